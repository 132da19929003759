// The window asks for a file: to open, to compare with, to save.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

#include "debugger/view/app.h"

namespace gjkdbg {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_listed = 500;

/// As a shell reads it: a leading "~/" is the home folder.
std::string at_home(const std::string& name) {
  const char* home = std::getenv("HOME");
  return home && name.starts_with("~/") ? home + name.substr(1) : name;
}

/// What could be meant by the beginning of a name: folders, with a slash, and JSON files, each as it would be typed.
std::vector<std::string> possible_names(const std::string& typed) {
  const std::size_t slash = typed.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : typed.substr(0, slash + 1), begun = typed.substr(folder.size());
  std::vector<std::string> folders, files;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : at_home(folder), fs::directory_options::skip_permission_denied, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(begun) || (name.starts_with('.') && begun.empty())) continue;
    std::error_code gone;
    if (entry->is_directory(gone)) folders.push_back(folder + name + "/");
    else if (name.ends_with(".json")) files.push_back(folder + name);
    if (folders.size() + files.size() >= most_listed) break;
  }
  std::sort(folders.begin(), folders.end());
  std::sort(files.begin(), files.end());
  folders.insert(folders.end(), files.begin(), files.end());
  return folders;
}

/// Tab: the name goes on for as long as all that could be meant agree.
int complete(ImGuiInputTextCallbackData* data) {
  const std::string typed(data->Buf, static_cast<std::size_t>(data->BufTextLen));
  const std::vector<std::string> names = possible_names(typed);
  if (names.empty()) return 0;
  std::string common = names[0];
  for (const std::string& name : names) common.resize(static_cast<std::size_t>(std::mismatch(common.begin(), common.end(), name.begin(), name.end()).first - common.begin()));
  while (!common.empty() && common.size() < names[0].size() && (names[0][common.size()] & 0xC0) == 0x80) common.pop_back();  // no part of a letter
  if (common.size() > typed.size()) data->InsertChars(data->BufTextLen, common.c_str() + typed.size());
  return 0;
}

bool can_be_saved(std::string_view name) {
  constexpr std::array<std::string_view, 4> ends{".json", ".png", ".svg", ".gif"};
  return std::any_of(ends.begin(), ends.end(), [&](std::string_view end) { return name.ends_with(end) && fs::path(name).filename() != end; });
}

}  // namespace

void App::file_dialog() {
  const bool saving = asked_ == Asking::save;
  if (saving_ && save_requested.empty()) file_saved();
  ImGui::TextUnformatted(saving ? "Save as" : asked_ == Asking::compare ? "Compare with a recording, or a scene" : "Open a scene or a recording");
  wrapped(saving ? "NAME.scene.json the scene, NAME.recording.json every event, NAME.png or .svg this step, NAME.gif the replay"
                 : "The name of a file, or a click in the list; Tab completes. A file can be dropped on the window, too.", theme.palette.text_soft);
  if (ImGui::IsWindowAppearing() || std::exchange(name_wanted_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputText("##file", file_buffer_, sizeof file_buffer_, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion | (saving ? ImGuiInputTextFlags_AutoSelectAll : 0), complete);
  const bool replaces = saving && replacing_ == file_buffer_ && !replacing_.empty();
  if (!saving) file_list();
  if (!file_error_.empty()) wrapped(file_error_, theme.palette.newest);
  else if (replaces) wrapped(replacing_ + " is there already. Once more, and it is replaced.", theme.palette.newest);
  if (ImGui::Button(replaces ? "Replace" : saving ? "Save" : asked_ == Asking::compare ? "Compare" : "Open") || entered) file_entered();
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
}

void App::file_list() {
  if (listed_for_ != file_buffer_) listed_for_ = file_buffer_, listed_ = possible_names(file_buffer_);
  // Eight rows, or as many as leave the whole dialog in the window.
  const ImGuiStyle& style = ImGui::GetStyle();
  const float row = ImGui::GetTextLineHeightWithSpacing(), padding = theme.px(8), error = file_error_.empty() ? 0 : 2 * row;
  const float room = ImGui::GetIO().DisplaySize.y - ImGui::GetCursorPosY() - ImGui::GetFrameHeightWithSpacing() - style.WindowPadding.y - style.DisplaySafeAreaPadding.y * 2 - error - padding;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, vec(theme.palette.field));
  ImGui::BeginChild("list", {0, std::clamp(std::floor(room / row), 2.f, 8.f) * row + padding}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  std::optional<std::string> chosen;
  for (const std::string& name : listed_)
    if (ImGui::Selectable(name.c_str(), false, ImGuiSelectableFlags_DontClosePopups)) chosen = name;
  if (listed_.empty()) ImGui::TextColored(vec(theme.palette.text_faint), "no such folder or JSON file");
  ImGui::EndChild();
  ImGui::PopStyleColor();
  if (!chosen || chosen->size() >= sizeof file_buffer_) return;
  std::strcpy(file_buffer_, chosen->c_str());
  if (!chosen->ends_with('/')) file_entered();
}

/// To be opened or compared with; what is wrong with it is said in the dialog.
bool App::file_taken(const std::string& name) {
  try {
    asked_ == Asking::compare ? compare_or_throw(name) : open_or_throw(name);
    message.clear();
    return true;
  } catch (const Error& e) {
    file_error_ = e.line(), name_wanted_ = true;
    return false;
  }
}

/// Within the dialog, where one is open: if it asks for a file to read, this is it; if for something else, that is over.
void App::file_dropped(bool dialog) {
  const std::vector<fs::path> files = std::exchange(dropped_, {});
  const bool reads = dialog && (asked_ == Asking::open || asked_ == Asking::compare);
  const bool taken = reads ? file_taken(files[0].string()) : (open(files[0]), message.empty());
  if (dialog && (taken || !reads)) ImGui::CloseCurrentPopup();
  if (taken && files.size() > 1) note("of " + std::to_string(files.size()) + " files the first is open; COMPARE WITH takes another");
}

void App::file_entered() {
  const std::string name = at_home(file_buffer_);
  file_error_.clear();
  if (asked_ != Asking::save) {
    if (file_taken(name)) ImGui::CloseCurrentPopup();
    return;
  }
  std::error_code ignored;
  if (!can_be_saved(name)) {
    file_error_ = "The name must end in .json, .png, .svg or .gif: it says what is saved.", name_wanted_ = true;
  } else if (fs::exists(name, ignored) && replacing_ != file_buffer_) {
    replacing_ = file_buffer_, name_wanted_ = true;
  } else {
    save_requested = name, saving_ = true;
  }
}

/// The host has done it, or said why not: then the name stays, to be changed.
void App::file_saved() {
  saving_ = false;
  if (message.empty()) return ImGui::CloseCurrentPopup();
  file_error_ = std::exchange(message, {}), name_wanted_ = true;
}

}  // namespace gjkdbg
