// Where a mesh's corners are: each of its triangles has a run of its own in a recording, and none of them is to be looked for among all others.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "shapes/shape.h"

namespace gjkdbg {

/// Finds the triangles that have a corner near a place, without going through all of them.
class CornerFinder {
 public:
  explicit CornerFinder(const Mesh& mesh);
  /// Ascending: all that have a corner no farther than `reach` from a place in the mesh's own frame, and others.
  std::vector<int> near(const AnyVector& place, double reach) const;
  /// Whether a corner is no farther than that.
  bool any_near(const AnyVector& place, double reach) const;
  /// No corner is farther from the mesh's origin.
  double extent() const { return extent_; }

 private:
  std::pair<std::size_t, std::size_t> slice(double from, double to) const;

  const Mesh& mesh_;
  std::vector<std::pair<double, int>> along_x_;  ///< corners by their first coordinate
  std::vector<std::vector<int>> triangles_;      ///< of each corner
  double extent_ = 0;
};
/// Of the meshes asked for so far.
using CornerFinders = std::map<const Mesh*, CornerFinder>;

}  // namespace gjkdbg
