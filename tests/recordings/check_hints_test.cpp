// What check says of a cause: supports that are none, and distances that leave out what is around the cores.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "recordings/check.h"
#include "recordings/replay.h"

namespace gjkdbg {
namespace {

/// Another program's recording of two boxes in space, x apart, the first turned and with margins if so said.
Recording of_boxes(double x, const std::string& margins = "", const std::string& turn = "", const std::string& query = "penetration") {
  const std::string first = margins.empty() ? "" : R"(, "margin": 0.1)", second = margins.empty() ? "" : R"(, "margin": 0.2)";
  Recording recording = record(parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": ")" + query + R"(", "bodies": [{"shape": {"type": "box", "half_extents": [1, 0.5, 0.7])" + first + "}" + (turn.empty() ? "" : R"(, "pose": {"position": [0, 0, 0], "rotation": )" + turn + "}") +
                                           R"(}, {"shape": {"type": "box", "half_extents": [0.6, 0.4, 0.5])" + second + R"(}, "pose": {"position": [)" + std::to_string(x) + ", 0.4, 0.2]}}]}", {}));
  recording.generator = "another";
  EXPECT_TRUE(check(recording).empty()) << check(recording)[0].message;
  return recording;
}

recorded::SupportQueried& first_support(Recording& recording) {
  return std::get<recorded::SupportQueried>(*std::find_if(recording.events.begin(), recording.events.end(), [](const Event& e) { return std::holds_alternative<recorded::SupportQueried>(e); }));
}

/// What is said of a first support along x whose point of A is another.
std::string said_of(Recording recording, const Eigen::Vector3d& a) {
  recorded::SupportQueried& q = first_support(recording);
  q.direction = Eigen::Vector3d(1, 0, 0), q.a = a, q.b = Eigen::Vector3d(recording.scene.scene.bodies[1].pose.position - Eigen::Vector3d(0.6, 0.4, 0.5)), q.w = q.a - q.b;
  for (const Finding& f : check(recording))
    if (f.code == "wrong-support") return f.message;
  return "";
}

bool holds(const std::string& text, const std::string& phrase) { return text.find(phrase) != std::string::npos; }

TEST(CheckHints, ASupportThatIsNone) {
  const Recording plain = of_boxes(2.3);
  EXPECT_EQ(said_of(plain, {1, 0.5, 0.7}), "");
  const std::string doubled = said_of(plain, {2, 1, 1.4}), inner = said_of(plain, {-1, 0.5, 0.7}), other = said_of(plain, {2.9, 0.8, 0.7}), corner = said_of(plain, {0.5, 0.5, 0.7});
  EXPECT_TRUE(holds(doubled, "outside the body") && holds(doubled, "a whole length for a half one") && !holds(doubled, "rotation")) << doubled;
  EXPECT_TRUE(holds(inner, "the farthest the other way")) << inner;
  EXPECT_TRUE(holds(other, "It is a point of body 1: A and B are interchanged")) << other;
  EXPECT_TRUE(holds(corner, "It is a point of the body, but others lie farther") && !holds(corner, "rotation") && !holds(corner, "frame")) << corner;
  // Where the body is turned, the usual cause is that.
  const std::string turned = said_of(of_boxes(2.3, "", R"({"axis": [0, 0, 1], "angle": 20})"), {0.9, 0, 0});
  EXPECT_TRUE(holds(turned, "It is a point of the body") && holds(turned, "rotation's transpose")) << turned;
}

TEST(CheckHints, AMarginAddedTwice) {
  const Recording recording = of_boxes(2.3, "with");
  EXPECT_EQ(said_of(recording, {1.1, 0.5, 0.7}), "");
  const std::string twice = said_of(recording, {1.2, 0.5, 0.7});
  EXPECT_TRUE(holds(twice, "It lies 0.1 outside the body, as far as its margin reaches")) << twice;
}

/// The first error of a result with another distance.
Finding with_distance(Recording recording, double distance) {
  recording.result.signed_distance = distance, recording.result.intersecting = distance <= 0;
  recording.result.witness_a.reset(), recording.result.witness_b.reset(), recording.result.lower_bound.reset(), recording.result.upper_bound.reset();
  for (Event& event : recording.events) {
    if (auto* end = std::get_if<recorded::EpaEnded>(&event)) end->depth = -distance;
    if (auto* end = std::get_if<recorded::GjkEnded>(&event); end && distance > 0) end->status = GjkStatus::converged;
  }
  const std::vector<Finding> findings = check(recording);
  return findings.empty() ? Finding() : findings[0];
}

/// Apart, overlapping with the cores apart, and with the cores overlapping: 0.4 apart, 0.1 and 0.6 deep.
TEST(CheckHints, RadiiLeftOutOfADistance) {
  for (const auto& [x, right] : {std::pair(2.3, 0.4), std::pair(1.8, -0.1), std::pair(1.3, -0.6)}) {
    const Recording recording = of_boxes(x, "with");
    ASSERT_NEAR(*recording.result.signed_distance, right, 1e-9);
    const std::string both = with_distance(recording, right + 0.3).message, second = with_distance(recording, right + 0.2).message, twice = with_distance(recording, right - 0.3).message;
    EXPECT_TRUE(holds(both, "the radii around them, 0.3 together, have not been taken off")) << x << ": " << both;
    EXPECT_TRUE(holds(second, "The radius around the core of body 1, 0.2, has not been taken off")) << x << ": " << second;
    EXPECT_TRUE(holds(twice, "have been taken off twice")) << x << ": " << twice;
    for (const std::string& said : {both, second, twice}) EXPECT_FALSE(holds(said, "the wrong sign") || holds(said, "said to be -")) << said;
  }
}

/// Yes and the length of a gap, or no and a depth: the search was right.
TEST(CheckHints, YesOrNoThatContradictsTheDistance) {
  for (const double x : {2.3, 1.3}) {
    Recording recording = of_boxes(x);
    recording.result.intersecting = !recording.result.intersecting;
    const std::vector<Finding> findings = check(recording);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].code, "wrong-answer");
    EXPECT_TRUE(holds(findings[0].message, "intersecting and signed_distance contradict each other")) << findings[0].message;
  }
}

