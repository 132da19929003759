// check, cast: whether bodies meet, when, where, and what they do in between, whoever computed it.
#include <algorithm>
#include <cmath>

#include "algo/motion.h"
#include "recordings/check_context.h"
#include "shapes/corners.h"

namespace gjkdbg {
namespace {

struct CastCheck {
  CheckContext& c;
  const Scene& scene;
  const Result& result;
  const double limit;    ///< on lengths
  const bool responded;  ///< what follows the first impact is not judged by the first stretch
  const Result right;    ///< ours, until the first impact

  explicit CastCheck(CheckContext& context)
      : c(context), scene(c.recording.scene.scene), result(c.recording.result), limit(c.stop * c.size),
        responded(std::any_of(c.recording.events.begin(), c.recording.events.end(), [](const Event& e) { return std::holds_alternative<recorded::State>(e); })), right(ours()) {}

  Result ours() const {
    Scene first = scene;
    if (first.motion) first.motion->response = Response::stop;
    return solve(first, resolve_settings({}, first));
  }

  const Motion& motion(int i) const { return *scene.bodies[static_cast<std::size_t>(i)].motion; }
  bool exists(const std::array<int, 2>& pair) const {
    const int n = static_cast<int>(scene.bodies.size());
    return pair[0] != pair[1] && std::min(pair[0], pair[1]) >= 0 && std::max(pair[0], pair[1]) < n;
  }

  /// Two bodies of the scene, where they are after a time.
  Scene at(const std::array<int, 2>& pair, double time) const {
    Scene two;
    two.dimension = scene.dimension;
    two.query = Query::penetration;
    for (const int i : pair) {
      two.bodies.push_back(moved(scene.bodies[static_cast<std::size_t>(i)], time, scene.dimension));
      two.bodies.back().motion.reset();
    }
    return two;
  }
  double gap_at(const std::array<int, 2>& pair, double time) const {
    const Scene two = at(pair, time);
    return *solve(two, resolve_settings({}, two)).signed_distance;
  }
  bool has_mesh(const std::array<int, 2>& pair) const {
    return std::any_of(pair.begin(), pair.end(), [&](int i) { return std::holds_alternative<Mesh>(scene.bodies[static_cast<std::size_t>(i)].shape.geometry); });
  }
  /// How far apart two bodies are along a unit direction from the first to the second.
  double along(const Scene& two, const AnyVector& n) const {
    const WorldSupport a(two.bodies[0], scene.dimension), b(two.bodies[1], scene.dimension);
    return n.dot(b(-n, true) - a(n, true));
  }

  /// The gaps on the way, and that the end says what the result says.
  void steps() const {
    for (std::size_t i = 0; i < c.recording.events.size(); ++i) {
      c.step = i;
      const Event& event = c.recording.events[i];
      if (std::holds_alternative<recorded::State>(event)) break;
      if (const auto* e = std::get_if<recorded::CastAdvanced>(&event)) advanced(*e);
      if (const auto* e = std::get_if<recorded::CastEnded>(&event); e && !responded) ended(*e);
    }
    c.step = c.recording.events.empty() ? 0 : c.recording.events.size() - 1;
  }

  void advanced(const recorded::CastAdvanced& e) const {
    if (!exists(e.pair)) return c.find("wrong-pair", "The scene has no bodies " + std::to_string(e.pair[0]) + " and " + std::to_string(e.pair[1]) + ".");
    if (e.normal.allFinite() && !e.normal.isZero(0) && std::abs(e.normal.norm() - 1) > 1e-5) return c.find("wrong-normal", "The normal " + text_of(e.normal) + " has length " + text_of(e.normal.norm()) + " instead of 1.");
    if (!(e.time >= 0 && e.time <= 1)) c.find("wrong-time", "The time " + text_of(e.time) + " of the step is not of the interval, 0 to 1.");
    if (c.recording.settings.name == MethodName::ray_cast || has_mesh(e.pair) || !e.normal.allFinite() || e.normal.isZero(0)) return;
    const double gap = gap_at(e.pair, e.time);
    if (std::abs(e.distance - gap) > limit) c.find("wrong-distance", "At time " + text_of(e.time) + " bodies " + std::to_string(e.pair[0]) + " and " + std::to_string(e.pair[1]) + " are " + text_of(gap) + " apart, not " + text_of(e.distance) + ".");
    else if (std::abs(along(at(e.pair, e.time), e.normal.stableNormalized()) - gap) > 10 * limit) c.find("wrong-normal", "Along the normal " + text_of(e.normal) + " the bodies are not the " + text_of(gap) + " apart that they are at time " + text_of(e.time) + ".");
  }

