// The left panel: the open scene with everything that can be edited.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>

#include "algo/motion.h"
#include "debugger/view/app.h"
#include "debugger/view/explain.h"
#include "debugger/view/input.h"
#include "debugger/view/plot.h"

namespace gjkdbg {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr float label_width = 96;  ///< logical pixels

bool fit(const char* format, const double* values, int count, float room) {
  const float field = (room - static_cast<float>(count - 1) * ImGui::GetStyle().ItemInnerSpacing.x) / static_cast<float>(count) - ImGui::GetStyle().FramePadding.x;
  return std::all_of(values, values + count, [&](double x) { return ImGui::CalcTextSize(formatted(x, format).c_str()).x <= field; });
}

/// The most digits with which each of the numbers fits into its share of the room; up to five, of which whole numbers need no exponent.
const char* format_that_fits(const double* values, int count, float room) {
  for (const char* format : {"%.4g", "%.5g", "%.3g"})
    if (fit(format, values, count, room)) return format;
  const bool ordinary = std::all_of(values, values + count, [](double x) { return x == 0 || std::abs(x) >= 0.1; });
  for (const char* format : {"%.2f", "%.2g"})  // 1.35 beside -0.5586 keeps its hundredths
    if ((ordinary || format[3] == 'g') && fit(format, values, count, room)) return format;
  return "%.1g";
}

/// Of numbers that stand below one another, for each has more digits than fit beside others; true when edited.
bool numbers_in_rows(const Theme& theme, double* values, int count, float speed, const char* format) {
  bool edited = false;
  for (int i = 0; i < count; ++i) {
    if (i > 0) ImGui::Dummy({0, theme.text->FontSize + 2 * ImGui::GetStyle().FramePadding.y}), ImGui::SameLine(theme.px(label_width));
    ImGui::PushID(i);
    ImGui::SetNextItemWidth(-1);
    edited |= ImGui::DragScalar("##value", ImGuiDataType_Double, &values[i], speed, nullptr, nullptr, format, ImGuiSliderFlags_NoRoundToFormat);
    takes_a_number();
    ImGui::PopID();
  }
  return edited;
}

/// One labelled row of numbers, or where `digits`, if more than usual are wanted, have no room in one, a row each; true when edited.
bool numbers(const Theme& theme, const char* label, double* values, int count, float speed, const double* low = nullptr, int digits = 4) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(vec(theme.palette.text_soft), "%s", label);
  ImGui::SameLine(theme.px(label_width));
  ImGui::SetNextItemWidth(-1);
  ImGui::PushFont(theme.mono);
  ImGui::PushID(label);
  for (int i = 0; i < count; ++i) values[i] += 0.0;  // no "-0"
  const double high = 1e12;
  const std::string wanted = "%." + std::to_string(digits) + "g";
  if (digits > 4 && !fit(wanted.c_str(), values, count, ImGui::GetContentRegionAvail().x)) {
    const bool edited = numbers_in_rows(theme, values, count, speed, wanted.c_str());
    ImGui::PopID();
    ImGui::PopFont();
    return edited;
  }
  const char* format = digits > 4 ? wanted.c_str() : format_that_fits(values, count, ImGui::GetContentRegionAvail().x);
  const bool short_of = std::any_of(values, values + count, [&](double x) { return std::strtod(formatted(x, format).c_str(), nullptr) != x; });
  const bool edited = ImGui::DragScalarN("##values", ImGuiDataType_Double, values, count, speed, low, low ? &high : nullptr, format, std::strcmp(format, "%.4g") == 0 ? 0 : ImGuiSliderFlags_NoRoundToFormat);
  takes_a_number();
  ImGui::PopID();
  ImGui::PopFont();
  if (short_of && ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
    std::string all;
    for (int i = 0; i < count; ++i) all += (i == 0 ? "" : ", ") + all_digits(values[i]);
    ImGui::SetTooltip("%s", all.c_str());
  }
  return edited;
}

const double zero = 0;

struct ShapeEditor {
  const Theme& theme;
  int dimension;
  float speed;

