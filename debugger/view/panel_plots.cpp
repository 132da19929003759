// Below the views, on the right: how the certificate closes in; of moving scenes distance, energy and momentum over time.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"

namespace gjkdbg {
namespace {

/// The gap between the bounds at a step.
struct Sample {
  std::size_t step;
  double gap;
  int phase;
  int run = 0;  ///< of a mesh each triangle is one
};

std::vector<Sample> samples_of(const Recording& recording) {
  std::vector<Sample> samples;
  int run = 0;
  double deepest = std::numeric_limits<double>::infinity();  // by GJK, which EPA goes on from
  for (std::size_t i = 0; i < recording.events.size(); ++i)
    std::visit(
        [&](const auto& e) {
          using E = std::decay_t<decltype(e)>;
          if constexpr (std::is_same_v<E, recorded::GjkBegan>) ++run;
          if constexpr (std::is_same_v<E, recorded::GjkEnded>) deepest = -e.lower_bound;
          if constexpr (requires { e.upper_bound; }) {
            const double upper = std::is_same_v<E, recorded::PolytopeGrown> && e.lower_bound <= deepest ? std::min(e.upper_bound, deepest) : e.upper_bound;
            samples.push_back({i, upper - e.lower_bound, phase_of(recording.events[i]), run});
          }
        },
        recording.events[i]);
  const Result& r = recording.result;
  const Event& last = recording.events.back();
  const bool without_bounds = std::holds_alternative<recorded::EpaEnded>(last) || std::holds_alternative<recorded::SatEnded>(last) || std::holds_alternative<recorded::MprEnded>(last);
  if (r.upper_bound && r.lower_bound && without_bounds) samples.push_back({recording.events.size() - 1, *r.upper_bound - *r.lower_bound, phase_of(last), run});
  std::erase_if(samples, [](const Sample& x) { return !(x.gap > 0) || !std::isfinite(x.gap); });
  return samples;
}

/// The background and the title of a plot; its upper left corner.
ImVec2 plot_frame(const Theme& theme, float width, float height, const char* title) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, {at.x + width, at.y + height}, packed(theme.palette.view), theme.px(6));
  draw->AddText(theme.small, theme.small->FontSize, {at.x + theme.px(10), at.y + theme.px(6)}, packed(theme.palette.text_faint), title);
  ImGui::Dummy({width, height});
  return at;
}

/// The point nearest to the mouse, if that is over the plot: a ring around it, what it is, and a click goes to its step. Call right after the plot is drawn.
struct Pointed {
  ImVec2 mouse = ImGui::GetMousePos(), at{};
  bool over = ImGui::IsItemHovered();
  float nearest = std::numeric_limits<float>::infinity();
  std::size_t step = 0;
  std::string told;

  void take(ImVec2 here, std::size_t of_step, const std::string& what) {
    const float far = std::abs(here.x - mouse.x) + std::abs(here.y - mouse.y) / 8;  // above all along the axis of steps
    if (far < nearest) nearest = far, at = here, step = of_step, told = what;
  }
  void show(App& app) const {
    if (!over || told.empty()) return;
    ImGui::GetWindowDrawList()->AddCircle(at, app.theme.px(5), packed(app.theme.palette.text), 16, app.theme.px(1.5f));
    ImGui::SetTooltip("%s\nstep %zu: click to go there", told.c_str(), step);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) app.session.playing = false, app.session.go_to(step);
  }
};

/// One entry of a plot's key, on the line of its title; where the next one begins.
float key_entry(const Theme& theme, float x, float y, const char* name, Colour colour, bool dashed) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float middle = y + theme.small->FontSize / 2, dash = theme.px(8);
  draw->AddLine({x, middle}, {x + (dashed ? dash : 2.5f * dash), middle}, packed(colour), theme.px(1.6f));
  if (dashed) draw->AddLine({x + 1.5f * dash, middle}, {x + 2.5f * dash, middle}, packed(colour), theme.px(1.6f));
  draw->AddText(theme.small, theme.small->FontSize, {x + 3 * dash, y}, packed(colour), name);
  return x + 3 * dash + theme.small->CalcTextSizeA(theme.small->FontSize, 1e9f, 0, name).x + theme.px(16);
}

