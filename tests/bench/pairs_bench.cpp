// A full signed query (distance or depth, normal, witnesses) on the pairs of every family: our methods, and the libraries that are installed, on the
// same pairs in one run. Counters: `wrong` of the pairs have the wrong class or are off by more than 1e-6 of the size; `worst` is the largest
// error relative to the size against the certified reference; silent: what the library does not answer. Then a table of ratios.
//   pairs_bench                                   all families; pairs by GJKDBG_PAIRS (200)
//   pairs_bench --benchmark_filter='boxes-.*'     some
//   pairs_bench --benchmark_filter='size/|gap/'   growth with hull size and with the gap
//   pairs_bench --benchmark_filter=coherent       one pair in motion, cold and warm starts
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>

#include "algo/prepared_pair.h"
#include "algo/solve.h"
#include "debugger/lab/families.h"
#include "debugger/lab/measure.h"
#include "debugger/lab/peers.h"

namespace gjkdbg {
namespace {

int pair_count() {
  const char* asked = std::getenv("GJKDBG_PAIRS");
  return asked ? std::max(1, std::atoi(asked)) : 200;
}

struct Pairs {
  std::vector<Scene> scenes;
  std::vector<Reference> references;
};
using Source = std::function<std::vector<Scene>()>;

/// Made when first asked for: a filtered run makes only its own.
const Pairs& pairs_of(const std::string& name, const Source& source) {
  static std::map<std::string, Pairs> all;
  const auto [at, made] = all.try_emplace(name);
  if (made) {
    at->second.scenes = source();
    for (const Scene& scene : at->second.scenes) at->second.references.push_back(reference(scene));
  }
  return at->second;
}

struct Tally {
  double worst = 0;
  int wrong = 0, silent = 0;
  void judge(const Scene& scene, const Reference& truth, bool overlap, std::optional<double> distance) {
    const double size = scene_size(scene), error = distance ? truth.error(*distance, size) : 0;
    const bool class_wrong = overlap != (truth.signed_distance <= 0) && std::abs(truth.signed_distance) > 1e-13 * std::max(size, scene.bodies[0].pose.position.norm());
    silent += !distance;
    wrong += class_wrong || error > 1e-6;
    worst = std::max(worst, error);
  }
  void report(benchmark::State& state, std::size_t pairs) const {
    state.counters["wrong"] = wrong, state.counters["worst"] = worst, state.counters["silent"] = silent;
    state.counters["ns"] = benchmark::Counter(static_cast<double>(pairs) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  }
};

void ours(benchmark::State& state, const std::string& name, const Source& source, const Method& method, Query query) {
  const Pairs& pairs = pairs_of(name, source);
  std::vector<std::unique_ptr<PreparedPair>> ready;
  std::vector<Settings> settings;
  Tally tally;
  for (std::size_t i = 0; i < pairs.scenes.size(); ++i) {
    const Scene& scene = pairs.scenes[i];
    settings.push_back(resolve_settings(method, scene));
    ready.push_back(prepare(scene.bodies[0], scene.bodies[1], scene.dimension, settings.back().scalar));
    const Result r = ready.back()->run(settings.back(), query);
    tally.judge(scene, pairs.references[i], r.intersecting, query == Query::penetration ? r.signed_distance : std::nullopt);
  }
  for (auto _ : state)
    for (std::size_t i = 0; i < ready.size(); ++i) benchmark::DoNotOptimize(ready[i]->run(settings[i], query));
  tally.report(state, ready.size());
}

void theirs(benchmark::State& state, const std::string& name, const Source& source, const Peer& peer) {
  const Pairs& pairs = pairs_of(name, source);
  std::vector<std::unique_ptr<PeerPair>> ready;
  Tally tally;
  for (std::size_t i = 0; i < pairs.scenes.size(); ++i) {
    auto pair = peer.prepare(pairs.scenes[i], 1e-6);
    if (!pair) continue;
    const PeerAnswer answer = pair->ask();
    tally.judge(pairs.scenes[i], pairs.references[i], answer.overlap, answer.signed_distance);
    ready.push_back(std::move(pair));
  }
  if (ready.size() * 2 < pairs.scenes.size()) return state.SkipWithError("does not know such shapes");
  for (auto _ : state)
    for (const auto& pair : ready) benchmark::DoNotOptimize(pair->ask());
  tally.report(state, ready.size());
  state.counters["pairs"] = static_cast<double>(ready.size());
}

/// One pair of hulls at 120 places a second, one passing the other while it turns: every query begun at the centres, or where the one before ended.
void coherent(benchmark::State& state, int vertices, Start start) {
  Scene scene = hull_pairs(1, vertices, 0.1)[0];
  Method m;
  m.start = start;
  const Settings settings = resolve_settings(m, scene);
  const auto pair = prepare(scene.bodies[0], scene.bodies[1], 3, settings.scalar);
  std::vector<Pose> places;
  Tally tally;
  for (int i = 0; i < 120; ++i) {
    Body& b = scene.bodies[1];
    b.pose.position += Eigen::Vector3d(0.01, 0.005, 0);
    b.pose.matrix = Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix() * Eigen::Matrix3d(b.pose.matrix);
    places.push_back(b.pose);
    pair->place(scene.bodies[0].pose, b.pose);
    const Result r = pair->run(settings, Query::penetration);
    tally.judge(scene, reference(scene), r.intersecting, r.signed_distance);
  }
  for (auto _ : state)
    for (const Pose& place : places) {
      pair->place(scene.bodies[0].pose, place);
      benchmark::DoNotOptimize(pair->run(settings, Query::penetration));
    }
  tally.report(state, places.size());
}

/// Passes everything on to the console and keeps the times for the table at the end.
class Table : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
      const std::string& name = run.run_name.function_name;
      const std::size_t slash = name.rfind('/');
      auto& row = rows_[name.substr(0, slash)];
      if (row.empty()) order_.push_back(name.substr(0, slash));
      row.push_back({name.substr(slash + 1), run.counters.at("ns").value, static_cast<int>(run.counters.at("wrong").value)});
    }
  }
  void Finalize() override {
    ConsoleReporter::Finalize();
    std::printf("\nTimes as multiples of our default's (wrong answers in brackets)\n");
    for (const std::string& family : order_) {
      const auto& row = rows_[family];
      std::printf("  %-18s %7.0f ns", family.c_str(), row.front().nanoseconds);
      for (std::size_t i = 1; i < row.size(); ++i) {
        std::printf("  %s %.2f", row[i].method.c_str(), row[i].nanoseconds / row.front().nanoseconds);
        if (row[i].wrong > 0) std::printf(" [%d]", row[i].wrong);
      }
      std::printf("\n");
    }
  }

