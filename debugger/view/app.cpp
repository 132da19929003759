#include "debugger/view/app.h"

#include <algorithm>
#include <cstring>
#include <numbers>

#include "debugger/view/explain.h"
#include "debugger/view/input.h"
#include "debugger/view/scene_code.h"
#include "recordings/json_writing.h"

#include <nlohmann/json.hpp>

namespace gjkdbg {

App::App(Gallery gallery, float scale) : gallery_(std::move(gallery)) {
  load_fonts(theme, scale);
  apply_colours(theme, true);
  ImGui::GetIO().IniFilename = nullptr;
}

void App::open(const std::filesystem::path& file) {
  try {
    open_or_throw(file);
    message.clear();
  } catch (const Error& e) {
    message = e.line();
  }
}

void App::open_or_throw(const std::filesystem::path& file) {
  if (const MeasurementKind kind = read_measurements(file, measured); kind != MeasurementKind::neither) {
    show_lab = true, lab_tab = kind == MeasurementKind::chart ? LabTab::chart : LabTab::atlas;
    if (!session.is_open()) session.open(gallery_.file("box-box-deep"));  // something to come back to
    return;
  }
  session.open(file);
  show_lab = false;
  settings.selected.reset();
}

void App::open_gallery(const std::string& name) { open(gallery_.file(name)); }

void App::compare(const std::filesystem::path& file) {
  try {
    Session read;
    read.open(file);
    session.compare_with(read.recording(), read.title());
    message.clear();
  } catch (const Error& e) {
    message = e.line();
  }
}

void App::fit_views() {
  const Camera world = world_camera, difference = difference_camera;
  world_camera = fit_world(session.meshes(), session.recording());
  difference_camera = fit_difference(session.meshes(), session.recording());
  if (fitted_ == 0) return;
  world_camera.yaw = world.yaw, world_camera.pitch = world.pitch;
  difference_camera.yaw = difference.yaw, difference_camera.pitch = difference.pitch;
}

void App::frame() {
  session.tick(ImGui::GetIO().DeltaTime);
  thumbnails_.next_frame();
  notice_left_ = std::max(0.f, notice_left_ - ImGui::GetIO().DeltaTime);
  if (preferences.dark != theme.dark) apply_colours(theme, preferences.dark);
  settings.difference = preferences.difference, settings.support_plane = preferences.support_plane, settings.dropped = preferences.dropped;
  settings.labels = preferences.labels, settings.grid = preferences.grid, settings.regions = preferences.regions, settings.bounds = preferences.bounds;
  settings.newest_first = preferences.newest_first;
  if (session.is_open() && fitted_ != session.opened()) fit_views(), fitted_ = session.opened();
  keys();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("gjkdbg", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar();
  panels({0, 0, size.x, size.y});
  ImGui::End();
  key_sheet();
  dialogs();
}

void App::panels(const Area& window) {
  const float gap = theme.px(6), top = theme.px(48);
  top_bar({0, 0, window.width, top});
  if (!session.is_open()) return;
  const float height = window.height - top - 2 * gap;
  if (show_lab) {
    lab_panel(*this, {gap, top + gap, window.width - 2 * gap, height});
    banner({gap, top + gap, window.width - 2 * gap, theme.px(40)});
    return;
  }
  if (lecture) {
    const float bottom = std::max(theme.px(190), window.height * 0.27f);
    view_panels(*this, {gap, top + gap, window.width - 2 * gap, height - bottom - gap}, true);
    lecture_panel({gap, top + gap + height - bottom, window.width - 2 * gap, bottom});
    banner({gap, top + gap, window.width - 2 * gap, theme.px(40)});
    return;
  }
  const bool narrow = window.width < theme.px(1180);
  Preferences& p = preferences;
  const float rail = theme.px(44);
  const float left = narrow ? rail : std::min(theme.px(p.left), window.width * 0.35f), right = std::min(theme.px(p.right), window.width * (narrow ? 0.29f : 0.4f));
  const float bottom = std::min(theme.px(p.bottom), window.height * 0.6f);
  const Area middle{left + 2 * gap, top + gap, window.width - left - right - 4 * gap, height - bottom - gap};
  if (narrow) icon_rail({gap, top + gap, left, height});
  else left_panel({gap, top + gap, left, height});
  view_panels(*this, middle, true);
  timeline_panel(*this, {middle.x, middle.y + middle.height + gap, middle.width, bottom});
  step_panel(*this, {window.width - right - gap, top + gap, right, height});
  if (!narrow) splitter("##left", {left + gap, top + gap, gap, height}, true, p.left, 200, 460, 1);
  splitter("##right", {window.width - right - 2 * gap, top + gap, gap, height}, true, p.right, 240, 560, -1);
  splitter("##bottom", {middle.x, middle.y + middle.height, middle.width, gap}, false, p.bottom, 130, 520, -1);
  banner({middle.x + gap, middle.y + gap, middle.width - 2 * gap, theme.px(40)});
}

/// The gap between two panels: dragging it moves the border, a double click puts it back.
void App::splitter(const char* name, const Area& area, bool vertical, float& value, float low, float high, float sign) {
  ImGui::SetCursorScreenPos({area.x, area.y});
  ImGui::InvisibleButton(name, {area.width, area.height});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddRectFilled({area.x + (vertical ? area.width / 3 : 0), area.y + (vertical ? 0 : area.height / 3)},
                                              {area.x + area.width * (vertical ? 2.f / 3 : 1), area.y + area.height * (vertical ? 1 : 2.f / 3)}, packed(theme.palette.accent));
  }
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (ImGui::IsItemActive()) value = std::clamp(value + sign * (vertical ? moved.x : moved.y) / theme.scale, low, high);
}

/// What went wrong, over the views, until something succeeds or it is clicked away; what was done, for a while.
void App::banner(const Area& area) {
  const bool error = !message.empty();
  if (!error && notice_left_ <= 0) return;
  const std::string& text = error ? message : notice;
  const float wrap = area.width - theme.px(60);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const float width = std::min(area.width, size.x + theme.px(60)), height = size.y + theme.px(22), x = area.x + (area.width - width) / 2;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4());
  begin_area("banner", {x, area.y, width, height});
  // In its own draw list: ImGui may draw a child's background with the parent's, below what the views have drawn.
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRectFullScreen();
  draw->AddRectFilled({x, area.y}, {x + width, area.y + height}, packed((error ? theme.palette.newest : theme.palette.support).shaded(-0.15)), theme.px(8));
  draw->PopClipRect();
  ImGui::SetCursorPos({(width - size.x) / 2, (height - size.y) / 2});
  ImGui::PushStyleColor(ImGuiCol_Text, vec(rgb(0xffffff)));
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  if (error && ImGui::IsWindowHovered()) {
    ImGui::SetTooltip("click to close");
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) message.clear();
  }
  ImGui::EndChild();
  ImGui::PopStyleColor();
}

