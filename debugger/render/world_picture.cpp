// The world: the bodies, their supports, the answer; of bodies that move where they came from and how fast they are.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "algo/motion.h"
#include "debugger/render/painter.h"
#include "recordings/mesh_parts.h"

namespace gjkdbg {
namespace {

class WorldPainter : public Painter {
 public:
  using Painter::Painter;

  Picture paint() {
    grid();
    for (std::size_t i = 0; i < meshes_.bodies.size(); ++i) {
      const int n = static_cast<int>(i);
      if (moves()) swept(n);
      mesh(moves() ? placed(n) : meshes_.bodies[i], body_colour(n), 0.16, one_d_offset(n));
    }
    triangles();
    velocities();
    supports();
    projected();
    answer();
    handles();
    return std::move(picture_);
  }

 private:
  DisplayMesh placed(int i) const { return placed_mesh(meshes_, recording_, frame_, i); }

  /// Of a mesh the triangle whose run this is.
  void triangles() {
    const auto parts = mesh_parts(recording_, frame_);
    for (std::size_t i = 0; parts && i < 2; ++i) {
      if (parts->triangle[i] < 0) continue;
      const int body = frame_.pair[i];
      const DisplayMesh mesh = moves() ? placed(body) : meshes_.bodies[static_cast<std::size_t>(body)];
      const Colour colour = body_colour(body);
      PictureFace face;
      for (const int corner : mesh.faces[static_cast<std::size_t>(parts->triangle[i])]) face.points.push_back(mesh.points[static_cast<std::size_t>(corner)]);
      for (std::size_t k = 0; k < 3; ++k) picture_.line(face.points[k], face.points[(k + 1) % 3], colour, 3);
      face.fill = colour.with_alpha(0.35);
      picture_.faces.push_back(std::move(face));
    }
  }

  /// Where a moving body was at the beginning, as an outline, and the way of its place.
  void swept(int i) {
    const Body& body = recording_.scene.scene.bodies[static_cast<std::size_t>(i)];
    const Frame::Place& place = frame_.places[static_cast<std::size_t>(i)];
    if (place.position == body.pose.position && place.rotation == body.pose.matrix) return;
    const DisplayMesh& began = meshes_.bodies[static_cast<std::size_t>(i)];
    for (const auto& edge : began.edges)
      if (edge.crease || edge.face_b < 0)
        picture_.line(began.points[static_cast<std::size_t>(edge.from)], began.points[static_cast<std::size_t>(edge.to)], body_colour(i).with_alpha(0.3), 1, Stroke::dashed);
    std::vector<ViewPoint> way{to_view(body.pose.position)};
    const std::size_t states = frame_.step;
    for (std::size_t k = 0; k < states; ++k)
      if (const auto* state = std::get_if<recorded::State>(&recording_.events[k]); state && static_cast<std::size_t>(i) < state->bodies.size())
        way.push_back(to_view(state->bodies[static_cast<std::size_t>(i)].position));
    way.push_back(to_view(place.position));
    for (std::size_t k = 0; k + 1 < way.size(); ++k) picture_.line(way[k], way[k + 1], body_colour(i).with_alpha(0.6), 1.2);
  }

  /// Of the whole motion, so that an arrow that grows shows a body that gets faster. What is slower than a fiftieth of it has none.
  struct Fastest {
    double velocity = 0, spin = 0;
    template <class Velocity, class Spin>
    void take(const Velocity& v, const Spin& s) {
      velocity = std::max(velocity, v.norm());
      for (const double x : s) spin = std::max(spin, std::abs(x));
    }
  };
  static constexpr double least_share = 0.02;
  Fastest fastest_ever() const {
    Fastest fastest;
    for (const Body& body : recording_.scene.scene.bodies)
      if (body.motion) fastest.take(body.motion->velocity, in_degrees(body.motion->angular_velocity));
    for (const Event& event : recording_.events)
      if (const auto* state = std::get_if<recorded::State>(&event))
        for (const recorded::BodyState& body : state->bodies) fastest.take(body.velocity, body.angular_velocity);
    return fastest;
  }

  /// Whose a motion is, where there are others.
  std::string of_body(std::size_t i) const { return frame_.places.size() > 2 ? " of " + body_letter(static_cast<int>(i)) : ""; }

  /// Of many bodies the two that are looked at have names at their arrows.
  bool named(int i) const { return frame_.places.size() <= 4 || i == frame_.pair[0] || i == frame_.pair[1]; }

  static std::string three_digits(double x) {
    char text[16];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
  }

