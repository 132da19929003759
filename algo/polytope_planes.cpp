#include "algo/polytope_planes.h"

#ifdef GJKDBG_AVX2
#include <immintrin.h>

#include <utility>

namespace gjkdbg {
namespace {

/// Four vectors, coordinate by coordinate.
struct FourVectors {
  __m256d x, y, z;
};

/// The points of four places: whole ones are read, and turned.
[[gnu::target("avx2"), gnu::always_inline]] inline FourVectors points_at(const Fan<double>& fan, const int* places) {
  const auto read = [&](int k) __attribute__((target("avx2"), always_inline)) { return _mm256_loadu_pd(fan.points[places[k]].w.data()); };  // x y z and one that is not asked for
  const __m256d p0 = read(0), p1 = read(1), p2 = read(2), p3 = read(3);
  const __m256d xz_01 = _mm256_unpacklo_pd(p0, p1), xz_23 = _mm256_unpacklo_pd(p2, p3), y_01 = _mm256_unpackhi_pd(p0, p1), y_23 = _mm256_unpackhi_pd(p2, p3);
  return {_mm256_permute2f128_pd(xz_01, xz_23, 0x20), _mm256_permute2f128_pd(y_01, y_23, 0x20), _mm256_permute2f128_pd(xz_01, xz_23, 0x31)};
}

[[gnu::target("avx2"), gnu::always_inline]] inline __m256d dot(const FourVectors& a, const FourVectors& b) {
  return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(a.x, b.x), _mm256_mul_pd(a.y, b.y)), _mm256_mul_pd(a.z, b.z));
}

[[gnu::target("avx2"), gnu::always_inline]] inline __m256d minus_products(const __m256d& a, const __m256d& b, const __m256d& c, const __m256d& d) {
  return _mm256_sub_pd(_mm256_mul_pd(a, b), _mm256_mul_pd(c, d));
}

/// The second of four places on; the fourth gets the fifth.
[[gnu::target("avx2"), gnu::always_inline]] inline __m256d next_of(const __m256d& four, double fifth) {
  return _mm256_blend_pd(_mm256_permute4x64_pd(four, 0b00111001), _mm256_set1_pd(fifth), 0b1000);
}

}  // namespace

[[gnu::target("avx2")]] bool set_fan_by_avx2(const Fan<double>& fan, Turn turn, PolytopeFace<3, double>* faces, double* nearness) {
  using Face = PolytopeFace<3, double>;
  static_assert(offsetof(Face, distance) == offsetof(Face, normal) + 3 * sizeof(double));  // written together
  const double* const p = fan.points[fan.apex].w.data();
  const FourVectors apex{_mm256_set1_pd(p[0]), _mm256_set1_pd(p[1]), _mm256_set1_pd(p[2])};
  const __m256d infinity = _mm256_set1_pd(std::numeric_limits<double>::infinity()), minus_infinity = _mm256_set1_pd(-std::numeric_limits<double>::infinity());
  __m256d all_set = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
  for (int k = 0; k < fan.n; k += 4) {
    const FourVectors at = points_at(fan, fan.ring + k);
    const double* const fifth = fan.points[fan.ring[k + 4]].w.data();
    FourVectors edge{_mm256_sub_pd(at.x, apex.x), _mm256_sub_pd(at.y, apex.y), _mm256_sub_pd(at.z, apex.z)};
    FourVectors next{next_of(edge.x, fifth[0] - p[0]), next_of(edge.y, fifth[1] - p[1]), next_of(edge.z, fifth[2] - p[2])};
    if (turn == Turn::around_inner) std::swap(edge, next);
    const FourVectors n{minus_products(edge.y, next.z, edge.z, next.y), minus_products(edge.z, next.x, edge.x, next.z), minus_products(edge.x, next.y, edge.y, next.x)};
    const __m256d area = dot(n, n), length = _mm256_sqrt_pd(area);
    const __m256d plain = _mm256_cmp_pd(area, _mm256_mul_pd(_mm256_set1_pd(thin_sine<double> * thin_sine<double>), _mm256_mul_pd(dot(edge, edge), dot(next, next))), _CMP_GT_OQ);
    const FourVectors normal{_mm256_div_pd(n.x, length), _mm256_div_pd(n.y, length), _mm256_div_pd(n.z, length)};
    const __m256d distance = _mm256_blendv_pd(infinity, dot(normal, apex), plain);
    // Faces again: x y z and the distance of each.
    const __m256d xy_02 = _mm256_unpacklo_pd(normal.x, normal.y), xy_13 = _mm256_unpackhi_pd(normal.x, normal.y);
    const __m256d zd_02 = _mm256_unpacklo_pd(normal.z, distance), zd_13 = _mm256_unpackhi_pd(normal.z, distance);
    const auto write = [&](int face, const __m256d& plane) __attribute__((target("avx2"), always_inline)) { _mm256_storeu_pd(faces[face].normal.data(), plane); };
    const int left = fan.n - k;
    write(k, _mm256_permute2f128_pd(xy_02, zd_02, 0x20));
    if (left > 1) write(k + 1, _mm256_permute2f128_pd(xy_13, zd_13, 0x20));
    if (left > 2) write(k + 2, _mm256_permute2f128_pd(xy_02, zd_02, 0x31));
    if (left > 3) write(k + 3, _mm256_permute2f128_pd(xy_13, zd_13, 0x31));
    const __m256d there = _mm256_castsi256_pd(_mm256_cmpgt_epi64(_mm256_set1_epi64x(left), _mm256_set_epi64x(3, 2, 1, 0)));
    _mm256_storeu_pd(nearness + k, _mm256_blendv_pd(minus_infinity, _mm256_xor_pd(distance, _mm256_set1_pd(-0.0)), there));
    all_set = _mm256_and_pd(all_set, _mm256_blendv_pd(all_set, plain, there));
  }
  return _mm256_movemask_pd(all_set) == 0b1111;
}

}  // namespace gjkdbg
#endif
