// What check must not overlook in recordings of motions, one edit at a time, and what it must not take for wrong in our own.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "recordings/check.h"
#include "recordings/gallery.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

Recording of_gallery(const std::string& scene) { return record(read_scene(read_gallery(GJKDBG_GALLERY).file(scene))); }

std::string told(const Recording& recording) {
  std::string out;
  for (const Finding& f : check(recording)) out += std::to_string(f.step) + " " + f.code + ": " + f.message + "\n";
  return out;
}

template <class E>
E& event_at(Recording& recording, std::size_t step) {
  return std::get<E>(recording.events.at(step));
}

/// The step and the code of the first finding after an edit.
std::string finding_after(const Recording& right, const std::function<void(Recording&)>& edit) {
  Recording wrong = right;
  edit(wrong);
  const std::vector<Finding> findings = check(wrong);
  return findings.empty() ? "none" : std::to_string(findings[0].step) + " " + findings[0].code;
}

AnyVector plane(double x, double y) { return Eigen::Vector2d(x, y); }

TEST(CheckMotion, StepsAfterTheFirstResponse) {
  const Recording right = of_gallery("cast-bounce");
  ASSERT_EQ(told(right), "");
  ASSERT_EQ(right.events.size(), 46U);
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastAdvanced>(r, 42).distance = -5; }), "42 wrong-distance");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastAdvanced>(r, 42).bound = -5; }), "42 inconsistent");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastAdvanced>(r, 34).normal *= -1; }), "34 wrong-normal");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastAdvanced>(r, 34).time += 0.01; }), "34 wrong-time") << "not the run before it, which is of the right time";
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::ImpulseApplied>(r, 25).normal = plane(0, 1); }), "25 flipped-normal");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::ImpulseApplied>(r, 43).point = plane(2, 99); }), "43 wrong-contact");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::ImpulseApplied>(r, 43).velocities_after[0][0] *= 0.5; }), "43 wrong-state");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::ImpulseApplied>(r, 43).time += 0.01; }), "43 tunnelling");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::ImpulseApplied>(r, 43).time -= 0.01; }), "43 wrong-time");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::State>(r, 26).energy = -77; }), "26 wrong-state");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::State>(r, 26).momentum = plane(3, 3); }), "26 wrong-state");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastEnded>(r, 45).pair = {0, 7}; }), "45 wrong-pair");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastEnded>(r, 45).pair = {0, 1}; }), "45 wrong-pair");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastEnded>(r, 45).status = CastStatus::hit; }), "45 wrong-pair");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastEnded>(r, 45).status = CastStatus::hit, event_at<recorded::CastEnded>(r, 45).pair = {0, 2}; }), "45 wrong-time");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastEnded>(r, 45).status = CastStatus::at_rest; }), "45 wrong-answer");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastEnded>(r, 45).status = CastStatus::initially_overlapping, event_at<recorded::CastEnded>(r, 45).pair = {0, 2}; }), "45 wrong-answer");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::CastEnded>(r, 45).time = 0.8; }), "45 wrong-time");
  EXPECT_EQ(finding_after(right, [](Recording& r) { r.result.support_calls = 99; }), "45 inconsistent");
  // The second impact and all that follows from it left out: the ball goes on through the wall.
  Recording through = right;
  through.events.erase(through.events.begin() + 42, through.events.begin() + 45);
  EXPECT_NE(told(through).find("tunnelling"), std::string::npos);
}

TEST(CheckMotion, RunsAreThoseOfBodiesAtRest) {
  const Recording right = of_gallery("cast-bounce");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::GjkEnded>(r, 7).upper_bound = 50; }), "7 inconsistent");
  EXPECT_EQ(finding_after(right, [](Recording& r) { event_at<recorded::GjkEnded>(r, 33).lower_bound = 3; }), "33 wrong-bounds");
  EXPECT_EQ(finding_after(right, [](Recording& r) {
              auto& query = event_at<recorded::SupportQueried>(r, 36);
              query.a += plane(0, 0.1), query.w += plane(0, 0.1);
            }), "36 wrong-support");
  Recording deep = of_gallery("cast-initially-overlapping");
  const auto epa = [](const Event& e) { return std::holds_alternative<recorded::EpaEnded>(e); };
  const auto step = static_cast<std::size_t>(std::find_if(deep.events.begin(), deep.events.end(), epa) - deep.events.begin());
  ASSERT_LT(step, deep.events.size());
  for (const double depth : {5.0, -1.0}) EXPECT_EQ(finding_after(deep, [&](Recording& r) { event_at<recorded::EpaEnded>(r, step).depth = depth; }), std::to_string(step) + (depth > 0 ? " wrong-depth" : " wrong-distance"));
}