  /// Angular velocities: in space an arrow along the axis, in the plane an arc the way the body turns.
  void spins(double fastest) {
    if (!(fastest > 0)) return;
    for (std::size_t i = 0; i < frame_.places.size(); ++i) {
      const Frame::Place& place = frame_.places[i];
      const ViewPoint from = to_view(place.position);
      if (place.angular_velocity.size() == 3) {
        const ViewPoint w(place.angular_velocity[0], place.angular_velocity[1], place.angular_velocity[2]);
        if (!(w.norm() > least_share * fastest)) continue;
        const ViewPoint tip = from + w * (0.3 * unit() / fastest);
        picture_.arrow(from, tip, palette_.chosen);
        if (named(static_cast<int>(i))) label(tip, "turning" + of_body(i), palette_.chosen);
      } else if (place.angular_velocity.size() == 1 && std::abs(place.angular_velocity[0]) > least_share * fastest) {
        const double sweep = place.angular_velocity[0] / fastest * 1.5, r = 0.14 * unit();
        const auto on_arc = [&](double share) { return ViewPoint(from + r * ViewPoint(std::cos(share * sweep), std::sin(share * sweep), 0)); };
        for (int k = 0; k < 11; ++k) picture_.line(on_arc(k / 12.0), on_arc((k + 1) / 12.0), palette_.chosen, 2);
        picture_.arrow(on_arc(11 / 12.0), on_arc(1), palette_.chosen, 2);
      }
    }
  }

  void velocities() {
    if (!moves()) return;
    const Fastest most = fastest_ever();
    spins(most.spin);
    const double fastest = most.velocity;
    if (!(fastest > 0)) return;
    for (std::size_t i = 0; i < frame_.places.size(); ++i) {
      const ViewPoint v = to_view(frame_.places[i].velocity);
      if (!(v.norm() > least_share * fastest)) continue;
      const ViewPoint from = to_view(frame_.places[i].position) + one_d_offset(static_cast<int>(i)), tip = tip_in_view(from, v * (velocity_arrow * unit() / fastest));
      shows("velocities");
      picture_.arrow(from, tip, palette_.support);
      if (named(static_cast<int>(i))) label(tip, "velocity" + of_body(i) + " " + three_digits(v.norm()), palette_.support);
    }
    if (const auto* e = std::get_if<recorded::ImpulseApplied>(&recording_.events[frame_.step])) impulse(*e);
    if (const auto* e = std::get_if<recorded::ContactFound>(&recording_.events[frame_.step])) picture_.points.push_back({to_view(e->point), palette_.chosen, 6, Mark::square, -1});
  }

  void impulse(const recorded::ImpulseApplied& e) {
    const ViewPoint at = to_view(e.point), along = to_view(e.impulse);
    picture_.points.push_back({at, palette_.chosen, 5, Mark::square, -1});
    if (along.isZero(0)) return;
    const ViewPoint tip = tip_in_view(at, along.stableNormalized() * unit() * 0.3);
    picture_.arrow(at, tip, palette_.chosen);
    label(tip, "impulse", palette_.chosen);
  }

  // --- The world ------------------------------------------------------------------------------------------------

  void supports() {
    const bool over = frame_.step + 1 == recording_.events.size() && recording_.result.witness_a;  // the witness points speak then
    for (const auto& [number, v] : frame_.vertices) {
      const bool newest = frame_.newest == number && !over, in_simplex = std::find(frame_.simplex.begin(), frame_.simplex.end(), number) != frame_.simplex.end();
      const bool selected = settings_.selected == number || settings_.pointed == number;
      if (((!newest && !in_simplex) || over) && !selected) continue;
      const ViewPoint a = to_view(v.a) + one_d_offset(frame_.pair[0]), b = to_view(v.b) + one_d_offset(frame_.pair[1]);
      const Colour colour = newest ? palette_.support : palette_.support.with_alpha(0.45);
      shows("supports");
      picture_.points.push_back({a, colour, newest ? 6.0 : 4.0, Mark::disc, number});
      picture_.points.push_back({b, colour, newest ? 6.0 : 4.0, Mark::square, number});
      if (selected) mark_selected(a), mark_selected(b), picture_.line(a, b, palette_.text, 1, Stroke::dashed);
      if (!newest) continue;
      label(a, "a", palette_.support);
      label(b, "b", palette_.support, 9, 10);
      if (!frame_.direction || !frame_.answered || frame_.depth) continue;  // the next direction is not theirs
      const ViewPoint d = arrow_along(*frame_.direction, support_arrow);
      if (d.isZero(0)) continue;
      const ViewPoint with_d = tip_in_view(a, d), against_d = tip_in_view(b, -d);
      picture_.arrow(a, with_d, palette_.simplex);
      picture_.arrow(b, against_d, palette_.simplex);
      label(with_d, "d", palette_.simplex);
      label(against_d, "-d", palette_.simplex);
    }
  }

