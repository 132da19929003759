#include "debugger/render/step_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "debugger/render/regions.h"

namespace gjkdbg {

SceneMeshes scene_meshes(const Scene& scene) {
  SceneMeshes meshes;
  meshes.dimension = scene.dimension;
  for (const Body& body : scene.bodies) meshes.bodies.push_back(body_mesh(body, scene.dimension));
  if (scene.bodies.size() < 2) return meshes;
  meshes.difference = difference_mesh(scene.bodies[0], scene.bodies[1], scene.dimension);
  meshes.radius = radius_sum(scene.bodies[0], scene.bodies[1], scene.dimension);
  return meshes;
}

std::string simplex_letter(const Frame& frame, int vertex, bool newest_first) {
  const auto found = std::find(frame.lettered.begin(), frame.lettered.end(), vertex);
  if (found == frame.lettered.end()) return {};
  const auto from_newest = found - frame.lettered.begin(), from_oldest = frame.lettered.end() - found - 1;
  return std::string(1, static_cast<char>('A' + (newest_first ? from_newest : from_oldest)));
}

namespace {

/// Builds one picture; what both views need.
class Painter {
 public:
  Painter(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const ViewSettings& settings, const Palette& palette,
          const Projection& projection)
      : meshes_(meshes), recording_(recording), frame_(frame), settings_(settings), palette_(palette), projection_(projection) {}

  Picture world() {
    grid();
    for (std::size_t i = 0; i < meshes_.bodies.size(); ++i) {
      const int n = static_cast<int>(i);
      if (moves()) swept(n);
      mesh(moves() ? placed(n) : meshes_.bodies[i], body_colour(n), 0.16, one_d_offset(n));
    }
    velocities();
    supports();
    answer();
    return std::move(picture_);
  }

  Picture difference() {
    grid();
    if (settings_.difference && !moves()) mesh(meshes_.difference, palette_.text_faint, 0.07, ViewPoint::Zero());
    if (settings_.difference && moves()) mesh(difference_here(), palette_.text_faint, 0.07, ViewPoint::Zero());
    region();
    polytope();
    portal();
    fading();
    simplex();
    bound_rings();
    origin();
    direction();
    closest();
    vertices();
    return std::move(picture_);
  }

 private:
  double unit() const { return std::min(projection_.rectangle().width, projection_.rectangle().height) / projection_.pixels_per_length() / 2; }
  bool flat() const { return meshes_.dimension < 3; }

  /// Intervals lie over one another: in 1D each is drawn a little off the line.
  ViewPoint one_d_offset(int body) const { return meshes_.dimension == 1 ? ViewPoint(0, (body == 0 ? 0.16 : -0.16) * unit(), 0) : ViewPoint(ViewPoint::Zero()); }

  // --- Bodies that move -------------------------------------------------------------------------------------------------------

  bool moves() const { return frame_.places.size() == meshes_.bodies.size() && !frame_.places.empty(); }

  /// The pair that is looked at in the two colours, all others in grey.
  Colour body_colour(int i) const {
    const std::array<int, 2> pair = moves() ? frame_.pair : std::array<int, 2>{0, 1};
    return i == pair[0] ? palette_.body_a : i == pair[1] ? palette_.body_b : palette_.dropped;
  }

  /// A body's mesh where the frame has it: p goes to R R0^T (p - x0) + x.
  DisplayMesh placed(int i) const {
    const auto k = static_cast<std::size_t>(i);
    const Body& body = recording_.scene.scene.bodies[k];
    const Frame::Place& place = frame_.places[k];
    const AnyMatrix turn = place.rotation * body.pose.matrix.transpose();
    const auto move = [&](const ViewPoint& p) {
      const AnyVector from = p.head(meshes_.dimension);
      return to_view(AnyVector(turn * (from - body.pose.position) + place.position));
    };
    DisplayMesh mesh = meshes_.bodies[k];
    for (ViewPoint& p : mesh.points) p = move(p);
    if (meshes_.dimension == 3)
      for (ViewPoint& n : mesh.normals) n = turn * n;
    return mesh;
  }

