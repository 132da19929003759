// What rounding does to a right run, of whatever method and scalar, is no error; and what is wrong is told at its step, however small the scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "recordings/check.h"
#include "recordings/comparison.h"
#include "recordings/gallery.h"

namespace gjkdbg {
namespace {

Recording run_of(const char* scene) { return record(parse_scene(scene, {})); }

/// All that is said, errors only or warnings, too.
std::string said_of(const Recording& recording, bool warnings = true) {
  std::string out;
  for (const Finding& f : check(recording))
    if (warnings || f.severity == Finding::Severity::error) out += std::to_string(f.step) + " " + f.code + ": " + f.message + "\n";
  return out;
}

/// The step, relative to the one that was edited, and the code of what is told first.
std::string told_first(Recording recording, std::size_t step, const std::function<void(Event&)>& edit) {
  edit(recording.events.at(step));
  const std::vector<Finding> findings = check(recording);
  return findings.empty() ? "none" : std::to_string(static_cast<long>(findings[0].step) - static_cast<long>(step)) + " " + findings[0].code;
}

template <class E>
std::size_t first_of(const Recording& recording, std::size_t from = 0) {
  const auto found = std::find_if(recording.events.begin() + static_cast<std::ptrdiff_t>(from), recording.events.end(), [](const Event& e) { return std::holds_alternative<E>(e); });
  return static_cast<std::size_t>(found - recording.events.begin());
}

// --- What is right ----------------------------------------------------------------------------------------------------

TEST(CheckRounding, ASearchThatWentRoundOnTheSpotConverges) {
  const Recording recording = run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "box", "half_extents": [0.842, 0.8, 0.252]}, "pose": {"rotation": {"quaternion": [0.0834834688460578, -0.8295956127423388, 0.40393218934191494, -0.37635145298183725]}, "position": [0, 0, 0]}},
    {"shape": {"type": "hull", "points": [[0, 0, 0], [0.7429265727908314, 0.21007774399428314, -0.07210918522127474], [1.045, 0.9821558462181577, -0.7890483384445452], [1.1, 0.8099773292524317, -0.9242860825036721]]}, "pose": {"rotation": {"quaternion": [0.0834834688460578, -0.8295956127423388, 0.40393218934191494, -0.37635145298183725]}, "position": [0.17294625358271953, -0.9019705703486778, 0.20341772197463937]}}], "method": {"name": "gjk", "closest_point": "johnson"}})");
  EXPECT_EQ(recording.result.status, "converged");
  EXPECT_EQ(said_of(recording), "");
}

TEST(CheckRounding, OfASliverJohnsonsCofactorsMayNameAnotherPart) {
  EXPECT_EQ(said_of(run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "cylinder", "radius": 300.0, "half_height": 1339.0}, "pose": {"rotation": {"quaternion": [0.42627072372595515, -0.7020419836921167, -0.3599479989026068, -0.4425694988516459]}, "position": [0, 0, 0]}},
    {"shape": {"type": "box", "half_extents": [1199.6360486974843, 224.0, 752.0]}, "pose": {"rotation": {"quaternion": [0.42627072372595515, -0.7020419836921167, -0.3599479989026068, -0.4425694988516459]}, "position": [523.5819605941539, 192.08594187294455, 1392.075141660165]}}], "method": {"name": "gjk-accelerated", "closest_point": "johnson", "acceleration": "nesterov"}})")), "") << "the simplex taken to hold the origin is a millionth of its size thin";
}

TEST(CheckRounding, TheNormalOfBodiesNextToTouchingIsTurned) {
  const Recording recording = run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "box", "half_extents": [0.0013000000000000002, 0.0005, 0.0011]}, "pose": {"rotation": {"quaternion": [0.9567715953345339, -0.2543266209881184, 0.1399406312611941, -0.01796396225768078]}, "position": [0, 0, 0]}},
    {"shape": {"type": "hull", "points": [[0, 0, 0], [0.00023845761336602024, 7.356086337519941e-06, 0.000760685418516988]]}, "pose": {"rotation": {"quaternion": [0.9567715953345339, -0.2543266209881184, 0.1399406312611941, -0.01796396225768078]}, "position": [0.0013913484998327988, 0.0003451751960469121, -1.8536577503757963e-06]}}], "method": {"name": "sat", "closest_point": "voronoi"}})");
  ASSERT_LT(*recording.result.signed_distance, 1e-16);
  EXPECT_EQ(said_of(recording), "");
}

