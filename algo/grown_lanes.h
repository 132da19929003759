// The step of algo/grown_simplex.h in lanes, for processors with AVX2: what it asks of several features is computed of all of them at once, and which of them is
// the nearest is looked at last. The same numbers, 0.6 of the time from a tetrahedron and 0.8 from a triangle: it went into one feature after the other, and into guesses which one it would be.
#pragma once

#include "algo/minkowski_difference.h"

namespace gjkdbg {

/// Of a triangle, the square of the sine of the angle below which its normal is worth less than 1e-13 in double.
template <class S>
inline constexpr S thin_squared = S(1e-6);

/// Where the last step told its feature in lanes: nowhere.
template <class S>
struct ToldInLanes {};

#ifdef GJKDBG_AVX2
/// Several features, side by side: v and |v|^2; and the weights times `whole` of the vertices, but the newest, that the functions below name: of an edge to the first or second of
/// them one is told.
struct FeatureLanes {
  double x[4], y[4], z[4], squared[4];
  double first[4], second[4], whole[4];
};

/// Of a triangle, the newest vertex and i and j: the nearest of the triangle (0) and its edges to i (1) and j (2), that is its lane. -1: not told, as it is thin, or
/// another feature may be the nearest. Weights: of i and j.
int nearest_of_triangle_by_avx2(const SupportPoint<3, double>* points, int newest, int i, int j, FeatureLanes& features);

/// Of a tetrahedron, the newest vertex and i, j and k, the face at the newest vertex that holds the nearest point: that of i and j (0), of j and k (1), of k and i (2).
/// -1: not told, as no face does or something is thin. Weights: of the two in this order.
int nearest_face_by_avx2(const SupportPoint<3, double>* points, int newest, int i, int j, int k, FeatureLanes& features);

/// What is left of the last step for the weights, when they are wanted at last.
template <>
struct ToldInLanes<double> {
  FeatureLanes features;
  int lane = -1;              ///< -1: it was told otherwise
  int first = 0, second = 0;  ///< places of the vertices the weights are of
};
#endif

}  // namespace gjkdbg
