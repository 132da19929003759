// Below the views: transport, scrubber, event list, bounds.
#include <algorithm>
#include <cmath>
#include <map>

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

bool icon_button(const Theme& theme, const char* id, Icon icon, const char* tip, bool strong = false) {
  const ImVec2 size{theme.px(36), theme.px(30)}, at = ImGui::GetCursorScreenPos();
  if (strong) ImGui::PushStyleColor(ImGuiCol_Button, vec(theme.palette.accent));
  const bool pressed = ImGui::Button(id, size);
  if (strong) ImGui::PopStyleColor();
  draw_icon(ImGui::GetWindowDrawList(), icon, {at.x + size.x / 2, at.y + size.y / 2}, theme.px(6.5f), packed(strong ? rgb(0xffffff) : theme.palette.text));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip);
  ImGui::SameLine(0, theme.px(5));
  return pressed;
}

}  // namespace

void transport(App& app) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  if (icon_button(theme, "##first", Icon::first, "To the beginning (Home)")) s.go_to(0);
  if (icon_button(theme, "##back_iteration", Icon::back_iteration, "Back an iteration (Shift+Left)")) s.step_iteration(-1);
  if (icon_button(theme, "##back", Icon::back, "Back an event (Left)")) s.step_by(-1);
  if (icon_button(theme, "##play", s.playing ? Icon::pause : Icon::play, "Play (Space)", true)) s.toggle_play();
  if (icon_button(theme, "##forward", Icon::forward, "On an event (Right)")) s.step_by(1);
  if (icon_button(theme, "##forward_iteration", Icon::forward_iteration, "On an iteration (Shift+Right)")) s.step_iteration(1);
  if (icon_button(theme, "##last", Icon::last, "To the end (End)")) s.go_to(s.count() - 1);
  const std::string count = "step " + std::to_string(s.step()) + " of " + std::to_string(s.count() - 1);
  const float count_width = ImGui::CalcTextSize(count.c_str()).x, right = ImGui::GetWindowContentRegionMax().x;
  if (ImGui::GetCursorPosX() + theme.px(190) + count_width > right) {  // no room for more
    ImGui::SameLine(std::max(ImGui::GetCursorPosX(), right - count_width));
    ImGui::TextUnformatted(count.c_str());
    return;
  }
  ImGui::SameLine(0, theme.px(14));
  ImGui::SetNextItemWidth(theme.px(64));
  static const char* const speeds[] = {"0.25x", "0.5x", "1x", "2x", "4x", "8x"};
  int at = static_cast<int>(std::lround(std::log2(s.speed))) + 2;
  if (ImGui::Combo("##speed", &at, speeds, 6)) s.speed = std::pow(2, at - 2);
  ImGui::SameLine();
  ImGui::Checkbox("loop", &s.loop);
  if (s.scene().scene.query == Query::simulate && ImGui::GetItemRectMax().x + theme.px(110) + count_width < ImGui::GetWindowPos().x + right) {
    ImGui::SameLine();
    ImGui::Checkbox("real time", &s.real_time);
  }
  ImGui::SameLine(right - count_width);
  ImGui::TextUnformatted(count.c_str());
}

namespace {

/// The time of a moving scene over its events: a mark where it moves on.
void time_axis(App& app) {
  const Session& s = app.session;
  const Theme& theme = app.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, theme.px(15)};
  ImGui::Dummy(size);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float cell = size.x / static_cast<float>(s.count());
  float free = at.x;
  double last = -1;
  for (std::size_t i = 0; i < s.count(); ++i) {
    std::optional<double> time;
    const Event& event = s.recording().events[i];
    if (const auto* e = std::get_if<recorded::State>(&event)) time = e->time;
    if (const auto* e = std::get_if<recorded::CastAdvanced>(&event)) time = e->time;
    if (const auto* e = std::get_if<recorded::CastEnded>(&event)) time = e->time;
    if (!time || *time == last) continue;
    last = *time;
    const float x = at.x + (static_cast<float>(i) + 0.5f) * cell;
    if (x < free) continue;
    const std::string text = "t " + short_number(*time);
    const float width = theme.small->CalcTextSizeA(theme.small->FontSize * 0.85f, 1000, 0, text.c_str()).x;
    draw->AddLine({x, at.y + theme.px(2)}, {x, at.y + size.y + theme.px(4)}, packed(theme.palette.accent), 1);
    if (x + width + theme.px(4) < at.x + size.x) draw->AddText(theme.small, theme.small->FontSize * 0.85f, {x + theme.px(3), at.y}, packed(theme.palette.text_faint), text.c_str());
    free = x + width + theme.px(12);
  }
}

}  // namespace

