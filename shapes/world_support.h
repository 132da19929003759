// A body's support mapping in the world, its dimension known at run time: for whoever stands outside the algorithms.
#pragma once

#include <memory>

#include "shapes/scene.h"

namespace gjkdbg {

class WorldSupport {
 public:
  /// `body`: valid in the dimension, no mesh.
  WorldSupport(const Body& body, int dimension);
  ~WorldSupport();
  WorldSupport(WorldSupport&&) noexcept;

  /// A farthest point of the core along a world direction; of the body, radius included, when `whole` (then along a zero or non-finite direction,
  /// the core's). Always finite.
  AnyVector operator()(const AnyVector& direction, bool whole) const;
  double radius() const;

 private:
  struct Any;
  template <int D>
  struct Of;
  std::unique_ptr<Any> of_;
};

}  // namespace gjkdbg
