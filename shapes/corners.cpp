#include "shapes/corners.h"

namespace gjkdbg {
namespace {

std::optional<Corners> corners_of_geometry(const Sphere& s, int dimension) { return Corners{{AnyVector::Zero(dimension)}, s.radius}; }

std::optional<Corners> corners_of_geometry(const Box& box, int dimension) {
  Corners corners;
  for (int bits = 0; bits < 1 << dimension; ++bits) {
    AnyVector p(dimension);
    for (int i = 0; i < dimension; ++i) p[i] = (bits >> i & 1) != 0 ? box.max[i] : box.min[i];
    corners.points.push_back(p);
  }
  return corners;
}

std::optional<Corners> corners_of_geometry(const Capsule& c, int dimension) {
  const AnyVector end = AnyVector::Unit(dimension, c.axis) * c.half_height;
  return Corners{{end, -end}, c.radius};
}

std::optional<Corners> corners_of_geometry(const PointSet& set, int) { return Corners{set.points, 0}; }

std::optional<Corners> corners_of_geometry(const Sum& sum, int dimension) {
  const auto first = corners_of(*sum.first, dimension), second = corners_of(*sum.second, dimension);
  if (!first || !second || first->points.size() * second->points.size() > largest_sum) return std::nullopt;
  Corners corners{{}, first->radius + second->radius};
  for (const AnyVector& p : first->points)
    for (const AnyVector& q : second->points) corners.points.push_back(p + q);
  return corners;
}

/// Cylinders, cones, ellipsoids: round, no corners. A mesh is solved triangle by triangle and never comes here.
template <class Round>
std::optional<Corners> corners_of_geometry(const Round&, int) {
  return std::nullopt;
}

}  // namespace

std::optional<Corners> corners_of(const Shape& shape, int dimension) {
  auto corners = std::visit([&](const auto& g) { return corners_of_geometry(g, dimension); }, shape.geometry);
  if (corners) corners->radius += shape.margin;
  return corners;
}

}  // namespace gjkdbg
