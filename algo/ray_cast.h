// GJK ray cast: the first point of a ray that lies in the difference A - B.
//
// van den Bergen, "Ray Casting against General Convex Objects with Application to Continuous Collision Detection", 2004. The ray is t r, t in
// [0, 1]. A point x of it is kept that is known to come before the difference; v leads to x from the nearest point of the simplex:
//
//   p = support(v)             every q of A - B has v . q <= v . p: a plane across v at p
//   if v . (x - p) > 0         x is beyond the plane, so the ray enters it later or never:
//     if v . r >= 0: miss        it leads away
//     t += -v . (x - p) / v . r, x = t r      clipped to the plane; n = v is the normal
//   P = P + p;  v = x - (point of P nearest x)
//   until |v| is within the tolerance
//
// The simplex is kept when x moves: its vertices stay vertices of A - B.
#pragma once

#include <cmath>

#include "algo/boolean_gjk.h"
#include "algo/signed_volumes.h"
#include "algo/trace.h"

namespace gjkdbg {

template <int D, class S>
struct RayCastResult {
  CastStatus status = CastStatus::miss;
  int iterations = 0;
  S time = 0;                                  ///< the ray is outside until here; its share, 0 to 1
  Vector<D, S> normal = Vector<D, S>::Zero();  ///< unit, from body 0 towards body 1, in body 0's frame: of the last plane; zero without one
  Vector<D, S> point_a = Vector<D, S>::Zero(), point_b = Vector<D, S>::Zero();  ///< of the bodies as they began, where they will touch; not after a miss
};

/// From the origin along body 1's motion relative to body 0, in body 0's axes.
template <class V>
struct RayOfMotion {
  V vector;               ///< over what is left of the interval, from `start` to 1
  double start = 0;       ///< of the whole interval: the trace tells its times
  std::array<int, 2> pair{};  ///< the bodies' numbers, for the trace
};

/// `difference` answers with points of the bodies, radii included (InflatedDifference). `reach`: at this distance it is a hit. `max_iterations`: supports after
/// the first.
template <class Difference, class Trace>
RayCastResult<Difference::D, typename Difference::S> ray_cast(Difference& difference, const RayOfMotion<Vector<Difference::D, typename Difference::S>>& motion,
                                                              typename Difference::S reach, int max_iterations, Trace& trace) {
  constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  const V& ray = motion.vector;
  RayCastResult<D, S> result;
  Simplex<D, S> simplex;
  V x = V::Zero();
  const V out = ray.isZero(0) ? V(V::Unit(0)) : ray;  // bodies that keep their distance need some direction, too
  auto first = difference.support(out);
  if constexpr (traced<Trace>) trace(SupportQueried<V, Viewed>{0, Phase::cast, out, first.vertex, first.a, first.b, first.w});
  simplex.add(first);
  simplex.weights[0] = 1;
  V v = x - first.w;
  S before = std::numeric_limits<S>::infinity();
  const auto end = [&](CastStatus status) {
    result.status = status;
    result.point_a = simplex.point_a(), result.point_b = simplex.point_b();
    return result;
  };
  while (true) {
    const S distance = v.norm();
    if (!(distance > reach)) return end(result.time == 0 && result.normal.isZero(0) ? CastStatus::initially_overlapping : CastStatus::hit);
    if (++result.iterations > max_iterations) return end(CastStatus::iteration_limit);
    const auto p = difference.support(v);
    if constexpr (traced<Trace>) trace(SupportQueried<V, Viewed>{result.iterations, Phase::cast, v, p.vertex, p.a, p.b, p.w});
    const S beyond = v.dot(x - p.w) - difference.rounding_floor() * distance;  // surely
    bool clipped = false;
    if (beyond > 0) {
      const S along = v.dot(ray);
      if (!(along < 0)) return end(CastStatus::miss);
      const S step = -beyond / along;
      result.normal = v / distance;
      if constexpr (traced<Trace>)
        trace(CastAdvanced<V, Viewed>{result.iterations, motion.start + static_cast<double>(result.time) * (1 - motion.start), motion.pair,
                                      static_cast<double>(beyond / distance), result.normal, static_cast<double>(-along / distance) / (1 - motion.start)});
      if (result.time + step > 1) return end(CastStatus::miss);
      clipped = result.time + step > result.time;
      result.time += step;
      x = result.time * ray;
    }
    // A vertex that the simplex has, or no progress without a clip: what is left is rounding.
    if (simplex.holds(p.w) && !clipped) return end(beyond > reach * distance ? CastStatus::iteration_limit : CastStatus::hit);
    if (!simplex.holds(p.w)) {
      if (simplex.size() == D + 1) return end(CastStatus::hit);  // the point is inside the simplex
      simplex.add(p);
    }
    std::array<V, D + 1> y;
    for (int i = 0; i < simplex.size(); ++i) y[i] = simplex[i].w - x;
    const auto feature = SignedVolumes<D, S>::closest(y.data(), simplex.size());
    simplex.reduce_to(feature);
    v = -feature.v;
    if (feature.enclosed) v.setZero();
    if (!clipped && !(feature.v_squared < before)) return end(std::sqrt(feature.v_squared) <= 16 * reach ? CastStatus::hit : CastStatus::iteration_limit);
    before = clipped ? std::numeric_limits<S>::infinity() : feature.v_squared;
  }
}

}  // namespace gjkdbg
