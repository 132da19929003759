// Signed volumes: the closest point of a simplex to the origin by the signs of its sub-volumes.
//
// Montanari, Petrinic, Barbieri, "Improving the GJK algorithm for faster and more reliable distance queries between
// convex objects", ACM TOG 36(3), 2017. The weight of a vertex is the volume (area, length) of the simplex with
// that vertex replaced by the origin, over the whole: a weight with the wrong sign means that the origin lies beyond
// the face opposite to it, and the search goes on in that face.
//
//   2D, triangle A B C:           the sign of each weight says on which side of the
//        \ beyond AC  /           opposite edge the origin lies, B's for one beyond AC.
//         \          /            One wrong sign: go to that edge. Two: the nearer of
//      ----A--------C----         two edges decides, and the segment case finds the
//           \      /              vertex if it must.
//    beyond  \ in /  beyond
//      AB     \  /     BC
//              B
//
// Deviations: signs that rounding could flip are taken in twice the precision; a triangle too thin for plain
// arithmetic goes to WideClosestPoint; the point on a face is the projection n (n . w) / n . n, which keeps its
// direction however near the origin is, instead of the weighted sum, which does not.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "algo/closest_point_wide.h"
#include "algo/enclosing_simplex.h"
#include "algo/grown_simplex.h"
#include "algo/orientation.h"
#include "algo/simplex.h"
#include "algo/voronoi.h"

namespace gjkdbg {

template <int D, class S>
struct SignedVolumes {
  using V = Vector<D, S>;
  using Feature = ClosestFeature<D, S>;
  using Grown = std::conditional_t<D == 3, GrownSimplex<S>, void>;  ///< of a simplex that has just grown by a vertex

  /// `size` vertices, 1 <= size <= D + 1.
  static Feature closest(const V* w, int size) {
    Feature f;
    if (size == 1) vertex(w, 0, f);
    else if (size == D + 1) full(w, f);
    else if (size == 2) segment(w, 0, 1, f);
    else if constexpr (D == 3) triangle(w, 0, 1, 2, f);
    return f;
  }

 private:
  // Each of these takes what it finds to `best` where that has nothing yet or nothing as near.

  static bool nearer(S v_squared, const Feature& best) { return best.count == 0 || v_squared < best.v_squared; }

  static void vertex(const V* w, int i, Feature& best) {
    const S v_squared = w[i].dot(w[i]);
    if (!nearer(v_squared, best)) return;
    best.count = 1, best.index[0] = i, best.weight[0] = 1;
    best.v = w[i], best.v_squared = v_squared;
  }

  /// e = w_j - w_i; the origin projects to w_i + t e with t = -w_i . e / e . e. The point is measured from the nearer end,
  /// and what rounding left along e is taken off once more, so that v stays perpendicular to the edge.
  static void segment(const V* w, int i, int j, Feature& best) {
    const V e = w[j] - w[i];
    const S along_i = -w[i].dot(e), along_j = w[j].dot(e), length = e.dot(e);
    if (!(along_i > 0) || !(length > 0)) return vertex(w, i, best);
    if (!(along_j > 0)) return vertex(w, j, best);
    const bool nearer_i = along_i < along_j;
    const S t = (nearer_i ? along_i : along_j) / length;
    V v = nearer_i ? V(w[i] + t * e) : V(w[j] - t * e);
    v -= e * (v.dot(e) / length);
    const S v_squared = v.dot(v);
    if (!nearer(v_squared, best)) return;
    best.count = 2, best.index[0] = i, best.index[1] = j;
    best.weight[0] = nearer_i ? 1 - t : t, best.weight[1] = nearer_i ? t : 1 - t;
    best.v = v, best.v_squared = v_squared;
  }

