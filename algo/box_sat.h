// The separating axis test of two boxes: 15 axes in space, 4 in the plane, and no support mapping.
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
// The least height is the depth, as in algo/sat.h; where it is negative and both witnesses lie on their boxes, it is the distance.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "algo/sat.h"

namespace gjkdbg {

/// Points of the cores with a - b = depth * normal.
template <int D, class S>
struct BoxWitnesses {
  Vector<D, S> a, b;
};

template <class Difference, class Trace>
class BoxSat {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;

 public:
  /// Half sizes and centres in each box's own axes; keeps references.
  BoxSat(Difference& difference, const BoxCore<D, S>& a, const BoxCore<D, S>& b, Trace& trace)
      : difference_(difference), trace_(trace), floor_(difference.rounding_floor()), rotation_(difference.rotation()), half_a_(a.half()), half_b_(b.half()),
        center_a_(a.center()), center_b_(difference.position() + rotation_ * b.center()), between_(center_b_ - center_a_), along_(rotation_.transpose() * between_),
        magnitude_(rotation_.cwiseAbs()) {}

  /// `enough`: the separation at which the search ends, >= 0.
  SatResult<D, S> run(S enough) {
    enough_ = enough;
    trace_(SatBegan<V, Viewed>{D, D, D == 3 ? 9 : 0});
    result_.status = all_axes();
    result_.normal = normal(best_);
    if (result_.status == SatStatus::overlapping) result_.depth = result_.normal.dot(difference_.support(result_.normal).w);
    if (result_.depth == 0) result_.depth = 0;
    trace_(SatEnded<V, Viewed>{result_.iterations, result_.status, result_.normal,
                               static_cast<double>(-result_.depth) - static_cast<double>(difference_.radius())});
    return result_;
  }

  /// Unset where there are none on this axis: the closest features are corners or edges that no axis is made of, or rounding has the last word.
  /// Features that lie flat on one another, or nearly so, share more than one point: projecting on one box and the other in turn finds one.
  std::optional<BoxWitnesses<D, S>> witnesses() const {
    const V out = result_.normal * result_.depth;
    V a = start(out);
    for (int round = result_.depth < 0 ? 1 : 8; round > 0; --round) {
      a = center_a_ + clamped(a - center_a_, half_a_);
      const V b = rotation_.transpose() * (a - out - center_b_), on_b = clamped(b, half_b_);
      if (((b - on_b).cwiseAbs().array() <= floor_).all()) return BoxWitnesses<D, S>{a, a - out};
      a = center_b_ + rotation_ * on_b + out;
    }
    return std::nullopt;
  }

 private:
  struct Axis {
    AxisSource source = AxisSource::face_a;
    int i = 0, j = 0;  ///< of A, of B
  };

  SatStatus all_axes() {
    for (int i = 0; i < D; ++i)
      if (separates({AxisSource::face_a, i, 0}, half_a_[i] + magnitude_.row(i).dot(half_b_.transpose()) - std::abs(between_[i]))) return SatStatus::separated;
    for (int j = 0; j < D; ++j)
      if (separates({AxisSource::face_b, 0, j}, half_b_[j] + magnitude_.col(j).dot(half_a_) - std::abs(along_[j]))) return SatStatus::separated;
    if constexpr (D == 3)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (edges_separate(i, j)) return SatStatus::separated;
    return result_.depth < -floor_ ? SatStatus::separated : SatStatus::overlapping;
  }

  bool edges_separate(int i, int j) requires(D == 3) {
    const int k = next(i), l = next(k), m = next(j), n = next(m);
    const S x = rotation_(k, j), y = rotation_(l, j), squared = x * x + y * y;
    constexpr S parallel = S(64) * std::numeric_limits<S>::epsilon();
    if (!(squared > parallel * parallel)) return false;  // no face of its own; the faces beside have been tested
    const S height = half_a_[k] * magnitude_(l, j) + half_a_[l] * magnitude_(k, j) + half_b_[m] * magnitude_(i, n) + half_b_[n] * magnitude_(i, m) -
                     std::abs(between_[l] * x - between_[k] * y);
    if constexpr (!traced<Trace>)
      if (height >= std::max(S(0), result_.depth)) return count(), false;  // and more so, divided by a length of at most 1
    return separates({AxisSource::edge_pair, i, j}, height / std::sqrt(squared));
  }

