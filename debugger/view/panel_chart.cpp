// A measured chart in the window: families of pairs by error and by certified gap, iterations by distance, the price of modelling too much, motion.
// Pointing at a dot tells what it is; at a method in the legend, leaves only its dots; a click on a family's dot opens its worst pair.
#include <algorithm>
#include <cmath>

#include "debugger/view/plot.h"

namespace gjkdbg {
namespace {

constexpr std::pair<const char*, std::uint32_t> peers[] = {{"Bullet", 0x8c8f96}, {"FCL", 0x7d8a5c}, {"libccd GJK", 0x9a7358}, {"libccd MPR", 0x5f8296}, {"ODE", 0x8f6c92}, {"Box2D", 0xa39a4a}};

/// A colour a method, whatever the scalar; other libraries in quieter ones.
Colour colour_of(const std::string& method, const Palette& p) {
  static constexpr std::pair<const char*, std::uint32_t> ours[] = {{"signed volumes", 0x3d8fe0}, {"Johnson", 0xe0663a}, {"Voronoi regions", 0x2fae83}, {"accelerated", 0xd07ab5}, {"Polyak", 0xdca11d},      {"Newton", 0xb8446e}, {"smoothed", 0x4f9d69},
                                                                   {"MPR", 0x62b8e8},            {"SAT", 0xa8a032},     {"closed form", 0xb07cc6},     {"projections", 0xd64550}, {"plain", 0x3d8fe0},       {"Nesterov", 0xd07ab5},
                                                                   {"conservative", 0x3d8fe0},   {"root-finding", 0x2fae83}, {"ray-cast", 0xe0663a},   {"explicit", 0x8c8f96},    {"semi-implicit", 0xdca11d}, {"rk4", 0xb8446e}};
  for (const auto& [name, value] : ours)
    if (method.starts_with(name)) return rgb(value);
  for (const auto& [name, value] : peers)
    if (method.starts_with(name)) return rgb(value);
  return p.text_faint;
}
bool single(const std::string& method) { return method.ends_with(", float"); }
bool foreign(const std::string& method) {
  return std::any_of(std::begin(peers), std::end(peers), [&](const auto& peer) { return method.starts_with(peer.first); });
}

/// Of ours a disc, in float a ring; of others a square.
void draw_mark(const Theme& theme, const std::string& method, ImVec2 at, Colour colour) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float r = theme.px(3.4f);
  if (foreign(method)) draw->AddRectFilled({at.x - r, at.y - r}, {at.x + r, at.y + r}, packed(colour));
  else if (single(method)) draw->AddCircle(at, r, packed(colour), 12, theme.px(1.3f));
  else draw->AddCircleFilled(at, r, packed(colour), 12);
}

/// Rows and columns of plots in an area.
struct Grid {
  ImVec2 at;
  float width, height, gap;
  int columns, rows;

  Grid(const Theme& theme, ImVec2 corner, ImVec2 size, int count, int most_columns) : at(corner), gap(theme.px(8)) {
    columns = std::clamp(size.x > theme.px(1000) ? most_columns : size.x > theme.px(560) ? 2 : 1, 1, std::max(1, count)), rows = (count + columns - 1) / columns;
    width = (size.x - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
    height = std::max(theme.px(150), (size.y - gap * static_cast<float>(rows - 1)) / static_cast<float>(std::max(1, rows)));
  }
  ImVec2 corner(int i) const { return {at.x + static_cast<float>(i % columns) * (width + gap), at.y + static_cast<float>(i / columns) * (height + gap)}; }
  ImVec2 size() const { return {width, height}; }
  /// Where the last row ends, for what scrolls.
  void end() const {
    ImGui::SetCursorScreenPos({at.x, at.y + static_cast<float>(rows) * (height + gap) - gap - 1});
    ImGui::Dummy({1, 1});
  }
};

/// Methods with their marks, in lines; which one is pointed at (-1: none) and where the rest of the area begins.
struct Legend {
  int pointed = -1;
  ImVec2 below;

