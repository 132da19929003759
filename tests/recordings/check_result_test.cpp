// Answers of other implementations that leave parts out: what is there is judged.
#include <gtest/gtest.h>

#include <string>

#include "recordings/check.h"
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

}  // namespace
}  // namespace gjkdbg
