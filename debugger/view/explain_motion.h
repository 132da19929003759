// What the steps of a motion mean: casts, states, contacts, impulses.
#pragma once

#include <string_view>

#include "debugger/render/step_pictures.h"
#include "debugger/view/explain.h"

namespace gjkdbg {

/// "iteration_limit": iteration limit.
std::string in_words(std::string_view name);

struct ExplainMotion {
  const Recording& recording;
  const Frame& frame;
  bool newest_first = true;  ///< A is the newest vertex of a simplex; else the oldest

  char letter_at(std::size_t place, std::size_t of) const { return vertex_letter(static_cast<std::ptrdiff_t>(newest_first ? place : of - 1 - place)); }

  Explanation operator()(const recorded::CastBegan& e) const;
  Explanation operator()(const recorded::CastAdvanced& e) const;
  Explanation operator()(const recorded::CastEnded& e) const;
  Explanation operator()(const recorded::State& e) const;
  Explanation operator()(const recorded::ContactFound& e) const;
  Explanation operator()(const recorded::ImpulseApplied& e) const;

 private:
  std::string body(int i) const { return body_name(recording, i); }
  const recorded::CastAdvanced* next_advance(const Edge& pair) const;
  bool responded() const;
  Explanation responds(const recorded::ImpulseApplied& e) const;
};

}  // namespace gjkdbg