  bool operator()(Sphere& s) const { return numbers(theme, "radius", &s.radius, 1, speed, &zero); }
  bool operator()(Box& b) const {
    if (!b.from_half_extents) {
      const bool low = numbers(theme, "min", b.min.data(), dimension, speed), high = numbers(theme, "max", b.max.data(), dimension, speed);
      return low || high;
    }
    if (!numbers(theme, "half extents", b.max.data(), dimension, speed, &zero)) return false;
    b.min = -b.max;
    return true;
  }
  template <class AlongAxis>
  bool along_axis(AlongAxis& s) const {
    const bool r = numbers(theme, "radius", &s.radius, 1, speed, &zero), h = numbers(theme, "half height", &s.half_height, 1, speed, &zero);
    return r || h;
  }
  bool operator()(Capsule& s) const { return along_axis(s); }
  bool operator()(Cylinder& s) const { return along_axis(s); }
  bool operator()(Cone& s) const { return along_axis(s); }
  bool operator()(Ellipsoid& e) const { return numbers(theme, "radii", e.radii.data(), dimension, speed, &zero); }
  bool operator()(PointSet& set) const {
    bool edited = false;
    const std::size_t shown = std::min<std::size_t>(set.points.size(), 8);
    for (std::size_t i = 0; i < shown; ++i) edited |= numbers(theme, ("point " + std::to_string(i)).c_str(), set.points[i].data(), dimension, speed);
    if (shown < set.points.size()) ImGui::TextColored(vec(theme.palette.text_faint), "and %zu more points", set.points.size() - shown);
    return edited;
  }
  bool operator()(Mesh& m) const {
    ImGui::TextColored(vec(theme.palette.text_faint), "%zu triangles", m.triangles.size());
    return false;
  }
  bool operator()(Sum&) const {
    ImGui::TextColored(vec(theme.palette.text_faint), "Minkowski sum of two shapes");
    return false;
  }
};

bool rotation(const Theme& theme, Pose& pose, int dimension) {
  if (dimension == 1) return false;
  if (dimension == 2) {
    double angle = to_plane_angle(pose.matrix).angle * degrees;
    if (!numbers(theme, "rotation \xC2\xB0", &angle, 1, 0.5f)) return false;
    pose.rotation = PlaneAngle{angle / degrees};
  } else {
    const Euler* given = std::get_if<Euler>(&pose.rotation);
    Euler euler = given && given->order == "xyz" && given->intrinsic ? *given : to_euler(pose.matrix, "xyz", true);
    for (double& a : euler.angles) a *= degrees;
    if (!numbers(theme, "rotation \xC2\xB0", euler.angles.data(), 3, 0.5f)) return false;
    for (double& a : euler.angles) a /= degrees;
    pose.rotation = euler;
  }
  pose.matrix = resolve(pose.rotation, dimension).matrix;
  return true;
}

/// A shape of another type and about the same size.
Shape shape_of_type(const std::string& type, int dimension, double size) {
  const auto corner = [&](double x, double y, double z) {
    AnyVector p(dimension);
    const double all[] = {x, y, z};
    for (int i = 0; i < dimension; ++i) p[i] = all[i] * size;
    return p;
  };
  const AnyVector half = corner(0.5, 0.5, 0.5);
  if (type == "sphere" || type == "circle") return {Sphere{size / 2}, 0};
  if (type == "box" || type == "interval") return {Box{-half, half, type == "box"}, 0};
  if (type == "capsule") return {Capsule{size / 4, size / 3, 1}, 0};
  if (type == "cylinder") return {Cylinder{size / 3, size / 2, 1}, 0};
  if (type == "cone") return {Cone{size / 2, size / 2, 1}, 0};
  if (type == "ellipsoid" || type == "ellipse") return {Ellipsoid{corner(0.6, 0.4, 0.3)}, 0};
  if (type == "point") return {PointSet{PointSetKind::point, {corner(0, 0, 0)}, {}}, 0};
  if (type == "segment") return {PointSet{PointSetKind::segment, {corner(-0.5, 0, 0), corner(0.5, 0, 0)}, {}}, 0};
  if (type == "triangle") return {PointSet{PointSetKind::triangle, {corner(-0.5, -0.4, 0), corner(0.5, -0.4, 0), corner(0, 0.5, 0)}, {}}, 0};
  if (type == "polygon") return {PointSet{PointSetKind::polygon, {corner(-0.5, -0.2, 0), corner(0, -0.5, 0), corner(0.5, -0.2, 0), corner(0.3, 0.4, 0), corner(-0.3, 0.4, 0)}, {}}, 0};
  return {PointSet{PointSetKind::hull, {corner(-0.5, -0.3, -0.3), corner(0.5, -0.3, -0.3), corner(0, -0.3, 0.5), corner(0, 0.5, 0)}, {}}, 0};
}

