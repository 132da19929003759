// Charts as numbers: CSV and JSON.
#include <cstdio>
#include <set>

#include <nlohmann/json.hpp>

#include "debugger/lab/chart.h"
#include "recordings/json_writing.h"
#include "recordings/scene_file.h"

namespace gjkdbg {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string number_text(double x, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

std::string chart_csv(const Chart& chart) {
  std::string out = "family,pairs,method,tolerance,nanoseconds,worst_error,median_error,worst_gap,median_gap,iterations,wrong,front\n";
  for (const ChartPanel& panel : chart.panels)
    for (const ChartPoint& p : panel.points)
      out += panel.name + "," + std::to_string(panel.pairs) + ",\"" + p.variant + "\"," + number_text(p.tolerance) + "," + number_text(p.nanoseconds) + "," + number_text(p.worst_error) + "," + number_text(p.median_error) + "," +
             number_text(p.worst_gap) + "," + number_text(p.median_gap) + "," + number_text(p.iterations) + "," + std::to_string(p.wrong) + "," + (p.front ? "1" : "0") + "\n";
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
    Json rung{{"shapes", p.shapes}, {"distance", p.distance}, {"method", p.method}, {"iterations", p.mean}, {"deviation", p.deviation}, {"nanoseconds", p.nanoseconds}};
    if (p.vertices > 0) rung["vertices"] = p.vertices;
    if (p.published) rung["published"] = {{"iterations", (*p.published)[0]}, {"deviation", (*p.published)[1]}};
    if (p.published_nanoseconds) rung["published_nanoseconds"] = *p.published_nanoseconds;
    out["ladder"].push_back(std::move(rung));
  }
  out["motion"] = Json::array();
  for (const MotionPoint& p : chart.motion)
    out["motion"].push_back({{"family", p.family}, {"method", p.method}, {"parameter", p.parameter}, {"nanoseconds", p.nanoseconds}, {"worst_error", p.worst_error}, {"late", p.late}, {"supports", p.queries}});
  return pretty_json(out) + "\n";
}

}  // namespace gjkdbg
