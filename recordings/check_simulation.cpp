// check, simulation: what a simulation may not do, whoever computed it.
#include <Eigen/Geometry>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "algo/motion.h"
#include "recordings/check_context.h"
#include "recordings/free_spin.h"
#include "recordings/simulated_bodies.h"

namespace gjkdbg {
namespace {

using V3 = Eigen::Vector3d;
using M3 = Eigen::Matrix3d;

struct SimulationCheck : SimulatedBodies {
  CheckContext& c;

  explicit SimulationCheck(CheckContext& context) : SimulatedBodies(context.recording.scene.scene), c(context) {}

  bool exists(const Edge& pair) const {
    const int n = static_cast<int>(scene.bodies.size());
    return pair[0] != pair[1] && std::min(pair[0], pair[1]) >= 0 && std::max(pair[0], pair[1]) < n;
  }

  /// What momenta and energies are let off by where they cancel. (Lengths are of about 1: see check_units.cpp.)
  double least() const {
    double heaviest = 0;
    for (const Body& body : scene.bodies) heaviest = std::max(heaviest, body.motion->is_static ? 0 : body.motion->mass);
    return 1e-12 * std::min(1.0, heaviest);
  }

  /// What the integrator may add to the spins' energy in a step: bodies turn with the angular momentum that the impulses leave.
  double gained_by_spin(const recorded::State& before, const recorded::State& now) const {
    double sum = 0;
    if (scene.dimension < 3 || now.bodies.size() != scene.bodies.size() || before.bodies.size() != scene.bodies.size()) return 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (!of(i).is_static) sum += spin_gain(moving(before, i).rotation, inertia(i), angular_momentum(moving(now, i), i), motion.time_step, motion.integrator);
    return sum;
  }

  /// As many digits as it takes to tell two numbers apart.
  static std::pair<std::string, std::string> told_apart(double x, double y) {
    char one[40], other[40];
    for (int digits = 6; digits <= 17; ++digits) {
      std::snprintf(one, sizeof one, "%.*g", digits, x), std::snprintf(other, sizeof other, "%.*g", digits, y);
      if (std::string_view(one) != other) break;
    }
    return {one, other};
  }

  /// In a step of length h the semi-implicit rule takes v' = v + h g and x' = x + h v': the energy H = m v^2 / 2 - m g . x changes by -m h g . (v' - v) / 2, so that
  /// H + h g . P / 2, with P = m v, stays as it is. So does a bounce that turns v back in the middle of the fall: by j n with j = 2 (u - r), u = -v . n and
  /// r = -h g . n / 2, it changes m v^2 / 2 by -m j r, h g . P / 2 by as much and the place, by h j n, -m g . x by 2 m j r. H alone jumps by up to m |g| h |v|. (Hairer,
  /// Lubich, Wanner, "Geometric Numerical Integration", IX: the modified energy.) Explicit Euler gains what it gains in flight, m (g h)^2 / 2 a step, and nothing in a bounce.
  double kept_energy(const recorded::State& state) const {
    const double share = motion.integrator == Integrator::semi_implicit_euler ? 0.5 : 0;
    return state.energy + share * motion.time_step * gravity.dot(in_space(state.momentum));
  }