  /// A triangle in space. n = (w_j - w_i) x (w_k - w_i); the weight of w_i has the sign of n . (w_j x w_k): twice
  /// the area of edge jk with the projected origin, times |n|. The products are taken with edges, which are short.
  static void triangle(const V* w, int i, int j, int k, Feature& best) {
    const V ij = w[j] - w[i], jk = w[k] - w[j], ki = w[i] - w[k];
    const V n = ij.cross(jk);
    const S area = n.dot(n);
    constexpr S thin = S(1e-6);  // sine squared of the angle below which the normal is worth less than 1e-13 in double
    if (!(area > thin * ij.dot(ij) * jk.dot(jk)) || !(area > thin * jk.dot(jk) * ki.dot(ki))) return thin_triangle(w, {i, j, k}, best);
    const S weight_i = n.dot(w[j].cross(jk)), weight_j = n.dot(w[k].cross(ki)), weight_k = n.dot(w[i].cross(ij));
    const bool beyond_i = !(weight_i > 0), beyond_j = !(weight_j > 0), beyond_k = !(weight_k > 0);
    if (!(beyond_i | beyond_j | beyond_k)) {
      const V v = n * (n.dot(nearest_of(w, i, j, k)) / area);
      const S v_squared = v.dot(v);
      if (!nearer(v_squared, best)) return;
      const S sum = weight_i + weight_j + weight_k;
      best.count = 3, best.index[0] = i, best.index[1] = j, best.index[2] = k;
      best.weight[0] = weight_i / sum, best.weight[1] = weight_j / sum, best.weight[2] = weight_k / sum;
      best.v = v, best.v_squared = v_squared;
      return;
    }
    if (beyond_i) segment(w, j, k, best);
    if (beyond_j) segment(w, k, i, best);
    if (beyond_k) segment(w, i, j, best);
  }

  static const V& nearest_of(const V* w, int i, int j, int k) {
    const S di = w[i].dot(w[i]), dj = w[j].dot(w[j]), dk = w[k].dot(w[k]);
    return di <= dj ? (di <= dk ? w[i] : w[k]) : (dj <= dk ? w[j] : w[k]);
  }

  /// Ericson's regions, which need no normal and no volume, where they prove themselves: v is the closest point iff no vertex lies nearer along it,
  /// v.w_i >= |v|^2 for all i, and by how much that fails bounds the error of |v| (times |v|). False where it fails by more than v rounds.
  static bool self_evident(const V* w, int size, Feature& f) {
    f = VoronoiRegions<D, S>::closest(w, size);
    if (f.enclosed) return false;
    S least = f.v_squared, far = 0;
    for (int i = 0; i < size; ++i) least = std::min(least, f.v.dot(w[i])), far = std::max(far, w[i].dot(w[i]));
    const S gap = f.v_squared - least;
    constexpr S rounding = 16 * std::numeric_limits<S>::epsilon();
    return gap * gap <= rounding * rounding * f.v_squared * far;
  }

  /// A triangle whose normal is worth little: in twice the precision where nothing simpler will do.
  static void thin_triangle(const V* w, const std::array<int, 3>& index, Feature& best) {
    const std::array<V, 3> vertices{w[index[0]], w[index[1]], w[index[2]]};
    Feature f;
    if (!self_evident(vertices.data(), 3, f)) f = WideClosestPoint<D, S>::of_boundary(vertices.data(), 3);
    if (!nearer(f.v_squared, best)) return;
    for (int i = 0; i < f.count; ++i) f.index[i] = index[f.index[i]];
    best = f;
  }

  static void full(const V* w, Feature& best) {
    if constexpr (D == 1) interval(w, best);
    if constexpr (D == 2) flat_triangle(w, best);
    if constexpr (D == 3) tetrahedron(w, best);
  }

  static void interval(const V* w, Feature& best) {
    const S low = w[0][0], high = w[1][0];
    if ((low < 0 && high > 0) || (low > 0 && high < 0)) best = EnclosingSimplex<D, S>::feature(w, {std::abs(high), std::abs(low)});
    else vertex(w, std::abs(low) <= std::abs(high) ? 0 : 1, best);
  }

