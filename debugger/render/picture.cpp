#include "debugger/render/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>

namespace gjkdbg {
namespace {

FlatItem flat_line(const PictureLine& line, const Projection& project) {
  FlatItem item;
  item.kind = FlatItem::Kind::line;
  item.points = {project(line.from), project(line.to)};
  item.colour = line.colour, item.width = line.width, item.stroke = line.stroke, item.arrow = line.arrow;
  return item;
}

double middle_depth(const std::vector<Projected>& points) {
  double sum = 0;
  for (const Projected& p : points) sum += p.depth;
  return sum / static_cast<double>(points.size());
}

struct LabelBox {
  double x, y, w, h;
  bool meets(const LabelBox& o) const { return x < o.x + o.w && o.x < x + w && y < o.y + o.h && o.y < y + h; }
};

/// How much of a segment lies in a box: its parameters between each pair of sides (Liang, Barsky 1984).
double length_inside(const LabelBox& box, const Projected& p, const Projected& q) {
  double from = 0, to = 1;
  const auto between = [&](double start, double step, double low, double high) {
    if (step == 0) return start > low && start < high;
    const double s = (low - start) / step, t = (high - start) / step;
    from = std::max(from, std::min(s, t)), to = std::min(to, std::max(s, t));
    return from < to;
  };
  const double dx = q.x - p.x, dy = q.y - p.y;
  return between(p.x, dx, box.x, box.x + box.w) && between(p.y, dy, box.y, box.y + box.h) ? (to - from) * std::hypot(dx, dy) : 0;
}

/// The place in a box from which a line leads to a point.
Projected towards(const LabelBox& box, const Projected& p) { return {std::clamp(p.x, box.x, box.x + box.w), std::clamp(p.y, box.y, box.y + box.h), p.depth}; }

double distance(const LabelBox& box, const Projected& p) { return std::hypot(std::max({box.x - p.x, 0.0, p.x - box.x - box.w}), std::max({box.y - p.y, 0.0, p.y - box.y - box.h})); }

/// Finds every label the place around its point, inside the view, where it hides least of other labels, points and strong lines; the first of equals.
/// First one after the other, then each once more beside all others. A spare one is left out rather than lie over others.
class LabelPlaces {
 public:
  LabelPlaces(const std::vector<FlatItem>& drawn, const ViewRectangle& view, double scale) : drawn_(drawn), view_(view), scale_(scale) {}

  std::vector<std::optional<LabelBox>> take(const std::vector<std::pair<Projected, const PictureLabel*>>& labels) {
    taken_.assign(labels.size(), std::nullopt);
    points_.clear();
    for (const auto& label : labels) points_.push_back(label.first);
    constexpr int rounds = 3;
    for (int round = 0; round < rounds; ++round)
      for (std::size_t i = 0; i < labels.size(); ++i) {
        taken_[i].reset();
        taken_[i] = best(labels[i].first, *labels[i].second);
      }
    return taken_;
  }

 private:
  static constexpr double apart = 3;  ///< pixels between two labels

  std::optional<LabelBox> best(const Projected& at, const PictureLabel& label) const {
    std::optional<LabelBox> best;
    double least = std::numeric_limits<double>::infinity();
    for (const LabelBox& box : places_around(at, label))
      if (const double bad = hides(box) + crosses(box, at) + (label.spare ? distance(box, at) / scale_ : misleads(box, at)); bad < least) least = bad, best = box;
    if (label.spare && best && hides(*best) > 25 * scale_) return std::nullopt;
    return best;
  }

  /// Beside the point in four corners, above, below, left and right; then farther off, where a line leads to it.
  std::vector<LabelBox> places_around(const Projected& at, const PictureLabel& label) const {
    const double w = text_width(label.text, label.small), h = label.small ? 13 : 17, right = std::abs(label.dx), side = label.dy, beyond = std::abs(side) + 14;
    const auto centred = [&](double dx, double dy) { return LabelBox{at.x + scale_ * dx, at.y + scale_ * (dy - h / 2), scale_ * w, scale_ * h}; };
    std::vector<LabelBox> boxes{centred(label.dx, side), centred(-right - w, side), centred(right, -side), centred(-right - w, -side),
                                centred(-w / 2, -beyond), centred(-w / 2, beyond), centred(right + 4, 0), centred(-right - 4 - w, 0)};
    for (const double away : {20.0, 36.0, 54.0})
      for (const double up : {-1.0, 1.0, -0.4, 0.4})
        for (const double way : {1.0, -1.0, 0.0})
          if (way != 0 || std::abs(up) == 1) boxes.push_back(centred(way > 0 ? right - 9 + away * 0.7 : way < 0 ? 9 - right - away * 0.7 - w : -w / 2, up * away + (up > 0 ? 4 : -4)));
    return boxes;
  }

