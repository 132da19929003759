// The separating axis test of two boxes in the plane: 4 axes, and from the same numbers the nearest points.
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
#include <optional>

#include "algo/nearest_points.h"
#include "algo/sat.h"

namespace gjkdbg {

/// Two boxes in the plane. What is chosen is chosen by branches: what follows is a chain of few steps that would wait for every choice, and a branch lets it go ahead.
/// Nothing is an array that is read by a place: what a compiler writes number by number and reads two at once, a processor waits for, and that
/// took more time than all the rest.
template <class S>
class Rectangles {
 public:
  /// Place, in A's axes; whether they are apart, else `distance` is minus the depth.
  struct Points {
    S normal[2], a[2], b[2];  ///< from A's centre; b - a = distance * normal; normal unit, from A to B
    S distance, lower_bound;  ///< the latter of the separation, but for rounding
    bool apart;
    bool corner;  ///< a corner of the difference: no axis has the distance
    bool proven;  ///< by an axis, or the plane across the corner
  };

  /// Half sizes, none of them zero; of B's turn the first column; p, from A's centre to B's, in A's axes.
  [[gnu::always_inline]] Rectangles(const Vector<2, S>& half_a, const Vector<2, S>& half_b, S cosine, S sine, S x, S y) : a0_(half_a[0]), a1_(half_a[1]), p0_(x), p1_(y) {
    const bool turned = (cosine < 0) != (sine < 0);
    cos_ = std::abs(turned ? sine : cosine), sin_ = std::abs(turned ? cosine : sine);
    b0_ = turned ? half_b[1] : half_b[0], b1_ = turned ? half_b[0] : half_b[1];
    q0_ = cos_ * p0_ + sin_ * p1_, q1_ = cos_ * p1_ - sin_ * p0_;
  }

  /// One of the four edges towards p, by its place in the table.
  struct Edge {
    S tx, ty;      ///< along it
    S side;        ///< 1 or -1: sign(n . p)
    S apart;       ///< the separation along its normal
    S on, beyond;  ///< of its points the nearest to p, from its middle; what of p's place along it lies beyond its end
    S ax, ay;      ///< A's part of that point

    S nearness() const { return apart * apart + beyond * beyond; }
    S nx() const { return -ty * side; }
    S ny() const { return tx * side; }
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

  /// The nearest points or, where no axis has more than `floor` between, the least overlap's.
  [[gnu::always_inline]] Points points(S floor) const {
    const Edge e0 = edge<0>(), e1 = edge<1>(), e2 = edge<2>(), e3 = edge<3>();
    const S most = std::max(std::max(e0.apart, e1.apart), std::max(e2.apart, e3.apart));
    Points found;
    found.apart = most > floor;
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
    found.corner = found.apart && best.beyond != 0;
    found.normal[0] = best.nx() + 0, found.normal[1] = best.ny() + 0;  // no negative zero
    found.distance = found.lower_bound = best.apart;
    found.proven = found.apart ? most - best.apart <= floor : std::abs(best.beyond) <= floor;
    S x = best.nx() * best.apart, y = best.ny() * best.apart;
    if (found.corner) {
      x += best.tx * best.beyond, y += best.ty * best.beyond;
      found.distance = std::sqrt(best.nearness());
      found.normal[0] = x / found.distance, found.normal[1] = y / found.distance;
      found.lower_bound = std::max(most, plane(found.normal[0], found.normal[1]));
      found.proven = found.distance - found.lower_bound <= 2 * floor;
    }
    found.a[0] = best.ax, found.a[1] = best.ay;
    found.b[0] = best.ax + x, found.b[1] = best.ay + y;
    return found;
  }

  /// Any of the edges.
  Edge operator[](int k) const { return k == 0 ? edge<0>() : k == 1 ? edge<1>() : k == 2 ? edge<2>() : edge<3>(); }

 private:
  /// How far apart they are along a unit direction.
  S plane(S x, S y) const { return x * p0_ + y * p1_ - (a0_ * std::abs(x) + a1_ * std::abs(y) + b0_ * std::abs(cos_ * x + sin_ * y) + b1_ * std::abs(cos_ * y - sin_ * x)); }

  const S a0_, a1_;
  S b0_, b1_, cos_, sin_;  ///< half sizes; R's cosine and sine
  const S p0_, p1_;        ///< in A's axes
  S q0_, q1_;              ///< p in B's (those of R)
};

template <class Difference, class Trace>
class RectangleSat {
  using S = typename Difference::S;
  using V = Vector<2, S>;

