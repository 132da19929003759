// Bodies that move: where they are at a time, and the static query that everything about motion is made of.
#pragma once

#include <algorithm>
#include <cmath>

#include "algo/solve.h"
#include "algo/world_trace.h"

namespace gjkdbg {

/// A static query on two bodies within a longer trace: vertex and face numbers go on from `numbers`. `trace` may be null.
/// With Start::previous GJK begins with `simplex` (or, when null, with the settings' `initial_simplex`) and leaves its last one there; where a mesh is one of the
/// bodies it does neither.
Result solve_static(const Scene& scene, const Settings& settings, TraceSink* trace, TraceNumbers& numbers, std::vector<SimplexPoint>* simplex = nullptr);

/// The rotation by an angular velocity (radians per unit of time, world axes) over a time: exp(w t), after Rodrigues. 1D: the identity.
AnyMatrix rotation_by(const AnyVector& angular_velocity, double time, int dimension);

/// The unit quaternion w x y z of a rotation; in the plane about z.
std::vector<double> orientation_of(const AnyMatrix& rotation);
/// An angular velocity as BodyState and FinalState tell it: degrees per unit of time.
std::vector<double> in_degrees(const AnyVector& radians);

/// The body moved on by its velocities for a time, turning about its pose's position. A body without motion stays.
Body moved(const Body& body, double time, int dimension);

/// Its place and its motion: of a mesh a copy takes as long as all its triangles.
inline Body without_shape(const Body& body) { return {"", {Sphere{0}, 0}, body.pose, body.motion}; }

/// A mesh is its triangles, each a convex set of its own; anything else is itself.
std::vector<Shape> convex_parts(const Shape& shape);
/// One of a mesh's, with its margin.
Shape triangle_of(const Shape& mesh, std::size_t number);

/// A length of the scene: no point of the body, its radius or margin included, is farther from `place`, which is in the body's frame (its first coordinates
/// count): by default its pose's position.
double reach_of(const Shape& shape, int dimension, const Eigen::Vector3d& place = Eigen::Vector3d::Zero());

/// How far a turning body comes forward along a unit vector at most in a time t: speed t + change t^2 / 2.
struct TurningBound {
  double speed = 0, change = 0;
  /// The mean speed at most until a gap d > 0 closes. It is open until t = 2 d / (s + sqrt(s^2 + 2 k d)). No shorter gap d' closes at a higher mean speed: t is
  /// concave in d and not negative at 0, so t(d') / d' >= t(d) / d. With s < 0 the other form of the root cancels nothing.
  double until_closed(double gap) const {
    const double up = std::max({std::abs(speed), change, gap}) < 1e-140 ? 0x1p600 : 1;  // squares below 1e-308 vanish; a power of two rounds nothing
    const double s = speed * up, k = change * up, d = gap * up, root = std::sqrt(s * s + 2 * k * d);
    return (s >= 0 ? (s + root) / 2 : d * k / (root - s)) / up;
  }
};
/// From where `body` is now; its velocity apart. 2D and 3D; zero for a body that does not turn. A point r of it, seen from its position, moves along
/// n by n . (w x r) = r . (n x w), of which the support along n x w is the most; the second derivative is at most |w|^2 |r|, with `reach` the
/// largest |r|.
TurningBound turning_bound(const Body& body, const AnyVector& angular_velocity, const AnyVector& n, double reach);

/// The square of a length below 1e-154 vanishes: such vectors are measured in units of 2^-600, which rounds nothing. (Eigen's stableNorm divides by the largest number, and
/// that rounds: the same bodies in another unit would meet at another time.)
inline double norm_of_any_size(const AnyVector& v) {
  const double most = v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0;
  return most < 1e-140 ? (v * 0x1p600).norm() * 0x1p-600 : v.norm();
}

/// The settings for the static queries inside a cast or a simulation.
Settings static_settings(const Settings& settings);

}  // namespace gjkdbg
