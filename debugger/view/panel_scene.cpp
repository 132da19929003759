// The left panel: the gallery in lessons, or the open scene with everything that can be edited.
#include <algorithm>
#include <numbers>

#include "debugger/view/app.h"

namespace gjkdbg {

void gallery_panel(App& app) {
  const Theme& theme = app.theme;
  for (const Lesson& lesson : app.gallery().lessons) {
    ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.text));
    const bool holds = std::find(lesson.scenes.begin(), lesson.scenes.end(), app.session.scene().scene.name) != lesson.scenes.end();
    ImGui::SetNextItemOpen(holds, ImGuiCond_Once);
    const bool open = ImGui::TreeNodeEx(lesson.title.c_str(), ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_NoTreePushOnOpen);
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", lesson.text.c_str());
    if (!open) continue;
    ImGui::PushFont(theme.small);
    for (const std::string& name : lesson.scenes) {
      const bool current = app.session.scene().scene.name == name;
      ImGui::PushStyleColor(ImGuiCol_Text, vec(current ? theme.palette.text : theme.palette.text_soft));
      ImGui::SetCursorPosX(ImGui::GetCursorPosX() + theme.px(18));
      if (ImGui::Selectable(name.c_str(), current)) app.open_gallery(name);
      ImGui::PopStyleColor();
    }
    ImGui::PopFont();
  }
}

namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// One labelled row of numbers; true when edited.
bool numbers(const Theme& theme, const char* label, double* values, int count, float speed, const double* low = nullptr) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(vec(theme.palette.text_soft), "%s", label);
  ImGui::SameLine(theme.px(100));
  ImGui::SetNextItemWidth(-1);
  ImGui::PushFont(theme.mono);
  ImGui::PushID(label);
  for (int i = 0; i < count; ++i) values[i] += 0.0;  // no "-0"
  const double high = 1e12;
  const bool edited = ImGui::DragScalarN("##values", ImGuiDataType_Double, values, count, speed, low, low ? &high : nullptr, "%.4g");
  ImGui::PopID();
  ImGui::PopFont();
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
    if (!numbers(theme, "rotation", &angle, 1, 0.5f)) return false;
    pose.rotation = PlaneAngle{angle / degrees};
  } else {
    const Euler* given = std::get_if<Euler>(&pose.rotation);
    Euler euler = given && given->order == "xyz" && given->intrinsic ? *given : to_euler(pose.matrix, "xyz", true);
    for (double& a : euler.angles) a *= degrees;
    if (!numbers(theme, "rotation", euler.angles.data(), 3, 0.5f)) return false;
    for (double& a : euler.angles) a /= degrees;
    pose.rotation = euler;
  }
  pose.matrix = resolve(pose.rotation, dimension).matrix;
  return true;
}

bool body(const Theme& theme, Body& b, int index, int dimension, double size) {
  ImGui::PushID(index);
  const auto speed = static_cast<float>(size * 0.005);
  ImGui::Dummy({0, theme.px(4)});
  ImGui::TextColored(vec(index == 0 ? theme.palette.body_a : theme.palette.body_b), "%s", index == 0 ? "A" : "B");
  ImGui::SameLine();
  const std::string type = type_name(b.shape, dimension);
  ImGui::Text("%s%s%s", type.c_str(), b.name.empty() || b.name == "A" || b.name == "B" ? "" : "  ", b.name == "A" || b.name == "B" ? "" : b.name.c_str());
  bool edited = std::visit(ShapeEditor{theme, dimension, speed}, b.shape.geometry);
  if (b.shape.margin > 0) edited |= numbers(theme, "margin", &b.shape.margin, 1, speed, &zero);
  edited |= numbers(theme, "position", b.pose.position.data(), dimension, speed);
  edited |= rotation(theme, b.pose, dimension);
  ImGui::PopID();
  return edited;
}

