// Charts and the atlas in the window: pointing at a dot or a cell tells what it is, clicking opens its worst scene.
#include <algorithm>
#include <cmath>

#include "debugger/view/app.h"

namespace gjkdbg {
namespace {

constexpr std::pair<const char*, std::uint32_t> peers[] = {{"Bullet", 0x8c8f96}, {"FCL", 0x7d8a5c}, {"libccd GJK", 0x9a7358}, {"libccd MPR", 0x5f8296}, {"ODE", 0x8f6c92}, {"Box2D", 0xa39a4a}};

/// A colour a method, whatever the scalar; other libraries in quieter ones.
Colour colour_of(const std::string& method, const Palette& p) {
  static constexpr std::pair<const char*, std::uint32_t> ours[] = {{"signed volumes", 0x3d8fe0}, {"Johnson", 0xe0663a}, {"Voronoi regions", 0x2fae83}, {"accelerated", 0xd07ab5},
                                                                   {"Polyak", 0xdca11d}, {"Newton", 0xb8446e},        {"MPR", 0x62b8e8},     {"SAT", 0xa8a032},     {"closed form", 0xb07cc6}, {"projections", 0xd64550}};
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

std::string formatted(double x, const char* format = "%.2g") {
  char text[32];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

/// Opens a scene at the first step that `check` finds wrong, else at the end.
void open_scene(App& app, SceneFile scene, const std::string& title) {
  try {
    app.session.open(std::move(scene), title);
    app.session.go_to(app.session.findings().empty() ? app.session.count() - 1 : app.session.findings().front().step);
    app.message.clear(), app.settings.selected.reset();
    app.show_lab = false;
  } catch (const Error& e) {
    app.message = e.line();
  }
}

void small_text(const Theme& theme, ImVec2 at, Colour colour, const std::string& text) {
  ImGui::GetWindowDrawList()->AddText(theme.small, theme.small->FontSize, at, packed(colour), text.c_str());
}
float small_width(const Theme& theme, const std::string& text) { return theme.small->CalcTextSizeA(theme.small->FontSize, FLT_MAX, 0, text.c_str()).x; }

// --- Speed against accuracy -------------------------------------------------------------------------------------------

constexpr double nothing = 1e-17;  ///< where an error of zero stands

/// One family: time up, error to the right, both logarithmic.
class FamilyPlot {
 public:
  FamilyPlot(const Theme& theme, const MeasuredChart& chart, const MeasuredFamily& family, ImVec2 at, ImVec2 size, int highlighted)
      : theme_(theme), chart_(chart), family_(family), at_(at), size_(size), highlighted_(highlighted) {
    low_ = 1e300, high_ = 0;
    for (const MeasuredDot& d : family.dots) low_ = std::min(low_, d.nanoseconds), high_ = std::max(high_, d.nanoseconds);
    low_ = std::floor(std::log10(low_)), high_ = std::max(low_ + 1, std::ceil(std::log10(std::max(high_, 1.0))));
    from_ = {at.x + theme_.px(46), at.y + theme_.px(34)}, to_ = {at.x + size.x - theme_.px(12), at.y + size.y - theme_.px(24)};
  }

  /// The dot pointed at.
  const MeasuredDot* draw() {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const Palette& p = theme_.palette;
    list->AddRectFilled(at_, {at_.x + size_.x, at_.y + size_.y}, packed(p.view), theme_.px(6));
    small_text(theme_, {at_.x + theme_.px(10), at_.y + theme_.px(6)}, p.text, family_.title);
    const std::string axes = "time a query, over worst error";
    const float room = size_.x - small_width(theme_, family_.title) - theme_.px(40);
    if (small_width(theme_, axes) < room) small_text(theme_, {to_.x - small_width(theme_, axes), at_.y + theme_.px(6)}, p.text_faint, axes);
    if (family_.dots.empty()) return nullptr;
    for (const double e : {std::log10(nothing), -12.0, -8.0, -4.0, 0.0}) {
      const float x = x_of(std::pow(10, e));
      list->AddLine({x, from_.y}, {x, to_.y}, packed(p.field), 1);
      const std::string label = e == 0 ? "1" : e < -16 ? "none" : "1e" + std::to_string(static_cast<int>(e));
      small_text(theme_, {x - small_width(theme_, label) / 2, to_.y + theme_.px(4)}, p.text_faint, label);
    }
    for (double t = low_; t <= high_; ++t) {
      const float y = y_of(std::pow(10, t));
      list->AddLine({from_.x, y}, {to_.x, y}, packed(p.field), 1);
      const std::string label = t < 3 ? formatted(std::pow(10, t), "%.0f ns") : t < 6 ? formatted(std::pow(10, t - 3), "%.0f \xC2\xB5s") : formatted(std::pow(10, t - 6), "%.0f ms");
      small_text(theme_, {from_.x - small_width(theme_, label) - theme_.px(4), y - theme_.px(7)}, p.text_faint, label);
    }
    for (std::size_t i = 0; i + 1 < family_.dots.size(); ++i)
      if (const MeasuredDot &a = family_.dots[i], &b = family_.dots[i + 1]; a.method == b.method) list->AddLine(place(a), place(b), packed(faded(a.method)), theme_.px(single(name(a)) ? 0.8f : 1.4f));
    const MeasuredDot* pointed = nullptr;
    float nearest = theme_.px(9);
    for (const MeasuredDot& d : family_.dots) {
      const ImVec2 x = place(d);
      draw_mark(theme_, name(d), x, faded(d.method));
      if (d.front && (highlighted_ < 0 || highlighted_ == d.method)) list->AddCircle(x, theme_.px(6), packed(p.text), 18, theme_.px(1));
      const ImVec2 mouse = ImGui::GetIO().MousePos;
      if (const float away = std::hypot(mouse.x - x.x, mouse.y - x.y); ImGui::IsWindowHovered() && away < nearest && (highlighted_ < 0 || highlighted_ == d.method)) nearest = away, pointed = &d;
    }
    if (pointed) list->AddCircle(place(*pointed), theme_.px(8), packed(p.accent), 20, theme_.px(2));
    return pointed;
  }

 private:
  const std::string& name(const MeasuredDot& d) const { return chart_.methods[static_cast<std::size_t>(d.method)]; }
  Colour faded(int method) const {
    Colour c = colour_of(chart_.methods[static_cast<std::size_t>(method)], theme_.palette);
    if (highlighted_ >= 0 && highlighted_ != method) c.a = 40;
    return c;
  }
  float x_of(double error) const { return from_.x + static_cast<float>((std::log10(std::clamp(error, nothing, 1.0)) + 17.5) / 17.5) * (to_.x - from_.x); }
  float y_of(double time) const { return to_.y - static_cast<float>((std::log10(time) - low_) / (high_ - low_)) * (to_.y - from_.y); }
  ImVec2 place(const MeasuredDot& d) const { return {x_of(d.worst_error), y_of(d.nanoseconds)}; }

  const Theme& theme_;
  const MeasuredChart& chart_;
  const MeasuredFamily& family_;
  ImVec2 at_, size_, from_, to_;
  int highlighted_;
  double low_ = 0, high_ = 1;
};

void tell_dot(App& app, const MeasuredChart& chart, const MeasuredFamily& family, const MeasuredDot& d) {
  const auto method = static_cast<std::size_t>(d.method);
  const auto scene = family.scenes.find(d.worst_pair);
  ImGui::BeginTooltip();
  ImGui::TextColored(vec(colour_of(chart.methods[method], app.theme.palette)), "%s, tolerance %g", chart.methods[method].c_str(), d.tolerance);
  ImGui::Text("%.0f ns a query, worst error %.2g%s", d.nanoseconds, d.worst_error, d.front ? "; nothing is both faster and more accurate" : "");
  if (d.wrong > 0) ImGui::TextColored(vec(app.theme.palette.newest), "%d of %d pairs wrong", d.wrong, family.pairs);
  if (scene != family.scenes.end()) ImGui::TextColored(vec(app.theme.palette.text_faint), chart.settings[method] ? "click: its worst pair" : "click: its worst pair, solved by our default");
  ImGui::EndTooltip();
  if (scene == family.scenes.end() || !ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
  SceneFile file = scene->second;
  if (chart.settings[method]) file.method = *chart.settings[method], file.method.tolerance = d.tolerance;
  open_scene(app, std::move(file), family.name + "-" + std::to_string(d.worst_pair));
}

void chart_area(App& app, ImVec2 at, ImVec2 size) {
  const MeasuredChart& chart = *app.measured.chart;
  const Theme& theme = app.theme;
  // The legend: pointing at a method leaves only its dots.
  int highlighted = -1;
  ImVec2 pen = at;
  for (std::size_t m = 0; m < chart.methods.size(); ++m) {
    const float width = small_width(theme, chart.methods[m]) + theme.px(26);
    if (pen.x + width > at.x + size.x) pen = {at.x, pen.y + theme.px(20)};
    const ImVec2 centre{pen.x + theme.px(8), pen.y + theme.px(9)};
    const Colour colour = colour_of(chart.methods[m], theme.palette);
    draw_mark(theme, chart.methods[m], centre, colour);
    const bool hovered = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(pen, {pen.x + width, pen.y + theme.px(18)});
    if (hovered) highlighted = static_cast<int>(m);
    small_text(theme, {pen.x + theme.px(16), pen.y + theme.px(2)}, hovered ? theme.palette.text : theme.palette.text_soft, chart.methods[m]);
    pen.x += width;
  }
  pen.y += theme.px(26);
  const int count = static_cast<int>(chart.families.size());
  if (count == 0) return;
  const int columns = std::min(count, size.x > theme.px(1000) ? 3 : size.x > theme.px(560) ? 2 : 1), rows = (count + columns - 1) / columns;
  const float gap = theme.px(8), width = (size.x - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
  const float height = std::max(theme.px(150), (at.y + size.y - pen.y - gap * static_cast<float>(rows - 1)) / static_cast<float>(rows));
  const MeasuredDot* pointed = nullptr;
  const MeasuredFamily* where = nullptr;
  for (int i = 0; i < count; ++i) {
    const MeasuredFamily& family = chart.families[static_cast<std::size_t>(i)];
    const ImVec2 corner{at.x + static_cast<float>(i % columns) * (width + gap), pen.y + static_cast<float>(i / columns) * (height + gap)};
    if (const MeasuredDot* d = FamilyPlot(theme, chart, family, corner, {width, height}, highlighted).draw()) pointed = d, where = &family;
  }
  ImGui::SetCursorScreenPos({at.x, pen.y + static_cast<float>(rows) * (height + gap)});
  ImGui::Dummy({1, 1});
  if (pointed) tell_dot(app, chart, *where, *pointed);
}

// --- Stability ----------------------------------------------------------------------------------------------------------

Colour verdict_colour(int verdict, const Palette& p) {
  static constexpr std::array<std::uint32_t, 8> colours{0x009e73, 0x5fbfa0, 0xf0e442, 0xe69f00, 0xcc79a7, 0xd55e00, 0x9a4600, 0x111111};
  return verdict < 8 ? rgb(colours[static_cast<std::size_t>(verdict)]) : p.field;
}

void tell_cell(App& app, const MeasuredAtlas& atlas, const MeasuredAtlas::Family& family, std::size_t m) {
  const MeasuredCell& cell = family.cells[m];
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(app.theme.px(460));
  ImGui::Text("%s, %s: %s", family.name.c_str(), atlas.methods[m].c_str(), atlas_verdicts[static_cast<std::size_t>(cell.verdict)]);
  if (cell.verdict != 8) ImGui::TextColored(vec(app.theme.palette.text_soft), "worst error %.2g at %g", cell.worst_error, cell.parameter);
  ImGui::TextUnformatted(cell.why.empty() ? family.what.c_str() : cell.why.c_str());
  if (cell.scene) ImGui::TextColored(vec(app.theme.palette.text_faint), "click: the simplest scene that fails so");
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  if (cell.scene && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    SceneFile scene = *cell.scene;
    scene.scene.description = atlas.methods[m] + ", " + atlas_verdicts[static_cast<std::size_t>(cell.verdict)] + ". " + cell.why;
    open_scene(app, std::move(scene), family.name + ", " + atlas.methods[m]);
  }
}

void atlas_area(App& app, ImVec2 at, ImVec2 size) {
  const MeasuredAtlas& atlas = *app.measured.atlas;
  const Theme& theme = app.theme;
  const Palette& p = theme.palette;
  ImDrawList* list = ImGui::GetWindowDrawList();
  ImVec2 pen = at;
  for (int v = 0; v < static_cast<int>(atlas_verdicts.size()); ++v) {
    const std::string name = atlas_verdicts[static_cast<std::size_t>(v)];
    const float width = small_width(theme, name) + theme.px(34);
    if (pen.x + width > at.x + size.x) pen = {at.x, pen.y + theme.px(20)};
    list->AddRectFilled({pen.x, pen.y + theme.px(3)}, {pen.x + theme.px(14), pen.y + theme.px(15)}, packed(verdict_colour(v, p)), theme.px(3));
    small_text(theme, {pen.x + theme.px(19), pen.y + theme.px(2)}, p.text_soft, name);
    pen.x += width;
  }
  const std::size_t rows = atlas.methods.size(), columns = atlas.families.size();
  if (rows == 0 || columns == 0) return;
  const float label = theme.px(150), top = pen.y + theme.px(52), gap = theme.px(2);
  const float width = std::min(theme.px(90), (size.x - label) / static_cast<float>(columns)), height = std::clamp((at.y + size.y - top) / static_cast<float>(rows), theme.px(18), theme.px(34));
  for (std::size_t f = 0; f < columns; ++f) {
    const std::string& name = atlas.families[f].name;
    const ImVec2 low{at.x + label + width * static_cast<float>(f), top - theme.px(22)};
    const bool hovered = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, {low.x + width, top});
    small_text(theme, {low.x + (width - small_width(theme, name)) / 2, low.y + theme.px(2)}, hovered ? p.text : p.text_soft, name);
    if (hovered) ImGui::SetTooltip("%s: %s", name.c_str(), atlas.families[f].what.c_str());
  }
  const MeasuredAtlas::Family* pointed = nullptr;
  std::size_t pointed_method = 0;
  for (std::size_t m = 0; m < rows; ++m) {
    const float y = top + height * static_cast<float>(m);
    small_text(theme, {at.x, y + height / 2 - theme.px(7)}, p.text_soft, atlas.methods[m]);
    for (std::size_t f = 0; f < columns; ++f) {
      const MeasuredCell& cell = atlas.families[f].cells[m];
      const ImVec2 low{at.x + label + width * static_cast<float>(f), y}, high{low.x + width - gap, y + height - gap};
      list->AddRectFilled(low, high, packed(verdict_colour(cell.verdict, p)), theme.px(3));
      const std::string text = cell.verdict == 7 ? "\xC3\x97" : cell.verdict == 8 || cell.worst_error == 0 ? "" : formatted(cell.worst_error, "%.0e");
      const bool dark_text = cell.verdict >= 1 && cell.verdict <= 4;
      if (small_width(theme, text) + theme.px(4) < width) small_text(theme, {(low.x + high.x - small_width(theme, text)) / 2, (low.y + high.y) / 2 - theme.px(7)}, rgb(dark_text ? 0x141414 : 0xffffff), text);
      if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(low, high)) {
        pointed = &atlas.families[f], pointed_method = m;
        list->AddRect(low, high, packed(p.text), theme.px(3), 0, theme.px(2));
      }
    }
  }
  ImGui::SetCursorScreenPos({at.x, top + height * static_cast<float>(rows)});
  ImGui::Dummy({1, 1});
  if (pointed) tell_cell(app, atlas, *pointed, pointed_method);
}

}  // namespace

void lab_panel(App& app, const Area& area) {
  const Theme& theme = app.theme;
  if (begin_area("lab", area, true)) {
    for (const auto& [name, value] : {std::pair("Speed against accuracy", App::LabTab::chart), {"Stability where methods fail", App::LabTab::atlas}}) {
      if (tab_button(theme, name, app.lab_tab == value)) app.lab_tab = value;
      ImGui::SameLine();
    }
    const bool chart = app.lab_tab == App::LabTab::chart, there = chart ? app.measured.chart.has_value() : app.measured.atlas.has_value();
    if (app.measuring) ImGui::TextColored(vec(theme.palette.text_soft), "measuring, some seconds ...");
    else if (ImGui::Button(there ? "Measure again" : "Measure now")) app.measure_requested = chart ? "chart" : "atlas";
    ImGui::SameLine();
    const float right = ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize("Back to the scene").x - theme.px(18);
    if (right > ImGui::GetCursorPosX()) ImGui::SetCursorPosX(right);
    if (ImGui::Button("Back to the scene")) app.show_lab = false;
    ImGui::Dummy({0, theme.px(2)});
    wrapped(chart ? "Time a query against the worst error of a family of pairs, a dot a tolerance; ringed: nothing is both faster and more accurate. Left and low is good."
                  : "The worst verdict of every family of hard pairs, a row a method. Point at a family for what it is, at a cell for the reason.",
            theme.palette.text_faint);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x, area.y + area.height - at.y - theme.px(14)};
    if (!there)
      wrapped("Nothing measured yet. \"Measure now\" runs gjkdbg " + std::string(chart ? "chart" : "atlas") + " --quick; Open or drop " + (chart ? "a chart" : "an atlas") + ".json of a full run to see that one.", theme.palette.text_soft);
    else if (chart) chart_area(app, at, size);
    else atlas_area(app, at, size);
  }
  ImGui::EndChild();
}

}  // namespace gjkdbg
