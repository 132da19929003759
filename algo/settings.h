// The method's settings: which algorithm, which variant, when to stop.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "shapes/vector.h"

namespace gjkdbg {

enum class MethodName { gjk, gjk_boolean, gjk_accelerated, mpr, sat };
inline constexpr std::array<std::string_view, 5> method_names{"gjk", "gjk-boolean", "gjk-accelerated", "mpr", "sat"};

/// The sub-algorithm that finds the point of a simplex closest to the origin.
enum class ClosestPoint { signed_volumes, johnson, voronoi };
inline constexpr std::array<std::string_view, 3> closest_point_names{"signed-volumes", "johnson", "voronoi"};

/// Who takes over when the cores overlap.
enum class Penetration { epa, mpr, none };
inline constexpr std::array<std::string_view, 3> penetration_names{"epa", "mpr", "none"};

enum class Scalar { double_precision, float_precision };
inline constexpr std::array<std::string_view, 2> scalar_names{"double", "float"};

/// As a scene or a command line gives it; what is not given is filled in by `resolve_settings`.
struct Method {
  std::optional<MethodName> name;
  std::optional<ClosestPoint> closest_point;
  std::optional<Penetration> penetration;
  std::optional<Scalar> scalar;
  std::optional<double> tolerance;        ///< relative gap between the bounds at which to stop, in (0, 1)
  std::optional<int> max_iterations;      ///< of each phase, >= 1
  std::optional<AnyVector> initial_direction;  ///< world frame, not zero
};

/// Every setting, defaults filled in.
struct Settings {
  MethodName name = MethodName::gjk;
  ClosestPoint closest_point = ClosestPoint::signed_volumes;
  Penetration penetration = Penetration::epa;
  Scalar scalar = Scalar::double_precision;
  double tolerance = 1e-12;
  int max_iterations = 512;
  std::optional<AnyVector> initial_direction;  ///< unset: from body 0's reference point towards body 1's
};

}  // namespace gjkdbg
