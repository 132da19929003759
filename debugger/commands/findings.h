// Findings for people, or as JSON, on standard output.
#pragma once

#include <vector>

#include "recordings/check.h"

namespace gjkdbg {

void print_findings(const std::vector<Finding>& findings, bool json);

}  // namespace gjkdbg