  Legend(const Theme& theme, const std::vector<std::string>& methods, ImVec2 at, float width_there_is) {
    ImVec2 pen = at;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const float width = small_width(theme, methods[m]) + theme.px(26);
      if (pen.x + width > at.x + width_there_is) pen = {at.x, pen.y + theme.px(20)};
      draw_mark(theme, methods[m], {pen.x + theme.px(8), pen.y + theme.px(9)}, colour_of(methods[m], theme.palette));
      const bool hovered = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(pen, {pen.x + width, pen.y + theme.px(18)});
      if (hovered) pointed = static_cast<int>(m);
      small_text(theme, {pen.x + theme.px(16), pen.y + theme.px(2)}, hovered ? theme.palette.text : theme.palette.text_soft, methods[m]);
      pen.x += width;
    }
    below = {at.x, pen.y + theme.px(26)};
  }
  /// Others than the one pointed at are drawn faint.
  Colour faded(const Theme& theme, const std::vector<std::string>& methods, int method) const {
    Colour c = colour_of(methods[static_cast<std::size_t>(method)], theme.palette);
    if (pointed >= 0 && pointed != method) c.a = 40;
    return c;
  }
  bool shows(int method) const { return pointed < 0 || pointed == method; }
};

/// The nearest to the mouse of all that is offered, if it is near enough.
class Pointer {
 public:
  explicit Pointer(const Theme& theme) : nearest_(theme.px(9)), at_all_(ImGui::IsWindowHovered()), mouse_(ImGui::GetIO().MousePos) {}
  bool nearer(ImVec2 at) {
    const float away = std::hypot(mouse_.x - at.x, mouse_.y - at.y);
    if (!at_all_ || !(away < nearest_)) return false;
    return nearest_ = away, at_ = at, true;
  }
  /// A ring around it.
  void mark(const Theme& theme) const { ImGui::GetWindowDrawList()->AddCircle(at_, theme.px(8), packed(theme.palette.accent), 20, theme.px(2)); }

