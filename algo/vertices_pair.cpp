#include "algo/vertices_pair.h"

#ifdef GJKDBG_AVX2
#include <bit>
#include <immintrin.h>

#include "algo/minkowski_difference.h"

namespace gjkdbg {
namespace {

/// Of several places, bits of `found`, the one that GreatestOfFours::found takes: it compares columns 2 and 3 with 0 and 1 first, and keeps the first of each.
[[gnu::noinline]] unsigned first_by_column(unsigned found) {
  constexpr unsigned column = 0x11111111;
  for (const int k : {0, 2, 1})
    if (const unsigned of_column = found & (column << k)) return static_cast<unsigned>(std::countr_zero(of_column));
  return static_cast<unsigned>(std::countr_zero(found));
}

/// The place of the highest of 4 * fours places; beyond the last four that one is looked at again.
template <int fours>
[[gnu::target("avx2"), gnu::always_inline]] inline unsigned highest(const VertexFours<3, double>& vertices, double x, double y, double z) {
  const __m256d along_x = _mm256_set1_pd(x), along_y = _mm256_set1_pd(y), along_z = _mm256_set1_pd(z);
  const double* const first = vertices.data();
  const std::size_t last = (vertices.size() - 1) / 4;
  __m256d height[fours];
  for (std::size_t i = 0; i < fours; ++i) {
    const double* const four = first + 12 * (i < last ? i : last);
    const __m256d in_plane = _mm256_add_pd(_mm256_mul_pd(along_x, _mm256_loadu_pd(four)), _mm256_mul_pd(along_y, _mm256_loadu_pd(four + 4)));
    height[i] = _mm256_add_pd(in_plane, _mm256_mul_pd(along_z, _mm256_loadu_pd(four + 8)));
  }
  __m256d most[fours];
  for (int i = 0; i < fours; ++i) most[i] = height[i];
  for (int step = fours / 2; step > 0; step /= 2)
    for (int i = 0; i < step; ++i) most[i] = _mm256_max_pd(most[i], most[i + step]);
  __m256d greatest = _mm256_max_pd(most[0], _mm256_permute2f128_pd(most[0], most[0], 1));
  greatest = _mm256_max_pd(greatest, _mm256_permute_pd(greatest, 5));
  unsigned found = 0;
  for (int i = 0; i < fours; ++i) found |= static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(height[i], greatest, _CMP_EQ_OQ))) << (4 * i);
  found &= ~0u >> (28 - 4 * last);
  if (found == 0) [[unlikely]] return 0;  // no numbers
  return (found & (found - 1)) == 0 ? static_cast<unsigned>(std::countr_zero(found)) : first_by_column(found);
}

[[gnu::target("avx2"), gnu::always_inline]] inline const double* highest_of(const VertexFours<3, double>& vertices, double x, double y, double z) {
  const unsigned place = vertices.size() <= 16 ? highest<4>(vertices, x, y, z) : highest<8>(vertices, x, y, z);
  return vertices.data() + 12 * (place / 4) + place % 4;
}

/// Element i of a product, in the order in which Eigen adds up: of two rows at once from the first column, of the row that is left over from the last.
[[gnu::always_inline]] inline double turned(const Matrix<3, double>& m, int i, double x, double y, double z) {
  return i < 2 ? (m(i, 0) * x + m(i, 1) * y) + m(i, 2) * z : m(i, 0) * x + (m(i, 1) * y + m(i, 2) * z);
}

}  // namespace

[[gnu::target("avx2")]] void VerticesPair::support(const RelativePose<3, double>& pose, const Vector<3, double>& d, SupportPoint<3, double>& point) const {
  const auto in_b = [&](int i) { return -turned(pose.inverse, i, d[0], d[1], d[2]); };
  const double* const a = highest_of(*a_, d[0], d[1], d[2]);
  const double* const b = highest_of(*b_, in_b(0), in_b(1), in_b(2));
  for (int i = 0; i < 3; ++i) {
    point.a[i] = a[4 * i];
    point.b[i] = turned(pose.rotation, i, b[0], b[4], b[8]) + pose.position[i];
    point.w[i] = point.a[i] - point.b[i];
  }
}

}  // namespace gjkdbg
#endif
