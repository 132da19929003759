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

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "algo/vertices_pair.h"
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
  Matrix<D, S> rotation, inverse;  ///< inverse: the transpose
  Vector<D, S> position;
};

/// A pose in as many numbers as the dimension has.
template <int D>
struct PlacedAxes {
  Matrix<D, double> rotation;
  Vector<D, double> position;
  PlacedAxes(const Pose& pose) : rotation(pose.matrix), position(pose.position) {}  // implicit on purpose: the same thing
};

/// With x the bodies' positions, R their rotations and c the reference points, the position of body 1's reference
/// seen from body 0's is R0^T ((x1 - x0) + R1 c1 - R0 c0). The sum is taken in twice the precision, so that two
/// bodies far out lose nothing where they are near each other; the products with R0^T round like any support. `scale` is the one of the shapes.
template <int D, class S>
RelativePose<D, S> relative_pose(const PlacedAxes<D>& pose_a, const Vector<D, double>& reference_a, const PlacedAxes<D>& pose_b,
                                 const Vector<D, double>& reference_b, double scale) {
  using Two = DoubleDouble;
  Two offset[D];
  for (int i = 0; i < D; ++i) {
    const Two apart = Two::two_sum(pose_b.position[i], -pose_a.position[i]);  // a place far out, times the scale of tiny bodies, may be no number
    offset[i] = {apart.high * scale, apart.low * scale};
  }
  if (!is_zero(reference_a) || !is_zero(reference_b))  // once for all: one after the other they take a tenth of the instructions before the first support
    for (int j = 0; j < D; ++j) {
      if (reference_b[j] != 0)
        for (int i = 0; i < D; ++i) offset[i] = offset[i] + Two::two_product(pose_b.rotation(i, j), reference_b[j]);
      if (reference_a[j] != 0)
        for (int i = 0; i < D; ++i) offset[i] = offset[i] - Two::two_product(pose_a.rotation(i, j), reference_a[j]);
    }
  RelativePose<D, S> relative;
  for (int i = 0; i < D; ++i) {
    const auto axis = pose_a.rotation.col(i);
    for (int j = 0; j < D; ++j) relative.rotation(i, j) = relative.inverse(j, i) = static_cast<S>(axis.dot(pose_b.rotation.col(j)));
    double high = axis[0] * offset[0].high, low = axis[0] * offset[0].low;  // number by number, as they are written
    for (int k = 1; k < D; ++k) high += axis[k] * offset[k].high, low += axis[k] * offset[k].low;
    relative.position[i] = static_cast<S>(high + low);
  }
  return relative;
}

/// MinkowskiDifference::rounding_floor of bodies of these extents, added, with this square of p.
template <class S>
S rounding_floor_of(S extents, S squared) {
  constexpr int roundings = std::is_same_v<S, double> ? 20 : 16;
  return roundings * std::numeric_limits<S>::epsilon() / 2 * (extents + std::sqrt(squared));
}

/// A and B are anything with support(direction), reference(), center(), extent(), radius(), polytope() and vertices(), and for Newton's
/// directions add_support_derivative(…): Convex among them. SAT and projections look for core(), too.
template <int D_, class S_, class A, class B = A>
class MinkowskiDifference {
 public:
  static constexpr int D = D_;
  using S = S_;
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;

  /// Keeps references to the bodies.
  MinkowskiDifference(const A& a, const B& b, const PlacedAxes<D>& pose_a, const PlacedAxes<D>& pose_b, double scale)
      : MinkowskiDifference(a, b, [&] { return relative_pose<D, S>(pose_a, a.reference(), pose_b, b.reference(), scale); }) {}

  /// The point of A - B farthest along d (body 0's frame, any length). Counts.
  [[gnu::always_inline]] Point support(const V& d) {
    Point point;
    point.vertex = numbers_++;
    ++calls_;
#ifdef GJKDBG_AVX2
    if constexpr (D == 3 && sizeof(S) == 8)
      if (of_vertices_) {
        of_vertices_.support(pose_, d[0], d[1], d[2], point);
        return point;
      }
#endif
    support_of_each(d, point);
    return point;
  }

  /// How the support moves with d: b's moves with -d, and counts for -b.
  SupportDerivative<D, S> support_derivative(const V& d, const Point& point) const {
    SupportDerivative<D, S> sum;
    a_.add_support_derivative(Matrix<D, S>::Identity(), d, point.a, sum);
    b_.add_support_derivative(pose_.rotation, -d, point.b - pose_.position, sum);
    return sum;
  }

