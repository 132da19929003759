// Cases at the edges that once went wrong: rounding that says "enclosed", corners within an edge, cores in one place, bodies at rest, lengths below
// the normal numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "algo/johnson.h"
#include "algo/signed_volumes.h"
#include "algo/solve.h"
#include "recordings/scene_file.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

Scene scene_of(const std::string& rest) { return parse_scene(R"({"format": "gjk-scene", "version": 1, )" + rest + "}", {}).scene; }

Result run(const Scene& scene, const Method& method) { return solve(scene, resolve_settings(method, scene)); }

Method johnson(Scalar scalar = Scalar::double_precision) {
  Method m;
  m.closest_point = ClosestPoint::johnson, m.scalar = scalar;
  return m;
}

TEST(EdgeCases, NoSubAlgorithmOverrulesASupportPlane) {
  const Scene scene = scene_of(R"("dimension": 3, "query": "distance", "bodies": [
    {"shape": {"type": "cone", "radius": 0.3, "half_height": 0.4}},
    {"shape": {"type": "cylinder", "radius": 0.3, "half_height": 0.7}, "pose": {"position": [-0.8, -0.1, 0.1], "rotation": {"axis": [1, 0, 0], "angle": 55}}}])");
  const Result r = run(scene, johnson());
  EXPECT_FALSE(r.intersecting);
  EXPECT_NEAR(*r.signed_distance, 0.228868022329, 1e-11);
  RandomScenes random(11);
  for (int i = 0; i < pairs_asked(4000); ++i) {
    Scene pair = random.scene(3, Family::general, false);
    pair.query = Query::distance;
    const Result truth = run(pair, {});
    for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
      const Result answer = run(pair, johnson(scalar));
      EXPECT_LE(*answer.lower_bound, *answer.upper_bound) << i;
      if (std::abs(*truth.signed_distance) > 1e-4) {
        EXPECT_EQ(answer.intersecting, truth.intersecting) << i;
      }
    }
  }
}

TEST(EdgeCases, ACornerWithinAnEdgeCutsNoContactOff) {
  for (int degrees = 0; degrees < 360; ++degrees) {
    const double turn = degrees * std::numbers::pi / 180;
    Scene scene = scene_of(R"("dimension": 2, "query": "contact", "bodies": [
      {"shape": {"type": "polygon", "points": [[-2, 1], [-2, -2], [-2, 2], [2, 0]]}}, {"shape": {"type": "box", "half_extents": [0.5, 3]}}])");
    const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(turn).toRotationMatrix();
    for (Body& b : scene.bodies) b.pose.matrix = rotation;
    scene.bodies[1].pose.position = rotation * Eigen::Vector2d(-2.4, 0);
    const Result r = run(scene, {});
    ASSERT_EQ(r.contacts->size(), 2u) << degrees;
    EXPECT_NEAR(((*r.contacts)[0].point_a - (*r.contacts)[1].point_a).norm(), 4, 1e-9) << degrees;
  }
}

/// How far a point is from a body's border, negative inside.
double off_border(const Body& body, const AnyVector& point, int dimension) {
  Scene probe;
  probe.dimension = dimension, probe.query = Query::penetration;
  probe.bodies = {body, Body{"", {PointSet{PointSetKind::point, {AnyVector::Zero(dimension)}, {}}, 0}, identity_pose(dimension)}};
  probe.bodies[1].pose.position = point;
  return *run(probe, {}).signed_distance;
}

TEST(EdgeCases, WitnessesOfRoundDepthsLieOnTheBodies) {
  RandomScenes random(5);
  double worst = 0;
  for (int k = 0; k < 400; ++k) {
    const auto ellipse = [&] {
      return R"({"shape": {"type": "ellipse", "radii": [)" + std::to_string(random.uniform(0.2, 1.5)) + ", " + std::to_string(random.uniform(0.2, 1.5)) + R"(]}, "pose": {"position": [)" +
             std::to_string(random.uniform(-0.5, 0.5)) + ", " + std::to_string(random.uniform(-0.5, 0.5)) + R"(], "rotation": {"angle": )" + std::to_string(random.uniform(0, 360)) + "}}}";
    };
    const Scene scene = scene_of(R"("dimension": 2, "query": "penetration", "bodies": [)" + ellipse() + ", " + ellipse() + "]");
    const Result r = run(scene, {});
    if (!r.intersecting) continue;
    worst = std::max({worst, std::abs(off_border(scene.bodies[0], *r.witness_a, 2)), std::abs(off_border(scene.bodies[1], *r.witness_b, 2))});
  }
  EXPECT_LT(worst, 1e-9);  // at a tolerance of 1e-10; 2e-6 where they lay on the chord
}

