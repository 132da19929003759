// The difference of two boxes in space: the separation along its 15 axes, and from the same numbers the nearest points.
//
// With half sizes a, b and the turn R of B, the columns R_j, the difference A - B is, about its centre, the sum of six segments (a zonotope; McMullen, "On
// zonotopes", Trans. AMS 159, 1971)
//
//   [-1, 1] a_i e_i + [-1, 1] b_j R_j,    i, j = 0, 1, 2
//
// and p, from A's centre to B's, is as far from it as the bodies are apart. Every two of the segments span a facet, at each end of the other four, so 15 pairs of
// facets; of each pair the one towards p counts, that of the sign s of n . p. With q = R^T p (p in B's axes), i k l and j m n cyclic:
//
//   a face of A, n = e_i, spans e_k and e_l and has B's corner -s sum_j sgn(R_ij) b_j R_j to it:
//     separation     |p_i| - a_i - sum_j b_j |R_ij|
//     place of p     p_k - s sum_j sgn(R_ij) b_j R_kj along e_k, of a_k to both sides, the same along e_l
//   a face of B, n = R_j: the same with R^T, q, and a and b exchanged
//   two edges, n = e_i x R_j / L, L^2 = R_kj^2 + R_lj^2: with x, y = R_kj, R_lj it is (0, -y, x) / L along e_i, e_k, e_l, and n . R_m = R_in / L, n . R_n = -R_im / L
//     separation     (|p_l x - p_k y| - a_k |y| - a_l |x| - b_m |R_in| - b_n |R_im|) / L
//     place of p     u = p_i - s (sgn(R_in) b_m R_im - sgn(R_im) b_n R_in) along e_i,  v = q_j - s (sgn(x) a_l y - sgn(y) a_k x) along R_j,
//                    and the nearest points S on A's edge, T on B's are those of two lines, S = (u - r v) / L^2, T = v - r S, r = R_ij, clamped (Ericson,
//                    "Real-Time Collision Detection", 2005, 5.1.9)
//
// How far p lies from a facet is the root of the squares of the separation and of what its place has beyond the facet's ends. The nearest point of the
// difference lies on a facet that faces p, so the least of these distances is the distance of the bodies; and the depth is the least overlap, as in algo/sat.h.
// A distance is proven by the plane across the points, or by the axis. The six faces' facets are looked at first: of 6 in 10 pairs half a side apart the nearest
// point is there, and the plane tells.
//
// Where an element of R is next to zero, features lie flat on one another: facets lie in one plane, and are parts of a larger one. As signs of such elements are
// noise they are taken for zeros with the signs of a small turn more, of one axis for all: then the parts cover the whole.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/nearest_points.h"
#include "algo/trace.h"
#include "shapes/triple.h"

namespace gjkdbg {

/// Two boxes in space. Nothing is an array read by a place that is not known beforehand, nothing goes through a call, and a sign is a factor: a number that is written
/// alone and read as half of two (an array's that is copied, and what gcc has put aside and reads for std::abs and std::copysign) is one a processor waits for, and
/// that took a third of the time.
template <class S>
class Boxes {
  using Triple = gjkdbg::Triple<S>;

 public:
  static constexpr int axes = 15;  ///< A's faces, B's faces, edges of both
  /// Of an element of R. 4 u of MinkowskiDifference::rounding_floor, which has room for them: a height of two boxes rounds 6 times, not 10.
  static constexpr S next_to_zero = 2 * std::numeric_limits<S>::epsilon();

  /// Half sizes, none of them zero; `turn(i, j)` an element of B's turn; p, from A's centre to B's, in A's axes.
  template <class Turn>
  [[gnu::always_inline]] Boxes(const Vector<3, S>& half_a, const Vector<3, S>& half_b, const Turn& turn, S x, S y, S z)
      : a_{half_a[0], half_a[1], half_a[2]}, b_{half_b[0], half_b[1], half_b[2]},
        r_{{turn(0, 0), turn(0, 1), turn(0, 2)}, {turn(1, 0), turn(1, 1), turn(1, 2)}, {turn(2, 0), turn(2, 1), turn(2, 2)}}, p_{x, y, z},
        q_{r_[0][0] * x + r_[1][0] * y + r_[2][0] * z, r_[0][1] * x + r_[1][1] * y + r_[2][1] * z, r_[0][2] * x + r_[1][2] * y + r_[2][2] * z} {
    set_signs<0>(), set_signs<1>(), set_signs<2>();
    if (flat_on_one_another()) [[unlikely]] settle<0>(), settle<1>(), settle<2>(), parallel_ = parallel<0>() + parallel<1>() + parallel<2>();
  }

