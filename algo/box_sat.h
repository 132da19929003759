// The separating axis test of two boxes in space: 15 axes, and no support mapping (on a line one axis; in the plane: algo/rectangle_sat.h).
//
// Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996, section 5. A box is its own mirror image in its centre, so of n and -n the one that
// leads towards the other box counts. With half sizes a, b, the axes of B as the columns of R, and p from centre to centre, the height of
// A - B along a unit direction n is
//
//   h(n) = sum_k a_k |n_k| + sum_k b_k |R_k . n| - |n . p|
//
//   n = e_i          a_i + sum_k b_k |R_ik| - |p_i|
//   n = R_j          sum_k a_k |R_kj| + b_j - |R_j . p|
//   n = e_i x R_j    (a_k |R_lj| + a_l |R_kj| + b_m |R_in| + b_n |R_im| - |p_l R_kj - p_k R_lj|) / |(R_kj, R_lj)|
//                    with i k l and j m n cyclic: e_i x R_j is R_kj e_l - R_lj e_k, and (e_i x R_j) . R_m = +- R_in
//
// The least height is the depth, as in algo/sat.h; where it is negative and both witnesses lie on their boxes, it is the distance. Else the nearest
// features are a corner and an edge or another corner, which no axis is made of. A point and its nearest on the other box, in turn, come to them in
// a few steps, and points that are each the nearest to the other are the closest of all: a plane across at either has the whole box behind it
// (alternating projections; Cheney, Goldstein 1959, theorem 2). The height along their difference proves it; where it does not, as when edges are nearly
// parallel and the points creep, GJK is asked.
//
// A query's branches are as random as its bodies. In space there are none where the least of the faces and the sides of corners are chosen: of pairs that are
// asked of once 5 branches are mispredicted, not 10, and a sixth of the time is saved (pairs that come round and round, which a processor learns, lose 4 %).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algo/nearest_points.h"
#include "algo/sat.h"

namespace gjkdbg {

/// The body's core where it is a box with no side of zero, else null.
template <int D, class S, class Body>
const BoxCore<D, S>* solid_box(const Body& body) {
  if constexpr (requires { body.core(); }) {
    const auto* box = std::get_if<BoxCore<D, S>>(&body.core());
    return box && (box->half().array() > 0).all() ? box : nullptr;
  }
  return nullptr;
}

template <class Difference, class Trace>
class BoxSat {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;

 public:
  /// Half sizes and centres in each box's own axes; keeps references.
  BoxSat(Difference& difference, const BoxCore<D, S>& a, const BoxCore<D, S>& b, Trace& trace)
      : difference_(difference), trace_(trace), floor_(difference.rounding_floor()), rotation_(difference.rotation()), half_a_(a.half()), half_b_(b.half()),
        center_a_(a.center()), center_b_(difference.position() + rotation_ * b.center()), between_(center_b_ - center_a_), along_(rotation_.transpose() * between_) {
    for (int i = 0; i < D; ++i)  // one by one, as they are read: see MinkowskiDifference::support
      for (int j = 0; j < D; ++j) magnitude_[i][j] = std::abs(rotation_(i, j));
  }

  /// `enough`: the separation that needs no more, >= 0; infinite where the distance is asked for.
  const SatResult<D, S>& run(S enough) {
    enough_ = enough;
    trace_(SatBegan<V, Viewed>{D, D, D == 3 ? 9 : 0});
    result_.status = all_axes();
    result_.normal = normal(best_);
    if (result_.status == SatStatus::overlapping) result_.depth = height(result_.normal);
    else if (-result_.depth <= enough_) gap_ = find_gap();
    if (result_.depth == 0) result_.depth = 0;
    trace_(SatEnded<V, Viewed>{result_.iterations, result_.status, result_.normal,
                               static_cast<double>(-result_.depth) - static_cast<double>(difference_.radius())});
    return result_;
  }

