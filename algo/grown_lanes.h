// The step of algo/grown_simplex.h in lanes, for processors with AVX2: what it asks of several features is computed of all of them at once, and which of them is
// the nearest is looked at last. The same numbers, a third of the time: most of it went into one feature after the other, and into guesses which one it would be.
#pragma once

#include "algo/minkowski_difference.h"

#ifdef GJKDBG_AVX2
namespace gjkdbg {

/// v and |v|^2 of several features, side by side.
struct FeatureLanes {
  double x[4], y[4], z[4], squared[4];
};

/// Of a triangle, the newest vertex and i and j: the nearest of the triangle (0) and its edges to i (1) and j (2), that is its lane. -1: not told, as it is thin, or
/// another feature may be the nearest.
int nearest_of_triangle_by_avx2(const SupportPoint<3, double>* points, int newest, int i, int j, FeatureLanes& features);

/// Of a tetrahedron, the newest vertex and i, j and k, the face at the newest vertex that holds the nearest point: that of i and j (0), of j and k (1), of k and i (2).
/// -1: not told, as no face does or something is thin.
int nearest_face_by_avx2(const SupportPoint<3, double>* points, int newest, int i, int j, int k, FeatureLanes& features);

}  // namespace gjkdbg
#endif
