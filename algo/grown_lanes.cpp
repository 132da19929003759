#include "algo/grown_lanes.h"

#ifdef GJKDBG_AVX2
#include <bit>

#include "algo/four_vectors.h"
#include "algo/orientation.h"

namespace gjkdbg {
namespace {

GJKDBG_LANES void set_points(FeatureLanes& features, const FourVectors& v) {
  _mm256_storeu_pd(features.x, v.x), _mm256_storeu_pd(features.y, v.y), _mm256_storeu_pd(features.z, v.z);
  _mm256_storeu_pd(features.squared, v.dot(v));
}
GJKDBG_LANES void set_weights(FeatureLanes& features, const __m256d& first, const __m256d& second, const __m256d& whole) {
  _mm256_storeu_pd(features.first, first), _mm256_storeu_pd(features.second, second), _mm256_storeu_pd(features.whole, whole);
}

/// The greatest of all lanes, in each.
GJKDBG_LANES __m256d greatest_of_lanes(__m256d x) {
  x = _mm256_max_pd(x, _mm256_permute2f128_pd(x, x, 0x01));
  return _mm256_max_pd(x, _mm256_permute_pd(x, 0b0101));
}

}  // namespace

/// Lanes: 0 the triangle, n; 1 and 2 the edges, e and e x c; 3 the third edge, for the angle.
[[gnu::target("avx2")]] int nearest_of_triangle_by_avx2(const SupportPoint<3, double>* points, int newest, int i, int j, FeatureLanes& features) {
  const FourVectors a = FourVectors::all(points[newest].w.data());
  const FourVectors e_i = FourVectors::all(points[i].w.data()) - a, e = FourVectors::of(points[j], points[i], points[j], points[j]) - a;
  const FourVectors first = a.with<0b0001>(e_i).cross(e);       // n, c_i, c_j
  const FourVectors across = e.cross(first).with<0b0001>(first);  // n, e_i x c_i, e_j x c_j
  const FourVectors side = e.with<0b0001>(first).with<0b1000>(e - e_i);
  const __m256d length = side.dot(side), along = side.dot(a);
  const __m256d height = _mm256_blend_pd(_mm256_set1_pd(1), along, 0b0001);
  set_points(features, across * _mm256_div_pd(height, length));
  const __m256d turned = first.from<0b00000000>().dot(first), towards = negative(along);  // n . c_i, n . c_j in lanes 1, 2
  const __m256d of_i = _mm256_blend_pd(negative(_mm256_permute4x64_pd(turned, 2)), towards, 0b0010), of_j = _mm256_blend_pd(_mm256_permute_pd(turned, 0b0101), towards, 0b0100);
  set_weights(features, of_i, of_j, length);
  const __m256d zero = _mm256_setzero_pd();
  const int positive_i = _mm256_movemask_pd(_mm256_cmp_pd(of_i, zero, _CMP_GT_OQ)), positive_j = _mm256_movemask_pd(_mm256_cmp_pd(of_j, zero, _CMP_GT_OQ));
  const int lane = 3 - 2 * (positive_i & 1) - (positive_j & 1);  // both the triangle, one its edge; of none, lane 3, nothing is told
  const int ends = _mm256_movemask_pd(_mm256_cmp_pd(towards, length, _CMP_LT_OQ)) & ((positive_i & 0b0010) | (positive_j & 0b0100));
  const int holds = ends | _mm_comilt_sd(_mm_add_sd(_mm256_castpd256_pd128(of_i), _mm256_castpd256_pd128(of_j)), _mm256_castpd256_pd128(length));
  // Thin is told by the longer of the edges to i and j, and by the longer of the others.
  const __m128d upper = _mm256_extractf128_pd(length, 1), lower = _mm256_castpd256_pd128(length), to_i = _mm_unpackhi_pd(lower, lower), third = _mm_unpackhi_pd(upper, upper);
  const __m128d longer = _mm_max_sd(to_i, upper), next_longer = _mm_max_sd(_mm_min_sd(to_i, upper), third);
  const bool plain = _mm_comigt_sd(lower, _mm_mul_sd(_mm_mul_sd(_mm_set_sd(thin_squared<double>), longer), next_longer)) != 0;
  return plain && (holds >> lane & 1) != 0 ? lane : -1;
}

/// Lanes: the faces of i and j, j and k, k and i; and of the solid.
[[gnu::target("avx2")]] int nearest_face_by_avx2(const SupportPoint<3, double>* points, int newest, int i, int j, int k, FeatureLanes& features) {
  const FourVectors a = FourVectors::all(points[newest].w.data());
  const FourVectors w = FourVectors::of(points[i], points[j], points[k], points[i]);
  const FourVectors e = w - a, next = w.from<0b01'00'10'01>() - a, e_k = FourVectors::all(points[k].w.data()) - a;
  const FourVectors n = e.cross(next);
  const __m256d area = n.dot(n), beyond = n.dot(a.with<0b1000>(e_k));  // the last: the volume
  set_points(features, n * _mm256_div_pd(beyond, area));
  const __m256d most = greatest_of_lanes(_mm256_max_pd(_mm256_max_pd(_mm256_max_pd(length_of(a.x), length_of(a.y)), length_of(a.z)), _mm256_max_pd(_mm256_max_pd(length_of(e.x), length_of(e.y)), length_of(e.z))));
  const __m256d error = _mm256_mul_pd(_mm256_set1_pd(2), _mm256_mul_pd(_mm256_mul_pd(_mm256_mul_pd(_mm256_set1_pd(determinant_rounding<double>), most), most), most));
  const __m256d told = _mm256_cmp_pd(length_of(beyond), error, _CMP_GT_OQ);
  const __m256d first = negative(n.dot(a.cross(next))), second = n.dot(a.cross(e)), zero = _mm256_setzero_pd();
  set_weights(features, first, second, area);
  const __m256d holds = _mm256_and_pd(_mm256_and_pd(_mm256_cmp_pd(first, zero, _CMP_GT_OQ), _mm256_cmp_pd(second, zero, _CMP_GT_OQ)), _mm256_cmp_pd(_mm256_add_pd(first, second), area, _CMP_LT_OQ));
  const FourVectors third = next - e;
  const __m256d of_e = e.dot(e), of_next = next.dot(next), of_third = third.dot(third);
  const __m256d longer = _mm256_max_pd(of_e, of_next), next_longer = _mm256_max_pd(_mm256_min_pd(of_e, of_next), of_third);
  const __m256d plain = _mm256_cmp_pd(area, _mm256_mul_pd(_mm256_mul_pd(_mm256_set1_pd(thin_squared<double>), longer), next_longer), _CMP_GT_OQ);
  if (_mm256_movemask_pd(_mm256_and_pd(told, plain)) != 0b1111) [[unlikely]] return -1;
  const int negative = _mm256_movemask_pd(beyond), faces = (negative ^ ((negative >> 3) - 1)) & _mm256_movemask_pd(holds) & 0b0111;  // beyond a face as the solid lies
  return faces != 0 ? std::countr_zero(static_cast<unsigned>(faces)) : -1;
}

}  // namespace gjkdbg
#endif