/// Touching, a millionth deep, and no more apart than rounding tells: yes or no is a warning there.
TEST(CheckHints, YesOrNoWhereTheBodiesTouch) {
  const auto told = [](double x, bool intersecting, Scalar scalar) {
    Recording recording = record(parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "intersect", "bodies": [{"shape": {"type": "box", "half_extents": [1, 1]}}, {"shape": {"type": "box", "half_extents": [1, 1]}, "pose": {"position": [0, 0]}}]})", {}));
    recording.scene.scene.bodies[1].pose.position[0] = x;
    recording.settings.scalar = scalar;
    recording.generator = "another", recording.events.clear(), recording.result = {}, recording.result.status = "converged", recording.result.intersecting = intersecting;
    const AnyVector d = Eigen::Vector2d(1, 0), a = Eigen::Vector2d(1, 1), b = Eigen::Vector2d(x - 1, -1);
    recording.events.push_back(recorded::GjkBegan{d});
    recording.events.push_back(recorded::SupportQueried{0, Phase::gjk, d, 0, a, b, a - b});
    const double unset = std::numeric_limits<double>::quiet_NaN();
    recording.events.push_back(recorded::GjkEnded{0, intersecting ? GjkStatus::touching : GjkStatus::separated, unset, unset});
    std::string out;
    for (const Finding& f : check(recording)) out += f.code + (f.severity == Finding::Severity::warning ? "? " : " ");
    return out;
  };
  constexpr Scalar exact = Scalar::double_precision, single = Scalar::float_precision;
  for (const double deep : {0.0, 1e-13, 1e-10, 1e-8, 1e-7, 1e-6}) {
    EXPECT_EQ(told(2 - deep, false, exact), "unjustified-separation? ") << deep;
    EXPECT_EQ(told(2 - deep, true, exact), "") << deep;
  }
  // In single precision 1 - 1e-8 is 1, and a touching that is exact there is one.
  EXPECT_EQ(told(2 - 1e-8, false, single), "");
  EXPECT_EQ(told(2, false, single), "unjustified-separation? ");
  EXPECT_EQ(told(2 - 1e-5, false, single), "unjustified-separation? ");
  EXPECT_EQ(told(2 + 1e-8, false, exact), "");
  EXPECT_EQ(told(2 + 1e-8, true, exact), "wrong-answer? ");
  EXPECT_EQ(told(2 + 1e-8, true, single), "");
  EXPECT_EQ(told(2 + 1e-12, true, exact), "");  // the tolerance to stop at
}

/// The same of round bodies, by the plane across the right normal: what reaches into the other by more than rounding is not apart, whoever says so.
TEST(CheckHints, YesOrNoWhereRoundBodiesTouch) {
  const auto told = [](double gap, bool own, Scalar scalar) {
    Recording recording = record(parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "intersect", "bodies": [{"shape": {"type": "ellipse", "radii": [2, 1]}}, {"shape": {"type": "circle", "radius": 0.5}, "pose": {"position": [0, 0]}}]})", {}));
    recording.scene.scene.bodies[1].pose.position[0] = 2.5 + gap;
    recording.settings.scalar = scalar;
    recording.events.clear(), recording.result = {}, recording.result.status = GjkStatus::separated, recording.result.intersecting = false;
    if (!own) recording.generator = "another";
    const AnyVector d = Eigen::Vector2d(1, 0), a = Eigen::Vector2d(2, 0), b = Eigen::Vector2d(2.5 + gap, 0);
    recording.events.push_back(recorded::GjkBegan{d});
    recording.events.push_back(recorded::SupportQueried{0, Phase::gjk, d, 0, a, b, a - b});
    const double unset = std::numeric_limits<double>::quiet_NaN();
    recording.events.push_back(recorded::GjkEnded{0, GjkStatus::separated, unset, unset});
    const auto findings = check(recording);
    return std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.code == "unjustified-separation"; });
  };
  for (const bool own : {false, true}) {
    for (const double deep : {1e-13, 1e-12, 1e-11, 1e-10, 1e-8, 1e-6, 1e-3}) EXPECT_TRUE(told(-deep, own, Scalar::double_precision)) << deep << " " << own;
    for (const double deep : {3e-6, 3e-5, 1e-4, 1e-2}) EXPECT_TRUE(told(-deep, own, Scalar::float_precision)) << deep << " " << own;
    for (const double gap : {1e-12, 1e-10, 1e-8}) EXPECT_FALSE(told(gap, own, Scalar::double_precision)) << gap << " " << own;
    EXPECT_FALSE(told(-1e-8, own, Scalar::float_precision)) << own;
  }
}

}  // namespace
}  // namespace gjkdbg
