// What is said of the heights of two rods, and of sums of rods and ellipsoids: that none is below it, along many directions; and the depths that come of it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "algo/bent_sum.h"
#include "algo/ellipsoid_depth.h"
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

using Rod3 = Eigen::Vector3d;

Body any_rod(RodScenes& random, int kind) {
  const double radius = std::pow(10, random.uniform(-1, 0)), half = std::pow(10, random.uniform(-3, 0.3));
  return RodScenes::rod(static_cast<RodKind>(kind % 5), radius, half);
}
/// Of two, or of three.
Body any_sum(RodScenes& random, int k) {
  const auto part = [&](int i) {
    const double waist = random.uniform(0.2, 1), height = random.uniform(0.2, 1);
    Body body = i % 3 == 0 ? RodScenes::ellipsoid(Rod3(waist, i % 2 == 0 ? waist : random.uniform(0.2, 1), height)) : any_rod(random, i / 3);
    if (auto* cylinder = std::get_if<Cylinder>(&body.shape.geometry)) cylinder->axis = i % 4 == 1 ? 0 : 2;
    if (auto* cone = std::get_if<Cone>(&body.shape.geometry)) cone->axis = i % 4 == 1 ? 1 : 2;
    return std::make_shared<Shape>(body.shape);
  };
  Body body = any_rod(random, 0);
  const auto first = part(k), second = part(k / 2);
  body.shape.geometry = Sum{first, second};
  if (k % 3 > 0) return body;
  const auto both = std::make_shared<Shape>(body.shape), third = part(k / 5);
  body.shape.geometry = Sum{both, third};
  return body;
}

std::size_t second_rod(const BentSum<double>& pair) { return pair.parts.rod_count > 1 ? 1 : 0; }

/// Where both folds cross, on one of them, along an axis, or near any of these.
Rod3 about_folds(RodScenes& random, const BentSum<double>& pair, int i) {
  const Rod3 d = random.direction(), off = i % 2 == 0 ? Rod3(Rod3::Zero()) : Rod3(std::pow(10, random.uniform(-6, -1)) * random.direction());
  const BentRod<double>&first = pair.parts.rods[0].rod, &second = pair.parts.rods[second_rod(pair)].rod;
  if (i % 10 < 3) {
    Rod3 crossing = first.on_fold(d);
    for (int k = 0; k < 60; ++k) crossing = first.on_fold(second.on_fold(crossing));
    return (crossing + off).normalized();
  }
  if (i % 10 < 5) return (first.on_fold(d) + off).normalized();
  if (i % 10 < 7) return (second.on_fold(d) + off).normalized();
  return i % 10 == 7 ? (first.shape.axis + off).normalized() : i % 10 == 8 ? (off - second.shape.axis).normalized() : d;
}

/// About twenty directions of the pair. How many of them were on the folds of the first two rods.
int expect_none_below_of(RodScenes& random, const Scene& scene, int k) {
  const Convex<3, double> a(scene.bodies[0].shape, 1), b(scene.bodies[1].shape, 1);
  MinkowskiDifference<3, double, Convex<3, double>> difference(a, b, scene.bodies[0].pose, scene.bodies[1].pose, 1);
  const auto pair = BentSum<double>::of(difference);
  int both = 0;
  EXPECT_TRUE(pair) << k;
  for (int i = 0; pair && i < 20; ++i) {
    const Rod3 d = about_folds(random, *pair, i);
    if (pair->parts.rods[0].rod.along(d).on_fold && pair->parts.rods[second_rod(*pair)].rod.along(d).on_fold) ++both;
    const auto point = difference.support(d);
    const auto heights = pair->model(d, point);
    EXPECT_NEAR(heights.height(), d.dot(point.w), 1e-14);
    EXPECT_NEAR(d.dot(heights.support()), heights.height(), 2e-14);
    EXPECT_LE((heights.points()[0] + heights.points()[1] - heights.support()).norm(), 1e-14);
    expect_none_below(random, heights, difference, i % 6 == 0 ? random.direction() : d, std::to_string(k) + ", " + std::to_string(i));
  }
  return both;
}