void App::picture_frame() {
  if (fitted_ != session.opened()) fit_views(), fitted_ = session.opened();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("picture", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar();
  const float gap = theme.px(8), caption = theme.px(92);
  view_panels(*this, {gap, gap, size.x - 2 * gap, size.y - caption - 2 * gap}, false);
  begin_area("caption", {gap, size.y - caption, size.x - 2 * gap, caption - gap});
  const Explanation e = explain(session.recording(), session.frame());
  ImGui::PushFont(theme.title);
  ImGui::TextUnformatted(e.title.c_str());
  ImGui::PopFont();
  const std::string place = session.title() + "  \xC2\xB7  step " + std::to_string(session.step()) + " of " + std::to_string(session.count() - 1);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(place.c_str()).x);
  ImGui::TextColored(vec(theme.palette.text_faint), "%s", place.c_str());
  wrapped(e.text, theme.palette.text_soft);
  ImGui::EndChild();
  ImGui::End();
}

/// For a hall: the step in letters that the last row can read, and the scrubber.
void App::lecture_panel(const Area& area) {
  if (begin_area("lecture", area)) {
    scrubber(*this);
    const Explanation e = explain(session.recording(), session.frame());
    ImGui::Dummy({0, theme.px(4)});
    ImGui::PushFont(theme.lecture_title);
    ImGui::TextUnformatted(e.title.c_str());
    ImGui::PopFont();
    ImGui::PushFont(theme.lecture);
    wrapped(e.text, theme.palette.text_soft);
    ImGui::PopFont();
  }
  ImGui::EndChild();
}

