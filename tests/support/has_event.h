// What kinds of steps a recording has, for tests.
#pragma once

#include <algorithm>
#include <string_view>

#include "recordings/recording.h"

namespace gjkdbg {

inline bool has_event(const Recording& run, std::string_view kind) {
  return std::any_of(run.events.begin(), run.events.end(), [&](const Event& e) { return kind_name(e) == kind; });
}

}  // namespace gjkdbg
