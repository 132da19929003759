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

  [[gnu::always_inline]] static Triple of(const Vector<3, S>& v) { return {v[0], v[1], v[2]}; }
  [[gnu::always_inline]] Vector<3, S> vector() const { return {x, y, z}; }
  [[gnu::always_inline]] Triple operator+(const Triple& t) const { return {x + t.x, y + t.y, z + t.z}; }
  [[gnu::always_inline]] Triple operator-(const Triple& t) const { return {x - t.x, y - t.y, z - t.z}; }
  [[gnu::always_inline]] Triple operator*(S s) const { return {x * s, y * s, z * s}; }
  [[gnu::always_inline]] S dot(const Triple& t) const { return x * t.x + y * t.y + z * t.z; }
  [[gnu::always_inline]] S most() const {
    const S in_plane = std::abs(x) < std::abs(y) ? std::abs(y) : std::abs(x);
    return in_plane < std::abs(z) ? std::abs(z) : in_plane;
  }
  [[gnu::always_inline]] Triple cross(const Triple& t) const { return {y * t.z - z * t.y, z * t.x - x * t.z, x * t.y - y * t.x}; }
};

}  // namespace gjkdbg
