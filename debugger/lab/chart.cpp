#include "debugger/lab/chart.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "algo/prepared_pair.h"
#include "algo/solve.h"
#include "debugger/lab/child.h"

namespace gjkdbg {
namespace {

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// What is known of how far the measuring is.
class Work {
 public:
  Work(double total, const std::function<bool(double)>& progress) : total_(total), progress_(progress) {}
  /// False: stop.
  bool done(double share) { return progress_(std::min((done_ += share) / total_, 0.999)); }

 private:
  double total_, done_ = 0;
  const std::function<bool(double)>& progress_;
};

using Pairs = std::vector<std::unique_ptr<PreparedPair>>;

Pairs prepared(const std::vector<Scene>& scenes, Scalar scalar) {
  Pairs pairs;
  for (const Scene& scene : scenes) pairs.push_back(prepare(scene.bodies[0], scene.bodies[1], scene.dimension, scalar));
  return pairs;
}
/// The same, which takes its time with large hulls. None: stopped.
Pairs prepared(const std::vector<Scene>& scenes, Work& work, double share) {
  Pairs pairs;
  for (const Scene& scene : scenes) {
    pairs.push_back(prepare(scene.bodies[0], scene.bodies[1], scene.dimension, Scalar::double_precision));
    if (!work.done(share / static_cast<double>(scenes.size()))) return {};
  }
  return pairs;
}

/// Nanoseconds a query: the median of several rounds of `ask(i)` over all pairs, after one to warm up.
template <class Ask>
double time_of(std::size_t pairs, int rounds, const Ask& ask) {
  std::vector<double> times;
  for (int round = 0; round <= rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < pairs; ++i) {
      const auto answer = ask(i);
      asm volatile("" : : "g"(&answer) : "memory");  // the answer counts as used
    }
    const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - begin;
    if (round > 0) times.push_back(elapsed.count() / static_cast<double>(pairs));
  }
  return median(times);
}

/// What is right about the answers of one method to one family.
class Judgement {
 public:
  Judgement(const ChartFamily& family, const std::vector<Reference>& references, ChartPoint& point) : family_(family), references_(references), point_(point) {}

  void add(std::size_t i, bool overlap, std::optional<double> value) {
    const double truth = references_[i].signed_distance, size = scene_size(family_.scenes[i]);
    const double error = value ? references_[i].error(*value, size) : 0;
    const bool class_wrong = overlap != (truth <= 0) && std::abs(truth) > 1e-6 * size;
    point_.wrong += class_wrong || error > 1e-3;
    if (!value) return;
    if (errors_.empty() || error > point_.worst_error) point_.worst = static_cast<int>(i), point_.worst_error = error;
    errors_.push_back(error);
  }
  void add_gap(double gap) {
    gaps_.push_back(gap);
    point_.worst_gap = std::max(point_.worst_gap, gap);
  }
  /// False: nothing to show, no answer had a value.
  bool finish() {
    if (!gaps_.empty()) point_.median_gap = median(gaps_);
    if (errors_.empty()) return false;
    point_.median_error = median(errors_);
    return true;
  }

 private:
  const ChartFamily& family_;
  const std::vector<Reference>& references_;
  ChartPoint& point_;
  std::vector<double> errors_, gaps_;
};

/// False: the method does not take these bodies.
bool measure(const ChartFamily& family, const std::vector<Reference>& references, const Pairs& pairs, const Variant& variant, int rounds, ChartPoint& point) {
  std::vector<Settings> settings;
  Judgement judgement(family, references, point);
  for (std::size_t i = 0; i < family.scenes.size(); ++i) {
    if (!applies(variant, family.scenes[i])) return false;
    Method method = variant.method;
    method.tolerance = point.tolerance;
    settings.push_back(resolve_settings(method, family.scenes[i]));
    const Result r = pairs[i]->run(settings.back(), Query::penetration);
    judgement.add(i, r.intersecting, r.signed_distance);
    judgement.add_gap((*r.upper_bound - *r.lower_bound) / scene_size(family.scenes[i]));
    point.iterations += static_cast<double>(r.iterations) / static_cast<double>(family.scenes.size());
  }
  point.nanoseconds = time_of(pairs.size(), rounds, [&](std::size_t i) { return pairs[i]->run(settings[i], Query::penetration); });
  return judgement.finish();
}

/// What a child process measures of another library.
struct Measured {
  double nanoseconds = 0, worst_error = 0, median_error = 0;
  int wrong = 0, worst = 0;
  bool answers = false;
};

/// Another library, in a process of its own: it may crash. False: it does not take all these bodies, crashes, or only says yes and no.
bool measure_peer(const ChartFamily& family, const std::vector<Reference>& references, const Peer& peer, int rounds, ChartPoint& point) {
  std::vector<std::unique_ptr<PeerPair>> pairs;
  for (const Scene& scene : family.scenes) {
    pairs.push_back(peer.prepare(scene, point.tolerance));
    if (!pairs.back()) return false;
  }
  Measured measured;
  const ChildEnd end = in_child<Measured>(20, measured, [&](Measured& m) {
    ChartPoint own;
    Judgement judgement(family, references, own);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const PeerAnswer answer = pairs[i]->ask();
      judgement.add(i, answer.overlap, answer.signed_distance);
    }
    m.answers = judgement.finish();
    m.nanoseconds = time_of(pairs.size(), rounds, [&](std::size_t i) { return pairs[i]->ask(); });
    m.worst_error = own.worst_error, m.median_error = own.median_error, m.wrong = own.wrong, m.worst = own.worst;
  });
  if (end != ChildEnd::finished || !measured.answers) return false;
  point.nanoseconds = measured.nanoseconds, point.worst_error = measured.worst_error, point.median_error = measured.median_error;
  point.wrong = measured.wrong, point.worst = measured.worst;
  return true;
}

