// Speed against accuracy: every method at every tolerance on the same pairs in one run.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
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
  bool error_known = false;                               ///< whether worst_error means anything: the query asks for distance and depth
};

/// GJK's steps by distance, as in Montaut et al. 2024, table III a, and its time on hulls, as in Montaut et al. 2022, table I.
struct LadderPoint {
  std::string shapes, method;
  double distance = 0;
  double mean = 0, deviation = 0;  ///< of the iterations
  double nanoseconds = 0;          ///< a query
  int vertices = 0;                ///< of a hull; 0: ellipsoids
  std::optional<std::array<double, 2>> published;  ///< iterations of this category there: mean and deviation
  std::optional<double> published_nanoseconds;     ///< of hulls of so many vertices there (others, -0.1 to 0.1 apart, on an Apple M1 Max)
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

std::string number_text(double x, const char* format = "%.6g");
std::string chart_csv(const Chart& chart);
std::string chart_json(const Chart& chart);
/// Commands for gnuplot that draw a picture with the given terminal into `file`.
using Drawing = std::string (*)(const Chart& chart, const std::string& terminal, const std::string& file);
struct ChartPicture {
  const char* name;  ///< the file's stem
  int width, height;
  bool (*has_something)(const Chart& chart);
  Drawing drawing;
};
/// What a chart is drawn as: time against the error; against the certified gap, what it takes to be sure; steps by distance; the price of modelling too
/// much; motion.
std::span<const ChartPicture> chart_pictures();

/// Pipes commands through gnuplot. False when it is not installed or fails.
bool run_gnuplot(const std::string& commands);

}  // namespace gjkdbg
