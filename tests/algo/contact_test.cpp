// Contact points: how many, where, inside both bodies; and what stands or rolls on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "recordings/check.h"
#include "recordings/recording.h"
#include "shapes/convex_hull.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

constexpr double deep = 0.05;

std::string placed(const std::string& shape, const std::string& position, const std::string& rotation = "", const std::string& more = "") {
  return R"({"shape": )" + shape + R"(, "pose": {"position": )" + position + (rotation.empty() ? "" : R"(, "rotation": )" + rotation) + "}" + more + "}";
}

SceneFile scene_of(const std::string& query, const std::string& bodies) {
  return parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, )" + query + R"(, "bodies": [)" + bodies + "]}", {});
}

/// The contact points of two bodies, which `check` finds right, from the second body's side; depths aside.
std::vector<ContactPoint> contacts(const std::string& a, const std::string& b) {
  const Recording recording = record(scene_of(R"("query": "contact")", a + ", " + b));
  for (const Finding& f : check(recording)) ADD_FAILURE() << f.code << ": " << f.message;
  return recording.result.contacts.value_or(std::vector<ContactPoint>());
}

/// On a table whose top is y = 0, by its edges of 1 along x and z.
std::vector<ContactPoint> on_table(const std::string& shape, double x, double y, const std::string& rotation = "") {
  return contacts(placed(R"({"type": "box", "half_extents": [1, 0.5, 1]})", "[0, -0.5, 0]"), placed(shape, "[" + std::to_string(x) + ", " + std::to_string(y) + ", 0]", rotation));
}

const std::string cylinder = R"({"type": "cylinder", "radius": 0.5, "half_height": 0.5})", cone = R"({"type": "cone", "radius": 0.5, "half_height": 0.5})",
                  upside_down = R"({"axis": [0, 0, 1], "angle": 180})", lying = R"({"axis": [0, 0, 1], "angle": 90})";

TEST(Contact, TheEndOfACylinderOrAConeStandsOnItsRim) {
  for (const std::string& shape : {cylinder, cone}) {
    const auto found = on_table(shape, 0, 0.5 - deep);
    ASSERT_EQ(found.size(), 8U);
    Eigen::Vector3d middle(0, 0, 0);
    for (const ContactPoint& c : found) {
      EXPECT_NEAR(std::hypot(c.point_b[0], c.point_b[2]), 0.5, 1e-12);
      EXPECT_NEAR(c.depth, deep, 1e-12);
      middle += c.point_b / 8;
    }
    EXPECT_LE(std::hypot(middle[0], middle[2]), 1e-12);
  }
}

TEST(Contact, TheTablesEdgeCutsTheRim) {
  const auto found = on_table(cylinder, 1.1, 0.5 - deep);  // the rim meets the edge x = 1 at z = +- sqrt(0.5^2 - 0.1^2)
  double farthest = -1;
  int at_edge = 0;
  for (const ContactPoint& c : found) {
    farthest = std::max(farthest, c.point_b[0]);
    if (std::abs(c.point_b[0] - 1) < 1e-12 && std::abs(std::abs(c.point_b[2]) - std::sqrt(0.24)) < 1e-12) ++at_edge;
  }
  EXPECT_LE(farthest, 1 + 1e-12);
  EXPECT_EQ(at_edge, 2);
  EXPECT_GE(found.size(), 5U);
}

TEST(Contact, ABoxOnACylindersEndTouchesWhereTheirOutlinesMeet) {
  // A plank across the end: no corner of it and no more than two of the rim's points above it, yet all four crossings.
  const auto plank = contacts(placed(cylinder, "[0, -0.5, 0]"), placed(R"({"type": "box", "half_extents": [2, 0.1, 0.1]})", "[0, 0.05, 0]"));
  const auto crossing = [](const ContactPoint& c) { return std::abs(std::abs(c.point_b[2]) - 0.1) < 1e-12 && std::abs(std::abs(c.point_b[0]) - std::sqrt(0.24)) < 1e-12; };
  EXPECT_EQ(std::count_if(plank.begin(), plank.end(), crossing), 4);
  // A small box well inside keeps its four corners; so does one on which the cylinder stands, by its outline alone.
  const auto small = contacts(placed(cylinder, "[0, -0.5, 0]"), placed(R"({"type": "box", "half_extents": [0.1, 0.1, 0.1]})", "[0, 0.05, 0]"));
  EXPECT_EQ(small.size(), 4U);
  const auto under = contacts(placed(R"({"type": "box", "half_extents": [0.1, 0.1, 0.1]})", "[0, -0.1, 0]"), placed(cylinder, "[0, 0.45, 0]"));
  EXPECT_EQ(under.size(), 4U);
}

