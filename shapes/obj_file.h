// Meshes from Wavefront OBJ files.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "shapes/vector.h"

namespace gjkdbg {

struct ObjMesh {
  std::vector<AnyVector> points;               ///< 3 numbers each
  std::vector<std::array<int, 3>> triangles;   ///< polygons are split; empty for a file of vertices only
};

/// Throws Error (place: the file's name, with the line where it is known) for a file that cannot be read, a malformed,
/// huge or non-finite vertex, no vertices at all, a face of fewer than three or that names a vertex that is not there, or a line that is no OBJ.
ObjMesh read_obj(const std::filesystem::path& file);

}  // namespace gjkdbg
