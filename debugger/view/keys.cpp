// What each key does, and the sheet that says so.
#include <imgui_internal.h>

#include <numbers>
#include <string_view>
#include <utility>

#include "debugger/view/app.h"
#include "debugger/view/input.h"
#include "debugger/view/scene_code.h"
#include "recordings/json_writing.h"

#include <nlohmann/json.hpp>

namespace gjkdbg {

void App::step_keys(bool shift, bool control) {
  const bool right = key_pressed(Key::right) || key_pressed(Key::period), left = key_pressed(Key::left) || key_pressed(Key::comma);
  if (!right && !left) return;
  const int direction = right ? 1 : -1;
  session.playing = false;
  if (control) session.step_phase(direction);
  else if (shift) session.step_iteration(direction);
  else session.step_by(direction);
}

void App::control_keys(bool shift) {
  if (key_pressed(Key::z) && session.can_undo() && !show_lab) session.undo(), fit_what_has_left();
  if (key_pressed(Key::y) && session.can_redo() && !show_lab) session.redo(), fit_what_has_left();
  if (key_pressed(Key::o)) ask(Asking::open);
  if (key_pressed(Key::s)) ask(Asking::save);
  if (key_pressed(Key::f)) open_find_bar();
  if (key_pressed(Key::g)) show_lab = false, ask(Asking::go_to);
  if (key_pressed(Key::q)) quit = true;
  if (key_pressed(Key::c)) {
    const SceneFile kept = session.scene_to_keep();
    ImGui::SetClipboardText(shift ? scene_as_cpp(kept).c_str() : (pretty_json(scene_to_json(kept)) + "\n").c_str());
    note(shift ? "the scene is copied as C++" : "the scene is copied as JSON");
  }
}

bool list_is_open() {
  const auto& open = ImGui::GetCurrentContext()->OpenPopupStack;
  return !open.empty() && open.back().Window && std::string_view(open.back().Window->Name).starts_with("##Combo");
}

void App::keys() {
  const ImGuiIO& io = ImGui::GetIO();
  // WantTextInput still holds in the frame after a text field went away with its dialog: keys typed meanwhile are no text.
  if ((io.WantTextInput && ImGui::IsAnyItemActive()) || !session.is_open()) return;
  if (list_open_ || list_is_open()) {  // one that ImGui has closed just now, by Escape, has had that key
    if (list_is_open() && key_pressed(Key::escape)) ImGui::ClosePopupToLevel(ImGui::GetCurrentContext()->OpenPopupStack.Size - 1, true);
    if (list_is_open() && key_pressed(Key::enter)) choose_now();
    return;
  }
  const bool popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  if (rail_open_ && popup && key_pressed(Key::escape)) return ImGui::ClosePopupToLevel(0, true);
  if (find_.open && !show_lab && !popup && key_pressed(Key::escape)) {
    find_.open = false;
    return;
  }
  if (find_takes_letters()) return;
  if (!show_lab) find_keys(), step_keys(shift_held(), control_held());
  if (control_held()) return control_keys(shift_held());
  if (key_pressed(Key::x)) show_lab = !show_lab, session.playing = false;
  else if (show_lab && key_pressed(Key::escape) && !show_keys && !popup) show_lab = false;
  else if (show_lab && key_pressed(Key::e)) show_lab = false, lecture = false;  // which it is turned to below
  else if (show_lab) return window_keys();  // nothing happens to a scene that is not seen
  if (key_pressed(Key::home)) session.playing = false, session.go_to(0);
  if (key_pressed(Key::end)) session.playing = false, session.go_to(session.count() - 1);
  if (key_pressed(Key::space)) session.toggle_play();
  if (key_pressed(Key::b)) session.toggle_breakpoint();
  if (key_pressed(Key::m) && !session.add_bookmark()) note("all nine bookmarks are taken");
  if (key_pressed(Key::left_bracket)) session.loop = true, session.loop_from = session.step();
  if (key_pressed(Key::right_bracket)) session.loop = true, session.loop_to = session.step();
  if (key_pressed(Key::page_down)) open_beside(1);
  if (key_pressed(Key::page_up)) open_beside(-1);
  for (int i = 1; i <= 9; ++i)
    if (key_pressed(static_cast<Key>(static_cast<int>(Key::digit_1) + i - 1)) && session.bookmarks.contains(i)) session.go_to(session.bookmarks[i]);
  view_keys();
}

/// Whatever is shown.
void App::window_keys() {
  if (key_pressed(Key::t)) preferences.dark = !preferences.dark;
  if (key_pressed(Key::slash) || key_pressed(Key::f1)) show_keys = !show_keys;
  if (key_pressed(Key::escape)) show_keys = false, message.clear();
}

void App::view_keys() {
  window_keys();
  if (key_pressed(Key::f)) {
    if (shift_held()) fitted_ = 0;  // and from where they looked at first
    fit_views();
    fitted_ = session.opened();
  }
  if (key_pressed(Key::v)) preferences.layout = static_cast<Layout>((static_cast<int>(preferences.layout) + 1) % 4);
  if (key_pressed(Key::l)) preferences.linked_cameras = !preferences.linked_cameras;
  if (key_pressed(Key::g)) left_tab = left_tab == LeftTab::gallery && (wide_ || rail_open_) ? LeftTab::scene : LeftTab::gallery, rail_opens_ = left_tab;
  if (key_pressed(Key::e)) lecture = !lecture;
  if (key_pressed(Key::escape)) lecture = false, settings.selected.reset();
  const double right_angle = std::numbers::pi / 2;
  const auto look = [&](double yaw, double pitch) {
    for (Camera* c : {&world_camera, &difference_camera}) c->yaw = yaw, c->pitch = pitch;
  };
  if (key_pressed(Key::pad_1)) look(0, 0);
  if (key_pressed(Key::pad_2)) look(right_angle, 0);
  if (key_pressed(Key::pad_3)) look(0, right_angle);
}

namespace {

struct KeyGroup {
  const char* title;
  std::initializer_list<std::pair<const char*, const char*>> rows;
};

/// Keys in their own colour, what they do beside them.
void key_group(const Theme& theme, const KeyGroup& group, float left, float meaning) {
  ImGui::SetCursorPosX(left);
  ImGui::PushFont(theme.small);
  ImGui::TextColored(vec(theme.palette.text_faint), "%s", group.title);
  ImGui::PopFont();
  for (const auto& [key, what] : group.rows) {
    ImGui::SetCursorPosX(left);
    ImGui::TextColored(vec(theme.palette.text), "%s", key);
    ImGui::SameLine(meaning);
    ImGui::TextColored(vec(theme.palette.text_soft), "%s", what);
  }
  ImGui::Dummy({0, theme.px(3)});
}

}  // namespace

/// Two columns; one below the other in a window that is too narrow for them.
void App::key_sheet() {
  if (!show_keys) return;
  static const KeyGroup left[] = {
      {"STEPS", {{"Right  Left   or   .  ,", "on, back an event"}, {"Shift with them", "an iteration"}, {"Ctrl with them", "a phase"}, {"Home  End", "first, last step"}, {"Space", "play, pause"}, {"[  ]", "loop from here, to here"},
                 {"B", "breakpoint here"}, {"M, 1 to 9", "bookmark, go to it"}, {"Ctrl-F, F3, Shift-F3", "find, next, the one before"}, {"Ctrl-G", "go to a step"}}},
      {"MOUSE", {{"drag, right drag, wheel", "orbit, pan, zoom"}, {"point at a name", "what it stands for"}, {"click a vertex", "select it in both views"}, {"click a number", "the step it comes from"}, {"drag a ring A or B", "move the body"}, {"drag its small disc", "turn the body"}}}};
  static const KeyGroup right[] = {
      {"SCENES AND FILES", {{"G", "gallery or scene"}, {"Page Down  Page Up", "next scene, the one before"}, {"Ctrl-O  Ctrl-S", "open, save"}, {"Ctrl-C, Ctrl-Shift-C", "copy the scene: JSON, C++"}, {"Ctrl-Z  Ctrl-Y", "undo, redo"}, {"Ctrl-Q", "quit"}}},
      {"VIEWS", {{"F, double click", "fit the views"}, {"Shift-F", "the views as at first"}, {"1 2 3 on the pad", "front, right, top"}, {"V", "side by side, stacked, one"}, {"L", "link the cameras"}, {"T", "dark or light"}, {"E", "explain in big letters"}, {"X", "charts and atlas"},
                 {"?", "this sheet"}}}};
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const bool two = size.x > theme.px(760);
  const float key = theme.px(166), column = theme.px(372), edge = ImGui::GetStyle().WindowPadding.x;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, vec(theme.palette.panel));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, theme.px(4)});
  ImGui::Begin("Keys and mouse", &show_keys, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  const float top = ImGui::GetCursorPosY();
  for (const KeyGroup& group : left) key_group(theme, group, edge, edge + key);
  if (two) ImGui::SetCursorPosY(top);
  for (const KeyGroup& group : right) key_group(theme, group, two ? edge + column : edge, two ? edge + column + key : edge + key);
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

}  // namespace gjkdbg