  /// Over a step the energy that the integrator keeps may change by what its order leaves, of the fall m (g h)^2 a body and of the spin what free_spin.h bounds, and restitution
  /// only takes. Bodies inside each other are put apart, which may lift them by as much as they are deep.
  void states() const {
    const SceneMotion& m = motion;
    double fall = 0, total = 0;
    bool walls = false;
    for (const Body& body : scene.bodies) {
      if (body.motion->is_static) walls = true;
      else fall += body.motion->mass * m.gravity.squaredNorm() * m.time_step * m.time_step, total += body.motion->mass;
    }
    const recorded::State* before = nullptr;
    bool touched = false;
    double deepest = 0;
    for (std::size_t i = 0; i < c.recording.events.size(); ++i) {
      const Event& event = c.recording.events[i];
      c.step = i;
      if (const auto* contact = std::get_if<recorded::ContactFound>(&event)) {
        touched = true, deepest = std::max(deepest, contact->depth);
        if (exists(contact->pair)) sinking(*contact);
      }
      const auto* now = std::get_if<recorded::State>(&event);
      if (!now) continue;
      if (before) {
        const double speed = std::sqrt(std::max(0.0, 2 * std::abs(before->energy) * std::max(total, 1e-300)));
        const double from = kept_energy(*before), to = kept_energy(*now);
        const double most = from + 4 * fall + 1e-6 * std::abs(before->energy) + (touched ? m.gravity.norm() * total * (0.01 * c.size + deepest) : 0);
        if (const auto [was, is] = told_apart(from, to); !(to <= most) && !(to <= most + gained_by_spin(*before, *now)))
          c.find("energy-gained", "Energy rose from " + was + " to " + is + " between times " + text_of(before->time) + " and " + text_of(now->time) + (m.integrator != Integrator::semi_implicit_euler || m.gravity.isZero(0) ? "." : ", with h g . P / 2, of which this integrator keeps the sum."));
        const AnyVector expected = before->momentum + total * m.time_step * m.gravity;
        if (!(walls && touched) && !((now->momentum - expected).stableNorm() <= 1e-9 * (speed + total * m.gravity.norm() * m.time_step) + least()))
          c.find("momentum-lost", "Momentum went from " + text_of(before->momentum) + " to " + text_of(now->momentum) + ", expected " + text_of(expected) + ": nothing but gravity acts on these bodies from outside.");
      }
      before = now;
      touched = false, deepest = 0;
    }
  }

  void sinking(const recorded::ContactFound& contact) const {
    double size = 1e300;
    for (const auto i : {static_cast<std::size_t>(contact.pair[0]), static_cast<std::size_t>(contact.pair[1])}) size = std::min(size, reach_of(scene.bodies[i].shape, scene.dimension, mass[i].center));
    if (contact.depth > 0.5 * size)
      c.find("sinking", "Body " + std::to_string(contact.pair[1]) + " has sunk " + text_of(contact.depth) + " into body " + std::to_string(contact.pair[0]) + ", more than half its size: the time step is too long for its speed, nothing holds it, or it began there.", Finding::Severity::warning);
  }

  void walk() {
    const recorded::State* before = nullptr;
    std::vector<const recorded::ContactFound*> contacts;
    std::vector<const recorded::ImpulseApplied*> impulses;
    std::vector<std::size_t> touching;
    std::size_t first_impulse = 0;
    int states = 0;
    bool touched = false;
    for (std::size_t i = 0; i < c.recording.events.size(); ++i) {
      c.step = i;
      const Event& event = c.recording.events[i];
      const auto* contact = std::get_if<recorded::ContactFound>(&event);
      const auto* impulse = std::get_if<recorded::ImpulseApplied>(&event);
      if ((contact && !exists(contact->pair)) || (impulse && !exists(impulse->pair))) return c.find("wrong-pair", "The scene has no such pair of bodies.");
      if (contact) contacts.push_back(contact);
      if (impulse && impulses.empty()) first_impulse = i;
      if (impulse) impulses.push_back(impulse);
      if (contact || impulse) touching.push_back(i);
      const auto* now = std::get_if<recorded::State>(&event);
      if (!now) continue;
      if (now->bodies.size() != scene.bodies.size()) return c.find("wrong-state", "There are " + std::to_string(now->bodies.size()) + " bodies; the scene has " + std::to_string(scene.bodies.size()) + ".");
      const double time = states++ * motion.time_step;
      if (std::abs(now->time - time) > 1e-9 * (1 + time)) c.find("wrong-time", "State " + std::to_string(states - 1) + " is at time " + text_of(now->time) + ", expected " + text_of(time) + ".");
      oriented(*now, before);
      sums(*now);
      if (before) advance(*before, *now, contacts, impulses, first_impulse), touches(*before, *now, touching);
      touched = !contacts.empty();
      contacts.clear(), impulses.clear(), touching.clear();
      before = now;
    }
    if (before) result(*before, states, touched);
  }