/// Iterations as bands, events as ticks; the pointer seeks.
void scrubber(App& app) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, theme.px(44)};
  ImGui::InvisibleButton("scrubber", size);
  const auto count = static_cast<float>(s.count());
  const float cell = size.x / count;
  if (ImGui::IsItemActive()) s.playing = false, s.go_to(static_cast<std::size_t>(std::clamp((ImGui::GetIO().MousePos.x - at.x) / cell, 0.f, count - 1)));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, {at.x + size.x, at.y + size.y}, packed(p.field), theme.px(4));
  int band = 0;
  float label_end = at.x;
  for (std::size_t i = 0; i < s.count();) {
    std::size_t end = i + 1;
    const int phase = phase_of(s.recording().events[i]);
    int iteration = iteration_of(s.recording().events[i]);
    const auto belongs = [&](const Event& event) { return phase_of(event) == phase && (iteration < 0 || iteration_of(event) < 0 || iteration_of(event) == iteration); };
    for (; end < s.count() && belongs(s.recording().events[end]); ++end)
      if (iteration < 0) iteration = iteration_of(s.recording().events[end]);
    const float x0 = at.x + static_cast<float>(i) * cell, x1 = at.x + static_cast<float>(end) * cell;
    if (band++ % 2 == 1 && x1 - x0 >= 1) draw->AddRectFilled({x0, at.y}, {x1, at.y + size.y}, packed(p.hover.with_alpha(0.6)));
    if (x1 - x0 < theme.px(8)) {
      i = end;
      continue;
    }
    const std::string label = (phase == 0 ? "" : "E") + std::to_string(std::max(0, iteration));
    const float width = theme.small->CalcTextSizeA(theme.small->FontSize, 1000, 0, label.c_str()).x;
    if (x0 + theme.px(3) >= label_end && x1 - x0 > width + theme.px(4)) {
      draw->AddText(theme.small, theme.small->FontSize * 0.85f, {x0 + theme.px(4), at.y + theme.px(2)}, packed(p.text_faint), label.c_str());
      label_end = x0 + width + theme.px(8);
    }
    i = end;
  }
  const std::size_t stride = std::max<std::size_t>(1, static_cast<std::size_t>(2 / std::max(cell, 1e-6f)));
  const float tick = std::clamp(cell * 0.4f, 1.f, theme.px(5));
  for (std::size_t i = 0; i < s.count(); i += stride) {
    const float x = at.x + (static_cast<float>(i) + 0.5f) * cell;
    draw->AddRectFilled({x - tick / 2, at.y + theme.px(19)}, {x + tick / 2, at.y + size.y - theme.px(6)}, packed(event_colour(p, s.recording().events[i])), 1);
  }
  if (s.parting() && s.parting()->event < s.count()) {
    const float x = at.x + (static_cast<float>(s.parting()->event) + 0.5f) * cell;
    draw->AddLine({x, at.y}, {x, at.y + size.y}, packed(p.body_b), theme.px(2));
    draw->AddText(theme.small, theme.small->FontSize * 0.85f, {x + theme.px(4), at.y + theme.px(2)}, packed(p.body_b), "parts");
  }
  for (const auto& [digit, step] : s.bookmarks) {
    const float x = at.x + (static_cast<float>(step) + 0.5f) * cell;
    draw->AddText(theme.small, theme.small->FontSize * 0.85f, {x - theme.px(3), at.y + size.y - theme.px(14)}, packed(p.accent), std::to_string(digit).c_str());
  }
  for (const Finding& f : s.findings()) {
    const float x = at.x + (static_cast<float>(f.step) + 0.5f) * cell, r = theme.px(5);
    draw->AddTriangleFilled({x - r, at.y + theme.px(2)}, {x + r, at.y + theme.px(2)}, {x, at.y + theme.px(2) + 1.6f * r}, packed(p.newest));
    draw->AddLine({x, at.y}, {x, at.y + size.y}, packed(p.newest), theme.px(1.5f));
  }
  for (const std::size_t b : s.breakpoints) {
    const float x = at.x + (static_cast<float>(b) + 0.5f) * cell;
    draw->AddCircleFilled({x, at.y + size.y - theme.px(3)}, theme.px(3), packed(p.newest));
  }
  if (s.loop && (s.loop_from || s.loop_to)) {
    const float x0 = at.x + static_cast<float>(s.loop_from.value_or(0)) * cell, x1 = at.x + static_cast<float>(s.loop_to.value_or(s.count() - 1) + 1) * cell;
    draw->AddRect({x0, at.y}, {x1, at.y + size.y}, packed(p.accent), theme.px(3), 0, theme.px(2));
  }
  const float x = at.x + (static_cast<float>(s.step()) + 0.5f) * cell;
  draw->AddLine({x, at.y - theme.px(2)}, {x, at.y + size.y + theme.px(2)}, packed(p.text), theme.px(2));
  draw->AddTriangleFilled({x - theme.px(6), at.y - theme.px(7)}, {x + theme.px(6), at.y - theme.px(7)}, {x, at.y + theme.px(1)}, packed(p.text));
}

