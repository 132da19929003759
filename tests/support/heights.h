// Heights of A - B over directions, from the bodies' supports in the world, for tests.
#pragma once

#include "shapes/scene.h"
#include "shapes/world_support.h"

namespace gjkdbg {

class Heights {
 public:
  explicit Heights(const Scene& scene) : a_(scene.bodies[0], scene.dimension), b_(scene.bodies[1], scene.dimension) {}
  AnyVector support(const AnyVector& n) const { return a_(n, true) - b_(-n, true); }
  double along(const AnyVector& n) const { return n.dot(support(n)); }
  /// Downhill from n: against the height's slope, which is what of the support is across n.
  double below(AnyVector n) const {
    double least = along(n), step = 1;
    for (int i = 0; i < 30; ++i) {
      const AnyVector w = support(n), slope = w - n * n.dot(w), next = (n - step * slope).normalized();
      if (const double height = along(next); height < least) least = height, n = next;
      else step /= 2;
    }
    return least;
  }

 private:
  WorldSupport a_, b_;
};

}  // namespace gjkdbg
