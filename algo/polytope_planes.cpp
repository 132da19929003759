#include "algo/polytope_planes.h"

#ifdef GJKDBG_AVX2
#include <utility>

#include "algo/four_vectors.h"

namespace gjkdbg {
namespace {

/// The second of four places on; the fourth gets the fifth.
[[gnu::target("avx2"), gnu::always_inline]] inline __m256d next_of(const __m256d& four, double fifth) {
  return _mm256_blend_pd(_mm256_permute4x64_pd(four, 0b00111001), _mm256_set1_pd(fifth), 0b1000);
}

}  // namespace

[[gnu::target("avx2")]] bool set_fan_by_avx2(const Fan<double>& fan, Turn turn, PolytopeFace<3, double>* faces, double* nearness) {
  using Face = PolytopeFace<3, double>;
  static_assert(offsetof(Face, distance) == offsetof(Face, normal) + 3 * sizeof(double));  // written together
  const double* const p = fan.points[fan.apex].w.data();
  const FourVectors apex = FourVectors::all(p);
  const __m256d infinity = _mm256_set1_pd(std::numeric_limits<double>::infinity()), minus_infinity = _mm256_set1_pd(-std::numeric_limits<double>::infinity());
  const Vector<3, double>& at_apex = fan.points[fan.apex].w;
  const __m256d most = _mm256_set1_pd(fan.rounding.most), allowed = _mm256_set1_pd(fan.rounding.allowed_squared);
  const __m256d of_edges = _mm256_set1_pd(fan.rounding.of_sine * fan.rounding.of_sine * at_apex.dot(at_apex));
  __m256d all_set = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
  for (int k = 0; k < fan.n; k += 4) {
    const auto point = [&](int i) __attribute__((target("avx2"), always_inline)) -> const SupportPoint<3, double>& { return fan.points[fan.ring[i]]; };
    FourVectors edge = FourVectors::of(point(k), point(k + 1), point(k + 2), point(k + 3)) - apex;
    const double* const fifth = fan.points[fan.ring[k + 4]].w.data();
    FourVectors next{next_of(edge.x, fifth[0] - p[0]), next_of(edge.y, fifth[1] - p[1]), next_of(edge.z, fifth[2] - p[2])};
    if (turn == Turn::around_inner) std::swap(edge, next);
    const FourVectors n = edge.cross(next);
    const __m256d area = n.dot(n), length = _mm256_sqrt_pd(area);
    const __m256d edges = _mm256_mul_pd(edge.dot(edge), next.dot(next));
    const __m256d plain = _mm256_cmp_pd(area, _mm256_mul_pd(_mm256_set1_pd(thin_sine<double> * thin_sine<double>), edges), _CMP_GT_OQ);
    const __m256d off = _mm256_and_pd(most, _mm256_cmp_pd(_mm256_mul_pd(of_edges, edges), _mm256_mul_pd(allowed, area), _CMP_GT_OQ));
    const FourVectors normal{_mm256_div_pd(n.x, length), _mm256_div_pd(n.y, length), _mm256_div_pd(n.z, length)};
    const __m256d distance = _mm256_blendv_pd(infinity, normal.dot(apex), plain);
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
    _mm256_storeu_pd(nearness + k, _mm256_blendv_pd(minus_infinity, _mm256_sub_pd(off, distance), there));
    all_set = _mm256_and_pd(all_set, _mm256_blendv_pd(all_set, plain, there));
  }
  return _mm256_movemask_pd(all_set) == 0b1111;
}

}  // namespace gjkdbg
#endif
