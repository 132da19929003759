#include "recordings/outlines.h"

#include <algorithm>

#include "algo/bent_sum.h"
#include "algo/minkowski_difference.h"
#include "algo/revolution_sat.h"
#include "algo/rolling_balls.h"
#include "algo/tilted_spheroids.h"
#include "algo/working_scale.h"

namespace gjkdbg {
namespace {

bool convex(const Body& body) { return !std::holds_alternative<Mesh>(body.shape.geometry); }

bool asks_for_depth(const Recording& recording) { return recording.scene.scene.query > Query::distance && recording.settings.penetration != Penetration::none; }

std::optional<Revolved<double>> revolved_body(const Body& body, int dimension) {
  if (dimension != 3 || !convex(body)) return std::nullopt;
  return revolved<double>(Convex<3, double>(body.shape).core());
}

template <class Kind>
auto count_of_bodies(const Scene& scene, const Kind& kind) {
  return std::count_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) {
    const auto found = revolved_body(body, scene.dimension);
    return found && kind(*found);
  });
}

template <int D, class S>
struct Placed {
  double scale;
  Convex<D, S> a, b;
  MinkowskiDifference<D, S, Convex<D, S>> difference;
  Placed(const Body& of_a, const Body& of_b)
      : scale(working_scale<S>(of_a, of_b)), a(of_a.shape, scale), b(of_b.shape, scale), difference(a, b, of_a.pose, of_b.pose, scale) {}
};

template <int D, class Kind>
bool is_pair(const Body& a, const Body& b, bool single, const Kind& kind) {
  return single ? kind(Placed<D, float>(a, b).difference) : kind(Placed<D, double>(a, b).difference);
}

/// Whether two of the bodies are of a kind, wherever they are and however they are turned.
template <class Kind>
bool any_pair(const Recording& recording, const Kind& kind) {
  const auto& bodies = recording.scene.scene.bodies;
  const int dimension = recording.scene.scene.dimension;
  const bool single = recording.settings.scalar == Scalar::float_precision;
  if (dimension == 1) return false;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      if (convex(bodies[i]) && convex(bodies[j]) && (dimension == 2 ? is_pair<2>(bodies[i], bodies[j], single, kind) : is_pair<3>(bodies[i], bodies[j], single, kind))) return true;
  return false;
}
bool nearly_balls(const Recording& recording) {
  return any_pair(recording, []<class Difference>(const Difference& difference) { return RollingBalls<typename Difference::S>::of(difference).has_value(); });
}
bool bends_are_known(const Recording& recording) {
  return any_pair(recording, []<class Difference>(const Difference& difference) { return has_bends(difference); });
}

template <class S>
std::optional<DepthOutline> of_revolution(const Recording& recording) {
  const Placed<3, S> placed(recording.scene.scene.bodies[0], recording.scene.scene.bodies[1]);
  const auto pair = RevolvedPair<S>::of(placed.difference, static_cast<S>(recording.settings.tolerance));
  if (!pair) return std::nullopt;
  const auto normals = pair->normals();
  return DepthOutline{OutlineKind::parallel_axes, normals.of_a, normals.of_b, static_cast<double>(pair->slack) / placed.scale, pair->curved()};
}

template <class S>
std::optional<DepthOutline> about_nearly_one_line(const Recording& recording) {
  const Placed<3, S> placed(recording.scene.scene.bodies[0], recording.scene.scene.bodies[1]);
  if (tilted_spheroids(placed.difference)) return DepthOutline{OutlineKind::bends};
  return RevolvedPair<S>::of_tilted(placed.difference) ? std::optional(DepthOutline{OutlineKind::tilted_axes}) : std::nullopt;
}

}  // namespace

bool may_have_outline(const Recording& recording) {
  return asks_for_depth(recording) && (count_of_bodies(recording.scene.scene, [](const auto&) { return true; }) >= 2 || bends_are_known(recording));
}

std::optional<DepthOutline> outline_of(const Recording& recording) {
  if (!asks_for_depth(recording)) return std::nullopt;
  const bool single = recording.settings.scalar == Scalar::float_precision, space = recording.scene.scene.dimension == 3;
  std::optional<DepthOutline> found;
  if (space) found = single ? of_revolution<float>(recording) : of_revolution<double>(recording);
  if (!found && space) found = single ? about_nearly_one_line<float>(recording) : about_nearly_one_line<double>(recording);
  if (!found && nearly_balls(recording)) found = DepthOutline{OutlineKind::near_balls};
  if (!found && bends_are_known(recording)) found = DepthOutline{OutlineKind::bends};
  return found;
}

}  // namespace gjkdbg
