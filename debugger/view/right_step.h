// What a right implementation would have done at a step of someone else's recording, from what that had.
#pragma once

#include <string>

#include "recordings/replay.h"

namespace gjkdbg {

/// A sentence or two; empty where there is nothing to compare, and for our own recordings.
std::string right_step(const Recording& recording, const Frame& frame);

}  // namespace gjkdbg
