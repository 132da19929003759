// How large and how small numbers may be for check to judge them rightly: whole numbers, lengths of normals, places far out, scenes beyond both ends of the scale.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <tuple>

#include "recordings/check.h"
#include "recordings/gallery.h"
#include "tests/support/gallery_run.h"

namespace gjkdbg {
namespace {

/// A static scene: two bodies, each a shape, its place, and a query, by a method.
Recording of_bodies(int dimension, const std::string& query, const std::string& a, const std::string& at_a, const std::string& b, const std::string& at_b, MethodName method = MethodName::gjk) {
  SceneFile file = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": )" + std::to_string(dimension) + R"(, "query": ")" + query + R"(", "bodies": [{"shape": )" + a + R"(, "pose": {"position": )" + at_a +
                                   R"(}}, {"shape": )" + b + R"(, "pose": {"position": )" + at_b + "}}]}", {});
  change_name(file.method, method);
  return record(file);
}

std::string first_code_of(const Recording& recording) {
  const std::vector<Finding> findings = check(recording);
  return findings.empty() ? "" : findings[0].code;
}

std::string all_said_of(const Recording& recording) {
  std::string out;
  for (const Finding& f : check(recording)) out += f.code + ": " + f.message + "\n";
  return out;
}

// --- Normals --------------------------------------------------------------------------------------------------------

AnyVector in_six_digits(AnyVector v) {
  for (double& x : v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", x);
    x = std::strtod(text, nullptr);
  }
  return v;
}

TEST(CheckRanges, NormalsAreUnitToTheirDigits) {
  Recording recording = of_bodies(3, "penetration", R"({"type": "box", "half_extents": [1, 1, 1]})", "[0, 0, 0]", R"({"type": "box", "half_extents": [1, 1, 1]})", "[2.5, 0, 0]");
  for (const char* generator : {"another", "a solver under gjkdbg 0.1.0"}) {
    recording.generator = generator;
    for (const double length : {1.001, 0.999, 1.00001, 1.000003}) {
      recording.result.normal = AnyVector(Eigen::Vector3d(length, 0, 0));
      const std::vector<Finding> findings = check(recording);
      ASSERT_FALSE(findings.empty()) << length;
      EXPECT_EQ(findings[0].code, "wrong-normal");
      EXPECT_EQ(findings[0].message.find("length 1 instead"), std::string::npos) << findings[0].message;
    }
    for (const double length : {1.000001, 0.999999, 1 + 16 * std::ldexp(1.0, -24)}) {
      recording.result.normal = AnyVector(Eigen::Vector3d(length, 0, 0));
      EXPECT_EQ(all_said_of(recording), "") << length;
    }
  }
}

/// Whatever its direction, a normal in six digits or in single precision is one; where no more than single precision is asked for, one in five digits.
TEST(CheckRanges, NormalsOfFewDigitsAreUnit) {
  for (const double x : {0.1, 0.37, 0.58, 0.9, 1.7})
    for (const double y : {0.02, 0.4, 0.77, 1.3}) {
      const std::string place = "[" + std::to_string(4 * x) + ", " + std::to_string(4 * y) + ", 3]", ball = R"({"type": "sphere", "radius": 1})";
      Recording recording = of_bodies(3, "penetration", ball, "[0, 0, 0]", ball, place, MethodName::closed_form);
      recording.generator = "a solver under gjkdbg 0.1.0";
      const AnyVector right = *recording.result.normal;
      recording.result.normal = in_six_digits(right);
      EXPECT_EQ(all_said_of(recording), "") << place;
      Eigen::Vector3f single = Eigen::Vector3d(right).cast<float>();
      single = single / single.norm();
      recording.result.normal = AnyVector(single.cast<double>());
      EXPECT_EQ(all_said_of(recording), "") << place;
      recording.result.normal = AnyVector(right * (1 + 8e-6)), recording.settings.scalar = Scalar::float_precision;
      EXPECT_EQ(all_said_of(recording), "") << place;
      recording.result.normal = AnyVector(right * (1 + 2e-5));
      EXPECT_EQ(first_code_of(recording), "wrong-normal") << place;
    }
}

TEST(CheckRanges, NormalsOfMotionsAreUnit) {
  for (const char* scene : {"cast-ray", "cast-slow-approach"}) {
    Recording recording = gallery_run(scene);
    EXPECT_EQ(all_said_of(recording), "") << scene;
    *recording.result.normal *= 1.001;
    EXPECT_EQ(first_code_of(recording), "wrong-normal") << scene;
  }
}

// --- Whole numbers --------------------------------------------------------------------------------------------------

/// Every whole number of an event, as `change` has it.
struct WholeNumbers {
  std::function<void(int&)> change;

