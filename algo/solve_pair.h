// One query on one pair of convex bodies: what runs, and what never does.
//
//   query         GJK ends at                          EPA runs
//   intersect     the first proof                      never
//   distance      the distance, or proof of overlap    never
//   penetration   the distance of the cores            when the cores overlap
//   contact       as penetration, then the contact points (algo/contact.h)
#pragma once

#include "algo/boolean_gjk.h"
#include "algo/epa.h"
#include "algo/gjk.h"
#include "algo/johnson.h"
#include "algo/result.h"
#include "algo/voronoi.h"
#include "algo/world_trace.h"

namespace gjkdbg {

/// Storage for repeated queries of one dimension and scalar.
template <int D, class S>
struct Workspace {
  EpaWorkspace<D, S> epa;
};

template <int D, class S, class Trace, class A = Convex<D, S>, class B = A>
class PairSolver {
  using V = Vector<D, S>;
  using Difference = MinkowskiDifference<D, S, A, B>;

 public:
  /// The working frame's lengths are the world's times `scale`, as in the shapes. Keeps references.
  PairSolver(const A& a, const B& b, const Pose& pose_a, const Pose& pose_b, double scale, const Settings& settings,
             Workspace<D, S>& workspace, Trace& trace)
      : difference_(a, b, relative_pose<D, S>(pose_a, a.reference(), pose_b, b.reference(), scale)),
        frame_(pose_a, a.reference(), scale), settings_(settings), workspace_(workspace), trace_(trace),
        radius_(static_cast<double>(difference_.radius())), polytopes_(a.polytope() && b.polytope()) {}

  Result run(Query query) {
    if (settings_.name == MethodName::gjk_boolean) return boolean();
    GjkOptions<D, S> options;
    options.goal = query == Query::intersect  ? GjkGoal::intersect
                   : query == Query::distance ? GjkGoal::distance
                                              : GjkGoal::signed_distance;
    options.tolerance = static_cast<S>(settings_.tolerance);
    options.max_iterations = settings_.max_iterations;
    options.direction = first_direction();
    options.accelerated = settings_.name == MethodName::gjk_accelerated;
    options.normalised = polytopes_;
    gjk_ = run_gjk(options);
    result_.status = gjk_status_names[static_cast<std::size_t>(gjk_.status)];
    result_.iterations = gjk_.iterations;
    if (query == Query::intersect) {
      result_.intersecting = overlapping();
    } else if (query == Query::distance) {
      distance();
    } else {
      penetration();
    }
    result_.support_calls = difference_.support_calls();
    return result_;
  }

 private:
  GjkResult<D, S> run_gjk(const GjkOptions<D, S>& options) {
    switch (settings_.closest_point) {
      case ClosestPoint::johnson: return gjk<Johnson<D, S>>(difference_, options, trace_);
      case ClosestPoint::voronoi: return gjk<VoronoiRegions<D, S>>(difference_, options, trace_);
      default: return gjk<SignedVolumes<D, S>>(difference_, options, trace_);
    }
  }

  V first_direction() const {
    if (settings_.initial_direction) {
      const Vector<D, double> world = *settings_.initial_direction;
      const Vector<D, double> local = frame_.rotation.transpose() * (world / world.cwiseAbs().maxCoeff());
      return local.template cast<S>();
    }
    return difference_.position().isZero(0) ? V(V::Unit(0)) : difference_.position();
  }

  Result boolean() {
    InflatedDifference<Difference> bodies(difference_);
    const auto found = BooleanGjk<InflatedDifference<Difference>, Trace>(bodies, first_direction(), settings_.max_iterations, trace_).run();
    result_.intersecting = found.intersecting();
    result_.status = gjk_status_names[static_cast<std::size_t>(found.status)];
    result_.iterations = found.iterations;
    result_.support_calls = difference_.support_calls();
    return result_;
  }

  bool overlapping() const {
    return gjk_.cores_overlap() || static_cast<double>(gjk_.distance) <= radius_;
  }

  void distance() {
    result_.intersecting = overlapping();
    result_.lower_bound = std::max(0.0, length(gjk_.lower_bound - radius_));
    result_.upper_bound = std::max(0.0, length(gjk_.upper_bound - radius_));
    if (!result_.intersecting) return separated();
    result_.signed_distance = 0;
    const V a = gjk_.simplex.point_a(), b = gjk_.simplex.point_b();
    const S share = difference_.radius() > 0 ? difference_.radius_a() / difference_.radius() : S(0.5);
    result_.witness_a = frame_.point(a + share * (b - a));
    result_.witness_b = result_.witness_a;
  }

  void penetration() {
    set_bounds(gjk_.lower_bound, gjk_.upper_bound);
    const bool undecided = gjk_.status == GjkStatus::stalled && gjk_.lower_bound <= 0;
    if (!gjk_.cores_overlap() && !undecided) return separated();
    if (settings_.penetration == Penetration::none) return overlap_only();
    EpaOptions<S> options;
    options.tolerance = static_cast<S>(settings_.tolerance);
    options.max_iterations = settings_.max_iterations;
    const EpaResult<D, S> found = epa(difference_, gjk_.simplex, options, workspace_.epa, trace_);
    result_.status = epa_status_names[static_cast<std::size_t>(found.status)];
    result_.iterations += found.iterations;
    set_bounds(-found.upper_bound, -found.lower_bound);
    const bool flat = found.face < 0;
    witnesses(flat ? gjk_.simplex.point_a() : found.point_a, flat ? gjk_.simplex.point_b() : found.point_b, found.normal, -found.depth);
  }

  void overlap_only() {
    result_.intersecting = true;
    result_.lower_bound.reset();
    result_.upper_bound = length(-radius_);
  }

  /// Bounds of the cores' signed distance.
  void set_bounds(S lower, S upper) {
    result_.lower_bound = length(static_cast<double>(lower) - radius_);
    result_.upper_bound = length(static_cast<double>(upper) - radius_);
  }

  void separated() { witnesses(gjk_.simplex.point_a(), gjk_.simplex.point_b(), -gjk_.v / gjk_.distance, gjk_.distance); }

  /// From core points a, b (b - a along the normal, up to rounding) and the cores' signed distance to those of the bodies.
  /// Both are set from their middle, so that b - a = signed distance * normal holds to the last bit or two.
  void witnesses(const V& a, const V& b, const V& normal, S core_distance) {
    const double distance = static_cast<double>(core_distance) - radius_;
    const Vector<D, double> n = frame_.direction(normal), middle = frame_.point(V((a + b) / 2));
    const double ra = static_cast<double>(difference_.radius_a()), rb = static_cast<double>(difference_.radius_b());
    result_.signed_distance = length(distance);
    result_.intersecting = distance <= 0;
    result_.normal = n;
    result_.witness_a = middle - n * length(static_cast<double>(core_distance) / 2 - ra);
    result_.witness_b = middle + n * length(static_cast<double>(core_distance) / 2 - rb);
  }

  double length(double working) const { return working * frame_.unit; }

  Difference difference_;
  WorkingFrame<D, S> frame_;
  const Settings& settings_;
  Workspace<D, S>& workspace_;
  Trace& trace_;
  const double radius_;
  const bool polytopes_;
  GjkResult<D, S> gjk_;
  Result result_;
};

}  // namespace gjkdbg
