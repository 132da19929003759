// The least height of an outline, by arcs of directions between those that were looked along.
//
// Where n1, n2 touch a convex outline at w1, w2, no height between them is less than
//
//   max(n . w1, n . w2)   at its least: across w2 - w1, along -w1 or -w2, or at an end of the arc
//
// (EPA's bound in the plane, without its need of a polytope around the origin). The direction of the least of all these is the next to be looked along. An ellipse with half axes p <= q is
// the sum of a disc of radius p^2 / q, its sharpest bend, and a convex rest: the disc counts exactly, by its radius, and w1, w2 are those of the rest. So concentric balls are proven at once,
// and what is nearly a ball in a few steps.
//
// An outline may turn by s about u, out of the plane: bounded for all |s| <= width at once, where n . w changes by s n . rate + s^2 / 2 n . curve, but for s^2 / 2 rest (algo/tilted_axes.h). With c_i the most that
// takes off on the arc,
//
//   height >= max(n . w1 - c1, n . w2 - c2, n . p - c_p)   p = w1 + k (w2 - w1), rate_p = rate1 + k (rate2 - rate1)
//
// The third is for corners. Where two ends of an edge move the opposite way the edge turns, and its height need not change: with p the foot of the perpendicular from the origin to w1 w2, at the
// height h along its direction m, all of them are h cos(x) + max(d1 sin(x) - c1, -c_p) on w1's side, d1 from p, x away from m, where c_p grows by no more than sin(x) of all that moves, and the least is
// where the two meet, if not at the end. What c1 is more than c_p falls off with its square.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "shapes/vector.h"

namespace gjkdbg {

template <class S>
class OutlineArcs {
 public:
  using Flat = Vector<2, S>;
  /// What no height is less than, and the direction along which it is met, if anywhere.
  struct Least {
    S height;
    Flat towards;
    S lost;  ///< how much less that is than with the parameter at zero
  };

  /// How the height of a point changes with s.
  struct Move {
    Flat rate, curve;
    Move between(const Move& other, S share) const { return {rate + (other.rate - rate) * share, curve + (other.curve - curve) * share}; }
  };
  struct Turn {
    S width = 0, rest = 0;  ///< of s; of its square, what no point says
  };

  /// `bend`: radius of the discs.
  explicit OutlineArcs(S bend, const Turn& turn = {}) : bend_(bend), turn_(turn) {}

  bool knows(const Flat& n) const { return std::any_of(list_.begin(), list_.begin() + count_, [&](const Touch& touch) { return touch.n == n; }); }
  bool full() const { return count_ == room; }
  int count() const { return count_; }
  /// From -u to u.
  bool all_round() const { return list_[0].n[1] == -1 && list_[static_cast<std::size_t>(count_ - 1)].n[1] == 1; }
  const Least& least() const { return least_; }

  /// n, unit, touches the outline at w, its disc included; neighbours are less than half a turn from each other, or -u and u.
  void add(const Flat& n, const Flat& w, const Move& move = {Flat::Zero(), Flat::Zero()}) {
    int i = count_;
    while (i > 0 && !before(list_[at(i - 1)].n, n)) --i;
    for (int k = count_++; k > i; --k) list_[at(k)] = list_[at(k - 1)];
    list_[at(i)] = {n, w - n * bend_, move, {std::numeric_limits<S>::infinity(), n, 0}};
    if (i > 0) bound(list_[at(i - 1)], list_[at(i)]);
    if (i + 1 < count_) bound(list_[at(i)], list_[at(i + 1)]);
    least_ = list_[0].least;
    for (int k = 1; k + 1 < count_; ++k)
      if (list_[at(k)].least.height < least_.height) least_ = list_[at(k)].least;
  }

 private:
  struct Touch {
    Flat n, w;
    Move move;
    Least least;  ///< up to the next one
  };
  static constexpr int room = 128;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static S cross(const Flat& x, const Flat& y) { return x[0] * y[1] - x[1] * y[0]; }
  static bool before(const Flat& x, const Flat& y) { return cross(x, y) > 0 || (cross(x, y) == 0 && x[1] < y[1]); }  // -u and u are across one another as well

  /// The most that n . v comes to between two directions.
  static S most_towards(const Flat& v, const Flat& first, const Flat& second) {
    const bool within = cross(first, v) > 0 && cross(v, second) > 0;
    return within ? v.norm() : std::max(first.dot(v), second.dot(v));
  }

  void bound(Touch& first, const Touch& second) const {
    Least& least = first.least;
    least.height = std::numeric_limits<S>::infinity();
    const auto consider = [&](const Flat& n) {
      if (const S height = std::max(n.dot(first.w), n.dot(second.w)); height < least.height) least.height = height, least.towards = n;
    };
    const auto within = [&](const Flat& way) {
      const S length = way.stableNorm();
      if (!(length > 0)) return;
      const Flat n = way / length;
      if (cross(first.n, n) > 0 && cross(n, second.n) > 0) consider(n);
    };
    consider(first.n), consider(second.n);
    const Flat chord = second.w - first.w;
    within({chord[1], -chord[0]}), within(-first.w), within(-second.w);
    const S still = least.height;
    if (turn_.width > 0) least.height = turning(first, second, still);
    least.lost = still - least.height;
    least.height += bend_;
  }

  /// What a turn takes off at most, where n . rate and -n . curve are no more than these.
  S taken(S rate, S curve) const { return turn_.width * rate + turn_.width * turn_.width / 2 * (std::max(S(0), curve) + turn_.rest); }
  S taken_between(const Move& move, const Touch& first, const Touch& second) const {
    const S rate = std::max(most_towards(move.rate, first.n, second.n), most_towards(-move.rate, first.n, second.n));
    return taken(rate, most_towards(-move.curve, first.n, second.n));
  }

  /// As the bound, where the outline turns. `still`: if it did not.
  S turning(const Touch& first, const Touch& second, S still) const {
    const S c1 = taken_between(first.move, first, second), c2 = taken_between(second.move, first, second);
    const Flat chord = second.w - first.w;
    const S length = chord.norm();
    if (!(length > 0)) return still - std::max(c1, c2);
    const Flat along = chord / length, m(along[1], -along[0]);
    const S d1 = -along.dot(first.w), d2 = along.dot(second.w);
    if (!(cross(first.n, m) > 0 && cross(m, second.n) > 0 && d1 >= 0 && d2 >= 0)) return still - std::max(c1, c2);
    const S h = m.dot(first.w);
    const Move move = first.move.between(second.move, d1 / length);
    const S c = taken(std::abs(m.dot(move.rate)), -m.dot(move.curve)), all = turn_.width * (move.rate.norm() + turn_.width / 2 * move.curve.norm());
    const auto beside = [&](S c_end, S d, S sin_end, S cos_end) {
      const S apart = std::max(S(0), c_end - c);
      const bool meet = cos_end < 0 ? apart < d : apart < d * sin_end;
      const S sin = meet ? apart / d : cos_end < 0 ? S(1) : sin_end, cos = meet ? std::sqrt((1 - sin) * (1 + sin)) : cos_end;
      return std::min(h, h * cos) - c - all * sin;
    };
    return std::min({first.n.dot(first.w) - c1, second.n.dot(second.w) - c2, beside(c1, d1, cross(first.n, m), first.n.dot(m)), beside(c2, d2, cross(m, second.n), m.dot(second.n))});
  }

  const S bend_;
  const Turn turn_;
  std::array<Touch, room> list_;  ///< by their angles
  int count_ = 0;
  Least least_{std::numeric_limits<S>::infinity(), Flat::Zero(), 0};
};

}  // namespace gjkdbg
