// The penetration query of two boxes in the plane that lie about their bodies' origins, from the poses to the answer in one piece. PairSolver says the same, to the bit;
// it is made for all that may follow, and setting that up takes longer than these four axes do.
#pragma once

#include "algo/box_sat.h"
#include "algo/rectangle_sat.h"
#include "algo/result.h"
#include "algo/trace.h"
#include "algo/world_trace.h"

namespace gjkdbg {

template <class S>
struct RectanglePair {
  Vector<2, S> half_a, half_b;  ///< times `scale`, as all lengths but the poses'
  S extents;                    ///< added
  double radius_a, radius_b;
  double scale;

  /// Nothing for other shapes, and boxes whose middle or core's reference point is not their body's origin.
  static std::optional<RectanglePair> of(const Convex<2, S>& a, const Convex<2, S>& b, double scale) {
    const auto *box_a = solid_box<2, S>(a), *box_b = solid_box<2, S>(b);
    if (!box_a || !box_b || !box_a->center().isZero(0) || !box_b->center().isZero(0) || !a.reference().isZero(0) || !b.reference().isZero(0)) return std::nullopt;
    return RectanglePair{box_a->half(), box_b->half(), static_cast<S>(a.extent() + b.extent()), a.radius(), b.radius(), scale};
  }

  /// False: rounding has the last word, and `result` means nothing.
  [[gnu::flatten]] bool solve(const PlacedAxes<2>& pose_a, const PlacedAxes<2>& pose_b, Result& result) const {
    const auto& a = pose_a.rotation;
    const auto& b = pose_b.rotation;
    const auto offset = [&](int i) { return DoubleDouble::two_sum(pose_b.position[i] * scale, -(pose_a.position[i] * scale)); };
    const DoubleDouble x = offset(0), y = offset(1);
    const auto turned = [&](int i) { return static_cast<S>(a(0, i) * b(0, 0) + a(1, i) * b(1, 0)); };
    const auto between = [&](int i) { return static_cast<S>((a(0, i) * x.high + a(1, i) * y.high) + (a(0, i) * x.low + a(1, i) * y.low)); };
    const S p0 = between(0), p1 = between(1), floor = rounding_floor_of(extents, p0 * p0 + p1 * p1);
    const auto found = Rectangles<S>(half_a, half_b, turned(0), turned(1), p0, p1).points(floor);
    if (!found.proven) return false;
    const double unit = 1 / scale, radius = radius_a + radius_b, rounding = 2 * std::numeric_limits<double>::epsilon() * radius;
    result.lower_bound = (static_cast<double>(found.lower_bound - floor) - radius - rounding) * unit + 0.0;  // no negative zero
    result.upper_bound = (static_cast<double>(found.distance + floor) - radius + rounding) * unit + 0.0;
    set_witnesses<2, S>(result, WorkingFrame<2, S>(pose_a, Vector<2, double>::Zero(), scale), Vector<2, S>(found.a), Vector<2, S>(found.b), Vector<2, S>(found.normal), static_cast<double>(found.distance), radius_a,
                        radius_b);
    result.status = sat_status_names[static_cast<std::size_t>(found.apart ? SatStatus::separated : SatStatus::overlapping)];
    result.iterations = 4 + found.corner, result.support_calls = 4;
    return true;
  }
};

}  // namespace gjkdbg
