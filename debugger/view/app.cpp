#include "debugger/view/app.h"

#include <algorithm>
#include <utility>

#include "debugger/view/explain.h"
#include "debugger/view/input.h"
#include "debugger/view/step_notes.h"
#include "recordings/json_writing.h"

#include <nlohmann/json.hpp>

namespace gjkdbg {

App::App(Gallery gallery, float scale) : gallery_(std::move(gallery)) {
  load_fonts(theme, scale);
  apply_colours(theme, true);
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().ConfigDragClickToInputText = true;
}

namespace {

bool has_errors(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Finding::Severity::error; });
}

}  // namespace

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
  if (session.findings().empty()) return;
  session.go_to(session.findings().front().step);  // what is looked for
  note("at the first finding; Home is the beginning", has_errors(session.findings()));
}

namespace {

bool same_bodies(SceneFile x, SceneFile y) {
  x.method = y.method = {};
  return scene_to_json(x) == scene_to_json(y);
}

}  // namespace

void App::show_run(Recording run) {
  const auto at_first_finding = [&] { return !session.findings().empty() && session.step() == session.findings().front().step; };
  const bool again = foreign(session.recording()), follows = !again || at_first_finding();
  if (same_bodies(session.scene(), run.scene)) {
    session.open_again(std::move(run));
  } else {
    const std::string name = run.scene.scene.name;
    session.open(std::move(run), name.empty() ? "your solver's run" : name);
    show_lab = false;
  }
  settings.selected.reset();
  message.clear();
  if (session.findings().empty()) {
    if (again) note("run again: no findings");
    return;
  }
  if (follows) session.go_to(session.findings().front().step);
  note(at_first_finding() ? std::string(again ? "run again: " : "") + "at the first finding; Home is the beginning"
                          : "run again: the first finding is at step " + std::to_string(session.findings().front().step),
       has_errors(session.findings()));
}

void App::open_gallery(const std::string& name) { open(gallery_.file(name)); }

void App::open_beside(int step) {
  std::vector<std::string> all;
  for (const Lesson& lesson : gallery_.lessons) all.insert(all.end(), lesson.scenes.begin(), lesson.scenes.end());
  const auto last = static_cast<std::ptrdiff_t>(all.size()) - 1, at = std::find(all.begin(), all.end(), session.scene().scene.name) - all.begin();
  const std::ptrdiff_t next = at <= last ? at + step : step > 0 ? 0 : last;
  if (next >= 0 && next <= last) open_gallery(all[static_cast<std::size_t>(next)]);
  else note(step > 0 ? "the gallery ends here" : "the gallery begins here");
}

void App::compare_or_throw(const std::filesystem::path& file) {
  Session read;
  read.open(file);
  session.compare_with(read.recording(), read.title() == session.title() ? method_text(read.recording()) : read.title());
}

void App::fit_views() {
  const Camera world = world_camera, difference = difference_camera;
  world_camera = fit_world(session.meshes(), session.recording());
  difference_camera = fit_difference(session.meshes(), session.recording());
  if (fitted_ == 0) return;
  world_camera.yaw = world.yaw, world_camera.pitch = world.pitch;
  difference_camera.yaw = difference.yaw, difference_camera.pitch = difference.pitch;
}

void App::fit_what_has_left() {
  const auto left = [](const Camera& all, const Camera& now) { return (all.target - now.target).norm() + all.radius > 2 * now.radius || 6 * all.radius < now.radius; };
  if (left(fit_world(session.meshes(), session.recording()), world_camera) || left(fit_difference(session.meshes(), session.recording()), difference_camera)) fit_views();
}

