// Three numbers side by side, as functions for processors with AVX2 have them: lanes 0 to 2; what lane 3 has is not asked for.
#pragma once

#include <immintrin.h>

#include "shapes/vector.h"

namespace gjkdbg {

using Lanes = __m256d;

/// Of functions that have them, as lanes are handed over by reference: within one that is made for AVX2.
#define GJKDBG_LANES [[gnu::target("avx2"), gnu::always_inline]] inline

GJKDBG_LANES Lanes three(const double* v) { return _mm256_set_m128d(_mm_load_sd(v + 2), _mm_loadu_pd(v)); }
GJKDBG_LANES void store_three(double* v, const Lanes& three) {
  _mm_storeu_pd(v, _mm256_castpd256_pd128(three));
  _mm_store_sd(v + 2, _mm256_extractf128_pd(three, 1));
}
GJKDBG_LANES Lanes negative(const Lanes& v) { return _mm256_xor_pd(v, _mm256_set1_pd(-0.0)); }
/// Each without its sign.
GJKDBG_LANES Lanes length_of(const Lanes& v) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), v); }
/// One of them in all lanes.
template <int i>
GJKDBG_LANES Lanes lane(const Lanes& v) { return _mm256_permute4x64_pd(v, i * 0b01010101); }

/// m v, in the order in which Eigen adds up: of two rows at once from the first column, of the row that is left over from the last. x, y, z: v's, in all lanes.
GJKDBG_LANES Lanes turned(const Matrix<3, double>& m, Lanes x, Lanes y, Lanes z) {
  x = _mm256_mul_pd(x, _mm256_loadu_pd(m.data())), y = _mm256_mul_pd(y, _mm256_loadu_pd(m.data() + 3)), z = _mm256_mul_pd(z, three(m.data() + 6));
  return _mm256_blend_pd(_mm256_add_pd(_mm256_add_pd(x, y), z), _mm256_add_pd(x, _mm256_add_pd(y, z)), 0b0100);
}
GJKDBG_LANES Lanes turned(const Matrix<3, double>& m, const Lanes& v) { return turned(m, lane<0>(v), lane<1>(v), lane<2>(v)); }

}  // namespace gjkdbg