  static double weight(const FlatItem& line) { return line.width >= 2 ? 1 : 0.5 * line.colour.a / 255; }

  /// In pixels of a strong line: a weaker one counts half at most, a point as many as it is wide and 30, a label or the border of the view far more.
  double hides(const LabelBox& box) const {
    double sum = 0;
    if (box.x < view_.x || box.x + box.w > view_.x + view_.width || box.y < view_.y || box.y + box.h > view_.y + view_.height) sum += 1000;
    const double d = scale_ * apart;
    for (const std::optional<LabelBox>& other : taken_) sum += other && box.meets({other->x - d, other->y, other->w + 2 * d, other->h}) ? 200 : 0;
    for (const FlatItem& item : drawn_) {
      const Projected& p = item.points.front();
      const double r = scale_ * item.width;
      if (item.kind == FlatItem::Kind::point && box.meets({p.x - r, p.y - r, 2 * r, 2 * r})) sum += 2 * r + 30;
      if (item.kind == FlatItem::Kind::line && item.width > 1) sum += weight(item) * length_inside(box, p, item.points.back());
    }
    return sum;
  }

  /// A line that leads from a label to its point strikes out the label that it runs through.
  double crosses(const LabelBox& box, const Projected& at) const {
    double sum = 0;
    for (std::size_t i = 0; i < taken_.size(); ++i)
      if (taken_[i]) sum += length_inside(*taken_[i], towards(box, at), at) > 0 || length_inside(box, towards(*taken_[i], points_[i]), points_[i]) > 0 ? 60 : 0;
    return sum;
  }

  /// What stands nearer to another point than to its own is taken for that one's; and far off for nobody's.
  double misleads(const LabelBox& box, const Projected& at) const {
    const double own = distance(box, at);
    double sum = own / scale_;
    for (const FlatItem& item : drawn_) {
      const Projected& p = item.points.front();
      if (item.kind == FlatItem::Kind::point && std::hypot(p.x - at.x, p.y - at.y) > 2 * scale_ && distance(box, p) < own) sum += 80;
    }
    return sum;
  }