  /// Every body is turned by some quaternion of length 1, and what is static stays as the scene has it.
  void oriented(const recorded::State& state, const recorded::State* before) const {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const std::vector<double>& q = state.bodies[i].orientation;
      const std::string who = "Body " + std::to_string(i) + " at time " + text_of(state.time) + " ";
      double squared = 0;
      for (const double x : q) squared += x * x;
      if (q.size() != 4 || !(std::abs(squared - 1) <= 1e-6)) return c.find("wrong-state", who + "has no orientation: that is a quaternion of length 1.");
      const std::vector<double>& spin = state.bodies[i].angular_velocity;
      const std::size_t axes = scene.dimension == 3 ? 3 : scene.dimension == 2 ? 1 : 0;
      if (spin.size() != axes) return c.find("wrong-state", who + "has an angular velocity of " + std::to_string(spin.size()) + " numbers; in " + std::to_string(scene.dimension) + "D it has " + std::to_string(axes) + ".");
      const bool turns = std::any_of(spin.begin(), spin.end(), [](double x) { return x != 0; });
      if (of(i).is_static && (turns || !state.bodies[i].velocity.isZero(0))) return c.find("wrong-state", who + "moves, though it is static.");
      const M3 own = moving(state, i).rotation;
      const AnyMatrix first = own.topLeftCorner(scene.dimension, scene.dimension);
      const bool fixed = !before || of(i).is_static;
      if (fixed && (first - scene.bodies[i].pose.matrix).norm() > 1e-6) return c.find("wrong-state", who + "is not turned as in the scene, " + (before ? "though it is static." : "at the beginning."));
      if (fixed && (state.bodies[i].position - scene.bodies[i].pose.position).norm() > 1e-9 * c.size + c.tolerance) return c.find("wrong-state", who + "is at " + text_of(state.bodies[i].position) + "; the scene has it at " + text_of(scene.bodies[i].pose.position) + ".");
      if (fixed) continue;
      // It turns at a speed between that before and that after the step, or one that a step of the torque-free motion comes through.
      const Moving was = moving(*before, i), is = moving(state, i);
      const double turned = Eigen::AngleAxisd(is.rotation * was.rotation.transpose()).angle(), most = 2 * motion.time_step * (was.spin.norm() + is.spin.norm()) + 1e-6;
      if (turned > most) return c.find("wrong-state", who + "has turned by " + text_of(turned * 180 / M_PI) + " degrees in a step, faster than it turns before or after.");
    }
  }

  /// Energy and momentum are what places and velocities make them.
  void sums(const recorded::State& state) {
    const SumsOfMotion right = sums_of(state);
    if (!std::isfinite(right.energy_scale) || !(std::abs(state.energy - right.energy) <= 1e-6 * right.energy_scale + least())) c.find("wrong-state", "The energy is given as " + text_of(state.energy) + "; places and velocities make it " + text_of(right.energy) + ".");
    if (!((in_space(state.momentum) - right.momentum).stableNorm() <= 1e-9 * right.momentum_scale + least())) c.find("wrong-state", "The momentum is given as " + text_of(state.momentum) + "; the velocities make it " + text_of(AnyVector(right.momentum)) + ".");
  }

