#include "recordings/replay.h"
#include "shapes/world_support.h"

namespace gjkdbg {

std::vector<SimplexPoint> last_simplex(const Recording& recording) {
  std::size_t end = recording.events.size();
  while (end > 0 && !std::holds_alternative<recorded::GjkEnded>(recording.events[end - 1])) --end;
  const auto& bodies = recording.scene.scene.bodies;
  if (end == 0 || bodies.size() != 2 || recording.scene.scene.motion) return {};
  for (const Body& body : bodies)
    if (std::holds_alternative<Mesh>(body.shape.geometry)) return {};
  const Frame frame = frame_at(recording, end - 1);
  const int dimension = recording.scene.scene.dimension;
  std::vector<SimplexPoint> points;
  // The points in the events are the world's: far out they have lost digits. The supports are asked for again, in the bodies' own frames.
  const auto support = [&](const Body& body, const AnyVector& d) {
    return WorldSupport(Body{body.name, body.shape, identity_pose(dimension)}, dimension)(body.pose.matrix.transpose() * d, false);
  };
  const auto& kept = recording.settings.initial_simplex;
  for (const int v : frame.simplex) {
    const auto at = frame.vertices.find(v);
    if (at == frame.vertices.end()) continue;
    if (const auto* query = std::get_if<recorded::SupportQueried>(&recording.events[at->second.event]))
      points.push_back({support(bodies[0], query->direction), support(bodies[1], -query->direction)});
    else if (static_cast<std::size_t>(v) < kept.size())
      points.push_back(kept[static_cast<std::size_t>(v)]);
  }
  return points;
}

}  // namespace gjkdbg