  DisplayMesh difference_here() const {
    const auto& bodies = recording_.scene.scene.bodies;
    const auto at = [&](int i) {
      Body body = bodies[static_cast<std::size_t>(i)];
      body.pose.position = frame_.places[static_cast<std::size_t>(i)].position, body.pose.matrix = frame_.places[static_cast<std::size_t>(i)].rotation;
      return body;
    };
    const int n = static_cast<int>(bodies.size());
    if (frame_.pair[0] >= n || frame_.pair[1] >= n) return {};
    return difference_mesh(at(frame_.pair[0]), at(frame_.pair[1]), meshes_.dimension);
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

  void velocities() {
    if (!moves()) return;
    double fastest = 0;
    for (const Frame::Place& place : frame_.places) fastest = std::max(fastest, place.velocity.norm());
    if (!(fastest > 0)) return;
    for (std::size_t i = 0; i < frame_.places.size(); ++i) {
      const ViewPoint v = to_view(frame_.places[i].velocity);
      if (!(v.norm() > 1e-9 * fastest)) continue;
      const ViewPoint from = to_view(frame_.places[i].position), tip = from + v * (0.35 * unit() / fastest);
      picture_.arrow(from, tip, palette_.support);
      label(tip, "velocity", palette_.support);
    }
    if (const auto* e = std::get_if<recorded::ImpulseApplied>(&recording_.events[frame_.step])) impulse(*e);
    if (const auto* e = std::get_if<recorded::ContactFound>(&recording_.events[frame_.step])) picture_.points.push_back({to_view(e->point), palette_.newest, 6, Mark::square, -1});
  }

  void impulse(const recorded::ImpulseApplied& e) {
    const ViewPoint at = to_view(e.point), along = to_view(e.impulse);
    picture_.points.push_back({at, palette_.newest, 5, Mark::square, -1});
    if (along.isZero(0)) return;
    picture_.arrow(at, at + along.stableNormalized() * unit() * 0.3, palette_.newest);
    label(at + along.stableNormalized() * unit() * 0.3, "impulse", palette_.newest);
  }

  /// Lines at round distances: in the plane of a 2D scene, or on the floor y = 0's level of a 3D one.
  void grid() {
    if (!settings_.grid) return;
    const double step = std::pow(10, std::floor(std::log10(unit() * 0.8)));
    const ViewPoint centre = (projection_.target() / step).array().round() * step;
    const Colour colour = palette_.grid;
    if (meshes_.dimension == 1) {
      const double reach = 40 * step, x = centre[0];
      picture_.line({x - reach, 0, 0}, {x + reach, 0, 0}, palette_.dropped, 1.5);
      for (int i = -40; i <= 40; ++i) picture_.line({x + i * step, -0.03 * unit(), 0}, {x + i * step, 0.03 * unit(), 0}, palette_.dropped, 1.2);
      for (int i = -9; i <= 9; ++i) mark_number({x + i * step, -0.03 * unit(), 0}, x + i * step, -4, 8);
      return;
    }
    if (flat()) {
      // Numbers along the axes, or along the edge of the view when they are out of it.
      const double left = projection_.target()[0] - 0.95 * unit(), low = projection_.target()[1] - 0.95 * unit();
      const bool x_axis_seen = std::abs(projection_.target()[1]) < unit(), y_axis_seen = std::abs(projection_.target()[0]) < unit();
      for (int i = -9; i <= 9; ++i) {
        mark_number({centre[0] + i * step, x_axis_seen ? 0 : low, 0}, centre[0] + i * step, 3, 2);
        if (std::abs(centre[1] + i * step) > 1e-9 * step) mark_number({y_axis_seen ? 0 : left, centre[1] + i * step, 0}, centre[1] + i * step, 3, 2);
      }
    }
    const int count = flat() ? 40 : 10;
    const double reach = count * step, floor = projection_.target()[1] - 0.8 * unit();
    for (int i = -count; i <= count; ++i) {
      const double x = centre[0] + i * step, y = centre[1] + i * step, z = centre[2] + i * step;
      if (flat()) {
        picture_.line({x, centre[1] - reach, 0}, {x, centre[1] + reach, 0}, x == 0 ? colour.shaded(0.25) : colour, 1);
        picture_.line({centre[0] - reach, y, 0}, {centre[0] + reach, y, 0}, y == 0 ? colour.shaded(0.25) : colour, 1);
      } else {
        picture_.line({x, floor, centre[2] - reach}, {x, floor, centre[2] + reach}, colour, 1);
        picture_.line({centre[0] - reach, floor, z}, {centre[0] + reach, floor, z}, colour, 1);
      }
    }
  }

  void mark_number(const ViewPoint& at, double value, double dx, double dy) {
    if (!settings_.labels) return;
    char text[24];
    std::snprintf(text, sizeof text, "%.4g", std::abs(value) < 1e-12 * unit() ? 0.0 : value);
    picture_.scale_marks.push_back({at, text, palette_.text_faint.with_alpha(0.75), dx, dy});
  }

  void mesh(const DisplayMesh& m, Colour colour, double opacity, const ViewPoint& offset) {
    const auto at = [&](int i) { return ViewPoint(m.points[static_cast<std::size_t>(i)] + offset); };
    std::vector<bool> front(m.faces.size(), true);
    for (std::size_t f = 0; f < m.faces.size(); ++f) {
      if (m.dimension == 3) front[f] = projection_.faces_eye(m.normals[f], at(m.faces[f][0]));
      PictureFace face;
      for (const int i : m.faces[f]) face.points.push_back(at(i));
      // Light comes from above and the eye's left.
      const double light = m.dimension == 3 ? m.normals[f].dot((projection_.towards() + 0.6 * projection_.up() - 0.4 * projection_.right()).normalized()) : 0;
      face.fill = colour.shaded(0.25 * light).with_alpha(opacity * (front[f] ? 1 : 0.5));
      picture_.faces.push_back(std::move(face));
    }
    for (const auto& edge : m.edges) {
      const bool fa = edge.face_a < 0 || front[static_cast<std::size_t>(edge.face_a)], fb = edge.face_b < 0 ? fa : front[static_cast<std::size_t>(edge.face_b)];
      const bool outline = fa != fb || edge.face_b < 0;
      if (!edge.crease && !outline) continue;
      const bool hidden = !fa && !fb;
      if (edge.from == edge.to) {
        picture_.points.push_back({at(edge.from), colour, 5, Mark::disc, -1});
      } else {
        const double wide = m.dimension == 1 ? 9 : outline ? 1.8 : 1.3;
        picture_.line(at(edge.from), at(edge.to), colour.with_alpha(opacity > 0.1 ? (hidden ? 0.35 : 0.95) : (hidden ? 0.2 : 0.5)), wide);
      }
    }
  }

  void label(const ViewPoint& at, const std::string& text, Colour colour, double dx = 9, double dy = -9) {
    if (settings_.labels && !text.empty()) picture_.labels.push_back({at, text, colour, dx, dy});
  }

  std::string letter_of(int number) const { return simplex_letter(frame_, number, settings_.newest_first); }

  const FrameVertex* vertex(int number) const {
    const auto found = frame_.vertices.find(number);
    return found == frame_.vertices.end() ? nullptr : &found->second;
  }

  // --- The world ------------------------------------------------------------------------------------------------

  void supports() {
    const bool over = frame_.step + 1 == recording_.events.size() && recording_.result.witness_a;  // the witness points speak then
    for (const auto& [number, v] : frame_.vertices) {
      const bool newest = frame_.newest == number && !over, in_simplex = std::find(frame_.simplex.begin(), frame_.simplex.end(), number) != frame_.simplex.end();
      const bool selected = settings_.selected == number || settings_.pointed == number;
      if (((!newest && !in_simplex) || over) && !selected) continue;
      const ViewPoint a = to_view(v.a) + one_d_offset(0), b = to_view(v.b) + one_d_offset(1);
      const Colour colour = newest ? palette_.support : palette_.support.with_alpha(0.45);
      picture_.points.push_back({a, colour, newest ? 6.0 : 4.0, Mark::disc, number});
      picture_.points.push_back({b, colour, newest ? 6.0 : 4.0, Mark::square, number});
      if (selected) mark_selected(a), mark_selected(b), picture_.line(a, b, palette_.text, 1, Stroke::dashed);
      if (!newest) continue;
      label(a, "a", palette_.support);
      label(b, "b", palette_.support, 9, 10);
      if (!frame_.direction || frame_.depth) continue;
      const ViewPoint d = arrow_along(*frame_.direction);
      if (d.isZero(0)) continue;
      picture_.arrow(a, a + d, palette_.simplex);
      picture_.arrow(b, b - d, palette_.simplex);
      label(a + d, "d", palette_.simplex);
      label(b - d, "-d", palette_.simplex);
    }
  }

  void mark_selected(const ViewPoint& at) { picture_.points.push_back({at, palette_.text, 10, Mark::ring, -1}); }

  /// A third of the view along a direction, or nothing for a direction that is none.
  ViewPoint arrow_along(const AnyVector& direction, double share = 0.3) const {
    const ViewPoint d = to_view(direction);
    if (!d.allFinite() || d.isZero(0)) return ViewPoint::Zero();
    return d.stableNormalized() * unit() * share;
  }

  /// At the last step: the witness points and the normal, and the contact points.
  void answer() {
    if (frame_.step + 1 != recording_.events.size()) return;
    const Result& r = recording_.result;
    if (!r.witness_a || !r.witness_b) return;
    const ViewPoint a = to_view(*r.witness_a) + one_d_offset(0), b = to_view(*r.witness_b) + one_d_offset(1);
    picture_.lines.push_back({a, b, palette_.frontier, 2.5, Stroke::solid, false, true});
    picture_.points.push_back({a, palette_.body_a, 6, Mark::disc, -1});
    picture_.points.push_back({b, palette_.body_b, 6, Mark::disc, -1});
    label(a, "witness a", palette_.body_a, 9, 12);
    label(b, "witness b", palette_.body_b, 9, -12);
    if (r.normal) {
      const ViewPoint tip = a + arrow_along(*r.normal, 0.4);
      picture_.arrow(a, tip, palette_.frontier);
      label(tip, "n", palette_.frontier);
    }
    if (!r.contacts) return;
    for (const ContactPoint& c : *r.contacts) {
      picture_.points.push_back({to_view(c.point_a), palette_.newest, 5, Mark::square, -1});
      picture_.lines.push_back({to_view(c.point_a), to_view(c.point_b), palette_.newest, 2, Stroke::solid, false, true});
    }
  }

  // --- The difference ---------------------------------------------------------------------------------------------

  void origin() {
    if (meshes_.radius > 0 && flat()) circle(meshes_.radius, palette_.frontier.with_alpha(0.8));
    if (meshes_.radius > 0 && !flat()) circle_facing(meshes_.radius, palette_.frontier.with_alpha(0.8));
    picture_.points.push_back({ViewPoint::Zero(), palette_.origin, 9, Mark::cross, -1});
    label(ViewPoint::Zero(), "O", palette_.origin, 10, 12);
  }
  void circle(double radius, Colour colour) { ring(radius, ViewPoint::UnitX(), ViewPoint::UnitY(), colour); }
  void circle_facing(double radius, Colour colour) { ring(radius, projection_.right(), projection_.up(), colour); }
  void ring(double radius, const ViewPoint& x, const ViewPoint& y, Colour colour) {
    constexpr int parts = 64;
    const auto at = [&](int i) { return ViewPoint(radius * (std::cos(i * 2 * M_PI / parts) * x + std::sin(i * 2 * M_PI / parts) * y)); };
    for (int i = 0; i < parts; i += 2) picture_.line(at(i), at(i + 1), colour, 1.3);
  }

  void face(const FrameFace& f, Colour colour, double opacity, double width, Stroke stroke = Stroke::solid) {
    PictureFace filled;
    for (const int v : f.vertices) {
      const FrameVertex* p = vertex(v);
      if (!p) return;
      filled.points.push_back(to_view(p->w));
    }
    const std::size_t n = filled.points.size();
    for (std::size_t i = 0; i < (n == 2 ? 1 : n) && n > 1; ++i) picture_.line(filled.points[i], filled.points[(i + 1) % n], colour.with_alpha(stroke == Stroke::dashed ? 0.7 : 0.9), width, stroke);
    filled.fill = colour.with_alpha(opacity);
    if (n > 2) picture_.faces.push_back(std::move(filled));
  }

  void polytope() {
    for (const auto& [number, f] : frame_.faces) {
      const bool chosen = frame_.chosen == number, added = std::find(frame_.added.begin(), frame_.added.end(), number) != frame_.added.end();
      const Colour colour = chosen ? palette_.chosen : added ? palette_.frontier : palette_.simplex;
      face(f, colour, chosen ? 0.5 : added ? 0.16 : 0.1, chosen ? 3 : added ? 1.6 : 1.2);
    }
    if (settings_.dropped)
      for (const FrameFace& f : frame_.removed) face(f, palette_.dropped, 0.04, 1.2, Stroke::dashed);
    for (const Edge& e : frame_.horizon) {
      const FrameVertex *p = vertex(e[0]), *q = vertex(e[1]);
      if (p && q && !flat()) picture_.lines.push_back({to_view(p->w), to_view(q->w), palette_.frontier, 3.2, Stroke::solid, true, true});
    }
    if (!frame_.normal || !frame_.depth) return;
    const ViewPoint tip = to_view(*frame_.normal) * std::max(0.0, *frame_.depth - meshes_.radius);
    picture_.lines.push_back({ViewPoint::Zero(), tip, palette_.chosen, 3, Stroke::solid, true, true});
    label(tip, "depth", palette_.chosen);
  }

  /// MPR: the rays from the inner point to the portal's corners, and the one through the origin.
  void portal() {
    if (!frame_.interior) return;
    const ViewPoint inside = to_view(*frame_.interior);
    picture_.points.push_back({inside, palette_.text, 6, Mark::ring, -1});
    label(inside, "inside", palette_.text, 9, 12);
    const ViewPoint ahead = -inside;
    picture_.lines.push_back({inside, ahead.isZero(0) ? inside : ViewPoint(ahead.stableNormalized() * unit() * 0.8), palette_.text_soft, 1.6, Stroke::dashed, true, true});
    if (frame_.portal.empty()) return;
    for (const int v : frame_.portal)
      if (const FrameVertex* p = vertex(v)) picture_.line(inside, to_view(p->w), palette_.chosen.with_alpha(0.5), 1.3);
    face({-1, 0, frame_.portal, {}, 0}, palette_.chosen, 0.4, 2.6);
  }

  /// The simplex before the cut and the part that was kept: where the origin is seen from.
  void region() {
    const auto* e = std::get_if<recorded::SimplexReduced>(&recording_.events[frame_.step]);
    if (!e || !settings_.regions || e->before.size() < 2) return;
    std::vector<ViewPoint> points;
    std::vector<int> part;
    for (const int v : e->before) {
      const FrameVertex* p = vertex(v);
      if (!p) return;
      if (std::find(e->region.begin(), e->region.end(), v) != e->region.end()) part.push_back(static_cast<int>(points.size()));
      points.push_back(to_view(p->w));
    }
    if (part.size() != e->region.size()) return;
    draw_region(picture_, points, part, 3 * unit(), palette_.simplex, meshes_.dimension);
    ViewPoint middle = ViewPoint::Zero();
    std::string name;
    for (const int i : part) middle += points[static_cast<std::size_t>(i)] / static_cast<double>(part.size());
    for (const int v : frame_.simplex) name += letter_of(v);
    std::sort(name.begin(), name.end());
    label(meshes_.dimension == 1 ? middle : ViewPoint(middle * 0.55), "region " + name, palette_.simplex, 10, 22);
  }

  /// What was dropped in the last steps, fading.
  void fading() {
    if (!settings_.dropped) return;
    std::size_t cuts = 0;
    for (std::size_t back = 1; back <= 8 && back <= frame_.step && cuts < 2; ++back) {
      const Event& event = recording_.events[frame_.step - back];
      if (std::holds_alternative<recorded::GjkBegan>(event) || std::holds_alternative<recorded::PolytopeSeeded>(event)) return;
      const auto* e = std::get_if<recorded::SimplexReduced>(&event);
      if (!e || e->before.size() == e->region.size()) continue;
      ++cuts;
      for (const int v : e->before) {
        if (std::find(e->region.begin(), e->region.end(), v) != e->region.end() || vertex(v)) continue;
        for (std::size_t k = frame_.step - back; k-- > 0;)
          if (const auto* query = std::get_if<recorded::SupportQueried>(&recording_.events[k]); query && query->vertex == v) {
            picture_.points.push_back({to_view(query->w), palette_.dropped.with_alpha(cuts == 1 ? 0.55 : 0.3), 3.5, Mark::disc, -1});
            break;
          }
      }
    }
  }

  /// The surface of A - B is nowhere nearer than the one ring and somewhere no farther than the other.
  void bound_rings() {
    if (!settings_.bounds || meshes_.dimension == 1) return;
    const auto ring_at = [&](double bound, Colour colour) {
      const double r = std::abs(bound + meshes_.radius);
      if (!std::isfinite(r) || !(r > 1e-3 * unit()) || r > 50 * unit()) return;
      if (flat()) ring(r, ViewPoint::UnitX(), ViewPoint::UnitY(), colour);
      else ring(r, projection_.right(), projection_.up(), colour);
    };
    if (frame_.upper_bound) ring_at(*frame_.upper_bound, palette_.text_soft.with_alpha(0.5));
    if (frame_.lower_bound && frame_.lower_bound != frame_.upper_bound) ring_at(*frame_.lower_bound, palette_.text_faint.with_alpha(0.4));
  }

  void simplex() {
    std::vector<ViewPoint> points;
    for (const int v : frame_.simplex)
      if (const FrameVertex* p = vertex(v)) points.push_back(to_view(p->w));
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + 1; j < points.size(); ++j) picture_.line(points[i], points[j], palette_.simplex, meshes_.dimension == 1 ? 5 : 2.4);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + 1; j < points.size(); ++j)
        for (std::size_t k = j + 1; k < points.size(); ++k) picture_.faces.push_back({{points[i], points[j], points[k]}, palette_.simplex.with_alpha(0.2)});
    if (!settings_.dropped) return;
    for (const int d : frame_.dropped)
      if (const FrameVertex* p = vertex(d))
        for (const ViewPoint& q : points) picture_.line(to_view(p->w), q, palette_.dropped, 1.3, Stroke::dashed);
  }