/// Of a portal 1e-4 thin in single precision, and of one of 2e-10: the plane of three vertices is not that of one of them. Another program's is to be.
TEST(CheckRounding, ThePlaneOfASliverIsTurned) {
  for (const char* scene : {R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "intersect", "method": {"name": "mpr", "scalar": "float"}, "bodies": [
    {"shape": {"type": "segment", "points": [[-7.964645926752549e-06, -0.47251365154854763, 0.5850286706662069], [5.947166888633967e-07, -0.022080880101524092, -0.8064804007260065]]}, "pose": {"position": [-1.3845439345750656, -0.7041815039959038, -1.915998119236233], "rotation": {"matrix": [[-0.24001174105177503, -0.9679423905642219, 0.07403980487626155], [0.3060951992953689, -0.003079572766557792, 0.9519959270920773], [-0.92124920251017, 0.25115342876495766, 0.2970216525675885]]}}},
    {"shape": {"type": "sum", "of": [{"type": "hull", "points": [[0.09385820081336416, 0.0031327165666716894, 0.00016014192828234944], [-0.09058742785498894, -0.8313045484134215, -0.1383152038269403], [-0.1754834537396518, 0.6656189476398764, -2.0199008631499552e-05]]}, {"type": "segment", "points": [[0.9846708393398464, -0.011212090959445095, -0.012894811648209603], [-9.95793812479029e-07, 0.6996400603776551, -0.2149374580735064]], "margin": 0.001238648984161194}]}, "pose": {"position": [0.07301639301021234, -0.7011050626221508, -2.1963608497717635], "rotation": {"matrix": [[0.6630539514879943, -0.7047012233039072, 0.252498798591465], [0.7140092334383001, 0.4940650997692674, -0.4960750868112959], [0.22483387640879993, 0.5092110201713632, 0.8307549969485781]]}}}]})",
       R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "intersect", "method": {"name": "mpr"}, "bodies": [
    {"shape": {"type": "hull", "points": [[-0.0016597094204148484, -0.9029850061770888, 0.48895124542448243], [0.3549110374866902, 0.06887622570341101, -7.37386075451155e-05], [0.2888919896484796, -0.6923495184494621, -2.655174660432722e-05]], "margin": 9.488336055813265e-07}, "pose": {"position": [0.22722676075872972, -0.2560002392639281, -0.017342420781136625], "rotation": {"matrix": [[0.6038036047615281, -0.34546282219377505, 0.7183847474431069], [-0.797125327923532, -0.2656589036236596, 0.5422329374985226], [0.003523983511034945, -0.9000448796628906, -0.43578296907156266]]}}},
    {"shape": {"type": "point", "points": [[0.1465362344501636, -0.5379041465838355, 0.01631241511885051]]}, "pose": {"position": [0.7351253200492787, -0.8474821969626112, 0.2855458609155498], "rotation": {"matrix": [[-0.8038758730665043, 0.19917027215452388, 0.5604594395595974], [0.20766240204750275, -0.7889968215974048, 0.5782390010065512], [0.55736873564762, 0.5812187352443878, 0.5928953316762475]]}}}]})"}) {
    Recording recording = run_of(scene);
    EXPECT_EQ(said_of(recording), "");
    recording.generator = "another";
    EXPECT_NE(said_of(recording).find("wrong-face"), std::string::npos);
  }
}

/// In single precision, 1.5e-7 deep: the points that are projected are no better known, and either answer is right.
TEST(CheckRounding, RoundBodiesThatTouchByTheirProjections) {
  const Recording recording = run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "intersect", "method": {"name": "projections", "scalar": "float"}, "bodies": [
    {"shape": {"type": "capsule", "radius": 0.00046424271117729193, "half_height": 5.2724635508622335e-05, "axis": "x"},
     "pose": {"position": [-0.5801655648699204, -0.3261080873669525], "rotation": {"matrix": [[0.5711671944060898, -0.82083374445394], [0.82083374445394, 0.5711671944060898]]}}},
    {"shape": {"type": "capsule", "radius": 1.8264841725251896e-06, "half_height": 0.7018809017175992, "axis": "x"},
     "pose": {"position": [0.02092824460921542, -0.4342494651225123], "rotation": {"matrix": [[0.9843477861722153, 0.1762368742853171], [-0.1762368742853171, 0.9843477861722153]]}}}]})");
  EXPECT_TRUE(recording.result.intersecting);
  EXPECT_EQ(said_of(recording), "");
}

