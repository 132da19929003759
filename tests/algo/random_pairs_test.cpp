// Random pairs against oracles that share nothing with algo/: exact rationals for polytopes and their roundings, 50-digit
// arithmetic and a search over directions for the curved shapes.
//
// GJKDBG_PAIRS sets how many polytope pairs (20000 unless set; the sanitizer run takes fewer).
#include <gtest/gtest.h>

#include "algo/contact.h"
#include "algo/minkowski_difference.h"
#include "algo/solve.h"
#include "shapes/convex.h"
#include "tests/oracle/exact_polytopes.h"
#include "tests/oracle/wide_gjk.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

Result answer(Scene scene, Query query, MethodName name = MethodName::gjk) {
  scene.query = query;
  Method method;
  method.name = name;
  return solve(scene, resolve_settings(method, scene));
}

std::string where(int dimension, Family family, int k) {
  return std::to_string(dimension) + "D family " + std::to_string(static_cast<int>(family)) + " pair " + std::to_string(k);
}

/// How far a world point is outside a body (negative inside), by the exact oracle.
double outside(const Scene& scene, int body, const AnyVector& point) {
  Scene probe = scene;
  Body& other = probe.bodies[static_cast<std::size_t>(1 - body)];
  other.shape = {PointSet{PointSetKind::point, {AnyVector::Zero(scene.dimension)}, {}}, 0};
  other.pose = identity_pose(scene.dimension);
  other.pose.position = point;
  return oracle::signed_distance(probe)->signed_distance;
}

struct Errors {
  double distance = 0, witness = 0, gap = 0;
};

/// All that a penetration result claims, against the exact answer.
void check(const Scene& scene, const Result& r, const oracle::Answer& exact, Errors& worst, bool probe_witnesses) {
  const double size = size_of(scene);
  ASSERT_TRUE(r.signed_distance && r.normal && r.witness_a && r.witness_b && r.lower_bound && r.upper_bound);
  const double error = std::abs(*r.signed_distance - exact.signed_distance) / std::max(size, std::abs(exact.signed_distance));
  worst.distance = std::max(worst.distance, error);
  EXPECT_LE(error, 1e-10) << *r.signed_distance << " for " << exact.signed_distance;
  const double slack = 1e-15 * std::abs(exact.signed_distance);
  EXPECT_LE(*r.lower_bound, exact.signed_distance + slack);
  EXPECT_GE(*r.upper_bound, exact.signed_distance - slack);
  worst.gap = std::max(worst.gap, (*r.upper_bound - *r.lower_bound) / size);
  EXPECT_LE(*r.upper_bound - *r.lower_bound, 1e-10 * std::max(size, std::abs(exact.signed_distance)));
  EXPECT_NEAR(r.normal->norm(), 1, 1e-12);
  const double place = size + scene.bodies[0].pose.position.norm();
  const double off = (*r.witness_b - *r.witness_a - *r.signed_distance * *r.normal).norm() / place;
  worst.witness = std::max(worst.witness, off);
  EXPECT_LE(off, 1e-14);
  if (!probe_witnesses) return;
  EXPECT_LE(outside(scene, 0, *r.witness_a), 1e-10 * size + 1e-15 * place);
  EXPECT_LE(outside(scene, 1, *r.witness_b), 1e-10 * size + 1e-15 * place);
}

void check_booleans(const Scene& scene, const oracle::Answer& exact) {
  if (std::abs(exact.signed_distance) <= 1e-12 * size_of(scene)) return;
  for (const Query query : {Query::intersect, Query::distance, Query::penetration, Query::contact})
    EXPECT_EQ(answer(scene, query).intersecting, exact.intersecting) << word_of(query) << " " << exact.signed_distance;
  EXPECT_EQ(answer(scene, Query::intersect, MethodName::gjk_boolean).intersecting, exact.intersecting) << "boolean " << exact.signed_distance;
  const Result distance = answer(scene, Query::distance);
  EXPECT_NEAR(*distance.signed_distance, std::max(0.0, exact.signed_distance), 1e-10 * std::max(size_of(scene), exact.signed_distance));
}

