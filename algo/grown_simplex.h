// The closest point to the origin of a simplex in space that has grown by a vertex, where plain arithmetic tells.
//
// The old vertices are the feature nearest the origin, with v across it, and the newest vertex a lies nearer along v: so a is a vertex of the new feature, and only
// features at a are looked at (van den Bergen 1999, section 3). With e_i = w_i - a from it to an old vertex, c_i = a x e_i, and n = e_i x e_j across a face
// (regions: Ericson, "Real-Time Collision Detection", 2005, 5.1):
//
//   edge      the origin projects to a + t e with t = -a . e / e . e; v = e x c / e . e is perpendicular to e, however near the origin is
//   face      v = n (n . a) / n . n; with n . n the weights of w_i and w_j are -n . c_j and n . c_i, and a's is what is left: where one of them
//             is not positive the origin lies beyond the other's edge
//   solid     with e_k to the third old vertex and V = n . e_k the weight of w_k is -n . a / V: where it is negative the origin lies beyond the face; where none is,
//             and something is left for a, inside
//
// All vectors but a are short, every product serves several of these, and everything stays in registers: next to the support this is the longest part of an iteration, each
// number of which waits for the one before.
//
// Where plain arithmetic may not know a sign, or a triangle is thin, what seems nearest is taken if it proves itself: v is the closest point iff no vertex lies nearer along
// it, v . w_i >= |v|^2 for all i. Where that fails by more than v rounds nothing is told, and the caller asks algo/signed_volumes.h.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "algo/closest_point_wide.h"
#include "algo/enclosing_simplex.h"
#include "algo/grown_lanes.h"
#include "algo/orientation.h"
#include "algo/simplex.h"
#include "shapes/triple.h"

namespace gjkdbg {

template <class S>
class GrownSimplex {
  using T = Triple<S>;
  using Points = std::array<SupportPoint<3, S>, 4>;

 public:
  struct Nearest {
    S x = 0, y = 0, z = 0, v_squared = 0;
    unsigned places = 0;  ///< of the feature's vertices; 0: not told
    Nearest() = default;
    [[gnu::always_inline]] Nearest(const T& v, S squared, unsigned of) : x(v.x), y(v.y), z(v.z), v_squared(squared), places(of) {}
    [[gnu::always_inline]] Nearest(const Nearest& n) : x(n.x), y(n.y), z(n.z), v_squared(n.v_squared), places(n.places) {}
    [[gnu::always_inline]] Nearest& operator=(const Nearest& n) { x = n.x, y = n.y, z = n.z, v_squared = n.v_squared, places = n.places; return *this; }
    [[gnu::always_inline]] T v() const { return {x, y, z}; }

    bool encloses() const { return places == 0b1111; }  ///< the origin is inside, and v zero
  };

  /// The old vertices' places, at most three, and the newest one's, whose w is a.
  [[gnu::always_inline]] static Nearest closest(const Points& points, unsigned old, int newest, const T a) {
    if (old == 0) return told(a, 1u << newest);
    const int i = std::countr_zero(old);
    if (!(old &= old - 1)) return along(Edge(points, a, newest, i));
    const int j = std::countr_zero(old), k = (old &= old - 1) != 0 ? std::countr_zero(old) : j;
#ifdef GJKDBG_AVX2
    if constexpr (sizeof(S) == 8)
      if (__builtin_cpu_supports("avx2")) {
        const Nearest found = in_lanes(points, newest, i, j, k);
        if (found.places != 0) [[likely]] return found;
        return one_by_one(points, newest, i, j, k);
      }
#endif
    return features(points, newest, i, j, k, a);
  }

  /// The weights of such a feature, by place: v = sum weight_i w_i. Those of no vertex of it stay.
  [[gnu::noinline]] static void weigh(const Points& points, unsigned places, int newest, std::array<S, 4>& weights) {
    const T a = T::of(points[newest].w);
    weights[newest] = 1;
    unsigned old = places & ~(1u << newest);
    if (old == 0) return;
    const Edge i(points, a, newest, std::countr_zero(old));
    if (!(old &= old - 1)) {
      weights[i.place] = i.towards / i.length, weights[newest] = 1 - weights[i.place];
      return;
    }
    const Edge j(points, a, newest, std::countr_zero(old));
    const T n = i.e.cross(j.e);
    if (old &= old - 1) return weigh_solid(points, i, j, Edge(points, a, newest, std::countr_zero(old)), weights);
    if (thin(i, j, n)) return weigh_wide(points, {newest, i.place, j.place}, weights);
    const S area = n.dot(n), of_i = -n.dot(j.c), of_j = n.dot(i.c);
    weights[i.place] = of_i / area, weights[j.place] = of_j / area, weights[newest] = (area - (of_i + of_j)) / area;
  }