TEST(CheckRounding, PointsProjectedFarOut) { EXPECT_EQ(said_of(run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "box", "half_extents": [0.5, 0.3, 0.501]}, "pose": {"rotation": {"quaternion": [-0.6889933311254824, -0.47884165749354113, 0.5000064661230332, -0.2144583655365433]}, "position": [430.68490967361674, -33788.113854130985, -403.5327212806239]}},
    {"shape": {"type": "box", "half_extents": [1.0, 1.35, 0.6]}, "pose": {"rotation": {"quaternion": [-0.6889933311254824, -0.47884165749354113, 0.5000064661230332, -0.2144583655365433]}, "position": [431.26967683797, -33787.89630770814, -402.07775989462294]}}], "method": {"name": "projections", "closest_point": "johnson", "start": "given", "initial_direction": [0.0535273505876905, -0.6685792426433382, -0.5680074246351977]}})")), ""); }

TEST(CheckRounding, BodiesASimulationLooksAt) {
  EXPECT_EQ(said_of(run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 1, "query": "simulate", "bodies": [
    {"shape": {"type": "interval", "min": -0.40585788538439305, "max": -0.40585788538439305}, "pose": {"position": [1.4950693144577576]}, "mass": 1, "restitution": 0.5},
    {"shape": {"type": "interval", "min": -0.06470449263462186, "max": 1.335295507365378}, "pose": {"position": [2.316608225668106]}, "velocity": [0.450592144306317], "mass": 0.2846154470328532},
    {"shape": {"type": "interval", "min": -0.1544484723386701, "max": 0.045551527661329916}, "pose": {"position": [0.28059119800659493]}, "velocity": [-1.1442435698820255], "mass": 1, "restitution": 1},
    {"shape": {"type": "interval", "min": -0.7940563098430851, "max": 0.49194369015691497}, "pose": {"position": [-2.371468757617874]}, "velocity": [0.7424975827692433], "mass": 0.001}], "method": {"scalar": "float", "closest_point": "signed-volumes"}, "time_step": 0.01, "steps": 10, "gravity": [-9.81], "integrator": "semi-implicit-euler"})"), false), "") << "near by their centres of mass, not by where their axes have their origin";
}

TEST(CheckRounding, OfThreeInARowOneRespondsTwice) {
  const Recording right = run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 1, "query": "cast", "bodies": [
    {"shape": {"type": "interval", "min": -0.205533671136525, "max": -0.205533671136525}, "pose": {"position": [1.1813747965449028]}, "velocity": [-2.8911526628670763]},
    {"shape": {"type": "interval", "min": -0.7915553260441468, "max": -0.4915553260441468}, "pose": {"position": [0.32487338364431917]}, "velocity": [-0.6805404906057729]},
    {"shape": {"type": "interval", "min": -0.8313191838474381, "max": -0.3313191838474381}, "pose": {"position": [-0.7631399888289438]}, "velocity": [0.4105879710125319]}], "method": {}, "response": "slide"})");
  EXPECT_EQ(said_of(right), "");
  // What nothing responds to is told still.
  std::size_t last = 0;
  for (std::size_t i = 0; i < right.events.size(); ++i)
    if (std::holds_alternative<recorded::ImpulseApplied>(right.events[i])) last = i;
  EXPECT_EQ(told_first(right, last, [](Event& e) { auto& impulse = std::get<recorded::ImpulseApplied>(e); impulse.velocities_after = impulse.velocities_before, impulse.impulse.setZero(); }), "0 wrong-state");
}

