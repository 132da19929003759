// Numbers four by four, and the greatest of many: four run side by side, each of which keeps its own greatest.
//
// No comparison is a branch, for which of many numbers is the greatest is nothing a processor can guess; and the fours are vectors for the
// compiler (two of two doubles, one of four floats), which it does not make of a loop with comparisons by itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace gjkdbg {

template <class S>
struct Four {
  using Place = std::conditional_t<sizeof(S) == 8, std::int64_t, std::int32_t>;  ///< as wide as S
  typedef S Values __attribute__((vector_size(16)));
  typedef Place Places __attribute__((vector_size(16)));
  static constexpr int width = 16 / static_cast<int>(sizeof(S)), parts = 4 / width;

  Values part[parts];

  const S* data() const { return reinterpret_cast<const S*>(part); }  ///< the four, one after the other
  S operator[](std::size_t k) const { return data()[k]; }
  void set(std::size_t k, S value) { reinterpret_cast<S*>(part)[k] = value; }
};

template <class S>
typename Four<S>::Values greater_of(typename Four<S>::Values a, typename Four<S>::Values b) {
#ifdef __SSE2__  // one instruction, which compilers do not find by themselves
  if constexpr (sizeof(S) == 8) return _mm_max_pd(a, b);
  else return _mm_max_ps(a, b);
#else
  return a > b ? a : b;
#endif
}
template <class S>
typename Four<S>::Values lesser_of(typename Four<S>::Values a, typename Four<S>::Values b) {
#ifdef __SSE2__
  if constexpr (sizeof(S) == 8) return _mm_min_pd(a, b);
  else return _mm_min_ps(a, b);
#else
  return a < b ? a : b;
#endif
}

template <class S>
class GreatestOfFours {
  using F = Four<S>;
  using Values = typename F::Values;
  using Place = typename F::Place;
  using Places = typename F::Places;

 public:
  GreatestOfFours() {
    for (Values& most : most_) most = Values{} - std::numeric_limits<S>::infinity();
  }
  void take(const F& values) {
    for (int i = 0; i < F::parts; ++i) {
      from_[i] = chosen(values.part[i] > most_[i], count_, from_[i]);
      most_[i] = greater_of<S>(values.part[i], most_[i]);
    }
    count_ += 1;
  }

  /// Where the greatest stands among the numbers taken, and what it is; the first where none is greater than -infinity.
  struct Found {
    std::size_t place;
    S value;
  };
  Found found() const {
    Values most = most_[0];
    Places place = 4 * from_[0];
    for (int i = 1; i < F::parts; ++i) {
      place = chosen(most_[i] > most, 4 * from_[i] + F::width * i, place);
      most = greater_of<S>(most_[i], most);
    }
    int best = 0;
    for (int k = 1; k < F::width; ++k) best += (k - best) & -static_cast<int>(most[k] > most[best]);
    return {static_cast<std::size_t>(place[best]) + static_cast<std::size_t>(best), most[best]};
  }

 private:
  static Places chosen(Places which, Places yes, Places no) { return (which & yes) | (~which & no); }

  Values most_[F::parts];
  Places from_[F::parts] = {};  ///< the four in which that stood
  Places count_ = {};
};

}  // namespace gjkdbg
