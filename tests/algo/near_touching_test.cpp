// Yes or no of bodies that touch but for a billionth of their size, by sub-algorithms whose rounding is larger than that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "algo/solve.h"
#include "recordings/check.h"
#include "recordings/recording.h"
#include "recordings/scene_file.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

Recording recorded_by(const Scene& scene, const Method& method) {
  SceneFile file;
  file.scene = scene, file.method = method;
  return record(file);
}

long runs_of_gjk(const Recording& recording) {
  return std::count_if(recording.events.begin(), recording.events.end(), [](const Event& e) { return std::holds_alternative<recorded::GjkBegan>(e); });
}

/// Body 1 moved along the normal until the signed distance is `gap`.
Scene moved_to(Scene scene, double gap) {
  const Result found = solve(scene, resolve_settings({}, scene));
  scene.bodies[1].pose.position += (gap - *found.signed_distance) * *found.normal;
  return scene;
}

/// Of 6,000 random pairs 455 ended as stalled by Johnson's cofactors, 568 by Voronoi regions, and were called apart; some that are apart by more than rounding were called
/// enclosed.
TEST(NearTouching, NoSubAlgorithmLeavesYesOrNoOpen) {
  RandomScenes random(77);
  int again = 0;
  for (int k = 0; k < pairs_asked(6000); ++k) {
    const bool polytopes = k % 5 > 0;  // beside a cone GJK and MPR may both stall within some floors
    const double gap = (k % 2 ? 1 : -1) * std::pow(10, random.uniform(polytopes ? -14 : -13, -8.3));
    Scene scene = moved_to(random.scene(2 + (k % 4 > 0), Family::general, polytopes), gap);
    const Result truth = solve(scene, resolve_settings({}, scene));
    if (*truth.lower_bound <= 0 && *truth.upper_bound >= 0) continue;
    scene.query = Query::intersect;
    for (const ClosestPoint part : {ClosestPoint::johnson, ClosestPoint::voronoi, ClosestPoint::signed_volumes}) {
      Method method;
      method.name = MethodName::gjk, method.closest_point = part;
      const Result answer = solve(scene, resolve_settings(method, scene));
      EXPECT_EQ(answer.intersecting, truth.intersecting) << k << " " << word_of(part) << " " << answer.status << " " << *truth.signed_distance;
      EXPECT_NE(answer.status, "stalled") << k << " " << word_of(part);
    }
    if (k % 10 > 0) continue;
    for (const ClosestPoint part : {ClosestPoint::johnson, ClosestPoint::voronoi}) {
      Method method;
      method.name = MethodName::gjk, method.closest_point = part;
      const Recording recording = recorded_by(scene, method);
      again += runs_of_gjk(recording) > 1;
      for (const Finding& finding : check(recording)) {
        EXPECT_EQ(finding.severity, Finding::Severity::warning) << k << " " << finding.message;
        EXPECT_EQ(finding.code, "cycle") << k << " " << finding.message;  // of the first run: it merely costs
      }
    }
  }
  if (pairs_asked(6000) >= 6000) {
    EXPECT_GT(again, 10);
  }
}

/// The triangle reaches 1.6e-13 into the cylinder's rim, and the nearest point of GJK's simplex lies on an edge but for a weight of 5e-15: |v| falls by less than it rounds.
TEST(NearTouching, WhereGjkStallsMprTellsYesFromNo) {
  const Scene scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "intersect", "bodies": [
    {"shape": {"type": "triangle", "points": [[-0.4369430461245696, -0.383183625920388, 0.29488827431548326], [0.2377230800140293, -0.1501567436577722, 0.00993312149328518],
      [0.538579912755456, -0.11381602164155136, 0.48698213116170996]]},
     "pose": {"position": [1.29394956734025, 0.46030489381788, -1.1850872067700073], "rotation": {"axis": [-0.3393143036085444, -0.7155770668580104, 0.2534799773252281], "angle": 67.13277427072332}}},
    {"shape": {"type": "cylinder", "radius": 0.6380839949556698, "half_height": 0.5354778991190926, "axis": "x"},
     "pose": {"position": [0.3831425961717545, -0.1344256325108505, -0.4811288134963827], "rotation": {"axis": [-0.5364696653111924, -0.054787342609704526, 0.6176944706683725], "angle": 241.95305832398031}}}]})", {}).scene;
  Method method;
  method.name = MethodName::gjk;
  const Recording recording = recorded_by(scene, method);
  EXPECT_TRUE(recording.result.intersecting);
  EXPECT_EQ(recording.result.status, "overlapping");
  EXPECT_TRUE(check(recording).empty());
}

constexpr std::string_view round_pair = R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "intersect", "bodies": [{"shape": {"type": "ellipse", "radii": [2, 1]}},
  {"shape": {"type": "circle", "radius": 0.5}, "pose": {"position": [0, 0]}}]})";

