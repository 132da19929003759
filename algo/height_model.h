// What the height of A - B is like about a direction, where both bodies are ellipsoids, or one a point: what it is no less than, and where it may be least.
//
// Along a great circle from the unit direction d the directions are cos(s) d + sin(s) t, t across d. With M the matrix of an ellipsoid whose squared radii are its eigenvalues, its height there is
// f(s) = sqrt(z), the height of a plane ellipse, which bends with the radius f'' + f:
//
//   z = h^2 + sin(2s) m.t + sin(s)^2 t.X t      h^2 = d.M d,  m = M d across d,  X = M - h^2 across d
//   f'' + f = h^3 T(t) / z^(3/2)                h^3 T(t) = h^2 t.M t - (m.t)^2 = (d x t).adj(M) (d x t),  T(t) = t.T t
//
// z^(-3/2) is convex, so f'' + f >= T(t) (1 - 3 / (2 h^2) (sin(2s) m.t + sin(s)^2 t.X t)). By Sturm's comparison, for s <= pi,
//
//   f(s) = f(0) cos(s) + f'(0) sin(s) + int_0^s sin(s - r) (f'' + f)(r) dr
//
// and for 1, sin(2r), sin(r)^2 the integral is q^2 / 2, q^3 cos(s / 2) / 3, q^4 / 12, with the chord q = 2 sin(s / 2). A - B's height is the sum of the bodies', but for the part c . n of their
// middles, which bends nowhere. With u = q t, h the height, g the slope (what of the support lies across d) of all,
//
//   h(n) >= h + cos(s / 2) (g.u - sum T(u) m.u / (2 h_k^2)) + u.(T - h) u / 2 - sum T(u) u.X u / (8 h_k^2)
//
// T - h is diagonal in axes e1, e2 across d; u.T u's other terms are shared out between u1^2 and u2^2, with what |u1|, |u2| are at most. Where the first is next to nothing, all that is left along e1 is
// u1^3 m1: that vanishes with the slope, so along a valley of directions that are nearly as near, the bound falls off by less than the valley's own heights differ. (A polytope's faces, EPA's,
// know of no bends: their bound falls off by h u^2 / 2.)
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "algo/sat.h"
#include "shapes/support_mappings.h"

namespace gjkdbg {

/// How a body bends: an ellipsoid, by its squared radii in parts of the greatest, so that no power of a small one vanishes.
template <int D, class S>
struct BentBody {
  Matrix<D, S> inverse;  ///< takes directions to its axes
  Vector<D, S> squares;
  S greatest;  ///< radius; of a point 0
  S ball;      ///< radius of the largest ball that rolls within it, of its sharpest bend; in parts of the greatest

  /// `axes`: of an ellipsoid.
  static BentBody of(const EllipsoidCore<D, S>& ellipsoid, const Matrix<D, S>& axes) {
    const S greatest = ellipsoid.radii.maxCoeff(), least = ellipsoid.radii.minCoeff() / greatest;
    return {axes.transpose(), (ellipsoid.radii / greatest).cwiseAbs2(), greatest, least * least};
  }
  static BentBody point() { return {Matrix<D, S>::Identity(), Vector<D, S>::Zero(), 0, 0}; }
  static BentBody unit_ball() { return {Matrix<D, S>::Identity(), Vector<D, S>::Ones(), 1, 1}; }

  /// What of it is farthest along d.
  Vector<D, S> support(const Vector<D, S>& d) const {
    const Vector<D, S> n = inverse * d, along = squares.cwiseProduct(n);
    return inverse.transpose() * along * (greatest / std::sqrt(n.dot(along)));
  }
};

/// Bodies whose sum it is that bends, each of any size. Keeps pointers.
template <int D, class S>
struct BentBodies {
  static constexpr int most = 10;
  struct Sized {
    const BentBody<D, S>* body;
    S greatest;
  };
  std::array<Sized, most> list{};
  int count = 0;

  void add(const BentBody<D, S>& body, S greatest) { list[static_cast<std::size_t>(count++)] = {&body, greatest}; }
};

template <int D, class S>
class HeightModel;

/// Of two bodies, in body 0's frame.
template <int D, class S>
struct BentPair {
  using Model = HeightModel<D, S>;
  std::array<BentBody<D, S>, 2> bodies;

