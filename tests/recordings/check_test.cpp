// A right implementation has no findings, whatever it is asked.
#include "recordings/check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "recordings/comparison.h"
#include "recordings/gallery.h"
#include "recordings/replay.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

std::string text(const std::vector<Finding>& findings) {
  std::string out;
  for (const Finding& f : findings) out += std::to_string(f.step) + " " + f.code + ": " + f.message + "\n";
  return out;
}

TEST(Check, OurOwnRecordingsOfTheGalleryAreClean) {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  for (const Lesson& lesson : gallery.lessons)
    for (const std::string& name : lesson.scenes)
      for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision})
        for (const bool boolean : {false, true}) {
          SceneFile scene = read_scene(gallery.file(name));
          scene.method.scalar = scalar;
          if (boolean && scene.scene.motion) continue;
          if (boolean) change_name(scene.method, MethodName::gjk_boolean), scene.scene.query = Query::intersect;
          EXPECT_EQ(text(check(record(scene))), "") << name << (boolean ? " boolean" : "") << (scalar == Scalar::double_precision ? "" : " float");
        }
}

/// A hull 2.3e-9 deep in a cone 2,000 wide: the polytope is 1e-12 of its size thick, and the corners of its faces do not tell which way is out.
TEST(Check, SliversOfEpaAreClean) {
  const SceneFile scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "bodies": [
    {"shape": {"type": "hull", "points": [[1.4978637168373088, 5.40018749880125, -27.381588012171562], [-13.773202500515403, 43.39283107051897, -16.936332436538386],
                                          [-25.68657521122911, -31.818092404383663, -54.3201256887751], [-41.35216958486282, -49.073385174348786, 66.77040544929957]]},
     "pose": {"position": [0, 0, 0], "rotation": {"axis": [1.3522100961327492, 0.2604920112458137, 0.7301164645809861], "angle": 90}}},
    {"shape": {"type": "cone", "radius": 2007.7253138390229, "half_height": 2007.7253138390229, "axis": "x"},
     "pose": {"position": [-779.6359209099871, -382.04428673898946, -562.6793925857306]}}]})", {});
  EXPECT_EQ(text(check(record(scene))), "");
}

