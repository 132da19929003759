// A polygon in space, cut into triangles along its own diagonals.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "shapes/vector.h"

namespace gjkdbg {

/// The triangles of the polygon whose corners are `points[corners[0]], points[corners[1]], …` (3 numbers each), in the order around it: three corners
/// each, turning as the polygon does; convex or not. Of a convex quadrilateral those of the shorter diagonal. A corner on the line between its
/// neighbours cuts nothing off; a polygon that is a line is fanned out, and of one that crosses itself, whose inside is anybody's guess, some triangles are given.
std::vector<std::array<int, 3>> polygon_triangles(std::span<const AnyVector> points, std::span<const int> corners);

}  // namespace gjkdbg
