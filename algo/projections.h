// Alternating projections by Newton's method: the distance of shapes whose nearest points have a formula.
//
// From a point x, b = P_B(x) is the point of B nearest to it, and a = P_A(b) that of A nearest to b. |a - b| falls from round to round, and where
// a = x, a and b are the nearest points of the bodies (Cheney, Goldstein, "Proximity maps for convex sets", 1959, theorem 2). The rounds alone creep where
// the bodies are flat or near. But it is known how the projections move (shapes/projections.h), and with g(x) = a - x and its derivative Jacobian
// J_A J_B - I, Newton's step d solves (I - J_A J_B) d = g. With J_A = T K T^T, J_B = U L U^T and C = U^T T, it is d = g + T y,
//
//   (I - K C^T L C) y = K C^T L U^T g        two equations in space, one in the plane
//
// Between bodies that nearly touch, g is the gap times the angle between x - b and the normal, so the root of g is nearly a triple one, and the steps come
// short of it. Hence g / |x - b| is brought to zero instead: its derivative has g w^T, w = (x - b) / |x - b|^2, in addition, and by the formula of
// Sherman and Morrison that divides the step by 1 + w . d.
//
// Features are told apart by the projections themselves, so a few steps find them and the last ones converge quadratically, on faces, edges
// and round surfaces alike. A step after which a and b are farther apart than before is taken back: less of it is tried, none at last. What proves the answer is
// the plane across a - b, with a support mapping, as in GJK. Where it does not (the bodies overlap, or rounding speaks), GJK goes on.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/minkowski_difference.h"
#include "algo/nearest_points.h"
#include "algo/trace.h"
#include "shapes/projections.h"

namespace gjkdbg {

template <int D, class S>
struct ProjectionsResult {
  ProjectionsStatus status = ProjectionsStatus::undecided;
  int iterations = 0;
  NearestPoints<D, S> nearest;  ///< valid when separated, of a yes or no without its normal; when overlapping, b is a point of both cores
};

template <class Difference, class Trace>
class Projections {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;

 public:
  /// Both bodies must be `projectable`. Keeps references.
  Projections(Difference& difference, S tolerance, int max_iterations, Trace& trace)
      : difference_(difference), trace_(trace), tolerance_(tolerance), most_rounds_(std::min(max_iterations, 24)), floor_(difference.rounding_floor()), reach_(static_cast<S>(difference.a().extent() + difference.b().extent())) {}

  /// `enough`: for a yes or no the sum of the radii: only whether the cores are farther apart is decided. Infinite where the distance itself is wanted.
  ProjectionsResult<D, S> run(S enough) {
    x_ = difference_.a().center();
    trace_(ProjectionsBegan<V, Viewed>{x_});
    result_.status = search(enough);
    result_.nearest.a = a_, result_.nearest.b = b_, result_.nearest.lower_bound = lower_;
    trace_(ProjectionsEnded<V, Viewed>{result_.iterations, result_.status, lower_bound(), upper_bound()});
    return result_;
  }

