// check, what our own recordings say twice: numbers and lists that follow from others. Other programs number and list as they like; what contradicts
// itself in their lists is told, too.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algo/motion.h"
#include "recordings/check_record.h"

namespace gjkdbg {
namespace {

template <class E, class... Others>
constexpr bool is_one_of = (std::is_same_v<E, Others> || ...);

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
  if (!ours_) return c_.inferred ? void() : theirs(event);
  std::visit(
      [this](const auto& e) {
        using E = std::decay_t<decltype(e)>;
        constexpr bool begins = is_one_of<E, recorded::GjkBegan, recorded::MprBegan, recorded::SatBegan, recorded::ProjectionsBegan, recorded::PolytopeSeeded>;
        if constexpr (begins) counted_ = true, iteration_ = std::is_same_v<E, recorded::GjkBegan> ? -1 : 0;
        if constexpr (requires { e.iteration; } && !is_one_of<E, recorded::CastAdvanced, recorded::CastEnded>) {
          const Number right = right_iteration(e);
          if constexpr (std::is_same_v<E, recorded::SupportQueried>) counted_ |= e.phase == Phase::seed;
          if (counted_ && e.iteration != right) contradiction("Iteration " + std::to_string(e.iteration) + " is in the place of iteration " + std::to_string(right) + ".");
          iteration_ = e.iteration;
          if constexpr (requires { e.status; }) iterations_ += e.iteration, counted_ = false, iteration_ = 0;
        }
        judge(e);
      },
      event);
}

/// Of another program: what is kept was there, lists name everything once, and the answer ends as the last phase does.
void RecordCheck::theirs(const Event& event) {
  const auto names_twice = [&](const char* what, const std::vector<int>& list) {
    if (std::set<int>(list.begin(), list.end()).size() != list.size()) contradiction("\"" + std::string(what) + "\" names a vertex twice: " + list_of(list) + ".");
  };
  if (const auto* e = std::get_if<recorded::SimplexReduced>(&event)) {
    names_twice("before", e->before);
    for (const int v : e->region)
      if (!e->before.empty() && !contains(e->before, v)) contradiction("Vertex " + std::to_string(v) + " was kept, but \"before\" does not hold it.");
  }
  if (const auto* e = std::get_if<recorded::PolytopeSeeded>(&event)) names_twice("vertices", e->vertices);
  std::visit(
      [this](const auto& e) {
        if constexpr (requires { e.status; }) last_status_ = word_of(e.status);
      },
      event);
}

/// A support begins the next iteration and two points projected the next round; all else belongs to the one that runs. The supports that complete
/// EPA's first polytope are before its first.
template <class E>
RecordCheck::Number RecordCheck::right_iteration(const E& e) const {
  if constexpr (std::is_same_v<E, recorded::SupportQueried>) return e.phase == Phase::seed ? 0 : e.phase == Phase::projections ? iteration_ : iteration_ + 1;
  else return std::max<Number>(0, iteration_) + (std::is_same_v<E, recorded::PointsProjected> ? 1 : 0);
}

/// Ours looks exactly where the step before leads. Below the normal numbers what the file holds of that is known to no more than the least number there is, each coordinate to half of it.
void RecordCheck::leads_on(const AnyVector& direction, const AnyVector& from, const char* what, double slack) {
  if (from.size() != direction.size() || !from.allFinite() || from.isZero(0)) return;
  const double lost = std::numeric_limits<double>::denorm_min() / c_.unit / from.stableNorm();
  if ((direction.stableNormalized() - from.stableNormalized()).norm() > slack + 2 * lost) contradiction("The direction is " + text_of(direction) + ", but " + what + " leads along " + text_of(from) + ".");
}

void RecordCheck::next_in_line(const char* what, Number number, Number& last) {
  if (number != last + 1) contradiction(what + std::to_string(number) + " comes after number " + std::to_string(last) + ": they are numbered one after the other.");
  last = number;
}

bool RecordCheck::same_points(const std::vector<ContactPoint>& x, const std::vector<ContactPoint>& y) const {
  const double slack = std::max(c_.tolerance, 1e-7 * c_.size);
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [&](const ContactPoint& p, const ContactPoint& q) {
    return (p.point_a - q.point_a).norm() <= slack && (p.point_b - q.point_b).norm() <= slack && std::abs(p.depth - q.depth) <= slack;
  });
}

