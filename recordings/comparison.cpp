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
  const auto text = [](const auto& x) {
    std::string out;
    if constexpr (std::is_same_v<decltype(x), const double&>) append_number(out, x);
    else append_vector(out, x);
    return out;
  };
  // What the query does not answer, or this run does not know, is not as expected either.
  const auto compare = [&](const char* name, const auto& is, const auto& expected, const auto& error) {
    if (!expected || (is && error(*is, *expected) <= e.tolerance)) return;
    missed.push_back(std::string(name) + " is " + (is ? text(*is) : "not known") + ", expected " + text(*expected) + " within " + text(e.tolerance));
  };
  const auto difference = [](double a, double b) { return std::abs(a - b); };
  if (e.intersecting && *e.intersecting != result.intersecting)
    missed.push_back(std::string("intersecting is ") + (result.intersecting ? "true" : "false") + ", expected " + (*e.intersecting ? "true" : "false"));
  compare("signed_distance", result.signed_distance, e.signed_distance, difference);
  compare("time", result.time, e.time, difference);
  compare("normal", result.normal, e.normal, [](const AnyVector& a, const AnyVector& b) { return (a - b).cwiseAbs().maxCoeff(); });
  return missed;
}

}  // namespace gjkdbg
