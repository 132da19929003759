#include "algo/motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "shapes/world_support.h"

namespace gjkdbg {

AnyMatrix rotation_by(const AnyVector& angular_velocity, double time, int dimension) {
  if (angular_velocity.size() == 0 || angular_velocity.isZero(0)) return AnyMatrix::Identity(dimension, dimension);
  if (dimension == 2) {
    const double angle = angular_velocity[0] * time;
    AnyMatrix r(2, 2);
    r << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return r;
  }
  const Eigen::Vector3d w = angular_velocity;
  return Eigen::AngleAxisd(w.norm() * time, w.stableNormalized()).toRotationMatrix();
}

std::vector<double> in_degrees(const AnyVector& radians) {
  std::vector<double> degrees;
  for (const double x : radians) degrees.push_back(x * 180 / M_PI);
  return degrees;
}

std::vector<double> orientation_of(const AnyMatrix& rotation) {
  if (rotation.rows() == 1) return {1, 0, 0, 0};
  if (rotation.rows() == 2) {
    const double half = to_plane_angle(rotation).angle / 2;
    return {std::cos(half), 0, 0, std::sin(half)};
  }
  const Quaternion q = to_quaternion(rotation);
  return {q.wxyz.begin(), q.wxyz.end()};
}

Body moved(const Body& body, double time, int dimension) {
  Body at = body;
  if (!body.motion || body.motion->is_static || time == 0) return at;
  at.pose.position += body.motion->velocity * time;
  if (body.motion->angular_velocity.size() == 0 || body.motion->angular_velocity.isZero(0)) return at;
  at.pose.matrix = rotation_by(body.motion->angular_velocity, time, dimension) * body.pose.matrix;
  at.pose.rotation = RotationMatrix{at.pose.matrix};
  return at;
}

std::vector<Shape> convex_parts(const Shape& shape) {
  const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
  if (!mesh) return {shape};
  std::vector<Shape> parts;
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i) parts.push_back(triangle_of(shape, i));
  return parts;
}

Shape triangle_of(const Shape& mesh, std::size_t number) {
  const Mesh& all = std::get<Mesh>(mesh.geometry);
  PointSet triangle{PointSetKind::triangle, {}, {}};
  for (const int corner : all.triangles[number]) triangle.points.push_back(all.points[static_cast<std::size_t>(corner)]);
  return {std::move(triangle), mesh.margin};
}

namespace {

template <int D>
double reach(const Shape& shape) {
  const Convex<D, double> convex(shape);
  return convex.reference().norm() + convex.extent() + convex.radius();
}

}  // namespace

double reach_of(const Shape& shape, int dimension) {
  if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
    double most = 0;
    for (const AnyVector& p : mesh->points) most = std::max(most, p.norm());
    return most + shape.margin;
  }
  return dimension == 1 ? reach<1>(shape) : dimension == 2 ? reach<2>(shape) : reach<3>(shape);
}

TurningBound turning_bound(const Body& body, const AnyVector& angular_velocity, const AnyVector& n, double reach) {
  if (angular_velocity.size() == 0 || angular_velocity.isZero(0)) return {};
  AnyVector across = n;
  if (n.size() == 2) across = Eigen::Vector2d(n[1], -n[0]) * angular_velocity[0];
  else across = Eigen::Vector3d(n).cross(Eigen::Vector3d(angular_velocity));
  const WorldSupport support(body, static_cast<int>(n.size()));
  return {across.dot(support(across, true) - body.pose.position), angular_velocity.squaredNorm() * reach};
}

Settings static_settings(const Settings& settings) {
  Settings s = settings;
  if (s.name >= MethodName::conservative_advancement) s.name = MethodName::gjk;
  s.tolerance = std::min(settings.tolerance, 1e-10);
  return s;
}

}  // namespace gjkdbg
