// What the window asks for: a step; a file in file_dialog.cpp, a text to find in find_bar.cpp.
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
  ImGui::GetStyle().Colors[ImGuiCol_ModalWindowDimBg] = vec(theme.palette.background.with_alpha(0.6));  // read when the frame ends
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  const bool shown = ImGui::BeginPopupModal("ask", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar();
  if (!dropped_.empty()) file_dropped(shown);
  if (!shown) return;
  if (asked_ == Asking::go_to) go_to_dialog();
  else file_dialog();
  if (key_pressed(Key::escape)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
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