TEST(CheckRounding, ContactsThatAreOnePointFarOutInTheWorld) {
  const Recording recording = run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "contact", "bodies": [
    {"shape": {"type": "box", "half_extents": [6.6e-34, 2.2e-34, 3.3e-34]}, "pose": {"position": [-6107.295253598274, 157664.34911055432, -18008346.699071646]}},
    {"shape": {"type": "capsule", "radius": 2.7e-34, "half_height": 2.6e-34, "axis": "x"}, "pose": {"position": [-6107.295253598274, 157664.34911055432, -18008346.699071646]}}]})");
  ASSERT_GT(recording.result.contacts->size(), 1U);
  EXPECT_EQ(said_of(recording), "");
}

TEST(CheckRounding, DirectionsOfYesOrNoAreNumbersHoweverLongTheBodies) {
  const Recording recording = run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "intersect", "bodies": [
    {"shape": {"type": "ellipse", "radii": [4.4865194552903456e+17, 1.0746154383928972e+18]}, "pose": {"position": [1.7122788410008212e+22, -5.957293919457172e+19], "rotation": {"angle": 225.24011040059375}}},
    {"shape": {"type": "box", "half_extents": [5.047246572745221e+17, 2.686538595982243e+17]}, "pose": {"position": [1.712211710198478e+22, -6.0249897453588865e+19], "rotation": {"angle": 225.24011040059375}}}], "method": {"name": "gjk-boolean"}})");
  EXPECT_EQ(said_of(recording), "");
}

TEST(CheckRounding, ContactsOfANormalInSinglePrecision) {
  const Recording recording = run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "contact", "bodies": [
    {"shape": {"type": "box", "half_extents": [0.4, 0.99884752656089, 0.0008]}, "pose": {"position": [0, 0, 0], "rotation": {"axis": [0, 0, 1], "angle": 45}}},
    {"shape": {"type": "box", "half_extents": [1323.0, 1.2046506680950346, 1400.0]}, "pose": {"position": [1.4394596753214741, 0.0, 0.0]}}], "method": {"name": "gjk", "scalar": "float", "stopping": "bounds"}})");
  EXPECT_EQ(said_of(recording), "") << "an edge on a wall: the contact is at the edge, not at the wall's rim";
}

TEST(CheckRounding, TheDeepestPointIsAContact) {
  // The face that looks down best is a little higher than the ridge.
  const Recording recording = run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "contact", "bodies": [
    {"shape": {"type": "box", "half_extents": [10, 1, 10]}, "pose": {"position": [0, -2, 0]}},
    {"shape": {"type": "hull", "points": [[-1, -1, 0], [1, -1.02, 0], [-3, -0.8, 1], [-3, -0.8, -1], [1, 0, 1.2], [1, 0, -1.2], [-3, 1, 0]]}}]})");
  EXPECT_EQ(said_of(recording), "");
  double deepest = 0;
  for (const ContactPoint& p : *recording.result.contacts) deepest = std::max(deepest, p.depth);
  EXPECT_NEAR(deepest, 0.02, 1e-12);
}

// --- What is wrong ----------------------------------------------------------------------------------------------------

/// A ball that bounces, so small that its energies are below the rests that others are let off by.
TEST(CheckRounding, SimulationsOfSmallBodies) {
  const Recording right = run_of(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "simulate", "time_step": 0.01, "steps": 20, "gravity": [0, -1e-6], "bodies": [
    {"shape": {"type": "box", "half_extents": [5e-7, 1e-7]}, "pose": {"position": [0, -1e-7]}, "static": true},
    {"shape": {"type": "circle", "radius": 1e-7}, "pose": {"position": [0, 1.2e-7]}, "velocity": [0, -4e-7], "restitution": 1}]})");
  ASSERT_EQ(said_of(right), "");
  const std::size_t state = first_of<recorded::State>(right, first_of<recorded::State>(right) + 1);
  EXPECT_EQ(told_first(right, state, [](Event& e) { std::get<recorded::State>(e).energy *= 0.5; }), "0 wrong-state");
  EXPECT_EQ(told_first(right, state, [](Event& e) { std::get<recorded::State>(e).momentum *= 0.5; }), "0 wrong-state");
  EXPECT_EQ(told_first(right, state, [](Event& e) { std::get<recorded::State>(e).bodies[1].velocity *= 1.001; }), "0 wrong-state");
  Recording wrong = right;
  *wrong.result.energy *= 0.5;
  EXPECT_NE(said_of(wrong).find("wrong-state: The result's energy"), std::string::npos) << said_of(wrong);
}

