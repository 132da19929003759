#include "debugger/view/app.h"

#include <algorithm>
#include <cstring>
#include <numbers>

#include "debugger/view/explain.h"
#include "debugger/view/input.h"

namespace gjkdbg {

App::App(Gallery gallery, float scale) : gallery_(std::move(gallery)) {
  load_fonts(theme, scale);
  apply_colours(theme, true);
  ImGui::GetIO().IniFilename = nullptr;
}

void App::open(const std::filesystem::path& file) {
  try {
    session.open(file);
    message.clear();
    settings.selected.reset();
  } catch (const Error& e) {
    message = e.line();
  }
}

void App::open_gallery(const std::string& name) { open(gallery_.file(name)); }

void App::fit_views() {
  const Camera world = world_camera, difference = difference_camera;
  world_camera = fit_world(session.meshes());
  difference_camera = fit_difference(session.meshes(), session.recording());
  if (fitted_ == 0) return;
  world_camera.yaw = world.yaw, world_camera.pitch = world.pitch;
  difference_camera.yaw = difference.yaw, difference_camera.pitch = difference.pitch;
}

void App::frame() {
  session.tick(ImGui::GetIO().DeltaTime);
  if (session.is_open() && fitted_ != session.opened()) fit_views(), fitted_ = session.opened();
  keys();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("gjkdbg", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar();
  const float gap = theme.px(6), top = theme.px(48);
  const bool narrow = size.x < theme.px(1180);
  top_bar({0, 0, size.x, top});
  const float left = narrow ? 0 : theme.px(left_width_), right = theme.px(narrow ? 280 : right_width_);
  const float bottom = std::min(theme.px(bottom_height_), size.y * 0.38f);
  const Area middle{left + gap, top + gap, size.x - left - right - 3 * gap, size.y - top - bottom - 3 * gap};
  if (session.is_open()) {
    if (!narrow) left_panel({gap, top + gap, left - gap, size.y - top - 2 * gap});
    view_panels(*this, middle, true);
    timeline_panel(*this, {middle.x, middle.y + middle.height + gap, middle.width, bottom});
    step_panel(*this, {size.x - right - gap, top + gap, right, size.y - top - 2 * gap});
  }
  ImGui::End();
  key_sheet();
  open_dialog();
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
  ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.text_soft));
  ImGui::TextWrapped("%s", e.text.c_str());
  ImGui::PopStyleColor();
  ImGui::EndChild();
  ImGui::End();
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
  if (ImGui::Button("Gallery")) ImGui::OpenPopup("gallery");
  ImGui::SameLine(0, theme.px(2));
  if (ImGui::Button("Open")) asking_file_ = true, saving_ = false;
  ImGui::SameLine(0, theme.px(2));
  if (ImGui::Button("Save")) asking_file_ = true, saving_ = true;
  ImGui::SameLine(0, theme.px(2));
  if (ImGui::Button(theme.dark ? "Light" : "Dark")) apply_colours(theme, !theme.dark);
  ImGui::SameLine(0, theme.px(2));
  if (ImGui::Button("Keys")) show_keys = !show_keys;
  ImGui::PopStyleColor();
  ImGui::SetNextWindowSize({theme.px(300), theme.px(420)});
  if (ImGui::BeginPopup("gallery")) {
    gallery_panel(*this);
    ImGui::EndPopup();
  }
  if (session.is_open()) {
    const Settings& s = session.recording().settings;
    const bool overlap = session.recording().result.intersecting;
    const std::string result = result_text(session.recording());
    const std::string method = std::string(method_names[static_cast<std::size_t>(s.name)]) + "  \xC2\xB7  " + std::string(query_names[static_cast<std::size_t>(session.scene().scene.query)]) +
                               "  \xC2\xB7  " + std::string(scalar_names[static_cast<std::size_t>(s.scalar)]);
    const auto width = [&](const std::string& text) { return theme.small->CalcTextSizeA(theme.small->FontSize, 1e6f, 0, text.c_str()).x + theme.px(22); };
    const float chips = width(result) + width(method) + theme.px(8), title = ImGui::CalcTextSize(session.title().c_str()).x;
    const float middle = area.width / 2 - title / 2, here = ImGui::GetItemRectMax().x + theme.px(16);
    if (std::max(middle, here) + title < area.width - chips - theme.px(24)) {
      ImGui::SameLine(std::max(middle, here));
      ImGui::TextUnformatted(session.title().c_str());
    }
    ImGui::SameLine(area.width - chips - theme.px(16));
    chip(theme, method, theme.palette.accent);
    ImGui::SameLine(0, theme.px(8));
    chip(theme, result, overlap ? theme.palette.newest : theme.palette.support);
  }
  ImGui::EndChild();
}

