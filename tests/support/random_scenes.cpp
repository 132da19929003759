#include "tests/support/random_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shapes/convex.h"

namespace gjkdbg {

AnyVector RandomScenes::vector(int dimension, Family family, double size) {
  AnyVector v(dimension);
  for (double& x : v) x = family == Family::lattice ? integer(-3, 3) : uniform(-size, size);
  if (family == Family::slivers) v[integer(0, dimension - 1)] *= std::pow(10, uniform(-6, 0));
  return v;
}

double RandomScenes::length(Family family, double size) {
  if (family == Family::lattice) return integer(1, 6) / 2.0;
  return size * (family == Family::slivers ? std::pow(10, uniform(-6, 0)) : uniform(0.1, 1));
}

PointSet RandomScenes::points(int dimension, Family family, double size, int count) {
  PointSet set;
  for (int i = 0; i < count; ++i) set.points.push_back(vector(dimension, family, size));
  set.kind = count == 1 ? PointSetKind::point : count == 2 ? PointSetKind::segment : dimension == 2 ? PointSetKind::polygon : PointSetKind::hull;
  return set;
}

Shape RandomScenes::shape(int dimension, Family family, bool polytopes, double size) {
  if (dimension == 1) {
    const double x = family == Family::lattice ? integer(-3, 3) : uniform(-size, size);
    return {Box{AnyVector::Constant(1, x), AnyVector::Constant(1, x + length(family, size)), false}, integer(0, 3) == 0 ? length(family, size) : 0};
  }
  const double margin = integer(0, 9) == 0 ? length(family, size) / 4 : 0;
  const auto half_extents = [&] {
    AnyVector h(dimension);
    for (double& x : h) x = length(family, size);
    return h;
  };
  const int axis = integer(0, dimension - 1);
  switch (integer(0, polytopes ? 5 : dimension == 2 ? 6 : 8)) {
    case 0: return {Sphere{length(family, size)}, margin};
    case 1: {
      const AnyVector h = half_extents();
      return {Box{-h, h, true}, margin};
    }
    case 2: return {Capsule{length(family, size) / 2, length(family, size), axis}, 0};
    case 3: return {points(dimension, family, size, integer(4, 9)), margin};
    case 4: return {points(dimension, family, size, integer(1, 3)), margin};
    case 5: {
      auto first = std::make_shared<Shape>(Shape{points(dimension, family, size, 3), 0});
      auto second = std::make_shared<Shape>(Shape{points(dimension, family, size, 2), margin});
      return {Sum{first, second}, 0};
    }
    case 6: return {Ellipsoid{half_extents()}, margin};
    case 7: return {Cylinder{length(family, size), length(family, size), axis}, margin};
    default: return {Cone{length(family, size), length(family, size), axis}, margin};
  }
}

AnyMatrix RandomScenes::rotation(int dimension, Family family) {
  if (dimension == 1) return AnyMatrix::Identity(1, 1);
  if (dimension == 2) {
    const double angle = family == Family::lattice ? 0 : uniform(0, 6.3);
    AnyMatrix m(2, 2);
    m << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return m;
  }
  if (family != Family::lattice) {
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(random_), normal(random_), normal(random_), normal(random_)).normalized().toRotationMatrix();
  }
  std::array<int, 3> order{0, 1, 2};
  std::shuffle(order.begin(), order.end(), random_);
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) m(i, order[static_cast<std::size_t>(i)]) = integer(0, 1) == 0 ? 1 : -1;
  if (m.determinant() < 0) m.row(0) *= -1;
  return m;
}

Scene RandomScenes::scene(int dimension, Family family, bool polytopes) {
  Scene scene;
  scene.dimension = dimension;
  const double ratio = family == Family::ratio ? std::pow(10, uniform(-6, 6)) : 1;
  const double reach = uniform(0, 2) * std::max(1.0, ratio);
  const AnyVector far = family == Family::offset ? AnyVector(AnyVector::Constant(dimension, std::pow(10, uniform(0, 6)))) : AnyVector(AnyVector::Zero(dimension));
  for (int i = 0; i < 2; ++i) {
    Body body{i == 0 ? "A" : "B", shape(dimension, family, polytopes, i == 0 ? 1 : ratio), {}};
    body.pose.matrix = rotation(dimension, family);
    body.pose.position = far + vector(dimension, family == Family::lattice ? family : Family::general, reach);
    if (dimension > 1 && family != Family::lattice) {
      if (dimension == 3) body.pose.rotation = RotationMatrix{body.pose.matrix};
    }
    scene.bodies.push_back(body);
  }
  if (family == Family::identical) scene.bodies[1] = scene.bodies[0];
  return scene;
}

double size_of(const Scene& scene) {
  const double size = std::max(size_of(scene.bodies[0].shape), size_of(scene.bodies[1].shape));
  return size > 0 ? size : 1;
}

}  // namespace gjkdbg