bool RecordCheck::differ(double said, double right) const {
  return std::isfinite(said) && std::abs(said - right) > std::max(c_.tolerance, 1e-7 * c_.size);
}

/// A bound that is not known is not said; what is known is. `whose`: "The lower", …
void RecordCheck::bound(const char* whose, double said, double right) {
  if (!std::isfinite(said) && std::isfinite(right)) contradiction(std::string(whose) + " bound is not said, but the steps before give " + text_of(right) + ".");
  else if (differ(said, right)) contradiction(std::string(whose) + " bound is " + text_of(said) + ", but the steps before give " + (std::isfinite(right) ? text_of(right) : "none") + ".");
}
void RecordCheck::same_bounds(const char* whose, double lower, double upper) {
  if (!c_.has_supports && !radius_between_) return;
  bound((std::string(whose) + " lower").c_str(), lower, lower_);
  bound((std::string(whose) + " upper").c_str(), upper, upper_);
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
  if (e.phase == Phase::mpr) height_ = std::min(height_, d.dot(e.w));
  if (e.phase == Phase::projections) plane_ = std::max(plane_, -d.dot(e.w));
  if (e.phase == Phase::mpr) newest_w_ = e.w, portal_ = portal_ == Portal::none ? Portal::none : Portal::found;
  if (e.phase == Phase::mpr) leads_on(e.direction, std::exchange(from_interior_, AnyVector()), "the way from MPR's inner point to the origin", 100 * c_.digits());
  if (e.phase == Phase::cast && e.iteration != 0 && e.iteration != ray_iteration_ + 1) contradiction("Iteration " + std::to_string(e.iteration) + " of a ray comes after iteration " + std::to_string(ray_iteration_) + ".");
  if (e.phase == Phase::cast) ray_iteration_ = e.iteration;
  if (e.phase != Phase::gjk) return;
  leads_on(e.direction, std::exchange(towards_, AnyVector()), "the nearest point of the simplex");
  plane_ = std::max(plane_, -d.dot(e.w));
  if (c_.recording.settings.name != MethodName::gjk_boolean) lower_ = plane_ - radius();  // which knows no bounds
  const AnyVector first = std::exchange(first_, AnyVector());
  if (asked_.empty() && first.size() > 0 && first != e.direction) contradiction("The first direction is " + text_of(e.direction) + ", but GJK began with " + text_of(first) + ".");
  asked_.insert(asked_.begin(), e.vertex);
}

