#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "algo/solve.h"
#include "shapes/convex.h"
#include "shapes/corners.h"
#include "shapes/error.h"

namespace gjkdbg {
namespace {

bool curved(const Shape& shape) {
  if (const Sum* sum = std::get_if<Sum>(&shape.geometry)) return curved(*sum->first) || curved(*sum->second);
  return std::holds_alternative<Ellipsoid>(shape.geometry) || std::holds_alternative<Cylinder>(shape.geometry) ||
         std::holds_alternative<Cone>(shape.geometry);
}

/// Polytopes are solved to the rounding floor in finitely many steps; curved pairs converge step by step, and EPA's
/// steps on them are dear.
double default_tolerance(const Scene& scene, const Settings& s) {
  if (scene.query == Query::cast) return s.scalar == Scalar::float_precision ? 1e-5 : 1e-9;
  bool round = false;
  for (const Body& body : scene.bodies) round = round || curved(body.shape);
  if (s.scalar == Scalar::float_precision) return round ? 1e-4 : 1e-6;
  return round ? 1e-10 : 1e-12;
}

/// Corners of a shape's core, no fewer than it has; of a sum's parts that have some; 0 where it is curved.
double corner_count(const Shape& shape, int dimension) {
  if (const Sum* sum = std::get_if<Sum>(&shape.geometry)) {
    const double first = corner_count(*sum->first, dimension), second = corner_count(*sum->second, dimension);
    return first > 0 && second > 0 ? first * second : std::max(first, second);
  }
  if (const PointSet* set = std::get_if<PointSet>(&shape.geometry)) return static_cast<double>(set->points.size());
  return curved(shape) ? 0 : std::holds_alternative<Sphere>(shape.geometry) ? 1 : std::ldexp(1.0, dimension);
}

/// Polytopes are solved in finitely many steps, and who has given no limit has these: EPA comes to a vertex of the difference for each corner of the
/// bodies at least where all its faces are about as near (prisms of many sides about one axis, geodesic balls with one centre): up to 1.2 steps a corner
/// of both were seen, and four are room enough. Where the other body is curved it comes back to each of these sides, until it has gone around the curve there: up to 45 steps a corner were seen, of prisms and
/// spheroids about one axis. No more than take a second; two that are curved never come to an end so.
int default_iterations(const Scene& scene, const Settings& s) {
  double most = 0, second = 0;
  bool round = false;
  for (const Body& body : scene.bodies) {
    const double corners = corner_count(body.shape, scene.dimension);
    round = round || curved(body.shape);
    second = std::max(second, std::min(most, corners)), most = std::max(most, corners);
  }
  return static_cast<int>(std::clamp((round ? 64 : 4) * (most + second), static_cast<double>(s.max_iterations), 65536.0));
}

[[noreturn]] void refuse(const std::string& message, const char* where) { throw Error("unsupported-method", message, where); }

/// By its name in quotes; by its place where it has none.
std::string named(const Scene& scene, const Body& body) { return body.name.empty() ? "body " + std::to_string(&body - scene.bodies.data()) : "body \"" + body.name + "\""; }

bool has_corners(const Shape& shape) {
  if (const Sum* sum = std::get_if<Sum>(&shape.geometry)) return has_corners(*sum->first) && has_corners(*sum->second);
  return !curved(shape);
}

/// SAT needs faces and edges.
void check_polytopes(const Scene& scene) {
  for (const Body& body : scene.bodies) {
    if (!has_corners(body.shape))
      refuse("method \"sat\" needs polytopes with or without a radius; " + named(scene, body) + " is a " + type_name(body.shape, scene.dimension), "/method/name");
    if (std::holds_alternative<Sum>(body.shape.geometry) && !corners_of(body.shape, scene.dimension))
      refuse("method \"sat\" takes sums of at most " + std::to_string(largest_sum) + " pairs of corners; " + named(scene, body) + " has more", "/method/name");
  }
}

/// A core that is a point or a segment, as the closed form needs; on a line every body is one.
bool segment(const Body& body, int dimension) {
  const PointSet* points = std::get_if<PointSet>(&body.shape.geometry);
  return dimension == 1 || std::holds_alternative<Sphere>(body.shape.geometry) || std::holds_alternative<Capsule>(body.shape.geometry) ||
         (points && points->points.size() <= 2);
}
void check_segments(const Scene& scene) {
  for (const Body& body : scene.bodies) {
    if (!segment(body, scene.dimension))
      refuse("method \"closed-form\" needs spheres, capsules, points or segments; " + named(scene, body) + " is a " + type_name(body.shape, scene.dimension), "/method/name");
  }
}

/// A shape whose nearest points have a formula.
bool has_projection(const Body& body) {
  const auto& g = body.shape.geometry;
  return std::holds_alternative<Sphere>(g) || std::holds_alternative<Box>(g) || std::holds_alternative<Capsule>(g) || std::holds_alternative<Cylinder>(g) ||
         std::holds_alternative<Cone>(g) || std::holds_alternative<Ellipsoid>(g);
}
void check_projections(const Scene& scene) {
  for (const Body& body : scene.bodies)
    if (!has_projection(body))
      refuse("method \"projections\" needs spheres, capsules, boxes, cylinders, cones or ellipsoids; " + named(scene, body) + " is a " + type_name(body.shape, scene.dimension), "/method/name");
}

/// Polygons in the plane, boxes among them, so small that their edges are looked along sooner than GJK is done: eight corners each take 0.41 of GJK's time,
/// sixteen 0.55, twenty 0.7, forty 1.2 (with AVX2).
bool few_corners(const Scene& scene) {
  std::size_t pairs = 1;
  for (const Body& body : scene.bodies) {
    const auto* points = std::get_if<PointSet>(&body.shape.geometry);
    const std::size_t corners = points ? points->points.size() : std::holds_alternative<Box>(body.shape.geometry) ? 4 : 0;
    if (corners < 3) return false;
    pairs *= corners;
  }
  return scene.dimension == 2 && pairs <= 400;
}

/// What the charts show to be fastest: the closed form of segments, the 15 axes of SAT of two boxes, those of small polygons, Newton's directions (gjk_accelerated) of two ellipsoids, projections of
/// other shapes that have them, GJK with smoothed directions (gjk_accelerated) for the rest; plain GJK for bodies in motion, and where its settings are asked for. Of hulls
/// smoothing takes 0.8 (near) to 0.97 (far apart) of GJK's time, of deep ones with EPA 1; of a hull and a round shape 0.87 to 1.04 of the supports. Of round shapes apart projections take 0.15 (two cylinders,
/// 1e-4 apart) to 0.6 (half apart) of GJK's time, with a ball 0.8 to 1.1; of deep ones, which are GJK's and EPA's in the end, 1 to 1.1.
void choose_fastest(const Scene& scene, const Method& m, Settings& s) {
  s.name = MethodName::gjk;
  const bool settings = m.closest_point || m.penetration || m.stopping || m.acceleration || m.start || m.initial_direction || !m.initial_simplex.empty();
  if (settings || scene.query == Query::cast || scene.query == Query::simulate) return;
  const auto all = [&](auto&& kind) { return std::all_of(scene.bodies.begin(), scene.bodies.end(), kind); };
  if (all([&](const Body& body) { return segment(body, scene.dimension); })) s.name = MethodName::closed_form;
  else if (all([](const Body& body) { return std::holds_alternative<Box>(body.shape.geometry); }) || few_corners(scene)) s.name = MethodName::sat;
  else if (all([](const Body& body) { return std::holds_alternative<Ellipsoid>(body.shape.geometry); })) s.name = MethodName::gjk_accelerated, s.acceleration = Acceleration::newton;
  else if (all(has_projection)) s.name = MethodName::projections;
  else s.name = MethodName::gjk_accelerated, s.acceleration = Acceleration::smoothed;
}

bool of_cast(MethodName name) { return name >= MethodName::conservative_advancement; }

void check_motion(const Settings& s, const Scene& scene) {
  const std::string name(word_of(s.name));
  if (scene.query != Query::cast && of_cast(s.name)) refuse("method \"" + name + "\" answers only the query \"cast\"", "/method/name");
  if (scene.query == Query::cast && !of_cast(s.name)) refuse("the query \"cast\" is answered by conservative-advancement, ray-cast or root-finding, not \"" + name + "\"", "/method/name");
  if (scene.query == Query::simulate && s.name == MethodName::closed_form) refuse("method \"closed-form\" does not answer the query \"simulate\"", "/method/name");
  if (scene.query == Query::simulate && s.penetration == Penetration::none) refuse("penetration \"none\" tells no depth, which the query \"simulate\" needs", "/method/penetration");
  if (scene.query == Query::simulate && s.name == MethodName::gjk_boolean) refuse("method \"gjk-boolean\" answers only the query \"intersect\"", "/method/name");
  if (scene.query != Query::cast && scene.query != Query::simulate) return;
  const bool all = scene.motion && std::all_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& body) { return body.motion.has_value(); });
  if (!all) throw Error("missing-motion", "the query \"" + std::string(word_of(scene.query)) + "\" needs bodies that know how they move", "/query");
  for (const Body& body : scene.bodies) {
    const bool turns = body.motion && body.motion->angular_velocity.size() > 0 && !body.motion->angular_velocity.isZero(0);
    if (s.name == MethodName::ray_cast && turns) refuse("method \"ray-cast\" takes bodies that do not turn; " + named(scene, body) + " does", "/method/name");
    if (std::holds_alternative<Mesh>(body.shape.geometry) && scene.query == Query::simulate && body.motion && !body.motion->is_static)
      throw Error("unsupported-method", "a mesh must be static, and this one moves", "/bodies/" + std::to_string(&body - scene.bodies.data()) + "/static");
  }
}