  static constexpr int next(int i) { return i == 2 ? 0 : i + 1; }

  /// An axis is a support of which only the height is wanted; in a trace it is asked for in full.
  void count() {
    ++result_.iterations;
    if constexpr (!traced<Trace>) difference_.count_support();
  }

  bool separates(const Axis& axis, S height) {
    if (result_.iterations == 0 || height < result_.depth) result_.depth = height, best_ = axis;
    count();
    if constexpr (traced<Trace>) {
      const V n = normal(axis);
      const auto point = difference_.support(n);
      const double radius = static_cast<double>(difference_.radius());
      trace_(SupportQueried<V, Viewed>{result_.iterations, Phase::sat, n, point.vertex, point.a, point.b, point.w});
      trace_(AxisTested<V, Viewed>{result_.iterations, axis.source, point.vertex, n, static_cast<double>(-height) - radius,
                                   static_cast<double>(-result_.depth - floor_) - radius, std::numeric_limits<double>::quiet_NaN()});
    }
    return -height > enough_ + floor_;
  }

  /// Unit, towards B.
  V normal(const Axis& axis) const {
    if (axis.source == AxisSource::face_a) return between_[axis.i] < 0 ? V(-V::Unit(axis.i)) : V(V::Unit(axis.i));
    if (axis.source == AxisSource::face_b) return along_[axis.j] < 0 ? V(-rotation_.col(axis.j)) : V(rotation_.col(axis.j));
    V n = V::Zero();
    if constexpr (D == 3) {
      const int k = next(axis.i), l = next(k);
      n[k] = -rotation_(l, axis.j), n[l] = rotation_(k, axis.j);
      n.normalize();
    }
    return n.dot(between_) < 0 ? V(-n) : n;
  }

  /// A corner farthest along d.
  V corner_a(const V& d) const {
    V corner = center_a_;
    for (int i = 0; i < D; ++i) corner[i] += d[i] < 0 ? -half_a_[i] : half_a_[i];
    return corner;
  }
  V corner_b(const V& d) const {
    V corner = center_b_;
    for (int j = 0; j < D; ++j) corner += rotation_.col(j) * (rotation_.col(j).dot(d) < 0 ? -half_b_[j] : half_b_[j]);
    return corner;
  }

  static V clamped(const V& p, const V& half) { return p.cwiseMin(half).cwiseMax(-half); }

  /// The point of A on the deepest feature: across a corner of B, a corner, or where the edges cross. The lines of two edges, c_a + s e_i and
  /// c_b + t R_j, are nearest where s = (u - r v) / (1 - r^2) with u, v the parts of c_b - c_a along them and r = R_ij; 1 - r^2 is the sum of
  /// the other two squares in the column.
  V start(const V& out) const {
    const V& n = result_.normal;
    if (best_.source == AxisSource::face_a) return corner_b(-n) + out;
    V a = corner_a(n);
    if constexpr (D == 3) {
      if (best_.source == AxisSource::edge_pair) {
        const int i = best_.i, k = next(i), l = next(k);
        const V edge = rotation_.col(best_.j);
        a[i] = center_a_[i];
        const V apart = corner_b(-n) - a;
        a[i] += (apart[i] - edge[i] * edge.dot(apart)) / (edge[k] * edge[k] + edge[l] * edge[l]);
      }
    }
    return a;
  }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const Matrix<D, S>& rotation_;
  const V half_a_, half_b_, center_a_, center_b_, between_, along_;
  const Matrix<D, S> magnitude_;
  S enough_ = 0;
  Axis best_;
  SatResult<D, S> result_;
};

}  // namespace gjkdbg
