// The measurements' panel: charts (panel_chart.cpp) and the atlas, in which pointing at a cell tells what it is and clicking opens its worst scene.
#include <algorithm>
#include <cmath>

#include "debugger/view/plot.h"
#include "debugger/view/wrong_step.h"

namespace gjkdbg {
namespace {

// --- Stability ----------------------------------------------------------------------------------------------------------

Colour verdict_colour(int verdict, const Palette& p) {
  static constexpr std::array<std::uint32_t, 8> colours{0x009e73, 0x5fbfa0, 0xf0e442, 0xe69f00, 0xcc79a7, 0xd55e00, 0x9a4600, 0x111111};
  return verdict < 8 ? rgb(colours[static_cast<std::size_t>(verdict)]) : p.field;
}

Colour text_on(int verdict) { return rgb(verdict >= 1 && verdict <= 4 ? 0x141414 : 0xffffff); }

/// One digit and the power of ten, as short as can be: 3e-12, 2e-9.
std::string magnitude(double x) {
  std::string text = formatted(x, "%.0e");
  if (const std::size_t tens = text.size() - 2; text.size() > 3 && text[tens] == '0') text.erase(tens, 1);
  return text;
}

/// The verdict's mark and the size of the error; in a narrow cell smaller, in a narrower one the mark.
void cell_text(const Theme& theme, const MeasuredCell& cell, ImVec2 low, ImVec2 high) {
  const std::string mark = atlas_verdict_marks[static_cast<std::size_t>(cell.verdict)], number = cell.verdict >= 7 || cell.worst_error == 0 ? "" : magnitude(cell.worst_error);
  const float room = high.x - low.x - theme.px(5), smallest = 0.7f;
  const std::string text = smallest * small_width(theme, mark + number) > room + theme.px(5) ? mark : mark + number;
  const float width = small_width(theme, text), size = theme.small->FontSize * std::clamp(room / std::max(width, 1.f), smallest, 1.f);
  const float drawn = width * size / theme.small->FontSize;
  ImGui::GetWindowDrawList()->AddText(theme.small, size, {(low.x + high.x - drawn) / 2, (low.y + high.y - size) / 2}, packed(text_on(cell.verdict)), text.c_str());
}

void tell_cell(App& app, const MeasuredAtlas& atlas, const MeasuredAtlas::Family& family, std::size_t m) {
  const MeasuredCell& cell = family.cells[m];
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(app.theme.px(460));
  ImGui::Text("%s, %s: %s (%s)", family.name.c_str(), atlas.methods[m].c_str(), atlas_verdicts[static_cast<std::size_t>(cell.verdict)], atlas_verdict_meanings[static_cast<std::size_t>(cell.verdict)]);
  const std::string often = cell.scene && !cell.how_often.empty() ? ", " + cell.how_often + " cases fail" : "";
  if (cell.verdict != 8) ImGui::TextColored(vec(app.theme.palette.text_soft), "worst error %.2g at %g%s", cell.worst_error, cell.parameter, often.c_str());
  ImGui::TextUnformatted(cell.why.empty() ? family.what.c_str() : cell.why.c_str());
  if (cell.scene) ImGui::TextColored(vec(app.theme.palette.text_faint), "click: the simplest scene that fails so");
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  if (cell.scene && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    SceneFile scene = *cell.scene;
    scene.scene.description = atlas.methods[m] + ", " + atlas_verdicts[static_cast<std::size_t>(cell.verdict)] + ". " + cell.why;
    open_measured(app, std::move(scene), family.name + ", " + atlas.methods[m]);
  }
}

void atlas_area(App& app, ImVec2 at, ImVec2 size) {
  const MeasuredAtlas& atlas = *app.measured.atlas;
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  ImDrawList* list = ImGui::GetWindowDrawList();
  ImVec2 pen = at;
  for (int v = 0; v < static_cast<int>(atlas_verdicts.size()); ++v) {
    const std::string name = atlas_verdicts[static_cast<std::size_t>(v)];
    const float width = small_width(theme, name) + theme.px(38);
    if (pen.x + width > at.x + size.x) pen = {at.x, pen.y + theme.px(20)};
    const ImVec2 low{pen.x, pen.y + theme.px(1)}, high{pen.x + theme.px(18), pen.y + theme.px(17)};
    verdict_mark(theme, v, low, high);
    small_text(theme, {pen.x + theme.px(23), pen.y + theme.px(2)}, p.text_soft, name);
    if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, {pen.x + width - theme.px(10), high.y})) ImGui::SetTooltip("%s", atlas_verdict_meanings[static_cast<std::size_t>(v)]);
    pen.x += width;
  }
  const std::size_t rows = atlas.methods.size(), columns = atlas.families.size();
  if (rows == 0 || columns == 0) {
    ImGui::SetCursorScreenPos({at.x, pen.y + theme.px(32)});
    return wrapped("This atlas has no families of pairs.", p.text_soft);
  }
  const float label = theme.px(150), top = pen.y + theme.px(52), gap = theme.px(2);
  const float width = std::min(theme.px(90), (size.x - label) / static_cast<float>(columns)), height = std::clamp((at.y + size.y - top) / static_cast<float>(rows), theme.px(18), theme.px(34));
  float free_from = at.x;
  for (std::size_t f = 0; f < columns; ++f) {
    const std::string& name = atlas.families[f].name;
    const ImVec2 low{at.x + label + width * static_cast<float>(f), top - theme.px(22)};
    const bool hovered = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, {low.x + width, top});
    const float left = low.x + (width - small_width(theme, name)) / 2;
    // Where not all have room some are told by pointing at their columns only.
    if (left >= free_from) small_text(theme, {left, low.y + theme.px(2)}, hovered ? p.text : p.text_soft, name), free_from = left + small_width(theme, name) + theme.px(2);
    if (hovered) ImGui::SetTooltip("%s: %s", name.c_str(), atlas.families[f].what.c_str());
  }
  const MeasuredAtlas::Family* pointed = nullptr;
  std::size_t pointed_method = 0;
  for (std::size_t m = 0; m < rows; ++m) {
    const float y = top + height * static_cast<float>(m);
    small_text(theme, {at.x, y + height / 2 - theme.px(7)}, p.text_soft, atlas.methods[m]);
    for (std::size_t f = 0; f < columns; ++f) {
      const MeasuredCell& cell = atlas.families[f].cells[m];
      const ImVec2 low{at.x + label + width * static_cast<float>(f), y}, high{low.x + width - gap, y + height - gap};
      list->AddRectFilled(low, high, packed(verdict_colour(cell.verdict, p)), theme.px(3));
      cell_text(theme, cell, low, high);
      if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high)) {
        pointed = &atlas.families[f], pointed_method = m;
        list->AddRect(low, high, packed(p.text), theme.px(3), 0, theme.px(2));
      }
    }
  }
  ImGui::SetCursorScreenPos({at.x, top + height * static_cast<float>(rows)});
  ImGui::Dummy({1, 1});
  if (pointed) tell_cell(app, atlas, *pointed, pointed_method);
}

}  // namespace

