// check, what our own recordings say twice: numbers and lists that follow from others. Other programs number and list as they like.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algo/motion.h"
#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

template <class E, class... Others>
constexpr bool is_one_of = (std::is_same_v<E, Others> || ...);

constexpr double unknown = std::numeric_limits<double>::infinity(), unknowable = std::numeric_limits<double>::quiet_NaN();  // from the events

bool looked_at(const std::vector<Edge>& pairs, const Edge& pair) { return std::find(pairs.begin(), pairs.end(), pair) != pairs.end(); }

bool same_numbers(std::vector<int> x, std::vector<int> y) {
  std::sort(x.begin(), x.end()), std::sort(y.begin(), y.end());
  return x == y;
}

/// Between the vertices' difference and any pair's; unset where it depends on the pair. A mesh has none, but for its margin.
std::optional<double> radius_of_all_pairs(const Scene& scene) {
  std::vector<double> radii;
  for (const Body& body : scene.bodies) radii.push_back(WorldSupport(Body{body.name, convex_parts(body.shape).front(), body.pose}, scene.dimension).radius());
  const bool same = std::all_of(radii.begin(), radii.end(), [&](double r) { return r == radii[0]; });
  if (radii.size() < 2 || (radii.size() > 2 && !same)) return std::nullopt;
  return radii[0] + radii[1];
}

}  // namespace

RecordCheck::RecordCheck(CheckContext& context) : c_(context), ours_(!foreign(context.recording)) {
  if (ours_ && !c_.has_supports) radius_between_ = radius_of_all_pairs(c_.recording.scene.scene);
}

void RecordCheck::contradiction(const std::string& message) {
  c_.find("inconsistent", message + " The recording contradicts itself: it was changed, or written wrongly.", Finding::Severity::warning);
}

void RecordCheck::operator()(const Event& event) {
  if (!ours_) return;
  std::visit(
      [this](const auto& e) {
        using E = std::decay_t<decltype(e)>;
        constexpr bool begins = is_one_of<E, recorded::GjkBegan, recorded::MprBegan, recorded::SatBegan, recorded::ProjectionsBegan, recorded::PolytopeSeeded>;
        if constexpr (begins) counted_ = true, iteration_ = std::is_same_v<E, recorded::GjkBegan> ? -1 : 0;
        if constexpr (requires { e.iteration; } && !is_one_of<E, recorded::CastAdvanced, recorded::CastEnded>) {
          const int right = right_iteration(e);
          if constexpr (std::is_same_v<E, recorded::SupportQueried>) counted_ |= e.phase == Phase::seed;
          if (counted_ && e.iteration != right) contradiction("Iteration " + std::to_string(e.iteration) + " is in the place of iteration " + std::to_string(right) + ".");
          iteration_ = e.iteration;
          if constexpr (requires { e.status; }) iterations_ += e.iteration, counted_ = false, iteration_ = 0;
        }
        judge(e);
      },
      event);
}

/// A support begins the next iteration and two points projected the next round; all else belongs to the one that runs. The supports that complete
/// EPA's first polytope are before its first.
template <class E>
int RecordCheck::right_iteration(const E& e) const {
  if constexpr (std::is_same_v<E, recorded::SupportQueried>) return e.phase == Phase::seed ? 0 : e.phase == Phase::projections ? iteration_ : iteration_ + 1;
  else return std::max(0, iteration_) + (std::is_same_v<E, recorded::PointsProjected> ? 1 : 0);
}

/// Ours looks exactly where the step before leads.
void RecordCheck::leads_on(const AnyVector& direction, const AnyVector& from, const char* what, double slack) {
  if (from.size() != direction.size() || !from.allFinite() || from.isZero(0)) return;
  if ((direction.stableNormalized() - from.stableNormalized()).norm() > slack) contradiction("The direction is " + text_of(direction) + ", but " + what + " leads along " + text_of(from) + ".");
}

void RecordCheck::next_in_line(const char* what, int number, int& last) {
  if (number != last + 1) contradiction(what + std::to_string(number) + " comes after number " + std::to_string(last) + ": they are numbered one after the other.");
  last = number;
}

bool RecordCheck::differ(double said, double right) const {
  return std::isfinite(said) && std::abs(said - right) > std::max(c_.tolerance, 1e-7 * c_.size);
}

