// The vertices that a frame refers to by number.
#pragma once

#include <map>
#include <vector>

#include "recordings/replay.h"

namespace gjkdbg {

/// The steps at which each number was given out.
std::map<int, std::vector<std::size_t>> index_vertices(const Recording& recording);
/// Fills in the vertices the frame refers to. One that nobody asked for before this step is left out.
void fill_vertices(Frame& frame, const Recording& recording, const std::map<int, std::vector<std::size_t>>& index);

}  // namespace gjkdbg