TEST(CheckMotion, AnImpactIsWithinTheIntervalAndAMissHasNone) {
  const Recording rod = of_gallery("cast-rotating-rod");
  EXPECT_NE(finding_after(rod, [](Recording& r) { r.result.touching_at = 1e300; }).find("wrong-time"), std::string::npos);
  const Recording miss = of_gallery("cast-receding");
  ASSERT_EQ(told(miss), "");
  for (const auto& claim : std::vector<std::function<void(Result&)>>{[](Result& r) { r.touching_at = 3; }, [](Result& r) { r.normal = plane(1, 0); }, [](Result& r) { r.witness_a = plane(9, 9); }, [](Result& r) { r.pair = {0, 1}; }}) {
    Recording wrong = miss;
    claim(wrong.result);
    EXPECT_NE(told(wrong).find("Nothing is met by this result"), std::string::npos) << told(wrong);
  }
  EXPECT_NE(finding_after(rod, [](Recording& r) { r.result.normal.reset(), r.result.witness_a.reset(), r.result.witness_b.reset(); }).find("inconsistent"), std::string::npos);
}

TEST(CheckMotion, PlanesOfARayAreWhereTheBodiesAre) {
  const Recording ray = of_gallery("cast-ray");
  ASSERT_EQ(told(ray), "");
  std::size_t planes = 0;
  for (std::size_t i = 0; i < ray.events.size(); ++i) {
    if (!std::holds_alternative<recorded::CastAdvanced>(ray.events[i])) continue;
    ++planes;
    const std::string step = std::to_string(i) + " ";
    EXPECT_EQ(finding_after(ray, [&](Recording& r) { event_at<recorded::CastAdvanced>(r, i).distance *= -1; }), step + "wrong-distance");
    EXPECT_EQ(finding_after(ray, [&](Recording& r) { event_at<recorded::CastAdvanced>(r, i).time += 0.01; }), step + "wrong-distance");
    EXPECT_EQ(finding_after(ray, [&](Recording& r) { event_at<recorded::CastAdvanced>(r, i).bound *= 2; }), step + "inconsistent");
  }
  EXPECT_GT(planes, 0U);
}

TEST(CheckMotion, DepthsOfASimulation) {
  const Recording right = of_gallery("sim-falling-box");
  ASSERT_EQ(told(right), "");
  int ends = 0, contacts = 0;
  for (std::size_t i = 0; i < right.events.size(); ++i) {
    const std::string step = std::to_string(i) + " ";
    if (std::holds_alternative<recorded::EpaEnded>(right.events[i]) && ends++ < 3) {
      for (const double depth : {5.0, -1.0}) EXPECT_EQ(finding_after(right, [&](Recording& r) { event_at<recorded::EpaEnded>(r, i).depth = depth; }), step + (depth > 0 ? "wrong-depth" : "wrong-distance"));
    }
    if (std::holds_alternative<recorded::ContactFound>(right.events[i]) && contacts++ < 8) {
      for (const double off : {-1.0, -0.3, 0.3}) EXPECT_EQ(finding_after(right, [&](Recording& r) { event_at<recorded::ContactFound>(r, i).depth += off; }), step + "wrong-contact") << off;
    }
  }
  EXPECT_GE(ends, 3);
  EXPECT_GE(contacts, 8);
  EXPECT_NE(finding_after(right, [](Recording& r) { r.result.support_calls += 1; }), "none");
}

std::string free_box(const std::string& half_extents, const std::string& spin, const std::string& integrator) {
  return told(record(parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "simulate", "steps": 60, "integrator": ")" + integrator + R"(", "bodies": [
    {"shape": {"type": "box", "half_extents": )" + half_extents + R"(}, "angular_velocity": )" + spin + "}]}", {})));
}

TEST(CheckMotion, AnIntegratorsOwnErrorIsNoGain) {
  for (const char* integrator : {"semi-implicit-euler", "rk4"})
    for (const char* spin : {"[100, 100, 100]", "[300, 200, 100]", "[96, -275, 263]", "[1000, 20, 3000]", "[1, 9000, 5000]", "[0.1, 0, 720]"})
      for (const char* box : {"[0.2, 1, 0.6]", "[0.1, 0.12, 3]", "[1, 0.05, 1]"}) EXPECT_EQ(free_box(box, spin, integrator), "") << integrator << " " << spin << " " << box;
}

