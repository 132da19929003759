#include "debugger/view/explain.h"

#include <algorithm>
#include <cmath>

#include "debugger/render/step_pictures.h"
#include "debugger/view/explain_methods.h"
#include "recordings/region_tests.h"

namespace gjkdbg {
namespace {

std::string feature_name(std::size_t vertices) {
  static const char* const names[] = {"nothing", "vertex", "edge", "triangle", "tetrahedron"};
  return vertices < 5 ? names[vertices] : "simplex";
}

struct Explain : ExplainMethods {
  using ExplainMethods::operator();

  /// The number that speaks against each dropped vertex: its weight in the projection of the origin on the part it was tried with.
  std::string why_dropped(const recorded::SimplexReduced& e) const {
    std::vector<AnyVector> points;
    for (const int v : e.before) {
      const auto found = frame.vertices.find(v);
      if (found == frame.vertices.end()) return {};
      points.push_back(found->second.w);
    }
    if (points.size() < 2 || points.size() > 4) return {};
    std::string text;
    const std::vector<RegionTest> tests = region_tests(points);
    for (std::size_t i = 0; i < e.before.size(); ++i) {
      if (std::find(e.region.begin(), e.region.end(), e.before[i]) != e.region.end()) continue;
      // The largest part with this vertex that the kept ones belong to, and where its weight is negative.
      const RegionTest* against = nullptr;
      double weight = 0;
      for (const RegionTest& test : tests)
        for (std::size_t k = 0; k < test.part.size(); ++k)
          if (test.part[k] == static_cast<int>(i) && test.weights[k] < 0 && (!against || test.part.size() > against->part.size())) against = &test, weight = test.weights[k];
      if (!against) continue;
      std::string rest;
      for (const int k : against->part)
        if (k != static_cast<int>(i)) rest.insert(newest_first ? rest.end() : rest.begin(), letter_at(static_cast<std::size_t>(k), points.size()));
      const char letter = letter_at(i, points.size());
      std::string part = rest + letter;
      std::sort(part.begin(), part.end());
      text += std::string("; \xCE\xBB") + letter + " = " + short_number(weight) + " in " + part + ": the origin lies beyond " + (rest.size() == 1 ? "" : feature_name(rest.size()) + " ") + rest;
    }
    return text;
  }

  /// Whether GJK left one, not just four points of less.
  bool solid_tetrahedron() const {
    std::vector<Eigen::Vector3d> w;
    for (const int v : frame.simplex)
      if (const auto found = frame.vertices.find(v); found != frame.vertices.end()) w.push_back(in_space(found->second.w));
    const auto edge = [&](std::size_t i) -> Eigen::Vector3d { return (w[i] - w[0]).stableNormalized(); };
    return w.size() == 4 && std::abs(edge(1).cross(edge(2)).dot(edge(3))) > 1e-6;
  }

  bool rounded() const { return recording.settings.name != MethodName::gjk_boolean && gjkdbg::rounded(recording.scene.scene); }  ///< whether the method goes by cores
  const char* bodies() const { return rounded() ? "cores" : "bodies"; }

  bool sat_follows() const { return frame.step + 1 < recording.events.size() && std::holds_alternative<recorded::SatBegan>(recording.events[frame.step + 1]); }
  /// GJK sees the cores alone.
  std::string less_the_radii(const recorded::GjkEnded& e) const {
    if (!rounded() || !frame.closest) return "";
    const double cores = frame.closest->norm(), radii = cores - (e.lower_bound + e.upper_bound) / 2;
    return radii > 1e-9 * cores ? ": |v| = " + short_number(cores) + " between the cores, less the radii, " + short_number(radii) + " together" : "";
  }
  std::string with_the_radii(const recorded::EpaEnded& e) const {
    const auto chosen = frame.chosen ? frame.faces.find(*frame.chosen) : frame.faces.end();
    if (!rounded() || chosen == frame.faces.end() || !(e.depth - chosen->second.distance > 1e-9 * e.depth)) return "";
    return ", " + short_number(chosen->second.distance) + " of the cores, with the radii, " + short_number(e.depth - chosen->second.distance) + " together,";
  }

