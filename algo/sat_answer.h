// The answer of a penetration query that SAT has all of: the same numbers PairSolver makes of it.
#pragma once

#include "algo/nearest_points.h"
#include "algo/result.h"
#include "algo/world_trace.h"

namespace gjkdbg {

template <int D, class S>
struct SatAnswer {
  WorkingFrame<D, S> frame;
  double radius_a, radius_b;
  S floor;  ///< of rounding

  /// Of the cores; `distance` is minus the depth where they overlap.
  void set(Result& result, const NearestPoints<D, S>& cores) const {
    const double radius = radius_a + radius_b, rounding = 2 * std::numeric_limits<double>::epsilon() * radius;
    result.lower_bound = (static_cast<double>(cores.lower_bound) - radius - rounding) * frame.unit + 0.0;  // no negative zero
    result.upper_bound = (static_cast<double>(cores.distance + floor) - radius + rounding) * frame.unit + 0.0;
    set_witnesses<D, S>(result, frame, cores.a, cores.b, cores.normal, static_cast<double>(cores.distance), radius_a, radius_b);
  }
};

}  // namespace gjkdbg
