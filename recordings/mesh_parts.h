// A mesh is solved triangle by triangle, each in a run of its own: which one a step is about.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "recordings/recording.h"

namespace gjkdbg {

struct MeshParts {
  std::array<int, 2> triangle{-1, -1};  ///< of each body, from 0; -1 of a body that is no mesh
  int run = 0, runs = 1;                ///< of the runs of a scene, from 0
};

/// Of a scene that does not move. Unset where no body is a mesh, or before the first run.
std::optional<MeshParts> mesh_parts(const Recording& recording, std::size_t step);

}  // namespace gjkdbg
