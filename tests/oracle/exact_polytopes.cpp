#include "tests/oracle/exact_polytopes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gjkdbg::oracle {
namespace {

using V = Eigen::Vector3d;
constexpr double infinity = std::numeric_limits<double>::infinity();

Point operator-(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
Rational dot(const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
Point cross(const Point& p, const Point& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
bool is_zero(const Point& p) { return p[0] == 0 && p[1] == 0 && p[2] == 0; }
V rounded(const Point& p) { return {p[0].get_d(), p[1].get_d(), p[2].get_d()}; }

/// The square root, correct to many more digits than a double has.
mpf_class root(const Rational& squared) {
  mpf_class x(squared, 256);
  return sqrt(x);
}

/// Both sets, exactly and as doubles relative to the first point of A.
struct Pair {
  std::vector<Point> a, b;
  std::vector<V> fa, fb;
  int dimension;
  double size = 0;

  Pair(const std::vector<Point>& points_a, const std::vector<Point>& points_b, int d) : a(points_a), b(points_b), dimension(d) {
    const Point origin = a[0];
    for (Point& p : a) p = p - origin, fa.push_back(rounded(p));
    for (Point& p : b) p = p - origin, fb.push_back(rounded(p));
    for (const V& p : fa) size = std::max(size, p.norm());
    for (const V& p : fb) size = std::max(size, (p - fb[0]).norm());
  }
};

// --- Directions that can support a facet -------------------------------------------------------------------------

struct Directions {
  const Pair& pair;
  std::vector<Point> exact;  ///< kept for exact evaluation
  double least = infinity;   ///< of the heights seen
  struct Candidate {
    V n;
    double height;
    std::array<const Point*, 4> edges;  ///< n = (e1 - e0) x (e3 - e2)

    Point exactly() const { return cross(*edges[1] - *edges[0], *edges[3] - *edges[2]); }
  };
  std::vector<Candidate> candidates;

  /// max n.a - min n.b over the sets, divided by |n|: minus the gap, or the depth, along n.
  double height(const V& n) const {
    double most = -infinity, lowest = infinity;
    for (const V& p : pair.fa) most = std::max(most, n.dot(p));
    for (const V& p : pair.fb) lowest = std::min(lowest, n.dot(p));
    return most - lowest;
  }

  void add_cross(const Point& p0, const Point& p1, const V& e, const Point& q0, const Point& q1, const V& f) {
    const V n = e.cross(f);
    const double length = n.norm(), scale = e.norm() * f.norm();
    if (scale == 0) return;
    if (length <= 1e-6 * scale) {  // nearly parallel: doubles cannot judge
      const Point exactly = cross(p1 - p0, q1 - q0);
      if (!is_zero(exactly)) keep(exactly);
      return;
    }
    for (const double sign : {1.0, -1.0}) {
      const V unit = sign * n / length;
      const double h = height(unit);
      if (h > least + 1e-8 * pair.size) continue;
      least = std::min(least, h);
      const Candidate candidate{unit, h, sign > 0 ? std::array{&p0, &p1, &q0, &q1} : std::array{&p1, &p0, &q0, &q1}};
      // Of short edges n may be far from what it is exactly.
      const auto same = [&](const Candidate& c) { return (c.n - unit).norm() < 2e-15 && is_zero(cross(c.exactly(), candidate.exactly())); };
      if (std::none_of(candidates.begin(), candidates.end(), same)) candidates.push_back(candidate);
    }
  }

  void keep(const Point& n) {
    exact.push_back(n);
    exact.push_back(Point{} - n);
  }

  void finish() {
    for (const Candidate& c : candidates)
      if (c.height <= least + 1e-8 * pair.size) exact.push_back(c.exactly());
  }
};

void add_triples(Directions& out, const std::vector<Point>& p, const std::vector<V>& f) {
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j)
      for (std::size_t k = j + 1; k < p.size(); ++k) out.add_cross(p[i], p[j], f[j] - f[i], p[i], p[k], f[k] - f[i]);
}

void add_edge_pairs(Directions& out) {
  const Pair& s = out.pair;
  for (std::size_t i = 0; i < s.a.size(); ++i)
    for (std::size_t j = i + 1; j < s.a.size(); ++j)
      for (std::size_t k = 0; k < s.b.size(); ++k)
        for (std::size_t l = k + 1; l < s.b.size(); ++l)
          out.add_cross(s.a[i], s.a[j], s.fa[j] - s.fa[i], s.b[k], s.b[l], s.fb[l] - s.fb[k]);
}

std::vector<Point> edges(const Pair& s) {
  std::vector<Point> out;
  for (const auto* set : {&s.a, &s.b})
    for (std::size_t i = 0; i < set->size(); ++i)
      for (std::size_t j = i + 1; j < set->size(); ++j)
        if (const Point e = (*set)[j] - (*set)[i]; !is_zero(e)) out.push_back(e);
  return out;
}

/// Where A - B spans less than its space, directions within what it spans, and those across it.
std::vector<Point> directions(const Pair& s) {
  Directions out{s, {}, infinity, {}};
  const std::vector<Point> all = edges(s);
  const Point w = s.a[0] - s.b[0];
  const Point* first = all.empty() ? nullptr : &all[0];
  Point plane{};
  if (first)
    for (const Point& e : all)
      if (plane = cross(*first, e); !is_zero(plane)) break;
  const bool planar = !is_zero(plane);
  const bool solid = planar && std::any_of(all.begin(), all.end(), [&](const Point& e) { return dot(plane, e) != 0; });
  if (!first) {
    if (!is_zero(w)) out.keep(w);
  } else if (!planar) {
    out.keep(*first);
    // Across the line: from it to the origin, if the origin is not on it.
    Point across = w;
    const Rational t = dot(w, *first) / dot(*first, *first);
    for (int i = 0; i < 3; ++i) across[i] -= t * (*first)[i];
    if (s.dimension > 1 && !is_zero(across)) out.keep(across);
    if (s.dimension > 1 && is_zero(across)) {  // any direction across it: depth 0
      const Point z{0, 0, 1}, x{1, 0, 0};
      out.keep(s.dimension == 2 || !is_zero(cross(z, *first)) ? cross(z, *first) : cross(x, *first));
    }
  } else if (!solid) {
    if (s.dimension == 3) out.keep(plane);
    for (const Point& e : all) out.keep(cross(plane, e));
  } else {
    add_triples(out, s.a, s.fa);
    add_triples(out, s.b, s.fb);
    add_edge_pairs(out);
    out.finish();
  }
  return out.exact;
}

Rational exact_height(const Pair& s, const Point& n) {
  Rational most = dot(n, s.a[0]), least = dot(n, s.b[0]);
  for (const Point& p : s.a) most = std::max(most, Rational(dot(n, p)));
  for (const Point& p : s.b) least = std::min(least, Rational(dot(n, p)));
  return most - least;
}

// --- Distance over features ------------------------------------------------------------------------------------

/// A pair of features with its closest points in the interior of both, as a double and, when asked for, exactly.
struct Nearest {
  const Pair& s;
  double least = infinity;
  std::optional<Rational> exact;  ///< squared distance
  Point closest{};                ///< b - a at it

  void offer(const Point& difference) {
    const Rational squared = dot(difference, difference);
    if (!exact || squared < *exact) exact = squared, closest = difference;
  }
  bool worth(double distance) const { return distance <= least + 1e-8 * (s.size + least); }
};

void vertex_to_vertex(Nearest& best, std::size_t i, std::size_t j, bool exactly) {
  const double d = (best.s.fb[j] - best.s.fa[i]).norm();
  if (!exactly) best.least = std::min(best.least, d);
  else if (best.worth(d)) best.offer(best.s.b[j] - best.s.a[i]);
}

/// Point p against segment q0 q1; sign +1 when p is of A.
void vertex_to_edge(Nearest& best, const Point& p, const V& fp, const Point& q0, const V& f0, const Point& q1, const V& f1, int sign, bool exactly) {
  const V e = f1 - f0, x = fp - f0;
  const double ee = e.squaredNorm();
  if (ee == 0) return;
  const double t = x.dot(e) / ee;
  if (t < -1e-6 || t > 1 + 1e-6) return;
  const double d = (x - t * e).norm();
  if (!exactly) {
    if (t >= 0 && t <= 1) best.least = std::min(best.least, d);
    return;
  }
  if (!best.worth(d)) return;
  const Point ex = q1 - q0, px = p - q0;
  const Rational ete = dot(ex, ex);
  if (ete == 0) return;
  const Rational at = dot(px, ex) / ete;
  if (at < 0 || at > 1) return;
  Point difference;
  for (int i = 0; i < 3; ++i) difference[i] = sign * (q0[i] + at * ex[i] - p[i]);
  best.offer(difference);
}

void vertex_to_triangle(Nearest& best, const Point& p, const V& fp, const std::array<const Point*, 3>& q, const std::array<V, 3>& f, int sign, bool exactly) {
  const V n = (f[1] - f[0]).cross(f[2] - f[0]);
  const double nn = n.squaredNorm();
  if (nn == 0) return;
  const double d = std::abs(n.dot(fp - f[0])) / std::sqrt(nn);
  for (int i = 0; i < 3; ++i)
    if (n.dot((f[(i + 1) % 3] - f[i]).cross(fp - f[i])) < -1e-6 * nn) return;
  if (!exactly) {
    for (int i = 0; i < 3; ++i)
      if (n.dot((f[(i + 1) % 3] - f[i]).cross(fp - f[i])) < 0) return;
    best.least = std::min(best.least, d);
    return;
  }
  if (!best.worth(d)) return;
  const Point m = cross(*q[1] - *q[0], *q[2] - *q[0]);
  const Rational mm = dot(m, m);
  if (mm == 0) return;
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(m, cross(*q[(i + 1) % 3] - *q[i], p - *q[i])) < 0) return;
  const Rational t = dot(m, *q[0] - p) / mm;
  best.offer({sign * t * m[0], sign * t * m[1], sign * t * m[2]});
}

void edge_to_edge(Nearest& best, std::size_t i, std::size_t j, std::size_t k, std::size_t l, bool exactly) {
  const Pair& s = best.s;
  const V e = s.fa[j] - s.fa[i], f = s.fb[l] - s.fb[k], n = e.cross(f), w = s.fb[k] - s.fa[i];
  const double nn = n.squaredNorm();
  if (nn <= 1e-8 * e.squaredNorm() * f.squaredNorm()) {  // nearly parallel: a vertex does nearly as well, and doubles cannot judge
    if (!exactly) return;
  } else {
    const double t = w.cross(f).dot(n) / nn, u = w.cross(e).dot(n) / nn;
    if (t < -1e-6 || t > 1 + 1e-6 || u < -1e-6 || u > 1 + 1e-6) return;
    const double d = std::abs(n.dot(w)) / std::sqrt(nn);
    if (!exactly) {
      if (t >= 0 && t <= 1 && u >= 0 && u <= 1) best.least = std::min(best.least, d);
      return;
    }
    if (!best.worth(d)) return;
  }
  const Point ex = s.a[j] - s.a[i], fx = s.b[l] - s.b[k], m = cross(ex, fx), x = s.b[k] - s.a[i];
  const Rational mm = dot(m, m);
  if (mm == 0) return;
  const Rational at = dot(cross(x, fx), m), au = dot(cross(x, ex), m);
  if (at < 0 || at > mm || au < 0 || au > mm) return;
  const Rational h = dot(m, x) / mm;
  best.offer({h * m[0], h * m[1], h * m[2]});
}

void all_features(Nearest& best, bool exactly) {
  const Pair& s = best.s;
  for (std::size_t i = 0; i < s.a.size(); ++i)
    for (std::size_t j = 0; j < s.b.size(); ++j) vertex_to_vertex(best, i, j, exactly);
  const auto against = [&](const std::vector<Point>& p, const std::vector<V>& f, const std::vector<Point>& q, const std::vector<V>& g, int sign) {
    for (std::size_t v = 0; v < p.size(); ++v)
      for (std::size_t i = 0; i < q.size(); ++i)
        for (std::size_t j = i + 1; j < q.size(); ++j) {
          vertex_to_edge(best, p[v], f[v], q[i], g[i], q[j], g[j], sign, exactly);
          if (s.dimension < 3) continue;  // apart in the plane, a vertex faces no triangle
          for (std::size_t k = j + 1; k < q.size(); ++k)
            vertex_to_triangle(best, p[v], f[v], {&q[i], &q[j], &q[k]}, {g[i], g[j], g[k]}, sign, exactly);
        }
  };
  against(s.a, s.fa, s.b, s.fb, 1);
  against(s.b, s.fb, s.a, s.fa, -1);
  for (std::size_t i = 0; i < s.a.size(); ++i)
    for (std::size_t j = i + 1; j < s.a.size(); ++j)
      for (std::size_t k = 0; k < s.b.size(); ++k)
        for (std::size_t l = k + 1; l < s.b.size(); ++l) edge_to_edge(best, i, j, k, l, exactly);
}

Answer apart(const Pair& s, double radius) {
  Nearest best{s, infinity, std::nullopt, {}};
  all_features(best, false);
  all_features(best, true);
  const mpf_class distance = root(*best.exact);
  Answer answer;
  answer.signed_distance = mpf_class(distance - radius).get_d();
  answer.intersecting = answer.signed_distance <= 0;
  V n;
  for (int i = 0; i < 3; ++i) n[i] = mpf_class(mpf_class(best.closest[static_cast<std::size_t>(i)], 256) / distance).get_d();
  answer.normals = {n};
  return answer;
}

}  // namespace

Answer signed_distance(const std::vector<Point>& a, const std::vector<Point>& b, int dimension, double radius) {
  const Pair s(a, b, dimension);
  std::optional<Rational> least;  // squared depth
  std::vector<Point> normals;
  for (const Point& n : directions(s)) {
    const Rational h = exact_height(s, n);
    if (h < 0) return apart(s, radius);
    const Rational squared = h * h / dot(n, n);
    if (least && squared > *least) continue;
    if (least && squared < *least) normals.clear();
    least = squared;
    normals.push_back(n);
  }
  Answer answer;
  answer.intersecting = true;
  const mpf_class depth = root(least.value_or(Rational(0)));
  answer.signed_distance = mpf_class(-depth - radius).get_d();
  for (const Point& n : normals) answer.normals.push_back(rounded(n).normalized());
  return answer;
}

namespace {

struct Rounded {
  std::vector<Point> points;
  double radius = 0;
};

Point exact(const AnyVector& p) {
  Point out{};
  for (Eigen::Index i = 0; i < p.size(); ++i) out[static_cast<std::size_t>(i)] = p[i];
  return out;
}

std::optional<Rounded> core(const Shape& shape, int dimension) {
  Rounded out;
  if (const auto* s = std::get_if<Sphere>(&shape.geometry)) {
    out = {{Point{}}, s->radius};
  } else if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    for (int corner = 0; corner < 1 << dimension; ++corner) {
      Point p{};
      for (int i = 0; i < dimension; ++i) p[static_cast<std::size_t>(i)] = (corner >> i) % 2 == 0 ? box->min[i] : box->max[i];
      out.points.push_back(p);
    }
  } else if (const auto* c = std::get_if<Capsule>(&shape.geometry)) {
    Point p{}, q{};
    p[static_cast<std::size_t>(c->axis)] = c->half_height, q[static_cast<std::size_t>(c->axis)] = -c->half_height;
    out = {{p, q}, c->radius};
  } else if (const auto* set = std::get_if<PointSet>(&shape.geometry)) {
    for (const AnyVector& p : set->points) out.points.push_back(exact(p));
  } else if (const auto* sum = std::get_if<Sum>(&shape.geometry)) {
    const auto x = core(*sum->first, dimension), y = core(*sum->second, dimension);
    if (!x || !y) return std::nullopt;
    for (const Point& p : x->points)
      for (const Point& q : y->points) out.points.push_back({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
    out.radius = x->radius + y->radius;
  } else {
    return std::nullopt;
  }
  out.radius += shape.margin;
  return out;
}

std::vector<Point> in_world(const std::vector<Point>& points, const Pose& pose, int dimension) {
  std::vector<Point> out;
  for (const Point& p : points) {
    Point x = exact(pose.position);
    for (int i = 0; i < dimension; ++i)
      for (int j = 0; j < dimension; ++j) x[static_cast<std::size_t>(i)] += Rational(pose.matrix(i, j)) * p[static_cast<std::size_t>(j)];
    out.push_back(x);
  }
  return out;
}

}  // namespace

std::optional<Answer> signed_distance(const Scene& scene) {
  const int d = scene.dimension;
  const auto a = core(scene.bodies[0].shape, d), b = core(scene.bodies[1].shape, d);
  if (!a || !b) return std::nullopt;
  return signed_distance(in_world(a->points, scene.bodies[0].pose, d), in_world(b->points, scene.bodies[1].pose, d), d, a->radius + b->radius);
}

}  // namespace gjkdbg::oracle
