// Charts on paper: commands for gnuplot.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "debugger/lab/chart.h"
#include "debugger/lab/gnuplot.h"

namespace gjkdbg {
namespace {

constexpr double smallest_drawn = 1e-17;  ///< what zero is drawn at

struct Style {
  const char* colour;
  bool dashed = false;
};

struct Dot {
  double x, y, deviation = 0;
};

/// One line of a panel: drawn with deviations where it has some.
struct Curve {
  std::string name;  ///< in the legend
  Style style;
  std::vector<Dot> dots;
  enum class Drawn { line, line_and_deviations, squares, rings } drawn = Drawn::line;
};

/// The method whose scalar is left out.
std::string in_double(const std::string& method) { return method.substr(0, method.rfind(", float")); }

/// A colour a method: the scalar is told by the dash. Colour-blind safe (Okabe and Ito), peers in greys.
Style style_of(const std::string& method) {
  static constexpr std::pair<const char*, const char*> colours[] = {
      {"signed volumes", "#0072B2"}, {"Johnson", "#D55E00"}, {"Voronoi regions", "#009E73"}, {"accelerated", "#CC79A7"}, {"Polyak", "#E69F00"},     {"Newton", "#882255"}, {"smoothed", "#117733"},
      {"MPR", "#56B4E9"},            {"SAT", "#B8A800"},     {"closed form", "#7B3294"},     {"projections", "#B2182B"}, {"fastest", "#6BBF00"}, {"rule of", "#8A6D3B"}, {"Bullet", "#222222"},     {"FCL", "#555555"},
      {"libccd GJK", "#777777"},     {"libccd MPR", "#999999"}, {"ODE", "#BBBBBB"},          {"Box2D", "#8C8450"},       {"plain", "#0072B2"},      {"Nesterov", "#CC79A7"},
      {"conservative-advancement", "#0072B2"}, {"root-finding", "#009E73"}, {"ray-cast", "#D55E00"}, {"explicit-euler", "#999999"}, {"semi-implicit-euler", "#E69F00"}, {"rk4", "#882255"}};
  const char* colour = "#000000";
  for (const auto& [name, value] : colours)
    if (method.starts_with(name)) colour = value;
  return {colour, method != in_double(method)};
}

/// A page of panels in rows, a title with a note above them, a legend below.
///
///   title
///   note
///   +-------+ +-------+ +-------+
///   | panel | |       | |       |        the names of the axes stand where the first column and the last row are
///   +-------+ +-------+ +-------+
///   -o- method   -o- method   …
class Page {
 public:
  Page(const std::string& terminal, const std::string& file, const ChartPicture& size, std::size_t panels, std::size_t most_columns)
      : width_(size.width), height_(size.height), columns_(std::clamp<std::size_t>(panels, 1, most_columns)), rows_(std::max<std::size_t>(1, (panels + columns_ - 1) / columns_)), panels_(panels) {
    out_ = "set encoding utf8\nset micro\nset terminal " + terminal + "\nset output " + quoted_for_gnuplot(file) +
           "\nset multiplot\nset border 3 lc rgb '#8a93a0'\nset tics nomirror scale 0.5 textcolor rgb '#30363f' font ',10'\nset grid lc rgb '#e3e7ec' lt 1\nset mxtics 1\nset mytics 1\nunset key\nset bars 0.4\n";
  }

  void title(const std::string& text, const std::string& note) {
    out_ += "set label 1 " + quoted_for_gnuplot(text) + " at screen " + at(24, 24) + title_look + "\nset label 2 " + quoted_for_gnuplot(note) + " at screen " + at(24, 50) + note_look + "\n";
  }
  void tell(const std::string& command) { out_ += command + "\n"; }

