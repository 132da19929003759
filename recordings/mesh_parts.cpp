#include "recordings/mesh_parts.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "algo/motion.h"
#include "shapes/shape.h"

namespace gjkdbg {
namespace {

/// Scenes at rest go through all pairs of triangles in order. Every run begins as the first did: MPR and SAT may hand over to GJK, GJK to MPR.
int runs_begun(const Recording& recording, std::size_t step) {
  const std::vector<Event>& events = recording.events;
  std::optional<std::size_t> first;
  int run = -1;
  for (std::size_t i = 0; i <= step; ++i) {
    if (!kind_name(events[i]).ends_with("_began")) continue;
    if (!first) first = events[i].index();
    run += events[i].index() == *first && !begins_again(recording, i);
  }
  return run;
}

/// Between two runs of a motion.
bool between_runs(const Event& event) {
  return std::holds_alternative<recorded::State>(event) || std::holds_alternative<recorded::CastBegan>(event) || std::holds_alternative<recorded::CastEnded>(event);
}

/// Motions leave out triangles that cannot be met: the supports of the step's run tell whose it is. Empty where there is none.
std::vector<const recorded::SupportQueried*> supports_of_run(const std::vector<Event>& events, std::size_t step) {
  std::vector<const recorded::SupportQueried*> supports;
  std::size_t began = step + 1;
  while (began-- > 0 && !between_runs(events[began])) {
    if (!kind_name(events[began]).ends_with("_began")) continue;
    for (std::size_t i = began + 1; i < events.size() && !between_runs(events[i]) && !kind_name(events[i]).ends_with("_began"); ++i)
      if (const auto* query = std::get_if<recorded::SupportQueried>(&events[i]); query && query->phase != Phase::cast && query->direction.allFinite()) supports.push_back(query);
    break;
  }
  return supports;
}

/// Whether each support along d (of body 0, -d of body 1) is the corner of the triangle that is farthest that way; with the margin or, of the core, without.
bool fits(const std::array<AnyVector, 3>& corners, double margin, std::size_t body, const std::vector<const recorded::SupportQueried*>& supports) {
  return std::all_of(supports.begin(), supports.end(), [&](const recorded::SupportQueried* query) {
    const AnyVector d = query->direction.stableNormalized() * (body == 0 ? 1.0 : -1.0), &point = body == 0 ? query->a : query->b;
    double size = point.norm(), nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (const AnyVector& c : corners) size = std::max(size, c.norm()), nearest = std::min(nearest, (c - point).norm()), farthest = std::max(farthest, d.dot(c - point));
    const double close = 1e-6 * size;  // in single precision as well
    return nearest <= margin + close && farthest <= close;
  });
}

std::vector<int> triangles_that_fit(const Mesh& mesh, double margin, const Frame::Place& place, std::size_t body, const std::vector<const recorded::SupportQueried*>& supports, const CornerFinder* finder) {
  std::vector<int> candidates(finder ? 0 : mesh.triangles.size()), found;
  std::iota(candidates.begin(), candidates.end(), 0);
  if (finder) {
    const AnyVector &point = body == 0 ? supports.front()->a : supports.front()->b, here = place.rotation.transpose() * (point - place.position);
    candidates = finder->near(here, margin + 2e-6 * (point.norm() + place.position.norm() + finder->extent()));  // `fits` allows half of it
  }
  for (const int k : candidates) {
    std::array<AnyVector, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = place.rotation * mesh.points[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(k)][i])] + place.position;
    if (fits(corners, margin, body, supports)) found.push_back(k);
  }
  return found;
}

}  // namespace

std::vector<std::array<int, 2>> fitting_triangles(const Recording& recording, const Frame& frame, CornerFinders* finders) {
  const Scene& scene = recording.scene.scene;
  const auto supports = supports_of_run(recording.events, frame.step);
  if (supports.empty() || frame.places.size() != scene.bodies.size()) return {};
  std::array<std::vector<int>, 2> found{{{-1}, {-1}}};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto body = static_cast<std::size_t>(frame.pair[i]);
    const Shape& shape = scene.bodies[body].shape;
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    if (!mesh) continue;
    const CornerFinder* const finder = finders ? &finders->try_emplace(mesh, *mesh).first->second : nullptr;
    found[i] = triangles_that_fit(*mesh, shape.margin, frame.places[body], i, supports, finder);
  }
  std::vector<std::array<int, 2>> pairs;
  for (const int i : found[0])
    for (const int j : found[1]) pairs.push_back({i, j});
  return pairs;
}

std::optional<MeshParts> mesh_parts(const Recording& recording, const Frame& frame) {
  const Scene& scene = recording.scene.scene;
  if (!scene.motion && scene.bodies.size() != 2) return std::nullopt;
  std::array<const Mesh*, 2> meshes;
  std::array<int, 2> counts{1, 1};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto body = static_cast<std::size_t>(frame.pair[i]);
    if (body >= scene.bodies.size()) return std::nullopt;
    meshes[i] = std::get_if<Mesh>(&scene.bodies[body].shape.geometry);
    if (meshes[i]) counts[i] = static_cast<int>(meshes[i]->triangles.size());
  }
  if (!meshes[0] && !meshes[1]) return std::nullopt;
  MeshParts parts;
  parts.runs = counts[0] * counts[1];
  if (!scene.motion) {
    parts.run = runs_begun(recording, frame.step);
    if (parts.run < 0 || parts.run >= parts.runs) return std::nullopt;
    if (meshes[0]) parts.triangle[0] = parts.run / counts[1];
    if (meshes[1]) parts.triangle[1] = parts.run % counts[1];
    return parts;
  }
  const std::vector<std::array<int, 2>> fit = fitting_triangles(recording, frame);
  if (fit.empty()) return std::nullopt;
  parts.triangle = fit.front();
  parts.run = std::max(0, parts.triangle[0]) * counts[1] + std::max(0, parts.triangle[1]);
  return parts;
}

}  // namespace gjkdbg
