// The events of bodies that move: cast and simulate.
#pragma once

#include "algo/event.h"

namespace gjkdbg {

// World frame. Every run of GJK and EPA nests inside its step.

/// The pairs of bodies that move against each other.
template <class V, class Store>
struct CastBegan {
  static constexpr std::string_view kind = "cast_began";
  ListOf<Store, Edge> pairs;
  static constexpr auto fields() { return std::tuple(field("pairs", &CastBegan::pairs)); }
};

/// At `time` the pair is `distance` apart along `normal`, and its bodies come nearer by at most `bound` per unit of time: until
/// time + distance / bound they cannot meet. World frame; the time is of the whole cast, 0 to 1. Of a ray cast `distance` is that of the plane just found.
template <class V, class Store>
struct CastAdvanced {
  static constexpr std::string_view kind = "cast_advanced";
  int iteration = 0;
  double time = 0;
  Edge pair{};
  double distance = 0;
  V normal;
  double bound = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &CastAdvanced::iteration), field("time", &CastAdvanced::time), field("pair", &CastAdvanced::pair),
                      field("distance", &CastAdvanced::distance), field("normal", &CastAdvanced::normal), field("bound", &CastAdvanced::bound));
  }
};

/// `pair` holds the two bodies that meet, of a ray cast at its limit those it stopped at, else nothing.
template <class V, class Store>
struct CastEnded {
  static constexpr std::string_view kind = "cast_ended";
  int iteration = 0;
  CastStatus status = CastStatus::miss;
  double time = 0;
  ListOf<Store, int> pair;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &CastEnded::iteration), field("status", &CastEnded::status), field("time", &CastEnded::time),
                      field("pair", &CastEnded::pair));
  }
};

/// Where a body is and how it moves; `velocity` is that of its pose's position. `orientation`: quaternion w x y z (in the plane about z). `angular_velocity`: degrees a unit of time, 3 numbers
/// (in the plane one, on a line none).
template <class V, class Store>
struct BodyState {
  V position;
  ListOf<Store, double> orientation;
  V velocity;
  ListOf<Store, double> angular_velocity;
  static constexpr auto fields() {
    return std::tuple(field("position", &BodyState::position), field("orientation", &BodyState::orientation),
                      field("velocity", &BodyState::velocity), field("angular_velocity", &BodyState::angular_velocity));
  }
};

/// All bodies at a time. `energy` (kinetic and of place) and `momentum` are those of the bodies that are not static; of a cast 0.
template <class V, class Store>
struct State {
  static constexpr std::string_view kind = "state";
  double time = 0;
  ListOf<Store, BodyState<V, Store>> bodies;
  double energy = 0;
  V momentum;
  static constexpr auto fields() {
    return std::tuple(field("time", &State::time), field("bodies", &State::bodies), field("energy", &State::energy),
                      field("momentum", &State::momentum));
  }
};

template <class V, class Store>
struct ContactFound {
  static constexpr std::string_view kind = "contact_found";
  double time = 0;
  Edge pair{};
  V point, normal;  ///< the normal points from the pair's first body to its second
  double depth = 0;
  static constexpr auto fields() {
    return std::tuple(field("time", &ContactFound::time), field("pair", &ContactFound::pair), field("point", &ContactFound::point),
                      field("normal", &ContactFound::normal), field("depth", &ContactFound::depth));
  }
};

/// Of a simulation: the second body gets `impulse` (mass times velocity) in the whole step, the first its opposite; the velocities are those of the centres of
/// mass, before the first and after the last impulse of the step, at all contacts. Of a cast's response, which knows no masses: `impulse` is the change of the
/// second body's velocity, zero where that body does not move, and the velocities are those of the poses' positions.
template <class V, class Store>
struct ImpulseApplied {
  static constexpr std::string_view kind = "impulse_applied";
  double time = 0;
  Edge pair{};
  V point, normal, impulse;
  ListOf<Store, V> velocities_before, velocities_after;
  static constexpr auto fields() {
    return std::tuple(field("time", &ImpulseApplied::time), field("pair", &ImpulseApplied::pair), field("point", &ImpulseApplied::point),
                      field("normal", &ImpulseApplied::normal), field("impulse", &ImpulseApplied::impulse),
                      field("velocities_before", &ImpulseApplied::velocities_before), field("velocities_after", &ImpulseApplied::velocities_after));
  }
};

}  // namespace gjkdbg
