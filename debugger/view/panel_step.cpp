// The right panel: what the step means, the simplex with its weights, the bounds, the algorithm's lines, the selected vertex.
#include <algorithm>
#include <cmath>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"
#include "debugger/view/right_step.h"

namespace gjkdbg {
namespace {

void heading(App& app) {
  Session& session = app.session;
  const Theme& theme = app.theme;
  const Explanation e = explain(session.recording(), session.frame());
  ImGui::PushFont(theme.small);
  const char* phase = phase_of(session.recording().events[session.step()]) == 0 ? "GJK" : "EPA";
  ImGui::TextColored(vec(theme.palette.text_faint), "Step %zu of %zu  \xC2\xB7  %s iteration %d", session.step(), session.count() - 1, phase, session.frame().iteration);
  ImGui::PopFont();
  ImGui::PushFont(theme.title);
  ImGui::TextWrapped("%s", e.title.c_str());
  ImGui::PopFont();
  ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.text_soft));
  ImGui::TextWrapped("%s", e.text.c_str());
  ImGui::PopStyleColor();
}

/// A bar per vertex of the simplex: its share in the nearest point.
void weights(App& app) {
  const Frame& frame = app.session.frame();
  const Theme& theme = app.theme;
  if (frame.simplex.empty() && frame.dropped.empty()) return;
  section(theme, frame.barycentric.empty() ? "SIMPLEX" : "SIMPLEX, BARYCENTRIC WEIGHTS");
  const float left = ImGui::GetCursorScreenPos().x, width = ImGui::GetContentRegionAvail().x, row = ImGui::GetTextLineHeight() + theme.px(4);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < frame.simplex.size(); ++i) {
    const float y = ImGui::GetCursorScreenPos().y;
    const bool newest = frame.newest == frame.simplex[i];
    ImGui::TextColored(vec(newest ? theme.palette.newest : theme.palette.simplex), "%c", static_cast<char>('A' + i));
    ImGui::SameLine(theme.px(34));
    ImGui::PushFont(theme.mono);
    ImGui::TextColored(vec(theme.palette.text_faint), "#%d", frame.simplex[i]);
    if (i < frame.barycentric.size()) {
      const std::string value = short_number(frame.barycentric[i]);
      const float from = left + theme.px(64), to = left + width - theme.px(78);
      draw->AddRectFilled({from, y + theme.px(5)}, {to, y + theme.px(13)}, packed(theme.palette.field), theme.px(3));
      const auto share = static_cast<float>(std::clamp(frame.barycentric[i], 0.0, 1.0));
      draw->AddRectFilled({from, y + theme.px(5)}, {from + (to - from) * share, y + theme.px(13)}, packed(theme.palette.simplex), theme.px(3));
      ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x);
      ImGui::Text("%s", value.c_str());
    }
    ImGui::PopFont();
    ImGui::SetCursorScreenPos({left, y + row});
  }
  for (const int v : frame.dropped) ImGui::TextColored(vec(theme.palette.dropped), "vertex #%d dropped", v);
}

void faces(App& app) {
  const Frame& frame = app.session.frame();
  if (frame.faces.empty()) return;
  const Theme& theme = app.theme;
  section(theme, "POLYTOPE");
  number_row(theme, "faces", std::to_string(frame.faces.size()), theme.palette.text);
  if (!frame.added.empty() && !frame.removed.empty()) number_row(theme, "removed / added", std::to_string(frame.removed.size()) + " / " + std::to_string(frame.added.size()), theme.palette.frontier);
  if (frame.chosen && frame.faces.contains(*frame.chosen)) {
    const FrameFace& f = frame.faces.at(*frame.chosen);
    number_row(theme, "nearest face", "#" + std::to_string(f.face), theme.palette.chosen);
    number_row(theme, "its distance", short_number(f.distance), theme.palette.chosen);
    number_row(theme, "its normal", short_vector(f.normal), theme.palette.chosen);
  }
}

void bounds(App& app) {
  const Frame& frame = app.session.frame();
  const Theme& theme = app.theme;
  if (!frame.lower_bound && !frame.upper_bound) return;
  section(theme, "SIGNED DISTANCE OF THE BODIES");
  const auto text = [](const std::optional<double>& x) { return x ? short_number(*x) : std::string("unknown"); };
  number_row(theme, "at most", text(frame.upper_bound), theme.palette.text);
  number_row(theme, "at least", text(frame.lower_bound), theme.palette.text);
  if (frame.lower_bound && frame.upper_bound) number_row(theme, "gap", short_number(*frame.upper_bound - *frame.lower_bound), theme.palette.text_soft);
}

