// The ray cast: its trace after responses, its answers at every size; and what bodies that turn and meshes that are given a simplex come to.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/motion.h"
#include "recordings/gallery.h"
#include "recordings/recording.h"
#include "recordings/replay.h"
#include "recordings/scene_file.h"

namespace gjkdbg {
namespace {

SceneFile of_the_gallery(const std::string& name) { return read_scene(read_gallery(GJKDBG_GALLERY).file(name)); }

TEST(RayCast, TracesTimesOfTheWholeInterval) {
  SceneFile file = of_the_gallery("cast-bounce");
  file.method.name = MethodName::ray_cast;
  const Recording run = record(file);
  std::vector<AnyVector> velocities;
  for (const Body& body : run.scene.scene.bodies) velocities.push_back(body.motion->velocity);
  double now = 0;
  int responses = 0, after = 0;
  for (const Event& event : run.events) {
    if (const auto* impulse = std::get_if<recorded::ImpulseApplied>(&event)) {
      for (std::size_t k = 0; k < 2; ++k) velocities[static_cast<std::size_t>(impulse->pair[k])] = impulse->velocities_after[k];
      now = impulse->time, ++responses;
    }
    const auto* advanced = std::get_if<recorded::CastAdvanced>(&event);
    if (!advanced) continue;
    after += responses > 0;
    EXPECT_GE(advanced->time, now - 1e-12);
    EXPECT_LE(advanced->time, 1);
    const AnyVector closing = velocities[static_cast<std::size_t>(advanced->pair[0])] - velocities[static_cast<std::size_t>(advanced->pair[1])];
    EXPECT_NEAR(advanced->bound, closing.dot(advanced->normal), 1e-9);
  }
  EXPECT_GT(responses, 0);
  EXPECT_GT(after, 0);
}

/// A ball of radius 0.5 that flies at a box's face, all lengths times `size`.
Result flight(double size, Scalar scalar, MethodName name) {
  Scene scene;
  scene.dimension = 3, scene.query = Query::cast;
  const auto at = [&](double x, double y, double z) { return AnyVector(Eigen::Vector3d(x, y, z) * size); };
  Body ball{"A", {Sphere{0.5 * size}, 0}, identity_pose(3), Motion{}}, box{"B", {Box{at(-1, -1, -1), at(1, 1, 1), true}, 0}, identity_pose(3), Motion{}};
  box.pose.position = at(4, 0.25, 0);
  for (Body* body : {&ball, &box}) body->motion->velocity = at(0, 0, 0), body->motion->angular_velocity = AnyVector::Zero(3);
  ball.motion->velocity = at(5, 0, 0);
  scene.bodies = {ball, box};
  Method method;
  method.name = name, method.scalar = scalar;
  return solve(scene, resolve_settings(method, scene));
}

TEST(RayCast, AnswersAlikeAtEverySize) {
  for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
    const bool single = scalar == Scalar::float_precision;
    for (const int exponent : {-300, -150, -40, 0, 40, 100}) {
      if (single && std::abs(exponent) > 100) continue;
      const Result found = flight(std::ldexp(1.0, exponent), scalar, MethodName::ray_cast);
      EXPECT_EQ(found.status, "hit") << exponent;
      EXPECT_NEAR(*found.time, 0.5, single ? 1e-5 : 1e-9) << exponent;
      EXPECT_LE(*found.time, 0.5);
    }
  }
}

TEST(Replay, AngularVelocitiesAreInDegrees) {
  const Recording run = record(of_the_gallery("cast-rotating-rod"));
  int turning = 0;
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    const Frame frame = frame_at(run, i);
    for (std::size_t k = 0; k < frame.places.size(); ++k) {
      const AnyVector& given = run.scene.scene.bodies[k].motion->angular_velocity;
      if (given.isZero(0)) continue;
      ++turning;
      EXPECT_EQ(frame.places[k].angular_velocity, in_degrees(given));
    }
  }
  EXPECT_GT(turning, 0);
}

/// A simplex is held against convex bodies only; of a mesh it would be believed.
TEST(WarmStart, OfAMeshIsNotTaken) {
  Scene scene;
  scene.dimension = 3, scene.query = Query::penetration;
  Mesh mesh;
  mesh.points = {Eigen::Vector3d(-1, 0, -1), Eigen::Vector3d(1, 0, -1), Eigen::Vector3d(0, 0, 1)};
  mesh.triangles = {{0, 1, 2}};
  Body ground{"A", {mesh, 0}, identity_pose(3), {}}, box{"B", {Box{Eigen::Vector3d(-0.5, -0.5, -0.5), Eigen::Vector3d(0.5, 0.5, 0.5), true}, 0}, identity_pose(3), {}};
  box.pose.position = Eigen::Vector3d(0, 5, 0);
  scene.bodies = {ground, box};
  Method method;
  method.start = Start::previous, method.initial_simplex = {{Eigen::Vector3d(0, 4.5, 0), Eigen::Vector3d(0, -0.5, 0)}};  // a point far above the triangle
  const Result found = solve(scene, resolve_settings(method, scene));
  EXPECT_FALSE(found.intersecting);
  EXPECT_NEAR(*found.signed_distance, 4.5, 1e-12);
}

}  // namespace
}  // namespace gjkdbg
