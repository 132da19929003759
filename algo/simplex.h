// The simplex of GJK: at most D + 1 vertices of the difference, and the point of their hull closest to the origin.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "algo/minkowski_difference.h"

namespace gjkdbg {

/// What a closest-point sub-algorithm says about the hull of some vertices: the smallest subset whose hull holds the point v
/// closest to the origin, as indices into the vertices handed in, and the weights with v = sum weight_i w_i.
/// When `enclosed`, the origin lies strictly inside all D + 1 of them: v = 0, all are kept.
template <int D, class S>
struct ClosestFeature {
  int count = 0;
  std::array<int, D + 1> index;   ///< the first `count`
  std::array<S, D + 1> weight;    ///< the first `count`
  Vector<D, S> v = Vector<D, S>::Zero();
  S v_squared = 0;
  bool enclosed = false;
};

/// Its points stay where they were put; what changes is the list of places.
template <int D, class S>
struct Simplex {
  using Point = SupportPoint<D, S>;
  int size = 0;
  std::array<int, D + 1> place;         ///< of the first `size` points
  std::array<S, D + 1> weights;         ///< of the same
  std::array<Point, D + 1> points;      ///< by place
  std::array<Vector<D, S>, D + 1> w;    ///< by place: points[…].w, side by side

  const Point& operator[](int i) const { return points[place[i]]; }

  void add(const Point& point) {
    unsigned taken = 0;
    for (int i = 0; i < size; ++i) taken |= 1u << place[i];
    const int free = std::countr_one(taken);
    points[free] = point, w[free] = point.w;
    place[size] = free, weights[size++] = 0;
  }

  bool holds(const Vector<D, S>& x) const {
    for (int i = 0; i < size; ++i)
      if (w[place[i]] == x) return true;
    return false;
  }

  /// Keeps the vertices of a feature, whose indices are places, in their order and with its weights.
  void reduce_to(const ClosestFeature<D, S>& feature) {
    for (int i = 0; i < feature.count; ++i) place[i] = feature.index[i], weights[i] = feature.weight[i];
    size = feature.count;
  }

  Vector<D, S> point_a() const { return weighted(&Point::a); }  ///< sum weight_i a_i
  Vector<D, S> point_b() const { return weighted(&Point::b); }

 private:
  Vector<D, S> weighted(Vector<D, S> Point::*member) const {
    Vector<D, S> sum = weights[0] * ((*this)[0].*member);
    for (int i = 1; i < size; ++i) sum += weights[i] * ((*this)[i].*member);
    return sum;
  }
};

}  // namespace gjkdbg
