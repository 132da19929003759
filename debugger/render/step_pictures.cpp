#include "debugger/render/step_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace gjkdbg {

SceneMeshes scene_meshes(const Scene& scene, const Settings& settings) {
  SceneMeshes meshes;
  meshes.dimension = scene.dimension;
  for (const Body& body : scene.bodies) meshes.bodies.push_back(body_mesh(body, scene.dimension));
  if (scene.bodies.size() < 2) return meshes;
  meshes.whole = settings.name == MethodName::gjk_boolean;
  meshes.difference = difference_mesh(scene.bodies[0], scene.bodies[1], scene.dimension, meshes.whole);
  meshes.radius = meshes.whole ? 0 : radius_sum(scene.bodies[0], scene.bodies[1], scene.dimension);
  return meshes;
}

std::string body_letter(int body) { return body < 26 ? std::string(1, static_cast<char>('A' + body)) : std::to_string(body); }

double half_view(const Projection& projection) { return std::min(projection.rectangle().width, projection.rectangle().height) / projection.pixels_per_length() / 2; }

ViewPoint middle(const DisplayMesh& mesh) {
  ViewPoint low = mesh.points[0], high = low;
  for (const ViewPoint& p : mesh.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (low + high) / 2;
}

ViewPoint row_offset(int body, int dimension, const Projection& projection) {
  if (dimension > 1) return ViewPoint::Zero();
  return {0, (body % 2 == 0 ? 0.3 : -0.3) * half_view(projection), 0};
}

/// p goes to R R0^T (p - x0) + x.
DisplayMesh placed_mesh(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, int body) {
  const auto k = static_cast<std::size_t>(body);
  const Pose& began = recording.scene.scene.bodies[k].pose;
  const Frame::Place& place = frame.places[k];
  const AnyMatrix turn = place.rotation * began.matrix.transpose();
  DisplayMesh mesh = meshes.bodies[k];
  for (ViewPoint& p : mesh.points) p = to_view(AnyVector(turn * (AnyVector(p.head(meshes.dimension)) - began.position) + place.position));
  if (meshes.dimension == 3)
    for (ViewPoint& n : mesh.normals) n = turn * n;
  return mesh;
}

namespace {

/// What is seen of a body in the picture: how far it reaches in directions all round.
class Outline {
 public:
  Outline(const DisplayMesh& mesh, const Projection& projection) {
    for (std::size_t i = 0; i < reach_.size(); ++i) {
      reach_[i] = -std::numeric_limits<double>::infinity();
      for (const ViewPoint& p : mesh.points) reach_[i] = std::max(reach_[i], along(i, projection(p)));
    }
  }
  bool holds(const Projected& p) const {
    for (std::size_t i = 0; i < reach_.size(); ++i)
      if (along(i, p) > reach_[i]) return false;
    return true;
  }
  /// The mean of its widths.
  double size() const { return std::accumulate(reach_.begin(), reach_.end(), 0.0) / static_cast<double>(reach_.size() / 2); }

 private:
  double along(std::size_t i, const Projected& p) const {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(reach_.size());
    return std::cos(angle) * p.x + std::sin(angle) * p.y;
  }
  std::array<double, 24> reach_{};
};

}  // namespace

std::vector<ViewPoint> letter_places(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const Projection& projection) {
  std::vector<ViewPoint> places;
  std::vector<DisplayMesh> placed;
  std::vector<Outline> outlines;
  for (int i = 0; i < static_cast<int>(frame.places.size()); ++i) {
    places.push_back(to_view(frame.places[static_cast<std::size_t>(i)].position) + row_offset(i, meshes.dimension, projection));
    if (meshes.dimension < 3) continue;
    placed.push_back(placed_mesh(meshes, recording, frame, i));
    outlines.emplace_back(placed.back(), projection);
  }
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const auto hidden = [&](const ViewPoint& p) {  // behind or inside what is a good deal smaller
      for (std::size_t k = 0; k < outlines.size(); ++k)
        if (k != i && outlines[k].size() < 0.7 * outlines[i].size() && outlines[k].holds(projection(p))) return true;
      return false;
    };
    if (!hidden(places[i])) continue;
    for (const ViewPoint& corner : placed[i].points)
      if (const ViewPoint p = places[i] + 0.6 * (corner - places[i]); !hidden(p) && projection.rectangle().contains(projection(p).x, projection(p).y)) {
        places[i] = p;
        break;
      }
  }
  return places;
}