void App::frame() {
  const bool played = session.playing;
  session.tick(ImGui::GetIO().DeltaTime);
  if (played && !session.playing && session.stops_at(session.step())) note(session.breakpoints.contains(session.step()) ? "stopped at a breakpoint" : "stopped: " + stop_when_text);
  thumbnails_.next_frame();
  notice_left_ = std::max(0.f, notice_left_ - ImGui::GetIO().DeltaTime);
  if (preferences.dark != theme.dark) apply_colours(theme, preferences.dark);
  settings.difference = preferences.difference, settings.support_plane = preferences.support_plane, settings.dropped = preferences.dropped;
  settings.labels = preferences.labels, settings.grid = preferences.grid, settings.regions = preferences.regions, settings.bounds = preferences.bounds;
  settings.newest_first = preferences.newest_first;
  if (session.is_open() && fitted_ != session.opened()) fit_views(), fitted_ = session.opened();
  read_decimal_commas();
  keys();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("gjkdbg", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar();
  panels({0, 0, size.x, size.y});
  ImGui::End();
  find_bar();
  key_sheet();
  dialogs();
  list_open_ = list_is_open();
  choose_by_keys(list_open_);
}

void App::edit(const SceneFile& next) {
  const bool theirs = foreign(session.recording());
  message = session.edit(next);
  if (theirs && message.empty()) note("solved by gjkdbg's own method from here on; Ctrl-Z brings your solver's run back");
}

/// What went wrong, until something succeeds or it is clicked away; what was done, for a while. At the lower end of what is shown, off the titles.
void App::banner(const Area& above) {
  const bool error = !message.empty();
  if (!error && notice_left_ <= 0 && running.empty()) return;
  const std::string& text = error ? message : notice_left_ > 0 ? notice : running;
  const float wrap = above.width - theme.px(60);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const float width = std::min(above.width, size.x + theme.px(60)), height = size.y + theme.px(22), x = above.x + (above.width - width) / 2, y = above.y + above.height - height;
  const bool bad = error || (notice_left_ > 0 && notice_is_bad_);
  const Colour fill = bad ? theme.palette.newest.shaded(-0.15) : theme.palette.hover;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4());
  begin_area("banner", {x, y, width, height});
  // In its own draw list: ImGui may draw a child's background with the parent's, below what the views have drawn.
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRectFullScreen();
  draw->AddRectFilled({x, y}, {x + width, y + height}, packed(fill), theme.px(8));
  draw->PopClipRect();
  ImGui::SetCursorPos({(width - size.x) / 2, (height - size.y) / 2});
  ImGui::PushStyleColor(ImGuiCol_Text, vec(bad ? rgb(0xffffff) : theme.palette.text));
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  if (error) draw->AddText({x + width - theme.px(22), y + (height - ImGui::GetTextLineHeight()) / 2}, packed(rgb(0xffffff)), "\xC3\x97");
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
  settings.body_letters = true;
  view_panels(*this, {gap, gap, size.x - 2 * gap, size.y - caption - 2 * gap}, false);
  settings.body_letters = false;
  begin_area("caption", {gap, size.y - caption, size.x - 2 * gap, caption - gap});
  const Explanation e = explain(session.recording(), session.frame(), settings.newest_first);
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

/// As the window is larger than 800 points high, so are the letters; and smaller as it is too low for all.
float App::lecture_scale(float window_height) const { return std::clamp(window_height / theme.px(800), 1.f, 2.5f) * std::clamp(window_height / theme.px(400), 0.6f, 1.f); }

/// On the title's line at the right, where there is room and it can be read; half as large.
void App::lecture_place(const std::string& place) {
  const float line = ImGui::GetItemRectMax().y, title = ImGui::GetItemRectMax().x;
  const float size = theme.lecture->FontSize * lecture_scale(ImGui::GetIO().DisplaySize.y) / 3.2f, width = theme.lecture->CalcTextSizeA(size, 1e6f, 0, place.c_str()).x;
  const float left = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x - width;
  if (left < title + theme.px(16) || size < theme.px(9)) return;
  ImGui::GetWindowDrawList()->AddText(theme.lecture, size, {left, line - size * 1.25f}, packed(theme.palette.text_faint), place.c_str());
}

/// For a hall: the step in letters that the last row can read, and the scrubber where that leaves room for them.
void App::lecture_panel(const Area& area) {
  if (begin_panel(theme, "lecture", area, true)) {
    if (area.height > theme.px(170)) scrubber(*this);
    const Explanation e = explain(session.recording(), session.frame(), settings.newest_first);
    ImGui::Dummy({0, theme.px(4)});
    ImGui::SetWindowFontScale(lecture_scale(ImGui::GetIO().DisplaySize.y) / 2);
    ImGui::PushFont(theme.lecture_title);
    ImGui::TextUnformatted(e.title.c_str());
    ImGui::PopFont();
    lecture_place(place_text(session));
    ImGui::PushFont(theme.lecture);
    finding_first(*this);
    wrapped(e.text, theme.palette.text_soft);
    for (const Finding& f : session.findings())
      if (f.step == session.step() && &f != error_here(session)) wrapped(f.message, theme.palette.newest);
    ImGui::PopFont();
    ImGui::SetWindowFontScale(1);
  }
  ImGui::EndChild();
}

namespace {

/// Whether a finding says that the answer is wrong, not only a step on the way.
bool about_the_answer(const Finding& f) {
  static const char* const codes[] = {"wrong-answer", "wrong-distance", "wrong-depth", "wrong-normal", "flipped-normal", "wrong-witness", "wrong-bounds", "wrong-contact", "unjustified-separation"};
  return std::find(std::begin(codes), std::end(codes), f.code) != std::end(codes);
}

}  // namespace

void App::top_bar(const Area& area) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(16), theme.px(9)});
  begin_area("top", area);
  ImGui::PopStyleVar();
  const bool name_fits = area.width >= theme.px(470), all_fit = area.width >= theme.px(400);  // what goes first has a key
  if (name_fits) {
    ImGui::PushFont(theme.title);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("gjkdbg");
    ImGui::PopFont();
    ImGui::SameLine(0, theme.px(20));
  }
  ImGui::PushStyleColor(ImGuiCol_Button, vec(theme.palette.panel));
  const auto button = [&](const char* name, const char* tip) {
    const bool pressed = ImGui::Button(name);
    tip_beside_row(theme, tip);
    ImGui::SameLine(0, theme.px(2));
    return pressed;
  };
  if (button("Open", "Open a scene or a recording (Ctrl-O)")) ask(Asking::open);
  if (button("Save", "Save the scene, the recording, a picture or the replay (Ctrl-S)")) ask(Asking::save);
  if (button("Find", find_.open ? "" : "Find a step (Ctrl-F)")) open_find_bar();  // whose field the words would cover
  if (button("Measure", "Speed against accuracy, stability where methods fail (X)")) show_lab = !show_lab, session.playing = false;
  if (all_fit && button("Explain", "Big text, for a hall (E)")) lecture = show_lab || !lecture, show_lab = false;
  if (all_fit && button(theme.dark ? "Light" : "Dark", "The other colours (T)")) preferences.dark = !preferences.dark;
  if (button("Keys", "All keys (?)")) show_keys = !show_keys;
  ImGui::PopStyleColor();
  if (session.is_open()) title_and_chips(area);
  ImGui::EndChild();
}

