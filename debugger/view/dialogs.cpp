// What the window asks for: a text to find, a step; a file in file_dialog.cpp.
#include <algorithm>
#include <cstring>
#include <utility>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"
#include "debugger/view/input.h"

namespace gjkdbg {

void App::dialogs() {
  if (asking_ != Asking::nothing) {
    asked_ = std::exchange(asking_, Asking::nothing);
    ImGui::OpenPopup("ask");
    find_error_.clear(), found_.reset();
    file_error_.clear(), replacing_.clear(), listed_for_.reset(), saving_ = false;
    go_to_ = session.is_open() ? static_cast<int>(session.step()) : 0;
    const std::string suggestion = asked_ == Asking::save ? session.title() + ".scene.json" : "";
    if (asked_ == Asking::save || asked_ == Asking::open || asked_ == Asking::compare) {
      std::memset(file_buffer_, 0, sizeof file_buffer_);
      std::strncpy(file_buffer_, suggestion.c_str(), sizeof file_buffer_ - 1);
    }
  }
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize({std::min(theme.px(560), window.x - theme.px(20)), 0});
  const bool find = asked_ == Asking::find;  // what is found is seen in the list, the sentence and the views: over these's titles, and nothing is dimmed
  if (find) ImGui::SetNextWindowPos({window.x / 2, theme.px(6)}, ImGuiCond_Always, {0.5f, 0});
  ImGui::GetStyle().Colors[ImGuiCol_ModalWindowDimBg] = vec(theme.palette.background.with_alpha(find ? 0 : 0.6));  // read when the frame ends
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  const bool shown = ImGui::BeginPopupModal("ask", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar();
  if (!shown) return;
  if (asked_ == Asking::find) find_dialog();
  else if (asked_ == Asking::go_to) go_to_dialog();
  else file_dialog();
  if (key_pressed(Key::escape)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void App::find_dialog() {
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputTextWithHint("##find", "Find a step: a part of its row or sentence, or upper_bound < 1e-3", find_buffer_, sizeof find_buffer_, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("conditions: upper_bound < 1e-3    region.size == 3    status == stalled    any warning    … and …    … or …");
  if (entered) ImGui::SetKeyboardFocusHere(-1);
  const bool next = ImGui::Button("Next (F3)") || entered;
  ImGui::SameLine();
  const bool previous = ImGui::Button("Previous (Shift-F3)");
  ImGui::SameLine();
  if (ImGui::Button("Close")) ImGui::CloseCurrentPopup();
  if (next || previous) {
    find_error_.clear();
    try {
      found_ = find_text(session, find_buffer_, session.step(), previous);
      if (found_) session.go_to(*found_);
      else find_error_ = "no step has it";
    } catch (const Error& e) {
      find_error_ = e.message();
    }
  }
  if (!find_error_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.newest));
    ImGui::TextWrapped("%s", find_error_.c_str());
    ImGui::PopStyleColor();
  } else if (found_) {
    const std::string told = "step " + std::to_string(*found_) + ": " + summary(session.recording(), *found_, settings.newest_first);
    ImGui::SameLine(0, theme.px(12));
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(vec(theme.palette.text_faint), "%s", shortened(theme.text, told, ImGui::GetContentRegionAvail().x).c_str());
    if (ImGui::IsItemHovered()) tooltip(theme, told);
  }
}

void App::go_to_dialog() {
  ImGui::Text("Go to a step, 0 to %zu", session.count() - 1);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputInt("##step", &go_to_, 0, 0, ImGuiInputTextFlags_EnterReturnsTrue);
  takes_a_number();
  if (ImGui::Button("Go") || entered) {
    session.playing = false;
    session.go_to(static_cast<std::size_t>(std::clamp<long>(go_to_, 0, static_cast<long>(session.count()) - 1)));
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
}

}  // namespace gjkdbg
