// Meshes from Wavefront OBJ files, read with tinyobjloader.
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

/// Throws Error (place: the file's name, with the line where it is known) for a file that cannot be read, a malformed or
/// non-finite vertex, no vertices at all, or a face that names a vertex that is not there.
ObjMesh read_obj(const std::filesystem::path& file);

}  // namespace gjkdbg
