// Charts on paper: CSV, JSON, and commands for gnuplot.
#include <algorithm>
#include <cstdio>
#include <set>

#include <nlohmann/json.hpp>

#include "debugger/lab/chart.h"
#include "recordings/json_writing.h"
#include "recordings/scene_file.h"

namespace gjkdbg {
namespace {

using Json = nlohmann::ordered_json;

constexpr double smallest_drawn = 1e-17;  ///< what zero is drawn at

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// The methods of a panel in the order they come.
std::vector<std::string> methods_of(const ChartPanel& panel) {
  std::vector<std::string> out;
  for (const ChartPoint& p : panel.points)
    if (std::find(out.begin(), out.end(), p.variant) == out.end()) out.push_back(p.variant);
  return out;
}

/// The method whose scalar is left out.
std::string in_double(const std::string& method) { return method.substr(0, method.rfind(", float")); }

/// A colour a method: the scalar is told by the dash. Colour-blind safe (Okabe and Ito), peers in greys.
std::string style_of(const std::string& method) {
  static constexpr std::pair<const char*, const char*> colours[] = {{"signed volumes", "#0072B2"}, {"Johnson", "#D55E00"}, {"Voronoi regions", "#009E73"}, {"accelerated", "#CC79A7"}, {"Polyak", "#E69F00"}, {"Newton", "#882255"},
                                                                    {"MPR", "#56B4E9"},            {"SAT", "#B8A800"},     {"closed form", "#7B3294"}, {"projections", "#B2182B"}, {"Bullet", "#222222"},          {"FCL", "#555555"},         {"libccd GJK", "#777777"},
                                                                    {"libccd MPR", "#999999"},     {"ODE", "#BBBBBB"},           {"Box2D", "#8C8450"}};
  const char* colour = "#000000";
  for (const auto& [name, value] : colours)
    if (method.starts_with(name)) colour = value;
  const bool single = method != in_double(method);
  return std::string("lc rgb '") + colour + "' dt " + (single ? "2" : "1") + " pt 7 ps " + (single ? "0.3" : "0.5") + " lw 1.3";
}

struct Axis {
  const char *title, *x_range;
  double (*x)(const ChartPoint&);
  bool front;
};

/// Panels in rows of up to three, the legend in the first.
std::string panels(const Chart& chart, const std::string& terminal, const std::string& file, const Axis& axis) {
  const std::size_t columns = std::clamp<std::size_t>(chart.panels.size(), 1, 3), rows = (chart.panels.size() + columns - 1) / columns;
  std::string out = "set terminal " + terminal + "\nset output '" + file + "'\nset multiplot layout " + std::to_string(rows) + "," + std::to_string(columns) + " title '" + axis.title + "'\n";
  out += "set logscale xy\nset format x '1e%T'\nset grid lc rgb '#dddddd'\nset xrange " + std::string(axis.x_range) + "\nset xtics 1e4\nset key bottom left samplen 1 spacing 0.75 maxrows 5 font ',7'\n";
  std::set<std::string> explained;
  for (const ChartPanel& panel : chart.panels) {
    const auto shown = [&](const ChartPoint& p) { return axis.x(p) >= 0; };
    std::vector<std::string> methods;
    for (const std::string& method : methods_of(panel))
      if (std::any_of(panel.points.begin(), panel.points.end(), [&](const ChartPoint& p) { return p.variant == method && shown(p); })) methods.push_back(method);
    if (methods.empty()) continue;
    // A long legend stands below the curves.
    const auto unexplained = std::count_if(methods.begin(), methods.end(), [&](const std::string& method) { return !explained.contains(in_double(method)); });
    out += "set title '" + panel.title + "' font ',11'\nset yrange [" + (unexplained > 4 ? "10" : "*") + ":*]\nplot ";
    for (const std::string& method : methods) out += "'-' using 1:2 with linespoints " + style_of(method) + (explained.insert(in_double(method)).second ? " title '" + in_double(method) + "'" : " notitle") + ", ";
    out += "'-' using 1:2 with points pt 6 ps 1.3 lc rgb '#000000' notitle\n";
    const auto data = [&](const ChartPoint& p) { out += number(std::max(axis.x(p), smallest_drawn)) + " " + number(p.nanoseconds) + "\n"; };
    for (const std::string& method : methods) {
      for (const ChartPoint& p : panel.points)
        if (p.variant == method && shown(p)) data(p);
      out += "e\n";
    }
    bool any = false;
    for (const ChartPoint& p : panel.points)
      if (p.front && axis.front) data(p), any = true;
    if (!any) out += "NaN NaN\n";
    out += "e\n";
  }
  return out + "unset multiplot\n";
}

}  // namespace

std::string chart_csv(const Chart& chart) {
  std::string out = "family,pairs,method,tolerance,nanoseconds,worst_error,median_error,worst_gap,median_gap,iterations,wrong,front\n";
  for (const ChartPanel& panel : chart.panels)
    for (const ChartPoint& p : panel.points)
      out += panel.name + "," + std::to_string(panel.pairs) + ",\"" + p.variant + "\"," + number(p.tolerance) + "," + number(p.nanoseconds) + "," + number(p.worst_error) + "," + number(p.median_error) + "," +
             number(p.worst_gap) + "," + number(p.median_gap) + "," + number(p.iterations) + "," + std::to_string(p.wrong) + "," + (p.front ? "1" : "0") + "\n";
  return out;
}

std::string chart_json(const Chart& chart) {
  Json out{{"format", "gjk-chart"}, {"version", 1}, {"generator", generator_name()}};
  out["methods"] = Json::object();  // ours, as a scene asks for them
  for (const Variant& variant : chart.methods)
    if (!variant.peer && !chart.panels.empty()) {
      SceneFile file;
      file.scene = chart.panels.front().scenes.front(), file.method = variant.method;
      out["methods"][variant.name] = scene_to_json(file)["method"];
    }
  out["families"] = Json::array();
  for (const ChartPanel& panel : chart.panels) {
    Json family{{"name", panel.name}, {"title", panel.title}, {"pairs", panel.pairs}};
    family["points"] = Json::array();
    std::set<int> worst;
    for (const ChartPoint& p : panel.points) {
      family["points"].push_back({{"method", p.variant}, {"tolerance", p.tolerance}, {"nanoseconds", p.nanoseconds}, {"worst_error", p.worst_error}, {"median_error", p.median_error}, {"worst_gap", p.worst_gap},
                                  {"median_gap", p.median_gap}, {"iterations", p.iterations}, {"wrong", p.wrong}, {"front", p.front}, {"worst_pair", p.worst}});
      worst.insert(p.worst);
    }
    family["scenes"] = Json::object();
    for (const int i : worst) {
      SceneFile file;
      file.scene = panel.scenes[static_cast<std::size_t>(i)];
      file.scene.query = Query::penetration;
      file.scene.name = panel.title + ", pair " + std::to_string(i);
      family["scenes"][std::to_string(i)] = scene_to_json(file);
    }
    out["families"].push_back(family);
  }
  out["price"] = Json::array();
  for (const PricePoint& p : chart.price) out["price"].push_back({{"what", p.what}, {"nanoseconds", p.nanoseconds}, {"worst_error", p.worst_error}, {"supports", p.supports}});
  out["ladder"] = Json::array();
  for (const LadderPoint& p : chart.ladder) {
    out["ladder"].push_back({{"shapes", p.shapes}, {"distance", p.distance}, {"method", p.method}, {"iterations", p.mean}, {"deviation", p.deviation}});
    if (!p.published.empty()) out["ladder"].back()["published"] = p.published;
  }
  out["motion"] = Json::array();
  for (const MotionPoint& p : chart.motion)
    out["motion"].push_back({{"family", p.family}, {"method", p.method}, {"parameter", p.parameter}, {"nanoseconds", p.nanoseconds}, {"worst_error", p.worst_error}, {"late", p.late}, {"supports", p.queries}});
  return pretty_json(out) + "\n";
}

std::string chart_gnuplot(const Chart& chart, const std::string& terminal, const std::string& file) {
  return panels(chart, terminal, file, {"Time a query (ns) against worst relative error; circles: the front, dashed: single precision", "[1e-17:1]", [](const ChartPoint& p) { return p.worst_error; }, true});
}

std::string gap_gnuplot(const Chart& chart, const std::string& terminal, const std::string& file) {
  return panels(chart, terminal, file, {"Time a query (ns) to a certified gap between the bounds (median, relative)", "[1e-17:1]", [](const ChartPoint& p) { return p.worst_gap > 0 ? p.median_gap : -1; }, false});
}

bool run_gnuplot(const std::string& commands) {
  std::FILE* pipe = popen("gnuplot 2>/dev/null", "w");
  if (!pipe) return false;
  const bool written = std::fwrite(commands.data(), 1, commands.size(), pipe) == commands.size();
  return pclose(pipe) == 0 && written;
}

}  // namespace gjkdbg