  /// A contact is where both bodies are, at the time of the step, and its impulse pushes along its normal: apart.
  /// `steps`: between the two states.
  void touches(const recorded::State& before, const recorded::State& now, const std::vector<std::size_t>& steps) const {
    std::vector<const recorded::ContactFound*> contacts;
    double deepest = 0;  // a contact lies half-way between a point of the one and one of the other
    for (const std::size_t step : steps)
      if (const auto* contact = std::get_if<recorded::ContactFound>(&c.recording.events[step])) deepest = std::max(deepest, contact->depth);
    const auto judge = [&](const auto& e, const char* what) {
      const double h = motion.time_step;
      if (std::min(std::abs(e.time - before.time), std::abs(e.time - now.time)) > 1e-9 * (1 + now.time)) return c.find("wrong-time", std::string(what) + " is at time " + text_of(e.time) + " in the step from " + text_of(before.time) + " to " + text_of(now.time) + ".");
      for (const int k : e.pair) {
        const auto i = static_cast<std::size_t>(k);
        const double off = std::min((e.point - before.bodies[i].position).norm(), (e.point - now.bodies[i].position).norm());
        const double reach = reach_of(scene.bodies[i].shape, scene.dimension), moves = 2 * h * (before.bodies[i].velocity.norm() + now.bodies[i].velocity.norm());
        if (const std::string length = c.not_unit(e.normal, std::string(what) + "'s normal"); !length.empty()) return c.find("wrong-normal", length);
        if (off > reach + deepest / 2 + moves + 1e-6 * c.size + c.world) return c.find("wrong-contact", std::string(what) + " is at " + text_of(e.point) + ", " + text_of(off) + " from body " + std::to_string(k) + ", which reaches " + text_of(reach) + ".");
      }
    };
    const std::size_t here = c.step;
    apart(before, steps);
    for (const std::size_t step : steps) {
      c.step = step;
      if (const auto* contact = std::get_if<recorded::ContactFound>(&c.recording.events[step])) {
        judge(*contact, "A contact"), contacts.push_back(contact);
        if (!of_mesh(contact->pair)) check_contact(c, pair_at(before, contact->pair), *contact);
      }
      const auto* e = std::get_if<recorded::ImpulseApplied>(&c.recording.events[step]);
      if (!e) continue;
      judge(*e, "An impulse");
      const bool found = std::any_of(contacts.begin(), contacts.end(), [&](const auto* contact) { return contact->pair == e->pair && contact->point == e->point; });
      if (!found && !foreign(c.recording)) c.find("wrong-contact", "An impulse is at " + text_of(e->point) + ", where bodies " + std::to_string(e->pair[0]) + " and " + std::to_string(e->pair[1]) + " have no contact in this step.");
      if (e->impulse.dot(e->normal) < -1e-9 * e->impulse.norm()) c.find("flipped-normal", "The impulse " + text_of(e->impulse) + " on body " + std::to_string(e->pair[1]) + " leads against its normal " + text_of(e->normal) + ": impulses push the second body along the normal, away from the first.");
      for (const auto* contact : contacts)
        if (contact->pair == e->pair && contact->point == e->point && (contact->normal - e->normal).norm() > 1e-9) c.find("wrong-normal", "The impulse at " + text_of(e->point) + " has the normal " + text_of(e->normal) + ", its contact " + text_of(contact->normal) + ".");
    }
    c.step = here;
  }

  bool of_mesh(const Edge& pair) const {
    return std::any_of(pair.begin(), pair.end(), [&](int i) { return std::holds_alternative<Mesh>(scene.bodies[static_cast<std::size_t>(i)].shape.geometry); });
  }

  /// Two bodies where a state has them.
  Scene pair_at(const recorded::State& state, const Edge& pair) const {
    Scene two;
    two.dimension = scene.dimension;
    two.query = Query::penetration;
    for (const int k : pair) {
      const auto i = static_cast<std::size_t>(k);
      Body body = scene.bodies[i];
      body.motion.reset();
      body.pose.position = state.bodies[i].position, body.pose.matrix = moving(state, i).rotation.topLeftCorner(scene.dimension, scene.dimension);
      body.pose.rotation = RotationMatrix{body.pose.matrix};
      two.bodies.push_back(std::move(body));
    }
    return two;
  }

  /// The deepest contact of two bodies is as deep as they overlap along its normal, from the first to the second, at the state before. Along a
  /// flipped one the overlap is what is left of both widths.
  void apart(const recorded::State& before, const std::vector<std::size_t>& steps) const {
    std::map<std::vector<int>, std::pair<std::size_t, const recorded::ContactFound*>> deepest;
    for (const std::size_t step : steps)
      if (const auto* contact = std::get_if<recorded::ContactFound>(&c.recording.events[step])) {
        const auto [found, first] = deepest.try_emplace({contact->pair[0], contact->pair[1]}, step, contact);
        if (!first && contact->depth > found->second.second->depth) found->second = {step, contact};
      }
    for (const auto& [pair, found] : deepest) {
      const auto& [step, contact] = found;
      if (const RunEnds ends = ends_before(c, step); ends.gjk_at_limit || ends.epa_at_limit || of_mesh({pair[0], pair[1]})) continue;  // after a limit the depth is what is proven, and no more
      const Scene two = pair_at(before, {pair[0], pair[1]});
      const WorldSupport a(two.bodies[0], scene.dimension), b(two.bodies[1], scene.dimension);
      const AnyVector& n = contact->normal;
      const double overlap = n.dot(a(n, true) - b(-n, true)), behind = n.dot(b(n, true) - a(-n, true));
      c.step = step;
      const double world = rounding_in_the_world(two);
      if (std::abs(behind - contact->depth) + 1e-6 * c.size + world < std::abs(overlap - contact->depth))
        c.find("flipped-normal", "Along the normal " + text_of(n) + " of the contact of bodies " + std::to_string(pair[0]) + " and " + std::to_string(pair[1]) + " they overlap by " + text_of(overlap) + ", against it by " + text_of(behind) + ", and the contact is " + text_of(contact->depth) + " deep: it leads from the second to the first.");
      else if (!foreign(c.recording) && !ends_before(c, step).gjk_at_limit && std::abs(overlap - contact->depth) > std::max({1e-6, 100 * c.digits(), c.stop}) * c.size + world)
        c.find("wrong-contact", "Along the normal " + text_of(n) + " bodies " + std::to_string(pair[0]) + " and " + std::to_string(pair[1]) + " overlap by " + text_of(overlap) + "; their contact is " + text_of(contact->depth) + " deep.");
    }
  }

