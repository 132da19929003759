// Vertices four by four, coordinate by coordinate, and the highest of them along a direction.
//
//   x x x x   y y y y   z z z z | x x x x   y y y y   z z z z | …        where fewer than four are left, the last is there again
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "shapes/fours.h"
#include "shapes/vector.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define GJKDBG_AVX2  // instructions that not every processor of the kind has: asked for when the program runs
#endif

namespace gjkdbg {

#ifdef GJKDBG_AVX2
/// The place of the highest vertex along d, of `count` fours of x, y and z.
std::size_t highest_by_avx2(const double* fours, std::size_t count, const double* d);
#endif

template <int D, class S>
class VertexFours {
  using V = Vector<D, S>;

 public:
  void push_back(const V& v) {
    if (size_ % 4 == 0) fours_.emplace_back();
    for (std::size_t k = size_ % 4; k < 4; ++k)
      for (int c = 0; c < D; ++c) fours_.back()[static_cast<std::size_t>(c)].set(k, v[c]);
    ++size_;
  }
  std::size_t size() const { return size_; }
  /// The fours, one after the other: four x, four y, four z, and so on.
  const S* data() const { return fours_[0][0].data(); }
  V operator[](std::size_t i) const {
    V v;
    for (int c = 0; c < D; ++c) v[c] = fours_[i / 4][static_cast<std::size_t>(c)][i % 4];
    return v;
  }

  /// The highest along d, of one vertex at least; of several as high, any.
  V highest(const V& d) const {
#ifdef GJKDBG_AVX2
    constexpr std::size_t worth_a_call = 3;
    if constexpr (D == 3 && sizeof(S) == 8)
      if (fours_.size() >= worth_a_call && __builtin_cpu_supports("avx2")) return (*this)[highest_by_avx2(fours_[0][0].data(), fours_.size(), d.data())];
#endif
    return highest_anywhere(d);
  }
  /// The same, on every processor.
  V highest_anywhere(const V& d) const {
    GreatestOfFours<S> heights;
    for (const Coordinates& four : fours_) {
      Four<S> height;
      for (int i = 0; i < Four<S>::parts; ++i) {
        height.part[i] = four[0].part[i] * d[0];
        for (int c = 1; c < D; ++c) height.part[i] += four[static_cast<std::size_t>(c)].part[i] * d[c];
      }
      heights.take(height);
    }
    return (*this)[heights.found().place];
  }

 private:
  using Coordinates = std::array<Four<S>, D>;

  std::vector<Coordinates> fours_;
  std::size_t size_ = 0;
};

}  // namespace gjkdbg
