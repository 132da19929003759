// Vectors of twice the working precision, for the decisions that plain arithmetic cannot take.
#pragma once

#include <array>

#include "shapes/double_double.h"
#include "shapes/vector.h"

namespace gjkdbg {

/// Three components of Wide<S>; missing ones (1D, 2D) are zero.
template <class S>
struct WideVector {
  std::array<Wide<S>, 3> c{};

  WideVector() = default;
  template <int D>
  explicit WideVector(const Vector<D, S>& v) {
    for (int i = 0; i < D; ++i) c[i] = Wide<S>(v[i]);
  }
  /// a - b: exact in double, to a rounding of double in float.
  template <int D>
  static WideVector difference(const Vector<D, S>& a, const Vector<D, S>& b) {
    WideVector r;
    for (int i = 0; i < D; ++i) {
      if constexpr (std::is_same_v<S, double>) r.c[i] = DoubleDouble::two_sum(a[i], -b[i]);
      else r.c[i] = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    }
    return r;
  }
  template <int D>
  Vector<D, S> rounded() const {
    Vector<D, S> v;
    for (int i = 0; i < D; ++i) v[i] = static_cast<S>(static_cast<double>(c[i]));
    return v;
  }
  friend WideVector operator-(const WideVector& x, const WideVector& y) {
    WideVector r;
    for (int i = 0; i < 3; ++i) r.c[i] = x.c[i] - y.c[i];
    return r;
  }
  friend WideVector operator+(const WideVector& x, const WideVector& y) {
    WideVector r;
    for (int i = 0; i < 3; ++i) r.c[i] = x.c[i] + y.c[i];
    return r;
  }
  friend WideVector operator*(const Wide<S>& s, const WideVector& x) {
    WideVector r;
    for (int i = 0; i < 3; ++i) r.c[i] = s * x.c[i];
    return r;
  }
  Wide<S> dot(const WideVector& y) const { return c[0] * y.c[0] + c[1] * y.c[1] + c[2] * y.c[2]; }
  WideVector cross(const WideVector& y) const {
    WideVector r;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      r.c[i] = c[j] * y.c[k] - c[k] * y.c[j];
    }
    return r;
  }
};

/// x / y to about twice the working precision: one Newton correction of the rounded quotient.
inline DoubleDouble divide(const DoubleDouble& x, const DoubleDouble& y) {
  const double first = x.high / y.high;
  const DoubleDouble rest = x - y * DoubleDouble(first);
  return DoubleDouble::quick_two_sum(first, rest.high / y.high);
}
inline double divide(double x, double y) { return x / y; }

}  // namespace gjkdbg
