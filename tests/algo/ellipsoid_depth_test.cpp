// What the bends of ellipsoids say: that no height is below, along many directions; and the depths that come of it, of ellipsoids that EPA gives up on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "algo/height_model.h"
#include "algo/solve.h"
#include "recordings/check.h"
#include "recordings/recording.h"
#include "tests/support/has_event.h"
#include "tests/support/heights.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

using Geometry = decltype(Shape::geometry);

class BentScenes {
 public:
  explicit BentScenes(int seed) : random_(static_cast<unsigned>(seed)) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  AnyVector direction(int dimension) {
    AnyVector x(dimension);
    for (double& c : x) c = std::normal_distribution<double>()(random_);
    return x.normalized();
  }
  Eigen::MatrixXd turned(int dimension, double angle) {
    const AnyVector axis = direction(3);
    if (dimension == 2) return Eigen::Rotation2Dd(angle).toRotationMatrix();
    return Eigen::AngleAxisd(angle, Eigen::Vector3d(axis)).toRotationMatrix();
  }
  /// Of two shapes, the second `away` from the first and turned by `angle`.
  Scene pair(int dimension, const Geometry& a, const Geometry& b, double away, double angle) {
    Scene scene;
    scene.dimension = dimension, scene.query = Query::penetration;
    for (const Geometry* geometry : {&a, &b}) {
      Body body{geometry == &a ? "A" : "B", {}, identity_pose(dimension)};
      body.shape.geometry = *geometry;
      scene.bodies.push_back(body);
    }
    Pose& pose = scene.bodies[1].pose;
    pose.matrix = turned(dimension, angle), pose.rotation = RotationMatrix{pose.matrix}, pose.position = away * direction(dimension);
    return scene;
  }

 private:
  std::mt19937_64 random_;
};

template <int D>
void expect_no_height_below(BentScenes& random, const Scene& scene) {
  const Convex<D, double> a(scene.bodies[0].shape, 1), b(scene.bodies[1].shape, 1);
  MinkowskiDifference<D, double, Convex<D, double>> difference(a, b, scene.bodies[0].pose, scene.bodies[1].pose, 1);
  const auto pair = BentPair<D, double>::of(difference);
  ASSERT_TRUE(pair);
  for (int i = 0; i < 20; ++i) {
    const Vector<D, double> d = random.direction(D);
    const HeightModel<D, double> model = pair->model(d, difference.support(d));
    for (int k = 0; k < 20; ++k) {
      const Vector<D, double> n = (d + std::pow(10, random.uniform(-3, 1)) * random.direction(D)).normalized();
      EXPECT_LE(model.least_within(model.reach((n - d).norm())), n.dot(difference.support(n).w) + 1e-13);
    }
    std::array<Vector<D, double>, D> corners;  // of a polygon that need not hold d, nor be small, nor lie on the same side
    const Vector<D, double> about = i % 4 == 0 ? Vector<D, double>(-d) : i % 4 == 1 ? Vector<D, double>(random.direction(D)) : d;
    for (auto& corner : corners) corner = (about + std::pow(10, random.uniform(-3, -0.01)) * random.direction(D)).normalized();
    const double least = model.least_within(model.reach(corners));
    for (int k = 0; k < 20; ++k) {
      Vector<D, double> within = Vector<D, double>::Zero();
      for (const auto& corner : corners) within += random.uniform(0, 1) * corner;
      const Vector<D, double> n = within.normalized();
      EXPECT_LE(least, n.dot(difference.support(n).w) + 1e-13);
    }
  }
}