  /// False for edges that are parallel: their axes are those of faces.
  template <int k>
  bool is_axis() const {
    if constexpr (k < faces) return true;
    else return Edges<(k - faces) / 3, (k - faces) % 3>(*this).cross();
  }
  /// How far apart the bodies are along an axis.
  template <int k>
  S separation() const {
    if constexpr (k < 3) return face<true, k>().separation;
    else if constexpr (k < faces) return face<false, k - 3>().separation;
    else return Edges<(k - faces) / 3, (k - faces) % 3>(*this).separation();
  }
  /// Unit, towards B.
  template <int k>
  Vector<3, S> normal() const {
    if constexpr (k < 3) return unsigned_zeros(face<true, k>().normal);
    else if constexpr (k < faces) return unsigned_zeros(rotated(face<false, k - 3>().normal));
    else return unsigned_zeros(Edges<(k - faces) / 3, (k - faces) % 3>(*this).normal());
  }
  static AxisSource source(int k) { return k < 3 ? AxisSource::face_a : k < faces ? AxisSource::face_b : AxisSource::edge_pair; }

  /// The nearest points or, where no axis has more than `floor` between, those of the least overlap.
  [[gnu::always_inline]] BoxPoints<3, S> points(S floor) const { return said(floor, [](const BoxPoints<3, S>& found) { return found; }); }
  /// What `say` makes of them. Asked at each ending by itself: where they come together all points go through memory, which costs a query a thirteenth.
  template <class Say>
  [[gnu::always_inline]] auto said(S floor, const Say& say) const {
    const Facet a0 = face<true, 0>(), a1 = face<true, 1>(), a2 = face<true, 2>(), b0 = face<false, 0>(), b1 = face<false, 1>(), b2 = face<false, 2>();
    S most = greater(greater(greater(a0.separation, a1.separation), a2.separation), greater(greater(b0.separation, b1.separation), b2.separation));
    if (most > floor) {
      Facet a = a0, b = b0;
      int nearest_a = 0, nearest_b = 3;
      if (a1.nearness() < a.nearness()) a = a1, nearest_a = 1;
      if (a2.nearness() < a.nearness()) a = a2, nearest_a = 2;
      if (b1.nearness() < b.nearness()) b = b1, nearest_b = 4;
      if (b2.nearness() < b.nearness()) b = b2, nearest_b = 5;
      const S nearness = lesser(a.nearness(), b.nearness());
      Triple beyond = a.off;
      if (b.nearness() < a.nearness()) beyond = b.off, a = from_b(b), nearest_a = nearest_b;
      BoxPoints<3, S> found = across_plane(a, nearness, most, floor);
      found.axes = faces;
      if (found.proven) return say(found);
      return say(nearest_beyond(ends_beyond(nearest_a, beyond, floor), most, floor));
    }
    int widest = 0;
    S separation = a0.separation;
    const auto widen = [&](const Facet& f, int place) {
      if (f.separation > separation) separation = f.separation, widest = place;
    };
    widen(a1, 1), widen(a2, 2), widen(b0, 3), widen(b1, 4), widen(b2, 5);
    return say(least_overlap(widest, floor));
  }

 private:
  static constexpr int faces = 6;
  static constexpr int next(int i) { return i == 2 ? 0 : i + 1; }
  static S sign(S x) { return std::copysign(S(1), x); }
  static S greater(S x, S y) { return x < y ? y : x; }
  static S lesser(S x, S y) { return y < x ? y : x; }
  static S clamped(S x, S half) { return lesser(greater(x, -half), half); }
  /// Zeros without a sign.
  [[gnu::always_inline]] static Vector<3, S> unsigned_zeros(const Triple& t) { return {t.x + 0, t.y + 0, t.z + 0}; }
  /// The element i, and the two that follow it.
  template <int i>
  [[gnu::always_inline]] static Triple cyclic(S at_i, S at_k, S at_l) { return i == 0 ? Triple{at_i, at_k, at_l} : i == 1 ? Triple{at_l, at_i, at_k} : Triple{at_k, at_l, at_i}; }

