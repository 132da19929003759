// The origin's weights within a full simplex: the parts' sizes over the whole, in twice the precision where plain arithmetic has lost them.
//
// With the origin in the place of vertex i, the simplex has volume |det(the other vertices)| / D!, and the origin is the sum of the vertices weighed by
// these. The volumes of a simplex nearly flat are sums that cancel: where their weights miss the origin by more than half the digits, they are
// summed again in twice the precision. That may show the origin outside, by less than the sub-algorithm could tell: the weights are those of the
// boundary's nearest point then.
#pragma once

#include <cmath>
#include <limits>

#include "algo/closest_point_wide.h"
#include "algo/wide.h"

namespace gjkdbg {

template <int D, class S>
class EnclosingSimplex {
  using V = Vector<D, S>;
  using Sizes = std::array<S, D + 1>;

 public:
  /// `w`: D + 1 vertices around the origin; `sizes`: of the parts, to any one factor.
  static ClosestFeature<D, S> feature(const V* w, const Sizes& sizes) {
    ClosestFeature<D, S> f;
    f.count = D + 1, f.enclosed = true;
    for (int i = 0; i <= D; ++i) f.index[i] = i;
    weigh(sizes, f);
    S far = 0;
    V missed = V::Zero();
    for (int i = 0; i <= D; ++i) far = std::max(far, w[i].cwiseAbs().maxCoeff()), missed += f.weight[i] * w[i];
    if (!(missed.cwiseAbs().maxCoeff() <= std::sqrt(std::numeric_limits<S>::epsilon()) * far)) weigh_wide(w, f);
    return f;
  }

 private:
  static void weigh(const Sizes& sizes, ClosestFeature<D, S>& f) {
    S sum = 0;
    for (const S size : sizes) sum += size;
    for (int i = 0; i <= D; ++i) f.weight[i] = std::abs(sum) > 0 ? sizes[i] / sum : S(1) / (D + 1);
  }

  /// By Cramer's rule part i is (-1)^i det(the others), up to a factor: of the whole's sign, or the origin lies beyond its face.
  [[gnu::noinline]] static void weigh_wide(const V* w, ClosestFeature<D, S>& f) {
    std::array<WideVector<S>, 4> v;
    for (int i = 0; i <= D; ++i) v[i] = WideVector<S>(w[i]);
    if constexpr (D < 3) v[3].c[2] = Wide<S>(1.0);  // the plane's normal
    if constexpr (D < 2) v[2].c[1] = Wide<S>(1.0);
    Sizes sizes;
    S least = 0, most = 0;
    for (int i = 0; i <= D; ++i) {
      std::array<int, 3> others{3, D < 2 ? 2 : 3, 3};
      for (int j = 0, n = 0; j <= D; ++j)
        if (j != i) others[n++] = j;
      const S size = static_cast<S>(static_cast<double>(v[others[0]].cross(v[others[1]]).dot(v[others[2]])));
      sizes[i] = i % 2 == 0 ? size : -size;
      least = std::min(least, sizes[i]), most = std::max(most, sizes[i]);
    }
    if (least == 0 || most == 0) return weigh(sizes, f);
    const ClosestFeature<D, S> nearest = WideClosestPoint<D, S>::of_boundary(w, D + 1);
    f.weight = {};
    for (int i = 0; i < nearest.count; ++i) f.weight[nearest.index[i]] = nearest.weight[i];
  }
};

}  // namespace gjkdbg
