// The simplex of GJK: at most D + 1 vertices of the difference, and the point of their hull closest to the origin.
#pragma once

#include <algorithm>
#include <array>

#include "algo/minkowski_difference.h"

namespace gjkdbg {

/// What a closest-point sub-algorithm says about the hull of some vertices: the smallest subset whose hull holds the point v
/// closest to the origin, as indices into the vertices handed in, and the weights with v = sum weight_i w_i.
/// When `enclosed`, the origin lies strictly inside all D + 1 of them: v = 0, all are kept.
template <int D, class S>
struct ClosestFeature {
  int count = 0;
  std::array<int, D + 1> index{};
  std::array<S, D + 1> weight{};
  Vector<D, S> v = Vector<D, S>::Zero();
  S v_squared = 0;
  bool enclosed = false;
};

template <int D, class S>
struct Simplex {
  using Point = SupportPoint<D, S>;
  int size = 0;
  std::array<Point, D + 1> points{};
  std::array<S, D + 1> weights{};

  void add(const Point& point) { points[size] = point, weights[size++] = 0; }

  bool holds(const Vector<D, S>& w) const {
    bool held = false;
    for (int i = 0; i < size; ++i) held |= ((points[i].w.array() == w.array()).template cast<int>().sum() == D);
    return held;
  }

  /// Keeps the vertices of a feature, in their order, with its weights.
  void reduce_to(const ClosestFeature<D, S>& feature) {
    const std::array<Point, D + 1> before = points;
    for (int i = 0; i < feature.count; ++i) points[i] = before[feature.index[i]], weights[i] = feature.weight[i];
    size = feature.count;
  }

  Vector<D, S> point_a() const { return weighted(&Point::a); }  ///< sum weight_i a_i
  Vector<D, S> point_b() const { return weighted(&Point::b); }

 private:
  Vector<D, S> weighted(Vector<D, S> Point::*member) const {
    Vector<D, S> sum = weights[0] * (points[0].*member);
    for (int i = 1; i < size; ++i) sum += weights[i] * (points[i].*member);
    return sum;
  }
};

}  // namespace gjkdbg