  /// Velocities change by gravity and by the impulses, places by the velocities and by what contacts push apart.
  void advance(const recorded::State& before, const recorded::State& now, const std::vector<const recorded::ContactFound*>& contacts, const std::vector<const recorded::ImpulseApplied*>& impulses, std::size_t first_impulse) {
    const double h = motion.time_step;
    const bool falls_last = motion.integrator == Integrator::explicit_euler;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Moving from = moving(before, i), to = moving(now, i);
      const int number = static_cast<int>(i);
      const bool fixed = of(i).is_static;
      V3 change = fixed ? V3(V3::Zero()) : V3(gravity * h);
      double push = 0;
      bool touched = false;
      for (const auto* e : contacts)
        if (e->pair[0] == number || e->pair[1] == number) push += std::abs(e->depth), touched = true;
      double speed = from.velocity.norm() + to.velocity.norm() + change.norm();
      for (const auto* e : impulses)
        if (!fixed && (e->pair[0] == number || e->pair[1] == number)) {
          const V3 one = in_space(e->impulse) / of(i).mass;
          change += e->pair[1] == number ? one : V3(-one), speed += one.norm();
        }
      const double slack = 1e-9 * speed + 1e-14;
      const V3 gained = to.velocity - from.velocity;
      if (!((gained - change).norm() <= slack) || !std::isfinite(slack))
        c.find("wrong-state", "Body " + std::to_string(i) + " changes its velocity by " + text_of(AnyVector(gained)) + " in the step to time " + text_of(now.time) + "; gravity and impulses make that " + text_of(AnyVector(change)) + ".");
      const V3 used = falls_last && !fixed ? V3(to.velocity - gravity * h) : to.velocity;
      double off = (to.place - from.place - h * used).norm();
      if (motion.integrator == Integrator::rk4 && !fixed) {  // in flight by the middle of the fall's velocities; what touches may rest or fly
        const double flown = (to.place - from.place - h * (used - gravity * (h / 2))).norm();
        off = touched ? std::min(off, flown) : flown;
      }
      if (off > (fixed ? 0 : push) + 1e-9 * (speed * h + c.size) + 1e-12 * from.place.norm())
        c.find("wrong-state", "Body " + std::to_string(i) + " is " + text_of(off) + " from where its velocity takes it by time " + text_of(now.time) + ".");
      if (!fixed && !touched && !foreign(c.recording)) keeps_spinning(from, to, i, now.time);
      for (const auto* e : impulses) {
        if (e->pair[0] != number && e->pair[1] != number) continue;
        const std::size_t which = e->pair[0] == number ? 0 : 1;
        if (e->velocities_before.size() != 2 || e->velocities_after.size() != 2) continue;
        const V3 fall = fixed ? V3(V3::Zero()) : V3(gravity * h);
        const V3 came = falls_last ? from.velocity : V3(from.velocity + fall), went = falls_last ? V3(to.velocity - fall) : to.velocity;
        if ((in_space(e->velocities_before[which]) - came).norm() <= slack && (in_space(e->velocities_after[which]) - went).norm() <= slack) continue;
        const std::size_t here = std::exchange(c.step, first_impulse);
        c.find("wrong-state", "The velocities of body " + std::to_string(i) + " before and after its impulse are not those of the states: " + text_of(AnyVector(came)) + " and " + text_of(AnyVector(went)) + ".");
        c.step = here;
      }
    }
  }