void App::top_bar(const Area& area) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(16), theme.px(9)});
  begin_area("top", area);
  ImGui::PopStyleVar();
  ImGui::PushFont(theme.title);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("gjkdbg");
  ImGui::PopFont();
  ImGui::SameLine(0, theme.px(20));
  ImGui::PushStyleColor(ImGuiCol_Button, vec(theme.palette.panel));
  const auto button = [&](const char* name, const char* tip) {
    const bool pressed = ImGui::Button(name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip);
    ImGui::SameLine(0, theme.px(2));
    return pressed;
  };
  if (button("Open", "Open a scene or a recording (Ctrl-O)")) ask(Asking::open);
  if (button("Save", "Save the scene, the recording, a picture or the replay (Ctrl-S)")) ask(Asking::save);
  if (button("Find", "Find a step (Ctrl-F)")) ask(Asking::find);
  if (button("Measure", "Speed against accuracy, stability where methods fail (X)")) show_lab = !show_lab;
  if (button("Explain", "Big text, for a hall (E)")) lecture = !lecture;
  if (button(theme.dark ? "Light" : "Dark", "The other colours (T)")) preferences.dark = !preferences.dark;
  if (button("Keys", "All keys (?)")) show_keys = !show_keys;
  ImGui::PopStyleColor();
  if (session.is_open()) {
    const bool simulated = session.scene().scene.query == Query::simulate;
    const auto& findings = session.findings();
    const bool open = undecided(session.recording().result), wrong = !open && std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Finding::Severity::error; });
    const bool neutral = !wrong && (simulated || open);
    const std::string result = (wrong ? "wrong: " : "") + result_text(session.recording());
    const Colour tone = neutral ? theme.palette.text_soft : wrong || session.recording().result.intersecting ? theme.palette.newest : theme.palette.support;
    std::string method = method_text(session.recording().settings) + "  \xC2\xB7  " + std::string(query_names[static_cast<std::size_t>(session.scene().scene.query)]);
    const auto width = [&](const std::string& text) { return theme.small->CalcTextSizeA(theme.small->FontSize, 1e6f, 0, text.c_str()).x + theme.px(22); };
    const float here = ImGui::GetItemRectMax().x + theme.px(16), title = ImGui::CalcTextSize(session.title().c_str()).x, middle = area.width / 2 - title / 2;
    const auto both = [&] { return width(result) + width(method) + theme.px(8); };
    const auto too_wide = [&] { return area.width - both() - theme.px(16) < here; };
    if (too_wide()) method = method_text(session.recording().settings);  // a narrow window: the query is left out, then all but the name
    if (too_wide()) method = method_names[static_cast<std::size_t>(session.recording().settings.name)];
    const float chips = both();
    if (std::max(middle, here) + title < area.width - chips - theme.px(24)) {
      ImGui::SameLine(std::max(middle, here));
      ImGui::TextUnformatted(session.title().c_str());
    }
    ImGui::SameLine(area.width - chips - theme.px(16));
    chip(theme, method, theme.palette.accent);
    ImGui::SameLine(0, theme.px(8));
    chip(theme, result, tone);
  }
  ImGui::EndChild();
}