/// A shape is the sum of its core and a ball; takes the ball away and returns its radius.
double bare(Shape& shape) {
  double radius = std::exchange(shape.margin, 0);
  if (Sphere* sphere = std::get_if<Sphere>(&shape.geometry)) radius += std::exchange(sphere->radius, 0);
  if (Capsule* capsule = std::get_if<Capsule>(&shape.geometry)) radius += std::exchange(capsule->radius, 0);
  if (Sum* sum = std::get_if<Sum>(&shape.geometry))
    for (auto* part : {&sum->first, &sum->second}) {
      Shape core = **part;
      radius += bare(core);
      *part = std::make_shared<const Shape>(std::move(core));
    }
  return radius;
}

/// Of the body's core the point nearest to one of the body, in its frame; none where that is proven to lie outside, by more than rounding. Asked of our own GJK, in double.
/// A point that is of the core to rounding stays as it is. Any other is moved to the core's nearest, also one that GJK, on curved sides, cannot
/// tell from a point of the core: a simplex with a vertex outside the difference would make the upper bound a lie.
std::optional<AnyVector> core_point(const Body& body, const AnyVector& point, int dimension) {
  Shape core = body.shape;
  const double radius = bare(core), rounding = 16 * std::numeric_limits<double>::epsilon() * (size_of(body.shape) + point.norm());
  Scene probe;
  probe.dimension = dimension, probe.query = Query::distance;
  probe.bodies = {Body{"", core, identity_pose(dimension)}, Body{"", {PointSet{PointSetKind::point, {point}, {}}, 0}, identity_pose(dimension)}};
  const Result nearest = solve(probe, resolve_settings({}, probe));
  if (*nearest.signed_distance <= rounding) return point;
  if (*nearest.lower_bound > radius + rounding) return std::nullopt;
  return nearest.witness_a;
}

