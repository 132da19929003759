// Boolean GJK as Casey Muratori teaches it ("Implementing GJK", 2006): do the bodies overlap, yes or no.
//
// A is always the newest vertex. A simplex is kept, and a direction D towards the origin from the part of it that
// matters; a new vertex that does not pass the origin (A . D < 0) proves the bodies apart. What has been ruled out by
// getting here is never tested again:
//
//   line AB        The origin is not behind B: A was found by going from B towards it. It is not beyond A: A
//                  passed it. So it is beside the segment: region AB, D = AB x AO x AB.
//
//              \  A  /         triangle ABC: beyond edge BC, and next to B or C alone, are ruled out by the
//            AC \   / AB       line case that went from BC to A. Five regions are left of the eight:
//          ------A------       A, AB, AC, and above or below the triangle.
//               / \            .
//              / in\           tetrahedron ABCD: the origin is not beyond BCD. Beyond ABC, ACD or ADB: the triangle
//             C-----B          case of that face; of several the nearest region. Beyond none: enclosed.
//
// No division, no square root, no distance: only signs. Where a direction vanishes the origin lies on the simplex:
// touching, which is overlapping.
#pragma once

#include <limits>

#include "algo/orientation.h"
#include "algo/simplex.h"
#include "algo/trace.h"

namespace gjkdbg {

struct BooleanGjkResult {
  GjkStatus status = GjkStatus::separated;
  int iterations = 0;
  bool intersecting() const { return status == GjkStatus::enclosed || status == GjkStatus::touching; }
};

template <class Difference, class Trace>
class BooleanGjk {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;

 public:
  /// `difference` answers with points of the bodies themselves, radii included (InflatedDifference). `direction`: body 0's frame, not zero.
  BooleanGjk(Difference& difference, const V& direction, int max_iterations, Trace& trace)
      : difference_(difference), d_(direction), max_iterations_(max_iterations), trace_(trace) {}

  BooleanGjkResult run() {
    trace_(GjkBegan<V, Viewed>{d_});
    push(query());
    d_ = -w(0);
    while (true) {
      const S most = d_.cwiseAbs().maxCoeff();
      if (!(most > 0)) return finish(GjkStatus::touching);
      if (most > long_one || most < 1 / long_one) d_ /= most;
      if (result_.iterations >= max_iterations_) return finish(GjkStatus::iteration_limit);
      ++result_.iterations;
      const Point a = query();
      if (a.w.dot(d_) < 0) return finish(GjkStatus::separated);
      if (holds(a.w)) return finish(GjkStatus::touching);
      push(a);
      if (do_simplex()) return finish(GjkStatus::enclosed);
    }
  }

 private:
  /// Across an edge d is of the third power of lengths, or the fifth, and the support of an ellipsoid squares its product with another. Of lengths up to 2^16 in
  /// float and 2^64 in double (working_scale.h) these squares are finite, and not zero, for a d between this and one over it: (2^16 1e10)^2 = 4e29, (2^64 1e60)^2 = 3e158.
  static constexpr S long_one = std::is_same_v<S, float> ? S(1e10) : S(1e60);
  static constexpr S leans = S(1e-3);  ///< what is left of long vectors, below which rounding turns it by more than a thousand of its units
  static constexpr S leans_on_edge = S(1.0 / 32);  ///< the same of two vertices, where to look again costs less

  /// Part of the simplex, and the direction from it towards the origin. Indices into points_: 0 is A, the newest.
  struct Region {
    int count = 0;
    std::array<int, 3> index{};
    V direction = V::Zero();
  };

  const V& w(int i) const { return points_[i].w; }

  Point query() {
    const Point point = difference_.support(d_);
    if constexpr (traced<Trace>)
      trace_(SupportQueried<V, Viewed>{result_.iterations, Phase::gjk, d_, point.vertex, point.a, point.b, point.w});
    return point;
  }

  bool holds(const V& x) const {
    return std::any_of(points_.begin(), points_.begin() + size_, [&](const Point& p) { return p.w == x; });
  }

  void push(const Point& point) {
    for (int i = size_; i > 0; --i) points_[i] = points_[i - 1];
    points_[0] = point;
    ++size_;
  }

  /// Cuts the simplex down and sets the next direction; true when the simplex encloses the origin.
  bool do_simplex() {
    Region region;
    if (size_ == D + 1 && encloses(region)) {
      trace_kept({0, 1, 2, 3}, size_);
      return true;
    }
    if (size_ == 2 && D > 1) region = line(0, 1);
    if constexpr (D == 3)
      if (size_ == 3) region = triangle(0, 1, 2);
    trace_kept({region.index[0], region.index[1], region.index[2], 0}, region.count);
    std::array<Point, D + 1> kept;
    for (int i = 0; i < region.count; ++i) kept[i] = points_[region.index[i]];
    std::copy(kept.begin(), kept.begin() + region.count, points_.begin());
    size_ = region.count;
    d_ = region.direction;
    return false;
  }

  /// The part of x perpendicular to the edge: AB x X x AB = X (AB.AB) - AB (AB.X).
  static V across(const V& ab, const V& x) { return x * ab.dot(ab) - ab * ab.dot(x); }

  /// Towards the origin, across the edge. Next to the line that is the difference of two long vectors, rounded: nothing at all where the origin lies on
  /// it, and beside it a direction that leans along AB, by which A or B itself may seem to pass the origin. So once more across: what is left, a share s of the long ones, leans by
  /// 4 u / s, and the far end of the edge rises by that times its length, 128 u of it where s is 1 / 32.
  Region line(int a, int b) const {
    const V ab = w(b) - w(a);
    Region region{2, {a, b, 0}, across(ab, -w(a))};
    V& d = region.direction;
    const S long_ones = ab.dot(ab) * w(a).norm(), left = d.norm();
    if (left <= 8 * std::numeric_limits<S>::epsilon() * long_ones) d.setZero();
    else if (left <= leans_on_edge * long_ones) d = across(ab, d);
    return region;
  }