/// Putting bodies apart that begin inside each other lifts them: not an error. Nor is a contact that is farther from a sharp body than that reaches: it lies
/// half-way between its two points.
TEST(Check, BodiesInsideEachOtherAreClean) {
  for (const char* body : {R"("shape": {"type": "box", "half_extents": [0.5, 0.5]}, "pose": {"position": [0, 0.3]})",
                           R"("shape": {"type": "polygon", "points": [[-0.18, 0.466], [0.4856, -0.119], [0.4872, -0.1125]]}, "pose": {"position": [0, 2.3]}, "velocity": [0, 0.77])"})
    EXPECT_EQ(text(check(record(parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "simulate", "gravity": [0, -9.81], "time_step": 0.01, "steps": 90, "bodies": [
      {"static": true, "friction": 0.6, "shape": {"type": "box", "half_extents": [20, 0.5]}, "pose": {"position": [0, -0.5]}}, {"friction": 0.6, )" + std::string(body) + "}]}", {})))), "");
}

/// Written, read, run again, checked and shown: every scene by every method that answers it.
TEST(Check, EveryMethodsRecordingsAreReadBackAndClean) {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  std::vector<int> used(method_names.size());
  int missed_portals = 0;
  for (const Lesson& lesson : gallery.lessons)
    for (const std::string& name : lesson.scenes)
      for (std::size_t m = 0; m < method_names.size(); ++m) {
        SceneFile scene = read_scene(gallery.file(name));
        scene.expect.reset();  // which may be of another method
        if (scene.scene.query == Query::simulate && m > 0) continue;  // long, and GJK's rooms once more
        change_name(scene.method, static_cast<MethodName>(m));
        std::string written;
        try {
          written = recording_to_text(record(scene));
        } catch (const Error&) {
          continue;  // no method for this scene
        }
        ++used[m];
        SCOPED_TRACE(name + " by " + std::string(method_names[m]));
        const Recording read = parse_recording(written, {});
        EXPECT_EQ(recording_to_text(read), written);
        EXPECT_FALSE(verify(read));
        const std::vector<Finding> findings = check(read);
        if (read.settings.name == MethodName::mpr && findings.size() == 1) {
          EXPECT_EQ(findings.front().code, "wrong-witness");
          EXPECT_NE(findings.front().message.find("MPR's depth is more than the right one"), std::string::npos);
          EXPECT_LE(++missed_portals, 2);
        } else {
          EXPECT_EQ(text(findings), "");
        }
        Replay replay(read);
        replay.at(read.events.size() - 1);
      }
  for (std::size_t m = 0; m < used.size(); ++m) EXPECT_GT(used[m], 5) << method_names[m];
}

TEST(Check, PointsOutASceneThatAsksForMoreThanItReads) {
  SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep"));
  EXPECT_EQ(text(check(record(file))), "");
  file.expect = Expectation{.intersecting = true, .signed_distance = {}, .normal = {}, .time = {}};
  EXPECT_NE(text(check(record(file))).find("asks-too-much"), std::string::npos);
  file.scene.query = Query::intersect;
  EXPECT_EQ(text(check(record(file))), "");
}

TEST(Check, OurOwnRecordingsOfRandomScenesAreClean) {
  RandomScenes random(21);
  const int count = pairs_asked(2000);
  for (int k = 0; k < count; ++k) {
    SceneFile file;
    file.scene = random.scene(1 + k % 3, static_cast<Family>(k / 3 % family_count), k % 2 == 0);
    file.scene.query = static_cast<Query>(k % 4);
    file.method.closest_point = static_cast<ClosestPoint>(k / 7 % 3);
    if (k / 5 % 3 == 0) file.method.name = MethodName::gjk_accelerated, file.method.acceleration = static_cast<Acceleration>(k / 15 % 4);
    if (file.scene.query == Query::intersect && k % 8 < 4) file.method.name = MethodName::gjk_boolean;
    if (k % 11 == 0) file.method.name = MethodName::mpr;
    if (k % 13 == 0 && k % 2 == 0) file.method.name = MethodName::sat;
    EXPECT_EQ(text(check(record(file))), "") << "scene " << k;
    if (testing::Test::HasFailure()) break;
  }
}

/// A recording of a scene of the gallery.
Recording recorded_scene(const std::string& name) { return record(read_scene(read_gallery(GJKDBG_GALLERY).file(name))); }

/// Where the nth event of a kind stands.
template <class E>
std::size_t step_of(const Recording& recording, std::size_t nth = 0) {
  for (std::size_t i = 0; i < recording.events.size(); ++i)
    if (std::holds_alternative<E>(recording.events[i]) && nth-- == 0) return i;
  ADD_FAILURE() << "no such event";
  return 0;
}
template <class E>
E& event(Recording& recording, std::size_t nth = 0) {
  return std::get<E>(recording.events[step_of<E>(recording, nth)]);
}

/// The first finding, as "step code".
std::string first(const Recording& recording) {
  const std::vector<Finding> findings = check(recording);
  return findings.empty() ? "none" : std::to_string(findings[0].step) + " " + findings[0].code;
}
std::string named(std::size_t step, const std::string& code) { return std::to_string(step) + " " + code; }

/// A body may lie well inside the other: then the middle of what would separate them is in neither.
TEST(Check, DistanceQueriesOfOverlapsNameAPointOfBothBodies) {
  RandomScenes random(22);
  std::vector<int> used(method_names.size());
  const int count = std::max(100, pairs_asked(400));
  for (int k = 0; k < count; ++k) {
    SceneFile file;
    file.scene = random.scene(1 + k % 3, static_cast<Family>(k / 3 % family_count), true);
    file.scene.query = Query::distance;
    file.scene.bodies[1].pose.position = file.scene.bodies[0].pose.position;
    for (const MethodName name : {MethodName::gjk, MethodName::sat, MethodName::mpr, MethodName::closed_form, MethodName::projections, MethodName::fastest}) {
      change_name(file.method, name);
      try {
        resolve_settings(file.method, file.scene);
      } catch (const Error&) {
        continue;  // no method for these bodies
      }
      ++used[static_cast<std::size_t>(name)];
      EXPECT_EQ(text(check(record(file))), "") << "scene " << k << " by " << word_of(name);
    }
    if (testing::Test::HasFailure()) break;
  }
  for (const MethodName name : {MethodName::sat, MethodName::mpr, MethodName::closed_form, MethodName::projections}) EXPECT_GT(used[static_cast<std::size_t>(name)], count / 20) << word_of(name);
  SceneFile nested = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "distance", "bodies": [
    {"shape": {"type": "box", "half_extents": [2, 2, 2]}}, {"shape": {"type": "box", "half_extents": [0.1, 0.1, 0.1]}, "pose": {"position": [1, 0, 0]}}]})", {});
  change_name(nested.method, MethodName::sat);
  Recording r = record(nested);
  EXPECT_EQ(first(r), "none");
  r.result.witness_b = AnyVector(Eigen::Vector3d(1.45, 0.1, 0.1));
  EXPECT_EQ(first(r), named(r.events.size() - 1, "wrong-witness"));
}

