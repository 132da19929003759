// check: walks a recording, our own or another implementation's, and says what is wrong, the first wrong step first.
//
// Every step is judged by what the recording holds (vertices, directions, simplices, faces) and by the scene's own support
// mappings; the answer by our core's, with its certificate. Where the answer is not unique (ties, touching within rounding) any of the right
// ones passes. The codes are listed in recordings/README.md.
#pragma once

#include <string>
#include <vector>

#include "recordings/recording.h"

namespace gjkdbg {

struct Finding {
  std::size_t step = 0;  ///< index of the event; of the last one when the result is meant
  enum class Severity { error, warning } severity = Severity::error;  ///< warning: it merely costs, or is merely written wrongly
  std::string code;
  std::string message;  ///< what is wrong, with the numbers, what was expected, the usual cause
};

/// The first finding of every code, in the order of steps. Those after the first error begin with "Follows from step N, probably.", of the same step with "Of the same cause, probably."
std::vector<Finding> check(const Recording& recording);

/// {"findings": [ … ]}
std::string findings_to_json(const std::vector<Finding>& findings);

}  // namespace gjkdbg