  /// Of boxes that overlap. Unset where rounding has the last word.
  /// Features that lie flat on one another, or nearly so, share more than one point: projecting on one box and the other in turn finds one.
  std::optional<SatWitnesses<D, S>> witnesses() const {
    const V out = result_.normal * result_.depth;
    V a = start(out);
    for (int round = 8; round > 0; --round) {
      a = nearest_on_a(a);
      const V b = in_b(a - out), on_b = clamped(b, half_b_);
      if (near(b, on_b)) return SatWitnesses<D, S>{a, a - out};
      a = from_b(on_b) + out;
    }
    return std::nullopt;
  }

  /// Of boxes that are apart, but by no more than enough. Unset where it is not proven.
  const std::optional<NearestPoints<D, S>>& gap() const { return gap_; }

 private:
  struct Axis {
    AxisSource source = AxisSource::face_a;
    int i = 0, j = 0;  ///< of A, of B
  };

  /// The search so far: no part of the object, so that it never leaves the registers.
  struct Least {
    S height = std::numeric_limits<S>::infinity();
    Axis axis;
    int tested = 0;
  };

  SatStatus all_axes() {
    Least least;
    const bool apart = faces_separate(least, std::make_integer_sequence<int, D>{}) || edge_pairs_separate(least, std::make_integer_sequence<int, D == 3 ? 9 : 0>{});
    result_.iterations = least.tested, result_.depth = least.height, best_ = least.axis;
    if constexpr (!traced<Trace>) difference_.count_supports(least.tested);  // an axis is a support of which only the height is wanted
    return apart || result_.depth < -floor_ ? SatStatus::separated : SatStatus::overlapping;
  }

  // Spelled out axis by axis: places known to the compiler take half the instructions of a loop's.
  template <int... i>
  bool faces_separate(Least& least, std::integer_sequence<int, i...>) {
    if constexpr (D == 3 && !traced<Trace>)
      if (std::isinf(enough_)) return least = least_of({face_height_a<i>()..., face_height_b<i>()...}), false;
    return (separates(least, {AxisSource::face_a, i, 0}, face_height_a<i>()) || ...) || (separates(least, {AxisSource::face_b, 0, i}, face_height_b<i>()) || ...);
  }
  template <int i>
  S face_height_a() const { return half_a_[i] + reach(half_b_, [&](int j) { return magnitude_[i][j]; }) - std::abs(between_[i]); }
  template <int j>
  S face_height_b() const { return half_b_[j] + reach(half_a_, [&](int i) { return magnitude_[i][j]; }) - std::abs(along_[j]); }

  /// Where no axis is the last: all at once, as a tournament, so that none waits for all before it. The first of equals.
  static Least least_of(const std::array<S, 6>& heights) {
    struct Entry {
      S height;
      int number;
    };
    const auto entry = [&](int number) { return Entry{heights[static_cast<std::size_t>(number)], number}; };
    const auto less = [](const Entry& p, const Entry& q) { return Entry{q.height < p.height ? q.height : p.height, q.height < p.height ? q.number : p.number}; };
    const Entry least = less(less(less(entry(0), entry(1)), entry(2)), less(less(entry(3), entry(4)), entry(5)));
    const bool of_a = least.number < 3;
    const int k = of_a ? least.number : least.number - 3;
    return {least.height, {of_a ? AxisSource::face_a : AxisSource::face_b, k, k}, 6};
  }

  template <int... pair>
  bool edge_pairs_separate(Least& least, std::integer_sequence<int, pair...>) {
    return (edges_separate<pair / 3, pair % 3>(least) || ...);
  }

  template <int i, int j>
  [[gnu::always_inline]] inline bool edges_separate(Least& least) {
    constexpr int k = next(i), l = next(k), m = next(j), n = next(m);
    const S x = rotation_(k, j), y = rotation_(l, j), squared = x * x + y * y;
    constexpr S parallel = S(64) * std::numeric_limits<S>::epsilon();
    if (!(squared > parallel * parallel)) return false;  // no face of its own; the faces beside have been tested
    const S height = half_a_[k] * magnitude_[l][j] + half_a_[l] * magnitude_[k][j] + half_b_[m] * magnitude_[i][n] + half_b_[n] * magnitude_[i][m] -
                     std::abs(between_[l] * x - between_[k] * y);
    // Whether it is less than the least is told without a root: with f(x) = x |x|, which grows with x, height / |(x, y)| < least where f(height) < f(least) (x^2 + y^2).
    const bool more = height * std::abs(height) >= least.height * std::abs(least.height) * squared;
    if constexpr (!traced<Trace>)
      if (more) return ++least.tested, false;
    return separates(least, {AxisSource::edge_pair, i, j}, height / std::sqrt(squared), more);
  }