/// A piece of a dashed line of which `drawn` pixels have been drawn before; how many it is with it.
float dashed_piece(const Theme& theme, ImVec2 a, ImVec2 b, Colour colour, float drawn) {
  const float length = std::hypot(b.x - a.x, b.y - a.y), dash = theme.px(8), period = 1.5f * dash;
  const auto at = [&](float way) { return ImVec2{a.x + (b.x - a.x) * way / length, a.y + (b.y - a.y) * way / length}; };
  for (float begin = -std::fmod(drawn, period); begin < length; begin += period)
    if (length > 0 && begin + dash > 0) ImGui::GetWindowDrawList()->AddLine(at(std::max(begin, 0.f)), at(std::min(begin + dash, length)), packed(colour), theme.px(1.6f));
  return drawn + length;
}

/// SAT has no bounds that close in, but an axis after another: how far the bodies are apart along each, or overlap.
void axes_plot(App& app, float width, float height) {
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  Session& s = app.session;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 at = plot_frame(theme, width, height, "along each axis");
  key_entry(theme, key_entry(theme, at.x + theme.px(120), at.y + theme.px(6), "gap", p.support, false), at.y + theme.px(6), "overlap", p.chosen, false);
  double low = 0, high = 0;
  for (const Event& event : s.recording().events)
    if (const auto* e = std::get_if<recorded::AxisTested>(&event)) low = std::min(low, e->distance), high = std::max(high, e->distance);
  const ImVec2 from{at.x + theme.px(64), at.y + theme.px(34)}, to{at.x + width - theme.px(14), at.y + height - theme.px(16)};
  const auto y_of = [&](double distance) { return to.y - static_cast<float>((distance - low) / std::max(high - low, 1e-300)) * (to.y - from.y); };
  const auto x_of = [&](std::size_t step) { return from.x + static_cast<float>(step) / static_cast<float>(std::max<std::size_t>(1, s.count() - 1)) * (to.x - from.x); };
  for (const double value : {low, 0.0, high}) {
    if (value != 0 && std::abs(y_of(value) - y_of(0)) < theme.px(10)) continue;
    draw->AddLine({from.x, y_of(value)}, {to.x, y_of(value)}, packed(value == 0 ? p.text_faint : p.field), 1);
    draw->AddText(theme.small, theme.small->FontSize * 0.85f, {at.x + theme.px(8), y_of(value) - theme.px(6)}, packed(p.text_faint), short_number(value).c_str());
  }
  draw->AddLine({x_of(s.step()), from.y}, {x_of(s.step()), to.y}, packed(p.text.with_alpha(0.6)), 1);
  Pointed pointed;
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < s.count(); ++i) {
    const auto* e = std::get_if<recorded::AxisTested>(&s.recording().events[i]);
    if (!e) continue;
    const ImVec2 here{x_of(i), y_of(e->distance)};
    const Colour colour = e->distance > 0 ? p.support : p.chosen;
    const bool better = e->distance > best;
    best = std::max(best, e->distance);
    draw->AddLine({here.x, y_of(0)}, here, packed(colour.with_alpha(better ? 1 : 0.4)), theme.px(2));
    draw->AddCircleFilled(here, theme.px(better ? 4.f : 2.5f), packed(colour.with_alpha(better ? 1 : 0.6)));
    if (pointed.over) pointed.take(here, i, (e->distance > 0 ? "a gap of " : "an overlap of ") + short_number(std::abs(e->distance)) + (better ? ", the best axis so far" : ""));
  }
  pointed.show(app);
}

