// check, what every event has to keep to, whatever the algorithm.
#include <algorithm>
#include <cmath>

#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

constexpr std::string_view gjk = "gjk", epa = "epa", mpr = "mpr", sat = "sat", projections = "projections", closed_form = "closed_form", motion = "cast";

/// The phase an event takes place in; empty for those that stand for themselves.
struct PhaseOf {
  bool in_sat;  ///< which projects points, too
  std::string_view operator()(const recorded::SupportQueried& e) const {
    constexpr std::array names{gjk, epa, epa, mpr, sat, motion, projections};
    return names[static_cast<std::size_t>(e.phase)];
  }
  std::string_view operator()(const recorded::VertexKept&) const { return gjk; }
  std::string_view operator()(const recorded::SimplexReduced&) const { return gjk; }
  std::string_view operator()(const recorded::PolytopeSeeded&) const { return epa; }
  std::string_view operator()(const recorded::FaceChosen&) const { return epa; }
  std::string_view operator()(const recorded::PolytopeGrown&) const { return epa; }
  std::string_view operator()(const recorded::PortalFound&) const { return mpr; }
  std::string_view operator()(const recorded::AxisTested&) const { return sat; }
  std::string_view operator()(const recorded::PointsProjected&) const { return in_sat ? sat : projections; }
  std::string_view operator()(const recorded::PointPredicted&) const { return projections; }
  std::string_view operator()(const recorded::LinesSolved&) const { return closed_form; }
  std::string_view operator()(const recorded::CastAdvanced&) const { return motion; }
  template <class E>
  std::string_view operator()(const E&) const {
    return {};
  }
};

}  // namespace

void TraceCheck::order(const Event& event) {
  phases(event);
  if (const auto vertex = given_vertex(event)) given(vertex->vertex, !c_.vertices.contains(vertex->vertex), "a vertex");
  const auto* seeded = std::get_if<recorded::PolytopeSeeded>(&event);
  const auto* grown = std::get_if<recorded::PolytopeGrown>(&event);
  if (!seeded && !grown) return;
  if (seeded) polytope_.clear();
  for (const auto& f : seeded ? seeded->faces : grown->added) polytope_.insert(f.face), given(f.face, faces_.insert(f.face).second, "a face");
}

void TraceCheck::values(const Event& event) {
  std::visit([this](const auto& e) { judge(e); }, event);
}

/// A motion encloses the runs it is made of; these do not enclose one another. EPA has no beginning of its own: it
/// follows a run of GJK, perhaps with MPR or SAT between.
void TraceCheck::phases(const Event& event) {
  const std::string_view kind = kind_name(event), inside = std::visit(PhaseOf{open_ == sat}, event);
  const bool begins = kind.ends_with("_began"), ends = kind.ends_with("_ended");
  const std::string_view phase = begins || ends ? kind.substr(0, kind.size() - 6) : inside;
  if (phase.empty()) {
    const bool of_motion = std::holds_alternative<recorded::State>(event) || std::holds_alternative<recorded::ContactFound>(event) || std::holds_alternative<recorded::ImpulseApplied>(event);
    if (of_motion && !c_.recording.scene.scene.motion) c_.find("wrong-state", "The bodies of this scene do not move: it has no \"" + std::string(kind) + "\".");
    return;
  }
  any_ = true;
  if (phase == motion) {
    if (begins && (motion_open_ || moved_)) incomplete("The cast begins a second time: after a response it goes on.");
    else if (ends && moved_) incomplete("The cast ends a second time.");
    else if (ends && !motion_open_) incomplete(std::string(kind) + " stands outside any cast: none has begun.");
    moved_ = moved_ || ends;
    motion_open_ = !ends;
    return;
  }
  if (!open_.empty() && open_ != phase) incomplete("A step of " + std::string(phase) + " comes before " + std::string(open_) + ", begun at step " + std::to_string(begun_) + ", has ended.");
  if (begins && open_ == phase) incomplete(std::string(phase) + " begins again before the run of step " + std::to_string(begun_) + " has ended.");
  const bool expands = phase == epa && expandable_;
  if (!begins && open_ != phase && !expands)
    incomplete(std::string(kind) + " stands outside any run of " + std::string(phase) + (ends && last_ended_ == phase ? ": the last one has ended already." : ": none has begun."));
  const auto* expanded = std::get_if<recorded::EpaEnded>(&event);
  if (expanded && open_ != phase && expands && expanded->status == EpaStatus::converged) incomplete("EPA ends, converged, but no step of it stands before: there is no polytope.");
  if (open_ != phase) begun_ = c_.step;
  open_ = ends ? std::string_view() : phase;
  if (!ends) return;
  last_ended_ = phase;
  expandable_ = phase == gjk || (expandable_ && (phase == mpr || phase == sat));
}

