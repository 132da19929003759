// What is said of the heights of an ellipsoid and a rod: that none is below it, along many directions; and the depths that come of it, of pairs that EPA gives up on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "algo/bent_sum.h"
#include "algo/solve.h"
#include "recordings/check.h"
#include "recordings/check_context.h"
#include "recordings/recording.h"
#include "tests/support/has_event.h"
#include "tests/support/heights.h"
#include "tests/support/heights_about.h"
#include "tests/support/random_scenes.h"
#include "tests/support/rod_scenes.h"

namespace gjkdbg {
namespace {

using V3 = Eigen::Vector3d;

/// An ellipsoid, and a rod, the one or the other first.
Scene ellipsoid_and_rod(RodScenes& random, int k, const V3& radii, RodKind kind, double away, double tilt) {
  const double radius = random.uniform(0.2, 1), half = std::pow(10, random.uniform(-3, 0.3));
  Body round = RodScenes::ellipsoid(radii), rod = RodScenes::rod(kind, radius, half);
  if (k % 7 == 2) round.shape.margin = 0.1;
  Scene scene = random.pair(std::move(round), std::move(rod), away, tilt);
  if (k % 2 == 0) std::swap(scene.bodies[0], scene.bodies[1]);
  return scene;
}

/// About directions anywhere, along the rod's axis or nearly, and on the fold.
V3 special(RodScenes& random, const BentSum<double>& pair, int i) {
  const auto& rod = pair.parts.rods[0].rod;
  const V3 d = random.direction(), axis = rod.shape.axis, across = (d - axis * axis.dot(d)).normalized();
  if (i % 5 == 1) return axis * (d[0] > 0 ? 1 : -1);
  if (i % 5 == 2) return (axis + std::pow(10, random.uniform(-5, -1)) * across).normalized();
  if (i % 5 < 2) return d;
  return (rod.fold_cos * across + (rod.fold_sin + (i % 5 == 4 ? std::pow(10, random.uniform(-5, -1)) : 0)) * axis).normalized();
}

TEST(RodHeights, NoHeightIsBelowIt) {
  RodScenes random(1);
  for (int k = 0; k < pairs_asked(1500); ++k) {
    V3 radii;
    for (double& r : radii) r = std::pow(10, random.uniform(-1, 0));
    const double away = k % 4 == 0 ? 0 : random.uniform(0, 1), tilt = random.uniform(0, 3);
    const Scene scene = ellipsoid_and_rod(random, k, radii, static_cast<RodKind>(k % 5), away, tilt);
    const Convex<3, double> a(scene.bodies[0].shape, 1), b(scene.bodies[1].shape, 1);
    MinkowskiDifference<3, double, Convex<3, double>> difference(a, b, scene.bodies[0].pose, scene.bodies[1].pose, 1);
    const auto pair = BentSum<double>::of(difference);
    ASSERT_TRUE(pair) << k;
    for (int i = 0; i < 20; ++i) {
      const V3 d = special(random, *pair, i);
      const auto point = difference.support(d);
      const auto heights = pair->model(d, point);
      EXPECT_EQ(heights.height(), d.dot(point.w));
      expect_none_below(random, heights, difference, i % 6 == 0 ? random.direction() : d, std::to_string(k) + ", " + std::to_string(i));
    }
  }
}

/// Two bodies about one middle, the ellipsoid the flatter one where they are nearest: both bend less along the rod's side than a ball about the origin, so only what the fold says closes the bounds.
TEST(RodHeights, LoseNothingAcrossTheFold) {
  RodScenes random(2);
  for (const RodKind kind : {RodKind::cylinder, RodKind::capsule, RodKind::segment}) {
    const Scene scene = ellipsoid_and_rod(random, 1, V3(0.8, 0.8, 0.7), kind, 0, 0);
    const Convex<3, double> a(scene.bodies[0].shape, 1), b(scene.bodies[1].shape, 1);
    MinkowskiDifference<3, double, Convex<3, double>> difference(a, b, scene.bodies[0].pose, scene.bodies[1].pose, 1);
    const auto pair = BentSum<double>::of(difference);
    ASSERT_TRUE(pair);
    const V3 axis = pair->parts.rods[0].rod.shape.axis, d = axis.unitOrthogonal(), beside = axis.cross(d);
    const double half = std::min(0.05, pair->parts.rods[0].rod.shape.half);
    const std::array<V3, 4> corners{(d + half * axis + 0.2 * beside).normalized(), (d + half * axis - 0.2 * beside).normalized(), (d - half * axis + 0.2 * beside).normalized(), (d - half * axis - 0.2 * beside).normalized()};
    const auto heights = pair->model(d, difference.support(d));
    EXPECT_NEAR(heights.least_among(corners), heights.height(), 1e-13);
    EXPECT_NEAR(heights.slope(), 0, 1e-14);
  }
}

/// About one middle, or beside it, a rod in what is a spheroid but for a little: of most of these EPA came to its limit, with bounds up to 6e-4 of the depth apart.
Scene in_nearly_a_spheroid(RodScenes& random, int k) {
  const double waist = random.uniform(0.3, 1.5), unlike = k % 4 == 0 ? 0 : std::pow(10, random.uniform(-4, -1));
  const double away = k % 2 == 0 ? 0 : std::pow(10, random.uniform(-6, -1)), tilt = k % 3 == 0 ? 0 : std::pow(10, random.uniform(-6, -0.3));
  return ellipsoid_and_rod(random, k, V3(waist, waist * (1 + unlike), random.uniform(0.3, 2)), static_cast<RodKind>(k % 5), away, tilt);
}

TEST(RodHeights, TellTheDepthOfWhatEpaGaveUpOn) {
  RodScenes random(3);
  int after = 0, most = 0;
  for (int k = 0; k < pairs_asked(200); ++k) {
    SceneFile file;
    file.scene = in_nearly_a_spheroid(random, k);
    const Recording run = record(file);
    const Result& r = run.result;
    const Heights heights(file.scene);
    ASSERT_TRUE(r.signed_distance && r.normal) << k;
    EXPECT_NE(r.status, StatusWord("iteration_limit")) << k;
    EXPECT_LE(*r.upper_bound - *r.lower_bound, 2e-10 * -*r.signed_distance) << k;
    EXPECT_NEAR((*r.witness_a - *r.witness_b + *r.normal * *r.signed_distance).norm(), 0, 1e-9) << k;
    for (int i = 0; i < 12; ++i) EXPECT_GE(heights.below(random.direction()), -*r.upper_bound - 1e-13) << k;
    const bool bends = has_event(run, "sat_began") && has_event(run, "epa_ended");
    EXPECT_LE(outside(file.scene, std::size_t{0}, *r.witness_a) + outside(file.scene, std::size_t{1}, *r.witness_b), bends ? 1e-9 : 1e-6) << k;
    if (bends && ++after % 10 == 1) { EXPECT_TRUE(check(run).empty()) << k << ": " << check(run)[0].message; }  // it looks at 512 polytopes
    most = std::max(most, r.support_calls);
  }
  EXPECT_GT(after, pairs_asked(20));
  EXPECT_LT(most, 512 + 8200);
}

TEST(RodHeights, InSinglePrecision) {
  RodScenes random(4);
  for (int k = 0; k < 60; ++k) {
    SceneFile file;
    file.scene = in_nearly_a_spheroid(random, k);
    const double exact = *record(file).result.signed_distance;
    file.method.scalar = Scalar::float_precision;
    const Recording run = record(file);
    EXPECT_NE(run.result.status, StatusWord("iteration_limit")) << k;
    EXPECT_LE(*run.result.lower_bound, exact + 1e-6) << k;
    EXPECT_GE(*run.result.upper_bound, exact - 1e-6) << k;
    EXPECT_LE(*run.result.upper_bound - *run.result.lower_bound, 2e-4 * -exact) << k;
    if (k % 20 == 5) { EXPECT_TRUE(check(run).empty()) << k << ": " << check(run)[0].message; }
  }
}

}  // namespace
}  // namespace gjkdbg
