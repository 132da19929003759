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

/// How many of the four lowest bits are set, the others not: many a processor has an instruction for it, but not all that this is built for.
constexpr int count_of(unsigned places) { return static_cast<int>(0x4332'3221'3221'2110U >> 4 * places & 7); }

/// Its points stay where they were put, by place; which of the places are taken are the bits of one number, so that the loop's next step need not wait for a list.
template <int D, class S>
struct Simplex {
  using Point = SupportPoint<D, S>;
  unsigned places = 0;                  ///< a bit for each that is taken
  std::array<S, D + 1> weights;         ///< by place
  std::array<Point, D + 1> points;      ///< by place

  int size() const { return count_of(places); }
  /// The place of the i-th vertex.
  int place(int i) const {
    unsigned left = places;
    for (; i > 0; --i) left &= left - 1;
    return std::countr_zero(left);
  }
  const Point& operator[](int i) const { return points[place(i)]; }
  S weight(int i) const { return weights[place(i)]; }

  int free_place() const { return std::countr_one(places); }
  void add(const Point& point) {
    const int free = free_place();
    points[free] = point, weights[free] = 0, places |= 1u << free;
  }

  bool holds(const Vector<D, S>& x) const { return holds(x, places); }
  /// Whether x is the vertex of one of these places.
  bool holds(const Vector<D, S>& x, unsigned among) const {
    bool held = false;
    for (int i = 0; i <= D; ++i) held |= (among >> i & 1) != 0 && points[i].w == x;
    return held;
  }

  /// Keeps the vertices of a feature, whose indices count these, with its weights.
  void reduce_to(const ClosestFeature<D, S>& feature) {
    unsigned kept = 0;
    for (int i = 0; i < feature.count; ++i) {
      const int at = place(feature.index[i]);
      kept |= 1u << at, weights[at] = feature.weight[i];
    }
    places = kept;
  }

  Vector<D, S> point_a() const { return weighted(&Point::a); }  ///< sum weight_i a_i
  Vector<D, S> point_b() const { return weighted(&Point::b); }
  Vector<D, S> point() const { return weighted(&Point::w); }

 private:
  Vector<D, S> weighted(Vector<D, S> Point::*member) const {
    int at = std::countr_zero(places);
    Vector<D, S> sum = weights[at] * (points[at].*member);
    for (unsigned left = places & (places - 1); left != 0; left &= left - 1) at = std::countr_zero(left), sum += weights[at] * (points[at].*member);
    return sum;
  }
};

}  // namespace gjkdbg
