#include "recordings/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "recordings/json_reading.h"
#include "recordings/json_writing.h"
#include "shapes/convex.h"
#include "shapes/corners.h"
#include "shapes/world_support.h"

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
  // What the query does not ask for is not written, and yet may be told by a file.
  text.pop_back();
  const auto beyond = [&](std::string_view name, const auto& field, const auto& append) {
    if (!field || text.find('"' + std::string(name) + "\":") != std::string::npos) return;
    text += ",\"" + std::string(name) + "\":";
    append(*field);
  };
  const auto number = [&](double x) { append_number(text, x); };
  const auto vector = [&](const AnyVector& v) { append_vector(text, v); };
  beyond("signed_distance", result.signed_distance, number);
  beyond("normal", result.normal, vector);
  beyond("witness_a", result.witness_a, vector);
  beyond("witness_b", result.witness_b, vector);
  beyond("lower_bound", result.lower_bound, number);
  beyond("upper_bound", result.upper_bound, number);
  beyond("time", result.time, number);
  beyond("touching_at", result.touching_at, number);
  beyond("energy", result.energy, number);
  beyond("pair", result.pair, [&](const std::array<int, 2>& pair) { text += '[' + std::to_string(pair[0]) + ',' + std::to_string(pair[1]) + ']'; });
  beyond("bodies", result.bodies, [&](const std::vector<FinalState>& bodies) { text += std::to_string(bodies.size()); });
  return text + '}';
}

/// Numbers may differ by `share` of the greatest of them and `size`.
bool nearly_same(const Json& a, const Json& b, double size, double share = 1e-4) {
  if (a.is_number_float() || b.is_number_float()) {
    if (!a.is_number() || !b.is_number()) return false;
    const double x = a.get<double>(), y = b.get<double>();
    return std::abs(x - y) <= share * std::max({size, std::abs(x), std::abs(y)});
  }
  if (a.type() != b.type() || a.size() != b.size()) return false;
  if (a.is_array()) return std::equal(a.begin(), a.end(), b.begin(), [&](const Json& x, const Json& y) { return nearly_same(x, y, size, share); });
  if (a.is_object()) return std::all_of(a.items().begin(), a.items().end(), [&](const auto& item) { return b.contains(item.key()) && nearly_same(item.value(), b[item.key()], size, share); });
  return a == b;
}

/// Names of the fields in which two JSON objects are not the same.
template <class Same>
std::vector<std::string> differing_fields(const Json& a, const Json& b, const Same& same) {
  std::vector<std::string> names;
  for (const auto& [key, value] : a.items())
    if (!b.contains(key) || !same(value, b[key])) names.push_back(key);
  for (const auto& [key, value] : b.items())
    if (!a.contains(key)) names.push_back(key);
  return names;
}

/// The largest difference of two numbers at the same place; NaN where whole numbers, words, or how many there are differ.
double largest_difference(const Json& a, const Json& b) {
  constexpr double other = std::numeric_limits<double>::quiet_NaN();
  if (a == b) return 0;
  if (a.is_number() && b.is_number() && (a.is_number_float() || b.is_number_float())) return std::abs(a.get<double>() - b.get<double>());
  if (a.type() != b.type() || !a.is_structured() || a.size() != b.size()) return other;
  double most = 0;
  for (auto x = a.begin(), y = b.begin(); x != a.end(); ++x, ++y) {
    const double here = largest_difference(*x, *y);
    if (std::isnan(here) || (a.is_object() && x.key() != y.key())) return other;
    most = std::max(most, here);
  }
  return most;
}

template <class Same>
std::optional<Difference> first_not(const Same& same, const Recording& a, const Recording& b, std::size_t from = 0) {
  const auto difference = [&](std::size_t event, std::string what, std::string left, std::string right, bool comparable) -> std::optional<Difference> {
    Difference d{event, std::move(what), {}, std::move(left), std::move(right), {}};
    if (!comparable) return d;
    const Json one = Json::parse(d.left), two = Json::parse(d.right);
    d.fields = differing_fields(one, two, same);
    if (d.fields.empty()) return std::nullopt;
    for (const std::string& name : d.fields) d.by.push_back(one.contains(name) && two.contains(name) ? largest_difference(one[name], two[name]) : std::numeric_limits<double>::quiet_NaN());
    return d;
  };
  const std::size_t longer = std::max(a.events.size(), b.events.size());
  for (std::size_t i = from; i < longer; ++i) {
    std::string left = i < a.events.size() ? text_of(a.events[i]) : "", right = i < b.events.size() ? text_of(b.events[i]) : "";
    if (left == right) continue;
    const bool comparable = !left.empty() && !right.empty() && a.events[i].index() == b.events[i].index();
    if (auto d = difference(i, "event " + std::to_string(i), std::move(left), std::move(right), comparable)) return d;
  }
  std::string left = text_of(a.result, a.scene.scene.query), right = text_of(b.result, b.scene.scene.query);
  if (left == right) return std::nullopt;
  return difference(longer, "result", std::move(left), std::move(right), true);
}

}  // namespace