  /// One facet, in A's axes, of a face of B in B's.
  struct Facet {
    S separation;  ///< along the normal
    S beyond;      ///< the square of what p's place has beyond the facet's ends
    Triple on;     ///< of the points nearest to each other the body's whose face it is, A's of two edges; from the body's centre
    Triple off;    ///< from there to p's point, from A towards B
    Triple normal;

    [[gnu::always_inline]] S nearness() const { return separation * separation + beyond; }
  };

  template <bool of_a, int i>
  [[gnu::always_inline]] Facet face() const {
    constexpr int k = next(i), l = next(k);
    const auto &half = of_a ? a_ : b_, &other = of_a ? b_ : a_, &p = of_a ? p_ : q_;
    const auto r = [&](int row, int column) { return of_a ? r_[row][column] : r_[column][row]; };
    const auto signed_half = [&](int column) { return other[column] * (of_a ? sign_[i][column] : sign_[column][i]); };
    const S c0 = signed_half(0), c1 = signed_half(1), c2 = signed_half(2), side = sign(p[i]);
    const auto corner = [&](int row) { return c0 * r(row, 0) + c1 * r(row, 1) + c2 * r(row, 2); };
    const S separation = side * p[i] - (half[i] + corner(i)), at_k = p[k] - side * corner(k), at_l = p[l] - side * corner(l);
    const S on_k = clamped(at_k, half[k]), on_l = clamped(at_l, half[l]), off_k = at_k - on_k, off_l = at_l - on_l;
    return {separation, off_k * off_k + off_l * off_l, cyclic<i>(side * half[i], on_k, on_l), cyclic<i>(side * separation, off_k, off_l), cyclic<i>(side, 0, 0)};
  }

  /// Of a face of B `on` is minus B's point, seen from B's centre: the difference has -B.
  [[gnu::always_inline]] Facet from_b(const Facet& f) const { return {f.separation, f.beyond, Triple{p_[0], p_[1], p_[2]} - rotated(f.on + f.off), rotated(f.off), rotated(f.normal)}; }
  [[gnu::always_inline]] Triple rotated(const Triple& t) const { return {r_[0][0] * t.x + r_[0][1] * t.y + r_[0][2] * t.z, r_[1][0] * t.x + r_[1][1] * t.y + r_[1][2] * t.z, r_[2][0] * t.x + r_[2][1] * t.y + r_[2][2] * t.z}; }

  /// Edges along e_i and R_j. n . R_m and n . R_n are those of n itself: where L is small R_in and R_im are no longer.
  template <int i, int j>
  struct Edges {
    static constexpr int k = next(i), l = next(k), m = next(j), n = next(m);
    const Boxes& boxes;
    S r, x, y, squared, across, side, ak, al, bm, bn;
    S times_length;  ///< the separation times L, but for rounding of the boxes' size

    [[gnu::always_inline]] explicit Edges(const Boxes& of) : boxes(of) {
      const auto &a = of.a_, &b = of.b_, &p = of.p_;
      const auto &turn = of.r_, &signs = of.sign_;
      r = turn[i][j], x = turn[k][j], y = turn[l][j], squared = x * x + y * y;
      ak = a[k] * signs[l][j], al = a[l] * signs[k][j], bm = b[m] * signs[i][n], bn = b[n] * signs[i][m];
      across = p[l] * x - p[k] * y, side = sign(across);
      times_length = side * across - (ak * y + al * x + bm * turn[i][n] + bn * turn[i][m]);
      if (squared < S(1) / 64) [[unlikely]] times_length = separation() * std::sqrt(squared);
    }
    /// Told without a root: with f(x) = x |x|, which grows with x, the separation is wider than w where f(L times it) > f(w) L^2.
    [[gnu::always_inline]] bool may_be_wider(S w, S floor) const {
      const S most = times_length + floor;
      return most * std::abs(most) >= w * greater(w, -w) * squared;
    }
    [[gnu::always_inline]] bool cross() const { return squared > next_to_zero * next_to_zero; }
    [[gnu::always_inline]] S separation() const {
      const auto &r_of = boxes.r_;
      const S of_m = std::abs(x * r_of[l][m] - y * r_of[k][m]), of_n = std::abs(x * r_of[l][n] - y * r_of[k][n]);
      return (side * across - (ak * y + al * x + boxes.b_[m] * of_m + boxes.b_[n] * of_n)) / std::sqrt(squared);
    }
    [[gnu::always_inline]] Triple normal() const {
      const S length = side * std::sqrt(squared);
      return cyclic<i>(0, -y / length, x / length);
    }

