#include "debugger/view/step_notes.h"

#include <algorithm>

#include "debugger/view/explain.h"
#include "debugger/view/right_step.h"

namespace gjkdbg {

const char* question(Query query) {
  switch (query) {
    case Query::intersect: return "Have the bodies a point in common? Yes or no is all that is asked.";
    case Query::distance: return "How far apart are the bodies, and which points are nearest? Overlapping ones are 0 apart.";
    case Query::penetration: return "How far apart are the bodies, or how deep in one another, along which normal, and touching where?";
    case Query::contact: return "How far apart are the bodies, or how deep in one another, along which normal, and at which contact points do they touch?";
    case Query::cast: return "When do the moving bodies touch for the first time, and where?";
    case Query::simulate: return "Where do forces, contacts and impulses take the bodies?";
  }
  return "";
}

void scene_note(App& app) {
  if (app.session.step() > 0) return;
  const Scene& scene = app.session.scene().scene;
  section(app.theme, "THE SCENE");
  if (!scene.description.empty() && !app.shows_scene_panel()) wrapped((app.session.can_undo() ? "Edited. As it was opened: " : "") + scene.description, app.theme.palette.text_soft);
  wrapped(question(scene.query), app.theme.palette.text);
}

void right_note(App& app) {
  const std::string text = right_step(app.session.recording(), app.session.frame());
  if (text.empty()) return;
  section(app.theme, "A RIGHT IMPLEMENTATION, FROM HERE");
  wrapped(text, app.theme.palette.support);
}

namespace {

/// One that an earlier one explains does not call out.
Colour colour_of(const Palette& p, const Finding& f) {
  if (f.message.starts_with("Follows from step")) return p.text_soft;
  return f.severity == Finding::Severity::error ? p.newest : p.frontier;
}

/// A finding's message, but for what the step's own sentence says already: a warning's.
std::string what_is_new(const Recording& recording, const Finding& f) {
  const auto* warning = std::get_if<recorded::Warning>(&recording.events[f.step]);
  if (!warning || !f.message.ends_with(warning->message)) return f.message;
  return f.message.substr(0, f.message.size() - warning->message.size());
}

}  // namespace

const Finding* error_here(const Session& s) {
  for (const Finding& f : s.findings())
    if (f.step == s.step() && f.severity == Finding::Severity::error) return &f;
  return nullptr;
}

void finding_first(App& app) {
  const Finding* f = error_here(app.session);
  if (!f) return;
  if (const std::string text = what_is_new(app.session.recording(), *f); !text.empty()) wrapped(text, colour_of(app.theme.palette, *f));
}

/// A click goes to the step; the whole message when pointed at. At the step that of the first stands here, or where it is an error below the step's title.
void findings_note(App& app) {
  Session& s = app.session;
  const Theme& theme = app.theme;
  if (s.findings().empty() && !foreign(s.recording())) return;
  section(theme, "FINDINGS");
  if (s.findings().empty()) wrapped("none: every step holds", theme.palette.support);
  bool first = true;
  for (std::size_t i = 0; i < s.findings().size(); ++i) {
    const Finding& f = s.findings()[i];
    const bool here = f.step == s.step(), whole = here && first;
    ImGui::PushID(static_cast<int>(i));
    ImGui::PushStyleColor(ImGuiCol_Text, vec(colour_of(theme.palette, f)));
    const std::string name = "step " + std::to_string(f.step) + "  " + f.code, fits = shortened(theme.text, name, ImGui::GetContentRegionAvail().x);
    const bool clicked = ImGui::Selectable(fits.c_str(), here);
    ImGui::PopStyleColor();
    ImGui::PopID();
    if (ImGui::IsItemHovered() && (!whole || fits != name)) tooltip(theme, (fits == name ? "" : f.code + "\n") + f.message);
    if (const std::string text = whole && &f != error_here(s) ? what_is_new(s.recording(), f) : ""; !text.empty()) wrapped(text, theme.palette.text_soft);
    if (here) first = false;
    if (clicked) s.go_to(f.step);
  }
}

void beside_note(App& app) {
  Session& s = app.session;
  if (!s.comparing()) return;
  const Theme& theme = app.theme;
  section(theme, ("BESIDE IT: " + s.other_title()).c_str());
  const std::size_t k = s.other_step();
  wrapped(short_kind(s.other().events[k]) + (": " + summary(s.other(), k, app.settings.newest_first)), theme.palette.text_soft);
  wrapped(parting_text(s), theme.palette.text_soft);
  if (const std::string ending = ending_text(s); !ending.empty()) wrapped(ending, theme.palette.text_soft);
  if (answers_agree(s.recording().result, s.other().result)) wrapped("the answers agree", theme.palette.support);
  number_row(theme, "its answer", result_text(s.other()), theme.palette.text_soft);
}

}  // namespace gjkdbg
