#include "shapes/vertex_eights.h"

#ifdef GJKDBG_AVX2
#include <algorithm>
#include <bit>
#include <cmath>

namespace gjkdbg {
namespace {

/// GreatestOfFours compares columns 2 and 3 with 0 and 1 first, and keeps the first of each.
std::size_t first_by_column(unsigned found) {
  constexpr unsigned column = 0x11111111;
  for (const int k : {0, 2, 1})
    if (const unsigned of_column = found & (column << k)) return static_cast<std::size_t>(std::countr_zero(of_column));
  return static_cast<std::size_t>(std::countr_zero(found));
}

}  // namespace

/// Where fewer than 32 are left, their middle: it is never alone the highest.
VertexEights::VertexEights(const VertexFours<3, double>& vertices) : size_(static_cast<unsigned>(vertices.size())) {
  const auto numbers = std::make_shared<Numbers>();
  Vector<3, double> middle = Vector<3, double>::Zero();
  for (std::size_t i = 0; i < size_; ++i) middle += vertices[i] / size_;
  double far = 0;
  for (std::size_t i = 0; i < most; ++i) {
    const Vector<3, double> v = i < size_ ? vertices[i] : middle;
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = v[static_cast<int>(c)];
      numbers->eights[i / 8][c][i % 8] = static_cast<float>(x), numbers->vertices[3 * i + c] = x;
      far = std::max(far, std::abs(x));
    }
  }
  far_ = static_cast<float>(far) + std::numeric_limits<float>::min();
  numbers_ = numbers;
}

std::size_t VertexEights::settled(unsigned high, const double* d) const {
  double greatest = -std::numeric_limits<double>::infinity();
  unsigned found = 0;
  for (; high != 0; high &= high - 1) {
    const unsigned bit = static_cast<unsigned>(std::countr_zero(high)), place = bit / 4 % 4 * 8 + bit / 16 * 4 + bit % 4;  // packed by halves of vectors
    if (place >= size_) continue;
    const double* const v = vertex(place);
    const double height = v[0] * d[0] + v[1] * d[1] + v[2] * d[2];
    if (!(height >= greatest)) continue;
    if (height > greatest) greatest = height, found = 0;
    found |= 1U << place;
  }
  if (found == 0) return 0;  // no numbers
  const unsigned last = size_ - 1;  // stands in VertexFours for those that its four lacks
  if ((found >> last & 1) != 0) found |= (2U << (last | 3)) - (1U << last);
  return std::min<std::size_t>(first_by_column(found), last);
}

}  // namespace gjkdbg
#endif