/// Bounds that were not known are not said, or are infinite.
void RecordCheck::same_bounds(const char* whose, double lower, double upper) {
  if (!c_.has_supports && !radius_between_) return;
  if (differ(lower, lower_)) contradiction(std::string(whose) + " lower bound is " + text_of(lower) + ", but the steps before give " + text_of(lower_) + ".");
  if (differ(upper, upper_)) contradiction(std::string(whose) + " upper bound is " + text_of(upper) + ", but the steps before give " + text_of(upper_) + ".");
}

void RecordCheck::judge(const recorded::GjkBegan& e) {
  simplex_.clear(), asked_.clear(), first_ = e.direction, towards_ = AnyVector();
  plane_ = lower_ = -unknown, upper_ = unknown;
}
/// Where a simplex was kept, its nearest point leads on.
void RecordCheck::judge(const recorded::VertexKept& e) {
  next_in_line("Vertex ", e.vertex, newest_);
  first_ = AnyVector(), asked_.insert(asked_.begin(), e.vertex);
}
void RecordCheck::judge(const recorded::SupportQueried& e) {
  ++supports_;
  next_in_line("Vertex ", e.vertex, newest_);
  const AnyVector d = e.direction.stableNormalized();
  axis_ = e.direction;
  if (e.phase == Phase::epa) height_ = std::min(height_, d.dot(e.w)), leads_on(e.direction, chosen_normal_, "the face chosen");
  if (e.phase == Phase::mpr) leads_on(e.direction, std::exchange(from_interior_, AnyVector()), "the way from MPR's inner point to the origin", 100 * c_.digits());
  if (e.phase == Phase::cast && e.iteration != 0 && e.iteration != ray_iteration_ + 1) contradiction("Iteration " + std::to_string(e.iteration) + " of a ray comes after iteration " + std::to_string(ray_iteration_) + ".");
  if (e.phase == Phase::cast) ray_iteration_ = e.iteration;
  if (e.phase != Phase::gjk) return;
  leads_on(e.direction, std::exchange(towards_, AnyVector()), "the nearest point of the simplex");
  plane_ = std::max(plane_, -d.dot(e.w)), lower_ = plane_ - radius();
  const AnyVector first = std::exchange(first_, AnyVector());
  if (asked_.empty() && first.size() > 0 && first != e.direction) contradiction("The first direction is " + text_of(e.direction) + ", but GJK began with " + text_of(first) + ".");
  asked_.insert(asked_.begin(), e.vertex);
}

/// Newest first; with momentum, a support that brought nothing is not kept.
void RecordCheck::judge(const recorded::SimplexReduced& e) {
  std::vector<int> right = std::exchange(asked_, {});
  right.insert(right.end(), simplex_.begin(), simplex_.end());
  const bool some = c_.recording.settings.name == MethodName::gjk_accelerated;
  const bool known = some ? std::all_of(e.before.begin(), e.before.end(), [&](int v) { return contains(right, v); }) : e.before == right;
  if (!known || std::set<int>(e.before.begin(), e.before.end()).size() != e.before.size())
    contradiction("\"before\" is " + list_of(e.before) + ", but the vertices kept and those asked for since are " + list_of(right) + ".");
  for (const int v : e.region)
    if (!contains(e.before, v)) contradiction("Vertex " + std::to_string(v) + " was kept, but \"before\" does not hold it.");
  if (e.closest.size() > 0 && e.barycentric.size() != e.region.size()) contradiction("There are " + std::to_string(e.barycentric.size()) + " weights for " + std::to_string(e.region.size()) + " vertices.");
  simplex_ = e.region;
  if (e.closest.size() > 0) upper_ = e.closest.norm() - radius();
  if (!some && e.closest.size() > 0) towards_ = -e.closest;
  same_bounds("The", e.lower_bound, e.upper_bound);
}

