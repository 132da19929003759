// check, what rounding leaves of the nearest point of a simplex.
#include <algorithm>
#include <cmath>
#include <limits>

#include "recordings/check_context.h"

namespace gjkdbg {

/// A vertex is known to u times the size of the numbers it is made of, and so is v, where the simplex is well shaped: 64 u, for the weights are rounded, too. Of a sliver
/// whose longest edge is L and which is h thin, weights are quotients of cofactors, which are made of squares of edges: Johnson's and the Voronoi regions' of terms of L^2 for
/// a difference of h^2, so that they are off by u (L / h)^2, and with them v by that share of the size; or another part is taken for the nearest, from which v is as far.
double CheckContext::rounding_of(const std::vector<AnyVector>& points) const {
  if (foreign(recording) || points.empty()) return 0;
  std::vector<AnyVector> rest;
  for (const AnyVector& p : points) rest.push_back(p - points[0]);
  double longest = 0, thin = 0;
  const auto spans = std::min(static_cast<std::size_t>(dimension), points.size() - 1);
  for (std::size_t i = 0; i < spans; ++i) {
    const AnyVector farthest = *std::max_element(rest.begin(), rest.end(), [](const AnyVector& x, const AnyVector& y) { return x.norm() < y.norm(); });
    thin = farthest.norm();
    if (i == 0) longest = thin;
    if (thin == 0) break;
    for (AnyVector& p : rest) p -= farthest.dot(p) / (thin * thin) * farthest;
  }
  const double ratio = spans == 0 ? 1 : longest / std::max(thin, std::numeric_limits<double>::min());
  return std::min(64 * epsilon() * size * ratio * ratio, size) + world;
}

/// Whether no simplex since that step has come nearer than the others by more than rounding tells: where the search went round, it went round on the spot.
bool GjkCheck::no_nearer_since(std::size_t step) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0, rounding = 0;
  for (auto r = reached_.rbegin(); r != reached_.rend() && r->step >= step; ++r)
    nearest = std::min(nearest, r->v.norm()), farthest = std::max(farthest, r->v.norm()), rounding = std::max(rounding, r->rounding);
  return farthest - nearest <= rounding;
}

void CheckContext::find_stall(const char* code, const std::string& message) {
  if (!found(code)) costs_.insert(code), stalls_.insert(code);
  find(code, message);
}

}  // namespace gjkdbg
