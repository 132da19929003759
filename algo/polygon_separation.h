// How far one convex polygon lies beyond the edges of another, four edges at a time.
//
// With R and p the pose of B in A's axes, an edge of A with outward unit normal n and offset n . x along it is
//
//   n . p - offset + min over the corners b of B of (R^T n) . b
//
// before all of B, and one of B
//
//   -(R n) . p - offset + min over the corners a of A of (R n) . a
//
// before all of A.
#pragma once

#include <limits>

#include "shapes/polygon_core.h"

namespace gjkdbg {

/// Two polygons, each in its own axes. Keeps references, as what has just been written number by number is best read so, too.
template <class S>
struct PolygonPair {
  Polygon<S> a, b;
  const Matrix<2, S>& rotation;  ///< of B, in A's axes
  const Vector<2, S>& position;

  Vector<2, S> to_a(const Vector<2, S>& p) const { return rotation * p + position; }
  Vector<2, S> to_b(const Vector<2, S>& p) const { return rotation.transpose() * (p - position); }
};

/// Of four edges of A (`of_a`) or of B.
template <bool of_a, class S>
Four<S> separations(const PolygonFour<S>& edges, const PolygonPair<S>& pair) {
  using Values = typename Four<S>::Values;
  const Matrix<2, S>& r = pair.rotation;
  const Polygon<S>& other = of_a ? pair.b : pair.a;
  const auto& [x, y] = edges.normal;
  Four<S> separation;
  for (int k = 0; k < Four<S>::parts; ++k) {
    const Values to_x = r(0, 0) * x.part[k] + r(!of_a ? 0 : 1, of_a ? 0 : 1) * y.part[k], to_y = r(of_a ? 0 : 1, !of_a ? 0 : 1) * x.part[k] + r(1, 1) * y.part[k];
    Values nearest = Values{} + std::numeric_limits<S>::infinity();
    for (int i = 0; i < other.count(); ++i) {
      const auto& [corner_x, corner_y] = other.four(i).corner;
      for (std::size_t j = 0; j < 4; ++j) nearest = lesser_of<S>(to_x * corner_x[j] + to_y * corner_y[j], nearest);
    }
    if constexpr (of_a) nearest += x.part[k] * pair.position[0] + y.part[k] * pair.position[1];
    else nearest -= to_x * pair.position[0] + to_y * pair.position[1];
    separation.part[k] = nearest - edges.offset.part[k];
  }
  return separation;
}

}  // namespace gjkdbg