void mark_front(std::vector<ChartPoint>& points) {
  for (ChartPoint& p : points)
    p.front = std::none_of(points.begin(), points.end(), [&](const ChartPoint& q) {
      return q.nanoseconds <= p.nanoseconds && q.worst_error <= p.worst_error && (q.nanoseconds < p.nanoseconds || q.worst_error < p.worst_error);
    });
}

/// The truth a price row is judged by: what was meant, not what it was modelled as.
std::vector<Reference> meant(const std::vector<PriceRow>& rows, const PriceRow& row) {
  const PriceRow* original = &row;
  for (const PriceRow& candidate : rows)
    if (row.what.starts_with("the same as hulls") && candidate.what.starts_with("spheres")) original = &candidate;
  std::vector<Reference> out;
  for (const Scene& scene : original->scenes) out.push_back(reference(scene));
  return out;
}

/// About how long a row takes to be made ready, beside a method on a family: large hulls get a table of directions.
double weight_of(const PriceRow& row) {
  double vertices = 0;
  for (const Scene& scene : row.scenes)
    if (const auto* set = std::get_if<PointSet>(&scene.bodies[0].shape.geometry)) vertices += static_cast<double>(set->points.size());
  return 1 + vertices / 8000;
}

/// Nothing: stopped.
std::optional<PricePoint> price_of(const std::vector<PriceRow>& rows, const PriceRow& row, int rounds, Work& work) {
  PricePoint point{row.what, 0, 0, 0, row.query == Query::penetration};
  const std::vector<Reference> truth = meant(rows, row);
  const Pairs pairs = prepared(row.scenes, work, weight_of(row));
  if (pairs.empty()) return std::nullopt;
  std::vector<Settings> settings;
  for (std::size_t i = 0; i < row.scenes.size(); ++i) {
    settings.push_back(resolve_settings({}, row.scenes[i]));
    const Result r = pairs[i]->run(settings.back(), row.query);
    point.supports += static_cast<double>(r.support_calls) / static_cast<double>(row.scenes.size());
    if (r.signed_distance && row.query == Query::penetration) point.worst_error = std::max(point.worst_error, truth[i].error(*r.signed_distance, scene_size(row.scenes[i])));
  }
  point.nanoseconds = time_of(pairs.size(), rounds, [&](std::size_t i) { return pairs[i]->run(settings[i], row.query); });
  return point;
}

/// The points of one method on one family, tolerance by tolerance.
void measure_family(const ChartFamily& family, const std::vector<Reference>& references, const Variant& variant, const std::vector<double>& tolerances, int rounds, std::vector<ChartPoint>& out) {
  const Pairs pairs = variant.peer ? Pairs() : prepared(family.scenes, *variant.method.scalar);
  const bool single = !variant.peer && variant.method.scalar == Scalar::float_precision;
  for (const double tolerance : tolerances) {
    if (single && tolerance < 1e-7) continue;
    if (variant.peer && ((!variant.peer->has_tolerance && tolerance != tolerances.front()) || tolerance < 1e-10)) continue;  // theirs below that no longer end
    ChartPoint point;
    point.variant = variant.name, point.tolerance = tolerance;
    if (variant.peer ? measure_peer(family, references, *variant.peer, rounds, point) : measure(family, references, pairs, variant, rounds, point)) out.push_back(point);
    else return;
  }
}

/// The ways of GJK that the ladder compares.
constexpr int ladder_ways = 5;
Method ladder_method(int way, double distance) {
  Method method;
  method.name = way == 0 ? MethodName::gjk : MethodName::gjk_accelerated;
  if (way > 0) method.acceleration = static_cast<Acceleration>(way - 1);
  method.penetration = Penetration::none;
  method.tolerance = std::min(0.5, 5e-9 / (distance * distance));
  return method;
}

LadderPoint ladder_point(const std::string& shapes, const std::vector<Scene>& scenes, const Pairs& pairs, double distance, int way, int rounds) {
  static constexpr const char* names[ladder_ways] = {"plain", "Nesterov", "Polyak", "Newton", "smoothed"};
  LadderPoint point;
  point.shapes = shapes, point.method = names[way], point.distance = distance;
  double sum = 0, squares = 0;
  std::vector<Settings> settings;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    settings.push_back(resolve_settings(ladder_method(way, distance), scenes[i]));
    const double k = pairs[i]->run(settings[i], Query::penetration).iterations;
    sum += k, squares += k * k;
  }
  const double n = static_cast<double>(scenes.size());
  point.mean = sum / n, point.deviation = std::sqrt(std::max(0.0, squares / n - point.mean * point.mean));
  point.nanoseconds = time_of(pairs.size(), rounds, [&](std::size_t i) { return pairs[i]->run(settings[i], Query::penetration); });
  return point;
}

