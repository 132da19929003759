// From how many vertices does the table of a hull beat a scan, while both are in the first-level cache? Why table_from is greater: shapes/convex.h.
// Directions turn a little from call to call, as GJK's do.
#include <benchmark/benchmark.h>

#include <random>

#include "shapes/convex.h"
#include "shapes/convex_hull.h"

namespace gjkdbg {
namespace {

std::vector<Vector<3, double>> sphere_points(int count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<Vector<3, double>> points;
  for (int i = 0; i < count; ++i) points.push_back(Vector<3, double>(normal(random), normal(random), normal(random)).normalized());
  return points;
}

template <class Core>
void query(benchmark::State& state, const Core& core) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::vector<Vector<3, double>> directions{Vector<3, double>(1, 0, 0)};
  while (directions.size() < 4096) directions.push_back(directions.back() + 0.3 * Vector<3, double>(normal(random), normal(random), normal(random)));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(core.support(directions[++i % 4096]));
}

void scan(benchmark::State& state) {
  VerticesCore<3, double> core;
  for (const auto& v : sphere_points(static_cast<int>(state.range(0)))) core.vertices.push_back(v);
  query(state, core);
}

void table(benchmark::State& state) {
  const auto vertices = sphere_points(static_cast<int>(state.range(0)));
  std::vector<AnyVector> points(vertices.begin(), vertices.end());
  const ConvexHull hull = convex_hull(points, 3);
  query(state, HullCore<double>(vertices, hull));
}

BENCHMARK(scan)->Arg(8)->Arg(16)->Arg(24)->Arg(32)->Arg(48)->Arg(64)->Arg(128)->Arg(512)->Arg(2048);
BENCHMARK(table)->Arg(8)->Arg(16)->Arg(24)->Arg(32)->Arg(48)->Arg(64)->Arg(128)->Arg(512)->Arg(2048);

}  // namespace
}  // namespace gjkdbg

BENCHMARK_MAIN();
