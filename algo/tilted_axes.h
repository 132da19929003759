// How deep two bodies of revolution are whose axes are nearly, but not quite, parallel and whose middles lie nearly on one line: rods within one another, a peg in its hole, wheels on an axle.
//
// There a circle of points of A - B is nearly as near as the nearest, which EPA would need thousands of faces for, and A - B is no body of revolution, whose section would tell the depth
// (algo/revolution_sat.h). But it changes little when it turns: with the axes u, u' of A and B, c from A's middle to B's, r of it across u, and the direction n(t, p) = cos(t) e(p) + sin(t) u, where e
// goes round u with the angle p, the height is
//
//   h(n) = h_A(n) + h_-B(n) - c . n,   h_A the same for all p.
//
// Where x, y are the points of A and -B (from their middles) that n0 = n(t, p0) touches, and R, R' turn about u, u',
//
//   h_A(n) = h_A(n0) >= n0 . x     for n = R(s) n0 = n(t, p0 + s)
//   h_-B(n) = h_-B(R'(-s) n) >= y . M(s) n0,   M(s) = R'(-s) R(s),   M(0) = 1,   M'(0) = d x ,   d = u - u'
//           >= y . n0 + s n0 . (y x d) + s^2 / 2 n0 . ((y . u) d - (y . d) u') - s^2 / 2 |d| |y| (s + 3 |d|)
//   -c . n >= -c . n0 - s cos(t) c . e'(p0) + s^2 / 2 cos(t) c . e(p0) - s^2 / 2 |s c . e'(p0)| / 3
//
// The square of s: with y' = R'(s) y, M'' gives y' . (d x (u x n)) - y' . (u' x (d x n)) = (y' . u)(d . n) - (y' . d)(u' . n) - (y' . n)(d . u - d . u'), where d . u = -d . u' = |d|^2 / 2, and
// from s = 0 on each of the products changes by no more than s |d| |y| and a part of |d|^2 |y|.
//
// Turned about u' instead, it is A's points that move: the same, with x for y and u for u'.
//
// So around the section at p0 all sections no farther than s are as high along (t), but for a point's rate and the square of s: the depth is bounded by arcs of t and intervals of p (algo/outline_arcs.h). An interval
// where the bound is not yet near enough is divided, at first where the least may lie. This is branch and bound (Land & Doig 1960), over the sphere. The square shrinks with |u - u'| and r, so that few
// intervals are needed where EPA needs most faces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "algo/bent_sum.h"
#include "algo/ellipsoid_depth.h"
#include "algo/outline_arcs.h"
#include "algo/revolution_sat.h"

namespace gjkdbg {

template <class Difference, class Trace>
class TiltedAxes {
  using S = typename Difference::S;
  using V = Vector<3, S>;
  using Flat = Vector<2, S>;  ///< in the axes e(p), u
  static constexpr S unknown = std::numeric_limits<S>::quiet_NaN();

 public:
  /// Keeps references.
  TiltedAxes(Difference& difference, const RevolvedPair<S>& pair, Trace& trace) : difference_(difference), trace_(trace), floor_(difference.rounding_floor()), pair_(pair), bend_(pair.a.sharpest() + pair.b.sharpest()) {}