  template <class Point>
  Model model(const Vector<D, S>& d, const Point& point) const {
    BentBodies<D, S> bent;
    for (const BentBody<D, S>& body : bodies) bent.add(body, body.greatest);
    return Model(bent, d, point.w);
  }
  template <class Point>
  SatWitnesses<D, S> witnesses(const Model&, const Point& point) const { return {point.a, point.b}; }

  /// Unset where a body is neither an ellipsoid nor a point (a ball's core), neither is an ellipsoid, or one is too flat for its bends to be told.
  template <class Difference>
  static std::optional<BentPair> of(const Difference& difference) {
    if constexpr (D > 1 && requires { difference.a().core(), difference.b().core(); }) {
      const auto a = bent(difference.a().core(), Matrix<D, S>::Identity()), b = bent(difference.b().core(), difference.rotation());
      if (a && b && (a->greatest > 0 || b->greatest > 0)) return BentPair{{*a, *b}};
    }
    return std::nullopt;
  }

  /// Unset as above.
  template <class Core>
  static std::optional<BentBody<D, S>> bent(const Core& core, const Matrix<D, S>& axes) {
    if (std::holds_alternative<PointCore<D, S>>(core)) return BentBody<D, S>::point();
    const auto* ellipsoid = std::get_if<EllipsoidCore<D, S>>(&core);
    if (!ellipsoid || !(ellipsoid->radii.minCoeff() * 1024 > ellipsoid->radii.maxCoeff())) return std::nullopt;
    return BentBody<D, S>::of(*ellipsoid, axes);
  }
};

/// About one direction, in body 0's frame and the unit of the bodies' radii.
template <int D, class S>
class HeightModel {
  static constexpr int across = D - 1;  ///< axes across d
  using V = Vector<D, S>;

 public:
  HeightModel() = default;
  /// `w`: A - B's support along the unit direction d.
  HeightModel(const BentBodies<D, S>& bodies, const V& d, const V& w) : d_(d), height_(d.dot(w)) {
    std::array<Bends, BentBodies<D, S>::most> bends;
    if constexpr (D == 3) {
      const V e = d.unitOrthogonal(), f = d.cross(e);
      axes_ = {e, f};
    } else {
      axes_ = {V(-d[1], d[0])};
    }
    for (int k = 0; k < bodies.count; ++k) {
      const auto& [body, greatest] = bodies.list[at(k)];
      bends[at(k)] = of_body(*body, greatest), ball_ += body->ball * greatest;
    }
    if constexpr (D == 3) turn(bends, bodies.count);
    for (int i = 0; i < across; ++i) slope_[at(i)] = axes_[at(i)].dot(w), bend_[at(i)] = -height_;
    for (int k = 0; k < bodies.count; ++k) take(bends[at(k)]);
  }

  const V& direction() const { return d_; }
  S height() const { return height_; }
  /// What A - B reaches farthest along d with: as high, and off d by the slope.
  V support() const {
    V w = height_ * d_;
    for (std::size_t i = 0; i < at(across); ++i) w += slope_[i] * axes_[i];
    return w;
  }
  /// How far the support lies beside the direction.
  S slope() const { return across == 2 ? std::hypot(slope_[0], slope_[across - 1]) : std::abs(slope_[0]); }

  /// How far directions are from this one: of u, its length and its parts along e1, e2, at most.
  struct Reach {
    S chord;
    std::array<S, across> along;
  };
  Reach reach(S chord) const {
    Reach reach{chord, {}};
    reach.along.fill(chord);
    return reach;
  }
  /// Of the spherical polygon with these corners, less than half the sphere. A direction n in it is w / |w| with a mean w of the corners, where e.w is no more than a corner's and |w| >= d.w no less than
  /// one's; and u = q t is the part of n across d, sin(s) t, over cos(s / 2).
  template <std::size_t corners>
  Reach reach(const std::array<V, corners>& ends) const {
    S square = 0, ahead = 1;
    std::array<S, across> aside{};
    for (const V& end : ends) {
      square = std::max(square, (end - d_).squaredNorm()), ahead = std::min(ahead, d_.dot(end));
      for (std::size_t i = 0; i < at(across); ++i) aside[i] = std::max(aside[i], std::abs(axes_[i].dot(end)));
    }
    if (!(ahead > 0)) return reach(S(2));  // the farthest direction need not be a corner
    Reach reach = this->reach(std::sqrt(square));
    if (!(ahead > S(0.25))) return reach;
    const S widened = 1 / (ahead * std::sqrt((1 + ahead) / 2));
    for (std::size_t i = 0; i < at(across); ++i) reach.along[i] = std::min(reach.chord, aside[i] * widened);
    return reach;
  }