bool choose_type(Shape& shape, int dimension, double size) {
  static const std::vector<std::string> types[] = {{"interval", "point"},
                                                   {"box", "circle", "ellipse", "capsule", "triangle", "polygon", "segment", "point"},
                                                   {"box", "sphere", "capsule", "cylinder", "cone", "ellipsoid", "hull", "triangle", "segment", "point"}};
  const std::string now = type_name(shape, dimension);
  bool edited = false;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##type", now.c_str())) return false;
  for (const std::string& type : types[dimension - 1])
    if (ImGui::Selectable(type.c_str(), type == now) && type != now) shape = shape_of_type(type, dimension, size), edited = true;
  ImGui::EndCombo();
  return edited;
}

bool body(const Theme& theme, Body& b, int index, Colour colour, int dimension, double size, int digits) {
  ImGui::PushID(index);
  const auto speed = static_cast<float>(size * 0.005);
  ImGui::Dummy({0, theme.px(4)});
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(vec(colour), "%s", body_letter(index).c_str());
  if (!b.name.empty() && b.name != body_letter(index)) {
    ImGui::SameLine();
    ImGui::TextColored(vec(theme.palette.text_soft), "%s", shortened(theme.text, b.name, theme.px(label_width - 4) - ImGui::GetCursorPosX()).c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", b.name.c_str());
  }
  ImGui::SameLine(theme.px(label_width));
  bool edited = choose_type(b.shape, dimension, size);
  edited |= std::visit(ShapeEditor{theme, dimension, speed}, b.shape.geometry);
  edited |= numbers(theme, "margin", &b.shape.margin, 1, speed, &zero);
  edited |= numbers(theme, "position", b.pose.position.data(), dimension, speed, nullptr, digits);
  edited |= rotation(theme, b.pose, dimension);
  if (b.motion) {
    edited |= numbers(theme, "velocity", b.motion->velocity.data(), dimension, speed);
    if (b.motion->angular_velocity.size() > 0) {
      AnyVector turn = b.motion->angular_velocity * degrees;
      if (numbers(theme, "turns by \xC2\xB0", turn.data(), static_cast<int>(turn.size()), 1)) b.motion->angular_velocity = turn / degrees, edited = true;
    }
  }
  ImGui::PopID();
  return edited;
}

/// Pointing at it tells what the setting does.
void setting_label(const Theme& theme, const char* label, const char* meaning) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(vec(theme.palette.text_soft), "%s", label);
  if (ImGui::IsItemHovered()) tooltip(theme, meaning);
}

