// Finding a step by a text, or by a condition.
#include <algorithm>
#include <cctype>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"

namespace gjkdbg {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

namespace {

/// The next step after `from`, or before it, round and round, whose text holds what is looked for.
template <class TextOf>
std::optional<std::size_t> next_with(const std::string& wanted, std::size_t count, std::size_t from, bool backwards, const TextOf& text_of) {
  for (std::size_t k = 1; k <= count; ++k) {
    const std::size_t step = backwards ? (from + count - k) % count : (from + k) % count;
    if (lower_case(text_of(step)).find(wanted) != std::string::npos) return step;
  }
  return std::nullopt;
}

constexpr std::size_t most_explained = 20000;  // so that a search for what is nowhere takes no longer than a breath

}  // namespace

/// The list comes first: its words (grow, face) stand in many sentences, and would be found at almost every step.
std::optional<std::size_t> find_text(const Session& session, const std::string& text, std::size_t from, bool backwards) {
  if (text.empty()) return std::nullopt;
  const Recording& recording = session.recording();
  if (text.find_first_of("<>=") != std::string::npos || text.starts_with("any ")) return find_step(Condition(text), recording, session.findings(), from, backwards);
  const std::string wanted = lower_case(text);
  const std::size_t count = recording.events.size();
  const auto listed = [&](std::size_t step) {
    const Event& event = recording.events[step];
    return std::string(kind_name(event)) + " " + short_kind(event) + " " + summary(recording, step);
  };
  if (const auto step = next_with(wanted, count, from, backwards, listed); step || count > most_explained) return step;
  Replay replay(recording);
  return next_with(wanted, count, from, backwards, [&](std::size_t step) {
    const Explanation e = explain(recording, replay.at(step));
    return e.title + "\n" + e.text;
  });
}

}  // namespace gjkdbg