TEST(Check, KnowsWhoseVerticesMprAndGjkAfterItHave) {
  SceneFile file = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "sphere", "radius": 1}}, {"shape": {"type": "sphere", "radius": 1}, "pose": {"position": [1.9, 0, 0]}}]})", {});
  change_name(file.method, MethodName::mpr);
  for (const Penetration penetration : {Penetration::epa, Penetration::mpr, Penetration::none}) {
    file.method.penetration = penetration;
    const Recording r = record(file);
    EXPECT_EQ(text(check(r)), "");
    EXPECT_GE(*r.result.upper_bound, -0.1);
  }
}

TEST(Check, NamesAPhaseThatDoesNotEndOnce) {
  const Recording right = recorded_scene("box-box-deep");
  const std::size_t gjk = step_of<recorded::GjkEnded>(right), epa = step_of<recorded::EpaEnded>(right);
  Recording r = right;
  r.events.clear();
  EXPECT_EQ(first(r), named(0, "incomplete-trace"));
  for (const std::size_t end : {gjk, epa}) {
    const auto at = static_cast<std::ptrdiff_t>(end);
    r = right, r.events.insert(r.events.begin() + at, right.events[end]);
    EXPECT_EQ(first(r), named(end + 1, "incomplete-trace"));
    r = right, r.events.erase(r.events.begin() + at);
    EXPECT_EQ(first(r), named(end == epa ? epa - 1 : end, "incomplete-trace"));
  }
}

TEST(Check, NamesANumberThatIsGivenOutAgain) {
  Recording r = recorded_scene("box-box-deep");
  event<recorded::SupportQueried>(r, 2).vertex = event<recorded::SupportQueried>(r, 1).vertex;
  EXPECT_EQ(first(r), named(step_of<recorded::SupportQueried>(r, 2), "number-reused"));
  r = recorded_scene("box-box-deep");
  event<recorded::PolytopeGrown>(r).added[0].face = event<recorded::PolytopeSeeded>(r).faces[0].face;
  EXPECT_EQ(first(r), named(step_of<recorded::PolytopeGrown>(r), "number-reused"));
}

TEST(Check, NamesTheStepOfAWrongSupport) {
  for (const char* scene : {"box-box-deep", "box-box-apart", "ellipsoid-sphere-deep", "2d-corner-to-edge"}) {
    const Recording right = recorded_scene(scene);
    const std::size_t step = step_of<recorded::SupportQueried>(right);
    Recording r = right;
    auto* query = &event<recorded::SupportQueried>(r);
    query->w = -query->w;
    EXPECT_EQ(first(r), named(step, "wrong-support")) << scene;
    r = right, query = &event<recorded::SupportQueried>(r);
    query->a += AnyVector::Ones(query->a.size());
    EXPECT_EQ(first(r), named(step, "wrong-support")) << scene;
    // Both moved alike: the difference is right, the points are not the bodies'.
    r = right, query = &event<recorded::SupportQueried>(r);
    const AnyVector off = 3 * AnyVector::Ones(query->a.size());
    query->a += off, query->b += off;
    EXPECT_EQ(first(r), named(step, "wrong-support")) << scene;
  }
}