 private:
  /// From the newest vertex.
  struct Edge {
    const T& a;
    T e, c;
    S length, towards;  ///< e . e, -a . e
    int newest, place;

    [[gnu::always_inline]] Edge(const Points& points, const T& from, int of, int to)
        : a(from), e(T::of(points[to].w) - a), c(a.cross(e)), length(e.dot(e)), towards(-a.dot(e)), newest(of), place(to) {}
    unsigned from() const { return 1u << newest; }
    unsigned to() const { return 1u << place; }
    T end() const { return a + e; }
  };

  [[gnu::always_inline]] static Nearest told(const T& v, unsigned places) { return {v, v.dot(v), places}; }

  [[gnu::always_inline]] static Nearest features(const Points& points, int newest, int i, int j, int k, const T& a) {
    const Edge to_i(points, a, newest, i), to_j(points, a, newest, j);
    if (k == j) return across(to_i, to_j, to_i.e.cross(to_j.e));
    return around(to_i, to_j, Edge(points, a, newest, k));
  }
  [[gnu::noinline]] static Nearest one_by_one(const Points& points, int newest, int i, int j, int k) { return features(points, newest, i, j, k, T::of(points[newest].w)); }

#ifdef GJKDBG_AVX2
  /// The nearest of a triangle (k is j) or of a solid's faces, where it is told at once.
  [[gnu::always_inline]] static Nearest in_lanes(const Points& points, int newest, int i, int j, int k) {
    FeatureLanes features;
    const int lane = k == j ? nearest_of_triangle_by_avx2(points.data(), newest, i, j, features) : nearest_face_by_avx2(points.data(), newest, i, j, k, features);
    if (lane < 0) [[unlikely]] return {};
    const unsigned all = 1u << newest | 1u << i | 1u << j | 1u << k;
    const int left_out = k == j ? (lane == 0 ? -1 : lane == 1 ? j : i) : (lane == 0 ? k : lane == 1 ? i : j);
    return {T{features.x[lane], features.y[lane], features.z[lane]}, features.squared[lane], left_out < 0 ? all : all & ~(1u << left_out)};
  }
#endif

  [[gnu::always_inline]] static Nearest along(const Edge& i) {
    if (!(i.towards > 0)) return told(i.a, i.from());
    if (!(i.towards < i.length)) [[unlikely]] return {};
    return told(i.e.cross(i.c) * (1 / i.length), i.from() | i.to());
  }

  /// 1e-6: the square of the sine of the angle below which n is worth less than 1e-13 in double.
  [[gnu::always_inline]] static bool thin(const Edge& i, const Edge& j, const T& n) {
    const T third = j.e - i.e;
    const S longer = i.length < j.length ? j.length : i.length, shorter = i.length < j.length ? i.length : j.length, across = third.dot(third);
    return !(n.dot(n) > S(1e-6) * longer * (shorter < across ? across : shorter));
  }

  [[gnu::always_inline]] static Nearest across(const Edge& i, const Edge& j, const T& n) {
    if (thin(i, j, n)) [[unlikely]] return across_thin(i, j, n);
    return in_triangle(i, j, n);
  }
  [[gnu::always_inline]] static Nearest in_triangle(const Edge& i, const Edge& j, const T& n) {
    const S area = n.dot(n), of_i = -n.dot(j.c), of_j = n.dot(i.c);
    if (of_i > 0 && of_j > 0) {
      if (!(of_i + of_j < area)) [[unlikely]] return {};
      return told(n * (n.dot(i.a) / area), i.from() | i.to() | j.to());
    }
    if (of_i > 0) return along(i);
    if (of_j > 0) return along(j);
    const Nearest at_i = along(i), at_j = along(j);
    if (at_i.places == 0 || at_j.places == 0) [[unlikely]] return {};
    return at_j.v_squared < at_i.v_squared ? at_j : at_i;
  }
  /// The weights are worth less than n: v must be where they say, too, or it is no point of the triangle.
  [[gnu::noinline]] static Nearest across_thin(const Edge& i, const Edge& j, const T& n) {
    const Nearest found = in_triangle(i, j, n);
    if (count_of(found.places) == 3) {
      const T off = i.a + i.e * (-n.dot(j.c) / n.dot(n)) + j.e * (n.dot(i.c) / n.dot(n)) - found.v();
      constexpr S rounding = 16 * std::numeric_limits<S>::epsilon();
      if (!(off.dot(off) <= rounding * rounding * i.a.dot(i.a))) return {};
    }
    return proven(found, {i.a, i.end(), j.end()});
  }