TEST(CheckMotion, TrueGainsOfASpinAreFound) {
  const Recording right = record(parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "simulate", "steps": 8, "bodies": [
    {"shape": {"type": "box", "half_extents": [0.2, 1, 0.6]}, "angular_velocity": [100, 100, 100]}]})", {}));
  ASSERT_EQ(told(right), "");
  // Turns a little faster from the fourth state on, and has the energy of it: 1e-4 of it in all, a hundred times what the step leaves.
  Recording wrong = right;
  const double faster = 1 + 5e-5;
  int states = 0;
  for (Event& e : wrong.events)
    if (auto* state = std::get_if<recorded::State>(&e); state && states++ >= 4) {
      state->energy *= faster * faster;
      for (double& w : state->bodies[0].angular_velocity) w *= faster;
    }
  const std::string all = told(wrong);
  EXPECT_NE(all.find("momentum-lost: The angular momentum of body 0"), std::string::npos) << all;
  wrong.generator = "another";
  for (const double gain : {1.02, 1.002}) {
    Recording more = right;
    more.generator = "another";
    states = 0;
    for (Event& e : more.events)
      if (auto* state = std::get_if<recorded::State>(&e); state && states++ >= 4) {
        state->energy *= gain * gain;
        for (double& w : state->bodies[0].angular_velocity) w *= gain;
      }
    EXPECT_NE(told(more).find("energy-gained"), std::string::npos) << gain;
  }
}

/// Its two numbers are not the same.
TEST(CheckMotion, AGainIsToldInAsManyDigitsAsItTakes) {
  Recording wrong = of_gallery("sim-newtons-cradle");
  int states = 0;
  for (Event& e : wrong.events)
    if (auto* state = std::get_if<recorded::State>(&e); state && states++ == 3) state->energy *= 1 + 2e-6;
  const std::string all = told(wrong);
  const std::size_t from = all.find("Energy rose from ");
  ASSERT_NE(from, std::string::npos) << all;
  const std::size_t x = from + 17, to = all.find(" to ", x), y = to + 4;
  EXPECT_NE(all.substr(x, to - x), all.substr(y, all.find(' ', y) - y)) << all;
}

/// A cube around a place of its frame that lies `off` from the pose: as large wherever that is.
std::string sunk(double off, double height) {
  std::string points;
  for (int k = 0; k < 8; ++k) points += (k == 0 ? "[" : ", [") + std::to_string(off + (k & 1 ? 0.5 : -0.5)) + (k & 2 ? ", 0.5" : ", -0.5") + (k & 4 ? ", 0.5]" : ", -0.5]");
  return told(record(parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "simulate", "steps": 2, "gravity": [0, -9.81, 0], "bodies": [
    {"shape": {"type": "box", "half_extents": [5, 1, 5]}, "static": true, "pose": {"position": [0, -1, 0]}},
    {"shape": {"type": "hull", "points": [)" + points + R"(]}, "mass": 1, "pose": {"position": [)" + std::to_string(-off) + ", " + std::to_string(height) + R"(, 0]}}]})", {})));
}
TEST(CheckMotion, SinkingIsToldByTheSizeOfTheBody) {
  for (const double off : {0.0, 100.0}) {
    EXPECT_NE(sunk(off, -0.1).find("sinking"), std::string::npos) << off;
    EXPECT_EQ(sunk(off, 0.3).find("sinking"), std::string::npos) << off;
  }
}

Recording cast_by(SceneFile scene, MethodName method, int limit) {
  scene.method.name = method;
  scene.method.max_iterations = limit;
  return record(scene);
}

/// A limit is a status. What is said all the same is proven, and check finds nothing in it.
void expect_honest(const SceneFile& scene, MethodName method, int limit) {
  const Recording recording = cast_by(scene, method, limit);
  const Result& r = recording.result;
  EXPECT_EQ(told(recording), "") << limit;
  Scene start = scene.scene;
  start.query = Query::penetration;
  for (Body& b : start.bodies) b.motion.reset();
  const Result right = solve(start, resolve_settings({}, start));
  if (r.status != "initially_overlapping") return;
  EXPECT_LE(*right.signed_distance, 1e-8) << limit;
  if (!r.normal) {
    EXPECT_FALSE(r.witness_a || r.witness_b);
    const auto warned = [](const Event& e) { return std::holds_alternative<recorded::Warning>(e); };
    EXPECT_TRUE(std::any_of(recording.events.begin(), recording.events.end(), warned));
  }
}