  /// Angular momentum is what nothing changes in flight; the angular velocity follows from it and from how the body is turned. Of a body without extent across an axis the velocity does
  /// not tell the momentum along that, which a contact half its depth beside it gives: as the axis turns it comes to light.
  void keeps_spinning(const Moving& from, const Moving& to, std::size_t i, double time) const {
    const V3 was = angular_momentum(from, i), is = angular_momentum(to, i);
    const V3 moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia(i), Eigen::EigenvaluesOnly).eigenvalues();
    if (moments[0] <= 1e-12 * moments[2]) return;
    const double scale = inertia(i).norm() * (from.spin.norm() + to.spin.norm());
    if ((is - was).norm() > 1e-9 * scale + 1e-14)
      c.find("momentum-lost", "The angular momentum of body " + std::to_string(i) + " went from " + text_of(AnyVector(was)) + " to " + text_of(AnyVector(is)) + " in the step to time " + text_of(time) + ", though nothing touched it.");
  }

  bool ran_to_its_end() const { return c.recording.result.status == "completed" || c.recording.result.status == "contact_unknown"; }

  /// Where no method asks for more than it tells, all supports are steps.
  void counts() {
    const Settings& s = c.recording.settings;
    const auto supports = std::count_if(c.recording.events.begin(), c.recording.events.end(), [](const Event& e) { return std::holds_alternative<recorded::SupportQueried>(e); });
    if (foreign(c.recording) || !ran_to_its_end() || s.penetration != Penetration::epa || s.name == MethodName::mpr || s.name == MethodName::sat) return;
    if (c.recording.result.support_calls != supports)
      c.find("inconsistent", "The result counts " + std::to_string(c.recording.result.support_calls) + " support calls, but " + std::to_string(supports) + " were made.", Finding::Severity::warning);
  }

  /// The result is the last state.
  void result(const recorded::State& last, int states, bool touched) {
    const Result& r = c.recording.result;
    c.step = c.recording.events.size() - 1;
    if (ran_to_its_end() && states != motion.steps + 1) c.find("wrong-time", std::to_string(states) + " states are recorded; " + std::to_string(motion.steps) + " steps make " + std::to_string(motion.steps + 1) + ".");
    if (r.time && std::abs(*r.time - last.time) > 1e-9 * (1 + last.time)) c.find("wrong-time", "The result is of time " + text_of(*r.time) + ", the last state of " + text_of(last.time) + ".");
    if (r.energy && std::abs(*r.energy - last.energy) > 1e-9 * std::abs(last.energy) + least()) c.find("wrong-state", "The result's energy is " + text_of(*r.energy) + ", the last state's " + text_of(last.energy) + ".");
    if (r.intersecting != touched) c.find("wrong-answer", std::string("intersecting is ") + (r.intersecting ? "true" : "false") + ", but the last step had " + (touched ? "contacts." : "none."));
    if (!r.bodies) return;
    bool same = r.bodies->size() == last.bodies.size();
    for (std::size_t i = 0; same && i < last.bodies.size(); ++i) {
      const FinalState& x = (*r.bodies)[i];
      const recorded::BodyState& y = last.bodies[i];
      same = (x.position - y.position).norm() <= 1e-9 * (c.size + y.position.norm()) && (x.velocity - y.velocity).norm() <= 1e-9 * y.velocity.norm() + 1e-14;
      same = same && near(x.orientation, y.orientation) && near(x.angular_velocity, y.angular_velocity);
    }
    if (!same) c.find("wrong-state", "The bodies of the result are not where the last state has them, or do not move as it says.");
  }

  static bool near(const std::vector<double>& x, const std::vector<double>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](double p, double q) { return std::abs(p - q) <= 1e-9 * (1 + std::abs(q)); });
  }
};

}  // namespace

void check_simulation(CheckContext& c) {
  SimulationCheck judge(c);
  judge.walk();
  check_limits(c);
  judge.states();
  judge.counts();
}

}  // namespace gjkdbg