std::vector<BodyHandle> place_handles(const std::vector<ViewPoint>& middles, const Projection& projection, double scale) {
  const double r = handle_radius * scale, apart = 2.5 * r;
  std::vector<Eigen::Vector2d> rings;
  for (const ViewPoint& middle : middles) rings.emplace_back(projection(middle).x, projection(middle).y);
  // Two that are too near each other give way both, all at once, so that those of a stack keep their order; of two in one place the later one goes down.
  bool moved = true;
  for (int round = 0; round < 200 && moved; ++round) {
    moved = false;
    std::vector<Eigen::Vector2d> shifts(rings.size(), Eigen::Vector2d::Zero());
    for (std::size_t i = 0; i < rings.size(); ++i)
      for (std::size_t k = i + 1; k < rings.size(); ++k) {
        const Eigen::Vector2d away = rings[k] - rings[i];
        if (away.norm() >= apart - 0.5) continue;
        const Eigen::Vector2d push = 0.3 * (apart - away.norm()) * (away.norm() > 1 ? away.normalized() : Eigen::Vector2d(0, 1));
        shifts[i] -= push, shifts[k] += push, moved = true;
      }
    for (std::size_t i = 0; i < rings.size(); ++i) rings[i] += shifts[i];
  }
  std::vector<BodyHandle> handles;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const Projected at = projection(middles[i]);
    const ViewPoint ring = middles[i] + projection.move(rings[i][0] - at.x, rings[i][1] - at.y);
    Eigen::Vector2d beside(1.9 * r, -1.5 * r);
    for (const Eigen::Vector2d& corner : {Eigen::Vector2d(1.9, -1.5), Eigen::Vector2d(-1.9, -1.5), Eigen::Vector2d(1.9, 1.5), Eigen::Vector2d(-1.9, 1.5)}) {
      const Eigen::Vector2d disc = rings[i] + r * corner;
      if (std::any_of(rings.begin(), rings.end(), [&](const auto& other) { return (other - disc).norm() < 1.5 * r; })) continue;
      beside = r * corner;
      break;
    }
    handles.push_back({ring, ring + projection.move(beside[0], beside[1])});
  }
  return handles;
}

std::string facet_name(int dimension) { return dimension == 1 ? "endpoint" : dimension == 2 ? "edge" : "face"; }

char vertex_letter(std::ptrdiff_t place) { return static_cast<char>('A' + place); }

std::string simplex_letter(const Frame& frame, int vertex, bool newest_first) {
  const auto found = std::find(frame.lettered.begin(), frame.lettered.end(), vertex);
  if (found == frame.lettered.end()) return {};
  const auto from_newest = found - frame.lettered.begin(), from_oldest = frame.lettered.end() - found - 1;
  return std::string(1, vertex_letter(newest_first ? from_newest : from_oldest));
}