void verdict_mark(const Theme& theme, int verdict, ImVec2 low, ImVec2 high) {
  ImGui::GetWindowDrawList()->AddRectFilled(low, high, packed(verdict_colour(verdict, theme.palette)), theme.px(3));
  const std::string mark = atlas_verdict_marks[static_cast<std::size_t>(verdict)];
  small_text(theme, {(low.x + high.x - small_width(theme, mark)) / 2, (low.y + high.y - theme.small->FontSize) / 2}, text_on(verdict), mark);
}

void open_measured(App& app, SceneFile scene, const std::string& title) {
  try {
    app.session.open_for_a_look(std::move(scene), title);
    const std::vector<Finding>& findings = app.session.findings();
    const std::optional<WrongStep> wrong = findings.empty() ? where_it_goes_wrong(app.session.recording()) : std::nullopt;
    app.session.go_to(wrong ? wrong->step : findings.empty() ? app.session.count() - 1 : findings.front().step);
    if (wrong) app.note(wrong->why);
    app.message.clear(), app.settings.selected.reset();
    app.show_lab = false;
  } catch (const Error& e) {
    app.message = e.line();
  }
}

/// Above a scene that a dot or a cell has opened: to where it stands, and to what was open before.
void way_back(App& app) {
  const std::string* before = app.session.waiting_title();
  if (!before) return;
  ImGui::PushFont(app.theme.small);
  const float room = ImGui::GetContentRegionAvail().x;
  if (ImGui::Button(app.lab_tab == App::LabTab::chart ? "Back to the chart (X)" : "Back to the atlas (X)")) app.show_lab = true;
  const std::string name = shortened(app.theme.small, "Back to " + *before, room - app.theme.px(16));
  const ImVec2 pad = ImGui::GetStyle().FramePadding;
  ImGui::SameLine(0, app.theme.px(6));
  if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(name.c_str()).x + 2 * pad.x) ImGui::NewLine();
  const bool taken = ImGui::Button((name + "##before").c_str());
  ImGui::PopFont();
  if (taken) app.session.take_up_again(), app.settings.selected.reset();
}