 public:
  /// No side is zero. Keeps references.
  RectangleSat(Difference& difference, const BoxCore<2, S>& a, const BoxCore<2, S>& b, Trace& trace)
      : difference_(difference), trace_(trace), floor_(difference.rounding_floor()), center_(a.center()), pair_(pair_of(difference, a, b, center_)) {}

  /// `enough`: the separation that needs no more, >= 0; infinite where the distance is asked for.
  const SatResult<2, S>& run(S enough) {
    trace_(SatBegan<V, Viewed>{2, 2, 0});
    const int widest = widest_axis(enough + floor_);
    if constexpr (!traced<Trace>) difference_.count_supports(result_.iterations);  // an axis is a support of which only the height is wanted
    const S separation = pair_[widest].apart;
    result_.status = separation > floor_ ? SatStatus::separated : SatStatus::overlapping;
    result_.normal = normal(pair_[widest]);
    result_.depth = S(0) - separation;
    if (separation <= enough && (separation > floor_ || std::isinf(enough))) find_points();
    trace_(SatEnded<V, Viewed>{result_.iterations, result_.status, result_.normal, static_cast<double>(-result_.depth) - static_cast<double>(difference_.radius())});
    return result_;
  }

  /// Of boxes that overlap. Unset where rounding has the last word.
  const std::optional<SatWitnesses<2, S>>& witnesses() const { return witnesses_; }
  /// Of boxes that are apart, but by no more than enough. Unset where it is not proven.
  const std::optional<NearestPoints<2, S>>& gap() const { return gap_; }

 private:
  static Rectangles<S> pair_of(const Difference& difference, const BoxCore<2, S>& a, const BoxCore<2, S>& b, const V& center) {
    const V between = difference.position() + difference.rotation() * b.center() - center;
    return {a.half(), b.half(), difference.rotation()(0, 0), difference.rotation()(1, 0), between[0], between[1]};
  }

  /// One axis after the other, A's first, until one says enough.
  int widest_axis(S enough) {
    int widest = 2;
    for (const int edge : {2, 0, 3, 1}) {
      if (pair_[edge].apart > pair_[widest].apart) widest = edge;
      ++result_.iterations;
      if constexpr (traced<Trace>) trace_axis(edge, pair_[widest].apart);
      if (pair_[edge].apart > enough) break;
    }
    return widest;
  }

  /// In a trace the support is asked for in full.
  void trace_axis(int edge, S widest) {
    const V n = normal(pair_[edge]);
    const auto point = difference_.support(n);
    const double radius = static_cast<double>(difference_.radius());
    trace_(SupportQueried<V, Viewed>{result_.iterations, Phase::sat, n, point.vertex, point.a, point.b, point.w});
    trace_(AxisTested<V, Viewed>{result_.iterations, edge % 2 == 0 ? AxisSource::face_a : AxisSource::face_b, point.vertex, n, static_cast<double>(pair_[edge].apart) - radius,
                                 static_cast<double>(widest - floor_) - radius, std::numeric_limits<double>::quiet_NaN()});
  }

  static V normal(const typename Rectangles<S>::Edge& e) { return V(e.nx() + 0, e.ny() + 0); }

  void find_points() {
    const auto found = pair_.points(floor_);
    const V a = center_ + V(found.a), b = center_ + V(found.b), n(found.normal);
    result_.iterations += found.corner;
    if constexpr (traced<Trace>) {
      const double radius = static_cast<double>(difference_.radius());
      if (found.corner)
        trace_(PointsProjected<V, Viewed>{result_.iterations, a, b, V(a - b), static_cast<double>(found.lower_bound - floor_) - radius, static_cast<double>(found.distance + floor_) - radius});
    }
    if (!found.proven) return;
    result_.normal = n, result_.depth = S(0) - found.distance;
    if (found.apart) gap_ = NearestPoints<2, S>{a, b, n, found.distance, found.lower_bound - floor_};
    else witnesses_ = SatWitnesses<2, S>{a, b};
  }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const V center_;  ///< A's
  const Rectangles<S> pair_;
  SatResult<2, S> result_;
  std::optional<SatWitnesses<2, S>> witnesses_;
  std::optional<NearestPoints<2, S>> gap_;
};

}  // namespace gjkdbg
