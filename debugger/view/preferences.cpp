#include "debugger/view/preferences.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace gjkdbg {
namespace {

/// Every field by name, once: `each(name, value, low, high)`.
template <class P, class Each>
void walk(P& p, Each&& each) {
  each("dark", p.dark, 0, 1), each("linked_cameras", p.linked_cameras, 0, 1), each("newest_first", p.newest_first, 0, 1);
  each("left", p.left, 180, 900), each("right", p.right, 220, 900), each("bottom", p.bottom, 120, 900), each("split", p.split, 0.15, 0.85);
  each("difference", p.difference, 0, 1), each("support_plane", p.support_plane, 0, 1), each("dropped", p.dropped, 0, 1), each("labels", p.labels, 0, 1);
  each("grid", p.grid, 0, 1), each("regions", p.regions, 0, 1), each("bounds", p.bounds, 0, 1);
  each("speed", p.speed, 0.25, 8), each("width", p.width, 320, 16384), each("height", p.height, 240, 16384);
}

}  // namespace

std::string preferences_to_text(const Preferences& preferences) {
  nlohmann::ordered_json json;
  walk(preferences, [&](const char* name, const auto& value, double, double) { json[name] = value; });
  json["layout"] = static_cast<int>(preferences.layout);
  return json.dump(1) + "\n";
}

Preferences preferences_from_text(std::string_view text) {
  Preferences preferences;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return preferences;
  walk(preferences, [&](const char* name, auto& value, double low, double high) {
    using T = std::decay_t<decltype(value)>;
    const auto found = json.find(name);
    if (found == json.end()) return;
    if constexpr (std::is_same_v<T, bool>) {
      if (found->is_boolean()) value = found->template get<bool>();
    } else if (found->is_number()) {
      value = static_cast<T>(std::clamp(found->template get<double>(), low, high));
    }
  });
  if (const auto found = json.find("layout"); found != json.end() && found->is_number_integer())
    preferences.layout = static_cast<Layout>(std::clamp(found->get<int>(), 0, 3));
  return preferences;
}

}  // namespace gjkdbg
