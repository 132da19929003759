// Times of impact against closed forms and bisection, conservation laws, inertia against numeric integration, the same bits twice.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "algo/motion.h"
#include "recordings/gallery.h"
#include "recordings/recording.h"
#include "shapes/mass.h"
#include "shapes/world_support.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

using V3 = Vector<3, double>;

AnyVector at(std::initializer_list<double> x) {
  AnyVector v(static_cast<Eigen::Index>(x.size()));
  std::copy(x.begin(), x.end(), v.begin());
  return v;
}

Body resting(const Shape& shape, const AnyVector& position) {
  const int d = static_cast<int>(position.size());
  Body b{"", shape, identity_pose(d), Motion{}};
  b.pose.position = position;
  b.motion->velocity = AnyVector::Zero(d);
  b.motion->angular_velocity = AnyVector::Zero(d == 1 ? 0 : d == 2 ? 1 : 3);
  return b;
}

Scene cast_of(std::vector<Body> bodies, int dimension) {
  Scene s;
  s.dimension = dimension;
  s.query = Query::cast;
  s.bodies = std::move(bodies);
  s.motion = SceneMotion{};
  s.motion->gravity = AnyVector::Zero(dimension);
  return s;
}

Result run(const Scene& scene, MethodName name) {
  Method method;
  method.name = name;
  return solve(scene, resolve_settings(method, scene));
}

double gap(const Scene& scene, double time) {
  Scene two = scene;
  two.query = Query::penetration;
  for (Body& b : two.bodies) b = moved(b, time, scene.dimension), b.motion.reset();
  return *solve(two, resolve_settings({}, two)).signed_distance;
}