void TraceCheck::finish() {
  if (!open_.empty()) incomplete("The run of " + std::string(open_) + " that began at step " + std::to_string(begun_) + " never ends: the recording is cut off, or its last event is missing.");
  if (motion_open_) incomplete("The cast never ends: the recording is cut off, or its last event is missing.");
  if (!any_ && c_.recording.scene.scene.query != Query::simulate && c_.recording.result.status != "aborted") incomplete("There is an answer, but no step that leads to it.");
}

void TraceCheck::incomplete(const std::string& message) { c_.find("incomplete-trace", message + " Every phase that begins ends in exactly one event of its own."); }

/// A number that was given out already would mean two things from here on.
void TraceCheck::given(int number, bool is_new, const char* what) {
  if (!is_new) c_.find("number-reused", std::string("The number ") + std::to_string(number) + " was given to " + what + " before: no number may be used twice in a recording.");
}

bool TraceCheck::belong_together(const AnyVector& a, const AnyVector& b, const AnyVector& w) {
  if (!a.allFinite() || !b.allFinite() || !w.allFinite()) return false;
  const AnyVector difference = a - b;
  if ((difference - w).stableNorm() <= c_.tolerance + far_out(a, b)) return true;
  const AnyVector beside_sum = a + b - w, beside_turned = difference + w;
  const double limit = c_.tolerance + far_out(a, b);
  const bool sum = beside_sum.stableNorm() <= limit, turned = beside_turned.stableNorm() <= limit;
  c_.find("wrong-support", "w is " + text_of(w) + ", but a - b is " + text_of(difference) + "." + (sum ? " What is given is a + b." : turned ? " What is given is b - a." : " The usual cause is a point of another query."));
  return false;
}

/// World coordinates far from the origin have lost digits.
double TraceCheck::far_out(const AnyVector& a, const AnyVector& b) const {
  return c_.digits() * (a.stableNorm() + b.stableNorm());
}

void TraceCheck::judge(const recorded::VertexKept& e) { belong_together(e.a, e.b, e.w); }

void TraceCheck::judge(const recorded::SupportQueried& e) {
  if (!belong_together(e.a, e.b, e.w) || !c_.has_supports || !e.direction.allFinite() || e.direction.isZero(0)) return;
  const AnyVector d = e.direction.stableNormalized();
  for (const bool first : {true, false}) {
    const AnyVector& point = first ? e.a : e.b;
    const double beyond = c_.short_of_support(first ? 0 : 1, first ? d : AnyVector(-d), point);
    if (beyond <= c_.tolerance + far_out(e.a, e.b)) continue;
    c_.find("wrong-support", std::string(first ? "a = " : "b = ") + text_of(point) + " is not the farthest point of body " + (first ? "0 along d" : "1 along -d") + ": it is off by " + text_of(beyond) + ", for d = " + text_of(e.direction) +
                                 "." + support_hint(first ? 0 : 1, first ? d : AnyVector(-d), point));
    return;
  }
}

