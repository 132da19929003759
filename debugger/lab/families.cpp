#include "debugger/lab/families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "algo/prepared_pair.h"
#include "debugger/lab/measure.h"
#include "shapes/error.h"

namespace gjkdbg {
namespace {

class Maker {
 public:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  AnyVector direction(int dimension) {
    std::normal_distribution<double> normal;
    AnyVector d(dimension);
    double squared = 0;
    for (double& x : d) x = normal(random_), squared += x * x;
    for (double& x : d) x /= std::sqrt(squared);
    return d;
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
  /// Radii of mean 0.1 and deviation 0.025: nearly balls.
  Shape roundish() {
    std::normal_distribution<double> radius(0.1, 0.025);
    const auto positive = [&] { return std::max(0.01, radius(random_)); };
    return {Ellipsoid{Eigen::Vector3d(positive(), positive(), positive())}, 0};
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
    const auto pair = prepare(scene.bodies[0], scene.bodies[1], dimension, Scalar::double_precision);
    const Settings exact = resolve_settings(reference_method(), scene);
    double far = 3;
    for (int i = 0; i < 6; ++i) {
      scene.bodies[1].pose.position = far * line;
      pair->place(scene.bodies[0].pose, scene.bodies[1].pose);
      far += gap - *pair->run(exact, Query::penetration).signed_distance;
      if (far < 0) far = 0.05;
    }
    scene.bodies[1].pose.position = far * line;
    return scene;
  }

 private:
  std::mt19937 random_{7};
};

/// One family: what makes a pair of it.
struct Recipe {
  const char *name, *title;
  double gap;
  Shape (*shape)(Maker&);
  int dimension = 3;
  void (*change)(Maker&, Scene&) = nullptr;  ///< after placing
};

Shape regular(int corners, Maker& maker) {
  PointSet set;
  const double radius = maker.uniform(0.5, 1), turn = maker.uniform(0, 1);
  for (int i = 0; i < corners; ++i) {
    const double t = 2 * std::numbers::pi * (i + turn) / corners;
    set.points.push_back(Eigen::Vector2d(radius * std::cos(t), radius * std::sin(t)));
  }
  return {set, 0};
}

/// Two boxes face on face, the same way round, 1e-9 apart or deep.
void face_to_face(Maker& maker, Scene& scene) {
  const Eigen::Matrix3d turn = maker.rotation(3);
  double reach = 0;
  for (Body& body : scene.bodies) body.pose.matrix = turn, reach += std::get<Box>(body.shape.geometry).max[0];
  const double side = maker.uniform(-0.2, 0.2), gap = maker.uniform(-1, 1) > 0 ? 1e-9 : -1e-9;
  scene.bodies[0].pose.position = Eigen::Vector3d(0, 0, 0);
  scene.bodies[1].pose.position = Eigen::Vector3d(turn * Eigen::Vector3d(reach + gap, side, -side));
}

void far_out(Maker& maker, Scene& scene) {
  const Eigen::Vector3d offset = 1e5 * maker.direction(3);
  for (Body& body : scene.bodies)
    for (int i = 0; i < 3; ++i) body.pose.position[i] += offset[i];
}

Shape capsule(Maker& maker) { return {Capsule{maker.uniform(0.2, 0.5), maker.uniform(0.3, 1), 1}, 0}; }
Shape sliver(Maker& maker) {
  const AnyVector half = Eigen::Vector3d(1, 1, 1e-4).cwiseProduct(Eigen::Vector3d(maker.uniform(0.4, 1), maker.uniform(0.4, 1), 1));
  return {Box{-half, half, true}, 0};
}
Shape ratio(Maker& maker) {
  Shape box = maker.box();
  if (maker.uniform(0, 1) < 0.5) return box;
  Box& b = std::get<Box>(box.geometry);
  b.min *= 1e-4, b.max *= 1e-4;
  return box;
}
template <int vertices>
Shape hull(Maker& maker) { return maker.hull(vertices); }
template <int corners>
Shape polygon(Maker& maker) { return regular(corners, maker); }
Shape box(Maker& maker) { return maker.box(); }
Shape rectangle(Maker& maker) { return maker.box(2); }
Shape curved(Maker& maker) { return maker.curved(); }
Shape ellipsoid(Maker& maker) { return maker.ellipsoid(); }

constexpr Recipe recipes[] = {
    {"boxes-apart", "boxes, 0.5 apart", 0.5, box},
    {"boxes-shallow", "boxes, 0.02 deep", -0.02, box},
    {"boxes-deep", "boxes, 0.4 deep", -0.4, box},
    {"hulls-apart", "hulls of 32 vertices, 0.5 apart", 0.5, hull<32>},
    {"hulls-deep", "hulls of 32 vertices, 0.3 deep", -0.3, hull<32>},
    {"curved-apart", "round shapes mixed, 0.5 apart", 0.5, curved},
    {"curved-near", "round shapes mixed, 1e-4 apart", 1e-4, curved},
    {"curved-shallow", "round shapes mixed, 0.05 deep", -0.05, curved},
    {"ellipsoids-near", "ellipsoids, 1e-4 apart", 1e-4, ellipsoid},
    {"capsules-apart", "capsules, 0.5 apart", 0.5, capsule},
    {"capsules-overlap", "capsules, 0.1 deep", -0.1, capsule},
    {"hulls128-apart", "hulls of 128 vertices, 0.5 apart", 0.5, hull<128>},
    {"hulls128-deep", "hulls of 128 vertices, 0.3 deep", -0.3, hull<128>},
    {"hulls1000-apart", "hulls of 1,000 vertices, 0.5 apart", 0.5, hull<1000>},
    {"hulls1000-deep", "hulls of 1,000 vertices, 0.3 deep", -0.3, hull<1000>},
    {"faces-touching", "boxes face to face, 1e-9 apart or deep", 0, box, 3, face_to_face},
    {"slivers", "plates 1e4 times as wide as thick, 0.01 apart", 0.01, sliver},
    {"size-ratio", "boxes, some 1e4 times as small, 0.01 apart", 0.01, ratio},
    {"offset-1e5", "boxes 0.02 deep, 1e5 from the origin", -0.02, box, 3, far_out},
    {"rectangles-2d", "rectangles in 2D, 0.3 apart", 0.3, rectangle, 2},
    {"octagons-2d", "octagons in 2D, 0.3 apart", 0.3, polygon<8>, 2},
};
constexpr std::size_t charted = 9;  ///< of a chart when none are named

std::vector<Scene> pairs_of(const Recipe& recipe, int pairs) {
  Maker maker;
  std::vector<Scene> out;
  for (int i = 0; i < pairs; ++i) {
    out.push_back(maker.pair([&] { return recipe.shape(maker); }, recipe.gap, recipe.dimension));
    if (recipe.change) recipe.change(maker, out.back());
  }
  return out;
}

/// An icosahedron whose triangles are cut into four until there are so many vertices, 10 * 4^k + 2, all of them on the unit sphere.
std::vector<Eigen::Vector3d> icosphere(int vertices) {
  std::vector<Eigen::Vector3d> points;
  for (const int axis : {0, 1, 2})
    for (const double one : {-1.0, 1.0})
      for (const double golden : {-std::numbers::phi, std::numbers::phi}) {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        p[(axis + 1) % 3] = one, p[(axis + 2) % 3] = golden;
        points.push_back(p.normalized());
      }
  const double edge = 4 / (1 + std::numbers::phi * std::numbers::phi);  // squared: 2 / sqrt(1 + phi^2) long
  std::vector<std::array<int, 3>> triangles;
  const auto beside = [&](int i, int j) { return std::abs((points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(j)]).squaredNorm() - edge) < 1e-9; };
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int k = j + 1; k < 12; ++k)
        if (beside(i, j) && beside(j, k) && beside(k, i)) triangles.push_back({i, j, k});
  while (static_cast<int>(points.size()) < vertices) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [at, added] = middles.try_emplace(std::minmax(i, j), static_cast<int>(points.size()));
      if (added) points.push_back((points[static_cast<std::size_t>(i)] + points[static_cast<std::size_t>(j)]).normalized());
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [i, j, k] : triangles) {
      const int ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
      for (const auto& t : {std::array{i, ij, ki}, {j, jk, ij}, {k, ki, jk}, {ij, jk, ki}}) finer.push_back(t);
    }
    triangles = std::move(finer);
  }
  return points;
}

}  // namespace

