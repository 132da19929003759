#include "shapes/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace gjkdbg {
namespace {

using V3 = Eigen::Vector3d;
constexpr double flat_limit = 1e-14;  ///< of the size: thinner sets count as flat

/// Ascending indices of the distinct points.
std::vector<int> distinct(const std::vector<V3>& points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) { return std::array{points[i][0], points[i][1], points[i][2]}; };
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return key(i) < key(j); });
  order.erase(std::unique(order.begin(), order.end(), [&](int i, int j) { return points[i] == points[j]; }), order.end());
  std::sort(order.begin(), order.end());
  return order;
}

/// An orthonormal frame adapted to the set: the first axis along its length, the second along its width.
struct Spread {
  V3 origin, axis[3];
  double extent[3] = {0, 0, 0};

  Spread(const std::vector<V3>& p, const std::vector<int>& used) : origin(p[used[0]]) {
    const auto farthest = [&](auto off) {
      V3 best = V3::Zero();
      for (const int i : used)
        if (const V3 x = off(p[i] - origin); x.squaredNorm() > best.squaredNorm()) best = x;
      return best;
    };
    const V3 x = farthest([](const V3& d) { return d; });
    axis[0] = x.norm() > 0 ? V3(x.normalized()) : V3::UnitX();
    const V3 y = farthest([&](const V3& d) { return V3(d - axis[0] * axis[0].dot(d)); });
    axis[1] = y.norm() > flat_limit * x.norm() ? V3(y.normalized()) : axis[0].unitOrthogonal();
    axis[1] = (axis[1] - axis[0] * axis[0].dot(axis[1])).normalized();
    axis[2] = axis[0].cross(axis[1]);
    for (const int i : used)
      for (int k = 0; k < 3; ++k) extent[k] = std::max(extent[k], std::abs(axis[k].dot(p[i] - origin)));
  }
  int rank() const {
    const double size = extent[0];
    return size == 0 ? 0 : extent[1] <= flat_limit * size ? 1 : extent[2] <= flat_limit * size ? 2 : 3;
  }
};

/// Andrew's monotone chain, in long double; collinear points are dropped. Counter-clockwise.
std::vector<int> planar_hull(const std::vector<Eigen::Vector2d>& p, std::vector<int> order) {
  std::sort(order.begin(), order.end(), [&](int i, int j) { return p[i][0] < p[j][0] || (p[i][0] == p[j][0] && p[i][1] < p[j][1]); });
  const auto turns_left = [&](int a, int b, int c) {
    const long double x1 = static_cast<long double>(p[b][0]) - p[a][0], y1 = static_cast<long double>(p[b][1]) - p[a][1];
    const long double x2 = static_cast<long double>(p[c][0]) - p[a][0], y2 = static_cast<long double>(p[c][1]) - p[a][1];
    return x1 * y2 - y1 * x2 > 0;
  };
  std::vector<int> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const int i : order) {
      while (hull.size() >= start + 2 && !turns_left(hull[hull.size() - 2], hull.back(), i)) hull.pop_back();
      hull.push_back(i);
    }
    hull.pop_back();
    std::reverse(order.begin(), order.end());
  }
  return hull;
}

void fill_flat(ConvexHull& hull, const std::vector<V3>& points, const std::vector<int>& used, const Spread& spread, int dimension) {
  std::vector<Eigen::Vector2d> plane(points.size());
  for (const int i : used)
    plane[i] = dimension == 2 ? Eigen::Vector2d(points[i].head<2>())
                              : Eigen::Vector2d(spread.axis[0].dot(points[i] - spread.origin), spread.axis[1].dot(points[i] - spread.origin));
  const std::vector<int> loop = planar_hull(plane, used);
  hull.vertices = loop;
  hull.faces.push_back(loop);
  if (dimension == 3) hull.faces.emplace_back(loop.rbegin(), loop.rend());
}

void fill_segment(ConvexHull& hull, const std::vector<V3>& points, const std::vector<int>& used, const Spread& spread) {
  const auto along = [&](int i) { return spread.axis[0].dot(points[i] - spread.origin); };
  const auto [low, high] = std::minmax_element(used.begin(), used.end(), [&](int i, int j) { return along(i) < along(j); });
  hull.vertices = {*low, *high};
  hull.edges.push_back({std::min(*low, *high), std::max(*low, *high)});
}

/// The corners of a Qhull facet in order, counter-clockwise from outside. Facets of more than three vertices are merged
/// coplanar ones: their vertices are sorted by angle about their middle.
std::vector<int> facet_loop(qhT* qh, facetT* facet, const std::vector<V3>& points, const std::vector<int>& used) {
  std::vector<int> loop;
  vertexT *vertex, **vertexp;
  FOREACHvertex_(facet->vertices) loop.push_back(used[qh_pointid(qh, vertex->point)]);
  const V3 normal(facet->normal[0], facet->normal[1], facet->normal[2]);
  V3 middle = V3::Zero();
  for (const int i : loop) middle += points[i] / static_cast<double>(loop.size());
  const V3 x = (points[loop[0]] - middle).normalized(), y = normal.cross(x);
  const auto angle = [&](int i) { return std::atan2(y.dot(points[i] - middle), x.dot(points[i] - middle)); };
  std::sort(loop.begin(), loop.end(), [&](int i, int j) { return angle(i) < angle(j); });
  return loop;
}