  /// Bounds that differ in what is on show of them have not met.
  std::string how_near(const recorded::GjkEnded& e) const {
    const double gap = e.upper_bound - e.lower_bound, size = std::max(std::abs(e.lower_bound), std::abs(e.upper_bound));
    if (gap <= 1e-4 * size) return " have met. The signed distance is known";
    return std::string(gap <= recording.settings.tolerance * size ? " are within the tolerance of each other" : " are as near as rounding lets them come") + ", and the signed distance lies between them";
  }

  /// After a stall that leaves open whether the bodies touch: who is asked next (algo/run_gjk.h, algo/solve_pair.h). In a motion, and between the parts of meshes, the next run may be another pair's.
  std::string asked_next() const {
    const Settings& s = recording.settings;
    const std::size_t next = frame.step + 1;
    if (recording.scene.scene.bodies.size() != 2 || next >= recording.events.size()) return "";
    const bool again = s.closest_point != ClosestPoint::signed_volumes && std::holds_alternative<recorded::GjkBegan>(recording.events[next]);
    const bool mpr = recording.scene.scene.query == Query::intersect && std::holds_alternative<recorded::MprBegan>(recording.events[next]);
    if (!again && !mpr) return "";
    return std::string(" They leave open whether the bodies touch, so ") + (again ? "signed volumes, which have exact signs to fall back on, begin once more." : "MPR is asked, which looks from a point inside A - B, not from the origin.");
  }

  std::string sentence(const recorded::GjkEnded& e) const {
    switch (e.status) {
      case GjkStatus::converged:
        if (!std::isfinite(e.lower_bound) || !std::isfinite(e.upper_bound)) return "The search ends, and the bodies are called apart. How far is not said here.";
        return "No support lies farther along -v than v itself: the bounds " + short_number(e.lower_bound) + " and " + short_number(e.upper_bound) + how_near(e) + less_the_radii(e) + ".";
      case GjkStatus::separated: return "The plane of the last support has all of " + difference() + " on its far side, so the bodies are apart. Only yes or no was asked, and this is the proof.";
      case GjkStatus::within_radius: return "The cores are apart, but nearer than the radii around them: the bodies overlap, and no more was asked.";
      case GjkStatus::enclosed: return "The simplex encloses the origin: some point of body " + a() + " is also a point of body " + b() + ". The " + bodies() + " overlap.";
      case GjkStatus::touching: return std::string("The origin lies on the simplex, within rounding: on a vertex, an edge or a face. ") + (frame.step + 1 == recording.events.size() ? "The bodies touch or overlap, and no more was asked." : std::string("Whether this is touch or overlap, ") + (sat_follows() ? "the next steps" : "EPA") + " will tell.");
      case GjkStatus::stalled:
        return "|v| no longer falls: the precision is used up, or the method's own rule stops it. The bounds say how much is known." + asked_next();
      case GjkStatus::iteration_limit: return "The iteration limit is reached before the bounds met. This is no answer; the bounds say how much is known.";
      case GjkStatus::rule_met: return "The stopping rule of the method is met. Bounds that have not met say that it stopped early.";
      case GjkStatus::aborted: return "The solver ended without an answer.";
    }
    return {};
  }

