// The atlas as a heat map: commands for gnuplot.
#include <algorithm>
#include <cstdio>

#include "debugger/lab/atlas.h"
#include "debugger/lab/chart.h"
#include "debugger/lab/gnuplot.h"

namespace gjkdbg {
namespace {

/// A row a family, a column a method, where everything stands in pixels from the upper left.
///
///   title
///   note
///                       +--------+ +----+
///   what a family is A1 |        | |    |       kinds of families, and of methods, have a gap between them
///                    A2 |        | |    |
///                       +--------+ +----+
///                       / / method
///                       [] verdict   [] verdict   …
class HeatMap {
 public:
  explicit HeatMap(const Atlas& atlas) : atlas_(atlas), columns_(atlas.methods.size()), rows_(std::max<std::size_t>(1, atlas.families.size())) {
    for (const AtlasFamily& family : atlas.families) widest_ = std::max(widest_, row_title(family).size());
  }

  int width() const { return static_cast<int>(std::max(right(), margin + legend_width()) + margin); }
  int height() const { return static_cast<int>(bottom() + foot); }

  std::string commands(const std::string& terminal, const std::string& file) const {
    std::string out = "set encoding utf8\nset terminal " + terminal + "\nset output " + quoted_for_gnuplot(file) + "\nunset border\nunset key\nunset colorbox\nset tics scale 0 textcolor rgb '#30363f' font ',10'\n";
    out += "set label 1 'Stability where methods fail' at screen " + at(margin, 24) + title_look + "\n";
    out += "set label 2 'The worst verdict of a method over a family of pairs, and the largest error relative to the size.' at screen " + at(margin, 50) + note_look + "\n";
    out += "set lmargin at screen " + across(left()) + "\nset rmargin at screen " + across(right()) + "\nset tmargin at screen " + up(head) + "\nset bmargin at screen " + up(bottom()) + "\n";
    out += "set xrange [-0.5:" + number_text(static_cast<double>(columns_) - 0.5) + "]\nset yrange [" + number_text(static_cast<double>(rows_) - 0.5) + ":-0.5]\n";
    return out + tics() + gaps() + legend() + cells();
  }

 private:
  static constexpr double cell_width = 42, cell_height = 26, margin = 24, head = 96, foot = 190, letter = 6.5;
  /// Right is blue-green, towards vermilion the more serious; the mark says it too.
  static constexpr std::array<const char*, verdict_names.size()> colours{"#009E73", "#9BD7C3", "#F0E442", "#E69F00", "#CC79A7", "#D55E00", "#7A3B00", "#000000", "#F1F3F5"};

  double left() const { return 2 * margin + letter * static_cast<double>(widest_); }
  double right() const { return left() + cell_width * static_cast<double>(columns_); }
  double bottom() const { return head + cell_height * static_cast<double>(rows_); }
  std::string across(double x) const { return number_text(x / width()); }
  std::string up(double y) const { return number_text(1 - y / height()); }
  std::string at(double x, double y) const { return across(x) + "," + up(y); }

  /// What the family is, without the reason why methods fail.
  static std::string row_title(const AtlasFamily& family) { return family.what.substr(0, family.what.find(':')) + "   " + family.name; }

  std::string tics() const {
    std::string x, y;
    for (std::size_t m = 0; m < columns_; ++m) x += (m > 0 ? ", " : "") + quoted_for_gnuplot(atlas_.methods[m].name) + " " + std::to_string(m);
    for (std::size_t f = 0; f < atlas_.families.size(); ++f) y += (f > 0 ? ", " : "") + quoted_for_gnuplot(row_title(atlas_.families[f])) + " " + std::to_string(f);
    return "set xtics rotate by 40 right (" + x + ")\nset ytics (" + y + ")\n";
  }

  /// Ours in double, those by others' rules, ours in float, other libraries.
  static int kind(const Variant& method) {
    return method.peer != nullptr ? 3 : method.method.scalar && *method.method.scalar == Scalar::float_precision ? 2 : method.name.starts_with("rule of") ? 1 : 0;
  }
  std::string gaps() const {
    std::string out;
    const auto line = [&](double from_x, double from_y, double to_x, double to_y) {
      out += "set arrow from " + number_text(from_x) + "," + number_text(from_y) + " to " + number_text(to_x) + "," + number_text(to_y) + " nohead front lc rgb '#ffffff' lw 4\n";
    };
    const double right = static_cast<double>(columns_) - 0.5, below = static_cast<double>(rows_) - 0.5;
    for (std::size_t m = 1; m < columns_; ++m)
      if (kind(atlas_.methods[m]) != kind(atlas_.methods[m - 1])) line(static_cast<double>(m) - 0.5, -0.5, static_cast<double>(m) - 0.5, below);
    for (std::size_t f = 1; f < atlas_.families.size(); ++f)
      if (atlas_.families[f].name[0] != atlas_.families[f - 1].name[0]) line(-0.5, static_cast<double>(f) - 0.5, right, static_cast<double>(f) - 0.5);
    return out;
  }

