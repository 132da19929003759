// The pairs that trace_cost_test.py measures on.
#pragma once

#include <vector>

#include "algo/solve_pair.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {

struct CostPair {
  Scene scene;
  Convex<3, double> a, b;
  Settings settings;
  explicit CostPair(const Scene& s) : scene(s), a(s.bodies[0].shape), b(s.bodies[1].shape), settings(resolve_settings({}, s)) {}
};

template <class Trace>
double once(CostPair& p, Trace& trace) {
  return *PairSolver<3, double, Trace>(p.a, p.b, p.scene.bodies[0].pose, p.scene.bodies[1].pose, 1, p.settings, trace).run(Query::penetration).signed_distance;
}

/// Every pair untraced, `rounds` times; the sum of the answers. Its instructions are counted.
double measured(std::vector<CostPair>& pairs, int rounds);

}  // namespace gjkdbg
