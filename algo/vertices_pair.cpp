#include "algo/vertices_pair.h"

#ifdef GJKDBG_AVX2
#include "algo/minkowski_difference.h"
#include "shapes/three_avx2.h"

namespace gjkdbg {
namespace {

/// The point of A's vertex and B's, whose numbers lie `stride` from one another.
GJKDBG_LANES void write(SupportPoint<3, double>& point, const RelativePose<3, double>& pose, const Lanes& at_a, const double* b, std::size_t stride) {
  const Lanes of_b = turned(pose.rotation, _mm256_broadcast_sd(b), _mm256_broadcast_sd(b + stride), _mm256_broadcast_sd(b + 2 * stride));
  const Lanes at_b = _mm256_add_pd(of_b, three(pose.position.data()));
  // Four numbers at once, the last of them to be written over, so that any of the three may be read as soon as it is written, one or two at once.
  _mm256_storeu_pd(point.w.data(), _mm256_sub_pd(at_a, at_b));
  _mm256_storeu_pd(point.a.data(), at_a);
  store_three(point.b.data(), at_b);
}

/// The highest along (x, y, z) of those whose bits are set. What it costs is the time until the bits are known, which the places met last do not wait for: of them it
/// is known beforehand which is the highest, and it mostly is one of them, for a direction across an edge or a face is that of the simplex.
GJKDBG_LANES unsigned highest_of(const VertexEights& vertices, unsigned high, std::uint32_t last, double x, double y, double z) {
  double greatest = -std::numeric_limits<double>::infinity();
  unsigned found = 0, met = 0;
  for (int i = 0; i < 4; ++i, last >>= 8) {
    const unsigned place = last & 0xff;
    const double* const v = vertices.vertex(place);
    const double height = v[0] * x + v[1] * y + v[2] * z;
    const bool higher = (height > greatest) | ((height == greatest) & (place < found));
    greatest = higher ? height : greatest, found = higher ? place : found, met |= 1U << place;
  }
  if ((high & ~met) != 0) [[unlikely]] return static_cast<unsigned>(vertices.settled(high, x, y, z));
  return found;
}

/// A table's vertex along d.
struct Found {
  const double* x;
  Vector<3, double> of_several;  ///< where more than a cell was looked at
  std::size_t stride = HullCore<double>::stride;

  GJKDBG_LANES Found(const HullCore<double>& table, const Lanes& d) : x(table.highest_by_avx2(d)) {
    if (x == nullptr) [[unlikely]] of_several = table.support(Vector<3, double>(d[0], d[1], d[2])), x = of_several.data(), stride = 1;
  }
};

}  // namespace

[[gnu::target("avx2"), gnu::always_inline]] inline void VerticesPair::end(SupportPoint<3, double>& point, const RelativePose<3, double>& pose, unsigned a, unsigned b) {
  last_a_ = last_a_ << 8 | a, last_b_ = last_b_ << 8 | b;
  write(point, pose, _mm256_loadu_pd(a_->vertex(a)), b_->vertex(b), 1);
}

/// What all else waits for is body 1: its direction is turned before, and its point after.
[[gnu::target("avx2")]] void VerticesPair::support(const RelativePose<3, double>& pose, double x, double y, double z, SupportPoint<3, double>& point) {
  if (a_ == nullptr) return support_of_tables(pose, x, y, z, point);
  point.w[0] = x, point.w[1] = y, point.w[2] = z;  // for `settled`: where they are handed over, they are no longer where they are needed first
  const float size = static_cast<float>(std::abs(x) + std::abs(y) + std::abs(z)) * 1.75F + std::numeric_limits<float>::min();
  const Lanes towards_a = negative(turned(pose.inverse, _mm256_set1_pd(x), _mm256_set1_pd(y), _mm256_set1_pd(z)));
  const __m128 single = _mm256_cvtpd_ps(towards_a);
  const __m256 twice = _mm256_set_m128(single, single);
  const VertexEights::Highest a = a_->highest(_mm256_set1_ps(static_cast<float>(x)), _mm256_set1_ps(static_cast<float>(y)), _mm256_set1_ps(static_cast<float>(z)), size);
  const VertexEights::Highest b = b_->highest(_mm256_permute_ps(twice, 0b00000000), _mm256_permute_ps(twice, 0b01010101), _mm256_permute_ps(twice, 0b10101010), size);
  if (!a.sure()) return b.sure() ? settled<true, false>(pose, point, a.high, b.place) : settled<true, true>(pose, point, a.high, b.high);
  if (!b.sure()) return settled<false, true>(pose, point, a.place, b.high);
  end(point, pose, a.place, b.place);
}

template <bool by_a, bool by_b>
void VerticesPair::settled(const RelativePose<3, double>& pose, SupportPoint<3, double>& point, unsigned a, unsigned b) {
  const double x = point.w[0], y = point.w[1], z = point.w[2];
  if constexpr (by_b) {
    const Lanes d = negative(turned(pose.inverse, _mm256_set1_pd(x), _mm256_set1_pd(y), _mm256_set1_pd(z)));
    b = highest_of(*b_, b, last_b_, d[0], d[1], d[2]);
  }
  if constexpr (by_a) a = highest_of(*a_, a, last_a_, x, y, z);
  end(point, pose, a, b);
}

[[gnu::target("avx2")]] void VerticesPair::support_of_tables(const RelativePose<3, double>& pose, double x, double y, double z, SupportPoint<3, double>& point) const {
  const Found b(*table_b_, negative(turned(pose.inverse, _mm256_set1_pd(x), _mm256_set1_pd(y), _mm256_set1_pd(z))));
  const Found a(*table_a_, _mm256_set_pd(0, z, y, x));
  write(point, pose, _mm256_set_pd(0, a.x[2 * a.stride], a.x[a.stride], a.x[0]), b.x, b.stride);
}

}  // namespace gjkdbg
#endif