TEST(HeightModel, NoHeightIsBelowIt) {
  BentScenes random(1);
  const auto radii = [&](int dimension) {
    AnyVector r(dimension);
    for (double& x : r) x = std::pow(10, random.uniform(-1.5, 0));
    if (dimension == 3 && random.uniform(0, 1) < 0.5) r[1] = r[0];
    return Ellipsoid{r};
  };
  for (int k = 0; k < pairs_asked(1500); ++k) {
    const int dimension = k % 3 == 0 ? 2 : 3;
    const Geometry ball = Sphere{0.3}, a = radii(dimension), other = k % 5 == 1 ? ball : radii(dimension);
    const bool first = k % 2 == 0;
    const Scene scene = random.pair(dimension, first ? a : other, first ? other : a, k % 4 == 0 ? 0 : random.uniform(0, 1), random.uniform(0, 6));
    if (dimension == 2) expect_no_height_below<2>(random, scene);
    else expect_no_height_below<3>(random, scene);
  }
}

/// At the end of the shortest axis of both, and about one middle, a bound that knew no bends would lose h chord^2 / 2. Half of all directions are no farther than that chord.
TEST(HeightModel, LosesNothingWhereTheHeightIsLeast) {
  BentScenes random(2);
  const Ellipsoid flat{AnyVector(Eigen::Vector3d(1, 0.9, 0.5))};
  const Scene scene = random.pair(3, flat, flat, 0, 0);
  const Convex<3, double> body(scene.bodies[0].shape, 1);
  MinkowskiDifference<3, double, Convex<3, double>> difference(body, body, scene.bodies[0].pose, scene.bodies[1].pose, 1);
  const Eigen::Vector3d d = Eigen::Vector3d::UnitZ();
  const HeightModel<3, double> model = BentPair<3, double>::of(difference)->model(d, difference.support(d));
  EXPECT_NEAR(model.height(), 1, 1e-15);
  EXPECT_NEAR(model.slope(), 0, 1e-15);
  EXPECT_NEAR(model.least_within(model.reach(0.3)), 1, 1e-15);
}

/// From the nearest pole of what is nearly a ball, beside the origin, the heights rise to the other pole. Of all directions the bound is the nearest one's, as it was not where the slope was zero to the last bit.
TEST(HeightModel, KnowsTheWholeSphere) {
  BentScenes random(7);
  const Scene scene = random.pair(3, Ellipsoid{AnyVector(Eigen::Vector3d(1, 1, 0.9))}, Sphere{0.1}, 0, 0);
  const Convex<3, double> a(scene.bodies[0].shape, 1), b(scene.bodies[1].shape, 1);
  Pose beside = scene.bodies[1].pose;
  beside.position = Eigen::Vector3d(0, 0, 0.5);
  MinkowskiDifference<3, double, Convex<3, double>> difference(a, b, scene.bodies[0].pose, beside, 1);
  const Eigen::Vector3d d = Eigen::Vector3d::UnitZ();
  const HeightModel<3, double> model = BentPair<3, double>::of(difference)->model(d, difference.support(d));
  EXPECT_EQ(model.height(), 0.9 - 0.5);
  EXPECT_EQ(model.slope(), 0);
  EXPECT_LE(model.least_within(model.reach(2.0)), 0.9 - 0.5);
}

/// Newton's step of an ellipsoid and a point beside its middle leads to the least height, each time squaring what is missing.
TEST(HeightModel, ItsStepsLeadToTheLeastHeight) {
  BentScenes random(3);
  const Scene scene = random.pair(3, Ellipsoid{AnyVector(Eigen::Vector3d(1, 0.8, 0.5))}, Sphere{0.1}, 0.1, 0);
  const Convex<3, double> a(scene.bodies[0].shape, 1), b(scene.bodies[1].shape, 1);
  MinkowskiDifference<3, double, Convex<3, double>> difference(a, b, scene.bodies[0].pose, scene.bodies[1].pose, 1);
  const auto bodies = BentPair<3, double>::of(difference);
  const auto at = [&](const Eigen::Vector3d& n) { return bodies->model(n, difference.support(n)); };
  HeightModel<3, double> model = at(Eigen::Vector3d(0.3, 0.2, scene.bodies[1].pose.position[2] > 0 ? 1 : -1).normalized());
  for (int i = 0; i < 6; ++i) model = at(model.step_down(1));
  EXPECT_LT(model.slope(), 1e-14);
}

