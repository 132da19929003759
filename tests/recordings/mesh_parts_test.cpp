// Which triangle of a mesh a step is about.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "algo/motion.h"
#include "recordings/gallery.h"
#include "recordings/mesh_parts.h"
#include "recordings/recording.h"
#include "recordings/scene_file.h"

namespace gjkdbg {
namespace {

SceneFile gallery_scene(const std::string& name) { return read_scene(read_gallery(GJKDBG_GALLERY).file(name)); }

TEST(MeshParts, CountTheRuns) {
  const Recording ball = record(gallery_scene("level-mesh"));
  EXPECT_EQ(mesh_parts(ball, frame_at(ball, 0))->triangle, (std::array<int, 2>{-1, 0}));
  std::set<int> seen;
  for (std::size_t i = 0; i < ball.events.size(); ++i) {
    const auto parts = mesh_parts(ball, frame_at(ball, i));
    ASSERT_TRUE(parts);
    EXPECT_EQ(parts->runs, 3);
    seen.insert(parts->triangle[1]);
    // Every support of the mesh is a corner of the triangle that is named.
    if (const auto* query = std::get_if<recorded::SupportQueried>(&ball.events[i])) {
      const Shape triangle = triangle_of(ball.scene.scene.bodies[1].shape, static_cast<std::size_t>(parts->triangle[1]));
      const auto& corners = std::get<PointSet>(triangle.geometry).points;
      EXPECT_TRUE(std::any_of(corners.begin(), corners.end(), [&](const AnyVector& c) { return (c - query->b).norm() < 1e-12; })) << i;
    }
  }
  EXPECT_EQ(seen, (std::set<int>{0, 1, 2}));
  const Recording boxes = record(gallery_scene("box-box-deep"));
  EXPECT_FALSE(mesh_parts(boxes, frame_at(boxes, 0)));
}

/// Of a motion the supports tell: each is a corner of the triangle that is named, and within one step of a simulation no triangle is named twice.
TEST(MeshParts, OfAMotionAreToldByTheSupports) {
  for (const std::string name : {"cast-ghost-mesh", "sim-ball-on-mesh"}) {
    const Recording recording = record(gallery_scene(name));
    Replay replay(recording);
    std::set<int> in_round;
    int runs = 0;
    for (std::size_t i = 0; i < recording.events.size(); ++i) {
      const Frame& frame = replay.at(i);
      const Event& event = recording.events[i];
      const auto parts = mesh_parts(recording, frame);
      if (std::holds_alternative<recorded::State>(event) || std::holds_alternative<recorded::CastBegan>(event)) {
        EXPECT_FALSE(parts) << name << i;
        in_round.clear();
      }
      if (std::holds_alternative<recorded::GjkBegan>(event)) {
        ASSERT_TRUE(parts) << name << i;
        ++runs;
        if (name.starts_with("sim")) {
          EXPECT_TRUE(in_round.insert(parts->run).second) << name << i;
        }
      }
      const auto* query = std::get_if<recorded::SupportQueried>(&event);
      if (!query || query->phase == Phase::cast) continue;
      ASSERT_TRUE(parts) << name << i;
      const std::size_t which = parts->triangle[0] >= 0 ? 0 : 1;
      const auto body = static_cast<std::size_t>(frame.pair[which]);
      const Shape triangle = triangle_of(recording.scene.scene.bodies[body].shape, static_cast<std::size_t>(parts->triangle[which]));
      const auto& corners = std::get<PointSet>(triangle.geometry).points;
      const AnyVector& given = which == 0 ? query->a : query->b;
      EXPECT_TRUE(std::any_of(corners.begin(), corners.end(), [&](const AnyVector& c) { return (frame.places[body].rotation * c + frame.places[body].position - given).norm() < 1e-9; })) << name << i;
    }
    EXPECT_GT(runs, 2) << name;
  }
}

}  // namespace
}  // namespace gjkdbg