  void direction() {
    if (!frame_.direction || frame_.gjk_status) {
      if (frame_.stage == Frame::Stage::gjk || frame_.stage == Frame::Stage::before || frame_.stage == Frame::Stage::done) return;
    }
    if (!frame_.direction || frame_.depth) return;
    const ViewPoint d = arrow_along(*frame_.direction, 0.42);
    if (d.isZero(0)) return;
    picture_.arrow(ViewPoint::Zero(), d, palette_.simplex);
    label(d, "d", palette_.simplex);
    if (settings_.support_plane && frame_.answered) support_plane(d.normalized());
  }

  /// Through the newest vertex, across the direction: all of A - B lies on the origin's side of it.
  void support_plane(const ViewPoint& d) {
    const FrameVertex* newest = frame_.newest ? vertex(*frame_.newest) : nullptr;
    if (!newest) return;
    const ViewPoint w = to_view(newest->w), foot = d * d.dot(w);
    const double reach = 0.75 * unit();
    const Colour colour = palette_.frontier;
    if (meshes_.dimension == 1) {
      picture_.line(w - ViewPoint(0, reach / 3, 0), w + ViewPoint(0, reach / 3, 0), colour, 1.6, Stroke::dashed);
    } else if (meshes_.dimension == 2) {
      const ViewPoint along(-d[1], d[0], 0), middle = (w + foot) / 2;
      picture_.line(middle - along * 1.6 * reach, middle + along * 1.6 * reach, colour, 1.6, Stroke::dashed);
    } else {
      ViewPoint x = d.unitOrthogonal();
      if (const ViewPoint across = w - foot; across.norm() > 1e-9 * unit()) x = across.normalized();
      const ViewPoint y = d.cross(x), middle = (w + foot) / 2;
      const ViewPoint corners[4] = {middle + (x + y) * reach / 1.5, middle + (x - y) * reach / 1.5, middle - (x + y) * reach / 1.5, middle - (x - y) * reach / 1.5};
      for (int i = 0; i < 4; ++i) picture_.line(corners[i], corners[(i + 1) % 4], colour.with_alpha(0.8), 1.4, Stroke::dashed);
      picture_.faces.push_back({{corners[0], corners[1], corners[2], corners[3]}, colour.with_alpha(0.05)});
    }
  }

