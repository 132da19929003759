#include "shapes/vertex_fours.h"

#ifdef GJKDBG_AVX2
#include <limits>

#include "shapes/fours_avx2.h"

namespace gjkdbg {
namespace {

/// GreatestOfFours with one vector a four, of every second of them.
struct GreatestOfEverySecond {
  __m256d most, from;
  __m256i four;

  [[gnu::target("avx2"), gnu::always_inline]] explicit inline GreatestOfEverySecond(int first)
      : most(_mm256_set1_pd(-std::numeric_limits<double>::infinity())), from(_mm256_setzero_pd()), four(_mm256_set1_epi64x(first)) {}
  [[gnu::target("avx2"), gnu::always_inline]] inline void take(const double* vertices, const __m256d (&d)[3]) {
    const __m256d in_plane = _mm256_add_pd(_mm256_mul_pd(d[0], _mm256_loadu_pd(vertices)), _mm256_mul_pd(d[1], _mm256_loadu_pd(vertices + 4)));
    const __m256d height = _mm256_add_pd(in_plane, _mm256_mul_pd(d[2], _mm256_loadu_pd(vertices + 8)));
    from = _mm256_blendv_pd(from, _mm256_castsi256_pd(four), _mm256_cmp_pd(height, most, _CMP_GT_OQ));
    most = _mm256_max_pd(height, most);
    four = _mm256_add_epi64(four, _mm256_set1_epi64x(2));
  }
};

}  // namespace

/// Of numbers that are alike it takes the one GreatestOfFours takes, so that no answer depends on the machine. Each step waits for the one before:
/// so the fours of even and of odd number go their own ways until the end.
[[gnu::target("avx2")]] std::size_t highest_by_avx2(const double* fours, std::size_t count, const double* d) {
  const __m256d along[3] = {_mm256_set1_pd(d[0]), _mm256_set1_pd(d[1]), _mm256_set1_pd(d[2])};
  GreatestOfEverySecond even(0), odd(1);
  for (; count >= 2; count -= 2, fours += 24) even.take(fours, along), odd.take(fours + 12, along);
  if (count == 1) even.take(fours, along);
  const __m256d later = _mm256_castsi256_pd(_mm256_cmpgt_epi64(_mm256_castpd_si256(even.from), _mm256_castpd_si256(odd.from)));
  const __m256d alike = _mm256_cmp_pd(odd.most, even.most, _CMP_EQ_OQ), greater = _mm256_cmp_pd(odd.most, even.most, _CMP_GT_OQ);
  const __m256d from = _mm256_blendv_pd(even.from, odd.from, _mm256_or_pd(greater, _mm256_and_pd(alike, later)));
  const __m256d most = _mm256_max_pd(odd.most, even.most);
  return found_by_avx2(most, _mm256_castpd_si256(from)).place;
}

}  // namespace gjkdbg
#endif
