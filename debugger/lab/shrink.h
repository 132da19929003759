// The simplest scene that still fails in the same way.
#pragma once

#include <functional>

#include "shapes/scene.h"

namespace gjkdbg {

/// Body 0 brought to the origin, turns undone, points left out, and every number of places and shapes rounded to as few digits as do: each step is kept
/// when the scene that comes of it is valid and `still` fails so. At most `most` scenes are asked about; at first the given one, which comes back as it is
/// when it does not fail.
Scene shrunk(Scene scene, const std::function<bool(const Scene&)>& still, int most);

}  // namespace gjkdbg