TEST(EdgeCases, AFlatOfTwoTrianglesGivesTheWholeContact) {
  const Scene scene = scene_of(R"("dimension": 3, "query": "contact", "bodies": [
    {"shape": {"type": "mesh", "points": [[-2, 0, -2], [2, 0, -2], [2, 0, 2], [-2, 0, 2]], "triangles": [[0, 2, 1], [0, 3, 2]]}},
    {"shape": {"type": "box", "half_extents": [0.5, 0.5, 0.5]}, "pose": {"position": [0, 0.49, 0]}}])");
  const Result r = run(scene, {});
  ASSERT_EQ(r.contacts->size(), 4u);
  for (const ContactPoint& p : *r.contacts) {
    EXPECT_NEAR(p.depth, 0.01, 1e-12);
    EXPECT_NEAR(std::abs(p.point_a[0]), 0.5, 1e-12);
    EXPECT_NEAR(std::abs(p.point_a[2]), 0.5, 1e-12);
  }
}

TEST(EdgeCases, WholeTurnsAreTakenOffInDegrees) {
  const auto turned = [](const std::string& angle) {
    return scene_of(R"("dimension": 2, "query": "distance", "bodies": [{"shape": {"type": "circle", "radius": 1}, "pose": {"rotation": {"angle": )" + angle + R"(}}}, {"shape": {"type": "circle", "radius": 1}}])").bodies[0].pose.matrix;
  };
  EXPECT_EQ(turned("3600000000280"), turned("280"));
  EXPECT_EQ(turned("-100000000000000000"), turned("-280"));
}

TEST(EdgeCases, BoundsHoldTheDepthOfConcentricBalls) {
  const Scene scene = scene_of(R"("dimension": 3, "query": "penetration", "bodies": [{"shape": {"type": "sphere", "radius": 0.1}}, {"shape": {"type": "sphere", "radius": 0.2}}])");
  const long double exact = -(static_cast<long double>(0.1) + static_cast<long double>(0.2));
  for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
    Method m;
    m.scalar = scalar;
    const Result r = run(scene, m);
    EXPECT_LE(*r.lower_bound, exact);
    EXPECT_GE(*r.upper_bound, exact);
    EXPECT_LE(*r.lower_bound, *r.signed_distance);
    EXPECT_GE(*r.upper_bound, *r.signed_distance);
    EXPECT_LT(*r.upper_bound - *r.lower_bound, 1e-15);
  }
}

TEST(EdgeCases, MprNamesADirectionForOnePointTwice) {
  const Scene scene = scene_of(R"("dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "point", "points": [[1, 2, 3]]}}, {"shape": {"type": "point", "points": [[1, 2, 3]]}}])");
  Method m;
  m.name = MethodName::mpr;
  const Result r = run(scene, m);
  EXPECT_TRUE(r.intersecting);
  EXPECT_DOUBLE_EQ(r.normal->norm(), 1);
}

/// A tolerance is for distances; yes and no are proven.
TEST(EdgeCases, ACoarseToleranceDoesNotDecideYesOrNo) {
  RandomScenes random(31);
  int overlaps = 0;
  for (int k = 0; k < 300; ++k) {
    Scene scene = scene_of(R"("dimension": 2, "query": "penetration", "bodies": [{"shape": {"type": "ellipse", "radii": [1, 0.3]}}, {"shape": {"type": "circle", "radius": 1}}])");
    const double angle = random.uniform(0, 6.28);
    const AnyVector away = Eigen::Vector2d(std::cos(angle), std::sin(angle));
    scene.bodies[1].pose.position = 3 * away;
    const Result apart = run(scene, {});
    scene.bodies[1].pose.position -= (*apart.signed_distance + random.uniform(-1e-3, 1e-3)) * *apart.normal;
    const double truth = *run(scene, {}).signed_distance;
    if (std::abs(truth) < 1e-8) continue;
    overlaps += truth < 0;
    scene.query = Query::intersect;
    for (const double tolerance : {1e-4, 1e-2, 0.9}) {
      Method m;
      m.tolerance = tolerance;
      EXPECT_EQ(run(scene, m).intersecting, truth < 0) << truth << " at " << tolerance;
    }
  }
  EXPECT_GT(overlaps, 50);
}