TEST(RandomPairs, PolytopesAgreeWithExactArithmetic) {
  RandomScenes random(1);
  Errors worst;
  for (int k = 0; k < pairs_asked(20000); ++k) {
    const int dimension = k % 10 == 0 ? 1 : k % 10 < 4 ? 2 : 3;
    const auto family = static_cast<Family>(k / 10 % family_count);
    const Scene scene = random.scene(dimension, family, true);
    const auto exact = oracle::signed_distance(scene);
    ASSERT_TRUE(exact);
    SCOPED_TRACE(where(dimension, family, k));
    const Result r = answer(scene, Query::penetration);
    EXPECT_TRUE(r.status == "converged" || r.status == "flat" || r.status == "separated") << r.status;
    check(scene, r, *exact, worst, k % 23 == 0);
    check_booleans(scene, *exact);
    if (testing::Test::HasFailure()) break;  // the first is enough, and its number names it
  }
  std::printf("worst error %.2g, witness %.2g, gap %.2g of the size\n", worst.distance, worst.witness, worst.gap);
}

/// The other sub-algorithms and acceleration, behind the same monotone loop and second opinion: as right, now and then stalled.
TEST(RandomPairs, EveryVariantAgreesWithExactArithmetic) {
  for (const MethodName name : {MethodName::gjk, MethodName::gjk_accelerated})
    for (const ClosestPoint part : {ClosestPoint::johnson, ClosestPoint::voronoi, ClosestPoint::signed_volumes}) {
      if (name == MethodName::gjk && part == ClosestPoint::signed_volumes) continue;
      RandomScenes random(6);
      int stalled = 0;
      for (int k = 0; k < pairs_asked(20000) / 10; ++k) {
        const int dimension = 1 + k % 3;
        const auto family = static_cast<Family>(k / 3 % family_count);
        const Scene scene = random.scene(dimension, family, true);
        SCOPED_TRACE(where(dimension, family, k));
        Method method;
        method.name = name, method.closest_point = part;
        const Result r = solve(scene, resolve_settings(method, scene));
        const auto exact = oracle::signed_distance(scene);
        const double size = std::max(size_of(scene), std::abs(exact->signed_distance));
        EXPECT_NEAR(*r.signed_distance, exact->signed_distance, 1e-10 * size);
        EXPECT_NE(r.status, "iteration_limit");
        stalled += r.status == "stalled";
        if (testing::Test::HasFailure()) return;
      }
      EXPECT_LE(stalled, pairs_asked(20000) / 500);
    }
}

/// SAT is exact for what it decides itself; MPR is right about yes and no, and its depth is a way out, if not the shortest.
TEST(RandomPairs, SatAndMprAgreeWithExactArithmetic) {
  RandomScenes random(8);
  int shortest = 0, deep = 0;
  for (int k = 0; k < pairs_asked(20000) / 4; ++k) {
    const int dimension = 1 + k % 3;
    const auto family = static_cast<Family>(k / 3 % family_count);
    const Scene scene = random.scene(dimension, family, true);
    SCOPED_TRACE(where(dimension, family, k));
    const auto exact = oracle::signed_distance(scene);
    const double size = std::max(size_of(scene), std::abs(exact->signed_distance)), sd = exact->signed_distance;
    for (const MethodName name : {MethodName::sat, MethodName::mpr})
      for (const Query query : {Query::intersect, Query::distance, Query::penetration}) {
        Scene asked = scene;
        asked.query = query;
        Method method;
        method.name = name;
        const Result r = solve(asked, resolve_settings(method, asked));
        if (std::abs(sd) > 1e-12 * size) {
          EXPECT_EQ(r.intersecting, exact->intersecting) << word_of(name) << " " << sd;
        }
        if (query == Query::distance) {
          EXPECT_NEAR(*r.signed_distance, std::max(0.0, sd), 1e-10 * size);
        }
        if (query != Query::penetration) continue;
        EXPECT_LE(*r.lower_bound, sd + 1e-13 * size);
        EXPECT_GE(*r.upper_bound, sd - 1e-13 * size);
        if (name == MethodName::sat || sd > 0) {
          EXPECT_NEAR(*r.signed_distance, sd, 1e-10 * size);
          EXPECT_LE((*r.witness_b - *r.witness_a - *r.signed_distance * *r.normal).norm(), 1e-14 * (size + scene.bodies[0].pose.position.norm()));
          EXPECT_LE(outside(asked, 0, *r.witness_a), 1e-9 * size) << r.status << " " << sd;
          EXPECT_LE(outside(asked, 1, *r.witness_b), 1e-9 * size) << r.status << " " << sd;
        } else {
          EXPECT_LE(*r.signed_distance, sd + 1e-10 * size);
          EXPECT_NE(r.status, "iteration_limit");
          ++deep, shortest += *r.signed_distance > sd - 1e-9 * size;
        }
      }
    if (testing::Test::HasFailure()) return;
  }
  std::printf("MPR's way out is the shortest in %d of %d\n", shortest, deep);
  EXPECT_LT(shortest, deep);
}

