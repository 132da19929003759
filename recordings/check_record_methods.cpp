// check, what our own recordings say twice: the part of MPR, SAT, the closed form, projections and casts.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "algo/motion.h"
#include "recordings/check_record.h"
#include "recordings/outlines.h"
#include "shapes/features.h"

namespace gjkdbg {
namespace {

bool looked_at(const std::vector<Edge>& pairs, const Edge& pair) { return std::find(pairs.begin(), pairs.end(), pair) != pairs.end(); }

}  // namespace

/// Whether the events are those of the method: every one but GJK begins with an event of its own, or says why it leaves all to GJK.
std::string RecordCheck::not_by_this_method() const {
  struct Own {
    MethodName name;
    std::string_view began, left;
  };
  const Settings& s = c_.recording.settings;
  const bool mpr_may_follow = s.penetration == Penetration::mpr || c_.recording.scene.scene.query == Query::intersect;  // where GJK stalls
  for (const Own& own : {Own{MethodName::mpr, "mpr_began", "mpr_began"}, Own{MethodName::sat, "sat_began", "flat-difference"}, Own{MethodName::projections, "projections_began", "flat-ellipsoid"}, Own{MethodName::closed_form, "closed_form_began", "closed_form_began"}}) {
    if (s.name == own.name && !methods_.contains(own.began) && !methods_.contains(own.left)) return "no step of it is there";
    const bool may_follow = own.name == MethodName::mpr ? mpr_may_follow : own.name == MethodName::sat && may_have_outline(c_.recording);
    if (s.name != own.name && methods_.contains(own.began) && !may_follow) return "there is \"" + std::string(own.began) + "\"";
  }
  return "";
}

void RecordCheck::judge(const recorded::Warning& e) {
  for (const std::string_view why : {"flat-difference", "flat-ellipsoid"})
    if (e.code == why) methods_.insert(why);
  contact_unknown_ |= e.code == "contact-unknown";
}
void RecordCheck::judge(const recorded::MprBegan& e) {
  methods_.insert(e.kind), inside_ = e.interior, height_ = unknown, cleared_ = -unknown;
  const bool leads = e.interior.norm() > 1000 * c_.digits() * c_.size;  // near the origin rounding leads elsewhere
  from_interior_ = leads ? AnyVector(-e.interior) : AnyVector();
  interior_ = leads ? AnyVector(e.interior.normalized()) : AnyVector(AnyVector::Zero(e.interior.size()));
  portal_ = Portal::none, newest_w_ = AnyVector();
  if (!leads) cleared_ = unknowable;
}

/// The origin's distance from the boundary of the hull of the inner point and the portal: no depth is less. NaN where it is rounding that has the origin inside, or where the planes of slivers
/// are worth less than what is compared here.
double RecordCheck::clearance(const recorded::PortalFound& e) const {
  if (inside_.size() != c_.dimension) return unknowable;  // the step that tells it is not there
  const double uncertain = std::max(c_.tolerance, 1e-7 * c_.size);
  std::vector<AnyVector> w;
  for (const int v : e.vertices)
    if (const auto found = c_.vertices.find(v); found != c_.vertices.end()) w.push_back(found->second);
  if (w.size() != static_cast<std::size_t>(c_.dimension) || std::abs(e.distance) <= uncertain) return unknowable;
  if (e.distance < 0) return -unknown;
  // As MPR takes off its own lower bound (algo/mpr.h): the normal is off by a few roundings over the sine between two sides, the plane by that times how far its points are.
  const auto is_noise = [&](const AnyVector& x, const AnyVector& y, const AnyVector& corner) {
    if (c_.dimension < 3) return false;
    const Eigen::Vector3d side = x - corner, other = y - corner;
    const double far = std::max({x.norm(), y.norm(), corner.norm()});
    return !(2 * c_.digits() * far * side.norm() * other.norm() <= uncertain * side.cross(other).norm());
  };
  if (c_.dimension == 3 && is_noise(w[1], w[2], w[0])) return unknowable;
  double least = e.distance;
  for (std::size_t i = 0; i < w.size() && c_.dimension > 1; ++i) {  // the sides, each of the inner point and of all corners but one
    const AnyVector p = w[(i + 1) % w.size()] - inside_, q = w[(i + 2) % w.size()] - inside_;
    AnyVector n = c_.dimension == 2 ? AnyVector(Eigen::Vector2d(p[1], -p[0])) : AnyVector(Eigen::Vector3d(p).cross(Eigen::Vector3d(q)));
    if (n.norm() <= 1e-6 * p.norm() * (c_.dimension == 3 ? q.norm() : 1) || is_noise(w[(i + 1) % w.size()], w[(i + 2) % w.size()], inside_)) return unknowable;
    if (n.dot(w[i] - inside_) > 0) n = -n;
    least = std::min(least, n.normalized().dot(inside_));
  }
  return std::max(0.0, least);
}

/// Supports bound the depth from above, portals with the origin on their inner side from below.
void RecordCheck::judge(const recorded::PortalFound& e) {
  portal_ = Portal::found_last;
  if (std::set<int>(e.vertices.begin(), e.vertices.end()).size() != e.vertices.size()) contradiction("The portal " + list_of(e.vertices) + " names a vertex twice.");
  if (static_cast<int>(e.vertices.size()) != c_.dimension) contradiction("The portal " + list_of(e.vertices) + " has " + std::to_string(e.vertices.size()) + " vertices instead of " + std::to_string(c_.dimension) + ".");
  if (const double cleared = clearance(e); std::isnan(cleared) || !(cleared_ >= cleared)) cleared_ = std::isnan(cleared_) ? cleared_ : cleared;
  bound("The lower", e.lower_bound, -height_);
  if (!std::isnan(cleared_)) bound("The upper", e.upper_bound, -cleared_);
}
void RecordCheck::judge(const recorded::MprEnded& e) {
  statuses_.emplace(word_of(e.status)), last_status_ = word_of(e.status);
  if (const std::string off = c_.not_unit(e.normal); !off.empty()) contradiction(off);
  const bool apart = e.status == MprStatus::separated;
  if (e.status != MprStatus::flat && (apart ? e.depth > c_.tolerance : e.depth < -c_.tolerance)) contradiction("MPR ended as \"" + std::string(last_status_) + "\", with a depth of " + text_of(e.depth) + ".");
  // "Overlapping" is known by a portal, or by a vertex that the ray from the inner point hits.
  const auto on_the_ray = [&] { return interior_.isZero(0) || (newest_w_ - newest_w_.dot(interior_) * interior_).norm() <= std::max(1e-6, 10 * c_.digits()) * c_.size; };
  const bool hit = portal_ == Portal::none && newest_w_.size() == interior_.size() && on_the_ray();
  if (e.status == MprStatus::overlapping && newest_w_.size() > 0 && !hit && portal_ != Portal::found_last) contradiction("MPR ended as \"overlapping\" without the portal that shows it.");
  lower_ = upper_ = unknowable;
  if (c_.recording.settings.penetration != Penetration::mpr || c_.recording.scene.scene.query <= Query::distance || e.status == MprStatus::flat || apart) return;
  lower_ = -height_, upper_ = portal_ == Portal::none || std::isnan(cleared_) ? unknowable : -std::max(0.0, cleared_);
}

/// Of two boxes opposite faces and parallel edges share their axes; of others there is one for every way that a face faces, and for two edges of different ways. Of bodies of revolution
/// the edges of a section count.
void RecordCheck::count_axes(const recorded::SatBegan& e) {
  const auto& bodies = c_.recording.scene.scene.bodies;
  section_slack_ = 0, curved_section_ = may_have_outline(c_.recording);
  if (!c_.has_supports || bodies.size() != 2) return;
  if (c_.recording.settings.name != MethodName::sat) return count_section_axes(e);
  const std::optional<Features> a = features_of(bodies[0].shape, c_.dimension), b = features_of(bodies[1].shape, c_.dimension);
  if (!a || !b) return;
  const auto count = [](const auto& list) { return static_cast<Number>(list.size()); };
  const std::array<Number, 3> said{e.faces_a, e.faces_b, e.edge_pairs}, of_all{count(a->face_normals), count(b->face_normals), count(a->edges) * count(b->edges)};
  const std::array<Number, 3> of_boxes{c_.dimension, c_.dimension, c_.dimension == 3 ? 9 : 0};
  const bool boxes = std::holds_alternative<Box>(bodies[0].shape.geometry) && std::holds_alternative<Box>(bodies[1].shape.geometry);
  const auto may_be_box = [](const Body& body) { return !std::holds_alternative<PointSet>(body.shape.geometry); };  // a sum of boxes is one
  if (said == of_all || (may_be_box(bodies[0]) && may_be_box(bodies[1]) && said == of_boxes)) return;
  const auto told = [](const std::array<Number, 3>& n) { return std::to_string(n[0]) + " and " + std::to_string(n[1]) + " faces and " + std::to_string(n[2]) + " pairs of edges"; };
  contradiction("SAT is said to have " + told(said) + " to look along; the bodies have " + told(boxes ? of_boxes : of_all) + ".");
}

void RecordCheck::count_section_axes(const recorded::SatBegan& e) {
  if (!may_have_outline(c_.recording)) return;
  const std::optional<DepthOutline> right = outline_of(c_.recording);
  if (!right) return contradiction("SAT begins, but the bodies are neither bodies of revolution about parallel axes, or nearly one line, nor ellipsoids.");
  section_slack_ = right->slack, curved_section_ = right->curved, meeting_unseen_ = right->kind != OutlineKind::parallel_axes;
  if (e.faces_a != right->edges_of_a || e.faces_b != right->edges_of_b || e.edge_pairs != 0)
    contradiction("SAT is said to have " + std::to_string(e.faces_a) + " and " + std::to_string(e.faces_b) + " faces and " + std::to_string(e.edge_pairs) + " pairs of edges to look along; the outline of these bodies has " +
                  std::to_string(right->edges_of_a) + " and " + std::to_string(right->edges_of_b) + " edges that count.");
}

/// A pair of edges of which one has no faces beside it is an axis both ways.
void RecordCheck::judge(const recorded::SatBegan& e) { count_axes(e), methods_.insert(e.kind), axes_ = {e.faces_a, e.faces_b, 2 * Number{e.edge_pairs}}, plane_ = -unknown, outlined_ = unknowable, nearest_projected_.reset(); }
void RecordCheck::judge(const recorded::AxisTested& e) {
  leads_on(e.direction, axis_, "its support");
  if (e.vertex != newest_) contradiction("Vertex " + std::to_string(e.vertex) + " is said to be the farthest along the axis, but the last one asked for is " + std::to_string(newest_) + ".");
  plane_ = std::max(plane_, e.distance);
  bound("The lower", e.lower_bound, plane_);
  outlined_ = e.upper_bound;
  if (!curved_section_ && e.source == AxisSource::outline) return contradiction("An axis is said to be one of an outline with an ellipse, but there is none.");
  if (!curved_section_) bound("The upper", e.upper_bound, unknown);  // an axis knows none
  if (e.source != AxisSource::outline && --axes_[static_cast<std::size_t>(e.source)] < 0) contradiction("More axes of \"" + std::string(word_of(e.source)) + "\" are tested than there are said to be.");
}
void RecordCheck::judge(const recorded::SatEnded& e) {
  if (const std::string off = c_.not_unit(e.normal); !off.empty()) contradiction(off);
  if (e.status != SatStatus::separated && axes_[0] + axes_[1] > 0) contradiction(std::to_string(axes_[0] + axes_[1]) + " faces have not been looked along, and no axis separates.");
  const bool in_vain = e.status == SatStatus::undecided && last_status_ == word_of(EpaStatus::iteration_limit);  // EPA's answer stands
  statuses_.emplace(word_of(e.status));
  if (!in_vain) last_status_ = word_of(e.status);
  const bool known = c_.has_supports || radius_between_;
  // A yes or no ends at the first axis that says enough; of those looked along at once another may be wider.
  const bool wider = c_.recording.scene.scene.query == Query::intersect && e.status == SatStatus::separated && e.distance > plane_;
  if (known && !wider && differ(e.distance, plane_) && differ(e.distance, nearest_projected_.value_or(plane_)))
    contradiction("SAT ends with a distance of " + text_of(e.distance) + ", but the steps before give " + text_of(nearest_projected_.value_or(plane_)) + ".");
  if (!in_vain) lower_ = upper_ = unknowable;
  if (e.status == SatStatus::overlapping && c_.recording.scene.scene.query > Query::distance && c_.recording.settings.penetration != Penetration::none) lower_ = e.distance, upper_ = (std::isfinite(outlined_) ? outlined_ : e.distance) + section_slack_;
  if (e.status == SatStatus::separated && nearest_projected_) lower_ = projected_bounds_.first, upper_ = projected_bounds_.second;
}

/// With p = corner + s edge_a - t edge_b, the ends of both parameters reach as far as the difference of the cores does, along its edges and the axes.
void RecordCheck::judge(const recorded::ClosedFormBegan& e) {
  segments_ = e, methods_.insert(e.kind);
  if (!c_.has_supports || !c_.cores) return;
  std::vector<AnyVector> directions;
  for (int i = 0; i < c_.dimension; ++i) directions.emplace_back(AnyVector::Unit(c_.dimension, i));
  for (const AnyVector* edge : {&e.edge_a, &e.edge_b})
    if (!edge->isZero(0) && edge->allFinite()) directions.push_back(edge->stableNormalized());
  const double lost = c_.digits() * (e.corner.norm() + e.edge_a.norm() + e.edge_b.norm());  // of lengths that cancel
  for (const AnyVector& d : directions)
    for (const double sign : {1.0, -1.0}) {
      const double reach = sign * d.dot(e.corner) + std::max(0.0, sign * d.dot(e.edge_a)) + std::max(0.0, -sign * d.dot(e.edge_b)), right = c_.height(sign * d);
      if (std::abs(reach - right) <= std::max(c_.tolerance, 1e-7 * c_.size) + lost) continue;
      contradiction("The segments' difference reaches " + text_of(reach) + " along " + text_of(AnyVector(sign * d)) + ", but that of the bodies' cores " + text_of(right) + ".");
      return;
    }
}

/// Between the nearest points of two lines is a way across both.
void RecordCheck::judge(const recorded::LinesSolved& e) {
  if (!segments_) return;
  // A place is missing of points, and of both lines where they are parallel.
  const AnyVector &u = segments_->edge_a, &v = segments_->edge_b;
  const bool parallel = !u.isZero(0) && !v.isZero(0) && (u.normalized() - u.normalized().dot(v.normalized()) * v.normalized()).norm() <= std::max(1e-6, std::sqrt(c_.digits()));
  for (const auto& [name, parameter, edge] : {std::tuple("s", e.s, &u), std::tuple("t", e.t, &v)})
    if (!std::isfinite(parameter) && !edge->isZero(0) && !parallel) return contradiction("The line of the edge " + text_of(*edge) + " is not parallel to the other, but \"" + name + "\", where it is nearest to that, is not said.");
  if (!std::isfinite(e.s) && !std::isfinite(e.t)) return;
  AnyVector between = segments_->corner;
  double lost = segments_->corner.norm();  // of lengths that cancel, however far out on a line that is short
  if (std::isfinite(e.s)) between += e.s * segments_->edge_a, lost += std::abs(e.s) * segments_->edge_a.norm();
  if (std::isfinite(e.t)) between -= e.t * segments_->edge_b, lost += std::abs(e.t) * segments_->edge_b.norm();
  for (const auto& [parameter, edge] : {std::pair(e.s, &segments_->edge_a), std::pair(e.t, &segments_->edge_b)})
    if (std::isfinite(parameter) && std::abs(between.dot(*edge)) > (std::max(c_.tolerance, 1e-7 * c_.size) + c_.digits() * lost) * edge->norm())
      contradiction("s = " + text_of(e.s) + " and t = " + text_of(e.t) + " are not where the lines are nearest: the way between is " + text_of(between) + ", not across the edge " + text_of(*edge) + ".");
}

void RecordCheck::judge(const recorded::ClosedFormEnded& e) {
  ++iterations_, statuses_.emplace(word_of(e.status)), last_status_ = word_of(e.status);
  lower_ = e.lower_bound, upper_ = e.upper_bound;
}

/// The point of a body nearest to another is a support of it along the way there.
void RecordCheck::nearest_to(std::size_t body, const AnyVector& point, const AnyVector& from) {
  const AnyVector out = from - point;
  if (!c_.has_supports || !c_.cores || !out.allFinite() || !(out.norm() > c_.tolerance)) return;
  const double beyond = c_.short_of_support(body, out.normalized(), point);
  if (beyond > std::max(c_.tolerance, 1e-7 * c_.size) + (c_.digits() * c_.size + c_.world) * c_.size / out.norm())
    contradiction((body == 0 ? "a = " : "b = ") + text_of(point) + " is not the point of body " + std::to_string(body) + " nearest to " + text_of(from) + ": the body reaches " + text_of(beyond) + " farther that way.");
}
void RecordCheck::judge(const recorded::ProjectionsBegan& e) { projected_from_ = e.point, plane_ = -unknown, methods_.insert(e.kind); }
void RecordCheck::judge(const recorded::PointPredicted& e) { projected_from_ = e.point; }
void RecordCheck::judge(const recorded::PointsProjected& e) {
  if (projected_from_.size() == e.b.size()) nearest_to(1, e.b, projected_from_);
  nearest_to(0, e.a, e.b);
  nearest_projected_ = e.closest.norm() - radius();
  projected_bounds_ = {e.lower_bound, e.upper_bound};
  if (!std::isfinite(e.upper_bound)) contradiction("The upper bound is not said, but two points are.");
  if (!c_.has_supports && !radius_between_) return;
  if (!methods_.contains(recorded::SatBegan::kind)) return bound("The lower", e.lower_bound, plane_ - radius());
  if (!(e.lower_bound >= plane_ - std::max(c_.tolerance, 1e-7 * c_.size))) contradiction("The lower bound is " + bound_text(e.lower_bound) + ", but an axis before leaves " + text_of(plane_) + " between the bodies.");
  bound("The upper", e.upper_bound, *nearest_projected_);
}
void RecordCheck::judge(const recorded::ProjectionsEnded& e) {
  if (c_.has_supports || radius_between_) bound("The lower", e.lower_bound, plane_ - radius());
  if (!std::isfinite(e.upper_bound)) contradiction("The upper bound is not said, but points were projected.");
  statuses_.emplace(word_of(e.status)), last_status_ = word_of(e.status);
  lower_ = e.lower_bound, upper_ = e.upper_bound;
}

/// Two bodies are looked at whatever they do, of more those that move against one another.
void RecordCheck::judge(const recorded::CastBegan& e) {
  const std::vector<Body>& bodies = c_.recording.scene.scene.bodies;
  const auto meets = [&](const Body& a, const Body& b) {
    const auto turns = [](const Body& body) { return body.motion->angular_velocity.size() > 0 && !body.motion->angular_velocity.isZero(0); };
    return bodies.size() == 2 || turns(a) || turns(b) || a.motion->velocity != b.motion->velocity;
  };
  std::vector<Edge> right;
  for (int i = 0; i < static_cast<int>(bodies.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(bodies.size()); ++j)
      if (meets(bodies[static_cast<std::size_t>(i)], bodies[static_cast<std::size_t>(j)])) right.push_back({i, j});
  if (e.pairs != right) contradiction("The cast's pairs are not those of the bodies that move against one another, each once, the lower number first.");
  pairs_ = e.pairs;
}
void RecordCheck::judge(const recorded::CastAdvanced& e) {
  if (!responded_ && !looked_at(pairs_, e.pair)) return contradiction("Bodies " + std::to_string(e.pair[0]) + " and " + std::to_string(e.pair[1]) + " are none of the cast's pairs.");
  const bool ray = c_.recording.settings.name == MethodName::ray_cast;
  Number& before = ray ? ray_iteration_ : cast_iteration_;
  if ((e.iteration != before && (ray || e.iteration != before + 1)) || e.iteration < 1) contradiction("Iteration " + std::to_string(e.iteration) + " of the cast comes after iteration " + std::to_string(before) + ".");
  if (!ray && (e.iteration == before ? e.time != cast_time_ : e.time < cast_time_)) contradiction("Time " + text_of(e.time) + " comes after time " + text_of(cast_time_) + ": a round of the cast has one time, and none is before the last.");
  before = e.iteration, cast_time_ = e.time;
  if (ray) leads_on(e.normal, axis_, "the support before it", 100 * c_.digits());
  else if (e.normal.isZero(0) && e.distance > c_.tolerance) contradiction("The bodies are said to be " + text_of(e.distance) + " apart, along no normal.");
  const bool portal = c_.recording.settings.penetration == Penetration::mpr && e.distance < 0 && !differ(e.distance, lower_);  // a depth by MPR is the most that its bounds allow
  if (!ray && radius_between_ && differ(e.distance, upper_) && !portal) contradiction("The pair is said to be " + text_of(e.distance) + " apart, but the steps before give " + text_of(upper_) + ".");
  const int count = static_cast<int>(c_.recording.scene.scene.bodies.size());
  const bool exist = std::min(e.pair[0], e.pair[1]) >= 0 && std::max(e.pair[0], e.pair[1]) < count;
  if (responded_ || !exist || c_.recording.scene.scene.query != Query::cast) return;
  // Along n the bodies come nearer by (vA - vB) . n, and by no more than |w| times their reach where they turn.
  const std::vector<Body>& bodies = c_.recording.scene.scene.bodies;
  const Body &a = bodies[static_cast<std::size_t>(e.pair[0])], &b = bodies[static_cast<std::size_t>(e.pair[1])];
  const double straight = (a.motion->velocity - b.motion->velocity).dot(e.normal);
  double turning = 0;
  for (const Body* body : {&a, &b})
    if (body->motion->angular_velocity.size() > 0 && !body->motion->angular_velocity.isZero(0)) turning += body->motion->angular_velocity.norm() * reach_of(body->shape, c_.dimension);
  if (std::abs(e.bound - straight) > turning + 1e-6 * (std::abs(straight) + turning) + 100 * c_.digits() * (a.motion->velocity.norm() + b.motion->velocity.norm()))
    contradiction("The bound on how fast they come nearer is " + text_of(e.bound) + ", but along the normal they move at " + text_of(straight) + (turning > 0 ? ", and turn at no more than " + text_of(turning) + "." : "."));
}

void RecordCheck::motion() {
  const Result& r = c_.recording.result;
  if (!ours_ || r.status == "aborted") return;
  const bool simulated = c_.recording.scene.scene.query == Query::simulate;
  if (!r.time || (simulated && !r.energy)) contradiction(std::string("The result has no \"") + (r.time ? "energy" : "time") + "\".");
  const std::string right_status = contact_unknown_ ? "contact_unknown" : "completed";
  if (simulated && r.status != right_status) contradiction("The result's status is \"" + r.status.text() + "\", but a simulation runs to its end, " + (contact_unknown_ ? "though not every contact is known" : "and every contact is known") + ": \"" + right_status + "\".");
  if (const Number right = simulated ? iterations_ : cast_iterations_.value_or(r.iterations); r.iterations != right) contradiction("The result counts " + std::to_string(r.iterations) + " iterations, the steps " + std::to_string(right) + ".");
  if (r.support_calls < supports_) contradiction("The result counts " + std::to_string(r.support_calls) + " support calls, but " + std::to_string(supports_) + " were made.");
}

}  // namespace gjkdbg