  [[gnu::always_inline]] static Nearest around(const Edge& i, const Edge& j, const Edge& k) {
    const T ij = i.e.cross(j.e), jk = j.e.cross(k.e), ki = k.e.cross(i.e), &a = i.a;
    const S beyond_ij = ij.dot(a), beyond_jk = jk.dot(a), beyond_ki = ki.dot(a), volume = ij.dot(k.e);
    // An edge rounds by half an ulp of its own, which the determinant's error has room for twice over.
    const S error = 2 * determinant_error(std::max({a.most(), i.e.most(), j.e.most(), k.e.most()}));
    if (!(std::min({std::abs(beyond_ij), std::abs(beyond_jk), std::abs(beyond_ki), std::abs(volume)}) > error)) [[unlikely]] return around_flat(i, j, k);
    const bool out = volume > 0;
    const bool by_ij = (beyond_ij > 0) == out, by_jk = (beyond_jk > 0) == out, by_ki = (beyond_ki > 0) == out;
    if (!(by_ij | by_jk | by_ki)) {
      const S left = beyond_ij + beyond_jk + beyond_ki + volume;
      if (std::abs(left) > 5 * error && (left > 0) == out) return {T{0, 0, 0}, 0, 0b1111};
      return {};
    }
    Nearest best;
    bool known = true;
    const auto ends_with = [&](const Nearest& found) __attribute__((always_inline)) {
      const bool inside = count_of(found.places) == 3;  // a face that the origin lies beyond: no other feature is nearer
      known &= found.places != 0;
      if (inside || best.places == 0 || found.v_squared < best.v_squared) best = found;
      return inside;
    };
    if (by_ij && ends_with(across(i, j, ij))) return best;
    if (by_jk && ends_with(across(j, k, jk))) return best;
    if (by_ki) ends_with(across(k, i, ki));
    return known ? best : Nearest{};
  }
  [[gnu::noinline]] static Nearest around_flat(const Edge& i, const Edge& j, const Edge& k) {
    Nearest best;
    for (const auto& [x, y] : {std::pair(&i, &j), std::pair(&j, &k), std::pair(&k, &i)}) {
      const Nearest found = across(*x, *y, x->e.cross(y->e));
      if (found.places != 0 && (best.places == 0 || found.v_squared < best.v_squared)) best = found;
    }
    return proven(best, {i.a, i.end(), j.end(), k.end()});
  }

  /// By how much the proof fails bounds the error of |v| (times |v|). The product rounds by the vertices' size.
  [[gnu::always_inline]] static Nearest proven(const Nearest& found, std::initializer_list<T> vertices) {
    S least = found.v_squared, far = 0;
    for (const T& w : vertices) least = std::min(least, found.v().dot(w)), far = std::max(far, w.dot(w));
    const S gap = found.v_squared - least;
    constexpr S rounding = 16 * std::numeric_limits<S>::epsilon();
    return gap * gap <= rounding * rounding * found.v_squared * far ? found : Nearest{};
  }

  static void weigh_solid(const Points& points, const Edge& i, const Edge& j, const Edge& k, std::array<S, 4>& weights) {
    std::array<S, 4> sizes;
    sizes[i.place] = j.e.cross(k.e).dot(i.a), sizes[j.place] = k.e.cross(i.e).dot(i.a), sizes[k.place] = i.e.cross(j.e).dot(i.a);
    sizes[i.newest] = -(sizes[i.place] + sizes[j.place] + sizes[k.place] + i.e.cross(j.e).dot(k.e));
    std::array<Vector<3, S>, 4> w;
    for (std::size_t l = 0; l < 4; ++l) w[l] = points[l].w, sizes[l] = std::abs(sizes[l]);
    weights = EnclosingSimplex<3, S>::feature(w.data(), sizes).weight;
  }

  static void weigh_wide(const Points& points, const std::array<int, 3>& places, std::array<S, 4>& weights) {
    std::array<Vector<3, S>, 3> w;
    for (std::size_t i = 0; i < 3; ++i) w[i] = points[places[i]].w, weights[places[i]] = 0;
    const auto feature = WideClosestPoint<3, S>::of_boundary(w.data(), 3);
    for (int i = 0; i < feature.count; ++i) weights[places[feature.index[i]]] = feature.weight[i];
  }
};

}  // namespace gjkdbg