/// Whether a run may end so: with a simplex that has a volume, or without, at its limit, and with these bounds.
void RecordCheck::judge(const recorded::GjkEnded& e) {
  const std::string status(gjk_status_names[static_cast<std::size_t>(e.status)]);
  statuses_.insert(status), last_status_ = gjk_status_names[static_cast<std::size_t>(e.status)];
  const bool whole = static_cast<int>(simplex_.size()) == c_.dimension + 1;
  const bool apart = e.status == GjkStatus::converged || e.status == GjkStatus::separated || e.status == GjkStatus::stalled;
  if ((e.status == GjkStatus::enclosed && !whole) || (apart && whole)) contradiction("GJK ended as \"" + status + "\" with the simplex " + list_of(simplex_) + (whole ? ", which encloses the origin." : ", which encloses nothing."));
  if (e.status == GjkStatus::iteration_limit && e.iteration < c_.recording.settings.max_iterations)
    contradiction("GJK ended at its limit of " + std::to_string(c_.recording.settings.max_iterations) + " iterations, after " + std::to_string(e.iteration) + ".");
  if (e.status == GjkStatus::within_radius && e.upper_bound > c_.tolerance) contradiction("GJK ended with the cores nearer than the radii, but the upper bound is " + text_of(e.upper_bound) + ".");
  const bool never = e.status == GjkStatus::aborted || (e.status == GjkStatus::rule_met && c_.recording.settings.stopping == Stopping::bounds) || (e.status == GjkStatus::within_radius && radius() == 0);
  if (ours_ && never) contradiction("GJK ended as \"" + status + "\", as it cannot in this scene by this method.");
  same_bounds("GJK's", e.lower_bound, e.upper_bound);
}

/// As many vertices as dimensions, in 3D counter-clockwise seen from outside, where they are not so nearly in a line that rounding has a say in it.
void RecordCheck::add(const std::vector<recorded::Face>& faces, bool in_line) {
  for (const recorded::Face& f : faces) {
    if (in_line) next_in_line("Face ", f.face, last_face_);
    last_face_ = std::max(last_face_, f.face);
    faces_[f.face] = f, standing_.insert(f.face);
    const std::string name = "Face " + std::to_string(f.face) + ", " + list_of(f.vertices) + ", ";
    if (static_cast<int>(f.vertices.size()) != c_.dimension) contradiction(name + "has " + std::to_string(f.vertices.size()) + " vertices instead of " + std::to_string(c_.dimension) + ".");
    if (c_.dimension != 3 || f.vertices.size() != 3) continue;
    std::array<Eigen::Vector3d, 3> w;
    for (std::size_t i = 0; i < 3; ++i) {
      const AnyVector* point = c_.vertex(f.vertices[i]);
      if (!point) return;
      w[i] = *point;
    }
    const Eigen::Vector3d edge = w[1] - w[0], other = w[2] - w[0], area = edge.cross(other), normal = f.normal;
    const double uncertain = 100 * c_.digits() * c_.size * std::max(edge.norm(), other.norm());
    if (area.norm() > uncertain && area.dot(normal) < -0.5 * area.norm() * normal.norm()) contradiction(name + "is listed clockwise, seen from where its normal points.");
  }
}

void RecordCheck::judge(const recorded::PolytopeSeeded& e) {
  standing_.clear(), chosen_.clear(), height_ = unknown;
  add(e.faces, false);  // some may be gone, from the search for a polytope that holds the origin
  std::set<int> used;
  for (const recorded::Face& f : e.faces) used.insert(f.vertices.begin(), f.vertices.end());
  if (!same_numbers(e.vertices, {used.begin(), used.end()})) contradiction("\"vertices\" is " + list_of(e.vertices) + ", but the faces have " + list_of({used.begin(), used.end()}) + ".");
}

/// Of the depth it is the lower bound.
void RecordCheck::judge(const recorded::FaceChosen& e) { chosen_.insert(e.face), upper_ = -e.distance - radius(), chosen_normal_ = e.normal; }