  void see(int& x) const { change(x); }
  void see(Edge& edge) const {
    for (int& x : edge) change(x);
  }
  template <class T>
  void see(std::vector<T>& list) const {
    for (T& x : list) see(x);
  }
  template <class E>
    requires requires { E::fields(); }
  void see(E& e) const {
    std::apply([&](const auto&... f) { (see(e.*f.member), ...); }, E::fields());
  }
  template <class T>
  void see(T&) const {}
};

int whole_numbers_of(Event& event) {
  int count = 0;
  const std::function<void(int&)> counts = [&](int&) { ++count; };
  std::visit([&](auto& e) { WholeNumbers{counts}.see(e); }, event);
  return count;
}

/// The reader takes any that is not negative: what comes after the largest, or of two of them together, is no `int`.
TEST(CheckRanges, WholeNumbersMayBeAsLargeAsTheyCome) {
  constexpr int most = std::numeric_limits<int>::max();
  const std::vector<std::pair<const char*, MethodName>> runs{{"two-unit-cubes", MethodName::gjk}, {"mpr-box-box", MethodName::mpr}, {"sat-box-box", MethodName::sat}, {"projections-ellipses", MethodName::projections}, {"cast-ray", MethodName::gjk}, {"cast-bounce", MethodName::gjk}};
  for (const auto& [scene, method] : runs) {
    const Recording right = gallery_run(scene, method);
    for (std::size_t i = 0; i < std::min<std::size_t>(right.events.size(), 40); ++i)
      for (int number = 0, all = whole_numbers_of(Recording(right).events[i]); number < all; ++number) {
        Recording recording = right;
        int left = number;
        const std::function<void(int&)> change = [&](int& x) { x = left-- == 0 ? most : x; };
        std::visit([&](auto& e) { WholeNumbers{change}.see(e); }, recording.events[i]);
        const std::string said = all_said_of(recording);
        EXPECT_NE(said, "") << scene << ", number " << number << " of step " << i;
        EXPECT_EQ(said.find(" -214748364"), std::string::npos) << said;
      }
    Recording all = right;
    for (Event& event : all.events) std::visit([&](auto& e) { WholeNumbers{[&](int& x) { x = most; }}.see(e); }, event);
    all.result.iterations = all.result.support_calls = most;
    EXPECT_EQ(all_said_of(all).find(" -214748364"), std::string::npos) << scene;
  }
}

TEST(CheckRanges, IterationsBeyondTheLargestAreAddedUp) {
  Recording recording = gallery_run("two-unit-cubes");
  for (Event& event : recording.events)
    std::visit(
        [](auto& e) {
          if constexpr (requires { e.iteration, e.status; }) e.iteration = std::numeric_limits<int>::max();
        },
        event);
  EXPECT_NE(all_said_of(recording).find("inconsistent"), std::string::npos);
}

// --- Numbers of which products are none -----------------------------------------------------------------------------

TEST(CheckRanges, AnAnswerBeyondAllScenesIsToldAsThat) {
  for (const char* generator : {"another", "a solver under gjkdbg 0.1.0"}) {
    Recording recording = gallery_run("two-unit-cubes");
    recording.generator = generator;
    Result& r = recording.result;
    r.signed_distance = -1e300, r.normal = AnyVector(Eigen::Vector3d(1e300, 0, 0)), r.witness_a = AnyVector(Eigen::Vector3d(1e300, 0, 0)), r.witness_b = AnyVector(Eigen::Vector3d(0, -1e300, 0));
    r.lower_bound.reset(), r.upper_bound.reset();
    const std::string said = all_said_of(recording);
    EXPECT_EQ(said.find("out-of-range: \"signed_distance\" holds -1e+300."), 0U) << said;
    for (const char* untrue : {"wrong-", "inf", "nan", "same point"}) EXPECT_EQ(said.find(untrue), std::string::npos) << said;
    r.intersecting = false;
    EXPECT_NE(all_said_of(recording).find("wrong-answer"), std::string::npos);
    // Beside a right distance each is judged, and what is said of it is so.
    r.intersecting = true, r.signed_distance = -0.1;
    const std::string of_normal = all_said_of(recording);
    EXPECT_NE(of_normal.find("has length 1e+300 instead of 1."), std::string::npos) << of_normal;
    r.normal = AnyVector(Eigen::Vector3d(1, 0, 0));
    const std::string of_witnesses = all_said_of(recording);
    EXPECT_NE(of_witnesses.find("wrong-witness"), std::string::npos) << of_witnesses;
    for (const char* untrue : {"inf", "nan", "same point"}) EXPECT_EQ(of_witnesses.find(untrue), std::string::npos) << of_witnesses;
  }
}

/// Momentum is mass times speed, of any two that a scene may have.
TEST(CheckRanges, LargeMassesHaveLargeMomenta) {
  Recording recording = record(parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "simulate", "steps": 1, "bodies": [{"shape": {"type": "segment", "points": [[1e50, 0], [1e50, 1e49]]}, "mass": 1e30, "angular_velocity": 90}]})", {}));
  EXPECT_EQ(all_said_of(recording), "");
  for (const double beyond : {1e112, 1e160, 1e300}) {
    Recording wrong = recording;
    for (Event& event : wrong.events)
      if (auto* state = std::get_if<recorded::State>(&event)) state->momentum[0] = beyond;
    EXPECT_NE(all_said_of(wrong), "") << beyond;
  }
}

