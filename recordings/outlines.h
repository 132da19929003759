// Outlines: of which bodies GJK's overlap is looked along by SAT, instead of EPA (algo/revolution_sat.h, algo/near_balls.h), whatever the method.
#pragma once

#include <optional>

#include "recordings/recording.h"

namespace gjkdbg {

/// Whether two of the scene's bodies are of such kinds, and the query asks for a depth: it may depend on how they lie.
bool may_have_outline(const Recording& recording);
/// And whether that outline may be curved, so that directions between those known are looked along.
bool may_have_curved_outline(const Recording& recording);

/// Of two bodies as they lie.
struct DepthOutline {
  bool near_balls = false;  ///< or of revolution
  int edges_of_a = 0, edges_of_b = 0;
  double slack = 0;         ///< how much less the depth may be than is found along them
};
/// Unset: none. The scene's two bodies must be convex.
std::optional<DepthOutline> outline_of(const Recording& recording);

}  // namespace gjkdbg