TEST(Contact, TwoEndsShareALens) {
  const auto found = contacts(placed(cylinder, "[0, -0.5, 0]"), placed(cone, "[0.6, 0.45, 0]"));  // circles of 0.5 whose centres are 0.6 apart cross at (0.3, +- 0.4)
  const auto crossing = [](const ContactPoint& c) { return std::abs(c.point_b[0] - 0.3) < 1e-9 && std::abs(std::abs(c.point_b[2]) - 0.4) < 1e-9; };
  EXPECT_EQ(std::count_if(found.begin(), found.end(), crossing), 2);
  EXPECT_GE(found.size(), 4U);
}

TEST(Contact, AnEndWithinALargerOneTouchesWithItsRim) {
  const std::string small = R"({"type": "cylinder", "radius": 0.2, "half_height": 0.5})";
  for (const bool small_first : {true, false}) {
    const auto found = small_first ? contacts(placed(small, "[0.1, -0.5, 0]"), placed(cylinder, "[0, 0.45, 0]")) : contacts(placed(cylinder, "[0, -0.5, 0]"), placed(small, "[0.1, 0.45, 0]"));
    EXPECT_GE(found.size(), 4U);
    for (const ContactPoint& c : found) {
      EXPECT_NEAR(std::hypot(c.point_a[0] - 0.1, c.point_a[2]), 0.2, 1e-9) << "small first: " << small_first;
      EXPECT_NEAR(c.depth, 0.05, 1e-9);
    }
  }
}

TEST(Contact, LyingBodiesTouchAlongALineAndTiltedOnesAtAPoint) {
  const auto line = on_table(cylinder, 0, 0.5 - deep, lying);
  ASSERT_EQ(line.size(), 2U);
  EXPECT_NEAR(std::abs(line[0].point_b[0] - line[1].point_b[0]), 1, 1e-12);
  // A cone on its side, which is sqrt(0.5^2 + 1^2) long.
  const auto side = on_table(cone, 0, 0.2, R"({"axis": [0, 0, 1], "angle": 116.56505117707799})");
  ASSERT_EQ(side.size(), 2U);
  EXPECT_NEAR((side[0].point_b - side[1].point_b).norm(), std::sqrt(1.25), 1e-9);
  EXPECT_EQ(on_table(cylinder, 0, 0.65, R"({"axis": [0, 0, 1], "angle": 30})").size(), 1U);
  EXPECT_EQ(on_table(cone, 0, 0.45, upside_down).size(), 1U);
}

TEST(Contact, LinesAlongOneAnotherShareAPieceAndAcrossAPoint) {
  const std::string capsule = R"({"type": "capsule", "radius": 0.2, "half_height": 0.5})", turned = R"({"axis": [1, 0, 0], "angle": 45})";
  const auto along_x = [](const std::string& shape, const std::string& position) { return placed(shape, position, lying); };
  const auto ends = [](std::vector<ContactPoint> found) {
    std::sort(found.begin(), found.end(), [](const auto& p, const auto& q) { return p.point_a[0] < q.point_a[0]; });
    EXPECT_EQ(found.size(), 2U);
    return found.size() == 2 ? std::pair(found[0].point_a[0], found[1].point_a[0]) : std::pair(0.0, 0.0);
  };
  for (const auto& other : {along_x(capsule, "[0.3, 0.35, 0]"), along_x(R"({"type": "cylinder", "radius": 0.2, "half_height": 0.5})", "[0.3, 0.35, 0]"),
                            placed(R"({"type": "box", "half_extents": [0.5, 0.1, 0.1]})", "[0.3, 0.3, 0]", turned)}) {
    const auto shared = ends(contacts(along_x(capsule, "[0, 0, 0]"), other));  // from -0.2, where the other begins, to 0.5, where the capsule's core ends
    EXPECT_NEAR(shared.first, -0.2, 1e-9) << other;
    EXPECT_NEAR(shared.second, 0.5, 1e-9) << other;
  }
  EXPECT_EQ(contacts(along_x(capsule, "[0, 0, 0]"), along_x(capsule, "[1.3, 0, 0]")).size(), 1U) << "end to end";
  EXPECT_EQ(contacts(along_x(capsule, "[0, 0, 0]"), along_x(capsule, "[1.1, 0.2, 0]")).size(), 1U) << "past one another";
  EXPECT_EQ(contacts(along_x(capsule, "[0, 0, 0]"), placed(capsule, "[0, 0.35, 0]", R"({"axis": [1, 0, 0], "angle": 90})")).size(), 1U) << "across";
}

