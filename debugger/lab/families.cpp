#include "debugger/lab/families.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "debugger/lab/measure.h"

namespace gjkdbg {
namespace {

class Maker {
 public:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  AnyVector direction(int dimension) {
    std::normal_distribution<double> normal;
    AnyVector d(dimension);
    for (double& x : d) x = normal(random_);
    return d.normalized();
  }
  AnyMatrix rotation(int dimension) {
    if (dimension == 2) {
      const double t = uniform(0, 2 * std::numbers::pi);
      AnyMatrix m(2, 2);
      m << std::cos(t), -std::sin(t), std::sin(t), std::cos(t);
      return m;
    }
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(random_), normal(random_), normal(random_), normal(random_)).normalized().toRotationMatrix();
  }
  Shape box(int dimension = 3) {
    AnyVector half(dimension);
    for (double& x : half) x = uniform(0.4, 1);
    return {Box{-half, half, true}, 0};
  }
  Shape hull(int vertices) {
    PointSet set;
    for (int i = 0; i < vertices; ++i) set.points.push_back(direction(3));
    return {set, 0};
  }
  Shape curved() {
    switch (std::uniform_int_distribution<int>(0, 4)(random_)) {
      case 0: return {Sphere{uniform(0.4, 1)}, 0};
      case 1: return {Capsule{uniform(0.2, 0.5), uniform(0.3, 0.8), 1}, 0};
      case 2: return {Cylinder{uniform(0.4, 0.8), uniform(0.4, 0.8), 1}, 0};
      case 3: return {Cone{uniform(0.4, 0.8), uniform(0.4, 0.8), 1}, 0};
      default: return ellipsoid();
    }
  }
  Shape ellipsoid() { return {Ellipsoid{Eigen::Vector3d(uniform(0.3, 1), uniform(0.3, 1), uniform(0.3, 1))}, 0}; }

  /// Two bodies, placed along a random line so that the bodies' signed distance comes out near `gap` (a few corrections).
  Scene pair(const std::function<Shape()>& shape, double gap, int dimension = 3) {
    Scene scene;
    scene.dimension = dimension;
    for (const char* name : {"A", "B"}) {
      Body body{name, shape(), identity_pose(dimension)};
      body.pose.matrix = rotation(dimension);
      scene.bodies.push_back(body);
    }
    const AnyVector line = direction(dimension);
    double far = 3;
    for (int i = 0; i < 6; ++i) {
      scene.bodies[1].pose.position = far * line;
      far += gap - reference(scene).signed_distance;
      if (far < 0) far = 0.05;
    }
    scene.bodies[1].pose.position = far * line;
    return scene;
  }

 private:
  std::mt19937 random_{7};
};

}  // namespace

std::vector<ChartFamily> chart_families(int pairs) {
  Maker maker;
  std::vector<ChartFamily> families;
  const auto add = [&](const char* name, const char* title, const std::function<Shape()>& shape, double gap) {
    ChartFamily family{name, title, {}};
    for (int i = 0; i < pairs; ++i) family.scenes.push_back(maker.pair(shape, gap));
    families.push_back(std::move(family));
  };
  const auto box = [&] { return maker.box(); };
  const auto hull = [&] { return maker.hull(32); };
  const auto curved = [&] { return maker.curved(); };
  add("boxes-apart", "boxes, 0.5 apart", box, 0.5);
  add("boxes-shallow", "boxes, 0.02 deep", box, -0.02);
  add("boxes-deep", "boxes, 0.4 deep", box, -0.4);
  add("hulls-apart", "hulls of 32 vertices, 0.5 apart", hull, 0.5);
  add("hulls-deep", "hulls of 32 vertices, 0.3 deep", hull, -0.3);
  add("curved-apart", "round shapes mixed, 0.5 apart", curved, 0.5);
  add("curved-near", "round shapes mixed, 1e-4 apart", curved, 1e-4);
  add("curved-shallow", "round shapes mixed, 0.05 deep", curved, -0.05);
  add("ellipsoids-near", "ellipsoids, 1e-4 apart", [&] { return maker.ellipsoid(); }, 1e-4);
  return families;
}

std::vector<PriceRow> price_rows(int pairs) {
  std::vector<PriceRow> rows;
  Maker maker;
  std::vector<Scene> spheres, boxes, flat;
  for (int i = 0; i < pairs; ++i) spheres.push_back(maker.pair([&] { return Shape{Sphere{maker.uniform(0.5, 1)}, 0}; }, 0.3));
  for (int i = 0; i < pairs; ++i) boxes.push_back(maker.pair([&] { return maker.box(); }, i % 2 == 0 ? 0.3 : -0.1));
  for (int i = 0; i < pairs; ++i) flat.push_back(maker.pair([&] { return maker.box(2); }, 0.3, 2));
  rows.push_back({"spheres as centre and radius", spheres, Query::penetration});
  for (const int vertices : {42, 162, 642, 2562}) {
    std::vector<Scene> hulls = spheres;
    for (Scene& scene : hulls)
      for (Body& body : scene.bodies) {
        const double radius = std::get<Sphere>(body.shape.geometry).radius;
        PointSet set;
        // A Fibonacci lattice: evenly spread points on the sphere.
        for (int i = 0; i < vertices; ++i) {
          const double y = 1 - (2 * i + 1.0) / vertices, r = std::sqrt(1 - y * y), t = i * std::numbers::pi * (3 - std::sqrt(5.0));
          set.points.push_back(radius * Eigen::Vector3d(r * std::cos(t), y, r * std::sin(t)));
        }
        body.shape = {set, 0};
      }
    rows.push_back({"the same as hulls of " + std::to_string(vertices) + " vertices", hulls, Query::penetration});
  }
  rows.push_back({"rectangles in 2D", flat, Query::penetration});
  std::vector<Scene> slabs = flat;
  for (Scene& scene : slabs) {
    scene.dimension = 3;
    for (Body& body : scene.bodies) {
      const AnyVector half = std::get<Box>(body.shape.geometry).max;
      const Eigen::Vector3d h(half[0], half[1], 1);
      body.shape = {Box{-h, h, true}, 0};
      const AnyMatrix turn = body.pose.matrix;
      body.pose.matrix = AnyMatrix::Identity(3, 3);
      body.pose.matrix.topLeftCorner(2, 2) = turn;
      body.pose.position = Eigen::Vector3d(body.pose.position[0], body.pose.position[1], 0);
    }
  }
  rows.push_back({"the same as slabs in 3D", slabs, Query::penetration});
  rows.push_back({"boxes, yes or no", boxes, Query::intersect});
  rows.push_back({"boxes, distance", boxes, Query::distance});
  rows.push_back({"boxes, penetration", boxes, Query::penetration});
  return rows;
}

}  // namespace gjkdbg
