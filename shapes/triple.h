// A vector of space as three numbers, each in a register of its own.
#pragma once

#include <cmath>

#include "shapes/vector.h"

namespace gjkdbg {

/// Where a Vector goes through memory, and is written number by number and read two at once, a processor waits for the cache.
/// Products add up in the order of Vector's, (x + y) + z: both give the same numbers.
template <class S>
struct Triple {
  S x, y, z;

  template <int D>
  [[gnu::always_inline]] static Triple of(const Vector<D, S>& v) {
    return {v[0], D > 1 ? v[1 % D] : S(0), D > 2 ? v[2 % D] : S(0)};
  }
  /// Of a vector that was just written: whatever compilers make of it, one number is read at a time.
  template <int D>
  [[gnu::always_inline]] static Triple just_written(const Vector<D, S>& v) {
    const volatile S* const numbers = v.data();
    Triple t{numbers[0], 0, 0};
    if constexpr (D > 1) t.y = numbers[1];
    if constexpr (D > 2) t.z = numbers[2];
    return t;
  }
  template <int D = 3>
  [[gnu::always_inline]] Vector<D, S> vector() const {
    Vector<D, S> v;
    v[0] = x;
    if constexpr (D > 1) v[1] = y;
    if constexpr (D > 2) v[2] = z;
    return v;
  }
  [[gnu::always_inline]] Triple operator-() const { return {-x, -y, -z}; }
  [[gnu::always_inline]] Triple operator+(const Triple& t) const { return {x + t.x, y + t.y, z + t.z}; }
  [[gnu::always_inline]] Triple operator-(const Triple& t) const { return {x - t.x, y - t.y, z - t.z}; }
  [[gnu::always_inline]] Triple operator*(S s) const { return {x * s, y * s, z * s}; }
  [[gnu::always_inline]] S dot(const Triple& t) const { return x * t.x + y * t.y + z * t.z; }
  [[gnu::always_inline]] S most() const {
    const S in_plane = std::abs(x) < std::abs(y) ? std::abs(y) : std::abs(x);
    return in_plane < std::abs(z) ? std::abs(z) : in_plane;
  }
  /// |x| + |y| + |z|: no less than the length, no more than sqrt(3) of it, and no root.
  [[gnu::always_inline]] S taxicab() const { return std::abs(x) + std::abs(y) + std::abs(z); }
  [[gnu::always_inline]] Triple cross(const Triple& t) const { return {y * t.z - z * t.y, z * t.x - x * t.z, x * t.y - y * t.x}; }
};

}  // namespace gjkdbg
