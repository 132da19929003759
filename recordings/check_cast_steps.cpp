// check, cast: the steps, gaps and bounds on the way, what bodies do when they have met, and how it ends, whoever computed it.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "algo/cast.h"
#include "recordings/cast_stretch.h"
#include "recordings/check_context.h"
#include "shapes/corners.h"

namespace gjkdbg {
namespace {

/// From one response to the next bodies move as they did; at one, those that meet get the velocities it names, the second by the impulse more.
struct CastWalk : CastStretch {
  CheckContext& c;
  const Result& result;
  const double limit;  ///< on lengths
  const bool ray, ours;
  int responses = 0;
  const recorded::State* last_state = nullptr;
  const recorded::CastAdvanced* last_advance = nullptr;
  mutable CornerFinders finders;

  explicit CastWalk(CheckContext& context)
      : CastStretch{context.recording.scene.scene}, c(context), result(c.recording.result), limit(c.stop * c.size + c.world), ray(c.recording.settings.name == MethodName::ray_cast), ours(!foreign(c.recording)) {}

  void run() {
    for (std::size_t i = 0; i < c.recording.events.size(); ++i) {
      c.step = i;
      const Event& event = c.recording.events[i];
      if (const auto* e = std::get_if<recorded::CastAdvanced>(&event)) advanced(*e);
      if (const auto* e = std::get_if<recorded::ImpulseApplied>(&event)) respond(*e);
      if (const auto* e = std::get_if<recorded::State>(&event)) as_said(*e);
      if (const auto* e = std::get_if<recorded::CastEnded>(&event)) ended(*e);
      if (std::any_of(bodies.begin(), bodies.end(), lost)) break;
    }
    c.step = c.recording.events.empty() ? 0 : c.recording.events.size() - 1;
  }

  /// Nothing is farther away, or faster, than a scene may have it: what a recording says beyond that is wrong, and has been told.
  static bool lost(const Body& body) { return !(std::max(body.pose.position.stableNorm(), body.motion->velocity.stableNorm()) <= 1e60); }

  // --- On the way -----------------------------------------------------------------------------------------------------

  /// After a response a cast goes on with the bodies that move against each other then. (What it begins with is compared with the scene elsewhere.)
  bool looks_at(const Two& pair) const { return bodies.size() == 2 || turns(pair[0]) || turns(pair[1]) || motion(pair[0]).velocity != motion(pair[1]).velocity; }

  double along_parts(const Two& pair, double time, const AnyVector& n, double said) const { return along(pair, time, n, said, limit, c.recording, c.step, finders); }

  void advanced(const recorded::CastAdvanced& e) {
    last_advance = &e;
    if (!exists(e.pair)) return c.find("wrong-pair", "The scene has no " + names_of(e.pair) + ".");
    if (ours && responses > 0 && !looks_at(e.pair)) c.find("inconsistent", "The cast goes on with " + names_of(e.pair) + ", which do not move against each other after the response.", Finding::Severity::warning);
    if (const std::string off = c.not_unit(e.normal); !off.empty() && e.normal.allFinite() && !e.normal.isZero(0)) return c.find("wrong-normal", off);
    if (!(e.time >= 0 && e.time <= 1)) return c.find("wrong-time", "The time " + text_of(e.time) + " of the step is not of the interval, 0 to 1.");
    if (!e.normal.allFinite() || e.normal.isZero(0)) return;
    const AnyVector n = e.normal.stableNormalized();
    closing(e, n);
    const std::string when = "At time " + text_of(e.time) + " " + names_of(e.pair);
    if (ray || has_mesh(e.pair)) {  // of a ray the plane just found; of a mesh the triangle looked at
      if (ray && !(e.distance > 0)) return c.find("wrong-distance", "A ray's plane is ahead of it, at a distance above zero, not " + text_of(e.distance) + ".");
      if (const double apart = along_parts(e.pair, e.time, n, e.distance); std::abs(apart - e.distance) > limit)
        c.find("wrong-distance", when + " are " + text_of(apart) + " apart along the normal " + text_of(n) + ", not " + text_of(e.distance) + ".");
      return;
    }
    const Scene two = at(e.pair, e.time);
    const double gap = gap_at(e.pair, e.time);
    if (any_way_out(c.recording.settings, gap) && e.distance < gap && std::abs(along(two, n) - e.distance) <= 10 * limit) return;
    if (std::abs(e.distance - gap) > limit) c.find("wrong-distance", when + " are " + text_of(gap) + " apart, not " + text_of(e.distance) + ".");
    else if (std::abs(along(two, n) - gap) > 10 * limit) c.find("wrong-normal", "Along the normal " + text_of(n) + " the bodies are not the " + text_of(gap) + " apart that they are at time " + text_of(e.time) + ".");
    else bounded(e, n, gap);
  }

