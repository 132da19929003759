// Below the views: transport, scrubber, and what stands under them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"

namespace gjkdbg {
namespace {

enum class Icon { first, back_iteration, back, play, pause, forward, forward_iteration, last };

void triangle(ImDrawList* draw, ImVec2 c, float r, float direction, ImU32 colour) {
  if (direction > 0) draw->AddTriangleFilled({c.x - r * 0.7f, c.y - r}, {c.x + r * 0.8f, c.y}, {c.x - r * 0.7f, c.y + r}, colour);
  else draw->AddTriangleFilled({c.x + r * 0.7f, c.y - r}, {c.x + r * 0.7f, c.y + r}, {c.x - r * 0.8f, c.y}, colour);
}

void draw_icon(ImDrawList* draw, Icon icon, ImVec2 c, float r, ImU32 colour) {
  const auto bar = [&](float x) { draw->AddRectFilled({c.x + x - r * 0.16f, c.y - r}, {c.x + x + r * 0.16f, c.y + r}, colour); };
  switch (icon) {
    case Icon::first: bar(-r), triangle(draw, {c.x + r * 0.3f, c.y}, r, -1, colour); break;
    case Icon::back_iteration: triangle(draw, {c.x - r * 0.7f, c.y}, r * 0.9f, -1, colour), triangle(draw, {c.x + r * 0.7f, c.y}, r * 0.9f, -1, colour); break;
    case Icon::back: bar(r * 0.9f), triangle(draw, {c.x - r * 0.2f, c.y}, r, -1, colour); break;
    case Icon::play: triangle(draw, c, r * 1.1f, 1, colour); break;
    case Icon::pause: bar(-r * 0.4f), bar(r * 0.4f); break;
    case Icon::forward: bar(-r * 0.9f), triangle(draw, {c.x + r * 0.2f, c.y}, r, 1, colour); break;
    case Icon::forward_iteration: triangle(draw, {c.x - r * 0.7f, c.y}, r * 0.9f, 1, colour), triangle(draw, {c.x + r * 0.7f, c.y}, r * 0.9f, 1, colour); break;
    case Icon::last: bar(r), triangle(draw, {c.x - r * 0.3f, c.y}, r, 1, colour); break;
  }
}

bool icon_button(const Theme& theme, float width, const char* id, Icon icon, const char* tip, bool strong = false) {
  const ImVec2 size{width, theme.px(30)}, at = ImGui::GetCursorScreenPos();
  if (strong) ImGui::PushStyleColor(ImGuiCol_Button, vec(theme.palette.accent));
  const bool pressed = ImGui::Button(id, size);
  if (strong) ImGui::PopStyleColor();
  draw_icon(ImGui::GetWindowDrawList(), icon, {at.x + size.x / 2, at.y + size.y / 2}, theme.px(6.5f), packed(strong ? rgb(0xffffff) : theme.palette.text));
  tip_beside_row(theme, tip);
  ImGui::SameLine(0, theme.px(5));
  return pressed;
}

}  // namespace

void transport(App& app) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  const float width = std::clamp((ImGui::GetContentRegionAvail().x - theme.px(6 * 5)) / 7, theme.px(18), theme.px(36));  // all seven have room
  if (icon_button(theme, width, "##first", Icon::first, "To the beginning (Home)")) s.go_to(0);
  if (icon_button(theme, width, "##back_iteration", Icon::back_iteration, "Back an iteration (Shift+Left)")) s.step_iteration(-1);
  if (icon_button(theme, width, "##back", Icon::back, "Back an event (Left)")) s.step_by(-1);
  if (icon_button(theme, width, "##play", s.playing ? Icon::pause : Icon::play, "Play (Space)", true)) s.toggle_play();
  if (icon_button(theme, width, "##forward", Icon::forward, "On an event (Right)")) s.step_by(1);
  if (icon_button(theme, width, "##forward_iteration", Icon::forward_iteration, "On an iteration (Shift+Right)")) s.step_iteration(1);
  if (icon_button(theme, width, "##last", Icon::last, "To the end (End)")) s.go_to(s.count() - 1);
  std::string count = "step " + std::to_string(s.step()) + " of " + std::to_string(s.count() - 1);
  const float right = ImGui::GetWindowContentRegionMax().x;
  const bool simulated = s.scene().scene.query == Query::simulate;
  if (simulated && ImGui::GetCursorPosX() + theme.px(300) + ImGui::CalcTextSize(count.c_str()).x > right) count = std::to_string(s.step()) + " / " + std::to_string(s.count() - 1);
  const float count_width = ImGui::CalcTextSize(count.c_str()).x;
  if (ImGui::GetCursorPosX() + count_width > right + theme.px(8)) return ImGui::NewLine();  // the step's panel has it, too
  if (ImGui::GetCursorPosX() + theme.px(190) + count_width > right) {  // no room for more
    ImGui::SameLine(std::max(ImGui::GetCursorPosX(), right - count_width));
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + (theme.px(30) - ImGui::GetFrameHeight()) / 2);
    ImGui::TextUnformatted(count.c_str());
    return;
  }
  ImGui::SameLine(0, theme.px(14));
  // In the middle of the buttons' height.
  const float row = ImGui::GetCursorPosY() + (theme.px(30) - ImGui::GetFrameHeight()) / 2;
  ImGui::SetCursorPosY(row);
  ImGui::SetNextItemWidth(theme.px(64));
  static const char* const speeds[] = {"0.25x", "0.5x", "1x", "2x", "4x", "8x"};
  int at = static_cast<int>(std::lround(std::log2(s.speed))) + 2;
  if (ImGui::Combo("##speed", &at, speeds, 6)) s.speed = std::pow(2, at - 2);
  ImGui::SameLine();
  ImGui::SetCursorPosY(row);
  ImGui::Checkbox("loop", &s.loop);
  if (simulated && ImGui::GetItemRectMax().x + theme.px(104) + count_width < ImGui::GetWindowPos().x + right) {
    ImGui::SameLine();
    ImGui::SetCursorPosY(row);
    ImGui::Checkbox("real time", &s.real_time);
  }
  ImGui::SameLine(right - count_width);
  ImGui::SetCursorPosY(row);  // the line's base is that of the fields
  ImGui::TextUnformatted(count.c_str());
}

