// In place of a chart or an atlas that is not there yet: what it will show, and how to get it.
#include <algorithm>

#include "debugger/view/plot.h"

namespace gjkdbg {
namespace {

/// Texts below one another.
struct TextColumn {
  const Theme& theme;
  ImVec2 at;
  float width;

  void line(const std::string& text, Colour colour, float indent = 0) {
    ImGui::SetCursorScreenPos({at.x + indent, at.y});
    wrapped(text, colour, width - indent);
    at.y = ImGui::GetItemRectMax().y + theme.px(3);
  }
  void title(const char* text) {
    ImGui::PushFont(theme.title);
    line(text, theme.palette.text);
    ImGui::PopFont();
    at.y += theme.px(3);
  }
  void heading(const char* text) {
    at.y += theme.px(14);
    ImGui::PushFont(theme.small);
    line(text, theme.palette.text_faint);
    ImGui::PopFont();
    at.y += theme.px(3);
  }
  /// What it is called, and beside it what it is.
  void row(const char* name, const char* what, float indent) {
    const float top = at.y;
    line(name, theme.palette.text);
    at.y = top;
    line(what, theme.palette.text_soft, indent);
    at.y += theme.px(2);
  }
};

void way_to_a_full_run(TextColumn& column, const std::string& what) {
  column.heading("MORE OF IT");
  column.line("In a terminal, gjkdbg " + what + " -o " + what + " takes more pairs and longer. Open (Ctrl-O) the " + what + "/" + what + ".json it writes, or drop it on this window.", column.theme.palette.text_soft);
}

/// A plot as there will be one a family of pairs, with what to look for in it.
void sketch(const Theme& theme, ImVec2 at, ImVec2 size) {
  const Palette& p = theme.palette;
  const Plot plot(theme, at, size, "a family of pairs", "an example, not measured", error_axis(), time_axis({100, 9000}));
  ImDrawList* list = ImGui::GetWindowDrawList();
  struct Way {
    const char* name;
    Colour colour;
    std::array<std::pair<double, double>, 4> dots;  ///< error, nanoseconds
  };
  static constexpr auto slow = std::array{std::pair(3e-3, 900.), std::pair(3e-6, 1500.), std::pair(3e-9, 2300.), std::pair(3e-12, 3400.)};
  static constexpr auto fast = std::array{std::pair(1e-4, 180.), std::pair(1e-8, 230.), std::pair(1e-12, 290.), std::pair(1e-16, 370.)};
  for (const Way& way : {Way{"one method", p.body_b, slow}, Way{"a better one", p.body_a, fast}}) {
    for (std::size_t i = 0; i < way.dots.size(); ++i) {
      const ImVec2 here = plot.place(way.dots[i].first, way.dots[i].second);
      if (i > 0) list->AddLine(plot.place(way.dots[i - 1].first, way.dots[i - 1].second), here, packed(way.colour), theme.px(1.4f));
      list->AddCircleFilled(here, theme.px(3.4f), packed(way.colour), 12);
    }
    const ImVec2 first = plot.place(way.dots[0].first, way.dots[0].second);
    small_text(theme, {first.x - small_width(theme, way.name) / 2, first.y + theme.px(6)}, way.colour, way.name);
  }
  list->AddCircle(plot.place(fast[3].first, fast[3].second), theme.px(6), packed(p.text), 18, theme.px(1));
}

void unmeasured_chart(const Theme& theme, ImVec2 at, float width) {
  const bool beside = width > theme.px(660);
  const float picture = beside ? width * 0.46f : width, gap = theme.px(28);
  TextColumn column{theme, at, beside ? width - picture - gap : width};
  column.title("Nothing is measured yet");
  column.line("Measure now, above, times all methods on the same pairs of shapes, at loose and at tight tolerances, and compares their answers with the true ones. It takes some seconds.", theme.palette.text_soft);
  TextColumn right{theme, {at.x + column.width + gap, at.y}, picture};
  TextColumn& caption = beside ? right : column;
  if (!beside) column.at.y += theme.px(8);
  sketch(theme, caption.at, {picture, theme.px(210)});
  caption.at.y += theme.px(216);
  caption.line("A dot is a method at one tolerance. To the right its worst error grows, upwards its time: left and low is good. Ringed: nothing is both faster and more accurate.", theme.palette.text_faint);
  column.heading("FIVE WAYS TO LOOK AT IT");
  const float indent = theme.px(130);
  column.row("error", "time over the worst error, a plot for each family of pairs", indent);
  column.row("certified gap", "time over how near the bounds are that prove the answer", indent);
  column.row("iterations", "how many GJK needs, by distance", indent);
  column.row("price of modelling", "what a mesh costs where a ball would do", indent);
  column.row("motion", "casts by how early they are, integrators by the energy they lose", indent);
  way_to_a_full_run(column, "chart");
  ImGui::SetCursorScreenPos({at.x, std::max(column.at.y, caption.at.y)});
  ImGui::Dummy({1, 1});
}

void unmeasured_atlas(const Theme& theme, ImVec2 at, float width) {
  const bool beside = width > theme.px(660);
  const float gap = theme.px(28), half = beside ? (width - gap) / 2 : width;
  TextColumn column{theme, at, half};
  column.title("Nothing is measured yet");
  column.line("Measure now, above, gives all methods the pairs that are hardest for them: grazing, flat, long and thin, far from the origin, the same body twice. Each answer is judged by the true one. It takes some seconds.", theme.palette.text_soft);
  column.heading("HOW TO READ IT");
  column.line("A table: a row a method, a column a family of pairs. A cell has the worst verdict of the family and the largest error. A click on a cell opens the simplest pair that fails so, at the step where it goes wrong.", theme.palette.text_soft);
  way_to_a_full_run(column, "atlas");
  TextColumn verdicts{theme, beside ? ImVec2{at.x + half + gap, at.y} : column.at, half};
  if (!beside) verdicts.heading("VERDICTS");
  for (int v = 0; v < static_cast<int>(atlas_verdicts.size()); ++v) {
    verdict_mark(theme, v, verdicts.at, {verdicts.at.x + theme.px(18), verdicts.at.y + theme.px(18)});
    verdicts.line(atlas_verdicts[static_cast<std::size_t>(v)], theme.palette.text, theme.px(28));
    ImGui::PushFont(theme.small);
    verdicts.at.y -= theme.px(3);
    verdicts.line(atlas_verdict_meanings[static_cast<std::size_t>(v)], theme.palette.text_soft, theme.px(28));
    ImGui::PopFont();
    verdicts.at.y += theme.px(4);
  }
  ImGui::SetCursorScreenPos({at.x, std::max(column.at.y, verdicts.at.y)});
  ImGui::Dummy({1, 1});
}

}  // namespace

void unmeasured(App& app, bool chart, ImVec2 at, ImVec2 size) {
  const float width = std::min(size.x, app.theme.px(920));
  const ImVec2 corner{at.x + (size.x - width) / 2, at.y + std::clamp(size.y * 0.5f - app.theme.px(230), 0.f, app.theme.px(90))};
  if (chart) unmeasured_chart(app.theme, corner, width);
  else unmeasured_atlas(app.theme, corner, width);
}

}  // namespace gjkdbg