bool keeps_simplex(MethodName name) {
  switch (name) {
    case MethodName::gjk_boolean:
    case MethodName::mpr:
    case MethodName::sat:
    case MethodName::closed_form:
    case MethodName::projections:
    case MethodName::ray_cast: return false;
    default: return true;
  }
}

/// And finds what GJK begins with.
void check_start(Settings& s, const Scene& scene) {
  if (s.start == Start::given && !s.initial_direction) throw Error("missing-field", "start \"given\" needs initial_direction", "/method/start");
  if (s.start != Start::given && s.initial_direction) throw Error("contradiction", "initial_direction goes with start \"given\"", "/method/start");
  if (s.start != Start::previous && !s.initial_simplex.empty()) throw Error("contradiction", "initial_simplex goes with start \"previous\"", "/method/start");
  if (s.start == Start::previous && !keeps_simplex(s.name))
    refuse("start \"previous\" is GJK's; method \"" + std::string(word_of(s.name)) + "\" keeps no simplex", "/method/start");
  if (s.initial_simplex.empty()) return;
  if (scene.bodies.size() != 2) throw Error("wrong-count", "initial_simplex goes with two bodies; a motion's pairs have their own", "/method/initial_simplex");
  if (static_cast<int>(s.initial_simplex.size()) > scene.dimension + 1)
    throw Error("wrong-count", "initial_simplex has at most " + std::to_string(scene.dimension + 1) + " vertices", "/method/initial_simplex");
  s.core_simplex = s.initial_simplex;
  for (std::size_t i = 0; i < s.initial_simplex.size(); ++i)
    for (const int k : {0, 1}) {
      AnyVector& p = k == 0 ? s.core_simplex[i].a : s.core_simplex[i].b;
      const Body& body = scene.bodies[static_cast<std::size_t>(k)];
      const std::string where = "/method/initial_simplex/" + std::to_string(i) + (k == 0 ? "/a" : "/b");
      if (p.size() != scene.dimension) throw Error("wrong-dimension", "needs " + std::to_string(scene.dimension) + " numbers", where);
      if (!p.allFinite()) throw Error("non-finite", "must be finite", where);
      if (std::holds_alternative<Mesh>(body.shape.geometry)) continue;
      const auto nearest = core_point(body, p, scene.dimension);
      if (!nearest) throw Error("out-of-range", "is no point of body " + (body.name.empty() ? std::to_string(k) : "\"" + body.name + "\""), where);
      p = *nearest;
    }
}

