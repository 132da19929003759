// The right panel: what the step means, the simplex with its weights, the bounds, the algorithm's lines, the selected vertex.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"
#include "debugger/view/plot.h"
#include "debugger/view/step_notes.h"
#include "recordings/mesh_parts.h"
#include "recordings/region_tests.h"

namespace gjkdbg {
namespace {

/// The last event up to this step for which `is` holds: where a number on show came from.
template <class Is>
std::optional<std::size_t> source(const Session& s, Is&& is) {
  for (std::size_t i = s.step() + 1; i-- > 0;)
    if (is(s.recording().events[i])) return i;
  return std::nullopt;
}
template <class... Kinds>
std::optional<std::size_t> last_of(const Session& s) {
  return source(s, [](const Event& e) { return (std::holds_alternative<Kinds>(e) || ...); });
}

/// What runs at a step, for people.
const char* phase_name(const Event& event, const Frame& frame) {
  if (const auto* query = std::get_if<recorded::SupportQueried>(&event); query && query->phase == Phase::cast) return "ray";
  if (event.index() >= Event(recorded::CastBegan{}).index() && !std::holds_alternative<recorded::Warning>(event)) return "motion";
  if (phase_of(event) == 1) return "EPA";
  if (frame.stage == Frame::Stage::mpr || frame.mpr_status) return "MPR";
  if (frame.stage == Frame::Stage::sat || frame.sat_status) return "SAT";
  if (frame.stage == Frame::Stage::closed_form || frame.closed_form_status) return "closed form";
  if (frame.stage == Frame::Stage::projections || std::holds_alternative<recorded::ProjectionsEnded>(event)) return "projections";
  return "GJK";
}

/// Of a mesh: which triangle the step is about; empty where there is none.
std::string triangle_name(Session& session) {
  const auto parts = mesh_parts(session.recording(), session.frame());
  return parts ? "Triangle " + std::to_string(parts->run + 1) + " of " + std::to_string(parts->runs) : "";
}

void heading(App& app) {
  Session& session = app.session;
  const Theme& theme = app.theme;
  const Explanation e = explain(session.recording(), session.frame(), app.settings.newest_first);
  ImGui::PushFont(theme.small);
  std::string place = place_text(session);
  if (session.frame().time) {
    const std::string time = "time " + short_number(*session.frame().time), beside = place + "  \xC2\xB7  " + time;
    place = ImGui::CalcTextSize(beside.c_str()).x <= ImGui::GetContentRegionAvail().x - theme.px(8) ? beside : place + "\n" + time;
  }
  wrapped(place, theme.palette.text_faint);
  if (const std::string triangle = triangle_name(session); !triangle.empty()) wrapped(triangle + ", a convex set of its own", theme.palette.text_faint);
  ImGui::PopFont();
  ImGui::PushFont(theme.title);
  ImGui::TextWrapped("%s", e.title.c_str());
  ImGui::PopFont();
  finding_first(app);
  wrapped(e.text, theme.palette.text_soft);
}

/// A bar per vertex of the simplex: its share in the nearest point.
void weights(App& app) {
  const Frame& frame = app.session.frame();
  const Theme& theme = app.theme;
  if (frame.simplex.empty() && frame.dropped.empty()) return;
  section(theme, frame.barycentric.empty() ? "SIMPLEX" : "SIMPLEX, BARYCENTRIC WEIGHTS");
  const float left = ImGui::GetCursorScreenPos().x, width = ImGui::GetContentRegionAvail().x, row = ImGui::GetTextLineHeight() + theme.px(4);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const std::vector<std::string> values = at_one_point(frame.barycentric);
  for (std::size_t i = 0; i < frame.simplex.size(); ++i) {
    const float y = ImGui::GetCursorScreenPos().y;
    const bool newest = frame.newest == frame.simplex[i];
    ImGui::TextColored(vec(newest ? theme.palette.newest : theme.palette.simplex), "%s", simplex_letter(frame, frame.simplex[i], app.settings.newest_first).c_str());
    ImGui::SameLine(theme.px(34));
    ImGui::PushFont(theme.mono);
    ImGui::TextColored(vec(theme.palette.text_faint), "#%d", frame.simplex[i]);
    if (i < frame.barycentric.size()) {
      const std::string& value = values[i];
      const float from = left + theme.px(64), to = left + width - theme.px(78);
      draw->AddRectFilled({from, y + theme.px(5)}, {to, y + theme.px(13)}, packed(theme.palette.field), theme.px(3));
      const auto share = static_cast<float>(std::clamp(frame.barycentric[i], 0.0, 1.0));
      draw->AddRectFilled({from, y + theme.px(5)}, {from + (to - from) * share, y + theme.px(13)}, packed(theme.palette.simplex), theme.px(3));
      ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x);
      ImGui::Text("%s", value.c_str());
    }
    ImGui::PopFont();
    ImGui::SetCursorScreenPos({left, y + row});
  }
  for (const int v : frame.dropped) ImGui::TextColored(vec(theme.palette.dropped), "%s  #%d dropped", simplex_letter(frame, v, app.settings.newest_first).c_str(), v);
}

std::string three_digits(double x) { return formatted(x == 0 ? 0 : x, "%.3g"); }

/// Where O's foot on a part lies. `letters`: of its vertices; `least`: the one with the smallest weight.
std::string projection_text(const RegionTest& test, const std::string& letters, std::size_t least) {
  if (test.weights.size() == 1) return letters + " is " + three_digits(test.distance) + " from O";
  std::vector<std::size_t> order(letters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return letters[i] < letters[j]; });
  std::string name, sum;
  for (const std::size_t i : order) {
    const double w = test.weights[i];
    name += letters[i];
    sum += (sum.empty() ? w < 0 ? "-" : "" : w < 0 ? " - " : " + ") + three_digits(std::abs(w)) + " " + letters[i];
  }
  const std::string smallest = three_digits(test.weights[least]);
  return "O's foot on " + name + ": " + sum + ", " + three_digits(test.distance) + " from O\n" +
         (test.holds_projection ? "its smallest weight is " + smallest + ": that far from the other answer, outside" : "the weight of " + std::string(1, letters[least]) + " is " + smallest + ": below 0, so it lies outside of " + name);
}