  std::string sentence(const recorded::EpaEnded& e) const {
    const std::string face = facet();
    switch (e.status) {
      case EpaStatus::converged:
        if (ends_at_an_earlier_face(e))
          return "Along the normal of " + (frame.faces.contains(e.face) ? face + " " + std::to_string(e.face) + ", which was asked along before, " : former_face(e.face) + ", ") + difference() + " reaches no farther than the polytope's nearest " + face + " is now: the bounds have met, and that" + with_the_radii(e) +
                 " is the depth. Moving body " + b() + " by " + short_number(e.depth) + " along " + short_vector(e.normal) + " just separates the bodies.";
        return "No vertex lies beyond the chosen " + face + ": it is part of the boundary of " + difference() + ", and its distance" + with_the_radii(e) + " is the depth. Moving body " + b() + " by " + short_number(e.depth) + " along " +
               short_vector(e.normal) + " just separates the bodies.";
      case EpaStatus::flat:
        if (rounded()) return "The difference of the cores has no " + measure() + ", and the origin lies in it: the depth, " + short_number(e.depth) + ", is that of the radii alone. The normal is across the flat difference.";
        return difference() + " has no " + measure() + " here: the " + bodies() + " touch without depth. The normal is across the flat difference.";
      case EpaStatus::separated:
        if (frame.lower_bound.value_or(0) <= 0) return "A support plane has the origin on its far side: the bodies seem to be apart after all, but by less than rounding can tell.";
        return "A support plane has the origin on its far side: the bodies are apart after all, by less than GJK could tell.";
      case EpaStatus::stalled: return "No " + face + " can be added in this precision. The last good " + face + " is the answer, and the bounds say how exact it is.";
      case EpaStatus::iteration_limit: return "The limit is reached before the bounds met, as on round shapes with many directions equally good. The bounds say how much is known." + std::string(sat_follows() ? " How ellipsoids bend may tell more." : "");
      case EpaStatus::aborted: return "The solver ended without an answer.";
    }
    return {};
  }

  /// One that has been removed since it was chosen.
  std::string former_face(int face) const {
    std::string text = "a" + std::string(facet() == "face" ? " " : "n ") + facet() + " that was there before (" + facet() + " " + std::to_string(face);
    for (std::size_t i = frame.step; i-- > 0;)
      if (const auto* chosen = std::get_if<recorded::FaceChosen>(&recording.events[i]); chosen && chosen->face == face) return text + ", chosen at step " + std::to_string(i) + ")";
    return text + ")";
  }

  /// Several ways out are as short, and the first one met is the answer.
  bool ends_at_an_earlier_face(const recorded::EpaEnded& e) const {
    for (std::size_t i = frame.step; i-- > 0;)
      if (const auto* chosen = std::get_if<recorded::FaceChosen>(&recording.events[i])) return e.face >= 0 && chosen->face != e.face;
    return false;
  }

  /// Where GJK begins when it is not told.
  std::string first_way(const AnyVector& direction) const {
    const auto& bodies = recording.scene.scene.bodies;
    const bool fallback = bodies.size() == 2 && bodies[0].pose.position == bodies[1].pose.position && direction.tail(direction.size() - 1).isZero(0);
    return fallback ? ", for the origins of the bodies' poses coincide. Any direction but zero would do." : ", from body " + a() + " towards body " + b() + ". Any direction but zero would do.";
  }

  Explanation operator()(const recorded::GjkBegan& e) const {
    if (frame.step + 1 < recording.events.size() && std::holds_alternative<recorded::VertexKept>(recording.events[frame.step + 1]))
      return {"GJK begins, warm", "It starts from the simplex the last run on these bodies ended with. If they have moved little, it is nearly right already."};
    return {"GJK begins", "The search starts along d = " + short_vector(e.direction) +
                              (recording.settings.initial_direction ? ", as the method says." : foreign(recording) ? ", as the solver chose. Any direction but zero would do." : first_way(e.direction))};
  }

  Explanation operator()(const recorded::VertexKept& e) const {
    return {"A vertex kept", "w = " + short_vector(e.w) + " was in the simplex the last run ended with. Its points of bodies " + a() + " and " + b() + " have moved with them: it still lies in " + difference() + ", so the search goes on from there."};
  }

