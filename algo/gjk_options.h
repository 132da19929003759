// What GJK is asked, and how.
#pragma once

#include <span>
#include <type_traits>

#include "algo/minkowski_difference.h"
#include "algo/settings.h"

namespace gjkdbg {

/// What the caller needs to know; the loop ends as soon as it is known.
enum class GjkGoal {
  intersect,       ///< whether the bodies overlap: ends at the first proof
  distance,        ///< the distance, or that the bodies overlap
  signed_distance  ///< the distance of the cores, however the radii compare with it
};

template <int D, class S>
struct GjkOptions {
  GjkGoal goal = GjkGoal::signed_distance;
  /// The tolerance for a yes or no, however coarse the one that is asked for.
  static constexpr S decisive = std::is_same_v<S, double> ? S(1e-10) : S(1e-4);
  S tolerance = S(1e-12);  ///< relative gap of the bounds at which the loop ends
  int max_iterations = 512;
  Vector<D, S> direction = Vector<D, S>::Unit(0);  ///< first search direction, not zero
  bool accelerated = false;  ///< directions other than -v, until they no longer help
  bool normalised = false;   ///< both bodies are polytopes: momentum is of unit vectors (Montaut et al. 2024), and Newton's directions are not tried
  Acceleration acceleration = Acceleration::nesterov;
  Stopping stopping = Stopping::bounds;
  std::span<const SupportPoint<D, S>> kept{};  ///< the simplex to begin with instead of the direction's support; at most D + 1
};

}  // namespace gjkdbg
