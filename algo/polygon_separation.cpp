#include "algo/polygon_separation.h"

#ifdef GJKDBG_AVX2
#include "shapes/fours_avx2.h"

namespace gjkdbg {
namespace {

struct Widest {
  __m256d most, from;
  __m256i four;

  [[gnu::target("avx2"), gnu::always_inline]] inline Widest()
      : most(_mm256_set1_pd(-std::numeric_limits<double>::infinity())), from(_mm256_setzero_pd()), four(_mm256_setzero_si256()) {}

  /// Of n fours of edges together, so that every corner is looked up once.
  template <bool of_a, int n>
  [[gnu::target("avx2"), gnu::always_inline]] inline void take(const PolygonFour<double>* edges, const PolygonPair<double>& pair) {
    __m256d x[n], y[n], to_x[n], to_y[n], nearest[n];
    const Matrix<2, double>& r = pair.rotation;
    const Polygon<double>& other = of_a ? pair.b : pair.a;
    const __m256d r00 = _mm256_set1_pd(r(0, 0)), r10 = _mm256_set1_pd(r(1, 0)), r01 = _mm256_set1_pd(r(0, 1)), r11 = _mm256_set1_pd(r(1, 1));
    for (int i = 0; i < n; ++i) {
      x[i] = _mm256_loadu_pd(edges[i].normal[0].data()), y[i] = _mm256_loadu_pd(edges[i].normal[1].data());
      to_x[i] = _mm256_add_pd(_mm256_mul_pd(r00, x[i]), _mm256_mul_pd(of_a ? r10 : r01, y[i]));
      to_y[i] = _mm256_add_pd(_mm256_mul_pd(of_a ? r01 : r10, x[i]), _mm256_mul_pd(r11, y[i]));
      nearest[i] = _mm256_set1_pd(std::numeric_limits<double>::infinity());
    }
    for (int j = 0; j < other.count(); ++j) {
      const auto& [corner_x, corner_y] = other.four(j).corner;
      for (std::size_t k = 0; k < 4; ++k) {
        const __m256d at_x = _mm256_broadcast_sd(corner_x.data() + k), at_y = _mm256_broadcast_sd(corner_y.data() + k);
        for (int i = 0; i < n; ++i) nearest[i] = _mm256_min_pd(_mm256_add_pd(_mm256_mul_pd(to_x[i], at_x), _mm256_mul_pd(to_y[i], at_y)), nearest[i]);
      }
    }
    const __m256d position_x = _mm256_set1_pd(pair.position[0]), position_y = _mm256_set1_pd(pair.position[1]);
    for (int i = 0; i < n; ++i) {
      if constexpr (of_a) nearest[i] = _mm256_add_pd(nearest[i], _mm256_add_pd(_mm256_mul_pd(x[i], position_x), _mm256_mul_pd(y[i], position_y)));
      else nearest[i] = _mm256_sub_pd(nearest[i], _mm256_add_pd(_mm256_mul_pd(to_x[i], position_x), _mm256_mul_pd(to_y[i], position_y)));
      const __m256d apart = _mm256_sub_pd(nearest[i], _mm256_loadu_pd(edges[i].offset.data()));
      from = _mm256_blendv_pd(from, _mm256_castsi256_pd(four), _mm256_cmp_pd(apart, most, _CMP_GT_OQ));
      most = _mm256_max_pd(apart, most);
      four = _mm256_add_epi64(four, _mm256_set1_epi64x(1));
    }
  }
  template <bool of_a>
  [[gnu::target("avx2"), gnu::always_inline]] inline void take_all(const PolygonPair<double>& pair) {
    const Polygon<double>& polygon = of_a ? pair.a : pair.b;
    int i = 0;
    for (; i + 2 <= polygon.count(); i += 2) take<of_a, 2>(&polygon.four(i), pair);
    if (i < polygon.count()) take<of_a, 1>(&polygon.four(i), pair);
  }
};

/// Polygon::lowest.
[[gnu::target("avx2"), gnu::always_inline]] inline int lowest(const Polygon<double>& polygon, double x, double y) {
  const __m256d to_x = _mm256_set1_pd(x), to_y = _mm256_set1_pd(y);
  __m256d least = _mm256_set1_pd(std::numeric_limits<double>::infinity());
  const auto height = [&](int i) __attribute__((target("avx2"), always_inline)) {
    const auto& [corner_x, corner_y] = polygon.four(i).corner;
    return _mm256_add_pd(_mm256_mul_pd(to_x, _mm256_loadu_pd(corner_x.data())), _mm256_mul_pd(to_y, _mm256_loadu_pd(corner_y.data())));
  };
  for (int i = 0; i < polygon.count(); ++i) least = _mm256_min_pd(height(i), least);
  least = _mm256_min_pd(least, _mm256_permute2f128_pd(least, least, 1));
  least = _mm256_min_pd(least, _mm256_permute_pd(least, 5));
  for (int i = 0; i < polygon.count(); ++i)
    if (const int found = _mm256_movemask_pd(_mm256_cmp_pd(height(i), least, _CMP_EQ_OQ))) return 4 * i + __builtin_ctz(static_cast<unsigned>(found));
  return 0;
}

}  // namespace

[[gnu::target("avx2")]] WidestSeparation<double> widest_by_avx2(const PolygonPair<double>& pair) {
  Widest widest;
  widest.take_all<true>(pair);
  widest.take_all<false>(pair);
  const auto [found, separation] = found_by_avx2(widest.most, _mm256_castpd_si256(widest.from));
  const int place = static_cast<int>(found), of_a = 4 * pair.a.count();
  const Matrix<2, double>& r = pair.rotation;
  if (place < of_a) {
    const Vector<2, double> n = pair.a.normal(place);
    return {place, lowest(pair.b, r(0, 0) * n[0] + r(1, 0) * n[1], r(0, 1) * n[0] + r(1, 1) * n[1]), separation};
  }
  const Vector<2, double> n = pair.b.normal(place - of_a);
  return {place, lowest(pair.a, r(0, 0) * n[0] + r(0, 1) * n[1], r(1, 0) * n[0] + r(1, 1) * n[1]), separation};
}

}  // namespace gjkdbg
#endif