/// Every part of the simplex as it was before the cut: its weights, whether it holds its projection, how close that was.
void regions(App& app) {
  const auto* e = std::get_if<recorded::SimplexReduced>(&app.session.recording().events[app.session.step()]);
  if (!e || e->before.size() < 2 || e->before.size() > 4) return;
  const Theme& theme = app.theme;
  const Frame& frame = app.session.frame();
  std::vector<AnyVector> points;
  for (const int v : e->before) {
    const auto found = frame.vertices.find(v);
    if (found == frame.vertices.end()) return;
    points.push_back(found->second.w);
  }
  section(theme, "EVERY PART: |v|, OR A WEIGHT < 0");
  ImGui::PushFont(theme.mono);
  const float right = ImGui::GetWindowContentRegionMax().x;
  const std::vector<RegionTest> tests = region_tests(points);
  std::vector<double> numbers;
  for (const RegionTest& test : tests) numbers.push_back(test.holds_projection ? test.distance : *std::min_element(test.weights.begin(), test.weights.end()));
  const std::vector<std::string> texts = at_one_point(numbers);
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const RegionTest& test = tests[k];
    std::string part, why = texts[k];
    for (const int i : test.part) part += vertex_letter(app.settings.newest_first ? i : static_cast<int>(points.size()) - 1 - i);
    const std::size_t least = static_cast<std::size_t>(std::min_element(test.weights.begin(), test.weights.end()) - test.weights.begin());
    const std::string tip = projection_text(test, part, least);
    if (!test.holds_projection) why = std::string("\xCE\xBB") + part[least] + " " + why;
    std::sort(part.begin(), part.end());
    const Colour colour = test.nearest ? theme.palette.simplex : test.holds_projection ? theme.palette.text_soft : theme.palette.dropped;
    ImGui::TextColored(vec(colour), "%s %s", test.nearest ? ">" : " ", part.c_str());
    ImGui::SameLine(theme.px(78));
    ImGui::TextColored(vec(colour), "%s", test.nearest ? "nearest" : test.holds_projection ? "farther" : "outside");
    ImGui::SameLine(right - ImGui::CalcTextSize(why.c_str()).x);
    ImGui::TextColored(vec(colour), "%s", why.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip.c_str());
  }
  ImGui::PopFont();
}

