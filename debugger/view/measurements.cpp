#include "debugger/view/measurements.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "recordings/json_reading.h"
#include "shapes/error.h"

#include <nlohmann/json.hpp>

namespace gjkdbg {
namespace {

/// Reads the objects of the list that stands at `key`, if there is one.
template <class Read>
void each_if_there(ObjectReader& parent, std::string_view key, const Read& read) {
  const Json* there = parent.optional(key);
  if (!there) return;
  const Json& list = *there;
  const Place place = parent.at(key);
  if (!list.is_array()) reject(place, "wrong-type", "must be a list");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Place here(place, i);
    ObjectReader object(list[i], here);
    read(object);
  }
}
template <class Read>
void each(ObjectReader& parent, std::string_view key, const Read& read) {
  (void)parent.required(key);
  each_if_there(parent, key, read);
}

SceneFile scene_at(const Json& json, const Place& place) {
  try {
    return scene_from_json(json, {});
  } catch (const Error& e) {
    throw Error(e.code(), e.message(), place.pointer() + e.where());
  }
}

/// The index of a name in a list that it joins when it is new.
int index_of(std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) return static_cast<int>(at - names.begin());
  names.push_back(name);
  return static_cast<int>(names.size()) - 1;
}

double number_at(ObjectReader& object, std::string_view key) { return read_number(object.required(key), object.at(key)); }
int count_at(ObjectReader& object, std::string_view key) { return read_integer(object.required(key), object.at(key), 0, 1000000); }
std::optional<double> number_if_there(ObjectReader& object, std::string_view key) {
  const Json* there = object.optional(key);
  return there ? std::optional(read_number(*there, object.at(key))) : std::nullopt;
}
/// A time or another number that is shown on a logarithmic scale.
double positive_at(ObjectReader& object, std::string_view key) {
  const double x = number_at(object, key);
  if (!(x > 0)) reject(object.at(key), "out-of-range", "must be positive");
  return x;
}
std::string string_at(ObjectReader& object, std::string_view key) { return read_string(object.required(key), object.at(key)); }

MeasuredRung read_rung(ObjectReader& object) {
  MeasuredRung rung{string_at(object, "shapes"), string_at(object, "method"), number_at(object, "distance"), number_at(object, "iterations"), number_at(object, "deviation"), 0, 0, {}, {}, {}};
  rung.nanoseconds = number_if_there(object, "nanoseconds").value_or(0), rung.published_nanoseconds = number_if_there(object, "published_nanoseconds");
  if (object.optional("vertices")) rung.vertices = count_at(object, "vertices");
  if (const Json* published = object.optional("published")) {
    const Place here = object.at("published");
    ObjectReader figures(*published, here);
    rung.published = number_at(figures, "iterations"), rung.published_deviation = number_at(figures, "deviation");
  }
  return rung;
}

MeasuredChart read_chart(ObjectReader& top) {
  MeasuredChart chart;
  each(top, "families", [&](ObjectReader& object) {
    MeasuredFamily family{string_at(object, "name"), string_at(object, "title"), count_at(object, "pairs"), {}, {}};
    each(object, "points", [&](ObjectReader& dot) {
      MeasuredDot d;
      d.method = index_of(chart.methods, string_at(dot, "method"));
      d.tolerance = number_at(dot, "tolerance"), d.nanoseconds = positive_at(dot, "nanoseconds"), d.worst_error = number_at(dot, "worst_error");
      d.median_gap = number_if_there(dot, "median_gap").value_or(0);
      d.wrong = count_at(dot, "wrong"), d.worst_pair = count_at(dot, "worst_pair"), d.front = read_bool(dot.required("front"), dot.at("front"));
      family.dots.push_back(d);
    });
    const Place scenes = object.at("scenes");
    if (const Json* list = object.optional("scenes"))
      for (const auto& [key, scene] : list->items()) family.scenes[std::atoi(key.c_str())] = scene_at(scene, Place(scenes, key));
    chart.families.push_back(std::move(family));
  });
  each_if_there(top, "ladder", [&](ObjectReader& object) { chart.ladder.push_back(read_rung(object)); });
  each_if_there(top, "price", [&](ObjectReader& o) { chart.price.push_back({string_at(o, "what"), positive_at(o, "nanoseconds"), number_at(o, "worst_error"), number_at(o, "supports")}); });
  each_if_there(top, "motion", [&](ObjectReader& o) { chart.motion.push_back({string_at(o, "family"), string_at(o, "method"), number_at(o, "parameter"), positive_at(o, "nanoseconds"), number_at(o, "worst_error")}); });
  chart.settings.resize(chart.methods.size());
  const Place methods = top.at("methods");
  if (const Json* list = top.optional("methods"))
    for (const auto& [name, method] : list->items())
      if (const auto at = std::find(chart.methods.begin(), chart.methods.end(), name); at != chart.methods.end())
        chart.settings[static_cast<std::size_t>(at - chart.methods.begin())] = method_from_json(method, Place(methods, name).pointer(), 3);
  return chart;
}

MeasuredAtlas read_atlas(ObjectReader& top) {
  MeasuredAtlas atlas;
  constexpr int most = 1'000'000;  // cases
  each(top, "families", [&](ObjectReader& object) {
    MeasuredAtlas::Family family{string_at(object, "name"), string_at(object, "what"), {}};
    const Json* const cases = object.optional("cases");
    each(object, "cells", [&](ObjectReader& cell) {
      MeasuredCell c;
      const auto method = static_cast<std::size_t>(index_of(atlas.methods, string_at(cell, "method")));
      c.verdict = static_cast<int>(read_enum(cell.required("verdict"), cell.at("verdict"), atlas_verdicts));
      const Json& error = cell.required("worst_error");
      c.worst_error = error.is_null() ? std::numeric_limits<double>::infinity() : read_number(error, cell.at("worst_error"));
      c.parameter = number_at(cell, "parameter");
      if (const Json* failed = cell.optional("failed"); failed && cases) c.how_often = std::to_string(read_integer(*failed, cell.at("failed"), 0, most)) + " of " + std::to_string(read_integer(*cases, object.at("cases"), 0, most));
      if (cell.optional("why")) c.why = string_at(cell, "why");
      if (const Json* scene = cell.optional("scene")) c.scene = scene_at(*scene, cell.at("scene"));
      if (family.cells.size() <= method) family.cells.resize(method + 1);
      family.cells[method] = std::move(c);
    });
    atlas.families.push_back(std::move(family));
  });
  for (auto& family : atlas.families) family.cells.resize(atlas.methods.size());
  return atlas;
}

}  // namespace

MeasurementKind read_measurements(const std::filesystem::path& file, Measurements& measurements) {
  if (file.filename().string().ends_with(".scene.json") || file.filename().string().ends_with(".recording.json")) return MeasurementKind::neither;
  const std::string text = read_text_file(file), beginning = text.substr(0, 200);
  if (beginning.find("\"gjk-chart\"") == std::string::npos && beginning.find("\"gjk-atlas\"") == std::string::npos) return MeasurementKind::neither;
  try {
    const Json json = parse_json(text);
    const Place root;
    ObjectReader top(json, root);
    const std::string format = string_at(top, "format");
    if (format == "gjk-chart") return measurements.chart = read_chart(top), MeasurementKind::chart;
    if (format == "gjk-atlas") return measurements.atlas = read_atlas(top), MeasurementKind::atlas;
    return MeasurementKind::neither;
  } catch (const Error& e) {
    throw e.in(file.string());
  }
}

}  // namespace gjkdbg
