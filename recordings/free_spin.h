// What an integrator may add to the energy of a body that spins freely: its own error, over one step.
#pragma once

#include <Eigen/Dense>

#include "shapes/scene.h"

namespace gjkdbg {

/// A bound on how much the energy of the spin rises in a step of length h, by the integrator alone. `rotation`: at the beginning; `inertia`: in the body's
/// axes, about its centre of mass; `momentum`: angular, in world axes, which nothing changes. 0 where the method has no such order (explicit Euler's gains are
/// what it is known for).
double spin_gain(const Eigen::Matrix3d& rotation, const Eigen::Matrix3d& inertia, const Eigen::Vector3d& momentum, double h, Integrator integrator);

}  // namespace gjkdbg