/// Bounds of the bodies' signed distance. Where no depth is asked for, an overlap may count as 0.
void TraceCheck::bounds(double lower, double upper) {
  if (lower > upper + c_.tolerance) {
    c_.find("wrong-bounds", "The lower bound " + text_of(lower) + " is above the upper one, " + text_of(upper) + ".");
    return;
  }
  if (!c_.has_supports) return;
  const Result& right = c_.reference();
  const double limit = c_.answer_tolerance();
  const bool depth_asked = c_.recording.scene.scene.query > Query::distance;
  if (lower > (depth_asked ? *right.upper_bound : std::max(0.0, *right.upper_bound)) + limit || upper < *right.lower_bound - limit)
    c_.find("wrong-bounds", "The bounds " + bound_text(lower) + " and " + bound_text(upper) + " of the signed distance leave the right one out, " + text_of(*right.signed_distance) + ".");
}

/// Along a unit normal the bodies are as far apart, or as little deep, as is said.
void TraceCheck::along(const AnyVector& normal, double distance) {
  if (!c_.has_supports || c_.inferred || normal.isZero(0)) return;
  if (!normal.allFinite()) return c_.find("non-finite-direction", "The direction " + text_of(normal) + " holds what is no number.");
  if (const std::string off = c_.not_unit(normal); !off.empty()) return c_.find("wrong-normal", off);
  const double limit = c_.answer_tolerance();
  if (std::abs(-c_.body_height(normal) - distance) <= limit) return;
  const double right = -c_.body_height(normal);
  const auto length = [](double x) { return x == 0 ? "touching" : x > 0 ? text_of(x) + " apart" : text_of(-x) + " deep in each other"; };
  const std::string said = "Along the normal " + text_of(normal) + " the bodies are said to be " + length(distance) + ", but they are " + length(right);
  if (std::abs(-c_.body_height(-normal) - distance) <= limit) c_.find("flipped-normal", said + "; the other way round it would be right. Normals point from body 0 towards body 1.");
  else c_.find(distance > 0 ? "wrong-distance" : "wrong-depth", said + "." + c_.forgotten_radii(distance));
}

/// The nearest point is the upper bound, radii taken off. (A recording of MPR has points of two kinds.)
void TraceCheck::nearest(const AnyVector& closest, double upper) {
  if (!c_.has_supports || !c_.cores || closest.size() == 0 || !std::isfinite(upper)) return;
  const double right = closest.norm() - c_.radius;
  if (std::abs(upper - right) > std::max(c_.tolerance, 1e-7 * c_.size))
    c_.find("wrong-bounds", "The nearest point is " + text_of(right) + " away, radii taken off, but the upper bound is " + text_of(upper) + ".");
}

void TraceCheck::judge(const recorded::SimplexReduced& e) {
  bounds(e.lower_bound, e.upper_bound);
  nearest(e.closest, e.upper_bound);
}

/// A plane with a unit normal, as far from the origin as the vertices named. That of a sliver is turned by rounding: its normal is a product of two edges, off by some u of both
/// lengths, and so is the height of what lies far from the corner that the distance was measured at.
void TraceCheck::plane(const std::vector<int>& vertices, const AnyVector& normal, double distance) {
  std::vector<std::pair<int, AnyVector>> known;
  for (const int v : vertices)
    if (const AnyVector* w = c_.vertex(v)) known.emplace_back(v, *w);
  for (const auto& [number, w] : known) {
    const double height = normal.dot(w), off = std::abs(height - distance);
    if (!(off > std::max(c_.tolerance, 1e-7 * c_.size))) continue;
    std::vector<AnyVector> corners;
    for (const auto& vertex : known) corners.push_back(vertex.second);
    c_.find_unless(off <= c_.rounding_of(corners), "wrong-face", "Along " + text_of(normal) + " vertex " + std::to_string(number) + " lies at " + text_of(height) + ", but the distance is given as " + text_of(distance) + ".");
    return;
  }
}