namespace {

void legend(App& app) {
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  ImGui::PushFont(theme.small);
  const std::pair<const char*, Colour> entries[] = {{"support", p.support}, {"simplex", p.simplex}, {"face chosen", p.chosen}, {"polytope", p.frontier}, {"begin, end", p.text}, {"warning, finding", p.newest}};
  for (const auto& [name, colour] : entries) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::GetCursorPosX() + theme.px(14) + ImGui::CalcTextSize(name).x > ImGui::GetWindowContentRegionMax().x) break;
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + theme.px(4)}, {at.x + theme.px(9), at.y + theme.px(13)}, packed(colour), 2);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + theme.px(14));
    ImGui::TextColored(vec(p.text_faint), "%s", name);
    ImGui::SameLine(0, theme.px(16));
  }
  ImGui::NewLine();
  ImGui::PopFont();
}

void event_list(App& app, float width, float height) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, vec(theme.palette.panel));
  ImGui::BeginChild("events", {width, height}, false);
  ImGui::PushFont(theme.mono);
  static std::size_t shown = 0;
  const float row = ImGui::GetTextLineHeightWithSpacing();
  if (shown != s.step()) ImGui::SetScrollY(std::max(0.f, static_cast<float>(s.step()) * row - height / 2));
  shown = s.step();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(s.count()), row);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Event& event = s.recording().events[k];
      ImGui::PushID(i);
      if (ImGui::Selectable("##row", s.step() == k)) s.playing = false, s.go_to(k);
      ImGui::SameLine(theme.px(8));
      ImGui::TextColored(vec(theme.palette.text_faint), "%4d", i);
      const ImVec2 at = ImGui::GetItemRectMax();
      ImGui::GetWindowDrawList()->AddRectFilled({at.x + theme.px(8), at.y - theme.px(13)}, {at.x + theme.px(16), at.y - theme.px(5)}, packed(event_colour(theme.palette, event)), 2);
      ImGui::SameLine(theme.px(66));
      ImGui::TextUnformatted(short_kind(event));
      ImGui::SameLine(theme.px(146));
      ImGui::TextColored(vec(theme.palette.text_soft), "%s", summary(s.recording(), k).c_str());
      ImGui::PopID();
    }
  ImGui::PopFont();
  ImGui::EndChild();
  ImGui::PopStyleColor();
}

/// The gap between the bounds at a step.
struct Sample {
  std::size_t step;
  double gap;
  int phase;
};

std::vector<Sample> samples_of(const Recording& recording) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < recording.events.size(); ++i)
    std::visit(
        [&](const auto& e) {
          if constexpr (requires { e.upper_bound; }) samples.push_back({i, e.upper_bound - e.lower_bound, phase_of(recording.events[i])});
        },
        recording.events[i]);
  const Result& r = recording.result;
  if (r.upper_bound && r.lower_bound && phase_of(recording.events.back()) == 1) samples.push_back({recording.events.size() - 1, *r.upper_bound - *r.lower_bound, 1});
  std::erase_if(samples, [](const Sample& x) { return !(x.gap > 0) || !std::isfinite(x.gap); });
  return samples;
}