  /// Sign of a value known to `error`; when rounding could flip it, `exactly()` decides.
  template <class Exactly>
  static int sure_sign(S value, S error, Exactly exactly) {
    return std::abs(value) > error ? (value > 0) - (value < 0) : exactly();
  }

  static void flat_triangle(const V* w, Feature& best) {
    const auto area = [&](int i, int j) { return w[i][0] * w[j][1] - w[i][1] * w[j][0]; };
    const S value[3] = {area(1, 2), area(2, 0), area(0, 1)};
    S m = 0;
    for (int i = 0; i < 3; ++i) m = std::max(m, w[i].cwiseAbs().maxCoeff());
    const S error = 4 * std::numeric_limits<S>::epsilon() * m * m;
    const V origin = V::Zero();
    const int whole = orientation<S>(w[0], w[1], w[2]);
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const int side = sure_sign(value[i], error, [&] { return orientation<S>(w[j], w[k], origin); });
      if (side == whole && whole != 0) continue;
      inside = false;
      segment(w, j, k, best);
    }
    if (inside) best = EnclosingSimplex<D, S>::feature(w, {std::abs(value[0]), std::abs(value[1]), std::abs(value[2])});
  }

  /// In three numbers, which stay in registers where a vector would go through memory.
  struct CrossProduct {
    S x, y, z;
    CrossProduct(const V& a, const V& b) : x(a[1] * b[2] - a[2] * b[1]), y(a[2] * b[0] - a[0] * b[2]), z(a[0] * b[1] - a[1] * b[0]) {}
    S dot(const V& v) const { return x * v[0] + y * v[1] + z * v[2]; }
  };

  /// Volume of the tetrahedron with vertex i replaced by the origin, for all i: two cross products serve all four.
  /// A point inside a face that the origin lies beyond is the nearest of all: no other face need be asked.
  static void tetrahedron(const V* w, Feature& best) {
    const CrossProduct w01(w[0], w[1]), w23(w[2], w[3]);
    const S value[4] = {w23.dot(w[1]), -w23.dot(w[0]), w01.dot(w[3]), -w01.dot(w[2])};
    S m = 0;
    for (int i = 0; i < 4; ++i) m = std::max(m, w[i].cwiseAbs().maxCoeff());
    const S error = determinant_error(m), sum = value[0] + value[1] + value[2] + value[3];
    const int whole = sure_sign(sum, 5 * error, [&] { return orientation<S>(w[0], w[1], w[2], w[3]); });
    int beyond = 0;
    std::array<int, 4> faces;
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4, k = (i + 2) % 4, l = (i + 3) % 4;
      // det(j, k, l) in this order has the sign of value[i] for even i and the opposite one for odd i.
      const int side = sure_sign(value[i], error, [&] {
        const int turned = determinant_sign_wide<S>(WideVector<S>(w[j]), WideVector<S>(w[k]), WideVector<S>(w[l]));
        return i % 2 == 0 ? turned : -turned;
      });
      faces[beyond] = i, beyond += (side != whole) | (whole == 0);
    }
    if (beyond == 0) best = EnclosingSimplex<D, S>::feature(w, {std::abs(value[0]), std::abs(value[1]), std::abs(value[2]), std::abs(value[3])});
    for (int k = 0; k < beyond && best.count < 3; ++k) triangle(w, (faces[k] + 1) % 4, (faces[k] + 2) % 4, (faces[k] + 3) % 4, best);
  }
};

/// The origin's weights in a simplex around it.
template <int D, class S>
void weigh_enclosing(Simplex<D, S>& simplex) {
  std::array<Vector<D, S>, D + 1> w;
  for (int i = 0; i <= D; ++i) w[i] = simplex.points[i].w;
  simplex.weights.fill(0);
  const auto feature = SignedVolumes<D, S>::closest(w.data(), D + 1);
  for (int i = 0; i < feature.count; ++i) simplex.weights[feature.index[i]] = feature.weight[i];
}

}  // namespace gjkdbg
