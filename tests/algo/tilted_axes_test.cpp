// The depth of bodies of revolution about nearly one line, against their supports along many directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
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

/// Two rods about nearly one line: of which kinds, how far that is off, and how it lies in the world, k chooses.
class NearlyOneLine {
 public:
  Scene scene;
  Eigen::Matrix3d axes;  ///< the line is the third

  NearlyOneLine(int k, double tilt, double aside) : random_(static_cast<unsigned>(k)) {
    scene.dimension = 3, scene.query = Query::penetration;
    const V3 way{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};  // in this order
    axes = k % 2 == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : turned(way, 1.1);
    for (int i = 0; i < 2; ++i) {
      Body body{i == 0 ? "A" : "B", {}, identity_pose(3)};
      const double radius = uniform(0.3, 1.5), half = uniform(1, 3);
      if (const int kind = (i == 0 ? k : k / 5) % 5; kind == 0) body.shape.geometry = Cylinder{radius, half, 2};
      else if (kind == 1) body.shape.geometry = Cone{radius, half, 2};
      else if (kind == 2) body.shape.geometry = Capsule{radius, half, 2};
      else body.shape.geometry = Ellipsoid{V3(radius, radius, kind == 3 ? half : radius / half)};
      if (k % 7 == 2) body.shape.margin = 0.1;
      Eigen::Matrix3d rotation = axes;
      V3 position = V3::Zero();
      if (i == 1) {
        const double towards = uniform(0, 2 * std::numbers::pi), from = uniform(0, 2 * std::numbers::pi), along = k % 3 == 0 ? 0 : uniform(-0.5, 0.5);
        const Eigen::Matrix3d head = k % 4 == 1 ? turned(V3::UnitX(), std::numbers::pi) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
        rotation = axes * turned(V3(std::cos(towards), std::sin(towards), 0), tilt) * head;
        position = axes * V3(aside * std::cos(from), aside * std::sin(from), along);
      }
      body.pose.matrix = rotation, body.pose.rotation = RotationMatrix{rotation}, body.pose.position = position;
      scene.bodies.push_back(body);
    }
  }

