// Contact points of two touching or overlapping bodies, from the normal EPA found.
//
// Of the flat parts of both that look most along the normal (algo/flat_feature.h) the one that looks along it best is the reference; the other one is clipped
// to its sides (Sutherland, Hodgman 1974), and every corner left that lies behind the reference is a contact point with its own depth (Gregorius, "The
// Separating Axis Test between Convex Polyhedra", GDC 2013). The end of a cylinder or a cone is a disc: of its outline count the rim's points an eighth of the
// way around apart, the deepest one first, and those where it meets the other outline. Where no face looks along the normal, lines that lie along
// one another (capsules or cylinders side by side, an edge on one of them) share a piece, and its two ends are the contacts; else (edge across edge, round bodies,
// a normal that EPA left unfinished at its limit) the pair of witness points is.
#pragma once

#include <vector>

#include "algo/result.h"
#include "shapes/scene.h"

namespace gjkdbg {

/// `result`: of the pair's penetration query, overlapping (signed distance <= 0) with normal and witnesses set.
/// World frame; the depth of every contact point is >= 0 and at most that of the pair, to rounding.
std::vector<ContactPoint> contact_points(const Body& a, const Body& b, const Result& result);

/// Contacts of parts of two bodies that are no farther from each other are one: a share of the smaller body's size, and what rounding leaves of a point `far` from the world's origin.
double least_apart(double size_a, double size_b, double far);

}  // namespace gjkdbg
