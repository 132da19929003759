// The window's content: a session, what is shown of it, and the panels. Draws with ImGui into whatever host made the context.
#pragma once

#include <string>

#include "debugger/view/session.h"
#include "debugger/view/theme.h"
#include "recordings/gallery.h"

namespace gjkdbg {

/// A rectangle of the window, in pixels.
struct Area {
  float x = 0, y = 0, width = 0, height = 0;
};

class App {
 public:
  App(Gallery gallery, float scale);

  Session session;
  Theme theme;
  ViewSettings settings;
  Camera world_camera, difference_camera;
  enum class Layout { both, world, difference } layout = Layout::both;
  enum class LeftTab { gallery, scene } left_tab = LeftTab::gallery;
  bool show_keys = false;
  std::string message;        ///< the last error, shown until the next success
  std::string save_requested; ///< a file name the person gave; the host writes it and clears this

  /// Opens a file or a gallery scene; what is wrong is shown in the window.
  void open(const std::filesystem::path& file);
  void open_gallery(const std::string& name);
  const Gallery& gallery() const { return gallery_; }

  /// One frame: keys, panels, views. Call between ImGui::NewFrame and ImGui::Render.
  void frame();
  /// Only the two views with a caption: what `render` writes.
  void picture_frame();
  /// Whether the next frame would differ without any input: something plays.
  bool moving() const { return session.playing; }
  void fit_views();

 private:
  void keys();
  void step_keys(bool shift, bool control);
  void top_bar(const Area& area);
  void left_panel(const Area& area);
  void key_sheet();
  void open_dialog();

  Gallery gallery_;
  int fitted_ = 0;
  bool asking_file_ = false;
  bool saving_ = false;
  char file_buffer_[1024] = {};
  float left_width_ = 270, right_width_ = 330, bottom_height_ = 260;  ///< logical pixels; splitters move them
};

// --- Panels, each a file -------------------------------------------------------------------------------------------

void gallery_panel(App& app);
void scene_panel(App& app);
void step_panel(App& app, const Area& area);
void timeline_panel(App& app, const Area& area);
/// The two views side by side, or the one chosen.
void view_panels(App& app, const Area& area, bool interactive);

// --- Small things all panels share ----------------------------------------------------------------------------------

/// A borderless child window over an area; call ImGui::EndChild after it.
bool begin_area(const char* name, const Area& area, bool scrolls = false);
void section(const Theme& theme, const char* title);
/// A label on the left and a number in the monospaced font, right-aligned.
void number_row(const Theme& theme, const char* label, const std::string& value, Colour colour);
/// A rounded label.
void chip(const Theme& theme, const std::string& text, Colour colour);
Colour event_colour(const Palette& palette, const Event& event);
/// The answer in a few words: "overlapping, depth 0.1".
std::string result_text(const Recording& recording);

}  // namespace gjkdbg
