#include "debugger/view/explain.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "debugger/render/step_pictures.h"

namespace gjkdbg {

std::string short_number(double x) {
  if (std::isnan(x)) return "unknown";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x == 0 ? 0.0 : x);
  return text;
}

std::string short_vector(const AnyVector& v) {
  std::string out = "(";
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", v[i] == 0 ? 0.0 : v[i]);
    out += (i > 0 ? ", " : "") + std::string(text);
  }
  return out + ")";
}

namespace {

std::string letters(const std::vector<int>& vertices, const std::vector<int>& order) {
  std::string out;
  for (const int v : vertices) {
    const auto at = std::find(order.begin(), order.end(), v);
    out += at == order.end() ? "?" : std::string(1, static_cast<char>('A' + (at - order.begin())));
  }
  return out;
}

std::string feature_name(std::size_t vertices) {
  static const char* const names[] = {"nothing", "vertex", "edge", "triangle", "tetrahedron"};
  return vertices < 5 ? names[vertices] : "simplex";
}

std::string sentence(GjkStatus status, const recorded::GjkEnded& e) {
  switch (status) {
    case GjkStatus::converged:
      return "No support lies nearer the origin than v: the bounds " + short_number(e.lower_bound) + " and " + short_number(e.upper_bound) + " have met. The bodies' signed distance is known.";
    case GjkStatus::separated: return "The plane of the last support has all of A - B on its far side, so the bodies are apart. Only yes or no was asked, and this is the proof.";
    case GjkStatus::within_radius: return "The cores are apart, but nearer than the radii around them: the bodies overlap, and no more was asked.";
    case GjkStatus::enclosed: return "The simplex encloses the origin: some point of A is also a point of B. The cores overlap.";
    case GjkStatus::touching: return "The origin lies on the simplex, within rounding: on a vertex, an edge or a face. Whether this is touch or overlap, EPA will tell.";
    case GjkStatus::stalled: return "|v| no longer falls: the precision is used up. The bounds say how much is known.";
    case GjkStatus::iteration_limit: return "The iteration limit is reached before the bounds met. This is no answer; the bounds say how much is known.";
    case GjkStatus::aborted: return "The solver ended without an answer.";
  }
  return {};
}

std::string sentence(EpaStatus status, const recorded::EpaEnded& e) {
  switch (status) {
    case EpaStatus::converged:
      return "No vertex lies beyond the chosen face: it is part of the boundary of A - B, and its distance is the depth. Moving B by " + short_number(e.depth) + " along " +
             short_vector(e.normal) + " just separates the bodies.";
    case EpaStatus::flat: return "A - B has no volume here: the cores touch without depth. The normal is across the flat difference.";
    case EpaStatus::separated: return "A support plane has the origin on its far side: the bodies are apart after all, by less than GJK could tell.";
    case EpaStatus::stalled: return "No face can be added in this precision. The last good face is the answer, and the bounds say how exact it is.";
    case EpaStatus::iteration_limit: return "The limit is reached before the bounds met, as on round shapes with many directions equally good. The bounds say how much is known.";
    case EpaStatus::aborted: return "The solver ended without an answer.";
  }
  return {};
}

struct Explain {
  const Recording& recording;
  const Frame& frame;

  Explanation operator()(const recorded::GjkBegan& e) const {
    return {"GJK begins", "The search starts along d = " + short_vector(e.direction) +
                              (recording.settings.initial_direction ? ", as the method says." : ", from A towards B. Any direction but zero would do.")};
  }

  Explanation operator()(const recorded::SupportQueried& e) const {
    const std::string where = "The farthest point of A - B along d = " + short_vector(e.direction) + " is w = a - b = " + short_vector(e.w) + ". ";
    if (e.phase == Phase::seed) return {"Support for EPA's start", where + "The simplex GJK left has too few corners for EPA: what is missing is asked for, across what is there."};
    if (e.phase == Phase::epa) return {"Support beyond the chosen face", where + "If it lies farther out than the face, the polytope grows to it; if not, the face is the boundary."};
    const double along = e.direction.dot(e.w) / e.direction.norm();
    if (frame.simplex.size() <= 1) return {"First support", where + "One corner of the difference is a start: the simplex is this point."};
    return {"Support towards the origin", where + (along < 0 ? "It lies " + short_number(-along) + " short of the origin along d: all of A - B does, so the bodies are at least that far apart (radii aside)."
                                                              : "It lies at or past the origin along d, so nothing is proven yet.")};
  }

  Explanation operator()(const recorded::SimplexReduced& e) const {
    const std::string kept = letters(e.region, e.before), all = letters(e.before, e.before);
    const std::string title = e.before.size() == e.region.size() ? "The whole " + feature_name(e.region.size()) + " is kept" : "Simplex cut to " + feature_name(e.region.size()) + " " + kept;
    std::string text;
    if (e.before.size() == e.region.size()) {
      text = "Every vertex of " + all + " is needed";
    } else {
      text = "Of " + all + ", the " + feature_name(e.region.size()) + " " + kept + " is nearest the origin; " + letters(frame.dropped, e.before) + " cannot hold the nearest point and " +
             (frame.dropped.size() == 1 ? "is" : "are") + " dropped";
    }
    if (e.closest.size() == 0) return {title, text + ". The next direction leads from it to the origin."};
    const double length = e.closest.norm();
    if (length == 0) return {title, text + ". The origin lies in it: the nearest point is the origin itself."};
    return {title, text + ". Its nearest point is v = " + short_vector(e.closest) + ", |v| = " + short_number(length) + "; the search goes on along -v."};
  }

  Explanation operator()(const recorded::GjkEnded& e) const {
    return {"GJK ends: " + std::string(gjk_status_names[static_cast<std::size_t>(e.status)]), sentence(e.status, e)};
  }

