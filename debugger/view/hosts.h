// Where the App lives: a GLFW window for people, an EGL framebuffer for tests and pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "debugger/view/app.h"
#include "debugger/view/input.h"

namespace gjkdbg {

/// RGB, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Writes what the person asked to save; returns the error's line, or nothing.
using Save = std::function<std::string(const App&, const std::string& file)>;

/// What has come of a run that goes on beside the window.
struct Refreshed {
  std::optional<Recording> run;  ///< to be shown instead of what is
  std::string error;
  std::string running;           ///< what to say for as long as it goes on
};

struct WindowOptions {
  int width = 0, height = 0;  ///< 0: as remembered
  float scale = 0;  ///< 0: the monitor's
  std::filesystem::path file;
  std::string scene = "box-box-deep";  ///< of the gallery, when no file is named
  std::filesystem::path beside;        ///< a recording or scene to compare with
  Save save;
  Preferences preferences;
  std::function<void(const Preferences&)> remember;  ///< called when the window closes
  std::function<Refreshed()> refresh;  ///< asked every third of a second
  /// Starts a measurement ("chart" or "atlas"), or, asked for "", tells the file of the one that is done. Throws Error when there will be none.
  std::function<std::optional<std::filesystem::path>(const std::string& what)> measure;
};

/// Opens the window and runs until it is closed. Throws Error when there is no display or no OpenGL 3.3.
void run_window(const WindowOptions& options, Gallery gallery);

/// The same content without a display.
class Headless {
 public:
  /// Throws Error when EGL or OpenGL 3.3 is not there.
  Headless(int width, int height, float scale, Gallery gallery);
  ~Headless();
  Headless(const Headless&) = delete;
  Headless& operator=(const Headless&) = delete;

  App& app() { return *app_; }
  /// One frame of the whole window, or of the views with a caption.
  void frame(bool picture_only = false);
  Image image() const;

  // Input, as a person gives it. Takes effect with the next frames, which these draw.
  void press(Key key, bool shift = false, bool control = false);
  void move(float x, float y);
  void click(float x, float y);
  void drag(float x0, float y0, float x1, float y1);
  void wheel(float x, float y, float steps);
  void type(const std::string& text);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
  std::unique_ptr<App> app_;
};

}  // namespace gjkdbg