/// In the plane a capsule that stands on a long one, or leans by ten degrees, has one point below its lower end; none inside it. Lying it has two.
TEST(Contact, ARoundedEdgeTouchesWithItsSurface) {
  const auto flat = [](const std::string& shape, const std::string& position, double angle) { return R"({"shape": )" + shape + R"(, "pose": {"position": )" + position + R"(, "rotation": {"angle": )" + std::to_string(angle) + "}}}"; };
  const std::string ground = flat(R"({"type": "capsule", "radius": 0.5, "half_height": 9, "axis": "x"})", "[0, 0]", 0), short_one = R"({"type": "capsule", "radius": 0.5, "half_height": 0.5})";
  for (const double angle : {0.0, 10.0, 30.0, 89.0, 90.0})
    for (const bool swapped : {false, true}) {
      const std::string leaning = flat(short_one, "[0, 0.3]", angle);
      SceneFile file = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "contact", "bodies": [)" + (swapped ? leaning + ", " + ground : ground + ", " + leaning) + "]}", {});
      const Recording recording = record(file);
      for (const Finding& finding : check(recording)) ADD_FAILURE() << finding.code << ": " << finding.message;
      const auto& found = recording.result.contacts.value();
      if (angle == 0 || angle == 90) {
        EXPECT_EQ(found.size(), angle == 0 ? 1u : 2u);
      }
      const double turn = angle * M_PI / 180;
      for (const ContactPoint& c : found) {  // how far from the core, a segment of half length 0.5 around (0, 0.3)
        const Eigen::Vector2d x = Eigen::Vector2d(swapped ? c.point_a : c.point_b) - Eigen::Vector2d(0, 0.3), axis(-std::sin(turn), std::cos(turn));
        EXPECT_NEAR((x - axis * std::clamp(x.dot(axis), -0.5, 0.5)).norm(), 0.5, 1e-9) << angle << " swapped " << swapped;
      }
    }
}

/// Cylinders, cones and boxes, faces flat on one another or not, with margins: every point lies in both bodies and no deeper than they are (`check`).
TEST(Contact, EveryPointLiesInBothBodies) {
  RandomScenes random(7);
  const std::string shapes[] = {cylinder, cone, R"({"type": "box", "half_extents": [0.4, 0.5, 0.3]})", R"({"type": "capsule", "radius": 0.2, "half_height": 0.5})",
                                R"({"type": "cylinder", "radius": 0.3, "half_height": 0.1, "margin": 0.1})"};
  int several = 0;
  for (int k = 0; k < pairs_asked(1500) && !testing::Test::HasFailure(); ++k) {
    const auto body = [&](const std::string& position) {
      const double angle = k % 3 == 0 ? 90 * random.integer(0, 3) : k % 3 == 1 ? random.uniform(-1e-3, 1e-3) : random.uniform(0, 360);
      const std::string axis = k % 3 == 0 ? random.integer(0, 1) ? "[1, 0, 0]" : "[0, 0, 1]" : "[" + std::to_string(random.uniform(0.1, 1)) + ", 0.3, " + std::to_string(random.uniform(-1, 1)) + "]";
      return placed(shapes[random.integer(0, 4)], position, R"({"axis": )" + axis + R"(, "angle": )" + std::to_string(angle) + "}");
    };
    const std::string to = "[" + std::to_string(random.uniform(-0.6, 0.6)) + ", " + std::to_string(random.uniform(0.3, 0.9)) + ", " + std::to_string(random.uniform(-0.6, 0.6)) + "]";
    const std::string a = body("[0, 0, 0]"), b = body(to);
    SCOPED_TRACE(a + ", " + b);
    several += contacts(a, b).size() > 2;
  }
  EXPECT_GT(several, pairs_asked(1500) / 20);
}

