#include "debugger/render/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

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

/// Labels look for a free place around their point, inside the view: right, left, above, below, and farther out.
void place_labels(const Picture& picture, const Projection& project, std::vector<FlatItem>& out) {
  struct Box {
    double x, y, w, h;
    bool meets(const Box& o) const { return x < o.x + o.w && o.x < x + w && y < o.y + o.h && o.y < y + h; }
  };
  std::vector<Box> taken;
  const ViewRectangle& view = project.rectangle();
  const auto fits = [&](const Box& box) {
    if (box.x < view.x || box.x + box.w > view.x + view.width || box.y < view.y || box.y + box.h > view.y + view.height) return false;
    return std::none_of(taken.begin(), taken.end(), [&](const Box& t) { return t.meets(box); });
  };
  for (const PictureLabel& label : picture.labels) {
    const Projected at = project(label.at);
    const double w = 8.5 * static_cast<double>(label.text.size()), h = 17;
    const std::array<std::array<double, 2>, 7> offsets{{{label.dx, label.dy}, {-label.dx - w, label.dy}, {label.dx, -label.dy}, {-label.dx - w, -label.dy},
                                                        {-w / 2, label.dy - 14}, {-w / 2, -label.dy + 14}, {label.dx + 14, label.dy - 20}}};
    Box best{at.x + offsets[0][0], at.y + offsets[0][1] - h / 2, w, h};
    for (const auto& o : offsets) {
      const Box box{at.x + o[0], at.y + o[1] - h / 2, w, h};
      if (fits(box)) {
        best = box;
        break;
      }
    }
    taken.push_back(best);
    FlatItem item;
    item.kind = FlatItem::Kind::label;
    item.points = {{best.x, best.y, at.depth}};
    item.colour = label.colour, item.text = label.text;
    out.push_back(std::move(item));
  }
}

}  // namespace

std::vector<FlatItem> flatten(const Picture& picture, const Projection& project) {
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
  for (const PictureLabel& mark : picture.scale_marks) {
    FlatItem item;
    item.kind = FlatItem::Kind::label;
    item.points = {project(mark.at)};
    item.points[0].x += mark.dx, item.points[0].y += mark.dy;
    item.text = mark.text, item.colour = mark.colour, item.small = true;
    out.push_back(std::move(item));
  }
  for (auto& [depth, item] : sorted) out.push_back(std::move(item));
  for (const PictureLine& line : picture.lines)
    if (line.on_top) out.push_back(flat_line(line, project));
  for (const PicturePoint& point : picture.points) {
    FlatItem item;
    item.kind = FlatItem::Kind::point;
    item.points = {project(point.at)};
    item.colour = point.colour, item.width = point.radius, item.mark = point.mark, item.vertex = point.vertex;
    out.push_back(std::move(item));
  }
  place_labels(picture, project, out);
  return out;
}

namespace {

std::string number(double x) {
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
  std::string out = "<line x1=\"" + number(p.x) + "\" y1=\"" + number(p.y) + "\" x2=\"" + number(q.x) + "\" y2=\"" + number(q.y) + "\" stroke-width=\"" +
                    number(item.width) + "\" stroke-linecap=\"round\"" + paint("stroke", item.colour) +
                    (item.stroke == Stroke::dashed ? " stroke-dasharray=\"7 5\"" : "") + "/>\n";
  const double length = std::hypot(q.x - p.x, q.y - p.y);
  if (!item.arrow || length < 1) return out;
  const double ux = (q.x - p.x) / length, uy = (q.y - p.y) / length, h = 5 + 2 * item.width, w = h * 0.45;
  out += "<polygon points=\"" + number(q.x + ux * 2) + "," + number(q.y + uy * 2) + " " + number(q.x - ux * h - uy * w) + "," + number(q.y - uy * h + ux * w) + " " +
         number(q.x - ux * h + uy * w) + "," + number(q.y - uy * h - ux * w) + "\"" + paint("fill", item.colour) + "/>\n";
  return out;
}

std::string svg_point(const FlatItem& item) {
  const std::string x = number(item.points[0].x), y = number(item.points[0].y), r = number(item.width);
  if (item.mark == Mark::cross) {
    const auto arm = [&](double dx, double dy) {
      return "<line x1=\"" + number(item.points[0].x - dx) + "\" y1=\"" + number(item.points[0].y - dy) + "\" x2=\"" + number(item.points[0].x + dx) + "\" y2=\"" +
             number(item.points[0].y + dy) + "\" stroke-width=\"2\"" + paint("stroke", item.colour) + "/>\n";
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
        for (const Projected& p : item.points) out += number(p.x) + "," + number(p.y) + " ";
        out += "\"" + paint("fill", item.colour) + "/>\n";
        break;
      }
      case FlatItem::Kind::line: out += svg_line(item); break;
      case FlatItem::Kind::point: out += svg_point(item); break;
      case FlatItem::Kind::label:
        out += "<text x=\"" + number(item.points[0].x) + "\" y=\"" + number(item.points[0].y + font_size) + "\" font-size=\"" + number(item.small ? font_size * 0.75 : font_size) + "\"" +
               paint("fill", item.colour) + ">" + escaped(item.text) + "</text>\n";
        break;
    }
  }
  return out;
}

}  // namespace gjkdbg
