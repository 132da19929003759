#include "tests/oracle/wide_gjk.h"

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

namespace gjkdbg::oracle {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;
using P = std::array<Wide, 3>;

Wide dot(const P& x, const P& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
P minus(const P& x, const P& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
P times(const Wide& s, const P& x) { return {s * x[0], s * x[1], s * x[2]}; }
P plus(const P& x, const P& y) { return {x[0] + y[0], x[1] + y[1], x[2] + y[2]}; }
Wide length(const P& x) { return sqrt(dot(x, x)); }

P wide(const AnyVector& v) {
  P p{};
  for (Eigen::Index i = 0; i < v.size(); ++i) p[static_cast<std::size_t>(i)] = v[i];
  return p;
}

P support(const Shape& shape, const P& d, int dimension);

P farthest(const std::vector<P>& points, const P& d) {
  P best = points[0];
  for (const P& p : points)
    if (dot(p, d) > dot(best, d)) best = p;
  return best;
}

struct Support {
  const P& d;
  int dimension;

  P operator()(const Sphere& s) const { return times(s.radius / length(d), d); }
  P operator()(const Box& b) const {
    P p{};
    for (int i = 0; i < dimension; ++i) p[static_cast<std::size_t>(i)] = d[static_cast<std::size_t>(i)] >= 0 ? b.max[i] : b.min[i];
    return p;
  }
  P operator()(const Capsule& c) const {
    P p = times(c.radius / length(d), d);
    const auto axis = static_cast<std::size_t>(c.axis);
    p[axis] += d[axis] >= 0 ? c.half_height : -c.half_height;
    return p;
  }
  /// `d` without its part along the axis, stretched to length r.
  P rim(int axis, double r) const {
    P across = d;
    across[static_cast<std::size_t>(axis)] = 0;
    const Wide l = length(across);
    return l == 0 ? P{} : times(r / l, across);
  }
  P operator()(const Cylinder& c) const {
    P p = rim(c.axis, c.radius);
    const auto axis = static_cast<std::size_t>(c.axis);
    p[axis] = d[axis] >= 0 ? c.half_height : -c.half_height;
    return p;
  }
  P operator()(const Cone& c) const {
    P apex{}, base = rim(c.axis, c.radius);
    const auto axis = static_cast<std::size_t>(c.axis);
    apex[axis] = c.half_height, base[axis] = -c.half_height;
    return farthest({apex, base}, d);
  }
  P operator()(const Ellipsoid& e) const {
    P scaled{};
    for (int i = 0; i < dimension; ++i) scaled[static_cast<std::size_t>(i)] = Wide(e.radii[i]) * d[static_cast<std::size_t>(i)];
    const Wide l = length(scaled);
    if (l == 0) return P{};
    for (int i = 0; i < dimension; ++i) scaled[static_cast<std::size_t>(i)] *= e.radii[i] / l;
    return scaled;
  }
  P operator()(const PointSet& s) const {
    std::vector<P> points;
    for (const AnyVector& p : s.points) points.push_back(wide(p));
    return farthest(points, d);
  }
  P operator()(const Mesh&) const { return {}; }
  P operator()(const Sum& s) const { return plus(support(*s.first, d, dimension), support(*s.second, d, dimension)); }
};

P support(const Shape& shape, const P& d, int dimension) {
  P p = std::visit(Support{d, dimension}, shape.geometry);
  if (shape.margin > 0) p = plus(p, times(shape.margin / length(d), d));
  return p;
}

P world_support(const Body& body, const P& d, int dimension) {
  P local{}, out = wide(body.pose.position);
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j) local[static_cast<std::size_t>(i)] += Wide(body.pose.matrix(j, i)) * d[static_cast<std::size_t>(j)];
  const P p = support(body.shape, local, dimension);
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j) out[static_cast<std::size_t>(i)] += Wide(body.pose.matrix(i, j)) * p[static_cast<std::size_t>(j)];
  return out;
}

/// Solves the small symmetric system for the weights of the point nearest the origin in the affine hull of the points; false when
/// singular or outside.
bool weights_of(const std::vector<P>& w, std::vector<Wide>& weights) {
  const std::size_t n = w.size();
  weights.assign(n, 0);
  if (n == 1) return weights[0] = 1, true;
  std::vector<std::vector<Wide>> m(n - 1, std::vector<Wide>(n));
  for (std::size_t i = 1; i < n; ++i) {
    for (std::size_t j = 1; j < n; ++j) m[i - 1][j - 1] = dot(minus(w[i], w[0]), minus(w[j], w[0]));
    m[i - 1][n - 1] = -dot(minus(w[i], w[0]), w[0]);
  }
  for (std::size_t c = 0; c + 1 < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r + 1 < n; ++r)
      if (abs(m[r][c]) > abs(m[pivot][c])) pivot = r;
    if (m[pivot][c] == 0) return false;
    std::swap(m[pivot], m[c]);
    for (std::size_t r = 0; r + 1 < n; ++r) {
      if (r == c) continue;
      const Wide f = m[r][c] / m[c][c];
      for (std::size_t k = c; k < n; ++k) m[r][k] -= f * m[c][k];
    }
  }
  Wide rest = 1;
  for (std::size_t i = 0; i + 1 < n; ++i) weights[i + 1] = m[i][n - 1] / m[i][i], rest -= weights[i + 1];
  weights[0] = rest;
  for (const Wide& x : weights)
    if (x <= 0) return false;
  return true;
}

/// Tries every subset; keeps the nearest.
P nearest(std::vector<P>& simplex) {
  P best = simplex[0];
  std::vector<P> kept{simplex[0]};
  for (unsigned mask = 1; mask < 1u << simplex.size(); ++mask) {
    std::vector<P> subset;
    for (std::size_t i = 0; i < simplex.size(); ++i)
      if ((mask >> i & 1u) != 0) subset.push_back(simplex[i]);
    std::vector<Wide> weights;
    if (subset.size() > 4 || !weights_of(subset, weights)) continue;
    P v{};
    for (std::size_t i = 0; i < subset.size(); ++i) v = plus(v, times(weights[i], subset[i]));
    if (dot(v, v) < dot(best, best)) best = v, kept = subset;
  }
  simplex = kept;
  return best;
}

}  // namespace

double wide_distance(const Scene& scene) {
  const int dimension = scene.dimension;
  const auto difference = [&](const P& d) {
    return minus(world_support(scene.bodies[0], d, dimension), world_support(scene.bodies[1], times(-1, d), dimension));
  };
  P start{};
  start[0] = 1;
  std::vector<P> simplex{difference(start)};
  P v = simplex[0];
  for (int i = 0; i < 300; ++i) {
    const P w = difference(times(-1, v));
    if (dot(v, v) - dot(v, w) <= Wide("1e-16") * dot(v, v)) break;
    simplex.push_back(w);
    v = nearest(simplex);
  }
  return length(v).convert_to<double>();
}

}  // namespace gjkdbg::oracle
