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

/// The points of a polytope, and a ring of n of them around another: ring[n] to ring[n + 3] are ring[0] again.
template <class S>
struct Fan {
  const SupportPoint<3, S>* points;
  const int* ring;
  int n, apex;
};

/// Sets a face's plane from the edges that lead from its last vertex, `apex`, to its others. False, and it is not set, where the angle between them is too
/// small for plain arithmetic.
template <class S>
[[gnu::always_inline]] inline bool set_plane_plainly(PolytopeFace<3, S>& face, const Vector<3, S>& edge, const Vector<3, S>& next, const Vector<3, S>& apex) {
  const Vector<3, S> n = edge.cross(next);
  const S area = n.dot(n);
  if (!(area > thin_sine<S> * thin_sine<S> * (edge.dot(edge) * next.dot(next)))) return false;
  face.normal = n / std::sqrt(area);
  face.distance = face.normal.dot(apex);
  return true;
}

/// Sets a face's plane from its vertices. 3D: n = (b - a) x (c - a), where the last vertex's edges are too thin that of the two shorter edges, and where
/// these are, too, in twice the precision.
template <int D, class S>
void set_plane(PolytopeFace<D, S>& face, const SupportPoint<D, S>* points) {
  using V = Vector<D, S>;
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
    if (set_plane_plainly<S>(face, a - c, b - c, c)) return;
    // The two shorter edges, and the corner nearest the origin. Looked up: which it is, is nothing a processor can guess.
    const V edges[3] = {b - a, c - b, a - c};
    const S squared[3] = {edges[0].dot(edges[0]), edges[1].dot(edges[1]), edges[2].dot(edges[2])};
    const std::size_t longest = ((squared[1] >= squared[0]) & (squared[1] >= squared[2])) != 0 ? 1 : 2 * (squared[2] >= squared[0]);
    constexpr std::size_t after[3] = {1, 2, 0};
    const std::size_t i = after[longest], j = after[i];
    V n = edges[i].cross(edges[j]);
    S length = n.norm();
    const S da = a.dot(a), db = b.dot(b);
    const V* const corners[3] = {&a, &b, &c};
    const V& near = *corners[std::min(da, db) <= c.dot(c) ? db < da : 2];
    if (length * length > thin_sine<S> * thin_sine<S> * squared[i] * squared[j]) {
      face.normal = n / length;
      face.distance = face.normal.dot(near);
      return;
    }
    using W = WideVector<S>;
    const W exact = W::difference(b, a).cross(W::difference(c, a));
    const S scale = exact.template rounded<3>().cwiseAbs().maxCoeff();
    n = exact.template rounded<3>() / (scale > 0 ? scale : S(1));
    length = n.norm();
    face.normal = length > 0 ? V(n / length) : V(V::Zero());
    const Wide<S> along = exact.dot(W(near));
    face.distance = length > 0 ? static_cast<S>(double(along)) / (scale * length) : std::numeric_limits<S>::infinity();
  }
}

#ifdef GJKDBG_AVX2
/// set_plane_plainly for face k of a fan in faces[k], with the same bits, and minus its distance in nearness[k]. `nearness` must have room for up to three
/// numbers more, which become -infinity. False when some planes are not set: their distance is infinite.
bool set_fan_by_avx2(const Fan<double>& fan, Turn turn, PolytopeFace<3, double>* faces, double* nearness);
#endif

}  // namespace gjkdbg