  /// The next panel. `x`, `y`: what its axes are, told at the edge of the page only.
  void panel(const std::string& name, const std::string& x, const std::string& y, const std::vector<Curve>& curves) {
    const std::size_t column = count_ % columns_, row = count_ / columns_;
    const double left = left_margin + static_cast<double>(column) * (panel_width() + across), top = head + static_cast<double>(row) * (panel_height() + below);
    out_ += "set lmargin at screen " + share(left, width_) + "\nset rmargin at screen " + share(left + panel_width(), width_) + "\nset tmargin at screen " + share(height_ - top, height_) + "\nset bmargin at screen " +
            share(height_ - top - panel_height(), height_) + "\n";
    out_ += "set label 3 " + quoted_for_gnuplot(name) + " at screen " + at(left, top - 14) + " font ',11' textcolor rgb '#14171d'\n";
    const bool last_in_column = count_ + columns_ >= panels_;
    out_ += last_in_column ? "set xlabel " + quoted_for_gnuplot(x) + " font ',10' textcolor rgb '#5a6472'\n" : "unset xlabel\n";
    out_ += column == 0 ? "set ylabel " + quoted_for_gnuplot(y) + " font ',10' textcolor rgb '#5a6472'\n" : "unset ylabel\n";
    plot(curves);
    if (count_++ == 0) out_ += "unset label 1\nunset label 2\n";
    for (const Curve& curve : curves)
      if (std::none_of(told_.begin(), told_.end(), [&](const Curve& c) { return c.name == curve.name; })) told_.push_back({curve.name, curve.style, {}, curve.drawn});
  }

  /// With the legend of all that was drawn.
  std::string finish() {
    double x = left_margin, y = height_ - foot + 76;
    out_ += "set lmargin at screen 0\nset rmargin at screen 1\nset tmargin at screen 1\nset bmargin at screen 0\nunset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\nunset label 3\nunset logscale\n";
    int mark = 10;
    std::stable_partition(told_.begin(), told_.end(), [](const Curve& curve) { return curve.drawn != Curve::Drawn::rings; });  // what is said of all of them comes last
    for (const Curve& curve : told_) {
      const double room = 58 + 6.9 * static_cast<double>(curve.name.size());
      if (x + room > width_ - 10) x = left_margin, y += 22;
      const std::string colour = std::string(" lc rgb ") + quoted_for_gnuplot(curve.style.colour);
      if (curve.drawn == Curve::Drawn::line || curve.drawn == Curve::Drawn::line_and_deviations)
        out_ += "set arrow " + std::to_string(mark) + " from screen " + at(x, y) + " to screen " + at(x + 26, y) + " nohead lw 1.6" + colour + (curve.style.dashed ? " dt 2" : "") + "\n";
      out_ += "set label " + std::to_string(mark) + " '' at screen " + at(x + 13, y) + " point" + point_of(curve) + colour + "\n";
      out_ += "set label " + std::to_string(mark + 100) + " " + quoted_for_gnuplot(curve.name) + " at screen " + at(x + 34, y) + " left font ',10' textcolor rgb '#30363f'\n";
      ++mark, x += room;
    }
    out_ += "set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle\nunset multiplot\n";
    return std::move(out_);
  }

 private:
  static constexpr double left_margin = 92, right_margin = 28, head = 100, foot = 128, across = 66, below = 62;

  double panel_width() const { return (width_ - left_margin - right_margin - across * static_cast<double>(columns_ - 1)) / static_cast<double>(columns_); }
  double panel_height() const { return (height_ - head - foot - below * static_cast<double>(rows_ - 1)) / static_cast<double>(rows_); }
  static std::string share(double pixels, double whole) { return number_text(pixels / whole); }
  std::string at(double x, double y) const { return share(x, width_) + "," + share(height_ - y, height_); }
  static std::string point_of(const Curve& curve) {
    return curve.drawn == Curve::Drawn::squares ? " pt 4 ps 1.1 lw 1.4" : curve.drawn == Curve::Drawn::rings ? " pt 6 ps 1.3" : curve.style.dashed ? " pt 7 ps 0.35" : " pt 7 ps 0.6";
  }

  void plot(const std::vector<Curve>& curves) {
    std::string command = "plot ", data;
    for (const Curve& curve : curves) {
      if (curve.dots.empty()) continue;
      const bool deviations = curve.drawn == Curve::Drawn::line_and_deviations || (curve.drawn == Curve::Drawn::squares && curve.dots.front().deviation > 0);
      const bool points = curve.drawn == Curve::Drawn::squares || curve.drawn == Curve::Drawn::rings;
      const std::string colour = std::string(" lc rgb ") + quoted_for_gnuplot(curve.style.colour) + (curve.style.dashed ? " dt 2" : "");
      if (deviations) command += "'-' using 1:2:3 with yerrorbars pt 0 lw 0.8" + colour + ", ";
      command += std::string("'-' using 1:2 with ") + (points ? "points" : "linespoints lw 1.4") + point_of(curve) + colour + ", ";
      for (int times = deviations ? 2 : 1; times > 0; --times) {
        for (const Dot& d : curve.dots) data += number_text(d.x) + " " + number_text(d.y) + " " + number_text(d.deviation) + "\n";
        data += "e\n";
      }
    }
    out_ += data.empty() ? "plot NaN notitle\n" : command.substr(0, command.size() - 2) + "\n" + data;
  }