template <class Names>
bool choice(const Theme& theme, const char* label, int& value, const Names& names, const std::vector<int>& offered, const char* meaning) {
  setting_label(theme, label, meaning);
  ImGui::SameLine(theme.px(label_width));
  ImGui::SetNextItemWidth(-1);
  bool edited = false;
  ImGui::PushID(label);
  const std::string now(names[static_cast<std::size_t>(value)]);
  const float room = ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - 2 * ImGui::GetStyle().FramePadding.x;
  const bool open = ImGui::BeginCombo("##choice", shortened(theme.text, now, room).c_str());
  if (!open && ImGui::IsItemHovered()) tooltip(theme, (ImGui::CalcTextSize(now.c_str()).x > room ? now + "\n" : "") + meaning);
  if (open) {
    for (const int i : offered)
      if (ImGui::Selectable(std::string(names[static_cast<std::size_t>(i)]).c_str(), i == value)) value = i, edited = true;
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return edited;
}

/// Where GJK begins, and the direction where one is given.
bool start(const Theme& theme, const Settings& now, SceneFile& next) {
  const bool gjk = now.name == MethodName::gjk || now.name == MethodName::gjk_accelerated;
  int value = static_cast<int>(now.start);
  bool edited = false;
  if (choice(theme, "start", value, start_names, gjk ? std::vector<int>{0, 1, 2} : std::vector<int>{0, 1}, "Where the search begins: from one body's centre towards the other's, along a direction of yours, or from the simplex the last run ended with.")) {
    next.method.start = static_cast<Start>(value), edited = true;
    next.method.initial_simplex.clear(), next.method.initial_direction.reset();
    if (next.method.start == Start::given) next.method.initial_direction = AnyVector(AnyVector::Unit(next.scene.dimension, 0));
  }
  if (now.start != Start::given || !next.method.initial_direction) return edited;
  AnyVector direction = *next.method.initial_direction;
  if (numbers(theme, "direction", direction.data(), next.scene.dimension, 0.01f) && !direction.isZero(0)) next.method.initial_direction = direction, edited = true;
  return edited;
}

/// What GJK and EPA are told.
bool gjk_settings(const Theme& theme, const Settings& now, SceneFile& next) {
  int part = static_cast<int>(now.closest_point);
  if (now.name == MethodName::gjk_boolean || now.name == MethodName::closed_form) return false;
  bool edited = false;
  if (choice(theme, "closest point", part, closest_point_names, {0, 1, 2}, "How GJK finds the simplex's point nearest the origin: by signed volumes, by Johnson's determinants, or by going through the Voronoi regions of its parts.")) next.method.closest_point = static_cast<ClosestPoint>(part), edited = true;
  if (start(theme, now, next)) edited = true;
  int directions = static_cast<int>(now.acceleration), rule = static_cast<int>(now.stopping), deep = static_cast<int>(now.penetration);
  if (now.name == MethodName::gjk_accelerated && choice(theme, "directions", directions, acceleration_names, {0, 1, 2, 3}, "What replaces the direction -v: a momentum (Nesterov's or Polyak's), Newton's step by the curvature of the bodies, or a mean with the best plane's direction (smoothed), which is for polytopes.")) next.method.acceleration = static_cast<Acceleration>(directions), edited = true;
  if (choice(theme, "stopping", rule, stopping_names, {0, 1, 2, 3, 4}, "When GJK is done: when the bounds of the distance meet (ours), or by the rule of another implementation, which may stop early.")) next.method.stopping = static_cast<Stopping>(rule), edited = true;
  if ((next.scene.query == Query::penetration || next.scene.query == Query::contact) && choice(theme, "when deep", deep, penetration_names, {0, 1, 2}, "What measures the depth of an overlap: EPA, the shortest way out; MPR, a way out in one direction; or nothing.")) next.method.penetration = static_cast<Penetration>(deep), edited = true;
  return edited;
}

/// Where a run ends.
bool limits(const Theme& theme, const Settings& now, SceneFile& next) {
  bool edited = false;
  setting_label(theme, "tolerance", "How far apart the bounds may be at the end, as a share of the distance or depth.");
  ImGui::SameLine(theme.px(label_width));
  ImGui::SetNextItemWidth(-1);
  ImGui::PushFont(theme.mono);
  double tolerance = now.tolerance;
  if (ImGui::InputDouble("##tolerance", &tolerance, 0, 0, "%.3g", ImGuiInputTextFlags_EnterReturnsTrue)) next.method.tolerance = tolerance, edited = true;
  takes_a_number();
  ImGui::PopFont();
  int limit = now.max_iterations;
  setting_label(theme, "max iterations", "Where each of GJK, EPA and the others gives up, and says so.");
  ImGui::SameLine(theme.px(label_width));
  ImGui::SetNextItemWidth(-1);
  ImGui::PushFont(theme.mono);
  if (ImGui::InputInt("##limit", &limit, 0, 0, ImGuiInputTextFlags_EnterReturnsTrue)) next.method.max_iterations = limit, edited = true;
  ImGui::PopFont();
  return edited;
}

bool method(App& app, SceneFile& next) {
  const Theme& theme = app.theme;
  const Settings& now = app.session.recording().settings;
  static constexpr const char* query_meaning = "The least the scene needs: yes or no, how far apart, how deep as well, or the contact points too. Nothing beyond it is computed.";
  section(theme, "METHOD");
  if (foreign(app.session.recording())) {
    ImGui::PushFont(theme.small);
    wrapped("This run is your solver's. A change here or to a body solves the scene by one of gjkdbg's own methods; Ctrl-Z brings your run back.", theme.palette.text_faint);
    ImGui::PopFont();
  }
  bool edited = false;
  int query = static_cast<int>(next.scene.query), scalar = static_cast<int>(now.scalar);
  int name = static_cast<int>(next.method.name == MethodName::fastest ? MethodName::fastest : now.name);
  if ((next.scene.motion ? choice(theme, "query", query, query_names, {query}, query_meaning) : choice(theme, "query", query, query_names, {0, 1, 2, 3}, query_meaning))) {
    next.scene.query = static_cast<Query>(query), edited = true;
    if (query != 0 && now.name == MethodName::gjk_boolean) next.method.name = MethodName::gjk;
  }
  if (choice(theme, "method", name, method_names, possible_methods(next), "The algorithm: those that take these bodies and answer this query.")) change_name(next.method, static_cast<MethodName>(name)), edited = true;
  const bool takes_over = now.name == MethodName::mpr || now.name == MethodName::sat || now.name == MethodName::projections;
  if (!takes_over) edited |= gjk_settings(theme, now, next);
  if (choice(theme, "scalar", scalar, scalar_names, {0, 1}, "What is counted in: double has 16 digits, float 7.")) next.method.scalar = static_cast<Scalar>(scalar), next.method.tolerance.reset(), edited = true;
  if (now.name != MethodName::closed_form) edited |= limits(theme, now, next);  // a formula neither converges nor iterates
  if (!takes_over) return edited;
  ImGui::PushFont(theme.small);
  wrapped("Where GJK and EPA take over from it:", theme.palette.text_faint);
  ImGui::PopFont();
  return gjk_settings(theme, now, next) || edited;
}

/// Moving scenes take any number of bodies.
bool add_body(SceneFile& next) {
  if (next.scene.bodies.size() >= 12 || !ImGui::Button("add a body")) return false;
  Body body = next.scene.bodies.back();
  body.name.clear();
  body.pose.position[0] += 2 * std::max(1e-9, reach_of(body.shape, next.scene.dimension));
  next.scene.bodies.push_back(body);
  return true;
}

}  // namespace