  void ended(const recorded::CastEnded& e) const {
    const std::vector<int> pair = result.pair ? std::vector<int>{(*result.pair)[0], (*result.pair)[1]} : std::vector<int>();
    const std::string status(word_of(e.status));
    if (status != result.status) c.find("wrong-answer", "The cast ended as \"" + status + "\", but the result says \"" + result.status + "\".");
    else if (result.time && std::abs(*result.time - e.time) > 1e-9) c.find("wrong-time", "The cast ended at time " + text_of(e.time) + ", but the result says " + text_of(*result.time) + ".");
    else if (pair != e.pair && e.status != CastStatus::iteration_limit) c.find("wrong-pair", "The pair of the cast's end is not that of the result.");
  }

  /// False when there is nothing more to judge.
  bool consistent() const {
    const bool met = result.status == "hit" || result.status == "initially_overlapping";
    if ((met || result.status == "miss") && met != result.intersecting) {
      c.find("wrong-answer", "The status is \"" + result.status + "\", but intersecting is " + (result.intersecting ? "true." : "false."));
      return false;
    }
    if (result.time && !(*result.time >= 0 && *result.time <= 1)) c.find("wrong-time", "The time " + text_of(*result.time) + " is not of the interval, 0 to 1.");
    else if (result.status == "miss" && result.time && *result.time < 1 - 1e-9) c.find("wrong-time", "Nothing is met, but the bodies are said to be apart until " + text_of(*result.time) + " only, not 1.");
    if (!result.intersecting) return false;
    if (!result.pair || !exists(*result.pair)) {
      c.find("wrong-pair", result.pair ? "The scene has no bodies " + std::to_string((*result.pair)[0]) + " and " + std::to_string((*result.pair)[1]) + " that could meet." : "Bodies meet, but which is not said.");
      return false;
    }
    return result.time.has_value();
  }

  void impact() const {
    if (!consistent()) return;
    const std::array<int, 2>& pair = *result.pair;
    const double time = *result.time, gap = gap_at(pair, time);
    const std::string who = "bodies " + std::to_string(pair[0]) + " and " + std::to_string(pair[1]);
    if (gap > limit) {
      const bool others = right.pair && *right.pair != pair && std::abs(*right.time - time) * speed(pair) <= limit;
      c.find(others ? "wrong-pair" : "wrong-time", "At time " + text_of(time) + " " + who + " are " + text_of(gap) + " apart" + (right.intersecting ? ", and the first to meet are " + std::to_string((*right.pair)[0]) + " and " + std::to_string((*right.pair)[1]) + ", at " + text_of(*right.time) + "." : "."));
      return;
    }
    if (gap < -limit && result.status != "initially_overlapping") return c.find("wrong-time", "At time " + text_of(time) + " " + who + " overlap by " + text_of(-gap) + " already.");
    if (result.touching_at && (*result.touching_at < time || gap_at(pair, *result.touching_at) > limit)) c.find("wrong-time", "At " + text_of(*result.touching_at) + " " + who + " do not surely touch.");
    normal_and_witnesses(at(pair, time), gap);
  }

  void normal_and_witnesses(const Scene& two, double gap) const {
    if (!result.normal) return;
    const AnyVector& n = *result.normal;
    if (!n.allFinite() || std::abs(n.norm() - 1) > 1e-3) return c.find("wrong-normal", "The normal " + text_of(n) + " has not length 1.");
    if (has_mesh(*result.pair)) return;
    if (along(two, n) < gap - 10 * limit) {
      const bool flipped = along(two, -n) >= gap - 10 * limit;
      c.find(flipped ? "flipped-normal" : "wrong-normal", "At the impact the bodies are " + text_of(gap) + " apart, but along the normal " + text_of(n) + " " + text_of(along(two, n)) + (flipped ? ": it points from the second body to the first." : "."));
    }
    if (!result.witness_a || !result.witness_b) return;
    // Along a smooth surface points are known less well than distances.
    const bool round = std::any_of(two.bodies.begin(), two.bodies.end(), [&](const Body& b) { return !corners_of(b.shape, scene.dimension); });
    const double slack = round ? std::max(10 * limit, 1e-3 * c.size) : 10 * limit;
    const double out_a = outside(two, 0, *result.witness_a), out_b = outside(two, 1, *result.witness_b);
    if (std::max(out_a, out_b) > slack) c.find("wrong-witness", std::string("At the time of impact witness_") + (out_a > out_b ? "a" : "b") + " lies " + text_of(std::max(out_a, out_b)) + " outside its body.");
    else if ((*result.witness_b - *result.witness_a - gap * n).norm() > slack) c.find("wrong-witness", "The witness points are " + text_of((*result.witness_b - *result.witness_a).norm()) + " from each other, but the bodies " + text_of(gap) + ".");
  }

