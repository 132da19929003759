#include "recordings/comparison.h"

#include <algorithm>
#include <cmath>

#include "recordings/json_reading.h"
#include "recordings/json_writing.h"

namespace gjkdbg {
namespace {

std::string text_of(const Event& event) {
  std::string text;
  append_event(text, event);
  return text;
}

std::string text_of(const Result& result, Query query) {
  std::string text;
  append_result(text, result, query);
  return text;
}

/// Names of the fields in which two JSON objects differ.
std::vector<std::string> differing_fields(const std::string& left, const std::string& right) {
  const Json a = Json::parse(left), b = Json::parse(right);
  std::vector<std::string> names;
  for (const auto& [key, value] : a.items())
    if (!b.contains(key) || b[key].dump() != value.dump()) names.push_back(key);
  for (const auto& [key, value] : b.items())
    if (!a.contains(key)) names.push_back(key);
  return names;
}

Difference difference(std::size_t event, std::string what, std::string left, std::string right, bool fields) {
  Difference d{event, std::move(what), {}, std::move(left), std::move(right)};
  if (fields) d.fields = differing_fields(d.left, d.right);
  return d;
}

}  // namespace

std::optional<Difference> first_difference(const Recording& a, const Recording& b) {
  const std::size_t longer = std::max(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < longer; ++i) {
    const std::string left = i < a.events.size() ? text_of(a.events[i]) : "", right = i < b.events.size() ? text_of(b.events[i]) : "";
    if (left == right) continue;
    const bool comparable = !left.empty() && !right.empty() && a.events[i].index() == b.events[i].index();
    return difference(i, "event " + std::to_string(i), left, right, comparable);
  }
  const std::string left = text_of(a.result, a.scene.scene.query), right = text_of(b.result, b.scene.scene.query);
  if (left == right) return std::nullopt;
  return difference(longer, "result", left, right, true);
}

std::optional<Difference> verify(const Recording& recording) {
  return first_difference(recording, record(recording.scene, recording.settings));
}

std::vector<std::string> missed_expectations(const SceneFile& scene, const Result& result) {
  std::vector<std::string> missed;
  if (!scene.expect) return missed;
  const Expectation& e = *scene.expect;
  const auto number = [](double x) {
    std::string text;
    append_number(text, x);
    return text;
  };
  if (e.intersecting && *e.intersecting != result.intersecting)
    missed.push_back(std::string("intersecting is ") + (result.intersecting ? "true" : "false") + ", expected " + (*e.intersecting ? "true" : "false"));
  if (e.signed_distance && result.signed_distance && !(std::abs(*result.signed_distance - *e.signed_distance) <= e.tolerance))
    missed.push_back("signed_distance is " + number(*result.signed_distance) + ", expected " + number(*e.signed_distance) + " within " + number(e.tolerance));
  if (e.time && !(result.time && std::abs(*result.time - *e.time) <= e.tolerance))
    missed.push_back("time is " + (result.time ? number(*result.time) : std::string("not known")) + ", expected " + number(*e.time) + " within " + number(e.tolerance));
  if (e.normal && result.normal && !((*result.normal - *e.normal).cwiseAbs().maxCoeff() <= e.tolerance)) {
    std::string is, expected;
    append_vector(is, *result.normal);
    append_vector(expected, *e.normal);
    missed.push_back("normal is " + is + ", expected " + expected + " within " + number(e.tolerance));
  }
  return missed;
}

}  // namespace gjkdbg