/// The new vertex is the one asked for last. The horizon is a loop, each edge as a removed face has it, and a new face stands on each.
void RecordCheck::judge(const recorded::PolytopeGrown& e) {
  if (e.vertex != newest_) contradiction("Vertex " + std::to_string(e.vertex) + " is said to join, but the last one asked for is " + std::to_string(newest_) + ".");
  for (const recorded::Face& f : e.added)
    if (!contains(f.vertices, e.vertex)) contradiction("The new face " + std::to_string(f.face) + ", " + list_of(f.vertices) + ", does not have the new vertex, " + std::to_string(e.vertex) + ".");
  if (const std::size_t right = c_.dimension == 3 ? e.added.size() : c_.dimension == 2 ? 1 : 0; e.horizon.size() != right)
    contradiction("The horizon has " + std::to_string(e.horizon.size()) + " edges; expected are " + std::to_string(right) + (c_.dimension == 3 ? ", one for each face added." : "."));
  for (std::size_t i = 0; i < e.horizon.size() && c_.dimension == 3; ++i) {
    const auto [from, to] = e.horizon[i];
    const bool loop = e.horizon[(i + 1) % e.horizon.size()][0] == to;
    const bool of_removed = std::any_of(e.removed.begin(), e.removed.end(), [&, from = from, to = to](int number) {
      const std::vector<int>& v = faces_[number].vertices;
      return v.size() == 3 && ((v[0] == from && v[1] == to) || (v[1] == from && v[2] == to) || (v[2] == from && v[0] == to));
    });
    if (!loop || !of_removed)
      contradiction("The edge from " + std::to_string(from) + " to " + std::to_string(to) + " of the horizon " + (loop ? "is of no face removed, this way round." : "is not followed by one that starts where it ends."));
  }
  for (const int number : e.removed) standing_.erase(number);
  add(e.added, true);
  upper_ = -unknown, lower_ = -height_ - radius();
  for (const int number : standing_) upper_ = std::max(upper_, -faces_[number].distance - radius());
  same_bounds("Minus the polytope's", -e.upper_bound, -e.lower_bound);
}

/// A face once chosen: the best one, which a later step may have removed. (What shows the bodies apart before there is a polytope to report is none of them.)
void RecordCheck::judge(const recorded::EpaEnded& e) {
  statuses_.emplace(epa_status_names[static_cast<std::size_t>(e.status)]), last_status_ = epa_status_names[static_cast<std::size_t>(e.status)];
  lower_ = -height_ - radius();
  if (e.status == EpaStatus::flat || e.status == EpaStatus::separated) lower_ = upper_ = unknowable;
  if (e.status == EpaStatus::flat && e.face >= 0) contradiction("EPA ended at face " + std::to_string(e.face) + " of a polytope that is flat: it has none.");
  if (e.face < 0 || !faces_.contains(e.face)) return;
  if (!chosen_.contains(e.face)) contradiction("EPA ends at face " + std::to_string(e.face) + ", which was never chosen.");
  else if (const AnyVector& n = faces_[e.face].normal; n.size() != e.normal.size() || (n - e.normal).norm() > 1e-9) contradiction("EPA ends at face " + std::to_string(e.face) + " with the normal " + text_of(e.normal) + ", but the face's is " + text_of(n) + ".");
  faces_.clear(), chosen_.clear();
}

void RecordCheck::judge(const recorded::PortalFound& e) {
  if (static_cast<int>(e.vertices.size()) != c_.dimension) contradiction("The portal " + list_of(e.vertices) + " has " + std::to_string(e.vertices.size()) + " vertices instead of " + std::to_string(c_.dimension) + ".");
}
void RecordCheck::judge(const recorded::MprEnded& e) {
  statuses_.emplace(mpr_status_names[static_cast<std::size_t>(e.status)]), last_status_ = mpr_status_names[static_cast<std::size_t>(e.status)];
  const double length = e.normal.norm();
  if (length > 0 && std::abs(length - 1) > 1e-4) contradiction("The normal " + text_of(e.normal) + " has length " + text_of(length) + " instead of 1.");
  const bool apart = e.status == MprStatus::separated;
  if (e.status != MprStatus::flat && (apart ? e.depth > c_.tolerance : e.depth < -c_.tolerance)) contradiction("MPR ended as \"" + std::string(last_status_) + "\", with a depth of " + text_of(e.depth) + ".");
  lower_ = upper_ = unknowable;
}