void App::left_panel(const Area& area) {
  if (begin_area("left", area, true)) {
    const float half = (ImGui::GetWindowContentRegionWidth() - theme.px(6)) / 2;
    if (tab_button(theme, "Gallery", left_tab == LeftTab::gallery, half)) left_tab = LeftTab::gallery;
    ImGui::SameLine(0, theme.px(6));
    if (tab_button(theme, "Scene", left_tab == LeftTab::scene, half)) left_tab = LeftTab::scene;
    ImGui::Dummy({0, theme.px(4)});
    left_tab == LeftTab::gallery ? gallery_panel(*this) : scene_panel(*this);
  }
  ImGui::EndChild();
}

/// Where there is no room for the left panel: two icons that open it.
void App::icon_rail(const Area& area) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(5), theme.px(8)});
  begin_area("rail", area);
  ImGui::PopStyleVar();
  const auto icon = [&](const char* name, const char* popup, const char* tip, bool gallery) {
    const ImVec2 at = ImGui::GetCursorScreenPos(), size{theme.px(34), theme.px(34)};
    if (ImGui::Button(name, size)) ImGui::OpenPopup(popup);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImU32 colour = packed(theme.palette.text);
    const auto px = [&](float x, float y) { return ImVec2{at.x + theme.px(x), at.y + theme.px(y)}; };
    if (gallery) {
      for (const float x : {9.f, 19.f})
        for (const float y : {9.f, 19.f}) draw->AddRectFilled(px(x, y), px(x + 7, y + 7), colour, theme.px(1.5f));
    } else {
      for (const auto& [y, knob] : {std::pair(10.f, 21.f), {17.f, 12.f}, {24.f, 18.f}}) {
        draw->AddLine(px(8, y), px(26, y), colour, theme.px(1.5f));
        draw->AddCircleFilled(px(knob, y), theme.px(3), colour, 12);
      }
    }
  };
  icon("##gallery", "gallery popup", "Gallery (G)", true);
  icon("##scene", "scene popup", "Scene: bodies, method, what is shown", false);
  for (const bool gallery : {true, false}) {
    ImGui::SetNextWindowPos({area.x + area.width + theme.px(4), area.y});
    ImGui::SetNextWindowSize({theme.px(290), std::min(area.height, theme.px(620))});
    if (!ImGui::BeginPopup(gallery ? "gallery popup" : "scene popup")) continue;
    gallery ? gallery_panel(*this) : scene_panel(*this);
    ImGui::EndPopup();
  }
  ImGui::EndChild();
}

void App::step_keys(bool shift, bool control) {
  const bool right = key_pressed(Key::right) || key_pressed(Key::period), left = key_pressed(Key::left) || key_pressed(Key::comma);
  if (!right && !left) return;
  const int direction = right ? 1 : -1;
  session.playing = false;
  if (control) session.step_phase(direction);
  else if (shift) session.step_iteration(direction);
  else session.step_by(direction);
}

void App::control_keys(bool shift) {
  if (key_pressed(Key::z) && session.can_undo()) session.undo();
  if (key_pressed(Key::y) && session.can_redo()) session.redo();
  if (key_pressed(Key::o)) ask(Asking::open);
  if (key_pressed(Key::s)) ask(Asking::save);
  if (key_pressed(Key::f)) ask(Asking::find);
  if (key_pressed(Key::g)) ask(Asking::go_to);
  if (key_pressed(Key::q)) quit = true;
  if (key_pressed(Key::c)) {
    ImGui::SetClipboardText(shift ? scene_as_cpp(session.scene()).c_str() : (pretty_json(scene_to_json(session.scene())) + "\n").c_str());
    note(shift ? "the scene is copied as C++" : "the scene is copied as JSON");
  }
}