 private:
  float nearest_;
  bool at_all_;
  ImVec2 mouse_, at_;
};

// --- Families of pairs: time over error, or over the certified gap ----------------------------------------------------------

void tell_dot(App& app, const MeasuredChart& chart, const MeasuredFamily& family, const MeasuredDot& d) {
  const auto method = static_cast<std::size_t>(d.method);
  const auto scene = family.scenes.find(d.worst_pair);
  ImGui::BeginTooltip();
  ImGui::TextColored(vec(colour_of(chart.methods[method], app.theme.palette)), "%s, tolerance %g", chart.methods[method].c_str(), d.tolerance);
  ImGui::Text("%.0f ns a query, worst error %.2g%s", d.nanoseconds, d.worst_error, d.front ? "; nothing is both faster and more accurate" : "");
  if (d.median_gap > 0) ImGui::Text("between its bounds %.2g", d.median_gap);
  if (d.wrong > 0) ImGui::TextColored(vec(app.theme.palette.newest), "%d of %d pairs wrong", d.wrong, family.pairs);
  if (scene != family.scenes.end()) ImGui::TextColored(vec(app.theme.palette.text_faint), chart.settings[method] ? "click: its worst pair" : "click: its worst pair, solved by our default");
  ImGui::EndTooltip();
  if (scene == family.scenes.end() || !ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
  SceneFile file = scene->second;
  if (chart.settings[method]) file.method = *chart.settings[method], file.method.tolerance = d.tolerance;
  open_measured(app, std::move(file), family.name + "-" + std::to_string(d.worst_pair));
}

void families(App& app, ImVec2 at, ImVec2 size, bool by_gap) {
  const MeasuredChart& chart = *app.measured.chart;
  const Theme& theme = app.theme;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const Legend legend(theme, chart.methods, at, size.x);
  const auto name = [&](const MeasuredDot& d) -> const std::string& { return chart.methods[static_cast<std::size_t>(d.method)]; };
  const auto shown = [&](const MeasuredDot& d) { return !by_gap || d.median_gap > 0; };
  const Grid grid(theme, legend.below, {size.x, at.y + size.y - legend.below.y}, static_cast<int>(chart.families.size()), 3);
  Pointer pointer(theme);
  const MeasuredDot* pointed = nullptr;
  const MeasuredFamily* where = nullptr;
  for (std::size_t f = 0; f < chart.families.size(); ++f) {
    const MeasuredFamily& family = chart.families[f];
    std::vector<double> times;
    for (const MeasuredDot& d : family.dots) times.push_back(d.nanoseconds);
    const Plot plot(theme, grid.corner(static_cast<int>(f)), grid.size(), family.title, by_gap ? "time a query, over gap" : "time a query, over worst error", error_axis(), time_axis(times));
    const auto place = [&](const MeasuredDot& d) { return plot.place(std::max(by_gap ? d.median_gap : d.worst_error, drawn_as_nothing), d.nanoseconds); };
    for (std::size_t i = 0; i + 1 < family.dots.size(); ++i)
      if (const MeasuredDot &a = family.dots[i], &b = family.dots[i + 1]; a.method == b.method && shown(a) && shown(b))
        list->AddLine(place(a), place(b), packed(legend.faded(theme, chart.methods, a.method)), theme.px(single(name(a)) ? 0.8f : 1.4f));
    for (const MeasuredDot& d : family.dots) {
      if (!shown(d)) continue;
      draw_mark(theme, name(d), place(d), legend.faded(theme, chart.methods, d.method));
      if (d.front && !by_gap && legend.shows(d.method)) list->AddCircle(place(d), theme.px(6), packed(theme.palette.text), 18, theme.px(1));
      if (legend.shows(d.method) && pointer.nearer(place(d))) pointed = &d, where = &family;
    }
  }
  grid.end();
  if (pointed) pointer.mark(theme), tell_dot(app, chart, *where, *pointed);
}

// --- Iterations by distance -------------------------------------------------------------------------------------------------

const std::vector<std::string> ladder_ways{"plain", "Nesterov", "Polyak", "Newton", "smoothed"};

/// A value of a rung, its deviation (0: not drawn) and the published one beside it.
struct RungValue {
  double value, deviation;
  std::optional<double> published, published_deviation;
};

void draw_deviation(const Theme& theme, const Plot& plot, double x, double value, double deviation, Colour colour) {
  if (!(deviation > 0)) return;
  const ImVec2 low = plot.place(x, value - deviation), high = plot.place(x, value + deviation);
  const float half = theme.px(3);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddLine(low, high, packed(colour), theme.px(1));
  for (const ImVec2& end : {low, high}) list->AddLine({end.x - half, end.y}, {end.x + half, end.y}, packed(colour), theme.px(1));
}

/// One method's rungs; `place_of(rung)` is where on the x axis, unset where it does not belong here.
template <class PlaceOf, class ValueOf>
void draw_rungs(const Theme& theme, const Plot& plot, const MeasuredChart& chart, int way, const Legend& legend, Pointer& pointer, const MeasuredRung** pointed, const PlaceOf& place_of, const ValueOf& value_of) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  const Colour colour = legend.faded(theme, ladder_ways, way);
  std::optional<ImVec2> before;
  for (const MeasuredRung& rung : chart.ladder) {
    const std::optional<double> x = rung.method == ladder_ways[static_cast<std::size_t>(way)] ? place_of(rung) : std::nullopt;
    if (!x) continue;
    const RungValue v = value_of(rung);
    const ImVec2 here = plot.place(*x, v.value);
    if (before) list->AddLine(*before, here, packed(colour), theme.px(1.4f));
    before = here;
    draw_deviation(theme, plot, *x, v.value, v.deviation, colour);
    draw_mark(theme, "", here, colour);
    if (v.published) {
      const double beside = *x + 0.14;
      draw_deviation(theme, plot, beside, *v.published, v.published_deviation.value_or(0), colour);
      const ImVec2 there = plot.place(beside, *v.published);
      const float r = theme.px(4);
      list->AddRectFilled({there.x - r, there.y - r}, {there.x + r, there.y + r}, packed(theme.palette.view));
      list->AddRect({there.x - r, there.y - r}, {there.x + r, there.y + r}, packed(colour), 0, 0, theme.px(1.5f));
    }
    if (legend.shows(way) && pointer.nearer(here)) *pointed = &rung;
  }
}

void tell_rung(App& app, const MeasuredRung& rung) {
  ImGui::BeginTooltip();
  ImGui::TextColored(vec(colour_of(rung.method, app.theme.palette)), "%s, %s %g %s", rung.method.c_str(), rung.shapes.c_str(), std::abs(rung.distance), rung.distance < 0 ? "deep" : "apart");
  ImGui::Text("%.1f \xC2\xB1 %.1f iterations", rung.iterations, rung.deviation);
  if (rung.published) ImGui::TextColored(vec(app.theme.palette.text_soft), "published: %.0f \xC2\xB1 %.0f (Montaut et al. 2024)", *rung.published, rung.published_deviation.value_or(0));
  if (rung.nanoseconds > 0) ImGui::Text("%.0f ns a query", rung.nanoseconds);
  if (rung.published_nanoseconds) ImGui::TextColored(vec(app.theme.palette.text_soft), "published: %.0f ns (Montaut et al. 2022, another machine)", *rung.published_nanoseconds);
  ImGui::EndTooltip();
}

void iterations(App& app, ImVec2 at, ImVec2 size) {
  const MeasuredChart& chart = *app.measured.chart;
  const Theme& theme = app.theme;
  const Legend legend(theme, ladder_ways, at, size.x);
  std::vector<double> distances, times;
  std::vector<int> vertices;
  double most = 0, most_of_hulls = 0;
  for (const MeasuredRung& rung : chart.ladder) {
    const double reach = std::max(rung.iterations + rung.deviation, rung.published.value_or(0) + rung.published_deviation.value_or(0));
    if (rung.vertices == 0) {
      most = std::max(most, reach);
      if (std::find(distances.begin(), distances.end(), rung.distance) == distances.end()) distances.push_back(rung.distance);
    } else {
      most_of_hulls = std::max(most_of_hulls, reach);
      if (std::find(vertices.begin(), vertices.end(), rung.vertices) == vertices.end()) vertices.push_back(rung.vertices);
      for (const double t : {rung.nanoseconds, rung.published_nanoseconds.value_or(0)})
        if (t > 0) times.push_back(t);
    }
  }
  std::vector<std::string> rungs, sizes;
  for (const double d : distances) rungs.push_back(formatted(d, "%g"));
  for (const int v : vertices) sizes.push_back(std::to_string(v));
  const auto index = [](const auto& list, auto value) { return static_cast<double>(std::find(list.begin(), list.end(), value) - list.begin()); };
  const Grid grid(theme, legend.below, {size.x, at.y + size.y - legend.below.y}, vertices.empty() ? 1 : times.empty() ? 2 : 3, 3);
  Pointer pointer(theme);
  const MeasuredRung* pointed = nullptr;
  const auto draw = [&](int plot_index, const std::string& title, const PlotAxis& x, const PlotAxis& y, const auto& place_of, const auto& value_of) {
    const Plot plot(theme, grid.corner(plot_index), grid.size(), title, "", x, y);
    for (int way = 0; way < static_cast<int>(ladder_ways.size()); ++way)
      draw_rungs(theme, plot, chart, way, legend, pointer, &pointed, [&](const MeasuredRung& r) { const std::optional<double> place = place_of(r); return place ? std::optional(*place + 0.06 * (way - 1.5)) : place; }, value_of);
  };
  draw(0, "ellipsoids: iterations over distance (below 0: deep)", named_axis(rungs), count_axis(most),
       [&](const MeasuredRung& r) { return r.vertices == 0 ? std::optional(index(distances, r.distance)) : std::nullopt; },
       [](const MeasuredRung& r) { return RungValue{r.iterations, r.deviation, r.published, r.published_deviation}; });
  const auto near_hull = [&](const MeasuredRung& r) { return r.vertices > 0 && r.distance < 0.1 ? std::optional(index(vertices, r.vertices)) : std::nullopt; };
  if (!vertices.empty()) draw(1, "hulls 0.001 apart: iterations over vertices", named_axis(sizes), count_axis(most_of_hulls), near_hull, [](const MeasuredRung& r) { return RungValue{r.iterations, r.deviation, {}, {}}; });
  if (!times.empty()) draw(2, "the same hulls: time a query", named_axis(sizes), time_axis(times), near_hull, [](const MeasuredRung& r) { return RungValue{r.nanoseconds, 0, r.published_nanoseconds, {}}; });
  grid.end();
  if (pointed) pointer.mark(theme), tell_rung(app, *pointed);
}

// --- The price of modelling too much, and motion ------------------------------------------------------------------------------

void price(App& app, ImVec2 at, ImVec2 size) {
  const MeasuredChart& chart = *app.measured.chart;
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  ImDrawList* list = ImGui::GetWindowDrawList();
  float names = 0, told = 0;
  double most = 0;
  const auto words = [](const MeasuredPrice& row) {
    return formatted(row.nanoseconds, "%.0f ns, ") + formatted(row.supports, "%.1f supports") + (row.worst_error > 0 ? ", error " + formatted(row.worst_error) : "");
  };
  for (const MeasuredPrice& row : chart.price) names = std::max(names, small_width(theme, row.what)), told = std::max(told, small_width(theme, words(row))), most = std::max(most, row.nanoseconds);
  const float from = at.x + names + theme.px(16), room = std::max(theme.px(40), at.x + size.x - from - told - theme.px(20));
  const float height = std::clamp(size.y / static_cast<float>(std::max<std::size_t>(1, chart.price.size())), theme.px(22), theme.px(44));
  for (std::size_t i = 0; i < chart.price.size(); ++i) {
    const MeasuredPrice& row = chart.price[i];
    const float y = at.y + height * static_cast<float>(i), width = room * static_cast<float>(row.nanoseconds / most);
    const bool again = row.what.starts_with("the same");
    const Colour colour = again ? p.text_faint : p.support;
    small_text(theme, {from - theme.px(10) - small_width(theme, row.what), y + height / 2 - theme.px(8)}, again ? p.text_soft : p.text, row.what);
    list->AddRectFilled({from, y + height * 0.18f}, {from + width, y + height * 0.82f}, packed(colour.with_alpha(0.75)), theme.px(3));
    small_text(theme, {from + width + theme.px(8), y + height / 2 - theme.px(8)}, p.text_soft, words(row));
  }
  ImGui::SetCursorScreenPos({at.x, at.y + height * static_cast<float>(chart.price.size())});
  ImGui::Dummy({1, 1});
}

void motion(App& app, ImVec2 at, ImVec2 size) {
  const MeasuredChart& chart = *app.measured.chart;
  const Theme& theme = app.theme;
  ImDrawList* list = ImGui::GetWindowDrawList();
  std::vector<std::string> names, methods;
  const auto join = [](std::vector<std::string>& all, const std::string& one) {
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  };
  for (const MeasuredMotion& m : chart.motion) join(names, m.family), join(methods, m.method);
  const Legend legend(theme, methods, at, size.x);
  const Grid grid(theme, legend.below, {size.x, at.y + size.y - legend.below.y}, static_cast<int>(names.size()), 2);
  Pointer pointer(theme);
  const MeasuredMotion* pointed = nullptr;
  for (std::size_t f = 0; f < names.size(); ++f) {
    std::vector<double> times;
    for (const MeasuredMotion& m : chart.motion)
      if (m.family == names[f]) times.push_back(m.nanoseconds);
    const bool free = names[f] == "free box";
    const Plot plot(theme, grid.corner(static_cast<int>(f)), grid.size(), names[f], free ? "time a step, over drift of energy" : "time a cast, over how early", error_axis(), time_axis(times));
    const MeasuredMotion* before = nullptr;
    for (const MeasuredMotion& m : chart.motion) {
      if (m.family != names[f]) continue;
      const int method = static_cast<int>(std::find(methods.begin(), methods.end(), m.method) - methods.begin());
      const auto place = [&](const MeasuredMotion& x) { return plot.place(std::max(x.worst_error, drawn_as_nothing), x.nanoseconds); };
      if (before && before->method == m.method) list->AddLine(place(*before), place(m), packed(legend.faded(theme, methods, method)), theme.px(1.4f));
      draw_mark(theme, m.method, place(m), legend.faded(theme, methods, method));
      if (legend.shows(method) && pointer.nearer(place(m))) pointed = &m;
      before = &m;
    }
  }
  grid.end();
  if (!pointed) return;
  pointer.mark(theme);
  const bool free = pointed->family == "free box";
  ImGui::BeginTooltip();
  ImGui::TextColored(vec(colour_of(pointed->method, theme.palette)), "%s, %s %g", pointed->method.c_str(), free ? "step" : "tolerance", pointed->parameter);
  ImGui::Text("%.0f ns, %s %.2g", pointed->nanoseconds, free ? "energy off by" : "early by at most", pointed->worst_error);
  ImGui::EndTooltip();
}

}  // namespace