  /// What no height is below along directions no farther than this.
  ///
  /// Where the height bends upwards along an axis, only so far along it may a height be less than this one as all else lets it fall: the bound within that is one of all, and what falls there is less.
  S least_within(const Reach& reach) const {
    constexpr int looks = 3;
    Reach near = reach;
    S least = -std::numeric_limits<S>::infinity();
    for (int look = 0; look < looks; ++look) {
      const S q1 = near.along[0], q2 = near.along[across - 1], second = std::min(near.chord * near.chord, q1 * q1 + q2 * q2);
      std::array<S, 2> slope{std::abs(slope_[0]), 0}, bend{bend_[0] - q1 / 3 * std::abs(cubic_[0]) - 2 * second * quartic_[0], 0}, fall{};
      if constexpr (across == 2) {
        slope[1] = std::abs(slope_[1]) + q1 * q1 / 6 * std::abs(cubic_[1]) + 2 * second * q1 * mixed_;
        bend[1] = bend_[1] - (q1 * std::abs(cubic_[2]) + q2 * std::abs(cubic_[3])) / 3 - 2 * second * quartic_[1];
      }
      for (std::size_t i = 0; i < at(across); ++i) {
        const S most = near.along[i];
        const bool within = bend[i] > 0 && slope[i] <= bend[i] * most;
        fall[i] = within ? slope[i] * slope[i] / (2 * bend[i]) : slope[i] * most - bend[i] * most * most / 2;
      }
      least = std::max(least, height_ - fall[0] - fall[1]);
      bool nearer = false;
      for (std::size_t i = 0; i < at(across); ++i) {
        if (!(bend[i] > 0)) continue;
        const S most = (slope[i] + std::sqrt(slope[i] * slope[i] + 2 * bend[i] * std::max(S(0), fall[1 - i]))) / bend[i];
        if (most < near.along[i] / 2) near.along[i] = most, nearer = true;
      }
      if (!nearer) break;
    }
    return std::max(least, least_by_ball(reach.chord));
  }

  template <std::size_t corners>
  S least_among(const std::array<V, corners>& ends) const { return least_within(reach(ends)); }
  template <std::size_t corners>
  S chord(const std::array<V, corners>& ends) const { return reach(ends).chord; }

