// What is drawn of a body, and of the difference: hulls for the eye only. The algorithms never see them.
#pragma once

#include <array>
#include <vector>

#include "shapes/scene.h"

namespace gjkdbg {

/// A point of a view: 2D scenes lie in z = 0, 1D scenes on the x axis.
using ViewPoint = Eigen::Vector3d;

ViewPoint to_view(const AnyVector& v);

struct DisplayMesh {
  int dimension = 3;
  std::vector<ViewPoint> points;
  std::vector<std::vector<int>> faces;     ///< counter-clockwise from outside (3D); one loop (2D)
  std::vector<ViewPoint> normals;          ///< of the faces, 3D
  struct DisplayEdge {
    int from, to;
    int face_a = -1, face_b = -1;  ///< the faces it joins
    bool crease = true;            ///< drawn always; others only where they are the outline
  };
  std::vector<DisplayEdge> edges;
};

/// The body in the world, radii and margins included. Meshes become their triangles.
DisplayMesh body_mesh(const Body& body, int dimension);

/// The difference A - B of the two cores, or of the bodies with their radii (`whole`): what the simplex and the polytope live in. Empty for meshes.
DisplayMesh difference_mesh(const Body& a, const Body& b, int dimension, bool whole);

/// The sum of the two radii: the bodies overlap where the cores' difference comes this near to the origin.
double radius_sum(const Body& a, const Body& b, int dimension);

}  // namespace gjkdbg