/// Newest first; with momentum, a support that brought nothing is not kept: of those asked for since any may be missing, of the simplex none.
void RecordCheck::judge(const recorded::SimplexReduced& e) {
  std::vector<int> right = std::exchange(asked_, {});
  right.insert(right.end(), simplex_.begin(), simplex_.end());
  const bool some = c_.recording.settings.name == MethodName::gjk_accelerated;
  const bool known = some ? std::all_of(e.before.begin(), e.before.end(), [&](int v) { return contains(right, v); }) && std::all_of(simplex_.begin(), simplex_.end(), [&](int v) { return contains(e.before, v); })
                          : e.before == right;
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
  const std::string status(word_of(e.status));
  statuses_.emplace(word_of(e.status)), last_status_ = word_of(e.status);
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
    last_face_ = std::max<Number>(last_face_, f.face);
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
  statuses_.emplace(word_of(e.status)), last_status_ = word_of(e.status);
  lower_ = -height_ - radius();
  if (e.status == EpaStatus::flat || e.status == EpaStatus::separated) lower_ = upper_ = unknowable;
  if (ours_ && e.face < 0 && !chosen_.empty()) contradiction("EPA ended as \"" + std::string(last_status_) + "\" at no face, but faces of its polytope were chosen.");
  if (e.status == EpaStatus::flat && e.face >= 0) contradiction("EPA ended at face " + std::to_string(e.face) + " of a polytope that is flat: it has none.");
  if (e.face < 0 || !faces_.contains(e.face)) return;
  if (!chosen_.contains(e.face)) contradiction("EPA ends at face " + std::to_string(e.face) + ", which was never chosen.");
  else if (const AnyVector& n = faces_[e.face].normal; n.size() != e.normal.size() || (n - e.normal).norm() > 1e-9) contradiction("EPA ends at face " + std::to_string(e.face) + " with the normal " + text_of(e.normal) + ", but the face's is " + text_of(n) + ".");
  faces_.clear(), chosen_.clear();
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
  if (!ours_ && r.status == word_of(GjkStatus::converged) && last_status_ == word_of(GjkStatus::iteration_limit)) contradiction("The result's status is \"" + r.status.text() + "\", but the last phase ended as \"" + std::string(last_status_) + "\".");
  if (!ours_ || statuses_.empty()) return;
  if (const std::string wrong = not_as_asked(); !wrong.empty()) contradiction("The scene asks for \"" + std::string(word_of(c_.recording.scene.scene.query)) + "\", but the result " + wrong + ".");
  if (const std::string wrong = not_by_this_method(); !wrong.empty()) contradiction("The method is \"" + std::string(word_of(c_.recording.settings.name)) + "\", but " + wrong + ".");
  if (!statuses_.contains(r.status)) contradiction("The result's status is \"" + r.status.text() + "\", with which no phase ended.");
  else if (c_.has_supports && r.status != last_status_) contradiction("The result's status is \"" + r.status.text() + "\", but the last phase ended as \"" + std::string(last_status_) + "\".");
  const AnyVector* at[] = {r.witness_a ? &*r.witness_a : nullptr, r.witness_b ? &*r.witness_b : nullptr};
  if (r.signed_distance && r.intersecting != (*r.signed_distance <= 0)) contradiction(std::string("The bodies are called ") + (r.intersecting ? "overlapping" : "apart") + ", at a signed distance of " + text_of(*r.signed_distance) + ".");
  if (r.signed_distance && r.normal && at[0] && at[1]) {
    const double off = AnyVector(*at[1] - *at[0] - *r.signed_distance * *r.normal).stableNorm(), most = std::max(at[0]->stableNorm(), at[1]->stableNorm()) + std::abs(*r.signed_distance);
    if (off > c_.digits() * most + c_.world) contradiction("witness_b - witness_a is off signed_distance * normal by " + text_of(off) + ".");
  }
  if (r.iterations != iterations_) contradiction("The result counts " + std::to_string(r.iterations) + " iterations, the phases " + std::to_string(iterations_) + ".");
  if (c_.recording.scene.scene.query == Query::distance) lower_ = std::max(lower_, 0.0), upper_ = r.intersecting ? unknowable : upper_;
  if (c_.has_supports && r.lower_bound && r.upper_bound) same_bounds("The result's", *r.lower_bound, *r.upper_bound);
  // Which points meet is looked for without a trace, contact points are, and of meshes the parts are put together: only the same again tells.
  const bool more = c_.recording.settings.name == MethodName::sat || c_.recording.settings.name == MethodName::mpr || c_.recording.settings.penetration == Penetration::mpr || meeting_unseen_;
  Number right = more ? std::max<Number>(supports_, r.support_calls) : supports_;
  if (c_.recording.generator == generator_name() && (more || r.contacts || !c_.has_supports)) {
    const Result again = c_.once_more();
    if (more) right = again.support_calls;
    if (r.contacts && again.contacts && again.contacts->size() != r.contacts->size()) contradiction("The result has " + std::to_string(r.contacts->size()) + " contact points; the scene has " + std::to_string(again.contacts->size()) + ".");
    else if (r.contacts && again.contacts && !same_points(*r.contacts, *again.contacts)) contradiction("The contact points are not those of the scene.");
    if (!c_.has_supports && r.lower_bound && again.lower_bound) bound("The result's lower", *r.lower_bound, *again.lower_bound);
    if (!c_.has_supports && r.upper_bound && again.upper_bound) bound("The result's upper", *r.upper_bound, *again.upper_bound);
  }
  if (r.support_calls != right) contradiction("The result counts " + std::to_string(r.support_calls) + " support calls, but " + std::to_string(right) + (right == supports_ ? " were made." : " are made of the scene."));
}

}  // namespace gjkdbg