    /// The place of p.
    struct Place {
      S s, t;
      S beyond;  ///< times L^2: with c, d what is left along e_i and R_j the square of the vector in their plane is (c^2 - 2 r c d + d^2) / L^2 = (c - r d)^2 / L^2 + d^2
      /// Where c and d are off by rounding.
      S beyond_within(S floor) const { return beyond + (floor / 8) * (floor / 8); }
    };
    [[gnu::always_inline]] Place place(S inverse) const {
      const S u = boxes.p_[i] - side * (bm * boxes.r_[i][m] - bn * boxes.r_[i][n]), v = boxes.q_[j] - side * (al * y - ak * x);
      Place p;
      p.s = clamped((u - r * v) * inverse, boxes.a_[i]);
      p.t = clamped(v - r * p.s, boxes.b_[j]);
      p.s = clamped(u - r * p.t, boxes.a_[i]);
      const S off_i = u - p.s - r * p.t, off_j = v - r * p.s - p.t, across_j = off_i - r * off_j;
      p.beyond = across_j * across_j + squared * (off_j * off_j);
      return p;
    }
    [[gnu::always_inline]] Triple point_a(const Place& p) const { return cyclic<i>(p.s, -side * ak, side * al); }
    [[gnu::always_inline]] Triple point_b(const Place& p) const { return Triple{boxes.p_[0], boxes.p_[1], boxes.p_[2]} - boxes.rotated(cyclic<j>(p.t, side * bm, -side * bn)); }
  };

  /// Looks along three pairs of edges for a wider separation.
  template <int i>
  [[gnu::always_inline]] void widen(Facet& widest, S floor) const { widen<i, 0>(widest, floor), widen<i, 1>(widest, floor), widen<i, 2>(widest, floor); }
  template <int i, int j>
  [[gnu::always_inline]] void widen(Facet& widest, S floor) const {
    const Edges<i, j> e(*this);
    if (!e.may_be_wider(widest.separation, floor) || !e.cross()) return;
    const S separation = e.separation();
    if (!(separation > widest.separation)) return;
    const S inverse = 1 / e.squared;
    const auto p = e.place(inverse);
    widest = {separation, p.beyond_within(floor) * inverse, e.point_a(p), {}, e.normal()};
  }

  struct Nearest {
    S nearness = std::numeric_limits<S>::infinity();
    Facet facet{0, 0, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  };
  template <int i>
  [[gnu::always_inline]] void approach_along_a(Nearest& nearest, S floor) const { approach<i, 0>(nearest, floor), approach<i, 1>(nearest, floor), approach<i, 2>(nearest, floor); }
  template <int j>
  [[gnu::always_inline]] void approach_along_b(Nearest& nearest, S floor) const { approach<0, j>(nearest, floor), approach<1, j>(nearest, floor), approach<2, j>(nearest, floor); }
  template <int i, int j>
  [[gnu::always_inline]] void approach(Nearest& nearest, S floor) const {
    const Edges<i, j> e(*this);
    if (!(e.times_length + floor > 0)) return;
    const S inverse = 1 / e.squared;
    const auto p = e.place(inverse);
    const S nearness = (e.times_length * e.times_length + p.beyond) * inverse;
    if (!(nearness < nearest.nearness && e.cross())) return;
    const Triple on = e.point_a(p);
    nearest.nearness = nearness, nearest.facet = {e.separation(), p.beyond_within(floor) * inverse, on, e.point_b(p) - on, e.normal()};
  }

