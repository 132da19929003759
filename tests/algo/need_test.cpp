// No more than is asked: counters of what a query runs, and that a prepared query allocates nothing.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Warray-bounds"  // GCC holds that any bit of a simplex's places may be set
#endif
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <new>
#include <optional>

#include "algo/prepared_pair.h"
#include "algo/solve.h"
#include "algo/solve_pair.h"
#include "recordings/gallery.h"
#include "recordings/recording.h"
#include "shapes/error.h"
#include "tests/support/random_scenes.h"

namespace {
std::atomic<long> allocations{0};
}  // namespace

#if defined(__SANITIZE_ADDRESS__)
#define GJKDBG_SANITIZED  // has operators of its own
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GJKDBG_SANITIZED
#endif
#endif

#ifndef GJKDBG_SANITIZED
// Counted, for the whole of this program. GCC cannot see that malloc and free belong together here.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif
void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
#endif

namespace gjkdbg {
namespace {

struct Counts {
  int supports = 0, epa = 0, gjk = 0;
  bool distance = false, normal = false, witnesses = false, contacts = false;
};

Counts counts_of(Scene scene, Query query) {
  scene.query = query;
  SceneFile file;
  file.scene = scene;
  const Recording r = record(file);
  Counts c;
  for (const Event& event : r.events) {
    if (const auto* e = std::get_if<recorded::SupportQueried>(&event)) {
      ++c.supports;
      EXPECT_EQ(e->w.size(), scene.dimension);
    }
    c.gjk += std::holds_alternative<recorded::GjkBegan>(event);
    c.epa += std::holds_alternative<recorded::PolytopeSeeded>(event) || std::holds_alternative<recorded::EpaEnded>(event);
  }
  EXPECT_EQ(c.supports, r.result.support_calls);
  c.distance = r.result.signed_distance.has_value(), c.normal = r.result.normal.has_value();
  c.witnesses = r.result.witness_a.has_value(), c.contacts = r.result.contacts.has_value();
  return c;
}

TEST(Need, AQueryComputesWhatItIsAskedAndNoMore) {
  RandomScenes random(31);
  for (int k = 0; k < 600; ++k) {
    const Scene scene = random.scene(1 + k % 3, static_cast<Family>(k / 3 % family_count), k % 2 == 0);
    const Counts yes_no = counts_of(scene, Query::intersect), distance = counts_of(scene, Query::distance), depth = counts_of(scene, Query::penetration);
    EXPECT_EQ(yes_no.epa + distance.epa, 0);
    EXPECT_FALSE(yes_no.distance || yes_no.normal || yes_no.witnesses);
    EXPECT_TRUE(distance.distance && distance.witnesses);
    EXPECT_TRUE(depth.distance && depth.normal && depth.witnesses);
    EXPECT_FALSE(depth.contacts);
    EXPECT_LE(yes_no.supports, distance.supports);
    EXPECT_LE(distance.supports, depth.supports);
  }
}

/// Of a method that takes such bodies.
std::optional<int> supports_by(MethodName name, Scene scene, Query query) {
  scene.query = query;
  Method method;
  method.name = name;
  try {
    return solve(scene, resolve_settings(method, scene)).support_calls;
  } catch (const Error&) {
    return {};
  }
}

/// Whatever the method: who asks for less waits no longer. But a point common to both, which only a distance query has, SAT does not come by: that is a short GJK more.
TEST(Need, NoMethodTakesMoreForLess) {
  RandomScenes random(33);
  std::array<int, method_names.size()> counted{};
  for (int k = 0; k < pairs_asked(600); ++k) {
    const Scene scene = random.scene(1 + k % 3, static_cast<Family>(k / 3 % family_count), k % 2 == 0);
    const bool apart = !solve(scene, resolve_settings({}, scene)).intersecting;
    for (const MethodName name : {MethodName::gjk, MethodName::gjk_accelerated, MethodName::mpr, MethodName::sat, MethodName::projections, MethodName::fastest}) {
      const auto yes_no = supports_by(name, scene, Query::intersect), distance = supports_by(name, scene, Query::distance), depth = supports_by(name, scene, Query::penetration);
      if (!depth) continue;
      ++counted[static_cast<std::size_t>(name)];
      const int in_vain = name == MethodName::projections || name == MethodName::fastest ? 1 : 0;  // a plane that could have told, and did not
      EXPECT_LE(*yes_no, *distance + in_vain) << "scene " << k << " by " << word_of(name);
      const int common_point = apart ? 0 : *supports_by(MethodName::gjk, scene, Query::distance);
      EXPECT_LE(*distance, *depth + (name == MethodName::sat || name == MethodName::fastest ? common_point : 0)) << "scene " << k << " by " << word_of(name);
    }
  }
  for (const MethodName name : {MethodName::gjk, MethodName::mpr, MethodName::sat, MethodName::fastest}) EXPECT_GE(counted[static_cast<std::size_t>(name)], pairs_asked(100)) << word_of(name);
}

/// A hull whose support mapping counts its dot products: one a vertex.
struct CountedHull : Convex<3, double> {
  using Convex<3, double>::Convex;
  Eigen::Vector3d support(const Eigen::Vector3d& d) const {
    ++calls, dots += vertices();
    return Convex<3, double>::support(d);
  }
  mutable long calls = 0, dots = 0;
};

Shape hull_of(RandomScenes& random, int points) {
  PointSet set{PointSetKind::hull, {}, ""};
  for (int i = 0; i < points; ++i) set.points.push_back(AnyVector(Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))));
  return {set, 0};
}

