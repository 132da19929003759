#include "recordings/region_tests.h"

#include <Eigen/QR>
#include <algorithm>
#include <bit>
#include <cmath>

namespace gjkdbg {

/// With p0 … pk the part's vertices, the projection of the origin is p0 + E t, E = (p1 - p0, …), where t minimises |p0 + E t|^2:
/// E^T E t = -E^T p0. The weights are 1 - sum t, t1, …, tk.
std::vector<RegionTest> region_tests(const std::vector<AnyVector>& points, double slack) {
  std::vector<RegionTest> tests;
  const int n = static_cast<int>(points.size());
  std::vector<unsigned> masks;
  for (unsigned mask = 1; mask < 1u << n; ++mask) masks.push_back(mask);
  std::stable_sort(masks.begin(), masks.end(), [](unsigned x, unsigned y) { return std::popcount(x) < std::popcount(y); });
  for (const unsigned mask : masks) {
    RegionTest test;
    for (int i = 0; i < n; ++i)
      if ((mask >> i & 1) != 0) test.part.push_back(i);
    const AnyVector& first = points[static_cast<std::size_t>(test.part[0])];
    const auto k = static_cast<Eigen::Index>(test.part.size()) - 1;
    if (k > first.size()) continue;
    Eigen::MatrixXd edges(first.size(), k);
    for (Eigen::Index i = 0; i < k; ++i) edges.col(i) = points[static_cast<std::size_t>(test.part[static_cast<std::size_t>(i) + 1])] - first;
    Eigen::VectorXd t(k);
    if (k > 0) {
      const auto solver = edges.colPivHouseholderQr();
      if (solver.rank() < k) continue;
      t = solver.solve(-Eigen::VectorXd(first));
    }
    test.weights.push_back(1 - t.sum());
    for (const double x : t) test.weights.push_back(x);
    test.distance = k == first.size() ? 0 : (Eigen::VectorXd(first) + edges * t).norm();
    test.holds_projection = std::all_of(test.weights.begin(), test.weights.end(), [&](double x) { return x >= -slack; });
    test.margin = *std::min_element(test.weights.begin(), test.weights.end(), [](double x, double y) { return std::abs(x) < std::abs(y); });
    tests.push_back(std::move(test));
  }
  RegionTest* best = nullptr;
  for (RegionTest& test : tests)
    if (test.holds_projection && (!best || test.distance < best->distance)) best = &test;
  if (best) best->nearest = true;
  return tests;
}

}  // namespace gjkdbg
