// Projections: the formulas of nearest points and how these move, against support mappings and differences; the method against exact arithmetic and GJK.
#include "algo/projections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "algo/solve.h"
#include "recordings/check.h"
#include "shapes/error.h"
#include "tests/oracle/exact_polytopes.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

template <int D>
Vector<D, double> moves_by(const Projection<D, double>& projection, const Vector<D, double>& dp) {
  const auto& t = projection.tangent;
  if constexpr (D == 3) {
    const double y0 = t[0].dot(dp), y1 = t[1].dot(dp);
    return t[0] * (projection.k00 * y0 + projection.k01 * y1) + t[1] * (projection.k01 * y0 + projection.k11 * y1);
  } else {
    return t[0] * (projection.k00 * t[0].dot(dp));
  }
}

/// Points about a core of every kind: x is in it and a support along p - x, and a little away from p it has moved as the derivative says.
template <int D>
void formulas_hold(const std::vector<Shape>& shapes) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const Shape& shape : shapes) {
    const Convex<D, double> body(shape);
    ASSERT_TRUE(projectable(body));
    int inside = 0, smooth = 0;
    const int points = 2000;
    for (int k = 0; k < points; ++k) {
      SCOPED_TRACE(type_name(shape, D) + ", point " + std::to_string(k));
      Vector<D, double> p, dp;
      const double far = std::pow(10, 0.5 * normal(random));
      for (int i = 0; i < D; ++i) p[i] = far * normal(random), dp[i] = 1e-6 * normal(random);
      const bool lattice = k % 4 == 0;  // on edges and in planes that the formulas tell apart
      if (lattice) p = (p * 4).array().round() / 4;
      ProjectionStart<double> start;
      Projection<D, double> at_p, beside;
      project_onto(body, p, start, at_p);
      if (at_p.inside) {
        ++inside;
        EXPECT_EQ(at_p.point, p);
        for (int i = 0; i < 30; ++i) {
          Vector<D, double> d;
          for (double& x : d) x = normal(random);
          EXPECT_LE(d.dot(p), d.dot(body.support(d)) + 1e-15 * d.norm());
        }
        continue;
      }
      const Vector<D, double> out = p - at_p.point;
      EXPECT_NEAR(out.dot(body.support(out)), out.dot(at_p.point), (1e-13 * out.norm() + 1e-15) * (1 + p.norm()));
      for (int i = 0; i < at_p.flat && i < D - 1; ++i) EXPECT_NEAR(out.dot(at_p.tangent[static_cast<std::size_t>(i)]), 0, 1e-13 * (1 + p.norm()));
      project_onto(body, Vector<D, double>(p + dp), start, beside);
      const double off = (beside.point - at_p.point - moves_by<D>(at_p, dp)).norm();
      smooth += lattice || off < 1e-3 * dp.norm();
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(smooth, (points - inside) * 99 / 100) << type_name(shape, D) << ": the rest may lie where two features meet";
    EXPECT_LT(inside, points * 3 / 5) << type_name(shape, D);
  }
}

TEST(Projections, FormulasHold) {
  formulas_hold<3>({{Sphere{0.5}, 0}, {Capsule{0.2, 0.7, 1}, 0}, {Box{Eigen::Vector3d(-0.3, -0.2, -1), Eigen::Vector3d(0.5, 0.4, 1), true}, 0}, {Cylinder{0.4, 0.7, 0}, 0}, {Cylinder{1, 0.01, 2}, 0},
                    {Cone{0.5, 0.6, 1}, 0}, {Cone{0.01, 1, 2}, 0}, {Cone{1, 0.01, 0}, 0}, {Cone{0.5, 0, 1}, 0}, {Cone{0, 0.5, 2}, 0}, {Cylinder{0.5, 0, 0}, 0}, {Cylinder{0, 0.5, 1}, 0}, {Capsule{0.2, 0, 1}, 0}, {Box{Eigen::Vector3d(-0.5, 0, -1), Eigen::Vector3d(0.5, 0, 1), true}, 0}, {Ellipsoid{Eigen::Vector3d(0.3, 1, 0.5)}, 0}, {Ellipsoid{Eigen::Vector3d(0.01, 1, 1)}, 0}, {Ellipsoid{Eigen::Vector3d(0.02, 0.01, 2)}, 0}});
  formulas_hold<2>({{Sphere{0.5}, 0}, {Capsule{0.2, 0.7, 1}, 0}, {Box{Eigen::Vector2d(-0.3, -0.2), Eigen::Vector2d(0.5, 0.4), true}, 0}, {Ellipsoid{Eigen::Vector2d(1, 0.02)}, 0}});
}