  const std::vector<FlatItem>& drawn_;
  const ViewRectangle& view_;
  const double scale_;
  std::vector<std::optional<LabelBox>> taken_;
  std::vector<Projected> points_;  ///< of the labels
};

FlatItem flat_point(const PicturePoint& point, const Projection& project) {
  FlatItem item;
  item.kind = FlatItem::Kind::point;
  item.points = {project(point.at)};
  item.colour = point.colour, item.width = point.radius, item.mark = point.mark, item.vertex = point.vertex;
  return item;
}

/// From a label to its dot, where it found no room beside that or another dot is nearer.
std::optional<FlatItem> leader(const LabelBox& box, const Projected& at, const PictureLabel& label, const std::vector<FlatItem>& drawn, double scale) {
  const double own = distance(box, at);
  bool has_dot = false, nearer_dot = false;
  for (const FlatItem& item : drawn) {
    if (item.kind != FlatItem::Kind::point) continue;
    const bool is_own = std::hypot(item.points[0].x - at.x, item.points[0].y - at.y) < 1;
    has_dot |= is_own, nearer_dot |= !is_own && distance(box, item.points[0]) < own;
  }
  if ((!has_dot && !label.area) || own < (nearer_dot ? 10 : 22) * scale) return std::nullopt;
  FlatItem line;
  line.kind = FlatItem::Kind::line;
  line.points = {towards(box, at), at};
  line.colour = label.colour.with_alpha(0.9), line.width = 1;
  return line;
}

std::vector<FlatItem> placed_labels(const Picture& picture, const Projection& project, std::vector<FlatItem> drawn, double scale, std::vector<LabelBox>& taken) {
  for (const PicturePoint& point : picture.kept_free) drawn.push_back(flat_point(point, project));
  ViewRectangle view = project.rectangle();
  view.y += picture.covered, view.height -= picture.covered;
  std::vector<FlatItem> out;
  std::vector<std::pair<Projected, const PictureLabel*>> in_turn;
  for (const PictureLabel& label : picture.labels) in_turn.emplace_back(project(label.at), &label);
  std::stable_partition(in_turn.begin(), in_turn.end(), [](const auto& next) { return !next.second->spare; });
  const auto boxes = LabelPlaces(drawn, view, scale).take(in_turn);
  for (std::size_t i = 0; i < in_turn.size(); ++i) {
    const auto& [at, label] = in_turn[i];
    if (!boxes[i]) continue;
    taken.push_back(*boxes[i]);
    if (auto line = leader(*boxes[i], at, *label, drawn, scale)) out.push_back(std::move(*line));
    FlatItem item;
    item.kind = FlatItem::Kind::label;
    item.points = {{boxes[i]->x, boxes[i]->y, at.depth}};
    item.colour = label->colour, item.text = label->text, item.small = label->small;
    out.push_back(std::move(item));
  }
  return out;
}

/// The axes' numbers, but where one would lie under a label, a body's ring or what covers the view's top.
std::vector<FlatItem> scale_marks(const Picture& picture, const Projection& project, double scale, const std::vector<LabelBox>& taken) {
  std::vector<FlatItem> out;
  for (const PictureLabel& mark : picture.scale_marks) {
    Projected at = project(mark.at);
    at.x += scale * mark.dx, at.y += scale * mark.dy;
    const LabelBox box{at.x, at.y, scale * text_width(mark.text, true), 11 * scale};
    if (at.y < project.rectangle().y + picture.covered || std::any_of(taken.begin(), taken.end(), [&](const LabelBox& other) { return box.meets(other); })) continue;
    FlatItem item;
    item.kind = FlatItem::Kind::label;
    item.points = {at};
    item.text = mark.text, item.colour = mark.colour, item.small = true;
    out.push_back(std::move(item));
  }
  return out;
}

}  // namespace

/// Of the letters' three widths in Inter, of 13 and of 11 pixels.
double text_width(const std::string& text, bool small) {
  double sum = 0;
  for (const char c : text)
    if ((c & 0xC0) != 0x80) sum += std::strchr("iljI.,:;'|!", c) ? 3.4 : std::strchr("tfr()[] -1", c) ? 4.6 : std::strchr("mwMW", c) ? 10.5 : 7.6;
  return (small ? 0.82 : 1) * sum;
}

std::vector<FlatItem> flatten(const Picture& picture, const Projection& project, double scale) {
  std::vector<std::pair<double, FlatItem>> sorted;
  for (const PictureFace& face : picture.faces) {
    FlatItem item;
    for (const ViewPoint& p : face.points) item.points.push_back(project(p));
    item.colour = face.fill;
    const double depth = middle_depth(item.points);
    sorted.emplace_back(depth, std::move(item));
  }
  for (const PictureLine& line : picture.lines)
    if (!line.on_top) {
      FlatItem item = flat_line(line, project);
      const double depth = middle_depth(item.points) + 1e-3;
      sorted.emplace_back(depth, std::move(item));
    }
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<FlatItem> out;
  for (auto& [depth, item] : sorted) out.push_back(std::move(item));
  for (const PictureLine& line : picture.lines)
    if (line.on_top) out.push_back(flat_line(line, project));
  for (const PicturePoint& point : picture.points) out.push_back(flat_point(point, project));
  std::vector<LabelBox> taken;
  std::vector<FlatItem> labels = placed_labels(picture, project, out, scale, taken);
  for (const PicturePoint& point : picture.kept_free) {
    const Projected p = project(point.at);
    taken.push_back({p.x - scale * point.radius, p.y - scale * point.radius, 2 * scale * point.radius, 2 * scale * point.radius});
  }
  std::vector<FlatItem> all = scale_marks(picture, project, scale, taken);
  for (auto* list : {&out, &labels}) std::move(list->begin(), list->end(), std::back_inserter(all));
  return all;
}

namespace {

std::string svg_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", x);
  return text;
}

std::string paint(const char* attribute, Colour c) {
  char text[80];
  std::snprintf(text, sizeof text, " %s=\"#%02x%02x%02x\" %s-opacity=\"%.3f\"", attribute, c.r, c.g, c.b, attribute, c.a / 255.0);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

std::string svg_line(const FlatItem& item) {
  const Projected &p = item.points[0], &q = item.points[1];
  std::string out = "<line x1=\"" + svg_number(p.x) + "\" y1=\"" + svg_number(p.y) + "\" x2=\"" + svg_number(q.x) + "\" y2=\"" + svg_number(q.y) + "\" stroke-width=\"" +
                    svg_number(item.width) + "\" stroke-linecap=\"round\"" + paint("stroke", item.colour) +
                    (item.stroke == Stroke::dashed ? " stroke-dasharray=\"7 5\"" : "") + "/>\n";
  const double length = std::hypot(q.x - p.x, q.y - p.y);
  if (!item.arrow || length < 1) return out;
  const double ux = (q.x - p.x) / length, uy = (q.y - p.y) / length, h = 5 + 2 * item.width, w = h * 0.45;
  out += "<polygon points=\"" + svg_number(q.x + ux * 2) + "," + svg_number(q.y + uy * 2) + " " + svg_number(q.x - ux * h - uy * w) + "," + svg_number(q.y - uy * h + ux * w) + " " +
         svg_number(q.x - ux * h + uy * w) + "," + svg_number(q.y - uy * h - ux * w) + "\"" + paint("fill", item.colour) + "/>\n";
  return out;
}

std::string svg_point(const FlatItem& item) {
  const std::string x = svg_number(item.points[0].x), y = svg_number(item.points[0].y), r = svg_number(item.width);
  if (item.mark == Mark::cross) {
    const auto arm = [&](double dx, double dy) {
      return "<line x1=\"" + svg_number(item.points[0].x - dx) + "\" y1=\"" + svg_number(item.points[0].y - dy) + "\" x2=\"" + svg_number(item.points[0].x + dx) + "\" y2=\"" +
             svg_number(item.points[0].y + dy) + "\" stroke-width=\"2\"" + paint("stroke", item.colour) + "/>\n";
    };
    return arm(item.width, 0) + arm(0, item.width);
  }
  const bool ring = item.mark == Mark::ring;
  return "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"" + r + "\"" + (ring ? " fill=\"none\" stroke-width=\"2\"" + paint("stroke", item.colour) : paint("fill", item.colour)) + "/>\n";
}

}  // namespace

std::string to_svg(const std::vector<FlatItem>& items, double font_size) {
  std::string out;
  for (const FlatItem& item : items) {
    switch (item.kind) {
      case FlatItem::Kind::polygon: {
        out += "<polygon points=\"";
        for (const Projected& p : item.points) out += svg_number(p.x) + "," + svg_number(p.y) + " ";
        out += "\"" + paint("fill", item.colour) + "/>\n";
        break;
      }
      case FlatItem::Kind::line: out += svg_line(item); break;
      case FlatItem::Kind::point: out += svg_point(item); break;
      case FlatItem::Kind::label:
        out += "<text x=\"" + svg_number(item.points[0].x) + "\" y=\"" + svg_number(item.points[0].y + font_size) + "\" font-size=\"" + svg_number(item.small ? font_size * 0.75 : font_size) + "\"" +
               paint("fill", item.colour) + ">" + escaped(item.text) + "</text>\n";
        break;
    }
  }
  return out;
}

std::vector<std::string> svg_lines(const std::string& sentence, double width, double font_size) {
  const auto letters = [](const std::string& text) { return std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }); };  // of UTF-8, its first bytes
  const auto room = static_cast<std::ptrdiff_t>(width / (0.6 * font_size));
  std::vector<std::string> lines;
  std::istringstream words(sentence);
  for (std::string word; words >> word;) {
    if (!lines.empty() && letters(lines.back()) + 1 + letters(word) <= room) lines.back() += " " + word;
    else lines.push_back(word);
  }
  return lines;
}

}  // namespace gjkdbg
