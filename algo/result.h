// The answer to a query, in world coordinates.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "algo/status.h"
#include "shapes/vector.h"

namespace gjkdbg {

/// A body at the end of a cast or a simulation: the orientation a quaternion w x y z, the velocity that of its pose's position, the angular velocity in degrees
/// per unit of time (3 numbers, in the plane 1, on a line none), as in BodyState of algo/motion_events.h.
struct FinalState {
  AnyVector position;
  std::vector<double> orientation;
  AnyVector velocity;
  std::vector<double> angular_velocity;
};

struct ContactPoint {
  AnyVector point_a, point_b;  ///< on body 0 and body 1, world frame
  double depth = 0;            ///< >= 0: how far point_b lies behind point_a along the normal
};

/// What is unset was not asked for, or does not exist (the normal of an overlapping `distance` query).
/// `witness_b - witness_a = signed_distance * normal`; the bounds enclose `signed_distance` (of a `distance`
/// query: max(0, signed distance)).
struct Result {
  Result() {}  // not constexpr: a compiler then fills all of it with zeros, a tenth of the time that two rectangles take

  bool intersecting = false;  ///< of a cast: they meet; of a simulation: whether its last step has contacts; means nothing where `unanswered`
  std::optional<double> signed_distance;
  std::optional<AnyVector> normal;  ///< unit, from body 0 towards body 1
  std::optional<AnyVector> witness_a, witness_b;
  std::optional<double> lower_bound, upper_bound;
  std::optional<std::vector<ContactPoint>> contacts;
  // Of a cast: the bodies are surely apart until `time` and surely touch at `touching_at` (unset when they graze by less than can be told);
  // normal and witnesses are those at `time`, of bodies that meet; unset where they overlap at the beginning and the search for the way out came to
  // its limit. Of a simulation: the time reached.
  std::optional<double> time, touching_at;
  std::optional<std::array<int, 2>> pair;           ///< the bodies that meet
  std::optional<std::vector<FinalState>> bodies;    ///< after responses, or at the end of a simulation
  std::optional<double> energy;                     ///< of a simulation, at the end
  StatusWord status;  ///< of the phase that gave the answer, of a mesh the nearest triangle's ("iteration_limit" where another that came to its limit may be nearer); "aborted": there is none, `intersecting` means nothing
  int iterations = 0;
  int support_calls = 0;  ///< all of them, those outside the trace too
};

/// Whether there is neither a yes nor a no: a limit came first, and what is known leaves both open. `intersecting` is false then, and means nothing.
inline bool unanswered(const Result& r) { return r.status == "aborted" || (r.status == "iteration_limit" && !r.intersecting && !(r.lower_bound && *r.lower_bound > 0)); }

}  // namespace gjkdbg
