#include "debugger/render/painter.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace gjkdbg {

/// 1, 2 or 5 times a power of ten, and at least this many pixels.
double Painter::round_step(double pixels) const {
  const double least = pixels / projection_.pixels_per_length(), power = std::pow(10, std::floor(std::log10(least)));
  for (const double times : {1.0, 2.0, 5.0})
    if (times * power >= least) return times * power;
  return 10 * power;
}

/// Lines at round distances: in the plane of a 2D scene, or on the floor y = 0's level of a 3D one.
void Painter::grid() {
  if (!settings_.grid) return;
  const double step = round_step(44);
  const ViewPoint centre = (projection_.target() / step).array().round() * step;
  const Colour colour = palette_.grid;
  if (meshes_.dimension == 1) {
    const double reach = 40 * step, x = centre[0];
    picture_.line({x - reach, 0, 0}, {x + reach, 0, 0}, palette_.dropped, 1.5);
    for (int i = -40; i <= 40; ++i) picture_.line({x + i * step, -0.03 * unit(), 0}, {x + i * step, 0.03 * unit(), 0}, palette_.dropped, 1.2);
    for (int i = -40; i <= 40; ++i) mark_number({x + i * step, -0.03 * unit(), 0}, x + i * step, step, -4, 8);
    return;
  }
  if (flat()) {
    // Numbers along the axes, or along the edge of the view when they are out of it.
    const double left = projection_.target()[0] - 0.95 * unit(), low = projection_.target()[1] - 0.95 * unit();
    const bool x_axis_seen = std::abs(projection_.target()[1]) < unit(), y_axis_seen = std::abs(projection_.target()[0]) < unit();
    for (int i = -40; i <= 40; ++i) {
      mark_number({centre[0] + i * step, x_axis_seen ? 0 : low, 0}, centre[0] + i * step, step, 3, 2);
      if (std::abs(centre[1] + i * step) > 1e-9 * step) mark_number({y_axis_seen ? 0 : left, centre[1] + i * step, 0}, centre[1] + i * step, step, 3, 2);
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

void Painter::mark_number(const ViewPoint& at, double value, double step, double dx, double dy) {
  if (!settings_.labels) return;
  char text[32];
  const int digits = static_cast<int>(std::clamp(std::ceil(std::log10(std::max(std::abs(value), step) / step)) + 1, 4.0, 17.0));  // so that neighbours differ
  std::snprintf(text, sizeof text, "%.*g", digits, std::abs(value) < 1e-12 * unit() ? 0.0 : value);
  // Cut off at the view's border, -7 would read as 7.
  const Projected p = projection_(at);
  const ViewRectangle& view = projection_.rectangle();
  const double width = 7 * static_cast<double>(std::strlen(text));
  if (p.x + dx < view.x + 2 || p.x + dx + width > view.x + view.width || p.y + dy < view.y || p.y + dy + 12 > view.y + view.height) return;
  picture_.scale_marks.push_back({at, text, palette_.text_faint.with_alpha(0.75), dx, dy, true});
}

void Painter::mesh(const DisplayMesh& m, Colour colour, double opacity, const ViewPoint& offset) {
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

void Painter::label(const ViewPoint& at, const std::string& text, Colour colour, double dx, double dy) {
  if (settings_.labels && !text.empty()) picture_.labels.push_back({at, text, colour, dx, dy});
}

void Painter::area_label(const ViewPoint& at, const std::string& text, Colour colour, double dx, double dy) {
  if (settings_.labels && !text.empty()) picture_.labels.push_back({at, text, colour, dx, dy, false, false, true});
}

void Painter::spare_label(const ViewPoint& at, const std::string& text, Colour colour, double dx, double dy) {
  if (settings_.labels) picture_.labels.push_back({at, text, colour, dx, dy, false, false, false, true});
}

void Painter::small_label(const ViewPoint& at, const std::string& text, Colour colour, bool spare) {
  if (settings_.labels && !text.empty()) picture_.labels.push_back({at, text, colour, 6, -8, true, false, false, spare});
}

const FrameVertex* Painter::vertex(int number) const {
  const auto found = frame_.vertices.find(number);
  return found == frame_.vertices.end() ? nullptr : &found->second;
}

ViewPoint Painter::tip_in_view(const ViewPoint& from, const ViewPoint& along) const {
  const double margin = 16 * settings_.scale;
  const ViewRectangle& view = projection_.rectangle();
  const Projected p = projection_(from), q = projection_(ViewPoint(from + along));
  double share = 1;
  const auto stay = [&](double start, double end, double low, double high) {
    if (end > high && end > start) share = std::min(share, (high - start) / (end - start));
    if (end < low && end < start) share = std::min(share, (start - low) / (start - end));
  };
  stay(p.x, q.x, view.x + margin, view.x + view.width - margin);
  stay(p.y, q.y, view.y + margin, view.y + view.height - margin);
  return from + along * std::clamp(share, view.contains(p.x, p.y) ? 0.2 : 1.0, 1.0);
}

/// A third of the view along a direction, or nothing for a direction that is none.
ViewPoint Painter::arrow_along(const AnyVector& direction, double share) const {
  const ViewPoint d = to_view(direction);
  if (!d.allFinite() || d.isZero(0)) return ViewPoint::Zero();
  return d.stableNormalized() * unit() * share;
}

}  // namespace gjkdbg
