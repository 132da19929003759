// A mesh is solved triangle by triangle, each in a run of its own: which one a step is about.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "recordings/corner_finder.h"
#include "recordings/replay.h"

namespace gjkdbg {

struct MeshParts {
  std::array<int, 2> triangle{-1, -1};  ///< of each body of the frame's pair, from 0; -1 of a body that is no mesh
  int run = 0, runs = 1;                ///< of the pair's triangles, from 0
};

/// Of the run that the frame's step belongs to. Unset where neither body is a mesh, where nothing runs, or where no triangle fits.
std::optional<MeshParts> mesh_parts(const Recording& recording, const Frame& frame);

/// Of a motion, where triangles that cannot be met are left out: all that the supports of the step's run fit, of which the first is taken for it; -1 of a body that is no mesh.
/// With `finders`, which are kept for the next call, much sooner where there are many.
std::vector<std::array<int, 2>> fitting_triangles(const Recording& recording, const Frame& frame, CornerFinders* finders = nullptr);

}  // namespace gjkdbg