  static constexpr int next(int i) { return i == 2 ? 0 : i + 1; }

  /// `more`: it is known to be no less than the least.
  [[gnu::always_inline]] inline bool separates(Least& least, const Axis& axis, S height, bool more = false) {
    if (!more && height < least.height) least.height = height, least.axis = axis;
    ++least.tested;
    if constexpr (traced<Trace>) trace_axis(least, axis, height);
    return -height > enough_ + floor_;
  }

  /// In a trace the support is asked for in full.
  void trace_axis(const Least& least, const Axis& axis, S height) {
    const V n = normal(axis);
    const auto point = difference_.support(n);
    const double radius = static_cast<double>(difference_.radius());
    trace_(SupportQueried<V, Viewed>{least.tested, Phase::sat, n, point.vertex, point.a, point.b, point.w});
    trace_(AxisTested<V, Viewed>{least.tested, axis.source, point.vertex, n, static_cast<double>(-height) - radius,
                                 static_cast<double>(-least.height - floor_) - radius, std::numeric_limits<double>::quiet_NaN()});
  }

  /// Unit, towards B.
  V normal(const Axis& axis) const {
    if constexpr (D < 3) {
      if (axis.source == AxisSource::face_a) return between_[axis.i] < 0 ? V(-V::Unit(axis.i)) : V(V::Unit(axis.i));
      return along_[axis.j] < 0 ? V(-rotation_.col(axis.j)) : V(rotation_.col(axis.j));
    } else if (axis.source != AxisSource::edge_pair) {
      static constexpr std::array<S, 9> own{1, 0, 0, 0, 1, 0, 0, 0, 1};
      const bool of_a = axis.source == AxisSource::face_a;  // no branch: one address or another
      const int k = of_a ? axis.i : axis.j;
      const S* column = (of_a ? own.data() : rotation_.data()) + D * k;
      return V(column[0], column[1], column[2]) * with_sign(S(1), (of_a ? between_.data() : along_.data())[k]);
    }
    V n = V::Zero();
    if constexpr (D == 3) {
      const int k = next(axis.i), l = next(k);
      const S x = rotation_(k, axis.j), y = rotation_(l, axis.j), length = std::sqrt(x * x + y * y);
      const auto component = [&](int i) { return i == k ? -y / length : i == l ? x / length : S(0); };
      n = V(component(0), component(1), component(2));
    }
    return n * with_sign(S(1), n.dot(between_));
  }

  /// `size` or, where `of` is negative, -`size`. (Of -0 as of 0.)
  static S with_sign(S size, S of) {
    if constexpr (D < 3) return of < 0 ? -size : size;
    return std::copysign(size, of + S(0));
  }

  /// A corner farthest along d.
  V corner_a(const V& d) const {
    V corner = center_a_;
    for (int i = 0; i < D; ++i) corner[i] += with_sign(half_a_[i], d[i]);
    return corner;
  }
  V corner_b(const V& d) const {
    V corner = center_b_;
    for (int j = 0; j < D; ++j) corner += rotation_.col(j) * with_sign(half_b_[j], rotation_.col(j).dot(d));
    return corner;
  }

  /// How far a box reaches along a direction with these sizes of components in its axes.
  template <class Component>
  static S reach(const V& half, Component component) {
    S sum = half[0] * component(0);
    for (int i = 1; i < D; ++i) sum += half[i] * component(i);
    return sum;
  }

  /// h(n) of any unit direction.
  S height(const V& n) const {
    const V in_b = rotation_.transpose() * n;
    return reach(half_a_, [&](int i) { return std::abs(n[i]); }) + reach(half_b_, [&](int j) { return std::abs(in_b[j]); }) - n.dot(between_);
  }

