// Answers of other implementations that leave parts out: what is there is judged.
#include <gtest/gtest.h>

#include <string>

#include "recordings/check.h"
#include "recordings/comparison.h"
#include "recordings/gallery.h"
#include "recordings/replay.h"

namespace gjkdbg {
namespace {

/// Two squares of side 2, the second at this place: a right trace, and this result.
std::string first_code(const std::string& place, const std::string& query, const std::string& result) {
  SceneFile scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": ")" + query + R"(", "bodies": [{"shape": {"type": "box", "half_extents": [1, 1]}}, {"shape": {"type": "box", "half_extents": [1, 1]}, "pose": {"position": )" +
                                    place + "}}]}", {});
  std::string text = recording_to_text(record(scene));
  const std::size_t from = text.find("\"generator\": \"") + 14, to = text.find('"', from + 1);
  text.replace(from, to - from, "another");
  const std::size_t answer = text.rfind("\"result\"");
  text = text.substr(0, answer) + "\"result\": {" + result + R"(, "status": "converged", "iterations": 3, "support_calls": 3}})";
  const std::vector<Finding> findings = check(parse_recording(text, {}));
  return findings.empty() ? "" : findings[0].code;
}

TEST(CheckResult, WitnessesAreJudgedWithoutANormal) {
  const std::string apart = R"("intersecting": false, "signed_distance": 1, "witness_a": [1, 0], "witness_b": )";
  EXPECT_EQ(first_code("[3, 0]", "penetration", apart + "[2, 0]"), "");
  EXPECT_EQ(first_code("[3, 0]", "penetration", apart + "[4, 0]"), "wrong-witness");
  EXPECT_EQ(first_code("[3, 0]", "distance", apart + "[4, 0]"), "wrong-witness");
  // Without a distance, too: the right one.
  EXPECT_EQ(first_code("[3, 0]", "penetration", R"("intersecting": false, "witness_a": [1, 0], "witness_b": [4, 0])"), "wrong-witness");
}

TEST(CheckResult, AWitnessAloneIsAsFarFromTheOtherBodyAsTheBodiesAreApart) {
  EXPECT_EQ(first_code("[3, 0]", "penetration", R"("intersecting": false, "signed_distance": 1, "witness_a": [1, 0.5])"), "");
  EXPECT_EQ(first_code("[3, 0]", "penetration", R"("intersecting": false, "signed_distance": 1, "witness_a": [0, 0])"), "wrong-witness");
  EXPECT_EQ(first_code("[3, 0]", "penetration", R"("intersecting": false, "signed_distance": 1, "normal": [1, 0], "witness_b": [4, 0])"), "wrong-witness");
}

/// Squares of such lengths are infinite, and nothing is outside an infinite slack.
TEST(CheckResult, WitnessesFarBeyondEveryScene) {
  for (const double far : {1e100, 1e155, 1e200, 1e300}) {
    Recording recording = record(read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep")));
    recording.result.witness_a = AnyVector(Eigen::Vector3d(far, far, 0));
    const std::vector<Finding> findings = check(recording);
    ASSERT_FALSE(findings.empty()) << far;
    EXPECT_EQ(findings[0].code, "wrong-witness") << far;
    EXPECT_EQ(findings[0].message.find("nan"), std::string::npos) << findings[0].message;
    EXPECT_EQ(findings[0].message.find("inf"), std::string::npos) << findings[0].message;
  }
}

TEST(CheckResult, WitnessesOfAnOverlap) {
  EXPECT_EQ(first_code("[1.5, 0.25]", "penetration", R"("intersecting": true, "signed_distance": -0.5, "witness_a": [1, 0], "witness_b": [0.5, 0])"), "");
  EXPECT_EQ(first_code("[1.5, 0.25]", "penetration", R"("intersecting": true, "signed_distance": -0.5, "witness_a": [1, 0], "witness_b": [1, 0])"), "wrong-witness");
  // Of a distance query a point of both, or the depth for nothing.
  EXPECT_EQ(first_code("[1.5, 0.25]", "distance", R"("intersecting": true, "signed_distance": 0, "witness_a": [0.8, 0], "witness_b": [0.8, 0])"), "");
  EXPECT_EQ(first_code("[1.5, 0.25]", "distance", R"("intersecting": true, "signed_distance": 0, "witness_a": [1, 0], "witness_b": [0.9, 0])"), "wrong-witness");
}

TEST(CheckResult, BoundsAreJudgedOnTheirOwn) {
  EXPECT_EQ(first_code("[3, 0]", "distance", R"("intersecting": false, "signed_distance": 1, "lower_bound": 0.5, "upper_bound": null)"), "");
  EXPECT_EQ(first_code("[3, 0]", "distance", R"("intersecting": false, "signed_distance": 1, "lower_bound": 5, "upper_bound": null)"), "wrong-bounds");
  EXPECT_EQ(first_code("[3, 0]", "distance", R"("intersecting": false, "upper_bound": 0.2)"), "wrong-bounds");
}

TEST(CheckResult, ContactPointsAreJudgedWithoutANormal) {
  EXPECT_EQ(first_code("[3, 0]", "contact", R"("intersecting": false, "signed_distance": 1, "contacts": [{"point_a": [9, 9], "point_b": [2, 0], "depth": 7}])"), "wrong-contact");
  EXPECT_EQ(first_code("[1.5, 0]", "contact", R"("intersecting": true, "signed_distance": -0.5, "contacts": [{"point_a": [1, 0], "point_b": [0.5, 0], "depth": 0.5}])"), "");
}

/// Rounding aside, a wrong distance says no more about the points, which may be right.
TEST(CheckResult, WhatFollowsFromAWrongDistanceIsNotToldAgain) {
  EXPECT_EQ(first_code("[3, 0]", "penetration", R"("intersecting": false, "signed_distance": 1.5, "normal": [1, 0], "witness_a": [1, 0], "witness_b": [2, 0])"), "wrong-distance");
}

TEST(CheckResult, EpaDoesNotEndWithoutAPolytope) {
  SceneFile scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "distance", "bodies": [{"shape": {"type": "box", "half_extents": [1, 1]}}, {"shape": {"type": "box", "half_extents": [1, 1]}, "pose": {"position": [3, 0]}}]})", {});
  Recording recording = record(scene);
  recording.generator = "another";
  recording.events.push_back(recorded::EpaEnded{0, EpaStatus::converged, 0, AnyVector(Eigen::Vector2d(1, 0)), -1});
  const std::vector<Finding> findings = check(recording);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].code, "incomplete-trace");
}