namespace {

/// Where there is nothing yet it is what to begin with.
bool measure_button(const Theme& theme, bool there) {
  if (there) return ImGui::Button("Measure again");
  ImGui::PushStyleColor(ImGuiCol_Button, vec(theme.palette.accent));
  ImGui::PushStyleColor(ImGuiCol_Text, vec(rgb(0xffffff)));
  const bool pressed = ImGui::Button("Measure now");
  ImGui::PopStyleColor(2);
  return pressed;
}

}  // namespace

void lab_panel(App& app, const Area& area) {
  const Theme& theme = app.theme;
  if (begin_area("lab", area, true)) {
    const auto below_unless_room = [&](const char* text) {
      if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(text).x + 2 * ImGui::GetStyle().FramePadding.x) ImGui::NewLine();
    };
    for (const auto& [name, value] : {std::pair("Speed against accuracy", App::LabTab::chart), {"Stability where methods fail", App::LabTab::atlas}}) {
      below_unless_room(name);
      if (tab_button(theme, name, app.lab_tab == value)) app.lab_tab = value;
      ImGui::SameLine();
    }
    const bool chart = app.lab_tab == App::LabTab::chart, there = chart ? app.measured.chart.has_value() : app.measured.atlas.has_value();
    below_unless_room("Measure again");
    if (app.measuring) ImGui::TextColored(vec(theme.palette.text_soft), "measuring, some seconds ...");
    else if (measure_button(theme, there)) app.measure_requested = chart ? "chart" : "atlas";
    ImGui::SameLine();
    const std::string* before = app.session.waiting_title();  // what was open before those that dots have opened
    const std::string back = "Back to " + (before ? shortened(theme.text, *before, theme.px(220)) : "the scene");
    const float right = ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(back.c_str()).x - theme.px(18);
    if (right > ImGui::GetCursorPosX()) ImGui::SetCursorPosX(right);
    else below_unless_room(back.c_str());
    if (ImGui::Button(back.c_str())) app.session.take_up_again(), app.show_lab = false;
    if (chart && there) {
      for (const auto& [name, value] : {std::pair("error", App::ChartView::error), {"certified gap", App::ChartView::gap}, {"iterations", App::ChartView::iterations}, {"price of modelling", App::ChartView::price}, {"motion", App::ChartView::motion}}) {
        below_unless_room(name);
        if (tab_button(theme, name, app.chart_view == value)) app.chart_view = value;
        ImGui::SameLine();
      }
      ImGui::NewLine();
    }
    ImGui::Dummy({0, theme.px(2)});
    if (there) wrapped(chart ? told_of(app.chart_view)
                  : "The worst verdict of every family of hard pairs, a row a method; the largest error is a share of the size. Point at a family, a verdict or a cell to read more.",
            theme.palette.text_faint);  // it is explained where there is nothing yet
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x, area.y + area.height - at.y - theme.px(14)};
    if (!there) unmeasured(app, chart, at, size);
    else if (chart) chart_area(app, at, size);
    else atlas_area(app, at, size);
  }
  ImGui::EndChild();
}

}  // namespace gjkdbg
