// Draws a flattened picture with ImGui.
#pragma once

#include <limits>

#include "debugger/render/picture.h"
#include "debugger/view/theme.h"

namespace gjkdbg {

/// Pixels, as ImGui takes them.
inline ImVec2 at(const Projected& p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

/// Where a label's text stands, below and right of its item's point.
inline ImVec2 label_size(const FlatItem& item, const Theme& theme) {
  const ImFont* font = item.small ? theme.small : theme.text;
  return font->CalcTextSizeA(font->FontSize * theme.marks * (item.small ? 0.85f : 1), std::numeric_limits<float>::max(), 0, item.text.c_str());
}

/// `small_marks`: for thumbnails, points and lines at half their size and no labels.
void draw_items(ImDrawList* draw, const std::vector<FlatItem>& items, const Theme& theme, bool small_marks = false);

}  // namespace gjkdbg
