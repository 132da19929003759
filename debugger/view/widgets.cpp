#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string_view>
#include <utility>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"
#include "debugger/view/plot.h"

namespace gjkdbg {

bool begin_area(const char* name, const Area& area, bool scrolls) {
  ImGui::SetCursorScreenPos({area.x, area.y});
  return ImGui::BeginChild(name, {area.width, area.height}, false,
                           ImGuiWindowFlags_AlwaysUseWindowPadding | (scrolls ? 0 : ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse));
}

bool has_small_margin(const Theme& theme, const Area& area) { return area.height < theme.px(100); }

bool begin_panel(const Theme& theme, const char* name, const Area& area, bool scrolls) {
  const bool low = has_small_margin(theme, area);
  if (low) ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(10), theme.px(7)});
  const bool seen = begin_area(name, area, scrolls);
  if (low) ImGui::PopStyleVar();  // tooltips have theirs
  return seen;
}

bool begin_list(const char* name) { return ImGui::BeginChild(name, {0, 0}, false); }

/// Left of the panel, where there is room, so that it covers nothing of it.
void tell_meaning(const Theme& theme, const char* name) {
  if (!ImGui::IsItemHovered()) return;
  const std::string meaning = glossary(name);
  if (meaning.empty()) return;
  const ImVec2 panel = ImGui::GetWindowPos();
  if (panel.x > theme.px(420)) ImGui::SetNextWindowPos({panel.x - theme.px(6), ImGui::GetItemRectMin().y}, ImGuiCond_Always, {1, 0});
  tooltip(theme, meaning);
}

void section(const Theme& theme, const char* title) {
  ImGui::Dummy({0, theme.px(4)});
  ImGui::PushFont(theme.small);
  wrapped(title, theme.palette.text_faint);
  ImGui::PopFont();
  tell_meaning(theme, title);
}

std::string shortened(const ImFont* font, const std::string& text, float room) {
  const auto width = [&](const std::string& t) { return font->CalcTextSizeA(font->FontSize, 1e6f, 0, t.c_str()).x; };
  if (width(text) <= room) return text;
  std::string cut = text;
  const auto inside_a_letter = [&] { return (cut.back() & 0xC0) == 0x80; };  // of several bytes
  while (!cut.empty() && width(cut + "\xE2\x80\xA6") > room) {
    while (inside_a_letter()) cut.pop_back();
    cut.pop_back();
    while (!cut.empty() && cut.back() == ' ') cut.pop_back();
  }
  return cut + "\xE2\x80\xA6";
}

namespace {

float width_of(const std::string& text, std::size_t from, std::size_t end) { return ImGui::CalcTextSize(text.data() + from, text.data() + end).x; }

/// A vector, "(1, 2, 3)," stays on one line where that has room for it.
std::size_t end_of_term(const std::string& text, std::size_t from, float room) {
  const std::size_t end = std::min(text.find_first_of(" \n", from), text.size());
  const bool numbers = from + 1 < text.size() && text[from] == '(' && std::string_view("-0123456789").find(text[from + 1]) != std::string_view::npos;
  const std::size_t close = numbers ? text.find(')', from) : std::string::npos;
  if (close == std::string::npos || close < end) return end;
  const std::size_t whole = std::min(text.find_first_of(" \n", close), text.size());
  return width_of(text, from, whole) <= room ? whole : end;
}

/// Of a sign that stands between two terms, blanks around it: where the second one begins; 0 where there is none.
std::size_t after_sign(const std::string& text, std::size_t end) {
  for (const std::string_view sign : {" = ", " - ", " . ", " \xE2\x88\x92 ", " + ", " < ", " > ", " <= ", " >= "})
    if (std::string_view(text).substr(end).starts_with(sign) && text[end - 1] != ',' && text[end - 1] != '.') return end + sign.size();
  return std::string_view(text).substr(end).starts_with(" -v") ? end + 1 : 0;
}

/// So do the two sides of a sign, "w = a - b" or "|v| = 1.5", and "along -v", as many of them as there is room for.
std::size_t end_of_word(const std::string& text, std::size_t from, float room) {
  std::size_t end = end_of_term(text, from, room);
  while (const std::size_t second = end > from ? after_sign(text, end) : 0) {
    const std::size_t longer = end_of_term(text, second, room);
    if (width_of(text, from, longer) > room) break;
    end = longer;
  }
  return end;
}

}  // namespace

