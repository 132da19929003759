// The Voronoi region of a part of the simplex, as a picture.
#pragma once

#include <vector>

#include "debugger/render/picture.h"

namespace gjkdbg {

/// Shades the region of a part: all x nearer to it than to any other part. In 2D the region itself, in 3D its walls; out to `reach`.
void draw_region(Picture& picture, const std::vector<ViewPoint>& simplex, const std::vector<int>& part, double reach, Colour colour, int dimension);

}  // namespace gjkdbg
