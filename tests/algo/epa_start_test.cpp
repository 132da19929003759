// The start around the way out that EPA takes for hulls of many vertices (algo/epa_start.h): every step holds, and the answer is SAT's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algo/solve.h"
#include "recordings/check.h"
#include "recordings/recording.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

/// A hull of so many points on an ellipsoid with half axes 1, 1 and `thickness`.
Shape hull(RandomScenes& random, int vertices, double thickness) {
  PointSet points{PointSetKind::hull, {}, {}};
  for (int i = 0; i < vertices; ++i) {
    Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    p.normalize();
    p[2] *= thickness;
    points.points.push_back(p);
  }
  return {points, 0};
}

Scene two_hulls(RandomScenes& random, int vertices, double thickness, double apart) {
  Scene scene;
  scene.dimension = 3, scene.query = Query::penetration;
  for (const char* name : {"A", "B"}) scene.bodies.push_back({name, hull(random, vertices, thickness), identity_pose(3)});
  scene.bodies[1].pose.matrix = random.rotation(3, Family::general);
  scene.bodies[1].pose.position = Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized() * apart;
  return scene;
}

struct Start {
  int asked = 0;
  std::size_t faces = 0;
  double depth = 0;
};

/// How EPA started, and the depth it found; the recording must be right in every step.
Start start_of(const Scene& scene, Scalar scalar) {
  Method method;
  method.scalar = scalar;
  SceneFile file;
  file.scene = scene;
  const Recording recording = record(file, resolve_settings(method, scene));
  for (const Finding& finding : check(recording)) ADD_FAILURE() << finding.code << ": " << finding.message;
  Start start;
  for (const auto& event : recording.events) {
    if (const auto* query = std::get_if<recorded::SupportQueried>(&event)) start.asked += query->phase == Phase::seed;
    if (const auto* seeded = std::get_if<recorded::PolytopeSeeded>(&event)) start.faces = seeded->faces.size();
  }
  start.depth = -recording.result.signed_distance.value_or(0);
  return start;
}

double depth_by_sat(const Scene& scene) {
  Method method;
  method.name = MethodName::sat;
  return -*solve(scene, resolve_settings(method, scene)).signed_distance;
}

/// Round, flat and hardly solid ones, shallow and deep: some start as the octahedron, some as the tetrahedron and what of the ring lies outside, some
/// without the ring, and all end at the depth.
TEST(EpaStart, HullsOfManyVerticesAgreeWithSat) {
  RandomScenes random(41);
  int octahedra = 0, grown = 0, without = 0;
  for (int k = 0; k < pairs_asked(240) && !testing::Test::HasFailure(); ++k) {
    constexpr int vertices[] = {12, 17, 24, 40, 80};
    constexpr double thickness[] = {1, 0.3, 1e-3};
    const Scene scene = two_hulls(random, vertices[k % 5], thickness[k / 5 % 3], k % 7 == 0 ? 1e-3 : random.uniform(0.1, 1.8));
    SCOPED_TRACE("pair " + std::to_string(k));
    const double depth = depth_by_sat(scene);
    if (depth <= 0) continue;
    const Start start = start_of(scene, Scalar::double_precision);
    EXPECT_NEAR(start.depth, depth, 1e-12);
    EXPECT_NEAR(start_of(scene, Scalar::float_precision).depth, depth, 1e-5);
    if (vertices[k % 5] <= 16) {
      EXPECT_LE(start.faces, 4u);
    }
    ++(start.faces == 8 && start.asked == 4 ? octahedra : start.faces > 4 ? grown : without);
  }
  EXPECT_GT(octahedra, 0);
  EXPECT_GT(grown, 0);
  EXPECT_GT(without, 0);
}

/// All sides tie: EPA comes to each of them, 1,020 here; the limit that nobody gave is no reason to leave a polytope unanswered.
TEST(EpaLimit, ManySidesAboutOneAxisAreFinite) {
  Scene scene;
  scene.query = Query::penetration;
  PointSet prism{PointSetKind::hull, {}, {}};
  for (int i = 0; i < 1024; ++i) prism.points.push_back(Eigen::Vector3d(std::cos((i / 2) * std::numbers::pi / 256), std::sin((i / 2) * std::numbers::pi / 256), i % 2 ? 2.0 : -2.0));
  scene.bodies = {{"A", {prism, 0}, identity_pose(3)}, {"B", {prism, 0}, identity_pose(3)}};
  for (const MethodName name : {MethodName::gjk, MethodName::fastest}) {
    Method method;
    method.name = name;
    const Result r = solve(scene, resolve_settings(method, scene));
    EXPECT_EQ(r.status, "converged");
    EXPECT_NEAR(*r.signed_distance, -2 * std::cos(std::numbers::pi / 512), 1e-12);
    method.max_iterations = 512;
    EXPECT_EQ(solve(scene, resolve_settings(method, scene)).status, "iteration_limit");
  }
}

/// So are the corners of a round hull about what is nearly a ball, though that has none.
TEST(EpaLimit, ARoundHullAboutAnEllipsoidIsFinite) {
  Scene scene;
  scene.query = Query::penetration;
  constexpr int corners = 1500;
  PointSet round{PointSetKind::hull, {}, {}};
  for (int i = 0; i < corners; ++i) {
    const double height = (2 * i + 1.0) / corners - 1, across = std::sqrt(1 - height * height), angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    round.points.push_back(Eigen::Vector3d(across * std::cos(angle), across * std::sin(angle), height));
  }
  scene.bodies = {{"A", {round, 0}, identity_pose(3)}, {"B", {Ellipsoid{AnyVector(Eigen::Vector3d(0.7, 0.71, 0.6999))}, 0}, identity_pose(3)}};
  Method method;
  const Result r = solve(scene, resolve_settings(method, scene));
  EXPECT_EQ(r.status, "converged");
  EXPECT_LE(*r.upper_bound - *r.lower_bound, 2e-10);
  method.max_iterations = 512;
  EXPECT_EQ(solve(scene, resolve_settings(method, scene)).status, "iteration_limit");
}

}  // namespace
}  // namespace gjkdbg