void App::keys() {
  const ImGuiIO& io = ImGui::GetIO();
  // WantTextInput still holds in the frame after a text field went away with its dialog: keys typed meanwhile are no text.
  if ((io.WantTextInput && ImGui::IsAnyItemActive()) || !session.is_open()) return;
  step_keys(shift_held(), control_held());
  if (control_held()) return control_keys(shift_held());
  if (key_pressed(Key::home)) session.playing = false, session.go_to(0);
  if (key_pressed(Key::end)) session.playing = false, session.go_to(session.count() - 1);
  if (key_pressed(Key::space)) session.toggle_play();
  if (key_pressed(Key::x)) show_lab = !show_lab;
  if (show_lab && key_pressed(Key::escape)) show_lab = false;
  if (key_pressed(Key::b)) session.toggle_breakpoint();
  if (key_pressed(Key::m)) session.add_bookmark();
  if (key_pressed(Key::left_bracket)) session.loop = true, session.loop_from = session.step();
  if (key_pressed(Key::right_bracket)) session.loop = true, session.loop_to = session.step();
  if (key_pressed(Key::f3)) {
    if (const auto step = find_text(session, find_buffer_, session.step(), shift_held())) session.go_to(*step);
  }
  for (int i = 1; i <= 9; ++i)
    if (key_pressed(static_cast<Key>(static_cast<int>(Key::digit_1) + i - 1)) && session.bookmarks.contains(i)) session.go_to(session.bookmarks[i]);
  view_keys();
}

void App::view_keys() {
  if (key_pressed(Key::f)) fit_views();
  if (key_pressed(Key::v)) preferences.layout = static_cast<Layout>((static_cast<int>(preferences.layout) + 1) % 4);
  if (key_pressed(Key::l)) preferences.linked_cameras = !preferences.linked_cameras;
  if (key_pressed(Key::g)) left_tab = left_tab == LeftTab::gallery ? LeftTab::scene : LeftTab::gallery;
  if (key_pressed(Key::t)) preferences.dark = !preferences.dark;
  if (key_pressed(Key::e)) lecture = !lecture;
  if (key_pressed(Key::slash) || key_pressed(Key::f1)) show_keys = !show_keys;
  if (key_pressed(Key::escape)) show_keys = lecture = false, settings.selected.reset(), message.clear();
  const double right_angle = std::numbers::pi / 2;
  const auto look = [&](double yaw, double pitch) {
    for (Camera* c : {&world_camera, &difference_camera}) c->yaw = yaw, c->pitch = pitch;
  };
  if (key_pressed(Key::pad_1)) look(0, 0);
  if (key_pressed(Key::pad_2)) look(right_angle, 0);
  if (key_pressed(Key::pad_3)) look(0, right_angle);
}

void App::key_sheet() {
  if (!show_keys) return;
  static const std::pair<const char*, const char*> rows[] = {
      {"Right  Left   or   .  ,", "on, back an event"}, {"Shift with them", "an iteration"}, {"Ctrl with them", "a phase"}, {"Home  End", "first, last step"},
      {"Space", "play, pause"}, {"[  ]", "loop from here, to here"}, {"B", "breakpoint here"}, {"M, 1 to 9", "bookmark, go to it"}, {"Ctrl-F, F3, Shift-F3", "find, next, previous"},
      {"Ctrl-G", "go to a step"}, {"F, double click", "fit the views"}, {"1 2 3 on the pad", "front, right, top"}, {"V", "side by side, stacked, one view"}, {"L", "link the cameras"},
      {"G", "gallery or scene"}, {"T", "dark or light"}, {"E", "explain in big letters"}, {"X", "charts and atlas"}, {"Ctrl-O  Ctrl-S", "open, save"}, {"Ctrl-C, Ctrl-Shift-C", "copy the scene: JSON, C++"},
      {"Ctrl-Z  Ctrl-Y", "undo, redo"}, {"Ctrl-Q", "quit"}, {"drag, right drag, wheel", "orbit, pan, zoom"}, {"click a vertex", "select it in both views"}, {"click a number", "the step it comes from"},
      {"drag a ring A or B", "move the body"}, {"drag its small disc", "turn the body"}};
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, vec(theme.palette.panel));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("Keys and mouse", &show_keys, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
  for (const auto& [key, meaning] : rows) {
    ImGui::TextColored(vec(theme.palette.text), "%s", key);
    ImGui::SameLine(theme.px(220));
    ImGui::TextColored(vec(theme.palette.text_soft), "%s", meaning);
  }
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

}  // namespace gjkdbg