/// Without a proof GJK ended where its bounds were 1e-10 of the distance from each other, in single precision 1e-4, with touching between them.
TEST(NearTouching, RoundBodiesAreToldApartAsFarAsThePrecisionGoes) {
  Scene scene = parse_scene(round_pair, {}).scene;
  for (const auto& [single, x, y] : {std::tuple(false, 2.0927421705271945, 0.8482639009076005), std::tuple(false, 0.7557719981648638, 1.4348091380940355), std::tuple(true, 1.47238, 1.22985)}) {
    scene.bodies[1].pose.position = Eigen::Vector2d(x, y);
    for (const MethodName name : {MethodName::gjk, MethodName::gjk_accelerated}) {
      Method method;
      method.name = name, method.scalar = single ? Scalar::float_precision : Scalar::double_precision;
      const Recording recording = recorded_by(scene, method);
      EXPECT_TRUE(recording.result.intersecting) << x << " " << word_of(name);
      EXPECT_TRUE(check(recording).empty()) << x << " " << word_of(name);
    }
  }
}

/// A gap, or an overlap, of a few floors can be decided, so it is, and what is less is nobody's fault.
TEST(NearTouching, OfRoundBodiesOnlyWhatIsWithinRoundingIsLeftOpen) {
  RandomScenes random(78);
  Scene flat = parse_scene(round_pair, {}).scene;
  const int pairs = pairs_asked(3000);
  int decided = 0;
  for (int k = 0; k < pairs; ++k) {
    const bool single = k % 2 > 0;
    Scene scene = k % 3 ? flat : random.scene(3, Family::general, false);
    if (k % 3) {
      const double angle = random.uniform(0, 6.3);
      scene.bodies[1].pose.position = Eigen::Vector2d(4 * std::cos(angle), 4 * std::sin(angle));
    }
    scene.query = Query::penetration;
    scene = moved_to(scene, (k % 4 < 2 ? -1 : 1) * std::pow(10, single ? random.uniform(-6, -3.5) : random.uniform(-14, -9)));
    const Result truth = solve(scene, resolve_settings({}, scene));
    scene.query = Query::intersect;
    for (const MethodName name : {MethodName::gjk, MethodName::gjk_accelerated}) {
      Method method;
      method.name = name, method.scalar = single ? Scalar::float_precision : Scalar::double_precision;
      const Recording recording = recorded_by(scene, method);
      EXPECT_TRUE(check(recording).empty()) << k << " " << word_of(name) << " " << *truth.signed_distance;
      const double floor = 3 * rounding_floor(scene, resolve_settings(method, scene));
      if (*truth.lower_bound <= floor && *truth.upper_bound >= -floor) continue;
      ++decided;
      EXPECT_EQ(recording.result.intersecting, *truth.upper_bound < 0) << k << " " << word_of(name) << " " << *truth.signed_distance << " " << recording.result.status;
    }
  }
  if (pairs_asked(3000) >= 3000) {
    EXPECT_GT(decided, 2000);
  }
}

/// Voronoi regions take the origin for enclosed, and EPA found it outside. Signed volumes tell that it is not enclosed.
TEST(NearTouching, WhatOnlyVoronoiRegionsCallEnclosedIsMeasured) {
  Scene scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "segment", "points": [[-1.8934744934578682e-06, 1.2067100261247066e-18, 4.552827766589452e-18], [1.4576262392832303e-06, -9.376534161231788e-19, -1.7576601169837112e-19]]}},
    {"shape": {"type": "box", "min": [2.7206393053246414e-10, -4.895560106691007e-10, 8.004771860045334e-11], "max": [8.488006001172677e-10, -9.299087041231268e-11, 1.7535811659732983e-09]}}]})", {}).scene;
  for (Body& b : scene.bodies) {
    b.pose.position = Eigen::Vector3d(0.00012749767245769274, 3.4242302721835682, 0.0007715480729853134);
    b.pose.matrix = resolve(Quaternion{{-0.6433279351390332, 0.21135090839270734, 0.6688881789072949, -0.30667338572071734}}, 3).matrix;
  }
  const Result truth = solve(scene, resolve_settings({}, scene));
  Method m;
  m.closest_point = ClosestPoint::voronoi, m.scalar = Scalar::float_precision;
  const Result r = solve(scene, resolve_settings(m, scene));
  EXPECT_EQ(r.status, "converged");
  EXPECT_LE(*r.lower_bound, *truth.upper_bound);
  EXPECT_GE(*r.upper_bound, *truth.lower_bound);
}

/// GJK cannot tell a gap from touching in single precision, and EPA finds the origin outside, often beside the nearest face: that face's plane is nearer than the face.
TEST(NearTouching, WhereEpaFindsAGapTheBoundsHoldIt) {
  RandomScenes random(12);
  Method single;
  single.scalar = Scalar::float_precision;
  int separated = 0;
  for (int i = 0; i < pairs_asked(2000); ++i) {
    Scene scene = random.scene(3, i % 2 ? Family::general : Family::slivers, true);
    const Result far = solve(scene, resolve_settings({}, scene));
    scene.bodies[1].pose.position += (1e-7 * size_of(scene) - *far.signed_distance) * *far.normal;
    const Result truth = solve(scene, resolve_settings({}, scene)), r = solve(scene, resolve_settings(single, scene));
    separated += r.status == "separated";
    if (r.status != "separated") continue;
    EXPECT_LE(*r.lower_bound, *truth.upper_bound) << i;
    EXPECT_GE(*r.upper_bound, *truth.lower_bound) << i;
  }
  if (pairs_asked(2000) >= 2000) {
    EXPECT_GT(separated, 100);
  }
}

}  // namespace
}  // namespace gjkdbg