void algorithm(App& app) {
  const Theme& theme = app.theme;
  const PseudoCode code = pseudo_code(app.session.recording(), app.session.step());
  section(theme, code.title.c_str());
  ImGui::PushFont(theme.mono);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < code.lines.size(); ++i) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool current = static_cast<int>(i) == code.current;
    if (current) {
      const float right = at.x + ImGui::GetContentRegionAvail().x;
      draw->AddRectFilled({at.x - theme.px(6), at.y - theme.px(2)}, {right, at.y + ImGui::GetTextLineHeight() + theme.px(2)}, packed(theme.palette.accent.with_alpha(0.3)), theme.px(4));
      draw->AddTriangleFilled({at.x - theme.px(2), at.y + theme.px(3)}, {at.x - theme.px(2), at.y + theme.px(12)}, {at.x + theme.px(5), at.y + theme.px(7.5f)}, packed(theme.palette.accent));
    }
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + theme.px(12));
    ImGui::TextColored(vec(current ? theme.palette.text : theme.palette.text_soft), "%s", code.lines[i].c_str());
  }
  ImGui::PopFont();
}

/// The selected vertex, or the newest: where it is and where it came from.
void vertex(App& app) {
  const Theme& theme = app.theme;
  const Frame& frame = app.session.frame();
  const auto number = app.settings.selected ? app.settings.selected : frame.newest;
  if (!number || !frame.vertices.contains(*number)) return;
  const FrameVertex& v = frame.vertices.at(*number);
  const std::string letter = simplex_letter(frame, *number);
  section(theme, ("VERTEX #" + std::to_string(*number) + (letter.empty() ? "" : " (" + letter + ")") + (app.settings.selected ? ", selected" : ", newest")).c_str());
  number_row(theme, "w = a - b", short_vector(v.w), theme.palette.text);
  number_row(theme, "a", short_vector(v.a), theme.palette.body_a);
  number_row(theme, "b", short_vector(v.b), theme.palette.body_b);
  if (ImGui::SmallButton(("from step " + std::to_string(v.event)).c_str())) app.session.go_to(v.event);
}

/// After the last step: the answer and its certificate.
void answer(App& app) {
  if (app.session.step() + 1 != app.session.count()) return;
  const Theme& theme = app.theme;
  const Result& r = app.session.recording().result;
  section(theme, "RESULT");
  number_row(theme, "intersecting", r.intersecting ? "yes" : "no", r.intersecting ? theme.palette.newest : theme.palette.support);
  if (r.signed_distance) number_row(theme, "signed distance", short_number(*r.signed_distance), theme.palette.text);
  if (r.normal) number_row(theme, "normal", short_vector(*r.normal), theme.palette.text);
  if (r.witness_a) number_row(theme, "witness a", short_vector(*r.witness_a), theme.palette.body_a);
  if (r.witness_b) number_row(theme, "witness b", short_vector(*r.witness_b), theme.palette.body_b);
  if (r.contacts) number_row(theme, "contact points", std::to_string(r.contacts->size()), theme.palette.newest);
  number_row(theme, "support calls", std::to_string(r.support_calls), theme.palette.text_soft);
}

/// What is wrong with the recording: a click goes to the step; at the step, the whole message.
void findings(App& app) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  if (s.findings().empty()) return;
  section(theme, "FINDINGS");
  for (const Finding& f : s.findings()) {
    const bool here = f.step == s.step();
    ImGui::PushStyleColor(ImGuiCol_Text, vec(f.severity == Finding::Severity::error ? theme.palette.newest : theme.palette.frontier));
    if (ImGui::Selectable(("step " + std::to_string(f.step) + "  " + f.code).c_str(), here)) s.go_to(f.step);
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered() && !here) {
      ImGui::BeginTooltip();
      ImGui::PushTextWrapPos(theme.px(420));
      ImGui::TextUnformatted(f.message.c_str());
      ImGui::PopTextWrapPos();
      ImGui::EndTooltip();
    }
    if (!here) continue;
    ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.text_soft));
    ImGui::TextWrapped("%s", f.message.c_str());
    ImGui::PopStyleColor();
  }
}

/// Beside a foreign run: what a right implementation would have done.
void right_implementation(App& app) {
  const std::string text = right_step(app.session.recording(), app.session.frame());
  if (text.empty()) return;
  section(app.theme, "A RIGHT IMPLEMENTATION, FROM HERE");
  ImGui::PushStyleColor(ImGuiCol_Text, vec(app.theme.palette.support));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

}  // namespace

void step_panel(App& app, const Area& area) {
  if (!begin_area("step", area, true)) return ImGui::EndChild();
  heading(app);
  right_implementation(app);
  findings(app);
  weights(app);
  faces(app);
  bounds(app);
  answer(app);
  algorithm(app);
  vertex(app);
  ImGui::EndChild();
}

}  // namespace gjkdbg
