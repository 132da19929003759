// The penetration query of two convex polygons in the plane, from the poses to the answer in one piece, as algo/box_query.h is that of two boxes: the same
// numbers PairSolver comes to.
#pragma once

#include "algo/polygon_eights.h"
#include "algo/polygon_sat.h"
#include "algo/sat_answer.h"

namespace gjkdbg {

template <class S>
class PolygonQuery;
#ifdef GJKDBG_AVX2
/// PolygonQuery::solve where the first points that the best edge leads to are proven. False: `result` means nothing.
bool solved_by_avx2(const PolygonQuery<double>& query, const PlacedAxes<2>& pose_a, const PlacedAxes<2>& pose_b, Result& result);
#endif

template <class S_>
class PolygonQuery {
 public:
  using S = S_;
  using V = Vector<2, S>;

  /// Whether a query of these can be made: two polygons, or one and a box of which no side is zero.
  static bool answers(const Convex<2, S>& a, const Convex<2, S>& b) {
    const auto is_polygon = [](const Convex<2, S>& body) { return std::holds_alternative<PolygonCore<S>>(body.core()); };
    return (is_polygon(a) || is_polygon(b)) && (is_polygon(a) || solid_box<2, S>(a)) && (is_polygon(b) || solid_box<2, S>(b));
  }
  /// Keeps pointers to the cores, which are made for `scale`.
  PolygonQuery(const Convex<2, S>& a, const Convex<2, S>& b, double scale)
      : polygon_of_a_(a), polygon_of_b_(b), a_(*polygon_of_a_.polygon), b_(*polygon_of_b_.polygon), reference_a_(a.reference()), reference_b_(b.reference()),
        extents_(static_cast<S>(a.extent() + b.extent())), radius_a_(a.radius()), radius_b_(b.radius()), scale_(scale) {
#ifdef GJKDBG_AVX2
    if constexpr (sizeof(S) == 8) eights_ = {a_, b_};
#endif
  }

  /// False: GJK has the last word, and `result` means nothing.
  bool solve(const PlacedAxes<2>& pose_a, const PlacedAxes<2>& pose_b, Result& result) const {
#ifdef GJKDBG_AVX2
    if constexpr (sizeof(S) == 8)
      if (__builtin_cpu_supports("avx2") && solved_by_avx2(*this, pose_a, pose_b, result)) return true;
#endif
    return solve_by_sat(pose_a, pose_b, result);
  }

  const Polygon<S>& a() const { return a_; }
  const Polygon<S>& b() const { return b_; }

  struct Placed {
    RelativePose<2, S> pose;
    S floor;  ///< of rounding
  };
  Placed placed(const PlacedAxes<2>& pose_a, const PlacedAxes<2>& pose_b) const {
    Placed placed{relative_pose<2, S>(pose_a, reference_a_, pose_b, reference_b_, scale_), 0};  // not copied: what was just written is still on its way
    const Vector<2, S>& p = placed.pose.position;
    placed.floor = rounding_floor_of(extents_, p[0] * p[0] + p[1] * p[1]);
    return placed;
  }
#ifdef GJKDBG_AVX2
  const PolygonEights& eights() const { return eights_; }
  /// Where there are eights.
  [[gnu::target("avx2"), gnu::always_inline]] inline PolygonEights::Widest widest_by_eights(const Placed& placed) const {
    return eights_.widest(placed.pose, placed.floor * 0x1p49);  // the floor is 10 2^-52 m
  }
#endif
  SatAnswer<2, S> answer(const PlacedAxes<2>& pose_a, S floor) const { return {WorkingFrame<2, S>(pose_a, reference_a_, scale_), radius_a_, radius_b_, floor}; }

 private:
  [[gnu::flatten, gnu::noinline]] bool solve_by_sat(const PlacedAxes<2>& pose_a, const PlacedAxes<2>& pose_b, Result& result) const {
    Difference difference{placed(pose_a, pose_b)};
    NoTrace trace;
    PolygonSat<Difference, NoTrace> sat(difference, a(), b(), trace);
    const SatResult<2, S>& found = sat.run(std::numeric_limits<S>::infinity());
    const S floor = difference.at.floor;
    if (sat.gap()) {
      answer(pose_a, floor).set(result, *sat.gap());
    } else {
      if (!sat.witnesses()) return false;
      answer(pose_a, floor).set(result, {sat.witnesses()->a, sat.witnesses()->b, found.normal, -found.depth, -found.depth - floor});
    }
    result.status = found.status;
    result.iterations = found.iterations, result.support_calls = difference.heights;
    return true;
  }

  /// What PolygonSat asks of a MinkowskiDifference.
  struct Difference {
    static constexpr int D = 2;
    using S = S_;
    Placed at;
    int heights = 0;

    S rounding_floor() const { return at.floor; }
    const Matrix<2, S>& rotation() const { return at.pose.rotation; }
    const V& position() const { return at.pose.position; }
    void count_supports(int more) { heights += more; }
    S radius() const { return 0; }  ///< of a trace only
  };

  const PolygonOf<S> polygon_of_a_, polygon_of_b_;
  const Polygon<S> a_, b_;
  const Vector<2, double> reference_a_, reference_b_;  ///< of the cores, times `scale_`, as all lengths but the poses'
  const S extents_;                                    ///< added
  const double radius_a_, radius_b_;
  const double scale_;
#ifdef GJKDBG_AVX2
  PolygonEights eights_;  ///< in double precision
#endif
};

}  // namespace gjkdbg
