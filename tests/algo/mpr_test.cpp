// MPR's points: where its depth is the right one they lie on the bodies, that far apart.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/solve.h"
#include "recordings/check.h"
#include "recordings/recording.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

Result measured(Scene scene, const Method& method) {
  scene.query = Query::penetration;
  return solve(scene, resolve_settings(method, scene));
}

/// How far a point of the world lies outside a body.
double beside(const Scene& scene, std::size_t body, const AnyVector& point) {
  Scene probe = scene;
  Body& other = probe.bodies[1 - body];
  other.shape = {PointSet{PointSetKind::point, {AnyVector::Zero(scene.dimension)}, {}}, 0};
  other.pose = identity_pose(scene.dimension);
  other.pose.position = point;
  return std::max(0.0, *measured(probe, {}).signed_distance);
}

/// The point where the ray leaves the portal is another one: witnesses that were made of it lay off the bodies in all of 260 pairs of polygons.
TEST(Mpr, WitnessesOfARightDepthLieOnTheBodies) {
  Method mpr;
  mpr.name = MethodName::mpr, mpr.penetration = Penetration::mpr;
  for (const int dimension : {2, 3}) {
    RandomScenes random(31);
    int right = 0;
    for (int k = 0; k < 600; ++k) {
      const Scene scene = random.scene(dimension, k % 2 == 0 ? Family::general : Family::lattice, true);
      const Result exact = measured(scene, {}), r = measured(scene, mpr);
      const double size = std::max(size_of(scene.bodies[0].shape), size_of(scene.bodies[1].shape));
      if (!r.intersecting || *exact.signed_distance > -1e-3 * size || std::abs(*r.signed_distance - *exact.signed_distance) > 1e-10 * size) continue;
      ++right;
      EXPECT_LT(beside(scene, 0, *r.witness_a), 1e-9 * size) << dimension << "D " << k;
      EXPECT_LT(beside(scene, 1, *r.witness_b), 1e-9 * size) << dimension << "D " << k;
      EXPECT_LT((*r.witness_b - *r.witness_a - *r.signed_distance * *r.normal).norm(), 1e-12 * size) << dimension << "D " << k;
    }
    EXPECT_GT(right, 40) << dimension;
  }
}

/// With the ray from the triangle's middle; found by a random search.
TEST(Mpr, TheWitnessOfAPointIsThePoint) {
  const SceneFile scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "bodies": [{"shape": {"type": "point", "points": [[0, -0.75]]}}, {"shape": {"type": "triangle", "points": [[0.5, -1.75], [2, 1], [-1.5, 0.25]]}}], "method": {"name": "mpr"}})", {});
  const Recording recording = record(scene);
  EXPECT_LT((*recording.result.witness_a - AnyVector(Eigen::Vector2d(0, -0.75))).norm(), 1e-14);
  EXPECT_LT((*recording.result.witness_b - AnyVector(Eigen::Vector2d(-0.25, -1))).norm(), 1e-14);
  EXPECT_TRUE(check(recording).empty());
}

/// Needles: the planes of slivers are noise, and what they say is not an answer.
TEST(Mpr, SliversTellNoOverlap) {
  RandomScenes random(3);
  int apart = 0;
  for (int i = 0; i < 2000; ++i) {
    Scene scene;
    scene.query = Query::intersect;
    const AnyVector half = Eigen::Vector3d(1000, 1e-3, 1e-6);
    scene.bodies.push_back({"", {Sphere{1e-3}, 0}, identity_pose(3)});
    scene.bodies.push_back({"", {Box{-half, half}, 0}, identity_pose(3)});
    for (double& x : scene.bodies[1].pose.position) x = random.uniform(-3, 3);
    scene.bodies[1].pose.matrix = random.rotation(3, Family::general);
    Method method;
    method.name = MethodName::mpr, method.scalar = Scalar::float_precision;
    const Result r = solve(scene, resolve_settings(method, scene));
    scene.query = Query::penetration;
    if (!(*solve(scene, resolve_settings({}, scene)).signed_distance > 0.01)) continue;
    EXPECT_FALSE(r.intersecting) << i << ": " << r.status;
    ++apart;
  }
  EXPECT_GT(apart, 1500);
}

}  // namespace
}  // namespace gjkdbg
