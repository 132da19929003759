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
    set_bounds(result, static_cast<double>(cores.lower_bound), static_cast<double>(cores.distance + floor), radius_a, radius_b, frame.unit);
    set_witnesses<D, S>(result, frame, cores.a, cores.b, cores.normal, static_cast<double>(cores.distance), radius_a, radius_b);
  }
};

}  // namespace gjkdbg
