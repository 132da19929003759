#include "shapes/features.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "shapes/convex_hull.h"
#include "shapes/corners.h"

namespace gjkdbg {
namespace {

/// Of the points of a loop.
AnyVector polygon_normal(const std::vector<AnyVector>& points, const std::vector<int>& loop) {
  std::vector<AnyVector> corners;
  for (const int i : loop) corners.push_back(points[static_cast<std::size_t>(i)]);
  return normal_of(corners);
}

void add_distinct(std::vector<AnyVector>& list, const AnyVector& n) {
  if (n.isZero(0) || !n.allFinite()) return;
  if (std::none_of(list.begin(), list.end(), [&](const AnyVector& m) { return m == n; })) list.push_back(n);
}

void add_edge(std::vector<EdgeFeature>& edges, EdgeFeature edge) {
  const auto same = [&](const EdgeFeature& e) { return (e.direction == edge.direction || e.direction == -edge.direction) && e.left == edge.left && e.right == edge.right; };
  if (std::none_of(edges.begin(), edges.end(), same)) edges.push_back(std::move(edge));
}

Features features_3d(const std::vector<AnyVector>& points, const ConvexHull& hull) {
  Features features;
  std::map<std::pair<int, int>, std::vector<AnyVector>> beside;
  for (const auto& loop : hull.faces) {
    const AnyVector n = polygon_normal(points, loop);
    add_distinct(features.face_normals, n);
    for (std::size_t i = 0; i < loop.size(); ++i) beside[std::minmax(loop[i], loop[(i + 1) % loop.size()])].push_back(n);
  }
  for (const auto& [i, j] : hull.edges) {
    EdgeFeature edge{(points[static_cast<std::size_t>(j)] - points[static_cast<std::size_t>(i)]).stableNormalized(), {}, {}};
    const auto& faces = beside[{i, j}];
    if (hull.rank == 3 && faces.size() == 2) edge.left = faces[0], edge.right = faces[1];
    if (!edge.direction.isZero(0)) add_edge(features.edges, std::move(edge));
  }
  return features;
}

Features features_2d(const std::vector<AnyVector>& points, const ConvexHull& hull) {
  Features features;
  const auto add = [&](int i, int j) {
    add_distinct(features.face_normals, normal_of({points[static_cast<std::size_t>(i)], points[static_cast<std::size_t>(j)]}));
  };
  for (const auto& loop : hull.faces)
    for (std::size_t i = 0; i < loop.size(); ++i) add(loop[i], loop[(i + 1) % loop.size()]);
  if (hull.rank == 1) add(hull.vertices.front(), hull.vertices.back()), add(hull.vertices.back(), hull.vertices.front());
  return features;
}

/// How far points lie beside the plane, or line, that they are taken to lie in.
double beside(const std::vector<AnyVector>& points, const ConvexHull& hull) {
  const AnyVector from = points[static_cast<std::size_t>(hull.vertices.front())], to = points[static_cast<std::size_t>(hull.vertices.back())];
  const AnyVector along = hull.rank == 2 ? polygon_normal(points, hull.faces.front()) : AnyVector((to - from).stableNormalized());
  double most = 0;
  for (const AnyVector& p : points) {
    const AnyVector way = p - from, part = along * along.dot(way);
    most = std::max(most, hull.rank == 2 ? part.norm() : AnyVector(way - part).norm());
  }
  return most;
}

/// Ways alone are told: by a power of two, which rounds none of them, areas stay numbers (of sides of 1e-170 they are none).
void near_one(std::vector<AnyVector>& points) {
  double size = 0;
  for (const AnyVector& p : points) size = std::max(size, p.cwiseAbs().maxCoeff());
  if (size == 0) return;
  const double by = std::ldexp(1.0, std::min(-std::ilogb(size), 1000));
  for (AnyVector& p : points) p *= by;
}

}  // namespace

AnyVector normal_of(const std::vector<AnyVector>& face) {
  if (face[0].size() == 2) {
    const AnyVector e = face[1] - face[0];
    return Eigen::Vector2d(e[1], -e[0]).stableNormalized();
  }
  // Newell's sum: twice the vector area, whatever the polygon's corners are.
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    const Eigen::Vector3d x = face[i] - face[0], y = face[i + 1] - face[0];
    area += x.cross(y);
  }
  return area.stableNormalized();
}

std::optional<Features> features_of(const Shape& shape, int dimension) {
  auto corners = corners_of(shape, dimension);
  if (!corners) return std::nullopt;
  near_one(corners->points);
  const ConvexHull hull = convex_hull(corners->points, dimension);
  if (dimension == 1) return Features{{AnyVector::Ones(1), -AnyVector::Ones(1)}, {}};
  Features features = dimension == 2 ? features_2d(corners->points, hull) : features_3d(corners->points, hull);
  double size = 0;
  for (const AnyVector& p : corners->points) size = std::max(size, (p - corners->points.front()).norm());
  features.nearly_flat = hull.rank > 0 && hull.rank < dimension && beside(corners->points, hull) > 1e-15 * size;
  return features;
}

}  // namespace gjkdbg
