#include "shapes/polygon_triangles.h"

#include <algorithm>
#include <cmath>

#include "shapes/double_double.h"

namespace gjkdbg {
namespace {

using Corner = std::array<double, 2>;

/// Twice the signed area of a, b, c: differences of doubles are two doubles exactly, and of their products the sign is known to 2^-100.
int turn(const Corner& a, const Corner& b, const Corner& c) {
  using Two = DoubleDouble;
  const auto apart = [](double x, double y) { return Two::two_sum(x, -y); };
  return (apart(b[0], a[0]) * apart(c[1], a[1]) - apart(b[1], a[1]) * apart(c[0], a[0])).sign();
}

/// The corners as the polygon is seen from where it turns counter-clockwise, along the axis across which it is widest, its extent between 1 and 2.
/// Newell's normal, the sum of p_i x p_(i+1), is twice the vector area, whichever corners turn in. Empty where it has none.
std::vector<Corner> seen_flat(std::span<const AnyVector> points, std::span<const int> corners) {
  const auto at = [&](std::size_t i) { return Eigen::Vector3d(points[static_cast<std::size_t>(corners[i % corners.size()])]); };
  double extent = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) extent = std::max(extent, (at(i) - at(0)).cwiseAbs().maxCoeff());
  if (!(extent > 0)) return {};
  const double unit = std::ldexp(1.0, -std::ilogb(extent));
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) normal += (unit * (at(i) - at(0))).cross(unit * (at(i + 1) - at(0)));
  int across = 0;
  if (!(normal.cwiseAbs().maxCoeff(&across) > 0)) return {};
  const int x = (across + 1) % 3, y = (across + 2) % 3;
  std::vector<Corner> flat(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) flat[i] = {unit * at(i)[x], (normal[across] > 0 ? unit : -unit) * at(i)[y]};
  return flat;
}

/// Cuts off one ear after another: a corner that turns as the polygon does, with no other corner in its triangle (Meisters 1975, "Polygons have ears"), or does not turn.
class Ears {
 public:
  Ears(const std::vector<Corner>& flat) : flat_(flat) {
    for (std::size_t i = 0; i < flat.size(); ++i) left_.push_back(static_cast<int>(i));
  }

  std::vector<std::array<int, 3>> cut() {
    while (left_.size() > 3) {
      const std::size_t i = next();
      out_.push_back(ear(i));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    out_.push_back(ear(1));
    return std::move(out_);
  }

 private:
  int around(std::size_t i, std::size_t step) const { return left_[(i + step) % left_.size()]; }
  std::array<int, 3> ear(std::size_t i) const { return {around(i, left_.size() - 1), left_[i], around(i, 1)}; }
  const Corner& corner(int i) const { return flat_[static_cast<std::size_t>(i)]; }
  int turns(std::size_t i) const {
    const auto [a, b, c] = ear(i);
    return turn(corner(a), corner(b), corner(c));
  }

  /// A corner that cuts nothing off, or an ear; where there is neither the polygon crosses itself, and the first corner that turns the right way will do.
  std::size_t next() const {
    std::size_t some = 1;
    bool found = false;
    for (std::size_t step = 1; step <= left_.size(); ++step) {  // from the second on: of a convex polygon that makes a fan about the first
      const std::size_t i = step % left_.size();
      const int way = turns(i);
      if (way == 0 || (way > 0 && empty(ear(i)))) return i;
      if (way > 0 && !found) some = i, found = true;
    }
    return some;
  }

  bool empty(const std::array<int, 3>& triangle) const {
    const Corner &a = corner(triangle[0]), &b = corner(triangle[1]), &c = corner(triangle[2]);
    return std::none_of(left_.begin(), left_.end(), [&](int other) {
      const Corner& p = corner(other);
      return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
  }

  const std::vector<Corner>& flat_;
  std::vector<int> left_;
  std::vector<std::array<int, 3>> out_;
};

}  // namespace

std::vector<std::array<int, 3>> polygon_triangles(std::span<const AnyVector> points, std::span<const int> corners) {
  const auto at = [&](int i) -> const AnyVector& { return points[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])]; };
  std::vector<std::array<int, 3>> triangles;
  const std::vector<Corner> flat = corners.size() > 3 ? seen_flat(points, corners) : std::vector<Corner>();
  if (flat.size() == 4 && turn(flat[0], flat[1], flat[2]) > 0 && turn(flat[1], flat[2], flat[3]) > 0 && turn(flat[2], flat[3], flat[0]) > 0 && turn(flat[3], flat[0], flat[1]) > 0 &&
      (at(3) - at(1)).norm() < (at(2) - at(0)).norm()) {
    triangles = {{0, 1, 3}, {1, 2, 3}};
  } else if (!flat.empty()) {
    triangles = Ears(flat).cut();
    std::erase_if(triangles, [&](const std::array<int, 3>& t) {  // what is a line as it is seen may be none in space, where the polygon is not flat
      const Eigen::Vector3d a = at(t[0]), ab = Eigen::Vector3d(at(t[1])) - a, ac = Eigen::Vector3d(at(t[2])) - a;
      return ab.stableNormalized().cross(ac.stableNormalized()).norm() < 1e-14;
    });
  }
  if (triangles.empty())  // three corners, or a line: nothing is to be lost of it
    for (int i = 1; i + 1 < static_cast<int>(corners.size()); ++i) triangles.push_back({0, i, i + 1});
  for (auto& triangle : triangles)
    for (int& i : triangle) i = corners[static_cast<std::size_t>(i)];
  return triangles;
}

}  // namespace gjkdbg
