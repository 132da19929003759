// Bodies whose difference has an outline that tells its depth, where EPA would need more faces than there is time for: GJK's overlap is looked along by axes.
#pragma once

#include "algo/near_balls.h"
#include "algo/revolution_sat.h"
#include "algo/tilted_axes.h"

namespace gjkdbg {

/// Of the first kind that they are of: of revolution about parallel axes, of revolution about nearly one line, nearly balls. Unset: of none. `tolerance`: relative, of the depth; `most`: EPA's iterations.
template <class Difference, class Trace>
std::optional<OutlineDepth<Difference::D, typename Difference::S>> outline_depth(Difference& difference, typename Difference::S tolerance, int most, Trace& trace) {
  std::optional<OutlineDepth<Difference::D, typename Difference::S>> found;
  if constexpr (Difference::D == 3) found = revolution_sat(difference, tolerance, most, trace);
  if constexpr (Difference::D == 3)
    if (!found) found = tilted_axes(difference, tolerance, most, trace);
  if (!found) found = near_balls(difference, tolerance, most, trace);
  return found;
}

}  // namespace gjkdbg
