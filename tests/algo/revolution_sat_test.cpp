// The depth of bodies of revolution whose axes are parallel, against their supports along many directions, and where the axes are not.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "algo/solve.h"
#include "recordings/check.h"
#include "recordings/recording.h"
#include "shapes/world_support.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

using V3 = Eigen::Vector3d;

double height_along(const Scene& scene, const V3& n) {
  const V3 a = WorldSupport(scene.bodies[0], 3)(n, true), b = WorldSupport(scene.bodies[1], 3)(-n, true);
  return n.dot(a - b);
}

class UprightPairs {
 public:
  Scene scene;
  V3 up, beside;  ///< the way of the axes, and from A's to B's, any where that is one

  /// k chooses: on one axis or beside one another, upright or turned together, B on its head, far out, with margins, discs and points for solids.
  UprightPairs(int k, double tilt) : random_(static_cast<unsigned>(k)) {
    scene.dimension = 3, scene.query = Query::penetration;
    const Eigen::Matrix3d together = k % 2 == 0 ? Eigen::Matrix3d::Identity() : turned(V3(1, 0.3, -0.7), uniform(-3, 3));
    up = together.col(2);
    const double away = k % 3 == 0 ? 0 : uniform(0, 0.7), angle = k % 5 == 0 ? 0 : uniform(-3, 3);
    const V3 step = together * V3(std::cos(angle), std::sin(angle), 0) * away;
    std::array<V3, 2> middles;
    for (int i = 0; i < 2; ++i) {
      Body body{i == 0 ? "A" : "B", {}, identity_pose(3)};
      const int axis = geometry(body.shape, k);
      if (k % 7 == 2) body.shape.margin = uniform(0, 0.3);
      const Eigen::Matrix3d upright = to_z(axis), spin = turned(V3::UnitZ(), uniform(-3, 3));
      const Eigen::Matrix3d head = i == 1 && k % 4 == 1 ? turned(V3::UnitX(), std::numbers::pi) : Eigen::Matrix3d::Identity();
      const Eigen::Matrix3d tilted = i == 1 && tilt != 0 ? turned(V3(0.6, 0.8, 0), tilt) : Eigen::Matrix3d::Identity();
      body.pose.matrix = together * tilted * head * (k % 2 == 0 ? Eigen::Matrix3d::Identity() : spin) * upright;
      body.pose.rotation = RotationMatrix{body.pose.matrix};
      body.pose.position = i == 0 ? V3(V3::Zero()) : V3(step + up * (k % 3 == 1 ? 0 : uniform(-0.7, 0.7)));
      const auto* segment = std::get_if<PointSet>(&body.shape.geometry);
      middles[i] = body.pose.position + (segment ? V3(body.pose.matrix * (segment->points[0] + segment->points[1]) / 2) : V3(V3::Zero()));
      scene.bodies.push_back(body);
    }
    beside = middles[1] - middles[0];
    beside -= up * up.dot(beside);
    beside = beside.norm() > 1e-12 ? V3(beside.normalized()) : up.unitOrthogonal();
    if (k % 11 == 4) for (Body& body : scene.bodies) body.pose.position += V3(1024, -512, 64);
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  static Eigen::Matrix3d turned(const V3& axis, double angle) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }
  static Eigen::Matrix3d to_z(int axis) { return Eigen::Quaterniond::FromTwoVectors(V3::Unit(axis), V3::UnitZ()).toRotationMatrix(); }

  int geometry(Shape& shape, int k) {
    const double radius = k % 6 == 0 ? 0.5 : uniform(0.2, 2), half = k % 13 == 6 ? 0 : k % 6 == 1 ? 0.5 : uniform(0.1, 2);
    const int axis = std::uniform_int_distribution<int>(0, 2)(random_);
    const auto spheroid = [&](double along) {
      V3 radii(radius, radius, radius);
      radii[axis] = along;
      return Ellipsoid{radii};
    };
    switch (std::uniform_int_distribution<int>(0, 8)(random_)) {
      case 0: shape.geometry = Cone{radius, half, axis}; break;
      case 1: shape.geometry = Capsule{radius, half, axis}; break;
      case 2: shape.geometry = Sphere{radius}; break;
      case 3: shape.geometry = PointSet{PointSetKind::segment, {V3(0.1, 0.2, -half), V3(0.1, 0.2, 0.4 * half)}, {}}; return 2;
      case 4: shape.geometry = spheroid(half); break;
      case 5: shape.geometry = spheroid(k % 2 == 0 ? radius : radius * (1 + std::pow(10, -uniform(2, 12)))); break;  // a ball, or nearly
      default: shape.geometry = Cylinder{radius, half, axis}; break;
    }
    return axis;
  }