TEST(Check, NamesWhatGjkSaysWrongly) {
  const Recording right = recorded_scene("box-box-deep");
  Recording r = right;
  event<recorded::GjkEnded>(r).status = GjkStatus::separated;
  EXPECT_EQ(first(r), named(step_of<recorded::GjkEnded>(r), "unjustified-separation"));
  const std::size_t step = step_of<recorded::SimplexReduced>(right, 1);
  r = right;
  event<recorded::SimplexReduced>(r, 1).closest *= 1.1;
  EXPECT_EQ(first(r), named(step, "wrong-closest"));
  r = right;
  auto& weights = event<recorded::SimplexReduced>(r, 1).barycentric;
  weights[0] += 0.1, weights[1] -= 0.1;
  EXPECT_EQ(first(r), named(step, "wrong-closest"));
  r = right;
  event<recorded::SimplexReduced>(r, 1).lower_bound = 0.5;
  EXPECT_EQ(first(r), named(step, "wrong-bounds"));
}

TEST(Check, NamesWhatEpaSaysWrongly) {
  const Recording right = recorded_scene("box-box-deep");
  const auto expect = [&](const auto& edit, std::size_t step, const char* code) {
    Recording r = right;
    edit(r);
    EXPECT_EQ(first(r), named(step, code));
  };
  const std::size_t seeded = step_of<recorded::PolytopeSeeded>(right), chosen = step_of<recorded::FaceChosen>(right);
  const std::size_t grown = step_of<recorded::PolytopeGrown>(right), ended = step_of<recorded::EpaEnded>(right);
  expect([](Recording& r) { event<recorded::PolytopeSeeded>(r).faces[1].distance += 0.1; }, seeded, "wrong-face");
  expect([](Recording& r) { event<recorded::FaceChosen>(r).distance *= 2; }, chosen, "wrong-face");
  expect([](Recording& r) { event<recorded::FaceChosen>(r).normal = Eigen::Vector3d(0.6, 0, 0.8); }, chosen, "wrong-face");
  expect([](Recording& r) { event<recorded::FaceChosen>(r).face = 999; }, chosen, "wrong-face");
  expect([](Recording& r) { event<recorded::PolytopeGrown>(r).horizon.pop_back(); }, grown, "wrong-horizon");
  expect([](Recording& r) { event<recorded::PolytopeGrown>(r).horizon[0][0] = 99; }, grown, "wrong-horizon");
  expect([](Recording& r) { event<recorded::EpaEnded>(r).normal *= -1; }, ended, "flipped-normal");
  expect([](Recording& r) { event<recorded::EpaEnded>(r).depth += 0.01; }, ended, "wrong-depth");
}

TEST(Check, NamesBoundsThatLeaveTheAnswerOut) {
  for (const char* scene : {"box-box-deep", "box-box-apart"}) {
    Recording r = recorded_scene(scene);
    *r.result.lower_bound = *r.result.signed_distance + 1e-3;
    EXPECT_EQ(first(r), named(r.events.size() - 1, "wrong-bounds"));
    r = recorded_scene(scene);
    *r.result.upper_bound = *r.result.signed_distance - 1e-3;
    EXPECT_EQ(first(r), named(r.events.size() - 1, "wrong-bounds"));
  }
}

TEST(Check, NamesANormalOfMprThatIsTurnedRound) {
  SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep"));
  change_name(file.method, MethodName::mpr);
  const Recording right = record(file);
  EXPECT_EQ(first(right), "none");
  Recording r = right;
  *r.result.normal *= -1;
  EXPECT_EQ(first(r), named(r.events.size() - 1, "flipped-normal"));
  r = right;
  event<recorded::MprEnded>(r).normal *= -1;
  EXPECT_EQ(first(r), named(step_of<recorded::MprEnded>(r), "flipped-normal"));
}

