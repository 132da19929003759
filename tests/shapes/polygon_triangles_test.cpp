// Polygons of OBJ files, cut into triangles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "shapes/polygon_triangles.h"
#include "shapes/pose.h"

namespace gjkdbg {
namespace {

using Vector3 = Eigen::Vector3d;

/// Each corner of a polygon given flat, turned and moved.
std::vector<AnyVector> in_space(const std::vector<std::array<double, 2>>& flat, const AnyMatrix& turned, const Vector3& moved, double scale) {
  std::vector<AnyVector> points;
  for (const auto& p : flat) points.push_back(AnyVector(Vector3(turned * Vector3(scale * p[0], scale * p[1], 0)) + moved));
  return points;
}

TEST(PolygonTriangles, FillAPolygonAndNothingElse) {
  std::mt19937 random(4711);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < 2000; ++k) {
    // A star about the origin: how far its corners are differs by up to ten times, so that many of them turn in.
    const int size = 4 + static_cast<int>(share(random) * 9);
    std::vector<std::array<double, 2>> flat;
    for (int i = 0; i < size; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.4 * share(random)) / size, far = 0.1 + share(random);
      flat.push_back({far * std::cos(angle), far * std::sin(angle)});
    }
    const double scale = std::pow(10.0, -40 + 80 * share(random));
    const std::array<double, 7> drawn{share(random), share(random), share(random), share(random), share(random), share(random), share(random)};
    const AnyMatrix turned = resolve(AxisAngle{AnyVector(Vector3(0.1 + drawn[0], drawn[1], drawn[2])), 6 * drawn[3]}, 3).matrix;
    const Vector3 moved = scale * 1e4 * Vector3(drawn[4], drawn[5], -drawn[6]);
    const std::vector<AnyVector> points = in_space(flat, turned, moved, scale);
    std::vector<int> corners(flat.size());
    std::iota(corners.begin(), corners.end(), 0);
    // Of triangles that all turn one way, none overlaps another or leaves the polygon: their edges cancel but for its own.
    const auto triangles = polygon_triangles(points, corners);
    ASSERT_EQ(triangles.size(), flat.size() - 2) << k;
    double area = 0, all = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      const auto &p = flat[i], &q = flat[(i + 1) % flat.size()];
      all += p[0] * q[1] - p[1] * q[0];
    }
    for (const auto& [i, j, l] : triangles) {
      const auto &a = flat[static_cast<std::size_t>(i)], &b = flat[static_cast<std::size_t>(j)], &c = flat[static_cast<std::size_t>(l)];
      const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      EXPECT_GT(twice, -1e-10) << k;
      area += twice;
    }
    EXPECT_NEAR(area, all, 1e-12) << k;
  }
}

TEST(PolygonTriangles, OfWhatIsSpecial) {
  using Triangles = std::vector<std::array<int, 3>>;
  const auto cut = [](const std::vector<std::array<double, 2>>& flat) {
    std::vector<int> corners(flat.size());
    std::iota(corners.begin(), corners.end(), 0);
    return polygon_triangles(in_space(flat, AnyMatrix::Identity(3, 3), Vector3(0, 0, 7), 1), corners);
  };
  EXPECT_EQ(cut({{0, 0}, {1, 10}, {0, 5}, {-1, 10}}), (Triangles{{0, 1, 2}, {0, 2, 3}})) << "the shorter diagonal lies outside";
  EXPECT_EQ(cut({{0, 0}, {4, 0}, {5, 1}, {0, 1}}), (Triangles{{0, 1, 3}, {1, 2, 3}})) << "the shorter one";
  EXPECT_EQ(cut({{0, 0}, {2, 0}, {1, 0}, {1, 1}}).size(), 1u) << "a spike";
  EXPECT_EQ(cut({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}).size(), 2u) << "a corner on an edge";
  EXPECT_EQ(cut({{0, 0}, {1, 1}, {2, 2}, {3, 3}}).size(), 2u) << "a line stays one";
  EXPECT_GE(cut({{0, 0}, {1e30, 0}, {1e30, 1e-30}, {0, 1e-30}}).size(), 1u) << "nearly one, too: a half less than rounding may go, not all";
  EXPECT_FALSE(cut({{0, 0}, {1, 1}, {1, 0}, {0, 2}, {3, 3}}).empty()) << "it crosses itself";
  EXPECT_EQ(polygon_triangles({}, {}).size(), 0u);
}

}  // namespace
}  // namespace gjkdbg