/// The gap between the bounds, event by event, on a logarithmic scale: the certificate closing in on the tolerance, down to the floor
/// below which nothing can be told. With another run beside it, that one's too.
void bounds_plot(App& app, float width, float height) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, {at.x + width, at.y + height}, packed(p.view), theme.px(6));
  draw->AddText(theme.small, theme.small->FontSize, {at.x + theme.px(10), at.y + theme.px(6)}, packed(p.text_faint), "gap between the bounds, log scale");
  ImGui::Dummy({width, height});
  const std::vector<Sample> samples = samples_of(s.recording()), others = s.comparing() ? samples_of(s.other()) : std::vector<Sample>();
  if (samples.empty() && others.empty()) return;
  const Settings& settings = s.recording().settings;
  const double size = std::abs(s.recording().result.signed_distance.value_or(0));
  const double floor = s.scene().scene.bodies.size() < 2 ? 0 : 2 * rounding_floor(s.scene().scene, settings), tolerance = std::max(settings.tolerance * size, 0.0);
  double low = floor, high = floor;
  for (const auto* list : {&samples, &others})
    for (const Sample& x : *list) low = std::min(low, x.gap), high = std::max(high, x.gap);
  const double log_low = std::floor(std::log10(low)) - 1, log_high = std::max(log_low + 1, std::ceil(std::log10(high)));
  const ImVec2 from{at.x + theme.px(52), at.y + theme.px(28)}, to{at.x + width - theme.px(14), at.y + height - theme.px(12)};
  const auto y_of = [&](double log) { return to.y - static_cast<float>((log - log_low) / (log_high - log_low)) * (to.y - from.y); };
  const std::size_t last = std::max(s.count(), s.comparing() ? s.other().events.size() : 0) - 1;
  const auto x_of = [&](std::size_t step) { return from.x + (last == 0 ? 0 : static_cast<float>(step) / static_cast<float>(last)) * (to.x - from.x); };
  for (int i = 0; i <= 2; ++i) {
    const double log = std::round(log_low + (log_high - log_low) * i / 2);
    char text[16];
    std::snprintf(text, sizeof text, "1e%+d", static_cast<int>(log));
    draw->AddText(theme.small, theme.small->FontSize, {at.x + theme.px(10), y_of(log) - theme.px(7)}, packed(p.text_faint), text);
    draw->AddLine({from.x, y_of(log)}, {to.x, y_of(log)}, packed(p.field), 1);
  }
  const auto level = [&](double value, const char* name, Colour colour, bool below) {
    if (!(value >= low * 0.999) || value > high) return;
    const float y = y_of(std::log10(value));
    for (float x = from.x; x < to.x; x += theme.px(8)) draw->AddLine({x, y}, {std::min(x + theme.px(4), to.x), y}, packed(colour), 1);
    draw->AddText(theme.small, theme.small->FontSize * 0.85f, {from.x + theme.px(4), below ? y + 1 : y - theme.px(13)}, packed(colour), name);
  };
  level(floor, "rounding floor", p.dropped, true);
  if (tolerance > 1.5 * floor) level(tolerance, "tolerance", p.support, false);
  const auto curve = [&](const std::vector<Sample>& all, bool other) {
    // Where many fall into one pixel, its least and its greatest stand for all.
    std::vector<Sample> thinned;
    const std::vector<Sample>* shown = &all;
    if (static_cast<float>(all.size()) > 2 * (to.x - from.x)) {
      for (std::size_t i = 0; i < all.size();) {
        std::size_t least = i, most = i, end = i;
        for (const float x = x_of(all[i].step); end < all.size() && x_of(all[end].step) < x + 2; ++end) {
          if (all[end].gap < all[least].gap) least = end;
          if (all[end].gap > all[most].gap) most = end;
        }
        thinned.push_back(all[std::min(least, most)]), thinned.push_back(all[std::max(least, most)]);
        i = end;
      }
      shown = &thinned;
    }
    for (std::size_t i = 0; i < shown->size(); ++i) {
      const std::vector<Sample>& list = *shown;
      const Colour colour = other ? p.body_b : list[i].phase == 0 ? p.simplex : p.chosen;
      const ImVec2 here{x_of(list[i].step), y_of(std::log10(list[i].gap))};
      if (i > 0 && list[i - 1].phase == list[i].phase) draw->AddLine({x_of(list[i - 1].step), y_of(std::log10(list[i - 1].gap))}, here, packed(colour), theme.px(other ? 1.2f : 2));
      if (other) draw->AddCircle(here, theme.px(3), packed(colour), 12, theme.px(1.2f));
      else draw->AddCircleFilled(here, theme.px(2.5f), packed(colour));
    }
  };
  curve(others, true);
  curve(samples, false);
  draw->AddLine({x_of(s.step()), from.y}, {x_of(s.step()), to.y}, packed(p.text.with_alpha(0.6)), 1);
}