std::vector<FinalState> after(double seconds, const std::string& shape, const std::string& position, const std::string& rotation, const std::string& velocity = "[0, 0, 0]") {
  const std::string rough = R"(, "friction": 0.5, "restitution": 0)";
  const auto scene = scene_of(R"("query": "simulate", "gravity": [0, -9.81, 0], "time_step": 0.01, "steps": )" + std::to_string(std::lround(100 * seconds)),
                              placed(R"({"type": "box", "half_extents": [9, 0.5, 9]})", "[0, -0.5, 0]", "", R"(, "static": true)" + rough) + ", " +
                                  placed(shape, position, rotation, R"(, "velocity": )" + velocity + rough));
  return record(scene).result.bodies.value();
}

/// Of a triangle that stands on a side with a corner within it: turned, rounding has that corner on the hull or not.
TEST(Contact, AnEdgeIsTouchedWholeWithACornerWithinItByRounding) {
  const Scene table = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "contact", "bodies": [
    {"shape": {"type": "box", "half_extents": [5, 0.5]}, "pose": {"position": [0, -0.5]}}, {"shape": {"type": "box", "half_extents": [1, 1]}}]})", {}).scene;
  int within = 0;
  for (int k = 0; k < 60; ++k) {
    Scene scene = table;
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.1 * k).toRotationMatrix();
    PointSet triangle{PointSetKind::hull, {}, {}};
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(-1, 0), Eigen::Vector2d(0.1, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}) triangle.points.push_back(turn * p);
    within += convex_hull(triangle.points, 2).vertices.size() == 4;
    scene.bodies[1].shape.geometry = triangle;
    scene.bodies[1].pose.position = Eigen::Vector2d(0, -0.01), scene.bodies[1].pose.rotation = PlaneAngle{-0.1 * k}, scene.bodies[1].pose.matrix = turn.transpose();
    const auto found = solve(scene, resolve_settings({}, scene)).contacts.value();
    ASSERT_EQ(found.size(), 2u) << k;
    EXPECT_NEAR((found[0].point_b - found[1].point_b).norm(), 2, 1e-9) << k;
  }
  EXPECT_GT(within, 5);
}

/// Pushing one corner lifts another one: what comes to rest rests, without a tremble.
TEST(Contact, WhatStandsStandsStill) {
  for (const std::string& shape : {cylinder, cone, std::string(R"({"type": "box", "half_extents": [0.5, 0.5, 0.5]})")}) {
    const FinalState upright = after(3, shape, "[0, 0.6, 0]", R"({"axis": [0, 1, 0], "angle": 20})")[1];
    EXPECT_LE(std::hypot(upright.position[0], upright.position[2]), 1e-9) << shape;
    const FinalState tilted = after(6, shape, "[0, 0.8, 0]", R"({"axis": [1, 0, 0.3], "angle": 12})")[1];
    for (const FinalState& s : {upright, tilted}) {
      EXPECT_NEAR(s.position[1], 0.5, 2e-3) << shape;
      EXPECT_LE(s.velocity.norm() + AnyVector(Eigen::Map<const Eigen::Vector3d>(s.angular_velocity.data())).norm(), 1e-6) << shape;
    }
  }
}

/// What is slower than a step's fall or two does not bounce, however elastic: a box would go on trembling on its corners.
TEST(Contact, ABouncyBoxComesToRestAtAll) {
  const SceneFile scene = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 2, "query": "simulate", "gravity": [0, -9.81], "time_step": 0.01, "steps": 500, "bodies": [
    {"shape": {"type": "box", "half_extents": [5, 0.5]}, "pose": {"position": [0, -0.5]}, "static": true, "restitution": 0.8},
    {"shape": {"type": "box", "half_extents": [0.5, 0.5]}, "pose": {"position": [0, 0.6]}, "restitution": 0.8}]})", {});
  EXPECT_LE(record(scene).result.bodies.value()[1].velocity.norm(), 1e-9);
}