/// Spheroids but for a little, turned against one another by a little or by much, about one middle or beside it: all that EPA gave up on, with bounds up to 1e-3 apart.
Scene nearly_spheroids(BentScenes& random, int k) {
  const auto one = [&] {
    const double waist = random.uniform(0.3, 0.6), unlike = k % 3 == 0 ? 0 : std::pow(10, random.uniform(-6, -1));
    return Ellipsoid{AnyVector(Eigen::Vector3d(waist, waist * (1 + unlike), waist * random.uniform(1.7, 3)))};
  };
  const Geometry a = one(), b = k % 4 == 3 ? Geometry(Sphere{0.2}) : one();
  return random.pair(3, a, b, k % 2 == 0 ? 0 : std::pow(10, random.uniform(-6, -1)), std::pow(10, random.uniform(-6, 0)));
}

TEST(EllipsoidDepth, IsAsDeepAsTheLeastHeightSays) {
  BentScenes random(4);
  int instead = 0, after = 0, most = 0;
  for (int k = 0; k < 160; ++k) {
    SceneFile file;
    file.scene = nearly_spheroids(random, k);
    if (k % 7 == 2) file.scene.bodies[0].shape.margin = 0.1;
    const Recording run = record(file);
    const Result& r = run.result;
    const Heights heights(file.scene);
    ASSERT_TRUE(r.signed_distance && r.normal) << k;
    EXPECT_NE(r.status, StatusWord("iteration_limit")) << k;
    EXPECT_LE(*r.upper_bound - *r.lower_bound, 2e-10 * -*r.signed_distance) << k;
    EXPECT_NEAR((*r.witness_a - *r.witness_b + *r.normal * *r.signed_distance).norm(), 0, 1e-9) << k;
    for (int i = 0; i < 12; ++i) EXPECT_GE(heights.below(random.direction(3)), -*r.upper_bound - 1e-13) << k;
    if (k % 20 == 5) { EXPECT_TRUE(check(run).empty()) << k << ": " << check(run)[0].message; }  // it looks at 512 polytopes
    const bool sat = has_event(run, "sat_began");
    instead += sat && !has_event(run, "epa_ended"), after += sat && has_event(run, "epa_ended"), most = std::max(most, r.support_calls);
  }
  EXPECT_GT(instead, 40);
  EXPECT_GT(after, 40);
  EXPECT_LT(most, 512 + 3000);
}

TEST(EllipsoidDepth, InSinglePrecision) {
  BentScenes random(5);
  for (int k = 0; k < 60; ++k) {
    SceneFile file;
    file.scene = nearly_spheroids(random, k);
    const double exact = *record(file).result.signed_distance;
    file.method.scalar = Scalar::float_precision;
    const Recording run = record(file);
    EXPECT_NEAR(*run.result.signed_distance, exact, 2e-5) << k;
    if (k % 20 == 5) { EXPECT_TRUE(check(run).empty()) << k << ": " << check(run)[0].message; }
  }
}

/// Who gives EPA few steps sees it end there, and an ellipsoid of no thickness bends in no way that could be told.
TEST(EllipsoidDepth, LeavesTheRestToEpa) {
  BentScenes random(6);
  const Ellipsoid leaf{AnyVector(Eigen::Vector3d(1, 0.9, 1e-4))}, egg{AnyVector(Eigen::Vector3d(0.5, 0.500001, 1))};
  SceneFile file;
  file.scene = random.pair(3, egg, egg, 0, 0.4), file.method.max_iterations = 64;
  EXPECT_EQ(record(file).result.status, StatusWord("iteration_limit"));
  EXPECT_FALSE(has_event(record(file), "sat_began"));
  file.method.max_iterations = 512;
  EXPECT_EQ(record(file).result.status, StatusWord("overlapping"));
  EXPECT_TRUE(has_event(record(file), "sat_began"));
  file.scene = random.pair(3, leaf, egg, 0.1, 0.4);
  EXPECT_FALSE(has_event(record(file), "sat_began"));
}

}  // namespace
}  // namespace gjkdbg