/// False when Qhull fails. The points are moved and scaled to lie around the origin, for Qhull only.
bool fill_solid(ConvexHull& hull, const std::vector<V3>& points, const std::vector<int>& used, const Spread& spread) {
  std::vector<double> coordinates;
  for (const int i : used)
    for (int k = 0; k < 3; ++k) coordinates.push_back((points[i][k] - spread.origin[k]) / spread.extent[0]);
  qhT state;
  qhT* qh = &state;
  QHULL_LIB_CHECK
  FILE* silent = std::fopen("/dev/null", "w");
  qh_zero(qh, silent);
  char command[] = "qhull";
  const bool good = qh_new_qhull(qh, 3, static_cast<int>(used.size()), coordinates.data(), False, command, nullptr, silent) == 0;
  if (good) {
    facetT* facet;
    FORALLfacets hull.faces.push_back(facet_loop(qh, facet, points, used));
  }
  qh_freeqhull(qh, qh_ALL);
  int current, total;
  qh_memfreeshort(qh, &current, &total);
  if (silent) std::fclose(silent);
  return good;
}

/// Edges from the faces, vertices from the edges, neighbours from both.
void connect(ConvexHull& hull) {
  for (const auto& face : hull.faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int i = face[k], j = face[(k + 1) % face.size()];
      hull.edges.push_back({std::min(i, j), std::max(i, j)});
    }
  std::sort(hull.edges.begin(), hull.edges.end());
  hull.edges.erase(std::unique(hull.edges.begin(), hull.edges.end()), hull.edges.end());
  for (const auto& face : hull.faces) hull.vertices.insert(hull.vertices.end(), face.begin(), face.end());
  std::sort(hull.vertices.begin(), hull.vertices.end());
  hull.vertices.erase(std::unique(hull.vertices.begin(), hull.vertices.end()), hull.vertices.end());
  const auto position = [&](int i) {
    return static_cast<int>(std::lower_bound(hull.vertices.begin(), hull.vertices.end(), i) - hull.vertices.begin());
  };
  std::vector<std::vector<int>> next(hull.vertices.size());
  for (const auto& [i, j] : hull.edges) next[position(i)].push_back(position(j)), next[position(j)].push_back(position(i));
  hull.first_neighbour.assign(1, 0);
  for (const auto& n : next) {
    hull.neighbours.insert(hull.neighbours.end(), n.begin(), n.end());
    hull.first_neighbour.push_back(static_cast<int>(hull.neighbours.size()));
  }
}

/// Whether no point sticks out of any face by more than rounding: what the hull's users take as exact must not be off by more than they round themselves.
/// Of grids at any angle, which have points in their faces, none was seen to stick out by more than a third of this.
constexpr double rounding = 5e-16;
bool covers(const ConvexHull& hull, const std::vector<V3>& points, const std::vector<int>& used, double size) {
  if (hull.faces.size() * used.size() > 10'000'000) return true;  // too large to check in the time it is worth
  for (const auto& face : hull.faces) {
    V3 normal = V3::Zero();
    for (std::size_t k = 0; k < face.size(); ++k)
      normal += (points[face[k]] - points[face[0]]).cross(points[face[(k + 1) % face.size()]] - points[face[0]]);
    if (!(normal.norm() > 0)) return false;
    normal.normalize();
    double height = -std::numeric_limits<double>::infinity();
    for (const int i : face) height = std::max(height, normal.dot(points[i] - points[face[0]]));
    for (const int i : used)
      if (normal.dot(points[i] - points[face[0]]) > height + rounding * size) return false;
  }
  return true;
}

}  // namespace

ConvexHull convex_hull(std::span<const AnyVector> input, int dimension) {
  std::vector<V3> points;
  points.reserve(input.size());
  double size = 0;
  for (const AnyVector& p : input) points.push_back(in_space(p)), size = std::max(size, points.back().cwiseAbs().maxCoeff());
  // By a power of two, which rounds nothing: areas are squares of lengths, and their squares must not vanish.
  if (size > 0)
    for (V3& p : points) p *= std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000));
  const std::vector<int> used = distinct(points);
  const Spread spread(points, used);
  ConvexHull hull;
  hull.rank = std::min(spread.rank(), dimension);
  if (hull.rank == 0) hull.vertices = {used[0]};
  if (hull.rank == 1) fill_segment(hull, points, used, spread);
  if (hull.rank == 2) fill_flat(hull, points, used, spread, dimension);
  const bool keep_all = hull.rank == 3 && (!fill_solid(hull, points, used, spread) || !covers(hull, points, used, spread.extent[0]));
  connect(hull);
  if (keep_all) hull.vertices = used, hull.first_neighbour.clear(), hull.neighbours.clear();
  return hull;
}

}  // namespace gjkdbg