void check_numbers(const Settings& s, int dimension) {
  if (!(s.tolerance > 0 && s.tolerance < 1)) throw Error("out-of-range", "tolerance must be greater than 0 and less than 1", "/method/tolerance");
  if (s.max_iterations < 1 || s.max_iterations > 1000000)
    throw Error("out-of-range", "max_iterations must lie between 1 and 1000000", "/method/max_iterations");
  if (!s.initial_direction) return;
  const AnyVector& d = *s.initial_direction;
  if (d.size() != dimension) throw Error("wrong-dimension", "initial_direction needs " + std::to_string(dimension) + " numbers", "/method/initial_direction");
  if (!d.allFinite()) throw Error("non-finite", "initial_direction must be finite", "/method/initial_direction");
  if (d.isZero(0)) throw Error("zero-direction", "initial_direction must not be zero", "/method/initial_direction");
}

}  // namespace

void change_name(Method& method, MethodName name) {
  method.name = name;
  if (keeps_simplex(name)) return;
  method.initial_simplex.clear();
  if (method.start == Start::previous) method.start.reset();
}

Settings resolve_settings(const Method& method, const Scene& scene) {
  Settings s;
  const MethodName plain = scene.query == Query::cast ? MethodName::conservative_advancement : MethodName::gjk;
  s.name = method.name.value_or(plain);
  s.scalar = method.scalar.value_or(s.scalar);
  if (s.name == MethodName::fastest) choose_fastest(scene, method, s);
  if (s.name == MethodName::gjk) s.name = plain;  // of a cast: with GJK inside
  s.closest_point = method.closest_point.value_or(s.closest_point);
  s.penetration = method.penetration.value_or(s.name == MethodName::mpr ? Penetration::mpr : s.penetration);
  s.stopping = method.stopping.value_or(s.stopping);
  s.acceleration = method.acceleration.value_or(s.acceleration);
  s.tolerance = method.tolerance.value_or(default_tolerance(scene, s));
  s.max_iterations = method.max_iterations.value_or(default_iterations(scene, s));
  s.initial_direction = method.initial_direction;
  s.initial_simplex = method.initial_simplex;
  s.start = method.start.value_or(s.initial_direction ? Start::given : s.initial_simplex.empty() ? s.start : Start::previous);
  if (s.name == MethodName::sat) check_polytopes(scene);
  if (s.name == MethodName::closed_form) check_segments(scene);
  if (s.name == MethodName::projections) check_projections(scene);
  if (scene.query != Query::cast && scene.query != Query::simulate && scene.bodies.size() != 2)
    throw Error("wrong-count", "the query \"" + std::string(word_of(scene.query)) + "\" takes two bodies, not " + std::to_string(scene.bodies.size()), "/bodies");
  check_motion(s, scene);
  check_numbers(s, scene.dimension);
  check_start(s, scene);
  if (s.name == MethodName::gjk_boolean && scene.query != Query::intersect)
    refuse("method \"gjk-boolean\" answers only the query \"intersect\"", "/method/name");
  return s;
}

}  // namespace gjkdbg
