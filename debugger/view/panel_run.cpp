// The left panel's sections about running: another run beside this one, and where playing stops.
#include <algorithm>

#include "debugger/view/app.h"

namespace gjkdbg {

std::vector<int> possible_methods(const SceneFile& file) {
  std::vector<int> out;
  for (std::size_t i = 0; i < method_names.size(); ++i) {
    Method m = file.method;
    change_name(m, static_cast<MethodName>(i));
    try {
      const bool fastest = m.name == MethodName::fastest && !file.scene.motion;
      if (resolve_settings(m, file.scene).name == *m.name || fastest) out.push_back(static_cast<int>(i));
    } catch (const Error&) {
    }
  }
  return out;
}

/// Another run beside this one: the same scene by another method, or a recording.
void compare_section(App& app) {
  const Theme& theme = app.theme;
  Session& s = app.session;
  section(theme, "COMPARE WITH");
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##compare", s.comparing() ? s.other_title().c_str() : "nothing")) {
    if (ImGui::Selectable("nothing", !s.comparing())) s.stop_comparing();
    ImGui::SetItemDefaultFocus();
    const Settings& now = s.recording().settings;
    const std::vector<int> possible = possible_methods(s.scene());
    const auto offer = [&](const char* title, auto change) {
      Method method = s.scene().method;
      change(method);
      if (ImGui::Selectable(title)) app.message = s.compare_with(method, title);
      if (ImGui::IsItemHovered()) tooltip(theme, meaning_of_choice(title));
    };
    if (now.scalar == Scalar::double_precision) offer("float", [](Method& m) { m.scalar = Scalar::float_precision, m.tolerance.reset(); });
    else offer("double", [](Method& m) { m.scalar = Scalar::double_precision, m.tolerance.reset(); });
    for (const ClosestPoint part : {ClosestPoint::signed_volumes, ClosestPoint::johnson, ClosestPoint::voronoi})
      if (part != now.closest_point) offer(word_of(part).data(), [&](Method& m) { m.closest_point = part, m.name = MethodName::gjk; });
    for (const MethodName name : {MethodName::gjk, MethodName::gjk_accelerated, MethodName::gjk_boolean, MethodName::mpr, MethodName::sat, MethodName::closed_form, MethodName::projections}) {
      if ((name == now.name && !foreign(s.recording())) || std::find(possible.begin(), possible.end(), static_cast<int>(name)) == possible.end()) continue;
      offer(word_of(name).data(), [&](Method& m) { change_name(m, name); });
    }
    if (ImGui::Selectable("another recording ...")) app.ask(App::Asking::compare);
    ImGui::EndCombo();
  }
  if (!s.comparing()) return;
  ImGui::PushFont(theme.small);
  const auto& parting = s.parting();
  if (parting && parting->event < s.count()) {
    ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.accent));
    if (ImGui::Selectable(("they part at step " + std::to_string(parting->event)).c_str())) s.go_to(parting->event);
    ImGui::PopStyleColor();
  } else {
    wrapped(parting_text(s), theme.palette.text_soft);
  }
  if (ImGui::Button("Swap the two runs")) s.swap_compared(method_text(s.recording()));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("the run beside comes here: its steps can be gone through, to its end");
  ImGui::PopFont();
}

namespace {

/// A click goes there, the cross takes it away.
void breakpoint_rows(App& app) {
  Session& s = app.session;
  std::optional<std::size_t> removed;
  for (const std::size_t step : s.breakpoints) {
    ImGui::PushID(static_cast<int>(step));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + app.theme.px(5), at.y + line / 2 + app.theme.px(1)}, app.theme.px(4), packed(app.theme.palette.newest));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + app.theme.px(16));
    const float cross = app.theme.px(22), room = ImGui::GetContentRegionAvail().x - cross;
    if (ImGui::Selectable(shortened(app.theme.text, "step " + std::to_string(step) + "  " + short_kind(s.recording().events[step]), room).c_str(), step == s.step(), 0, {room, 0})) s.playing = false, s.go_to(step);
    ImGui::SameLine(0, app.theme.px(4));
    if (ImGui::SmallButton("x")) removed = step;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("remove the breakpoint");
    ImGui::PopID();
  }
  if (removed) s.breakpoints.erase(*removed);
}

}  // namespace

/// Where playing stops: a condition, and the breakpoints.
void stop_section(App& app) {
  const Theme& theme = app.theme;
  section(theme, "STOP WHEN");
  char buffer[256] = {};
  app.stop_when_text.copy(buffer, sizeof buffer - 1);
  ImGui::SetNextItemWidth(-1);
  ImGui::PushFont(theme.mono);
  const bool edited = ImGui::InputTextWithHint("##stop", "upper_bound < 1e-3", buffer, sizeof buffer);
  if (edited) {
    app.stop_when_text = buffer;
    app.stop_when_error.clear();
    try {
      app.session.stop_when = Condition(app.stop_when_text);
    } catch (const Error& e) {
      app.stop_when_error = e.message();
    }
  }
  ImGui::PopFont();
  if (ImGui::IsItemHovered() && app.stop_when_error.empty()) ImGui::SetTooltip("kind == polytope_grown    status == stalled    region.size == 3    any warning    … and …    … or …");
  if (!app.stop_when_error.empty()) {
    wrapped(app.stop_when_error, theme.palette.newest);
    if (edited) ImGui::SetScrollHereY(1);  // the field may be the last that has room
  }
  breakpoint_rows(app);
}

}  // namespace gjkdbg
