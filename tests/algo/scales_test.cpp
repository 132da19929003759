// Scenes of tiny bodies, of bodies far from where they are measured from, and of many parts: answers are the same as at home, or say what they do not know.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/motion.h"
#include "recordings/recording.h"
#include "recordings/scene_file.h"
#include "shapes/mass.h"

namespace gjkdbg {
namespace {

Scene scene_with(const std::string& rest) { return parse_scene(R"({"format": "gjk-scene", "version": 1, )" + rest + "}", {}).scene; }

Result answered(const Scene& scene, const Method& method = {}) { return solve(scene, resolve_settings(method, scene)); }

Method named(MethodName name) {
  Method m;
  m.name = name;
  return m;
}

/// The scale that tiny bodies are solved at makes infinities of places far out.
TEST(Scales, TinyBodiesInOnePlaceFarOut) {
  for (const char* shape : {R"("sphere", "radius": 1e-300)", R"("box", "half_extents": [1e-300, 1e-300, 1e-300])"}) {
    const std::string body = std::string(R"({"shape": {"type": )") + shape + R"(}, "pose": {"position": [1e10, -3, 0]}})";
    const Scene scene = scene_with(R"("dimension": 3, "query": "penetration", "bodies": [)" + body + ", " + body + "]");
    const bool ball = std::holds_alternative<Sphere>(scene.bodies[0].shape.geometry);
    for (const MethodName name : {MethodName::gjk, MethodName::gjk_accelerated, MethodName::mpr, MethodName::projections, ball ? MethodName::closed_form : MethodName::sat}) {
      const Result plain = answered(scene, named(name)), traced = record(SceneFile{scene, named(name), {}, {}, {}, {}}).result;
      for (const Result& r : {plain, traced}) {
        ASSERT_TRUE(r.signed_distance && r.normal && r.witness_a) << word_of(name);
        EXPECT_NEAR(*r.signed_distance * 1e300, -2, 1e-9) << word_of(name);
        EXPECT_NEAR(r.normal->norm(), 1, 1e-12) << word_of(name);
        EXPECT_EQ((*r.witness_a)[0], 1e10) << word_of(name);
        EXPECT_LE(*r.lower_bound, *r.signed_distance) << word_of(name);
        EXPECT_LE(*r.signed_distance, *r.upper_bound) << word_of(name);
      }
    }
  }
}

/// The floor is of the bodies' size, which is a root of squares.
TEST(Scales, TheRoundingFloorOfTinyBodies) {
  Scene scene = scene_with(R"("dimension": 3, "query": "penetration", "bodies": [
    {"shape": {"type": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}},
    {"shape": {"type": "box", "half_extents": [0.5, 0.4, 0.3]}, "pose": {"position": [2, 0.3, 0.1]}}])");
  const Result r = answered(scene);
  const double floor = rounding_floor(scene, resolve_settings({}, scene)), reach = reach_of(scene.bodies[1].shape, 3);
  const double s = std::ldexp(1.0, -700);
  for (AnyVector& p : std::get<PointSet>(scene.bodies[0].shape.geometry).points) p *= s;
  Box& box = std::get<Box>(scene.bodies[1].shape.geometry);
  box.min *= s, box.max *= s, scene.bodies[1].pose.position *= s;
  const Result tiny = answered(scene);
  EXPECT_EQ(*tiny.signed_distance / s, *r.signed_distance);
  EXPECT_EQ(*tiny.lower_bound / s, *r.lower_bound);
  EXPECT_EQ(*tiny.upper_bound / s, *r.upper_bound);
  EXPECT_EQ(rounding_floor(scene, resolve_settings({}, scene)) / s, floor);
  EXPECT_EQ(reach_of(scene.bodies[1].shape, 3) / s, reach);
}

/// What slides on a rough floor slides as far, at every scale.
TEST(Scales, FrictionOfTinyBodies) {
  Scene scene = scene_with(R"("dimension": 3, "query": "simulate", "gravity": [0, -8, 0], "time_step": 0.015625, "steps": 32, "bodies": [
    {"static": true, "friction": 0.5, "shape": {"type": "box", "half_extents": [4, 1, 4]}, "pose": {"position": [0, -1, 0]}},
    {"velocity": [1, 0, 0], "friction": 0.5, "shape": {"type": "box", "half_extents": [0.5, 0.5, 0.5]}, "pose": {"position": [0, 0.5, 0]}}])");
  const double way = (*answered(scene).bodies)[1].position[0];
  EXPECT_LT(way, 0.2);
  const double s = std::ldexp(1.0, -60);
  for (Body& body : scene.bodies) {
    Box& box = std::get<Box>(body.shape.geometry);
    box.min *= s, box.max *= s, body.pose.position *= s, body.motion->velocity *= s;
  }
  scene.motion->gravity *= s;
  EXPECT_NEAR((*answered(scene).bodies)[1].position[0] / s, way, 1e-6);
}

