#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "algo/solve.h"
#include "recordings/scene_file.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

/// Cubes on their edges, crossed, a little apart: where the origin is next to a line through two vertices of the difference, the way from the line to it is
/// what rounding leaves of two long vectors. A boolean GJK that takes it as it is says they touch.
TEST(BooleanGjk, NextToALine) {
  for (const double gap : {1e-4, 1e-6, 1e-10, 1e-13})
    for (const double sign : {1.0, -1.0}) {
      Scene scene;
      scene.query = Query::intersect;
      for (const double z : {0.0, 2.8 + sign * gap}) {
        Body body{"", {Box{Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1), true}, 0}, identity_pose(3)};
        body.pose.position = Eigen::Vector3d(0, 0, z);
        body.pose.matrix = z == 0 ? Eigen::Quaterniond(2, 0, 1, 0).normalized().toRotationMatrix() : Eigen::Quaterniond(2, 1, 0, 0).normalized().toRotationMatrix();
        scene.bodies.push_back(body);
      }
      for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
        if (scalar == Scalar::float_precision && gap < 1e-5) continue;  // what single precision carries of 2.8
        Method method;
        method.name = MethodName::gjk_boolean, method.scalar = scalar;
        EXPECT_EQ(solve(scene, resolve_settings(method, scene)).intersecting, sign < 0) << gap * sign << " " << word_of(scalar);
      }
    }
}

/// 4.2e-5 beside a long edge: of the way there a 770th was left, which rounding turned so far that the edge's other end seemed to lie beyond the origin.
TEST(BooleanGjk, BesideAnEdgeInFloat) {
  Scene scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "intersect", "bodies": [
    {"shape": {"type": "polygon", "points": [[-0.4925058157630563, 0.9655890876215465], [-0.641244825897003, -0.9794806028682791], [0.1124983687446206, -0.6570532867957316]]},
     "pose": {"position": [0.21729744061481004, -1.4226805990150726], "rotation": {"matrix": [[0.3908889427196078, -0.9204378493193047], [0.9204378493193047, 0.3908889427196078]]}}},
    {"shape": {"type": "box", "half_extents": [8.279652560438359e-06, 4.808746648892961e-06]},
     "pose": {"position": [0.8320822584115957, -1.574397123039495], "rotation": {"matrix": [[-0.17989426215951784, 0.9836859531588741], [-0.9836859531588741, -0.17989426215951784]]}}}]})", {}).scene;
  Method method;
  method.name = MethodName::gjk_boolean, method.scalar = Scalar::float_precision;
  EXPECT_FALSE(solve(scene, resolve_settings(method, scene)).intersecting);
  scene.query = Query::penetration;
  EXPECT_GT(*solve(scene, resolve_settings({}, scene)).lower_bound, 4e-5);
}

/// Lengths about 2^17 are as large as float is reckoned in without a scale: eighth powers of them are no numbers any more.
TEST(BooleanGjk, TheLargestLengthsInFloat) {
  RandomScenes random(9);
  int apart = 0;
  for (int i = 0; i < 6000; ++i) {
    constexpr double size = 1.3e5;
    const auto point = [&] { return AnyVector(Eigen::Vector3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size))); };
    Scene scene;
    for (const bool second : {false, true}) {
      PointSet hull;
      for (int k = 4 + i % 4; k > 0; --k) hull.points.push_back(point());
      scene.bodies.push_back({"", {hull, 0}, identity_pose(3)});
      if (second) scene.bodies.back().pose.position = point();
    }
    const Result truth = solve(scene, resolve_settings({}, scene));
    if (std::abs(*truth.signed_distance) < 1e-3 * size) continue;
    scene.query = Query::intersect;
    Method method;
    method.name = MethodName::gjk_boolean, method.scalar = Scalar::float_precision;
    EXPECT_EQ(solve(scene, resolve_settings(method, scene)).intersecting, truth.intersecting) << i;
    apart += !truth.intersecting;
  }
  EXPECT_GT(apart, 500);
}

/// A direction across an edge is of the third power of lengths, or the fifth, and an ellipsoid's support squares it: far from 1 the square was no number, or zero, the
/// support the ellipsoid's centre, and the bodies were called apart.
TEST(BooleanGjk, EllipsoidsOfLengthsFarFromOneInFloat) {
  RandomScenes random(23);
  int overlapping = 0;
  for (int i = 0; i < 2000; ++i) {
    const double size = i % 2 == 0 ? 5e4 : 3e-5;
    const auto vector = [&](double least, double most) { return AnyVector(Eigen::Vector3d(random.uniform(least, most), random.uniform(least, most), random.uniform(least, most)) * size); };
    Scene scene;
    Body ellipsoid{"", {Ellipsoid{vector(0.3, 1)}, 0}, identity_pose(3)}, box{"", {Box{vector(-1, -0.3), vector(0.3, 1), false}, 0}, identity_pose(3)};
    box.pose.position = vector(-1.3, 1.3);
    scene.bodies = {ellipsoid, box};
    scene.query = Query::penetration;
    const double right = *solve(scene, resolve_settings({}, scene)).signed_distance;
    if (std::abs(right) < 1e-2 * size) continue;
    scene.query = Query::intersect;
    Method method;
    method.name = MethodName::gjk_boolean, method.scalar = Scalar::float_precision;
    EXPECT_EQ(solve(scene, resolve_settings(method, scene)).intersecting, right < 0) << i << " " << right / size;
    overlapping += right < 0;
  }
  EXPECT_GT(overlapping, 200);
}

}  // namespace
}  // namespace gjkdbg
