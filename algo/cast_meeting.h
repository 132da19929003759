// What a cast keeps while it looks for the first meeting: pairs, gaps, meetings, walls. Of cast.cpp.
#pragma once

#include "algo/status.h"
#include "shapes/shape.h"

namespace gjkdbg {

/// Two convex parts of two bodies that still may meet. A mesh has a part for each triangle: what separates one of them separates no other.
struct Pair {
  int first, second;
  const Shape *shape_a, *shape_b;
  bool open = true;
  double last_time = -1, last_distance = 0;  ///< when its gap was looked at before; < 0: not yet
  AnyVector last_normal{};
};

/// What is known of a pair at a time.
struct Gap {
  double distance = 0;
  AnyVector normal, witness_a, witness_b;
  double closing = 0;  ///< how fast it closes at most along the normal, whichever way the bodies turn
  double bound = 0;    ///< how fast until they can meet; at most `closing`
  bool known = true;   ///< false: GJK or EPA came to its limit; the distance may be less, the depth too, and the normal another
  double at_most = 0;  ///< the distance
};

/// What a body was turned off by.
struct Wall {
  int body;
  AnyVector normal;  ///< into the wall
};

struct Meeting {
  CastStatus status = CastStatus::miss;
  double time = 0;  ///< since the beginning of the stretch
  Pair pair{-1, -1, nullptr, nullptr};
  Gap gap;
};

}  // namespace gjkdbg
