// The closest point of a simplex to the origin by brute force in twice the precision: slow, and as good as exact.
//
// Every vertex, every edge and in 3D every triangle is tried: the origin is projected on its affine hull, and among those
// whose projection has no negative weight the nearest one is the answer.
// Called where the fast sub-algorithms meet a sliver they cannot judge.
#pragma once

#include <optional>

#include "algo/simplex.h"
#include "algo/wide.h"

namespace gjkdbg {

template <int D, class S>
class WideClosestPoint {
  using W = Wide<S>;
  using WV = WideVector<S>;

 public:
  /// `w`: `size` vertices, 1 <= size <= D + 1. Never reports `enclosed`: the sides of the full simplex are for the
  /// caller to judge; it is asked for the nearest point of the boundary. (In 1D the edge is the
  /// whole simplex: the origin inside it is v = 0, with two weights.)
  static ClosestFeature<D, S> of_boundary(const Vector<D, S>* w, int size) {
    WideClosestPoint search(w, size);
    for (int i = 0; i < size; ++i) search.vertex(i);
    for (int i = 0; i < size; ++i)
      for (int j = i + 1; j < size; ++j) search.segment(i, j);
    if constexpr (D == 3)
      for (int i = 0; i < size; ++i)
        for (int j = i + 1; j < size; ++j)
          for (int k = j + 1; k < size; ++k) search.triangle(i, j, k);
    return search.best_;
  }

 private:
  WideClosestPoint(const Vector<D, S>* w, int size) {
    for (int i = 0; i < size; ++i) w_[i] = WV(w[i]);
  }

  void vertex(int i) { offer({i}, {W(1.0)}, 1); }

  /// Weights of the projection on the line: t = -w_i . e / e . e for w_j, with e = w_j - w_i.
  void segment(int i, int j) {
    const WV e = w_[j] - w_[i];
    const W length = e.dot(e);
    const W tj = -w_[i].dot(e), ti = w_[j].dot(e);
    if (sign(length) <= 0 || sign(ti) <= 0 || sign(tj) <= 0) return;
    offer({i, j}, {divide(ti, length), divide(tj, length)}, 2);
  }

  /// With n = (w_j - w_i) x (w_k - w_i), the weight of w_i is n . (w_j x w_k) / n . n, and so on around: the signed area of
  /// the projected origin with the opposite edge. Differences keep the products small.
  void triangle(int i, int j, int k) {
    const WV ij = w_[j] - w_[i], jk = w_[k] - w_[j], ki = w_[i] - w_[k];
    const WV n = ij.cross(jk);
    const W area = n.dot(n);
    const W ai = n.dot(w_[j].cross(jk)), aj = n.dot(w_[k].cross(ki)), ak = n.dot(w_[i].cross(ij));
    if (sign(area) <= 0 || sign(ai) <= 0 || sign(aj) <= 0 || sign(ak) <= 0) return;
    offer({i, j, k}, {divide(ai, area), divide(aj, area), divide(ak, area)}, 3);
  }

  void offer(const std::array<int, 3>& index, const std::array<W, 3>& weight, int count) {
    WV v = weight[0] * w_[index[0]];
    for (int i = 1; i < count; ++i) v = v + weight[i] * w_[index[i]];
    const W squared = v.dot(v);
    if (best_.count > 0 && sign(best_squared_ - squared) <= 0) return;
    best_squared_ = squared;
    best_.count = count;
    for (int i = 0; i < count; ++i) {
      best_.index[i] = index[i];
      best_.weight[i] = static_cast<S>(static_cast<double>(weight[i]));
    }
    best_.v = v.template rounded<D>();
    best_.v_squared = best_.v.dot(best_.v);
  }

  std::array<WV, D + 1> w_;
  ClosestFeature<D, S> best_;
  W best_squared_{};
};

}  // namespace gjkdbg
