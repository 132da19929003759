// The bodies of a cast in a stretch of it, from one response to the next: what check measures there.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "algo/motion.h"
#include "recordings/mesh_parts.h"
#include "shapes/world_support.h"

namespace gjkdbg {

struct CastStretch {
  const Scene& scene;
  std::vector<Body> bodies = scene.bodies;  ///< where the stretch begins
  double from = 0;                          ///< when it does

  using Two = std::array<int, 2>;
  const Body& body(int i) const { return bodies[static_cast<std::size_t>(i)]; }
  const Motion& motion(int i) const { return *body(i).motion; }
  bool exists(const Two& pair) const { return pair[0] != pair[1] && std::min(pair[0], pair[1]) >= 0 && std::max(pair[0], pair[1]) < static_cast<int>(bodies.size()); }
  bool has_mesh(const Two& pair) const {
    return std::any_of(pair.begin(), pair.end(), [&](int i) { return std::holds_alternative<Mesh>(body(i).shape.geometry); });
  }
  bool turns(int i) const { return motion(i).angular_velocity.size() > 0 && !motion(i).angular_velocity.isZero(0); }

  /// Two bodies of the scene, where they are at a time.
  Scene at(const Two& pair, double time) const {
    Scene two;
    two.dimension = scene.dimension;
    two.query = Query::penetration;
    for (const int i : pair) two.bodies.push_back(moved(body(i), time - from, scene.dimension)), two.bodies.back().motion.reset();
    return two;
  }
  double gap_at(const Two& pair, double time) const {
    const Scene two = at(pair, time);
    return *solve(two, resolve_settings({}, two)).signed_distance;
  }

  /// How far apart two bodies are along a unit direction from the first to the second.
  static double along(const Scene& two, const AnyVector& n) {
    const WorldSupport a(two.bodies[0], two.dimension), b(two.bodies[1], two.dimension);
    return n.dot(b(-n, true) - a(n, true));
  }
  /// The same of two parts of meshes at a time: of those that the run before this step was about, or else of all, the one that is nearest to what is said. Of a mesh nothing
  /// is copied, nor all of it gone through where it needs not be: every triangle comes here once.
  double along(const Two& pair, double time, const AnyVector& n, double said, double close, const Recording& recording, std::size_t step, CornerFinders& finders) const {
    Frame frame;
    frame.pair = pair, frame.step = step;
    for (const Body& b : bodies) {
      const Pose pose = moved(without_shape(b), time - from, scene.dimension).pose;
      frame.places.push_back({pose.position, pose.matrix, {}, {}});
    }
    const auto height = [&](int i, const AnyVector& d, int triangle) {
      const Body& whole = body(i);
      const Frame::Place& place = frame.places[static_cast<std::size_t>(i)];
      Body part{whole.name, triangle < 0 ? whole.shape : triangle_of(whole.shape, static_cast<std::size_t>(triangle)), whole.pose};
      part.pose.position = place.position, part.pose.matrix = place.rotation;
      return n.dot(WorldSupport(part, scene.dimension)(d, true));
    };
    double best = std::numeric_limits<double>::infinity();
    const auto take = [&](double apart) {
      if (std::abs(apart - said) < std::abs(best - said)) best = apart;
    };
    for (const auto& [i, j] : fitting_triangles(recording, frame, &finders)) take(height(pair[1], -n, j) - height(pair[0], n, i));
    if (std::abs(best - said) <= close) return best;
    const auto heights = [&](int i, const AnyVector& d) {
      const auto* mesh = std::get_if<Mesh>(&body(i).shape.geometry);
      std::vector<double> all;
      for (int k = mesh ? 0 : -1; k < (mesh ? static_cast<int>(mesh->triangles.size()) : 0); ++k) all.push_back(height(i, d, k));
      return all;
    };
    const std::vector<double> near = heights(pair[1], -n);
    for (const double a : heights(pair[0], n))
      for (const double b : near) take(b - a);
    return best;
  }

  /// How fast two bodies can come nearer.
  double speed(const Two& pair) const { return (motion(pair[0]).velocity - motion(pair[1]).velocity).norm() + turning(pair); }
  /// The part of it that comes of turning: |w| times the reach.
  double turning(const Two& pair) const {
    double s = 0;
    for (const int i : pair)
      if (turns(i)) s += motion(i).angular_velocity.norm() * reach_of(body(i).shape, scene.dimension);
    return s;
  }
  /// How fast they come nearer along n, turning aside.
  double approach(const Two& pair, const AnyVector& n) const { return (motion(pair[0]).velocity - motion(pair[1]).velocity).dot(n); }

  void go_to(double time) {
    for (Body& b : bodies) b = moved(b, time - from, scene.dimension);
    from = time;
  }
};

/// MPR's depth is that along its own normal, and no less than the right one.
inline bool any_way_out(const Settings& settings, double gap) { return settings.penetration == Penetration::mpr && gap < 0; }

inline std::string names_of(const std::array<int, 2>& pair) { return "bodies " + std::to_string(pair[0]) + " and " + std::to_string(pair[1]); }

}  // namespace gjkdbg
