#include "debugger/view/explain_motion.h"

#include <algorithm>

namespace gjkdbg {

std::string in_words(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

Explanation ExplainMotion::operator()(const recorded::CastBegan& e) const {
  return {"The cast begins", std::to_string(e.pairs.size()) + (e.pairs.size() == 1 ? " pair of bodies moves" : " pairs of bodies move") + " against each other. When do they meet for the first time?"};
}

Explanation ExplainMotion::operator()(const recorded::CastAdvanced& e) const {
  const std::string at = "At time " + short_number(e.time) + " " + body(e.pair[0]) + " and " + body(e.pair[1]) + " are " + short_number(e.distance) + " apart along " + short_vector(e.normal) + ". ";
  if (e.distance < 0) return {"Inside each other", body(e.pair[0]) + " and " + body(e.pair[1]) + " overlap by " + short_number(-e.distance) + " at time " + short_number(e.time) + ": they meet no later than that."};
  if (meets_at(recording, frame.step)) return {"They meet", at + "That is within the tolerance, and they still approach: this is the time of impact."};
  if (recording.settings.name == MethodName::root_finding)
    if (const auto* next = next_advance(e.pair)) return {"Surely apart for a while", at + "They come nearer by at most " + short_number(e.bound) + " per unit of time; along this normal, or one that turns on with them, the gap stays open until " + short_number(next->time) + "."};
  if (e.bound <= 0) return {"This pair recedes", at + "Along this normal they do not come nearer any more, so it separates them for good: the pair is left out."};
  return {"Surely apart for a while", at + "They come nearer by at most " + short_number(e.bound) + " per unit of time, so until " + short_number(e.time + std::max(0.0, e.distance) / e.bound) + " they cannot meet."};
}

/// Of the same pair, before anything responds.
const recorded::CastAdvanced* ExplainMotion::next_advance(const Edge& pair) const {
  for (std::size_t i = frame.step + 1; i < recording.events.size() && !std::holds_alternative<recorded::State>(recording.events[i]); ++i)
    if (const auto* next = std::get_if<recorded::CastAdvanced>(&recording.events[i]); next && next->pair == pair) return next;
  return nullptr;
}

bool ExplainMotion::responded() const {
  return std::any_of(recording.events.begin(), recording.events.end(), [](const Event& event) { return std::holds_alternative<recorded::ImpulseApplied>(event); });
}

Explanation ExplainMotion::operator()(const recorded::CastEnded& e) const {
  const std::string title = "The cast ends: " + in_words(word_of(e.status));
  const std::string who = e.pair.size() == 2 ? body(e.pair[0]) + " and " + body(e.pair[1]) : "";
  switch (e.status) {
    case CastStatus::hit: return {title, "At time " + short_number(e.time) + " " + who + " are within the tolerance of each other and still approaching: this is the time of impact, early by no more than that tolerance."};
    case CastStatus::miss: return responded() ? Explanation{"The cast ends: nothing more is hit", "Nothing more meets before the interval ends."} : Explanation{title, "No pair meets before the interval ends."};
    case CastStatus::initially_overlapping: return {title, who + " overlap at the beginning: there is no first time to look for." + (recording.result.normal ? "" : recording.settings.penetration == Penetration::none ? " Which way out is the nearest is not asked." : " Which way out is the nearest is not known: the search for it came to its limit.")};
    case CastStatus::at_rest: return {title, "Nothing moves any more."};
    case CastStatus::iteration_limit: return {title, "Until time " + short_number(e.time) + " all are surely apart; no more is known within the limit."};
  }
  return {title, {}};
}

Explanation ExplainMotion::operator()(const recorded::State& e) const {
  std::string text = "Where the bodies are at time " + short_number(e.time);
  if (recording.scene.scene.query == Query::simulate) text += ". Energy " + short_number(e.energy) + ", momentum " + short_vector(e.momentum);
  return {"State at " + short_number(e.time), text + "."};
}

Explanation ExplainMotion::operator()(const recorded::ContactFound& e) const {
  return {"A contact", body(e.pair[0]) + " and " + body(e.pair[1]) + " touch at " + short_place(recording, e.point) + ", " + short_number(e.depth) + " deep along " + short_vector(e.normal) + "."};
}

Explanation ExplainMotion::operator()(const recorded::ImpulseApplied& e) const {
  if (recording.scene.scene.query == Query::cast) return responds(e);
  std::string text = body(e.pair[1]) + " gets the impulse " + short_vector(e.impulse) + " at " + short_place(recording, e.point) + ", " + body(e.pair[0]) + " the opposite.";
  if (e.velocities_before.size() == 2 && e.velocities_after.size() == 2)
    text += " Velocities: " + short_vector(e.velocities_before[0]) + " to " + short_vector(e.velocities_after[0]) + " and " + short_vector(e.velocities_before[1]) + " to " + short_vector(e.velocities_after[1]) + ".";
  return {"An impulse", text};
}

/// A cast's bodies have no masses: those that move get other velocities.
Explanation ExplainMotion::responds(const recorded::ImpulseApplied& e) const {
  std::string text = body(e.pair[0]) + " and " + body(e.pair[1]) + " touch at " + short_place(recording, e.point) + ".";
  for (std::size_t k = 0; k < std::min(e.velocities_before.size(), e.velocities_after.size()) && k < 2; ++k)
    if (e.velocities_before[k] != e.velocities_after[k])
      text += " The velocity of " + body(e.pair[k]) + " goes from " + short_vector(e.velocities_before[k]) + " to " + short_vector(e.velocities_after[k]) + ".";
  return {"The motion responds", text};
}

}  // namespace gjkdbg