void counters(App& app) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  int supports = 0, grown = 0;
  std::size_t dropped = 0;
  for (std::size_t i = 0; i <= s.step(); ++i) {
    supports += std::holds_alternative<recorded::SupportQueried>(s.recording().events[i]);
    if (const auto* cut = std::get_if<recorded::SimplexReduced>(&s.recording().events[i])) dropped += cut->before.size() - std::min(cut->before.size(), cut->region.size());
    grown += std::holds_alternative<recorded::PolytopeGrown>(s.recording().events[i]);
  }
  section(theme, "SO FAR");
  const int all = s.recording().result.support_calls;
  const std::string of_all = s.step() + 1 == s.count() && all > supports ? " of all " + std::to_string(all) : "";
  std::string text = std::to_string(supports) + of_all + (supports == 1 && of_all.empty() ? " support" : " supports");
  if (dropped > 0) text += ", " + std::to_string(dropped) + " dropped";
  if (grown > 0) text += ", " + std::to_string(grown) + " grown";
  number_row(theme, "in these steps", text, theme.palette.text_soft);
}

void faces(App& app) {
  const Frame& frame = app.session.frame();
  if (frame.faces.empty()) return;
  const Theme& theme = app.theme;
  section(theme, "POLYTOPE");
  const std::string facet = facet_name(app.session.recording());
  number_row(theme, (facet + "s").c_str(), std::to_string(frame.faces.size()), theme.palette.text);
  if (!frame.added.empty() && !frame.removed.empty()) number_row(theme, "removed / added", std::to_string(frame.removed.size()) + " / " + std::to_string(frame.added.size()), theme.palette.frontier);
  if (frame.chosen && frame.faces.contains(*frame.chosen)) {
    const FrameFace& f = frame.faces.at(*frame.chosen);
    number_row(app, (foreign(app.session.recording()) ? facet + " chosen" : "nearest " + facet).c_str(), std::to_string(f.face), theme.palette.chosen, f.event);
    number_row(app, "its distance", short_number(f.distance), theme.palette.chosen, f.event, all_digits(f.distance));
    number_row(app, "its normal", f.normal, theme.palette.chosen, f.event);
  }
}

void bounds(App& app) {
  const Frame& frame = app.session.frame();
  const Theme& theme = app.theme;
  if (!frame.lower_bound && !frame.upper_bound) return;
  const Event& event = app.session.recording().events[app.session.step()];
  const bool before = std::holds_alternative<recorded::SupportQueried>(event) || std::holds_alternative<recorded::PolytopeSeeded>(event);
  section(theme, (std::string(mesh_parts(app.session.recording(), app.session.frame()) ? "DISTANCE TO THE TRIANGLE" : "SIGNED DISTANCE") + (before ? ", BEFORE THIS STEP" : "")).c_str());
  const std::optional<double> nearer = bound_by_first_face(app.session), upper = nearer ? nearer : frame.upper_bound;
  const double gap = upper && frame.lower_bound ? *upper - *frame.lower_bound : 0;
  const std::vector<std::string> texts = at_one_point({upper.value_or(0), frame.lower_bound.value_or(0), gap});
  const auto row = [&](const char* label, const std::optional<double>& x, const std::string& text, std::optional<std::size_t> source) {
    if (x) number_row(app, label, text, theme.palette.text, source, all_digits(*x));
    else number_row(app, label, "unknown", theme.palette.text, source);
  };
  const auto from = last_of<recorded::SimplexReduced, recorded::GjkEnded, recorded::PolytopeGrown, recorded::PortalFound, recorded::AxisTested, recorded::PointsProjected, recorded::ProjectionsEnded, recorded::ClosedFormEnded>(app.session);
  row("at most", upper, texts[0], nearer ? last_of<recorded::FaceChosen>(app.session) : from);
  row("at least", frame.lower_bound, texts[1], from);
  if (!frame.lower_bound || !upper) return;
  number_row(app, "gap", texts[2], theme.palette.text_soft, std::nullopt, all_digits(gap));
}

/// Beside the algorithm's line: an arrow where it is the step's, a cross where the step is not what it says.
void line_mark(const Theme& theme, ImVec2 at, bool wrong, Colour colour) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (!wrong) return draw->AddTriangleFilled({at.x - theme.px(2), at.y + theme.px(3)}, {at.x - theme.px(2), at.y + theme.px(12)}, {at.x + theme.px(5), at.y + theme.px(7.5f)}, packed(colour));
  const ImVec2 middle{at.x + theme.px(1.5f), at.y + theme.px(7.5f)};
  const float arm = theme.px(4);
  for (const float way : {-1.f, 1.f}) draw->AddLine({middle.x - arm, middle.y - way * arm}, {middle.x + arm, middle.y + way * arm}, packed(colour), theme.px(2));
}