std::string broken_into_lines(const std::string& text, float room) {
  const auto width = [](const std::string& t) { return ImGui::CalcTextSize(t.c_str()).x; };
  const float space = width(" ");
  std::string lines;
  float used = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = end_of_word(text, i, room);
    std::string word = text.substr(i, end - i);
    if (used > 0 && used + space + width(word) > room) lines += '\n', used = 0;
    else if (i > 0 && text[i - 1] == ' ' && !lines.empty() && used > 0) lines += ' ', used += space;
    while (width(word) > room && word.size() > 1) {
      std::size_t fit = 1;
      while (fit + 1 < word.size() && (width(word.substr(0, fit + 1)) <= room || (word[fit] & 0xC0) == 0x80)) ++fit;
      lines += word.substr(0, fit) + '\n', word.erase(0, fit);
    }
    lines += word, used += width(word);
    if (end < text.size() && text[end] == '\n') lines += '\n', used = 0;
    i = end + 1;
  }
  return lines;
}

void wrapped(const std::string& text, Colour colour, float room) { ImGui::TextColored(vec(colour), "%s", broken_into_lines(text, room).c_str()); }
void wrapped(const std::string& text, Colour colour) { wrapped(text, colour, ImGui::GetContentRegionAvail().x); }

void number_row(const Theme& theme, const char* label, const std::string& value, Colour colour) {
  const float left = ImGui::GetCursorPosX(), label_end = left + ImGui::CalcTextSize(label).x + theme.px(6);
  ImGui::TextColored(vec(theme.palette.text_soft), "%s", label);
  tell_meaning(theme, label);
  ImGui::PushFont(theme.mono);
  const float right = ImGui::GetWindowContentRegionMax().x, at = right - ImGui::CalcTextSize(value.c_str()).x;
  if (at > label_end) {
    ImGui::SameLine(at);
    ImGui::TextColored(vec(colour), "%s", value.c_str());
  } else {  // no room beside the label: below it; far-out places have so many digits that they take lines
    ImGui::BeginGroup();
    std::istringstream lines(broken_into_lines(value, right - left));
    for (std::string line; std::getline(lines, line);) {
      ImGui::SetCursorPosX(right - ImGui::CalcTextSize(line.c_str()).x);
      ImGui::TextColored(vec(colour), "%s", line.c_str());
    }
    ImGui::EndGroup();
  }
  ImGui::PopFont();
}

void tooltip(const Theme& theme, const std::string& text) {
  ImGui::BeginTooltip();
  ImGui::TextUnformatted(broken_into_lines(text, theme.px(372)).c_str());
  ImGui::EndTooltip();
}

void tip_beside_row(const Theme& theme, const char* text) {
  if (*text == 0 || !ImGui::IsItemHovered()) return;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax(), size = ImGui::CalcTextSize(text), pad = ImGui::GetStyle().WindowPadding, window = ImGui::GetIO().DisplaySize;
  const float height = size.y + 2 * pad.y, gap = theme.px(5), below = high.y + gap;
  ImGui::SetNextWindowPos({std::max(0.f, std::min(low.x, window.x - size.x - 2 * pad.x)), below + height < window.y / 2 ? below : low.y - gap - height});
  ImGui::SetTooltip("%s", text);
}