// --- Far from the origin --------------------------------------------------------------------------------------------

TEST(CheckRanges, BodiesFarOutAreJudgedByWhatTheWorldLeavesOfThem) {
  const std::string circle = R"({"type": "circle", "radius": 1e-6})", place = "[1e5, 1e5]";
  const std::string ball = R"({"type": "sphere", "radius": 1})", hull = R"({"type": "hull", "points": [[1, 0, 0], [-1, 0.5, 0], [0, -1, 0.2], [0, 0, 1.3]]})";
  for (const MethodName method : {MethodName::gjk, MethodName::mpr, MethodName::projections, MethodName::closed_form, MethodName::fastest}) EXPECT_EQ(all_said_of(of_bodies(2, "penetration", circle, place, circle, place, method)), "");
  for (const char* far : {"1e9", "1e11", "1e12", "1e13", "1e14", "1e15"})
    for (const char* query : {"distance", "penetration", "contact"})
      for (const char* beside : {"0", "0.7", "1.5", "40"}) {
        const std::string at = "[" + std::string(far) + ", 0, 0]", next = "[" + std::string(far) + ", " + beside + ", 0.1]";
        EXPECT_EQ(all_said_of(of_bodies(3, query, ball, at, hull, next)), "") << far << " " << query << " " << beside;
        EXPECT_EQ(all_said_of(of_bodies(3, query, hull, at, hull, next)), "") << far << " " << query << " " << beside;
      }
  // So where they move.
  for (const char* scene : {"cast-bounce", "cast-slow-approach", "sim-newtons-cradle", "sim-slope-holds"})
    for (const double out : {1e11, 1e12, 1e13}) {
      SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file(scene));
      for (Body& body : file.scene.bodies) body.pose.position[0] += out;
      file.scene.motion->steps = std::min(file.scene.motion->steps, 20);
      EXPECT_EQ(all_said_of(record(file)), "") << scene << " " << out;
    }
  // Of what it leaves nothing is let pass.
  Recording wrong = of_bodies(2, "penetration", circle, place, circle, place);
  *wrong.result.signed_distance *= 1.01, wrong.result.lower_bound.reset(), wrong.result.upper_bound.reset(), wrong.generator = "another";
  EXPECT_EQ(first_code_of(wrong), "wrong-depth");
}

// --- Scenes whose lengths have no squares ---------------------------------------------------------------------------

