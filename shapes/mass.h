// Centre of mass and inertia of a shape of mass 1, evenly filled.
#pragma once

#include "shapes/shape.h"

namespace gjkdbg {

struct MassProperties {
  Vector<3, double> center = Vector<3, double>::Zero();    ///< in the body's frame; missing coordinates are 0
  Matrix<3, double> inertia = Matrix<3, double>::Zero();   ///< about the centre, body axes; in the plane only zz counts
};

/// Exact for sphere, box, capsule, cylinder, cone, ellipsoid and point sets of any rank (solid, lamina, rod, point), in 3D and 2D. A margin on
/// what is not a sphere or a capsule, and a sum, are filled by some hundred support points: about a thousandth off. A mesh: nothing.
/// On a line only the centre is told.
MassProperties mass_properties(const Shape& shape, int dimension);

}  // namespace gjkdbg
