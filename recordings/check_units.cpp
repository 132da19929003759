// check, scenes so small that squares of their lengths are zero, as those of 1e-200 are: they are judged in units of their own.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "recordings/check_context.h"
#include "recordings/simulated_bodies.h"
#include "shapes/convex.h"

namespace gjkdbg {
namespace {

/// Of lengths up to this products of four have lost nothing yet: 1e-240, and of parts a trillion times smaller they are numbers all the same.
constexpr double least_length = 1e-60;
/// Simulations are compared with more than lengths: momenta and energies, of which a millionth of a millionth is let pass. Of smaller bodies that would be all.
constexpr double least_simulated = 1e-3;
/// Energies are squares of lengths: of bodies smaller than this the file has few digits of them, or none.
constexpr double least_told = 1e-140;

/// Multiplies all lengths, and what is one per unit of time, by a power of two, which rounds nothing on the way up.
struct Lengths {
  double by;
  bool energies = true;  ///< those, too
  double longest = 0;    ///< so far

  void scale(double& x) {
    if (!std::isfinite(x)) return;  // not known, still
    x *= by, longest = std::max(longest, std::abs(x));
  }
  void scale(AnyVector& v) {
    for (double& x : v) scale(x);
  }
  void scale(std::vector<SimplexPoint>& simplex) {
    for (SimplexPoint& p : simplex) scale(p.a), scale(p.b);
  }
  template <class T>
  void scale(std::optional<T>& x) {
    if (x) scale(*x);
  }
  template <class T>
  void scale(std::vector<T>& list) {
    for (T& x : list) scale(x);
  }
  template <class E>
    requires requires { E::fields(); }
  void scale(E& e) {
    // A direction's length means nothing, and the rest are none. (What a cast calls energy and momentum is zero.)
    if constexpr (requires { e.energy; })
      if (energies) scale(e.energy), scale(e.energy);  // a square
    const auto none = [](std::string_view name) {
      for (const std::string_view other : {"direction", "normal", "barycentric", "time", "s", "t", "energy", "orientation", "angular_velocity"})
        if (name == other) return true;
      return false;
    };
    const auto one = [&](const auto& f) {
      if (!none(f.name)) scale(e.*f.member);
    };
    std::apply([&](const auto&... f) { (one(f), ...); }, E::fields());
  }
  template <class T>
  void scale(T&) {}  // numbers of things, words

  void scale(Body& body) {
    body.shape = scaled(body.shape, by);
    scale(body.pose.position);
    if (body.motion) scale(body.motion->velocity);
  }
  void scale(Scene& scene) {
    for (Body& body : scene.bodies) scale(body);
    if (scene.motion) scale(scene.motion->gravity);
  }
  void scale(Result& r) {
    scale(r.signed_distance), scale(r.lower_bound), scale(r.upper_bound), scale(r.witness_a), scale(r.witness_b);
    if (energies) scale(r.energy), scale(r.energy);
    if (r.contacts)
      for (ContactPoint& p : *r.contacts) scale(p.point_a), scale(p.point_b), scale(p.depth);
    if (r.bodies)
      for (FinalState& body : *r.bodies) scale(body.position), scale(body.velocity);
  }
};

/// The energies and momenta of such small bodies: those that are told as far as numbers go, which the file has lost, are put in again; any other stays, and is wrong.
/// A product that has lost its digits is off by the least number there is, times the factors still to come.
void restore_sums(Recording& recording, const Recording& written, double unit) {
  const SimulatedBodies bodies(recording.scene.scene);
  const std::size_t n = bodies.scene.bodies.size();
  double heavy = 1;
  for (std::size_t i = 0; i < n; ++i) heavy += bodies.of(i).is_static ? 0 : bodies.of(i).mass;
  const recorded::State* last = nullptr;
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    auto* state = std::get_if<recorded::State>(&recording.events[i]);
    if (!state || state->bodies.size() != n) continue;
    const auto& told = std::get<recorded::State>(written.events[i]);
    const SumsOfMotion right = bodies.sums_of(*state);
    double spin = 1;
    for (const recorded::BodyState& b : state->bodies)
      for (const double w : b.angular_velocity) spin += std::abs(w);
    const double lost = 1e6 * std::numeric_limits<double>::denorm_min() * heavy * spin;
    const bool same = std::abs(told.energy - right.energy * unit * unit) <= 1e-6 * right.energy_scale * unit * unit + lost;
    state->energy = same ? right.energy : told.energy;
    if (state->momentum.size() == bodies.scene.dimension && (in_space(told.momentum) - right.momentum * unit).cwiseAbs().maxCoeff() <= 1e-9 * right.momentum_scale * unit + lost)
      state->momentum = right.momentum.head(bodies.scene.dimension);
    last = state;
  }
  if (last && written.result.energy) recording.result.energy = std::abs(*written.result.energy - last->energy * unit * unit) <= 1e-6 * std::abs(last->energy) * unit * unit + 1e6 * std::numeric_limits<double>::denorm_min() * heavy ? last->energy : *written.result.energy;
}

}  // namespace

std::optional<InOtherUnits> in_units_of_its_own(const Recording& recording) {
  const Scene& scene = recording.scene.scene;
  double size = 0;
  for (const Body& body : scene.bodies) {
    size = std::max({size, size_of(body.shape), body.pose.position.cwiseAbs().maxCoeff()});
    if (body.motion && body.motion->velocity.size() > 0) size = std::max(size, body.motion->velocity.cwiseAbs().maxCoeff());
  }
  const bool simulated = scene.query == Query::simulate;
  if (simulated && scene.motion && scene.motion->gravity.size() > 0) size = std::max(size, scene.motion->gravity.cwiseAbs().maxCoeff() * scene.motion->time_step);
  if (size == 0 || size > (simulated ? least_simulated : least_length)) return std::nullopt;
  const int exponent = std::min(-std::ilogb(size), 1000);  // below the normal numbers 2^1000 is near enough, and a number
  InOtherUnits out{recording, std::ldexp(1.0, -exponent), exponent};
  const bool lost = simulated && scene.motion && size < least_told;
  Lengths lengths{1 / out.unit, !lost};
  lengths.scale(out.recording.scene.scene);
  lengths.scale(out.recording.settings.initial_simplex);
  for (Event& event : out.recording.events) std::visit([&](auto& e) { lengths.scale(e); }, event);
  lengths.scale(out.recording.result);
  if (lost) restore_sums(out.recording, recording, out.unit);
  return lengths.longest <= 1e75 ? std::optional(std::move(out)) : std::nullopt;  // else it is the recording that is wrong, and as it stands, too
}

Result CheckContext::once_more() const {
  Result result = solve(written.scene.scene, written.settings);
  Lengths{1 / unit, true}.scale(result);
  return result;
}

std::vector<Finding> told_in_units(std::vector<Finding> findings, const InOtherUnits& units) {
  for (Finding& f : findings) f.message += " (Lengths are told in units of " + text_of(units.unit) + ", 2 to the power of " + std::to_string(-units.exponent) + ": the scene is that small.)";
  return findings;
}

}  // namespace gjkdbg
