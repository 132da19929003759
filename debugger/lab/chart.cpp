#include "debugger/lab/chart.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

#include "algo/prepared_pair.h"
#include "algo/solve.h"
#include "recordings/json_writing.h"

namespace gjkdbg {
namespace {

constexpr double smallest_error = 1e-17;  ///< what an error of zero is drawn at

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

using Pairs = std::vector<std::unique_ptr<PreparedPair>>;

std::unique_ptr<PreparedPair> prepared(const Scene& scene, Scalar scalar) { return prepare(scene.bodies[0], scene.bodies[1], scene.dimension, scalar); }

/// Nanoseconds a query: the median of several rounds over all pairs, after one to warm up.
double time_of(Pairs& pairs, const std::vector<Settings>& settings, Query query, int rounds) {
  std::vector<double> times;
  for (int round = 0; round <= rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Result result = pairs[i]->run(settings[i], query);
      asm volatile("" : : "g"(&result) : "memory");  // the answer counts as used
    }
    const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - begin;
    if (round > 0) times.push_back(elapsed.count() / static_cast<double>(pairs.size()));
  }
  return median(times);
}

ChartPoint measure(const ChartFamily& family, const std::vector<Reference>& references, Pairs& pairs, const Variant& variant, double tolerance, int rounds) {
  ChartPoint point{variant.name, tolerance, 0, 0, 0, 0, 0, 0, false};
  std::vector<Settings> settings;
  std::vector<double> errors;
  for (std::size_t i = 0; i < family.scenes.size(); ++i) {
    Method method = variant.method;
    method.tolerance = tolerance;
    settings.push_back(resolve_settings(method, family.scenes[i]));
    const Result r = pairs[i]->run(settings.back(), Query::penetration);
    const double size = scene_size(family.scenes[i]), error = references[i].error(*r.signed_distance, size);
    errors.push_back(error);
    point.worst_gap = std::max(point.worst_gap, (*r.upper_bound - *r.lower_bound) / size);
    point.iterations += static_cast<double>(r.iterations) / static_cast<double>(family.scenes.size());
    const bool class_wrong = r.intersecting != (references[i].signed_distance <= 0) && std::abs(references[i].signed_distance) > 1e-6 * size;
    point.wrong += class_wrong || error > 1e-3;
  }
  point.worst_error = *std::max_element(errors.begin(), errors.end());
  point.median_error = median(errors);
  point.nanoseconds = time_of(pairs, settings, Query::penetration, rounds);
  return point;
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

PricePoint price_of(const std::vector<PriceRow>& rows, const PriceRow& row, int rounds) {
  PricePoint point{row.what, 0, 0, 0};
  const std::vector<Reference> truth = meant(rows, row);
  Pairs pairs;
  std::vector<Settings> settings;
  for (std::size_t i = 0; i < row.scenes.size(); ++i) {
    pairs.push_back(prepared(row.scenes[i], Scalar::double_precision));
    settings.push_back(resolve_settings({}, row.scenes[i]));
    const Result r = pairs.back()->run(settings.back(), row.query);
    point.supports += static_cast<double>(r.support_calls) / static_cast<double>(row.scenes.size());
    if (r.signed_distance && row.query == Query::penetration) point.worst_error = std::max(point.worst_error, truth[i].error(*r.signed_distance, scene_size(row.scenes[i])));
  }
  point.nanoseconds = time_of(pairs, settings, row.query, rounds);
  return point;
}

}  // namespace

Chart make_chart(bool quick, const std::function<bool(double)>& progress) {
  const int count = quick ? 60 : 400, rounds = quick ? 3 : 9;
  const std::vector<ChartFamily> families = chart_families(count);
  const std::vector<Variant> all = variants();
  const std::vector<double> tolerances = quick ? std::vector<double>{1e-2, 1e-6, 1e-10, 1e-14} : std::vector<double>{1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14};
  const double total = static_cast<double>(families.size() * all.size());
  double done = 0;
  Chart chart;
  for (const ChartFamily& family : families) {
    std::vector<Reference> references;
    for (const Scene& scene : family.scenes) references.push_back(reference(scene));
    chart.panels.push_back({family.name, family.title, static_cast<int>(family.scenes.size()), {}});
    for (const Variant& variant : all) {
      const bool single = variant.method.scalar == Scalar::float_precision;
      Pairs pairs;
      for (const Scene& scene : family.scenes) pairs.push_back(prepared(scene, *variant.method.scalar));
      for (const double tolerance : tolerances)
        if (!single || tolerance >= 1e-7) chart.panels.back().points.push_back(measure(family, references, pairs, variant, tolerance, rounds));
      if (!progress(++done / (total + 1))) return mark_front(chart.panels.back().points), chart;
    }
    mark_front(chart.panels.back().points);
  }
  const std::vector<PriceRow> rows = price_rows(count);
  for (const PriceRow& row : rows) chart.price.push_back(price_of(rows, row, rounds));
  chart.motion = motion_points(quick);
  progress(1);
  return chart;
}

namespace {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

}  // namespace

std::string chart_csv(const Chart& chart) {
  std::string out = "family,pairs,method,tolerance,nanoseconds,worst_error,median_error,worst_gap,iterations,wrong,front\n";
  for (const ChartPanel& panel : chart.panels)
    for (const ChartPoint& p : panel.points)
      out += panel.name + "," + std::to_string(panel.pairs) + ",\"" + p.variant + "\"," + number(p.tolerance) + "," + number(p.nanoseconds) + "," + number(p.worst_error) + "," + number(p.median_error) + "," +
             number(p.worst_gap) + "," + number(p.iterations) + "," + std::to_string(p.wrong) + "," + (p.front ? "1" : "0") + "\n";
  return out;
}

std::string chart_json(const Chart& chart) {
  std::string out = "{\"format\": \"gjk-chart\", \"version\": 1, \"generator\": ";
  append_string(out, generator_name());
  out += ",\n\"families\": [";
  const auto field = [&](const char* name, double x) {
    out += std::string(", \"") + name + "\": ";
    append_number(out, x);
  };
  for (std::size_t i = 0; i < chart.panels.size(); ++i) {
    const ChartPanel& panel = chart.panels[i];
    out += (i > 0 ? "," : "") + std::string("\n {\"name\": \"") + panel.name + "\", \"title\": \"" + panel.title + "\", \"pairs\": " + std::to_string(panel.pairs) + ", \"points\": [";
    for (std::size_t k = 0; k < panel.points.size(); ++k) {
      const ChartPoint& p = panel.points[k];
      out += (k > 0 ? "," : "") + std::string("\n  {\"method\": \"") + p.variant + "\"";
      field("tolerance", p.tolerance), field("nanoseconds", p.nanoseconds), field("worst_error", p.worst_error), field("median_error", p.median_error);
      field("worst_gap", p.worst_gap), field("iterations", p.iterations), field("wrong", p.wrong);
      out += p.front ? ", \"front\": true}" : ", \"front\": false}";
    }
    out += "]}";
  }
  out += "],\n\"price\": [";
  for (std::size_t i = 0; i < chart.price.size(); ++i) {
    const PricePoint& p = chart.price[i];
    out += (i > 0 ? "," : "") + std::string("\n {\"what\": \"") + p.what + "\"";
    field("nanoseconds", p.nanoseconds), field("worst_error", p.worst_error), field("supports", p.supports);
    out += "}";
  }
  out += "],\n\"motion\": [";
  for (std::size_t i = 0; i < chart.motion.size(); ++i) {
    const MotionPoint& p = chart.motion[i];
    out += (i > 0 ? "," : "") + std::string("\n {\"family\": \"") + p.family + "\", \"method\": \"" + p.method + "\"";
    field("parameter", p.parameter), field("nanoseconds", p.nanoseconds), field("worst_error", p.worst_error), field("late", p.late), field("supports", p.queries);
    out += "}";
  }
  return out + "]}\n";
}

std::string chart_gnuplot(const Chart& chart, const std::string& terminal, const std::string& file) {
  static const char* const colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7"};
  const std::size_t rows = (chart.panels.size() + 2) / 3;
  std::string out = "set terminal " + terminal + "\nset output '" + file + "'\nset multiplot layout " + std::to_string(rows) + ",3 title 'Time a query (ns) against worst relative error; circles: the front'\n";
  out += "set logscale xy\nset format x '1e%T'\nset grid lc rgb '#dddddd'\nset xrange [1e-17:1]\nset xtics 1e4\nset key bottom left samplen 1 spacing 0.9 font ',9'\nset style line 99 lc rgb '#000000'\n";
  for (const ChartPanel& panel : chart.panels) {
    out += "set title '" + panel.title + "' font ',11'\nset yrange [*:*]\n";
    std::map<std::string, std::vector<const ChartPoint*>> by_variant;
    std::vector<std::string> order;
    for (const ChartPoint& p : panel.points) {
      if (!by_variant.contains(p.variant)) order.push_back(p.variant);
      by_variant[p.variant].push_back(&p);
    }
    out += "plot ";
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool single = order[i].ends_with("float");
      out += "'-' using 1:2 with linespoints lc rgb '" + std::string(colours[i % 4]) + "' dt " + (single ? "2" : "1") + " pt 7 ps " + (single ? "0.3" : "0.5") + " lw 1.3 " +
             (&panel == &chart.panels.front() ? "title '" + order[i] + "'" : "notitle") + ", ";
    }
    out += "'-' using 1:2 with points pt 6 ps 1.3 lc rgb '#000000' notitle\n";
    const auto data = [&](const ChartPoint& p) { out += number(std::max(p.worst_error, smallest_error)) + " " + number(p.nanoseconds) + "\n"; };
    for (const std::string& name : order) {
      for (const ChartPoint* p : by_variant[name]) data(*p);
      out += "e\n";
    }
    for (const ChartPoint& p : panel.points)
      if (p.front) data(p);
    out += "e\n";
  }
  return out + "unset multiplot\n";
}

bool run_gnuplot(const std::string& commands) {
  std::FILE* pipe = popen("gnuplot 2>/dev/null", "w");
  if (!pipe) return false;
  const bool written = std::fwrite(commands.data(), 1, commands.size(), pipe) == commands.size();
  return pclose(pipe) == 0 && written;
}

}  // namespace gjkdbg
