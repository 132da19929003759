// Compiled twice by trace_cost_test.py: against the core as it is, and against a copy without its trace lines.
#include "tests/trace_cost/pairs.h"

namespace gjkdbg {

__attribute__((noinline)) double measured(std::vector<CostPair>& pairs, int rounds) {
  NoTrace trace;
  double sum = 0;
  for (int i = 0; i < rounds; ++i)
    for (CostPair& p : pairs) sum += once(p, trace);
  return sum;
}

}  // namespace gjkdbg
