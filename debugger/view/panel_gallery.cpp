// The left panel: the gallery in lessons, each scene with a picture of itself.
#include <algorithm>
#include <utility>

#include "debugger/view/app.h"

namespace gjkdbg {
namespace {

/// One scene: its picture, its name, the beginning of what it says of itself. True when clicked.
bool scene_row(App& app, const std::string& name, bool current) {
  const Theme& theme = app.theme;
  const float height = theme.px(46);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushID(name.c_str());
  const bool clicked = ImGui::Selectable("##scene", current, 0, {width, height});
  ImGui::PopID();
  if (const std::string description = ImGui::IsItemHovered() ? app.thumbnails().description(app.gallery(), name) : ""; !description.empty()) tooltip(theme, description);
  if (!ImGui::IsRectVisible(at, {at.x + width, at.y + height})) return clicked;
  app.thumbnails().draw(app.gallery(), name, theme, {at.x + theme.px(4), at.y + theme.px(3)}, {at.x + theme.px(68), at.y + height - theme.px(3)});
  // A long name takes two lines, cut at a hyphen.
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 colour = packed(current ? theme.palette.text : theme.palette.text_soft);
  const float left = at.x + theme.px(78), room = width - theme.px(80);
  const auto text_width = [&](const std::string& text) { return theme.small->CalcTextSizeA(theme.small->FontSize, 1e6f, 0, text.c_str()).x; };
  std::size_t cut = std::string::npos;
  if (text_width(name) > room) {
    cut = name.rfind('-', name.size() - 1);
    while (cut != std::string::npos && cut > 0 && text_width(name.substr(0, cut + 1)) > room) cut = name.rfind('-', cut - 1);
  }
  const bool two = cut != std::string::npos;
  const float line = theme.small->FontSize + theme.px(1), y = at.y + height / 2 - line;
  draw->AddText(theme.small, theme.small->FontSize, {left, y}, colour, two ? name.substr(0, cut + 1).c_str() : name.c_str());
  const ImU32 faint = packed(theme.palette.text_faint);
  if (two) draw->AddText(theme.small, theme.small->FontSize, {left, y + line}, colour, name.substr(cut + 1).c_str());
  else draw->AddText(theme.small, theme.small->FontSize, {left, y + line}, faint, shortened(theme.small, app.thumbnails().description(app.gallery(), name), room).c_str());
  return clicked;
}

/// The scenes whose names or descriptions hold the text, in either case.
std::vector<std::string> matches(App& app, const std::string& text) {
  std::vector<std::string> found;
  const std::string wanted = lower_case(text);
  for (const Lesson& lesson : app.gallery().lessons)
    for (const std::string& name : lesson.scenes)
      if (lower_case(name + " " + app.thumbnails().description(app.gallery(), name)).find(wanted) != std::string::npos) found.push_back(name);
  return found;
}

/// `follow`: the list goes to the one that is open, if it is out of sight.
void scene_rows(App& app, const std::vector<std::string>& names, bool follow) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, app.theme.px(2)});
  for (const std::string& name : names) {
    const bool current = app.session.scene().scene.name == name;
    const bool clicked = scene_row(app, name, current);
    if (current && follow && !ImGui::IsItemVisible()) ImGui::SetScrollHereY(0.5f);
    if (clicked) app.open_gallery(name);
  }
  ImGui::PopStyleVar();
}

/// Those that are looked for, or all in their lessons.
void scenes(App& app, bool entered) {
  const Theme& theme = app.theme;
  if (app.gallery_search[0] != 0) {
    const std::vector<std::string> found = matches(app, app.gallery_search);
    const std::string count = found.empty() ? "no scene has it" : std::to_string(found.size()) + (found.size() == 1 ? " scene" : " scenes");
    ImGui::TextColored(vec(theme.palette.text_faint), "%s", count.c_str());
    if (entered && !found.empty()) app.open_gallery(found[0]);
    return scene_rows(app, found, false);
  }
  // However a scene was opened, its lesson opens, and the list goes there.
  const bool follow = std::exchange(app.gallery_shows, app.session.scene().scene.name) != app.session.scene().scene.name;
  for (const Lesson& lesson : app.gallery().lessons) {
    ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.text));
    const bool holds = std::find(lesson.scenes.begin(), lesson.scenes.end(), app.session.scene().scene.name) != lesson.scenes.end();
    if (holds && follow) ImGui::SetNextItemOpen(true);
    else ImGui::SetNextItemOpen(false, ImGuiCond_Once);
    const bool open = ImGui::TreeNodeEx(lesson.title.c_str(), ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_NoTreePushOnOpen);
    ImGui::PopStyleColor();
    if (!open) {
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", lesson.text.c_str());
      continue;
    }
    ImGui::PushFont(theme.small);
    wrapped(lesson.text, theme.palette.text_faint);
    ImGui::PopFont();
    scene_rows(app, lesson.scenes, follow);
  }
}

}  // namespace

void gallery_panel(App& app) {
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputTextWithHint("##search", "find a scene", app.gallery_search, sizeof app.gallery_search, ImGuiInputTextFlags_EnterReturnsTrue);
  if (begin_list("scenes")) scenes(app, entered);
  ImGui::EndChild();
}

}  // namespace gjkdbg
