// Up to 32 vertices in single precision, eight by eight, and in double: the highest along a direction is looked for in the one, and told in the other.
//
//   x x x x x x x x   y y y y y y y y   z z z z z z z z | … | x y z x y z …      where fewer than 32 are left, their middle
//
// A height that is rounded to single precision says which vertices may be the highest: one, but where the direction is across an edge or a face. To be in hand as soon as the
// greatest height is, a vertex's place stands in the last five bits of its height. Whether another comes near enough to be as high in double is told beside, which nobody waits for
// but a processor that guessed wrong; then those few are settled in double.
//
// By how much a height may be off, with t = (|d_x| + |d_y| + |d_z|) m no less than the sum of its products' sizes and m the greatest coordinate: the direction and the vertex are
// rounded by 2^-24, three products and two sums as often again, which is 5 2^-24 t; the place changes it by less than 2^-18 t. Two heights, and the difference: less than 2^-16.8 t. What
// underflows is less than the smallest normal number. Where t is beyond single precision, so is the bar, and all vertices may be the highest.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>

#include "shapes/vertex_fours.h"

#ifdef GJKDBG_AVX2
#include <immintrin.h>

namespace gjkdbg {

/// Of none it says no.
class VertexEights {
 public:
  static constexpr std::size_t least = 9, most = 32;  ///< vertices

  VertexEights() = default;
  explicit VertexEights(const VertexFours<3, double>& vertices);
  explicit operator bool() const { return numbers_ != nullptr; }

  /// Into the cache, as long as something else is to be done.
  [[gnu::always_inline]] void fetch() const {
    for (std::size_t line = 0; line < sizeof(Numbers::eights); line += 64) __builtin_prefetch(reinterpret_cast<const char*>(numbers_.get()) + line);
  }

  /// What single precision says.
  struct Highest {
    unsigned place;
    unsigned high;  ///< a bit for the place of each vertex that may be the highest: where there is more than one of them, `settled` says which is
    bool sure() const { return (high & (high - 1)) == 0; }
  };

  /// The highest along (x, y, z), each eight times, of no more than this size.
  [[gnu::target("avx2"), gnu::always_inline]] inline Highest highest(__m256 x, __m256 y, __m256 z, float size) const {
    const __m256i places = _mm256_setr_epi32(0, 1, 2, 3, 16, 17, 18, 19);
    __m256 height[4];
    for (int i = 0; i < 4; ++i) {
      const auto& [vx, vy, vz] = numbers_->eights[static_cast<std::size_t>(i)];
      const __m256 sum = _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, _mm256_load_ps(vx.data())), _mm256_mul_ps(y, _mm256_load_ps(vy.data()))), _mm256_mul_ps(z, _mm256_load_ps(vz.data())));
      const __m256i place = _mm256_or_si256(places, _mm256_set1_epi32(4 * i));
      height[i] = _mm256_or_ps(_mm256_andnot_ps(_mm256_castsi256_ps(_mm256_set1_epi32(31)), sum), _mm256_castsi256_ps(place));
    }
    const __m256 eight = _mm256_max_ps(_mm256_max_ps(height[0], height[1]), _mm256_max_ps(height[2], height[3]));
    __m128 greatest = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
    greatest = _mm_max_ps(greatest, _mm_permute_ps(greatest, 0b01001110));
    greatest = _mm_max_ps(greatest, _mm_permute_ps(greatest, 0b10110001));
    const __m256 bar = _mm256_set1_ps(_mm_cvtss_f32(greatest) - (size * far_ * near + std::numeric_limits<float>::min()));
    __m256i high[4];
    for (int i = 0; i < 4; ++i) high[i] = _mm256_castps_si256(_mm256_cmp_ps(height[i], bar, _CMP_NLT_UQ));
    const __m256i all = _mm256_packs_epi16(_mm256_packs_epi32(high[0], high[1]), _mm256_packs_epi32(high[2], high[3]));
    return {static_cast<unsigned>(_mm_cvtsi128_si32(_mm_castps_si128(greatest))) % unsigned{most}, static_cast<unsigned>(_mm256_movemask_epi8(all))};
  }

  /// The place of the highest along (x, y, z) of those whose bits are set; of several as high the first, which is the one that GreatestOfFours takes.
  std::size_t settled(unsigned high, double x, double y, double z) const;

  const double* vertex(std::size_t place) const { return numbers_->vertices.data() + 3 * place; }  ///< x, y, z, and one number more may be read

 private:
  struct alignas(64) Numbers {
    std::array<std::array<std::array<float, 8>, 3>, most / 8> eights;
    std::array<double, 3 * most + 1> vertices;
  };

  std::shared_ptr<const Numbers> numbers_;
  static constexpr float near = 1e-5F;  ///< times t: heights nearer to one another may be the other way round
  float far_ = 0;                       ///< the greatest coordinate
  unsigned all_ = 0;  ///< a bit for the place of each vertex
};

}  // namespace gjkdbg
#endif