  std::mt19937_64 random_;
};

/// Least height in the plane of the axes: over directions a thousandth apart, and then on both sides of each of them that is lower than its neighbours and not
/// above the least by more than a thousandth of a turn makes. There one arc of a circle or two meet.
double least_height(const UprightPairs& pair) {
  const auto at = [&](double t) { return height_along(pair.scene, std::cos(t) * pair.beside + std::sin(t) * pair.up); };
  constexpr double step = 1e-3;
  std::vector<double> heights;
  for (int k = -1572; k <= 1572; ++k) heights.push_back(at(k * step));
  const double lowest = *std::min_element(heights.begin(), heights.end()), above = 2 * step * size_of(pair.scene);
  double least = lowest;
  for (std::size_t k = 1; k + 1 < heights.size(); ++k) {
    if (heights[k] > heights[k - 1] || heights[k] > heights[k + 1] || heights[k] > lowest + above) continue;
    double low = (static_cast<double>(k) - 1573) * step, high = low + 2 * step;
    for (int halving = 0; halving < 90; ++halving) {
      const double t1 = low + (high - low) / 3, t2 = high - (high - low) / 3;
      (at(t1) < at(t2) ? high : low) = at(t1) < at(t2) ? t2 : t1;
    }
    least = std::min(least, at((low + high) / 2));
  }
  return least;
}

int of_kind(const Recording& recording, std::string_view kind) {
  int count = 0;
  for (const Event& event : recording.events) count += kind_name(event) == kind;
  return count;
}

Recording run_recorded(const Scene& scene, Method method = {}) {
  SceneFile file;
  file.scene = scene, file.method = method;
  return record(file);
}

TEST(RevolutionSat, IsAsDeepAsTheLeastHeightSays) {
  int told = 0;
  for (int k = 0; k < pairs_asked(400) && !testing::Test::HasFailure(); ++k) {
    const UprightPairs pair(k, 0);
    SCOPED_TRACE(k);
    const double least = least_height(pair);
    const Recording recording = run_recorded(pair.scene);
    for (const Finding& finding : check(recording)) ADD_FAILURE() << finding.code << ": " << finding.message;
    const Result& r = recording.result;
    if (of_kind(recording, "sat_began") == 0) continue;
    ++told;
    const double size = size_of(pair.scene) + (k % 11 == 4 ? 1024 : 0);
    EXPECT_EQ(of_kind(recording, "epa_ended"), 0);
    EXPECT_EQ(r.status, "overlapping");
    const bool curved = std::holds_alternative<Ellipsoid>(pair.scene.bodies[0].shape.geometry) || std::holds_alternative<Ellipsoid>(pair.scene.bodies[1].shape.geometry);
    const double within = 1e-13 * size - (curved ? 1e-10 * *r.signed_distance : 0);
    EXPECT_NEAR(-*r.signed_distance, least, within);
    EXPECT_LE(*r.upper_bound - *r.lower_bound, within);
    EXPECT_LE(r.iterations, curved ? 60 : 15);
    EXPECT_LT((*r.witness_b - *r.witness_a - *r.signed_distance * *r.normal).norm(), 1e-13 * size);
    const Result untraced = solve(pair.scene, recording.settings);
    EXPECT_EQ(*untraced.signed_distance, *r.signed_distance);
    EXPECT_EQ(*untraced.witness_a, *r.witness_a);
    EXPECT_EQ(*untraced.normal, *r.normal);
    EXPECT_EQ(untraced.support_calls, r.support_calls);
  }
  EXPECT_GT(told, pairs_asked(400) / 2);
}