  /// How fast two bodies can come nearer.
  double speed(const std::array<int, 2>& pair) const {
    double s = (motion(pair[0]).velocity - motion(pair[1]).velocity).norm();
    for (const int i : pair) s += motion(i).angular_velocity.norm() * reach_of(scene.bodies[static_cast<std::size_t>(i)].shape, scene.dimension);
    return s;
  }

  /// The bodies are apart until `time`, whatever pair was named: at samples between, and where our own cast has them meet, as often as it takes
  /// to see whether they go in.
  void tunnelling() const {
    if (!result.time || result.status == "initially_overlapping" || result.status == "iteration_limit") return;
    constexpr int samples = 64;
    const double until = result.intersecting ? std::min(1.0, *result.time) : 1;
    const int n = static_cast<int>(scene.bodies.size());
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        const std::array<int, 2> pair{i, j};
        if (!(speed(pair) > 0)) continue;
        std::vector<double> times;
        for (int k = 1; k < samples; ++k) times.push_back(until * k / samples);
        if (right.intersecting && right.pair == pair)
          for (int k = 1; k < samples; ++k) times.push_back(*right.time + 2 * k * limit / speed(pair));
        for (const double t : times) {
          if (t >= until) continue;
          const double gap = gap_at(pair, t);
          if (gap >= -limit) continue;
          c.find("tunnelling", "Bodies " + std::to_string(i) + " and " + std::to_string(j) + " overlap by " + text_of(-gap) + " at time " + text_of(t) + (result.intersecting ? ", before the time of impact " + text_of(until) : ", but no impact is reported") + ".");
          return;
        }
      }
  }

  void approach() const {
    if (!result.intersecting || !result.normal || !result.pair || !exists(*result.pair) || result.status == "initially_overlapping") return;
    const Motion &a = motion((*result.pair)[0]), &b = motion((*result.pair)[1]);
    const bool turns = (a.angular_velocity.size() > 0 && !a.angular_velocity.isZero(0)) || (b.angular_velocity.size() > 0 && !b.angular_velocity.isZero(0));
    const double approach = (a.velocity - b.velocity).dot(*result.normal);
    if (turns || approach >= -1e-9 * (a.velocity - b.velocity).norm()) return;
    c.find("normal-against-approach", "The bodies come together against the normal " + text_of(*result.normal) + ": their velocity along it is " + text_of(approach) + ". It should point from the first body to the second.");
  }

  /// From one response to the next bodies move as they did; at one, those that meet get the velocities it names, the second by the impulse more.
  void responses() const {
    std::vector<Body> bodies = scene.bodies;
    double time = 0;
    for (std::size_t i = 0; i < c.recording.events.size(); ++i) {
      c.step = i;
      if (const auto* e = std::get_if<recorded::ImpulseApplied>(&c.recording.events[i])) {
        advance(bodies, std::exchange(time, e->time), e->time);
        respond(bodies, *e);
      } else if (const auto* state = std::get_if<recorded::State>(&c.recording.events[i])) {
        advance(bodies, std::exchange(time, state->time), state->time);
        as_said(bodies, *state);
      }
    }
  }

  void advance(std::vector<Body>& bodies, double from, double to) const {
    if (!(to >= from && to <= 1)) c.find("wrong-time", "The time " + text_of(to) + " comes after " + text_of(from) + ", in an interval that ends at 1.");
    for (Body& body : bodies) body = moved(body, to - from, scene.dimension);
  }

  void respond(std::vector<Body>& bodies, const recorded::ImpulseApplied& e) const {
    if (!exists(e.pair) || e.velocities_before.size() != 2 || e.velocities_after.size() != 2) return c.find("wrong-pair", "An impulse is between two bodies of the scene, with the velocities of both before and after.");
    for (std::size_t k = 0; k < 2; ++k) {
      AnyVector& v = bodies[static_cast<std::size_t>(e.pair[k])].motion->velocity;
      if ((v - e.velocities_before[k]).norm() > 1e-9 * c.size) c.find("wrong-state", "Body " + std::to_string(e.pair[k]) + " comes with the velocity " + text_of(e.velocities_before[k]) + ", expected " + text_of(v) + ".");
      v = e.velocities_after[k];
    }
    const AnyVector change = e.velocities_after[1] - e.velocities_before[1];
    if ((change - e.impulse).norm() > 1e-9 * c.size) c.find("wrong-state", "The impulse " + text_of(e.impulse) + " changes the second body's velocity by " + text_of(change) + ".");
  }