/// Next to a needle or a leaf, out along the normal of a point, often next to its rim or its end: that is the nearest one. It was missed by up to 6e-10 of the size.
TEST(Projections, FindThePointOfANeedleThatIsNextToThem) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-10, 0);
  for (const Eigen::Vector3d& radii : {Eigen::Vector3d(1.5e-5, 0.085, 1.1e-6), Eigen::Vector3d(1.2e-5, 0.08, 4.4e-4), Eigen::Vector3d(0.3, 1, 0.5), Eigen::Vector3d(1e-3, 1, 1), Eigen::Vector3d(0.02, 0.01, 2),
                                       Eigen::Vector3d(10, 0.0126, 2.5e-6)}) {
    const EllipsoidCore<3, double> core{radii};
    double worst = 0;
    for (int k = 0; k < 5000; ++k) {
      Eigen::Vector3d on_ball;
      for (int i = 0; i < 3; ++i) on_ball[i] = normal(random) * std::pow(10, exponent(random) / 2);
      on_ball.normalize();
      const Eigen::Vector3d point = radii.cwiseProduct(on_ball), out = on_ball.cwiseQuotient(radii).normalized();
      ProjectionStart<double> start;
      Projection<3, double> found;
      project(core, Vector<3, double>(point + std::pow(10, exponent(random)) * out), start, found);
      worst = std::max(worst, (found.point - point).norm());
    }
    EXPECT_LT(worst, 2e-14 * radii.maxCoeff()) << radii.transpose();
  }
}

/// In single precision the squares of a leaf's thickness are lost beside the rest, and Newton's step was no number: a recording with "point": null.
TEST(Projections, StepBesideALeafInNumbers) {
  const SceneFile scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "penetration", "method": {"name": "projections", "scalar": "float"}, "bodies": [
      {"shape": {"type": "ellipsoid", "radii": [0.06193677525439484, 0.028702449434633525, 1.409701264446027e-06]}, "pose": {"position": [0, 0, 0], "rotation": {"axis": [1.078778183140885, 0.7424542080541862, 0.2249611060693429], "angle": 120.06489651188392}}},
      {"shape": {"type": "cylinder", "radius": 0.011818945689533546, "half_height": 0.309236840361317}, "pose": {"position": [0.07970389339931971, -0.13382060304375973, -0.06909568704021485], "rotation": {"axis": [0.4694891910482657, -0.7262191249275073, 1.5344206532054228], "angle": 91.61720389298989}}}]})", {});
  const Recording run = record(scene);
  for (const Event& event : run.events)
    if (const auto* predicted = std::get_if<recorded::PointPredicted>(&event)) {
      EXPECT_TRUE(predicted->point.allFinite()) << predicted->iteration;
    }
  EXPECT_NO_THROW(parse_recording(recording_to_text(run), {}));
}

Settings projections(const Scene& scene, Scalar scalar = Scalar::double_precision) {
  Method method;
  method.name = MethodName::projections, method.scalar = scalar;
  return resolve_settings(method, scene);
}

bool suits(const Scene& scene) {
  try {
    (void)projections(scene);
    return true;
  } catch (const Error&) {
    return false;
  }
}

