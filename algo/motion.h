// Bodies that move: where they are at a time, and the static query that everything about motion is made of.
#pragma once

#include "algo/solve.h"
#include "algo/world_trace.h"

namespace gjkdbg {

/// A static query on two bodies within a longer trace: vertex and face numbers go on from `numbers`. `trace` may be null.
/// With Start::previous GJK begins with `simplex` (or, when null, `initial_simplex`) and leaves its last one there; not where a mesh is one of the bodies.
Result solve_static(const Scene& scene, const Settings& settings, TraceSink* trace, TraceNumbers& numbers, std::vector<SimplexPoint>* simplex = nullptr);

/// The rotation by an angular velocity over a time: exp(w t), after Rodrigues. 1D: the identity.
AnyMatrix rotation_by(const AnyVector& angular_velocity, double time, int dimension);

/// The unit quaternion w x y z of a rotation; in the plane about z.
std::vector<double> orientation_of(const AnyMatrix& rotation);

/// The body moved on by its velocities for a time, turning about its pose's position. A body without motion stays.
Body moved(const Body& body, double time, int dimension);

/// A mesh is its triangles, each a convex set of its own; anything else is itself.
std::vector<Shape> convex_parts(const Shape& shape);

/// How far the body reaches from its pose's position.
double reach_of(const Shape& shape, int dimension);

/// The settings for the static queries inside a cast or a simulation.
Settings static_settings(const Settings& settings);

}  // namespace gjkdbg