const char* told_of(App::ChartView view) {
  switch (view) {
    case App::ChartView::error: return "The time of a query against the worst error of a family of pairs, a dot a tolerance; ringed: nothing is both faster and more accurate. Left and low is good.";
    case App::ChartView::gap: return "The time of a query against the gap between its certified bounds (the median of the pairs): what it takes to be sure. Other libraries have no bounds.";
    case App::ChartView::iterations: return "GJK's iterations by distance, mean and deviation, stopped at a duality gap of 1e-8; squares: as published.";
    case App::ChartView::price: return "The same pairs, modelled as they need and as they do not. The error is the one against what was meant.";
    case App::ChartView::motion: return "Casts by how early their worst time of impact is, none late; integrators by how far the energy of a free box drifts.";
  }
  return "";
}

void chart_area(App& app, ImVec2 at, ImVec2 size) {
  const MeasuredChart& chart = *app.measured.chart;
  const bool nothing = app.chart_view == App::ChartView::iterations ? chart.ladder.empty() : app.chart_view == App::ChartView::price ? chart.price.empty() : app.chart_view == App::ChartView::motion ? chart.motion.empty() : chart.families.empty();
  if (nothing) return wrapped("Not in this chart: only one of all families and methods has it.", app.theme.palette.text_soft);
  switch (app.chart_view) {
    case App::ChartView::error: return families(app, at, size, false);
    case App::ChartView::gap: return families(app, at, size, true);
    case App::ChartView::iterations: return iterations(app, at, size);
    case App::ChartView::price: return price(app, at, size);
    case App::ChartView::motion: return motion(app, at, size);
  }
}

}  // namespace gjkdbg
