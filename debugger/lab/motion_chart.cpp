#include "debugger/lab/motion_chart.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <random>

#include "algo/motion.h"
#include "recordings/recording.h"

namespace gjkdbg {
namespace {

/// Numbers in [low, high), the same on every machine.
class Numbers {
 public:
  double operator()(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_{7};
};

double gap(const Scene& scene, double time) {
  Scene two = scene;
  two.query = Query::penetration;
  two.motion.reset();
  for (Body& b : two.bodies) b = moved(b, time, 3), b.motion.reset();
  return *solve(two, resolve_settings({}, two)).signed_distance;
}

/// The first time on a grid of 1/200 at which they overlap, then bisection; negative when they never do.
double true_time(const Scene& scene) {
  double low = 0, high = -1;
  for (int i = 0; i <= 200 && high < 0; ++i) (gap(scene, i / 200.0) <= 0 ? high : low) = i / 200.0;
  if (high <= 0) return -1;
  for (int i = 0; i < 60; ++i) (gap(scene, (low + high) / 2) <= 0 ? high : low) = (low + high) / 2;
  return high;
}

}  // namespace

Body moving(const Shape& shape, const Vector<3, double>& position, const Vector<3, double>& velocity, const Vector<3, double>& spin) {
  Body b{"", shape, identity_pose(3), Motion{}};
  b.pose.position = position;
  b.motion->velocity = velocity, b.motion->angular_velocity = spin;
  return b;
}

std::vector<CastScene> cast_scenes(const std::string& family, int count) {
  Numbers number;
  std::vector<CastScene> list;
  while (static_cast<int>(list.size()) < count) {
    const auto any = [&](double r) { return Vector<3, double>(number(-r, r), number(-r, r), number(-r, r)); };
    const Shape ball{Sphere{0.5}, 0}, box{Box{AnyVector(Vector<3, double>::Constant(-0.5)), AnyVector(Vector<3, double>::Constant(0.5))}, 0};
    const bool turns = family == "boxes, turning";
    const Vector<3, double> place = any(1).normalized() * number(2.5, 4), spin = turns ? any(1.5) : Vector<3, double>(Vector<3, double>::Zero());
    CastScene c;
    c.scene.query = Query::cast;
    c.scene.motion = SceneMotion{};
    c.scene.motion->gravity = AnyVector::Zero(3);
    c.scene.bodies = {moving(family == "balls" ? ball : box, Vector<3, double>::Zero(), any(0.5), spin),
                      moving(family == "balls" ? ball : box, place, Vector<3, double>(-1.3 * place + any(0.5)), Vector<3, double>(-spin))};
    c.scene.bodies[1].pose.rotation = AxisAngle{AnyVector(any(1)), number(0, 3)};
    c.scene.bodies[1].pose.matrix = resolve(c.scene.bodies[1].pose.rotation, 3).matrix;
    c.time = true_time(c.scene);
    if (c.time > 0) list.push_back(std::move(c));
  }
  return list;
}

namespace {

double nanoseconds(const std::function<void()>& run, int rounds) {
  std::vector<double> times;
  for (int i = 0; i <= rounds; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    run();
    if (i > 0) times.push_back(std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count());
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

/// False: stopped.
bool cast_points(const std::string& family, bool quick, const std::function<bool()>& go_on, std::vector<MotionPoint>& points) {
  const std::vector<CastScene> scenes = cast_scenes(family, quick ? 20 : 100);
  for (const MethodName name : {MethodName::conservative_advancement, MethodName::root_finding, MethodName::ray_cast}) {
    if (name == MethodName::ray_cast && family == "boxes, turning") continue;
    for (const double tolerance : quick ? std::vector<double>{1e-3, 1e-9} : std::vector<double>{1e-2, 1e-4, 1e-6, 1e-9, 1e-12}) {
      MotionPoint point{family, std::string(word_of(name)), tolerance, 0, 0, 0, 0};
      Method method;
      method.name = name, method.tolerance = tolerance;
      for (const CastScene& c : scenes) {
        const Result r = solve(c.scene, resolve_settings(method, c.scene));
        const double early = c.time - (r.intersecting ? *r.time : 1);
        point.worst_error = std::max(point.worst_error, early);
        point.late += early < -1e-12;
        point.queries += r.support_calls / static_cast<double>(scenes.size());
      }
      const auto all = [&] {
        for (const CastScene& c : scenes) {
          const Result r = solve(c.scene, resolve_settings(method, c.scene));
          asm volatile("" : : "g"(&r) : "memory");
        }
      };
      point.nanoseconds = nanoseconds(all, quick ? 3 : 9) / static_cast<double>(scenes.size());
      points.push_back(std::move(point));
      if (!go_on()) return false;
    }
  }
  return true;
}

/// A free box that tumbles: nothing acts on it, so its energy may not change.
bool integrator_points(bool quick, const std::function<bool()>& go_on, std::vector<MotionPoint>& points) {
  for (const Integrator integrator : {Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::rk4})
    for (const double step : {0.04, 0.02, 0.01, 0.005}) {
      SceneFile file;
      file.scene.query = Query::simulate;
      file.scene.motion = SceneMotion{Response::stop, AnyVector::Zero(3), step, static_cast<int>(std::lround(2 / step)), integrator};
      const Vector<3, double> half(0.5, 0.3, 0.2);
      file.scene.bodies = {moving({Box{AnyVector(-half), AnyVector(half)}, 0}, Vector<3, double>::Zero(), {1, 0, 0}, {3, 0.5, 0.2})};
      const Settings settings = resolve_settings({}, file.scene);
      MotionPoint point{"free box", std::string(word_of(integrator)), step, 0, 0, 0, 0};
      double first = 0;
      for (const Event& event : record(file, settings).events)
        if (const auto* s = std::get_if<recorded::State>(&event)) {
          if (first == 0) first = s->energy;
          point.worst_error = std::max(point.worst_error, std::abs(s->energy / first - 1));
        }
      point.nanoseconds = nanoseconds([&] { (void)solve(file.scene, settings); }, quick ? 3 : 21) / file.scene.motion->steps;
      points.push_back(std::move(point));
      if (!go_on()) return false;
    }
  return true;
}

}  // namespace

int motion_point_count(bool quick) { return 8 * (quick ? 2 : 5) + 12; }

std::vector<MotionPoint> motion_points(bool quick, const std::function<bool()>& go_on) {
  std::vector<MotionPoint> points;
  for (const char* family : {"balls", "boxes", "boxes, turning"})
    if (!cast_points(family, quick, go_on, points)) return points;
  integrator_points(quick, go_on, points);
  return points;
}

}  // namespace gjkdbg