TEST(CheckMotion, AnOverlapWhoseWayOutIsNotKnownIsClean) {
  const SceneFile cylinders = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "cast", "bodies": [
    {"shape": {"type": "cylinder", "radius": 1, "half_height": 2}, "velocity": [1, 0, 0]}, {"shape": {"type": "cylinder", "radius": 1, "half_height": 2}, "pose": {"rotation": {"axis": [0, 0, 1], "angle": 0.001}}}]})", {});
  const SceneFile ellipsoids = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "cast", "bodies": [
    {"shape": {"type": "ellipsoid", "radii": [1, 1.00001, 3]}, "velocity": [1, 0, 0]}, {"shape": {"type": "ellipsoid", "radii": [0.8, 0.80001, 2.5]}, "pose": {"rotation": {"axis": [0, 0, 1], "angle": 40}}}]})", {});
  const SceneFile ellipses = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "cast", "bodies": [
    {"shape": {"type": "ellipse", "radii": [1, 0.5]}, "velocity": [1, 0]}, {"shape": {"type": "ellipse", "radii": [0.7, 1]}, "pose": {"position": [0.3, 0.2]}}]})", {});
  for (const MethodName method : {MethodName::conservative_advancement, MethodName::root_finding, MethodName::ray_cast}) {
    for (const SceneFile* overlap : {&cylinders, &ellipsoids}) {
      expect_honest(*overlap, method, 512), expect_honest(*overlap, method, 3);
      EXPECT_EQ(cast_by(*overlap, method, 512).result.status, "initially_overlapping");
      EXPECT_TRUE(cast_by(*overlap, method, 512).result.normal);
    }
    for (int limit = 1; limit <= 12; ++limit) expect_honest(ellipses, method, limit);
    EXPECT_FALSE(cast_by(ellipses, method, 4).result.normal) << word_of(method);
    EXPECT_TRUE(cast_by(ellipses, method, 512).result.normal) << word_of(method);
  }
}

/// After two iterations the normal is no more than a guess, and the depth what is proven: that it fits the other way round by chance says nothing.
TEST(CheckMotion, AContactThatIsNotKnownIsNotCalledFlipped) {
  const SceneFile scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "simulate", "steps": 5, "time_step": 0.1, "integrator": "explicit-euler", "bodies": [
    {"shape": {"type": "box", "half_extents": [2, 1.081672165790601, 1.381847696408812]}, "velocity": [2.694, 1.011, -2.348], "pose": {"position": [-1.2173894062157147, -1.6355289490958123, -2.777129835975133],
      "rotation": {"matrix": [[-0.2975024735346543, 0.9513640713540921, -0.07999176193414423], [-0.9060166480474212, -0.3077520485002241, -0.2905555198319784], [-0.30104171090013077, -0.013967117830180207, 0.9535086826651554]]}}},
    {"shape": {"type": "cylinder", "radius": 1.5, "half_height": 2, "margin": 0.2345350086941435}, "static": true,
      "pose": {"position": [0, -2.553600387238033, -2.8895152054974167], "rotation": {"quaternion": [-0.036226150658218416, -0.0947763510118033, 0.6854621402910436, -0.7210039968855908]}}}],
    "method": {"max_iterations": 2, "tolerance": 0.9, "initial_direction": [0.5943329543494913, -0.6850832522324033, 0.421223547400758]}})", {});
  const Recording recording = record(scene);
  ASSERT_EQ(recording.result.status, "contact_unknown");
  EXPECT_EQ(told(recording), "");
}

TEST(CheckMotion, CastsAtLowLimitsAreClean) {
  RandomScenes random(91);
  for (int k = 0; k < pairs_asked(1500); ++k) {
    const int d = 2 + k % 2;
    SceneFile file;
    file.scene = random.scene(d, Family::general, true);
    Scene& scene = file.scene;
    scene.query = Query::cast;
    scene.motion = SceneMotion{};
    scene.motion->gravity = AnyVector::Zero(d);
    scene.motion->response = static_cast<Response>(k % 3);
    for (Body& b : scene.bodies) {
      if (k % 4 == 0) b.pose.position *= 0.2;
      b.motion = Motion{};
      b.motion->velocity = AnyVector::Zero(d), b.motion->angular_velocity = AnyVector::Zero(d == 2 ? 1 : 3);
      b.motion->restitution = 0.5;
      for (double& x : b.motion->velocity) x = random.uniform(-6, 6);
      if (k % 3 == 1)
        for (double& x : b.motion->angular_velocity) x = random.uniform(-3, 3);
    }
    const MethodName method = k % 3 == 1 ? (k % 2 == 0 ? MethodName::conservative_advancement : MethodName::root_finding) : std::array{MethodName::conservative_advancement, MethodName::ray_cast, MethodName::root_finding}[static_cast<std::size_t>(k / 3 % 3)];
    expect_honest(file, method, k % 5 == 0 ? 512 : 1 + k % 14);
    if (testing::Test::HasFailure()) {
      std::printf("scene %d\n", k);
      return;
    }
  }
}

