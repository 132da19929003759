// GJK and EPA to read as a lesson, in 1D, 2D and 3D.
//
//   c++ -std=c++17 -O2 gjk.cpp -o gjk && gjkdbg run SCENE --exec ./gjk
//
// Replace what `main` calls by yours. All it needs is solver.support(d): the farthest point w of A - B along d, with a and b, w = a - b. Reports
// (solver.simplex, polytope, face) are optional; the more you report, the earlier gjkdbg can tell where it went wrong.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "gjkdbg_solver.h"

using gjkdbg::Solver, gjkdbg::Vec, gjkdbg::Vertex;
using Corners = std::vector<Vertex>;

// --- Vectors ---------------------------------------------------------------------------------------------------------
static double dot(const Vec& x, const Vec& y) { return std::inner_product(x.begin(), x.end(), y.begin(), 0.0); }
static Vec plus(Vec x, double s, const Vec& y) {  // x + s y
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += s * y[i];
  return x;
}
static Vec scaled(double s, const Vec& x) { return plus(Vec(x.size(), 0.0), s, x); }
static Vec minus(const Vec& x, const Vec& y) { return plus(x, -1, y); }
static double length(const Vec& x) { return std::sqrt(dot(x, x)); }
static std::vector<int> numbers(const Corners& corners) {
  std::vector<int> out;
  for (const Vertex& x : corners) out.push_back(x.number);
  return out;
}
/// All ways to pick `size` of a list.
static std::vector<Corners> combinations(const Corners& list, std::size_t size, std::size_t from = 0) {
  if (size == 0) return {{}};
  std::vector<Corners> out;
  for (std::size_t i = from; i < list.size(); ++i)
    for (Corners rest : combinations(list, size - 1, i + 1)) {
      rest.insert(rest.begin(), list[i]);
      out.push_back(rest);
    }
  return out;
}

// --- GJK: the nearest part of a simplex --------------------------------------------------------------------------------
struct Nearest {
  Corners part;
  Vec v, weights;
  Vec at(Vec Vertex::*which) const {
    Vec sum(v.size(), 0.0);
    for (std::size_t i = 0; i < part.size(); ++i) sum = plus(sum, weights[i], part[i].*which);
    return sum;
  }
};
/// Weights of the point nearest the origin in the flat through the points; empty when they do not span it.
/// With p0 + sum t_i e_i, e_i = p_i - p0, the nearest has e_j . (p0 + sum t_i e_i) = 0 for all j: solved by elimination. p0 is the point that is nearest
/// to the others: of a sliver's two long sides the products would lose what sets them apart.
static Vec affine_weights(const Corners& p) {
  const std::size_t n = p.size() - 1;
  Vec spread;
  for (const Vertex& x : p) {
    spread.push_back(0);
    for (const Vertex& y : p) spread.back() += dot(minus(y.w, x.w), minus(y.w, x.w));
  }
  const std::size_t base = static_cast<std::size_t>(std::min_element(spread.begin(), spread.end()) - spread.begin());
  std::vector<Vec> e, rows;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (i != base) e.push_back(minus(p[i].w, p[base].w));
  for (std::size_t i = 0; i < n; ++i) {
    for (rows.emplace_back(); rows[i].size() < n;) rows[i].push_back(dot(e[i], e[rows[i].size()]));
    rows[i].push_back(-dot(e[i], p[base].w));
  }
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(rows[r][c]) > std::abs(rows[c][c])) std::swap(rows[r], rows[c]);
    if (std::abs(rows[c][c]) <= 1e-14 * dot(e[c], e[c])) return {};
    for (std::size_t r = 0; r < n; ++r)
      if (r != c) rows[r] = plus(rows[r], -rows[r][c] / rows[c][c], rows[c]);
  }
  Vec weights;
  for (std::size_t i = 0; i < n; ++i) weights.push_back(rows[i][n] / rows[i][i]);
  weights.insert(weights.begin() + static_cast<std::ptrdiff_t>(base), 1 - std::accumulate(weights.begin(), weights.end(), 0.0));
  return weights;
}
/// The part of the simplex nearest the origin. Tries every part; slow, and never wrong.
static Nearest nearest(const Corners& simplex) {
  Nearest best;
  for (std::size_t size = 1; size <= simplex.size(); ++size)
    for (const Corners& part : combinations(simplex, size)) {
      Nearest now{part, simplex[0].w, affine_weights(part)};
      if (now.weights.empty() || *std::min_element(now.weights.begin(), now.weights.end()) < 0) continue;
      now.v = now.at(&Vertex::w);
      if (best.part.empty() || dot(now.v, now.v) < dot(best.v, best.v)) best = now;
    }
  return best;
}
/// |v| is the distance; v = 0 when they overlap.
static Nearest gjk(Solver& solver, double tolerance) {
  Vec d(static_cast<std::size_t>(solver.dimension), 0.0);
  d[0] = 1;
  Nearest now = nearest({solver.support(d)});
  double scale = length(now.v);
  while (true) {
    solver.simplex(numbers(now.part), now.v);
    if (length(now.v) <= 1e-12 * scale || now.part.size() == d.size() + 1) return {now.part, Vec(d.size(), 0.0), now.weights};
    const Vertex w = solver.support(scaled(-1, now.v));
    scale = std::max(scale, length(w.w));
    const bool known = std::any_of(now.part.begin(), now.part.end(), [&](const Vertex& x) { return x.w == w.w; });
    if (dot(now.v, now.v) - dot(now.v, w.w) <= tolerance * dot(now.v, now.v) || known) return now;
    Corners simplex{w};
    simplex.insert(simplex.end(), now.part.begin(), now.part.end());
    const Nearest next = nearest(simplex);
    if (dot(next.v, next.v) >= dot(now.v, now.v)) return now;  // rounding: no nearer part can be told
    now = next;
  }
}

