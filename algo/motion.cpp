#include "algo/motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

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
  for (const double x : radians) degrees.push_back(x * 180 / std::numbers::pi);
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
double reach(const Shape& shape, double scale, const Eigen::Vector3d& place) {
  const Convex<D, double> convex(shape, scale);
  return (convex.reference() - place.head<D>()).norm() + convex.extent() + convex.radius();
}

double scaled_reach(const Shape& shape, int dimension, double scale, const Eigen::Vector3d& place) {
  const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
  const PointSet* set = std::get_if<PointSet>(&shape.geometry);
  if (mesh || set) {
    double most = 0;
    for (const AnyVector& p : mesh ? mesh->points : set->points) most = std::max(most, (in_space(p) * scale - place).norm());
    return most + shape.margin * scale;
  }
  return dimension == 1 ? reach<1>(shape, scale, place) : dimension == 2 ? reach<2>(shape, scale, place) : reach<3>(shape, scale, place);
}

}  // namespace

/// At a size near 1, by a power of two, which rounds nothing: squares of lengths below 1e-162 vanish.
double reach_of(const Shape& shape, int dimension, const Eigen::Vector3d& place) {
  const double size = size_of(shape), scale = size > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000)) : 1;
  return scaled_reach(shape, dimension, scale, place * scale) / scale;
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
