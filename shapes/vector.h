// Vector and matrix types shared by every room.
//
// The algorithms are templates over the dimension D (1, 2, 3) and the scalar S (double, float) and use the
// fixed-size types. Scenes, recordings and the window learn the dimension at run time and use the `Any…`
// types: same Eigen interface, at most three rows, storage in place, no allocation.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross

namespace gjkdbg {

template <int D, class S>
using Vector = Eigen::Matrix<S, D, 1>;

template <int D, class S>
using Matrix = Eigen::Matrix<S, D, D>;

/// A point or direction of a dimension known at run time (1, 2 or 3 rows).
using AnyVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

/// A square matrix of a dimension known at run time (1, 2 or 3 rows).
using AnyMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

/// Whether every number is zero, of whichever sign: one branch for all of them.
template <int D, class S>
bool is_zero(const Vector<D, S>& v) {
  using Bits = std::conditional_t<sizeof(S) == 8, std::uint64_t, std::uint32_t>;
  Bits any = 0;
  for (int i = 0; i < D; ++i) any |= std::bit_cast<Bits>(v[i]);
  return any << 1 == 0;
}

/// The point in space with these coordinates, those it lacks 0.
inline Vector<3, double> in_space(const AnyVector& p) {
  Vector<3, double> out = Vector<3, double>::Zero();
  out.head(p.size()) = p;
  return out;
}

}  // namespace gjkdbg