  double width_, height_;
  std::size_t columns_, rows_, panels_, count_ = 0;
  std::vector<Curve> told_;
  std::string out_;
};

/// The curves of some points by method, in the order they come.
template <class Point, class Place>
std::vector<Curve> curves_of(const std::vector<Point>& points, std::string Point::*method, const Place& place) {
  std::vector<Curve> out;
  std::string last;
  for (const Point& p : points) {
    const std::optional<Dot> dot = place(p);
    if (!dot) continue;
    if (out.empty() || last != p.*method) out.push_back({in_double(p.*method), style_of(p.*method), {}}), last = p.*method;
    out.back().dots.push_back(*dot);
  }
  return out;
}

/// Errors to the right, times up, both logarithmic.
std::string errors_and_times() {
  return "set logscale xy\nset format y '%.0s %cs'\nset xrange [4e-18:2]\nset xtics ('none' 1e-17, '10^{-12}' 1e-12, '10^{-8}' 1e-8, '10^{-4}' 1e-4, '1' 1)";
}

/// Families of pairs, a panel each: nanoseconds over what `x` is, both logarithmic.
std::string families(const Chart& chart, const ChartPicture& picture, const std::string& terminal, const std::string& file, const std::string& title, const std::string& note, const std::string& axis,
                     double (*x)(const ChartPoint&), bool front) {
  const auto drawn = [&](const ChartPanel& panel) { return std::any_of(panel.points.begin(), panel.points.end(), [&](const ChartPoint& p) { return x(p) >= 0; }); };
  Page page(terminal, file, picture, static_cast<std::size_t>(std::count_if(chart.panels.begin(), chart.panels.end(), drawn)), 3);
  page.title(title, note);
  page.tell(errors_and_times());
  for (const ChartPanel& panel : chart.panels) {
    if (!drawn(panel)) continue;
    const auto dot = [&](const ChartPoint& p) -> std::optional<Dot> { return x(p) < 0 ? std::nullopt : std::optional(Dot{std::max(x(p), smallest_drawn), p.nanoseconds * 1e-9}); };
    std::vector<Curve> curves = curves_of(panel.points, &ChartPoint::variant, dot);
    Curve best{"the front: nothing is both faster and more accurate", {"#000000"}, {}, Curve::Drawn::rings};
    for (const ChartPoint& p : panel.points)
      if (front && p.front) best.dots.push_back(*dot(p));
    if (front) curves.push_back(std::move(best));
    page.panel(panel.title, axis, "time a query", curves);
  }
  return page.finish();
}

std::string error_picture(const Chart& chart, const std::string& terminal, const std::string& file);
std::string gap_picture(const Chart& chart, const std::string& terminal, const std::string& file);
std::string ladder_picture(const Chart& chart, const std::string& terminal, const std::string& file);
std::string price_picture(const Chart& chart, const std::string& terminal, const std::string& file);
std::string motion_picture(const Chart& chart, const std::string& terminal, const std::string& file);

double error_of(const ChartPoint& p) { return p.worst_error; }
double gap_of(const ChartPoint& p) { return p.worst_gap > 0 ? p.median_gap : -1; }  ///< of the certified bounds; other libraries have none

template <double (*x)(const ChartPoint&)>
bool has_dots(const Chart& chart) {
  return std::any_of(chart.panels.begin(), chart.panels.end(), [](const ChartPanel& panel) { return std::any_of(panel.points.begin(), panel.points.end(), [](const ChartPoint& p) { return x(p) >= 0; }); });
}

constexpr ChartPicture pictures[] = {{"chart", 1400, 1100, has_dots<error_of>, error_picture},
                                     {"gap", 1400, 1100, has_dots<gap_of>, gap_picture},
                                     {"ladder", 1400, 560, [](const Chart& c) { return !c.ladder.empty() && c.ladder.back().vertices > 0; }, ladder_picture},
                                     {"price", 1400, 560, [](const Chart& c) { return !c.price.empty(); }, price_picture},
                                     {"motion", 1400, 520, [](const Chart& c) { return !c.motion.empty(); }, motion_picture}};

std::string error_picture(const Chart& chart, const std::string& terminal, const std::string& file) {
  return families(chart, pictures[0], terminal, file, "Speed against accuracy", "The time of a query over the worst error outside the certified bounds, a dot a tolerance. Left and low is good. Dashed: single precision; greys: other libraries.",
                  "worst error, of the size", error_of, true);
}

std::string gap_picture(const Chart& chart, const std::string& terminal, const std::string& file) {
  return families(chart, pictures[1], terminal, file, "What it takes to be sure", "The time of a query over the gap between its certified bounds (the median), a dot a tolerance. Other libraries have no bounds. Dashed: single precision.",
                  "gap between the bounds, of the size", gap_of, false);
}

/// Iterations on ellipsoids by distance, beside those published; on hulls by their vertices, and the time, beside the published one.
std::string ladder_picture(const Chart& chart, const std::string& terminal, const std::string& file) {
  Page page(terminal, file, pictures[2], 3, 3);
  page.title("Iterations by distance", "Means, with one standard deviation, at a duality gap of 1e-8. Squares: published in Montaut et al. 2024, table III, and (time; hulls -0.1 to 0.1 apart, on another machine) 2022, table I.");
  std::vector<double> distances;
  std::string tics;
  for (const LadderPoint& p : chart.ladder)
    if (p.vertices == 0 && std::find(distances.begin(), distances.end(), p.distance) == distances.end()) {
      tics += (tics.empty() ? "" : ", ") + quoted_for_gnuplot(number_text(p.distance)) + " " + std::to_string(distances.size());
      distances.push_back(p.distance);
    }
  const auto rung = [&](const LadderPoint& p) { return static_cast<double>(std::find(distances.begin(), distances.end(), p.distance) - distances.begin()); };
  const std::vector<std::string> ways{"plain", "Nesterov", "Polyak", "Newton", "smoothed"};
  std::vector<Curve> ellipsoids, hulls, times;
  for (std::size_t way = 0; way < ways.size(); ++way) {
    Curve curve{ways[way], style_of(ways[way]), {}, Curve::Drawn::line_and_deviations}, published{ways[way] + ", published", style_of(ways[way]), {}, Curve::Drawn::squares};
    Curve near{ways[way], style_of(ways[way]), {}, Curve::Drawn::line_and_deviations}, far{ways[way] + ", 1 apart", {near.style.colour, true}, {}}, near_time{ways[way], near.style, {}}, far_time = far, published_time = published;
    const double aside = 0.05 * (static_cast<double>(way) - 2);
    for (const LadderPoint& p : chart.ladder) {
      if (p.method != ways[way]) continue;
      if (p.vertices == 0) {
        curve.dots.push_back({rung(p) + aside, p.mean, p.deviation});
        if (p.published) published.dots.push_back({rung(p) + aside + 0.1, (*p.published)[0], (*p.published)[1]});
        continue;
      }
      const double vertices = p.vertices * std::pow(1.2, aside);
      (p.distance < 0.1 ? near : far).dots.push_back({vertices, p.mean, p.deviation});
      (p.distance < 0.1 ? near_time : far_time).dots.push_back({static_cast<double>(p.vertices), p.nanoseconds * 1e-9});
      if (p.published_nanoseconds) published_time.dots.push_back({static_cast<double>(p.vertices), *p.published_nanoseconds * 1e-9});
    }
    for (Curve* c : {&curve, &published})
      if (!c->dots.empty()) ellipsoids.push_back(*c);
    for (Curve* c : {&near, &far}) hulls.push_back(*c);
    for (Curve* c : {&near_time, &far_time, &published_time})
      if (!c->dots.empty()) times.push_back(*c);
  }
  page.tell("set xrange [-0.5:" + number_text(static_cast<double>(distances.size()) - 0.5) + "]\nset xtics (" + tics + ")\nset yrange [0:*]");
  page.panel("ellipsoids with radii of mean 0.1: iterations", "distance (below zero: deep)", "iterations", ellipsoids);
  page.tell("set logscale x\nset xrange [25:3300]\nset xtics (33, 141, 626, 2500)");
  page.panel("hulls around the unit sphere, 0.001 and 1 apart: iterations", "vertices of each hull", "", hulls);
  page.tell("set logscale xy\nset yrange [1e-7:1e-5]\nset format y '%.0s %cs'");
  page.panel("the same: time a query", "vertices of each hull", "", times);
  return page.finish();
}

/// Bars: what was modelled, and what it costs.
std::string price_picture(const Chart& chart, const std::string& terminal, const std::string& file) {
  const double width = pictures[3].width, height = pictures[3].height;
  std::string out = "set encoding utf8\nset micro\nset terminal " + terminal + "\nset output " + quoted_for_gnuplot(file) + "\nunset key\nset border 1 lc rgb '#8a93a0'\nset tics nomirror scale 0.5 textcolor rgb '#30363f' font ',11'\n";
  out += "set label 1 'The price of modelling too much' at screen " + number_text(24 / width) + "," + number_text(1 - 24 / height) + " font ',15' textcolor rgb '#14171d'\n";
  out += "set label 2 'The same pairs, modelled as they need and as they do not: time a query, supports asked for, and the worst error against what was meant.' at screen " + number_text(24 / width) + "," + number_text(1 - 50 / height) + " font ',10' textcolor rgb '#5a6472'\n";
  out += "set lmargin at screen 0.24\nset rmargin at screen 0.80\nset tmargin at screen " + number_text(1 - 76 / height) + "\nset bmargin at screen " + number_text(60 / height) + "\nset format x '%g ns'\nset grid xtics lc rgb '#e3e7ec' lt 1\nset xrange [0:*]\nset xtics add ('0' 0)\nset style fill solid noborder\n";
  std::string tics, data;
  const auto rows = static_cast<int>(chart.price.size());
  for (int i = 0; i < rows; ++i) {
    const PricePoint& p = chart.price[static_cast<std::size_t>(i)];
    tics += (i > 0 ? ", " : "") + quoted_for_gnuplot(p.what) + " " + std::to_string(-i);
    const std::string error = p.error_known ? (p.worst_error > 0 ? "error " + number_text(p.worst_error, "%.2g") : "no error") : "";
    out += "set label " + std::to_string(i + 10) + " " + quoted_for_gnuplot("  " + number_text(p.nanoseconds, "%.0f") + " ns, " + number_text(p.supports, "%.1f") + " supports" + (error.empty() ? "" : ", " + error)) + " at " + number_text(p.nanoseconds) + "," +
           std::to_string(-i) + " font ',10' textcolor rgb '#30363f'\n";
    const bool spheres = p.what.find("hulls") != std::string::npos || p.what.starts_with("spheres"), flat = p.what.find("2D") != std::string::npos || p.what.find("slabs") != std::string::npos;
    data += "0 " + std::to_string(-i) + " 0 " + number_text(p.nanoseconds) + " " + number_text(-i - 0.33) + " " + number_text(-i + 0.33) + (spheres ? " 0x4C9BE8" : flat ? " 0xE8A33D" : " 0x2FBF8F") + "\n";
  }
  out += "set yrange [" + number_text(-rows + 0.4) + ":0.6]\nset ytics scale 0 (" + tics + ")\n";
  return out + "plot '-' using 1:2:3:4:5:6:7 with boxxyerror lc rgb variable\n" + data + "e\n";
}

/// Casts by their tolerance, integrators by their step.
std::string motion_picture(const Chart& chart, const std::string& terminal, const std::string& file) {
  std::vector<std::string> names;
  for (const MotionPoint& p : chart.motion)
    if (std::find(names.begin(), names.end(), p.family) == names.end()) names.push_back(p.family);
  Page page(terminal, file, pictures[4], names.size(), 4);
  page.title("Motion", "Casts: time over how early the worst time of impact is, a dot a tolerance (none is late). The free box: time a step over how far its energy drifts, a dot a step.");
  page.tell(errors_and_times());
  for (const std::string& name : names) {
    const auto dot = [&](const MotionPoint& p) -> std::optional<Dot> { return p.family == name ? std::optional(Dot{std::max(p.worst_error, smallest_drawn), p.nanoseconds * 1e-9}) : std::nullopt; };
    const bool free = name == "free box";
    page.panel(name + (free ? ": a step" : ": a cast"), free ? "energy drift, relative" : "early at the worst, of the motion", "time", curves_of(chart.motion, &MotionPoint::method, dot));
  }
  return page.finish();
}

}  // namespace

std::span<const ChartPicture> chart_pictures() { return pictures; }

bool run_gnuplot(const std::string& commands) {
  std::FILE* pipe = popen("trap '' INT; exec gnuplot 2>/dev/null", "w");  // Ctrl-C ends the measuring, not the drawing of what was measured
  if (!pipe) return false;
  const bool written = std::fwrite(commands.data(), 1, commands.size(), pipe) == commands.size();
  return pclose(pipe) == 0 && written;
}

}  // namespace gjkdbg
