// GJK by the sub-algorithm that is asked for, and by signed volumes where that one comes to no answer.
//
// Johnson's cofactors and the Voronoi regions have no exact fallback, and their v is a weighted sum of vertices: an error of epsilon times the size of A - B turns a
// v of length |v| by epsilon size / |v|, and the plane across it moves by epsilon size^2 / |v|. Once |v| is below the root of epsilon times the size that is more than
// |v| itself: no plane proves a gap any more, and GJK stalls with bounds on both sides of touching. Signed volumes keep v's direction, and their signs are exact. So GJK begins
// once more, along -v, which leads to the same simplex in a few supports.
#pragma once

#include "algo/gjk.h"
#include "algo/johnson.h"
#include "algo/voronoi.h"

namespace gjkdbg {

/// Stalled where the cores, or the bodies, may be apart or not.
template <int D, class S>
bool undecided(const GjkResult<D, S>& found, S radius) {
  return found.status == GjkStatus::stalled && (found.lower_bound <= 0 || (found.lower_bound <= radius && found.upper_bound > radius));
}

/// The result's iterations are those of both runs.
template <class Difference, class Trace>
void run_gjk(Difference& difference, ClosestPoint part, const GjkOptions<Difference::D, typename Difference::S>& options, Trace& trace,
             GjkResult<Difference::D, typename Difference::S>& result) {
  constexpr int D = Difference::D;
  using S = typename Difference::S;
  if (part == ClosestPoint::signed_volumes) return gjk<SignedVolumes<D, S>>(difference, options, trace, result);
  if (part == ClosestPoint::johnson) gjk<Johnson<D, S>>(difference, options, trace, result);
  else gjk<VoronoiRegions<D, S>>(difference, options, trace, result);
  if (!undecided(result, difference.radius())) return;
  const int before = result.iterations;
  GjkOptions<D, S> again = options;
  again.direction = -result.v, again.kept = {};
  result = {};
  gjk<SignedVolumes<D, S>>(difference, again, trace, result);
  result.iterations += before;
}

}  // namespace gjkdbg