void number_row(App& app, const char* label, const std::string& value, Colour colour, std::optional<std::size_t> source, const std::string& exact) {
  number_row(app.theme, label, value, colour);
  if (source && *source >= app.session.count()) source.reset();
  if ((!source && exact.empty()) || !ImGui::IsItemHovered()) return;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  std::string tip = exact.empty() ? "" : exact + "\nright click: copy";
  if (source) {
    ImGui::GetWindowDrawList()->AddLine({low.x, high.y}, {high.x, high.y}, packed(colour), 1);
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    tip += (tip.empty() ? "" : "\n") + ("from step " + std::to_string(*source)) + ": click to go there";
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) app.session.playing = false, app.session.go_to(*source);
  }
  if (!exact.empty() && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) ImGui::SetClipboardText(exact.c_str());
  ImGui::SetTooltip("%s", tip.c_str());
}

std::string all_digits(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::vector<std::string> at_one_point(const std::vector<double>& values) {
  constexpr std::size_t most = 7;  // characters from the point on
  const auto from_the_point = [](const std::string& text) { return text.size() - std::min(text.find_first_of(".e"), text.size()); };
  const auto has_places = [](const std::string& text) { return text.find('.') != std::string::npos && text.find('e') == std::string::npos; };
  std::vector<std::string> texts;
  std::size_t longest = 0;
  for (const double value : values) {
    std::string text = short_number(value);
    if (from_the_point(text) > most) text = formatted(value, std::abs(value) < 1e-2 || text.find('e') != std::string::npos ? "%.2e" : "%.6f");
    if (has_places(text)) longest = std::max(longest, from_the_point(text));
    texts.push_back(std::move(text));
  }
  for (std::string& text : texts)
    if (has_places(text)) text.append(longest - from_the_point(text), ' ');
  return texts;
}

void number_row(App& app, const char* label, double value, Colour colour, std::optional<std::size_t> source) { number_row(app, label, short_number(value), colour, source, all_digits(value)); }

void number_row(App& app, const char* label, const AnyVector& value, Colour colour, std::optional<std::size_t> source, int digits) {
  std::string exact;
  for (const double x : value) exact += (exact.empty() ? "(" : ", ") + all_digits(x);
  number_row(app, label, short_vector(value, digits), colour, source, exact + ")");
}

bool tab_button(const Theme& theme, const char* name, bool current, float width) {
  ImGui::PushStyleColor(ImGuiCol_Text, vec(current ? theme.palette.text : theme.palette.text_faint));
  ImGui::PushStyleColor(ImGuiCol_Button, vec(current ? theme.palette.field : theme.palette.panel));
  const bool pressed = ImGui::Button(name, {width, 0});
  ImGui::PopStyleColor(2);
  return pressed;
}

void chip(const Theme& theme, const std::string& text, Colour colour) {
  ImGui::PushFont(theme.small);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str()), at = ImGui::GetCursorScreenPos();
  const ImVec2 end{at.x + size.x + theme.px(22), at.y + size.y + theme.px(10)};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, end, packed(colour.with_alpha(theme.dark ? 0.2 : 0.14)), theme.px(12));
  draw->AddText({at.x + theme.px(11), at.y + theme.px(5)}, packed(theme.dark ? colour.shaded(0.35) : colour.shaded(-0.25)), text.c_str());
  ImGui::Dummy({end.x - at.x, end.y - at.y});
  ImGui::PopFont();
}

