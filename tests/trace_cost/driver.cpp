// What trace_cost_test.py compiles twice: against the core as it is, and against a copy without its trace lines.
//   driver count N   N times over every pair untraced, in `measured`: the function whose instructions are counted
//   driver time N    nanoseconds an event: N times over every pair traced to a sink that only counts, less the same untraced
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "algo/solve_pair.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

class Counting final : public SinkTaking<Counting> {
 public:
  template <class Event>
  void take(const Event&) { ++events; }
  long events = 0;
};

struct Pair {
  Scene scene;
  Convex<3, double> a, b;
  Settings settings;
  explicit Pair(const Scene& s) : scene(s), a(s.bodies[0].shape), b(s.bodies[1].shape), settings(resolve_settings({}, s)) {}
};

template <class Trace>
double once(Pair& p, Trace& trace) {
  return *PairSolver<3, double, Trace>(p.a, p.b, p.scene.bodies[0].pose, p.scene.bodies[1].pose, 1, p.settings, trace).run(Query::penetration).signed_distance;
}

}  // namespace

__attribute__((noinline)) double measured(std::vector<Pair>& pairs, int rounds) {
  NoTrace trace;
  double sum = 0;
  for (int i = 0; i < rounds; ++i)
    for (Pair& p : pairs) sum += once(p, trace);
  return sum;
}

}  // namespace gjkdbg

int main(int argc, char** argv) {
  using namespace gjkdbg;
  if (argc != 3) return 2;
  const int rounds = std::atoi(argv[2]);
  RandomScenes random(5);
  std::vector<Pair> pairs;
  for (int k = 0; k < 60; ++k) pairs.emplace_back(random.scene(3, static_cast<Family>(k % family_count), k % 2 == 0));
  if (std::strcmp(argv[1], "count") == 0) return measured(pairs, rounds) == 0.125;
#ifdef TIMED
  Counting sink;
  double best_on = 1e300, best_off = 1e300;
  for (int attempt = 0; attempt < 5; ++attempt) {
    sink.events = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < rounds; ++i)
      for (Pair& p : pairs) {
        TraceNumbers numbers;
        const WorkingFrame<3, double> frame(p.scene.bodies[0].pose, p.a.reference(), 1);
        WorldTrace<3, double> trace(frame, numbers, sink);
        (void)once(p, trace);
      }
    const auto middle = std::chrono::steady_clock::now();
    (void)measured(pairs, rounds);
    best_on = std::min(best_on, std::chrono::duration<double, std::nano>(middle - begin).count());
    best_off = std::min(best_off, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - middle).count());
  }
  std::printf("%.1f\n", (best_on - best_off) / static_cast<double>(sink.events));
#endif
}
