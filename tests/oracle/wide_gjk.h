// The oracle for curved shapes that are apart: GJK in 50 decimal digits, as plain as can be. Shares nothing with algo/.
#pragma once

#include "shapes/scene.h"

namespace gjkdbg::oracle {

/// The distance of the scene's two bodies to far more digits than a double has; they must be apart.
double wide_distance(const Scene& scene);

}  // namespace gjkdbg::oracle