/// What is open, by which method it was solved, and with what result; in a narrow window less of it.
void App::title_and_chips(const Area& area) {
  const bool simulated = session.scene().scene.query == Query::simulate;
  const auto& findings = session.findings();
  const auto errors = std::count_if(findings.begin(), findings.end(), [](const Finding& f) { return f.severity == Finding::Severity::error; });
  const bool open = unanswered(session.recording().result), wrong = !open && std::any_of(findings.begin(), findings.end(), about_the_answer);
  const bool found_wrong = wrong || errors > 0, neutral = simulated || open;  // findings have one colour everywhere
  const std::string found = wrong || errors == 0 ? "" : errors == 1 ? "  \xC2\xB7  1 finding" : "  \xC2\xB7  " + std::to_string(errors) + " findings";
  const std::string whole_result = (wrong ? "wrong: " : "") + result_text(session.recording()) + found, name = session.title() + (session.can_undo() ? " (edited)" : "");
  std::string result = whole_result;
  const Colour tone = found_wrong ? theme.palette.newest : neutral ? theme.palette.text_soft : session.recording().result.intersecting ? theme.palette.chosen : theme.palette.support;
  const std::string whole = method_text(session.recording()), short_name = foreign(session.recording()) ? "yours" : std::string(word_of(session.recording().settings.name));
  std::string method = whole + "  \xC2\xB7  " + std::string(word_of(session.scene().scene.query));
  const auto width = [&](const std::string& text) { return theme.small->CalcTextSizeA(theme.small->FontSize, 1e6f, 0, text.c_str()).x + theme.px(22); };
  const float here = ImGui::GetItemRectMax().x + theme.px(16), title = ImGui::CalcTextSize(name.c_str()).x, middle = area.width / 2 - title / 2;
  const auto both = [&] { return width(result) + width(method) + theme.px(8); };
  const auto too_wide = [&] { return area.width - both() - theme.px(16) < here; };
  if (too_wide()) method = whole;  // a narrow window: the query is left out, then all but the name
  if (too_wide()) method = short_name;
  const bool alone = too_wide();  // not even that
  if (const float room = area.width - theme.px(16) - here; alone && width(result) > room) {
    if (room < theme.px(80)) return;
    result = shortened(theme.small, result, room - theme.px(22));
  }
  const float chips = alone ? width(result) : both();
  if (const float room = area.width - chips - theme.px(24) - std::max(middle, here); room > std::min(title, theme.px(80))) {
    ImGui::SameLine(std::max(middle, here));
    ImGui::TextUnformatted(shortened(theme.text, name, room).c_str());
    if (title > room && ImGui::IsItemHovered()) tooltip(theme, name);
  }
  ImGui::SameLine(area.width - chips - theme.px(16));
  if (!alone) {
    chip(theme, method, theme.palette.accent);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("method: %s\nquery: %s", whole.c_str(), word_of(session.scene().scene.query).data());
    ImGui::SameLine(0, theme.px(8));
  }
  chip(theme, result, tone);
  if (!ImGui::IsItemHovered()) return;
  const Result& r = session.recording().result;
  const std::string bounds = r.lower_bound && r.upper_bound ? "\nbounds: " + all_digits(*r.lower_bound) + " to " + all_digits(*r.upper_bound) : "";
  ImGui::SetTooltip("%s\nstatus: %s%s", whole_result.c_str(), r.status.text().c_str(), bounds.c_str());
}