// --- EPA -----------------------------------------------------------------------------------------------------------------
/// A number without rounding: the sum of its parts, the smallest first, none of which shares a bit with another (Shewchuk 1997). The sum and the product
/// of two doubles are two doubles: the rounded one, and what it was rounded by.
struct Exact {
  std::vector<double> parts;
  void add(double x) {
    for (double& part : parts) {
      const double sum = x + part, of_part = sum - x, lost = (x - (sum - of_part)) + (part - of_part);
      part = lost, x = sum;
    }
    parts.push_back(x);
    parts.erase(std::remove(parts.begin(), parts.end(), 0.0), parts.end());
  }
  double rounded() const { return std::accumulate(parts.begin(), parts.end(), 0.0); }
  int sign() const { return parts.empty() ? 0 : parts.back() > 0 ? 1 : -1; }
};
static Exact operator-(Exact x, const Exact& y) {
  for (const double part : y.parts) x.add(-part);
  return x;
}
static Exact operator*(const Exact& x, const Exact& y) {
  Exact product;
  for (const double p : x.parts)
    for (const double q : y.parts) product.add(std::fma(p, q, -(p * q))), product.add(p * q);
  return product;
}
using ExactVec = std::vector<Exact>;
static Exact dot(const ExactVec& x, const ExactVec& y) {
  Exact sum;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (const double part : (x[i] * y[i]).parts) sum.add(part);
  return sum;
}
/// x - y, times a power of two: where the lengths are near 1, products of them lose no bits below the smallest double.
static ExactVec difference(const Vec& x, const Vec& y, int exponent) {
  ExactVec out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) out[i].add(std::ldexp(x[i], exponent)), out[i].add(-std::ldexp(y[i], exponent));
  return out;
}

