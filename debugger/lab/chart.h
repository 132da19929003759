// Speed against accuracy: every method at every tolerance on the same pairs in one run.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "debugger/lab/families.h"
#include "debugger/lab/measure.h"
#include "debugger/lab/motion_chart.h"

namespace gjkdbg {

/// A method at a tolerance on a family.
struct ChartPoint {
  std::string variant;
  double tolerance = 0;
  double nanoseconds = 0;   ///< a query: median over the rounds
  double worst_error = 0;   ///< outside the certified interval, relative to the size
  double median_error = 0;
  double worst_gap = 0;     ///< of the method's own bounds, relative; of another library, which has none: unset (0)
  double median_gap = 0;
  double iterations = 0;    ///< mean
  int wrong = 0;            ///< answers with the wrong class or off by more than 1e-3
  bool front = false;       ///< nothing is both faster and more accurate
  int worst = 0;            ///< the pair with the largest error, of those a method answers
};

struct ChartPanel {
  std::string name, title;
  int pairs = 0;
  std::vector<ChartPoint> points;
  std::vector<Scene> scenes;
};

struct PricePoint {
  std::string what;
  double nanoseconds = 0, worst_error = 0, supports = 0;  ///< error against what was meant: the sphere, the rectangle
};

/// Mean and standard deviation of GJK's iterations by distance, as in Montaut et al. 2024, table III a.
struct LadderPoint {
  std::string shapes, method;
  double distance = 0, mean = 0, deviation = 0;
  std::string published;  ///< for this category there; empty: not published
};

struct Chart {
  std::vector<Variant> methods;
  std::vector<ChartPanel> panels;
  std::vector<PricePoint> price;
  std::vector<MotionPoint> motion;
  std::vector<LadderPoint> ladder;
};

struct ChartOptions {
  bool quick = false;
  std::vector<std::string> families, methods;  ///< by name; none: the usual ones
};

/// `progress(share done)` returns false to stop: what was measured until then is returned.
Chart make_chart(const ChartOptions& options, const std::function<bool(double)>& progress);

std::string chart_csv(const Chart& chart);
std::string chart_json(const Chart& chart);
/// Commands for gnuplot that draw the chart with the given terminal into `file`.
std::string chart_gnuplot(const Chart& chart, const std::string& terminal, const std::string& file);
/// The same with the certified gap in place of the error: what it takes to be sure.
std::string gap_gnuplot(const Chart& chart, const std::string& terminal, const std::string& file);

/// Pipes commands through gnuplot. False when it is not installed or fails.
bool run_gnuplot(const std::string& commands);

}  // namespace gjkdbg
