// A plot: a frame with two axes, even or logarithmic, and where its points stand.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "debugger/view/app.h"

namespace gjkdbg {

std::string formatted(double x, const char* format = "%.2g");
void small_text(const Theme& theme, ImVec2 at, Colour colour, const std::string& text);
float small_width(const Theme& theme, const std::string& text);

struct PlotAxis {
  double low = 0, high = 1;
  bool logarithmic = false;
  std::vector<std::pair<double, std::string>> names;  ///< where lines are drawn, and what stands there

  /// From 0 at `low` to 1 at `high`; what lies beyond, there.
  float share(double x) const;
};

inline constexpr double drawn_as_nothing = 1e-17;  ///< where an error of zero stands
PlotAxis error_axis();
/// Whole decades of nanoseconds around what there is.
PlotAxis time_axis(const std::vector<double>& nanoseconds);
/// From zero up.
PlotAxis count_axis(double most);
/// Names one after the other, equally far apart, at 0, 1, 2, …
PlotAxis named_axis(const std::vector<std::string>& names);

class Plot {
 public:
  /// Draws the frame. `note` stands on the right of the title where there is room.
  Plot(const Theme& theme, ImVec2 at, ImVec2 size, const std::string& title, const std::string& note, PlotAxis x, PlotAxis y);
  ImVec2 place(double x, double y) const { return {from_.x + x_.share(x) * (to_.x - from_.x), to_.y - y_.share(y) * (to_.y - from_.y)}; }

 private:
  PlotAxis x_, y_;
  ImVec2 from_, to_;
};

/// What is shown of a measured chart, in this area.
void chart_area(App& app, ImVec2 at, ImVec2 size);
/// Where nothing has been measured: what a chart, or an atlas, will show, and how to get it.
void unmeasured(App& app, bool chart, ImVec2 at, ImVec2 size);
/// A verdict's square with its mark.
void verdict_mark(const Theme& theme, int verdict, ImVec2 low, ImVec2 high);
/// What it is, in a sentence.
const char* told_of(App::ChartView view);
/// Opens a scene in place of the measurements, at the first step that `check` finds wrong, else at the end.
void open_measured(App& app, SceneFile scene, const std::string& title);

}  // namespace gjkdbg