/// Of an overlap a step takes a share away, however many contact points it has: each of a box's four points would take it again.
TEST(Contact, ManyPointsPutBodiesApartNoFartherThanOne) {
  const auto risen = [](const std::string& shape) {
    const auto scene = scene_of(R"("query": "simulate", "gravity": [0, 0, 0], "time_step": 0.01, "steps": 2)",
                                placed(R"({"type": "box", "half_extents": [5, 0.5, 5]})", "[0, -0.5, 0]", "", R"(, "static": true)") + ", " + placed(shape, "[0, 0.45, 0]"));
    return record(scene).result.bodies.value()[1].position[1] - 0.45;
  };
  const double ball = risen(R"({"type": "sphere", "radius": 0.5})");
  EXPECT_GT(ball, 0.01);
  EXPECT_LT(ball, deep);
  for (const std::string& shape : {cylinder, std::string(R"({"type": "box", "half_extents": [0.5, 0.5, 0.5]})")}) EXPECT_NEAR(risen(shape), ball, 1e-3) << shape;
}

/// Where EPA came to its limit the normal may be another: a bounce along it could gain energy. Such a contact ends the approach and no more.
TEST(Contact, WhatIsNotKnownToTouchThatWayDoesNotBounce) {
  const auto rise = [](int max_iterations) {
    const std::string bouncing = R"(, "restitution": 1)", floor = placed(R"({"type": "box", "half_extents": [5, 0.5, 5]})", "[0, -0.5, 0]", "", R"(, "static": true)" + bouncing);
    const std::string egg = placed(R"({"type": "ellipsoid", "radii": [0.5, 0.5, 0.4]})", "[0.1, 0.3, 0.2]", R"({"axis": [1, 2, 3], "angle": 40})", R"(, "velocity": [0, -1, 0])" + bouncing);
    const Result r = record(scene_of(R"("query": "simulate", "gravity": [0, 0, 0], "time_step": 0.01, "steps": 1, "method": {"max_iterations": )" + std::to_string(max_iterations) + "}", floor + ", " + egg)).result;
    EXPECT_EQ(r.status, max_iterations < 10 ? "contact_unknown" : "completed");
    return (*r.bodies)[1].velocity[1];
  };
  for (const int limit : {4, 6, 8}) EXPECT_NEAR(rise(limit), 0, 0.05) << limit;
  EXPECT_GT(rise(512), 0.9);
}

/// On single points the upper log rocked end over end and drove the lower ones apart.
TEST(Contact, APileOfLogsStaysLevel) {
  const std::string rough = R"(, "friction": 0.6)", along_z = R"({"axis": [1, 0, 0], "angle": 90})";
  for (const std::string shape : {"cylinder", "capsule"}) {
    const auto log = [&](const std::string& position) { return ", " + placed(R"({"type": ")" + shape + R"(", "radius": 0.5, "half_height": 1})", position, along_z, rough); };
    const auto scene = scene_of(R"("query": "simulate", "gravity": [0, -9.81, 0], "time_step": 0.01, "steps": 400)",
                                placed(R"({"type": "box", "half_extents": [5, 0.5, 5]})", "[0, -0.5, 0]", "", R"(, "static": true)" + rough) + log("[-0.5, 0.5, 0]") + log("[0.5, 0.5, 0.1]") +
                                    log("[0, 1.366, 0.3]"));
    const auto end = record(scene).result.bodies.value();
    EXPECT_NEAR(end[2].position[0] - end[1].position[0], 1, 0.01) << shape;
    EXPECT_NEAR(end[3].position[1], 1.366, 0.01) << shape;
    for (int i = 1; i < 4; ++i) {
      const auto& q = end[static_cast<std::size_t>(i)].orientation;
      EXPECT_LE(std::abs((Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Eigen::Vector3d::UnitY()).y()), 1e-3) << shape << " " << i << " is level";
    }
  }
}

/// A cylinder that slides until it rolls keeps two thirds of its speed: angular momentum about the line of contact is kept, m v r = (m r^2 + m r^2 / 2) w.
TEST(Contact, ACylinderThatSlidesComesToRollStraight) {
  const FinalState s = after(2, cylinder, "[0, 0.5, -2]", lying, "[0, 0, 1.5]")[1];
  EXPECT_NEAR(s.velocity[2], 1, 0.01);
  EXPECT_NEAR(s.angular_velocity[0] * M_PI / 180, s.velocity[2] / 0.5, 0.02);
  EXPECT_LE(std::abs(s.velocity[0]) + std::abs(s.position[0]), 1e-6) << "it does not turn aside";
}