// How long each takes, beside a method on a family.
constexpr double weight_of_rung = 1, weight_of_motion = 1, rungs_of_ladder = ladder_ways * (7 + 8);

/// GJK's iterations by distance, with plain steps, with momentum, Newton's directions and smoothed ones, stopped where the paper stops: at a duality gap 2 v.(v - w) of 1e-8. With the
/// plane's bound p = v.w / |v| that is |v| - p <= 5e-9 / |v|, relative to |v| a tolerance of 5e-9 / |v|^2. False: stopped.
bool ladder(bool quick, int rounds, Work& work, std::vector<LadderPoint>& out) {
  struct Rung { double distance; std::optional<std::array<double, 2>> plain, nesterov; };
  static constexpr Rung rungs[] = {{-0.05, {{6, 2}}, {{6, 3}}}, {-0.001, {}, {}}, {1e-4, {}, {}}, {0.001, {{16, 5}}, {{7, 2}}}, {0.01, {}, {}}, {0.1, {}, {}}, {1, {{4, 1}}, {{13, 4}}}};
  struct Hulls { int vertices; double plain, nesterov; };
  static constexpr Hulls hulls[] = {{33, 800, 800}, {141, 1200, 1000}, {626, 1800, 1400}, {2500, 4100, 2700}};
  for (const Rung& rung : rungs) {
    const std::vector<Scene> scenes = ladder_ellipsoids(quick ? 60 : 400, rung.distance);
    const Pairs pairs = prepared(scenes, Scalar::double_precision);
    for (int way = 0; way < ladder_ways; ++way) {
      out.push_back(ladder_point("ellipsoids", scenes, pairs, rung.distance, way, rounds));
      if (way < 2) out.back().published = way == 0 ? rung.plain : rung.nesterov;
      if (!work.done(weight_of_rung)) return false;
    }
  }
  for (const Hulls& hull : hulls)
    for (const double distance : {0.001, 1.0}) {
      const std::vector<Scene> scenes = hull_pairs(quick ? 5 : 20, hull.vertices, distance);
      const Pairs pairs = prepared(scenes, Scalar::double_precision);
      for (int way = 0; way < ladder_ways; ++way) {
        out.push_back(ladder_point("hulls of " + std::to_string(hull.vertices), scenes, pairs, distance, way, rounds));
        out.back().vertices = hull.vertices;
        if (way < 2 && distance < 0.1) out.back().published_nanoseconds = way == 0 ? hull.plain : hull.nesterov;
        if (!work.done(weight_of_rung)) return false;
      }
    }
  return true;
}

}  // namespace

Chart make_chart(const ChartOptions& options, const std::function<bool(double)>& progress) {
  const bool quick = options.quick, usual = options.families.empty() && options.methods.empty();
  const int count = quick ? 40 : 300, rounds = quick ? 3 : 7;
  std::vector<Variant> all = chosen(variants(), options.methods);
  if (options.methods.empty()) std::erase_if(all, [](const Variant& v) { return v.method.stopping.has_value(); });  // others' rules are as fast as ours: when asked for
  const std::vector<ChartFamily> families = chart_families(count, options.families);
  const std::vector<double> tolerances = quick ? std::vector<double>{1e-2, 1e-6, 1e-10, 1e-14} : std::vector<double>{1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14};
  const std::vector<PriceRow> rows = usual ? price_rows(count) : std::vector<PriceRow>();
  double others = usual ? weight_of_rung * rungs_of_ladder + weight_of_motion * motion_point_count(quick) : 0;
  for (const PriceRow& row : rows) others += weight_of(row);
  Work work(static_cast<double>(families.size() * all.size()) + others, progress);
  Chart chart;
  chart.methods = all;
  for (const ChartFamily& family : families) {
    std::vector<Reference> references;
    for (const Scene& scene : family.scenes) references.push_back(reference(scene));
    chart.panels.push_back({family.name, family.title, static_cast<int>(family.scenes.size()), {}, family.scenes});
    for (const Variant& variant : all) {
      measure_family(family, references, variant, tolerances, rounds, chart.panels.back().points);
      if (!work.done(1)) return mark_front(chart.panels.back().points), chart;
    }
    mark_front(chart.panels.back().points);
  }
  if (usual) {
    for (const PriceRow& row : rows) {
      const std::optional<PricePoint> point = price_of(rows, row, rounds, work);
      if (!point) return chart;
      chart.price.push_back(*point);
    }
    if (!ladder(quick, rounds, work, chart.ladder)) return chart;
    chart.motion = motion_points(quick, [&] { return work.done(weight_of_motion); });
  }
  progress(1);
  return chart;
}

}  // namespace gjkdbg