  Explanation operator()(const recorded::SupportQueried& e) const {
    const std::string where = "The farthest point of " + difference() + " along d = " + short_vector(e.direction) + " is w = a - b = " + short_vector(e.w) + ". ";
    if (e.phase == Phase::seed)
      return solid_tetrahedron() && !foreign(recording) ? Explanation{"Support around the way out", where + "GJK's tetrahedron would do as EPA's start, but all of its faces would have to grow. Four corners around the way from the middle of " + difference() + " past the origin begin nearer to the answer."}
                                 : Explanation{"Support for EPA's start", where + "The simplex GJK left has too few corners for EPA: what is missing is asked for, across what is there."};
    if (e.phase == Phase::mpr)
      return {"Support for the portal", where + (e.direction.dot(e.w) < 0 ? "It lies short of the origin: its plane proves the bodies apart."
                                                                         : "It lies at or past the origin along d, so this plane does not separate the bodies.")};
    if (e.phase == Phase::cast) return {"Support for the ray", where + "Nothing of " + difference() + " lies beyond the plane there: if the point x on the ray still does, x moves on to that plane."};
    if (e.phase == Phase::sat) return {"Support along an axis", where + "How far it reaches past the origin is how far the bodies overlap along this axis."};
    if (e.phase == Phase::epa) return {"Support across the chosen " + facet(), where + reach_across(e)};
    const double along = e.direction.stableNormalized().dot(e.w);
    if (e.phase == Phase::projections)
      return {"Support across the way between", where + (along < 0 ? "All of " + difference() + " lies " + short_number(-along) + " or more short of the origin along d: the " + bodies() + " are at least that far apart. Where the two points are no farther from each other, they are the nearest."
                                                                   : "It lies at or past the origin along d, so nothing is proven yet.")};
    if (frame.simplex.size() <= 1) return {"First support", where + "One corner of the difference is a start: the simplex is this point."};
    const auto [title, why] = way(e.direction);
    return {title, why + where + (along < 0 ? "It lies " + short_number(-along) + " short of the origin along d: all of " + difference() + " does, so the " + bodies() + " are at least that far apart."
                                                              : "It lies at or past the origin along d, so nothing is proven yet.")};
  }

  std::string measure() const { return recording.scene.scene.dimension == 1 ? "length" : recording.scene.scene.dimension == 2 ? "area" : "volume"; }
  static std::string capital(std::string word) { return word[0] = static_cast<char>(word[0] - 'a' + 'A'), word; }

  /// How far EPA's support reaches, against the face chosen before it, and what comes of it.
  std::string reach_across(const recorded::SupportQueried& e) const {
    const auto* chosen = frame.step > 0 ? std::get_if<recorded::FaceChosen>(&recording.events[frame.step - 1]) : nullptr;
    const bool more = frame.step + 1 < recording.events.size();
    const bool grows = more && std::holds_alternative<recorded::PolytopeGrown>(recording.events[frame.step + 1]);
    if (!chosen || e.direction.isZero(0)) return "If it lies farther out than the " + facet() + ", the polytope grows to it; if not, the " + facet() + " is the boundary.";
    return "It reaches " + short_number(e.direction.stableNormalized().dot(e.w)) + " from the origin, the " + facet() + (grows ? " only " : " ") + short_number(chosen->distance) + ": " +
           (grows ? "the " + facet() + " is not the boundary, and the polytope grows to it." : "as far as it need be known, nothing lies beyond the " + facet() + ".");
  }

  /// Whether directions other than -v are asked for.
  bool led() const { return recording.settings.name == MethodName::gjk_accelerated; }
  bool ends_here() const { return frame.step + 1 < recording.events.size() && std::holds_alternative<recorded::GjkEnded>(recording.events[frame.step + 1]); }

  /// v of the simplex before this step; null where there is none.
  const AnyVector* closest_before() const {
    for (std::size_t i = frame.step; i-- > 0;)
      if (const auto* reduced = std::get_if<recorded::SimplexReduced>(&recording.events[i])) return reduced->closest.size() > 0 ? &reduced->closest : nullptr;
    return nullptr;
  }