/// The edge that two triangles share is one, and what it touches it touches once.
TEST(Contact, AnEdgeOfTwoTrianglesTouchesOnce) {
  const auto ridge = contacts(placed(R"({"type": "mesh", "points": [[-3, 0, 0], [3, 0, 0], [0, -2, 3], [0, -2, -3]], "triangles": [[0, 1, 2], [1, 0, 3]]})", "[0, 0, 0]"),
                              placed(R"({"type": "box", "half_extents": [0.5, 0.6, 0.7]})", "[-0.2, 0.4, 0.1]", R"({"axis": [2, 0, 2], "angle": 45})"));
  EXPECT_EQ(ridge.size(), 1u);
  const Recording moving = record(scene_of(
      R"("query": "simulate", "steps": 3, "gravity": [0, -9.81, 0])",
      placed(R"({"type": "mesh", "points": [[-3, 0.1, 0], [3, -0.15, 0], [0.2, -2, 3], [-0.3, -2, -3]], "triangles": [[0, 1, 2], [1, 0, 3]]})", "[0, 0, 0]", "", R"(, "static": true)") + ", " +
          placed(R"({"type": "box", "half_extents": [0.5, 0.6, 0.7]})", "[0.3, 0.45, 0.02]", R"({"axis": [1, 2, 3], "angle": 77})")));
  std::vector<recorded::ContactFound> found;
  for (const Event& event : moving.events)
    if (const auto* contact = std::get_if<recorded::ContactFound>(&event)) {
      for (const auto& other : found) EXPECT_TRUE(other.time != contact->time || (other.point - contact->point).norm() > 1e-9 || (other.normal - contact->normal).norm() > 1e-6);
      found.push_back(*contact);
    }
  EXPECT_GE(found.size(), 1u);
}

/// Of a ball around a point of one triangle no depth is told, nor a normal that the contacts with others could have.
TEST(Contact, WithoutADepthThereIsNone) {
  SceneFile file = scene_of(R"("query": "contact")", placed(R"({"type": "mesh", "points": [[-3, 0, -3], [3, 0, -3], [0, 0, 3], [-3, 0.5, -3], [3, 0.5, -3], [0, 0.5, 3], [0, 0.5, -9]], "triangles": [[0, 1, 2], [3, 4, 5], [4, 3, 6]]})", "[0, 0, 0]") +
                                                         ", " + placed(R"({"type": "sphere", "radius": 1})", "[0, 0, -2.75]"));
  file.method.penetration = Penetration::none;
  const Result r = record(file).result;
  EXPECT_TRUE(r.intersecting);
  EXPECT_FALSE(r.normal);
  EXPECT_TRUE(r.contacts && r.contacts->empty());
}

/// Edges that lie along one another, by rounding a little across, meet nowhere: what two sides share has its four corners and no more.
TEST(ContactPoints, OfEdgesInOneLineAreTheCorners) {
  PointSet corners{PointSetKind::hull, {}, {}};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) corners.points.push_back(Eigen::Vector3d(x, y, z));
  const Shape box{Box{-Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones()}, 0}, hull{corners, 0};
  for (const Shape& shape : {box, hull})
    for (int degrees = 0; degrees < 90; ++degrees)
      for (const double far : {0.0, 3e4})
        for (const double x : {0.0, 0.3, 0.5, 1.0}) {
          Scene scene;
          scene.query = Query::contact;
          scene.bodies = {{"A", shape, identity_pose(3)}, {"B", shape, identity_pose(3)}};
          const Eigen::Matrix3d turned = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitZ()).toRotationMatrix();
          for (Body& body : scene.bodies) body.pose.matrix = turned, body.pose.position = Eigen::Vector3d(far, -far, 0);
          scene.bodies[1].pose.position += turned * Eigen::Vector3d(x, 0, 1.99);
          for (const MethodName name : {MethodName::gjk, MethodName::sat}) {
            Method method;
            method.name = name;
            const auto found = *solve(scene, resolve_settings(method, scene)).contacts;
            ASSERT_EQ(found.size(), 4u) << degrees << " degrees, " << x << " along, " << far << " out";
            for (const ContactPoint& c : found) {
              const Eigen::Vector3d at = turned.transpose() * (c.point_a - scene.bodies[0].pose.position);
              EXPECT_NEAR(std::abs(at[0] - x / 2), 1 - x / 2, 1e-9);
              EXPECT_NEAR(std::abs(at[1]), 1, 1e-9);
            }
          }
        }
}

