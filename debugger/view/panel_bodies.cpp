// The left panel's bodies: their shapes and where they are, for editing; in a motion, how many there are.
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

/// Whether a format leaves the numbers what they are, but for half a hundredth.
bool tells(const char* format, const double* values, int count) {
  return std::all_of(values, values + count, [&](double x) { return std::abs(std::strtod(formatted(x, format).c_str(), nullptr) - x) <= 0.005 * std::abs(x); });
}

/// While one of the row's numbers is held the row keeps its form, or what is below it would jump.
bool keeps_its_form() { return ImGui::GetStateStorage()->GetBool(ImGui::GetID("held")); }
void note_held() { ImGui::GetStateStorage()->SetBool(ImGui::GetID("held"), ImGui::IsItemActive()); }

void tell_digits(const double* values, int count, const char* format) {
  const bool short_of = std::any_of(values, values + count, [&](double x) { return std::strtod(formatted(x, format).c_str(), nullptr) != x; });
  if (!short_of || !ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
  std::string all;
  for (int i = 0; i < count; ++i) all += (i == 0 ? "" : ", ") + all_digits(values[i]);
  ImGui::SetTooltip("%s", all.c_str());
}

/// Of numbers that stand below one another, for each has more digits than fit beside others; true when edited. Each has the name it has in one row, so
/// that what is held stays held.
bool numbers_in_rows(double* values, int count, float speed, const double* low, const double* high, const char* format) {
  bool edited = false;
  ImGui::BeginGroup();
  ImGui::PushID("##values");
  for (int i = 0; i < count; ++i) {
    ImGui::PushID(i);
    ImGui::SetNextItemWidth(-1);
    edited |= ImGui::DragScalar("", ImGuiDataType_Double, &values[i], speed, low, high, format, ImGuiSliderFlags_NoRoundToFormat);
    takes_a_number();
    tell_digits(&values[i], 1, format);
    ImGui::PopID();
  }
  ImGui::PopID();
  ImGui::EndGroup();
  return edited;
}

}  // namespace

bool numbers(const Theme& theme, const char* label, double* values, int count, float speed, const double* low, int digits) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(vec(theme.palette.text_soft), "%s", label);
  ImGui::SameLine(theme.px(label_width));
  ImGui::SetNextItemWidth(-1);
  ImGui::PushFont(theme.mono);
  ImGui::PushID(label);
  for (int i = 0; i < count; ++i) values[i] += 0.0;  // no "-0"
  const double highest = 1e12;
  const double* high = low ? &highest : nullptr;
  const float room = ImGui::GetContentRegionAvail().x;
  const std::string wanted = "%." + std::to_string(digits > 4 ? digits : 6) + "g";
  const char* format = digits > 4 ? wanted.c_str() : format_that_fits(values, count, room);
  bool* kept = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("rows"));
  if (!keeps_its_form()) *kept = digits > 4 ? !fit(format, values, count, room) : !tells(format, values, count);
  const bool rows = *kept;
  bool edited = false;
  if (rows) {
    edited = numbers_in_rows(values, count, speed, low, high, wanted.c_str());
  } else {
    edited = ImGui::DragScalarN("##values", ImGuiDataType_Double, values, count, speed, low, high, format, std::strcmp(format, "%.4g") == 0 ? 0 : ImGuiSliderFlags_NoRoundToFormat);
    takes_a_number();
  }
  note_held();
  ImGui::PopID();
  ImGui::PopFont();
  if (!rows) tell_digits(values, count, format);
  return edited;
}

namespace {

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

bool choose_type(Shape& shape, int dimension, double size, float room) {
  static const std::vector<std::string> types[] = {{"interval", "point"},
                                                   {"box", "circle", "ellipse", "capsule", "triangle", "polygon", "segment", "point"},
                                                   {"box", "sphere", "capsule", "cylinder", "cone", "ellipsoid", "hull", "triangle", "segment", "point"}};
  const std::string now = type_name(shape, dimension);
  bool edited = false;
  ImGui::SetNextItemWidth(room);
  if (!ImGui::BeginCombo("##type", now.c_str(), ImGuiComboFlags_HeightLarge)) return false;
  for (const std::string& type : types[dimension - 1]) {
    if (ImGui::Selectable(type.c_str(), type == now) && type != now) shape = shape_of_type(type, dimension, size), edited = true;
    if (type == now) ImGui::SetItemDefaultFocus();
  }
  ImGui::EndCombo();
  return edited;
}

/// At the end of a body's first line; its index, when pressed, into `removed`.
void remove_button(const Theme& theme, int index, std::optional<int>& removed) {
  ImGui::SameLine(0, theme.px(4));
  if (ImGui::Button("x", {ImGui::GetFrameHeight(), 0})) removed = index;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("remove body %s", body_letter(index).c_str());
}

bool body(const Theme& theme, Body& b, int index, Colour colour, int dimension, double size, int digits, bool removable, std::optional<int>& removed) {
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
  bool edited = choose_type(b.shape, dimension, size, removable ? -ImGui::GetFrameHeight() - theme.px(4) : -1);
  if (removable) remove_button(theme, index, removed);
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

constexpr std::size_t most_bodies = 12;  ///< that the panel shows

}  // namespace

bool all_bodies(App& app, SceneFile& next, double size) {
  const Theme& theme = app.theme;
  std::vector<Body>& bodies = next.scene.bodies;
  const bool removable = next.scene.motion && bodies.size() > (next.scene.query == Query::simulate ? 1 : 2);
  std::optional<int> removed;
  bool edited = false;
  for (int i = 0; i < static_cast<int>(std::min(bodies.size(), most_bodies)); ++i)
    edited |= body(theme, bodies[static_cast<std::size_t>(i)], i, letter_colour(app, i), next.scene.dimension, size, app.place_digits, removable, removed);
  if (bodies.size() > most_bodies) ImGui::TextColored(vec(theme.palette.text_faint), "and %zu more bodies", bodies.size() - most_bodies);
  if (!removed) return edited;
  bodies.erase(bodies.begin() + *removed);
  return true;
}

bool add_body(SceneFile& next) {
  if (next.scene.bodies.size() >= most_bodies || !ImGui::Button("add a body")) return false;
  Body body = next.scene.bodies.back();
  body.name.clear();
  body.pose.position[0] += 2 * std::max(1e-9, reach_of(body.shape, next.scene.dimension));
  next.scene.bodies.push_back(body);
  return true;
}

}  // namespace gjkdbg