TEST(Check, NamesWhatOtherMethodsSayWrongly) {
  SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep"));
  change_name(file.method, MethodName::mpr);
  Recording r = record(file);
  event<recorded::PortalFound>(r).distance += 0.1;
  EXPECT_EQ(first(r), named(step_of<recorded::PortalFound>(r), "wrong-face"));
  change_name(file.method, MethodName::sat);
  r = record(file);
  EXPECT_EQ(first(r), "none");
  event<recorded::AxisTested>(r, 2).distance += 0.1;
  EXPECT_EQ(first(r), named(step_of<recorded::AxisTested>(r, 2), "wrong-depth"));
  Recording right = recorded_scene("sat-2d-apart");
  EXPECT_EQ(first(right), "none");
  r = right, event<recorded::PointsProjected>(r).a[0] += 0.1;
  EXPECT_EQ(first(r), named(step_of<recorded::PointsProjected>(r), "wrong-support"));
  r = right, event<recorded::PointsProjected>(r).lower_bound += 0.1;
  EXPECT_EQ(first(r), named(step_of<recorded::PointsProjected>(r), "wrong-bounds"));
  r = right, event<recorded::PointsProjected>(r).upper_bound += 0.1;
  EXPECT_EQ(first(r), named(step_of<recorded::PointsProjected>(r), "wrong-bounds"));
  right = recorded_scene("closed-form-capsules");
  EXPECT_EQ(first(right), "none");
  r = right, event<recorded::ClosedFormEnded>(r).s += 0.1;
  EXPECT_EQ(first(r), named(step_of<recorded::ClosedFormEnded>(r), "wrong-closest"));
  r = right, event<recorded::ClosedFormEnded>(r).normal *= -1;
  EXPECT_EQ(first(r), named(step_of<recorded::ClosedFormEnded>(r), "flipped-normal"));
  r = recorded_scene("box-box-deep");
  event<recorded::SimplexReduced>(r, 1).upper_bound += 0.1;
  EXPECT_EQ(first(r), named(step_of<recorded::SimplexReduced>(r, 1), "wrong-bounds"));
}

/// The codes of a cast's result that was changed.
std::string after(const char* scene, const std::function<void(Result&)>& edit) {
  Recording r = recorded_scene(scene);
  edit(r.result);
  const std::vector<Finding> findings = check(r);
  std::string codes;
  for (const Finding& f : findings) codes += (codes.empty() ? "" : " ") + f.code;
  return codes;
}

TEST(Check, NamesWhatACastSaysWrongly) {
  const auto missed = [](Result& r) { r.intersecting = false, r.status = "miss", r.time = 1, r.pair.reset(), r.normal.reset(), r.witness_a.reset(), r.witness_b.reset(), r.touching_at.reset(); };
  for (const char* scene : {"cast-bullet-thin-wall", "cast-rotating-rod", "cast-ray"}) {
    EXPECT_EQ(after(scene, [](Result&) {}), "") << scene;
    EXPECT_EQ(after(scene, missed), "wrong-answer tunnelling") << scene;
    EXPECT_NE(after(scene, [](Result& r) { r.intersecting = false; }).find("wrong-answer"), std::string::npos) << scene;
    EXPECT_NE(after(scene, [](Result& r) { r.time = 0; }).find("wrong-time"), std::string::npos) << scene;
    EXPECT_NE(after(scene, [](Result& r) { r.time = *r.time + 0.01; }).find("wrong-time"), std::string::npos) << scene;
    EXPECT_NE(after(scene, [](Result& r) { *r.time *= 0.9; }).find("wrong-time"), std::string::npos) << scene;
    EXPECT_NE(after(scene, [](Result& r) { r.pair = {0, 7}; }).find("wrong-pair"), std::string::npos) << scene;
    EXPECT_EQ(after(scene, [](Result& r) { r.normal->setZero(); }), "wrong-normal") << scene;
    EXPECT_NE(after(scene, [](Result& r) { *r.normal *= -1; }).find("flipped-normal"), std::string::npos) << scene;
    EXPECT_EQ(after(scene, [](Result& r) { (*r.witness_a)[0] += 5; }), "wrong-witness") << scene;
  }
  EXPECT_EQ(after("cast-grazing-miss", [](Result& r) { r.intersecting = true; }), "wrong-answer");
  EXPECT_EQ(after("cast-bounce", [](Result& r) { (*r.bodies)[0].velocity *= 2; }), "wrong-state");
  Recording r = recorded_scene("cast-rotating-rod");
  event<recorded::CastAdvanced>(r, 1).distance += 0.1;
  EXPECT_EQ(first(r), named(step_of<recorded::CastAdvanced>(r, 1), "wrong-distance"));
  r = recorded_scene("cast-rotating-rod");
  event<recorded::CastEnded>(r).time *= 0.5;
  EXPECT_EQ(first(r), named(step_of<recorded::CastEnded>(r), "wrong-time"));
}

