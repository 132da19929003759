// simulate: rigid bodies through time, with collisions.
//
// Baraff, "An Introduction to Physically Based Modeling: Rigid Body Simulation", SIGGRAPH 1997 course notes. A body is its place x (of its centre of
// mass), its rotation R, its momentum P = m v and its angular momentum L = I w, with I = R I_body R^T. A step of length h:
//
//   1. gravity changes the momenta                        P += m g h
//   2. contacts: every pair whose bounding spheres touch and that may move is asked for its contact points (GJK, EPA)
//   3. impulses j n at the points that approach, one after the other until none does; u the relative velocity there, K its change by a unit impulse:
//        j = -(1 + e) u . n / (n . K n),  K = (1/m_a + 1/m_b) - [r_a] I_a^-1 [r_a] - [r_b] I_b^-1 [r_b]
//      friction: across n, at most mu j. Restitution e of a contact that approaches at no more than twice what gravity gives within the step is none.
//   4. places go on with the new momenta, by the integrator (explicit Euler goes on with the old ones, as it is taught, and before 1)
//   5. of what still overlaps by more than a thousandth of its size two fifths are moved apart: places alone, never velocities
//
// Of a contact whose search came to its limit neither the way nor the depth is known: it holds the bodies, without a bounce, and a warning says so.
// Modelled no further than asked: no angular state in 1D, none of a static body, no GJK for pairs whose bounding spheres are apart.
#pragma once

#include "algo/solve.h"

namespace gjkdbg {

/// `scene.query` is simulate; `trace` may be null.
Result simulate(const Scene& scene, const Settings& settings, TraceSink* trace);

}  // namespace gjkdbg
