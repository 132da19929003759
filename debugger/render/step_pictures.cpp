#include "debugger/render/step_pictures.h"

#include <algorithm>
#include <cmath>

namespace gjkdbg {

SceneMeshes scene_meshes(const Scene& scene) {
  SceneMeshes meshes;
  meshes.dimension = scene.dimension;
  for (const Body& body : scene.bodies) meshes.bodies.push_back(body_mesh(body, scene.dimension));
  if (scene.bodies.size() < 2) return meshes;
  meshes.difference = difference_mesh(scene.bodies[0], scene.bodies[1], scene.dimension);
  meshes.radius = radius_sum(scene.bodies[0], scene.bodies[1], scene.dimension);
  return meshes;
}

double half_view(const Projection& projection) { return std::min(projection.rectangle().width, projection.rectangle().height) / projection.pixels_per_length() / 2; }

ViewPoint row_offset(int body, int dimension, const Projection& projection) {
  if (dimension > 1) return ViewPoint::Zero();
  return {0, (body == 0 ? 0.3 : -0.3) * half_view(projection), 0};
}

std::string simplex_letter(const Frame& frame, int vertex, bool newest_first) {
  const auto found = std::find(frame.lettered.begin(), frame.lettered.end(), vertex);
  if (found == frame.lettered.end()) return {};
  const auto from_newest = found - frame.lettered.begin(), from_oldest = frame.lettered.end() - found - 1;
  return std::string(1, static_cast<char>('A' + (newest_first ? from_newest : from_oldest)));
}

namespace {

struct Bounds {
  ViewPoint low = ViewPoint::Constant(INFINITY), high = ViewPoint::Constant(-INFINITY);
  void add(const ViewPoint& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  Camera camera(int dimension) const {
    Camera c;
    c.target = (low + high) / 2;
    const double size = (high - low).norm() / 2;
    c.radius = size > 0 ? size * 1.15 : 1;
    c.flat = dimension < 3;
    return c;
  }
};

}  // namespace

Camera fit_world(const SceneMeshes& meshes) {
  Bounds bounds;
  for (const DisplayMesh& mesh : meshes.bodies)
    for (const ViewPoint& p : mesh.points) bounds.add(p);
  return bounds.camera(meshes.dimension);
}

Camera fit_world(const SceneMeshes& meshes, const Recording& recording) {
  const Scene& scene = recording.scene.scene;
  if (!scene.motion) return fit_world(meshes);
  Bounds bounds;
  const auto add = [&](std::size_t i, const AnyVector& position) {
    const ViewPoint shift = to_view(AnyVector(position - scene.bodies[i].pose.position));
    for (const ViewPoint& p : meshes.bodies[i].points) bounds.add(p), bounds.add(p + shift);
  };
  const double end = recording.result.intersecting ? recording.result.time.value_or(1) : 1;
  for (std::size_t i = 0; i < meshes.bodies.size(); ++i) add(i, scene.query == Query::cast ? AnyVector(scene.bodies[i].pose.position + scene.bodies[i].motion->velocity * end) : scene.bodies[i].pose.position);
  for (const Event& event : recording.events)
    if (const auto* state = std::get_if<recorded::State>(&event))
      for (std::size_t i = 0; i < state->bodies.size() && i < meshes.bodies.size(); ++i) add(i, state->bodies[i].position);
  return bounds.camera(meshes.dimension);
}

Camera fit_difference(const SceneMeshes& meshes, const Recording& recording) {
  Bounds bounds;
  bounds.add(ViewPoint::Constant(0));
  for (const ViewPoint& p : meshes.difference.points) bounds.add(p);
  if (meshes.radius > 0 && std::isfinite(meshes.radius)) {
    const ViewPoint r(meshes.radius, meshes.dimension > 1 ? meshes.radius : 0, meshes.dimension > 2 ? meshes.radius : 0);
    bounds.add(r), bounds.add(-r);
  }
  for (const Event& event : recording.events)
    if (const auto given = given_vertex(event)) bounds.add(to_view(given->w));
  return bounds.camera(meshes.dimension);
}

}  // namespace gjkdbg