TEST(SumHeights, NoHeightOfTwoRodsIsBelowIt) {
  RodScenes random(11);
  int both = 0;
  for (int k = 0; k < pairs_asked(1500); ++k) {
    Body first = any_rod(random, k), second = any_rod(random, k / 5);
    const double away = k % 4 == 0 ? 0 : random.uniform(0, 1), tilt = k % 3 == 0 ? std::pow(10, random.uniform(-9, 0)) : random.uniform(0, 3);
    both += expect_none_below_of(random, random.pair(std::move(first), std::move(second), away, tilt), k);
  }
  EXPECT_GT(both, pairs_asked(500));
}

/// Of up to three rods and ellipsoids each, along any of the axes.
TEST(SumHeights, NoHeightOfSumsIsBelowIt) {
  RodScenes random(15);
  int both = 0;
  for (int k = 0; k < pairs_asked(1500); ++k) {
    Body first = any_sum(random, k), second = k % 3 == 0 ? any_rod(random, k / 3) : any_sum(random, k / 3);
    const double away = k % 4 == 0 ? 0 : random.uniform(0, 1), tilt = k % 2 == 0 ? std::pow(10, random.uniform(-9, 0)) : random.uniform(0, 3);
    both += expect_none_below_of(random, random.pair(std::move(first), std::move(second), away, tilt), k);
  }
  EXPECT_GT(both, pairs_asked(300));
}

/// A flat one within a long one, or the other way round, tilted by as little: along the crossing of their folds nothing is lost, all around the directions in which the height hardly rises.
TEST(SumHeights, LoseNothingWhereTheFoldsCross) {
  RodScenes random(12);
  for (const double tilt : {1e-6, 1e-3, 0.3}) {
    const Scene scene = random.pair(RodScenes::rod(RodKind::cylinder, 1.2, 1.4), RodScenes::rod(RodKind::capsule, 0.25, 1e-3), 0, tilt);
    const Convex<3, double> a(scene.bodies[0].shape, 1), b(scene.bodies[1].shape, 1);
    MinkowskiDifference<3, double, Convex<3, double>> difference(a, b, scene.bodies[0].pose, scene.bodies[1].pose, 1);
    const auto pair = BentSum<double>::of(difference);
    ASSERT_TRUE(pair);
    const Rod3 axis = pair->parts.rods[0].rod.shape.axis, d = axis.cross(pair->parts.rods[1].rod.shape.axis).normalized(), beside = axis.cross(d);
    std::array<Rod3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = (d + (k < 2 ? 0.2 : -0.2) * axis + (k % 2 == 0 ? 0.3 : -0.3) * beside).normalized();
    const auto heights = pair->model(d, difference.support(d));
    EXPECT_NEAR(heights.height(), 1.2, 1e-12) << tilt;
    EXPECT_NEAR(heights.least_among(corners), heights.height(), 1e-13) << tilt;
    EXPECT_NEAR(heights.slope(), 0, 1e-9) << tilt;
  }
}

/// A rod in or beside another, one of them next to flat, tilted by as little: of such, sections left a few open, and EPA most.
Scene one_next_to_flat(RodScenes& random, int k) {
  const auto rod = [&](int kind, double half) { return RodScenes::rod(static_cast<RodKind>(kind % 5), random.uniform(0.2, 2), half); };
  const double long_half = random.uniform(0.3, 3), flat_half = std::pow(10, random.uniform(-4, -1.5));
  Body first = rod(k % 4, long_half), second = rod(k / 4, flat_half);
  const double away = k % 3 == 0 ? 0 : std::pow(10, random.uniform(-7, -1)), tilt = std::pow(10, random.uniform(-4, -0.5));
  Scene scene = random.pair(std::move(first), std::move(second), away, tilt);
  if (k % 2 == 0) std::swap(scene.bodies[0], scene.bodies[1]);
  return scene;
}