/// A run of SAT that no GJK follows.
bool only_axes(const std::vector<Event>& events) {
  const auto is_axis = [](const Event& event) { return std::holds_alternative<recorded::AxisTested>(event); };
  const auto is_gjk = [](const Event& event) { return std::holds_alternative<recorded::GjkBegan>(event); };
  return std::count_if(events.begin(), events.end(), is_axis) > 1 && std::none_of(events.begin(), events.end(), is_gjk);
}

/// Why there is nothing that closes in.
const char* why_no_curve(const Recording& recording) {
  switch (recording.settings.name) {
    case MethodName::gjk_boolean: return "Only yes or no is asked: this\nmethod keeps no bounds.";
    case MethodName::closed_form: return "A formula gives the answer at once:\nno bounds close in.";
    case MethodName::projections: return "Only the last support proves the\ndistance: no bounds close in.";
    case MethodName::mpr: return recording.scene.scene.query == Query::intersect ? "Yes or no is all that is asked:\nno bounds close in." : "MPR's ray is through at once:\nno bounds close in.";
    case MethodName::sat: return "One axis is proof enough:\nno bounds close in.";
    default: return "This run is over before bounds\ncould close in.";
  }
}

/// Where many samples fall into one pixel its least and its greatest stand for all.
template <class PlaceOfStep>
std::vector<Sample> thinned(const std::vector<Sample>& all, float pixels, const PlaceOfStep& x_of) {
  if (static_cast<float>(all.size()) <= 2 * pixels) return all;
  std::vector<Sample> kept;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t least = i, most = i, end = i;
    for (const float x = x_of(all[i].step); end < all.size() && x_of(all[end].step) < x + 2; ++end) {
      if (all[end].gap < all[least].gap) least = end;
      if (all[end].gap > all[most].gap) most = end;
    }
    kept.push_back(all[std::min(least, most)]), kept.push_back(all[std::max(least, most)]);
    i = end;
  }
  return kept;
}

/// Gaps over steps, on a logarithmic scale: its range, and what is drawn in it.
class GapPlot {
 public:
  /// `floor`: of rounding, or zero. Gaps are positive; not both lists are empty.
  GapPlot(const Theme& theme, ImVec2 at, ImVec2 size, const std::vector<Sample>& samples, const std::vector<Sample>& others, std::size_t last_step, double floor)
      : theme_(theme), at_(at), from_{at.x + theme.px(52), at.y + theme.px(28)}, to_{at.x + size.x - theme.px(14), at.y + size.y - theme.px(12)},
        last_step_(last_step), low_(floor > 0 ? floor : std::numeric_limits<double>::infinity()), high_(floor) {
    for (const auto* list : {&samples, &others})
      for (const Sample& x : *list) low_ = std::min(low_, x.gap), high_ = std::max(high_, x.gap);
    log_low_ = std::floor(std::log10(low_)) - 1, log_high_ = std::max(log_low_ + 1, std::ceil(std::log10(high_)));
  }

  ImVec2 place(const Sample& x) const { return {x_of(x.step), y_of(std::log10(x.gap))}; }

  void grid() const {
    for (int i = 0; i <= 2; ++i) {
      const double log = std::round(log_low_ + (log_high_ - log_low_) * i / 2);
      char text[16];
      std::snprintf(text, sizeof text, "1e%+d", static_cast<int>(log));
      draw_->AddText(theme_.small, theme_.small->FontSize, {at_.x + theme_.px(10), y_of(log) - theme_.px(7)}, packed(theme_.palette.text_faint), text);
      draw_->AddLine({from_.x, y_of(log)}, {to_.x, y_of(log)}, packed(theme_.palette.field), 1);
    }
  }