  /// Of a direction of GJK's, and why it is not -v where it is not.
  std::pair<const char*, const char*> way(const AnyVector& direction) const {
    const AnyVector* v = led() ? closest_before() : nullptr;
    if (foreign(recording)) return {"The solver's next support", ""};
    if (!v || (direction.normalized() + v->normalized()).norm() < 1e-12) return {"Support towards the origin", ""};
    if (recording.settings.acceleration == Acceleration::newton) return {"Support along Newton's direction", "The curvature of the bodies at the last supports tells where the plane farthest from the origin should lie: across d, not across v. "};
    if (recording.settings.acceleration == Acceleration::smoothed) return {"Support along the smoothed direction", "So early, -v swings from side to side: d lies between it and the direction of the best plane so far. "};
    return {"Support along the momentum", "d keeps some of the directions before it, and is not -v alone. "};
  }

  /// What a solver keeps may be wrong, and no reason is given for it: the findings and the way to go on from here stand below.
  Explanation solver_keeps(const recorded::SimplexReduced& e) const {
    const std::string kept = letters(e.region, e.before, newest_first), all = letters(e.before, e.before, newest_first), part = feature_name(e.region.size()) + " " + kept;
    std::string text = e.before.size() <= e.region.size() ? "The solver keeps the " + part : "Of " + all + ", the solver keeps the " + part + " and drops " + letters(frame.dropped, e.before, newest_first);
    if (e.closest.size() > 0) text += ". It gives v = " + short_vector(e.closest) + ", |v| = " + short_number(e.closest.norm()) + " for the point nearest the origin";
    return {e.before.size() <= e.region.size() ? "The whole " + feature_name(e.region.size()) + " is kept" : "Simplex cut to " + part, text + "."};
  }

  Explanation operator()(const recorded::SimplexReduced& e) const {
    if (foreign(recording)) return solver_keeps(e);
    if (e.before.size() == 1 && e.closest.size() > 0)
      return {"The simplex is one vertex", "So the nearest point is that vertex: v = " + short_vector(e.closest) + ", |v| = " + short_number(e.closest.norm()) + (led() || ends_here() ? "." : "; the search goes on along -v, towards the origin.")};
    const std::string kept = letters(e.region, e.before, newest_first), all = letters(e.before, e.before, newest_first);
    const std::string title = e.before.size() == e.region.size() ? "The whole " + feature_name(e.region.size()) + " is kept" : "Simplex cut to " + feature_name(e.region.size()) + " " + kept;
    std::string text;
    if (e.before.size() == e.region.size()) {
      text = "Every vertex of " + all + " is needed" + foot_within(e);
    } else {
      text = "Of " + all + ", the " + feature_name(e.region.size()) + " " + kept + " is nearest the origin; " + letters(frame.dropped, e.before, newest_first) + (frame.dropped.size() == 1 ? " is" : " are") + " dropped: no part with " +
             (frame.dropped.size() == 1 ? "it" : "them") + " is nearer";
    }
    text += why_dropped(e);
    if (e.closest.size() == 0) return {title, text + "." + what_the_region_means(e)};
    const double length = e.closest.norm();
    if (length == 0) return {title, text + ". The origin lies in it: the nearest point is the origin itself."};
    return {title, text + ". Its nearest point is v = " + short_vector(e.closest) + ", |v| = " + short_number(length) + (led() || ends_here() ? "." : "; the search goes on along -v.")};
  }

  /// Why a simplex of which nothing is dropped is the nearest part of itself.
  std::string foot_within(const recorded::SimplexReduced& e) const {
    const auto& weights = e.barycentric;
    const bool known = e.region.size() > 1 && weights.size() == e.region.size() && std::all_of(weights.begin(), weights.end(), [](double x) { return x > 0; });
    return known && e.closest.size() > 0 && e.closest.norm() > 0 ? ": the foot of the perpendicular from O lies within it, for all weights are positive" : "";
  }