/// By sections or EPA, all of them; by the bends alone, whatever they tell, and most are proven.
TEST(BentSum, TellTheDepthOfOneThatIsNextToFlat) {
  RodScenes random(13);
  int proven = 0;
  for (int k = 0; k < pairs_asked(160); ++k) {
    SceneFile file;
    file.scene = one_next_to_flat(random, k);
    const Result r = record(file).result;
    if (!(*r.signed_distance < 0)) continue;
    EXPECT_NE(r.status, StatusWord("iteration_limit")) << k;
    const Convex<3, double> a(file.scene.bodies[0].shape, 1), b(file.scene.bodies[1].shape, 1);
    MinkowskiDifference<3, double, Convex<3, double>> difference(a, b, file.scene.bodies[0].pose, file.scene.bodies[1].pose, 1);
    const auto pair = BentSum<double>::of(difference);
    ASSERT_TRUE(pair) << k;
    NoTrace none;
    const auto found = ellipsoid_depth(difference, *pair, 1e-10, 512, none);
    const double depth = found.sat.depth + difference.radius();
    EXPECT_GE(depth, -*r.upper_bound - 1e-13) << k;
    EXPECT_LE(depth - found.slack, -*r.lower_bound + 1e-13) << k;
    proven += found.sat.status == SatStatus::overlapping;
    if (!found.points || found.sat.status != SatStatus::overlapping) continue;
    EXPECT_NEAR((found.points->a - found.points->b - found.sat.depth * found.sat.normal).norm(), 0, 1e-9) << k;
  }
  EXPECT_GT(proven, pairs_asked(90));
}

/// Sums about nearly one line, of which EPA gives up on many, with bounds up to 1e-4 apart.
TEST(BentSum, TellsTheDepthOfSums) {
  RodScenes random(16);
  int after = 0;
  for (int k = 0; k < pairs_asked(300); ++k) {
    SceneFile file;
    Body first = any_sum(random, k), second = any_rod(random, k / 7);
    const double away = k % 3 == 0 ? 0 : std::pow(10, random.uniform(-7, -1)), tilt = k % 2 == 0 ? 0 : std::pow(10, random.uniform(-7, -0.5));
    file.scene = random.pair(std::move(first), std::move(second), away, tilt);
    const Recording run = record(file);
    const Result& r = run.result;
    if (!(*r.signed_distance < 0)) continue;
    EXPECT_NE(r.status, StatusWord("iteration_limit")) << k;
    EXPECT_LE(*r.upper_bound - *r.lower_bound, 2e-10 * -*r.signed_distance + 1e-14) << k;
    const Heights heights(file.scene);
    for (int i = 0; i < 12; ++i) EXPECT_GE(heights.below(random.direction()), -*r.upper_bound - 1e-13) << k;
    if (has_event(run, "sat_began") && has_event(run, "epa_ended") && ++after % 10 == 1) { EXPECT_TRUE(check(run).empty()) << k << ": " << check(run)[0].message; }
  }
  EXPECT_GT(after, pairs_asked(10));
}

/// Rods one of which is next to flat, that sections leave open when their supports run out, and EPA after them, with bounds up to 1e-4 apart.
TEST(BentSum, TellsWhatSectionsLeaveOpen) {
  struct Pair {
    RodKind flat_kind;
    double radius, half, flat_radius, flat_half, tilt, away;
  };
  for (const Pair& p : {Pair{RodKind::cylinder, 0.893, 2.44, 0.5326, 1.94e-3, 3.211e-5, 0}, Pair{RodKind::cylinder, 0.657, 2.875, 1.3095, 1e-9, 1.477e-4, 2e-7}, Pair{RodKind::cylinder, 1, 2.5, 0.5, 1.0 / 512, 1e-3, 0}}) {
    RodScenes random(14);
    SceneFile file;
    file.scene = random.pair(RodScenes::rod(RodKind::capsule, p.radius, p.half), RodScenes::rod(p.flat_kind, p.flat_radius, p.flat_half), p.away, p.tilt);
    const Recording run = record(file);
    EXPECT_TRUE(has_event(run, "epa_ended"));
    EXPECT_EQ(run.result.status, StatusWord("overlapping"));
    EXPECT_LE(*run.result.upper_bound - *run.result.lower_bound, 2e-10 * -*run.result.signed_distance);
    EXPECT_LE(outside(file.scene, std::size_t{0}, *run.result.witness_a) + outside(file.scene, std::size_t{1}, *run.result.witness_b), 1e-9);
    EXPECT_TRUE(check(run).empty());
  }
}