 private:
  ProjectionsStatus search(S enough) {
    const bool yes_or_no = std::isfinite(enough);
    while (result_.iterations < most_rounds_) {
      ++result_.iterations;
      project();
      const V v = a_ - b_;
      const S squared = v.dot(v), distance = std::sqrt(squared);
      const bool nearer = distance <= least_ + floor_;
      if (nearer) least_ = std::min(least_, distance), nearest_ = a_;
      if constexpr (traced<Trace>) trace_(PointsProjected<V, Viewed>{result_.iterations, a_, b_, v, lower_bound(), upper_bound()});
      // b is of both. Or what is thinner than the numbers reach has led beyond them: of what is no number nothing says that it is outside.
      if (on_a_.inside) return std::isnan(distance) ? ProjectionsStatus::undecided : ProjectionsStatus::overlapping;
      if (!(distance > floor_)) return ProjectionsStatus::undecided;
      if (!nearer) {
        if (!take_back()) return ProjectionsStatus::undecided;
        continue;
      }
      result_.nearest.distance = distance;
      if (yes_or_no && distance + floor_ <= enough) return ProjectionsStatus::separated;  // of the cores, that is: the radii meet
      if (on_b_.inside) {  // from b to a and on, without a step
        x_ = a_, share_ = 0, predicted();
        continue;
      }
      const V g = a_ - x_;
      const S moved = g.dot(g);
      // The plane across v leans by about |g| / |v| against the farthest one; that counts by the size of the bodies where these have edges.
      const bool worth_asking = result_.iterations > 1 && moved * reach_ * reach_ <= 4 * tolerance_ * squared * squared + floor_ * floor_;
      // Of a yes or no, where so much leaning leaves it room beyond the radii.
      const bool may_tell = yes_or_no && moved * reach_ * reach_ <= 16 * (distance - enough) * (distance - enough) * squared;
      if (worth_asking || may_tell) {
        const V upright = upright_way(v);
        const S height = plane(upright, upright.norm());
        lower_ = std::max(lower_, height - floor_);
        // A yes or no that is open between these bounds is not decided by the nearer of them.
        const S radius = difference_.radius(), share = yes_or_no || (radius > 0 && lower_ <= radius && distance + floor_ > radius) ? S(0) : tolerance_;
        const S gap = share * distance + floor_;
        if (lower_ > enough || (distance - height <= gap && (yes_or_no || normal_proves(v, distance, upright, gap)))) return ProjectionsStatus::separated;
        if (moved <= floor_ * floor_) return ProjectionsStatus::undecided;
      }
      step(g);
    }
    return ProjectionsStatus::undecided;
  }

  void project() {
    const V seen = difference_.from_b(x_);
    project_onto(difference_.b(), seen, start_b_, on_b_);
    b_.noalias() = difference_.rotation() * on_b_.point;
    b_ += difference_.position();
    project_onto(difference_.a(), b_, start_a_, on_a_);
    a_ = on_a_.point;
  }

  /// From the nearest point of a straight line the way leads off at a right angle. However short it is and whatever rounding made of it, it is brought back
  /// to that, or its plane would cut off the line's far end. v itself where it leads along a line, far from the answer.
  V upright_way(const V& v) const {
    std::array<V, 4> lines;
    int count = 0;
    for (int i = 0; i < std::min(on_a_.flat, D - 1); ++i) lines[count++] = on_a_.tangent[i];
    for (int i = 0; i < std::min(on_b_.flat, D - 1); ++i) lines[count++] = difference_.rotation() * on_b_.tangent[i];
    if (count == 0) return v;
    V upright = v - lines[0] * (lines[0].dot(v) / lines[0].dot(lines[0]));
    if constexpr (D == 3) {
      for (int i = 1; i < count; ++i) {
        const V across = lines[0].cross(lines[i]);
        const S squared = across.dot(across);
        if (!(squared > S(1e-6) * lines[0].dot(lines[0]) * lines[i].dot(lines[i]))) continue;
        upright = across * (across.dot(v) / squared);
        break;
      }
    }
    return upright.dot(upright) > S(0.5) * v.dot(v) ? upright : v;
  }

  /// The plane across `upright` proves the distance to the tolerance t, and leans by sqrt(2 t) against v at most: too far for the points, which lie along v. Theirs is the normal, unless rounding is all
  /// that v has more; then its own plane must prove as much. It does where it leans too little to count over the bodies' length.
  bool normal_proves(const V& v, S distance, const V& upright, S gap) {
    const S aside = (v - upright).norm();
    if (aside <= floor_) return result_.nearest.normal = -upright / upright.norm(), true;
    result_.nearest.normal = -v / distance;
    return aside * reach_ <= gap * distance || distance - plane(v, distance) <= gap;
  }

  S plane(const V& v, S distance) {
    const auto point = difference_.support(V(-v));
    if constexpr (traced<Trace>)
      trace_(SupportQueried<V, Viewed>{result_.iterations, Phase::projections, V(-v), point.vertex, point.a, point.b, point.w});
    return v.dot(point.w) / distance;
  }

  void step(const V& g) {
    from_ = x_, step_ = newton(g), share_ = 1;
    if (!step_.allFinite()) step_ = g;  // of needles whose squares are beyond the numbers
    if (const S squared = step_.dot(step_); squared > reach_ * reach_) step_ *= reach_ / std::sqrt(squared);  // no body is that long
    if (result_.iterations > 1) {  // the first x is somewhere inside A
      const V apart = x_ - b_;
      const S nearer = apart.dot(step_) / apart.dot(apart);
      if (nearer < 0) share_ = 1 / std::max(1 + nearer, S(0.2));
    }
    go();
  }

