// The difference of two boxes in the plane: the separation along its 4 axes, and from the same numbers the nearest points.
//
// With half sizes a, b and R the turn of B, the difference A - B is, about its centre, the sum of four segments (a zonotope)
//
//   [-1, 1] a_0 e_0 + [-1, 1] a_1 e_1 + [-1, 1] b_0 R_0 + [-1, 1] b_1 R_1
//
// and p, from A's centre to B's, is as far from it as the bodies are apart. A quarter turn of B with b_0, b_1 exchanged is the same box, and so is a half turn: so R
// is a turn by 0 to 90 degrees, with C, S >= 0 its cosine and sine. Then e_0, R_0, e_1, R_1 stand in this order, counter-clockwise, and on the outline the edges
// come in it, too: around the half of it from one corner to the opposite one each segment is an edge once, those before it at one end, those behind at the other.
//
//   edge along  normal  middle M of the edge            height n . M = h           place t . M
//   e_0         e_1     b_0 R_0 + a_1 e_1 + b_1 R_1      a_1 + b_0 S + b_1 C        b_0 C - b_1 S
//   R_0         R_1     -a_0 e_0 + a_1 e_1 + b_1 R_1     b_1 + a_0 S + a_1 C        a_1 S - a_0 C
//   e_1         -e_0    -a_0 e_0 - b_0 R_0 + b_1 R_1     a_0 + b_0 C + b_1 S        b_1 C - b_0 S
//   R_1         -R_0    -a_0 e_0 - b_0 R_0 - a_1 e_1     b_0 + a_0 C + a_1 S        a_0 S - a_1 C
//
// The opposite edges are these through the centre: of each two the one towards p counts, sign(n . p) M. Beyond its line p lies |n . p| - h, the separation along
// the axis, and beyond its ends what is left of t . p - sign t . M. The depth is the least overlap, as in algo/sat.h. Of bodies that are apart the nearest point of the
// outline lies on an edge that faces p; so the least distance from the four edges is the distance. Where that is a corner, the plane across proves it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/nearest_points.h"
#include "algo/trace.h"

namespace gjkdbg {

/// Two boxes in the plane. What is chosen is chosen by branches: what follows is a chain of few steps that would wait for every choice, and a branch lets it go ahead.
/// Nothing is an array that is read by a place: what a compiler writes number by number and reads two at once, a processor waits for, and that
/// took more time than all the rest.
template <class S>
class Rectangles {
 public:
  static constexpr int axes = 4;  ///< A's edges, then B's

  /// Half sizes, none of them zero; `turn(i, j)` an element of B's turn; p, from A's centre to B's, in A's axes.
  template <class Turn>
  [[gnu::always_inline]] Rectangles(const Vector<2, S>& half_a, const Vector<2, S>& half_b, const Turn& turn, S x, S y) : a0_(half_a[0]), a1_(half_a[1]), p0_(x), p1_(y) {
    const S cosine = turn(0, 0), sine = turn(1, 0);
    const bool turned = (cosine < 0) != (sine < 0);
    cos_ = std::abs(turned ? sine : cosine), sin_ = std::abs(turned ? cosine : sine);
    b0_ = turned ? half_b[1] : half_b[0], b1_ = turned ? half_b[0] : half_b[1];
    q0_ = cos_ * p0_ + sin_ * p1_, q1_ = cos_ * p1_ - sin_ * p0_;
  }

  template <int>
  bool is_axis() const { return true; }
  /// How far apart the bodies are along an axis.
  template <int k>
  S separation() const { return edge<edges[k]>().apart; }
  /// Unit, towards B.
  template <int k>
  Vector<2, S> normal() const { return edge<edges[k]>().normal(); }
  static AxisSource source(int k) { return k < 2 ? AxisSource::face_a : AxisSource::face_b; }