/// An ellipse that is nearly a circle, alone or with a short segment or a triangle, and what is of the other kinds: whatever EPA makes of them, the bends agree with it, and close where it does not.
TEST(BentOutline, TellsTheDepthInThePlane) {
  RodScenes random(17);
  int beyond_epa = 0;
  for (int k = 0; k < pairs_asked(1200); ++k) {
    const auto ellipse = [&] {
      const double radius = random.uniform(0.3, 1), unlike = std::pow(10, random.uniform(-5, -0.3));
      return Shape{Ellipsoid{AnyVector(Eigen::Vector2d(radius, radius * (1 - unlike)))}, 0};
    };
    const auto cornered = [&](int kind) {
      const double size = std::pow(10, random.uniform(-4, 0));
      if (kind % 3 == 0) return Shape{PointSet{PointSetKind::segment, {Eigen::Vector2d(-size, 0), Eigen::Vector2d(size, 0)}, ""}, 0};
      if (kind % 3 == 1) return Shape{Capsule{0.3, size, 0}, 0};
      return Shape{PointSet{PointSetKind::hull, {Eigen::Vector2d(-size, -size), Eigen::Vector2d(size, -size), Eigen::Vector2d(0, size)}, ""}, 0};
    };
    Shape first = ellipse(), second = k % 2 == 0 ? cornered(k / 2) : ellipse();
    if (k % 4 > 0) first = Shape{Sum{std::make_shared<Shape>(first), std::make_shared<Shape>(cornered(k / 4))}, 0};
    SceneFile file;
    file.scene.dimension = 2, file.scene.query = Query::penetration;
    file.scene.bodies = {{"A", first, identity_pose(2)}, {"B", second, identity_pose(2)}};
    const double turn = random.uniform(0, 6), away = k % 3 == 0 ? 0 : random.uniform(0, 0.5);
    const Rod3 way = random.direction();
    Pose& pose = file.scene.bodies[1].pose;
    pose.matrix = Eigen::Rotation2Dd(turn).toRotationMatrix(), pose.rotation = RotationMatrix{pose.matrix}, pose.position = Eigen::Vector2d(away * way[0], away * way[1]);
    const Convex<2, double> a(first, 1), b(second, 1);
    MinkowskiDifference<2, double, Convex<2, double>> difference(a, b, file.scene.bodies[0].pose, pose, 1);
    const Result r = record(file).result;
    if (!(*r.signed_distance < -difference.radius())) continue;  // the cores are apart
    EXPECT_NE(r.status, StatusWord("iteration_limit")) << k;
    file.method.max_iterations = 200;  // EPA alone
    beyond_epa += record(file).result.status == StatusWord("iteration_limit");
    const auto outline = BentOutline<double>::of(difference);
    ASSERT_TRUE(outline) << k;
    NoTrace none;
    const auto found = ellipsoid_depth(difference, *outline, 1e-10, 512, none);
    const double depth = found.sat.depth + difference.radius();
    EXPECT_EQ(found.sat.status, SatStatus::overlapping) << k;
    EXPECT_GE(depth, -*r.upper_bound - 1e-13) << k;
    EXPECT_LE(depth - found.slack, -*r.lower_bound + 1e-13) << k;
  }
  EXPECT_GT(beyond_epa, 0);  // about one in twenty, so also of the few that are drawn for the sanitizers
}

}  // namespace
}  // namespace gjkdbg