  /// A point of each body, looking for the one nearest to the other; and where the next look begins.
  void projected() {
    if (frame_.predicted) {
      const ViewPoint x = to_view(*frame_.predicted) + one_d_offset(frame_.pair[0]);
      picture_.points.push_back({x, palette_.chosen, 9, Mark::ring, -1});
      label(x, "x", palette_.chosen, -12, 10);
    }
    const auto* e = std::get_if<recorded::PointsProjected>(&recording_.events[frame_.step]);
    if (!e) return;
    const ViewPoint a = to_view(e->a) + one_d_offset(frame_.pair[0]), b = to_view(e->b) + one_d_offset(frame_.pair[1]);
    shows("nearest points in turn");
    picture_.line(a, b, palette_.simplex, 1.6, Stroke::dashed);
    if (frame_.predicted) picture_.line(to_view(*frame_.predicted) + one_d_offset(frame_.pair[0]), b, palette_.chosen, 1.2, Stroke::dashed);
    picture_.points.push_back({a, palette_.simplex, 6, Mark::disc, -1});
    picture_.points.push_back({b, palette_.simplex, 6, Mark::square, -1});
    label(a, "a", palette_.simplex);
    label(b, "b", palette_.simplex, 9, 10);
  }

  /// Where the window draws the rings and letters that a body is held by: labels keep off them. Elsewhere the letters alone.
  void handles() {
    std::vector<ViewPoint> middles;
    if (moves() && frame_.step > 0) middles = letter_places(meshes_, recording_, frame_, projection_);
    else
      for (std::size_t i = 0; i < meshes_.bodies.size(); ++i) middles.push_back(middle(meshes_.bodies[i]) + one_d_offset(static_cast<int>(i)));
    const std::vector<BodyHandle> handles = place_handles(middles, projection_, settings_.scale);
    for (std::size_t i = 0; i < middles.size(); ++i) {
      if (settings_.body_letters) {
        label(middles[i], body_letter(static_cast<int>(i)), body_colour(static_cast<int>(i)).mixed(palette_.text), -4, 0);
        continue;
      }
      picture_.kept_free.push_back({handles[i].ring, palette_.text, handle_radius + 2, Mark::ring, -1});
      if (meshes_.dimension > 1) picture_.kept_free.push_back({handles[i].disc, palette_.text, 5, Mark::disc, -1});
    }
  }

  /// At the last step: the witness points and the normal, and the contact points.
  void answer() {
    if (frame_.step + 1 != recording_.events.size()) return;
    const Result& r = recording_.result;
    if (!r.witness_a || !r.witness_b) return;
    if (moves() && r.time && frame_.time != r.time) return;  // the bodies have moved on since
    const auto pair = r.pair.value_or(frame_.pair);
    const ViewPoint a = to_view(*r.witness_a) + one_d_offset(pair[0]), b = to_view(*r.witness_b) + one_d_offset(pair[1]);
    shows("witnesses");
    picture_.lines.push_back({a, b, palette_.frontier, 2.5, Stroke::solid, false, true});
    picture_.points.push_back({a, palette_.body_a, 6, Mark::disc, -1});
    picture_.points.push_back({b, palette_.body_b, 6, Mark::disc, -1});
    const double beside = (a - b).dot(projection_.up()) >= 0 ? -12 : 12;  // the upper one's name above it, the lower one's below
    const std::string witness = projection_.rectangle().width < 280 * settings_.scale ? "" : "witness ";  // a small view has no room for the word beside the point
    label(a, witness + "a", palette_.body_a, 9, beside);
    label(b, witness + "b", palette_.body_b, 9, -beside);
    if (r.normal) {
      shows("normal");
      const ViewPoint tip = tip_in_view(a, arrow_along(*r.normal, normal_arrow));
      picture_.arrow(a, tip, palette_.frontier);
      label(tip, "n", palette_.frontier);
    }
    if (!r.contacts) return;
    if (!r.contacts->empty()) shows("contact points");
    for (std::size_t i = 0; i < r.contacts->size(); ++i) {
      const ContactPoint& c = (*r.contacts)[i];
      picture_.points.push_back({to_view(c.point_a), palette_.chosen, 5, Mark::square, -1});
      picture_.lines.push_back({to_view(c.point_a), to_view(c.point_b), palette_.chosen, 2, Stroke::solid, false, true});
      if (r.contacts->size() > 1 && i < numbered_contacts) spare_label(to_view(c.point_a), std::to_string(i + 1), palette_.chosen.mixed(palette_.text), 8, -10);
    }
  }
};

}  // namespace

Picture world_picture(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const ViewSettings& settings, const Palette& palette,
                      const Projection& projection) {
  return WorldPainter(meshes, recording, frame, settings, palette, projection).paint();
}

}  // namespace gjkdbg
