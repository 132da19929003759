// Linked twice by trace_cost_test.py, with either `measured` of untraced.cpp.
//   driver count N   N times over every pair untraced
//   driver time N    nanoseconds an event: N times over every pair traced to a sink that only counts, less the same untraced
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/trace_cost/pairs.h"

namespace gjkdbg {
namespace {

class Counting final : public SinkTaking<Counting> {
 public:
  template <class Event>
  void take(const Event&) { ++events; }
  long events = 0;
};

double nanoseconds_an_event(std::vector<CostPair>& pairs, int rounds) {
  using Clock = std::chrono::steady_clock;
  Counting sink;
  double best_on = 1e300, best_off = 1e300;
  for (int attempt = 0; attempt < 5; ++attempt) {
    sink.events = 0;
    const auto begin = Clock::now();
    for (int i = 0; i < rounds; ++i)
      for (CostPair& p : pairs) {
        TraceNumbers numbers;
        const WorkingFrame<3, double> frame(p.scene.bodies[0].pose, p.a.reference(), 1);
        WorldTrace<3, double> trace(frame, numbers, sink);
        (void)once(p, trace);
      }
    const auto middle = Clock::now();
    (void)measured(pairs, rounds);
    best_on = std::min(best_on, std::chrono::duration<double, std::nano>(middle - begin).count());
    best_off = std::min(best_off, std::chrono::duration<double, std::nano>(Clock::now() - middle).count());
  }
  return (best_on - best_off) / static_cast<double>(sink.events);
}

}  // namespace
}  // namespace gjkdbg

int main(int argc, char** argv) {
  using namespace gjkdbg;
  if (argc != 3) return 2;
  const int rounds = std::atoi(argv[2]);
  RandomScenes random(5);
  std::vector<CostPair> pairs;
  for (int k = 0; k < 60; ++k) pairs.emplace_back(random.scene(3, static_cast<Family>(k % family_count), k % 2 == 0));
  if (std::strcmp(argv[1], "count") == 0) return measured(pairs, rounds) == 0.125;
  std::printf("%.1f\n", nanoseconds_an_event(pairs, rounds));
}