/// Whatever the axes do, no direction has less height than the bounds allow.
void expect_no_way_out_is_shorter(const Scene& scene, const Result& r, double slack) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  double least = std::numeric_limits<double>::infinity();
  V3 best = V3::UnitX();
  const auto look = [&](const V3& n) {
    if (const double h = height_along(scene, n); h < least) least = h, best = n;
  };
  look(r.normal->normalized());
  for (int k = 0; k < 300; ++k) look(V3(normal(random), normal(random), normal(random)).normalized());
  for (double step = 0.1; step > 1e-9; step *= 0.9)
    for (int k = 0; k < 6; ++k) look((best + step * V3(normal(random), normal(random), normal(random))).normalized());
  EXPECT_GE(least + *r.upper_bound, -slack);
  EXPECT_LE(*r.lower_bound, *r.signed_distance);
}

/// A part of the tolerance is taken for parallel, and the bounds say so; more is EPA's.
TEST(RevolutionSat, AxesThatAreNearlyParallel) {
  int told = 0, by_epa = 0;
  for (int k = 0; k < pairs_asked(60) && !testing::Test::HasFailure(); ++k)
    for (const double tilt : {1e-16, 1e-13, 1e-11, 1e-4}) {
      const UprightPairs pair(k, tilt);
      for (const double tolerance : {1e-10, 1e-2}) {
        SCOPED_TRACE(std::to_string(k) + " tilt " + std::to_string(tilt) + " tolerance " + std::to_string(tolerance));
        Method method;
        method.tolerance = tolerance;
        const Recording recording = run_recorded(pair.scene, method);
        for (const Finding& finding : check(recording)) ADD_FAILURE() << finding.code << ": " << finding.message;
        if (!recording.result.intersecting) continue;
        (recording.result.status == "overlapping" ? told : by_epa) += 1;
        if (recording.result.status == "overlapping") {
          EXPECT_LE(*recording.result.upper_bound - *recording.result.lower_bound, tolerance * -*recording.result.signed_distance + 1e-13 * size_of(pair.scene));
        }
        expect_no_way_out_is_shorter(pair.scene, recording.result, 1e-13 * size_of(pair.scene));
      }
    }
  EXPECT_GT(told, by_epa / 4);
  EXPECT_GT(by_epa, told / 4);
}

/// One axis, and the nearest points a whole circle: the case that EPA comes to its limit at. In single precision, too, and by every way that leads to a depth.
TEST(RevolutionSat, ACircleOfNearestPoints) {
  Scene scene;
  scene.query = Query::contact;
  scene.bodies = {{"A", {Cone{1, 1, 1}, 0}, identity_pose(3)}, {"B", {Cylinder{0.5, 1, 1}, 0}, identity_pose(3)}};
  const double depth = 3 / std::sqrt(5.0);  // along (2, 1) / sqrt 5, across the cone's side, the cone reaches 1 / sqrt 5, and the cylinder the other way 2 / sqrt 5
  for (const MethodName name : {MethodName::gjk, MethodName::gjk_accelerated, MethodName::projections, MethodName::fastest})
    for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
      Method method;
      method.name = name, method.scalar = scalar;
      const Result r = solve(scene, resolve_settings(method, scene));
      EXPECT_NEAR(*r.signed_distance, -depth, scalar == Scalar::float_precision ? 1e-6 : 1e-15) << word_of(name);
      EXPECT_LT(r.iterations, 40);
      EXPECT_EQ(r.contacts->size(), 1u);
    }
}

