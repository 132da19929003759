// Contact points of two touching or overlapping bodies, from the normal EPA found.
//
// For polytopes: of the faces of both that look along the normal, the one that looks along it best is the reference; the
// other body's most opposed face is clipped to its sides (Sutherland, Hodgman 1974), and every corner left that
// lies behind the reference face is a contact point with its own depth (Gregorius, "The Separating Axis Test between
// Convex Polyhedra", GDC 2013). Where no face looks along the normal (edge on edge, round bodies), the pair of
// witness points is the contact.
#pragma once

#include <vector>

#include "algo/result.h"
#include "shapes/scene.h"

namespace gjkdbg {

/// `result`: of the pair's penetration query, overlapping (signed distance <= 0) with normal and witnesses set.
/// World frame; the depth of every contact point is >= 0 and at most that of the pair, to rounding.
std::vector<ContactPoint> contact_points(const Body& a, const Body& b, const Result& result);

}  // namespace gjkdbg