  Explanation operator()(const recorded::PolytopeSeeded& e) const {
    return {"EPA begins with " + std::to_string(e.faces.size()) + " faces",
            "A polytope inside A - B that holds the origin. It grows outwards until its nearest face is part of the boundary; that face's distance is the depth."};
  }

  Explanation operator()(const recorded::FaceChosen& e) const {
    return {"Nearest face chosen", "Face " + std::to_string(e.face) + " is nearest the origin, at " + short_number(e.distance) + ". The depth is at least that. Is there anything of A - B beyond it?"};
  }

  Explanation operator()(const recorded::PolytopeGrown& e) const {
    return {"The polytope grows", "The new vertex sees " + std::to_string(e.removed.size()) + (e.removed.size() == 1 ? " face, which is" : " faces, which are") +
                                      " removed. The hole's rim, the horizon, is joined to it by " + std::to_string(e.added.size()) + " new faces. The depth lies between " +
                                      short_number(e.lower_bound) + " and " + short_number(e.upper_bound) + "."};
  }

  Explanation operator()(const recorded::EpaEnded& e) const {
    return {"EPA ends: " + std::string(epa_status_names[static_cast<std::size_t>(e.status)]), sentence(e.status, e)};
  }

  Explanation operator()(const recorded::Warning& e) const { return {"Warning: " + e.code, e.message}; }
};

struct Summarise {
  std::string operator()(const recorded::GjkBegan& e) const { return "d = " + short_vector(e.direction); }
  std::string operator()(const recorded::SupportQueried& e) const { return "w = " + short_vector(e.w); }
  std::string operator()(const recorded::SimplexReduced& e) const {
    return letters(e.before, e.before) + " -> " + letters(e.region, e.before) + (e.closest.size() > 0 ? "  |v| = " + short_number(e.closest.norm()) : "");
  }
  std::string operator()(const recorded::GjkEnded& e) const { return std::string(gjk_status_names[static_cast<std::size_t>(e.status)]); }
  std::string operator()(const recorded::PolytopeSeeded& e) const { return std::to_string(e.vertices.size()) + " vertices, " + std::to_string(e.faces.size()) + " faces"; }
  std::string operator()(const recorded::FaceChosen& e) const { return "face " + std::to_string(e.face) + " at " + short_number(e.distance); }
  std::string operator()(const recorded::PolytopeGrown& e) const { return "-" + std::to_string(e.removed.size()) + " +" + std::to_string(e.added.size()) + " faces"; }
  std::string operator()(const recorded::EpaEnded& e) const {
    return std::string(epa_status_names[static_cast<std::size_t>(e.status)]) + "  depth " + short_number(e.depth);
  }
  std::string operator()(const recorded::Warning& e) const { return e.code; }
};

}  // namespace

Explanation explain(const Recording& recording, const Frame& frame) { return std::visit(Explain{recording, frame}, recording.events[frame.step]); }

std::string summary(const Recording& recording, std::size_t step) { return std::visit(Summarise{}, recording.events[step]); }

PseudoCode pseudo_code(const Recording& recording, std::size_t step) {
  const Event& event = recording.events[step];
  const auto* query = std::get_if<recorded::SupportQueried>(&event);
  if ((query && query->phase != Phase::gjk) || std::holds_alternative<recorded::PolytopeSeeded>(event) || std::holds_alternative<recorded::FaceChosen>(event) ||
      std::holds_alternative<recorded::PolytopeGrown>(event) || std::holds_alternative<recorded::EpaEnded>(event)) {
    PseudoCode code{"EPA", {"P = simplex, completed to enclose O", "repeat", "  f = face of P nearest O", "  w = support(normal of f)", "  if w not beyond f: depth = |f|", "  remove the faces w sees", "  join the horizon to w"}, -1};
    if (query) code.current = query->phase == Phase::seed ? 0 : 3;
    else if (std::holds_alternative<recorded::PolytopeSeeded>(event)) code.current = 0;
    else if (std::holds_alternative<recorded::FaceChosen>(event)) code.current = 2;
    else if (std::holds_alternative<recorded::PolytopeGrown>(event)) code.current = 6;
    else code.current = 4;
    return code;
  }
  PseudoCode code;
  if (recording.settings.name == MethodName::gjk_boolean) {
    code = {"GJK, boolean form", {"W = { support(d) };  d = -w", "repeat", "  w = support(d)", "  if w short of O: apart", "  W = { w } + W", "  W, d = region of O, way to O", "  if W encloses O: overlap"}, -1};
    if (std::holds_alternative<recorded::GjkBegan>(event)) code.current = 0;
    else if (query) code.current = query->iteration == 0 ? 0 : 2;
    else if (std::holds_alternative<recorded::SimplexReduced>(event)) code.current = 5;
    else if (const auto* end = std::get_if<recorded::GjkEnded>(&event)) code.current = end->status == GjkStatus::separated ? 3 : 6;
    return code;
  }
  code = {"GJK, distance form", {"w = support(d);  W = { w }", "repeat", "  v = point of W nearest O", "  W = the part of W that holds v", "  if v = O: overlap", "  w = support(-v)", "  if w no nearer O than v: apart", "  W = { w } + W"}, -1};
  if (std::holds_alternative<recorded::GjkBegan>(event)) code.current = 0;
  else if (query) code.current = query->iteration == 0 ? 0 : 5;
  else if (std::holds_alternative<recorded::SimplexReduced>(event)) code.current = 3;
  else if (const auto* end = std::get_if<recorded::GjkEnded>(&event)) code.current = end->status == GjkStatus::enclosed || end->status == GjkStatus::touching ? 4 : 6;
  return code;
}

}  // namespace gjkdbg
