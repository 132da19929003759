// The step at which a run of our own begins to go wrong, beside the run of the default method.
#pragma once

#include <optional>
#include <string>

#include "recordings/recording.h"

namespace gjkdbg {

struct WrongStep {
  std::size_t step = 0;
  std::string why;  ///< a few words
};

/// Of MPR the first portal that the shortest way out does not go through, or the vertex on its ray where it ends without one, of GJK in another form the first step that goes another way; nothing where the
/// answers agree, or where it cannot be told.
std::optional<WrongStep> where_it_goes_wrong(const Recording& run);

}  // namespace gjkdbg