/// A moving scene: over time, the distance of the pair looked at (cast), or the energy (simulate).
void motion_plot(App& app, float width, float height) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const bool cast = s.scene().scene.query == Query::cast;
  draw->AddRectFilled(at, {at.x + width, at.y + height}, packed(p.view), theme.px(6));
  draw->AddText(theme.small, theme.small->FontSize, {at.x + theme.px(10), at.y + theme.px(6)}, packed(p.text_faint), cast ? "distance over time, each advance" : "energy over time");
  ImGui::Dummy({width, height});
  struct Point {
    double time, value;
    int series;
  };
  std::vector<Point> points;
  for (const Event& event : s.recording().events) {
    if (const auto* e = std::get_if<recorded::CastAdvanced>(&event); e && cast) points.push_back({e->time, e->distance, e->pair[0] * 1000 + e->pair[1]});
    if (const auto* e = std::get_if<recorded::State>(&event); e && !cast) points.push_back({e->time, e->energy, 0});
  }
  if (points.empty()) return;
  double low = cast ? 0 : points[0].value, high = points[0].value, first = cast ? 0 : points[0].time, last = cast ? 1 : points[0].time;
  for (const Point& x : points) low = std::min(low, x.value), high = std::max(high, x.value), last = std::max(last, x.time);
  if (!(high > low)) high = low + std::max(1e-12, std::abs(low) * 1e-3);
  const ImVec2 from{at.x + theme.px(64), at.y + theme.px(28)}, to{at.x + width - theme.px(14), at.y + height - theme.px(22)};
  const auto place = [&](const Point& x) {
    return ImVec2{from.x + static_cast<float>((x.time - first) / std::max(last - first, 1e-300)) * (to.x - from.x), to.y - static_cast<float>((x.value - low) / (high - low)) * (to.y - from.y)};
  };
  for (const double value : {low, high}) {
    const float y = place({first, value, 0}).y;
    draw->AddLine({from.x, y}, {to.x, y}, packed(p.field), 1);
    draw->AddText(theme.small, theme.small->FontSize * 0.85f, {at.x + theme.px(8), y - theme.px(6)}, packed(p.text_faint), short_number(value).c_str());
  }
  draw->AddText(theme.small, theme.small->FontSize * 0.85f, {from.x, to.y + theme.px(4)}, packed(p.text_faint), ("t " + short_number(first)).c_str());
  const std::string end = short_number(last);
  draw->AddText(theme.small, theme.small->FontSize * 0.85f, {to.x - theme.px(7) * static_cast<float>(end.size()), to.y + theme.px(4)}, packed(p.text_faint), end.c_str());
  std::map<int, ImVec2> before;
  for (const Point& x : points) {
    const ImVec2 here = place(x);
    const Colour colour = !cast || x.series == s.frame().pair[0] * 1000 + s.frame().pair[1] ? p.simplex : p.dropped;
    if (const auto found = before.find(x.series); found != before.end() && here.x >= found->second.x) draw->AddLine(found->second, here, packed(colour), theme.px(1.6f));
    if (cast) draw->AddCircleFilled(here, theme.px(2.5f), packed(colour));
    before[x.series] = here;
  }
  if (!s.frame().time) return;
  const float x = place({*s.frame().time, low, 0}).x;
  draw->AddLine({x, from.y}, {x, to.y}, packed(p.text.with_alpha(0.6)), 1);
}

}  // namespace

void timeline_panel(App& app, const Area& area) {
  if (!begin_area("timeline", area)) return ImGui::EndChild();
  transport(app);
  ImGui::Dummy({0, app.theme.px(4)});
  const bool moves = app.session.scene().scene.motion.has_value();
  if (moves) time_axis(app);
  scrubber(app);
  legend(app);
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