/// Two balls: |p + v t| = r, the smaller root.
TEST(Cast, BallsMeetWhenTheQuadraticSays) {
  RandomScenes random(41);
  int hits = 0;
  for (int k = 0; k < pairs_asked(3000); ++k) {
    const int d = 2 + k % 2;
    AnyVector p(d), v(d);
    for (int i = 0; i < d; ++i) p[i] = random.uniform(-3, 3), v[i] = random.uniform(-8, 8);
    const double ra = random.uniform(0.1, 0.6), rb = random.uniform(0.1, 0.6), r = ra + rb;
    if (p.norm() <= r * 1.01) continue;
    Scene scene = cast_of({resting({Sphere{ra}, 0}, AnyVector::Zero(d)), resting({Sphere{rb}, 0}, p)}, d);
    scene.bodies[1].motion->velocity = v;
    const double a = v.squaredNorm(), b = p.dot(v), c = p.squaredNorm() - r * r, root = b * b - a * c;
    if (std::abs(root) < 1e-6) continue;  // grazing: the gallery has it
    const double time = root < 0 ? 2 : (-b - std::sqrt(root)) / a;
    const bool hit = time >= 0 && time <= 1;
    if (std::abs(time - 1) < 1e-6) continue;
    for (const MethodName name : {MethodName::conservative_advancement, MethodName::ray_cast, MethodName::root_finding}) {
      const Result found = run(scene, name);
      EXPECT_EQ(found.intersecting, hit) << k << " " << word_of(name) << " " << time << " " << found.status;
      if (!hit || !found.intersecting) continue;
      ++hits;
      EXPECT_LE(*found.time, time + 1e-13) << "late";
      EXPECT_GE(*found.time, time - 1e-5) << k << " " << word_of(name);
      ASSERT_TRUE(found.touching_at);
      EXPECT_GE(*found.touching_at, time - 1e-13);
      EXPECT_GT((scene.bodies[0].motion->velocity - v).dot(*found.normal), 0);
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(hits, pairs_asked(3000) / 8);
}

/// Random shapes: nothing overlaps before the time of impact, and at the time it names the pair is within the tolerance.
TEST(Cast, NothingTunnels) {
  RandomScenes random(42);
  int hits = 0;
  for (int k = 0; k < pairs_asked(10000); ++k) {
    const int d = 2 + k % 2;
    const bool turning = k % 5 == 0;
    Scene scene = random.scene(d, Family::general, k % 3 != 0);
    scene.query = Query::cast;
    scene.motion = SceneMotion{};
    scene.motion->gravity = AnyVector::Zero(d);
    double size = 0;
    for (Body& b : scene.bodies) {
      b.motion = resting(b.shape, b.pose.position).motion;
      for (double& x : b.motion->velocity) x = random.uniform(-6, 6);
      if (turning)
        for (double& x : b.motion->angular_velocity) x = random.uniform(-3, 3);
      size = std::max(size, reach_of(b.shape, d));
    }
    const MethodName name = turning ? (k % 2 == 0 ? MethodName::conservative_advancement : MethodName::root_finding)
                                    : std::array{MethodName::conservative_advancement, MethodName::ray_cast, MethodName::root_finding}[static_cast<std::size_t>(k % 3)];
    const Result found = run(scene, name);
    if (found.status == "initially_overlapping") {
      EXPECT_LE(gap(scene, 0), 1e-8 * size);
      continue;
    }
    const double until = found.status == "miss" ? 1 : *found.time;
    for (int i = 0; i <= 6; ++i) EXPECT_GE(gap(scene, until * i / 6), -1e-10 * size) << k << " at " << until * i / 6 << " of " << until << " " << word_of(name);
    if (found.status == "hit") {
      ++hits;
      EXPECT_LE(gap(scene, *found.time), 1e-7 * size) << k << " " << word_of(name);
      if (found.touching_at) {
        EXPECT_LE(gap(scene, *found.touching_at), 1e-12 * size);
      }
    }
    EXPECT_TRUE(found.status == "hit" || found.status == "miss") << found.status << " " << k << " " << word_of(name);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(hits, pairs_asked(10000) / 10);
}

/// Two methods that look at the pair quite differently: neither goes on after the other has seen the bodies touch.
TEST(Cast, TurningBodiesMeetByBothMethods) {
  RandomScenes random(7);
  int hits = 0, steps = 0;
  const int count = pairs_asked(4000);
  for (int k = 0; k < count; ++k) {
    const int d = 2 + k % 2;
    Scene scene = random.scene(d, Family::general, k % 3 != 0);
    scene.query = Query::cast;
    scene.motion = SceneMotion{};
    scene.motion->gravity = AnyVector::Zero(d);
    for (Body& b : scene.bodies) {
      b.motion = resting(b.shape, b.pose.position).motion;
      for (double& x : b.motion->velocity) x = random.uniform(-6, 6);
      for (double& x : b.motion->angular_velocity) x = random.uniform(-10, 10);
    }
    const Result roots = run(scene, MethodName::root_finding), advancing = run(scene, MethodName::conservative_advancement);
    EXPECT_NE(roots.status, "iteration_limit") << k;
    steps += roots.iterations;
    if (advancing.status != "hit" || !advancing.touching_at) continue;
    ++hits;
    EXPECT_EQ(roots.status, "hit") << k;
    if (!roots.time) return;
    EXPECT_LE(*roots.time, *advancing.touching_at) << k;
    if (roots.touching_at) {
      EXPECT_LE(*advancing.time, *roots.touching_at) << k;
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(hits, count / 20);
  EXPECT_LT(steps, 4 * count) << "a normal that turns with the bodies needs 2.7 a pair, one that stays 5.3";
}

/// What a turning body reaches along a normal, against where it is at many times; and the mean speed, against the gap it would close.
TEST(Cast, NoTurningBodyReachesFartherThanItsBound) {
  RandomScenes random(44);
  for (int k = 0; k < pairs_asked(2000); ++k) {
    const int d = 2 + k % 2;
    Scene scene = random.scene(d, Family::general, true);
    Body& body = scene.bodies[0];
    body.motion = resting(body.shape, body.pose.position).motion;
    AnyVector n(d);
    for (double& x : n) x = random.uniform(-1, 1);
    n.normalize();
    for (double& x : body.motion->angular_velocity) x = random.uniform(-4, 4);
    const double reach = reach_of(body.shape, d);
    const TurningBound bound = turning_bound(body, body.motion->angular_velocity, n, reach);
    const auto height = [&](const Body& at) { return n.dot(WorldSupport(at, d)(n, true) - body.pose.position); };
    const double now = height(body), gap = random.uniform(0.01, 1) * reach, closed = gap / bound.until_closed(gap);
    EXPECT_NEAR(bound.speed * closed + bound.change / 2 * closed * closed, gap, 1e-12 * reach);
    for (int i = 1; i <= 8; ++i) {
      const double t = 0.2 * i;
      EXPECT_LE(height(moved(body, t, d)), now + bound.speed * t + bound.change / 2 * t * t + 1e-13 * reach) << k << " at " << t;
    }
    EXPECT_LE(bound.speed, body.motion->angular_velocity.norm() * reach * (1 + 1e-12));
  }
}

/// The first overlap on a fine grid, then bisection.
TEST(Cast, TurningBodiesMeetWhenBisectionSays) {
  RandomScenes random(43);
  int hits = 0;
  for (int k = 0; k < pairs_asked(300); ++k) {
    Scene scene = cast_of({resting({Box{-at({1, 0.1}), at({1, 0.1})}, 0}, at({0, 0})), resting({Box{-at({0.4, 0.4}), at({0.4, 0.4})}, 0}, at({random.uniform(-2, 2), random.uniform(1.2, 2)}))}, 2);
    scene.bodies[0].motion->angular_velocity[0] = random.uniform(-4, 4);
    scene.bodies[1].motion->velocity = at({random.uniform(-1, 1), random.uniform(-2, 0)});
    double low = 0, high = -1;
    for (int i = 1; i <= 400 && high < 0; ++i) {
      if (gap(scene, i / 400.0) <= 0) high = i / 400.0;
      else low = i / 400.0;
    }
    const Result found = run(scene, k % 2 == 0 ? MethodName::conservative_advancement : MethodName::root_finding);
    if (high < 0) continue;  // the grid may have missed a graze
    for (int i = 0; i < 60; ++i) (gap(scene, (low + high) / 2) <= 0 ? high : low) = (low + high) / 2;
    ASSERT_TRUE(found.intersecting) << k;
    EXPECT_LE(*found.time, high + 1e-12);
    if (low < *found.time + 1.0 / 400) {
      EXPECT_GE(*found.time, low - 1e-6);
    }
    ++hits;
  }
  EXPECT_GT(hits, pairs_asked(300) / 4);
}

Scene simulation(std::vector<Body> bodies, int dimension, double step, int steps, Integrator integrator) {
  Scene s = cast_of(std::move(bodies), dimension);
  s.query = Query::simulate;
  s.motion->time_step = step, s.motion->steps = steps, s.motion->integrator = integrator;
  return s;
}

std::vector<recorded::State> states_of(const Scene& scene) {
  SceneFile file;
  file.scene = scene;
  std::vector<recorded::State> list;
  for (const Event& event : record(file).events)
    if (const auto* s = std::get_if<recorded::State>(&event)) list.push_back(*s);
  return list;
}

TEST(Simulate, FreeBodiesKeepMomentumAndEnergy) {
  for (const Integrator integrator : {Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::rk4}) {
    Body box = resting({Box{-at({0.5, 0.3, 0.2}), at({0.5, 0.3, 0.2})}, 0}, at({0, 0, 0}));
    box.motion->velocity = at({1, 2, 3});
    box.motion->angular_velocity = at({3, 0.5, 0.2});
    const auto states = states_of(simulation({box}, 3, 0.01, 200, integrator));
    double drift = 0;
    for (const auto& s : states) {
      EXPECT_EQ(s.momentum, states[0].momentum);
      drift = std::max(drift, std::abs(s.energy / states[0].energy - 1));
    }
    std::printf("%s: energy drift %.2g over 200 steps\n", word_of(integrator).data(), drift);
    EXPECT_LE(drift, integrator == Integrator::explicit_euler ? 1e-1 : integrator == Integrator::semi_implicit_euler ? 1e-3 : 1e-7);
    EXPECT_NEAR(states.back().bodies[0].position[2], 6, 1e-12);
  }
}

TEST(Simulate, AFallIsAParabola) {
  const double g = 9.81, h = 0.01;
  for (const Integrator integrator : {Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::rk4}) {
    Scene scene = simulation({resting({Sphere{0.5}, 0}, at({0, 100, 0}))}, 3, h, 100, integrator);
    scene.motion->gravity = at({0, -g, 0});
    const double y = states_of(scene).back().bodies[0].position[1], exact = 100 - g / 2;
    const double order = integrator == Integrator::rk4 ? 1e-11 : 1.01 * g * h / 2;
    EXPECT_NEAR(y, exact, order) << word_of(integrator);
  }
}

TEST(Simulate, CollisionsKeepMomentumAndElasticOnesEnergy) {
  RandomScenes random(44);
  for (int k = 0; k < pairs_asked(100); ++k) {
    const int d = 1 + k % 3;
    std::vector<Body> bodies;
    for (int i = 0; i < 4; ++i) {
      const Shape ball = d == 1 ? Shape{Box{at({-0.5}), at({0.5}), false}, 0} : Shape{Sphere{0.5}, 0};
      AnyVector p = AnyVector::Zero(d);
      p[0] = 1.5 * i;
      for (int j = 1; j < d; ++j) p[j] = random.uniform(-0.3, 0.3);
      Body b = resting(ball, p);
      b.motion->mass = random.uniform(0.5, 3);
      b.motion->restitution = k % 2;
      b.motion->velocity[0] = random.uniform(-5, 5);
      bodies.push_back(b);
    }
    const auto states = states_of(simulation(bodies, d, 0.005, 200, Integrator::semi_implicit_euler));
    for (std::size_t i = 1; i < states.size(); ++i) {
      EXPECT_LE((states[i].momentum - states[0].momentum).norm(), 1e-11);
      EXPECT_LE(states[i].energy, states[i - 1].energy * (1 + 1e-12) + 1e-12);
      if (k % 2 == 1) {
        EXPECT_NEAR(states[i].energy, states[0].energy, 1e-10 * states[0].energy);
      }
    }
    if (testing::Test::HasFailure()) return;
  }
}

/// It once gained as much in a bounce as it fell in a step, and more by being pushed out of the floor.
TEST(Simulate, AnElasticBallBouncesAsHighAsItFell) {
  Scene scene = read_scene(read_gallery(GJKDBG_GALLERY).file("sim-elastic-ball")).scene;
  for (const auto& [integrator, drift] : {std::pair{Integrator::rk4, 1e-12}, {Integrator::semi_implicit_euler, 0.02}}) {
    scene.motion->integrator = integrator;
    const auto states = states_of(scene);
    for (const auto& s : states) EXPECT_NEAR(s.energy, states[0].energy, drift * states[0].energy) << s.time;
  }
}

TEST(Simulate, TheGallerysAnswers) {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  const auto end = [&](const char* name) { return record(read_scene(gallery.file(name))).result; };
  // The last ball leaves with the first one's speed, all others stand.
  const Result cradle = end("sim-newtons-cradle");
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR((*cradle.bodies)[i].velocity[0], 0, 1e-12);
  EXPECT_NEAR((*cradle.bodies)[4].velocity[0], 2, 1e-12);
  // Coulomb: the one holds, the other slides by (g sin a - mu g cos a) t^2 / 2.
  const auto along = [&](const char* name) {
    const Result r = end(name);
    return -((*r.bodies)[0].position - read_scene(gallery.file(name)).scene.bodies[0].pose.position).dot(at({std::cos(M_PI / 9), std::sin(M_PI / 9)}));
  };
  EXPECT_NEAR(along("sim-slope-holds"), 0, 0.02);
  EXPECT_NEAR(along("sim-slope-slides"), 9.81 * (std::sin(M_PI / 9) - 0.1 * std::cos(M_PI / 9)) / 2, 0.05);
  // The stack stands.
  const Result stack = end("sim-stack-of-five");
  for (std::size_t i = 1; i < 6; ++i) EXPECT_NEAR((*stack.bodies)[i].position[1], static_cast<double>(i) - 0.5, 0.02);
  // Two stand, the third rolls on with two thirds of its speed.
  const Result rolling = end("sim-roll-and-rest");
  for (const std::size_t i : {1U, 2U}) EXPECT_LE((*rolling.bodies)[i].velocity.norm(), 1e-6);
  EXPECT_NEAR((*rolling.bodies)[3].velocity[2], 1.6, 0.01);
  // Over flush tiles: the one slides to the end after one touch, the other catches on an inner edge.
  EXPECT_NEAR((*end("cast-ghost-cured").bodies)[0].position[0], 4, 1e-6);
  EXPECT_NEAR((*end("cast-ghost-mesh").bodies)[0].position[0], 2.5, 1e-6);
  EXPECT_LT((*end("cast-ghost").bodies)[0].position[0], 3);
  // The bullet is through the wall.
  EXPECT_GT((*end("sim-tunnelling").bodies)[0].position[0], 5);
  // The middle axis: the body turns over.
  double least = 1;
  for (const auto& s : states_of(read_scene(gallery.file("sim-intermediate-axis")).scene)) {
    const auto& q = s.bodies[0].orientation;
    least = std::min(least, 1 - 2 * (q[1] * q[1] + q[3] * q[3]));  // y of the body's y axis
  }
  EXPECT_LT(least, -0.8);
}

TEST(Simulate, TheSameBitsTwice) {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  for (const char* name : {"sim-falling-box", "cast-rotating-rod", "cast-bounce"}) {
    const SceneFile scene = read_scene(gallery.file(name));
    const Recording one = record(scene);
    EXPECT_EQ(recording_to_text(one), recording_to_text(record(scene)));
    const Result silent = solve(scene.scene, one.settings);
    EXPECT_EQ(silent.time, one.result.time) << "watching changes nothing";
    EXPECT_EQ(silent.energy, one.result.energy);
  }
}

/// A grid of cells: volume, centre and inertia by counting.
MassProperties counted(const std::function<bool(const V3&)>& inside, const V3& reach) {
  constexpr int n = 90;
  double cells = 0;
  V3 first = V3::Zero();
  Matrix<3, double> second = Matrix<3, double>::Zero();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const V3 x = ((V3(i, j, k) + V3::Constant(0.5)) * 2 / n - V3::Ones()).cwiseProduct(reach);
        if (!inside(x)) continue;
        ++cells, first += x, second += x * x.transpose();
      }
  MassProperties m;
  m.center = first / cells;
  const Matrix<3, double> c = second / cells - m.center * m.center.transpose();
  m.inertia = c.trace() * Matrix<3, double>::Identity() - c;
  return m;
}

TEST(Mass, ClosedFormsAgreeWithCounting) {
  struct Case {
    Shape shape;
    std::function<bool(const V3&)> inside;
    V3 reach;
  };
  const auto across = [](const V3& x) { return std::hypot(x[0], x[2]); };
  const std::vector<Case> cases{
      {{Sphere{0.8}, 0}, [](const V3& x) { return x.norm() <= 0.8; }, V3::Constant(0.8)},
      {{Box{at({-0.5, -0.3, -0.2}), at({0.7, 0.3, 0.2}), false}, 0}, [](const V3& x) { return x[0] >= -0.5 && x[0] <= 0.7 && std::abs(x[1]) <= 0.3 && std::abs(x[2]) <= 0.2; }, V3(0.7, 0.3, 0.2)},
      {{Capsule{0.3, 0.6, 1}, 0}, [&](const V3& x) { return std::hypot(across(x), std::max(0.0, std::abs(x[1]) - 0.6)) <= 0.3; }, V3(0.3, 0.9, 0.3)},
      {{Cylinder{0.5, 0.7, 1}, 0}, [&](const V3& x) { return across(x) <= 0.5 && std::abs(x[1]) <= 0.7; }, V3(0.5, 0.7, 0.5)},
      {{Cone{0.5, 0.7, 1}, 0}, [&](const V3& x) { return across(x) <= 0.5 * (0.7 - x[1]) / 1.4; }, V3(0.5, 0.7, 0.5)},
      {{Ellipsoid{at({0.9, 0.5, 0.3})}, 0}, [](const V3& x) { return std::hypot(x[0] / 0.9, x[1] / 0.5, x[2] / 0.3) <= 1; }, V3(0.9, 0.5, 0.3)},
      {{PointSet{PointSetKind::hull, {at({0, 0, 0}), at({1, 0, 0}), at({0, 1, 0}), at({0, 0, 1})}, {}}, 0}, [](const V3& x) { return x.minCoeff() >= 0 && x.sum() <= 1; }, V3::Ones()},
  };
  for (const Case& c : cases) {
    const MassProperties exact = mass_properties(c.shape, 3), grid = counted(c.inside, c.reach);
    EXPECT_LE((exact.center - grid.center).norm(), 0.01) << type_name(c.shape, 3);
    EXPECT_LE((exact.inertia - grid.inertia).cwiseAbs().maxCoeff(), 0.02 * exact.inertia.cwiseAbs().maxCoeff()) << type_name(c.shape, 3) << "\n" << exact.inertia << "\n" << grid.inertia;
  }
  // A rod of length 2: 1/3 across, nothing along.
  const MassProperties rod = mass_properties({PointSet{PointSetKind::segment, {at({-1, 0, 0}), at({1, 0, 0})}, {}}, 0}, 3);
  EXPECT_NEAR(rod.inertia(1, 1), 1.0 / 3, 1e-15);
  EXPECT_NEAR(rod.inertia(0, 0), 0, 1e-15);
  // A margin: a box of half 0.4 with a margin of 0.1 lies between the boxes of 0.4 and 0.5.
  const double rounded = mass_properties({Box{-at({0.4, 0.4, 0.4}), at({0.4, 0.4, 0.4})}, 0.1}, 3).inertia(0, 0);
  EXPECT_GT(rounded, 0.16 * 2 / 3);
  EXPECT_LT(rounded, 0.25 * 2 / 3);
}

}  // namespace
}  // namespace gjkdbg
