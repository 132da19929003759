// The closed form against exact arithmetic: points, segments, spheres and capsules, also parallel, crossing, coincident and of no length.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algo/solve.h"
#include "recordings/check.h"
#include "recordings/recording.h"
#include "shapes/error.h"
#include "tests/oracle/exact_polytopes.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

/// Bodies whose cores are points and segments.
class SegmentPairs {
 public:
  Scene scene(int dimension, int k) {
    Scene s;
    s.dimension = dimension, s.query = Query::penetration;
    const AnyVector direction = vector(dimension, k % 2 == 0);
    for (int i = 0; i < 2; ++i) s.bodies.push_back(body(dimension, k, i, direction));
    return s;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  AnyVector vector(int dimension, bool lattice) {
    AnyVector v(dimension);
    for (int i = 0; i < dimension; ++i) v[i] = lattice ? whole(-2, 2) : uniform(-2, 2);
    return v;
  }

  /// k chooses: lattice or not, nearly parallel by how much, radii or none, a far place, a capsule with a rotation.
  Body body(int dimension, int k, int i, const AnyVector& direction) {
    const bool lattice = k % 2 == 0, parallel = k % 3 == 0;
    const double tilt = k % 9 == 0 ? 0 : std::pow(10, -uniform(1, 16));
    const AnyVector start = vector(dimension, lattice);
    const AnyVector along = whole(0, 7) == 0 ? AnyVector(AnyVector::Zero(dimension)) : parallel ? AnyVector(direction + i * tilt * vector(dimension, false)) : vector(dimension, lattice);
    Body b{i == 0 ? "A" : "B", {PointSet{PointSetKind::segment, {start, start + along}, {}}, 0}, identity_pose(dimension)};
    if (k % 5 == 1) b.shape.margin = uniform(0, 1);
    if (k % 7 == 2 && dimension > 1) {
      b.shape = {Capsule{uniform(0, 1), uniform(0, 2), whole(0, dimension - 1)}, 0};
      b.pose.position = start;
      if (dimension == 3) {
        const Eigen::Vector4d q(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        b.pose.rotation = Quaternion{{q[0], q[1], q[2], q[3]}};
        b.pose.matrix = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
      }
    }
    if (k % 11 == 3) b.pose.position += AnyVector::Constant(dimension, 1e5);
    return b;
  }

  std::mt19937 random_{7};
};

Settings closed_form(const Scene& scene, Scalar scalar = Scalar::double_precision) {
  Method method;
  method.name = MethodName::closed_form, method.scalar = scalar;
  return resolve_settings(method, scene);
}

TEST(ClosedForm, AgreesWithExactArithmetic) {
  SegmentPairs random;
  double worst = 0, worst_float = 0;
  int overlapping = 0;
  for (int k = 0; k < pairs_asked(20000); ++k) {
    const int dimension = 1 + k % 3;
    const Scene scene = random.scene(dimension, k / 3);
    SCOPED_TRACE(std::to_string(dimension) + "D pair " + std::to_string(k));
    const auto exact = oracle::signed_distance(scene);
    ASSERT_TRUE(exact);
    const double size = 8 + (scene.bodies[0].pose.position - scene.bodies[1].pose.position).norm();
    const Result r = solve(scene, closed_form(scene));
    ASSERT_TRUE(r.signed_distance && r.normal && r.witness_a && r.witness_b && r.lower_bound && r.upper_bound);
    const double sd = exact->signed_distance, error = std::abs(*r.signed_distance - sd) / size;
    worst = std::max(worst, error);
    EXPECT_LE(error, 1e-14) << *r.signed_distance << " for " << sd;
    EXPECT_LE(*r.lower_bound, sd + 1e-15 * std::abs(sd));
    EXPECT_GE(*r.upper_bound, sd - 1e-15 * std::abs(sd));
    EXPECT_LE(*r.upper_bound - *r.lower_bound, 1e-12 * size);
    EXPECT_NEAR(r.normal->norm(), 1, 1e-14);
    const double place = size + scene.bodies[0].pose.position.norm();
    EXPECT_LE((*r.witness_b - *r.witness_a - *r.signed_distance * *r.normal).norm(), 1e-14 * place);
    overlapping += r.intersecting;
    for (const Query query : {Query::intersect, Query::distance}) {
      Scene asked = scene;
      asked.query = query;
      const Result least = solve(asked, closed_form(asked));
      if (std::abs(sd) > 1e-13 * size) {
        EXPECT_EQ(least.intersecting, sd <= 0);
      }
      if (query == Query::distance) {
        EXPECT_NEAR(*least.signed_distance, std::max(0.0, sd), 1e-14 * size);
      } else {
        EXPECT_FALSE(least.signed_distance || least.normal || least.lower_bound);
      }
    }
    const Result single = solve(scene, closed_form(scene, Scalar::float_precision));
    worst_float = std::max(worst_float, std::abs(*single.signed_distance - sd) / size);
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_LE(worst_float, 1e-5);
  EXPECT_GT(overlapping, pairs_asked(20000) / 20);
  std::printf("worst error %.2g, in float %.2g of the size; %d of %d overlap\n", worst, worst_float, overlapping, pairs_asked(20000));
}

TEST(ClosedForm, TracesWhatItComputes) {
  SegmentPairs random;
  for (int k = 0; k < 300; ++k) {
    const Scene scene = random.scene(1 + k % 3, k / 3);
    Recorder recorder;
    const Result r = solve(scene, closed_form(scene), recorder);
    const auto events = recorder.take_all();
    ASSERT_EQ(events.size(), 3u);
    const auto& began = std::get<recorded::ClosedFormBegan>(events[0]);
    const auto& ended = std::get<recorded::ClosedFormEnded>(events[2]);
    const AnyVector w = began.corner + ended.s * began.edge_a - ended.t * began.edge_b;
    EXPECT_LE((w - ended.closest).norm(), 1e-13 * (8 + w.norm())) << k;
    EXPECT_GE(std::min(ended.s, ended.t), 0);
    EXPECT_LE(std::max(ended.s, ended.t), 1);
    EXPECT_EQ(ended.lower_bound, *r.lower_bound);
    EXPECT_EQ(*r.signed_distance, *solve(scene, closed_form(scene)).signed_distance) << "the same with and without a trace";
  }
}

/// Segments that cross at a small angle with a small gap between them: the way from one to the other stays across both, however short it is.
TEST(ClosedForm, NearlyParallelSegmentsThatNearlyMeet) {
  for (int k = 0; k < 200; ++k) {
    std::mt19937 random(static_cast<unsigned>(k));
    std::uniform_real_distribution<double> uniform(0.3, 0.7);
    const double angle = std::pow(10, -1 - 10 * uniform(random)), gap = std::pow(10, -1 - 16 * uniform(random)), place = uniform(random);
    Scene scene;
    scene.dimension = 3, scene.query = Query::penetration;
    for (const double half : {2.0, 0.5}) {
      Body body{half == 2 ? "A" : "B", {}, identity_pose(3)};
      body.shape.geometry = Capsule{0.5, half, 1};
      scene.bodies.push_back(body);
    }
    const Eigen::Vector3d way = Eigen::Vector3d(0.6, 0, 0.8);
    scene.bodies[1].pose.matrix = Eigen::AngleAxisd(angle, way).toRotationMatrix(), scene.bodies[1].pose.rotation = RotationMatrix{scene.bodies[1].pose.matrix};
    scene.bodies[1].pose.position = gap * way + Eigen::Vector3d(0, place, 0);
    SCOPED_TRACE(k);
    SceneFile file;
    file.scene = scene, file.method.name = MethodName::closed_form;
    const Recording recording = record(file);
    for (const Finding& finding : check(recording)) ADD_FAILURE() << finding.code << ": " << finding.message;
    EXPECT_NEAR(*recording.result.signed_distance, gap - 1, 1e-15);
    EXPECT_NEAR(std::abs(recording.result.normal->dot(way)), 1, 1e-12);
    EXPECT_LE(*recording.result.upper_bound - *recording.result.lower_bound, 1e-13);
  }
}

/// Two capsules about one middle, from parallel to crossed: their cores meet there, so the depth is the sum of the radii, whatever the cross product of nearly parallel axes is.
TEST(ClosedForm, CapsulesAboutOneMiddle) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int k = 0; k < 4000; ++k) {
    SceneFile file;
    file.scene.dimension = 3, file.scene.query = Query::penetration;
    const Eigen::Vector3d axis = Eigen::Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized(), place(uniform(-1, 1), uniform(-1, 1), 0);
    const double turn = uniform(0, 3), tilt = k % 10 == 0 ? 0 : std::pow(10, -uniform(0, 17));
    double radii = 0;
    for (const double angle : {turn, turn + tilt}) {
      const double radius = k % 3 == 0 ? 0 : uniform(0.1, 1);
      Body body{"", {Capsule{radius, uniform(0.1, 3), 2}, 0}, identity_pose(3)};
      body.pose.matrix = Eigen::AngleAxisd(angle, axis).toRotationMatrix(), body.pose.rotation = RotationMatrix{body.pose.matrix}, body.pose.position = place;
      file.scene.bodies.push_back(body), radii += radius;
    }
    for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
      file.method.name = MethodName::closed_form, file.method.scalar = scalar;
      const Result r = record(file).result;
      const double rounding = (scalar == Scalar::double_precision ? 1e-15 : 4e-7) * size_of(file.scene);
      EXPECT_NEAR(*r.signed_distance, -radii, rounding) << k << ", tilt " << tilt;
      EXPECT_LE(*r.lower_bound, -radii) << k << ", tilt " << tilt;
      EXPECT_GE(*r.upper_bound, -radii) << k << ", tilt " << tilt;
    }
  }
}

TEST(ClosedForm, IsRefusedWhereThereIsNone) {
  SegmentPairs random;
  Scene scene = random.scene(3, 1);
  scene.bodies[1].shape = {Box{Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1)}, 0};
  try {
    (void)closed_form(scene);
    FAIL() << "a box is no segment";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), "unsupported-method");
  }
}

}  // namespace
}  // namespace gjkdbg
