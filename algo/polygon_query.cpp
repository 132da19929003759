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

  /// The edge with the widest separation: its place among those of A and then of B, in fours; those that fill up a four stand for the last.
  [[gnu::target("avx2"), gnu::always_inline]] inline int of(const PolygonPair<double>& pair) {
    take_all<true>(pair);
    take_all<false>(pair);
    return static_cast<int>(found_by_avx2(most, _mm256_castpd_si256(from)).place);
  }
};

/// Polygon::lowest, and how high that lies.
struct LowestCorner {
  int corner;
  double height;

  [[gnu::target("avx2"), gnu::always_inline]] inline LowestCorner(const Polygon<double>& polygon, double x, double y) : corner(0) {
    const __m256d to_x = _mm256_set1_pd(x), to_y = _mm256_set1_pd(y);
    __m256d least = _mm256_set1_pd(std::numeric_limits<double>::infinity());
    const auto heights = [&](int i) __attribute__((target("avx2"), always_inline)) {
      const auto& [corner_x, corner_y] = polygon.four(i).corner;
      return _mm256_add_pd(_mm256_mul_pd(to_x, _mm256_loadu_pd(corner_x.data())), _mm256_mul_pd(to_y, _mm256_loadu_pd(corner_y.data())));
    };
    for (int i = 0; i < polygon.count(); ++i) least = _mm256_min_pd(heights(i), least);
    least = _mm256_min_pd(least, _mm256_permute2f128_pd(least, least, 1));
    least = _mm256_min_pd(least, _mm256_permute_pd(least, 5));
    height = _mm256_cvtsd_f64(least);
    for (int i = 0; i < polygon.count(); ++i)
      if (const int found = _mm256_movemask_pd(_mm256_cmp_pd(heights(i), least, _CMP_EQ_OQ))) {
        corner = 4 * i + __builtin_ctz(static_cast<unsigned>(found));
        return;
      }
  }
};

/// Of an edge of A (`of_a`) or of B, the one with the widest separation; false where PolygonSat must look.
template <bool of_a>
[[gnu::target("avx2"), gnu::always_inline]] inline bool concluded(const PolygonPair<double>& pair, int edge, const SatAnswer<2, double>& answer, Result& result) {
  using V = Vector<2, double>;
  const double floor = answer.floor;
  const Matrix<2, double>& r = pair.rotation;
  const Polygon<double>& edges = of_a ? pair.a : pair.b;
  const V out = edges.normal(edge), &p = pair.position;
  const V turned(r(0, 0) * out[0] + r(!of_a ? 0 : 1, of_a ? 0 : 1) * out[1], r(of_a ? 0 : 1, !of_a ? 0 : 1) * out[0] + r(1, 1) * out[1]);
  const LowestCorner lowest(of_a ? pair.b : pair.a, turned[0], turned[1]);
  const double separation = (of_a ? lowest.height + (out[0] * p[0] + out[1] * p[1]) : lowest.height - (turned[0] * p[0] + turned[1] * p[1])) - edges.offset(edge);
  const bool apart = separation > floor;
  if (!apart && separation >= -floor) return false;
  const auto say = [&](const PolygonPoints<double>& points, const V& normal) {
    answer.set(result, {points.a, points.b, normal, separation, separation - floor});
    result.status = apart ? SatStatus::separated : SatStatus::overlapping;
    result.iterations = result.support_calls = pair.a.size() + pair.b.size();
    return true;
  };
  // Each ending by itself: brought together they take a sixth longer.
  const EdgeAndCorner<of_a, double> nearest(pair, edge, lowest.corner, separation);
  if (nearest.is_across()) return say(nearest.points_across(), of_a ? out : V(-turned));
  const PolygonPoints<double> points = nearest.points_at_end(floor);
  if (points.across) return say(points, of_a ? out : V(-turned));
  if (!apart) return false;
  const auto gap = proven_gap(pair, points.a, points.b, floor);
  if (!gap) return false;
  answer.set(result, *gap);
  result.status = SatStatus::separated;
  result.support_calls = pair.a.size() + pair.b.size();
  result.iterations = result.support_calls + 1;
  return true;
}

}  // namespace

[[gnu::target("avx2"), gnu::flatten]] bool solved_by_avx2(const PolygonQuery<double>& query, const PlacedAxes<2>& pose_a, const PlacedAxes<2>& pose_b, Result& result) {
  const Polygon<double>&a = query.a(), &b = query.b();
  a.fetch(), b.fetch();
  const PolygonQuery<double>::Placed placed = query.placed(pose_a, pose_b);
  const PolygonPair<double> pair{a, b, placed.pose.rotation, placed.pose.position};
  const SatAnswer<2, double> answer = query.answer(pose_a, placed.floor);
  if (query.eights())
    if (const auto [place, sure] = query.widest_by_eights(placed); sure) [[likely]]
      return place < 8 ? concluded<true>(pair, static_cast<int>(place), answer, result) : concluded<false>(pair, static_cast<int>(place - 8), answer, result);
  const int edge = Widest().of(pair), of_a = 4 * a.count();
  return edge < of_a ? concluded<true>(pair, std::min(edge, a.size() - 1), answer, result) : concluded<false>(pair, std::min(edge - of_a, b.size() - 1), answer, result);
}

}  // namespace gjkdbg
#endif