void TraceCheck::judge(const recorded::GjkEnded& e) {
  bounds(e.lower_bound, e.upper_bound);
  if (!c_.has_supports || c_.inferred) return;  // how a solver's run ended is its answer, and judged as that
  const double distance = *c_.reference().signed_distance, limit = c_.answer_tolerance();
  const bool apart = e.status == GjkStatus::separated, cores_apart = e.status == GjkStatus::converged;
  if ((apart && distance < -limit) || (cores_apart && distance < -limit - c_.radius))
    c_.find("unjustified-separation", "GJK ended as \"" + std::string(word_of(e.status)) + "\", but the bodies overlap, " + text_of(-distance) + " deep." + (c_.recording.result.signed_distance ? c_.forgotten_radii(*c_.recording.result.signed_distance) : ""));
}

void TraceCheck::judge(const recorded::PolytopeGrown& e) { bounds(-e.upper_bound, -e.lower_bound); }

void TraceCheck::judge(const recorded::EpaEnded& e) {
  if (e.face >= 0 && !polytope_.empty() && !polytope_.contains(e.face)) c_.find("wrong-face", "EPA ends at face " + std::to_string(e.face) + ", which the polytope never had.");
  polytope_.clear();
  if (e.status != EpaStatus::aborted) along(e.normal, -e.depth);
}

void TraceCheck::judge(const recorded::PortalFound& e) {
  bounds(e.lower_bound, e.upper_bound);
  plane(e.vertices, e.normal, e.distance);
}

void TraceCheck::judge(const recorded::MprEnded& e) {
  if (e.status != MprStatus::flat) along(e.normal, -e.depth);
}

void TraceCheck::judge(const recorded::AxisTested& e) {
  bounds(e.lower_bound, e.upper_bound);
  along(e.direction, e.distance);
  if (c_.has_supports && c_.cores) plane({e.vertex}, e.direction, -(e.distance + c_.radius));
}

void TraceCheck::judge(const recorded::PointsProjected& e) {
  bounds(e.lower_bound, e.upper_bound);
  if (!e.closest.allFinite()) return no_point(e.closest);
  if (!belong_together(e.a, e.b, e.closest)) return;
  if (open_ == sat || e.closest.norm() - c_.radius < e.upper_bound) nearest(e.closest, e.upper_bound);  // else there was a nearer one before
}

void TraceCheck::no_point(const AnyVector& closest) { c_.find("wrong-closest", "The nearest point is given as " + text_of(closest) + ", which is no point."); }

void TraceCheck::judge(const recorded::SatEnded& e) { along(e.normal, e.distance); }

void TraceCheck::judge(const recorded::ProjectionsEnded& e) { bounds(e.lower_bound, e.upper_bound); }

/// The parameters give the nearest point, and along the normal the bodies are as far apart as the bounds say.
void TraceCheck::judge(const recorded::ClosedFormEnded& e) {
  bounds(e.lower_bound, e.upper_bound);
  if (c_.recording.scene.scene.query > Query::distance) along(e.normal, (e.lower_bound + e.upper_bound) / 2);
  if (e.closest.size() > 0 && !e.closest.allFinite()) return no_point(e.closest);
  if (!segments_ || !std::isfinite(e.s) || !std::isfinite(e.t)) return;
  const AnyVector right = segments_->corner + e.s * segments_->edge_a - e.t * segments_->edge_b;
  const double lost = c_.digits() * (segments_->corner.norm() + segments_->edge_a.norm() + segments_->edge_b.norm());  // of lengths that cancel
  if ((right - e.closest).norm() > std::max(c_.tolerance, 1e-7 * c_.size) + lost)
    c_.find("wrong-closest", "s = " + text_of(e.s) + " and t = " + text_of(e.t) + " give the point " + text_of(right) + ", but the nearest is given as " + text_of(e.closest) + ".");
}

}  // namespace gjkdbg
