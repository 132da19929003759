// The Minkowski difference: simplex, direction, support plane, regions, polytope, portal.
#include <algorithm>
#include <cmath>
#include <set>

#include "algo/motion.h"
#include "debugger/render/painter.h"
#include "debugger/render/regions.h"
#include "recordings/mesh_parts.h"

namespace gjkdbg {
namespace {

class DifferencePainter : public Painter {
 public:
  using Painter::Painter;

  Picture paint() {
    grid();
    const auto parts = mesh_parts(recording_, frame_);
    if (settings_.difference) mesh(moves() ? difference_here(parts) : parts ? difference_of(*parts) : meshes_.difference, palette_.text_faint, 0.07, ViewPoint::Zero());
    region();
    polytope();
    portal();
    parallelogram();
    ray();
    fading();
    simplex();
    const bool rings = bound_rings();
    origin();
    direction();
    closest();
    vertices();
    if (rings) shows("bounds");
    return std::move(picture_);
  }

 private:
  /// Of the pair where it is now; a mesh's is that of its triangle.
  DisplayMesh difference_here(const std::optional<MeshParts>& parts) const {
    const auto& bodies = recording_.scene.scene.bodies;
    const auto at = [&](std::size_t which) {
      const auto i = static_cast<std::size_t>(frame_.pair[which]);
      Body body = bodies[i];
      body.pose.position = frame_.places[i].position, body.pose.matrix = frame_.places[i].rotation;
      if (parts && parts->triangle[which] >= 0) body.shape = triangle_of(body.shape, static_cast<std::size_t>(parts->triangle[which]));
      return body;
    };
    const int n = static_cast<int>(bodies.size());
    if (frame_.pair[0] >= n || frame_.pair[1] >= n) return {};
    return difference_mesh(at(0), at(1), meshes_.dimension, meshes_.whole);
  }

  /// Of the triangles whose run this is, at rest.
  DisplayMesh difference_of(const MeshParts& parts) const {
    const auto part = [&](std::size_t i) {
      Body body = recording_.scene.scene.bodies[i];
      if (parts.triangle[i] >= 0) body.shape = triangle_of(body.shape, static_cast<std::size_t>(parts.triangle[i]));
      return body;
    };
    return difference_mesh(part(0), part(1), meshes_.dimension, meshes_.whole);
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
    if (!frame_.faces.empty()) shows("polytope");
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
    if (const auto chosen = frame_.chosen ? frame_.faces.find(*frame_.chosen) : frame_.faces.end(); chosen != frame_.faces.end()) name_face(chosen->second);
    right_face();
    if (!frame_.normal || !frame_.depth || frame_.epa_status == EpaStatus::aborted || frame_.mpr_status == MprStatus::overlapping) return;  // the latter's is no way out
    if (frame_.epa_status == EpaStatus::iteration_limit && recording_.scene.scene.query == Query::cast && !recording_.result.normal) return;  // nor is this, the answer says
    const ViewPoint tip = to_view(*frame_.normal) * std::max(0.0, *frame_.depth - meshes_.radius);
    if (!(tip.norm() > 1e-6 * unit())) return;
    shows("way out");
    picture_.lines.push_back({ViewPoint::Zero(), tip, palette_.text, 3, Stroke::solid, true, true});  // not the chosen face's colour, before which it lies
    area_label(tip / 2, meshes_.radius > 0 ? "depth of the cores" : "depth", palette_.text);
  }

  /// Beside another program's choice the face that is the nearest, in the colour in which the panel tells what is right.
  void right_face() {
    if (!foreign(recording_) || !std::holds_alternative<recorded::FaceChosen>(recording_.events[frame_.step])) return;
    const FrameFace* nearest = nullptr;
    for (const auto& [number, f] : frame_.faces)
      if (!nearest || f.distance < nearest->distance) nearest = &f;
    const auto chosen = frame_.chosen ? frame_.faces.find(*frame_.chosen) : frame_.faces.end();
    if (!nearest || (chosen != frame_.faces.end() && chosen->second.distance <= nearest->distance + 1e-7 * unit())) return;
    face(*nearest, palette_.support, 0.12, 3, Stroke::dashed);
    if (const auto at = middle_of(*nearest)) area_label(*at, "nearest: " + name_of(*nearest), palette_.support.mixed(palette_.text), 8, 30);
  }

