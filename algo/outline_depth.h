// Bodies whose difference has an outline that tells its depth, where EPA would need more faces than there is time for: GJK's overlap is looked along by axes.
#pragma once

#include "algo/bent_sum.h"
#include "algo/ellipsoid_depth.h"
#include "algo/near_balls.h"
#include "algo/revolution_sat.h"
#include "algo/tilted_axes.h"
#include "algo/tilted_spheroids.h"

namespace gjkdbg {

/// Of the first kind that they are of: of revolution about parallel axes, spheroids, or other bodies of revolution, about nearly one line, nearly balls. Unset: of none. `tolerance`: relative, of the depth; `most`: EPA's iterations.
template <class Difference, class Trace>
std::optional<OutlineDepth<Difference::D, typename Difference::S>> outline_depth(Difference& difference, typename Difference::S tolerance, int most, Trace& trace) {
  if constexpr (Difference::D == 3) {
    if (const auto found = revolution_sat(difference, tolerance, most, trace)) return found;
    if (const auto pair = tilted_spheroids(difference)) return ellipsoid_depth(difference, *pair, tolerance, most, trace);
    if (const auto found = tilted_axes(difference, tolerance, most, trace)) return found;
  }
  return near_balls(difference, tolerance, most, trace);
}

/// For where EPA came to its limit. `asked`: whether outline_depth() had something to say: near balls have then gone on by the bends of two ellipsoids. Unset where the limit was too low to tell, or their bends are
/// not known.
template <class Difference, class Trace>
std::optional<OutlineDepth<Difference::D, typename Difference::S>> depth_by_bends(Difference& difference, typename Difference::S tolerance, int most, bool asked, Trace& trace) {
  using S = typename Difference::S;
  if (!fair_for_epa(most)) return std::nullopt;
  if constexpr (Difference::D > 1)
    if (const auto pair = BentPair<Difference::D, S>::of(difference)) return asked ? std::nullopt : std::optional(ellipsoid_depth(difference, *pair, tolerance, most, trace));
  if constexpr (Difference::D == 3)
    if (const auto sum = BentSum<S>::of(difference)) return ellipsoid_depth(difference, *sum, tolerance, most, trace);
  if constexpr (Difference::D == 2)
    if (const auto outline = BentOutline<S>::of(difference)) return ellipsoid_depth(difference, *outline, tolerance, most, trace);
  return std::nullopt;
}

}  // namespace gjkdbg