void algorithm(App& app) {
  const Theme& theme = app.theme;
  const bool wrong = error_here(app.session) != nullptr;
  const Colour mark = wrong ? theme.palette.newest : theme.palette.accent;
  const PseudoCode code = pseudo_code(app.session.recording(), app.session.step());
  section(theme, code.title.c_str());
  ImGui::PushFont(theme.mono);
  float widest = 0;
  for (const std::string& line : code.lines) widest = std::max(widest, ImGui::CalcTextSize(line.c_str()).x);
  const float room = ImGui::GetContentRegionAvail().x - theme.px(12);
  if (widest > room) ImGui::SetWindowFontScale(std::max(0.66f, room / widest));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  ImGui::BeginGroup();
  for (std::size_t i = 0; i < code.lines.size(); ++i) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool current = static_cast<int>(i) == code.current;
    if (current) {
      const float right = at.x + ImGui::GetContentRegionAvail().x;
      draw->AddRectFilled({at.x - theme.px(6), at.y - theme.px(2)}, {right, at.y + ImGui::GetTextLineHeight() + theme.px(2)}, packed(mark.with_alpha(0.3)), theme.px(4));
      line_mark(theme, at, wrong, mark);
    }
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + theme.px(12));
    ImGui::TextColored(vec(current ? theme.palette.text : theme.palette.text_soft), "%s", code.lines[i].c_str());
  }
  ImGui::EndGroup();
  ImGui::SetWindowFontScale(1);
  ImGui::PopFont();
  tell_meaning(theme, code.title.c_str());
}

/// The selected vertex, or the newest: where it is and where it came from.
void vertex(App& app) {
  const Theme& theme = app.theme;
  const Frame& frame = app.session.frame();
  const auto number = app.settings.selected ? app.settings.selected : frame.newest;
  if (!number || !frame.vertices.contains(*number)) return;
  const FrameVertex& v = frame.vertices.at(*number);
  const std::string letter = simplex_letter(frame, *number, app.settings.newest_first);
  section(theme, ("VERTEX #" + std::to_string(*number) + (letter.empty() ? "" : " (" + letter + ")") + (app.settings.selected ? ", selected" : ", newest")).c_str());
  number_row(app, "w = a - b", v.w, theme.palette.text, v.event);
  number_row(app, "a", v.a, theme.palette.body_a, v.event, digits_that_tell(v.a, v.b));
  number_row(app, "b", v.b, theme.palette.body_b, v.event, digits_that_tell(v.a, v.b));
  if (v.event == app.session.step()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {app.theme.px(8), app.theme.px(2)});
  if (ImGui::Button(("from step " + std::to_string(v.event)).c_str())) app.session.go_to(v.event);
  ImGui::PopStyleVar();
}

/// Of a cast. What the digits on show would not tell from the time before it has the difference written out.
std::string touching_text(const Result& r) {
  const std::string text = short_number(*r.touching_at);
  if (!r.time || text != short_number(*r.time) || *r.touching_at == *r.time) return text;
  char more[32];
  std::snprintf(more, sizeof more, " + %.2g", *r.touching_at - *r.time);
  return text + more;
}

/// How many, and of the first ones, which the picture numbers, where they are on A.
void contacts(App& app, const std::vector<ContactPoint>& all) {
  const Colour colour = app.theme.palette.chosen;
  number_row(app.theme, "contact points", std::to_string(all.size()), colour);
  for (std::size_t i = 0; i < all.size() && i < numbered_contacts; ++i) {
    const ContactPoint& c = all[i];
    const std::string exact = "on the one body " + short_vector(c.point_a, 17) + "\non the other " + short_vector(c.point_b, 17) + "\ndepth " + all_digits(c.depth);
    number_row(app, ("contact " + std::to_string(i + 1)).c_str(), short_place(app.session.recording(), c.point_a), colour, std::nullopt, exact);
  }
}

