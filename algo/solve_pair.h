// One query on one pair of convex bodies: what runs, and what never does.
//
//   query         GJK ends at                          EPA runs
//   intersect     the first proof                      never
//   distance      the distance, or proof of overlap    never
//   penetration   the distance of the cores            when the cores overlap
//   contact       as penetration, then the contact points (algo/contact.h)
//
// MPR and SAT tell how deep, but not how far: where they find a gap and its length is asked for, GJK measures it. Projections tell how far,
// but not how deep. Where GJK stalls with bounds on both sides of touching and only yes or no is asked for, MPR is asked, which looks from the middle of the difference and
// not from the origin: a portal that rounding leaves no room near the origin may be told from there.
#pragma once

#include "algo/boolean_gjk.h"
#include "algo/box_sat.h"
#include "algo/epa.h"
#include "algo/lent.h"
#include "algo/mpr.h"
#include "algo/outline_depth.h"
#include "algo/polygon_sat.h"
#include "algo/projections.h"
#include "algo/result.h"
#include "algo/run_gjk.h"
#include "algo/sat.h"
#include "algo/warm_start.h"
#include "algo/world_trace.h"

namespace gjkdbg {

template <int D, class S, class Trace, class A = Convex<D, S>, class B = A>
class PairSolver {
  using V = Vector<D, S>;
  using Difference = MinkowskiDifference<D, S, A, B>;

 public:
  /// The working frame's lengths are the world's times `scale`, as in the shapes. Keeps references.
  PairSolver(const A& a, const B& b, const PlacedAxes<D>& pose_a, const PlacedAxes<D>& pose_b, double scale, const Settings& settings, Trace& trace,
             LateFeatures* features_a = nullptr, LateFeatures* features_b = nullptr, WarmStart<D, S>* warm = nullptr)
      : difference_(a, b, pose_a, pose_b, scale),
        frame_(pose_a, a.reference(), scale), settings_(settings), trace_(trace),
        radius_(a.radius() + b.radius()), polytopes_(a.polytope() && b.polytope()),
        features_a_(features_a), features_b_(features_b), warm_(settings.start == Start::previous ? warm : nullptr) {}

  Result run(Query query) {
    Result result;
    result_ = &result;
    decide(query);
    result.support_calls = difference_.support_calls() + more_calls_;
    return result;
  }

 private:
  void decide(Query query) {
    if (settings_.name == MethodName::gjk_boolean) return boolean();
    if (settings_.name == MethodName::mpr && mpr_decides(query)) return;
    if (settings_.name == MethodName::sat && sat_decides(query)) return;
    if (settings_.name == MethodName::projections && projections_decide(query)) return;
    GjkOptions<D, S> options;
    options.goal = query == Query::intersect ? GjkGoal::intersect : query == Query::distance ? GjkGoal::distance : GjkGoal::signed_distance;
    options.tolerance = tolerance_for(query);
    options.max_iterations = settings_.max_iterations;
    options.direction = first_direction();
    options.accelerated = settings_.name == MethodName::gjk_accelerated;
    options.normalised = polytopes_;
    options.acceleration = settings_.acceleration;
    options.stopping = settings_.stopping;
    std::array<SupportPoint<D, S>, D + 1> kept;
    if (warm_) {
      for (int i = 0; i < warm_->size; ++i) kept[i] = difference_.kept(warm_->a[i], warm_->b[i]);
      options.kept = {kept.data(), static_cast<std::size_t>(warm_->size)};
    }
    run_gjk(difference_, settings_.closest_point, options, trace_, gjk_);
    if (warm_) keep_simplex();
    result_->status = gjk_.status;
    result_->iterations += gjk_.iterations;
    if (query == Query::intersect) {
      if (undecided(gjk_, difference_.radius()) && mpr_decides(query)) return;
      result_->intersecting = overlapping();
    } else if (query == Query::distance) {
      distance();
    } else {
      penetration();
    }
  }

  /// Yes or no is proven, not approximated: a coarse tolerance, meant for distances, has no say in it.
  S tolerance_for(Query query) const {
    const S tolerance = static_cast<S>(settings_.tolerance);
    return query == Query::intersect ? std::min(tolerance, GjkOptions<D, S>::decisive) : tolerance;
  }

