// A scene: bodies, each a convex shape with a pose, and the least that has to be known about them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shapes/pose.h"
#include "shapes/shape.h"

namespace gjkdbg {

/// What is asked, least first; nothing beyond it is computed.
enum class Query {
  intersect,    ///< yes or no
  distance,     ///< and how far apart, where; 0 when overlapping
  penetration,  ///< signed distance: and how deep, which way out
  contact,      ///< penetration and the contact points
  cast,         ///< time of impact of moving bodies
  simulate      ///< rigid bodies through time
};
inline constexpr std::array<std::string_view, 6> query_names{"intersect", "distance", "penetration",
                                                             "contact",   "cast",     "simulate"};
constexpr std::string_view word_of(Query x) { return query_names[static_cast<std::size_t>(x)]; }

/// What a cast does when bodies meet.
enum class Response { stop, slide, bounce };
inline constexpr std::array<std::string_view, 3> response_names{"stop", "slide", "bounce"};
constexpr std::string_view word_of(Response x) { return response_names[static_cast<std::size_t>(x)]; }

/// How a simulation goes from one time to the next.
enum class Integrator {
  explicit_euler,       ///< all rates at the old state; the rotation matrix is orthonormalised after Gram and Schmidt
  semi_implicit_euler,  ///< momenta first, then places with the new ones; rotation by the exponential map at the middle of the step
  rk4,                  ///< Runge and Kutta's fourth order, on the quaternion
};
inline constexpr std::array<std::string_view, 3> integrator_names{"explicit-euler", "semi-implicit-euler", "rk4"};
constexpr std::string_view word_of(Integrator x) { return integrator_names[static_cast<std::size_t>(x)]; }

/// How a body moves; only in the scenes of `cast` and `simulate`. World axes; the body turns about its pose's position.
/// A cast reads the velocities, and for Response::bounce the restitution.
struct Motion {
  AnyVector velocity;          ///< per unit of time (of a cast: the whole interval)
  AnyVector angular_velocity;  ///< radians per unit of time: 3 numbers in 3D, 1 in 2D, none in 1D
  double mass = 1;             ///< > 0
  double restitution = 0;      ///< 0 … 1: of a contact the larger of the two counts
  double friction = 0;         ///< Coulomb's coefficient; of a contact the geometric mean
  bool is_static = false;      ///< never moves, of infinite mass
};

struct Body {
  std::string name;
  Shape shape;
  Pose pose;
  std::optional<Motion> motion = std::nullopt;
};

/// What the scenes of `cast` and `simulate` add to the scene itself.
struct SceneMotion {
  Response response = Response::stop;  ///< of a cast
  AnyVector gravity;                   ///< this and the rest of a simulation: length per time squared, world axes
  double time_step = 1.0 / 60;
  int steps = 60;                      ///< how many time steps
  Integrator integrator = Integrator::semi_implicit_euler;
};

/// Something the reader put right and the user should know.
struct SceneWarning {
  std::string code, message;
};

struct Scene {
  std::string name, description, source;
  std::vector<std::string> tags;
  int dimension = 3;
  Query query = Query::penetration;
  std::vector<Body> bodies;
  std::optional<SceneMotion> motion;   ///< of `cast` and `simulate`
  std::vector<SceneWarning> warnings;  ///< become the recording's first events
};

}  // namespace gjkdbg
