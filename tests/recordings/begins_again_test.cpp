// Where GJK begins once more on the same bodies, or begins with a simplex that was kept; and meshes whose neighbouring triangles the same supports fit.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "algo/motion.h"
#include "recordings/check.h"
#include "recordings/mesh_parts.h"
#include "recordings/recording.h"

namespace gjkdbg {
namespace {

Recording run_of_scene(const std::string& rest) { return record(parse_scene(R"({"format": "gjk-scene", "version": 1, )" + rest + "}", ".")); }

std::string told_of(const Recording& recording) {
  std::string out;
  for (const Finding& f : check(recording)) out += std::to_string(f.step) + " " + f.code + ": " + f.message + "\n";
  return out;
}

std::size_t first_again(const Recording& recording) {
  for (std::size_t i = 0; i < recording.events.size(); ++i)
    if (begins_again(recording, i)) return i;
  ADD_FAILURE() << "it does not begin again";
  return 0;
}

/// The first run is that of the bodies where the second one is, too: at the time of the step after both.
TEST(BeginsAgain, InACastBothRunsAreOfOneTime) {
  const Recording cast = run_of_scene(R"("dimension": 2, "query": "cast", "bodies": [
    {"shape": {"type": "box", "half_extents": [0.0003712311569015496, 0.5]}, "pose": {"position": [2.07717099729874, -2.2121814762994063], "rotation": {"angle": 90}},
     "velocity": [-4.596159696817729, 2.7352562975847174], "angular_velocity": -141.9176715061453},
    {"shape": {"type": "polygon", "points": [[0.5, 0], [1, 0.5], [-0.5, 0.5], [0, -1]]}, "pose": {"position": [1.6573202564531844, 1.300838233759646], "rotation": {"angle": 318.5740706368896}},
     "velocity": [-3.0550484463492054, -1.2841548224582076]}], "method": {"closest_point": "johnson"})");
  const std::size_t again = first_again(cast);
  EXPECT_EQ(told_of(cast), "");
  const auto began = [&] {
    std::size_t i = again;
    while (!std::holds_alternative<recorded::GjkBegan>(cast.events[--i])) {}
    return i;
  }();
  EXPECT_EQ(frame_at(cast, began).time, frame_at(cast, again).time);
  // What is wrong in the second run is found there.
  Recording wrong = cast;
  std::get<recorded::SupportQueried>(wrong.events[again + 1]).a[0] += 0.25;
  ASSERT_FALSE(check(wrong).empty());
  EXPECT_EQ(check(wrong)[0].step, again + 1);
}

/// In single precision GJK works in lengths near 1: the direction is -v in those.
TEST(BeginsAgain, InLengthsOfItsOwn) {
  const std::string rest = R"("dimension": 2, "query": "cast", "bodies": [{"shape": {"type": "box", "half_extents": [0.000003712311569015496, 0.005]}, "pose": {"position": [0.0207717099729874, -0.022121814762994063], "rotation": {"angle": 90}},
     "velocity": [-0.04596159696817729, 0.027352562975847174], "angular_velocity": -141.9176715061453},
    {"shape": {"type": "polygon", "points": [[0.005, 0], [0.01, 0.005], [-0.005, 0.005], [0, -0.01]]}, "pose": {"position": [0.016573202564531844, 0.01300838233759646], "rotation": {"angle": 318.5740706368896}},
     "velocity": [-0.030550484463492054, -0.012841548224582076]}], "method": {"scalar": "float", "closest_point": "johnson", "tolerance": 1e-7})";
  const Recording cast = run_of_scene(rest);
  (void)first_again(cast);
  EXPECT_EQ(told_of(cast), "");
}

