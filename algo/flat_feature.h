// The flat part of a body's surface that looks most along a direction: a face, an edge in the plane, the end of a cylinder, the line on its side.
#pragma once

#include <optional>
#include <vector>

#include "shapes/scene.h"

namespace gjkdbg {

struct Disc {
  Eigen::Vector3d center, normal;  ///< normal: unit, outwards
  double radius = 0;
};

/// Of a body's core, in the world's frame.
struct FlatFeature {
  std::vector<AnyVector> points;  ///< a face's corners in order, the ends of an edge or a line, or, where there is neither, all corners; of a disc none
  std::optional<Disc> disc;
  double alignment = -2;  ///< cosine of the angle between its outward normal and the direction; -2 where it is no face
  double radius = 0;      ///< around the core
  double size = 0;        ///< of the body, in the largest norm and within a factor of two
};

/// `direction`: unit. Nothing for ellipsoids, for sums of round shapes, and on a line.
std::optional<FlatFeature> flat_feature(const Body& body, const AnyVector& direction);

}  // namespace gjkdbg