  /// Of the form that computes no nearest point: the end says whether the region holds the origin.
  std::string what_the_region_means(const recorded::SimplexReduced& e) const {
    const auto* end = ends_here() ? std::get_if<recorded::GjkEnded>(&recording.events[frame.step + 1]) : nullptr;
    const std::string part = feature_name(e.region.size()) + " " + letters(e.region, e.before, newest_first);
    if (!end) return " The next direction leads from it to the origin.";
    if (end->status == GjkStatus::enclosed) return " The origin lies in the " + part + ": the " + bodies() + " overlap.";
    if (end->status == GjkStatus::touching) return " The origin lies on the " + part + ", within rounding: the " + bodies() + " touch or overlap.";
    return "";
  }

  Explanation operator()(const recorded::GjkEnded& e) const {
    if (foreign(recording) && e.status != GjkStatus::aborted)
      return {"The solver ends", std::string("It takes the bodies to be ") + (e.status == GjkStatus::enclosed || e.status == GjkStatus::touching || e.status == GjkStatus::within_radius ? "overlapping." : "apart.")};
    const bool open = e.status == GjkStatus::touching && frame.step + 1 < recording.events.size();  // until the next steps tell
    return {"GJK ends: " + (open ? "touching or overlapping" : in_words(word_of(e.status))), sentence(e)};
  }

  Explanation operator()(const recorded::PolytopeSeeded& e) const {
    return {"EPA begins with " + std::to_string(e.faces.size()) + " " + facet() + "s",
            "A polytope inside " + difference() + " that holds the origin. It grows outwards until its nearest " + facet() + " is part of the boundary; that " + facet() + "'s distance" + (rounded() ? ", and the radii, are" : " is") + " the depth."};
  }

  /// A solver knows its faces by them.
  std::string vertices_of(int face) const {
    const auto found = frame.faces.find(face);
    if (found == frame.faces.end()) return "";
    std::string text;
    for (const int v : found->second.vertices) text += " #" + std::to_string(v);
    return " (vertices" + text + ")";
  }

  Explanation operator()(const recorded::FaceChosen& e) const {
    if (foreign(recording)) return {"The solver's nearest " + facet(), "It takes " + facet() + " " + std::to_string(e.face) + vertices_of(e.face) + " for the nearest to the origin, and gives " + short_number(e.distance) + " for its distance, " + short_vector(e.normal) + " for its normal."};
    return {"Nearest " + facet() + " chosen", capital(facet()) + " " + std::to_string(e.face) + " is nearest the origin, at " + short_number(e.distance) + ". The depth is at least that. Is there anything of " + difference() + " beyond it?"};
  }

  Explanation operator()(const recorded::PolytopeGrown& e) const {
    const bool plane = facet() == "edge";
    const std::string bounds = frame.lower_bound && frame.upper_bound ? " The depth lies between " + short_number(std::max(0.0, -*frame.upper_bound)) + " and " + short_number(-*frame.lower_bound) + "." : "";
    return {"The polytope grows", "The new vertex sees " + std::to_string(e.removed.size()) + " " + facet() + (e.removed.size() == 1 ? ", which is" : "s, which are") + " removed. " +
                                      (plane ? "The gap's two ends are" : "The hole's rim, the horizon, is") + " joined to it by " + std::to_string(e.added.size()) + " new " + facet() + "s." + bounds};
  }

  Explanation operator()(const recorded::EpaEnded& e) const {
    if (foreign(recording) && e.status != EpaStatus::aborted)
      return {"The solver's EPA ends", "It takes the " + facet() + " chosen for part of the boundary, and gives " + short_number(e.depth) + " for the depth" + (e.normal.isZero(0) ? "." : ", " + short_vector(e.normal) + " for the normal.")};
    return {"EPA ends: " + in_words(word_of(e.status)), sentence(e)};
  }

  Explanation operator()(const recorded::Warning& e) const { return {"Warning: " + e.code, e.message}; }
};

}  // namespace

bool rounded(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) { return b.shape.margin > 0 || std::holds_alternative<Sphere>(b.shape.geometry) || std::holds_alternative<Capsule>(b.shape.geometry); });
}

Explanation explain(const Recording& recording, const Frame& frame, bool newest_first) { return std::visit(Explain{{recording, frame, newest_first}}, recording.events[frame.step]); }

}  // namespace gjkdbg