  /// As the step's sentence calls it.
  std::string name_of(const FrameFace& f) const { return facet_name(meshes_.dimension) + " " + std::to_string(f.face); }

  std::optional<ViewPoint> middle_of(const FrameFace& f) const {
    ViewPoint middle = ViewPoint::Zero();
    for (const int v : f.vertices) {
      const FrameVertex* p = vertex(v);
      if (!p) return std::nullopt;
      middle += to_view(p->w) / static_cast<double>(f.vertices.size());
    }
    return middle;
  }

  void name_face(const FrameFace& f) {
    const std::string name = name_of(f);
    if (const auto at = middle_of(f)) area_label(*at, name, palette_.chosen.mixed(palette_.text), -text_width(name, false) / 2, -12);  // lighter than the face, on which it stands if it can
  }

  /// MPR: the rays from the inner point to the portal's corners, and the one through the origin.
  void portal() {
    if (!frame_.interior || frame_.mpr_status == MprStatus::flat) return;  // no point is inside, then
    const ViewPoint inside = to_view(*frame_.interior);
    picture_.points.push_back({inside, palette_.text, 6, Mark::ring, -1});
    label(inside, "inside", palette_.text, 9, 12);
    const ViewPoint ahead = -inside;
    picture_.lines.push_back({inside, ahead.isZero(0) ? inside : tip_in_view(ViewPoint::Zero(), ahead.stableNormalized() * unit() * 0.8), palette_.text_soft, 1.6, Stroke::dashed, true, true});
    if (frame_.portal.empty()) return;
    shows("portal");
    for (const int v : frame_.portal)
      if (const FrameVertex* p = vertex(v)) picture_.line(inside, to_view(p->w), palette_.chosen.with_alpha(0.5), 1.3);
    face({-1, 0, frame_.portal, {}, 0}, palette_.chosen, 0.4, 2.6);
  }

  /// A ray cast: as the bodies move the origin goes along r = v_B - v_A in the difference of the bodies where they began, and x is how far it surely gets.
  void ray() {
    const auto* query = std::get_if<recorded::SupportQueried>(&recording_.events[frame_.step]);
    const auto at = [&](int i) { return static_cast<std::size_t>(frame_.pair[static_cast<std::size_t>(i)]); };
    if (!query || query->phase != Phase::cast || std::max(at(0), at(1)) >= frame_.places.size()) return;
    const ViewPoint r = to_view(frame_.places[at(1)].velocity) - to_view(frame_.places[at(0)].velocity);
    double clipped = 0;
    for (std::size_t i = frame_.step; i-- > 0 && !std::holds_alternative<recorded::CastBegan>(recording_.events[i]) && !std::holds_alternative<recorded::State>(recording_.events[i]);)
      if (const auto* advanced = std::get_if<recorded::CastAdvanced>(&recording_.events[i])) {
        if (advanced->pair == frame_.pair && advanced->bound > 0) clipped = advanced->time + advanced->distance / advanced->bound;
        break;
      }
    if (r.isZero(0) || !(clipped <= 1)) return;
    shows("ray");
    const ViewPoint tip = tip_in_view(ViewPoint::Zero(), r);  // where the ray goes is what counts
    picture_.lines.push_back({ViewPoint::Zero(), tip, palette_.text_soft, 1.6, Stroke::dashed, true, true});
    picture_.points.push_back({clipped * r, palette_.chosen, 8, Mark::ring, -1});
    label(clipped * r, "x", palette_.chosen, -12, 10);
    label(tip, "r", palette_.text_soft);
  }