  /// Points that were there before keep their numbers: they would drift if they were turned there and back.
  void keep_simplex() {
    const WarmStart<D, S> before = *warm_;
    const Simplex<D, S>& simplex = gjk_.simplex;
    warm_->size = simplex.size();
    for (int i = 0; i < warm_->size; ++i) {
      const SupportPoint<D, S>& p = simplex[i];
      const bool old = p.vertex < before.size;
      warm_->a[i] = old ? before.a[p.vertex] : p.a, warm_->b[i] = old ? before.b[p.vertex] : difference_.from_b(p.b);
    }
  }

  V first_direction() const {
    if (settings_.initial_direction) {
      const Vector<D, double> world = *settings_.initial_direction;
      const Vector<D, double> local = frame_.rotation.transpose() * (world / world.cwiseAbs().maxCoeff());
      return local.template cast<S>();
    }
    return is_zero(axis_) ? difference_.towards_b() : axis_;
  }

  void boolean() {
    InflatedDifference<Difference> bodies(difference_);
    const auto found = BooleanGjk<InflatedDifference<Difference>, Trace>(bodies, first_direction(), settings_.max_iterations, trace_).run();
    result_->intersecting = found.intersecting();
    result_->status = found.status;
    result_->iterations = found.iterations;
  }

  bool overlapping() const {
    return gjk_.cores_overlap() || static_cast<double>(gjk_.distance) <= radius_;
  }

  void distance() {
    result_->intersecting = overlapping();
    set_bounds(gjk_.lower_bound, gjk_.upper_bound);
    no_bound_below_zero();
    if (!result_->intersecting) return separated();
    set_common_point(*result_, frame_, gjk_.simplex.point_a(), gjk_.simplex.point_b(), radius_a(), radius_b());
  }

  void penetration() {
    set_bounds(gjk_.lower_bound, gjk_.upper_bound);
    const bool undecided = gjk_.status == GjkStatus::stalled && gjk_.lower_bound <= 0;
    if (!gjk_.cores_overlap() && !undecided) return separated();
    if (settings_.penetration == Penetration::none) return overlap_only(-radius_ + rounding());
    if (settings_.penetration == Penetration::mpr) {
      const MprResult<D, S> found = run_mpr(true);
      if (found.decided && found.overlapping()) return portal_depth(found);
      if (found.decided) return apart_after_all(found);
    }
    const S tolerance = static_cast<S>(settings_.tolerance);
    const auto outline = outline_depth(difference_, tolerance, settings_.max_iterations, trace_);
    if (outline_decides(outline)) return;
    EpaOptions<S> options;
    options.tolerance = tolerance, options.max_iterations = settings_.max_iterations;
    Lent<EpaWorkspace<D, S>> workspace;  // looked up where EPA runs, and only there
    const EpaResult<D, S> found = epa(difference_, gjk_.simplex, options, *workspace, trace_);
    result_->iterations += found.iterations;
    if (found.status == EpaStatus::iteration_limit && outline_decides(depth_by_bends(difference_, tolerance, settings_.max_iterations, outline.has_value(), trace_))) return;
    result_->status = found.status, set_bounds(-found.upper_bound, -found.lower_bound);
    const bool flat = found.face < 0;
    if (flat && gjk_.status == GjkStatus::enclosed) weigh_enclosing(gjk_.simplex);
    witnesses(flat ? gjk_.simplex.point_a() : found.point_a, flat ? gjk_.simplex.point_b() : found.point_b, found.normal, -found.depth);
  }

  /// False: they have no outline that decides.
  bool outline_decides(const std::optional<OutlineDepth<D, S>>& found) {
    if (!found || !sat_answers(found->sat, false)) return false;
    return sat_depth(found->sat, found->points ? *found->points : apart_along(found->sat), found->slack), true;
  }