/// The events of an iteration side by side.
struct Band {
  float x0;
  int phase, iteration;
};

/// Numbers above the bands: of every band, or where they have no room of every second, fifth, tenth… iteration. Then a run's beginning, which has the number 0,
/// has it only where it is the recording's: in a motion runs begin everywhere.
void number_bands(const Theme& theme, const std::vector<Band>& bands, ImVec2 at, float end) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const auto label = [](const Band& band) { return (band.phase == 0 ? "" : "E") + std::to_string(band.iteration); };
  const auto reach = [&](const Band& band) { return band.x0 + theme.small->CalcTextSizeA(theme.small->FontSize, 1000, 0, label(band).c_str()).x + theme.px(8); };
  const auto fits = [&](int stride) {
    for (std::size_t i = 0, last = bands.size(); i < bands.size(); ++i) {
      if (bands[i].iteration % stride != 0) continue;
      if (last < i && bands[last].phase == bands[i].phase && bands[last].iteration < bands[i].iteration && reach(bands[last]) > bands[i].x0 + theme.px(3)) return false;
      last = i;
    }
    return true;
  };
  int stride = 1;
  for (int decade = 1; !fits(stride) && decade <= 100000; decade *= 10)
    for (const int step : {2 * decade, 5 * decade, 10 * decade})
      if (!fits(stride)) stride = step;
  float free_from = at.x;
  for (const Band& band : bands) {
    const bool begins_again = stride > 1 && band.iteration == 0 && band.x0 > at.x;
    if (band.iteration % stride != 0 || begins_again || band.x0 + theme.px(3) < free_from || reach(band) - theme.px(4) > end) continue;
    draw->AddText(theme.small, theme.small->FontSize * 0.85f, {band.x0 + theme.px(4), at.y + theme.px(2)}, packed(theme.palette.text_faint), label(band).c_str());
    free_from = reach(band);
  }
}