TEST(EdgeCases, ASimulationNeedsADepth) {
  Scene scene = scene_of(R"("dimension": 3, "query": "simulate", "steps": 3, "bodies": [{"shape": {"type": "box", "half_extents": [1, 1, 1]}}, {"shape": {"type": "box", "half_extents": [1, 1, 1]}}])");
  Method m;
  m.penetration = Penetration::none;
  EXPECT_THROW(resolve_settings(m, scene), Error);
  m.penetration = Penetration::mpr;
  EXPECT_NO_THROW(resolve_settings(m, scene));
}

/// What counts as flat when a hull is taken is not quite: a corner that sticks out by less than 1e-14 of the size was lost, and the bounds with it.
TEST(EdgeCases, NearlyFlatHullsKeepTheirCorners) {
  for (const int dimension : {2, 3})
    for (const PointSetKind kind : {PointSetKind::hull, PointSetKind::triangle})
      for (const double height : {1e-16, 3e-15, 9e-15, 1.5e-14, 2.5e-14, 1e-13}) {
        Scene scene;
        scene.dimension = dimension, scene.query = Query::penetration;
        const auto at = [&](double x, double y, double z) { return dimension == 2 ? AnyVector(Eigen::Vector2d(x, y)) : AnyVector(Eigen::Vector3d(x, y, z)); };
        PointSet roof{kind, {at(-1, 0, -1), at(1, 0, -1), at(0, height, 0)}, {}};
        if (dimension == 3 && kind == PointSetKind::hull) roof.points.push_back(at(0, 0, 1));
        scene.bodies = {Body{"A", {roof, 0}, identity_pose(dimension)}, Body{"B", {PointSet{PointSetKind::point, {at(0, 1, 0)}, {}}, 0}, identity_pose(dimension)}};
        const Result r = solve(scene, resolve_settings({}, scene));
        EXPECT_LE(*r.lower_bound, 1 - height) << dimension << " " << height;
        EXPECT_GE(*r.upper_bound, 1 - height) << dimension << " " << height;
        // Its ridge in a box, which it leaves downwards: SAT does not know faces that turn away by so little.
        scene.bodies[1] = Body{"B", {Box{AnyVector::Constant(dimension, -2), AnyVector::Constant(dimension, 2), true}, 0}, identity_pose(dimension)};
        scene.bodies[1].pose.position[1] = 1.5;
        Method sat;
        sat.name = MethodName::sat;
        const Result deep = solve(scene, resolve_settings(sat, scene));
        EXPECT_LE(*deep.lower_bound, -0.5 - height) << dimension << " " << height;
        EXPECT_GE(*deep.upper_bound, -0.5 - height) << dimension << " " << height;
      }
}

