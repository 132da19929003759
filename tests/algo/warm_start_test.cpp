// Warm starts: the same answers from the simplex of the run before, in fewer steps, and no drift however long they go on.
#include <gtest/gtest.h>

#include "algo/prepared_pair.h"
#include "algo/solve.h"
#include "recordings/replay.h"
#include "shapes/error.h"
#include "shapes/world_support.h"
#include "tests/oracle/exact_polytopes.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

/// A pair of hulls, one of which turns and passes the other: apart, through it, apart again.
class Passing {
 public:
  Passing() {
    RandomScenes random(3);
    for (const char* name : {"A", "B"}) {
      PointSet points;
      for (int i = 0; i < 40; ++i) points.points.push_back(Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized());
      bodies_.push_back(Body{name, {points, 0}, identity_pose(3)});
    }
  }
  Scene at(double time) const {
    Scene s;
    s.dimension = 3, s.query = Query::penetration, s.bodies = bodies_;
    s.bodies[1].pose.position = Eigen::Vector3d(4 * time - 2, 1.1 - time / 2, 0.3);
    s.bodies[1].pose.matrix = Eigen::AngleAxisd(2 * time, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    return s;
  }

 private:
  std::vector<Body> bodies_;
};

Settings settings(const Scene& scene, Start start) {
  Method method;
  method.start = start;
  return resolve_settings(method, scene);
}

TEST(WarmStart, AgreesWithAColdOneInFewerSteps) {
  const Passing passing;
  const Scene first = passing.at(0);
  const auto warm = prepare(first.bodies[0], first.bodies[1], 3, Scalar::double_precision), cold = prepare(first.bodies[0], first.bodies[1], 3, Scalar::double_precision);
  const Settings previous = settings(first, Start::previous), centres = settings(first, Start::centres);
  int warm_supports = 0, cold_supports = 0, apart = 0, deep = 0;
  constexpr int steps = 2000;
  for (int i = 0; i <= steps; ++i) {
    const Scene scene = passing.at(static_cast<double>(i) / steps);
    for (const auto* pair : {&warm, &cold}) (*pair)->place(scene.bodies[0].pose, scene.bodies[1].pose);
    const Result w = warm->run(previous, Query::penetration), c = cold->run(centres, Query::penetration);
    EXPECT_NEAR(*w.signed_distance, *c.signed_distance, 1e-13) << i;
    EXPECT_EQ(w.intersecting, c.intersecting);
    if (std::abs(*c.signed_distance) > 1e-6) {
      EXPECT_LT((*w.normal - *c.normal).norm(), 1e-6) << i;
    }
    (c.intersecting ? deep : apart) += 1;
    if (!c.intersecting) warm_supports += w.support_calls, cold_supports += c.support_calls;
    if (i % 200 == 0) {
      EXPECT_NEAR(*w.signed_distance, oracle::signed_distance(scene)->signed_distance, 1e-13);
    }
  }
  EXPECT_GT(apart, 200);
  EXPECT_GT(deep, 200);
  EXPECT_LT(warm_supports * 2, cold_supports);
  std::printf("apart: %.2f supports a query warm, %.2f cold\n", static_cast<double>(warm_supports) / apart, static_cast<double>(cold_supports) / apart);
}

TEST(WarmStart, DoesNotDrift) {
  const Passing passing;
  const Scene first = passing.at(0);
  const auto pair = prepare(first.bodies[0], first.bodies[1], 3, Scalar::double_precision);
  const Settings previous = settings(first, Start::previous);
  for (int i = 0; i < 20000; ++i) {
    const Scene scene = passing.at(0.1 + 1e-3 * std::sin(i * 0.1));
    pair->place(scene.bodies[0].pose, scene.bodies[1].pose);
    (void)pair->run(previous, Query::penetration);
  }
  ASSERT_FALSE(pair->simplex().empty());
  for (const SimplexPoint& p : pair->simplex())
    for (const int k : {0, 1}) {
      double nearest = INFINITY;
      for (const AnyVector& v : std::get<PointSet>(first.bodies[static_cast<std::size_t>(k)].shape.geometry).points) nearest = std::min(nearest, (v - (k == 0 ? p.a : p.b)).norm());
      EXPECT_LT(nearest, 1e-15) << k;
    }
}

/// Every dimension, scalar and kind of shape: begun from the simplex of another place, the answer is that of a cold start.
TEST(WarmStart, AnyPairFromAnotherPlace) {
  RandomScenes random(12);
  int begun = 0;
  for (int k = 0; k < 3000; ++k) {
    const int dimension = 1 + k % 3;
    Scene scene = random.scene(dimension, static_cast<Family>(k / 3 % family_count), k % 2 == 0);
    Method method;
    if (k % 4 == 3) method.name = MethodName::gjk_accelerated, method.acceleration = static_cast<Acceleration>(k / 4 % 3);
    SceneFile cold, warm;
    cold.scene = scene, cold.method = method;
    method.start = Start::previous, method.initial_simplex = last_simplex(record(cold));
    const double size = size_of(scene);
    scene.bodies[1].pose.position += 0.05 * size * AnyVector::Ones(dimension);
    warm.scene = scene, warm.method = method;
    const Recording run = record(warm);
    SceneFile again = warm;
    again.method.start.reset(), again.method.initial_simplex.clear();
    const Result reference = record(again).result;
    begun += method.initial_simplex.empty() ? 0 : std::holds_alternative<recorded::VertexKept>(run.events[1]);
    EXPECT_LE(*run.result.lower_bound, *run.result.upper_bound) << k;
    const double slack = 1e-9 * std::max(size, std::abs(*reference.signed_distance)) + (*reference.upper_bound - *reference.lower_bound) + (*run.result.upper_bound - *run.result.lower_bound);
    EXPECT_NEAR(*run.result.signed_distance, *reference.signed_distance, slack) << k;
    EXPECT_EQ(*solve(warm.scene, run.settings).signed_distance, *run.result.signed_distance) << "the same with and without a trace";
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(begun, 2500);
}

/// GJK's simplices are of the cores: a point in a body's rounding stands for the core's nearest. The answer is that of a cold start.
TEST(WarmStart, AnyPointsOfRoundBodiesWillDo) {
  RandomScenes random(21);
  const auto point_of = [&](const Body& body, int dimension) {
    const WorldSupport support(Body{"", body.shape, identity_pose(dimension)}, dimension);
    AnyVector p = AnyVector::Zero(dimension);
    double all = 0;
    for (int i = 0; i < 3; ++i) {
      const AnyVector d = AnyVector::NullaryExpr(dimension, [&] { return random.uniform(-1, 1); });
      const double weight = random.integer(0, 2);
      p += weight * support(d, true), all += weight;
      if (i == 2 && all == 0) return AnyVector(support(d, true));
    }
    return AnyVector(p / all);
  };
  int moved = 0;
  for (int k = 0; k < pairs_asked(600); ++k) {
    const int dimension = 2 + k % 2;
    Scene scene = random.scene(dimension, Family::general, false);
    for (Body& body : scene.bodies)
      if (k % 3 == 0) body.shape.margin = random.uniform(0, 1);
    if (k % 5 == 0) scene.bodies[0].shape = {Sum{std::make_shared<const Shape>(scene.bodies[0].shape), std::make_shared<const Shape>(Shape{Sphere{0.3}, 0.1})}, 0};
    Method method;
    for (int i = 0; i <= k % (dimension + 1); ++i) method.initial_simplex.push_back({point_of(scene.bodies[0], dimension), point_of(scene.bodies[1], dimension)});
    const Settings settings = resolve_settings(method, scene);
    for (std::size_t i = 0; i < settings.initial_simplex.size(); ++i) moved += settings.core_simplex[i].a != settings.initial_simplex[i].a;
    const Result warm = solve(scene, settings), cold = solve(scene, resolve_settings({}, scene));
    const double slack = 1e-9 * size_of(scene) + (*cold.upper_bound - *cold.lower_bound) + std::abs(*warm.upper_bound - *warm.lower_bound);
    EXPECT_LE(*warm.lower_bound, *warm.upper_bound) << k;
    EXPECT_NEAR(*warm.signed_distance, *cold.signed_distance, slack) << k;
    Recorder recorder;
    EXPECT_EQ(*solve(scene, settings, recorder).signed_distance, *warm.signed_distance) << k;
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(moved, pairs_asked(600) / 4);
}

/// Of a sum of curved bodies GJK tells no point on the border from one a little outside; its own supports are points of it.
TEST(WarmStart, ACurvedSumTakesItsOwnSimplex) {
  RandomScenes random(22);
  for (int k = 0; k < pairs_asked(200); ++k) {
    const Shape segment{PointSet{PointSetKind::segment, {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, random.uniform(-2, 2), 0.5)}, {}}, 0};
    const Shape round = k % 2 == 0 ? Shape{Cylinder{1, 0.5, 1}, 0} : Shape{Cone{1, 0.5, 1}, 0};
    SceneFile file;
    file.scene.dimension = 3, file.scene.query = Query::distance;
    file.scene.bodies = {Body{"A", {Sum{std::make_shared<const Shape>(round), std::make_shared<const Shape>(segment)}, 0}, identity_pose(3)},
                         Body{"B", {Box{Eigen::Vector3d(-0.5, -0.5, -0.5), Eigen::Vector3d(0.5, 0.5, 0.5), true}, 0}, identity_pose(3)}};
    file.scene.bodies[1].pose.position = Eigen::Vector3d(3, random.uniform(-1, 1), random.uniform(-1, 1));
    const Recording cold = record(file);
    file.method.start = Start::previous, file.method.initial_simplex = last_simplex(cold);
    const Recording warm = record(file);
    EXPECT_NEAR(*warm.result.signed_distance, *cold.result.signed_distance, 1e-9) << k;
    EXPECT_LE(*warm.result.lower_bound, *cold.result.upper_bound) << k;
    EXPECT_GE(*warm.result.upper_bound, *cold.result.lower_bound) << k;
    if (testing::Test::HasFailure()) break;
  }
}

TEST(WarmStart, RefusesWhatIsNoSimplexOfTheBodies) {
  Scene scene = Passing().at(0);
  const auto refused = [&](std::vector<SimplexPoint> points, std::optional<Start> start = {}) {
    Method method;
    method.start = start, method.initial_simplex = std::move(points);
    try {
      (void)resolve_settings(method, scene);
      return std::string("accepted");
    } catch (const Error& e) {
      return e.line();
    }
  };
  const AnyVector inside = Eigen::Vector3d(0, 0, 0), outside = Eigen::Vector3d(0, 3, 0);
  EXPECT_EQ(refused({{inside, inside}}), "accepted");
  EXPECT_EQ(refused({{inside, inside}, {inside, outside}}), "/method/initial_simplex/1/b: is no point of body \"B\"");
  EXPECT_EQ(refused(std::vector<SimplexPoint>(5, {inside, inside})), "/method/initial_simplex: initial_simplex has at most 4 vertices");
  scene.bodies[1].name.clear();
  EXPECT_EQ(refused({{inside, inside}, {inside, outside}}), "/method/initial_simplex/1/b: is no point of body 1") << "by number, where it has no name";
  EXPECT_EQ(refused({{inside, Eigen::Vector2d(0, 0)}}), "/method/initial_simplex/0/b: needs 3 numbers");
  EXPECT_EQ(refused({{inside, inside}}, Start::centres), "/method/start: initial_simplex goes with start \"previous\"");
  EXPECT_EQ(refused({}, Start::given), "/method/start: start \"given\" needs initial_direction");
}

}  // namespace
}  // namespace gjkdbg