  Region corner(int a) const { return {1, {a, 0, 0}, V(-w(a))}; }

  /// Region A or AB, when the origin is known to be beyond edge AB.
  Region beyond_edge(int a, int b) const { return (w(b) - w(a)).dot(-w(a)) > 0 ? line(a, b) : corner(a); }

  /// AB x AC; of a thin triangle in twice the precision, for the same reason.
  V normal_of(int a, int b, int c) const requires(D == 3) {
    const V ab = w(b) - w(a), ac = w(c) - w(a), n = ab.cross(ac);
    if (n.dot(n) > leans * leans * ab.dot(ab) * ac.dot(ac)) return n;
    using W = WideVector<S>;
    return W::difference(w(b), w(a)).cross(W::difference(w(c), w(a))).template rounded<3>();
  }

  Region triangle(int a, int b, int c) const requires(D == 3) {
    const V ab = w(b) - w(a), ac = w(c) - w(a), ao = -w(a), n = normal_of(a, b, c);
    if (n.cross(ac).dot(ao) > 0) return ac.dot(ao) > 0 ? line(a, c) : beyond_edge(a, b);
    if (ab.cross(n).dot(ao) > 0) return beyond_edge(a, b);
    const S height = n.dot(ao);
    if (std::abs(height) <= 8 * std::numeric_limits<S>::epsilon() * n.norm() * ao.norm()) return {3, {a, b, c}, V::Zero()};
    if (height > 0) return {3, {a, b, c}, n};
    return {3, {a, c, b}, V(-n)};
  }

  /// Whether D + 1 vertices enclose the origin; if not, the region it is in.
  bool encloses(Region& region) const {
    if constexpr (D == 1) return true;  // B, then A beyond the origin: it lies between
    if constexpr (D == 2) return inside_triangle(region);
    if constexpr (D == 3) return inside_tetrahedron(region);
  }

  bool inside_triangle(Region& region) const requires(D == 2) {
    const auto beyond = [&](int b, int opposite) {
      const V ab = w(b) - w(0), ao = -w(0), away(ab[1], -ab[0]);
      const S side = away.dot(w(opposite) - w(0)), origin = away.dot(ao);
      return side > 0 ? origin < 0 : origin > 0;
    };
    if (beyond(1, 2)) return region = beyond_edge(0, 1), false;
    if (beyond(2, 1)) return region = beyond_edge(0, 2), false;
    return true;
  }

  bool inside_tetrahedron(Region& region) const requires(D == 3) {
    static constexpr int faces[3][3] = {{1, 2, 3}, {2, 3, 1}, {3, 1, 2}};  // A b c, opposite
    S nearest = std::numeric_limits<S>::infinity();
    for (const auto& f : faces) {
      const V n = normal_of(0, f[0], f[1]);
      const S inner = n.dot(w(f[2]) - w(0)), origin = n.dot(-w(0));
      if (inner > 0 ? origin >= 0 : inner < 0 ? origin <= 0 : false) continue;
      const Region candidate = triangle(0, f[0], f[1]);
      if (const S distance = squared_distance(candidate); region.count == 0 || distance < nearest) nearest = distance, region = candidate;
    }
    return region.count == 0;
  }

  /// For the rare origin beyond several faces: of their regions the nearest is the right one. (a . d)^2 / d . d: across an edge d is of the third power of lengths, and
  /// the square of the eighth, too large for float.
  S squared_distance(const Region& region) const {
    const V &a = w(region.index[0]), &d = region.direction;
    const S along = a.dot(d), length = d.dot(d);
    return length > 0 ? along / length * along : S(0);
  }

  void trace_kept(const std::array<int, 4>& kept, int count) {
    if constexpr (traced<Trace>) {
      std::array<int, 4> before{}, region{};
      for (int i = 0; i < size_; ++i) before[i] = points_[i].vertex;
      for (int i = 0; i < count; ++i) region[i] = points_[kept[i]].vertex;
      const double nothing = std::numeric_limits<double>::quiet_NaN();
      trace_(SimplexReduced<V, Viewed>{result_.iterations, std::span<const int>(before.data(), size_),
                                       std::span<const int>(region.data(), count), {},
                                       V::Constant(std::numeric_limits<S>::quiet_NaN()), nothing, nothing});
    }
  }

  BooleanGjkResult finish(GjkStatus status) {
    result_.status = status;
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    trace_(GjkEnded<V, Viewed>{result_.iterations, status, nothing, nothing});
    return result_;
  }

  Difference& difference_;
  V d_;
  const int max_iterations_;
  Trace& trace_;
  std::array<Point, D + 1> points_{};
  int size_ = 0;
  BooleanGjkResult result_;
};

/// A difference whose support points are those of the bodies: each core's plus its radius along the direction.
template <class Difference>
class InflatedDifference {
 public:
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;

  explicit InflatedDifference(Difference& cores) : cores_(cores) {}

  S rounding_floor() const { return cores_.rounding_floor() + 4 * std::numeric_limits<S>::epsilon() * cores_.radius(); }

  SupportPoint<D, S> support(const V& d) {
    auto point = cores_.support(d);
    const V n = d.stableNormalized();
    point.a += cores_.radius_a() * n;
    point.b -= cores_.radius_b() * n;
    point.w = point.a - point.b;
    return point;
  }

 private:
  Difference& cores_;
};

}  // namespace gjkdbg
