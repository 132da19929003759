// A pair of convex bodies made ready once and asked as often as wanted, wherever they are: what a program that only
// wants answers calls. Nothing is traced, and after the first few queries nothing is allocated.
#pragma once

#include <memory>

#include "algo/result.h"
#include "algo/settings.h"
#include "shapes/scene.h"

namespace gjkdbg {

/// One object must not be used by two threads at once; different objects may.
class PreparedPair {
 public:
  virtual ~PreparedPair() = default;
  /// `settings`: from `resolve_settings` for these bodies, of the scalar the pair was made in (std::bad_optional_access for a closed form or SAT on other
  /// shapes). Query: intersect, distance or penetration; others are answered as penetration. The result is in world coordinates and scene lengths.
  /// With Start::previous every run begins with the simplex of the one before, the first with `initial_simplex`.
  virtual Result run(const Settings& settings, Query query) = 0;
  /// The simplex of the last run with Start::previous; empty when there was none.
  virtual std::vector<SimplexPoint> simplex() const = 0;
  /// Where the bodies are from now on. The rotations' `matrix` must be orthonormal.
  virtual void place(const Pose& a, const Pose& b) = 0;
};

/// Both shapes must be valid in the dimension (`validate`) and no meshes. Lengths are multiplied by `scale`, a power of two, while at work.
std::unique_ptr<PreparedPair> prepare(const Body& a, const Body& b, int dimension, Scalar scalar, double scale = 1);

}  // namespace gjkdbg