/// After the last step: the answer and its certificate.
void answer(App& app) {
  if (app.session.step() + 1 != app.session.count()) return;
  const Theme& theme = app.theme;
  const Result& r = app.session.recording().result;
  const bool first_hit = r.status == "hit";
  section(theme, mesh_parts(app.session.recording(), app.session.frame()) ? "RESULT, OF ALL TRIANGLES" : first_hit ? "RESULT: THE FIRST HIT" : "RESULT");
  if (r.time) number_row(app, app.session.scene().scene.query == Query::cast ? "apart until" : "time", *r.time, theme.palette.text);
  if (r.touching_at) number_row(theme, "touching at", touching_text(r), theme.palette.text);
  if (r.energy) number_row(app, "energy", *r.energy, theme.palette.text);
  if (unanswered(r)) {
    number_row(theme, "intersecting", "not known", theme.palette.text_soft);
    number_row(theme, "support calls", std::to_string(r.support_calls), theme.palette.text_soft);
    return;
  }
  number_row(theme, "intersecting", r.intersecting ? "yes" : "no", foreign(app.session.recording()) ? theme.palette.text : r.intersecting ? theme.palette.chosen : theme.palette.support);
  const char* label = unproven(r) ? "signed distance, about" : "signed distance";
  if (r.signed_distance) number_row(app, label, short_number(*r.signed_distance), theme.palette.text, last_of<recorded::GjkEnded, recorded::EpaEnded, recorded::MprEnded, recorded::SatEnded, recorded::ClosedFormEnded, recorded::ProjectionsEnded>(app.session), all_digits(*r.signed_distance));
  if (r.normal) number_row(app, "normal", *r.normal, theme.palette.text);
  const int digits = r.witness_a && r.witness_b ? digits_that_tell(*r.witness_a, *r.witness_b) : 4;
  if (r.witness_a) number_row(app, "witness a", *r.witness_a, theme.palette.body_a, {}, digits);
  if (r.witness_b) number_row(app, "witness b", *r.witness_b, theme.palette.body_b, {}, digits);
  if (r.contacts) contacts(app, *r.contacts);
  number_row(theme, "support calls", std::to_string(r.support_calls), theme.palette.text_soft);
}

}  // namespace

/// Of the polytope, which lies inside and holds the origin, the face chosen is the nearest: the depth is no less. Once it has grown the events say so.
/// They allow for rounding, which a face's distance does not.
std::optional<double> bound_by_first_face(Session& s) {
  const Frame& frame = s.frame();
  const auto& events = s.recording().events;
  const auto chosen = frame.chosen ? frame.faces.find(*frame.chosen) : frame.faces.end();
  if (!frame.upper_bound || frame.epa_status || chosen == frame.faces.end() || foreign(s.recording()) || s.scene().scene.motion) return std::nullopt;
  for (std::size_t i = s.step() + 1; i-- > 0 && !std::holds_alternative<recorded::PolytopeSeeded>(events[i]);)
    if (std::holds_alternative<recorded::PolytopeGrown>(events[i])) return std::nullopt;
  double far = 0;
  for (const int v : chosen->second.vertices)
    if (const auto at = frame.vertices.find(v); at != frame.vertices.end()) far = std::max(far, at->second.a.norm() + at->second.b.norm());
  const double epsilon = s.recording().settings.scalar == Scalar::float_precision ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
  const double bound = -chosen->second.distance - s.meshes().radius + 20 * epsilon * far, better = *frame.upper_bound - bound, gap = *frame.upper_bound - frame.lower_bound.value_or(bound);
  return better > 1e-9 * gap ? std::optional(bound) : std::nullopt;
}

std::string place_text(Session& session) {
  const Event& event = session.recording().events[runs_at(session.recording(), session.step())];
  const char* phase = phase_name(event, session.frame());
  const bool counted = !session.frame().parallelogram && !std::holds_alternative<recorded::State>(event) && !std::holds_alternative<recorded::ContactFound>(event) && !std::holds_alternative<recorded::ImpulseApplied>(event);
  const std::string iteration = counted ? std::string(std::strcmp(phase, "motion") == 0 ? "," : "") + " iteration " + std::to_string(session.frame().iteration) : "";
  return "Step " + std::to_string(session.step()) + " of " + std::to_string(session.count() - 1) + "  \xC2\xB7  " + phase + iteration;
}

void step_panel(App& app, const Area& area) {
  // As if there were a scrollbar, so that the column of numbers stays where it is when there is one.
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::SetNextWindowContentSize({std::max(1.f, area.width - 2 * (has_small_margin(app.theme, area) ? app.theme.px(10) : style.WindowPadding.x) - style.ScrollbarSize), 0});
  if (!begin_panel(app.theme, "step", area, true)) return ImGui::EndChild();
  way_back(app);
  heading(app);
  scene_note(app);
  right_note(app);
  findings_note(app);
  beside_note(app);
  weights(app);
  regions(app);
  faces(app);
  bounds(app);
  answer(app);
  algorithm(app);
  vertex(app);
  counters(app);
  ImGui::EndChild();
}

}  // namespace gjkdbg