Colour event_colour(const Palette& p, const Event& event) {
  struct {
    const Palette& p;
    Colour operator()(const recorded::GjkBegan&) const { return p.text; }
    Colour operator()(const recorded::VertexKept&) const { return p.support; }
    Colour operator()(const recorded::SupportQueried&) const { return p.support; }
    Colour operator()(const recorded::SimplexReduced&) const { return p.simplex; }
    Colour operator()(const recorded::GjkEnded&) const { return p.text; }
    Colour operator()(const recorded::PolytopeSeeded&) const { return p.frontier; }
    Colour operator()(const recorded::FaceChosen&) const { return p.chosen; }
    Colour operator()(const recorded::PolytopeGrown&) const { return p.frontier; }
    Colour operator()(const recorded::EpaEnded&) const { return p.text; }
    Colour operator()(const recorded::MprBegan&) const { return p.text; }
    Colour operator()(const recorded::PortalFound&) const { return p.chosen; }
    Colour operator()(const recorded::MprEnded&) const { return p.text; }
    Colour operator()(const recorded::SatBegan&) const { return p.text; }
    Colour operator()(const recorded::AxisTested&) const { return p.chosen; }
    Colour operator()(const recorded::PointsProjected&) const { return p.simplex; }
    Colour operator()(const recorded::SatEnded&) const { return p.text; }
    Colour operator()(const recorded::ClosedFormBegan&) const { return p.text; }
    Colour operator()(const recorded::LinesSolved&) const { return p.simplex; }
    Colour operator()(const recorded::ClosedFormEnded&) const { return p.text; }
    Colour operator()(const recorded::ProjectionsBegan&) const { return p.text; }
    Colour operator()(const recorded::PointPredicted&) const { return p.chosen; }
    Colour operator()(const recorded::ProjectionsEnded&) const { return p.text; }
    Colour operator()(const recorded::CastBegan&) const { return p.text; }
    Colour operator()(const recorded::CastAdvanced&) const { return p.accent; }
    Colour operator()(const recorded::CastEnded&) const { return p.text; }
    Colour operator()(const recorded::State&) const { return p.accent; }
    Colour operator()(const recorded::ContactFound&) const { return p.chosen; }
    Colour operator()(const recorded::ImpulseApplied&) const { return p.body_b; }
    Colour operator()(const recorded::Warning&) const { return p.newest; }
  } colours{p};
  return std::visit(colours, event);
}

namespace {

template <class... Kinds>
bool one_of(const Event& event) { return (std::holds_alternative<Kinds>(event) || ...); }

}  // namespace

float event_share(const Event& event) {
  if (one_of<recorded::FaceChosen, recorded::PortalFound, recorded::AxisTested, recorded::PointPredicted, recorded::ContactFound>(event)) return 0.4f;
  if (one_of<recorded::SupportQueried, recorded::VertexKept>(event)) return 0.6f;
  return one_of<recorded::SimplexReduced, recorded::PointsProjected, recorded::LinesSolved>(event) ? 0.85f : 1.f;
}

const char* short_kind(const Event& event) {
  static const char* const names[] = {"begin", "kept", "support", "simplex", "end", "polytope", "nearest", "grow", "end", "begin", "portal", "end", "begin", "axis", "points", "end", "begin", "lines", "end", "begin", "newton", "end", "begin", "advance", "end", "state", "contact", "impulse", "warning"};
  static_assert(std::size(names) == std::variant_size_v<Event>);
  return names[event.index()];
}

std::string method_text(const Recording& recording) {
  if (foreign(recording)) return "your solver";  // whatever method the file names
  const Settings& s = recording.settings;
  std::string text(word_of(s.name));
  if (s.name == MethodName::gjk_accelerated && s.acceleration != Acceleration::nesterov) text += " \xC2\xB7 " + std::string(word_of(s.acceleration));
  if (s.closest_point != ClosestPoint::signed_volumes) text += " \xC2\xB7 " + std::string(word_of(s.closest_point));
  if (s.stopping != Stopping::bounds) text += " \xC2\xB7 " + std::string(word_of(s.stopping));
  if (s.start == Start::previous) text += " \xC2\xB7 warm";
  return text + " \xC2\xB7 " + std::string(word_of(s.scalar));
}

