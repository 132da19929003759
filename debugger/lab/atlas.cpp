#include "debugger/lab/atlas.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "algo/solve.h"
#include "recordings/json_writing.h"

namespace gjkdbg {
namespace {

/// Judges one answer. `unit` is the rounding of the method's scalar; the exact answer itself carries a few roundings of the sizes.
Verdict judge(const Result& r, double exact, double size, double unit, double tolerance, double& error) {
  const double value = *r.signed_distance;
  if (!std::isfinite(value)) return error = std::numeric_limits<double>::infinity(), Verdict::not_finite;
  const double scale = std::max(size, std::abs(exact));
  error = std::abs(value - exact) / scale;
  const bool class_lost = r.intersecting != (exact <= 0);
  if (class_lost && std::abs(exact) > 64 * unit * scale) return Verdict::wrong_class;
  const double good = std::max(unit > 1e-10 ? 1e-5 : 1e-9, 2 * tolerance);  // what was asked for
  if (error <= 4 * unit && !class_lost) return Verdict::right;
  if (error <= good) return class_lost || error > 64 * unit ? Verdict::right_within_rounding : Verdict::right;
  if (r.status == "iteration_limit" || r.status == "stalled") return Verdict::gave_up;
  const double slack = 64 * unit * scale;
  const bool excluded = exact < *r.lower_bound - slack || exact > *r.upper_bound + slack;
  return excluded ? Verdict::lied : Verdict::wrong_value;
}

AtlasCell sweep(const AtlasFamily& family, const Variant& variant) {
  AtlasCell cell;
  bool first = true;
  const double unit = variant.method.scalar == Scalar::float_precision ? 1.2e-7 : 2.3e-16;
  for (const AtlasCase& one : family.cases) {
    double error = 0;
    const Settings settings = resolve_settings(variant.method, one.scene);
    const Verdict verdict = judge(solve(one.scene, settings), one.exact, scene_size(one.scene), unit, settings.tolerance, error);
    if (first || verdict > cell.verdict || (verdict == cell.verdict && error > cell.worst_error)) cell = {verdict, error, one.parameter, one.scene};
    first = false;
  }
  return cell;
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

}  // namespace

Atlas make_atlas(bool quick, const std::function<bool(double)>& progress) {
  Atlas atlas{atlas_families(quick), variants(), {}};
  for (std::size_t i = 0; i < atlas.families.size(); ++i) {
    std::vector<AtlasCell> row;
    for (const Variant& variant : atlas.methods) row.push_back(sweep(atlas.families[i], variant));
    atlas.cells.push_back(std::move(row));
    if (!progress(static_cast<double>(i + 1) / static_cast<double>(atlas.families.size()))) break;
  }
  atlas.families.resize(atlas.cells.size());
  return atlas;
}

std::string atlas_csv(const Atlas& atlas) {
  std::string out = "family,method,verdict,worst_error,parameter\n";
  for (std::size_t f = 0; f < atlas.families.size(); ++f)
    for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
      const AtlasCell& cell = atlas.cells[f][m];
      out += atlas.families[f].name + ",\"" + atlas.methods[m].name + "\"," + verdict_names[static_cast<std::size_t>(cell.verdict)] + "," + number(cell.worst_error) + "," + number(cell.parameter) + "\n";
    }
  return out;
}

std::string atlas_json(const Atlas& atlas) {
  nlohmann::ordered_json out{{"format", "gjk-atlas"}, {"version", 1}, {"generator", generator_name()}};
  out["families"] = nlohmann::ordered_json::array();
  for (std::size_t f = 0; f < atlas.families.size(); ++f) {
    nlohmann::ordered_json family{{"name", atlas.families[f].name}, {"what", atlas.families[f].what}, {"cases", atlas.families[f].cases.size()}};
    family["cells"] = nlohmann::ordered_json::array();
    for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
      const AtlasCell& cell = atlas.cells[f][m];
      nlohmann::ordered_json entry{{"method", atlas.methods[m].name}, {"verdict", verdict_names[static_cast<std::size_t>(cell.verdict)]}, {"parameter", cell.parameter}};
      entry["worst_error"] = std::isfinite(cell.worst_error) ? nlohmann::ordered_json(cell.worst_error) : nlohmann::ordered_json(nullptr);
      if (cell.verdict >= Verdict::gave_up) {
        SceneFile worst;
        worst.scene = cell.scene;
        worst.scene.name = atlas.families[f].name + ", " + atlas.methods[m].name;
        worst.method = atlas.methods[m].method;
        entry["scene"] = scene_to_json(worst);
      }
      family["cells"].push_back(entry);
    }
    out["families"].push_back(family);
  }
  return pretty_json(out) + "\n";
}

std::string atlas_gnuplot(const Atlas& atlas, const std::string& terminal, const std::string& file) {
  std::string out = "set terminal " + terminal + "\nset output '" + file + "'\nset title 'Stability where methods fail: the worst of each family' font ',14'\nset rmargin 34\n";
  // Right is blue-green, towards vermilion the more serious; the digit says it too.
  out += "set palette maxcolors 7 defined (0 '#009E73', 1 '#9BD7C3', 2 '#F0E442', 3 '#E69F00', 4 '#CC79A7', 5 '#D55E00', 6 '#000000')\nset cbrange [-0.5:6.5]\nset cbtics (";
  for (std::size_t i = 0; i < verdict_names.size(); ++i) out += (i > 0 ? ", " : "") + std::string("'") + verdict_names[i] + "' " + std::to_string(i);
  out += ")\nset xrange [-0.5:" + std::to_string(atlas.methods.size()) + "-0.5]\nset yrange [" + std::to_string(atlas.families.size()) + "-0.5:-0.5]\nset xtics rotate by 20 right (";
  for (std::size_t m = 0; m < atlas.methods.size(); ++m) out += (m > 0 ? ", " : "") + std::string("'") + atlas.methods[m].name + "' " + std::to_string(m);
  out += ")\nset ytics (";
  for (std::size_t f = 0; f < atlas.families.size(); ++f) out += (f > 0 ? ", " : "") + std::string("'") + atlas.families[f].name + "' " + std::to_string(f);
  out += ")\nunset key\nplot '-' using 1:2:3 with image, '-' using 1:2:3 with labels font ',9'\n";
  for (std::size_t f = 0; f < atlas.families.size(); ++f)
    for (std::size_t m = 0; m < atlas.methods.size(); ++m) out += std::to_string(m) + " " + std::to_string(f) + " " + std::to_string(static_cast<int>(atlas.cells[f][m].verdict)) + "\n";
  out += "e\n";
  for (std::size_t f = 0; f < atlas.families.size(); ++f)
    for (std::size_t m = 0; m < atlas.methods.size(); ++m) out += std::to_string(m) + " " + std::to_string(f) + " " + number(atlas.cells[f][m].worst_error) + "\n";
  return out + "e\n";
}

}  // namespace gjkdbg