/// A pair of edges of which one has no faces beside it is an axis both ways.
void RecordCheck::judge(const recorded::SatBegan& e) { axes_ = {e.faces_a, e.faces_b, 2 * e.edge_pairs}, plane_ = -unknown, nearest_projected_.reset(); }
void RecordCheck::judge(const recorded::AxisTested& e) {
  leads_on(e.direction, axis_, "its support");
  if (e.vertex != newest_) contradiction("Vertex " + std::to_string(e.vertex) + " is said to be the farthest along the axis, but the last one asked for is " + std::to_string(newest_) + ".");
  plane_ = std::max(plane_, e.distance);
  if (differ(e.lower_bound, plane_)) contradiction("The lower bound is " + text_of(e.lower_bound) + ", but the widest gap so far is " + text_of(plane_) + ".");
  if (--axes_[static_cast<std::size_t>(e.source)] < 0) contradiction("More axes of \"" + std::string(axis_source_names[static_cast<std::size_t>(e.source)]) + "\" are tested than there are said to be.");
}
void RecordCheck::judge(const recorded::SatEnded& e) {
  if (e.status != SatStatus::separated && axes_[0] + axes_[1] > 0) contradiction(std::to_string(axes_[0] + axes_[1]) + " faces have not been looked along, and no axis separates.");
  statuses_.emplace(sat_status_names[static_cast<std::size_t>(e.status)]), last_status_ = sat_status_names[static_cast<std::size_t>(e.status)];
  const bool known = c_.has_supports || radius_between_;
  if (known && differ(e.distance, plane_) && differ(e.distance, nearest_projected_.value_or(plane_)))
    contradiction("SAT ends with a distance of " + text_of(e.distance) + ", but the steps before give " + text_of(nearest_projected_.value_or(plane_)) + ".");
  lower_ = upper_ = unknowable;
}

/// With p = corner + s edge_a - t edge_b, the ends of both parameters reach as far as the difference of the cores does, along its edges and the axes.
void RecordCheck::judge(const recorded::ClosedFormBegan& e) {
  segments_ = e;
  if (!c_.has_supports || !c_.cores) return;
  std::vector<AnyVector> directions;
  for (int i = 0; i < c_.dimension; ++i) directions.emplace_back(AnyVector::Unit(c_.dimension, i));
  for (const AnyVector* edge : {&e.edge_a, &e.edge_b})
    if (!edge->isZero(0) && edge->allFinite()) directions.push_back(edge->stableNormalized());
  for (const AnyVector& d : directions)
    for (const double sign : {1.0, -1.0}) {
      const double reach = sign * d.dot(e.corner) + std::max(0.0, sign * d.dot(e.edge_a)) + std::max(0.0, -sign * d.dot(e.edge_b)), right = c_.height(sign * d);
      if (std::abs(reach - right) <= std::max(c_.tolerance, 1e-7 * c_.size)) continue;
      contradiction("The segments' difference reaches " + text_of(reach) + " along " + text_of(AnyVector(sign * d)) + ", but that of the bodies' cores " + text_of(right) + ".");
      return;
    }
}

/// Between the nearest points of two lines is a way across both.
void RecordCheck::judge(const recorded::LinesSolved& e) {
  if (!segments_ || (!std::isfinite(e.s) && !std::isfinite(e.t))) return;
  AnyVector between = segments_->corner;
  if (std::isfinite(e.s)) between += e.s * segments_->edge_a;
  if (std::isfinite(e.t)) between -= e.t * segments_->edge_b;
  for (const auto& [parameter, edge] : {std::pair(e.s, &segments_->edge_a), std::pair(e.t, &segments_->edge_b)})
    if (std::isfinite(parameter) && std::abs(between.dot(*edge)) > std::max(c_.tolerance, 1e-7 * c_.size) * edge->norm())
      contradiction("s = " + text_of(e.s) + " and t = " + text_of(e.t) + " are not where the lines are nearest: the way between is " + text_of(between) + ", not across the edge " + text_of(*edge) + ".");
}

void RecordCheck::judge(const recorded::ClosedFormEnded& e) {
  ++iterations_, statuses_.emplace(closed_form_status_names[static_cast<std::size_t>(e.status)]), last_status_ = closed_form_status_names[static_cast<std::size_t>(e.status)];
  lower_ = e.lower_bound, upper_ = e.upper_bound;
}