  /// What no height is below on one side of a circle of directions through d: with x the part of u along `way`, unit, across d and the circle, those with x cos(s / 2) >= turn q^2 / 2.
  ///
  /// With y the part of u along the circle, X = x cos(s / 2), c the least cos(s / 2), all terms of the bound that have x in them come to g_x X + e x + b x^2 / 2, |e| <= N: what of the higher terms counts as |u2|,
  /// and the mixed bend; b is x's own. They are no less than f(X) = (g_x - N / c) X + B X^2 / 2 for X >= 0, (g_x + N / c) X + B X^2 / 2 for X <= 0, B = b, or b / c^2 where that is below zero, and
  ///
  ///   X >= x0,   x0 = turn (x0^2 + y^2) / 2                for turn >= 0
  ///   X >= -x0,  x0 = |turn| (x0^2 / c^2 + y^2) / 2        otherwise, for |turn| X <= c^2: the other root is beyond that
  ///
  /// with x0 = |turn| y^2 / (1 + sqrt(1 - w turn^2 y^2)), w = 1 or 1 / c^2, no more than k y^2, the root at y_most. Where f rises up to there, and is no less at x_most, it is least at x0, or -x0, where it comes to
  ///
  ///   a y^2 / 2 + (B + w a) x0^2 / 2,   a = (g_x - N / c) turn,   or a = (g_x + N / c) turn
  ///
  /// which is exact on the circle: that b and a cancel is how a circle of heights that are all the same shows. Where f leads downwards, or in the plane, the bound is that of both sides.
  template <std::size_t corners>
  S least_on_one_side(const std::array<V, corners>& ends, const V& way, S turn) const {
    const Reach reach = this->reach(ends);
    const S both = least_within(reach);
    if constexpr (across == 2) {
      const S q = reach.chord, q1 = reach.along[0], q2 = reach.along[across - 1], second = q * q, cos = std::sqrt(std::max(S(0), 1 - second / 4));
      const S w1 = way.dot(axes_[0]), w2 = way.dot(axes_[across - 1]), s1 = std::abs(w1), s2 = std::abs(w2);
      const S x_most = std::min(q, q1 * s1 + q2 * s2), y_most = std::min(q, q1 * s2 + q2 * s1), wide = turn >= 0 ? S(1) : 1 / (cos * cos), bent = std::abs(turn) * y_most;
      if (!(cos > 0) || (turn < 0 && !(std::max(-turn * x_most, bent) < cos * cos))) return both;
      const S more = q1 * q1 / 6 * std::abs(cubic_[1]) + 2 * second * q1 * mixed_;  // of |u2|
      const S first = bend_[0] - q1 / 3 * std::abs(cubic_[0]) - 2 * second * quartic_[0], last = bend_[across - 1] - (q1 * std::abs(cubic_[2]) + q2 * std::abs(cubic_[3])) / 3 - 2 * second * quartic_[across - 1];
      const S own = first * w1 * w1 + last * w2 * w2, bend_x = own >= 0 ? own : own / (cos * cos), bend_xy = (last - first) * w1 * w2;
      const S slope_x = slope_[0] * w1 + slope_[across - 1] * w2, slope_y = std::abs(slope_[across - 1] * w1 - slope_[0] * w2) + more * s1;
      const S most = (more * s2 + std::abs(bend_xy) * y_most) / cos, least_slope = slope_x - most, most_slope = slope_x + most;
      const S per_square = std::abs(turn) / (1 + std::sqrt(std::max(S(0), 1 - wide * bent * bent))), x_circle = std::min(x_most, per_square * y_most * y_most);
      const auto rise = [&](S x) { return x * (least_slope + bend_x * x / 2); };
      const bool upwards = least_slope >= 0 && (turn >= 0 ? rise(x_most) >= rise(x_circle) : rise(x_most) >= 0 && most_slope >= bend_x * x_circle);
      if (!upwards) return both;
      const S circle = turn * (turn >= 0 ? least_slope : most_slope);
      const S bend_y = first * w2 * w2 + last * w1 * w1 + circle + per_square * x_circle * std::min(S(0), bend_x + wide * circle);
      const bool within = bend_y > 0 && slope_y <= bend_y * y_most;
      return std::max(both, height_ + (within ? -slope_y * slope_y / (2 * bend_y) : bend_y * y_most * y_most / 2 - slope_y * y_most));
    }
    return both;
  }

  /// As above, where a disc of this radius is across d, of which w has the middle: its height is the radius times sin(s) = |u| cos(s / 2), and rises to all sides. Where it rises more than all else falls the height is
  /// least along d.
  template <std::size_t corners>
  S least_above(const std::array<V, corners>& ends, S radius) const {
    const Reach reach = this->reach(ends);
    if constexpr (across == 2) {
      const S q = reach.chord, second = q * q, rise = radius * std::sqrt(std::max(S(0), 1 - second / 4));
      S worst = std::abs(mixed_) * 2;
      for (const S x : cubic_) worst += std::abs(x) / 6;
      for (const S x : quartic_) worst += 2 * x;  // of |u|^3 and more, for q <= 1
      const S fall = slope() + q * std::max(S(0), -std::min(bend_[0], bend_[across - 1])) / 2 + second * worst;
      if (q <= 1 && rise >= fall) return height_;
    }
    return least_within(reach);
  }

  /// Whether the height falls all the way to d + v, as far as slope and bends say.
  bool falls_along(const V& v) const {
    S rate = 0;
    for (int i = 0; i < across; ++i) {
      const S x = axes_[at(i)].dot(v);
      rate += (slope_[at(i)] + bend_[at(i)] * x) * x;
    }
    return rate < 0;
  }

  /// Newton's step to where the height is least, along the axes that bend towards that, and along each of them no farther than `most`.
  V step(S most) const { return moved([&](std::size_t i) { return bend_[i] > 0 ? std::clamp(-slope_[i] / bend_[i], -most, most) : S(0); }); }
  /// Along every axis downhill; as far as Newton's step leads, at most by this.
  V step_down(S most) const { return moved([&](std::size_t i) { return slope_[i] == 0 ? S(0) : std::clamp(-slope_[i] / std::abs(bend_[i]), -most, most); }); }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  template <class Along>
  V moved(const Along& along) const {
    V there = d_;
    for (std::size_t i = 0; i < at(across); ++i) there += along(i) * axes_[i];
    return there.normalized();
  }

  S least_by_ball(S q) const {
    const S rest = height_ - ball_, aside = slope(), cos = 1 - q * q / 2, sin = q * std::sqrt(std::max(S(0), 1 - q * q / 4));
    if (aside * cos <= -rest * sin) return ball_ - std::hypot(rest, aside);
    return ball_ + rest * cos - aside * sin;
  }