/// What is seen where there is no room for all: the rarer the better.
int rarity(const Event& event) {
  if (std::holds_alternative<recorded::Warning>(event)) return 5;
  if (std::holds_alternative<recorded::ImpulseApplied>(event)) return 4;
  if (std::holds_alternative<recorded::ContactFound>(event)) return 3;
  if (std::holds_alternative<recorded::PolytopeGrown>(event) || std::holds_alternative<recorded::PolytopeSeeded>(event)) return 2;
  return std::holds_alternative<recorded::State>(event) || std::holds_alternative<recorded::CastAdvanced>(event) ? 1 : 0;
}

/// The events whose ticks are drawn: all, or of those that share two pixels the rarest.
std::vector<std::size_t> ticks(const std::vector<Event>& events, float cell) {
  const double width = cell >= 2 ? 1 : 2 / std::max(static_cast<double>(cell), 1e-6);  // in events
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < events.size();) {
    const auto end = std::max<std::size_t>(i + 1, static_cast<std::size_t>((std::floor(static_cast<double>(i) / width) + 1) * width));
    std::size_t rarest = i;
    for (std::size_t k = i; k < std::min(end, events.size()); ++k)
      if (rarity(events[k]) > rarity(events[rarest])) rarest = k;
    drawn.push_back(rarest);
    i = end;
  }
  return drawn;
}

/// The strip that the scrubber draws on: its corner, its size, and the width of one event.
struct Strip {
  ImVec2 at, size;
  float cell;

  float left_of(std::size_t step) const { return at.x + static_cast<float>(step) * cell; }
  float middle_of(std::size_t step) const { return at.x + (static_cast<float>(step) + 0.5f) * cell; }
  float bottom() const { return at.y + size.y; }
  /// The step under the mouse, or the nearest.
  std::size_t under_mouse(std::size_t count) const { return static_cast<std::size_t>(std::clamp((ImGui::GetIO().MousePos.x - at.x) / cell, 0.f, static_cast<float>(count) - 1)); }
};

/// Every other band is drawn a little lighter; their numbers stand at the top.
void draw_bands(const Theme& theme, const std::vector<Event>& events, const Strip& strip) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  std::vector<Band> bands;
  for (std::size_t i = 0; i < events.size();) {
    std::size_t end = i + 1;
    const int phase = phase_of(events[i]);
    int iteration = iteration_of(events[i]);
    const auto belongs = [&](const Event& event) { return std::holds_alternative<recorded::Warning>(event) || (phase_of(event) == phase && (iteration < 0 || iteration_of(event) == iteration)); };
    for (; end < events.size() && belongs(events[end]); ++end)
      if (iteration < 0) iteration = iteration_of(events[end]);
    const float x0 = strip.left_of(i), x1 = strip.left_of(end);
    if (bands.size() % 2 == 1 && x1 - x0 >= 1) draw->AddRectFilled({x0, strip.at.y}, {x1, strip.bottom()}, packed(theme.palette.hover.with_alpha(0.6)));
    // Those of a cast go by their times, above.
    const bool timed = std::holds_alternative<recorded::CastAdvanced>(events[i]) || std::holds_alternative<recorded::CastEnded>(events[i]);
    bands.push_back({x0, phase, timed ? -1 : std::max(0, iteration)});
    i = end;
  }
  std::erase_if(bands, [](const Band& band) { return band.iteration < 0; });
  number_bands(theme, bands, strip.at, strip.at.x + strip.size.x);
}

void draw_ticks(const Theme& theme, const std::vector<Event>& events, const Strip& strip) {
  const float width = std::clamp(strip.cell * 0.4f, 1.f, theme.px(5)), low = strip.bottom() - theme.px(6), high = strip.at.y + theme.px(19);
  const auto draw_tick = [&](std::size_t i, float wide) {
    const float x = strip.middle_of(i);
    ImGui::GetWindowDrawList()->AddRectFilled({x - wide / 2, low - (low - high) * event_share(events[i])}, {x + wide / 2, low}, packed(event_colour(theme.palette, events[i])), 1);
  };
  const std::vector<std::size_t> drawn = ticks(events, strip.cell);
  for (const std::size_t i : drawn) draw_tick(i, width);
  for (const std::size_t i : drawn)
    if (rarity(events[i]) >= 3) draw_tick(i, std::max(width, theme.px(2.5f)));  // before those beside them
}