/// The point of a body nearest to another is a support of it along the way there.
void RecordCheck::nearest_to(std::size_t body, const AnyVector& point, const AnyVector& from) {
  const AnyVector out = from - point;
  if (!c_.has_supports || !c_.cores || !out.allFinite() || !(out.norm() > c_.tolerance)) return;
  const double beyond = c_.short_of_support(body, out.normalized(), point);
  if (beyond > std::max(c_.tolerance, 1e-7 * c_.size) + c_.digits() * c_.size * c_.size / out.norm())
    contradiction((body == 0 ? "a = " : "b = ") + text_of(point) + " is not the point of body " + std::to_string(body) + " nearest to " + text_of(from) + ": the body reaches " + text_of(beyond) + " farther that way.");
}
void RecordCheck::judge(const recorded::ProjectionsBegan& e) { projected_from_ = e.point; }
void RecordCheck::judge(const recorded::PointPredicted& e) { projected_from_ = e.point; }
void RecordCheck::judge(const recorded::PointsProjected& e) {
  if (projected_from_.size() == e.b.size()) nearest_to(1, e.b, projected_from_);
  nearest_to(0, e.a, e.b);
  nearest_projected_ = e.closest.norm() - radius();
}
void RecordCheck::judge(const recorded::ProjectionsEnded& e) {
  statuses_.emplace(projections_status_names[static_cast<std::size_t>(e.status)]), last_status_ = projections_status_names[static_cast<std::size_t>(e.status)];
  lower_ = e.lower_bound, upper_ = e.upper_bound;
}