  /// MPR has a plane between bodies that GJK could not tell apart: GJK's simplex has the nearest points it knew.
  void apart_after_all(const MprResult<D, S>& found) {
    const S cores = difference_.radius() - found.depth, floor = difference_.rounding_floor();
    if (gjk_.status == GjkStatus::enclosed) weigh_enclosing(gjk_.simplex);
    set_bounds(std::max(gjk_.lower_bound, cores - floor), std::max(gjk_.upper_bound, cores + floor));
    witnesses(gjk_.simplex.point_a(), gjk_.simplex.point_b(), found.normal, cores);
  }

  // --- MPR and SAT ------------------------------------------------------------------------------------------------

  MprResult<D, S> run_mpr(bool depth) {
    InflatedDifference<Difference> bodies(difference_);
    MprOptions<D, S> options;
    options.tolerance = static_cast<S>(settings_.tolerance);
    options.max_iterations = settings_.max_iterations;
    options.depth = depth;
    options.interior = difference_.center();
    const MprResult<D, S> found = mpr(bodies, options, trace_);
    result_->status = found.status;
    result_->iterations += found.iterations;
    return found;
  }

  /// False: apart, and the distance is asked for, or not decided.
  bool mpr_decides(Query query) {
    const bool depth = query == Query::penetration || query == Query::contact;
    const MprResult<D, S> found = run_mpr(depth && settings_.penetration == Penetration::mpr);
    if (!found.decided || (!found.overlapping() && query != Query::intersect)) return false;
    result_->intersecting = found.overlapping();
    if (query == Query::intersect) return true;
    if (!depth) {
      const auto [a, b] = on_the_ray(found);
      if ((a - b).norm() <= 8 * difference_.rounding_floor()) overlapping_at(a, b, 2 * difference_.rounding_floor());
      else inside_both(2 * difference_.rounding_floor());  // the ray grazes the portal
      return true;
    }
    if (settings_.penetration == Penetration::epa) return false;  // GJK's simplex is where EPA starts
    if (settings_.penetration == Penetration::none) return overlap_only(0), true;
    portal_depth(found);
    return true;
  }

  /// The origin lies between the inner point v0 and where the ray leaves, p: O = v0 + t (p - v0); with the same weights the points of A and of B coincide.
  std::pair<V, V> on_the_ray(const MprResult<D, S>& found) const {
    const V v0 = difference_.center(), center = difference_.a().center();
    const S length = (found.point_a - found.point_b - v0).norm(), t = length > 0 ? std::min(S(1), v0.norm() / length) : S(0);
    return {center + t * (found.point_a - center), center - v0 + t * (found.point_b - center + v0)};
  }

  /// The points of the portal nearest to the way out are the witnesses where they are that way apart; where the portal is a part of a larger face, or of another
  /// than the normal's, the bodies are moved apart along it. Where their depth is less, no points of both lie the way out apart.
  void portal_depth(const MprResult<D, S>& found) {
    const S cores = S(static_cast<double>(-found.depth) + radius_);
    if (found.off <= 8 * difference_.rounding_floor()) {
      witnesses(found.way_a, found.way_b, found.normal, cores, true);
    } else {
      const GjkResult<D, S> touching = push_apart(found.normal, -cores);
      const V a = touching.simplex.point_a(), b = touching.simplex.point_b() - push_;
      if ((a - b + cores * found.normal).norm() < found.off) witnesses(a, b, found.normal, cores);
      else witnesses(found.way_a, found.way_b, found.normal, cores, true);
    }
    result_->lower_bound = length(-static_cast<double>(found.upper_bound));
    result_->upper_bound = length(-static_cast<double>(found.lower_bound));
  }

  /// False: apart, and the distance is asked for, or the theorem does not hold.
  bool sat_decides(Query query) {
    const auto *box_a = solid_box<D, S>(difference_.a()), *box_b = solid_box<D, S>(difference_.b());
    if (box_a && box_b) return solids_decide(BoxSat<Difference, Trace>(difference_, *box_a, *box_b, trace_), query);
    if constexpr (D == 2) {
      const PolygonOf<S> a(difference_.a()), b(difference_.b());
      if (a.polygon && b.polygon) return solids_decide(PolygonSat<Difference, Trace>(difference_, *a.polygon, *b.polygon, trace_), query);
    }
    Lent<SatWorkspace<D, S>> workspace;
    Sat<Difference, Trace> sat(difference_, features_a_->get(), features_b_->get(), difference_.rotation(), *workspace, trace_);
    if (!sat.spans()) {
      if constexpr (traced<Trace>)
        trace_(Warning<V, Viewed>{"flat-difference", "The difference of the bodies has no volume, or a body next to none: faces and edges alone do not decide. GJK does."});
      return false;
    }
    const bool yes_or_no = query == Query::intersect;
    const SatResult<D, S> found = sat.run();
    if (!sat_answers(found, yes_or_no)) return false;
    if (!yes_or_no) sat_witnesses(found, std::nullopt, query);
    return true;
  }