namespace {

/// In a window of its own, so that what is above stays and the gallery is scrolled for itself.
void scrolling_scene(App& app) {
  if (begin_list("scene")) scene_panel(app);
  ImGui::EndChild();
}

}  // namespace

void App::left_panel(const Area& area) {
  if (begin_area("left", area)) {
    const float half = (ImGui::GetWindowContentRegionWidth() - theme.px(6)) / 2;
    if (tab_button(theme, "Gallery", left_tab == LeftTab::gallery, half)) left_tab = LeftTab::gallery;
    ImGui::SameLine(0, theme.px(6));
    if (tab_button(theme, "Scene", left_tab == LeftTab::scene, half)) left_tab = LeftTab::scene;
    ImGui::Dummy({0, theme.px(4)});
    left_tab == LeftTab::gallery ? gallery_panel(*this) : scrolling_scene(*this);
  }
  ImGui::EndChild();
}

/// Where there is no room for the left panel: two icons that open it.
void App::icon_rail(const Area& area) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(5), theme.px(8)});
  begin_area("rail", area);
  ImGui::PopStyleVar();
  std::optional<LeftTab> opens;
  const auto popup_of = [](LeftTab tab) { return tab == LeftTab::gallery ? "gallery popup" : "scene popup"; };
  const auto icon = [&](const char* name, const char* tip, bool gallery) {
    const ImVec2 at = ImGui::GetCursorScreenPos(), size{theme.px(34), theme.px(34)};
    const LeftTab tab = gallery ? LeftTab::gallery : LeftTab::scene;
    // A click beside an open popup closes it, and no button hears of it.
    const bool over = ImGui::IsPopupOpen(popup_of(gallery ? LeftTab::scene : LeftTab::gallery)) && ImGui::IsMouseClicked(ImGuiMouseButton_Left) && ImGui::IsMouseHoveringRect(at, {at.x + size.x, at.y + size.y}, false);
    if (ImGui::Button(name, size) || over) opens = tab;
    if (ImGui::IsItemHovered()) ImGui::SetNextWindowPos({at.x + size.x + theme.px(7), at.y}), ImGui::SetTooltip("%s", tip);  // off the other one
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
  icon("##gallery", "Gallery (G)", true);
  icon("##scene", "Scene: bodies, method, what is shown (G)", false);
  if (const auto now = std::exchange(rail_opens_, opens)) ImGui::OpenPopup(popup_of(*now));  // a frame later: the click itself still closes what is open
  for (const bool gallery : {true, false}) {
    ImGui::SetNextWindowPos({area.x + area.width + theme.px(4), area.y});
    ImGui::SetNextWindowSize({theme.px(290), std::min(area.height, theme.px(620))});
    if (!ImGui::BeginPopup(popup_of(gallery ? LeftTab::gallery : LeftTab::scene))) continue;
    rail_open_ = true;
    gallery ? gallery_panel(*this) : scrolling_scene(*this);
    ImGui::EndPopup();
  }
  ImGui::EndChild();
}

}  // namespace gjkdbg