  /// The difference of two segments, by the corner and the two edges of the formula.
  void parallelogram() {
    if (!frame_.parallelogram) return;
    shows("parallelogram");
    const ViewPoint corner = to_view(frame_.parallelogram->corner), a = to_view(frame_.parallelogram->edge_a), b = -to_view(frame_.parallelogram->edge_b);
    picture_.faces.push_back({{corner, corner + a, corner + a + b, corner + b}, palette_.simplex.with_alpha(0.18)});
    picture_.line(corner + b, corner + a + b, palette_.body_a.with_alpha(0.6), 1.4);
    picture_.line(corner + a, corner + a + b, palette_.body_b.with_alpha(0.6), 1.4);
    if (!a.isZero(0)) picture_.lines.push_back({corner, corner + a, palette_.body_a, 3, Stroke::solid, true, true}), label(corner + a, "s = 1", palette_.body_a);
    if (!b.isZero(0)) picture_.lines.push_back({corner, corner + b, palette_.body_b, 3, Stroke::solid, true, true}), label(corner + b, "t = 1", palette_.body_b);
    picture_.points.push_back({corner, palette_.text, 4.5, Mark::disc, -1});
    label(corner, "c", palette_.text, 8, -12);
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
    shows("region");
    draw_region(picture_, points, part, 3 * unit(), palette_.simplex, meshes_.dimension);
    ViewPoint middle = ViewPoint::Zero();
    std::string name;
    for (const int i : part) middle += points[static_cast<std::size_t>(i)] / static_cast<double>(part.size());
    for (const int v : frame_.simplex) name += letter_of(v);
    std::sort(name.begin(), name.end());
    spare_label(meshes_.dimension == 1 ? middle : ViewPoint(middle * 0.55), "region " + name, palette_.simplex, 10, 22);
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
          if (const auto given = given_vertex(recording_.events[k]); given && given->vertex == v) {
            picture_.points.push_back({to_view(given->w), palette_.dropped.with_alpha(cuts == 1 ? 0.55 : 0.3), 3.5, Mark::disc, -1});
            break;
          }
      }
    }
  }

  /// Where a ring round the origin can be named: on a diagonal, the first that has room for a word in the view.
  std::optional<ViewPoint> place_on_ring(double radius) const {
    const ViewRectangle& view = projection_.rectangle();
    const double room = 60 * settings_.scale, line = 20 * settings_.scale;  // a title lies at the top
    for (const auto& [x, y] : {std::pair(1, -1), {-1, -1}, {1, 1}, {-1, 1}}) {
      const ViewPoint at = (x * projection_.right() + y * projection_.up()) * (radius * M_SQRT1_2);
      const Projected p = projection_(at);
      if (p.x > view.x + room && p.x < view.x + view.width - room && p.y > view.y + room && p.y < view.y + view.height - line) return at;
    }
    return std::nullopt;
  }

  /// Of a ring that lies outside of the view all but a corner's dash or two would be a stray line.
  bool is_seen(double radius) const {
    int seen = 0;
    for (double turn = 0; turn < 2 * M_PI; turn += M_PI / 32) {
      const Projected p = projection_((std::cos(turn) * projection_.right() + std::sin(turn) * projection_.up()) * radius);
      seen += projection_.rectangle().contains(p.x, p.y);
    }
    return seen >= 8;
  }

  /// The surface of A - B is nowhere nearer than the one ring and somewhere no farther than the other.
  bool bound_rings() {
    if (!settings_.bounds || meshes_.dimension == 1) return false;
    bool drawn = false;
    const auto ring_at = [&](double bound, bool upper, bool named, Colour colour) {
      const double r = std::abs(bound + meshes_.radius);
      if (!std::isfinite(r) || !(r > 1e-3 * unit()) || r > 50 * unit() || !is_seen(r)) return;
      const bool deep = bound + meshes_.radius < 0;  // the distance is at most -1: the depth is at least 1
      if (const auto at = place_on_ring(r); at && named && r > 0.15 * unit()) small_label(*at, std::string(deep ? "depth " : "") + (upper != deep ? "at most" : "at least"), palette_.text_faint, true);
      drawn = true;
      if (flat()) ring(r, ViewPoint::UnitX(), ViewPoint::UnitY(), colour);
      else ring(r, projection_.right(), projection_.up(), colour);
    };
    if (frame_.upper_bound) ring_at(*frame_.upper_bound, true, true, palette_.text_soft.with_alpha(0.5));
    const bool meet = frame_.lower_bound && frame_.upper_bound && std::abs(*frame_.upper_bound - *frame_.lower_bound) < 0.02 * unit();
    if (frame_.lower_bound && frame_.lower_bound != frame_.upper_bound) ring_at(*frame_.lower_bound, false, !meet, palette_.text_faint.with_alpha(0.4));
    return drawn;
  }