/// A corner that hardly sticks out of a face is not dropped, either, where the bounds would miss it.
TEST(EdgeCases, HullsKeepACornerThatHardlySticksOut) {
  for (int k = 1; k < 400; ++k) {
    const double height = 1 + k * 0x1p-52;
    Scene scene;
    scene.query = Query::penetration;
    PointSet roof{PointSetKind::hull, {Eigen::Vector3d(0, 0, height)}, {}};
    for (int i = 0; i < 8; ++i) roof.points.push_back(Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    scene.bodies = {Body{"A", {roof, 0}, identity_pose(3)}, Body{"B", {PointSet{PointSetKind::point, {Eigen::Vector3d(0, 0, 2)}, {}}, 0}, identity_pose(3)}};
    const Result r = solve(scene, resolve_settings({}, scene));
    EXPECT_LE(*r.lower_bound, 2 - height) << k;
    EXPECT_GE(*r.upper_bound, 2 - height) << k;
  }
}

/// SAT needs the corners of a sum, which are as many as pairs of its parts': it once looked for features that nobody had made.
TEST(EdgeCases, SatRefusesASumOfTooManyCorners) {
  const auto ring = [](int corners) {
    PointSet set{PointSetKind::hull, {}, {}};
    for (int i = 0; i < corners; ++i) set.points.push_back(Eigen::Vector2d(std::cos(2 * std::numbers::pi * i / corners), std::sin(2 * std::numbers::pi * i / corners)));
    return std::make_shared<const Shape>(Shape{set, 0});
  };
  const auto scene = [&](int corners) {
    Scene s;
    s.dimension = 2, s.query = Query::penetration;
    s.bodies = {Body{"A", {Sum{ring(corners), ring(corners)}, 0}, identity_pose(2)}, Body{"B", *ring(5), identity_pose(2)}};
    return s;
  };
  Method sat;
  sat.name = MethodName::sat;
  EXPECT_EQ(solve(scene(64), resolve_settings(sat, scene(64))).status, "overlapping");
  EXPECT_THROW(resolve_settings(sat, scene(65)), Error);
}

TEST(EdgeCases, TwoBodiesAtRestAreAskedWhetherTheyOverlap) {
  for (const MethodName name : {MethodName::conservative_advancement, MethodName::ray_cast, MethodName::root_finding})
    for (const double x : {0.5, 2.5}) {
      Scene scene = scene_of(R"("dimension": 3, "query": "cast", "bodies": [{"shape": {"type": "box", "half_extents": [1, 1, 1]}}, {"shape": {"type": "box", "half_extents": [1, 1, 1]}}])");
      scene.bodies[1].pose.position[0] = x;
      Method m;
      m.name = name;
      const Result r = run(scene, m);
      EXPECT_EQ(r.status, x < 2 ? "initially_overlapping" : "miss");
      EXPECT_EQ(r.intersecting, x < 2);
      // Two walls at rest may overlap for all that the ball beside them cares.
      scene.bodies.push_back(scene.bodies[0]);
      scene.bodies[2].pose.position[1] = 5, scene.bodies[2].motion->velocity[0] = 1;
      EXPECT_EQ(run(scene, m).status, "miss");
    }
}

/// |p + v t| = r has the smaller root (-p.v - sqrt((p.v)^2 - v.v (p.p - r^2))) / v.v.
TEST(EdgeCases, ARayInFloatIsNeverLate) {
  RandomScenes random(5);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Scene scene = scene_of(R"("dimension": 3, "query": "cast", "bodies": [{"shape": {"type": "sphere", "radius": 0.5}}, {"shape": {"type": "sphere", "radius": 0.25}}])");
    const Eigen::Vector3d p(random.uniform(1, 3), random.uniform(-1, 1), random.uniform(-1, 1)), v(random.uniform(-6, -1), random.uniform(-1, 1), random.uniform(-1, 1));
    scene.bodies[1].pose.position = p, scene.bodies[1].motion->velocity = v;
    const double pv = p.dot(v), vv = v.dot(v), root = pv * pv - vv * (p.dot(p) - 0.5625);
    if (root < 1e-3) continue;  // grazing
    const double time = (-pv - std::sqrt(root)) / vv;
    if (time <= 0 || time > 0.99) continue;
    Method m;
    m.name = MethodName::ray_cast, m.scalar = Scalar::float_precision;
    const Result r = run(scene, m);
    ASSERT_TRUE(r.intersecting) << i;
    EXPECT_LE(*r.time, time) << i;
    EXPECT_NEAR(*r.time, time, 1e-4) << i;
    EXPECT_GE(r.touching_at.value_or(1), time) << i;
    ++hits;
  }
  EXPECT_GT(hits, 200);
}

