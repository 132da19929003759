// The bar in which a step is looked for: what is typed is found at once. When it has been entered the arrows and the like are the steps' again, while letters
// go on with the text until something else is clicked on.
#include <imgui_internal.h>

#include <algorithm>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"
#include "debugger/view/input.h"

namespace gjkdbg {

void App::open_find_bar() {
  find_.open = find_.wants_focus = find_.in_hand = true;
  find_.to_its_end = false;
  show_lab = false;  // it is steps that are found
  forget_found();
}

void App::forget_found() {
  find_.from = session.step(), find_.opened = session.opened();
  find_.error.clear(), find_.found.reset();
}

/// The next one, or the one before, from the step that is shown.
void App::find_next(bool backwards) {
  find_.error.clear();
  session.playing = false;
  try {
    find_.found = find_text(session, find_.text, session.step(), backwards);
    if (find_.found) session.go_to(*find_.found);
    else if (!find_.open) note("no step has it");
    else if (find_.text[0] != 0) find_.error = "no step has it";
  } catch (const Error& e) {
    (find_.open ? find_.error : message) = e.message();  // a condition that is none
  }
  find_.from = session.step();
}

/// From the step at which the typing began, that step included. A condition that is not finished yet is no mistake.
void App::find_while_typing() {
  find_.error.clear();
  const std::size_t before = (find_.from + session.count() - 1) % session.count();
  try {
    find_.found = find_text(session, find_.text, before, false);
    if (!find_.found && find_.text[0] != 0) find_.error = "no step has it";
  } catch (const Error&) {
    find_.found.reset();
  }
  session.playing = false;
  session.go_to(find_.found.value_or(find_.from));
}

void App::find_keys() {
  const bool next = key_pressed(Key::f3) || (find_.open && key_pressed(Key::enter) && !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
  if (next) find_next(shift_held());
}

/// Letters that come before the field has the keys again, each a shortcut otherwise. A blank plays.
bool App::find_takes_letters() {
  const ImGuiIO& io = ImGui::GetIO();
  if (!find_.open || !find_.in_hand || show_lab || io.KeyCtrl) return false;
  std::string typed;
  for (const ImWchar c : io.InputQueueCharacters)
    if (c > ' ' && c < 127) typed += static_cast<char>(c);
  if (typed.empty()) return false;
  std::string text = find_.text + typed;
  text.resize(std::min(text.size(), sizeof find_.text - 1));
  text.copy(find_.text, text.size()), find_.text[text.size()] = 0;
  ImGui::GetIO().InputQueueCharacters.resize(0);
  find_.wants_focus = find_.to_its_end = true;
  find_while_typing();
  return true;
}

namespace {

/// Behind what is there, which is not selected: it stays when typing goes on. `data.UserData`: whether that is still to be done.
int cursor_to_its_end(ImGuiInputTextCallbackData* data) {
  if (!std::exchange(*static_cast<bool*>(data->UserData), false)) return 0;
  data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
  return 0;
}

/// Closes what it stands in.
bool small_cross(const Theme& theme) {
  const float side = ImGui::GetFrameHeight(), arm = theme.px(5);
  const ImVec2 at = ImGui::GetCursorScreenPos(), middle{at.x + side / 2, at.y + side / 2};
  const bool pressed = ImGui::Button("##close", {side, side});
  for (const float way : {-1.f, 1.f}) ImGui::GetWindowDrawList()->AddLine({middle.x - arm, middle.y - way * arm}, {middle.x + arm, middle.y + way * arm}, packed(theme.palette.text), theme.px(1.5f));
  return pressed;
}

/// The longest of these that fits.
const char* first_that_fits(std::initializer_list<const char*> texts, float room) {
  const auto fits = [&](const char* text) { return ImGui::CalcTextSize(text).x <= room; };
  const auto found = std::find_if(texts.begin(), texts.end(), fits);
  return found == texts.end() ? *(texts.end() - 1) : *found;
}

}  // namespace

/// Above the views, so that what the step is about stays in sight; across the window where they are too narrow for it, or not shown.
void App::find_bar() {
  if (!session.is_open()) find_.open = false;
  if (!find_.open || show_lab) return;
  if (find_.opened != session.opened()) forget_found();
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const bool above_views = views_.width > theme.px(330);
  const float room = above_views ? views_.width - theme.px(12) : window.x - theme.px(20), width = std::min(theme.px(700), room);
  ImGui::SetNextWindowPos({above_views ? views_.x + views_.width / 2 : window.x / 2, theme.px(50)}, ImGuiCond_Always, {0.5f, 0});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(8), theme.px(7)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, vec(theme.palette.panel));
  ImGui::Begin("find", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  const float gap = theme.px(6), pad = 2 * ImGui::GetStyle().FramePadding.x;
  const float buttons = ImGui::CalcTextSize("Next").x + ImGui::CalcTextSize("Previous").x + 2 * pad + ImGui::GetFrameHeight() + 3 * gap;
  if (std::exchange(find_.wants_focus, false)) ImGui::SetKeyboardFocusHere();
  const float field = ImGui::GetContentRegionAvail().x - buttons;
  const char* hint = first_that_fits({"Find a step: a part of its row or sentence, or upper_bound < 1e-3", "A part of a row or sentence, or upper_bound < 1e-3", "Find: text, or upper_bound < 1e-3", "Find a step"}, field - pad);
  ImGui::SetNextItemWidth(field);
  const std::string typed = find_.text;
  const bool entered = ImGui::InputTextWithHint("##find", hint, find_.text, sizeof find_.text, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_CallbackAlways, cursor_to_its_end, &find_.to_its_end);
  if (ImGui::IsItemActive()) find_.in_hand = true;
  else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) find_.in_hand = false;
  const bool left = ImGui::IsItemDeactivated() && key_pressed(Key::escape);
  if (left) typed.copy(find_.text, sizeof find_.text - 1), find_.text[typed.size()] = 0;  // Escape takes back what is typed; F3 goes on with it
  else if (ImGui::IsItemEdited()) find_while_typing();
  if (ImGui::IsItemActive() && key_pressed(Key::f3)) find_next(shift_held());
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) ImGui::SetTooltip("conditions: upper_bound < 1e-3    region.size == 3    status == stalled    any warning    \xE2\x80\xA6 and \xE2\x80\xA6    \xE2\x80\xA6 or \xE2\x80\xA6");
  ImGui::SameLine(0, gap);
  if (ImGui::Button("Next")) find_next(false);
  tip_beside_row(theme, "Enter, F3");
  ImGui::SameLine(0, gap);
  if (ImGui::Button("Previous")) find_next(true);
  tip_beside_row(theme, "Shift-Enter, Shift-F3");
  ImGui::SameLine(0, gap);
  if (small_cross(theme) || left) find_.open = false;
  tip_beside_row(theme, "Close (Escape)");
  if (entered) find_next(shift_held());
  ImGui::PushFont(theme.small);
  if (!find_.error.empty()) {
    ImGui::TextColored(vec(theme.palette.newest), "%s", shortened(theme.small, find_.error, ImGui::GetContentRegionAvail().x).c_str());
    if (ImGui::IsItemHovered()) tooltip(theme, find_.error);
  } else if (find_.found == session.step()) {  // not where one has stepped on from it
    const std::string told = "step " + std::to_string(*find_.found) + ": " + std::string(short_kind(session.recording().events[*find_.found])) + "  " + summary(session.recording(), *find_.found, settings.newest_first);
    ImGui::TextColored(vec(theme.palette.text_soft), "%s", shortened(theme.small, told, ImGui::GetContentRegionAvail().x).c_str());
  }
  ImGui::PopFont();
  ImGui::End();
}

}  // namespace gjkdbg