TEST(Check, NamesStatesThatDoNotFollow) {
  const auto expect = [](const char* scene, const auto& edit, const char* code) {
    Recording r = recorded_scene(scene);
    EXPECT_EQ(first(r), "none") << scene;
    edit(r);
    EXPECT_EQ(first(r), named(step_of<recorded::State>(r, 2), code)) << scene;
  };
  for (const char* scene : {"sim-falling-box", "sim-spinning-box", "sim-explicit-euler", "sim-newtons-cradle"}) {
    expect(scene, [](Recording& r) { event<recorded::State>(r, 2).time += 1e-3; }, "wrong-time");
    expect(scene, [](Recording& r) { event<recorded::State>(r, 2).bodies[0].position[0] += 1e-3; }, "wrong-state");
    expect(scene, [](Recording& r) { event<recorded::State>(r, 2).bodies[0].velocity[0] += 1e-3; }, "wrong-state");
    expect(scene, [](Recording& r) { event<recorded::State>(r, 2).energy += 1e-2 * (1 + std::abs(event<recorded::State>(r, 2).energy)); }, "wrong-state");
    expect(scene, [](Recording& r) { event<recorded::State>(r, 2).momentum[0] += 1e-3; }, "wrong-state");
    EXPECT_EQ(after(scene, [](Result& r) { (*r.bodies)[0].position[0] += 1e-3; }), "wrong-state") << scene;
    EXPECT_EQ(after(scene, [](Result& r) { *r.energy += 1; }), "wrong-state") << scene;
    EXPECT_EQ(after(scene, [](Result& r) { *r.time += 1; }), "wrong-time") << scene;
    EXPECT_EQ(after(scene, [](Result& r) { r.intersecting = !r.intersecting; }), "wrong-answer") << scene;
  }
  Recording r = recorded_scene("sim-newtons-cradle");
  event<recorded::ImpulseApplied>(r).impulse *= 1.01;
  EXPECT_EQ(check(r)[0].code, "wrong-state");
  r = recorded_scene("sim-newtons-cradle");
  event<recorded::ImpulseApplied>(r).velocities_after[1][0] += 0.01;
  EXPECT_EQ(first(r), named(step_of<recorded::ImpulseApplied>(r), "wrong-state"));
}

/// A support that only ended the momentum, or that Newton's direction asked for in vain, was never part of the simplex; Jolt's rule asks once more.
TEST(Check, KnowsWhatMomentumAndJoltsRuleAskFor) {
  RandomScenes random(5);
  for (int k = 0; k < 6000; ++k) {
    SceneFile file;
    file.scene = random.scene(2 + k % 2, static_cast<Family>(k / 3 % family_count), k % 2 == 0);
    if (k % 2 == 0) change_name(file.method, MethodName::gjk_accelerated), file.method.acceleration = static_cast<Acceleration>(k / 2 % 4);
    else file.method.stopping = Stopping::jolt;
    file.scene.query = Query::distance;
    EXPECT_EQ(text(check(record(file))), "") << "scene " << k;
    if (testing::Test::HasFailure()) break;
  }
}

}  // namespace
}  // namespace gjkdbg
