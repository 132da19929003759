// Which edge of two polygons of five to eight corners has the widest separation (algo/polygon_separation.h): looked for in single precision, eight edges at a
// time. Where that leaves more than one, it does not say.
//
// To be in hand as soon as the widest separation is, an edge's place, 0 to 7 of A, 8 to 15 of B, stands in the last four bits of its own. By how much that may be off, with
// m = extent_a + extent_b + |p| no less than any of its three terms: the rotation, normals, corners, offsets and p are rounded by 2^-24, and so is every product and sum. An
// element of R^T n is off by less than 4 sqrt 2 2^-24, its product with a corner by less than 12 2^-24 m, that with p no more; with the last two sums it is 16 2^-24 m. The place
// changes it by 2^-20 m. Two separations: less than 2^-18 m; the bar lies 2^-17 m below the widest. What underflows is less than the smallest normal number. Where m is beyond
// single precision, so is the bar, and every edge may be the one.
#pragma once

#include <array>
#include <limits>

#include "algo/minkowski_difference.h"
#include "shapes/polygon_core.h"

#ifdef GJKDBG_AVX2
#include "shapes/three_avx2.h"

namespace gjkdbg {

class PolygonEights {
 public:
  PolygonEights() = default;
  /// Of polygons with fewer or more corners it says no.
  PolygonEights(const Polygon<double>& a, const Polygon<double>& b) : usable_(is_eight(a) && is_eight(b)) {
    if (usable_) a_ = Eight(a), b_ = Eight(b);
  }
  explicit operator bool() const { return usable_; }

  struct Widest {
    unsigned place;
    bool sure;
  };
  /// `size`: m, as above, or some more.
  GJKDBG_LANES Widest widest(const RelativePose<2, double>& pose, double size) const {
    const Rotation r{all(pose.rotation(0, 0)), all(pose.rotation(1, 0)), all(pose.rotation(0, 1)), all(pose.rotation(1, 1))};
    const __m256 px = all(pose.position[0]), py = all(pose.position[1]);
    const __m256 apart_a = placed(separations<true>(r, px, py), 0), apart_b = placed(separations<false>(r, px, py), 8);
    const __m256 eight = _mm256_max_ps(apart_a, apart_b);
    __m128 most = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
    most = _mm_max_ps(most, _mm_permute_ps(most, 0b01001110));
    most = _mm_max_ps(most, _mm_permute_ps(most, 0b10110001));
    const __m256 bar = _mm256_set1_ps(_mm_cvtss_f32(most) - (static_cast<float>(size) * 0x1p-17F + std::numeric_limits<float>::min()));
    const unsigned high = static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(apart_a, bar, _CMP_NLT_UQ)) << 8 | _mm256_movemask_ps(_mm256_cmp_ps(apart_b, bar, _CMP_NLT_UQ)));
    return {static_cast<unsigned>(_mm_cvtsi128_si32(_mm_castps_si128(most))) % 16, (high & (high - 1)) == 0};
  }

 private:
  /// A polygon's corners and edges, number by number.
  struct alignas(32) Eight {
    std::array<float, 8> corner_x, corner_y, normal_x, normal_y, offset;

    Eight() = default;
    /// An edge that is not there is out of question; the last corner stands for those that are not.
    explicit Eight(const Polygon<double>& polygon) {
      for (int i = 0; i < 8; ++i) {
        const auto k = static_cast<std::size_t>(i), in_four = k % 4;
        const PolygonFour<double>& four = polygon.four(i / 4);
        corner_x[k] = static_cast<float>(four.corner[0][in_four]), corner_y[k] = static_cast<float>(four.corner[1][in_four]);
        normal_x[k] = static_cast<float>(four.normal[0][in_four]), normal_y[k] = static_cast<float>(four.normal[1][in_four]);
        offset[k] = i < polygon.size() ? static_cast<float>(four.offset[in_four]) : std::numeric_limits<float>::max() / 2;
      }
    }
  };
  struct Rotation {
    __m256 xx, yx, xy, yy;
  };

  static bool is_eight(const Polygon<double>& polygon) { return polygon.count() == 2; }
  GJKDBG_LANES static __m256 all(double x) { return _mm256_set1_ps(static_cast<float>(x)); }
  GJKDBG_LANES static __m256 sum_of_products(__m256 a, __m256 x, __m256 b, __m256 y) { return _mm256_add_ps(_mm256_mul_ps(a, x), _mm256_mul_ps(b, y)); }
  GJKDBG_LANES static __m256 placed(__m256 separation, int first) {
    const __m256i place = _mm256_add_epi32(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7), _mm256_set1_epi32(first));
    return _mm256_or_ps(_mm256_andnot_ps(_mm256_castsi256_ps(_mm256_set1_epi32(15)), separation), _mm256_castsi256_ps(place));
  }

  template <bool of_a>
  GJKDBG_LANES __m256 separations(const Rotation& r, __m256 px, __m256 py) const {
    const Eight &edges = of_a ? a_ : b_, &other = of_a ? b_ : a_;
    const __m256 x = _mm256_load_ps(edges.normal_x.data()), y = _mm256_load_ps(edges.normal_y.data());
    const __m256 to_x = sum_of_products(r.xx, x, of_a ? r.yx : r.xy, y), to_y = sum_of_products(of_a ? r.xy : r.yx, x, r.yy, y);
    __m256 nearest[2] = {all(std::numeric_limits<double>::infinity()), all(std::numeric_limits<double>::infinity())};
    for (std::size_t j = 0; j < 8; ++j) {
      const __m256 at_x = _mm256_broadcast_ss(other.corner_x.data() + j), at_y = _mm256_broadcast_ss(other.corner_y.data() + j);
      nearest[j % 2] = _mm256_min_ps(nearest[j % 2], sum_of_products(to_x, at_x, to_y, at_y));
    }
    const __m256 least = _mm256_min_ps(nearest[0], nearest[1]), of_position = of_a ? sum_of_products(x, px, y, py) : sum_of_products(to_x, px, to_y, py);
    return _mm256_sub_ps(of_a ? _mm256_add_ps(least, of_position) : _mm256_sub_ps(least, of_position), _mm256_load_ps(edges.offset.data()));
  }

  Eight a_, b_;
  bool usable_ = false;
};

}  // namespace gjkdbg
#endif
