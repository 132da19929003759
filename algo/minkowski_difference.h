// The Minkowski difference of two placed convex sets, and the conventions everything else relies on:
//
//   w = a - b            a vertex of the difference: a of body 0, b of body 1
//   support(d)           = support_A(d) - support_B(-d): the point of A - B farthest along d
//   signed distance      > 0 a gap, 0 touching, < 0 minus the penetration depth
//   normal n             unit, from body 0 towards body 1; moving body 1 by depth * n just separates the bodies
//   witnesses            points a, b on the bodies with b - a = signed distance * n
//
// The bodies overlap iff A - B holds the origin. Its point closest to the origin, v = a - b, gives distance |v|
// and n = -v / |v|; when the origin is inside, the nearest boundary point v gives depth |v| and n = v / |v|.
//
// Everything is computed in the axes of body 0, with the reference point of its core as origin: distance from the
// world's origin costs no accuracy.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "shapes/convex.h"
#include "shapes/double_double.h"
#include "shapes/pose.h"

namespace gjkdbg {

/// A vertex of the difference and where it came from. `vertex` is its number in the trace.
template <int D, class S>
struct SupportPoint {
  Vector<D, S> w, a, b;
  int vertex = -1;
};

/// Body 1 seen from body 0: b_0 = rotation * b_1 + position, both about the reference points of their cores.
template <int D, class S>
struct RelativePose {
  Matrix<D, S> rotation = Matrix<D, S>::Identity();
  Vector<D, S> position = Vector<D, S>::Zero();
};

/// With x the bodies' positions, R their rotations and c the reference points, the position of body 1's reference
/// seen from body 0's is R0^T ((x1 - x0) + R1 c1 - R0 c0). The sum is taken in twice the precision, so that two
/// bodies far out lose nothing where they are near each other. `scale` is the one of the shapes.
template <int D, class S>
RelativePose<D, S> relative_pose(const Pose& pose_a, const Vector<D, double>& reference_a, const Pose& pose_b,
                                 const Vector<D, double>& reference_b, double scale) {
  using Two = DoubleDouble;
  Two offset[D];
  for (int i = 0; i < D; ++i) {
    offset[i] = Two::two_sum(pose_b.position[i] * scale, -(pose_a.position[i] * scale));
    for (int j = 0; j < D; ++j) {
      if (reference_b[j] != 0) offset[i] = offset[i] + Two::two_product(pose_b.matrix(i, j), reference_b[j]);
      if (reference_a[j] != 0) offset[i] = offset[i] - Two::two_product(pose_a.matrix(i, j), reference_a[j]);
    }
  }
  // Scalar products in twice the precision (Dot2 of Ogita, Rump, Oishi 2005); what goes into many products is split once. Each row is
  // (row i of R0^T) times [R1 | offset]: D + 1 sums side by side.
  using Row = Eigen::Array<double, D + 1, 1>;
  const auto high_part = [](const Row& x) -> Row { const Row big = x * 134217729.0; return big - (big - x); };  // DoubleDouble::split
  std::array<Row, D> right, right_high, right_low, tail;  // tail: what `right` leaves out
  for (int k = 0; k < D; ++k) {
    for (int j = 0; j < D; ++j) right[k][j] = pose_b.matrix(k, j);
    right[k][D] = offset[k].high;
    tail[k] = Row::Zero(), tail[k][D] = offset[k].low;
    right_high[k] = high_part(right[k]), right_low[k] = right[k] - right_high[k];
  }
  RelativePose<D, S> relative;
  for (int i = 0; i < D; ++i) {
    Row sum = Row::Zero(), rest = Row::Zero();
    for (int k = 0; k < D; ++k) {
      const double left = pose_a.matrix(k, i);
      const Two halves = Two::split(left);
      const Row product = left * right[k];
      const Row error = ((halves.high * right_high[k] - product) + halves.high * right_low[k] + halves.low * right_high[k]) + halves.low * right_low[k];
      const Row total = sum + product, part = total - sum;
      rest += ((sum - (total - part)) + (product - part)) + error + left * tail[k];
      sum = total;
    }
    const Row rounded = sum + rest;
    for (int j = 0; j < D; ++j) relative.rotation(i, j) = static_cast<S>(rounded[j]);
    relative.position[i] = static_cast<S>(rounded[D]);
  }
  return relative;
}

/// A and B are anything with support(direction, hint), extent(), radius() and polytope(), Convex among them.
template <int D_, class S_, class A, class B = A>
class MinkowskiDifference {
 public:
  static constexpr int D = D_;
  using S = S_;
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;

  /// Keeps references to the bodies.
  MinkowskiDifference(const A& a, const B& b, const RelativePose<D, S>& pose)
      : a_(a), b_(b), rotation_(pose.rotation), inverse_(pose.rotation.transpose()), position_(pose.position) {
    const S magnitude = static_cast<S>(a.extent() + b.extent()) + position_.norm();
    rounding_floor_ = 16 * std::numeric_limits<S>::epsilon() / 2 * magnitude;
  }

  /// The point of A - B farthest along d (body 0's frame, any length). Counts.
  Point support(const V& d) {
    Point point;
    point.a = a_.support(d, hint_a_);
    point.b.noalias() = rotation_ * b_.support(-(inverse_ * d), hint_b_);
    point.b += position_;
    point.w = point.a - point.b;
    point.vertex = calls_++;
    return point;
  }

  /// The difference of the same bodies with body 1 moved by an offset in body 0's frame.
  MinkowskiDifference moved(const V& offset) const { return MinkowskiDifference(a_, b_, {rotation_, position_ + offset}); }
  /// A point inside: of a flat difference, in its plane.
  V center() const { return a_.center() - (rotation_ * b_.center() + position_); }
  const Matrix<D, S>& rotation() const { return rotation_; }  ///< body 1's axes in body 0's
  int support_calls() const { return calls_; }
  /// Sum of the radii around the cores: the bodies' difference is the cores' plus a ball of this radius.
  S radius() const { return static_cast<S>(a_.radius() + b_.radius()); }
  S radius_a() const { return static_cast<S>(a_.radius()); }
  S radius_b() const { return static_cast<S>(b_.radius()); }
  bool polytope() const { return a_.polytope() && b_.polytope(); }
  /// From A's reference point towards B's: a good first direction.
  const V& position() const { return position_; }

  /// How far a computed support may be off: forming R b + p and a - b rounds at most 7 times, each by half an ulp of at
  /// most extent_a + extent_b + |p|; taking its product with a unit direction rounds 5 times more. 16 u of that
  /// magnitude covers both. No gap below this can be told from zero by one plane.
  S rounding_floor() const { return rounding_floor_; }

 private:
  const A& a_;
  const B& b_;
  Matrix<D, S> rotation_, inverse_;
  V position_;
  S rounding_floor_;
  int hint_a_ = 0, hint_b_ = 0;
  int calls_ = 0;
};

}  // namespace gjkdbg