TEST(Projections, AgreeWithExactArithmeticAndWithGjk) {
  RandomScenes random(31);
  const int count = pairs_asked(4500);
  int used = 0, undecided = 0, apart = 0;
  for (int k = 0; k < count; ++k) {
    const bool polytopes = k % 2 == 0;
    const Scene scene = random.scene(1 + k % 3, static_cast<Family>(k / 3 % family_count), polytopes);
    if (!suits(scene)) continue;
    SCOPED_TRACE("pair " + std::to_string(k));
    ++used;
    Recorder recorder;
    const Result r = solve(scene, projections(scene), recorder), gjk = solve(scene, resolve_settings({}, scene));
    const double size = size_of(scene) + std::abs(*gjk.signed_distance);
    for (const Event& event : recorder.take_all())
      if (const auto* end = std::get_if<recorded::ProjectionsEnded>(&event)) undecided += end->status == ProjectionsStatus::undecided;
    apart += !gjk.intersecting;
    ASSERT_TRUE(r.signed_distance && r.lower_bound && r.upper_bound);
    EXPECT_LE(*r.lower_bound, *gjk.upper_bound);
    EXPECT_GE(*r.upper_bound, *gjk.lower_bound);
    EXPECT_GE(*r.signed_distance, *r.lower_bound - 1e-15 * size);
    EXPECT_LE(*r.signed_distance, *r.upper_bound + 1e-15 * size);
    EXPECT_EQ(*r.signed_distance, *solve(scene, projections(scene)).signed_distance) << "the same with and without a trace";
    if (polytopes) {
      if (const auto exact = oracle::signed_distance(scene)) {
        EXPECT_NEAR(*r.signed_distance, exact->signed_distance, 1e-12 * size);
        EXPECT_LE(*r.lower_bound, exact->signed_distance + 1e-15 * size);
        EXPECT_GE(*r.upper_bound, exact->signed_distance - 1e-15 * size);
      }
    }
    for (const Query query : {Query::intersect, Query::distance}) {
      Scene asked = scene;
      asked.query = query;
      const Result least = solve(asked, projections(asked));
      if (std::abs(*gjk.signed_distance) > 1e-9 * size) {
        EXPECT_EQ(least.intersecting, gjk.intersecting);
      }
      if (query == Query::distance) {
        EXPECT_NEAR(*least.signed_distance, std::max(0.0, *gjk.signed_distance), 1e-9 * size);
      } else {
        EXPECT_FALSE(least.signed_distance || least.normal || least.lower_bound);
      }
    }
    const Result single = solve(scene, projections(scene, Scalar::float_precision));
    EXPECT_NEAR(*single.signed_distance, *r.signed_distance, 2e-3 * size);
    if (k % 10 < 2) {
      SceneFile file;
      file.scene = scene, file.method.name = MethodName::projections;
      for (const Finding& finding : check(record(file))) ADD_FAILURE() << finding.step << " " << finding.code << ": " << finding.message;
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(used, count / 8);
  EXPECT_GT(apart, used / 4);
  EXPECT_LT(undecided, used / 10);
  std::printf("%d of %d pairs, %d apart; %d left to GJK\n", used, count, apart, undecided);
}

/// How far a point of the world lies outside a body, as far as is proven.
double proven_outside(const Body& body, const AnyVector& point) {
  Scene probe;
  probe.dimension = static_cast<int>(point.size()), probe.query = Query::distance;
  probe.bodies = {body, Body{"", {PointSet{PointSetKind::point, {AnyVector::Zero(probe.dimension)}, {}}, 0}, identity_pose(probe.dimension)}};
  probe.bodies[1].pose.position = point;
  return *solve(probe, resolve_settings({}, probe)).lower_bound;
}

/// However coarse the tolerance is: the plane that proves the distance leans against b - a by the root of it, and leaves the points where they are.
TEST(Projections, WitnessesLieOnTheBodies) {
  RandomScenes random(77);
  int used = 0, plain = 0;
  for (int k = 0; k < pairs_asked(3000); ++k) {
    Scene scene = random.scene(2 + k % 2, Family::general, false);
    if (!suits(scene)) continue;
    SCOPED_TRACE("pair " + std::to_string(k));
    Settings settings = projections(scene);
    if (k % 4 > 0) settings.tolerance = std::pow(10, -2 * (k / 4 % 5) - 2);
    const Result r = solve(scene, settings), yes = solve(scene, resolve_settings({}, scene));
    if (r.intersecting) continue;
    ++used;
    const double size = size_of(scene) + *r.signed_distance;
    EXPECT_LE(proven_outside(scene.bodies[0], *r.witness_a), 1e-12 * size);
    EXPECT_LE(proven_outside(scene.bodies[1], *r.witness_b), 1e-12 * size);
    EXPECT_LE((*r.witness_b - *r.witness_a - *r.signed_distance * *r.normal).norm(), 1e-14 * size);
    EXPECT_NEAR(r.normal->norm(), 1, 1e-14);
    EXPECT_LE(*r.lower_bound, *yes.upper_bound);
    EXPECT_GE(*r.upper_bound, *yes.lower_bound);
    Recorder recorder;
    const Result traced = solve(scene, settings, recorder);
    EXPECT_EQ(*traced.witness_a, *r.witness_a);
    EXPECT_EQ(*traced.normal, *r.normal);
    plain += scene.bodies[0].shape.margin == 0 && scene.bodies[1].shape.margin == 0;
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(used, pairs_asked(3000) / 20);
  std::printf("%d pairs apart, %d without a margin\n", used, plain);
}

/// Ellipsoids so thin that the numbers do not reach: steps that lead nowhere are no overlap.
/// The way between nearest points on edges is upright on both, however short it is: the plane across it proves the gap, and GJK is hardly ever asked.
TEST(Projections, DecideBesideEdgesHoweverNear) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double gap : {1e-5, 1e-8, 1e-12}) {
    int pairs = 0, decided = 0;
    for (int k = 0; k < 300; ++k) {
      Scene scene;
      scene.dimension = 3, scene.query = Query::distance;
      for (int i = 0; i < 2; ++i) {
        Body b{"", {Box{Eigen::Vector3d(-0.3 + 0.2 * uniform(random), -0.5, -0.7), Eigen::Vector3d(0.5, 0.4, 0.6), false}, 0}, identity_pose(3)};
        if (i == 0 && k % 2 == 0) b.shape = {Capsule{0, 0.7, 1}, 0};
        b.pose.matrix = Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random)).normalized().toRotationMatrix();
        b.pose.position = Eigen::Vector3d(2 * i + 0.3 * uniform(random), uniform(random), uniform(random));
        scene.bodies.push_back(b);
      }
      const Result first = solve(scene, resolve_settings({}, scene));
      if (first.intersecting) continue;
      scene.bodies[1].pose.position -= *first.normal * (*first.signed_distance - gap);
      const Result r = solve(scene, projections(scene));
      EXPECT_NEAR(*r.signed_distance, gap, 1e-14);
      ++pairs, decided += r.status == word_of(ProjectionsStatus::separated);
    }
    EXPECT_GT(decided, 0.9 * pairs) << gap;
  }
}

