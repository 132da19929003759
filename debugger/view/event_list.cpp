// The list of a recording's events, with the step that is shown in its middle.
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"

namespace gjkdbg {
namespace {

/// Before a row's number: a disc for a breakpoint, a bookmark's digit.
void row_marks(const App& app, std::size_t step, ImVec2 at) {
  const Theme& theme = app.theme;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float middle = at.y + ImGui::GetTextLineHeight() / 2;
  if (app.session.breakpoints.contains(step)) draw->AddCircleFilled({at.x + theme.px(4), middle}, theme.px(4), packed(theme.palette.newest), 16);
  for (const auto& [digit, marked] : app.session.bookmarks)
    if (marked == step) draw->AddText(theme.small, theme.small->FontSize, {at.x + theme.px(10), middle - theme.small->FontSize / 2}, packed(theme.palette.accent), std::to_string(digit).c_str());
}

/// Where the columns of the list end or begin, by its widest number.
struct ListColumns {
  float digit, number_end, kind, details;
};

void event_row(App& app, int row, const ListColumns& columns) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  const auto step = static_cast<std::size_t>(row);
  const Event& event = s.recording().events[step];
  const std::string number = std::to_string(row), details = summary(s.recording(), step, app.settings.newest_first);
  ImGui::PushID(row);
  const ImVec2 left = ImGui::GetCursorScreenPos();
  const float end = ImGui::GetContentRegionAvail().x;
  if (ImGui::Selectable("##row", s.step() == step)) s.playing = false, s.go_to(step);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s: %s", short_kind(event), details.c_str());  // a row may be cut off
  row_marks(app, step, left);
  ImGui::SameLine(columns.number_end - columns.digit * static_cast<float>(number.size()));
  ImGui::TextColored(vec(theme.palette.text_faint), "%s", number.c_str());
  const ImVec2 at = ImGui::GetItemRectMax();
  const float middle = at.y - ImGui::GetTextLineHeight() / 2, half = theme.px(4);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x + theme.px(8), middle - half}, {at.x + theme.px(16), middle + half}, packed(event_colour(theme.palette, event)), 2);
  ImGui::SameLine(columns.kind);
  ImGui::TextUnformatted(short_kind(event));
  ImGui::SameLine(columns.details);
  ImGui::TextColored(vec(theme.palette.text_soft), "%s", shortened(theme.mono, details, end - columns.details).c_str());
  ImGui::PopID();
}

}  // namespace

void event_list(App& app, float width, float height) {
  const Session& s = app.session;
  const Theme& theme = app.theme;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, vec(theme.palette.panel));
  ImGui::PushFont(theme.mono);
  const float row = ImGui::GetTextLineHeightWithSpacing(), rows = std::max(1.f, std::floor(height / row));  // whole rows only
  static std::size_t shown = 0;
  static float shown_rows = 0;  // a window that has become smaller still shows the step
  if (const bool resized = std::exchange(shown_rows, rows) != rows; shown != s.step() || resized)  // before the list begins, or it would follow a frame late
    ImGui::SetNextWindowScroll({-1, std::max(0.f, std::round(static_cast<float>(s.step()) - rows / 2) * row)});
  shown = s.step();
  ImGui::SetNextWindowContentSize({0, static_cast<float>(s.count()) * row});  // of a scene just opened, too: how far it scrolls
  ImGui::BeginChild("events", {width, rows * row}, false);
  const float digit = ImGui::CalcTextSize("0").x, number_end = theme.px(20) + digit * static_cast<float>(std::to_string(s.count() - 1).size());
  const ListColumns columns{digit, number_end, number_end + theme.px(26), number_end + theme.px(102)};
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(s.count()), row);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) event_row(app, i, columns);
  ImGui::EndChild();
  ImGui::PopFont();
  ImGui::PopStyleColor();
}

}  // namespace gjkdbg