namespace {

struct Bounds {
  ViewPoint low = ViewPoint::Constant(INFINITY), high = ViewPoint::Constant(-INFINITY);
  std::vector<ViewPoint> points;  ///< those that more than the box is wanted of
  double around_origin = 0;       ///< the radius of a ball about the origin
  void add(const ViewPoint& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  void keep(const ViewPoint& p) { add(p), points.push_back(p); }
  Camera camera(int dimension) const {
    Camera c;
    c.target = (low + high) / 2;
    // From whichever side: of what is round the ball about the middle is smaller than the one about the box.
    double size = around_origin > 0 ? c.target.norm() + around_origin : 0;
    for (const ViewPoint& p : points) size = std::max(size, (p - c.target).norm());
    c.radius = size > 0 ? size * 1.15 : 1;
    c.flat = dimension < 3;
    return c;
  }
  /// As far as a camera is drawn back for what is not in the bounds.
  double farthest() const { return low == high ? 1.25 : 1.25 * 1.15 * (high - low).norm() / 2; }
};

/// An arrow that will be drawn, from `from`, as long as this share of the camera's radius.
struct Arrow {
  ViewPoint from, along;
};

void add_arrow(std::vector<Arrow>& arrows, const ViewPoint& from, const AnyVector& direction, double share) {
  if (from.allFinite() && direction.allFinite() && !direction.isZero(0)) arrows.push_back({from, to_view(direction).stableNormalized() * share});
}

/// The side of a view that spans low to high, of which -1 to 1 are shown: how far it must move, in that measure, and how much more it must show.
struct Side {
  double low = 0, high = 0;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
  double wider() const { return std::max(1.0, (high - low) / 2); }
  double shift() const { return high - low > 2 ? (high + low) / 2 : std::max(0.0, high - 1) + std::min(0.0, low + 1); }
};

/// Moves the camera and draws it back, to a quarter beyond the box's ball at most, until the arrows' tips are in view, as it looks at first. The arrows grow with the radius: a few rounds.
Camera with_room_for(const std::vector<Arrow>& arrows, const Bounds& shown, int dimension) {
  constexpr double share = 0.93;  // of the view, so that the arrow's letter has room too
  const Camera tight = shown.camera(dimension);
  Camera c = tight;
  for (int round = 0; round < 4; ++round) {
    const Projection view(c, {-1 / share, -1 / share, 2 / share, 2 / share});
    Side across, down;
    const auto add = [&](const ViewPoint& p) {
      const Projected at = view(p);
      across.add(at.x), down.add(at.y);
    };
    for (const ViewPoint& p : shown.points) add(p);
    for (const Arrow& a : arrows) add(a.from + a.along * c.radius);
    c.target += view.move(across.shift(), down.shift());
    c.radius = std::min(c.radius * std::max(across.wider(), down.wider()), std::max(tight.radius, shown.farthest()));
  }
  return c;
}

Bounds world_bounds(const SceneMeshes& meshes, const Recording& recording) {
  const Scene& scene = recording.scene.scene;
  Bounds bounds;
  for (const DisplayMesh& mesh : meshes.bodies)
    for (const ViewPoint& p : mesh.points) bounds.keep(p);
  if (!scene.motion) return bounds;
  const auto add = [&](std::size_t i, const AnyVector& position) {
    const ViewPoint shift = to_view(AnyVector(position - scene.bodies[i].pose.position));
    for (const ViewPoint& p : meshes.bodies[i].points) bounds.add(p + shift);
  };
  const double end = recording.result.intersecting ? recording.result.time.value_or(1) : 1;
  for (std::size_t i = 0; i < meshes.bodies.size() && scene.query == Query::cast; ++i) add(i, AnyVector(scene.bodies[i].pose.position + scene.bodies[i].motion->velocity * end));
  for (const Event& event : recording.events)
    if (const auto* state = std::get_if<recorded::State>(&event))
      for (std::size_t i = 0; i < state->bodies.size() && i < meshes.bodies.size(); ++i) add(i, state->bodies[i].position);
  for (int corner = 0; corner < 8; ++corner) bounds.keep({(corner & 1 ? bounds.high : bounds.low)[0], (corner & 2 ? bounds.high : bounds.low)[1], (corner & 4 ? bounds.high : bounds.low)[2]});
  return bounds;
}

/// In a cast A - B moves on, past O where the bodies come by one another or spring back: where it is after each response, and at the end.
void add_moved_difference(Bounds& bounds, const SceneMeshes& meshes, const Recording& recording) {
  const std::vector<Body>& bodies = recording.scene.scene.bodies;
  if (recording.scene.scene.query != Query::cast || bodies.size() < 2 || !bodies[0].motion || !bodies[1].motion) return;
  AnyVector moved = AnyVector::Zero(bodies[0].pose.position.size()), velocity = bodies[0].motion->velocity - bodies[1].motion->velocity;
  double time = 0;
  const auto keep = [&](const AnyVector& by) {
    for (const ViewPoint& p : meshes.difference.points) bounds.keep(p + to_view(by));
  };
  for (const Event& event : recording.events) {
    if (const auto* e = std::get_if<recorded::CastEnded>(&event)) keep(AnyVector(moved + velocity * (e->time - time)));
    const auto* state = std::get_if<recorded::State>(&event);
    if (!state || state->bodies.size() < 2) continue;
    moved = state->bodies[0].position - bodies[0].pose.position - state->bodies[1].position + bodies[1].pose.position;
    velocity = state->bodies[0].velocity - state->bodies[1].velocity, time = state->time;
    keep(moved);
  }
}

}  // namespace

namespace {

/// Of bodies that move, at the beginning and of a cast after every response: as long as they are fast.
void add_velocities(std::vector<Arrow>& arrows, const Recording& recording) {
  const std::vector<Body>& bodies = recording.scene.scene.bodies;
  double fastest = 0;
  for (const Body& body : bodies) fastest = std::max(fastest, body.motion ? body.motion->velocity.norm() : 0);
  if (!(fastest > 0)) return;
  const auto add = [&](const AnyVector& from, const AnyVector& velocity) { add_arrow(arrows, to_view(from), velocity, velocity_arrow * std::min(1.0, velocity.norm() / fastest)); };
  for (const Body& body : bodies)
    if (body.motion) add(body.pose.position, body.motion->velocity);
  for (const Event& event : recording.events)
    if (const auto* state = std::get_if<recorded::State>(&event); state && recording.scene.scene.query == Query::cast)
      for (const recorded::BodyState& body : state->bodies) add(body.position, body.velocity);
}

}  // namespace

Camera fit_world(const SceneMeshes& meshes, const Recording& recording) {
  std::vector<Arrow> arrows;
  add_velocities(arrows, recording);
  const bool still = recording.scene.scene.query != Query::simulate;  // of a simulation thousands are asked, everywhere: the bodies would become small for them
  for (const Event& event : recording.events)
    if (const auto* e = std::get_if<recorded::SupportQueried>(&event); e && still) add_arrow(arrows, to_view(e->a), e->direction, support_arrow), add_arrow(arrows, to_view(e->b), e->direction, -support_arrow);
  const Result& r = recording.result;
  if (r.witness_a && r.normal) add_arrow(arrows, to_view(*r.witness_a), *r.normal, normal_arrow);
  return with_room_for(arrows, world_bounds(meshes, recording), meshes.dimension);
}

Camera fit_difference(const SceneMeshes& meshes, const Recording& recording) {
  Bounds bounds;
  bounds.keep(ViewPoint::Zero());
  for (const ViewPoint& p : meshes.difference.points) bounds.keep(p);
  if (meshes.radius > 0 && std::isfinite(meshes.radius)) {
    const ViewPoint r(meshes.radius, meshes.dimension > 1 ? meshes.radius : 0, meshes.dimension > 2 ? meshes.radius : 0);
    bounds.add(r), bounds.add(-r);
    bounds.around_origin = meshes.radius;
  }
  add_moved_difference(bounds, meshes, recording);
  std::vector<Arrow> arrows;
  for (const Event& event : recording.events) {
    if (const auto given = given_vertex(event)) bounds.keep(to_view(given->w));
    if (const auto* e = std::get_if<recorded::GjkBegan>(&event)) add_arrow(arrows, ViewPoint::Zero(), e->direction, direction_arrow);
    if (const auto* e = std::get_if<recorded::SupportQueried>(&event)) add_arrow(arrows, ViewPoint::Zero(), e->direction, direction_arrow);
  }
  return with_room_for(arrows, bounds, meshes.dimension);
}

}  // namespace gjkdbg