  double height(double turn, double rise) const {
    const V3 n = axes * V3(std::cos(rise) * std::cos(turn), std::cos(rise) * std::sin(turn), std::sin(rise));
    return n.dot(WorldSupport(scene.bodies[0], 3)(n, true) - WorldSupport(scene.bodies[1], 3)(-n, true));
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  static Eigen::Matrix3d turned(const V3& axis, double angle) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

  std::mt19937_64 random_;
};

/// Of a function on low ... high with one least value.
template <class Function>
double least_between(double low, double high, int steps, const Function& f) {
  double least = std::min(f(low), f(high));
  for (int i = 0; i < steps; ++i) {
    const double first = low + (high - low) * 0.382, second = low + (high - low) * 0.618, at_first = f(first), at_second = f(second);
    (at_first < at_second ? high : low) = at_first < at_second ? second : first;
    least = std::min({least, at_first, at_second});
  }
  return least;
}

/// Least height of one section: around every direction of many that is lower than those beside it.
double lowest_rise(const NearlyOneLine& pair, double turn) {
  constexpr int steps = 60;
  const auto rise = [](int i) { return std::numbers::pi * (double(i) / steps - 0.5); };
  std::array<double, steps + 1> heights;
  for (int i = 0; i <= steps; ++i) heights[static_cast<std::size_t>(i)] = pair.height(turn, rise(i));
  const auto at = [&](int i) { return heights[static_cast<std::size_t>(i)]; };
  double least = std::min(heights.front(), heights.back());
  for (int i = 0; i <= steps; ++i) {
    const int before = std::max(0, i - 1), after = std::min(steps, i + 1);
    if (at(i) <= at(before) && at(i) <= at(after)) least = std::min(least, least_between(rise(before), rise(after), 65, [&](double x) { return pair.height(turn, x); }));
  }
  return least;
}

/// Around every section that is lower than those beside it.
double least_of_all(const NearlyOneLine& pair) {
  constexpr int sections = 48;
  constexpr double apart = 2 * std::numbers::pi / sections;
  std::array<double, sections> lowest;
  for (int i = 0; i < sections; ++i) lowest[static_cast<std::size_t>(i)] = lowest_rise(pair, apart * i);
  const auto at = [&](int i) { return lowest[static_cast<std::size_t>((i + sections) % sections)]; };
  double least = at(0);
  for (int i = 0; i < sections; ++i) {
    if (at(i) > at(i - 1) || at(i) > at(i + 1)) continue;
    least = std::min(least, least_between(apart * (i - 1), apart * (i + 1), 45, [&](double turn) { return lowest_rise(pair, turn); }));
  }
  return least;
}

Recording recorded_run(const Scene& scene, const Method& method = {}) {
  SceneFile file;
  file.scene = scene, file.method = method;
  return record(file);
}

int axes_in(const Recording& recording) {
  int count = 0;
  for (const Event& event : recording.events) count += kind_name(event) == "axis_tested";
  return count;
}

TEST(TiltedAxes, AreAsDeepAsTheLeastHeightSays) {
  int told = 0, looked = 0;
  const std::array<double, 5> tilts{1e-8, 1e-5, 1e-3, 0.02, 0.2}, asides{0, 1e-7, 1e-4, 3e-3, 1e-2};
  for (int k = 0; k < pairs_asked(100) && !testing::Test::HasFailure(); ++k) {
    const NearlyOneLine pair(k, tilts[static_cast<std::size_t>(k % 5)], asides[static_cast<std::size_t>(k / 5 % 5)]);
    SCOPED_TRACE(k);
    const Recording recording = recorded_run(pair.scene);
    for (const Finding& finding : check(recording)) ADD_FAILURE() << finding.code << ": " << finding.message;
    const Result& r = recording.result;
    if (r.status != "overlapping" || axes_in(recording) == 0) continue;
    ++told, looked += axes_in(recording);
    const double least = least_of_all(pair), depth = -*r.signed_distance;
    EXPECT_NEAR(depth, least, 1e-9 * depth);
    EXPECT_LE(-*r.upper_bound, least + 1e-12);  // what is proven holds for every direction
    EXPECT_LE(*r.upper_bound - *r.lower_bound, 1e-9 * depth);
    EXPECT_EQ(solve(pair.scene, recording.settings).signed_distance, r.signed_distance);
  }
  EXPECT_GT(told, pairs_asked(100) * 9 / 10);
  EXPECT_LT(looked, 600 * told);
}

TEST(TiltedAxes, InSinglePrecision) {
  Method method;
  method.scalar = Scalar::float_precision;
  for (int k = 0; k < 25; ++k) {
    const NearlyOneLine pair(k, 1e-3, 1e-3);
    SCOPED_TRACE(k);
    const Recording recording = recorded_run(pair.scene, method);
    for (const Finding& finding : check(recording)) ADD_FAILURE() << finding.code << ": " << finding.message;
    if (axes_in(recording) > 0) { EXPECT_NEAR(*recording.result.signed_distance, *solve(pair.scene, Settings{}).signed_distance, 1e-4); }
  }
}

/// A limit that is too low leaves it to EPA.
TEST(TiltedAxes, SayWhereTheLimitIsReached) {
  Method method;
  method.max_iterations = 3;
  const NearlyOneLine pair(0, 1e-3, 1e-3);
  const Recording recording = recorded_run(pair.scene, method);
  for (const Finding& finding : check(recording)) ADD_FAILURE() << finding.code << ": " << finding.message;
  EXPECT_GT(axes_in(recording), 0);
  EXPECT_EQ(recording.result.status, "iteration_limit");
  EXPECT_LT(*recording.result.lower_bound, *recording.result.upper_bound);
}

/// Beside one another, or across: EPA has a place to go to.
TEST(TiltedAxes, OthersAreNot) {
  EXPECT_EQ(axes_in(recorded_run(NearlyOneLine(0, 1e-3, 0.4).scene)), 0);
  EXPECT_EQ(axes_in(recorded_run(NearlyOneLine(0, 0.5, 1e-3).scene)), 0);
}

}  // namespace
}  // namespace gjkdbg
