// How a phase ended. Every way out has a name of its own; reaching a limit never looks like an answer.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace gjkdbg {

enum class GjkStatus {
  converged,        ///< apart; the bounds agree within the tolerance or the rounding floor
  separated,        ///< apart, proven by a support plane; the distance was not asked for
  within_radius,    ///< the cores are nearer than the radii: overlap proven; no more was asked for
  enclosed,         ///< the simplex encloses the origin with volume to spare: the cores overlap
  touching,         ///< the simplex holds the origin within rounding, on a vertex, an edge or a face
  stalled,          ///< no progress is possible in this precision; the bounds say how much is known
  iteration_limit,  ///< the bounds say how much is known
  aborted,          ///< another implementation's run that ended without an answer; ours never does
  rule_met,         ///< another stopping rule than the bounds' ended it; the bounds say how much is known
};
inline constexpr std::array<std::string_view, 9> gjk_status_names{
    "converged", "separated", "within_radius", "enclosed", "touching", "stalled", "iteration_limit", "aborted", "rule_met"};
constexpr std::string_view word_of(GjkStatus x) { return gjk_status_names[static_cast<std::size_t>(x)]; }

enum class EpaStatus {
  converged,        ///< the bounds of the depth agree within the tolerance or the rounding floor
  flat,             ///< the difference has no volume: depth 0 (plus the radii), normal across it
  separated,        ///< the origin turned out to lie outside, by less than GJK could tell
  stalled,          ///< no face can be added in this precision; the last good face is the answer
  iteration_limit,  ///< the bounds say how much is known
  aborted,          ///< as above
};
inline constexpr std::array<std::string_view, 6> epa_status_names{"converged", "flat", "separated", "stalled",
                                                                  "iteration_limit", "aborted"};
constexpr std::string_view word_of(EpaStatus x) { return epa_status_names[static_cast<std::size_t>(x)]; }

enum class MprStatus {
  converged,        ///< the bodies overlap; the portal lies on the boundary, within the tolerance or the rounding floor
  overlapping,      ///< the bodies overlap; only that was asked
  separated,        ///< a support plane has the origin on its far side
  flat,             ///< the difference has no volume to look from: no answer
  stalled,          ///< no progress is possible in this precision; the portal so far is the answer
  iteration_limit,  ///< the portal so far is the answer, if it has passed the origin
};
inline constexpr std::array<std::string_view, 6> mpr_status_names{"converged", "overlapping", "separated", "flat", "stalled", "iteration_limit"};
constexpr std::string_view word_of(MprStatus x) { return mpr_status_names[static_cast<std::size_t>(x)]; }

enum class CastStatus {
  hit,                    ///< they meet; at `time` they are still apart, by no more than the tolerance times the scene's size, or as near as rounding lets it come
  miss,                   ///< they do not meet in the interval
  initially_overlapping,  ///< they overlap at the beginning, which is proven; the way out may not be known (algo/cast.h)
  at_rest,                ///< after responses: nothing moves any more (of the event cast_ended; a result has the status of the first meeting)
  iteration_limit,        ///< apart until `time`; no more is known
};
inline constexpr std::array<std::string_view, 5> cast_status_names{"hit", "miss", "initially_overlapping", "at_rest", "iteration_limit"};
constexpr std::string_view word_of(CastStatus x) { return cast_status_names[static_cast<std::size_t>(x)]; }

enum class SatStatus {
  overlapping,  ///< no axis separates; the least overlap is the depth
  separated,    ///< some axis does, by more than rounding; `normal` is the widest one known, or leads from one nearest point to the other
  undecided,    ///< the least overlap or the widest gap is within rounding: touching, or, where the difference is sharp, well apart; GJK decides
};
inline constexpr std::array<std::string_view, 3> sat_status_names{"overlapping", "separated", "undecided"};
constexpr std::string_view word_of(SatStatus x) { return sat_status_names[static_cast<std::size_t>(x)]; }

enum class ClosedFormStatus {
  separated,    ///< of the cores: the formula gives their distance
  overlapping,  ///< the cores share a point, up to rounding
};
inline constexpr std::array<std::string_view, 2> closed_form_status_names{"separated", "overlapping"};
constexpr std::string_view word_of(ClosedFormStatus x) { return closed_form_status_names[static_cast<std::size_t>(x)]; }

enum class ProjectionsStatus {
  separated,    ///< the nearest points of the cores, proven by the plane between them; of a yes or no, what is enough for it
  overlapping,  ///< a point is of both cores
  undecided,    ///< rounding, or the search, came to no proof: GJK goes on
};
inline constexpr std::array<std::string_view, 3> projections_status_names{"separated", "overlapping", "undecided"};
constexpr std::string_view word_of(ProjectionsStatus x) { return projections_status_names[static_cast<std::size_t>(x)]; }

/// A status in words, as a result has it: one of the names above, or what another program wrote. A view of a text that is there as long as the program runs: to make a text of its
/// own took 2 of the 42 ns that an answer takes for two rectangles.
class StatusWord : public std::string_view {
 public:
  StatusWord() = default;
  template <std::size_t size>
  constexpr StatusWord(const char (&literal)[size]) : std::string_view(literal, size - 1) {}  // implicit on purpose: a literal is one (not consteval, which ends clang 14)
  template <class Status>
    requires std::is_enum_v<Status>
  constexpr StatusWord(Status status) : std::string_view(word_of(status)) {}  // implicit on purpose, too
  std::string text() const { return std::string(*this); }
  /// The same text, kept from now on. From any thread.
  static StatusWord kept(std::string_view text);

 private:
  explicit StatusWord(std::string_view text) : std::string_view(text) {}
};

}  // namespace gjkdbg