  /// Until they can meet, at distance / bound from then, they come nearer along n by no more than bound times the time. (From then on the next step tells.)
  void bounded(const recorded::CastAdvanced& e, const AnyVector& n, double gap) const {
    if (ray || !(e.bound > 0) || !std::isfinite(e.bound) || !(turns(e.pair[0]) || turns(e.pair[1]))) return;  // of what does not turn the bound is how fast it moves
    constexpr int samples = 8;
    const double until = std::min(1 - e.time, gap / e.bound);
    for (int k = 1; k <= samples && until > 0; ++k) {
      const double t = until * k / samples, apart = along(at(e.pair, e.time + t), n), least = gap - e.bound * t;
      if (apart >= least - 10 * limit) continue;
      return c.find("wrong-bounds", "From time " + text_of(e.time) + " on " + names_of(e.pair) + " are said to come nearer at " + text_of(e.bound) + " at most, which leaves " + text_of(least) + " between them at " + text_of(e.time + t) + ", but along the normal there are " + text_of(apart) +
                                       ". Points of a body that turns move at up to |w| times their distance from its centre, and faster towards the other body later on than now.");
    }
  }

  /// Along n the bodies come nearer by (vA - vB) . n, and by no more than |w| times their reach where they turn.
  void closing(const recorded::CastAdvanced& e, const AnyVector& n) const {
    const double straight = approach(e.pair, n), aside = turning(e.pair);
    const double slack = 1e-6 * (std::abs(straight) + aside) + 100 * c.digits() * (motion(e.pair[0]).velocity.norm() + motion(e.pair[1]).velocity.norm());
    if (ours && std::abs(e.bound - straight) > aside + slack)
      c.find("inconsistent", "The bound on how fast " + names_of(e.pair) + " come nearer is " + text_of(e.bound) + ", but along the normal they move at " + text_of(straight) + (aside > 0 ? ", and turn at no more than " + text_of(aside) + "." : "."), Finding::Severity::warning);
  }

  // --- At a response --------------------------------------------------------------------------------------------------

  void respond(const recorded::ImpulseApplied& e) {
    until(e.time);
    ++responses;
    if (!exists(e.pair) || e.velocities_before.size() != 2 || e.velocities_after.size() != 2) return c.find("wrong-pair", "An impulse is between two bodies of the scene, with the velocities of both before and after.");
    place(e);
    law(e);
    for (std::size_t k = 0; k < 2; ++k) {
      AnyVector& v = bodies[static_cast<std::size_t>(e.pair[k])].motion->velocity;
      if ((v - e.velocities_before[k]).norm() > 1e-9 * c.size) c.find("wrong-state", "Body " + std::to_string(e.pair[k]) + " comes with the velocity " + text_of(e.velocities_before[k]) + ", expected " + text_of(v) + ".");
      v = e.velocities_after[k];
    }
    const AnyVector change = e.velocities_after[1] - e.velocities_before[1];
    if ((change - e.impulse).norm() > 1e-9 * c.size) c.find("wrong-state", "The impulse " + text_of(e.impulse) + " changes the second body's velocity by " + text_of(change) + ".");
  }

  /// The two bodies touch then, along the normal and at the point.
  void place(const recorded::ImpulseApplied& e) const {
    const double gap = gap_at(e.pair, e.time);
    if (std::abs(gap) > limit) return c.find("wrong-time", "At time " + text_of(e.time) + " " + names_of(e.pair) + " are said to meet, but they " + (gap > 0 ? "are " + text_of(gap) + " apart." : "overlap by " + text_of(-gap) + "."));
    if (const std::string off = c.not_unit(e.normal, "An impulse's normal"); !off.empty()) return c.find("wrong-normal", off);
    if (const double apart = along_parts(e.pair, e.time, e.normal, gap); apart < gap - 10 * limit)
      return c.find(along_parts(e.pair, e.time, -e.normal, gap) >= gap - 10 * limit ? "flipped-normal" : "wrong-normal", "Where they meet, " + names_of(e.pair) + " overlap by " + text_of(-apart) + " along the normal " + text_of(e.normal) + " of their impulse.");
    if (ours && !ray && last_advance && last_advance->pair == e.pair && last_advance->normal.size() == e.normal.size() && (last_advance->normal - e.normal).norm() > 1e-9)
      c.find("inconsistent", "The impulse has the normal " + text_of(e.normal) + ", the step that found the impact " + text_of(last_advance->normal) + ".", Finding::Severity::warning);
    const Scene two = at(e.pair, e.time);
    const bool round = std::any_of(two.bodies.begin(), two.bodies.end(), [&](const Body& b) { return !corners_of(b.shape, scene.dimension); });
    const double out_a = outside(two, 0, e.point), out_b = outside(two, 1, e.point);
    if (!e.point.allFinite() || std::max(out_a, out_b) > (round ? std::max(10 * limit, 1e-3 * c.size) : 10 * limit))
      c.find("wrong-contact", "The point " + text_of(e.point) + " of the impulse lies " + text_of(out_a) + " from body " + std::to_string(e.pair[0]) + " and " + text_of(out_b) + " from body " + std::to_string(e.pair[1]) + ": it is where they meet.");
  }