  template <class SolidSat>
  bool solids_decide(SolidSat sat, Query query) {
    const bool yes_or_no = query == Query::intersect;
    const SatResult<D, S>& found = sat.run(yes_or_no ? difference_.radius() : std::numeric_limits<S>::infinity());
    if (sat_answers(found, yes_or_no)) {
      if (!yes_or_no) sat_witnesses(found, sat.witnesses(), query);
      return true;
    }
    if (sat.gap()) apart_at(*sat.gap(), query);
    return sat.gap().has_value();
  }

  /// False: overlapping, and the depth is asked for, or not decided.
  bool projections_decide(Query query) {
    if constexpr (requires { difference_.a().core(), difference_.b().core(); }) {
      if (!projectable(difference_.a()) || !projectable(difference_.b())) {
        if constexpr (traced<Trace>) trace_(Warning<V, Viewed>{"flat-ellipsoid", "The nearest point of an ellipsoid without thickness has no formula here. GJK decides."});
        return false;
      }
      Projections<Difference, Trace> projections(difference_, tolerance_for(query), settings_.max_iterations, trace_);
      const ProjectionsResult<D, S> found = projections.run(query == Query::intersect ? difference_.radius() : std::numeric_limits<S>::infinity());
      result_->iterations += found.iterations;
      result_->status = found.status;
      if (found.status == ProjectionsStatus::undecided) return false;
      if (found.status == ProjectionsStatus::separated) return apart_at(found.nearest, query), true;
      result_->intersecting = true;
      if (query == Query::distance) overlapping_at(found.nearest.b, found.nearest.b, difference_.rounding_floor());
      return query == Query::intersect || query == Query::distance;
    }
    return false;
  }

  void apart_at(const NearestPoints<D, S>& found, Query query) {
    result_->intersecting = static_cast<double>(found.distance) <= radius_;
    if (query == Query::intersect) return;
    set_bounds(found.lower_bound, found.distance + difference_.rounding_floor());
    if (query == Query::distance) {
      no_bound_below_zero();
      if (result_->intersecting) return set_common_point(*result_, frame_, found.a, found.b, radius_a(), radius_b());
    }
    witnesses(found.a, found.b, found.normal, found.distance);
  }

  /// False: apart, and the distance is asked for, or not decided.
  bool sat_answers(const SatResult<D, S>& found, bool yes_or_no) {
    result_->iterations += found.iterations;
    result_->status = found.status;
    const bool apart = found.status == SatStatus::separated;
    axis_ = found.normal;
    if (found.status == SatStatus::undecided || (apart && !(yes_or_no && -static_cast<double>(found.depth) > radius_))) return false;
    result_->intersecting = !apart;
    return true;
  }

  void sat_witnesses(const SatResult<D, S>& found, const std::optional<SatWitnesses<D, S>>& known, Query query) {
    if (query == Query::distance) return inside_both(std::max(S(0), difference_.rounding_floor() - found.depth));
    if (settings_.penetration == Penetration::none) return overlap_only(static_cast<double>(difference_.rounding_floor()) - radius_ + rounding());
    sat_depth(found, known ? *known : apart_along(found));
  }

  SatWitnesses<D, S> apart_along(const SatResult<D, S>& found) {
    const GjkResult<D, S> touching = push_apart(found.normal, found.depth);
    return {touching.simplex.point_a(), touching.simplex.point_b() - push_};
  }