  void simplex() {
    std::vector<ViewPoint> points;
    for (const int v : frame_.simplex)
      if (const FrameVertex* p = vertex(v)) points.push_back(to_view(p->w));
    if (!points.empty()) shows("simplex");
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
    const ViewPoint d = arrow_along(*frame_.direction, direction_arrow);
    if (d.isZero(0)) return;
    const ViewPoint tip = tip_in_view(ViewPoint::Zero(), d);
    picture_.arrow(ViewPoint::Zero(), tip, palette_.simplex);
    label(tip, "d", palette_.simplex);
    shows("direction");
    if (settings_.support_plane && frame_.answered) support_plane(d.normalized());
  }

  /// Through the newest vertex, across the direction: all of A - B lies on the origin's side of it.
  void support_plane(const ViewPoint& d) {
    const FrameVertex* newest = frame_.newest ? vertex(*frame_.newest) : nullptr;
    if (!newest) return;
    shows("support plane");
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

  /// The nearest point of the simplex. A frame forgets it when the next support is asked for; at the end of the run it is the answer, and the last cut has it.
  const AnyVector* nearest_point() const {
    if (frame_.closest) return &*frame_.closest;
    if (!frame_.gjk_status || frame_.stage != Frame::Stage::done || frame_.epa_status) return nullptr;
    for (std::size_t i = frame_.step; i-- > 0 && !kind_name(recording_.events[i]).ends_with("_began");)
      if (const auto* e = std::get_if<recorded::SimplexReduced>(&recording_.events[i])) return e->closest.size() > 0 ? &e->closest : nullptr;
    return nullptr;
  }

  void closest() {
    const AnyVector* nearest = nearest_point();
    if (!nearest || !frame_.faces.empty()) return;
    const ViewPoint v = to_view(*nearest);
    if (v.norm() > 1e-6 * unit()) {
      shows("nearest point");
      picture_.lines.push_back({ViewPoint::Zero(), v, palette_.text_soft, 1.6, Stroke::dashed, false, true});
      picture_.points.push_back({v, palette_.text, 6, Mark::ring, -1});
      name_dot(v, "v", palette_.text);
    }
  }

  /// One dot, one label: what lies in the same place is the same point, and "v = A" says so.
  void name_dot(const ViewPoint& at, const std::string& name, Colour colour) {
    for (PictureLabel& other : picture_.labels)
      if (other.dot && (other.at - at).norm() <= 1e-9 * unit()) {
        other.text += " = " + name;
        return;
      }
    label(at, name, colour);
    if (settings_.labels) picture_.labels.back().dot = true;
  }

  /// Those of a polytope, and those that are asked for to begin it, go by their numbers, as long as there is room for them.
  bool numbered() const {
    std::set<int> corners(frame_.seeds.begin(), frame_.seeds.end());
    for (const auto& [number, f] : frame_.faces) corners.insert(f.vertices.begin(), f.vertices.end());
    return !corners.empty() && corners.size() <= 14;
  }

  void vertices() {
    const bool numbers = numbered();
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
      else if (!letter.empty()) name_dot(w, letter, palette_.text);
      else if (newest) name_dot(w, numbers ? "w #" + std::to_string(number) : "w", palette_.newest);
      else if (numbers) small_label(w, "#" + std::to_string(number), palette_.text_faint);
    }
  }
};

}  // namespace

Picture difference_picture(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const ViewSettings& settings, const Palette& palette,
                           const Projection& projection) {
  return DifferencePainter(meshes, recording, frame, settings, palette, projection).paint();
}

}  // namespace gjkdbg