  /// Of a body, over the axes: T; m and X in parts of h^2.
  struct Bends {
    S t11, t12, t22, m1, m2, x11, x12, x22;
    /// In the axes cos e1 + sin e2, cos e2 - sin e1.
    void turn(S cos, S sin) {
      const auto matrix = [&](S& a, S& b, S& c) {
        const S first = cos * cos * a + 2 * cos * sin * b + sin * sin * c, last = sin * sin * a - 2 * cos * sin * b + cos * cos * c;
        b = (cos * cos - sin * sin) * b + cos * sin * (c - a), a = first, c = last;
      };
      matrix(t11, t12, t22), matrix(x11, x12, x22);
      const S first = cos * m1 + sin * m2;
      m2 = cos * m2 - sin * m1, m1 = first;
    }
  };

  Bends of_body(const BentBody<D, S>& body, S greatest) const {
    Bends b{};
    if (!(greatest > 0)) return b;
    const V d = body.inverse * d_, e = body.inverse * axes_[0], md = body.squares.cwiseProduct(d), me = body.squares.cwiseProduct(e);
    const S square = d.dot(md), scale = greatest / (square * std::sqrt(square));
    b.m1 = e.dot(md) / square, b.x11 = e.dot(me) / square - 1;
    if constexpr (D == 3) {
      const V f = body.inverse * axes_[1], adjugate(body.squares[1] * body.squares[2], body.squares[2] * body.squares[0], body.squares[0] * body.squares[1]);
      b.m2 = f.dot(md) / square, b.x12 = f.dot(me) / square, b.x22 = f.dot(body.squares.cwiseProduct(f)) / square - 1;
      const V ae = adjugate.cwiseProduct(e);
      b.t11 = f.dot(adjugate.cwiseProduct(f)) * scale, b.t12 = -f.dot(ae) * scale, b.t22 = e.dot(ae) * scale;  // d x e = f, d x f = -e
    } else {
      b.t11 = body.squares[0] * body.squares[1] * scale;
    }
    return b;
  }

  /// To the axes in which T is diagonal, the least bend first.
  void turn(std::array<Bends, BentBodies<D, S>::most>& bends, int count) {
    Bends sum{};
    for (int k = 0; k < count; ++k) sum.t11 += bends[at(k)].t11, sum.t12 += bends[at(k)].t12, sum.t22 += bends[at(k)].t22;
    const S half = (sum.t22 - sum.t11) / 2, mixed = -sum.t12, length = std::hypot(half, mixed);
    if (!(length > 0)) return;
    // The least lies at an angle a to e1 where cos(2a) = half / length, sin(2a) = mixed / length.
    S cos = std::sqrt((1 + std::abs(half) / length) / 2), sin = mixed / (2 * length * cos);
    if (half < 0) std::swap(cos, sin);
    for (int k = 0; k < count; ++k) bends[at(k)].turn(cos, sin);
    const V e = cos * axes_[0] + sin * axes_[1];
    axes_[across - 1] = cos * axes_[across - 1] - sin * axes_[0], axes_[0] = e;
  }

  void take(const Bends& b) {
    bend_[0] += b.t11, cubic_[0] += 3 * b.t11 * b.m1;
    const S most = (b.t11 + b.t22) / 2 + std::hypot((b.t11 - b.t22) / 2, b.t12);
    quartic_[0] += most * std::max(S(0), b.x11) / 8;
    if constexpr (across == 2) {
      bend_[1] += b.t22;
      cubic_[1] += 3 * (b.t11 * b.m2 + 2 * b.t12 * b.m1), cubic_[2] += 3 * (2 * b.t12 * b.m2 + b.t22 * b.m1), cubic_[3] += 3 * b.t22 * b.m2;
      quartic_[1] += most * std::max(S(0), b.x22) / 8, mixed_ += most * std::abs(b.x12) / 8;
    }
  }

  V d_;
  std::array<V, across> axes_;  ///< e1, e2
  S height_ = 0, ball_ = 0;
  std::array<S, across> slope_{}, bend_{}, quartic_{};  ///< g, T - h, and of u_i^2 u^2
  std::array<S, 4> cubic_{};                             ///< of u1^3, u1^2 u2, u1 u2^2, u2^3, times 6
  S mixed_ = 0;                                          ///< of |u1 u2| u^2
};

}  // namespace gjkdbg
