// The faces of the expanding polytope, and the point of a face that answers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "algo/simplex.h"
#include "algo/wide.h"

namespace gjkdbg {

template <int D, class S>
struct PolytopeFace {
  std::array<int, D> vertices;     ///< indices into points(); counter-clockwise seen from outside
  std::array<int, D> neighbours;   ///< 3D: across edge (vertices[i], vertices[i+1]), as 4 times the face and its edge; 2D: before, after; 1D: the side, -1 or 1
  Vector<D, S> normal;             ///< unit, outwards; zero for a face without area
  S distance;                      ///< of the plane from the origin, negative: the origin is outside; infinite for a face without area
  std::uint32_t place;             ///< among those that Polytope::nearest looks at
  bool removed = false;
  PolytopeFace() {}                // leaves the numbers unset: they are written next
};

/// What one growth did. The new faces are one after the other around the hole: in 3D face i lies between the edge vertices[0], vertices[1] of the
/// horizon and the new point, in 2D the first leads to it and the second from it. Valid until the next growth.
struct Growth {
  std::span<const int> removed;
  int first_added = 0, added = 0;  ///< new faces: the first one's number, how many
};

/// Weights of a face's corners with which they make its point nearest the origin (the projection; clamped to the face). `wide`: in twice the
/// precision, as thin faces need. In 3D the weight of a corner is the area of the opposite edge with the projected origin, along the normal:
/// n . (w_j x w_k).
template <int D, class S>
std::array<S, D> projection_weights(const std::array<Vector<D, S>, D>& w, [[maybe_unused]] const Vector<D, S>& normal, [[maybe_unused]] bool wide) {
  using V = Vector<D, S>;
  std::array<S, D> weight{};
  weight[0] = 1;
  if constexpr (D == 2) {
    const V e = w[1] - w[0];
    const S length = e.dot(e), t = length > 0 ? -w[0].dot(e) / length : S(0);
    weight[1] = std::clamp(t, S(0), S(1)), weight[0] = 1 - weight[1];
  } else if constexpr (D == 3) {
    const auto area = [&](const V& p, const V& q) {
      if (!wide) return std::max(S(0), normal.dot(p.cross(q - p)));
      using W = WideVector<S>;
      return std::max(S(0), static_cast<S>(double(W(normal).dot(W(p).cross(W::difference(q, p))))));
    };
    weight = {area(w[1], w[2]), area(w[2], w[0]), area(w[0], w[1])};
    const S sum = weight[0] + weight[1] + weight[2];
    if (!(sum > 0)) return {1, 0, 0};
    for (S& x : weight) x /= sum;
  }
  return weight;
}

}  // namespace gjkdbg