TEST(EdgeCases, LengthsBelowTheNormalNumbers) {
  const Scene scene = scene_of(R"("dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "box", "half_extents": [1e-310, 1e-310, 1e-310]}}, {"shape": {"type": "box", "half_extents": [1e-310, 1e-310, 1e-310]}, "pose": {"position": [1.5e-310, 0, 0]}}])");
  const Result r = run(scene, {});
  EXPECT_TRUE(r.intersecting);
  EXPECT_NEAR(*r.signed_distance / 1e-310, -0.5, 1e-10);
  EXPECT_NEAR(r.normal->norm(), 1, 1e-15);
}

/// A simplex as flat as 1e-16 of its size, around the origin: volumes in plain arithmetic are noise, and weights made of them put the common point 400 outside.
TEST(EdgeCases, WeightsOfAFlatSimplexAroundTheOrigin) {
  using V = Eigen::Vector3d;
  const V w[] = {{2810.403518979995, -705.740376336218, -1215.1224243218005},
                 {2810.4035189799947, -705.7481279341624, -1215.1179221878901},
                 {2810.4035189799947, -705.7326247368399, -1215.1269264102584},
                 {-1205.047108698051, 302.6079468902094, 521.0211742542091}};
  const auto feature = SignedVolumes<3, double>::closest(w, 4);
  ASSERT_TRUE(feature.enclosed);
  V made = V::Zero();
  for (int i = 0; i < 4; ++i) made += feature.weight[i] * w[feature.index[i]];
  EXPECT_LE(made.norm(), 1e-9);
}

/// From a stack of boxes at rest: two supports of the same height to the last digit but one, a third below. Cofactors cancel to 1e-17 of themselves.
template <class ClosestPoint>
void weights_make_the_origin() {
  using V = Eigen::Vector2d;
  const V w[] = {{-4.520000003705495, 6.330430846190893e-09}, {-5.520000003704971, -1.0168620712125431e-06}, {5.479999996294505, 6.330430846190893e-09}};
  const auto feature = ClosestPoint::closest(w, 3);
  ASSERT_TRUE(feature.enclosed);
  V made = V::Zero();
  for (int i = 0; i < 3; ++i) made += feature.weight[i] * w[feature.index[i]];
  EXPECT_LE(made.norm(), 1e-12);
}
TEST(EdgeCases, WeightsOfAFlatTriangleAroundTheOrigin) {
  weights_make_the_origin<SignedVolumes<2, double>>();
  weights_make_the_origin<Johnson<2, double>>();
  weights_make_the_origin<VoronoiRegions<2, double>>();
}

/// In single precision GJK calls them touching, and MPR's portal lies 0.001 on the near side of the origin: that is a gap, not an overlap 0.001 apart.
TEST(EdgeCases, ADepthBelowZeroIsNoOverlap) {
  const Scene scene = scene_of(R"("dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "box", "half_extents": [1000, 0.001, 0.001]}},
    {"shape": {"type": "box", "half_extents": [0.001, 1000, 0.001]}, "pose": {"position": [0, 0, 0.003]}}])");
  Method m;
  m.scalar = Scalar::float_precision, m.penetration = Penetration::mpr;
  const Result r = run(scene, m);
  EXPECT_NEAR(*r.signed_distance, 0.001, 1e-6);
  EXPECT_FALSE(r.intersecting);
}

/// From a cylinder and a capsule: the origin lies 4e-13 beside a tetrahedron 1e-10 thick, too little for Johnson's cofactors. Weights of an inside would miss it by
/// 6e-3; those of the nearest edge do not.
TEST(EdgeCases, WeightsOfASliverThatIsOnlyCalledEnclosing) {
  using V = Eigen::Vector3d;
  const V w[] = {{2.5, -2.0000184150981237, -1.6955792325745733e-10}, {2.5, 2.0000013056481696, -8.523182160047327e-13}, {-2.5, -2.0000001914059955, -1.8318679906315083e-14}, {2.5, -2.000000000042176, 0}};
  const auto feature = Johnson<3, double>::closest(w, 4);
  ASSERT_TRUE(feature.enclosed);
  V made = V::Zero();
  for (int i = 0; i < 4; ++i) made += feature.weight[i] * w[feature.index[i]];
  EXPECT_LE(made.norm(), 1e-12);
}