/// Its sides would be looked for along a normal that is none of theirs (sim-log-pile with a limit of 2: contacts beside both logs).
TEST(ContactPoints, OfARunThatEndedAtItsLimitAreTheWitnesses) {
  Scene scene;
  scene.query = Query::contact;
  scene.bodies = {{"A", {Cylinder{0.5, 1, 2}, 0}, identity_pose(3)}, {"B", {Cylinder{0.5, 1, 2}, 0}, identity_pose(3)}};
  scene.bodies[1].pose.position = Eigen::Vector3d(0.99, 0, 0.1);
  scene.bodies[1].pose.matrix = Eigen::AngleAxisd(1e-3, Eigen::Vector3d::UnitY()).toRotationMatrix();  // of parallel logs SAT knows the way out
  int limited = 0;
  for (int limit = 1; limit <= 40; ++limit) {
    Method method;
    method.max_iterations = limit;
    const Result r = solve(scene, resolve_settings(method, scene));
    if (!r.contacts || !r.intersecting || r.status != "iteration_limit") continue;
    ASSERT_EQ(r.contacts->size(), 1u) << limit;
    EXPECT_EQ((*r.contacts)[0].point_a, *r.witness_a);
    ++limited;
  }
  EXPECT_GT(limited, 2);
}

/// Of sides of 1e-170 areas are no numbers, and of 1e-200 not even squares of lengths; far from the world's origin that is no matter either.
TEST(ContactPoints, AreThoseOfTheSameSceneInAnyUnit) {
  const Shape box{Box{-Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones()}, 0}, rod{Cylinder{1, 1.5, 1}, 0}, rounded{Capsule{0.5, 2, 1}, 0.25};
  const Shape hull{PointSet{PointSetKind::hull, {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 1, 0), Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(0, 0, 2)}, {}}, 0};
  const Shape sum{Sum{std::make_shared<const Shape>(box), std::make_shared<const Shape>(hull)}, 0};
  const Shape mesh{Mesh{{Eigen::Vector3d(-3, 0, -3), Eigen::Vector3d(3, 0, -3), Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(0, 0, -9)}, {{0, 2, 1}, {0, 1, 3}}, {}}, 0};
  int several = 0;
  for (const Shape& a : {box, rod, rounded, hull, sum, mesh})
    for (const Shape& b : {box, rod, rounded, hull}) {
      const auto contacts = [&](int exponent) {
        const double unit = std::ldexp(1.0, exponent);
        Scene scene;
        scene.query = Query::contact;
        scene.bodies = {{"A", scaled(a, unit), identity_pose(3)}, {"B", scaled(b, unit), identity_pose(3)}};
        scene.bodies[1].pose.position = Eigen::Vector3d(0.25, 0.875, -0.125) * unit;
        std::vector<ContactPoint> found = *solve(scene, resolve_settings({}, scene)).contacts;
        for (ContactPoint& c : found) c = {c.point_a / unit, c.point_b / unit, c.depth / unit};
        return found;
      };
      const auto right = contacts(0);
      several += right.size() > 2;
      for (const int exponent : {-999, -665, -333, -130, 130}) {
        const auto found = contacts(exponent);
        ASSERT_EQ(found.size(), right.size()) << exponent << ", shapes " << a.geometry.index() << " and " << b.geometry.index();
        for (std::size_t i = 0; i < found.size(); ++i) {
          EXPECT_LE((found[i].point_a - right[i].point_a).norm(), 1e-9) << exponent;
          EXPECT_LE((found[i].point_b - right[i].point_b).norm(), 1e-9) << exponent;
          EXPECT_NEAR(found[i].depth, right[i].depth, 1e-9) << exponent;
        }
      }
    }
  EXPECT_GT(several, 5);
}

}  // namespace
}  // namespace gjkdbg
