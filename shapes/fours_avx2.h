// What functions for processors with AVX2 share (shapes/fours.h without it); the same numbers and, of numbers that are alike, the same places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <immintrin.h>

#include "shapes/fours.h"

namespace gjkdbg {

/// GreatestOfFours::found: the greatest of four columns, and where each stood in its own.
[[gnu::target("avx2"), gnu::always_inline]] inline GreatestOfFours<double>::Found found_by_avx2(const __m256d& most, const __m256i& from) {
  const __m256i places = _mm256_add_epi64(_mm256_slli_epi64(from, 2), _mm256_set_epi64x(3, 2, 1, 0));
  const __m128d low = _mm256_castpd256_pd128(most), high = _mm256_extractf128_pd(most, 1), greatest = _mm_max_pd(high, low);
  const __m128i place = _mm_blendv_epi8(_mm256_castsi256_si128(places), _mm256_extracti128_si256(places, 1), _mm_castpd_si128(_mm_cmpgt_pd(high, low)));
  alignas(16) std::int64_t of_two[2];
  _mm_store_si128(reinterpret_cast<__m128i*>(of_two), place);
  const __m128d second = _mm_unpackhi_pd(greatest, greatest);
  return {static_cast<std::size_t>(of_two[_mm_comigt_sd(second, greatest)]), _mm_cvtsd_f64(_mm_max_sd(second, greatest))};
}

}  // namespace gjkdbg