TEST(CheckRanges, TinyScenesAreJudgedInUnitsOfTheirOwn) {
  const Recording line = of_bodies(1, "penetration", R"({"type": "interval", "min": 0, "max": 1e-200})", "[0]", R"({"type": "interval", "min": 5e-201, "max": 3e-200})", "[0]");
  EXPECT_EQ(all_said_of(line), "");
  for (const std::string size : {"e-70", "e-100", "e-155", "e-200", "e-300"}) {
    const std::string box = R"({"type": "box", "half_extents": [1)" + size + ", 1" + size + ", 1" + size + "]}";
    const std::string hull = R"({"type": "hull", "points": [[1)" + size + ", 0, 0], [-1" + size + ", 0.5" + size + ", 0], [0, -1" + size + ", 0.2" + size + "], [0, 0, 1.3" + size + "]]}";
    const std::string ball = R"({"type": "sphere", "radius": 1)" + size + "}", origin = "[0, 0, 0]";
    for (const std::string x : {"0.3", "1.1", "5"}) {
      const std::string at = "[" + x + size + ", 0.2" + size + ", 0]";
      for (const char* query : {"intersect", "distance", "penetration"})
        for (const auto& [a, b, method] : {std::tuple(box, hull, MethodName::gjk), std::tuple(box, box, MethodName::sat), std::tuple(hull, hull, MethodName::mpr), std::tuple(ball, hull, MethodName::gjk_accelerated), std::tuple(ball, ball, MethodName::closed_form), std::tuple(box, box, MethodName::fastest)})
          EXPECT_EQ(all_said_of(of_bodies(3, query, a, origin, b, at, method)), "") << size << " " << x << " " << query << " " << word_of(method);
      Recording wrong = of_bodies(3, "penetration", box, origin, hull, at);
      *wrong.result.signed_distance *= 1.01, wrong.result.lower_bound.reset(), wrong.result.upper_bound.reset(), wrong.generator = "another";
      const std::string said = all_said_of(wrong);
      EXPECT_EQ(said.find("wrong-d"), 0U) << said;
      EXPECT_NE(said.find("Lengths are told in units of "), std::string::npos) << said;
      // What is no length of such a scene.
      *wrong.result.signed_distance = 1e9;
      EXPECT_NE(all_said_of(wrong), "") << size;
    }
  }
}

/// Their energies are squares, of which a file has few digits or none: they are reckoned from places and velocities. One that cannot have been lost is still found.
TEST(CheckRanges, SimulationsOfTinyBodies) {
  for (const std::string size : {"e-120", "e-145", "e-160", "e-200", "e-270"}) {
    const SceneFile file = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "simulate", "gravity": [0, -9)" + size + R"(, 0], "steps": 30, "bodies": [
      {"static": true, "shape": {"type": "box", "half_extents": [9)" + size + ", 1" + size + ", 9" + size + R"(]}, "pose": {"position": [0, -1)" + size + R"(, 0]}},
      {"shape": {"type": "ellipsoid", "radii": [0.5)" + size + ", 0.2" + size + ", 0.3" + size + R"(]}, "pose": {"position": [0, 0.6)" + size + R"(, 0]}, "mass": 2,
       "velocity": [1)" + size + ", -2" + size + ", 0" + R"(], "restitution": 0.5}]})", {});
    const Recording recording = record(file);
    EXPECT_EQ(all_said_of(recording), "") << size;
    Recording other = recording;
    std::size_t step = other.events.size();
    while (!std::holds_alternative<recorded::State>(other.events[--step]) || step > other.events.size() / 2) {}
    std::get<recorded::State>(other.events[step]).energy += 1e-3;
    const std::vector<Finding> findings = check(other);
    ASSERT_FALSE(findings.empty()) << size;
    EXPECT_EQ(findings[0].step, step) << size << ": " << findings[0].message;
  }
}

/// Below the normal numbers a file holds the nearest point to few digits: the direction along it has all of them.
TEST(CheckRanges, LengthsBelowTheNormalNumbers) {
  for (const std::string size : {"e-310", "e-312"}) {
    const Recording flat = of_bodies(2, "penetration", R"({"type": "ellipse", "radii": [1.2)" + size + ", 1.714" + size + "]}", "[0, 0]", R"({"type": "box", "half_extents": [1.8)" + size + ", 1.2" + size + "]}", "[3" + size + ", 0]");
    EXPECT_EQ(all_said_of(flat), "") << size;
    const Recording solid = of_bodies(3, "penetration", R"({"type": "ellipsoid", "radii": [1.947)" + size + ", 0.5" + size + ", 1.919" + size + "]}", "[0, 0, 0]",
                                      R"({"type": "box", "half_extents": [1.053)" + size + ", 2.017" + size + ", 1.112" + size + "]}", "[3" + size + ", 0, 0]");
    EXPECT_EQ(all_said_of(solid), "") << size;
  }
}

}  // namespace
}  // namespace gjkdbg