  /// Less of the step that led away; none at last. False: that has been tried.
  bool take_back() {
    if (share_ == 0) return false;
    share_ = share_ > S(1.1) ? S(1) : share_ > S(0.1) ? share_ / 4 : S(0);
    if (share_ > 0) go();
    else x_ = nearest_, predicted();
    return true;
  }

  /// So far along a tangent that it may have come through to B: then back to A.
  void go() {
    const V way = share_ * step_;
    x_ = from_ + way;
    if (result_.iterations > 1 && way.dot(way) > S(0.02) * least_ * reach_) {
      project_onto(difference_.a(), x_, start_a_, on_a_);
      x_ = on_a_.point;
    }
    predicted();
  }

  void predicted() {
    if constexpr (traced<Trace>) trace_(PointPredicted<V, Viewed>{result_.iterations, x_});
  }

  /// See above; where the bodies are flat and parallel, the matrix is singular but for a little, and g has nothing in that direction.
  V newton(const V& g) const {
    constexpr S one = 1 + 4096 * std::numeric_limits<S>::epsilon();
    if constexpr (D == 3) {
      const V u0 = difference_.rotation() * on_b_.tangent[0], u1 = difference_.rotation() * on_b_.tangent[1];
      const V &t0 = on_a_.tangent[0], &t1 = on_a_.tangent[1];
      const S l00 = on_b_.k00, l01 = on_b_.k01, l11 = on_b_.k11, k00 = on_a_.k00, k01 = on_a_.k01, k11 = on_a_.k11;
      const S c00 = u0.dot(t0), c01 = u0.dot(t1), c10 = u1.dot(t0), c11 = u1.dot(t1), g0 = u0.dot(g), g1 = u1.dot(g);
      const S lc00 = l00 * c00 + l01 * c10, lc01 = l00 * c01 + l01 * c11, lc10 = l01 * c00 + l11 * c10, lc11 = l01 * c01 + l11 * c11;
      const S lg0 = l00 * g0 + l01 * g1, lg1 = l01 * g0 + l11 * g1;
      const S s00 = c00 * lc00 + c10 * lc10, s01 = c00 * lc01 + c10 * lc11, s11 = c01 * lc01 + c11 * lc11;  // C^T L C
      const S h0 = c00 * lg0 + c10 * lg1, h1 = c01 * lg0 + c11 * lg1;
      const S m00 = one - (k00 * s00 + k01 * s01), m01 = -(k00 * s01 + k01 * s11), m10 = -(k01 * s00 + k11 * s01), m11 = one - (k01 * s01 + k11 * s11);
      const S r0 = k00 * h0 + k01 * h1, r1 = k01 * h0 + k11 * h1, inverse = 1 / (m00 * m11 - m01 * m10);
      return g + (r0 * m11 - r1 * m01) * inverse * t0 + (r1 * m00 - r0 * m10) * inverse * t1;
    } else if constexpr (D == 2) {
      const V u = difference_.rotation() * on_b_.tangent[0];
      const V& t = on_a_.tangent[0];
      const S c = u.dot(t), k = on_a_.k00 * c * on_b_.k00;
      return g + k * u.dot(g) / (one - k * c) * t;
    } else {
      return g;
    }
  }

  /// Of the bodies' signed distance, so far.
  double lower_bound() const { return static_cast<double>(lower_) - static_cast<double>(difference_.radius()); }
  double upper_bound() const { return static_cast<double>(least_ + floor_) - static_cast<double>(difference_.radius()); }

  Difference& difference_;
  Trace& trace_;
  const S tolerance_;
  const int most_rounds_;  ///< beyond these GJK is faster
  const S floor_, reach_;
  ProjectionsResult<D, S> result_;
  ProjectionStart<S> start_a_, start_b_;
  Projection<D, S> on_a_, on_b_;
  V x_, a_, b_;
  V nearest_;          ///< the best a so far
  V from_, step_;      ///< the last of Newton's steps
  S share_ = 0;        ///< how much of it was made
  S least_ = std::numeric_limits<S>::infinity(), lower_ = -std::numeric_limits<S>::infinity();
};

}  // namespace gjkdbg
