// The planes of the polytope's faces. Most come as a fan, between a ring of points and one more, the apex, and are found four at a time:
//
//            p              face k is (r_k, r_k+1, p), counter-clockwise seen from outside; its plane's normal is (r_k - p) x (r_k+1 - p).
//          / | \.           Where p lies inwards of the ring, (r_k+1, r_k, p) is: `Turn::around_inner`.
//        /   |   \.
//     r_0---r_1---r_2
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "algo/polytope_face.h"

namespace gjkdbg {

/// Sine of the angle between a face's edges below which its normal is worth less than 1e-13 in double.
template <class S>
inline constexpr S thin_sine = S(1e-3);

enum class Turn { around_outer, around_inner };

/// What rounding leaves open of the distance from the origin of a plane through p with the normal e x f: that is off by 9 u |e| |f| at most, so the unit normal
/// by 9 u over the sine between e and f, and the distance by |p| times that.
template <class S>
struct PlaneRounding {
  static constexpr S of_sine = S(4.5) * std::numeric_limits<S>::epsilon();
  S allowed_squared;  ///< below its root it counts for nothing
  S most;             ///< where the sine is no thin one

  /// `area` = |e x f|^2, `edges` = |e|^2 |f|^2.
  S of_distance(S area, S edges, const Vector<3, S>& p) const { return of_sine * of_sine * p.dot(p) * edges > allowed_squared * area ? most : S(0); }
};

/// The points of a polytope, and a ring of n of them around another: ring[n] to ring[n + 3] are ring[0] again.
template <class S>
struct Fan {
  const SupportPoint<3, S>* points;
  const int* ring;
  int n, apex;
  PlaneRounding<S> rounding;
};

/// Sets a face's plane from the edges that lead from its last vertex, `apex`, to its others, and what its distance may be `off` by. False, and it is not set,
/// where the angle between them is too small for plain arithmetic.
template <class S>
[[gnu::always_inline]] inline bool set_plane_plainly(PolytopeFace<3, S>& face, const Vector<3, S>& edge, const Vector<3, S>& next, const Vector<3, S>& apex, const PlaneRounding<S>& rounding, S& off) {
  const Vector<3, S> n = edge.cross(next);
  const S area = n.dot(n), edges = edge.dot(edge) * next.dot(next);
  if (!(area > thin_sine<S> * thin_sine<S> * edges)) return false;
  face.normal = n / std::sqrt(area);
  face.distance = face.normal.dot(apex);
  off = rounding.of_distance(area, edges, apex);
  return true;
}

/// Sets a face's plane from its vertices in twice the precision, its distance as that of `near`, one of them: right to the last digits.
template <class S>
void set_plane_widely(PolytopeFace<3, S>& face, const Vector<3, S>& a, const Vector<3, S>& b, const Vector<3, S>& c, const Vector<3, S>& near) {
  using V = Vector<3, S>;
  using W = WideVector<S>;
  const W exact = W::difference(b, a).cross(W::difference(c, a));
  const S scale = exact.template rounded<3>().cwiseAbs().maxCoeff();
  const V n = exact.template rounded<3>() / (scale > 0 ? scale : S(1));
  const S length = n.norm();
  face.normal = length > 0 ? V(n / length) : V(V::Zero());
  face.distance = length > 0 ? static_cast<S>(double(exact.dot(W(near)))) / (scale * length) : std::numeric_limits<S>::infinity();
}

/// Sets a face's plane from its vertices. 3D: n = (b - a) x (c - a), where the last vertex's edges are too thin that of the two shorter edges, and where
/// these are, too, in twice the precision. Returns what its distance may be off by.
template <int D, class S>
S set_plane(PolytopeFace<D, S>& face, const SupportPoint<D, S>* points, [[maybe_unused]] const PlaneRounding<S>& rounding) {
  using V = Vector<D, S>;
  S off = 0;
  const auto at = [&](int i) -> const V& { return points[i].w; };
  const V& a = at(face.vertices[0]);
  if constexpr (D == 1) {
    face.distance = face.normal[0] * a[0];
  } else if constexpr (D == 2) {
    const V e = at(face.vertices[1]) - a;
    const S length = e.norm();
    face.normal = length > 0 ? V(V(e[1], -e[0]) / length) : V(V::Zero());
    const V& b = at(face.vertices[1]);
    face.distance = length > 0 ? face.normal.dot(a.dot(a) < b.dot(b) ? a : b) : std::numeric_limits<S>::infinity();
  } else {
    const V &b = at(face.vertices[1]), &c = at(face.vertices[2]);
    if (set_plane_plainly<S>(face, a - c, b - c, c, rounding, off)) return off;
    // The two shorter edges, and the corner nearest the origin. Looked up: which it is, is nothing a processor can guess.
    const V edges[3] = {b - a, c - b, a - c};
    const S squared[3] = {edges[0].dot(edges[0]), edges[1].dot(edges[1]), edges[2].dot(edges[2])};
    const std::size_t longest = ((squared[1] >= squared[0]) & (squared[1] >= squared[2])) != 0 ? 1 : 2 * (squared[2] >= squared[0]);
    constexpr std::size_t after[3] = {1, 2, 0};
    const std::size_t i = after[longest], j = after[i];
    const V n = edges[i].cross(edges[j]);
    const S length = n.norm();
    const S da = a.dot(a), db = b.dot(b);
    const V* const corners[3] = {&a, &b, &c};
    const V& near = *corners[std::min(da, db) <= c.dot(c) ? db < da : 2];
    if (length * length > thin_sine<S> * thin_sine<S> * squared[i] * squared[j]) {
      face.normal = n / length;
      face.distance = face.normal.dot(near);
      return rounding.of_distance(length * length, squared[i] * squared[j], near);
    }
    set_plane_widely<S>(face, a, b, c, near);
  }
  return off;
}

#ifdef GJKDBG_AVX2
/// set_plane_plainly for face k of a fan in faces[k], with the same bits, and minus its distance, less what that may be off by, in nearness[k]. `nearness` must have room for up to three
/// numbers more, which become -infinity. False when some planes are not set: their distance is infinite.
bool set_fan_by_avx2(const Fan<double>& fan, Turn turn, PolytopeFace<3, double>* faces, double* nearness);
#endif

}  // namespace gjkdbg