namespace {

/// A field of an event, as the panels call it.
std::string in_words_of_the_panel(std::string field) {
  for (const auto& [name, words] : {std::pair("barycentric", "the weights"), {"closest", "v"}, {"region", "the part that is kept"}, {"vertex", "the vertex"}, {"w", "w"}})
    if (field == name) return words;
  std::replace(field.begin(), field.end(), '_', ' ');
  return field;
}

std::string in_words(const SharedSupports& shared) {
  if (shared.first == 0) return "";
  if (shared.all) return "; as far as both go, all supports are the same";
  return "; the first " + (shared.first == 1 ? std::string("support is") : std::to_string(shared.first) + " supports are") + " the same";
}

/// What differs where two runs part: kinds, or fields, with how much their numbers differ by.
std::string what_parts(const Session& session) {
  const Difference& p = *session.parting();
  const auto kind = [&](const Recording& run) { return p.event < run.events.size() ? "\"" + std::string(short_kind(run.events[p.event])) + "\"" : std::string("nothing more"); };
  if (p.fields.empty()) return ": " + kind(session.recording()) + " here, " + kind(session.other()) + " beside" + in_words(session.shared_supports());
  std::string text;
  for (std::size_t i = 0; i < p.fields.size(); ++i) {
    text += (i == 0 ? ": " : ", ") + in_words_of_the_panel(p.fields[i]);
    if (!std::isnan(p.by[i])) text += " by " + short_number(p.by[i]);
  }
  return text;
}

}  // namespace

std::string parting_text(const Session& session) {
  if (session.unlike()) return "two algorithms: no step of one is the other's, and only their answers compare";
  const std::string but = session.alike_but();
  const auto& p = session.parting();
  if (!p) return "the same" + but + ", step by step";
  if (p->event >= std::max(session.count(), session.other().events.size())) return "the same" + but + ", step by step; the results differ" + what_parts(session);
  return (session.step() < p->event ? "the same so far" + but + "; " : "") + "they part at step " + std::to_string(p->event) + what_parts(session);
}

std::string ending_text(const Session& session) {
  const std::size_t here = session.count() - 1, beside = session.other().events.size() - 1;
  if (here == beside) return {};
  if (here < beside) return "it goes on for " + std::to_string(beside - here) + (beside - here == 1 ? " step" : " steps") + " longer than this run, to step " + std::to_string(beside);
  return session.step() > beside ? "it has ended, at step " + std::to_string(beside) : "it ends at step " + std::to_string(beside) + ", before this run";
}

bool answers_agree(const Result& a, const Result& b) {
  const auto near = [](const std::optional<double>& x, const std::optional<double>& y) { return x.has_value() == y.has_value() && (!x || std::abs(*x - *y) <= 1e-9); };
  return !unanswered(a) && !unanswered(b) && a.intersecting == b.intersecting && near(a.signed_distance, b.signed_distance) && near(a.time, b.time) && near(a.energy, b.energy);
}

bool unproven(const Result& r) { return r.signed_distance && r.lower_bound && r.upper_bound && *r.upper_bound - *r.lower_bound > 1e-4 * std::abs(*r.signed_distance); }

std::string result_text(const Recording& recording) {
  const Result& r = recording.result;
  if (recording.scene.scene.query == Query::simulate) return "time " + short_number(r.time.value_or(0)) + ", energy " + short_number(r.energy.value_or(0)) + (r.status == "contact_unknown" ? ", a contact unknown" : "");
  if (recording.scene.scene.query == Query::cast) return r.intersecting ? r.status == "hit" ? "hit at " + short_number(*r.time) : "overlapping at first" : r.status.text();
  if (unanswered(r)) return r.lower_bound && r.upper_bound ? "undecided, between " + short_number(*r.lower_bound) + " and " + short_number(*r.upper_bound) : "undecided";
  std::string text = r.intersecting ? "overlapping" : "apart";
  if (r.signed_distance) {
    const double d = *r.signed_distance;
    const bool proven = !unproven(r);
    text = d > 0 && r.lower_bound.value_or(d) <= 0 ? "seem apart, by at most " + short_number(r.upper_bound.value_or(d)) : d > 0 ? "apart, distance " + (proven ? short_number(d) : "at most " + short_number(*r.upper_bound)) : d == 0 ? "touching" : "overlapping, depth " + (proven ? short_number(-d) : "at most " + short_number(-*r.lower_bound));
    if (recording.scene.scene.query == Query::distance && r.intersecting) text = "overlapping";
  }
  return text;
}

}  // namespace gjkdbg
