// The oracle for polytopes: exact rational arithmetic, brute force over features. Shares nothing with algo/.
//
// Two point sets are given; the answer is the signed distance of their hulls, exact until the last square root.
// Overlap is decided by all directions that can support a facet of A - B: normals of point triples of A and of B,
// and cross products of an edge of each (in the plane: perpendiculars of edges; in lower ranks what remains).
// Distance is the least over all pairs of features (vertex, edge, triangle).
// Doubles only choose which candidates are worth exact evaluation.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "shapes/scene.h"

namespace gjkdbg::oracle {

using Rational = mpq_class;
using Point = std::array<Rational, 3>;  ///< unused coordinates are zero

struct Answer {
  bool intersecting = false;
  double signed_distance = 0;
  std::vector<Eigen::Vector3d> normals;  ///< every unit normal that attains it (one when apart; none kept when they touch flat)
};

/// Hulls of two non-empty point sets, grown by `radius` in all.
Answer signed_distance(const std::vector<Point>& a, const std::vector<Point>& b, int dimension, double radius);

/// The scene's pair, or nothing when a body is round in a way this oracle does not know (anything but boxes, points
/// sets, spheres, capsules, margins and sums of these). Poses are taken as the numbers in their matrices.
std::optional<Answer> signed_distance(const Scene& scene);

}  // namespace gjkdbg::oracle
