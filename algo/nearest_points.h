// Points that prove a distance, however they were found.
#pragma once

#include "shapes/vector.h"

namespace gjkdbg {

/// The points of the cores nearest to each other, with b - a = distance * normal. No points are nearer than lower_bound.
template <int D, class S>
struct NearestPoints {
  Vector<D, S> a, b, normal;
  S distance, lower_bound;
};

/// Two boxes': while they are apart the nearest points, else those across the least overlap, `distance` being minus the depth. From A's centre, in A's axes.
template <int D, class S>
struct BoxPoints : NearestPoints<D, S> {
  int axes;     ///< that have been looked along
  bool apart;
  bool corner;  ///< no axis has the distance: it lies across a corner or an edge of the difference
  bool proven;  ///< by an axis, or the plane across; if not, these are not the points, but near
};

}  // namespace gjkdbg