template <class Names>
bool choice(const Theme& theme, const char* label, int& value, const Names& names, const std::vector<int>& offered) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(vec(theme.palette.text_soft), "%s", label);
  ImGui::SameLine(theme.px(100));
  ImGui::SetNextItemWidth(-1);
  bool edited = false;
  ImGui::PushID(label);
  if (ImGui::BeginCombo("##choice", std::string(names[static_cast<std::size_t>(value)]).c_str())) {
    for (const int i : offered)
      if (ImGui::Selectable(std::string(names[static_cast<std::size_t>(i)]).c_str(), i == value)) value = i, edited = true;
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return edited;
}

bool method(App& app, SceneFile& next) {
  const Theme& theme = app.theme;
  const Settings& now = app.session.recording().settings;
  section(theme, "METHOD");
  bool edited = false;
  int query = static_cast<int>(next.scene.query), name = static_cast<int>(now.name), scalar = static_cast<int>(now.scalar);
  if (choice(theme, "query", query, query_names, {0, 1, 2, 3})) {
    next.scene.query = static_cast<Query>(query), edited = true;
    if (query != 0 && now.name == MethodName::gjk_boolean) next.method.name = MethodName::gjk;
  }
  if (choice(theme, "method", name, method_names, query == 0 ? std::vector<int>{0, 1, 2} : std::vector<int>{0, 2})) next.method.name = static_cast<MethodName>(name), edited = true;
  int part = static_cast<int>(now.closest_point);
  if (now.name != MethodName::gjk_boolean && choice(theme, "closest point", part, closest_point_names, {0, 1, 2})) next.method.closest_point = static_cast<ClosestPoint>(part), edited = true;
  if (choice(theme, "scalar", scalar, scalar_names, {0, 1})) next.method.scalar = static_cast<Scalar>(scalar), next.method.tolerance.reset(), edited = true;
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(vec(theme.palette.text_soft), "tolerance");
  ImGui::SameLine(theme.px(100));
  ImGui::SetNextItemWidth(-1);
  ImGui::PushFont(theme.mono);
  double tolerance = now.tolerance;
  if (ImGui::InputDouble("##tolerance", &tolerance, 0, 0, "%.3g", ImGuiInputTextFlags_EnterReturnsTrue)) next.method.tolerance = tolerance, edited = true;
  ImGui::PopFont();
  int limit = now.max_iterations;
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(vec(theme.palette.text_soft), "max iterations");
  ImGui::SameLine(theme.px(100));
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputInt("##limit", &limit, 0, 0, ImGuiInputTextFlags_EnterReturnsTrue)) next.method.max_iterations = std::max(1, limit), edited = true;
  return edited;
}

}  // namespace

void scene_panel(App& app) {
  const Theme& theme = app.theme;
  SceneFile next = app.session.scene();
  if (!next.scene.description.empty()) {
    ImGui::PushFont(theme.small);
    ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.text_soft));
    ImGui::TextWrapped("%s", next.scene.description.c_str());
    if (!next.scene.source.empty()) {
      ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.text_faint));
      ImGui::TextWrapped("Source: %s", next.scene.source.c_str());
      ImGui::PopStyleColor();
    }
    ImGui::PopStyleColor();
    ImGui::PopFont();
  }
  const bool was_active = ImGui::IsAnyItemActive();
  bool edited = false;
  const double size = std::max(1e-300, std::min(app.world_camera.radius, 1e12));
  for (int i = 0; i < 2; ++i) edited |= body(theme, next.scene.bodies[static_cast<std::size_t>(i)], i, next.scene.dimension, size);
  edited |= method(app, next);
  if (edited) {
    next.expect.reset();  // of the scene as it was
    app.message = app.session.edit(next);
  }
  // A drag in a field is one edit, from press to release.
  if (!was_active && ImGui::IsAnyItemActive()) app.session.begin_edit();
  if (!ImGui::IsAnyItemActive()) app.session.end_edit();
  section(theme, "SHOW");
  ImGui::Checkbox("Minkowski difference", &app.settings.difference);
  ImGui::Checkbox("support plane", &app.settings.support_plane);
  ImGui::Checkbox("dropped and removed", &app.settings.dropped);
  ImGui::Checkbox("labels", &app.settings.labels);
  ImGui::Checkbox("grid", &app.settings.grid);
}

}  // namespace gjkdbg
