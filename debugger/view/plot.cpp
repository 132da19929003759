#include "debugger/view/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gjkdbg {

std::string formatted(double x, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

void small_text(const Theme& theme, ImVec2 at, Colour colour, const std::string& text) {
  ImGui::GetWindowDrawList()->AddText(theme.small, theme.small->FontSize, at, packed(colour), text.c_str());
}
float small_width(const Theme& theme, const std::string& text) { return theme.small->CalcTextSizeA(theme.small->FontSize, FLT_MAX, 0, text.c_str()).x; }

float PlotAxis::share(double x) const {
  const double inside = std::clamp(x, low, high);
  return static_cast<float>(logarithmic ? std::log(inside / low) / std::log(high / low) : (inside - low) / (high - low));
}

PlotAxis error_axis() { return {drawn_as_nothing / 3, 1, true, {{drawn_as_nothing, "none"}, {1e-12, "1e-12"}, {1e-8, "1e-8"}, {1e-4, "1e-4"}, {1, "1"}}}; }

PlotAxis time_axis(const std::vector<double>& nanoseconds) {
  double low = 1e300, high = 0;
  for (const double t : nanoseconds) low = std::min(low, t), high = std::max(high, t);
  const double first = std::floor(std::log10(low)), last = std::max(first + 1, std::ceil(std::log10(std::max(high, 1.0))));
  PlotAxis axis{std::pow(10, first), std::pow(10, last), true, {}};
  for (double t = first; t <= last; ++t)
    axis.names.emplace_back(std::pow(10, t), t < 3 ? formatted(std::pow(10, t), "%.0f ns") : t < 6 ? formatted(std::pow(10, t - 3), "%.0f \xC2\xB5s") : formatted(std::pow(10, t - 6), "%.0f ms"));
  return axis;
}

PlotAxis count_axis(double most) {
  const double step = most > 40 ? 20 : most > 12 ? 5 : most > 5 ? 2 : 1;
  PlotAxis axis{0, std::max(step, std::ceil(most / step) * step), false, {}};
  for (double n = 0; n <= axis.high; n += step) axis.names.emplace_back(n, formatted(n, "%.0f"));
  return axis;
}

PlotAxis named_axis(const std::vector<std::string>& names) {
  PlotAxis axis{-0.5, std::max(0.5, static_cast<double>(names.size()) - 0.5), false, {}};
  for (std::size_t i = 0; i < names.size(); ++i) axis.names.emplace_back(i, names[i]);
  return axis;
}

Plot::Plot(const Theme& theme, ImVec2 at, ImVec2 size, const std::string& title, const std::string& note, PlotAxis x, PlotAxis y)
    : x_(std::move(x)), y_(std::move(y)), from_(at.x + theme.px(46), at.y + theme.px(34)), to_(at.x + size.x - theme.px(14), at.y + size.y - theme.px(24)) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const Palette& p = theme.palette;
  list->AddRectFilled(at, {at.x + size.x, at.y + size.y}, packed(p.view), theme.px(6));
  const std::string heading = shortened(theme.small, title, size.x - theme.px(20));
  small_text(theme, {at.x + theme.px(10), at.y + theme.px(6)}, p.text, heading);
  if (small_width(theme, note) < size.x - small_width(theme, heading) - theme.px(40)) small_text(theme, {to_.x - small_width(theme, note), at.y + theme.px(6)}, p.text_faint, note);
  for (const auto& [value, name] : x_.names) {
    const float here = place(value, y_.low).x;
    list->AddLine({here, from_.y}, {here, to_.y}, packed(p.field), 1);
    small_text(theme, {here - small_width(theme, name) / 2, to_.y + theme.px(4)}, p.text_faint, name);
  }
  for (const auto& [value, name] : y_.names) {
    const float here = place(x_.low, value).y;
    list->AddLine({from_.x, here}, {to_.x, here}, packed(p.field), 1);
    small_text(theme, {from_.x - small_width(theme, name) - theme.px(4), here - theme.px(7)}, p.text_faint, name);
  }
}

}  // namespace gjkdbg