  /// A dashed line across, with its name below or above it; nothing where the value is out of range.
  void level(double value, const char* name, Colour colour, bool below) const {
    if (!(value >= low_ * 0.999) || value > high_) return;
    const float y = y_of(std::log10(value)), font = theme_.small->FontSize * 0.85f;
    for (float x = from_.x; x < to_.x; x += theme_.px(8)) draw_->AddLine({x, y}, {std::min(x + theme_.px(4), to_.x), y}, packed(colour), 1);
    const ImVec2 place{from_.x + theme_.px(4), below ? y + 1 : y - theme_.px(13)}, extent = theme_.small->CalcTextSizeA(font, 1e9f, 0, name);
    draw_->AddRectFilled(place, {place.x + extent.x, place.y + extent.y}, packed(theme_.palette.view));  // no grid line through it
    draw_->AddText(theme_.small, font, place, packed(colour), name);
  }

  /// `other`: of the run beside it.
  void curve(const std::vector<Sample>& all, bool other) const {
    const Palette& p = theme_.palette;
    const std::vector<Sample> shown = thinned(all, to_.x - from_.x, [&](std::size_t step) { return x_of(step); });
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const Colour colour = other ? p.text_soft : shown[i].phase == 0 ? p.simplex : p.chosen;
      const ImVec2 here = place(shown[i]);
      if (i > 0 && shown[i - 1].phase == shown[i].phase && shown[i - 1].run == shown[i].run) draw_->AddLine(place(shown[i - 1]), here, packed(colour), theme_.px(other ? 1.2f : 2));
      if (other) draw_->AddCircle(here, theme_.px(3), packed(colour), 12, theme_.px(1.2f));
      else draw_->AddCircleFilled(here, theme_.px(2.5f), packed(colour));
    }
  }

  void cursor(std::size_t step) const { draw_->AddLine({x_of(step), from_.y}, {x_of(step), to_.y}, packed(theme_.palette.text.with_alpha(0.6)), 1); }

 private:
  float x_of(std::size_t step) const { return from_.x + (last_step_ == 0 ? 0 : static_cast<float>(step) / static_cast<float>(last_step_)) * (to_.x - from_.x); }
  float y_of(double log) const { return to_.y - static_cast<float>((log - log_low_) / (log_high_ - log_low_)) * (to_.y - from_.y); }

  const Theme& theme_;
  ImDrawList* draw_ = ImGui::GetWindowDrawList();
  ImVec2 at_, from_, to_;
  std::size_t last_step_;
  double low_, high_, log_low_, log_high_;
};

/// What a moving scene's plot shows: a distance or an energy at a time.
struct TimedValue {
  double time, value;
  int series;  ///< of a cast each pair is one
  std::size_t step;
};
int series_of(const std::array<int, 2>& pair) { return pair[0] * 1000 + pair[1]; }

std::vector<TimedValue> timed_values(const Recording& recording) {
  const bool cast = recording.scene.scene.query == Query::cast;
  std::vector<TimedValue> values;
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    const Event& event = recording.events[i];
    if (const auto* e = std::get_if<recorded::CastAdvanced>(&event); e && cast) values.push_back({e->time, e->distance, series_of(e->pair), i});
    if (const auto* e = std::get_if<recorded::State>(&event); e && !cast) values.push_back({e->time, e->energy, 0, i});
  }
  return values;
}

/// When a cast ends: with the hit, or with the interval.
double end_of_cast(const Recording& recording) {
  const auto* ended = std::get_if<recorded::CastEnded>(&recording.events.back());
  return ended && ended->time > 0 ? ended->time : 1;
}

/// Distances or energies over time: their range, and what is drawn in it.
class TimePlot {
 public:
  /// `cast`: of one, when it ends.
  TimePlot(const Theme& theme, ImVec2 at, ImVec2 size, const std::vector<TimedValue>& values, std::optional<double> cast)
      : theme_(theme), at_(at), from_{at.x + theme.px(64), at.y + theme.px(28)}, to_{at.x + size.x - theme.px(cast ? 14 : 58), at.y + size.y - theme.px(22)},
        low_(cast ? 0 : values[0].value), high_(values[0].value), first_(cast ? 0 : values[0].time), last_(cast.value_or(values[0].time)) {
    for (const TimedValue& x : values) low_ = std::min(low_, x.value), high_ = std::max(high_, x.value), last_ = std::max(last_, x.time);
    if (const double middle = (low_ + high_) / 2; !(high_ - low_ > 1e-6 * std::abs(middle))) {  // what stays is a line, not its rounding drawn large
      const double beside = std::max(1e-12, std::abs(middle) * 1e-3);
      low_ = middle - beside, high_ = middle + beside;
    }
  }