  void closest() {
    if (!frame_.closest || !frame_.faces.empty()) return;
    const ViewPoint v = to_view(*frame_.closest);
    if (v.norm() > 1e-6 * unit()) {
      picture_.lines.push_back({ViewPoint::Zero(), v, palette_.text_soft, 1.6, Stroke::dashed, false, true});
      picture_.points.push_back({v, palette_.text, 6, Mark::ring, -1});
      label(v, "v", palette_.text);
    }
  }

  void vertices() {
    for (const auto& [number, v] : frame_.vertices) {
      const std::string letter = letter_of(number);
      const bool dropped = std::find(frame_.dropped.begin(), frame_.dropped.end(), number) != frame_.dropped.end();
      const bool newest = frame_.newest == number;
      if (dropped && !settings_.dropped) continue;
      const ViewPoint w = to_view(v.w);
      const Colour colour = newest ? palette_.newest : dropped ? palette_.dropped : palette_.simplex;
      picture_.points.push_back({w, colour, newest ? 6.5 : dropped ? 4.0 : letter.empty() ? 3.5 : 6.0, Mark::disc, number});
      if (settings_.selected == number || settings_.pointed == number) mark_selected(w);
      if (dropped) label(w, letter.empty() ? "dropped" : letter + " dropped", palette_.dropped);
      else if (!letter.empty()) label(w, letter, palette_.text);
      else if (newest) label(w, "w", palette_.newest);
    }
  }

