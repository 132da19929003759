// The separating axes of two polygons, or a polygon and a box, in the plane against exact arithmetic: edges that lie along one another, nearly so, slivers,
// edges of very different length, many corners, far places, one inside the other, with margins.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "algo/polygon_query.h"
#include "recordings/recording.h"
#include "shapes/convex_hull.h"
#include "tests/support/random_scenes.h"
#include "tests/support/sat_agreement.h"

namespace gjkdbg {
namespace {

class PolygonPairs {
 public:
  /// k chooses: whole numbers or not, how many corners, a box for one of them, how nearly parallel, slivers, margins, a far place, away from its origin.
  Scene scene(int k) {
    Scene s;
    s.dimension = 2, s.query = Query::penetration;
    const PointSet first = points(k);
    for (int i = 0; i < 2; ++i) {
      Shape shape{k % 4 == 1 && i == 1 ? first : points(k), k % 13 == 5 ? uniform(0, 0.5) : 0};
      if (i == 0) shape.geometry = first;
      if (k % 6 == 5 && i == k % 2) shape.geometry = Box{-Eigen::Vector2d(1, uniform(0.01, 2)), Eigen::Vector2d(uniform(0.1, 1), 0.5), false};
      Body b{i == 0 ? "A" : "B", shape, identity_pose(2)};
      for (int j = 0; j < 2; ++j) b.pose.position[j] = k % 2 == 0 ? whole(-3, 3) : uniform(-2.5, 2.5);
      if (k % 11 == 3) b.pose.position.array() += 1e5;
      const double turned = k % 5 == 0 ? 0 : k % 5 == 1 ? std::pow(10, -uniform(1, 17)) * i : k % 5 == 2 ? std::numbers::pi * i : uniform(-3, 3);
      b.pose.rotation = PlaneAngle{turned};
      b.pose.matrix = Eigen::Rotation2Dd(turned).toRotationMatrix();
      s.bodies.push_back(b);
    }
    return s;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  /// Solid: at least three corners not in a line.
  PointSet points(int k) {
    for (;;) {
      PointSet set{PointSetKind::hull, {}, {}};
      const int count = k % 17 == 4 ? 16 : whole(3, 11);
      const double thin = k % 7 == 3 ? std::pow(10, -uniform(0, 6)) : 1, away = k % 19 == 6 ? 1e3 : 0, turn = uniform(0, 6);
      for (int i = 0; i < count; ++i) {
        const double t = k % 3 == 1 ? turn + 2 * std::numbers::pi * i / count : k % 23 == 9 ? std::pow(10, -uniform(0, 9)) : uniform(0, 2 * std::numbers::pi);
        if (k % 3 == 0) set.points.push_back(Eigen::Vector2d(whole(-2, 2), whole(-2, 2) * thin));
        else set.points.push_back(Eigen::Vector2d(std::cos(t) + away, std::sin(t) * thin - away));
      }
      if (convex_hull(set.points, 2).rank == 2) return set;
    }
  }

  std::mt19937 random_{23};
};

std::vector<AnyVector> corners(const Shape& shape) {
  if (const auto* set = std::get_if<PointSet>(&shape.geometry)) return set->points;
  const Box& box = std::get<Box>(shape.geometry);
  return {box.min, Eigen::Vector2d(box.max[0], box.min[1]), box.max, Eigen::Vector2d(box.min[0], box.max[1])};
}

double extent(const Scene& scene) {
  double size = 0;
  for (const Body& body : scene.bodies)
    for (const AnyVector& p : corners(body.shape)) size = std::max(size, p.norm() + body.shape.margin);
  return size;
}

/// How far a point lies outside the core of a body of the scene, at most, beyond its margin.
double outside_polygon(const Body& body, const AnyVector& point) {
  const AnyVector local = body.pose.matrix.transpose() * (point - body.pose.position);
  const std::vector<AnyVector> all = corners(body.shape);
  const auto loop = convex_hull(all, 2).faces.front();
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const AnyVector &from = all[static_cast<std::size_t>(loop[i])], &to = all[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
    const Eigen::Vector2d edge = to - from, n = Eigen::Vector2d(edge[1], -edge[0]).normalized();
    most = std::max(most, n.dot(Eigen::Vector2d(local - from)) - body.shape.margin);
  }
  return most;
}

TEST(PolygonSat, AgreesWithExactArithmetic) {
  PolygonPairs random;
  SatAgreement agreement{&outside_polygon, 0};
  for (int k = 0; k < pairs_asked(3000) && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE("pair " + std::to_string(k));
    const Scene scene = random.scene(k);
    agreement.judge(scene, extent(scene));
  }
  agreement.finish();
  EXPECT_LT(agreement.by_gjk, agreement.pairs / 20);
}

/// The trace looks along one edge after the other, the query four at a time, and on some processors in other instructions: the same numbers.
TEST(PolygonSat, TracesWhatItComputes) {
  PolygonPairs random;
  int projected = 0;
  for (int k = 0; k < 2000; ++k) {
    Scene scene = random.scene(k);
    if (k % 8 == 7) scene.query = Query::intersect;
    for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
      Recorder recorder;
      const Result r = solve(scene, sat(scene, scalar), recorder), silent = solve(scene, sat(scene, scalar));
      EXPECT_EQ(r.intersecting, silent.intersecting);
      EXPECT_EQ(r.signed_distance, silent.signed_distance) << k;
      EXPECT_EQ(r.normal, silent.normal);
      EXPECT_EQ(r.witness_a, silent.witness_a);
      EXPECT_EQ(r.witness_b, silent.witness_b);
      EXPECT_EQ(r.lower_bound, silent.lower_bound);
      EXPECT_EQ(r.iterations, silent.iterations);
      EXPECT_EQ(r.support_calls, silent.support_calls);
      if (scalar == Scalar::float_precision) continue;
      const double near = 1e-14 * (extent(scene) + scene.bodies[0].pose.position.norm());
      for (const auto& event : recorder.take_all()) {
        projected += std::holds_alternative<recorded::PointsProjected>(event);
        const auto* axis = std::get_if<recorded::AxisTested>(&event);
        if (!axis) continue;
        EXPECT_NEAR(axis->direction.norm(), 1, 1e-14);
        EXPECT_NEAR(axis->distance, across(scene, axis->direction), near) << k;
      }
    }
  }
  EXPECT_GT(projected, 100);
}

#ifdef GJKDBG_AVX2
[[gnu::target("avx2")]] PolygonEights::Widest widest_named(const PolygonQuery<double>& query, const PolygonQuery<double>::Placed& placed) { return query.widest_by_eights(placed); }

/// Single precision names an edge only where it is the one, and mostly does.
TEST(PolygonSat, SinglePrecisionNamesTheWidestEdgeOrNone) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2";
  PolygonPairs random;
  int looked_for = 0, named = 0, in_general = 0, named_in_general = 0;
  for (int k = 0; k < 6000; ++k) {
    const Scene scene = random.scene(k);
    const Convex<2, double> core_a(scene.bodies[0].shape), core_b(scene.bodies[1].shape);
    if (!PolygonQuery<double>::answers(core_a, core_b)) continue;
    const PolygonQuery<double> query(core_a, core_b, 1);
    if (!query.eights()) continue;
    const auto placed = query.placed(scene.bodies[0].pose, scene.bodies[1].pose);
    GreatestOfFours<double> widest;
    const PolygonPair<double> pair{query.a(), query.b(), placed.pose.rotation, placed.pose.position};
    for (int i = 0; i < 2; ++i) widest.take(separations<true>(query.a().four(i), pair));
    for (int i = 0; i < 2; ++i) widest.take(separations<false>(query.b().four(i), pair));
    const PolygonEights::Widest found = widest_named(query, placed);
    const bool general = k % 3 == 2 && k % 4 != 1 && k % 5 > 2 && k % 7 != 3 && k % 19 != 6 && k % 11 != 3;  // neither parallel nor thin nor far out
    ++looked_for, in_general += general;
    if (!found.sure) continue;
    ++named, named_in_general += general;
    const int place = static_cast<int>(widest.found().place);  // the last edge stands for those that are not there
    EXPECT_EQ(found.place, place < 8 ? std::min(place, query.a().size() - 1) : 8 + std::min(place - 8, query.b().size() - 1)) << k;
  }
  EXPECT_GT(looked_for, 800);
  EXPECT_GT(named, looked_for / 2);
  EXPECT_GT(in_general, 40);
  EXPECT_EQ(named_in_general, in_general);
}
#endif

/// Tip to tip, so sharp that along every edge's normal the gap is less than rounding: bodies well apart, once taken for an overlap; in space edge to edge.
TEST(PolygonSat, NeedlesTipToTipAreApart) {
  for (const int dimension : {2, 3})
    for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision})
      for (const double thin : {1e-3, 1e-6, 1e-9, 1e-11, 1e-12})
        for (const double gap : {1e-5, 1e-3, 1e-2}) {
          SCOPED_TRACE(std::to_string(dimension) + "D, thickness " + std::to_string(std::log10(thin)) + ", gap " + std::to_string(gap));
          Scene scene;
          scene.dimension = dimension, scene.query = Query::penetration;
          for (const double side : {-1.0, 1.0}) {
            PointSet set{PointSetKind::hull, {}, {}};
            for (const double end : {-1.0, 1.0}) {
              if (dimension == 2) set.points.push_back(Eigen::Vector2d(side, end * thin));
              else for (const double y : {-1.0, 1.0}) set.points.push_back(Eigen::Vector3d(side, y, end * thin));
              if (dimension == 3) set.points.push_back(Eigen::Vector3d(0, end, 0));
            }
            if (dimension == 2) set.points.push_back(Eigen::Vector2d(0, 0));
            Body b{"", {set, 0}, identity_pose(dimension)};
            if (side > 0) b.pose.position[0] = gap;
            scene.bodies.push_back(b);
          }
          const Result r = solve(scene, sat(scene, scalar));
          EXPECT_FALSE(r.intersecting) << r.status;
          EXPECT_NEAR(*r.signed_distance, gap, scalar == Scalar::float_precision ? 1e-6 * gap : 1e-15);
          EXPECT_LE(*r.lower_bound, gap);
          EXPECT_GE(*r.upper_bound, gap);
          scene.query = Query::intersect;
          EXPECT_FALSE(solve(scene, sat(scene, scalar)).intersecting);
        }
}

