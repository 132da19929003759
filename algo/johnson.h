// Johnson's sub-algorithm: the closest point of a simplex to the origin by cofactors, with the backup procedure.
//
// Gilbert, Johnson, Keerthi 1988, section V; written as in van den Bergen 1999. For a subset X of the vertices the point of its
// affine hull nearest the origin is sum_i D_i(X) w_i / D(X), D(X) = sum_i D_i(X), where
//   D_i({i}) = 1,     D_j(X + j) = sum over i in X of D_i(X) (w_i . w_k - w_i . w_j),  k any vertex of X.
// X is the answer when D_i(X) > 0 for all i in X and D_j(X + j) <= 0 for all others: the weights are positive, and every other
// vertex lies beyond. Rounding can leave no X with both; the backup procedure then takes the nearest of those with positive weights.
// Known weakness: the cofactors are products of up to six lengths, and for slivers rounding decides their signs. No guard is added here:
// this is the method to compare with, not the default.
#pragma once

#include "algo/enclosing_simplex.h"

namespace gjkdbg {

template <int D, class S>
class Johnson {
  using V = Vector<D, S>;
  using Feature = ClosestFeature<D, S>;
  static constexpr int most = D + 1;

 public:
  using Grown = void;

  /// `w`: `size` vertices, 1 <= size <= D + 1.
  static Feature closest(const V* w, int size) {
    Johnson j(w, size);
    Feature backup;
    for (unsigned x = 1; x < 1u << size; ++x) {
      if (!j.positive(x)) continue;
      const Feature candidate = j.feature(x);
      if (j.others_beyond(x)) return candidate;
      if (backup.count == 0 || candidate.v_squared < backup.v_squared) backup = candidate;
    }
    return backup;
  }

 private:
  Johnson(const V* w, int size) : w_(w), size_(size) {
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) dot_[i][j] = w[i].dot(w[j]);
    for (unsigned x = 1; x < 1u << size; ++x) cofactors(x);
  }

  static bool has(unsigned x, int i) { return (x >> i & 1u) != 0; }

  /// D_j(x) for all j in x, from the subsets without j: they come earlier.
  void cofactors(unsigned x) {
    for (int j = 0; j < size_; ++j) {
      if (!has(x, j)) continue;
      const unsigned rest = x & ~(1u << j);
      if (rest == 0) {
        delta_[x][j] = 1;
        continue;
      }
      int k = 0;
      while (!has(rest, k)) ++k;
      S sum = 0;
      for (int i = 0; i < size_; ++i)
        if (has(rest, i)) sum += delta_[rest][i] * (dot_[i][k] - dot_[i][j]);
      delta_[x][j] = sum;
    }
  }

  bool positive(unsigned x) const {
    for (int i = 0; i < size_; ++i)
      if (has(x, i) && !(delta_[x][i] > 0)) return false;
    return true;
  }

  bool others_beyond(unsigned x) const {
    for (int j = 0; j < size_; ++j)
      if (!has(x, j) && delta_[x | 1u << j][j] > 0) return false;
    return true;
  }

  Feature feature(unsigned x) const {
    if (size_ == most && x == (1u << most) - 1) return EnclosingSimplex<D, S>::feature(w_, delta_[x]);
    Feature f;
    S sum = 0;
    for (int i = 0; i < size_; ++i)
      if (has(x, i)) sum += delta_[x][i];
    for (int i = 0; i < size_; ++i) {
      if (!has(x, i)) continue;
      f.index[f.count] = i;
      f.weight[f.count] = delta_[x][i] / sum;
      f.v += f.weight[f.count++] * w_[i];
    }
    f.v_squared = f.v.dot(f.v);
    return f;
  }

  const V* w_;
  int size_;
  std::array<std::array<S, most>, most> dot_{};
  std::array<std::array<S, most>, 1u << most> delta_{};
};

}  // namespace gjkdbg