  /// Of bodies of which some axis has `most` between, where the nearest of the faces' facets is not the nearest of all. That is nearly always (99 of 100 pairs) one
  /// beside it, across the ends that p lies beyond: there all facets are of that edge, along e_i, and an R_j, or the other way round.
  [[gnu::noinline]] BoxPoints<3, S> nearest_beyond(int ends, S most, S floor) const {
    if (ends == 0) return across_facet(beside(most - floor, floor), most, floor);
    Nearest nearest;
    if (ends & 1) approach_along_a<0>(nearest, floor);
    if (ends & 2) approach_along_a<1>(nearest, floor);
    if (ends & 4) approach_along_a<2>(nearest, floor);
    if (ends & 8) approach_along_b<0>(nearest, floor);
    if (ends & 16) approach_along_b<1>(nearest, floor);
    if (ends & 32) approach_along_b<2>(nearest, floor);
    const BoxPoints<3, S> found = across(nearest, most, floor);
    return found.proven ? found : nearest_of_edges(most, floor);
  }
  /// The directions of these ends, a bit for every e_i and then every R_j. A face's place is beyond along k where the end along l is passed, and the other way round.
  static int ends_beyond(int face, const Triple& off, S floor) {
    const int x = std::abs(off.x) > floor, y = std::abs(off.y) > floor, z = std::abs(off.z) > floor;
    switch (face % 3) {
      case 0: return (y << 2 | z << 1) << face;
      case 1: return (z << 0 | x << 2) << (face - 1);
      default: return (x << 1 | y << 0) << (face - 2);
    }
  }

  [[gnu::noinline]] BoxPoints<3, S> nearest_of_edges(S most, S floor) const {
    Nearest nearest;
    approach_along_a<0>(nearest, floor), approach_along_a<1>(nearest, floor), approach_along_a<2>(nearest, floor);
    return across(nearest, most, floor);
  }

  /// `widest`: the face along which they overlap least.
  [[gnu::noinline]] BoxPoints<3, S> least_overlap(int widest, S floor) const {
    Facet f = face_at(widest);
    if (widest >= 3) f = from_b(f);
    if (parallel_ < 3) widen<0>(f, floor), widen<1>(f, floor), widen<2>(f, floor);  // else all edges' axes are faces', too
    if (f.separation > floor) return nearest_of_edges(f.separation, floor);
    if (!(f.beyond <= floor * floor)) f = beside(f.separation - floor, floor);
    return across_facet(f, f.separation, floor);
  }

  /// By its place among the axes; of B in B's axes.
  Facet face_at(int place) const {
    switch (place) {
      case 0: return face<true, 0>();
      case 1: return face<true, 1>();
      case 2: return face<true, 2>();
      case 3: return face<false, 0>();
      case 4: return face<false, 1>();
      default: return face<false, 2>();
    }
  }

  /// The points across a facet that p is beside.
  BoxPoints<3, S> across_facet(const Facet& f, S most, S floor) const {
    BoxPoints<3, S> found;
    found.a = unsigned_zeros(f.on), found.b = unsigned_zeros(f.on + f.normal * f.separation), found.normal = unsigned_zeros(f.normal);
    found.distance = f.separation, found.lower_bound = most;
    found.axes = axes - parallel_;
    found.apart = most > floor, found.corner = false, found.proven = (f.beyond <= floor * floor) & (most - f.separation <= 2 * floor);
    return found;
  }

  /// The points of two bodies that are apart, wherever they lie on the facet; `squared`: their distance's square.
  [[gnu::always_inline]] BoxPoints<3, S> across_plane(const Facet& f, S squared, S most, S floor) const {
    const S distance = std::sqrt(squared);
    const Triple n{f.off.x / distance, f.off.y / distance, f.off.z / distance};
    const S apart = plane(n.x, n.y, n.z);
    BoxPoints<3, S> found;
    found.a = unsigned_zeros(f.on), found.b = unsigned_zeros(f.on + f.off), found.normal = unsigned_zeros(n);
    found.distance = distance, found.lower_bound = greater(most, apart);
    found.axes = axes - parallel_;
    found.apart = true, found.corner = f.beyond > floor * floor, found.proven = distance - apart <= 2 * floor;
    return found;
  }
  /// Of no facet of these: those of the widest axis, proven where they are the nearest.
  [[gnu::always_inline]] BoxPoints<3, S> across(const Nearest& nearest, S most, S floor) const {
    const Facet& f = nearest.facet;
    if (!std::isfinite(nearest.nearness)) [[unlikely]] return across_facet(beside(most - floor, floor), most, floor);
    const S widest = greater(most, f.separation);
    return f.beyond <= floor * floor ? across_facet(f, widest, floor) : across_plane(f, f.off.dot(f.off), widest, floor);
  }