 private:
  struct Cell {
    std::string method;
    double nanoseconds;
    int wrong;
  };
  std::map<std::string, std::vector<Cell>> rows_;
  std::vector<std::string> order_;
};

void register_family(const std::string& name, const Source& source) {
  const auto add = [&](const std::string& method, MethodName which, Query query = Query::penetration, Scalar scalar = Scalar::double_precision) {
    Method m;
    m.name = which, m.scalar = scalar;
    benchmark::RegisterBenchmark((name + "/" + method).c_str(), [=](benchmark::State& state) { ours(state, name, source, m, query); })->MinTime(0.1);
  };
  add("default", MethodName::gjk);
  add("accelerated", MethodName::gjk_accelerated);
  add("float", MethodName::gjk, Query::penetration, Scalar::float_precision);
  add("yes-no", MethodName::gjk, Query::intersect);
  const auto made_of = [&](std::initializer_list<std::string_view> families) { return std::any_of(families.begin(), families.end(), [&](auto f) { return name.starts_with(f); }); };
  if (made_of({"boxes", "faces-touching", "slivers", "size-ratio", "offset-1e5", "rectangles", "octagons"})) add("sat", MethodName::sat);
  if (made_of({"curved", "ellipsoids", "hulls", "size", "gap"})) add("fastest", MethodName::fastest);
  if (made_of({"curved", "ellipsoids"})) {
    for (const auto& [method, which] : {std::pair("at-1e-6", MethodName::gjk), std::pair("fastest-at-1e-6", MethodName::fastest)}) {
      Method m;
      m.name = which, m.tolerance = 1e-6;
      benchmark::RegisterBenchmark((name + "/" + method).c_str(), [=](benchmark::State& state) { ours(state, name, source, m, Query::penetration); })->MinTime(0.1);
    }
  }
  if (name.starts_with("capsules")) add("closed-form", MethodName::closed_form);
  for (const Peer& peer : peers())
    benchmark::RegisterBenchmark((name + "/" + peer.name).c_str(), [=, &peer](benchmark::State& state) { theirs(state, name, source, peer); })->MinTime(0.1);
}

}  // namespace
}  // namespace gjkdbg

int main(int argc, char** argv) {
  using namespace gjkdbg;
  const int pairs = pair_count();
  for (const std::string& name : chart_family_names())
    register_family(name, [=] { return chart_families(pairs, {name})[0].scenes; });
  for (const int vertices : {8, 32, 128, 512, 2000, 8000}) register_family("size/" + std::to_string(vertices), [=] { return hull_pairs(std::max(1, pairs / 5), vertices, 0.1); });
  for (const double gap : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    char name[32];
    std::snprintf(name, sizeof name, "gap/%.0e", gap);
    register_family(name, [=] { return hull_pairs(pairs, 32, gap); });
  }
  for (const int vertices : {8, 32, 128, 1000})
    for (const Start start : {Start::centres, Start::previous})
      benchmark::RegisterBenchmark(("coherent/" + std::to_string(vertices) + "/" + std::string(word_of(start))).c_str(),
                                   [=](benchmark::State& state) { coherent(state, vertices, start); })->MinTime(0.1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  Table table;
  benchmark::RunSpecifiedBenchmarks(&table);
}