TEST(RandomPairs, ContactPointsLieOnBothBodies) {
  RandomScenes random(2);
  int found = 0;
  for (int k = 0; k < pairs_asked(20000) / 10; ++k) {
    const int dimension = k % 3 == 0 ? 2 : 3;
    const auto family = static_cast<Family>(k / 3 % 3);
    const Scene scene = random.scene(dimension, family, true);
    const Result r = answer(scene, Query::contact);
    SCOPED_TRACE(where(dimension, family, k));
    ASSERT_TRUE(r.contacts);
    EXPECT_EQ(r.contacts->empty(), !r.intersecting);
    const double size = size_of(scene);
    for (const ContactPoint& c : *r.contacts) {
      ++found;
      EXPECT_GE(c.depth, 0);
      EXPECT_LE(c.depth, -*r.signed_distance + 1e-9 * size);
      EXPECT_LE((c.point_a - c.point_b - c.depth * *r.normal).norm(), 1e-9 * size);
      if (k % 11 == 0) {
        EXPECT_LE(outside(scene, 0, c.point_a), 1e-8 * size);
        EXPECT_LE(outside(scene, 1, c.point_b), 1e-8 * size);
      }
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(found, pairs_asked(20000) / 100);
}

/// Support planes of A - B: no depth may exceed any of them, and the gap must reach every one.
template <int D>
struct Planes {
  Convex<D, double> a, b;
  MinkowskiDifference<D, double, Convex<D, double>> difference;
  Matrix<D, double> frame;

  explicit Planes(const Scene& s)
      : a(s.bodies[0].shape), b(s.bodies[1].shape),
        difference(a, b, s.bodies[0].pose, s.bodies[1].pose, 1),
        frame(s.bodies[0].pose.matrix) {}
  /// The least signed distance that the plane along a unit world direction allows.
  double bound(const Vector<D, double>& world) {
    const Vector<D, double> n = frame.transpose() * world;
    return -(n.dot(difference.support(n).w) + difference.radius());
  }
};

/// No direction may prove the answer wrong: random ones, then downhill from the answer's own.
template <int D>
double best_refutation(const Scene& scene, const Result& r, RandomScenes& random) {
  Planes<D> planes(scene);
  const auto random_direction = [&] {
    Vector<D, double> d;
    for (double& x : d) x = random.uniform(-1, 1);
    return d;
  };
  Vector<D, double> best = *r.normal;
  double most = planes.bound(best);
  for (int i = 0; i < 40; ++i)
    if (const Vector<D, double> d = random_direction().normalized(); planes.bound(d) > most) most = planes.bound(d), best = d;
  double step = 0.3;
  for (int i = 0; i < 120; ++i) {
    const Vector<D, double> d = (best + step * random_direction()).normalized();
    if (const double bound = planes.bound(d); bound > most) {
      most = bound, best = d;
    } else {
      step *= 0.9;
    }
  }
  return most;
}

TEST(RandomPairs, NoPlaneRefutesACurvedAnswer) {
  RandomScenes random(3);
  int limits = 0;
  for (int k = 0; k < pairs_asked(20000) / 4; ++k) {
    const int dimension = k % 4 == 0 ? 2 : 3;
    const auto family = static_cast<Family>(k / 4 % (family_count - 1));
    const Scene scene = random.scene(dimension, family, false);
    const Result r = answer(scene, Query::penetration);
    SCOPED_TRACE(where(dimension, family, k));
    const double size = size_of(scene), sd = *r.signed_distance;
    ASSERT_TRUE(std::isfinite(sd));
    EXPECT_NE(r.status, "stalled");
    EXPECT_LE(*r.lower_bound, *r.upper_bound);
    const double refuted = dimension == 2 ? best_refutation<2>(scene, r, random) : best_refutation<3>(scene, r, random);
    EXPECT_LE(refuted, *r.upper_bound + 1e-12 * size);
    if (r.status == "iteration_limit") {
      // Only where a whole ring of directions ties, which integer coordinates make: faces cannot close in on all of it.
      ++limits;
      EXPECT_EQ(family, Family::lattice);
      EXPECT_LE(*r.upper_bound - *r.lower_bound, 1e-4 * size);
      continue;
    }
    EXPECT_LE(*r.upper_bound - *r.lower_bound, 1e-6 * std::max(size, std::abs(sd)));
    EXPECT_LE(refuted, sd + 1e-6 * size);
    EXPECT_GE(dimension == 2 ? Planes<2>(scene).bound(*r.normal) : Planes<3>(scene).bound(*r.normal), sd - 1e-6 * size);
    if (std::abs(sd) > 1e-9 * size) {
      EXPECT_EQ(answer(scene, Query::intersect).intersecting, sd <= 0);
      EXPECT_EQ(answer(scene, Query::distance).intersecting, sd <= 0);
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_LE(limits, pairs_asked(20000) / 400);
}

/// Every plane is a true bound whatever direction it is across: the certificates agree. And of two ellipsoids Newton's directions take half the steps.
TEST(RandomPairs, NewtonsDirectionsAnswerAsThePlainOnes) {
  RandomScenes random(14);
  int plain_steps = 0, newton_steps = 0, stalled = 0;
  for (int k = 0; k < pairs_asked(20000) / 4; ++k) {
    const int dimension = k % 4 == 0 ? 2 : 3;
    const Scene scene = random.scene(dimension, static_cast<Family>(k / 4 % family_count), false);
    Method method;
    method.scalar = k % 3 == 0 ? Scalar::float_precision : Scalar::double_precision;
    const Result plain = solve(scene, resolve_settings(method, scene));
    method.name = MethodName::gjk_accelerated, method.acceleration = Acceleration::newton;
    const Result newton = solve(scene, resolve_settings(method, scene));
    SCOPED_TRACE(where(dimension, static_cast<Family>(k / 4 % family_count), k));
    const double slack = 1e-12 * size_of(scene);
    ASSERT_TRUE(std::isfinite(*newton.signed_distance));
    EXPECT_LE(*newton.lower_bound, *plain.upper_bound + slack);
    EXPECT_GE(*newton.upper_bound, *plain.lower_bound - slack);
    if (plain.status == "converged") {
      const double tolerance = method.scalar == Scalar::float_precision ? 2e-4 : 2e-10;
      const double band = rounding_floor(scene, resolve_settings(method, scene));
      stalled += newton.status == "stalled";
      EXPECT_NE(newton.status, "iteration_limit");
      EXPECT_NEAR(*newton.signed_distance, *plain.signed_distance, tolerance * std::max(size_of(scene), std::abs(*plain.signed_distance)) + 4 * band);  // of the cores, which lie farther apart
    }
    const auto ellipsoid = [](const Body& body) { return std::holds_alternative<Ellipsoid>(body.shape.geometry); };
    if (*plain.signed_distance > 0 && ellipsoid(scene.bodies[0]) && ellipsoid(scene.bodies[1])) plain_steps += plain.iterations, newton_steps += newton.iterations;
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_LE(stalled, pairs_asked(20000) / 500);
  EXPECT_LT(newton_steps, plain_steps / 2);
  std::printf("two ellipsoids: %d steps, plain %d\n", newton_steps, plain_steps);
}

/// Nothing but fewer supports of polytopes.
TEST(RandomPairs, SmoothedDirectionsAnswerAsThePlainOnes) {
  RandomScenes random(16);
  for (int k = 0; k < pairs_asked(20000) / 4; ++k) {
    const int dimension = k % 4 == 0 ? 2 : 3;
    const Scene scene = random.scene(dimension, static_cast<Family>(k / 4 % family_count), false);
    SCOPED_TRACE(where(dimension, static_cast<Family>(k / 4 % family_count), k));
    Method method;
    method.scalar = k % 3 == 0 ? Scalar::float_precision : Scalar::double_precision;
    const Settings plainly = resolve_settings(method, scene);
    method.name = MethodName::gjk_accelerated, method.acceleration = Acceleration::smoothed;
    const Settings led = resolve_settings(method, scene);
    const Result plain = solve(scene, plainly), found = solve(scene, led);
    const double band = rounding_floor(scene, plainly), slack = 1e-12 * size_of(scene) + 4 * band;
    ASSERT_TRUE(std::isfinite(*found.signed_distance));
    EXPECT_LE(*found.lower_bound, *plain.upper_bound + slack);
    EXPECT_GE(*found.upper_bound, *plain.lower_bound - slack);
    if (plain.status == "converged" && found.status == "converged") {
      EXPECT_NEAR(*found.signed_distance, *plain.signed_distance, 2 * plainly.tolerance * (std::abs(*plain.signed_distance) + size_of(scene)) + slack);
    }
    Scene yes_or_no = scene;
    yes_or_no.query = Query::intersect;
    if (std::abs(*plain.signed_distance) > 2 * slack) {
      EXPECT_EQ(solve(yes_or_no, led).intersecting, plain.intersecting);
    }
    if (testing::Test::HasFailure()) break;
  }
}

TEST(RandomPairs, SmoothedDirectionsTakeFewerSupports) {
  RandomScenes random(17);
  const auto vector = [&] { return AnyVector(Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized()); };
  int plain = 0, smoothed = 0;
  for (int k = 0; k < 300; ++k) {
    Scene scene;
    scene.dimension = 3;
    for (const char* name : {"A", "B"}) {
      PointSet hull{PointSetKind::hull, {}, {}};
      for (int i = 0; i < 32; ++i) hull.points.push_back(vector());
      scene.bodies.push_back({name, {hull, 0}, identity_pose(3)});
    }
    scene.bodies[1].pose.position = vector() * 3;
    const Result far = answer(scene, Query::penetration);
    scene.bodies[1].pose.position -= *far.normal * (*far.signed_distance - 0.05);
    Method method;
    method.name = MethodName::gjk_accelerated, method.acceleration = Acceleration::smoothed;
    const Result r = solve(scene, resolve_settings(method, scene));
    EXPECT_NEAR(*r.signed_distance, 0.05, 1e-12) << "pair " << k;
    plain += answer(scene, Query::penetration).support_calls, smoothed += r.support_calls;
  }
  EXPECT_LT(smoothed, 0.85 * plain);
  std::printf("hulls of 32 vertices: %d supports, plain %d\n", smoothed, plain);
}

/// A ball, as an ellipsoid, nearly touches an edge: |v| rounds by far more than its square's last digits, and that must not end the search.
TEST(RandomPairs, NearlyTouchedEdgesDoNotStall) {
  RandomScenes random(15);
  const auto vector = [&] { return AnyVector(Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))); };
  for (int k = 0; k < pairs_asked(20000) / 10; ++k) {
    Scene scene;
    scene.dimension = 3;
    scene.query = Query::penetration;
    Body ball{"A", {Ellipsoid{AnyVector(Eigen::Vector3d::Ones())}, 0}, identity_pose(3)}, edge{"B", {PointSet{PointSetKind::segment, {vector() * 2, vector() * 2}, {}}, 0}, identity_pose(3)};
    edge.pose.position = vector().normalized() * 6;
    scene.bodies = {ball, edge};
    const Result far = answer(scene, Query::penetration);
    const double gap = std::pow(10.0, -4 - k % 4);
    scene.bodies[1].pose.position -= *far.normal * (*far.signed_distance - gap);
    Method method;
    method.name = MethodName::gjk_accelerated, method.acceleration = Acceleration::newton;
    const Result newton = solve(scene, resolve_settings(method, scene));
    EXPECT_EQ(newton.status, "converged") << "pair " << k;
    EXPECT_NEAR(*newton.signed_distance, gap, 1e-9) << "pair " << k;
    if (testing::Test::HasFailure()) break;
  }
}

TEST(RandomPairs, CurvedDistancesAgreeWithFiftyDigits) {
  RandomScenes random(4);
  int compared = 0;
  for (int k = 0; k < pairs_asked(20000) / 20; ++k) {
    const int dimension = k % 4 == 0 ? 2 : 3;
    const Scene scene = random.scene(dimension, k % 2 == 0 ? Family::general : Family::lattice, false);
    const Result r = answer(scene, Query::penetration);
    const double size = size_of(scene);
    if (*r.signed_distance < 1e-3 * size) continue;
    const double wide = oracle::wide_distance(scene);
    SCOPED_TRACE(where(dimension, Family::general, k));
    EXPECT_NEAR(*r.signed_distance, wide, 1e-6 * size);
    ++compared;
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(compared, pairs_asked(20000) / 100);
}

}  // namespace
}  // namespace gjkdbg
