#include "shapes/vertex_fours.h"

#ifdef GJKDBG_AVX2
#include <immintrin.h>

#include <limits>

namespace gjkdbg {

/// GreatestOfFours with one vector a four; of numbers that are alike it takes the same one, so that no answer depends on the machine.
[[gnu::target("avx2")]] std::size_t highest_by_avx2(const double* fours, std::size_t count, const double* d) {
  const __m256d x = _mm256_set1_pd(d[0]), y = _mm256_set1_pd(d[1]), z = _mm256_set1_pd(d[2]);
  const __m256i one = _mm256_set1_epi64x(1);
  __m256d most = _mm256_set1_pd(-std::numeric_limits<double>::infinity()), from = _mm256_setzero_pd();
  __m256i four = _mm256_setzero_si256();
  for (const double* const end = fours + 12 * count; fours < end; fours += 12) {
    const __m256d in_plane = _mm256_add_pd(_mm256_mul_pd(x, _mm256_loadu_pd(fours)), _mm256_mul_pd(y, _mm256_loadu_pd(fours + 4)));
    const __m256d height = _mm256_add_pd(in_plane, _mm256_mul_pd(z, _mm256_loadu_pd(fours + 8)));
    from = _mm256_blendv_pd(from, _mm256_castsi256_pd(four), _mm256_cmp_pd(height, most, _CMP_GT_OQ));
    most = _mm256_max_pd(height, most);
    four = _mm256_add_epi64(four, one);
  }
  const __m256i places = _mm256_add_epi64(_mm256_slli_epi64(_mm256_castpd_si256(from), 2), _mm256_set_epi64x(3, 2, 1, 0));
  const __m128d low = _mm256_castpd256_pd128(most), high = _mm256_extractf128_pd(most, 1), greatest = _mm_max_pd(high, low);
  const __m128i place = _mm_blendv_epi8(_mm256_castsi256_si128(places), _mm256_extracti128_si256(places, 1), _mm_castpd_si128(_mm_cmpgt_pd(high, low)));
  alignas(16) std::int64_t of_two[2];
  _mm_store_si128(reinterpret_cast<__m128i*>(of_two), place);
  return static_cast<std::size_t>(of_two[_mm_comigt_sd(_mm_unpackhi_pd(greatest, greatest), greatest)]);
}

}  // namespace gjkdbg
#endif
