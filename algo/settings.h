// The method's settings: which algorithm, which variant, when to stop.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "shapes/vector.h"

namespace gjkdbg {

enum class MethodName {
  gjk, gjk_boolean, gjk_accelerated, mpr, sat,
  closed_form,  ///< of cores that are points or segments (algo/closed_form.h)
  projections,  ///< of cores whose nearest points have a formula (algo/projections.h)
  fastest,      ///< of a `Method` only: whichever of closed_form, sat, projections, gjk and gjk_accelerated the charts show to be fastest for the scene's bodies, with its settings
  conservative_advancement, ray_cast, root_finding  ///< of `cast`; GJK runs inside (algo/cast.h)
};
inline constexpr std::array<std::string_view, 11> method_names{"gjk", "gjk-boolean", "gjk-accelerated", "mpr", "sat", "closed-form", "projections", "fastest",
                                                              "conservative-advancement", "ray-cast", "root-finding"};
constexpr std::string_view word_of(MethodName x) { return method_names[static_cast<std::size_t>(x)]; }

/// The sub-algorithm that finds the point of a simplex closest to the origin.
enum class ClosestPoint { signed_volumes, johnson, voronoi };
inline constexpr std::array<std::string_view, 3> closest_point_names{"signed-volumes", "johnson", "voronoi"};
constexpr std::string_view word_of(ClosestPoint x) { return closest_point_names[static_cast<std::size_t>(x)]; }

/// When GJK's loop ends for lack of progress. All but `bounds` are other libraries' rules, with their constants, for comparison.
enum class Stopping {
  bounds,          ///< the plane across v and |v| agree within the tolerance or the rounding floor
  van_den_bergen,  ///< |v| - best plane so far <= tolerance |v| (van den Bergen 1999)
  bullet,          ///< |v|^2 - v.w <= 1e-12 |v|^2 (float: 1e-6)
  jolt,            ///< |v|^2 fell by no more than epsilon times itself
  opengjk,         ///< |v|^2 - v.w <= 1e4 epsilon |v|^2, or < 1e2 epsilon; 25 iterations at most
};
inline constexpr std::array<std::string_view, 5> stopping_names{"bounds", "van-den-bergen", "bullet", "jolt", "opengjk"};
constexpr std::string_view word_of(Stopping x) { return stopping_names[static_cast<std::size_t>(x)]; }

/// How gjk-accelerated comes to its directions: by momentum (Montaut et al. 2024, section IV), by Newton's method (algo/newton_direction.h), or
/// by the best plane's direction as well, in its first steps (algo/leading_direction.h).
enum class Acceleration { nesterov, polyak, newton, smoothed };
inline constexpr std::array<std::string_view, 4> acceleration_names{"nesterov", "polyak", "newton", "smoothed"};
constexpr std::string_view word_of(Acceleration x) { return acceleration_names[static_cast<std::size_t>(x)]; }

/// Who takes over when the cores overlap.
enum class Penetration { epa, mpr, none };
inline constexpr std::array<std::string_view, 3> penetration_names{"epa", "mpr", "none"};
constexpr std::string_view word_of(Penetration x) { return penetration_names[static_cast<std::size_t>(x)]; }

/// Where GJK begins.
enum class Start {
  centres,   ///< a support along the way from body 0's reference point to body 1's
  given,     ///< a support along `initial_direction`
  previous,  ///< the simplex the last run ended with, moved with the bodies: `initial_simplex`, or the pair's own in a motion
};
inline constexpr std::array<std::string_view, 3> start_names{"centres", "given", "previous"};
constexpr std::string_view word_of(Start x) { return start_names[static_cast<std::size_t>(x)]; }

/// A vertex of a simplex: a point of each body, in its own frame.
struct SimplexPoint {
  AnyVector a, b;
};

enum class Scalar { double_precision, float_precision };
inline constexpr std::array<std::string_view, 2> scalar_names{"double", "float"};
constexpr std::string_view word_of(Scalar x) { return scalar_names[static_cast<std::size_t>(x)]; }

/// As a scene or a command line gives it; what is not given is filled in by `resolve_settings`.
struct Method {
  std::optional<MethodName> name;
  std::optional<ClosestPoint> closest_point;
  std::optional<Penetration> penetration;
  std::optional<Scalar> scalar;
  std::optional<Stopping> stopping;
  std::optional<Acceleration> acceleration;
  std::optional<Start> start;
  std::optional<double> tolerance;        ///< relative gap between the bounds at which to stop, in (0, 1)
  std::optional<int> max_iterations;      ///< of each phase, >= 1
  std::optional<AnyVector> initial_direction;  ///< world frame, not zero
  std::vector<SimplexPoint> initial_simplex;   ///< at most D + 1
};

/// Another algorithm with the same settings; a warm start is left behind where the algorithm keeps no simplex.
void change_name(Method& method, MethodName name);

/// Every setting, defaults filled in.
struct Settings {
  MethodName name = MethodName::gjk;
  ClosestPoint closest_point = ClosestPoint::signed_volumes;
  Penetration penetration = Penetration::epa;
  Scalar scalar = Scalar::double_precision;
  Stopping stopping = Stopping::bounds;
  Acceleration acceleration = Acceleration::nesterov;
  Start start = Start::centres;
  double tolerance = 1e-12;
  int max_iterations = 512;
  std::optional<AnyVector> initial_direction;  ///< of Start::given
  std::vector<SimplexPoint> initial_simplex;   ///< of Start::previous, as given; empty: there is none yet, begin at the centres
  std::vector<SimplexPoint> core_simplex;      ///< the same of the cores, which GJK begins with: each point, or the core's nearest to it
};

}  // namespace gjkdbg
