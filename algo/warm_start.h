// The simplex that a run of GJK hands on to the next.
#pragma once

#include <array>
#include <vector>

#include "algo/settings.h"
#include "shapes/convex.h"

namespace gjkdbg {

/// The simplex GJK ended with, for the next run on the same bodies to begin with: its points in the cores' own frames, which stay
/// points of the bodies wherever these move. (Cameron 1997; Box2D keeps the vertices' numbers, which only polytopes have.)
template <int D, class S>
struct WarmStart {
  int size = 0;
  std::array<Vector<D, S>, D + 1> a{}, b{};
};

/// From points in the bodies' frames and back: the cores' are relative to their references, and scaled.
template <int D, class S>
WarmStart<D, S> warm_start(const std::vector<SimplexPoint>& points, const Convex<D, S>& a, const Convex<D, S>& b, double scale) {
  WarmStart<D, S> warm;
  for (const SimplexPoint& p : points) {
    const Vector<D, double> pa = p.a * scale - a.reference(), pb = p.b * scale - b.reference();
    warm.a[warm.size] = pa.template cast<S>(), warm.b[warm.size++] = pb.template cast<S>();
  }
  return warm;
}
template <int D, class S>
std::vector<SimplexPoint> simplex_points(const WarmStart<D, S>& warm, const Convex<D, S>& a, const Convex<D, S>& b, double scale) {
  std::vector<SimplexPoint> points;
  for (int i = 0; i < warm.size; ++i)
    points.push_back({(warm.a[i].template cast<double>() + a.reference()) / scale, (warm.b[i].template cast<double>() + b.reference()) / scale});
  return points;
}

}  // namespace gjkdbg
