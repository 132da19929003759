// The right panel: what the step means, the simplex with its weights, the bounds, the algorithm's lines, the selected vertex.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"
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
  for (std::size_t i = 0; i < frame.simplex.size(); ++i) {
    const float y = ImGui::GetCursorScreenPos().y;
    const bool newest = frame.newest == frame.simplex[i];
    ImGui::TextColored(vec(newest ? theme.palette.newest : theme.palette.simplex), "%s", simplex_letter(frame, frame.simplex[i], app.settings.newest_first).c_str());
    ImGui::SameLine(theme.px(34));
    ImGui::PushFont(theme.mono);
    ImGui::TextColored(vec(theme.palette.text_faint), "#%d", frame.simplex[i]);
    if (i < frame.barycentric.size()) {
      const std::string value = at_the_point(frame.barycentric[i]);
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
  for (const RegionTest& test : region_tests(points)) {
    std::string part, why;
    for (const int i : test.part) part += vertex_letter(app.settings.newest_first ? i : static_cast<int>(points.size()) - 1 - i);
    const std::size_t least = static_cast<std::size_t>(std::min_element(test.weights.begin(), test.weights.end()) - test.weights.begin());
    if (!test.holds_projection) why = std::string("\xCE\xBB") + part[least] + " " + at_the_point(test.weights[least]);
    else why = at_the_point(test.distance);
    std::sort(part.begin(), part.end());
    const Colour colour = test.nearest ? theme.palette.simplex : test.holds_projection ? theme.palette.text_soft : theme.palette.dropped;
    ImGui::TextColored(vec(colour), "%s %s", test.nearest ? ">" : " ", part.c_str());
    ImGui::SameLine(theme.px(78));
    ImGui::TextColored(vec(colour), "%s", test.nearest ? "nearest" : test.holds_projection ? "farther" : "outside");
    ImGui::SameLine(right - ImGui::CalcTextSize(why.c_str()).x);
    ImGui::TextColored(vec(colour), "%s", why.c_str());
    if (!ImGui::IsItemHovered()) continue;
    std::string tip = "weights of the origin's projection:";
    for (const double w : test.weights) tip += " " + short_number(w);
    ImGui::SetTooltip("%s\nat %s; the test is %s from the other answer", tip.c_str(), short_number(test.distance).c_str(), short_number(std::abs(test.margin)).c_str());
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
  std::string text = std::to_string(supports) + (supports == 1 ? " support" : " supports");
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
    number_row(app, "its distance", at_the_point(f.distance), theme.palette.chosen, f.event, all_digits(f.distance));
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
  const auto row = [&](const char* label, const std::optional<double>& x, std::optional<std::size_t> source) {
    if (x) number_row(app, label, at_the_point(*x), theme.palette.text, source, all_digits(*x));
    else number_row(app, label, "unknown", theme.palette.text, source);
  };
  const auto from = last_of<recorded::SimplexReduced, recorded::GjkEnded, recorded::PolytopeGrown, recorded::PortalFound, recorded::AxisTested, recorded::PointsProjected, recorded::ProjectionsEnded, recorded::ClosedFormEnded>(app.session);
  // Of the polytope, which lies inside and holds the origin, the face chosen is the nearest: the depth is no less.
  std::optional<double> upper = frame.upper_bound;
  const auto chosen = frame.chosen ? frame.faces.find(*frame.chosen) : frame.faces.end();
  const bool proven = !frame.epa_status && chosen != frame.faces.end() && !foreign(app.session.recording()) && !app.session.scene().scene.motion;
  if (proven && upper) upper = std::min(*upper, -chosen->second.distance - app.session.meshes().radius);
  row("at most", upper, proven ? last_of<recorded::FaceChosen>(app.session) : from);
  row("at least", frame.lower_bound, from);
  if (!frame.lower_bound || !upper) return;
  const double gap = *upper - *frame.lower_bound;
  number_row(app, "gap", at_the_point(gap), theme.palette.text_soft, std::nullopt, all_digits(gap));
}

void algorithm(App& app) {
  const Theme& theme = app.theme;
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
      draw->AddRectFilled({at.x - theme.px(6), at.y - theme.px(2)}, {right, at.y + ImGui::GetTextLineHeight() + theme.px(2)}, packed(theme.palette.accent.with_alpha(0.3)), theme.px(4));
      draw->AddTriangleFilled({at.x - theme.px(2), at.y + theme.px(3)}, {at.x - theme.px(2), at.y + theme.px(12)}, {at.x + theme.px(5), at.y + theme.px(7.5f)}, packed(theme.palette.accent));
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
  if (r.signed_distance) number_row(app, label, at_the_point(*r.signed_distance), theme.palette.text, last_of<recorded::GjkEnded, recorded::EpaEnded, recorded::MprEnded, recorded::SatEnded, recorded::ClosedFormEnded, recorded::ProjectionsEnded>(app.session), all_digits(*r.signed_distance));
  if (r.normal) number_row(app, "normal", *r.normal, theme.palette.text);
  const int digits = r.witness_a && r.witness_b ? digits_that_tell(*r.witness_a, *r.witness_b) : 4;
  if (r.witness_a) number_row(app, "witness a", *r.witness_a, theme.palette.body_a, {}, digits);
  if (r.witness_b) number_row(app, "witness b", *r.witness_b, theme.palette.body_b, {}, digits);
  if (r.contacts) contacts(app, *r.contacts);
  number_row(theme, "support calls", std::to_string(r.support_calls), theme.palette.text_soft);
}

}  // namespace

std::string place_text(Session& session) {
  const Event& event = session.recording().events[runs_at(session.recording(), session.step())];
  const char* phase = phase_name(event, session.frame());
  const bool counted = !session.frame().parallelogram && !std::holds_alternative<recorded::State>(event) && !std::holds_alternative<recorded::ContactFound>(event) && !std::holds_alternative<recorded::ImpulseApplied>(event);
  const std::string iteration = counted ? std::string(std::strcmp(phase, "motion") == 0 ? "," : "") + " iteration " + std::to_string(session.frame().iteration) : "";
  return "Step " + std::to_string(session.step()) + " of " + std::to_string(session.count() - 1) + "  \xC2\xB7  " + phase + iteration;
}

void step_panel(App& app, const Area& area) {
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