  /// Of a body between two others a response to one may leave it approaching the other, or both: they respond again before time goes on.
  bool meets_again(const recorded::ImpulseApplied& e) const {
    const auto& events = c.recording.events;
    for (std::size_t i = c.step + 1; i < events.size(); ++i) {
      const auto* next = std::get_if<recorded::ImpulseApplied>(&events[i]);
      if (next && next->time > e.time) return false;
      if (next && next->pair == e.pair) return true;
    }
    return false;
  }

  /// "bounce" turns the approach back, times the larger restitution, and changes nothing across the normal. "slide" takes it off; two walls may take off more.
  void law(const recorded::ImpulseApplied& e) const {
    if (!e.normal.allFinite() || !scene.motion) return;
    const auto relative = [&](const std::vector<AnyVector>& v) { return v[0] - v[1]; };
    const AnyVector before = relative(e.velocities_before), after = relative(e.velocities_after);
    const double slack = std::max(1e-9, 100 * c.digits()) * (e.velocities_before[0].norm() + e.velocities_before[1].norm()) + 1e-12 * c.size;
    const double came = before.dot(e.normal), went = after.dot(e.normal);
    if (scene.motion->response == Response::bounce) {
      const double back = came > 0 ? -std::max(motion(e.pair[0]).restitution, motion(e.pair[1]).restitution) * came : came;
      if (std::abs(went - back) > slack) c.find("wrong-state", "Bodies that approach at " + text_of(came) + " go on at " + text_of(went) + " along the normal; bouncing makes that " + text_of(back) + ".");
      for (std::size_t k = 0; k < 2; ++k) {
        const AnyVector change = e.velocities_after[k] - e.velocities_before[k];
        if ((change - change.dot(e.normal) * e.normal).norm() > slack) c.find("wrong-state", "The velocity of body " + std::to_string(e.pair[k]) + " changes by " + text_of(change) + ", not along the normal " + text_of(e.normal) + ": there is no friction.");
      }
      return;
    }
    if (went > slack && !meets_again(e)) c.find("wrong-state", "After they have met, bodies approach along the normal at " + text_of(went) + " still.");
    for (std::size_t k = 0; k < 2; ++k)  // who meets what stands still
      if (e.velocities_before[1 - k].isZero(0) && e.velocities_after[k].norm() > e.velocities_before[k].norm() + slack) c.find("wrong-state", "Body " + std::to_string(e.pair[k]) + " slides on faster than it came, at " + text_of(e.velocities_after[k].norm()) + " instead of " + text_of(e.velocities_before[k].norm()) + ".");
  }

  /// On to a time, with no body going into another. (Until the first impact the answer is judged, more closely.)
  void until(double time) {
    if (!(time >= from && time <= 1 + 1e-12)) return c.find("wrong-time", "The time " + text_of(time) + " comes after " + text_of(from) + ", in an interval that ends at 1.");
    constexpr int samples = 8;
    const int n = static_cast<int>(bodies.size());
    for (int i = 0; i < n && responses > 0 && time > from; ++i)
      for (int j = i + 1; j < n; ++j) {
        if (!(speed({i, j}) > 0)) continue;
        for (int k = 1; k <= samples; ++k) {
          const double t = from + (time - from) * k / samples, gap = gap_at({i, j}, t);
          if (gap < -limit) return c.find("tunnelling", "Bodies " + std::to_string(i) + " and " + std::to_string(j) + " overlap by " + text_of(-gap) + " at time " + text_of(t) + ", and nothing is said to meet between " + text_of(from) + " and " + text_of(time) + "."), go_to(time);
        }
      }
    go_to(time);
  }