  /// Across the widest gap, or by projections: see above.
  std::optional<NearestPoints<D, S>> find_gap() {
    const V out = result_.normal * result_.depth;
    V a = nearest_on_a(start(out)), b = in_b(a - out), on_b = clamped(b, half_b_);
    if (near(b, on_b)) return NearestPoints<D, S>{a, a - out, result_.normal, -result_.depth, -result_.depth - floor_};
    for (int round = 8; round > 0; --round) {
      b = from_b(on_b);
      a = nearest_on_a(b);
      ++result_.iterations;
      if constexpr (traced<Trace>) trace_projection(a, b);
      const V before = std::exchange(on_b, clamped(in_b(a), half_b_));
      if (near(on_b, before)) return proven_gap(a, b);
    }
    return std::nullopt;
  }

  std::optional<NearestPoints<D, S>> proven_gap(const V& a, const V& b) {
    const S distance = (b - a).norm();
    if (!(distance > floor_)) return std::nullopt;
    const V n = (b - a) / distance;
    const S plane = -height(n);
    if (distance - plane > 2 * floor_) return std::nullopt;
    result_.normal = n, result_.depth = -distance;
    return NearestPoints<D, S>{a, b, n, distance, plane - floor_};
  }

  void trace_projection(const V& a, const V& b) {
    const S distance = (b - a).norm(), plane = distance > 0 ? -height(V((b - a) / distance)) : S(0);
    const double radius = static_cast<double>(difference_.radius());
    trace_(PointsProjected<V, Viewed>{result_.iterations, a, b, V(a - b), static_cast<double>(std::max(plane, -result_.depth) - floor_) - radius,
                                      static_cast<double>(distance + floor_) - radius});
  }

  V nearest_on_a(const V& p) const { return center_a_ + clamped(p - center_a_, half_a_); }
  V in_b(const V& p) const { return rotation_.transpose() * (p - center_b_); }  ///< from A's axes, about A's reference, to B's, about its centre
  V from_b(const V& p) const { return center_b_ + rotation_ * p; }
  bool near(const V& p, const V& q) const {
    if constexpr (D < 3) return ((p - q).cwiseAbs().array() <= floor_).all();
    bool all = true;
    for (int i = 0; i < D; ++i) all &= std::abs(p[i] - q[i]) <= floor_;
    return all;
  }

  static V clamped(const V& p, const V& half) { return p.cwiseMin(half).cwiseMax(-half); }

  /// The point of A on the deepest feature: across a corner of B, a corner, or where the edges cross. The lines of two edges, c_a + s e_i and
  /// c_b + t R_j, are nearest where s = (u - r v) / (1 - r^2) with u, v the parts of c_b - c_a along them and r = R_ij; 1 - r^2 is the sum of
  /// the other two squares in the column.
  V start(const V& out) const {
    const V& n = result_.normal;
    const bool across = best_.source == AxisSource::face_a;
    if constexpr (D < 3) return across ? V(corner_b(-n) + out) : corner_a(n);
    const V of_b = corner_b(-n);
    V a = corner_a(n);
    if constexpr (D == 3) {
      if (best_.source == AxisSource::edge_pair) {
        const int i = best_.i, k = next(i), l = next(k);
        const V edge = rotation_.col(best_.j);
        a[i] = center_a_[i];
        const V apart = of_b - a;
        a[i] += (apart[i] - edge[i] * edge.dot(apart)) / (edge[k] * edge[k] + edge[l] * edge[l]);
        return a;
      }
    }
    for (int i = 0; i < D; ++i) a[i] = across ? of_b[i] + out[i] : a[i];
    return a;
  }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const Matrix<D, S>& rotation_;
  const V half_a_, half_b_, center_a_, center_b_, between_, along_;
  S magnitude_[D][D];  ///< |R_ij|
  S enough_ = 0;
  Axis best_;
  SatResult<D, S> result_;
  std::optional<NearestPoints<D, S>> gap_;
};

}  // namespace gjkdbg
