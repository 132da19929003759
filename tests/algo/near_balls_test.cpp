// The depth of ellipsoids that are nearly balls, of ellipses that are nearly circles: against their heights along many directions, and which bodies are.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "algo/solve.h"
#include "recordings/check.h"
#include "recordings/recording.h"
#include "tests/support/heights.h"

namespace gjkdbg {
namespace {

/// Radii 1 and 0.5 or so, off by up to `unlike` of that, B's centre `away` from A's. Of every fourth B is a ball, every fifth has a margin.
Scene nearly_balls_scene(int k, int dimension, double unlike, double away) {
  std::mt19937 random(static_cast<unsigned>(k));
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  std::normal_distribution<double> normal;
  const auto any = [&] {
    AnyVector x(dimension);
    for (double& c : x) c = normal(random);
    return x;
  };
  Scene scene;
  scene.dimension = dimension, scene.query = Query::penetration;
  for (const double size : {1.0, 0.5}) {
    Body body{size == 1 ? "A" : "B", {}, identity_pose(dimension)};
    AnyVector radii(dimension);
    for (double& r : radii) r = size * (1 + unlike * uniform(random));
    if (size < 1 && k % 4 == 3) body.shape.geometry = Sphere{0.4};
    else body.shape.geometry = Ellipsoid{radii};
    if (k % 5 == 2) body.shape.margin = 0.1;
    const double angle = uniform(random) * 6;  // one after the other: compilers draw the arguments of a call in orders of their own
    if (dimension == 3) body.pose.matrix = Eigen::AngleAxisd(angle, Eigen::Vector3d(any()).normalized()).toRotationMatrix();
    else body.pose.matrix = Eigen::Rotation2Dd(angle).toRotationMatrix();
    body.pose.rotation = RotationMatrix{body.pose.matrix};
    scene.bodies.push_back(body);
  }
  scene.bodies[1].pose.position = away * any().normalized();
  return scene;
}

bool has_outline(const Recording& run) {
  return std::any_of(run.events.begin(), run.events.end(), [](const Event& e) { return std::holds_alternative<recorded::SatBegan>(e); });
}

TEST(NearBalls, AreAsDeepAsTheLeastHeightSays) {
  int looked_along = 0, most = 0, supports = 0;
  for (int k = 0; k < 240; ++k) {
    const int dimension = k % 3 == 0 ? 2 : 3;
    const double unlike = std::pow(10, -0.7 - k % 10), away = k % 7 == 0 ? 0 : std::pow(10, -1 - k % 6);
    const Scene scene = nearly_balls_scene(k, dimension, unlike, away);
    SceneFile file;
    file.scene = scene;
    const Recording run = record(file);
    const Result& r = run.result;
    const Heights heights(scene);
    ASSERT_TRUE(r.signed_distance && r.normal) << k;
    EXPECT_EQ(r.status, StatusWord("overlapping")) << k;
    EXPECT_LE(*r.upper_bound - *r.lower_bound, 1e-10) << k;
    EXPECT_NEAR(heights.along(*r.normal), -*r.signed_distance, 1e-13) << k;
    EXPECT_NEAR((*r.witness_a - *r.witness_b + *r.normal * *r.signed_distance).norm(), 0, 1e-10) << k;
    std::mt19937 random(static_cast<unsigned>(k));
    std::normal_distribution<double> normal;
    for (int i = 0; i < 12; ++i) {
      AnyVector n(dimension);
      for (double& c : n) c = normal(random);
      EXPECT_GE(heights.below(n.normalized()), -*r.upper_bound) << k;
    }
    EXPECT_TRUE(check(run).empty()) << k << ": " << check(run)[0].message;
    looked_along += has_outline(run), most = std::max(most, r.support_calls), supports += r.support_calls;
  }
  EXPECT_EQ(looked_along, 240);
  EXPECT_LT(most, 400);  // EPA came to its limit, 512: nearly spheroids take the most
  EXPECT_LT(supports, 240 * 60);
}

TEST(NearBalls, InSinglePrecision) {
  for (int k = 0; k < 60; ++k) {
    SceneFile file;
    file.scene = nearly_balls_scene(k, k % 2 == 0 ? 2 : 3, std::pow(10, -1 - k % 7), k % 3 == 0 ? 0 : 0.05);
    const double exact = *record(file).result.signed_distance;
    file.method.scalar = Scalar::float_precision;
    const Recording run = record(file);
    EXPECT_NEAR(*run.result.signed_distance, exact, 2e-5) << k;
    EXPECT_TRUE(check(run).empty()) << k << ": " << check(run)[0].message;
  }
}

/// What is long or flat has a rest that is most of it: EPA looks at the whole. So does a query that asks for no depth, or for MPR's.
TEST(NearBalls, OthersAreNot) {
  SceneFile file;
  file.scene = nearly_balls_scene(1, 3, 0.1, 0.1);
  EXPECT_TRUE(has_outline(record(file)));
  SceneFile other = file;
  other.scene.query = Query::distance;
  EXPECT_FALSE(has_outline(record(other)));
  other = file, other.method.penetration = Penetration::mpr;
  EXPECT_FALSE(has_outline(record(other)));
  other = file, other.scene.bodies[0].shape.geometry = Ellipsoid{AnyVector(Eigen::Vector3d(2, 1, 0.9))};
  EXPECT_FALSE(has_outline(record(other)));
  other = file, other.scene.bodies[0].shape.geometry = Box{AnyVector(Eigen::Vector3d(-1, -1, -1)), AnyVector(Eigen::Vector3d(1, 1, 1))};
  EXPECT_FALSE(has_outline(record(other)));
}

/// Three iterations are not enough for GJK and EPA on the rests: EPA follows, and neither claims to have come to the end.
TEST(NearBalls, SayWhereTheLimitIsReached) {
  SceneFile file;
  file.scene = nearly_balls_scene(1, 3, 0.2, 0);
  file.method.max_iterations = 3;
  const Recording run = record(file);
  EXPECT_TRUE(has_outline(run));
  EXPECT_EQ(run.result.status, StatusWord("iteration_limit"));
  EXPECT_TRUE(check(run).empty()) << check(run)[0].message;
}

}  // namespace
}  // namespace gjkdbg
