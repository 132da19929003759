// check, our own recordings: what the same run once more shows to have been changed, and no rule tells.
#include <algorithm>
#include <cmath>

#include "recordings/check_context.h"
#include "recordings/comparison.h"
#include "recordings/json_writing.h"
#include "shapes/convex.h"
#include "shapes/error.h"

namespace gjkdbg {
namespace {

/// Where two lists of texts differ: what stands before and after is the same.
struct Stretch {
  std::size_t first, left, right;  ///< from which on, and how many of either side
};

std::vector<std::string> texts_of(const std::vector<Event>& events) {
  std::vector<std::string> texts(events.size());
  for (std::size_t i = 0; i < events.size(); ++i) append_event(texts[i], events[i]);
  return texts;
}

Stretch differing(const std::vector<std::string>& left, const std::vector<std::string>& right) {
  const std::size_t shorter = std::min(left.size(), right.size());
  std::size_t before = 0, after = 0;
  while (before < shorter && left[before] == right[before]) ++before;
  while (after < shorter - before && left[left.size() - 1 - after] == right[right.size() - 1 - after]) ++after;
  return {before, left.size() - before - after, right.size() - before - after};
}

/// Both sides of the first few fields that differ, as JSON, cut where they are long.
std::string both_sides(const Difference& d) {
  constexpr std::size_t fields = 2, longest = 160;
  const auto value = [](const std::string& object, const std::string& name) {
    const std::string key = '"' + name + "\":";
    const std::size_t from = object.find(key);
    if (from == std::string::npos) return std::string("missing");
    std::size_t end = from + key.size();
    for (int depth = 0; end < object.size() && (depth > 0 || (object[end] != ',' && object[end] != '}')); ++end) depth += (object[end] == '[' || object[end] == '{') - (object[end] == ']' || object[end] == '}');
    const std::string text = object.substr(from + key.size(), end - from - key.size());
    return text.size() > longest ? text.substr(0, longest) + " …" : text;
  };
  std::string out;
  for (std::size_t i = 0; i < std::min(fields, d.fields.size()); ++i) out += (i > 0 ? "; \"" : "\"") + d.fields[i] + "\" is " + value(d.left, d.fields[i]) + ", expected " + value(d.right, d.fields[i]);
  return out;
}

}  // namespace

/// Where the same run gives every event, and the result, but for one, that one was changed. Where more differs, this is the recording of another build, or
/// of another machine's sines: it may be as right. So may numbers be that differ in their last digits only.
void tell_changed(const Recording& recording, std::vector<Finding>& findings) {
  if (recording.generator != generator_name() || recording.events.empty()) return;
  Recording again;
  try {
    again = record(recording.scene, recording.settings);
  } catch (const Error&) {
    return;
  }
  const Stretch s = differing(texts_of(recording.events), texts_of(again.events));
  if (s.left > 1 || s.right > 1) return;
  const bool event = s.left + s.right > 0;
  const std::size_t step = std::min(s.first, recording.events.size() - 1);
  const auto only = [&](const Recording& r, std::size_t count, const Result& result) {
    const auto from = r.events.begin() + static_cast<std::ptrdiff_t>(s.first);
    return Recording{r.generator, r.scene, r.settings, {from, from + static_cast<std::ptrdiff_t>(count)}, result};
  };
  const std::optional<Difference> in_event = event ? first_difference(only(recording, s.left, recording.result), only(again, s.right, recording.result)) : std::nullopt;
  const std::optional<Difference> in_result = first_difference(only(recording, 0, recording.result), only(again, 0, again.result));
  if (in_event.has_value() == in_result.has_value()) return;
  const Difference& d = in_event ? *in_event : *in_result;
  double size = 0;
  for (const Body& body : recording.scene.scene.bodies) size = std::max(size, size_of(body.shape));
  if (!d.fields.empty() && std::all_of(d.by.begin(), d.by.end(), [&](double by) { return by <= 1e-12 * size; })) return;
  const auto here = [&](const Finding& f) { return f.step == step && f.code != "asks-too-much"; };
  const auto error = [](const Finding& f) { return f.severity == Finding::Severity::error; };
  const auto first = std::find_if(findings.begin(), findings.end(), error);
  const bool misled = first != findings.end() && first->step < step;
  if (!misled && std::any_of(findings.begin(), findings.end(), here)) return;
  // All other steps are as they should be: the errors told of them come of this one, which may say when, and of which bodies, those before it are.
  const std::optional<Finding> told = first == findings.end() ? std::nullopt : std::optional(*first);
  std::string what = !event ? "The result is not that of the scene: " + both_sides(d) + "."
                     : s.left == 0 ? "A step is missing here: \"" + std::string(kind_name(again.events[s.first])) + "\"."
                     : s.right == 0 ? "This step is one too many."
                     : d.fields.empty() ? "This step is none of the scene: expected is \"" + std::string(kind_name(again.events[s.first])) + "\"."
                                        : "This step is not that of the scene: " + both_sides(d) + ".";
  what += " All else is as the same run gives it once more: it was changed, or written wrongly.";
  if (told) what += " At step " + std::to_string(told->step) + ": " + told->message;
  const auto changed = [&](const char* name) { return in_event && std::find(d.fields.begin(), d.fields.end(), name) != d.fields.end(); };
  const std::string code = !told ? "inconsistent" : misled && changed("time") ? "wrong-time" : misled && changed("pair") ? "wrong-pair" : told->code;
  std::erase_if(findings, [&](const Finding& f) { return f.code == "inconsistent" || error(f); });
  const auto place = std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.step > step; });
  findings.insert(place, {step, told ? Finding::Severity::error : Finding::Severity::warning, code, what});
}

}  // namespace gjkdbg
