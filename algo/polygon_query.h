// The penetration query of two convex polygons in the plane, from the poses to the answer in one piece, as algo/box_query.h is that of two boxes.
#pragma once

#include "algo/polygon_sat.h"
#include "algo/sat_answer.h"

namespace gjkdbg {

template <class S_>
struct PolygonQuery {
  using S = S_;
  using V = Vector<2, S>;

  Polygon<S> a, b;
  Vector<2, double> reference_a, reference_b;  ///< of the cores, times `scale`, as all lengths but the poses'
  S extents;                                   ///< added
  double radius_a, radius_b;
  double scale;

  /// Nothing for other shapes. Keeps pointers to the cores.
  static std::optional<PolygonQuery> of(const Convex<2, S>& a, const Convex<2, S>& b, double scale) {
    const auto *core_a = std::get_if<PolygonCore<S>>(&a.core()), *core_b = std::get_if<PolygonCore<S>>(&b.core());
    if (!core_a || !core_b) return std::nullopt;
    return PolygonQuery{core_a->polygon(), core_b->polygon(), a.reference(), b.reference(), static_cast<S>(a.extent() + b.extent()), a.radius(), b.radius(), scale};
  }

  /// False: GJK has the last word, and `result` means nothing.
  [[gnu::flatten]] bool solve(const PlacedAxes<2>& pose_a, const PlacedAxes<2>& pose_b, Result& result) const {
    Placed placed{relative_pose<2, S>(pose_a, reference_a, pose_b, reference_b, scale)};
    const V& p = placed.pose.position;
    const S floor = placed.floor = rounding_floor_of(extents, p[0] * p[0] + p[1] * p[1]);
    NoTrace trace;
    PolygonSat<Placed, NoTrace> sat(placed, a, b, trace);
    const SatResult<2, S>& found = sat.run(std::numeric_limits<S>::infinity());
    const SatAnswer<2, S> answer{WorkingFrame<2, S>(pose_a, reference_a, scale), radius_a, radius_b, floor};
    if (sat.gap()) {
      answer.set(result, *sat.gap());
    } else {
      if (found.status != SatStatus::overlapping) return false;
      const auto witnesses = sat.witnesses();
      if (!witnesses) return false;
      answer.set(result, {witnesses->a, witnesses->b, found.normal, -found.depth, -found.depth - floor});
    }
    result.status = word_of(found.status);
    result.iterations = found.iterations, result.support_calls = placed.heights;
    return true;
  }

 private:
  /// What PolygonSat asks of a MinkowskiDifference.
  struct Placed {
    static constexpr int D = 2;
    using S = S_;
    RelativePose<2, S> pose;
    S floor = 0;
    int heights = 0;

    S rounding_floor() const { return floor; }
    const Matrix<2, S>& rotation() const { return pose.rotation; }
    const V& position() const { return pose.position; }
    void count_supports(int more) { heights += more; }
    S radius() const { return 0; }  ///< of a trace only
  };
};

}  // namespace gjkdbg
