// Which part of a simplex is nearest the origin, and what the test for each part says.
#pragma once

#include <vector>

#include "shapes/vector.h"

namespace gjkdbg {

/// One part of a simplex (a vertex, an edge, a face, the whole) as a candidate for the nearest.
struct RegionTest {
  std::vector<int> part;         ///< positions in the simplex
  std::vector<double> weights;   ///< of the origin's projection on the part's plane, in the order of `part`; they sum to 1
  double distance = 0;           ///< of that projection from the origin
  bool holds_projection = false; ///< all weights >= 0: the projection lies in the part
  bool nearest = false;          ///< of the parts that hold theirs, this is the one
  double margin = 0;             ///< the weight nearest zero: how close the test was to the other answer
};

/// All parts, single vertices first. `points`: 1 to 8, of equal dimension. A part without extent (repeated or collinear vertices) is left
/// out. A weight down to -slack counts as none.
std::vector<RegionTest> region_tests(const std::vector<AnyVector>& points, double slack = 0);

}  // namespace gjkdbg