/// Where the two runs part, the findings, the loop, and where we are.
void draw_flags(const Theme& theme, const Session& s, const Strip& strip) {
  const Palette& p = theme.palette;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float top = strip.at.y, bottom = strip.bottom();
  if (s.parting() && s.parting()->event < s.count()) {
    const float x = strip.middle_of(s.parting()->event);
    draw->AddLine({x, top}, {x, bottom}, packed(p.text_soft), theme.px(2));
    draw->AddText(theme.small, theme.small->FontSize * 0.85f, {x + theme.px(4), top + theme.px(2)}, packed(p.text_soft), "parts");
  }
  for (const Finding& f : s.findings()) {
    const float x = strip.middle_of(f.step), r = theme.px(5);
    draw->AddTriangleFilled({x - r, top + theme.px(2)}, {x + r, top + theme.px(2)}, {x, top + theme.px(2) + 1.6f * r}, packed(p.newest));
    draw->AddLine({x, top}, {x, bottom}, packed(p.newest), theme.px(1.5f));
  }
  if (s.loop && (s.loop_from || s.loop_to))
    draw->AddRect({strip.left_of(s.loop_from.value_or(0)), top}, {strip.left_of(s.loop_to.value_or(s.count() - 1) + 1), bottom}, packed(p.accent), theme.px(3), 0, theme.px(2));
  const float x = strip.middle_of(s.step());
  draw->AddLine({x, top - theme.px(2)}, {x, bottom + theme.px(2)}, packed(p.text), theme.px(2));
  draw->AddTriangleFilled({x - theme.px(6), top - theme.px(7)}, {x + theme.px(6), top - theme.px(7)}, {x, top + theme.px(1)}, packed(p.text));
}

/// Breakpoints as discs, bookmarks as their digits, on the lower edge and before all else.
void draw_marks(const App& app, const Strip& strip) {
  const Theme& theme = app.theme;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const Palette& p = theme.palette;
  const auto place = [&](std::size_t step) { return ImVec2{strip.middle_of(step), strip.bottom() - theme.px(1)}; };
  for (const std::size_t step : app.session.breakpoints) {
    draw->AddCircleFilled(place(step), theme.px(6), packed(p.panel), 20);
    draw->AddCircleFilled(place(step), theme.px(4.5f), packed(p.newest), 20);
  }
  for (const auto& [digit, step] : app.session.bookmarks) {
    const std::string text = std::to_string(digit);
    const float size = theme.small->FontSize * 0.85f, half = theme.small->CalcTextSizeA(size, 1000, 0, text.c_str()).x / 2;
    ImVec2 c = place(step);
    if (app.session.breakpoints.contains(step)) c.x += theme.px(12);
    draw->AddRectFilled({c.x - theme.px(6), c.y - theme.px(7)}, {c.x + theme.px(6), c.y + theme.px(6)}, packed(p.accent), theme.px(2));
    draw->AddText(theme.small, size, {c.x - half, c.y - size / 2 - theme.px(1)}, packed(rgb(0xffffff)), text.c_str());
  }
}

/// Iterations as bands, events as ticks; the pointer seeks.
void scrubber(App& app) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  const ImVec2 size{ImGui::GetContentRegionAvail().x, theme.px(44)};
  const Strip strip{ImGui::GetCursorScreenPos(), size, size.x / static_cast<float>(s.count())};
  ImGui::InvisibleButton("scrubber", size);
  const bool held = ImGui::IsItemActive(), hovered = ImGui::IsItemHovered();
  if (held) s.playing = false, s.go_to(strip.under_mouse(s.count()));
  const std::vector<Event>& events = s.recording().events;
  ImGui::GetWindowDrawList()->AddRectFilled(strip.at, {strip.at.x + size.x, strip.bottom()}, packed(theme.palette.field), theme.px(4));
  draw_bands(theme, events, strip);
  draw_ticks(theme, events, strip);
  draw_flags(theme, s, strip);
  draw_marks(app, strip);
  if (!hovered || held) return;
  const std::size_t under = strip.under_mouse(s.count());
  ImGui::SetTooltip("step %zu  %s  %s", under, short_kind(events[under]), summary(s.recording(), under, app.settings.newest_first).c_str());
}

