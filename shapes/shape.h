// What a convex set is, as a person describes it: the shapes of the scene format, with their sizes.
//
// This is the description only. `shapes/convex.h` turns it into the set the algorithms see: a core with a
// support mapping, plus a radius. All shapes live in their body's frame, lengths in scene units.
// A shape made by hand must pass `validate` before it is used.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "shapes/vector.h"

namespace gjkdbg {

struct Shape;

/// A ball: `sphere` in 3D, `circle` in 2D. Centred at the origin.
struct Sphere {
  double radius = 0;
};

/// An axis-aligned box between two corners; `box` in 2D and 3D, `interval` in 1D.
struct Box {
  AnyVector min, max;
  bool from_half_extents = true;  ///< which of the two notations the scene used; only writing it back cares
};

/// A segment of length 2 * half_height along an axis, with a radius. 2D and 3D.
struct Capsule {
  double radius = 0;
  double half_height = 0;  ///< of the core segment
  int axis = 1;            ///< 0 x, 1 y, 2 z
};

/// A capped cylinder centred at the origin, 3D.
struct Cylinder {
  double radius = 0;
  double half_height = 0;
  int axis = 1;
};

/// A capped cone, apex at +half_height on its axis, base circle at -half_height, 3D.
struct Cone {
  double radius = 0;
  double half_height = 0;
  int axis = 1;
};

/// `ellipse` in 2D, `ellipsoid` in 3D: semi-axes along the coordinate axes. A semi-axis may be zero.
struct Ellipsoid {
  AnyVector radii;
};

enum class PointSetKind { point, segment, triangle, polygon, hull };

/// The convex hull of finitely many points, which may repeat, lie inside, or span less than the space.
struct PointSet {
  PointSetKind kind = PointSetKind::hull;
  std::vector<AnyVector> points;
  std::string mesh;  ///< the OBJ file the points came from, as the scene names it; empty when given in place
};

/// Static triangles, 3D only; not convex: every query runs once per triangle.
struct Mesh {
  std::vector<AnyVector> points;
  std::vector<std::array<int, 3>> triangles;  ///< indices into `points`
  std::string mesh;                           ///< as in PointSet
};

/// The Minkowski sum of two shapes, each in the body's frame.
struct Sum {
  std::shared_ptr<const Shape> first, second;
};

struct Shape {
  std::variant<Sphere, Box, Capsule, Cylinder, Cone, Ellipsoid, PointSet, Mesh, Sum> geometry;
  double margin = 0;  ///< the shape is the sum of `geometry` and a ball of this radius
};

/// Throws Error (place: a JSON pointer relative to the shape) when the shape is not a valid set of the given
/// dimension: non-finite numbers, negative sizes or margins, magnitudes above `largest_length`, a box's min above its max, a point set without
/// points or with the wrong number of them, a mesh without triangles or with a wrong index, a sum that lacks a part or has a mesh for one, an axis or a
/// type that does not exist in this dimension.
void validate(const Shape& shape, int dimension);

/// All lengths times a factor: a power of two rounds nothing.
Shape scaled(const Shape& shape, double by);

/// Lengths beyond this are refused: products of four lengths must stay finite in double.
inline constexpr double largest_length = 1e60;

/// The name of the shape's type in a scene of the given dimension: "sphere", "circle", "interval", …
std::string type_name(const Shape& shape, int dimension);

}  // namespace gjkdbg