  void as_said(std::vector<Body>& bodies, const recorded::State& state) const {
    if (state.bodies.size() != bodies.size()) return c.find("wrong-state", "There are " + std::to_string(state.bodies.size()) + " bodies; the scene has " + std::to_string(bodies.size()) + ".");
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const recorded::BodyState& said = state.bodies[i];
      Body& body = bodies[i];
      if ((said.position - body.pose.position).norm() > limit) c.find("wrong-state", "Body " + std::to_string(i) + " is at " + text_of(said.position) + " at time " + text_of(state.time) + ", expected " + text_of(body.pose.position) + ".");
      if ((said.velocity - body.motion->velocity).norm() > 1e-9 * c.size) c.find("wrong-state", "Body " + std::to_string(i) + " has the velocity " + text_of(said.velocity) + " at time " + text_of(state.time) + ", expected " + text_of(body.motion->velocity) + ".");
      turned(i, said.orientation, said.angular_velocity, body, state.time);
    }
  }

  /// Nothing but their own spin turns the bodies of a cast.
  void turned(std::size_t i, const std::vector<double>& orientation, const std::vector<double>& spin, const Body& body, double time) const {
    const std::string who = "Body " + std::to_string(i) + " at time " + text_of(time) + " ";
    const std::vector<double> own = in_degrees(body.motion->angular_velocity);  // empty: none
    bool same_spin = spin.size() == (scene.dimension == 3 ? 3u : scene.dimension == 2 ? 1u : 0u);
    for (std::size_t k = 0; same_spin && k < spin.size(); ++k) same_spin = std::abs(spin[k] - (own.empty() ? 0 : own[k])) <= 1e-9 * (1 + std::abs(spin[k]));
    if (!same_spin) c.find("wrong-state", who + "does not have the angular velocity of the scene.");
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    if (orientation.size() == 4) q = Eigen::Quaterniond(orientation[0], orientation[1], orientation[2], orientation[3]);
    const AnyMatrix matrix = q.toRotationMatrix().topLeftCorner(scene.dimension, scene.dimension);
    if (orientation.size() != 4 || std::abs(q.norm() - 1) > 1e-6) c.find("wrong-state", who + "has no orientation: that is a quaternion of length 1.");
    else if ((matrix - body.pose.matrix).norm() > 1e-6) c.find("wrong-state", who + "is not turned as its motion turns it.");
  }

  /// After the last response bodies go straight on, unless they turn, and end as they moved then.
  void final_places() const {
    const recorded::State* last = nullptr;
    double end = 1;
    for (const Event& event : c.recording.events) {
      if (const auto* state = std::get_if<recorded::State>(&event)) last = state;
      if (const auto* e = std::get_if<recorded::CastEnded>(&event)) end = e->time;
    }
    if (!last || !result.bodies) return;
    const bool as_many = last->bodies.size() == result.bodies->size();
    for (std::size_t i = 0; as_many && i < last->bodies.size(); ++i) {
      const auto& from = last->bodies[i];
      const FinalState& to = (*result.bodies)[i];
      if ((to.velocity - from.velocity).norm() > 1e-9 * from.velocity.norm()) c.find("wrong-state", "Body " + std::to_string(i) + " ends with the velocity " + text_of(to.velocity) + ", but left its last impact with " + text_of(from.velocity) + ".");
      turned(i, to.orientation, to.angular_velocity, moved(scene.bodies[i], end, scene.dimension), end);
      const AnyVector expected = from.position + (end - last->time) * from.velocity;
      if ((to.position - expected).norm() > limit) c.find("wrong-state", "Body " + std::to_string(i) + " ends at " + text_of(to.position) + ", expected " + text_of(expected) + ".");
    }
    if (!as_many) c.find("wrong-state", "The result has " + std::to_string(result.bodies->size()) + " bodies, the last state " + std::to_string(last->bodies.size()) + ".");
  }
};

}  // namespace

void check_cast(CheckContext& c) {
  const CastCheck judge(c);
  judge.steps();
  judge.approach();
  judge.tunnelling();
  judge.impact();
  judge.responses();
  judge.final_places();
}

}  // namespace gjkdbg