namespace {

/// A colour's kinds, of those that the recording has.
class LegendEntries {
 public:
  explicit LegendEntries(const Recording& recording) : recording_(recording) {
    for (const Event& event : recording.events) present_[event.index()] = true;
  }
  template <class Kind>
  LegendEntries& name(const std::string& text) {
    static const std::size_t index = Event(Kind{}).index();
    if (present_[index] && joined_.find(text) == std::string::npos) joined_ += (joined_.empty() ? "" : ", ") + text;
    return *this;
  }
  /// What was named since the last call; empty where there is none of it.
  std::string take() { return std::exchange(joined_, {}); }
  std::string chosen() {
    return name<recorded::FaceChosen>("nearest " + facet_name(recording_)).name<recorded::PortalFound>("portal").name<recorded::AxisTested>("axis").name<recorded::PointPredicted>("Newton").name<recorded::ContactFound>("contact").take();
  }
  std::string simplex() { return name<recorded::SimplexReduced>("simplex").name<recorded::PointsProjected>("points").name<recorded::LinesSolved>("lines").take(); }
  std::string support() { return name<recorded::SupportQueried>("support").name<recorded::VertexKept>("kept").take(); }
  std::string polytope() { return name<recorded::PolytopeSeeded>("polytope").name<recorded::PolytopeGrown>("polytope").take(); }
  std::string motion() { return name<recorded::CastAdvanced>("advance").name<recorded::State>("state").take(); }
  std::string impulse() { return name<recorded::ImpulseApplied>("impulse").take(); }
  std::string warning() { return name<recorded::Warning>("warning").take(); }

 private:
  const Recording& recording_;
  std::array<bool, std::variant_size_v<Event>> present_{};
  std::string joined_;
};

/// The ticks' colours and heights.
void legend(App& app) {
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  ImGui::PushFont(theme.small);
  LegendEntries kinds(app.session.recording());
  struct Entry {
    std::string name;
    Colour colour;
    float share;
  };
  const Entry entries[] = {{kinds.support(), p.support, 0.6f}, {kinds.simplex(), p.simplex, 0.85f}, {kinds.chosen(), p.chosen, 0.4f}, {kinds.polytope(), p.frontier, 1}, {kinds.motion(), p.accent, 1},
                           {kinds.impulse(), p.body_b, 1}, {"begin, end", p.text, 1}, {kinds.warning(), p.newest, 1}, {app.session.findings().empty() ? "" : "finding", p.newest, 0}};
  for (const auto& [name, colour, share] : entries) {
    if (name.empty()) continue;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::GetCursorPosX() + theme.px(14) + ImGui::CalcTextSize(name.c_str()).x > ImGui::GetWindowContentRegionMax().x) break;
    const float low = at.y + theme.px(14), tall = theme.px(11);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    if (share > 0) draw->AddRectFilled({at.x + theme.px(2), low - tall * share}, {at.x + theme.px(7), low}, packed(colour), 1);
    else draw->AddTriangleFilled({at.x, low - theme.px(9)}, {at.x + theme.px(10), low - theme.px(9)}, {at.x + theme.px(5), low}, packed(colour));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + theme.px(14));
    ImGui::TextColored(vec(p.text_faint), "%s", name.c_str());
    ImGui::SameLine(0, theme.px(16));
  }
  ImGui::NewLine();
  ImGui::PopFont();
}

}  // namespace

void timeline_panel(App& app, const Area& area) {
  if (!begin_panel(app.theme, "timeline", area)) return ImGui::EndChild();
  if (area.height > app.theme.px(100)) transport(app), ImGui::Dummy({0, app.theme.px(4)});
  const bool moves = app.session.scene().scene.motion.has_value();
  if (moves) time_axis(app);
  scrubber(app);
  if (ImGui::GetContentRegionAvail().y > app.theme.px(16)) legend(app);
  const ImVec2 left = ImGui::GetContentRegionAvail();
  if (left.y > app.theme.px(40)) {
    const float list = left.x > app.theme.px(560) ? left.x * 0.56f : left.x;
    event_list(app, list, left.y);
    if (list < left.x) {
      ImGui::SameLine(0, app.theme.px(10));
      (moves ? motion_plot : bounds_plot)(app, left.x - list - app.theme.px(10), left.y);
    }
  }
  ImGui::EndChild();
}

}  // namespace gjkdbg