/// `normal`: unit, away from a point inside; `exact_normal`: of any length, without rounding. Of the slivers that thin shapes lead to a normal from
/// rounded differences may be any.
struct Face { Corners corners; Vec normal; double distance = 0; ExactVec exact_normal; };
static Face make_face(const Corners& c, const Vec& inside, int exponent) {
  ExactVec n(1, Exact{{1.0}});
  if (c.size() > 1) {
    const ExactVec x = difference(c[1].w, c[0].w, exponent), y = difference(c.back().w, c[0].w, exponent);
    const auto cross = [&](int i, int j) { return x[i] * y[j] - x[j] * y[i]; };
    if (c.size() == 2) n = {x[1], Exact() - x[0]};
    else n = {cross(1, 2), cross(2, 0), cross(0, 1)};
  }
  if (dot(n, difference(c[0].w, inside, exponent)).sign() < 0)
    for (Exact& x : n) x = Exact() - x;
  Vec unit;
  for (const Exact& x : n) unit.push_back(x.rounded());
  unit = scaled(1 / std::abs(*std::max_element(unit.begin(), unit.end(), [](double x, double y) { return std::abs(x) < std::abs(y); })), unit);
  unit = scaled(1 / length(unit), unit);
  return {c, unit, dot(unit, c[0].w), n};
}
/// Whether w lies on an edge's line, but for 1e-14 of the lengths: with |x|^2 |y|^2 - (x . y)^2 the square of the triangle's area, twice.
static bool in_line(const Vertex& w, const Corners& edge, int exponent) {
  const ExactVec x = difference(w.w, edge[0].w, exponent), y = difference(w.w, edge[1].w, exponent);
  const Exact xx = dot(x, x), yy = dot(y, y), xy = dot(x, y);
  const double longest = std::max(xx.rounded(), yy.rounded());
  return (xx * yy - xy * xy).rounded() <= 1e-28 * longest * longest;
}
/// Whether w lies beyond the face, or in its plane: told without rounding where that might decide. So the faces seen are always one disc with one rim,
/// and no new face is without area: w on the line of an edge takes away the faces on both sides of it.
static bool sees(const Vertex& w, const Face& f, double rounding, int exponent) {
  const double height = dot(f.normal, w.w) - f.distance;
  if (std::abs(height) > rounding) return height > 0;
  if (dot(f.exact_normal, difference(w.w, f.corners[0].w, exponent)).sign() >= 0) return true;
  const auto edges = f.corners.size() == 3 ? combinations(f.corners, 2) : std::vector<Corners>();
  return std::any_of(edges.begin(), edges.end(), [&](const Corners& edge) { return in_line(w, edge, exponent); });
}
/// Vertices until they span the space. False, and the direction across, when A - B is flat.
static bool complete(Solver& solver, Corners& points, const Corners& simplex, Vec& across) {
  std::vector<Vec> basis;
  const auto part_across = [&](Vec x) {
    for (const Vec& e : basis) x = plus(x, -dot(e, x), e);
    return x;
  };
  const auto off = [&](const Vertex& x) { return length(part_across(minus(x.w, points[0].w))); };
  double scale = 1e-300;
  for (const Vertex& x : simplex) scale = std::max(scale, length(x.w));
  points = {simplex[0]};
  while (points.size() <= points[0].w.size()) {
    Corners candidates;
    std::copy_if(simplex.begin(), simplex.end(), std::back_inserter(candidates), [&](const Vertex& x) { return off(x) > 1e-7 * scale; });
    if (candidates.empty()) {
      across.clear();
      for (std::size_t k = 0; k < points[0].w.size(); ++k) {
        Vec axis(points[0].w.size(), 0.0);
        axis[k] = 1;
        if (const Vec x = part_across(axis); across.empty() || length(x) > length(across)) across = x;
      }
      across = scaled(1 / length(across), across);
      candidates = {solver.support(across), solver.support(scaled(-1, across))};
    }
    const Vertex best = *std::max_element(candidates.begin(), candidates.end(), [&](const Vertex& x, const Vertex& y) { return off(x) < off(y); });
    scale = std::max(scale, length(best.w));
    if (off(best) <= 1e-10 * scale) return false;
    const Vec y = part_across(minus(best.w, points[0].w));
    basis.push_back(scaled(1 / length(y), y));
    points.push_back(best);
  }
  return true;
}
struct Depth { double depth; Vec normal; Nearest foot; };
static Depth epa(Solver& solver, const Corners& simplex, double tolerance) {
  Corners points;
  Vec flat;
  if (!complete(solver, points, simplex, flat)) return {0, flat, nearest(simplex)};
  const std::size_t dimension = points[0].w.size();
  Vec inside(dimension, 0.0);
  double rounding = 0, height = 0;
  for (const Vertex& x : points) inside = plus(inside, 1.0 / static_cast<double>(points.size()), x.w), rounding = std::max(rounding, 1e-14 * length(x.w));
  // `rounding`: of a point's height above a plane, for its normal's numbers are right to the last bits.
  const int exponent = -std::ilogb(rounding / 1e-14);
  std::vector<Face> faces;
  for (const Corners& c : combinations(points, dimension)) faces.push_back(make_face(c, inside, exponent));
  Face face;
  while (true) {
    std::vector<std::vector<int>> lists;
    for (const Face& f : faces) lists.push_back(numbers(f.corners));
    solver.polytope(lists);
    face = *std::min_element(faces.begin(), faces.end(), [](const Face& x, const Face& y) { return x.distance < y.distance; });
    solver.face(numbers(face.corners), face.normal, face.distance);
    const Vertex w = solver.support(face.normal);
    height = dot(face.normal, w.w);
    rounding = std::max(rounding, 1e-14 * length(w.w));
    if (height - face.distance <= std::max(tolerance * height, rounding) || faces.size() > 600) break;
    std::map<std::vector<int>, Corners> horizon;  // what belongs to one removed face only
    std::vector<Face> kept;
    for (const Face& f : faces) {
      const bool seen = sees(w, f, rounding, exponent);
      if (!seen) kept.push_back(f);
      for (const Corners& ridge : seen ? combinations(f.corners, dimension - 1) : std::vector<Corners>()) {
        std::vector<int> key = numbers(ridge);
        std::sort(key.begin(), key.end());
        if (horizon.erase(key) == 0) horizon[key] = ridge;
      }
    }
    for (auto& [key, ridge] : horizon) {
      ridge.push_back(w);
      kept.push_back(make_face(ridge, inside, exponent));
    }
    faces = kept;
  }
  // The origin's projection on the plane, as a combination of the corners of the face that holds it.
  Nearest foot;
  for (const Face& f : faces) {
    if (f.distance > face.distance + 1e-9 * height) continue;
    Corners moved = f.corners;
    for (Vertex& x : moved) x.w = plus(x.w, -face.distance, face.normal);
    if (const Nearest now = nearest(moved); foot.part.empty() || length(now.v) < length(foot.v)) foot = now;
  }
  return {height, face.normal, foot};
}

int main() {
  Solver solver;
  const Nearest found = gjk(solver, std::max(solver.tolerance, 1e-12));
  const double distance = length(found.v);
  if (solver.query == "intersect") solver.result(distance == 0);
  else if (distance > 0) {
    solver.result(false, distance, scaled(-1 / distance, found.v), found.at(&Vertex::a), found.at(&Vertex::b));
  } else if (solver.query == "distance") {
    solver.result(true, 0.0);
  } else {
    const Depth d = epa(solver, found.part, std::max(solver.tolerance, 1e-6));
    const Vec middle = scaled(0.5, plus(d.foot.at(&Vertex::a), 1, d.foot.at(&Vertex::b)));
    solver.result(true, -d.depth, d.normal, plus(middle, d.depth / 2, d.normal), plus(middle, -d.depth / 2, d.normal));
  }
}