std::vector<std::string> chart_family_names() {
  std::vector<std::string> names;
  for (const Recipe& recipe : recipes) names.emplace_back(recipe.name);
  return names;
}

std::vector<ChartFamily> chart_families(int pairs, const std::vector<std::string>& names) {
  const auto known = chart_family_names();
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      std::string all;
      for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
      throw Error("no-such-family", "no family has this name; there are " + all, name);
    }
  std::vector<ChartFamily> families;
  for (std::size_t i = 0; i < std::size(recipes); ++i) {
    const Recipe& recipe = recipes[i];
    const bool chosen = names.empty() ? i < charted : std::find(names.begin(), names.end(), recipe.name) != names.end();
    if (chosen) families.push_back({recipe.name, recipe.title, pairs_of(recipe, pairs)});
  }
  return families;
}

std::vector<Scene> hull_pairs(int pairs, int vertices, double gap) {
  Maker maker;
  std::vector<Scene> out;
  for (int i = 0; i < pairs; ++i) out.push_back(maker.pair([&] { return maker.hull(vertices); }, gap));
  return out;
}

std::vector<Scene> ladder_ellipsoids(int pairs, double gap) {
  Maker maker;
  std::vector<Scene> out;
  for (int i = 0; i < pairs; ++i) out.push_back(maker.pair([&] { return maker.roundish(); }, gap));
  return out;
}

std::vector<PriceRow> price_rows(int pairs) {
  std::vector<PriceRow> rows;
  Maker maker;
  std::vector<Scene> spheres, boxes, flat;
  for (int i = 0; i < pairs; ++i) spheres.push_back(maker.pair([&] { return Shape{Sphere{maker.uniform(0.5, 1)}, 0}; }, 0.3));
  for (int i = 0; i < pairs; ++i) boxes.push_back(maker.pair([&] { return maker.box(); }, i % 2 == 0 ? 0.3 : -0.1));
  for (int i = 0; i < pairs; ++i) flat.push_back(maker.pair([&] { return maker.box(2); }, 0.3, 2));
  rows.push_back({"spheres as centre and radius", spheres, Query::penetration});
  for (const int vertices : {42, 162, 642, 2562, 10242}) {
    const std::vector<Eigen::Vector3d> points = icosphere(vertices);
    // Of the largest hull a few pairs do: most of the time would go into making it ready.
    std::vector<Scene> hulls(spheres.begin(), spheres.begin() + (vertices > 10000 ? std::min(pairs, 20) : pairs));
    for (Scene& scene : hulls)
      for (Body& body : scene.bodies) {
        const double radius = std::get<Sphere>(body.shape.geometry).radius;
        PointSet set;
        for (const Eigen::Vector3d& p : points) set.points.push_back(radius * p);
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
