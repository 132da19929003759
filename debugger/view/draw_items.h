// Draws a flattened picture with ImGui.
#pragma once

#include "debugger/render/picture.h"
#include "debugger/view/theme.h"

namespace gjkdbg {

/// Pixels, as ImGui takes them.
inline ImVec2 at(const Projected& p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

/// `small_marks`: for thumbnails, points and lines at half their size and no labels.
void draw_items(ImDrawList* draw, const std::vector<FlatItem>& items, const Theme& theme, bool small_marks = false);

}  // namespace gjkdbg
