// A picture: what a view shows, as primitives in scene space with their meaning's colour. Pure data; a window draws it with
// its own means, a file writes it as SVG.
#pragma once

#include <string>
#include <vector>

#include "debugger/render/camera.h"
#include "debugger/render/palette.h"

namespace gjkdbg {

enum class Stroke { solid, dashed };

struct PictureFace {
  std::vector<ViewPoint> points;
  Colour fill;
};
struct PictureLine {
  ViewPoint from, to;
  Colour colour;
  double width = 1.5;  ///< pixels
  Stroke stroke = Stroke::solid;
  bool arrow = false;
  bool on_top = false;  ///< drawn over everything, whatever lies in front
};
enum class Mark { disc, ring, cross, square };
struct PicturePoint {
  ViewPoint at;
  Colour colour;
  double radius = 5;  ///< pixels
  Mark mark = Mark::disc;
  int vertex = -1;  ///< what a click selects
};
struct PictureLabel {
  ViewPoint at;
  std::string text;
  Colour colour;
  double dx = 9, dy = -9;  ///< pixels from the point
  bool small = false;
  bool dot = false;  ///< names a dot, and may be joined by another name of it
  bool area = false;  ///< names no dot, but what lies at the point: a line leads there from a place farther off
  bool spare = false;  ///< names no dot: gets its place after the others, or none where there is no free one
};

struct Picture {
  std::vector<PictureFace> faces;
  std::vector<PictureLine> lines;
  std::vector<PicturePoint> points;
  std::vector<PictureLabel> labels;
  std::vector<PicturePoint> kept_free;     ///< not drawn: labels keep off them, for something of the window's lies there
  std::vector<PictureLabel> scale_marks;  ///< small, under everything, never moved apart
  std::vector<std::string> shown;          ///< what of the step is drawn, besides what every step has
  double covered = 0;                     ///< pixels below the view's upper border: labels keep off them, too, for a title lies there

  void line(const ViewPoint& from, const ViewPoint& to, Colour colour, double width = 1.5, Stroke stroke = Stroke::solid) {
    lines.push_back({from, to, colour, width, stroke, false, false});
  }
  void arrow(const ViewPoint& from, const ViewPoint& to, Colour colour, double width = 2.5) {
    lines.push_back({from, to, colour, width, Stroke::solid, true, true});
  }
};

/// Flattened: in pixels, in drawing order.
struct FlatItem {
  enum class Kind { polygon, line, point, label } kind = Kind::polygon;
  std::vector<Projected> points;
  Colour colour;
  double width = 1;  ///< of a line; the radius of a point
  Stroke stroke = Stroke::solid;
  bool arrow = false;
  Mark mark = Mark::disc;
  std::string text;
  bool small = false;  ///< of a label
  int vertex = -1;
};

/// About as wide as a text is drawn, before it is scaled, in pixels.
double text_width(const std::string& text, bool small);

/// Projects and sorts back to front (faces by their middle, lines just before faces at the same depth; points and labels last).
/// Labels go to where they hide least of one another, of points and of strong lines. `scale`: of text and marks, in pixels.
std::vector<FlatItem> flatten(const Picture& picture, const Projection& projection, double scale = 1);

/// As an SVG fragment (no document element).
std::string to_svg(const std::vector<FlatItem>& items, double font_size);
/// A sentence in lines that are no wider than `width` in an SVG's font, which is not known: letters are taken to be 0.6 of its size wide, as DejaVu's are. A word longer than that has a line of its own.
std::vector<std::string> svg_lines(const std::string& sentence, double width, double font_size);

}  // namespace gjkdbg
