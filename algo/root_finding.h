// Root finding for bodies that turn: for how long a normal goes on separating them (Mirtich 1996; Catto, "Continuous collision", GDC 2013).
//
// Between points a of A and b of B, the gap along a normal is n . (b - a), at least that of the supports. Nothing in it closes faster than a bound L, so it is
// open for another (gap - target) / L, and so on, up to its root. GJK then gives the next normal.
//
// A normal that stays: L is the speed at which the bodies close along it at most, however they turn. But where an edge or a face of a turning body is
// nearest, one of its corners dips, and the gap along this normal closes at once, though the bodies come near slowly. So there is also
// a normal that goes on turning as it has since the last look: n(t) = n cos(f t) + m sin(f t). With x from A's position to B's, r from a body's position to a
// point of it, v the relative velocity and w_n = f n x m, which is how n turns, the gap between two points changes by
//
//   n' . x + n . v + r_B . ((w_n - w_B) x n) - r_A . ((w_n - w_A) x n)
//
// and over a stretch T the sum of the first two by no more than T (f^2 (|x| + |v| T) + 2 f |v|), (w_n - w) x n by no more than |w_n - w| f T.
#pragma once

#include "algo/cast_meeting.h"
#include "shapes/scene.h"

namespace gjkdbg {

class RootFinding {
 public:
  /// The bodies as at the beginning of the motion, `motion` set; `time`: from there to now. Gaps of `target` or less count as closed. Looks at most `left` ahead.
  RootFinding(Body a, Body b, double reach_a, double reach_b, int dimension, double time, double target, double left);

  /// How long from now the gap stays open along gap.normal; gap.closing must be positive.
  double staying(const Gap& gap);
  /// The same along one that turns on from `last_normal`, `since` before.
  double turning(const Gap& gap, const AnyVector& last_normal, double since);
  int support_calls() const { return supports_; }

 private:
  double open_along(const AnyVector& n, double ahead);
  AnyVector relative_spin(const Body& body, const AnyVector& n, const AnyVector& m, double f) const;
  AnyVector across(const AnyVector& w, const AnyVector& n) const;

  Body a_, b_;
  double reach_a_, reach_b_;
  int dimension_;
  double time_, target_, left_;
  int supports_ = 0;
};

}  // namespace gjkdbg
