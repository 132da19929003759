// A recording's events as short readable lines, so that an expected list is the test.
#pragma once

#include <string>
#include <vector>

#include "recordings/recording.h"

namespace gjkdbg {

/// "support 3 (epa) along 0 0 1: w = 0 0 1", "simplex 1 0 -> 1 0", "gjk ended touching", … Numbers with four digits.
std::vector<std::string> event_log(const Recording& recording);

}  // namespace gjkdbg
