// cast: when moving bodies meet for the first time, and what becomes of their motion then.
//
// Bodies move with constant velocity v and angular velocity w over the unit interval. Three methods:
//
// Conservative advancement (Mirtich 1996; bound after Lin 1993). With the bodies d apart along the unit normal n, from A to B, no point of A moves
// along n faster than vA . n + |wA x n| rA (a point r from the centre moves with v + w x r, and (w x r) . n = (n x w) . r <= |n x w| |r|), and
// none of B slower than vB . n - |wB x n| rB. So they come nearer by at most
//
//     bound = (vA - vB) . n + |wA x n| rA + |wB x n| rB
//
// per unit of time: until t + d / bound they cannot meet. Where bound <= 0 they never do along this n, which separates them for good: the pair
// is left out. The time goes on to the least of these over all pairs, and the distances are taken anew.
//
// Of bodies that turn, |n x w| r is mostly too much. With s the speed along n now and k >= |w|^2 r the most it can change by, a gap d is open until
// s t + k t^2 / 2 = d (turning_bound in algo/motion.h); the smaller of the two mean speeds is `bound`. A step ends with half the tolerated gap left.
//
// Root finding (Catto, "Continuous Collision", GDC 2013, with the difference that no root is passed over): the gap along n alone, supports of the
// two moved bodies, is followed to where it closes, and along one that turns on as the last two
// did; the longer counts (algo/root_finding.h). Only then GJK is asked for a new n.
//
// Where GJK or EPA comes to its limit, normal and distance are not known: no step from there is safe, and the cast ends at its own limit. An overlap at
// the beginning is told all the same when it is proven, without a normal.
//
// Ray cast (van den Bergen, "Ray Casting against General Convex Objects", 2004): bodies that do not turn meet at time t when t (vB - vA)
// lies in A - B; GJK walks along that ray. See algo/ray_cast.h.
#pragma once

#include "algo/solve.h"

namespace gjkdbg {

inline constexpr int most_responses = 64;  ///< then a cast ends at the next impact

/// `scene.query` is cast. The times are of [0, 1]; `trace` may be null.
Result cast(const Scene& scene, const Settings& settings, TraceSink* trace);

}  // namespace gjkdbg
