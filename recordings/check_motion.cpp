// check, motion: what a cast or a simulation may not do, whoever computed it.
#include <algorithm>
#include <cmath>

#include "algo/motion.h"
#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

/// The signed distance of two bodies of a scene after a time.
double gap_at(const Scene& scene, const std::array<int, 2>& pair, double time) {
  Scene two;
  two.dimension = scene.dimension;
  two.query = Query::penetration;
  for (const int i : pair) {
    two.bodies.push_back(moved(scene.bodies[static_cast<std::size_t>(i)], time, scene.dimension));
    two.bodies.back().motion.reset();
  }
  return *solve(two, resolve_settings({}, two)).signed_distance;
}

struct MotionCheck {
  CheckContext& c;
  const Scene& scene;
  const Result& result;

  /// Between samples the bodies are apart until `time`, whatever pair was named.
  void tunnelling() const {
    if (!result.time || result.status == "initially_overlapping") return;
    constexpr int samples = 64;
    const double until = result.intersecting ? *result.time : 1;
    const int n = static_cast<int>(scene.bodies.size());
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        const Motion &a = *scene.bodies[static_cast<std::size_t>(i)].motion, &b = *scene.bodies[static_cast<std::size_t>(j)].motion;
        if (a.velocity == b.velocity && a.angular_velocity == b.angular_velocity) continue;
        for (int k = 1; k < samples; ++k) {
          const double t = until * k / samples, gap = gap_at(scene, {i, j}, t);
          if (gap >= -1e-6 * c.size) continue;
          c.find("tunnelling", "Bodies " + std::to_string(i) + " and " + std::to_string(j) + " overlap by " + text_of(-gap) + " at time " + text_of(t) + (result.intersecting ? ", before the time of impact " + text_of(until) : ", but no impact is reported") + ".");
          return;
        }
      }
  }

  void normal() const {
    if (!result.intersecting || !result.normal || !result.pair || result.status == "initially_overlapping") return;
    const Motion &a = *scene.bodies[static_cast<std::size_t>((*result.pair)[0])].motion, &b = *scene.bodies[static_cast<std::size_t>((*result.pair)[1])].motion;
    const bool turns = (a.angular_velocity.size() > 0 && !a.angular_velocity.isZero(0)) || (b.angular_velocity.size() > 0 && !b.angular_velocity.isZero(0));
    const double approach = (a.velocity - b.velocity).dot(*result.normal);
    if (turns || approach >= -1e-9 * (a.velocity - b.velocity).norm()) return;
    c.find("normal-against-approach", "The bodies come together against the normal " + text_of(*result.normal) + ": their velocity along it is " + text_of(approach) + ". It should point from the first body to the second.");
  }

  /// Over a step energy may change by what its order leaves, of the fall m (g h)^2 a body, and restitution only takes.
  void states() const {
    const SceneMotion& m = *scene.motion;
    double fall = 0, mass = 0;
    bool walls = false;
    for (const Body& body : scene.bodies) {
      if (body.motion->is_static) walls = true;
      else fall += body.motion->mass * m.gravity.squaredNorm() * m.time_step * m.time_step, mass += body.motion->mass;
    }
    const recorded::State* before = nullptr;
    bool touched = false;
    for (std::size_t i = 0; i < c.recording.events.size(); ++i) {
      const Event& event = c.recording.events[i];
      c.step = i;
      touched = touched || std::holds_alternative<recorded::ContactFound>(event);
      if (const auto* contact = std::get_if<recorded::ContactFound>(&event)) sinking(*contact);
      const auto* now = std::get_if<recorded::State>(&event);
      if (!now) continue;
      if (before) {
        const double speed = std::sqrt(std::max(0.0, 2 * std::abs(before->energy) * std::max(mass, 1e-300)));
        if (now->energy > before->energy + 4 * fall + 1e-6 * std::abs(before->energy) + (touched ? m.gravity.norm() * mass * 0.01 * c.size : 0))
          c.find("energy-gained", "Energy rose from " + text_of(before->energy) + " to " + text_of(now->energy) + " between times " + text_of(before->time) + " and " + text_of(now->time) + ".");
        const AnyVector expected = before->momentum + mass * m.time_step * m.gravity;
        if (!(walls && touched) && (now->momentum - expected).norm() > 1e-9 * (speed + mass * m.gravity.norm() * m.time_step) + 1e-12)
          c.find("momentum-lost", "Momentum went from " + text_of(before->momentum) + " to " + text_of(now->momentum) + ", expected " + text_of(expected) + ": nothing but gravity acts on these bodies from outside.");
      }
      before = now;
      touched = false;
    }
  }

  void sinking(const recorded::ContactFound& contact) const {
    double size = 1e300;
    for (const int i : contact.pair) size = std::min(size, reach_of(scene.bodies[static_cast<std::size_t>(i)].shape, scene.dimension));
    if (contact.depth > 0.5 * size)
      c.find("sinking", "Body " + std::to_string(contact.pair[1]) + " has sunk " + text_of(contact.depth) + " into body " + std::to_string(contact.pair[0]) + ", more than half its size: the time step is too long for its speed, or nothing holds it.", Finding::Severity::warning);
  }
};

}  // namespace

void check_motion(CheckContext& c) {
  const MotionCheck judge{c, c.recording.scene.scene, c.recording.result};
  if (!c.recording.events.empty()) c.step = c.recording.events.size() - 1;
  if (judge.scene.query == Query::cast) {
    judge.tunnelling();
    judge.normal();
  } else {
    judge.states();
  }
}

}  // namespace gjkdbg
