// What an answer claims, against planes of its own: no plane proves more than the upper bound, the normal's proves the lower one, and a yes or no is the same whatever else is asked for.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "algo/solve.h"
#include "recordings/check.h"
#include "recordings/recording.h"
#include "tests/support/heights.h"
#include "tests/support/random_scenes.h"
#include "tests/support/rod_scenes.h"

namespace gjkdbg {
namespace {

using V3 = Eigen::Vector3d;

Body in_space(Shape shape) { return {"", std::move(shape), identity_pose(3)}; }

/// Two bodies of these, so far apart or so deep, to the precision of their distance. They meet where they would from afar, mostly at their ends, or from where
/// their middles are as far as that from one another.
Scene placed(RodScenes& random, Shape first, Shape second, double gap, std::optional<double> middles = {}) {
  Scene scene = random.pair(in_space(std::move(first)), in_space(std::move(second)), 0, random.uniform(0, 3));
  scene.bodies[1].pose.position += middles.value_or(10 * (size_of(scene) + 1)) * random.direction();
  const Result apart = solve(scene, resolve_settings({}, scene));
  scene.bodies[1].pose.position -= (*apart.signed_distance - gap) * *apart.normal;
  return scene;
}

Shape round_shape(RodScenes& random, int k) {
  const double radius = random.uniform(0.3, 1), half = random.uniform(0.2, 1);
  switch (k % 5) {
    case 0: return {Sphere{radius}, 0};
    case 1: return {Capsule{radius, half, 2}, 0};
    case 2: return {Cylinder{radius, half, 2}, 0};
    case 3: return {Cone{radius, half, 2}, 0};
    default: return {Ellipsoid{AnyVector(V3(radius, half, random.uniform(0.2, 1)))}, 0};
  }
}

/// `slack`: of a bound, for the rounding of the planes here. The normal's own plane may prove less than the best one by what the search ends at; how much less where it says that it came no
/// farther.
/// Raises `most` to the lower bound, and lowers `least` to the upper one.
void expect_certified(const Scene& scene, const Settings& settings, const AnyVector& other_way, double slack, const std::string& what, double& most, double& least) {
  const Result r = solve(scene, settings);
  if (!r.signed_distance) return;
  most = std::max(most, *r.lower_bound), least = std::min(least, *r.upper_bound);
  const Heights heights(scene);
  EXPECT_LE(*r.lower_bound, *r.upper_bound) << what;
  EXPECT_LE(*r.lower_bound, *r.signed_distance + slack) << what;
  EXPECT_GE(*r.upper_bound, *r.signed_distance - slack) << what;
  EXPECT_GE(*r.upper_bound, -heights.along(other_way) - slack) << what;
  if (r.normal && r.status != StatusWord("stalled") && r.status != StatusWord("iteration_limit")) {
    EXPECT_GE(-heights.along(*r.normal), *r.lower_bound - 2 * (*r.upper_bound - *r.lower_bound) - settings.tolerance * (std::abs(*r.signed_distance) + 2) - slack) << what;
  }
}

std::vector<Method> methods_for(Scalar scalar) {
  std::vector<Method> all;
  for (const MethodName name : {MethodName::gjk, MethodName::gjk_accelerated, MethodName::mpr, MethodName::fastest}) all.push_back({}), all.back().name = name;
  for (const ClosestPoint closest : {ClosestPoint::johnson, ClosestPoint::voronoi}) all.push_back({}), all.back().closest_point = closest;
  for (Method& m : all) m.scalar = scalar;
  return all;
}

/// Of every method in both scalars, against the normal of a fine answer; and not one bound contradicts another's.
void expect_all_certified(const Scene& scene, const std::string& what) {
  Method fine;
  fine.tolerance = 1e-14;
  const Result best = solve(scene, resolve_settings(fine, scene));
  ASSERT_TRUE(best.normal);
  double most = *best.lower_bound, least = *best.upper_bound;
  for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision})
    for (const Method& m : methods_for(scalar)) {
      const std::string by = ", method " + std::to_string(static_cast<int>(m.name.value_or(MethodName::gjk))) + (scalar == Scalar::float_precision ? " in float" : "");
      expect_certified(scene, resolve_settings(m, scene), *best.normal, 2e-15 * size_of(scene), what + by, most, least);
    }
  EXPECT_LE(most, least) << what;
}

Shape triangle(RodScenes& random, double reach) {
  const V3 p = random.direction(), q = random.direction();
  return {PointSet{PointSetKind::triangle, {AnyVector(reach * p), AnyVector(reach * q), AnyVector(V3(0.1, 0.2, 0.3))}, ""}, 0};
}

/// Long bodies beside short ones, whose simplices are next to flat.
TEST(Certificates, OfShortBodiesBesideLongOnes) {
  RodScenes random(1);
  for (int k = 0; k < pairs_asked(1500); ++k) {
    const double length = std::pow(10, random.uniform(0, 3));
    const Shape longer = k % 3 == 0 ? Shape{Cylinder{1, length, 2}, 0} : k % 3 == 1 ? Shape{Cone{1, length, 2}, 0} : Shape{Ellipsoid{AnyVector(V3(1, 0.8, length))}, 0};
    const Shape shorter = k % 2 == 0 ? triangle(random, 1) : round_shape(random, k / 2);
    expect_all_certified(placed(random, longer, shorter, random.uniform(0, 1) < 0.3 ? -0.1 : std::pow(10, random.uniform(-4, 0))), std::to_string(k));
  }
}

/// A triangle that reaches less deep into the middle of a long body than its simplices' rounding: EPA's faces there are slivers.
TEST(Certificates, OfATriangleAndTheMiddleOfALongBody) {
  RodScenes random(3);
  for (int k = 0; k < pairs_asked(3000); ++k) {
    const double length = std::pow(10, random.uniform(1.5, 3)), radius = random.uniform(0.2, 1), reach = random.uniform(0.5, 2), depth = std::pow(10, random.uniform(-6, -2));
    const Shape longer = k % 3 == 0 ? Shape{Cone{radius, length, 2}, 0} : Shape{Cylinder{radius, length, 2}, 0};
    expect_all_certified(placed(random, triangle(random, reach), longer, -depth, reach), std::to_string(k));
  }
}

/// Round bodies that touch, or nearly: the answer is the proven one, however coarse the distance may be.
TEST(Certificates, OfYesOrNoAreTheSameInEveryQuery) {
  RodScenes random(2);
  for (int k = 0; k < pairs_asked(1500); ++k) {
    const double gap = (k % 2 == 0 ? 1 : -1) * std::pow(10, random.uniform(-11, -2));
    Scene scene = placed(random, round_shape(random, k), round_shape(random, k / 5), gap);
    scene.query = Query::intersect;
    const bool yes = solve(scene, resolve_settings({}, scene)).intersecting;
    for (const Query query : {Query::distance, Query::penetration, Query::contact}) {
      scene.query = query;
      for (const double tolerance : {0.1, 1e-4, 1e-10})
        for (Method m : methods_for(Scalar::double_precision)) {
          m.tolerance = tolerance;
          const Result r = solve(scene, resolve_settings(m, scene));
          if (r.status == StatusWord("stalled")) continue;  // it says that it cannot tell
          EXPECT_EQ(r.intersecting, yes) << k << ", gap " << gap << ", tolerance " << tolerance << ", method " << static_cast<int>(m.name.value_or(MethodName::gjk)) << ", closest point " << static_cast<int>(m.closest_point.value_or(ClosestPoint::signed_volumes));
        }
    }
  }
}

}  // namespace
}  // namespace gjkdbg
