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
// number of which waits for the one before. Where a processor can, a triangle's features and a solid's faces are looked at side by side (algo/grown_lanes.h).
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
    T v{0, 0, 0};
    S v_squared = 0;
    unsigned places = 0;  ///< of the feature's vertices; 0: not told

    bool encloses() const { return places == 0b1111; }  ///< the origin is inside, and v zero
  };

  /// Hands the nearest to `take`, from wherever it is found: a number that several ways lead to goes through memory. The old vertices' places, at most three, and the newest one's, whose
  /// w is a. `lanes`: for `weigh`.
  template <class Take>
  [[gnu::always_inline]] static bool find(const Points& points, unsigned old, int newest, const T a, ToldInLanes<S>& lanes, const Take& take) {
    forget(lanes);
    if (old == 0) return take(told(a, 1u << newest));
    const Old places(old);
    if (places.count == 1) return take(along(Edge(points, a, newest, places.i)));
#ifdef GJKDBG_AVX2
    if constexpr (sizeof(S) == 8)
      if (__builtin_cpu_supports("avx2")) {
        if (const Nearest found = in_lanes(points, places, newest, lanes); found.places != 0) [[likely]] return take(found);
        return take(one_by_one(points, old, newest));
      }
#endif
    return take(of_features(points, places, newest, a));
  }
  /// The same without lanes, of two old vertices at least.
  [[gnu::noinline]] static Nearest one_by_one(const Points& points, unsigned old, int newest) { return of_features(points, Old(old), newest, T::of(points[newest].w)); }

  /// What was told in lanes is not the feature whose weights will be wanted.
  [[gnu::always_inline]] static void forget([[maybe_unused]] ToldInLanes<S>& lanes) {
#ifdef GJKDBG_AVX2
    if constexpr (sizeof(S) == 8) lanes.lane = -1;
#endif
  }

  /// The weights of such a feature, by place: v = sum weight_i w_i. Those of other places mean nothing.
  [[gnu::always_inline]] static void weigh(const Points& points, unsigned places, int newest, const ToldInLanes<S>& lanes, std::array<S, 4>& weights) {
#ifdef GJKDBG_AVX2
    if constexpr (sizeof(S) == 8)
      if (const int lane = lanes.lane; lane >= 0) {
        const S whole = lanes.features.whole[lane], first = lanes.features.first[lane], second = lanes.features.second[lane];
        weights[lanes.first] = first / whole, weights[lanes.second] = second / whole;
        weights[newest] = count_of(places) == 3 ? (whole - (first + second)) / whole : 1 - weights[(places >> lanes.first & 1) != 0 ? lanes.first : lanes.second];
        return;
      }
#endif
    weigh_anew(points, places, newest, weights);
  }
  [[gnu::noinline]] static void weigh_anew(const Points& points, unsigned places, int newest, std::array<S, 4>& weights) {
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
  /// The places of the old vertices; of two of them k is j.
  struct Old {
    int i, j, k, count;

    [[gnu::always_inline]] explicit Old(unsigned places) {
      i = std::countr_zero(places), places &= places - 1, count = 1 + (places != 0);
      j = places != 0 ? std::countr_zero(places) : i, places &= places - 1;
      k = places != 0 ? std::countr_zero(places) : j, count += places != 0;
    }
  };

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

  [[gnu::always_inline]] static Nearest of_features(const Points& points, const Old& old, int newest, const T& a) {
    const Edge i(points, a, newest, old.i), j(points, a, newest, old.j);
    if (old.count == 2) return across(i, j, i.e.cross(j.e));
    return around(i, j, Edge(points, a, newest, old.k));
  }

#ifdef GJKDBG_AVX2
  /// The nearest of a triangle or of a solid's faces, where it is told at once.
  [[gnu::always_inline]] static Nearest in_lanes(const Points& points, const Old& old, int newest, ToldInLanes<S>& told) {
    const auto [i, j, k, count] = old;
    FeatureLanes& features = told.features;
    int lane, left_out;
    if (count == 2) {
      lane = nearest_of_triangle_by_avx2(points.data(), newest, i, j, features);
      left_out = lane == 1 ? j : i, told.first = i, told.second = j;
    } else {
      lane = nearest_face_by_avx2(points.data(), newest, i, j, k, features);
      left_out = lane == 0 ? k : lane == 1 ? i : j, told.first = lane == 0 ? i : lane == 1 ? j : k, told.second = lane == 0 ? j : lane == 1 ? k : i;
    }
    if (lane < 0) [[unlikely]] return {};
    told.lane = lane;
    const unsigned all = 1u << newest | 1u << i | 1u << j | 1u << k;
    return {{features.x[lane], features.y[lane], features.z[lane]}, features.squared[lane], count == 2 && lane == 0 ? all : all & ~(1u << left_out)};
  }
#endif

  [[gnu::always_inline]] static Nearest along(const Edge& i) {
    if (!(i.towards > 0)) return told(i.a, i.from());
    if (!(i.towards < i.length)) [[unlikely]] return {};
    return told(i.e.cross(i.c) * (1 / i.length), i.from() | i.to());
  }

  [[gnu::always_inline]] static bool thin(const Edge& i, const Edge& j, const T& n) {
    const T third = j.e - i.e;
    const S longer = i.length < j.length ? j.length : i.length, shorter = i.length < j.length ? i.length : j.length, across = third.dot(third);
    return !(n.dot(n) > thin_squared<S> * longer * (shorter < across ? across : shorter));
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
      const T off = i.a + i.e * (-n.dot(j.c) / n.dot(n)) + j.e * (n.dot(i.c) / n.dot(n)) - found.v;
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
      if (std::abs(left) > 5 * error && (left > 0) == out) return {{0, 0, 0}, 0, 0b1111};
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
    if (by_ki && ends_with(across(k, i, ki))) return best;
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
    for (const T& w : vertices) least = std::min(least, found.v.dot(w)), far = std::max(far, w.dot(w));
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