  void as_said(const recorded::State& state) {
    until(state.time);
    last_state = &state;
    if (state.bodies.size() != bodies.size()) return c.find("wrong-state", "There are " + std::to_string(state.bodies.size()) + " bodies; the scene has " + std::to_string(bodies.size()) + ".");
    if (state.energy != 0 || !state.momentum.isZero(0)) c.find("wrong-state", "The state has the energy " + text_of(state.energy) + " and the momentum " + text_of(state.momentum) + "; a cast knows no masses, and both are 0.");
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const recorded::BodyState& said = state.bodies[i];
      const Body& body = bodies[i];
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

  // --- The end --------------------------------------------------------------------------------------------------------

  void ended(const recorded::CastEnded& e) {
    const std::optional<Two> pair = e.pair.size() == 2 ? std::optional<Two>{{e.pair[0], e.pair[1]}} : std::nullopt;
    const bool meets = e.status == CastStatus::hit || e.status == CastStatus::initially_overlapping;
    if (pair ? !exists(*pair) : !e.pair.empty() || meets) return c.find("wrong-pair", "The cast ends with the pair " + list_of(e.pair) + (meets ? ", which is not of two bodies that meet." : ", which the scene does not have."));
    if (e.status == CastStatus::miss && pair) c.find("wrong-pair", "Nothing is met in the end, but the pair " + list_of(e.pair) + " is named.");
    const std::string status(word_of(e.status));
    if (responses == 0) return as_the_result(e, status);
    until(e.time);
    if (e.status == CastStatus::miss && e.time < 1 - 1e-9) c.find("wrong-time", "Nothing more is met, but the cast ends at time " + text_of(e.time) + ", not 1.");
    if (e.status == CastStatus::initially_overlapping) c.find("wrong-answer", "The cast ended as \"" + status + "\", after bodies have met and gone on.");
    if (e.status == CastStatus::hit && gap_at(*pair, e.time) > limit) c.find("wrong-time", "The cast ends at time " + text_of(e.time) + " where " + names_of(*pair) + " meet, but they are " + text_of(gap_at(*pair, e.time)) + " apart.");
    else if (e.status == CastStatus::hit && ours && responses < most_responses) c.find("inconsistent", "The cast ends at an impact that nothing responds to.", Finding::Severity::warning);
    double fastest = 0;
    for (const Body& body : scene.bodies) fastest = std::max(fastest, body.motion->velocity.norm());
    const auto moves = [&](const Body& body) { return body.motion->velocity.norm() > 1e-9 * fastest; };
    if (e.status == CastStatus::at_rest && std::any_of(bodies.begin(), bodies.end(), moves)) c.find("wrong-answer", "The cast ended as \"at_rest\", but bodies move.");
    ends_where_it_moved(e.time);
  }

  void as_the_result(const recorded::CastEnded& e, const std::string& status) const {
    const std::vector<int> pair = result.pair ? std::vector<int>{(*result.pair)[0], (*result.pair)[1]} : std::vector<int>();
    if (status != result.status) c.find("wrong-answer", "The cast ended as \"" + status + "\", but the result says \"" + result.status.text() + "\".");
    else if (result.time && std::abs(*result.time - e.time) > 1e-9) c.find("wrong-time", "The cast ended at time " + text_of(e.time) + ", but the result says " + text_of(*result.time) + ".");
    else if (pair != e.pair && e.status != CastStatus::iteration_limit) c.find("wrong-pair", "The pair of the cast's end is not that of the result.");
  }

  /// After the last response bodies go straight on, unless they turn, and end as they moved then.
  void ends_where_it_moved(double end) const {
    if (!last_state || !result.bodies) return;
    const bool as_many = last_state->bodies.size() == result.bodies->size() && result.bodies->size() == bodies.size();
    for (std::size_t i = 0; as_many && i < bodies.size(); ++i) {
      const auto& left = last_state->bodies[i];
      const FinalState& to = (*result.bodies)[i];
      if ((to.velocity - left.velocity).norm() > 1e-9 * left.velocity.norm()) c.find("wrong-state", "Body " + std::to_string(i) + " ends with the velocity " + text_of(to.velocity) + ", but left its last impact with " + text_of(left.velocity) + ".");
      turned(i, to.orientation, to.angular_velocity, moved(scene.bodies[i], end, scene.dimension), end);
      const AnyVector expected = left.position + (end - last_state->time) * left.velocity;
      if ((to.position - expected).norm() > limit) c.find("wrong-state", "Body " + std::to_string(i) + " ends at " + text_of(to.position) + ", expected " + text_of(expected) + ".");
    }
    if (!as_many) c.find("wrong-state", "The result has " + std::to_string(result.bodies->size()) + " bodies, the last state " + std::to_string(last_state->bodies.size()) + ".");
  }
};

}  // namespace

void check_cast_steps(CheckContext& c) { CastWalk(c).run(); }

}  // namespace gjkdbg
