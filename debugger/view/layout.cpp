// Where the panels stand, by the room there is.
#include <algorithm>

#include "debugger/view/app.h"

namespace gjkdbg {

/// Too low for all: the views go before the buttons, which have keys, and the list of steps.
bool App::is_low(const Area& window) const { return window.height < theme.px(400); }

/// Of a panel that has room for no more; above it the time of what moves.
float App::scrubber_height() const { return theme.px(session.scene().scene.motion ? 78 : 58); }

void App::panels(const Area& window) {
  rail_open_ = false;  // unless the rail is drawn, and open
  const float gap = theme.px(6), top = theme.px(is_low(window) ? 40 : 48);
  top_bar({0, 0, window.width, top});
  if (!session.is_open()) return;
  const float height = window.height - top - 2 * gap;
  if (show_lab) {
    lab_panel(*this, {gap, top + gap, window.width - 2 * gap, height});
    banner({gap, top + gap, window.width - 2 * gap, height - gap});
    return;
  }
  if (lecture) {
    const float bottom = is_low(window) ? height * 0.52f : std::max(theme.px(190), window.height * 0.27f);
    theme.marks = 1.4f * lecture_scale(window.height);
    views_ = {gap, top + gap, window.width - 2 * gap, height - bottom - gap};
    view_panels(*this, views_, true);
    theme.marks = 1;
    lecture_panel({gap, top + gap + height - bottom, window.width - 2 * gap, bottom});
    banner({views_.x, views_.y, views_.width, views_.height - gap});
    return;
  }
  if (window.width < theme.px(600)) return small_panels(window, top);
  const bool narrow = window.width < theme.px(1180);
  wide_ = !narrow;
  Preferences& p = preferences;
  const float rail = theme.px(44);
  const float left = narrow ? rail : std::min(theme.px(p.left), window.width * 0.35f), right = std::min(theme.px(p.right), narrow ? std::max(window.width * 0.29f, theme.px(232)) : window.width * 0.4f);
  const float lines = window.height / theme.px(900), tall = lines > 1 ? std::min(lines, 1.6f) : std::clamp(window.height / theme.px(650), 0.8f, 1.f);  // a tall window has more steps in its list, a low one fewer
  const bool low = is_low(window);
  const float bottom = low ? scrubber_height() : std::min(theme.px(p.bottom) * tall, window.height * 0.6f);
  const Area middle{left + 2 * gap, top + gap, window.width - left - right - 4 * gap, height - bottom - gap};
  if (narrow) icon_rail({gap, top + gap, left, height});
  else left_panel({gap, top + gap, left, height}), rail_opens_.reset();
  views_ = middle;
  view_panels(*this, middle, true);
  timeline_panel(*this, {middle.x, middle.y + middle.height + gap, middle.width, bottom});
  step_panel(*this, {window.width - right - gap, top + gap, right, height});
  if (!narrow) splitter("##left", {left + gap, top + gap, gap, height}, true, p.left, 200, 460, 1);
  splitter("##right", {window.width - right - 2 * gap, top + gap, gap, height}, true, p.right, 240, 560, -1);
  if (!low) splitter("##bottom", {middle.x, middle.y + middle.height, middle.width, gap}, false, p.bottom, 130, 520, -1 / tall);
  banner({middle.x + gap, middle.y, middle.width - 2 * gap, middle.height - gap});
}

/// One below the other: side by side neither the views nor the step's words have room.
void App::small_panels(const Area& window, float top) {
  wide_ = false;
  const bool low = is_low(window);
  const float gap = theme.px(low ? 4 : 6), rail = theme.px(44), height = window.height - top - 2 * gap;
  const Area middle{rail + 2 * gap, top + gap, window.width - rail - 3 * gap, height};
  // The buttons only where they leave room for the rest: each has its key. The list of steps only in a high window.
  const float strip = scrubber_height() + (low ? 0 : theme.px(height < theme.px(620) ? 60 : 192));
  const float rest = height - strip - 2 * gap, step = low ? std::max(theme.px(48), rest * 0.3f) : rest / 2, above = rest - step;
  icon_rail({gap, top + gap, rail, height});
  views_ = {middle.x, middle.y, middle.width, above};
  view_panels(*this, views_, true);
  timeline_panel(*this, {middle.x, middle.y + above + gap, middle.width, strip});
  step_panel(*this, {middle.x, middle.y + above + strip + 2 * gap, middle.width, step});
  banner({views_.x + gap, views_.y, views_.width - 2 * gap, views_.height - gap});
}

/// The gap between two panels: dragging it moves the border, a double click puts it back.
void App::splitter(const char* name, const Area& area, bool vertical, float& value, float low, float high, float sign) {
  ImGui::SetCursorScreenPos({area.x, area.y});
  ImGui::InvisibleButton(name, {area.width, area.height});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddRectFilled({area.x + (vertical ? area.width / 3 : 0), area.y + (vertical ? 0 : area.height / 3)},
                                              {area.x + area.width * (vertical ? 2.f / 3 : 1), area.y + area.height * (vertical ? 1 : 2.f / 3)}, packed(theme.palette.accent));
  }
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (ImGui::IsItemActive()) value = std::clamp(value + sign * (vertical ? moved.x : moved.y) / theme.scale, low, high);
}

}  // namespace gjkdbg