void scene_panel(App& app) {
  const Theme& theme = app.theme;
  SceneFile next = app.session.scene();
  if (!next.scene.description.empty()) {
    ImGui::PushFont(theme.small);
    wrapped(next.scene.description, app.session.can_undo() ? theme.palette.text_faint : theme.palette.text_soft);
    // On a line that is there before, too: what is edited stays where it is.
    const std::string source = next.scene.source.empty() ? "" : "Source: " + next.scene.source;
    wrapped(source + (!app.session.can_undo() ? " " : source.empty() ? "As it was: edited since." : ", edited since"), theme.palette.text_faint);
    ImGui::PopFont();
  }
  const bool was_active = ImGui::IsAnyItemActive();
  if (!was_active) app.place_digits = digits_of_places(next.scene);  // while one is dragged its field stays where it is
  bool edited = false;
  const double size = std::max(1e-300, std::min(app.world_camera.radius, 1e12));
  const int bodies = static_cast<int>(std::min<std::size_t>(next.scene.bodies.size(), 12));
  for (int i = 0; i < bodies; ++i) edited |= body(theme, next.scene.bodies[static_cast<std::size_t>(i)], i, letter_colour(app, i), next.scene.dimension, size, app.place_digits);
  if (next.scene.motion) edited |= add_body(next);
  edited |= method(app, next);
  if (edited) {
    next.expect.reset();  // of the scene as it was
    app.edit(next);
    app.fit_what_has_left();
  }
  // A drag in a field is one edit, from press to release.
  if (!was_active && ImGui::IsAnyItemActive()) app.session.begin_edit();
  if (!ImGui::IsAnyItemActive()) app.session.end_edit();
  compare_section(app);
  stop_section(app);
  section(theme, "SHOW");
  Preferences& p = app.preferences;
  ImGui::Checkbox("Minkowski difference", &p.difference);
  ImGui::Checkbox("support plane", &p.support_plane);
  ImGui::Checkbox("region of the kept part", &p.regions);
  ImGui::Checkbox("bounds as rings", &p.bounds);
  ImGui::Checkbox("dropped and removed", &p.dropped);
  ImGui::Checkbox("labels", &p.labels);
  ImGui::Checkbox("A is the newest vertex", &p.newest_first);
  ImGui::Checkbox("grid", &p.grid);
  ImGui::Checkbox("cameras linked", &p.linked_cameras);
}

}  // namespace gjkdbg
