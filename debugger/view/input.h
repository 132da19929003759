// Keys, by what they mean here. Hides the change of ImGui's input interface in 1.87 (from KeysDown to AddKeyEvent).
#pragma once

#include <vector>

namespace gjkdbg {

enum class Key {
  right, left, period, comma, home, end, space, b, m, left_bracket, right_bracket, f, v, g, t, o, s, z, y, slash, f1, escape, e, l, c, n, q, x, f3, enter, page_up, page_down,
  digit_1, digit_2, digit_3, digit_4, digit_5, digit_6, digit_7, digit_8, digit_9, pad_1, pad_2, pad_3
};
inline constexpr int key_count = static_cast<int>(Key::pad_3) + 1;

/// Pressed since the last frame, repeats included.
bool key_pressed(Key key);

/// A press as the window system tells it (its own code), before the frame that it falls in: before 1.87 ImGui loses one that is let go within
/// the same frame. `forget_presses` after every frame.
void note_press(int code, bool shift, bool control);
void forget_presses();
const std::vector<int>& noted_presses();
/// Held now, or with a press noted since the last frame.
bool shift_held();
bool control_held();

/// For tests and pictures, where no window feeds the keys: presses and lets go. Call `map_keys` once per context where no GLFW does.
void feed_key(Key key, bool down);
void map_keys();
/// Whether the arrows go through the list that is open, and Return takes what they are on: ImGui's own navigation, which nothing else here uses.
void choose_by_keys(bool on);
void choose_now();
/// A comma that is typed into a field for a number is its point: ImGui would drop it, and "3,5" would be 35. The one after every such field, the other between
/// ImGui::NewFrame and the first.
void takes_a_number();
void read_decimal_commas();

}  // namespace gjkdbg