  ImVec2 place(const TimedValue& x) const { return {x_of(x.time), y_of(x.value)}; }

  void axes() const {
    const Palette& p = theme_.palette;
    const float font = theme_.small->FontSize * 0.85f;
    for (const double value : {low_, high_}) {
      draw_->AddLine({from_.x, y_of(value)}, {to_.x, y_of(value)}, packed(p.field), 1);
      draw_->AddText(theme_.small, font, {at_.x + theme_.px(8), y_of(value) - theme_.px(6)}, packed(p.text_faint), short_number(value).c_str());
    }
    draw_->AddText(theme_.small, font, {from_.x, to_.y + theme_.px(4)}, packed(p.text_faint), ("t " + short_number(first_)).c_str());
    const std::string end = short_number(last_);
    draw_->AddText(theme_.small, font, {to_.x - theme_.px(7) * static_cast<float>(end.size()), to_.y + theme_.px(4)}, packed(p.text_faint), end.c_str());
  }

  /// A line through each series, the one looked at before all others in colour; `dots`: at each value.
  void curves(const std::vector<TimedValue>& values, int looked_at, bool dots) const {
    std::map<int, ImVec2> before;
    for (const TimedValue& x : values) {
      const ImVec2 here = place(x);
      const Colour colour = x.series == looked_at ? theme_.palette.simplex : theme_.palette.dropped;
      if (const auto found = before.find(x.series); found != before.end() && here.x >= found->second.x) draw_->AddLine(found->second, here, packed(colour), theme_.px(1.6f));
      if (dots) draw_->AddCircleFilled(here, theme_.px(2.5f), packed(colour));
      before[x.series] = here;
    }
  }

  /// The length of the momentum, from 0 to its greatest, which stands at the right.
  void momentum(const std::vector<Event>& events) const {
    const Colour colour = theme_.palette.text_soft;
    double most = 0;
    for (const Event& event : events)
      if (const auto* e = std::get_if<recorded::State>(&event)) most = std::max(most, e->momentum.norm());
    if (!(most > 0)) return;
    for (const auto& [value, y] : {std::pair(most, from_.y), {0.0, to_.y}})
      draw_->AddText(theme_.small, theme_.small->FontSize * 0.85f, {to_.x + theme_.px(6), y - theme_.px(6)}, packed(colour), short_number(value).c_str());
    std::optional<ImVec2> before;
    float drawn = 0;
    for (const Event& event : events)
      if (const auto* e = std::get_if<recorded::State>(&event)) {
        const ImVec2 here{x_of(e->time), to_.y - static_cast<float>(e->momentum.norm() / most) * (to_.y - from_.y)};
        if (before) drawn = dashed_piece(theme_, *before, here, colour, drawn);
        before = here;
      }
  }

  void cursor(double time) const { draw_->AddLine({x_of(time), from_.y}, {x_of(time), to_.y}, packed(theme_.palette.text.with_alpha(0.6)), 1); }

 private:
  float x_of(double time) const { return from_.x + static_cast<float>((time - first_) / std::max(last_ - first_, 1e-300)) * (to_.x - from_.x); }
  float y_of(double value) const { return to_.y - static_cast<float>((value - low_) / (high_ - low_)) * (to_.y - from_.y); }

  const Theme& theme_;
  ImDrawList* draw_ = ImGui::GetWindowDrawList();
  ImVec2 at_, from_, to_;
  double low_, high_, first_, last_;
};