/// A flat spheroid is touched along its axis all over its side, or nearly: where is for the other body to say.
TEST(RevolutionSat, AFlatSpheroidGivesWay) {
  for (const double along : {0.0, 1e-9, 1e-4}) {
    Scene scene;
    scene.query = Query::penetration;
    scene.bodies = {{"A", {Ellipsoid{V3(1, along, 1)}, 0}, identity_pose(3)}, {"B", {Ellipsoid{V3(1.7, 1.71, 1.7)}, 0}, identity_pose(3)}};
    scene.bodies[1].pose.position = V3(0.58, 0.5, 0);
    const Recording recording = run_recorded(scene);
    EXPECT_EQ(recording.result.status, "overlapping");
    for (const Finding& finding : check(recording)) ADD_FAILURE() << along << ": " << finding.code << ": " << finding.message;
    EXPECT_NEAR((*recording.result.witness_b)[0], 0.58, 1e-3) << along;
  }
}

/// An outline with an ellipse takes some steps: where there are not so many, EPA is asked, and says that it came to its limit as well.
TEST(RevolutionSat, AnOutlineThatIsNotDone) {
  Scene scene;
  scene.query = Query::penetration;
  scene.bodies = {{"A", {Ellipsoid{V3(1, 2, 1)}, 0}, identity_pose(3)}, {"B", {Cylinder{0.5, 1, 1}, 0}, identity_pose(3)}};
  scene.bodies[1].pose.position = V3(0.3, 0.2, 0);
  Method method;
  method.max_iterations = 6;
  const Recording limited = run_recorded(scene, method);
  EXPECT_EQ(of_kind(limited, "sat_ended"), 1);
  EXPECT_EQ(of_kind(limited, "epa_ended"), 1);
  EXPECT_EQ(limited.result.status, "iteration_limit");
  EXPECT_TRUE(check(limited).empty());
  EXPECT_EQ(run_recorded(scene).result.status, "overlapping");
}

/// An ellipsoid or ellipse of equal radii is a centre and a radius: as a sphere or circle it gives the same numbers, deep with one centre and apart.
TEST(RevolutionSat, ABallHoweverItIsWritten) {
  for (const int dimension : {2, 3})
    for (const double away : {0.0, 0.3, 1.5, 2.5})
      for (const bool box : {false, true}) {
        Scene round, written;
        for (Scene* scene : {&round, &written}) {
          scene->dimension = dimension, scene->query = Query::penetration;
          const Shape ball = scene == &round ? Shape{Sphere{1}, 0} : Shape{Ellipsoid{AnyVector::Ones(dimension)}, 0};
          const AnyVector half = AnyVector::Constant(dimension, 0.5);
          scene->bodies = {{"A", ball, identity_pose(dimension)}, {"B", box ? Shape{Box{-half, half}, 0} : ball, identity_pose(dimension)}};
          scene->bodies[1].pose.position[0] = away;
        }
        Method method;
        method.tolerance = 1e-12;
        const Result x = solve(round, resolve_settings(method, round)), y = solve(written, resolve_settings(method, written));
        EXPECT_EQ(*x.signed_distance, *y.signed_distance) << dimension << "D, " << away;
        EXPECT_EQ(*x.witness_a, *y.witness_a);
        EXPECT_EQ(x.support_calls, y.support_calls);
        EXPECT_TRUE(check(run_recorded(written)).empty());
      }
}

/// Discs in one plane, capsules and needles on one line: their difference has no volume, and EPA knows what to say of that. Nothing but rounding deep: the same.
TEST(RevolutionSat, WithoutVolumeEpaIsAsked) {
  for (const auto& [a, b, depth] : {std::tuple<Shape, Shape, double>{{Cylinder{1, 0, 1}, 0}, {Cylinder{0.5, 0, 1}, 0}, 0}, {{Capsule{0.5, 1, 1}, 0}, {Capsule{0.25, 1, 1}, 0}, 0.75}, {{Cylinder{0, 1, 1}, 0.25}, {Sphere{1}, 0}, 1.25}}) {
    Scene scene;
    scene.query = Query::penetration;
    scene.bodies = {{"A", a, identity_pose(3)}, {"B", b, identity_pose(3)}};
    const Recording recording = run_recorded(scene);
    EXPECT_EQ(of_kind(recording, "sat_began"), 0);
    EXPECT_NEAR(*recording.result.signed_distance, -depth, 1e-12);
    EXPECT_TRUE(check(recording).empty());
  }
}

}  // namespace
}  // namespace gjkdbg