  static std::string verdict_text(std::size_t i) {
    std::string words = verdict_names[i];
    std::replace(words.begin(), words.end(), '-', ' ');
    return *verdict_marks[i] != 0 ? std::string(verdict_marks[i]) + "  " + words : words;
  }
  static double legend_room(std::size_t i) { return 50 + letter * (static_cast<double>(std::string(verdict_names[i]).size()) + (*verdict_marks[i] != 0 ? 3 : 0)); }
  double legend_width() const {
    double x = 0;
    for (std::size_t i = 0; i < verdict_names.size(); ++i) x += legend_room(i);
    return x;
  }
  std::string legend() const {
    std::string out;
    double x = std::min(left(), std::max(right() - legend_width(), margin));
    const double y = height() - 30;
    for (std::size_t i = 0; i < verdict_names.size(); ++i) {
      const std::string number = std::to_string(10 + i);
      out += "set object " + number + " rectangle from screen " + at(x, y + 8) + " to screen " + at(x + 22, y - 8) + " fc rgb '" + colours[i] + "' fs solid noborder\n";
      out += "set label " + number + " " + quoted_for_gnuplot(verdict_text(i)) + " at screen " + at(x + 29, y) + " left font ',10' textcolor rgb '#30363f'\n";
      x += legend_room(i);
    }
    return out;
  }

  /// The verdict's mark and the size of the error.
  static std::string label(const AtlasCell& cell) {
    const std::string mark = verdict_marks[static_cast<std::size_t>(cell.verdict)];
    if (cell.verdict == Verdict::crashed || cell.verdict == Verdict::not_applicable) return mark;
    if (cell.worst_error == 0) return mark + "0";
    char text[32];
    std::snprintf(text, sizeof text, "%.0e", cell.worst_error);
    const std::string digits = text;
    const std::size_t e = digits.find('e');
    return e == std::string::npos ? mark + digits : mark + digits.substr(0, e + 1) + std::to_string(std::stoi(digits.substr(e + 1)));
  }
  std::string cells() const {
    std::string colour, text, palette;
    for (std::size_t i = 0; i < colours.size(); ++i) palette += (i > 0 ? ", " : "") + std::to_string(i) + " '" + colours[i] + "'";
    for (std::size_t f = 0; f < atlas_.families.size(); ++f)
      for (std::size_t m = 0; m < columns_; ++m) {
        const AtlasCell& cell = atlas_.cells[f][m];
        const std::string place = std::to_string(m) + " " + std::to_string(f) + " ";
        colour += place + std::to_string(static_cast<int>(cell.verdict)) + "\n";
        const bool dark = cell.verdict == Verdict::crashed || cell.verdict == Verdict::not_finite;
        if (const std::string words = label(cell); !words.empty()) text += place + words + (dark ? " 0xFFFFFF\n" : " 0x000000\n");
      }
    const std::string all = "set palette maxcolors " + std::to_string(colours.size()) + " defined (" + palette + ")\nset cbrange [-0.5:" + number_text(static_cast<double>(colours.size()) - 0.5) + "]\n";
    const std::string boxes = "using 1:2:(0.5):(0.5):3 with boxxyerror fs solid noborder lc palette";  // an image has no size where there is but a row or a column
    if (colour.empty()) return all + "plot NaN\n";
    if (text.empty()) return all + "plot '-' " + boxes + "\n" + colour + "e\n";
    return all + "plot '-' " + boxes + ", '-' using 1:2:3:4 with labels font ',8' textcolor rgb variable\n" + colour + "e\n" + text + "e\n";
  }

  const Atlas& atlas_;
  const std::size_t columns_, rows_;
  std::size_t widest_ = 0;  ///< letters of the longest title of a row
};

}  // namespace

std::array<int, 2> atlas_picture_size(const Atlas& atlas) {
  const HeatMap map(atlas);
  return {map.width(), map.height()};
}

std::string atlas_gnuplot(const Atlas& atlas, const std::string& terminal, const std::string& file) { return HeatMap(atlas).commands(terminal, file); }

}  // namespace gjkdbg
