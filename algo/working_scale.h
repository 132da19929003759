// The factor by which a pair's lengths are multiplied while at work.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "shapes/convex.h"
#include "shapes/scene.h"

namespace gjkdbg {

/// Lengths within 2^-range .. 2^range are left alone (1); others are brought near 1 by a power of two, so that products of four lengths neither
/// overflow nor vanish. Scaling by a power of two rounds nothing. (Below the normal numbers 2^1000 is near enough, and a number.) `longest`: of what else
/// is reckoned with, in scene lengths. S: the scalar that is reckoned in.
template <class S>
double working_scale(const Body& a, const Body& b, double longest = 0) {
  constexpr int range = std::is_same_v<S, float> ? 16 : 64;
  const double size = std::max({size_of(a.shape), size_of(b.shape), (b.pose.position - a.pose.position).cwiseAbs().maxCoeff(), longest});
  if (size == 0) return 1;
  const int exponent = std::ilogb(size);
  return std::abs(exponent) <= range ? 1 : std::ldexp(1.0, std::min(-exponent, 1000));
}

}  // namespace gjkdbg
