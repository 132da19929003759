// The faces and edges of a polytope's core, as far as the separating axis test needs them: which way they face.
#pragma once

#include <optional>
#include <vector>

#include "shapes/shape.h"

namespace gjkdbg {

/// Unit, the outward one of a face whose corners are in order (in the plane: of an edge).
AnyVector normal_of(const std::vector<AnyVector>& face);

struct EdgeFeature {
  AnyVector direction;    ///< unit
  AnyVector left, right;  ///< outward unit normals of the two faces it joins; empty (size() 0) when the polytope is no solid
};

/// In the axes of the body. A flat polytope in space has two faces, a segment none.
struct Features {
  std::vector<AnyVector> face_normals;  ///< unit, outwards
  std::vector<EdgeFeature> edges;       ///< 3D only; those that differ in more than their place
  bool nearly_flat = false;             ///< taken for flat, but not so to rounding: faces that turn away by less than 1e-14 are missing
};

/// Nothing for what is not a polytope with a radius around it (corners_of).
std::optional<Features> features_of(const Shape& shape, int dimension);

/// The same, found when first asked for: `get` throws std::bad_optional_access where there is nothing.
class LateFeatures {
 public:
  LateFeatures(const Shape& shape, int dimension) : shape_(shape), dimension_(dimension) {}
  const Features& get() {
    if (!features_) features_ = features_of(shape_, dimension_).value();
    return *features_;
  }

 private:
  Shape shape_;
  int dimension_;
  std::optional<Features> features_;
};

}  // namespace gjkdbg
