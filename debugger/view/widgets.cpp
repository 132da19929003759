#include "debugger/view/app.h"
#include "debugger/view/explain.h"

namespace gjkdbg {

bool begin_area(const char* name, const Area& area, bool scrolls) {
  ImGui::SetCursorScreenPos({area.x, area.y});
  return ImGui::BeginChild(name, {area.width, area.height}, false,
                           ImGuiWindowFlags_AlwaysUseWindowPadding | (scrolls ? 0 : ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse));
}

void section(const Theme& theme, const char* title) {
  ImGui::Dummy({0, theme.px(4)});
  ImGui::PushFont(theme.small);
  ImGui::TextColored(vec(theme.palette.text_faint), "%s", title);
  ImGui::PopFont();
}

void number_row(const Theme& theme, const char* label, const std::string& value, Colour colour) {
  ImGui::TextColored(vec(theme.palette.text_soft), "%s", label);
  ImGui::PushFont(theme.mono);
  const float width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::SameLine(std::max(ImGui::GetCursorPosX() + theme.px(40), ImGui::GetWindowContentRegionMax().x - width));
  ImGui::TextColored(vec(colour), "%s", value.c_str());
  ImGui::PopFont();
}

void chip(const Theme& theme, const std::string& text, Colour colour) {
  ImGui::PushFont(theme.small);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), at = ImGui::GetCursorScreenPos();
  const ImVec2 end{at.x + size.x + theme.px(22), at.y + size.y + theme.px(10)};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, end, packed(colour.with_alpha(theme.dark ? 0.2 : 0.14)), theme.px(12));
  draw->AddText({at.x + theme.px(11), at.y + theme.px(5)}, packed(theme.dark ? colour.shaded(0.35) : colour.shaded(-0.25)), text.c_str());
  ImGui::Dummy({end.x - at.x, end.y - at.y});
  ImGui::PopFont();
}

Colour event_colour(const Palette& p, const Event& event) {
  struct {
    const Palette& p;
    Colour operator()(const recorded::GjkBegan&) const { return p.text; }
    Colour operator()(const recorded::SupportQueried&) const { return p.support; }
    Colour operator()(const recorded::SimplexReduced&) const { return p.simplex; }
    Colour operator()(const recorded::GjkEnded&) const { return p.text; }
    Colour operator()(const recorded::PolytopeSeeded&) const { return p.frontier; }
    Colour operator()(const recorded::FaceChosen&) const { return p.chosen; }
    Colour operator()(const recorded::PolytopeGrown&) const { return p.frontier; }
    Colour operator()(const recorded::EpaEnded&) const { return p.text; }
    Colour operator()(const recorded::MprBegan&) const { return p.text; }
    Colour operator()(const recorded::PortalFound&) const { return p.chosen; }
    Colour operator()(const recorded::MprEnded&) const { return p.text; }
    Colour operator()(const recorded::SatBegan&) const { return p.text; }
    Colour operator()(const recorded::AxisTested&) const { return p.chosen; }
    Colour operator()(const recorded::SatEnded&) const { return p.text; }
    Colour operator()(const recorded::Warning&) const { return p.newest; }
  } colours{p};
  return std::visit(colours, event);
}

std::string result_text(const Recording& recording) {
  const Result& r = recording.result;
  std::string text = r.intersecting ? "overlapping" : "apart";
  if (r.signed_distance) {
    const double d = *r.signed_distance;
    text = d > 0 ? "apart, distance " + short_number(d) : d == 0 ? "touching" : "overlapping, depth " + short_number(-d);
    if (recording.scene.scene.query == Query::distance && r.intersecting) text = "overlapping";
  }
  return text;
}

}  // namespace gjkdbg