TEST(Projections, OfWhatIsNextToFlatClaimNoOverlap) {
  RandomScenes random(31);
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    const bool single = i % 2 == 0;
    Scene scene = random.scene(3, Family::general, false);
    AnyVector radii = AnyVector::Ones(3);
    radii[i % 3] = single ? 1e-12 : 1e-100;
    scene.bodies[0].shape = {Ellipsoid{radii}, 0};
    const AnyVector half = AnyVector::Constant(3, 0.3);
    if (i % 4 < 2) scene.bodies[1].shape = {Box{-half, half}, 0};
    else scene.bodies[1].shape = {Capsule{0, 100, 1}, 0};
    for (const Query query : {Query::distance, Query::intersect}) {
      scene.query = query;
      const Result truth = solve(scene, resolve_settings({}, scene)), r = solve(scene, projections(scene, single ? Scalar::float_precision : Scalar::double_precision));
      if (query == Query::distance) {
        ASSERT_TRUE(r.witness_a->allFinite() && r.witness_b->allFinite()) << i;
        if (truth.intersecting || *truth.signed_distance < 1e-3) break;
      }
      EXPECT_FALSE(r.intersecting) << i << ", " << word_of(query);
      ++apart;
    }
  }
  EXPECT_GT(apart, 100);
}

TEST(Projections, AreRefusedWhereThereIsNoFormula) {
  Scene scene;
  scene.bodies = {Body{"A", {Sphere{1}, 0}, identity_pose(3)}, Body{"wedge", {PointSet{PointSetKind::hull, {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}, {}}, 0}, identity_pose(3)}};
  scene.dimension = 3;
  try {
    (void)projections(scene);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), "unsupported-method");
    EXPECT_NE(std::string(e.what()).find("\"wedge\" is a hull"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace gjkdbg
