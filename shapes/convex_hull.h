// The convex hull of a point set: its extreme vertices, faces and edges.
//
// Hulls in space come from Qhull (Barber, Dobkin, Huhdanpaa 1996); flat, collinear and single-point sets are handled
// here. Used to reduce hulls to their extreme vertices, for their table of directions, for contact polygons and for display. Our
// GJK and EPA never see it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "shapes/vector.h"

namespace gjkdbg {

/// All indices are into the points handed in, which are never changed.
struct ConvexHull {
  int rank = 0;               ///< 0 a point, 1 a segment, 2 flat, 3 a solid (at most the dimension)
  std::vector<int> vertices;  ///< the extreme points, ascending, without duplicates
  /// 3D solids: polygons, coplanar triangles merged, counter-clockwise seen from outside. Flat in 3D: the polygon twice, once each
  /// way. 2D: one loop, counter-clockwise. Rank 0 and 1: empty.
  std::vector<std::vector<int>> faces;
  std::vector<std::array<int, 2>> edges;  ///< smaller index first, each once
  /// Adjacency by position in `vertices`: the neighbours of vertices[i] are the positions
  /// neighbours[first_neighbour[i]] .. neighbours[first_neighbour[i + 1] - 1]. Empty when all distinct points were kept.
  std::vector<int> first_neighbour, neighbours;
};

/// `points`: at least one, finite, all of `dimension` 1, 2 or 3 rows. Never loses an extreme point by more than
/// rounding: where Qhull gives up (a set thinner than it can judge), all distinct points are kept, and `faces` and `edges`
/// may be empty. (Its hull is checked up to 1e7 pairs of a face and a point; beyond, it is believed.)
ConvexHull convex_hull(std::span<const AnyVector> points, int dimension);

}  // namespace gjkdbg