  const SceneMeshes& meshes_;
  const Recording& recording_;
  const Frame& frame_;
  const ViewSettings& settings_;
  const Palette& palette_;
  const Projection& projection_;
  Picture picture_;
};

struct Bounds {
  ViewPoint low = ViewPoint::Constant(INFINITY), high = ViewPoint::Constant(-INFINITY);
  void add(const ViewPoint& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  Camera camera(int dimension) const {
    Camera c;
    c.target = (low + high) / 2;
    const double size = (high - low).norm() / 2;
    c.radius = size > 0 ? size * 1.15 : 1;
    c.flat = dimension < 3;
    return c;
  }
};

}  // namespace

Picture world_picture(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const ViewSettings& settings, const Palette& palette,
                      const Projection& projection) {
  return Painter(meshes, recording, frame, settings, palette, projection).world();
}

Picture difference_picture(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const ViewSettings& settings, const Palette& palette,
                           const Projection& projection) {
  return Painter(meshes, recording, frame, settings, palette, projection).difference();
}

Camera fit_world(const SceneMeshes& meshes) {
  Bounds bounds;
  for (const DisplayMesh& mesh : meshes.bodies)
    for (const ViewPoint& p : mesh.points) bounds.add(p);
  return bounds.camera(meshes.dimension);
}

Camera fit_world(const SceneMeshes& meshes, const Recording& recording) {
  const Scene& scene = recording.scene.scene;
  if (!scene.motion) return fit_world(meshes);
  Bounds bounds;
  const auto add = [&](std::size_t i, const AnyVector& position) {
    const ViewPoint shift = to_view(AnyVector(position - scene.bodies[i].pose.position));
    for (const ViewPoint& p : meshes.bodies[i].points) bounds.add(p), bounds.add(p + shift);
  };
  const double end = recording.result.intersecting ? recording.result.time.value_or(1) : 1;
  for (std::size_t i = 0; i < meshes.bodies.size(); ++i) add(i, scene.query == Query::cast ? AnyVector(scene.bodies[i].pose.position + scene.bodies[i].motion->velocity * end) : scene.bodies[i].pose.position);
  for (const Event& event : recording.events)
    if (const auto* state = std::get_if<recorded::State>(&event))
      for (std::size_t i = 0; i < state->bodies.size() && i < meshes.bodies.size(); ++i) add(i, state->bodies[i].position);
  return bounds.camera(meshes.dimension);
}

Camera fit_difference(const SceneMeshes& meshes, const Recording& recording) {
  Bounds bounds;
  bounds.add(ViewPoint::Constant(0));
  for (const ViewPoint& p : meshes.difference.points) bounds.add(p);
  if (meshes.radius > 0 && std::isfinite(meshes.radius)) {
    const ViewPoint r(meshes.radius, meshes.dimension > 1 ? meshes.radius : 0, meshes.dimension > 2 ? meshes.radius : 0);
    bounds.add(r), bounds.add(-r);
  }
  for (const Event& event : recording.events)
    if (const auto* query = std::get_if<recorded::SupportQueried>(&event)) bounds.add(to_view(query->w));
  return bounds.camera(meshes.dimension);
}

}  // namespace gjkdbg
