// Conditions over events: where playing stops, and what a search finds.
//
//   condition := clause { ("and" | "or") clause }        "and" binds closer
//   clause    := "any warning" | "any finding" | path [ operator value ]
//   path      := field { "." part }                        kind, status, iteration, region, upper_bound, closest, …
//   part      := size | norm | x | y | z
//   operator  := < <= > >= == !=
//   value     := a number or a word
//
// A path alone holds where the event has the field. A word alone that is no field holds where it is part of the kind's name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "recordings/check.h"
#include "recordings/recording.h"

namespace gjkdbg {

class Condition {
 public:
  /// Throws Error (code "bad-condition") that says what is wrong; empty text holds nowhere.
  explicit Condition(std::string_view text = {});

  bool holds(const Recording& recording, const std::vector<Finding>& findings, std::size_t step) const;
  const std::string& text() const { return text_; }

 private:
  struct Clause {
    std::string path, compare, word;
    double number = 0;
    bool is_number = false;
  };
  bool clause_holds(const Clause& clause, const Recording& recording, const std::vector<Finding>& findings, std::size_t step) const;

  std::string text_;
  std::vector<std::vector<Clause>> any_of_;  ///< of these, one must hold as a whole
};

/// The first step after `from` (before it, when backwards) where the condition holds, going around the ends; nothing when none does.
std::optional<std::size_t> find_step(const Condition& condition, const Recording& recording, const std::vector<Finding>& findings, std::size_t from, bool backwards);

}  // namespace gjkdbg
