#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "algo/solve.h"

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

}  // namespace
}  // namespace gjkdbg
