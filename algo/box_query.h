// The penetration query of two boxes that lie about their bodies' origins, from the poses to the answer in one piece. PairSolver says the same, to the bit;
// it is made for all that may follow, and setting that up takes longer than these few axes do.
#pragma once

#include "algo/box_sat.h"
#include "algo/sat_answer.h"

namespace gjkdbg {

template <int D, class S>
struct BoxQuery;
#ifdef GJKDBG_AVX2
/// BoxQuery::solve_plainly, with the same bits, where no edges are nearly parallel and the points lie where they mostly do. False: `result` means nothing.
bool solved_by_avx2(const BoxQuery<3, double>& query, const PlacedAxes<3>& pose_a, const PlacedAxes<3>& pose_b, Result& result);
#endif

template <int D, class S>
struct BoxQuery {
  Vector<D, S> half_a, half_b;  ///< times `scale`, as all lengths but the poses'
  S extents;                    ///< added
  double radius_a, radius_b;
  double scale;

  /// Nothing for other shapes, and boxes whose middle or core's reference point is not their body's origin.
  static std::optional<BoxQuery> of(const Convex<D, S>& a, const Convex<D, S>& b, double scale) {
    const auto *box_a = solid_box<D, S>(a), *box_b = solid_box<D, S>(b);
    if (!box_a || !box_b || !box_a->center().isZero(0) || !box_b->center().isZero(0) || !a.reference().isZero(0) || !b.reference().isZero(0)) return std::nullopt;
    return BoxQuery{box_a->half(), box_b->half(), static_cast<S>(a.extent() + b.extent()), a.radius(), b.radius(), scale};
  }

  /// False: rounding has the last word, and `result` means nothing.
  bool solve(const PlacedAxes<D>& pose_a, const PlacedAxes<D>& pose_b, Result& result) const {
#ifdef GJKDBG_AVX2
    if constexpr (D == 3 && sizeof(S) == 8)
      if (__builtin_cpu_supports("avx2") && solved_by_avx2(*this, pose_a, pose_b, result)) return true;
#endif
    return solve_plainly(pose_a, pose_b, result);
  }
  [[gnu::flatten]] bool solve_plainly(const PlacedAxes<D>& pose_a, const PlacedAxes<D>& pose_b, Result& result) const {
    const Between between(pose_a, pose_b, scale);
    S p[D], squared = 0;
    for (int i = 0; i < D; ++i) p[i] = between.position(i), squared += p[i] * p[i];
    const S floor = rounding_floor_of(extents, squared);
    const auto say = [&](const BoxPoints<D, S>& found) __attribute__((always_inline)) { return answered(found, floor, pose_a, result); };
    const auto axes = box_axes<D, S>(half_a, half_b, [&](int i, int j) { return between.turn(i, j); }, p);
    if constexpr (D == 3) return axes.said(floor, say);
    else return say(axes.points(floor));
  }

 private:
  [[gnu::always_inline]] bool answered(const BoxPoints<D, S>& found, S floor, const PlacedAxes<D>& pose_a, Result& result) const {
    if (!found.proven) return false;
    NearestPoints<D, S> cores = found;
    cores.lower_bound -= floor;
    SatAnswer<D, S>{WorkingFrame<D, S>(pose_a, Vector<D, double>::Zero(), scale), radius_a, radius_b, floor}.set(result, cores);
    result.status = found.apart ? SatStatus::separated : SatStatus::overlapping;
    result.iterations = found.axes + found.corner, result.support_calls = found.axes;
    return true;
  }

  /// relative_pose() of references of zero, number by number.
  struct Between {
    const PlacedAxes<D>&a, &b;
    DoubleDouble x, y, z;  ///< from body 0's origin to body 1's; as many as there are

    Between(const PlacedAxes<D>& pose_a, const PlacedAxes<D>& pose_b, double times) : a(pose_a), b(pose_b), x(offset(0, times)), y(offset(D > 1 ? 1 : 0, times)), z(offset(D > 2 ? 2 : 0, times)) {}
    DoubleDouble offset(int i, double times) const { return DoubleDouble::two_sum(b.position[i] * times, -(a.position[i] * times)); }
    S turn(int i, int j) const { return static_cast<S>(along(i, b.rotation(0, j), b.rotation(D > 1 ? 1 : 0, j), b.rotation(D > 2 ? 2 : 0, j))); }
    S position(int i) const { return static_cast<S>(along(i, x.high, y.high, z.high) + along(i, x.low, y.low, z.low)); }

    /// Body 0's axis i times a vector.
    double along(int i, double to_x, double to_y, double to_z) const {
      if constexpr (D == 1) return a.rotation(0, i) * to_x;
      else if constexpr (D == 2) return a.rotation(0, i) * to_x + a.rotation(1, i) * to_y;
      else return a.rotation(0, i) * to_x + a.rotation(1, i) * to_y + a.rotation(2, i) * to_z;
    }
  };
};

}  // namespace gjkdbg
