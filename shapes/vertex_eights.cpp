#include "shapes/vertex_eights.h"

#ifdef GJKDBG_AVX2
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace gjkdbg {
namespace {

/// Of vertices as high as one another, which of two places GreatestOfFours takes: it compares columns 2 and 3 with 0 and 1 first, and keeps the first of each. The last vertex stands in
/// VertexFours for those that its four lacks, too.
std::size_t rank_of(std::size_t place, std::size_t size) {
  const auto rank = [](std::size_t of) { return std::array<std::size_t, 4>{0, 2, 1, 3}[of % 4] * VertexEights::most + of; };
  std::size_t first = rank(place);
  if (place == size - 1)
    for (std::size_t copy = place + 1; copy % 4 != 0; ++copy) first = std::min(first, rank(copy));
  return first;
}

}  // namespace

/// Where fewer than 32 are left, their middle: it is never alone the highest.
VertexEights::VertexEights(const VertexFours<3, double>& vertices) : all_(vertices.size() < most ? (1U << vertices.size()) - 1 : ~0U) {
  const std::size_t size = vertices.size();
  const auto numbers = std::make_shared<Numbers>();
  std::array<std::size_t, most> order;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(size), [&](std::size_t i, std::size_t j) { return rank_of(i, size) < rank_of(j, size); });
  Vector<3, double> middle = Vector<3, double>::Zero();
  for (std::size_t i = 0; i < size; ++i) middle += vertices[i] / static_cast<double>(size);
  double far = 0;
  for (std::size_t bit = 0; bit < most; ++bit) {
    const Vector<3, double> v = bit < size ? vertices[order[bit]] : middle;
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = v[static_cast<int>(c)];
      numbers->eights[bit / 4 % 4][c][bit / 16 * 4 + bit % 4] = static_cast<float>(x), numbers->vertices[3 * bit + c] = x;  // packed by halves of vectors
      far = std::max(far, std::abs(x));
    }
  }
  far_ = static_cast<float>(far) + std::numeric_limits<float>::min();
  numbers_ = numbers;
}

[[gnu::target("avx2")]] std::size_t VertexEights::settled(unsigned high, double x, double y, double z) const {
  double greatest = -std::numeric_limits<double>::infinity();
  unsigned found = 0;
  for (high &= all_; high != 0; high &= high - 1) {
    const unsigned place = static_cast<unsigned>(std::countr_zero(high));
    const double* const v = vertex(place);
    const double height = v[0] * x + v[1] * y + v[2] * z;
    const bool higher = height > greatest;
    greatest = higher ? height : greatest, found = higher ? place : found;
  }
  return found;
}

}  // namespace gjkdbg
#endif
