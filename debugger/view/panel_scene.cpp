// The left panel: the open scene with everything that can be edited.
#include <algorithm>
#include <cstdlib>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"
#include "debugger/view/input.h"
#include "debugger/view/plot.h"

namespace gjkdbg {

namespace {

/// Pointing at it tells what the setting does.
void setting_label(const Theme& theme, const char* label, const char* meaning) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(vec(theme.palette.text_soft), "%s", label);
  if (ImGui::IsItemHovered()) tooltip(theme, meaning);
}

template <class Names>
bool choice(const Theme& theme, const char* label, int& value, const Names& names, const std::vector<int>& offered, const char* meaning) {
  setting_label(theme, label, meaning);
  ImGui::SameLine(theme.px(label_width));
  ImGui::SetNextItemWidth(-1);
  bool edited = false;
  ImGui::PushID(label);
  const std::string now(names[static_cast<std::size_t>(value)]);
  const float room = ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - 2 * ImGui::GetStyle().FramePadding.x;
  const bool open = ImGui::BeginCombo("##choice", shortened(theme.text, now, room).c_str());
  if (!open && ImGui::IsItemHovered()) tooltip(theme, meaning + ("\n\n" + now) + ": " + meaning_of_choice(now));
  if (open) {
    for (const int i : offered) {
      const std::string name(names[static_cast<std::size_t>(i)]);
      const bool current = i == value;
      if (ImGui::Selectable(name.c_str(), current)) value = i, edited = true;
      if (current) ImGui::SetItemDefaultFocus();
      if (ImGui::IsItemHovered()) tooltip(theme, meaning_of_choice(name));
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
  return edited;
}

/// Where GJK begins, and the direction where one is given.
bool start(const Theme& theme, const Settings& now, SceneFile& next) {
  const bool gjk = now.name == MethodName::gjk || now.name == MethodName::gjk_accelerated;
  int value = static_cast<int>(now.start);
  bool edited = false;
  if (choice(theme, "start", value, start_names, gjk ? std::vector<int>{0, 1, 2} : std::vector<int>{0, 1}, "Where the search begins: from one body's centre towards the other's, along a direction of yours, or from the simplex the last run ended with.")) {
    next.method.start = static_cast<Start>(value), edited = true;
    next.method.initial_simplex.clear(), next.method.initial_direction.reset();
    if (next.method.start == Start::given) next.method.initial_direction = AnyVector(AnyVector::Unit(next.scene.dimension, 0));
  }
  if (now.start != Start::given || !next.method.initial_direction) return edited;
  AnyVector direction = *next.method.initial_direction;
  if (numbers(theme, "direction", direction.data(), next.scene.dimension, 0.01f) && !direction.isZero(0)) next.method.initial_direction = direction, edited = true;
  return edited;
}

/// What GJK and EPA are told.
bool gjk_settings(const Theme& theme, const Settings& now, SceneFile& next) {
  int part = static_cast<int>(now.closest_point);
  if (now.name == MethodName::gjk_boolean || now.name == MethodName::closed_form) return false;
  bool edited = false;
  if (choice(theme, "closest point", part, closest_point_names, {0, 1, 2}, "How GJK finds the simplex's point nearest the origin: by signed volumes, by Johnson's determinants, or by going through the Voronoi regions of its parts.")) next.method.closest_point = static_cast<ClosestPoint>(part), edited = true;
  if (start(theme, now, next)) edited = true;
  int directions = static_cast<int>(now.acceleration), rule = static_cast<int>(now.stopping), deep = static_cast<int>(now.penetration);
  if (now.name == MethodName::gjk_accelerated && choice(theme, "directions", directions, acceleration_names, {0, 1, 2, 3}, "What replaces the direction -v: a momentum (Nesterov's or Polyak's), Newton's step by the curvature of the bodies, or a mean with the best plane's direction (smoothed), which is for polytopes.")) next.method.acceleration = static_cast<Acceleration>(directions), edited = true;
  if (choice(theme, "stopping", rule, stopping_names, {0, 1, 2, 3, 4}, "When GJK is done: when the bounds of the distance meet (ours), or by the rule of another implementation, which may stop early.")) next.method.stopping = static_cast<Stopping>(rule), edited = true;
  if ((next.scene.query == Query::penetration || next.scene.query == Query::contact) && choice(theme, "when deep", deep, penetration_names, {0, 1, 2}, "What measures the depth of an overlap: EPA, the shortest way out; MPR, a way out in one direction; or nothing.")) next.method.penetration = static_cast<Penetration>(deep), edited = true;
  return edited;
}

/// A number that counts once it is typed in full: at Enter, or where something else is clicked on; Escape leaves it as it was.
template <class Number, class Field>
bool typed(Number& value, const Field& field) {
  static std::optional<Number> typing;
  Number now = typing.value_or(value);
  const auto text = [](Number x) { return formatted(static_cast<double>(x), "%.3g"); };
  field(now);
  if (ImGui::IsItemActive()) return typing = now, false;
  typing.reset();
  // What the field showed and was not changed has fewer digits than the value.
  if (!ImGui::IsItemDeactivatedAfterEdit() || now == value || now == static_cast<Number>(std::strtod(text(value).c_str(), nullptr))) return false;
  return value = now, true;
}

/// Where a run ends.
bool limits(const Theme& theme, const Settings& now, SceneFile& next) {
  bool edited = false;
  setting_label(theme, "tolerance", "How far apart the bounds may be at the end, as a share of the distance or depth.");
  ImGui::SameLine(theme.px(label_width));
  ImGui::SetNextItemWidth(-1);
  ImGui::PushFont(theme.mono);
  double tolerance = now.tolerance;
  if (typed(tolerance, [](double& x) { ImGui::InputDouble("##tolerance", &x, 0, 0, "%.3g"), takes_a_number(); })) next.method.tolerance = tolerance, edited = true;
  ImGui::PopFont();
  int limit = now.max_iterations;
  setting_label(theme, "max iterations", "Where each of GJK, EPA and the others gives up, and says so.");
  ImGui::SameLine(theme.px(label_width));
  ImGui::SetNextItemWidth(-1);
  ImGui::PushFont(theme.mono);
  if (typed(limit, [](int& x) { ImGui::InputInt("##limit", &x, 0, 0); })) next.method.max_iterations = limit, edited = true;
  ImGui::PopFont();
  return edited;
}

bool method(App& app, SceneFile& next) {
  const Theme& theme = app.theme;
  const Settings& now = app.session.recording().settings;
  static constexpr const char* query_meaning = "The least the scene needs: yes or no, how far apart, how deep as well, or the contact points too. Nothing beyond it is computed.";
  section(theme, "METHOD");
  if (foreign(app.session.recording())) {
    ImGui::PushFont(theme.small);
    wrapped("This run is your solver's. A change here or to a body solves the scene by one of gjkdbg's own methods; Ctrl-Z brings your run back.", theme.palette.text_faint);
    ImGui::PopFont();
  }
  bool edited = false;
  int query = static_cast<int>(next.scene.query), scalar = static_cast<int>(now.scalar);
  int name = static_cast<int>(next.method.name == MethodName::fastest ? MethodName::fastest : now.name);
  if ((next.scene.motion ? choice(theme, "query", query, query_names, {query}, query_meaning) : choice(theme, "query", query, query_names, {0, 1, 2, 3}, query_meaning))) {
    next.scene.query = static_cast<Query>(query), edited = true;
    if (query != 0 && now.name == MethodName::gjk_boolean) next.method.name = MethodName::gjk;
  }
  if (choice(theme, "method", name, method_names, possible_methods(next), "The algorithm: those that take these bodies and answer this query.")) change_name(next.method, static_cast<MethodName>(name)), edited = true;
  const bool takes_over = now.name == MethodName::mpr || now.name == MethodName::sat || now.name == MethodName::projections;
  if (!takes_over) edited |= gjk_settings(theme, now, next);
  if (choice(theme, "scalar", scalar, scalar_names, {0, 1}, "What is counted in: double has 16 digits, float 7.")) next.method.scalar = static_cast<Scalar>(scalar), next.method.tolerance.reset(), edited = true;
  if (now.name != MethodName::closed_form) edited |= limits(theme, now, next);  // a formula neither converges nor iterates
  if (!takes_over) return edited;
  ImGui::PushFont(theme.small);
  wrapped("Where GJK and EPA take over from it:", theme.palette.text_faint);
  ImGui::PopFont();
  return gjk_settings(theme, now, next) || edited;
}

}  // namespace

void scene_panel(App& app) {
  const Theme& theme = app.theme;
  SceneFile next = app.session.scene();
  if (!next.scene.description.empty()) {
    ImGui::PushFont(theme.small);
    wrapped(next.scene.description, app.session.can_undo() ? theme.palette.text_faint : theme.palette.text_soft);
    // On a line that is there before, too: what is edited stays where it is.
    const std::string source = next.scene.source.empty() ? "" : "Source: " + next.scene.source;
    wrapped(source + (!app.session.can_undo() ? " " : source.empty() ? "As it was: edited since." : ", edited since"), theme.palette.text_faint);
    ImGui::PopFont();
  }
  const bool was_active = ImGui::IsAnyItemActive();
  if (!was_active) app.place_digits = digits_of_places(next.scene);  // while one is dragged its field stays where it is
  const double size = std::max(1e-300, std::min(app.world_camera.radius, 1e12));
  bool edited = all_bodies(app, next, size);
  if (next.scene.motion) edited |= add_body(next);
  edited |= method(app, next);
  if (edited) {
    next.expect.reset();  // of the scene as it was
    app.edit(next);
    app.fit_what_has_left();
  }
  // A drag in a field is one edit, from press to release.
  if (!was_active && ImGui::IsAnyItemActive()) app.session.begin_edit();
  if (!ImGui::IsAnyItemActive()) app.session.end_edit();
  compare_section(app);
  stop_section(app);
  section(theme, "SHOW");
  Preferences& p = app.preferences;
  ImGui::Checkbox("Minkowski difference", &p.difference);
  ImGui::Checkbox("support plane", &p.support_plane);
  ImGui::Checkbox("region of the kept part", &p.regions);
  ImGui::Checkbox("bounds as rings", &p.bounds);
  ImGui::Checkbox("dropped and removed", &p.dropped);
  ImGui::Checkbox("labels", &p.labels);
  ImGui::Checkbox("A is the newest vertex", &p.newest_first);
  ImGui::Checkbox("grid", &p.grid);
  ImGui::Checkbox("cameras linked", &p.linked_cameras);
}

}  // namespace gjkdbg