TEST(CheckRounding, AWrongSupportOfAMotionIsToldWhereItIs) {
  const Recording right = record(read_scene(read_gallery(GJKDBG_GALLERY).file("sim-newtons-cradle")));
  const std::size_t began = first_of<recorded::GjkBegan>(right), first = first_of<recorded::SupportQueried>(right, began), second = first_of<recorded::SupportQueried>(right, first + 1);
  const std::string told = told_first(right, second, [](Event& e) { auto& q = std::get<recorded::SupportQueried>(e); q.a[0] -= 0.25, q.w = q.a - q.b; });
  EXPECT_EQ(told, "0 wrong-support");
}

TEST(CheckRounding, HowManyAxesThereAre) {
  const auto by_sat = [](const char* a, const char* b) {
    return run_of((std::string(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "bodies": [{"shape": )") + a + "}, {\"shape\": " + b + R"(, "pose": {"position": [0.9, 0.1, 0.2]}}], "method": {"name": "sat"}})").c_str());
  };
  const char *box = R"({"type": "box", "half_extents": [0.5, 0.5, 0.5]})", *hull = R"({"type": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]})";
  for (const char* other : {box, hull}) {
    const Recording right = by_sat(box, other);
    ASSERT_EQ(said_of(right), "");
    const std::size_t began = first_of<recorded::SatBegan>(right);
    EXPECT_EQ(told_first(right, began, [](Event& e) { std::get<recorded::SatBegan>(e).edge_pairs += 1; }), "0 inconsistent");
    EXPECT_EQ(told_first(right, began, [](Event& e) { std::get<recorded::SatBegan>(e).faces_b += 1; }), "0 inconsistent");
  }
}

TEST(CheckRounding, ASumOfBoxesIsABox) {
  const std::string sum = R"({"type": "sum", "of": [{"type": "box", "half_extents": [1, 1]}, {"type": "box", "half_extents": [0.5, 0.25]}]})";
  EXPECT_EQ(said_of(run_of((R"({"format": "gjk-scene", "version": 1, "dimension": 2, "bodies": [{"shape": )" + sum + "}, {\"shape\": " + sum + R"(, "pose": {"position": [2, 0.5]}}], "method": {"name": "sat"}})").c_str())), "");
}

TEST(CheckRounding, BodiesThatTurnComeNearerThanTheBoundLets) {
  const Recording right = record(read_scene(read_gallery(GJKDBG_GALLERY).file("cast-rotating-rod")));
  ASSERT_EQ(said_of(right), "");
  const std::size_t step = first_of<recorded::CastAdvanced>(right);
  EXPECT_EQ(told_first(right, step, [](Event& e) { std::get<recorded::CastAdvanced>(e).bound *= 0.5; }), "0 wrong-bounds");
}

// --- What a scene expects of another program --------------------------------------------------------------------------

TEST(CheckRounding, WhatASolverMisses) {
  const SceneFile scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "penetration", "bodies": [{"shape": {"type": "box", "half_extents": [1, 1]}},
    {"shape": {"type": "box", "half_extents": [1, 1]}, "pose": {"position": [3, 0]}}], "expect": {"intersecting": false, "signed_distance": 2, "normal": [0, 1]}})", {});
  Recording run = record(scene);
  run.generator = "a solver under gjkdbg 0.1.0";
  EXPECT_EQ(missed_by_solver(scene, run).size(), 2U) << "the distance is 1, the normal (1, 0)";
  run.result.normal.reset(), run.result.signed_distance.reset();
  EXPECT_TRUE(missed_by_solver(scene, run).empty()) << "what a solver does not answer it does not miss";
  run.result.intersecting = true;
  EXPECT_EQ(missed_by_solver(scene, run).size(), 1U);
  run.result.status = "aborted";
  EXPECT_TRUE(missed_by_solver(scene, run).empty()) << "told as a finding";
}

}  // namespace
}  // namespace gjkdbg
