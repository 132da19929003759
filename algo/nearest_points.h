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

}  // namespace gjkdbg
