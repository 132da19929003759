// Outlines: of which bodies GJK's overlap is looked along by SAT, instead of EPA or after it (algo/outline_depth.h), whatever the method.
#pragma once

#include <optional>

#include "recordings/recording.h"

namespace gjkdbg {

/// Whether two of the scene's bodies are of such kinds, and the query asks for a depth: it may depend on how they lie.
bool may_have_outline(const Recording& recording);

/// Bodies of revolution about parallel axes, what is nearly balls, bodies of revolution about nearly one line; or by their bends: spheroids about nearly one line, and all ellipsoids, rods and sums of such that EPA gave up on.
enum class OutlineKind { parallel_axes, near_balls, tilted_axes, bends };

/// Of two bodies as they lie.
struct DepthOutline {
  OutlineKind kind = OutlineKind::parallel_axes;
  int edges_of_a = 0, edges_of_b = 0;
  double slack = 0;    ///< how much less the depth may be than is found along them
  bool curved = true;  ///< or all of its edges are known
};
/// Unset: none. The scene's two bodies must be convex.
std::optional<DepthOutline> outline_of(const Recording& recording);

}  // namespace gjkdbg