/// A cube's inertia is the same wherever its body's origin lies, and at every scale.
TEST(Scales, TheInertiaOfAHullFarFromItsOrigin) {
  for (const auto& [far, size] : {std::pair{1e8, 1.0}, {1e12, 1.0}, {0.0, 1e-80}}) {
    PointSet cube;
    for (int bits = 0; bits < 8; ++bits) {
      AnyVector p(3);
      for (int i = 0; i < 3; ++i) p[i] = (i == 1 ? -far : far) + ((bits >> i & 1) != 0 ? size : -size);
      cube.points.push_back(p);
    }
    const MassProperties m = mass_properties({cube, 0}, 3);
    EXPECT_LE((m.inertia / (size * size) - Matrix<3, double>::Identity() * (2.0 / 3)).cwiseAbs().maxCoeff(), 1e-14) << far << " " << size;
    EXPECT_LE((m.center - Vector<3, double>(far, -far, far)).cwiseAbs().maxCoeff(), 1e-15 * (far + size)) << far << " " << size;
  }
}

/// How deep bodies that rest may stay in one another is a share of their own size, not of how far from their origins they lie.
TEST(Scales, WhatRestsIsPutApartWhereverItsOriginLies) {
  for (const int far : {0, 1000}) {
    const auto hull = [&](const Vector<3, double>& half) {
      PointSet set;
      for (int bits = 0; bits < 8; ++bits) {
        AnyVector p(3);
        for (int i = 0; i < 3; ++i) p[i] = ((bits >> i & 1) != 0 ? half[i] : -half[i]) + (i == 0 ? far : 0);
        set.points.push_back(p);
      }
      return Shape{set, 0};
    };
    Scene scene = scene_with(R"("dimension": 3, "query": "simulate", "gravity": [0, -8, 0], "time_step": 0.015625, "steps": 60, "bodies": [
      {"static": true, "shape": {"type": "sphere", "radius": 1}}, {"shape": {"type": "sphere", "radius": 1}}])");
    scene.bodies[0].shape = hull({4, 0.5, 4}), scene.bodies[1].shape = hull({0.5, 0.5, 0.5});
    scene.bodies[0].pose.position[0] = scene.bodies[1].pose.position[0] = -far;
    scene.bodies[0].pose.position[1] = -0.5, scene.bodies[1].pose.position[1] = 0.4;
    EXPECT_NEAR((*answered(scene).bodies)[1].position[1], 0.5, 1e-3) << far;
  }
}

/// A search that ends at its limit before one of the triangles is told apart has not told the mesh apart.
TEST(Scales, AMeshIsNotToldApartWhileATriangleIsOpen) {
  for (const char* triangles : {"[[0, 1, 2], [3, 4, 5]]", "[[3, 4, 5], [0, 1, 2]]"}) {
    Scene scene = scene_with(R"("dimension": 3, "query": "intersect", "bodies": [
      {"shape": {"type": "box", "half_extents": [0.3, 0.2, 0.25]}, "pose": {"position": [0, 0.1, 0]}},
      {"shape": {"type": "mesh", "points": [[50, 0, 0], [51, 0, 0], [50, 1, 0], [-1, 0, -1], [3, 0, -1.5], [-1, 0.02, 1.7]], "triangles": )" + std::string(triangles) + "}}]");
    for (const Query query : {Query::intersect, Query::distance, Query::penetration}) {
      scene.query = query;
      EXPECT_TRUE(answered(scene).intersecting);
      for (int most = 1; most < 6; ++most) {
        Method method;
        method.max_iterations = most;
        const Result r = answered(scene, method);
        EXPECT_TRUE(unanswered(r) || r.intersecting) << triangles << ", " << word_of(query) << ", " << most << " iterations: " << r.status;
      }
    }
  }
}

/// Below 1e-154 squares vanish: speeds that were lost made the tenth digit of the time another, and the support of an ellipsoid its middle, so that bodies missed each other.
TEST(Scales, ACastTakesTheSameTimeAtEverySize) {
  const Scene scene = scene_with(R"("dimension": 3, "query": "cast", "bodies": [
    {"shape": {"type": "sum", "of": [{"type": "ellipsoid", "radii": [0.5, 0.25, 1]}, {"type": "box", "half_extents": [0.1, 0.25, 0.15]}]},
     "velocity": [2, -0.3, 0.1], "angular_velocity": [40, 110, -70]},
    {"shape": {"type": "ellipsoid", "radii": [0.6, 0.2, 0.4]}, "pose": {"position": [2.5, 0.1, -0.1]}, "velocity": [-0.6, 0.1, 0], "angular_velocity": [-80, 50, 20]}])");
  for (const MethodName name : {MethodName::conservative_advancement, MethodName::root_finding}) {
    const Result r = answered(scene, named(name));
    EXPECT_TRUE(r.intersecting);
    for (const int exponent : {-500, -530, -700, -900}) {
      Scene tiny = scene;
      for (Body& body : tiny.bodies) {
        body.shape = scaled(body.shape, std::ldexp(1.0, exponent));
        body.pose.position *= std::ldexp(1.0, exponent), body.motion->velocity *= std::ldexp(1.0, exponent);
      }
      EXPECT_EQ(answered(tiny, named(name)).time, r.time) << word_of(name) << " " << exponent;
    }
  }
}

}  // namespace
}  // namespace gjkdbg