/// A ball that bounces for ever, on a floor or a hill, at any limit: no step gains energy, no run of GJK or EPA that came to its limit is acted on in silence, and its contacts do
/// not bounce. That the semi-implicit rule has more energy after a bounce than before it, by m |g| h |v|, is no gain: the fall before had lost half of it, the rise loses the rest.
TEST(CheckMotion, BouncesAtAnyLimitAreClean) {
  RandomScenes random(17);
  int limited = 0;
  for (int k = 0; k < pairs_asked(240); ++k) {
    SceneFile file = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "simulate", "gravity": [0, -9.81], "steps": 90, "bodies": [
      {"shape": {"type": "ellipse", "radii": [3, 1]}, "static": true}, {"shape": {"type": "circle", "radius": 0.5}, "pose": {"position": [0, 2.5]}, "restitution": 1}]})", {});
    Scene& scene = file.scene;
    if (k % 3 == 1) scene.bodies[0].shape = {Box{plane(-3, -1), plane(3, 1)}, 0};
    if (k % 4 == 1) scene.bodies[1].shape = {Ellipsoid{plane(random.uniform(0.2, 1), random.uniform(0.2, 1))}, 0};
    scene.bodies[1].motion->velocity = plane(random.uniform(-1, 1), 0);
    scene.bodies[1].pose.position = plane(random.uniform(-1, 1), random.uniform(2, 3.5));
    scene.motion->integrator = static_cast<Integrator>(k % 3);
    if (k % 5 != 0) file.method.max_iterations = random.integer(3, 14);
    const Recording recording = record(file);
    ASSERT_EQ(told(recording), "") << k;
    const auto unknown = [](const Event& e) { return std::holds_alternative<recorded::Warning>(e) && std::get<recorded::Warning>(e).code == "contact-unknown"; };
    const auto warning = std::find_if(recording.events.begin(), recording.events.end(), unknown);
    EXPECT_EQ(recording.result.status, warning == recording.events.end() ? "completed" : "contact_unknown");
    Recording lies = recording;
    lies.result.status = warning == recording.events.end() ? StatusWord("contact_unknown") : StatusWord("completed");
    EXPECT_NE(told(lies).find("inconsistent"), std::string::npos) << "the status does not fit";
    if (warning == recording.events.end()) continue;
    ++limited;
    Recording silent = recording;
    std::erase_if(silent.events, unknown);
    EXPECT_NE(told(silent).find("inconsistent"), std::string::npos) << "a limit that is not told";
  }
  EXPECT_GT(limited, 10 * pairs_asked(240) / 240);
}

/// Of another program that turns back after the fall what ours turns back in the middle of it: a bounce gains m |g| h |v|, which its depth does not make up for.
TEST(CheckMotion, ABounceThatGainsIsOne) {
  SceneFile file = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "simulate", "gravity": [0, -9.81], "steps": 60, "bodies": [
    {"shape": {"type": "ellipse", "radii": [3, 1]}, "static": true}, {"shape": {"type": "circle", "radius": 0.5}, "pose": {"position": [0, 3.37]}, "restitution": 1}]})", {});
  Recording more = record(file);
  EXPECT_EQ(told(more), "");
  more.generator = "another";
  bool bounced = false;
  for (Event& e : more.events) {
    bounced = bounced || std::holds_alternative<recorded::ImpulseApplied>(e);
    auto* state = std::get_if<recorded::State>(&e);
    if (!state || !bounced) continue;
    recorded::BodyState& ball = state->bodies[1];
    const double before = ball.velocity[1];
    ball.velocity[1] += 9.81 / 60, state->momentum[1] += 9.81 / 60, state->energy += (ball.velocity[1] * ball.velocity[1] - before * before) / 2;
  }
  EXPECT_NE(told(more).find("energy-gained"), std::string::npos) << told(more);
}

}  // namespace
}  // namespace gjkdbg
