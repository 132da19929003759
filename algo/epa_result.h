// What EPA is told, what it answers, and the storage it works in.
#pragma once

#include <array>
#include <vector>

#include "algo/polytope.h"
#include "algo/trace.h"

namespace gjkdbg {

template <class S>
struct EpaOptions {
  S tolerance = S(1e-12);  ///< relative gap of the bounds at which the loop ends
  int max_iterations = 512;
};

template <int D, class S>
struct EpaResult {
  EpaStatus status = EpaStatus::converged;
  int iterations = 0;
  int face = -1;                              ///< number of the answering face; -1 where the difference is flat: status flat, or separated by its plane
  Vector<D, S> normal = Vector<D, S>::Zero();  ///< unit, out of the difference: from body 0 towards body 1
  S depth = 0;             ///< of the cores: support along `normal`; negative when `separated`
  S lower_bound = 0;       ///< of the cores' depth
  S upper_bound = 0;
  Vector<D, S> point_a = Vector<D, S>::Zero(), point_b = Vector<D, S>::Zero();  ///< core points, a - b nearest to depth * normal; zero where `face` is -1: GJK's simplex has them
};

/// Storage that may be kept from one call to the next.
template <int D, class S>
struct EpaWorkspace {
  Polytope<D, S> polytope;
  std::vector<int> numbers;                                    ///< scratch for the trace
  std::vector<FaceEvent<Vector<D, S>, Viewed>> face_events;
  std::vector<std::array<int, D>> face_vertices;
  std::vector<Edge> edges;
};

}  // namespace gjkdbg
