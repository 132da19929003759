// Voronoi regions: the closest point of a simplex to the origin by asking which vertex, edge or face region it lies in.
//
// Ericson, "Real-Time Collision Detection", 2005, sections 5.1.2, 5.1.5 and 5.1.6.
//
//        \        /                 A triangle in its plane: the region of a vertex is where both edges at it lead away;
//         \  A   /                  of an edge, where the origin projects on it and lies on its outer side;
//       AC \    / AB                of the face, what is left. The signs va, vb, vc are areas with the
//           \  /                    projected origin, as in signed volumes.
//      ------\/------
//        C   face   B
//
// A tetrahedron: the faces that have the origin on their outer side are tried, the nearest point wins; none: enclosed.
// Guard: a tetrahedron so flat that the side of its own fourth vertex is uncertain tries all four faces.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "algo/enclosing_simplex.h"

namespace gjkdbg {

template <int D, class S>
struct VoronoiRegions {
  using V = Vector<D, S>;
  using Feature = ClosestFeature<D, S>;
  using Grown = void;

  /// `w`: `size` vertices, 1 <= size <= D + 1.
  static Feature closest(const V* w, int size) {
    if (size == 1) return part(w, {0}, {1}, 1);
    if (size == 2) {
      if constexpr (D == 1) {
        if ((w[0][0] < 0) != (w[1][0] < 0) && w[0][0] != 0 && w[1][0] != 0) return EnclosingSimplex<D, S>::feature(w, {std::abs(w[1][0]), std::abs(w[0][0])});
      }
      return segment(w, 0, 1);
    }
    if constexpr (D >= 2)
      if (size == 3) return triangle(w, 0, 1, 2);
    if constexpr (D == 3) return tetrahedron(w);
    return {};
  }

 private:
  static Feature part(const V* w, const std::array<int, 3>& index, const std::array<S, 3>& weight, int count) {
    Feature f;
    f.count = count;
    for (int i = 0; i < count; ++i) f.index[i] = index[i], f.weight[i] = weight[i], f.v += weight[i] * w[index[i]];
    f.v_squared = f.v.dot(f.v);
    return f;
  }

  static Feature segment(const V* w, int a, int b) {
    const V ab = w[b] - w[a];
    const S t = -w[a].dot(ab), length = ab.dot(ab);
    if (!(t > 0)) return part(w, {a}, {1}, 1);
    if (!(t < length)) return part(w, {b}, {1}, 1);
    return part(w, {a, b}, {1 - t / length, t / length}, 2);
  }

  static Feature triangle(const V* w, int a, int b, int c) {
    const V ab = w[b] - w[a], ac = w[c] - w[a];
    const S d1 = -ab.dot(w[a]), d2 = -ac.dot(w[a]);
    if (d1 <= 0 && d2 <= 0) return part(w, {a}, {1}, 1);
    const S d3 = -ab.dot(w[b]), d4 = -ac.dot(w[b]);
    if (d3 >= 0 && d4 <= d3) return part(w, {b}, {1}, 1);
    const S vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 - d3 > 0) return part(w, {a, b}, {1 - d1 / (d1 - d3), d1 / (d1 - d3)}, 2);
    const S d5 = -ab.dot(w[c]), d6 = -ac.dot(w[c]);
    if (d6 >= 0 && d5 <= d6) return part(w, {c}, {1}, 1);
    const S vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 - d6 > 0) return part(w, {a, c}, {1 - d2 / (d2 - d6), d2 / (d2 - d6)}, 2);
    const S va = d3 * d6 - d5 * d4, along = (d4 - d3) + (d5 - d6);
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0 && along > 0) return part(w, {b, c}, {1 - (d4 - d3) / along, (d4 - d3) / along}, 2);
    const S sum = va + vb + vc;
    if (!(sum > 0)) return nearest_edge(w, a, b, c);  // no area
    if constexpr (D == 2) return EnclosingSimplex<D, S>::feature(w, {va, vb, vc});
    return part(w, {a, b, c}, {va / sum, vb / sum, vc / sum}, 3);
  }

  static Feature nearest_edge(const V* w, int a, int b, int c) {
    Feature best = segment(w, a, b);
    for (const Feature& other : {segment(w, b, c), segment(w, c, a)})
      if (other.v_squared < best.v_squared) best = other;
    return best;
  }

  /// Whether the origin and vertex d lie on different sides of the plane a b c; when d's side is uncertain, yes.
  static bool outside(const V* w, int a, int b, int c, int d) {
    if constexpr (D == 3) {
      const V n = (w[b] - w[a]).cross(w[c] - w[a]);
      const S origin = -n.dot(w[a]), fourth = n.dot(w[d] - w[a]);
      const S uncertain = 16 * std::numeric_limits<S>::epsilon() * n.norm() * (w[d] - w[a]).norm();
      return std::abs(fourth) <= uncertain || origin * fourth <= 0;
    }
    return true;
  }

  static Feature tetrahedron(const V* w) {
    static constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    Feature best;
    for (const auto& [a, b, c, d] : faces) {
      if (!outside(w, a, b, c, d)) continue;
      const Feature candidate = triangle(w, a, b, c);
      if (best.count == 0 || candidate.v_squared < best.v_squared) best = candidate;
    }
    if (best.count > 0) return best;
    const auto volume = [&](int i, int j, int k) { return std::abs(w[i].dot(w[j].cross(w[k]))); };
    return EnclosingSimplex<D, S>::feature(w, {volume(1, 2, 3), volume(0, 2, 3), volume(0, 1, 3), volume(0, 1, 2)});
  }
};

}  // namespace gjkdbg