std::optional<Difference> first_difference(const Recording& a, const Recording& b) {
  return first_not([](const Json& x, const Json& y) { return x.dump() == y.dump(); }, a, b);
}

std::vector<std::string> differing_premises(const Recording& a, const Recording& b) {
  const auto premises = [](const Recording& r) { return Json::parse(recording_to_text({r.generator, r.scene, r.settings, {}, r.result})); };
  const Json left = premises(a), right = premises(b);
  std::vector<std::string> names;
  for (const char* name : {"scene", "method"})
    if (left[name] != right[name]) names.emplace_back(name);
  return names;
}

namespace {

/// The largest coordinate of the difference that was met.
double size_of_difference(const Recording& a) {
  double size = 0;
  for (const Event& event : a.events)
    if (const auto* query = std::get_if<recorded::SupportQueried>(&event)) size = std::max(size, query->w.cwiseAbs().maxCoeff());
  return size;
}

}  // namespace

std::optional<Difference> first_other_way(const Recording& a, const Recording& b) {
  const double size = size_of_difference(a);
  return first_not([&](const Json& x, const Json& y) { return nearly_same(x, y, size); }, a, b);
}

std::optional<Difference> first_other_step(const Recording& a, const Recording& b, std::size_t from) {
  const double size = size_of_difference(a), share = a.settings.scalar == b.settings.scalar ? 1e-9 : 1e-4;
  const auto unknown = [](const Json& x) { return x.is_null() || (x.is_array() && x.empty()); };
  return first_not([&](const Json& x, const Json& y) { return unknown(x) || unknown(y) || nearly_same(x, y, size, share); }, a, b, from);
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
  if (e.intersecting && (unanswered(result) || *e.intersecting != result.intersecting))
    missed.push_back(std::string("intersecting is ") + (unanswered(result) ? "not known" : result.intersecting ? "true" : "false") + ", expected " + (*e.intersecting ? "true" : "false"));
  compare("signed_distance", result.signed_distance, e.signed_distance, difference);
  compare("time", result.time, e.time, difference);
  compare("normal", result.normal, e.normal, [](const AnyVector& a, const AnyVector& b) { return (a - b).cwiseAbs().maxCoeff(); });
  return missed;
}

std::vector<std::string> missed_by_solver(const SceneFile& scene, const Recording& run) {
  if (!scene.expect || unanswered(run.result)) return {};
  const Scene& bodies = scene.scene;
  const bool round = std::any_of(bodies.bodies.begin(), bodies.bodies.end(), [&](const Body& b) { return WorldSupport(b, bodies.dimension).radius() > 0 || !corners_of(b.shape, bodies.dimension); });
  const double share = std::max(round || run.settings.scalar == Scalar::float_precision ? 1e-3 : 1e-6, 8 * run.settings.tolerance);
  double size = 0;
  for (const Body& body : bodies.bodies) size = std::max(size, size_of(body.shape));
  SceneFile of_distance = scene, of_normal = scene;
  Result result = run.result;
  if (bodies.query == Query::distance && result.intersecting && result.signed_distance) result.signed_distance = std::max(0.0, *result.signed_distance);
  of_distance.expect->tolerance = std::max(scene.expect->tolerance, share * std::max(size, std::abs(scene.expect->signed_distance.value_or(0))));
  of_distance.expect->normal.reset();
  if (!result.signed_distance) of_distance.expect->signed_distance.reset();
  // Next to touching either answer is right, and so is any normal; of round bodies one that is off by x makes the distance wrong by x^2 only, if by that.
  Expectation& e = *of_distance.expect;
  const bool touching = result.signed_distance && std::abs(*result.signed_distance) <= e.tolerance && std::abs(e.signed_distance.value_or(0)) <= e.tolerance;
  if (touching) e.intersecting.reset();
  std::vector<std::string> missed = missed_expectations(of_distance, result);
  if (touching || round || !result.normal) return missed;
  of_normal.expect->tolerance = std::max(scene.expect->tolerance, std::sqrt(2 * share));
  of_normal.expect->intersecting.reset(), of_normal.expect->signed_distance.reset();
  for (std::string& what : missed_expectations(of_normal, result)) missed.push_back(std::move(what));
  return missed;
}

}  // namespace gjkdbg