  /// How far apart they are along a unit direction.
  [[gnu::always_inline]] S plane(S x, S y, S z) const {
    const auto of_b = [&](int j) { return b_[j] * std::abs(r_[0][j] * x + r_[1][j] * y + r_[2][j] * z); };
    return (x * p_[0] + y * p_[1] + z * p_[2]) - ((a_[0] * std::abs(x) + a_[1] * std::abs(y) + a_[2] * std::abs(z)) + (of_b(0) + of_b(1) + of_b(2)));
  }

  /// Of facets in one plane, or as far off, the one p is beside: of edges only where it is beside no face's.
  [[gnu::noinline]] Facet beside(S least, S floor) const {
    Facet best{least, std::numeric_limits<S>::infinity(), {0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    const auto take = [&](const Facet& f) {
      if (f.separation >= least && f.beyond < best.beyond) best = f;
    };
    take(face<false, 0>()), take(face<false, 1>()), take(face<false, 2>());
    if (best.beyond < std::numeric_limits<S>::infinity()) best = from_b(best);
    take(face<true, 0>()), take(face<true, 1>()), take(face<true, 2>());
    const auto take_edges = [&]<int i, int j>(const Edges<i, j>& e) {
      if (best.beyond <= floor * floor || !e.may_be_wider(least, floor) || !e.cross()) return;
      const S inverse = 1 / e.squared;
      const auto p = e.place(inverse);
      take({e.separation(), p.beyond_within(floor) * inverse, e.point_a(p), {0, 0, 0}, e.normal()});
    };
    const auto take_row = [&]<int i>(std::integral_constant<int, i>) { take_edges(Edges<i, 0>(*this)), take_edges(Edges<i, 1>(*this)), take_edges(Edges<i, 2>(*this)); };
    if (!(best.beyond <= floor * floor)) take_row(std::integral_constant<int, 0>{}), take_row(std::integral_constant<int, 1>{}), take_row(std::integral_constant<int, 2>{});
    return best;
  }

  template <int i>
  [[gnu::always_inline]] void set_signs() { sign_[i][0] = sign(r_[i][0]), sign_[i][1] = sign(r_[i][1]), sign_[i][2] = sign(r_[i][2]); }

  [[gnu::always_inline]] bool flat_on_one_another() const {
    const auto least = [](S x, S y, S z) { return lesser(lesser(std::abs(x), std::abs(y)), std::abs(z)); };
    return least(least(r_[0][0], r_[0][1], r_[0][2]), least(r_[1][0], r_[1][1], r_[1][2]), least(r_[2][0], r_[2][1], r_[2][2])) <= next_to_zero;
  }
  /// The small turn is about an axis t: R_j + t x R_j, of which the element i is R_ij + t_k R_lj - t_l R_kj.
  template <int i>
  [[gnu::always_inline]] void settle() { settle<i, 0>(), settle<i, 1>(), settle<i, 2>(); }
  template <int i, int j>
  [[gnu::always_inline]] void settle() {
    constexpr int k = next(i), l = next(k);
    constexpr S t[3] = {S(0.5), S(0.7), S(1.1)};
    if (std::abs(r_[i][j]) <= next_to_zero) sign_[i][j] = sign(t[k] * r_[l][j] - t[l] * r_[k][j]), r_[i][j] = 0;
  }
  template <int i>
  [[gnu::always_inline]] int parallel() const { return !Edges<i, 0>(*this).cross() + !Edges<i, 1>(*this).cross() + !Edges<i, 2>(*this).cross(); }

  const S a_[3], b_[3];
  S r_[3][3], sign_[3][3];  ///< R's elements, and their signs
  const S p_[3], q_[3];
  int parallel_ = 0;        ///< pairs of edges
};

}  // namespace gjkdbg
