// Fonts, colours and spacing of the window.
#pragma once

#include <imgui.h>

#include "debugger/render/palette.h"

namespace gjkdbg {

struct Theme {
  Palette palette = dark_palette;
  bool dark = true;
  float scale = 1;  ///< of everything
  float marks = 1;  ///< of what the views show, besides
  ImFont* text = nullptr;
  ImFont* small = nullptr;
  ImFont* title = nullptr;
  ImFont* mono = nullptr;
  ImFont* lecture = nullptr;        ///< for a hall: the sentence. Both are loaded twice as large as in a small window, to be crisp in a large one.
  ImFont* lecture_title = nullptr;

  float px(float logical) const { return logical * scale; }
};

/// Loads the fonts into the current ImGui context (Inter and JetBrains Mono where installed, DejaVu for missing signs, else ImGui's own)
/// and sets colours and spacing.
void load_fonts(Theme& theme, float scale);
void apply_colours(Theme& theme, bool dark);

inline ImU32 packed(Colour c) { return IM_COL32(c.r, c.g, c.b, c.a); }
inline ImVec4 vec(Colour c) { return {c.r / 255.f, c.g / 255.f, c.b / 255.f, c.a / 255.f}; }

}  // namespace gjkdbg
