// Search directions by Newton's method: few steps where the bodies are round.
//
// With the support function h(x) = max over w of A - B of x . w, the distance is the greatest of the planes -h(u) over unit u. Where the boundary of
// A - B is smooth, h has the gradient w(x), the support along x, and the Hessian H(x), the derivative of the support mapping. Neither w nor h / |x| changes
// with the length of x, so H(x) x = 0, and h is convex, so H has no negative direction. About a unit u, for m across u:
//
//   h(u - m) = w . (u - m) + m . H m / 2 + ...,    |u - m| = 1 + |m|^2 / 2 + ...
//   the plane  -h(u - m) / |u - m| = p + w . m - m . (H + p I) m / 2 + ...,    p = -w . u
//   is farthest where  (H + p I) m = w - (w . u) u.
//
// As long as p > 0, there is one solution, and the steps converge quadratically: near the answer each squares the error. Without curvature,
// u - m = -w / p: plain GJK with one vertex. Where p is not positive, or not known to be near the distance yet, the caller's guess of the distance damps the step.
//
// A face or an edge of either body is a ridge of the planes, where h is the greater of two smooth pieces. With the gradients g and g' at u (of the
// piece that the model was of before, w' + H' u, since H' u' = 0), one H for both, and m(y) = (H + p I)^-1 (y - (y . u) u), the farthest plane is that of y = g + t (g' - g) where
// both pieces are as high: (g' - g) . (u - m(y)) = 0, for t between 0 and 1. The pieces are told apart by whether a derivative foretold
// the next support. Where three pieces meet, and far from the answer, the model misleads; each plane is a true bound all the same, and the caller
// goes back to the plain direction.
//
// Newton's method on a sphere: Absil, Mahony, Sepulchre, "Optimization algorithms on matrix manifolds" (2008), chapter 6.
#pragma once

#include <algorithm>
#include <cmath>

#include "shapes/support_mappings.h"

namespace gjkdbg {

/// (H + p I)^-1, by cofactors.
template <int D, class S>
SupportDerivative<D, S> damped_inverse(const SupportDerivative<D, S>& h, S p) {
  SupportDerivative<D, S> inverse;
  if constexpr (D == 1) {
    inverse.at[0][0] = 1 / (h.at[0][0] + p);
  } else if constexpr (D == 2) {
    const S a = h.at[0][0] + p, b = h.at[0][1], c = h.at[1][1] + p, one = 1 / (a * c - b * b);
    inverse.at[0][0] = c * one, inverse.at[0][1] = -b * one, inverse.at[1][1] = a * one;
  } else {
    const S a = h.at[0][0] + p, b = h.at[0][1], c = h.at[0][2], d = h.at[1][1] + p, e = h.at[1][2], f = h.at[2][2] + p;
    const S aa = d * f - e * e, ab = c * e - b * f, ac = b * e - c * d, one = 1 / (a * aa + b * ab + c * ac);
    inverse.at[0][0] = aa * one, inverse.at[0][1] = ab * one, inverse.at[0][2] = ac * one;
    inverse.at[1][1] = (a * f - c * c) * one, inverse.at[1][2] = (b * c - a * e) * one, inverse.at[2][2] = (a * d - b * b) * one;
  }
  return inverse;
}

/// Difference: with support_derivative, as MinkowskiDifference.
template <class Difference>
class NewtonDirection {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Point = typename Difference::Point;

 public:
  explicit NewtonDirection(const Difference& difference) : difference_(difference) {}

  /// The support along d, which is `length` long.
  void take(const V& d, S length, const Point& point) { u_ = d / length, point_ = point; }

  /// A direction, its length, and how far its plane should be away. Not finite where the curvature is beyond the numbers.
  struct Step {
    V x;
    S length, plane;
    bool on_ridge;  ///< two pieces of the boundary were taken into account
  };
  /// From the support taken last. p > 0: the distance, as far as it is known. In one function, as MinkowskiDifference::support is.
  [[gnu::flatten]] Step next(S p) {
    model();
    const SupportDerivative<D, S> inverse = damped_inverse(newest_.derivative, p);
    V y = newest_.w, m = inverse * across(y);
    if (pieces_ == 2) {
      const V other = before_.w + before_.derivative * u_ - y, turned = inverse * across(other);
      const S ahead = other.dot(u_ - m), rate = other.dot(turned);
      if (ahead > 0 && rate > 0) {
        const S t = std::min(ahead / rate, S(1));
        y += t * other, m += t * turned;
      }
    }
    Step step;
    step.x = u_ - m;
    step.length = step.x.norm();
    step.plane = -(y.dot(step.x) + (y.dot(m) - p * m.squaredNorm()) / 2) / step.length;  // m . H m = m . y - p m . m
    step.on_ridge = pieces_ == 2;
    return step;
  }

 private:
  struct Piece {
    V w;
    SupportDerivative<D, S> derivative;  ///< along a unit direction
  };

  V across(const V& v) const { return v - v.dot(u_) * u_; }

  void model() {
    const Piece piece{point_.w, difference_.support_derivative(u_, point_)};
    if (pieces_ > 0 && !foretold(newest_, piece.w)) before_ = newest_, pieces_ = 2;
    else if (pieces_ < 2 || foretold(before_, piece.w)) pieces_ = 1;
    newest_ = piece;
  }

  /// Whether a piece's derivative foretold the support along u, more or less: else that is of another piece of the boundary.
  bool foretold(const Piece& piece, const V& w) const {
    const V moved = w - piece.w;
    return (moved - piece.derivative * u_).squaredNorm() <= S(0.64) * moved.squaredNorm();
  }

  const Difference& difference_;
  V u_;
  Point point_;
  int pieces_ = 0;
  Piece newest_, before_;
};

}  // namespace gjkdbg
