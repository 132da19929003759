// How numbers, vectors and lists stand in the messages of `check`, and of the solver protocol.
#pragma once

#include <string>
#include <vector>

#include "shapes/vector.h"

namespace gjkdbg {

std::string text_of(double x);
/// A bound; one that is not known says so.
std::string bound_text(double x);
std::string text_of(const AnyVector& v);
std::string list_of(const std::vector<int>& numbers);
/// What the order of the vertices in triangles of a polytope means for who finds a horizon by cancelling edges; for the end of a message, or empty.
std::string winding_hint(const std::vector<std::vector<int>>& faces);
/// What a distance is that was measured along a normal of this length.
std::string by_length(double length);

}  // namespace gjkdbg
