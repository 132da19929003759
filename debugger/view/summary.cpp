// Numbers, names and events in short: for lists, panels and sentences.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "debugger/render/step_pictures.h"
#include "debugger/view/explain.h"
#include "recordings/outlines.h"

namespace gjkdbg {

std::string short_number(double x) {
  if (std::isnan(x)) return "unknown";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x == 0 ? 0.0 : x);
  return text;
}

std::string short_vector(const AnyVector& v, int digits) {
  std::string out = "(";
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    char text[32];
    const bool nothing = std::abs(v[i]) <= 4e-16 * v.cwiseAbs().maxCoeff();  // beside the rest
    std::snprintf(text, sizeof text, "%.*g", digits, nothing ? 0.0 : v[i]);
    out += (i > 0 ? ", " : "") + std::string(text);
  }
  return out + ")";
}

int digits_that_tell(const AnyVector& p, const AnyVector& q) {
  const double apart = (p - q).lpNorm<Eigen::Infinity>(), far = std::max(p.lpNorm<Eigen::Infinity>(), q.lpNorm<Eigen::Infinity>());
  if (!(apart > 0) || !std::isfinite(far)) return 4;
  return static_cast<int>(std::clamp(std::ceil(std::log10(far) - std::log10(apart)) + 2, 4.0, 17.0));
}

int digits_of_places(const Scene& scene) {
  int digits = 4;
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) digits = std::max(digits, digits_that_tell(scene.bodies[0].pose.position, scene.bodies[i].pose.position));
  return digits;
}

std::string short_place(const Recording& recording, const AnyVector& point) { return short_vector(point, digits_of_places(recording.scene.scene)); }

std::string letters(const std::vector<int>& vertices, const std::vector<int>& order, bool newest_first) {
  std::string out;
  for (const int v : vertices) {
    const auto at = std::find(order.begin(), order.end(), v);
    out += at == order.end() ? '?' : vertex_letter(newest_first ? at - order.begin() : order.end() - at - 1);
  }
  if (!newest_first) std::sort(out.begin(), out.end());
  return out;
}

bool meets_at(const Recording& recording, std::size_t step) {
  if (step + 1 >= recording.events.size()) return false;
  const Event& next = recording.events[step + 1];
  const auto* end = std::get_if<recorded::CastEnded>(&next);
  return std::holds_alternative<recorded::ImpulseApplied>(next) || (end && end->status == CastStatus::hit);
}

std::string body_name(const Recording& recording, int body) {
  const auto& bodies = recording.scene.scene.bodies;
  const std::string& name = bodies[std::min(static_cast<std::size_t>(body), bodies.size() - 1)].name;
  const std::string letter = body_letter(body);
  return name.empty() ? "body " + letter : name == letter ? name : name + " (" + letter + ")";
}

std::string facet_name(const Recording& recording) { return gjkdbg::facet_name(recording.scene.scene.dimension); }

bool of_two_boxes(const Recording& recording, std::size_t step) {
  const int dimension = recording.scene.scene.dimension;
  for (std::size_t i = step + 1; i-- > 0;)
    if (const auto* began = std::get_if<recorded::SatBegan>(&recording.events[i])) return dimension > 1 && began->faces_a == dimension && began->faces_b == dimension;
  return false;
}

bool of_an_outline(const Recording& recording) { return recording.settings.name != MethodName::sat; }
bool outline_told(const Recording& recording) {
  const Scene& scene = recording.scene.scene;
  const auto mesh = [](const Body& body) { return std::holds_alternative<Mesh>(body.shape.geometry); };
  return of_an_outline(recording) && !scene.motion && std::none_of(scene.bodies.begin(), scene.bodies.end(), mesh);
}
namespace {

bool has_outline(const Recording& recording, OutlineKind kind) {
  if (!outline_told(recording)) return false;
  const std::optional<DepthOutline> outline = outline_of(recording);
  return outline && outline->kind == kind;
}

}  // namespace

bool of_near_balls(const Recording& recording) { return has_outline(recording, OutlineKind::near_balls); }
bool of_tilted_axes(const Recording& recording) { return has_outline(recording, OutlineKind::tilted_axes); }
bool of_bends(const Recording& recording) { return has_outline(recording, OutlineKind::bends); }
bool after_epa(const Recording& recording, std::size_t step) {
  for (std::size_t i = step + 1; i-- > 1;)
    if (std::holds_alternative<recorded::SatBegan>(recording.events[i])) return std::holds_alternative<recorded::EpaEnded>(recording.events[i - 1]);
  return false;
}
bool by_bends(const Recording& recording, std::size_t step) { return of_bends(recording) || after_epa(recording, step); }

namespace {

struct Summarise {
  const Recording& recording;
  std::size_t step;
  bool newest_first;

