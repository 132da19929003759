#include "recordings/corner_finder.h"

#include <algorithm>

namespace gjkdbg {

CornerFinder::CornerFinder(const Mesh& mesh) : mesh_(mesh), triangles_(mesh.points.size()) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i) along_x_.emplace_back(mesh.points[i][0], static_cast<int>(i)), extent_ = std::max(extent_, mesh.points[i].stableNorm());
  std::sort(along_x_.begin(), along_x_.end());
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    for (const int corner : mesh.triangles[k]) triangles_[static_cast<std::size_t>(corner)].push_back(static_cast<int>(k));
}

/// The corners whose first coordinates lie from one number to another.
std::pair<std::size_t, std::size_t> CornerFinder::slice(double from, double to) const {
  const auto first = std::lower_bound(along_x_.begin(), along_x_.end(), std::pair(from, -1));
  const auto last = std::upper_bound(first, along_x_.end(), std::pair(to, static_cast<int>(along_x_.size())));
  return {static_cast<std::size_t>(first - along_x_.begin()), static_cast<std::size_t>(last - along_x_.begin())};
}

std::vector<int> CornerFinder::near(const AnyVector& place, double reach) const {
  std::vector<int> found;
  const auto [first, last] = slice(place[0] - reach, place[0] + reach);
  for (std::size_t i = first; i < last; ++i) {
    const auto corner = static_cast<std::size_t>(along_x_[i].second);
    if ((mesh_.points[corner] - place).cwiseAbs().maxCoeff() > reach) continue;
    found.insert(found.end(), triangles_[corner].begin(), triangles_[corner].end());
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool CornerFinder::any_near(const AnyVector& place, double reach) const {
  const auto [first, last] = slice(place[0] - reach, place[0] + reach);
  return std::any_of(along_x_.begin() + static_cast<std::ptrdiff_t>(first), along_x_.begin() + static_cast<std::ptrdiff_t>(last),
                     [&](const auto& corner) { return (mesh_.points[static_cast<std::size_t>(corner.second)] - place).norm() <= reach; });
}

}  // namespace gjkdbg
