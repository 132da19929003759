#include "recordings/mesh_parts.h"

namespace gjkdbg {

std::optional<MeshParts> mesh_parts(const Recording& recording, std::size_t step) {
  const Scene& scene = recording.scene.scene;
  if (scene.motion || scene.bodies.size() != 2) return std::nullopt;
  std::array<const Mesh*, 2> meshes;
  std::array<int, 2> counts{1, 1};
  for (std::size_t i = 0; i < 2; ++i) {
    meshes[i] = std::get_if<Mesh>(&scene.bodies[i].shape.geometry);
    if (meshes[i]) counts[i] = static_cast<int>(meshes[i]->triangles.size());
  }
  if (!meshes[0] && !meshes[1]) return std::nullopt;
  MeshParts parts;
  parts.runs = counts[0] * counts[1];
  // Every run begins as the first did: MPR and SAT may hand over to GJK, GJK to MPR.
  std::optional<std::size_t> first;
  parts.run = -1;
  for (std::size_t i = 0; i <= step; ++i) {
    const Event& event = recording.events[i];
    if (!kind_name(event).ends_with("_began")) continue;
    if (!first) first = event.index();
    parts.run += event.index() == *first;
  }
  if (parts.run < 0 || parts.run >= parts.runs) return std::nullopt;
  if (meshes[0]) parts.triangle[0] = parts.run / counts[1];
  if (meshes[1]) parts.triangle[1] = parts.run % counts[1];
  return parts;
}

}  // namespace gjkdbg
