// Numbers of twice the working precision, as unevaluated sums of two: for the few places where rounding decides.
//
// two_sum and two_product are the error-free transformations of Knuth and Dekker (Dekker 1971, "A floating-point
// technique for extending the available precision"); product and sum of two pairs keep about 2^-104 relative error
// in double. For float the pair is a single double, which is more than twice as precise.
// Needs round-to-nearest and no contraction (-ffp-contract=off).
#pragma once

#include <cmath>
#include <type_traits>

namespace gjkdbg {

struct DoubleDouble {
  double high = 0, low = 0;

  DoubleDouble() = default;
  DoubleDouble(double value) : high(value) {}  // implicit on purpose: a double is one
  DoubleDouble(double h, double l) : high(h), low(l) {}
  explicit operator double() const { return high + low; }

  /// a + b exactly, for any a and b.
  static DoubleDouble two_sum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;
    return {sum, (a - (sum - b_part)) + (b - b_part)};
  }
  /// a + b exactly, for |a| >= |b|.
  static DoubleDouble quick_two_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
  }
  /// a in two halves of 26 bits, whose products are exact (Veltkamp; |a| below 1e300).
  static DoubleDouble split(double a) {
    const double big = a * 134217729.0, high = big - (big - a);  // 2^27 + 1
    return {high, a - high};
  }
  /// a * b exactly (barring underflow), x and y being their halves. Without a processor's fused multiply-add at hand this is several
  /// times as fast as std::fma, which then is a call; the results are the same.
  static DoubleDouble two_product(double a, const DoubleDouble& x, double b, const DoubleDouble& y) {
    const double product = a * b;
    return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
  }
  static DoubleDouble two_product(double a, double b) { return two_product(a, split(a), b, split(b)); }

  friend DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
    DoubleDouble s = two_sum(x.high, y.high);
    const DoubleDouble t = two_sum(x.low, y.low);
    s = quick_two_sum(s.high, s.low + t.high);
    return quick_two_sum(s.high, s.low + t.low);
  }
  friend DoubleDouble operator-(const DoubleDouble& x) { return {-x.high, -x.low}; }
  friend DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) { return x + (-y); }
  friend DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
    const DoubleDouble p = two_product(x.high, y.high);
    return quick_two_sum(p.high, p.low + (x.high * y.low + x.low * y.high));
  }
  int sign() const { return high > 0 ? 1 : high < 0 ? -1 : low > 0 ? 1 : low < 0 ? -1 : 0; }
};

inline int sign(const DoubleDouble& x) { return x.sign(); }
inline int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The wider type in which differences and products of S hardly round.
template <class S>
using Wide = std::conditional_t<std::is_same_v<S, float>, double, DoubleDouble>;

}  // namespace gjkdbg