void soft_note(const Theme& theme, ImVec2 at, const std::string& text) {
  ImGui::GetWindowDrawList()->AddText(theme.small, theme.small->FontSize, {at.x + theme.px(12), at.y + theme.px(32)}, packed(theme.palette.text_soft), text.c_str());
}

}  // namespace

/// The gap between the bounds, event by event, on a logarithmic scale: the certificate closing in on the tolerance, down to the floor
/// below which nothing can be told. With another run beside it, that one's too.
void bounds_plot(App& app, float width, float height) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  const std::vector<Sample> samples = samples_of(s.recording()), others = s.comparing() ? samples_of(s.other()) : std::vector<Sample>();
  if (others.size() <= 1 && only_axes(s.recording().events)) return axes_plot(app, width, height);
  const ImVec2 at = plot_frame(theme, width, height, "gap between the bounds, log scale");
  if (s.comparing() && width > theme.px(310)) key_entry(theme, at.x + theme.px(232), at.y + theme.px(6), "beside", p.text_soft, false);
  if (samples.size() <= 1 && others.empty()) {
    const std::string why = foreign(s.recording()) ? "This run tells no bounds." : why_no_curve(s.recording());
    return soft_note(theme, at, why + (samples.empty() ? "" : " At its end they are\n" + short_number(samples[0].gap) + " apart."));
  }
  const Settings& settings = s.recording().settings;
  const double size = std::abs(s.recording().result.signed_distance.value_or(0)), tolerance = std::max(settings.tolerance * size, 0.0);
  const double floor = s.scene().scene.bodies.size() < 2 ? 0 : 2 * rounding_floor(s.scene().scene, settings);  // points know no rounding, their radii do
  const std::size_t last = std::max(s.count(), s.comparing() ? s.other().events.size() : 0) - 1;
  const GapPlot plot(theme, at, {width, height}, samples, others, last, floor);
  plot.grid();
  plot.level(floor, "rounding floor", p.dropped, true);
  if (tolerance > 1.5 * floor) plot.level(tolerance, "tolerance", p.support, false);
  plot.curve(others, true);
  plot.curve(samples, false);
  plot.cursor(s.step());
  if (Pointed pointed; pointed.over) {
    for (const Sample& x : samples) pointed.take(plot.place(x), x.step, "the bounds are " + short_number(x.gap) + " apart");
    pointed.show(app);
  }
}

/// A moving scene: over time, the distance of the pair looked at (cast), or the energy (simulate).
void motion_plot(App& app, float width, float height) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  const bool cast = s.scene().scene.query == Query::cast;
  const ImVec2 at = plot_frame(theme, width, height, cast ? "distance over time, each advance" : "over time");
  if (!cast) {
    const float y = at.y + theme.px(6), momentum = key_entry(theme, at.x + theme.px(84), y, "energy", p.simplex, false);
    key_entry(theme, momentum, y, width < theme.px(310) ? "momentum" : "momentum, at the right", p.text_soft, true);
  }
  const std::vector<TimedValue> values = timed_values(s.recording());
  if (values.empty())
    return soft_note(theme, at, s.recording().result.intersecting && cast ? "They overlap at the beginning:\nthere is nothing to advance to." : "Nothing has moved.");
  const TimePlot plot(theme, at, {width, height}, values, cast ? std::optional(end_of_cast(s.recording())) : std::nullopt);
  plot.axes();
  plot.curves(values, cast ? series_of(s.frame().pair) : 0, cast);
  if (!cast) plot.momentum(s.recording().events);
  if (s.frame().time) plot.cursor(*s.frame().time);
  if (Pointed pointed; pointed.over) {
    for (const TimedValue& x : values) pointed.take(plot.place(x), x.step, "time " + short_number(x.time) + (cast ? ", distance " : ", energy ") + short_number(x.value));
    pointed.show(app);
  }
}

}  // namespace gjkdbg
