// Which side of a plane, a line or a point another point lies on: the sign, right in all but the most hopeless cases.
//
// A determinant of D vectors is evaluated in plain arithmetic; if it is larger than its rounding error can be,
// its sign stands (the static filter of Fortune and van Wyk; error bound as in Shewchuk 1997, section 4).
// Otherwise it is evaluated in twice the precision, where it is taken for zero only below about 1e-29 of its terms.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/wide.h"

namespace gjkdbg {

/// Of determinant_error, times m^3.
template <class S>
inline constexpr S determinant_rounding = 24 * std::numeric_limits<S>::epsilon();

/// Error of a 3x3 determinant with entries of at most m: its six products of three are each off by at most 3 u m^3
/// (u: half an ulp of 1), their sum by 5 more roundings of at most 6 m^3: below 48 u m^3.
template <class S>
S determinant_error(S m) {
  return determinant_rounding<S> * m * m * m;
}

template <class S>
int determinant_sign_wide(const WideVector<S>& x, const WideVector<S>& y, const WideVector<S>& z) {
  const Wide<S> value = x.cross(y).dot(z);
  const double bound = std::ldexp(1.0, std::is_same_v<S, float> ? -48 : -98);
  const auto size = [](const WideVector<S>& v) {
    return std::max({std::abs(double(v.c[0])), std::abs(double(v.c[1])), std::abs(double(v.c[2]))});
  };
  const double terms = 6 * size(x) * size(y) * size(z);  // no less than the sum of |products|
  return std::abs(double(value)) <= bound * terms ? 0 : sign(value);
}

/// Sign of det[b - a, c - a, d - a]: +1 when d lies on the side of the plane abc from which a, b, c turn counter-clockwise.
template <class S>
int orientation(const Vector<3, S>& a, const Vector<3, S>& b, const Vector<3, S>& c, const Vector<3, S>& d) {
  const Vector<3, S> x = b - a, y = c - a, z = d - a;
  const S value = x.cross(y).dot(z);
  const S m = std::max({x.cwiseAbs().maxCoeff(), y.cwiseAbs().maxCoeff(), z.cwiseAbs().maxCoeff()});
  if (std::abs(value) > 2 * determinant_error(m)) return value > 0 ? 1 : -1;  // twice: the differences round too
  using W = WideVector<S>;
  return determinant_sign_wide<S>(W::difference(b, a), W::difference(c, a), W::difference(d, a));
}

/// Sign of det[b - a, c - a]: +1 when a, b, c turn counter-clockwise.
template <class S>
int orientation(const Vector<2, S>& a, const Vector<2, S>& b, const Vector<2, S>& c) {
  const Vector<2, S> x = b - a, y = c - a;
  const S value = x[0] * y[1] - x[1] * y[0];
  const S m = std::max(x.cwiseAbs().maxCoeff(), y.cwiseAbs().maxCoeff());
  if (std::abs(value) > 8 * std::numeric_limits<S>::epsilon() * m * m) return value > 0 ? 1 : -1;
  WideVector<S> unit;
  unit.c[2] = Wide<S>(1.0);
  return determinant_sign_wide<S>(WideVector<S>::difference(b, a), WideVector<S>::difference(c, a), unit);
}

}  // namespace gjkdbg