  /// The nearest points or, where no axis has more than `floor` between, those of the least overlap.
  [[gnu::always_inline]] BoxPoints<2, S> points(S floor) const {
    const Edge e0 = edge<0>(), e1 = edge<1>(), e2 = edge<2>(), e3 = edge<3>();
    const S most = std::max(std::max(e0.apart, e1.apart), std::max(e2.apart, e3.apart));
    BoxPoints<2, S> found;
    found.axes = axes, found.apart = most > floor;
    Edge best = e0;
    if (found.apart) {
      if (e1.nearness() < best.nearness()) best = e1;
      if (e2.nearness() < best.nearness()) best = e2;
      if (e3.nearness() < best.nearness()) best = e3;
    } else {
      // Of parallel edges on one line, which are as far off, the one p is beside.
      S least = std::numeric_limits<S>::infinity();
      for (const Edge& e : {e0, e1, e2, e3})
        if (e.apart >= most - floor && std::abs(e.beyond) < least) best = e, least = std::abs(e.beyond);
    }
    found.corner = found.apart && std::abs(best.beyond) > floor;
    found.normal = best.normal();
    found.distance = found.lower_bound = best.apart;
    found.proven = found.apart ? most - best.apart <= floor : std::abs(best.beyond) <= floor;
    S x = best.nx() * best.apart, y = best.ny() * best.apart;
    if (found.corner) {
      x += best.tx * best.beyond, y += best.ty * best.beyond;
      found.distance = std::sqrt(best.nearness());
      found.normal[0] = x / found.distance, found.normal[1] = y / found.distance;
      const S across = plane(found.normal[0], found.normal[1]);
      found.lower_bound = std::max(most, across);
      found.proven = found.distance - across <= 2 * floor;
    }
    found.a[0] = best.ax, found.a[1] = best.ay;
    found.b[0] = best.ax + x, found.b[1] = best.ay + y;
    return found;
  }

 private:
  static constexpr int edges[axes] = {2, 0, 3, 1};  ///< by their places in the table

  /// One of the four edges towards p.
  struct Edge {
    S tx, ty;      ///< along it
    S side;        ///< 1 or -1: sign(n . p)
    S apart;       ///< the separation along its normal
    S on, beyond;  ///< of its points the nearest to p, from its middle; what of p's place along it lies beyond its end
    S ax, ay;      ///< A's part of that point

    S nearness() const { return apart * apart + beyond * beyond; }
    S nx() const { return -ty * side; }
    S ny() const { return tx * side; }
    Vector<2, S> normal() const { return {nx() + 0, ny() + 0}; }  // no negative zero
  };
  template <int k>
  [[gnu::always_inline]] Edge edge() const {
    Edge e;
    e.tx = k == 0 ? 1 : k == 1 ? cos_ : k == 2 ? 0 : -sin_, e.ty = k == 0 ? 0 : k == 1 ? sin_ : k == 2 ? 1 : cos_;
    const S across = k == 0 ? p1_ : k == 1 ? q1_ : k == 2 ? -p0_ : -q0_, along = k == 0 ? p0_ : k == 1 ? q0_ : k == 2 ? p1_ : q1_, reach = k == 0 ? a0_ : k == 1 ? b0_ : k == 2 ? a1_ : b1_;
    const S height = k == 0 ? a1_ + b0_ * sin_ + b1_ * cos_ : k == 1 ? b1_ + a0_ * sin_ + a1_ * cos_ : k == 2 ? a0_ + b0_ * cos_ + b1_ * sin_ : b0_ + a0_ * cos_ + a1_ * sin_;
    const S middle = k == 0 ? b0_ * cos_ - b1_ * sin_ : k == 1 ? a1_ * sin_ - a0_ * cos_ : k == 2 ? b1_ * cos_ - b0_ * sin_ : a0_ * sin_ - a1_ * cos_;
    e.side = across < 0 ? -1 : 1;
    e.apart = std::abs(across) - height;
    const S whole = along - (across < 0 ? -middle : middle);
    e.on = std::min(std::max(whole, -reach), reach);
    e.beyond = whole - e.on;
    e.ax = k == 0 ? e.on : -e.side * a0_, e.ay = k == 2 ? e.on : k == 3 ? -e.side * a1_ : e.side * a1_;
    return e;
  }

  /// How far apart they are along a unit direction.
  S plane(S x, S y) const { return x * p0_ + y * p1_ - (a0_ * std::abs(x) + a1_ * std::abs(y) + b0_ * std::abs(cos_ * x + sin_ * y) + b1_ * std::abs(cos_ * y - sin_ * x)); }

  const S a0_, a1_;
  S b0_, b1_, cos_, sin_;  ///< half sizes; R's cosine and sine
  const S p0_, p1_;        ///< in A's axes
  S q0_, q1_;              ///< p in B's (those of R)
};

}  // namespace gjkdbg
