// Scenes of a rod, a cylinder, a cone, a capsule, a segment or a disc, with an ellipsoid or another rod.
#pragma once

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "shapes/scene.h"

namespace gjkdbg {

enum class RodKind { cylinder, cone, capsule, segment, disc };

/// Chosen by chance.
class RodScenes {
  using V3 = Eigen::Vector3d;

 public:
  explicit RodScenes(int seed) : random_(static_cast<unsigned>(seed)) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  V3 direction() {
    std::normal_distribution<double> normal;
    V3 x;
    for (double& part : x) part = normal(random_);
    return x.normalized();
  }

  static Body rod(RodKind kind, double radius, double half) {
    Body rod{"rod", {}, identity_pose(3)};
    if (kind == RodKind::cylinder) rod.shape.geometry = Cylinder{radius, half, 2};
    else if (kind == RodKind::cone) rod.shape.geometry = Cone{radius, half, 2};
    else if (kind == RodKind::capsule) rod.shape.geometry = Capsule{radius, half, 2};
    else if (kind == RodKind::segment) rod.shape.geometry = PointSet{PointSetKind::segment, {V3(0, 0, -half), V3(0, 0, half)}, ""};
    else rod.shape.geometry = Ellipsoid{AnyVector(V3(radius, radius, 0))};
    return rod;
  }
  static Body ellipsoid(const V3& radii) {
    Body round{"round", {}, identity_pose(3)};
    round.shape.geometry = Ellipsoid{AnyVector(radii)};
    return round;
  }

  /// The second turned by the tilt out of the first's third axis, and moved in any direction; both together turned in any way.
  Scene pair(Body first, Body second, double away, double tilt) {
    Scene scene;
    scene.dimension = 3, scene.query = Query::penetration;
    const V3 way = direction(), across(way[1], -way[0], 0);
    const Eigen::Matrix3d all = Eigen::AngleAxisd(uniform(0, 6), direction()).toRotationMatrix();
    place(first, all, V3::Zero()), place(second, all * Eigen::AngleAxisd(tilt, across.normalized()).toRotationMatrix(), away * direction());
    scene.bodies = {std::move(first), std::move(second)};
    return scene;
  }

 private:
  static void place(Body& body, const Eigen::Matrix3d& rotation, const V3& position) { body.pose.matrix = rotation, body.pose.rotation = RotationMatrix{rotation}, body.pose.position = position; }

  std::mt19937_64 random_;
};

}  // namespace gjkdbg
