// Findings for people, or as JSON.
#pragma once

#include <ostream>
#include <vector>

#include "recordings/check.h"

namespace gjkdbg {

void print_findings(const std::vector<Finding>& findings, bool json, std::ostream& out);

}  // namespace gjkdbg