/// No depth was measured, so there is none to be told, and no points.
TEST(CheckResult, ContactsWithoutADepthAreNone) {
  SceneFile scene = read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep"));
  scene.scene.query = Query::contact;
  scene.method.penetration = Penetration::none;
  for (const MethodName name : {MethodName::gjk, MethodName::mpr, MethodName::sat}) {
    change_name(scene.method, name);
    const Recording recording = record(scene);
    EXPECT_TRUE(recording.result.intersecting);
    EXPECT_TRUE(check(recording).empty()) << check(recording)[0].message;
  }
}

/// On a round side a depth that is right to 1e-4 may be a hundredth beside the best way out; its points are not off for that.
TEST(CheckResult, MprMayStopBesideTheBestWayOut) {
  SceneFile scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "contact", "method": {"name": "mpr", "tolerance": 1e-4}, "bodies": [{"shape": {"type": "ellipse", "radii": [0.522953553940059, 0.9645382500646948]}, "pose": {"position": [0.0681152977341194, -0.2550175644683292], "rotation": {"angle": -90}}}, {"shape": {"type": "point", "points": [[0, 0]]}, "pose": {"position": [-0.13005636364469772, 0.04526693112420055]}}]})", {});
  const std::vector<Finding> findings = check(record(scene));
  EXPECT_TRUE(findings.empty()) << findings[0].message;
}

/// The last phase's, and such as its numbers allow.
TEST(CheckResult, StatusesAreThoseOfTheSteps) {
  const auto edited = [](const char* name, MethodName method, auto change) {
    SceneFile scene = read_scene(read_gallery(GJKDBG_GALLERY).file(name));
    if (!scene.scene.motion) change_name(scene.method, method);
    Recording recording = record(scene);
    EXPECT_TRUE(check(recording).empty()) << name;
    change(recording);
    const std::vector<Finding> findings = check(recording);
    return findings.empty() ? "" : findings[0].code;
  };
  EXPECT_EQ(edited("obb-shallow", MethodName::gjk, [](Recording& r) { r.result.status = "enclosed"; }), "inconsistent");
  EXPECT_EQ(edited("sim-intermediate-axis", MethodName::gjk, [](Recording& r) { r.result.status = "stalled"; }), "inconsistent");
  const auto end_of_mpr = [](auto change) {
    return [change](Recording& r) {
      for (Event& event : r.events)
        if (auto* end = std::get_if<recorded::MprEnded>(&event)) change(*end);
    };
  };
  EXPECT_EQ(edited("mpr-apart", MethodName::mpr, end_of_mpr([](recorded::MprEnded& e) { e.status = MprStatus::converged; })), "inconsistent");
  EXPECT_NE(edited("mpr-flat", MethodName::mpr, end_of_mpr([](recorded::MprEnded& e) { e.normal = AnyVector::Unit(e.normal.size(), 0) * 0.3; })), "");
  const auto other_distance = [](Recording& r) {
    for (Event& event : r.events)
      if (auto* end = std::get_if<recorded::SatEnded>(&event)) end->distance *= 2;
  };
  EXPECT_NE(edited("obb-shallow", MethodName::sat, other_distance), "");
  EXPECT_NE(edited("sat-2d-apart", MethodName::sat, other_distance), "");
}

/// What a file tells beyond what was asked for is no part of a run.
TEST(Verify, FindsWhatARunLeavesOut) {
  Recording asked = record(read_scene(read_gallery(GJKDBG_GALLERY).file("2d-intersect-only")));
  EXPECT_FALSE(verify(asked));
  asked.result.signed_distance = 3.0, asked.result.normal = AnyVector(Eigen::Vector2d(1, 0)), asked.result.pair = {0, 1};
  const auto difference = verify(asked);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->what, "result");
  EXPECT_EQ(difference->fields, (std::vector<std::string>{"signed_distance", "normal", "pair"}));
  Recording miss = record(read_scene(read_gallery(GJKDBG_GALLERY).file("cast-receding")));
  EXPECT_FALSE(verify(miss));
  miss.result.lower_bound = 1.0;
  EXPECT_TRUE(verify(miss));
}

}  // namespace
}  // namespace gjkdbg