/// A mesh makes one run per triangle, however often GJK begins on it.
TEST(BeginsAgain, OnTheSameTriangle) {
  const Recording box = run_of_scene(R"("dimension": 3, "query": "distance", "bodies": [
    {"shape": {"type": "mesh", "points": [[-0.002, 0, -0.002], [-0.002, 0, 0], [-0.002, 0, 0.002], [0, 0, -0.002], [0, -0.00011532987740650824, 0], [0, 0, 0.002],
      [0.002, 0, -0.002], [0.002, 0, 0], [0.002, 0, 0.002]], "triangles": [[0, 1, 3], [1, 4, 3], [1, 2, 4], [2, 5, 4], [3, 4, 6], [4, 7, 6], [4, 5, 7], [5, 8, 7]]},
     "pose": {"rotation": {"quaternion": [0.17979279143368357, -0.7441794166274094, 0.4319933837073576, 0.47671088140469414]}}},
    {"shape": {"type": "box", "half_extents": [0.0008025592338983461, 0, 0.0005]}, "pose": {"position": [-0.00005184653420572553, -0.00032543601946791905, 0.0008063096322981285]}}],
    "method": {"closest_point": "voronoi", "scalar": "float"})");
  (void)first_again(box);
  for (std::size_t i = 0; i < box.events.size(); ++i) {
    const auto* query = std::get_if<recorded::SupportQueried>(&box.events[i]);
    if (!query) continue;
    const auto parts = mesh_parts(box, frame_at(box, i));
    ASSERT_TRUE(parts) << i;
    const Shape triangle = triangle_of(box.scene.scene.bodies[0].shape, static_cast<std::size_t>(parts->triangle[0]));
    const auto& corners = std::get<PointSet>(triangle.geometry).points;
    const Eigen::Vector3d own = Eigen::Matrix3d(box.scene.scene.bodies[0].pose.matrix).transpose() * Eigen::Vector3d(query->a);
    EXPECT_TRUE(std::any_of(corners.begin(), corners.end(), [&](const AnyVector& c) { return (c - own).norm() < 1e-8; })) << i;
  }
}

/// No support of GJK's tells whose vertices these are: those of the simplex that was kept are the cores', MPR's of the whole bodies come after them.
TEST(BeginsAgain, FromASimplexThatHoldsTheOrigin) {
  const Recording deep = run_of_scene(R"("dimension": 2, "query": "penetration", "bodies": [{"shape": {"type": "circle", "radius": 1.25}}, {"shape": {"type": "box", "half_extents": [1.125, 0.75]}, "pose": {"position": [-0.25, -0.25]}}],
    "method": {"name": "gjk", "penetration": "mpr", "start": "previous", "initial_simplex": [{"a": [0, 0], "b": [-1.125, -0.75]}, {"a": [0, 0], "b": [-1.125, 0.75]}, {"a": [0, 0], "b": [1.125, 0.75]}]})");
  ASSERT_EQ(std::get<recorded::GjkEnded>(deep.events[5]).status, GjkStatus::enclosed);
  EXPECT_EQ(told_of(deep), "");
}

/// The only support that is asked for is wrong: that does not make the vertices before it those of the whole bodies.
TEST(BeginsAgain, FromASimplexAndAWrongSupport) {
  Recording apart = run_of_scene(R"("dimension": 2, "query": "distance", "bodies": [{"shape": {"type": "circle", "radius": 1.25}}, {"shape": {"type": "box", "half_extents": [1, 1]}, "pose": {"position": [3, 0.5]}}],
    "method": {"start": "previous", "initial_simplex": [{"a": [0, 0], "b": [-1, 1]}, {"a": [0, 0], "b": [-1, -1]}]})");
  EXPECT_EQ(told_of(apart), "");
  ASSERT_EQ(apart.events.size(), 6u);
  auto& support = std::get<recorded::SupportQueried>(apart.events[4]);
  std::swap(support.a, support.b), support.w = -support.w;
  ASSERT_FALSE(check(apart).empty());
  EXPECT_EQ(check(apart)[0].step, 4u) << told_of(apart);
}

/// The supports of a run fit every triangle beside a corner, and only one of them ends as it did.
TEST(MeshParts, AllThatFit) {
  const Recording cast = run_of_scene(R"("dimension": 3, "query": "cast", "bodies": [
    {"shape": {"type": "mesh", "points": [[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], "triangles": [[0, 1, 2], [0, 2, 3]]}},
    {"shape": {"type": "sphere", "radius": 0.5}, "pose": {"position": [-1.5, 2, -1.5]}, "velocity": [0.25, -2, 0.25]}])");
  EXPECT_EQ(told_of(cast), "");
  Replay replay(cast);
  std::size_t both = 0;
  for (std::size_t i = 0; i < cast.events.size(); ++i)
    if (std::holds_alternative<recorded::GjkBegan>(cast.events[i])) both += fitting_triangles(cast, replay.at(i)).size() == 2;
  EXPECT_GT(both, 0u);
}

}  // namespace
}  // namespace gjkdbg