/// Short of the origin, or beyond it: a portal at the limit says neither, and was taken for an overlap.
TEST(EdgeCases, MprAtItsLimitClaimsNoMoreThanItHasProven) {
  RandomScenes random(4);
  int undecided = 0;
  for (int i = 0; i < pairs_asked(3000); ++i) {
    Scene pair = random.scene(2 + i % 2, Family::general, i % 4 < 2);
    const Result truth = run(pair, {});
    Method m;
    m.name = MethodName::mpr;
    for (m.max_iterations = 1; *m.max_iterations <= 6; ++*m.max_iterations)
      for (const Query query : {Query::intersect, Query::distance, Query::penetration}) {
        pair.query = query;
        const Result r = run(pair, m);
        undecided += unanswered(r);
        if (!unanswered(r) && std::abs(*truth.signed_distance) > 1e-6) {
          EXPECT_EQ(r.intersecting, truth.intersecting) << i << " limit " << *m.max_iterations;
        }
        if (!r.lower_bound || !r.upper_bound) continue;
        const double right = query == Query::distance ? std::max(0.0, *truth.signed_distance) : *truth.signed_distance;
        EXPECT_LE(*r.lower_bound, right + 1e-9) << i;
        EXPECT_GE(*r.upper_bound, right - 1e-9) << i;
      }
  }
  EXPECT_GT(undecided, 0);
}

/// Where the origin's projection lies beside the face that is the answer, the points of the face are off the bodies: by 1.6e-5 here, once.
TEST(EdgeCases, WitnessesOfCurvedBodiesLieOnThem) {
  for (const char* radii : {"2.718805920765648, 2.67978875828775", "1.1, 0.9", "0.7, 2.9"}) {
    const Result r = run(scene_of(R"("dimension": 2, "query": "penetration", "bodies": [{"shape": {"type": "ellipse", "radii": [)" + std::string(radii) + R"(]}}, {"shape": {"type": "point", "points": [[0, 0]]}}])"), {});
    EXPECT_LT(r.witness_b->norm(), 1e-9) << radii;
    EXPECT_NEAR(r.witness_a->norm(), -*r.signed_distance, 1e-9) << radii;
  }
}

/// Squares of lengths of 1e-170 are no numbers: the box's extent was 0 by them, and the difference flat. The other body has no extent of its own.
TEST(EdgeCases, ABoxSmallerThanItsSquares) {
  for (const char* body : {R"({"type": "box", "half_extents": [1e-200, 1e-200, 2e-200]})", R"({"type": "hull", "points": [[1e-200, 0, 0], [-1e-200, 1e-200, 0], [-1e-200, -1e-200, 0], [0, 0, 2e-200], [0, 0, -2e-200]]})"}) {
    const Result r = run(scene_of(R"("dimension": 3, "bodies": [{"shape": )" + std::string(body) + R"(}, {"shape": {"type": "sphere", "radius": 1e-200}}])"), {});
    EXPECT_EQ(r.status, "converged") << body;
    EXPECT_NEAR(r.normal->norm(), 1, 1e-12) << body;
    EXPECT_LT(*r.signed_distance, -1.3e-200) << body;
  }
}

/// Of one triangle the core lies in the box, of the other only the margin: the whole is deeper than the margin, by as much as was not asked for.
TEST(EdgeCases, AMeshIsAsDeepAsItsDeepestPart) {
  for (const char* triangles : {"[[0, 1, 2], [3, 4, 5]]", "[[3, 4, 5], [0, 1, 2]]"}) {
    const Scene scene = scene_of(R"("dimension": 3, "bodies": [{"shape": {"type": "mesh", "margin": 0.5, "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.25], [1, 0, 1.25], [0, 1, 1.25]], "triangles": )" + std::string(triangles) +
                                 R"(}}, {"shape": {"type": "box", "half_extents": [1, 1, 1]}}])");
    Method no_depth;
    no_depth.penetration = Penetration::none;
    const Result r = run(scene, no_depth);
    EXPECT_TRUE(r.intersecting);
    EXPECT_FALSE(r.signed_distance || r.lower_bound || r.normal);
    EXPECT_NEAR(*r.upper_bound, -0.5, 1e-15);
  }
}

}  // namespace
}  // namespace gjkdbg
