#include "algo/polygon_query.h"

#ifdef GJKDBG_AVX2
#include "shapes/fours_avx2.h"

namespace gjkdbg {
namespace {

/// What `separations` says of four edges after four, and the greatest of it.
struct Widest {
  __m256d most, from;
  __m256i four;

  [[gnu::target("avx2"), gnu::always_inline]] inline Widest()
      : most(_mm256_set1_pd(-std::numeric_limits<double>::infinity())), from(_mm256_setzero_pd()), four(_mm256_setzero_si256()) {}

  /// Of n fours of edges together, so that every corner is looked up once. `known`: how many fours of corners there are, or 0.
  template <bool of_a, int n, int known = 0>
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
    const int count = known > 0 ? known : other.count();
    for (int j = 0; j < count; ++j) {
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

  /// The edge with the widest separation: its place among those of A and then of B, in fours; those that fill up a four stand for the last.
  [[gnu::target("avx2"), gnu::always_inline]] inline GreatestOfFours<double>::Found of(const PolygonPair<double>& pair) {
    if (pair.a.count() == 2 && pair.b.count() == 2) {  // five to eight corners: no loops
      take<true, 2, 2>(&pair.a.four(0), pair);
      take<false, 2, 2>(&pair.b.four(0), pair);
    } else {
      take_all<true>(pair);
      take_all<false>(pair);
    }
    return found_by_avx2(most, _mm256_castpd_si256(from));
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

/// Of an edge of A (`of_a`) or of B; false where PolygonSat must look.
template <bool of_a>
[[gnu::target("avx2"), gnu::always_inline]] inline bool concluded(const PolygonPair<double>& pair, int edge, double separation, const SatAnswer<2, double>& answer, Result& result) {
  using V = Vector<2, double>;
  const double floor = answer.floor;
  const bool apart = separation > floor;
  if (!apart && separation >= -floor) return false;
  const Matrix<2, double>& r = pair.rotation;
  const V out = (of_a ? pair.a : pair.b).normal(edge);
  const V turned(r(0, 0) * out[0] + r(!of_a ? 0 : 1, of_a ? 0 : 1) * out[1], r(of_a ? 0 : 1, !of_a ? 0 : 1) * out[0] + r(1, 1) * out[1]);
  const auto say = [&](const PolygonPoints<double>& points, const V& normal) {
    answer.set(result, {points.a, points.b, normal, separation, separation - floor});
    result.status = word_of(apart ? SatStatus::separated : SatStatus::overlapping);
    result.iterations = result.support_calls = pair.a.size() + pair.b.size();
    return true;
  };
  // Each ending by itself: brought together they take a sixth longer.
  const EdgeAndCorner<of_a, double> nearest(pair, edge, lowest(of_a ? pair.b : pair.a, turned[0], turned[1]), separation);
  if (nearest.is_across()) return say(nearest.points_across(), of_a ? out : V(-turned));
  const PolygonPoints<double> points = nearest.points_at_end(floor);
  if (points.across) return say(points, of_a ? out : V(-turned));
  if (!apart) return false;
  const auto gap = proven_gap(pair, points.a, points.b, floor);
  if (!gap) return false;
  answer.set(result, *gap);
  result.status = word_of(SatStatus::separated);
  result.support_calls = pair.a.size() + pair.b.size();
  result.iterations = result.support_calls + 1;
  return true;
}

}  // namespace

[[gnu::target("avx2"), gnu::flatten]] bool solved_by_avx2(const PolygonQuery<double>& query, const PlacedAxes<2>& pose_a, const PlacedAxes<2>& pose_b, Result& result) {
  const Polygon<double>&a = query.a(), &b = query.b();
  a.fetch(), b.fetch();
  const auto [pose, floor] = query.placed(pose_a, pose_b);
  const PolygonPair<double> pair{a, b, pose.rotation, pose.position};
  const SatAnswer<2, double> answer = query.answer(pose_a, floor);
  const auto [place, separation] = Widest().of(pair);
  const int edge = static_cast<int>(place), of_a = 4 * a.count();
  return edge < of_a ? concluded<true>(pair, std::min(edge, a.size() - 1), separation, answer, result)
                     : concluded<false>(pair, std::min(edge - of_a, b.size() - 1), separation, answer, result);
}

}  // namespace gjkdbg
#endif
