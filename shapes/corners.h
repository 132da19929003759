// A polytope's corners: for what needs features and not only supports, contact polygons and pictures.
#pragma once

#include <optional>
#include <vector>

#include "shapes/shape.h"

namespace gjkdbg {

/// Points whose hull is the shape's core, in the body's frame, and the radius around it. They may repeat or lie inside.
struct Corners {
  std::vector<AnyVector> points;
  double radius = 0;
};

inline constexpr std::size_t largest_sum = 4096;  ///< pairs of corners

/// Nothing for what is round (cylinder, cone, ellipsoid), for a mesh, and for sums with more pairs of corners than `largest_sum`.
std::optional<Corners> corners_of(const Shape& shape, int dimension);

}  // namespace gjkdbg