/// What is counted is all there is: no support but those the result tells of, no vertex looked at twice for one, and fewer dot products for less.
TEST(Need, DotProductsAreThoseOfTheSupports) {
  RandomScenes random(34);
  for (int k = 0; k < 300; ++k) {
    const int size_a = 4 + k % 13, size_b = 4 + k % 7;
    Scene scene;
    scene.dimension = 3;
    scene.bodies = {{"", hull_of(random, size_a), identity_pose(3)}, {"", hull_of(random, size_b), identity_pose(3)}};
    for (int i = 0; i < 3; ++i) scene.bodies[1].pose.position[i] = random.uniform(-1, 1);
    const CountedHull a(scene.bodies[0].shape), b(scene.bodies[1].shape);
    const PlacedAxes<3> at_a(scene.bodies[0].pose), at_b(scene.bodies[1].pose);
    for (const MethodName name : {MethodName::gjk, MethodName::gjk_accelerated, MethodName::mpr, MethodName::gjk_boolean}) {
      long before = 0;
      for (const Query query : {Query::intersect, Query::distance, Query::penetration}) {
        if (name == MethodName::gjk_boolean && query != Query::intersect) continue;
        scene.query = query;
        Method method;
        method.name = name;
        const Settings settings = resolve_settings(method, scene);
        a.calls = b.calls = a.dots = b.dots = 0;
        NoTrace trace;
        const Result r = PairSolver<3, double, NoTrace, CountedHull>(a, b, at_a, at_b, 1, settings, trace).run(query);
        EXPECT_EQ(a.calls, r.support_calls) << k << " " << word_of(name) << " " << word_of(query);
        EXPECT_EQ(b.calls, r.support_calls) << k << " " << word_of(name) << " " << word_of(query);
        EXPECT_EQ(a.dots + b.dots, r.support_calls * (a.vertices() + b.vertices()));
        EXPECT_LE(before, a.dots + b.dots) << k << " " << word_of(name) << " " << word_of(query);
        before = a.dots + b.dots;
      }
    }
  }
}

TEST(Need, RoundCoresNeedNoPolytope) {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  for (const char* name : {"2d-circles-overlap", "pair-sphere-sphere"}) {
    const Counts c = counts_of(read_scene(gallery.file(name)).scene, Query::penetration);
    EXPECT_EQ(c.epa, 0) << name;
    EXPECT_LE(c.supports, 3) << name;
  }
}

/// Shapes prepared once, the workspace kept: the query itself.
long allocations_of(const Scene& scene, const Settings& settings, Query query) {
  const auto pair = prepare(scene.bodies[0], scene.bodies[1], scene.dimension, settings.scalar);
  const auto run = [&] { return pair->run(settings, query); };
  for (int i = 0; i < 3; ++i) (void)run();  // the workspace grows to what this pair needs
  const long before = allocations;
  const Result r = run();
  const long made = allocations - before;
  EXPECT_GE(r.iterations, 0);
  return made;
}

TEST(Need, APreparedQueryAllocatesNothing) {
#ifdef GJKDBG_SANITIZED
  GTEST_SKIP() << "the sanitizer counts for itself";
#endif
  RandomScenes random(32);
  for (int k = 0; k < 900; ++k) {
    const int dimension = 1 + k % 3;
    const Scene scene = random.scene(dimension, static_cast<Family>(k / 3 % 3), k % 2 == 0);
    const Settings settings = resolve_settings({}, scene);
    for (const Query query : {Query::intersect, Query::distance, Query::penetration}) {
      const long made = allocations_of(scene, settings, query);
      EXPECT_EQ(made, 0) << "scene " << k << " " << word_of(query);
      if (testing::Test::HasFailure()) return;
    }
  }
}