/// Two bodies are looked at whatever they do, of more those that move against one another; after a response these may be others.
void RecordCheck::judge(const recorded::CastBegan& e) {
  const std::vector<Body>& bodies = c_.recording.scene.scene.bodies;
  const auto meets = [&](const Body& a, const Body& b) {
    const auto turns = [](const Body& body) { return body.motion->angular_velocity.size() > 0 && !body.motion->angular_velocity.isZero(0); };
    return bodies.size() == 2 || turns(a) || turns(b) || a.motion->velocity != b.motion->velocity;
  };
  std::vector<Edge> right;
  for (int i = 0; i < static_cast<int>(bodies.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(bodies.size()); ++j)
      if (!pairs_.empty() ? looked_at(e.pairs, {i, j}) : meets(bodies[static_cast<std::size_t>(i)], bodies[static_cast<std::size_t>(j)])) right.push_back({i, j});
  if (e.pairs != right) contradiction("The cast's pairs are not those of the bodies that move against one another, each once, the lower number first.");
  pairs_ = e.pairs;
}
void RecordCheck::judge(const recorded::CastAdvanced& e) {
  if (!looked_at(pairs_, e.pair)) return contradiction("Bodies " + std::to_string(e.pair[0]) + " and " + std::to_string(e.pair[1]) + " are none of the cast's pairs.");
  const bool ray = c_.recording.settings.name == MethodName::ray_cast;
  int& before = ray ? ray_iteration_ : cast_iteration_;
  if (e.iteration != before && (ray || e.iteration != before + 1)) contradiction("Iteration " + std::to_string(e.iteration) + " of the cast comes after iteration " + std::to_string(before) + ".");
  if (!ray && (e.iteration == before ? e.time != cast_time_ : e.time < cast_time_)) contradiction("Time " + text_of(e.time) + " comes after time " + text_of(cast_time_) + ": a round of the cast has one time, and none is before the last.");
  before = e.iteration, cast_time_ = e.time;
  if (!ray && radius_between_ && differ(e.distance, upper_)) contradiction("The pair is said to be " + text_of(e.distance) + " apart, but the steps before give " + text_of(upper_) + ".");
  const int count = static_cast<int>(c_.recording.scene.scene.bodies.size());
  const bool exist = std::min(e.pair[0], e.pair[1]) >= 0 && std::max(e.pair[0], e.pair[1]) < count;
  if (responded_ || !exist || c_.recording.scene.scene.query != Query::cast) return;
  // Along n the bodies come nearer by (vA - vB) . n, and by no more than |w| times their reach where they turn.
  const std::vector<Body>& bodies = c_.recording.scene.scene.bodies;
  const Body &a = bodies[static_cast<std::size_t>(e.pair[0])], &b = bodies[static_cast<std::size_t>(e.pair[1])];
  const double straight = (a.motion->velocity - b.motion->velocity).dot(e.normal);
  double turning = 0;
  for (const Body* body : {&a, &b})
    if (body->motion->angular_velocity.size() > 0) turning += body->motion->angular_velocity.norm() * reach_of(body->shape, c_.dimension);
  if (std::abs(e.bound - straight) > turning + 1e-6 * (std::abs(straight) + turning) + 100 * c_.digits() * (a.motion->velocity.norm() + b.motion->velocity.norm()))
    contradiction("The bound on how fast they come nearer is " + text_of(e.bound) + ", but along the normal they move at " + text_of(straight) + (turning > 0 ? ", and turn at no more than " + text_of(turning) + "." : "."));
}

void RecordCheck::motion() {
  const Result& r = c_.recording.result;
  if (!ours_ || r.status == "aborted") return;
  const bool simulated = c_.recording.scene.scene.query == Query::simulate;
  if (simulated && r.status != "completed") contradiction("The result's status is \"" + r.status + "\", but a simulation runs to its end: \"completed\".");
  if (const int right = simulated ? iterations_ : cast_iterations_.value_or(r.iterations); r.iterations != right) contradiction("The result counts " + std::to_string(r.iterations) + " iterations, the steps " + std::to_string(right) + ".");
  if (r.support_calls < supports_) contradiction("The result counts " + std::to_string(r.support_calls) + " support calls, but " + std::to_string(supports_) + " were made.");
}

/// What is missing of what was asked for, or there without having been asked for.
std::string RecordCheck::not_as_asked() const {
  const Result& r = c_.recording.result;
  const Query query = c_.recording.scene.scene.query;
  if (r.time || r.touching_at || r.pair || r.bodies || r.energy) return "holds what only motions have";
  if (query == Query::intersect) return r.signed_distance || r.normal || r.witness_a || r.witness_b || r.contacts ? "holds more than yes or no" : "";
  if (r.contacts.has_value() != (query == Query::contact) && r.signed_distance) return r.contacts ? "holds contact points" : "has no contact points";
  if (!r.signed_distance) return r.intersecting && c_.recording.settings.penetration == Penetration::none ? "" : "has no signed_distance";
  if (!r.witness_a || !r.witness_b) return "has not both witness points";
  if (!r.lower_bound || !r.upper_bound) return "has not both bounds";
  return r.normal || (query == Query::distance && r.intersecting) ? "" : "has no normal";
}

/// The answer's counts and its status are those of the phases. (A common point is looked for without a trace.)
void RecordCheck::result() {
  const Result& r = c_.recording.result;
  if (!ours_ || statuses_.empty()) return;
  if (const std::string wrong = not_as_asked(); !wrong.empty()) contradiction("The scene asks for \"" + std::string(query_names[static_cast<std::size_t>(c_.recording.scene.scene.query)]) + "\", but the result " + wrong + ".");
  if (!statuses_.contains(r.status)) contradiction("The result's status is \"" + r.status + "\", with which no phase ended.");
  else if (c_.has_supports && r.status != last_status_) contradiction("The result's status is \"" + r.status + "\", but the last phase ended as \"" + std::string(last_status_) + "\".");
  const AnyVector* at[] = {r.witness_a ? &*r.witness_a : nullptr, r.witness_b ? &*r.witness_b : nullptr};
  if (r.signed_distance && r.intersecting != (*r.signed_distance <= 0)) contradiction(std::string("The bodies are called ") + (r.intersecting ? "overlapping" : "apart") + ", at a signed distance of " + text_of(*r.signed_distance) + ".");
  if (r.signed_distance && r.normal && at[0] && at[1]) {
    const double off = (*at[1] - *at[0] - *r.signed_distance * *r.normal).norm(), most = std::max(at[0]->norm(), at[1]->norm()) + std::abs(*r.signed_distance);
    if (off > c_.digits() * most) contradiction("witness_b - witness_a is off signed_distance * normal by " + text_of(off) + ".");
  }
  if (r.iterations != iterations_) contradiction("The result counts " + std::to_string(r.iterations) + " iterations, the phases " + std::to_string(iterations_) + ".");
  if (c_.recording.scene.scene.query == Query::distance) lower_ = std::max(lower_, 0.0), upper_ = r.intersecting ? unknowable : upper_;
  if (c_.has_supports && r.lower_bound && r.upper_bound) same_bounds("The result's", *r.lower_bound, *r.upper_bound);
  const bool more = c_.recording.settings.name == MethodName::sat || c_.recording.settings.name == MethodName::mpr || c_.recording.settings.penetration == Penetration::mpr;  // to find which points meet, without a trace
  if (r.support_calls < supports_ || (r.support_calls > supports_ && !more)) contradiction("The result counts " + std::to_string(r.support_calls) + " support calls, but " + std::to_string(supports_) + " were made.");
}

}  // namespace gjkdbg