void App::left_panel(const Area& area) {
  if (begin_area("left", area, true)) {
    const auto tab = [&](const char* name, LeftTab value) {
      const bool current = left_tab == value;
      ImGui::PushStyleColor(ImGuiCol_Text, vec(current ? theme.palette.text : theme.palette.text_faint));
      ImGui::PushStyleColor(ImGuiCol_Button, vec(current ? theme.palette.field : theme.palette.panel));
      if (ImGui::Button(name, {(ImGui::GetWindowContentRegionWidth() - theme.px(6)) / 2, 0})) left_tab = value;
      ImGui::PopStyleColor(2);
    };
    tab("Gallery", LeftTab::gallery);
    ImGui::SameLine(0, theme.px(6));
    tab("Scene", LeftTab::scene);
    ImGui::Dummy({0, theme.px(4)});
    if (!message.empty()) {
      ImGui::PushStyleColor(ImGuiCol_Text, vec(theme.palette.newest));
      ImGui::TextWrapped("%s", message.c_str());
      ImGui::PopStyleColor();
    }
    left_tab == LeftTab::gallery ? gallery_panel(*this) : scene_panel(*this);
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

void App::keys() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || !session.is_open()) return;
  step_keys(io.KeyShift, io.KeyCtrl);
  if (io.KeyCtrl) {
    if (key_pressed(Key::z) && session.can_undo()) session.undo();
    if (key_pressed(Key::y) && session.can_redo()) session.redo();
    if (key_pressed(Key::o)) asking_file_ = true, saving_ = false;
    if (key_pressed(Key::s)) asking_file_ = true, saving_ = true;
    return;
  }
  if (key_pressed(Key::home)) session.playing = false, session.go_to(0);
  if (key_pressed(Key::end)) session.playing = false, session.go_to(session.count() - 1);
  if (key_pressed(Key::space)) session.toggle_play();
  if (key_pressed(Key::b)) session.toggle_breakpoint();
  if (key_pressed(Key::m)) session.add_bookmark();
  if (key_pressed(Key::left_bracket)) session.loop = true, session.loop_from = session.step();
  if (key_pressed(Key::right_bracket)) session.loop = true, session.loop_to = session.step();
  if (key_pressed(Key::f)) fit_views();
  if (key_pressed(Key::v)) layout = static_cast<Layout>((static_cast<int>(layout) + 1) % 3);
  if (key_pressed(Key::g)) left_tab = left_tab == LeftTab::gallery ? LeftTab::scene : LeftTab::gallery;
  if (key_pressed(Key::t)) apply_colours(theme, !theme.dark);
  if (key_pressed(Key::slash) || key_pressed(Key::f1)) show_keys = !show_keys;
  if (key_pressed(Key::escape)) show_keys = false, settings.selected.reset();
  for (int i = 1; i <= 9; ++i)
    if (key_pressed(static_cast<Key>(static_cast<int>(Key::digit_1) + i - 1)) && session.bookmarks.contains(i)) session.go_to(session.bookmarks[i]);
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
      {"Space", "play, pause"}, {"[  ]", "loop from here, to here"}, {"B", "breakpoint here"}, {"M, 1 to 9", "bookmark, go to it"}, {"F, double click", "fit the views"},
      {"1 2 3 on the pad", "front, right, top"}, {"V", "both views, or one"}, {"G", "gallery or scene"}, {"T", "dark or light"}, {"Ctrl-O  Ctrl-S", "open, save"},
      {"Ctrl-Z  Ctrl-Y", "undo, redo"}, {"drag, right drag, wheel", "orbit, pan, zoom"}, {"click a vertex", "select it in both views"}, {"drag a ring A or B", "move the body"}};
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

void App::open_dialog() {
  if (asking_file_) {
    ImGui::OpenPopup("File");
    asking_file_ = false;
    const std::string suggestion = saving_ ? session.title() + ".scene.json" : "";
    std::strncpy(file_buffer_, suggestion.c_str(), sizeof file_buffer_ - 1);
  }
  ImGui::SetNextWindowSize({theme.px(520), 0});
  if (!ImGui::BeginPopupModal("File", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoSavedSettings)) return;
  ImGui::TextUnformatted(saving_ ? "Save as (NAME.scene.json, or NAME.recording.json with every event)" : "Open a scene or a recording");
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputText("##file", file_buffer_, sizeof file_buffer_, ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::Button(saving_ ? "Save" : "Open") || entered) {
    if (saving_) save_requested = file_buffer_;
    else open(file_buffer_);
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel") || key_pressed(Key::escape)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace gjkdbg
