#include "debugger/view/input.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gjkdbg {
namespace {

#if IMGUI_VERSION_NUM < 18700
// Before 1.87 keys are the backend's own numbers: GLFW's, for every host here.
constexpr std::array<int, key_count> codes{262, 263, 46, 44, 268, 269, 32, 66, 77, 91, 93, 70, 86, 71, 84, 79, 83, 90, 89, 47, 290, 256, 69, 76, 67, 78, 81, 88, 292, 257, 266, 267,
                                           49, 50, 51, 52, 53, 54, 55, 56, 57, 321, 322, 323};
#else
constexpr std::array<ImGuiKey, key_count> codes{ImGuiKey_RightArrow, ImGuiKey_LeftArrow, ImGuiKey_Period, ImGuiKey_Comma, ImGuiKey_Home, ImGuiKey_End, ImGuiKey_Space,
                                                ImGuiKey_B, ImGuiKey_M, ImGuiKey_LeftBracket, ImGuiKey_RightBracket, ImGuiKey_F, ImGuiKey_V, ImGuiKey_G, ImGuiKey_T,
                                                ImGuiKey_O, ImGuiKey_S, ImGuiKey_Z, ImGuiKey_Y, ImGuiKey_Slash, ImGuiKey_F1, ImGuiKey_Escape, ImGuiKey_E, ImGuiKey_L, ImGuiKey_C, ImGuiKey_N, ImGuiKey_Q, ImGuiKey_X, ImGuiKey_F3, ImGuiKey_Enter, ImGuiKey_PageUp, ImGuiKey_PageDown, ImGuiKey_1, ImGuiKey_2,
                                                ImGuiKey_3, ImGuiKey_4, ImGuiKey_5, ImGuiKey_6, ImGuiKey_7, ImGuiKey_8, ImGuiKey_9, ImGuiKey_Keypad1, ImGuiKey_Keypad2, ImGuiKey_Keypad3};
#endif

struct Presses {
  std::vector<int> codes;
  bool shift = false, control = false;
};
Presses& noted() {
  static Presses of_this_frame;
  return of_this_frame;
}

ImGuiID& number_field() {
  static ImGuiID last = 0;
  return last;
}

}  // namespace

bool key_pressed(Key key) {
  const auto code = codes[static_cast<std::size_t>(key)];
  return ImGui::IsKeyPressed(code, true) || std::find(noted().codes.begin(), noted().codes.end(), static_cast<int>(code)) != noted().codes.end();
}

void note_press(int code, bool shift, bool control) {
  noted().codes.push_back(code);
  noted().shift |= shift, noted().control |= control;
}
void forget_presses() { noted() = {}; }
const std::vector<int>& noted_presses() { return noted().codes; }
bool shift_held() { return ImGui::GetIO().KeyShift || noted().shift; }
bool control_held() { return ImGui::GetIO().KeyCtrl || noted().control; }

void feed_key(Key key, bool down) {
#if IMGUI_VERSION_NUM < 18700
  ImGui::GetIO().KeysDown[codes[static_cast<std::size_t>(key)]] = down;
#else
  ImGui::GetIO().AddKeyEvent(codes[static_cast<std::size_t>(key)], down);
#endif
}

void map_keys() {
#if IMGUI_VERSION_NUM < 18700
  ImGuiIO& io = ImGui::GetIO();
  const std::pair<int, int> pairs[] = {{ImGuiKey_Tab, 258}, {ImGuiKey_LeftArrow, 263}, {ImGuiKey_RightArrow, 262}, {ImGuiKey_UpArrow, 265}, {ImGuiKey_DownArrow, 264}, {ImGuiKey_Home, 268}, {ImGuiKey_End, 269},
                                       {ImGuiKey_Backspace, 259}, {ImGuiKey_Enter, 257}, {ImGuiKey_Escape, 256}, {ImGuiKey_Space, 32}};
  for (const auto& [key, code] : pairs) io.KeyMap[key] = code;
#endif
}

void choose_by_keys(bool on) {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  int& flags = context.IO.ConfigFlags;
  if (on == ((flags & ImGuiConfigFlags_NavEnableKeyboard) != 0)) return;
  flags ^= ImGuiConfigFlags_NavEnableKeyboard;
  if (!on) context.NavDisableHighlight = true;  // no frame stays round the list's field
}

void choose_now() {
#if IMGUI_VERSION_NUM < 18700
  ImGuiContext& context = *ImGui::GetCurrentContext();
  if (!context.NavDisableHighlight) context.NavActivateId = context.NavActivateDownId = context.NavActivatePressedId = context.NavId;  // later versions do so themselves
#endif
}

void takes_a_number() {
  if (ImGui::IsItemActive()) number_field() = ImGui::GetCurrentContext()->ActiveId;
}

void read_decimal_commas() {
  const ImGuiID active = ImGui::GetCurrentContext()->ActiveId;
  if (active == 0 || active != number_field()) return;
  for (ImWchar& c : ImGui::GetIO().InputQueueCharacters)
    if (c == ',') c = '.';
}

}  // namespace gjkdbg