  /// `overlapping` where the depth is known within rounding, or this tolerance, a part of it. With some 16 supports for each of `most`, of which EPA's steps would take longer.
  const SatResult<3, S>& run(S tolerance, int most) {
    tolerance_ = tolerance, most_ = 16 * std::int64_t{most};
    turn_about(flattest_is_b() ? pair_.b : pair_.a);
    down_ = look_along(-u_), up_ = look_along(u_);
    for (int k = 0; k < quarters; ++k) examine({std::numbers::pi_v<S> * S(k) * 2 / quarters, std::numbers::pi_v<S> / quarters, 0});
    settle();
    while (count_ > 0 && !near_enough(least_) && count_ + 2 < room && result_.iterations < most_) {
      const Interval widest = take_least();
      // The middle, which may be where the least is, a ninth; what lies beside it is seldom as near.
      const S ninth = widest.width / 9;
      for (const S side : {S(0), S(-5), S(5)}) examine({widest.middle + side * ninth, side == 0 ? ninth : 4 * ninth, 0});
      settle();
    }
    const bool known = near_enough(least_) && result_.depth > floor_;
    result_.status = known ? SatStatus::overlapping : result_.depth < -floor_ ? SatStatus::separated : SatStatus::undecided;
    look_along(V(result_.normal));  // so that the last axis is the answer's
    return result_;
  }

  /// How much less than what was found the depth may be.
  S slack() const { return std::max(S(0), result_.depth - least_); }

 private:
  static constexpr int quarters = 4, room = 1024;

  /// Of the angle p: `width` to both sides of `middle`, and what no height is below.
  struct Interval {
    S middle, width, least;
  };

  /// Which of them has the edge, across the section, that the way out leads through: turning about its axis leaves that edge where it is.
  bool flattest_is_b() {
    if (pair_.curved()) return pair_.a.ellipse() && !pair_.b.ellipse();
    const auto normals = pair_.normals();
    const V e = across_both();
    S least = std::numeric_limits<S>::infinity();
    bool is_b = false;
    for (int i = 0; i < normals.of_a + normals.of_b; ++i) {
      const V n = (e * normals.list[i].n[0] + pair_.a.axis * normals.list[i].n[1]).stableNormalized();
      if (const S height = n.dot(look_along(n).w); height < least) least = height, is_b = i >= normals.of_a;
    }
    return is_b;
  }
  V across_both() const {
    const V way = pair_.a.axis.cross(pair_.b.axis);
    return way.stableNorm() > std::numeric_limits<S>::min() ? V(way.stableNormalized()) : V(pair_.a.axis.unitOrthogonal());
  }
  void turn_about(const Revolved<S>& body) {
    about_b_ = &body == &pair_.b, u_ = body.axis, off_ = u_ - other().axis, c_ = pair_.b.middle - pair_.a.middle;
    const V e = across_both();  // where cylinders about one middle are nearest
    e1_ = (e - u_ * u_.dot(e)).normalized(), e2_ = u_.cross(e1_);
  }
  const Revolved<S>& other() const { return about_b_ ? pair_.a : pair_.b; }

  bool near_enough(S least) const { return result_.depth - least <= std::max(floor_, tolerance_ * result_.depth); }

  SupportPoint<3, S> look_along(const V& n) {
    const SupportPoint<3, S> point = difference_.support(n);
    const S height = n.dot(point.w);
    ++result_.iterations;
    if (result_.iterations == 1 || height < result_.depth) result_.depth = height, result_.normal = n;
    if constexpr (traced<Trace>) tell_axis(trace_, result_.iterations, AxisSource::outline, n, point, result_.depth, least_, floor_, static_cast<double>(difference_.radius()));
    return point;
  }