/// By every method that takes the bodies, of every kind of scene, in both scalars.
TEST(Need, NoMethodAllocates) {
#ifdef GJKDBG_SANITIZED
  GTEST_SKIP() << "the sanitizer counts for itself";
#endif
  RandomScenes random(33);
  std::array<int, method_names.size()> counted{};
  for (int k = 0; k < 240; ++k) {
    Scene scene = random.scene(1 + k % 3, static_cast<Family>(k / 3 % family_count), k % 2 == 0);
    for (std::size_t m = 0; m < method_names.size(); ++m)
      for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
        Method method;
        method.name = static_cast<MethodName>(m), method.scalar = scalar;
        scene.query = method.name == MethodName::gjk_boolean ? Query::intersect : Query::penetration;
        Settings settings;
        try {
          settings = resolve_settings(method, scene);
        } catch (const Error&) {
          continue;  // no method for these bodies
        }
        ++counted[m];
        ASSERT_EQ(allocations_of(scene, settings, scene.query), 0) << "scene " << k << " by " << word_of(*method.name) << " in " << word_of(scalar);
      }
  }
  for (const MethodName name : {MethodName::gjk, MethodName::gjk_boolean, MethodName::mpr, MethodName::sat, MethodName::projections}) EXPECT_GT(counted[static_cast<std::size_t>(name)], 40) << word_of(name);
}

/// The plane of the first support is a proof like any other.
TEST(Need, YesOrNoIsToldByTheFirstPlaneThatSeparates) {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  for (const char* name : {"box-box-apart", "pair-hull-hull", "accelerated-smoothed", "2d-ellipses-apart"}) {
    Scene scene = read_scene(gallery.file(name)).scene;
    scene.query = Query::penetration;
    const double gap = *solve(scene, resolve_settings({}, scene)).signed_distance;
    scene.bodies[1].pose.position += (scene.bodies[1].pose.position - scene.bodies[0].pose.position).normalized() * (20 + std::abs(gap));  // far beyond all that turns aside
    for (const MethodName method : {MethodName::gjk, MethodName::gjk_accelerated}) {
      Method by;
      by.name = method;
      scene.query = Query::intersect;
      const Result r = solve(scene, resolve_settings(by, scene));
      EXPECT_FALSE(r.intersecting) << name;
      EXPECT_EQ(r.status, "separated") << name;
      EXPECT_EQ(r.support_calls, 1) << name;
    }
    EXPECT_EQ(counts_of(scene, Query::intersect).supports, 1) << name << ": as traced";
  }
}

TEST(Need, TheFastestMethodGoesByTheBodies) {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  Method fastest;
  fastest.name = MethodName::fastest;
  const auto chosen = [&](const char* name, const Method& method) { return resolve_settings(method, read_scene(gallery.file(name)).scene).name; };
  EXPECT_EQ(chosen("cast-rotating-rod", fastest), MethodName::conservative_advancement);
  const std::pair<const char*, MethodName> expected[] = {{"box-box-deep", MethodName::sat}, {"pair-sphere-sphere", MethodName::closed_form}, {"1d-overlap", MethodName::closed_form}, {"pair-sphere-box", MethodName::projections}, {"pair-ellipsoid-ellipsoid", MethodName::gjk_accelerated}, {"pair-cone-ellipsoid", MethodName::projections}, {"sat-polygons-apart", MethodName::sat}, {"2d-deep", MethodName::sat}, {"pair-cone-hull", MethodName::gjk_accelerated}, {"pair-box-hull", MethodName::gjk_accelerated}};
  for (const auto& [name, method] : expected) {
    EXPECT_EQ(chosen(name, fastest), method) << name;
    const Scene scene = read_scene(gallery.file(name)).scene;
    const Settings settings = resolve_settings(fastest, scene);
    const Result r = solve(scene, settings), usual = solve(scene, resolve_settings({}, scene));
    EXPECT_NEAR(*r.signed_distance, *usual.signed_distance, settings.tolerance > 1e-12 ? 1e-9 : 1e-12) << name;
#ifndef GJKDBG_SANITIZED
    EXPECT_EQ(allocations_of(scene, settings, Query::penetration), 0) << name;
#endif
  }
  EXPECT_EQ(resolve_settings(fastest, read_scene(gallery.file("pair-ellipsoid-ellipsoid")).scene).acceleration, Acceleration::newton);
  for (const char* name : {"pair-box-hull", "pair-cone-hull"}) EXPECT_EQ(resolve_settings(fastest, read_scene(gallery.file(name)).scene).acceleration, Acceleration::smoothed) << name;
  fastest.closest_point = ClosestPoint::johnson;
  EXPECT_EQ(chosen("box-box-deep", fastest), MethodName::gjk) << "a setting of GJK's asks for GJK";
}

}  // namespace
}  // namespace gjkdbg