  /// A vertex of known points, each in its core's own frame. Does not count as a support.
  Point kept(const V& a, const V& b) {
    Point point;
    point.a = a, point.b = pose_.rotation * b + pose_.position;
    point.w = point.a - point.b;
    point.vertex = numbers_++;
    return point;
  }
  /// A point in body 0's frame, seen from body 1's core.
  V from_b(const V& b) const { return pose_.inverse * (b - pose_.position); }

  /// The difference of the same bodies with body 1 moved by an offset in body 0's frame.
  MinkowskiDifference moved(const V& offset) const {
    return MinkowskiDifference(a_, b_, [&] { return RelativePose<D, S>{pose_.rotation, pose_.inverse, pose_.position + offset}; });
  }
  /// A point inside: of a flat difference, in its plane.
  V center() const { return a_.center() - (pose_.rotation * b_.center() + pose_.position); }
  const Matrix<D, S>& rotation() const { return pose_.rotation; }  ///< body 1's axes in body 0's
  int support_calls() const { return calls_; }
  /// Heights along directions found without their points count like supports.
  void count_supports(int heights) { calls_ += heights; }
  const A& a() const { return a_; }
  const B& b() const { return b_; }
  /// Sum of the radii around the cores: the bodies' difference is the cores' plus a ball of this radius.
  S radius() const { return static_cast<S>(a_.radius() + b_.radius()); }
  S radius_a() const { return static_cast<S>(a_.radius()); }
  S radius_b() const { return static_cast<S>(b_.radius()); }
  bool polytope() const { return a_.polytope() && b_.polytope(); }
  /// Of the body with fewer; A - B has no fewer, for each of those is the support of some directions. 0: a body is round.
  int vertices() const { return std::min(a_.vertices(), b_.vertices()); }
  /// B's reference point, seen from A's.
  const V& position() const { return pose_.position; }
  /// A good first direction: from A's reference point towards B's, whatever its length; where they are one, any.
  V towards_b() const { return pose_.position.squaredNorm() > std::sqrt(std::numeric_limits<S>::min()) ? pose_.position : next_to_each_other(); }

  /// How far a computed support may be off, with u half an ulp of 1 and m = extent_a + extent_b + |p|: forming R b + p - a rounds 5 times, its
  /// product with a unit direction 5 times. An element of R is a sum of three products of the elements of two rotations: off by at most
  /// 3 u |R0|^T |R1|, which stretches nothing by more than (5/3)^2, so R b + p by at most 8.4 u m. In float, R and p come from double and are off
  /// by u each. No gap below this sum, rounded up, can be told from zero by one plane.
  S rounding_floor() const { return rounding_floor_; }

 private:
  /// All in one function (a tenth of the time of two boxes): a vector that a call returns is written number by number and read two at once,
  /// and a processor waits until such a write has reached the cache.
  [[gnu::flatten, gnu::noinline]] void support_of_each(const V& d, Point& point) const {
    point.a = a_.support(d);
    point.b.noalias() = pose_.rotation * b_.support(-(pose_.inverse * d));
    point.b += pose_.position;
    point.w = point.a - point.b;
  }

  /// A vector whose square vanishes has a direction all the same.
  [[gnu::noinline]] V next_to_each_other() const {
    const S most = pose_.position.cwiseAbs().maxCoeff();
    if (!(most > 0)) return V::Unit(0);
    const V longer = pose_.position / most;
    return longer / longer.norm();
  }

  /// Takes a function, so that the pose is written where it stays: copying what was just written number by number is what a processor waits for.
  template <class Pose>
    requires std::is_invocable_v<Pose>
  MinkowskiDifference(const A& a, const B& b, const Pose& pose) : a_(a), b_(b), of_vertices_(a, b), pose_(pose()) {
    S squared = 0;
    for (int i = 0; i < D; ++i) squared += pose_.position[i] * pose_.position[i];
    rounding_floor_ = rounding_floor_of(static_cast<S>(a.extent() + b.extent()), squared);
  }

  const A& a_;
  const B& b_;
  VerticesPair of_vertices_;
  const RelativePose<D, S> pose_;
  S rounding_floor_;
  int calls_ = 0, numbers_ = 0;
};

}  // namespace gjkdbg