  /// Sections through the axis at the interval's middle, until no height of it is near the least that is known, or the interval is what is left open.
  void examine(Interval interval) {
    const V e = std::cos(interval.middle) * e1_ + std::sin(interval.middle) * e2_;
    const S beside = c_.dot(u_.cross(e));  // c . e'(p)
    // Of the part of c the curve is c . e, that of -c . n and of its n_e.
    const S towards = c_.dot(e), tilt = off_.norm();
    OutlineArcs<S> arcs(bend_, {interval.width, tilt * other().reach() * (interval.width + 3 * tilt) + interval.width * std::abs(beside) / 3});
    const auto touch = [&](const Flat& n, const SupportPoint<3, S>& point) {
      const V its_point = about_b_ ? V(point.a - pair_.a.middle) : V(pair_.b.middle - point.b), y = its_point - other().sharpest() * in_space(e, n);
      const V rate = y.cross(off_), curve = u_.dot(y) * off_ - off_.dot(y) * other().axis;
      arcs.add(n, {e.dot(point.w), u_.dot(point.w)}, {Flat(e.dot(rate) - beside, u_.dot(rate)), Flat(e.dot(curve) + towards, u_.dot(curve))});
    };
    touch({0, -1}, down_), touch({0, 1}, up_);
    // Beside no cylinder's side, which has its normal between two that are looked along.
    for (const S angle : {S(-0.61), S(0.37)}) touch({std::cos(angle), std::sin(angle)}, look_along(in_space(e, {std::cos(angle), std::sin(angle)})));
    while (!near_enough(arcs.least().height) && !arcs.full() && result_.iterations < most_) {
      const auto open = arcs.least();
      const V n = in_space(e, open.towards);
      if (arcs.knows(open.towards)) break;
      const SupportPoint<3, S> point = look_along(n);
      if (n.dot(point.w) - (open.height + open.lost) <= open.lost / 2) break;  // the section is known well enough
      touch(open.towards, point);
    }
    interval.least = arcs.least().height;
    if (near_enough(interval.least)) settled_ = std::min(settled_, interval.least);
    else list_[static_cast<std::size_t>(count_++)] = interval;
  }
  V in_space(const V& e, const Flat& flat) const { return e * flat[0] + u_ * flat[1]; }

  void settle() {
    least_ = settled_;
    for (int k = 0; k < count_; ++k) least_ = std::min(least_, list_[static_cast<std::size_t>(k)].least);
  }
  Interval take_least() {
    const auto least = std::min_element(list_.begin(), list_.begin() + count_, [](const Interval& x, const Interval& y) { return x.least < y.least; });
    const Interval taken = *least;
    *least = list_[static_cast<std::size_t>(--count_)];
    return taken;
  }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const RevolvedPair<S> pair_;
  const S bend_;       ///< radius of the balls of the sharpest bends, of both
  bool about_b_ = false;
  V u_, off_, e1_, e2_;  ///< the axis, what it is from the other's, and two across it
  V c_;                  ///< from A's middle to B's
  S tolerance_ = 0, least_ = unknown, settled_ = std::numeric_limits<S>::infinity();
  std::int64_t most_ = 0;  ///< supports
  int count_ = 0;
  SupportPoint<3, S> down_, up_;
  std::array<Interval, room> list_;  ///< those not near enough
  SatResult<3, S> result_;
};

/// Unset where they are none, or their axes too far from one another for it to be worth while. Witness points are the caller's to find
/// where there are none. `most`: see TiltedAxes::run.
template <class Difference, class Trace>
std::optional<OutlineDepth<3, typename Difference::S>> tilted_axes(Difference& difference, typename Difference::S tolerance, int most, Trace& trace) {
  using S = typename Difference::S;
  using V = Vector<3, S>;
  const auto pair = RevolvedPair<S>::of_tilted(difference);
  if (!pair) return std::nullopt;
  if constexpr (traced<Trace>) trace(SatBegan<V, Viewed>{0, 0, 0});
  TiltedAxes<Difference, Trace> outline(difference, *pair, trace);
  const SatResult<3, S> by_sections = outline.run(tolerance, most);
  OutlineDepth<3, S> found{by_sections, std::nullopt, outline.slack()};
  if (by_sections.status == SatStatus::overlapping)
    if (const auto bends = BentSum<S>::of(difference)) found = EllipsoidDepth(difference, *bends, outline_look(difference, trace)).sharpened(found, tolerance);
  if constexpr (traced<Trace>) trace(SatEnded<V, Viewed>{found.sat.iterations, found.sat.status, found.sat.normal, -static_cast<double>(found.sat.depth) - static_cast<double>(difference.radius())});
  return found;
}

}  // namespace gjkdbg