  /// `slack`: how much less the depth may be than the least that was found.
  void sat_depth(const SatResult<D, S>& found, const SatWitnesses<D, S>& points, S slack = 0) {
    set_bounds(-found.depth - difference_.rounding_floor(), -found.depth + difference_.rounding_floor() + slack);
    witnesses(points.a, points.b, found.normal, -found.depth);
  }

  /// With body 1 moved out along the normal, by the depth and some more, the closest points are the witnesses.
  GjkResult<D, S> push_apart(const V& normal, S depth) {
    const S beyond = difference_.rounding_floor() / (8 * std::numeric_limits<S>::epsilon());
    push_ = normal * (depth + beyond);
    Difference apart = difference_.moved(push_);
    GjkOptions<D, S> options;
    options.direction = V(-normal);
    NoTrace silent;
    GjkResult<D, S> nearest;
    gjk<SignedVolumes<D, S>>(apart, options, silent, nearest);
    more_calls_ = apart.support_calls();
    if (nearest.status == GjkStatus::enclosed) weigh_enclosing(nearest.simplex);
    return nearest;
  }

  /// A point of both bodies, which SAT does not come by: GJK's simplex makes one.
  void inside_both(S no_farther) {
    Difference same = difference_.moved(V::Zero());
    GjkOptions<D, S> options;
    options.goal = GjkGoal::distance;
    axis_ = V::Zero();  // that of the least overlap leads past the origin
    options.direction = first_direction();
    NoTrace silent;
    GjkResult<D, S> nearest;
    gjk<SignedVolumes<D, S>>(same, options, silent, nearest);
    more_calls_ = same.support_calls();
    overlapping_at(nearest.simplex.point_a(), nearest.simplex.point_b(), no_farther);
  }

  /// The answer of a distance query to an overlap, between points of the cores no farther from each other than the radii reach. What rounding
  /// takes for an overlap may be a gap, but no wider one than this.
  void overlapping_at(const V& a, const V& b, S no_farther) {
    result_->intersecting = true;
    result_->lower_bound = 0, result_->upper_bound = length(static_cast<double>(no_farther));
    set_common_point(*result_, frame_, a, b, radius_a(), radius_b());
  }

  void overlap_only(double upper) {
    result_->intersecting = true;
    result_->lower_bound.reset();
    result_->upper_bound = length(upper);
  }

  /// From bounds of the cores' signed distance.
  void set_bounds(S lower, S upper) { gjkdbg::set_bounds(*result_, static_cast<double>(lower), static_cast<double>(upper), radius_a(), radius_b(), frame_.unit); }
  /// The radii are sums, and taking them off rounds once more.
  double rounding() const { return 2 * std::numeric_limits<double>::epsilon() * radius_; }
  void no_bound_below_zero() {
    result_->lower_bound = std::max(0.0, *result_->lower_bound), result_->upper_bound = std::max(0.0, *result_->upper_bound);
  }

  void separated() { witnesses(gjk_.simplex.point_a(), gjk_.simplex.point_b(), -gjk_.v / gjk_.distance, gjk_.distance); }

  /// `inflated`: a and b are of the bodies already.
  void witnesses(const V& a, const V& b, const V& normal, S core_distance, bool inflated = false) {
    const double ra = inflated ? radius_ / 2 : radius_a(), rb = inflated ? radius_ / 2 : radius_b();
    set_witnesses(*result_, frame_, a, b, normal, static_cast<double>(core_distance), ra, rb);
  }

  double radius_a() const { return difference_.a().radius(); }
  double radius_b() const { return difference_.b().radius(); }
  double length(double working) const { return working * frame_.unit + 0.0; }  // no negative zero

  Difference difference_;
  WorkingFrame<D, S> frame_;
  const Settings& settings_;
  Trace& trace_;
  const double radius_;
  const bool polytopes_;
  LateFeatures *features_a_, *features_b_;  ///< of SAT
  WarmStart<D, S>* warm_;
  V push_ = V::Zero();
  V axis_ = V::Zero();  ///< the separating axis found, where GJK goes on
  int more_calls_ = 0;
  GjkResult<D, S> gjk_;
  Result* result_ = nullptr;  ///< during `run`
};

}  // namespace gjkdbg
