// Four vectors at once, coordinate by coordinate, for processors with AVX2. Products add up in the order of Vector's: the same numbers.
#pragma once

#include "algo/minkowski_difference.h"

#ifdef GJKDBG_AVX2
#include "shapes/three_avx2.h"

namespace gjkdbg {

struct FourVectors {
  __m256d x, y, z;

  /// One of them in all lanes.
  GJKDBG_LANES static FourVectors all(const double* v) { return {_mm256_broadcast_sd(v), _mm256_broadcast_sd(v + 1), _mm256_broadcast_sd(v + 2)}; }
  /// The w of four points: whole ones are read, and turned.
  GJKDBG_LANES static FourVectors of(const SupportPoint<3, double>& p, const SupportPoint<3, double>& q, const SupportPoint<3, double>& r, const SupportPoint<3, double>& s) {
    const __m256d p0 = _mm256_loadu_pd(p.w.data()), p1 = _mm256_loadu_pd(q.w.data()), p2 = _mm256_loadu_pd(r.w.data()), p3 = _mm256_loadu_pd(s.w.data());  // x y z, and one that is not asked for
    const __m256d xz_01 = _mm256_unpacklo_pd(p0, p1), xz_23 = _mm256_unpacklo_pd(p2, p3), y_01 = _mm256_unpackhi_pd(p0, p1), y_23 = _mm256_unpackhi_pd(p2, p3);
    return {_mm256_permute2f128_pd(xz_01, xz_23, 0x20), _mm256_permute2f128_pd(y_01, y_23, 0x20), _mm256_permute2f128_pd(xz_01, xz_23, 0x31)};
  }

  GJKDBG_LANES FourVectors operator-(const FourVectors& v) const { return {_mm256_sub_pd(x, v.x), _mm256_sub_pd(y, v.y), _mm256_sub_pd(z, v.z)}; }
  GJKDBG_LANES FourVectors operator*(const __m256d& s) const { return {_mm256_mul_pd(x, s), _mm256_mul_pd(y, s), _mm256_mul_pd(z, s)}; }
  GJKDBG_LANES __m256d dot(const FourVectors& v) const { return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(x, v.x), _mm256_mul_pd(y, v.y)), _mm256_mul_pd(z, v.z)); }
  GJKDBG_LANES FourVectors cross(const FourVectors& v) const {
    return {_mm256_sub_pd(_mm256_mul_pd(y, v.z), _mm256_mul_pd(z, v.y)), _mm256_sub_pd(_mm256_mul_pd(z, v.x), _mm256_mul_pd(x, v.z)),
            _mm256_sub_pd(_mm256_mul_pd(x, v.y), _mm256_mul_pd(y, v.x))};
  }
  /// Those of `v` in the lanes whose bits are set.
  template <int lanes>
  GJKDBG_LANES FourVectors with(const FourVectors& v) const {
    return {_mm256_blend_pd(x, v.x, lanes), _mm256_blend_pd(y, v.y, lanes), _mm256_blend_pd(z, v.z, lanes)};
  }
  /// From lane `places` % 4, of the next lane from lane `places` / 4 % 4, and so on.
  template <int places>
  GJKDBG_LANES FourVectors from() const {
    return {_mm256_permute4x64_pd(x, places), _mm256_permute4x64_pd(y, places), _mm256_permute4x64_pd(z, places)};
  }
};

}  // namespace gjkdbg
#endif
