#include "debugger/view/draw_items.h"

#include <algorithm>
#include <cmath>

namespace gjkdbg {
namespace {

void draw_dashes(ImDrawList* draw, ImVec2 p, ImVec2 q, ImU32 colour, float width, float scale) {
  const float length = std::hypot(q.x - p.x, q.y - p.y), dash = 7 * scale, gap = 5 * scale;
  if (length < 1 || length > 20000) return;
  const ImVec2 u{(q.x - p.x) / length, (q.y - p.y) / length};
  for (float t = 0; t < length; t += dash + gap) {
    const float end = std::min(t + dash, length);
    draw->AddLine({p.x + u.x * t, p.y + u.y * t}, {p.x + u.x * end, p.y + u.y * end}, colour, width);
  }
}

void draw_line(ImDrawList* draw, const FlatItem& item, float scale) {
  const ImVec2 p = at(item.points[0]), q = at(item.points[1]);
  const auto width = static_cast<float>(item.width) * scale;
  if (item.stroke == Stroke::dashed) return draw_dashes(draw, p, q, packed(item.colour), width, scale);
  const float length = std::hypot(q.x - p.x, q.y - p.y);
  if (!item.arrow || length < 2) {
    draw->AddLine(p, q, packed(item.colour), width);
    return;
  }
  const float head = std::min((6 + 2 * static_cast<float>(item.width)) * scale, length * 0.6f), wide = head * 0.42f;
  const ImVec2 u{(q.x - p.x) / length, (q.y - p.y) / length}, neck{q.x - u.x * head, q.y - u.y * head};
  draw->AddLine(p, neck, packed(item.colour), width);
  draw->AddTriangleFilled(q, {neck.x - u.y * wide, neck.y + u.x * wide}, {neck.x + u.y * wide, neck.y - u.x * wide}, packed(item.colour));
}

void draw_point(ImDrawList* draw, const FlatItem& item, const Theme& theme) {
  const ImVec2 p = at(item.points[0]);
  const float scale = theme.scale * theme.marks, r = static_cast<float>(item.width) * scale;
  const ImU32 colour = packed(item.colour), rim = packed(theme.palette.view);
  switch (item.mark) {
    case Mark::disc:
      draw->AddCircleFilled(p, r + 1.5f * scale, rim, 24);
      draw->AddCircleFilled(p, r, colour, 24);
      break;
    case Mark::ring: draw->AddCircle(p, r, colour, 24, 2 * scale); break;
    case Mark::square:
      draw->AddRectFilled({p.x - r, p.y - r}, {p.x + r, p.y + r}, rim);
      draw->AddRectFilled({p.x - r * 0.8f, p.y - r * 0.8f}, {p.x + r * 0.8f, p.y + r * 0.8f}, colour);
      break;
    case Mark::cross:
      draw->AddLine({p.x - r, p.y}, {p.x + r, p.y}, colour, 2 * scale);
      draw->AddLine({p.x, p.y - r}, {p.x, p.y + r}, colour, 2 * scale);
      break;
  }
}

}  // namespace

void draw_items(ImDrawList* draw, const std::vector<FlatItem>& items, const Theme& theme, bool small_marks) {
  std::vector<ImVec2> polygon;
  const auto text_size = [&](const ImFont* font) { return font->FontSize * theme.marks; };
  for (const FlatItem& item : items) {
    switch (item.kind) {
      case FlatItem::Kind::polygon: {
        polygon.clear();
        double area = 0;
        for (std::size_t i = 0; i < item.points.size(); ++i) {
          const Projected &p = item.points[i], &q = item.points[(i + 1) % item.points.size()];
          area += p.x * q.y - q.x * p.y;
          polygon.push_back(at(p));
        }
        if (area < 0) std::reverse(polygon.begin(), polygon.end());  // ImGui's soft rim wants one winding
        const ImDrawListFlags before = draw->Flags;
        draw->Flags &= ~ImDrawListFlags_AntiAliasedFill;  // neighbours share their edges: no soft seams between them
        draw->AddConvexPolyFilled(polygon.data(), static_cast<int>(polygon.size()), packed(item.colour));
        draw->Flags = before;
        break;
      }
      case FlatItem::Kind::line: draw_line(draw, item, theme.scale * theme.marks * (small_marks ? 0.6f : 1)); break;
      case FlatItem::Kind::point:
        if (!small_marks) draw_point(draw, item, theme);
        break;
      case FlatItem::Kind::label: {
        if (small_marks) break;
        const ImVec2 p = at(item.points[0]);
        if (item.small) {
          const float size = text_size(theme.small) * 0.85f;
          draw->AddText(theme.small, size, {p.x + 1, p.y + 1}, packed(theme.palette.view), item.text.c_str());
          draw->AddText(theme.small, size, p, packed(item.colour), item.text.c_str());
          break;
        }
        draw->AddText(theme.text, text_size(theme.text), {p.x + 1, p.y + 1}, packed(theme.palette.view), item.text.c_str());
        draw->AddText(theme.text, text_size(theme.text), p, packed(item.colour), item.text.c_str());
        break;
      }
    }
  }
}

}  // namespace gjkdbg