/// In single precision a sliver's edges all face the same way, and the one that is looked across may be far from the nearest: it takes several rounds. In each
/// a is the point of A nearest to b, whichever body the edge is of.
TEST(PolygonSat, ProjectsOnASliverRoundByRound) {
  PointSet pentagon{PointSetKind::hull, {}, {}}, sliver{PointSetKind::hull, {}, {}};
  for (int i = 0; i < 5; ++i) pentagon.points.push_back(Eigen::Vector2d(std::cos(0.4 * std::numbers::pi * i), std::sin(0.4 * std::numbers::pi * i)));
  for (int i = 0; i < 7; ++i) sliver.points.push_back(Eigen::Vector2d(std::cos(2 * std::numbers::pi * i / 7), 6e-12 * std::sin(2 * std::numbers::pi * i / 7)));
  for (const bool swapped : {false, true}) {
    Scene scene;
    scene.dimension = 2, scene.query = Query::penetration;
    scene.bodies = {Body{"A", {pentagon, 0}, identity_pose(2)}, Body{"B", {sliver, 0}, identity_pose(2)}};
    scene.bodies[0].pose.position = Eigen::Vector2d(-1, 1);
    if (swapped) std::swap(scene.bodies[0], scene.bodies[1]);
    Recorder recorder;
    const Result r = solve(scene, sat(scene, Scalar::float_precision), recorder);
    EXPECT_NEAR(*r.signed_distance, 1 - std::sin(0.4 * std::numbers::pi), 1e-6);
    int answers = 0;
    for (const auto& event : recorder.take_all())
      if (const auto* e = std::get_if<recorded::PointsProjected>(&event)) {
        const AnyVector n = -e->closest.normalized();
        EXPECT_NEAR(n.dot(e->a), n.dot(WorldSupport(scene.bodies[0], 2)(n, true)), 1e-6);
        ++answers;
      }
    EXPECT_GE(answers, 2);
  }
}

/// Corner to corner and corner to another edge: no axis tells the distance, projections do.
TEST(PolygonSat, ProjectsPointsWhereNoAxisTellsTheDistance) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int apart = 0, projected = 0;
  for (int k = 0; k < 2000; ++k) {
    Scene scene;
    scene.dimension = 2, scene.query = Query::penetration;
    for (int i = 0; i < 2; ++i) {
      PointSet set{PointSetKind::hull, {}, {}};
      for (int j = 0; j < 3 + k % 7; ++j) {
        const double t = 2 * std::numbers::pi * (j + 0.3 * uniform(random)) / (3 + k % 7);
        set.points.push_back(Eigen::Vector2d(std::cos(t), std::sin(t)));
      }
      Body b{"", {set, 0}, identity_pose(2)};
      b.pose.position = Eigen::Vector2d(3 * uniform(random), 3 * uniform(random));
      scene.bodies.push_back(b);
    }
    const auto exact = oracle::signed_distance(scene);
    ASSERT_TRUE(exact);
    if (exact->signed_distance < 1e-3) continue;
    ++apart;
    projected += projections_of_sat(scene, exact->signed_distance, outside_polygon) > 0;
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(projected, apart / 8);
}

}  // namespace
}  // namespace gjkdbg