  std::string operator()(const recorded::GjkBegan& e) const { return "d = " + short_vector(e.direction); }
  std::string operator()(const recorded::SupportQueried& e) const { return "w = " + short_vector(e.w); }
  std::string operator()(const recorded::VertexKept& e) const { return "w = " + short_vector(e.w); }
  std::string operator()(const recorded::SimplexReduced& e) const {
    return letters(e.before, e.before, newest_first) + " -> " + letters(e.region, e.before, newest_first) + (e.closest.size() > 0 ? "  |v| = " + short_number(e.closest.norm()) : "");
  }
  /// A solver's is put down from its answer.
  std::string operator()(const recorded::GjkEnded& e) const {
    if (foreign(recording) && e.status != GjkStatus::aborted) return e.status == GjkStatus::enclosed || e.status == GjkStatus::touching || e.status == GjkStatus::within_radius ? "taken to overlap" : "taken to be apart";
    return std::string(word_of(e.status));
  }
  std::string operator()(const recorded::PolytopeSeeded& e) const { return std::to_string(e.vertices.size()) + " vertices, " + std::to_string(e.faces.size()) + " " + facet_name(recording) + "s"; }
  std::string operator()(const recorded::FaceChosen& e) const { return facet_name(recording) + " " + std::to_string(e.face) + " at " + short_number(e.distance); }
  std::string operator()(const recorded::PolytopeGrown& e) const { return "-" + std::to_string(e.removed.size()) + " +" + std::to_string(e.added.size()) + " " + facet_name(recording) + "s"; }
  std::string operator()(const recorded::EpaEnded& e) const {
    if (e.status == EpaStatus::aborted) return "aborted";  // no depth was found
    return std::string(word_of(e.status)) + "  depth " + short_number(e.depth);
  }
  std::string operator()(const recorded::MprBegan& e) const { return "from " + short_vector(e.interior); }
  std::string operator()(const recorded::PortalFound& e) const { return "portal at " + short_number(e.distance); }
  std::string operator()(const recorded::MprEnded& e) const {
    return std::string(word_of(e.status)) + (e.status == MprStatus::separated ? "  gap " + short_number(-e.depth) : e.status == MprStatus::overlapping ? "" : "  depth " + short_number(e.depth));
  }
  std::string operator()(const recorded::SatBegan& e) const {
    if (of_near_balls(recording)) return "nearly balls";
    if (by_bends(recording, step)) return "by the bends";
    if (of_tilted_axes(recording)) return "about nearly one line";
    if (of_an_outline(recording) && e.faces_a + e.faces_b == 0) return "a curved outline";
    if (of_an_outline(recording)) return std::to_string(e.faces_a) + " + " + std::to_string(e.faces_b) + " edges of the outline";
    return std::to_string(e.faces_a) + " + " + std::to_string(e.faces_b) + " faces, " + std::to_string(e.edge_pairs) + " edge pairs";
  }
  std::string operator()(const recorded::AxisTested& e) const { return (e.distance > 0 ? "gap " : "overlap ") + short_number(std::abs(e.distance)); }
  std::string operator()(const recorded::PointsProjected& e) const { return "|a - b| = " + short_number(e.closest.norm()); }
  std::string operator()(const recorded::SatEnded& e) const {
    return std::string(word_of(e.status)) + "  " + short_number(e.distance);
  }
  std::string operator()(const recorded::ClosedFormBegan& e) const { return "c = " + short_vector(e.corner); }
  std::string operator()(const recorded::LinesSolved& e) const {
    const std::string s = std::isnan(e.s) ? "" : "s = " + short_number(e.s), t = std::isnan(e.t) ? "" : "t = " + short_number(e.t);
    return s.empty() || t.empty() ? s + t : s + "  " + t;
  }
  std::string operator()(const recorded::ClosedFormEnded& e) const { return std::string(word_of(e.status)) + "  " + short_number((e.lower_bound + e.upper_bound) / 2); }
  std::string operator()(const recorded::ProjectionsBegan& e) const { return "x = " + short_place(recording, e.point); }
  std::string operator()(const recorded::PointPredicted& e) const { return "x = " + short_place(recording, e.point); }
  std::string operator()(const recorded::ProjectionsEnded& e) const { return std::string(word_of(e.status)); }
  std::string operator()(const recorded::CastBegan& e) const { return std::to_string(e.pairs.size()) + (e.pairs.size() == 1 ? " pair" : " pairs"); }
  std::string operator()(const recorded::CastAdvanced& e) const { return (recording.scene.scene.bodies.size() > 2 ? pair(e.pair) + "  " : "") + "t = " + short_number(e.time) + "  d = " + short_number(e.distance); }
  std::string operator()(const recorded::CastEnded& e) const { return std::string(word_of(e.status)) + "  t = " + short_number(e.time); }
  std::string operator()(const recorded::State& e) const { return "t = " + short_number(e.time); }
  std::string pair(const std::array<int, 2>& p) const { return body_letter(p[0]) + "-" + body_letter(p[1]); }
  std::string operator()(const recorded::ContactFound& e) const { return pair(e.pair) + "  depth " + short_number(e.depth); }
  /// Of a cast the velocities change, and there is no impulse.
  std::string operator()(const recorded::ImpulseApplied& e) const {
    if (recording.scene.scene.query != Query::cast) return pair(e.pair) + "  " + short_number(e.impulse.norm());
    for (std::size_t k = 0; k < std::min(e.velocities_before.size(), e.velocities_after.size()) && k < 2; ++k)
      if (e.velocities_before[k] != e.velocities_after[k]) return body_letter(e.pair[k]) + "  v = " + short_vector(e.velocities_after[k]);
    return pair(e.pair);
  }
  std::string operator()(const recorded::Warning& e) const { return e.code; }
};

}  // namespace

std::string summary(const Recording& recording, std::size_t step, bool newest_first) { return std::visit(Summarise{recording, step, newest_first}, recording.events[step]); }

}  // namespace gjkdbg
