#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <utility>

#include "debugger/view/hosts.h"
#include "shapes/error.h"

namespace gjkdbg {
namespace {

/// GLFW for as long as it lives; its errors become one line.
struct Glfw {
  Glfw() {
    glfwSetErrorCallback([](int, const char* what) { last_error() = what; });
    if (!glfwInit()) throw Error("no-display", "no window can be opened: " + last_error());
  }
  ~Glfw() { glfwTerminate(); }
  static std::string& last_error() {
    static std::string text;
    return text;
  }
};

GLFWwindow* make_window(const WindowOptions& options) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  int width = options.preferences.width, height = options.preferences.height;
  // A size kept from another display may be more than this one has. A size that was asked for is taken at its word.
  int x = 0, y = 0, free_width = 0, free_height = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(monitor, &x, &y, &free_width, &free_height);
  if (free_width > 0 && free_height > 0) width = std::min(width, free_width), height = std::min(height, free_height);
  GLFWwindow* window = glfwCreateWindow(options.width > 0 ? options.width : width, options.height > 0 ? options.height : height, "gjkdbg", nullptr, nullptr);
  if (!window) throw Error("no-display", "no window with OpenGL 3.3 can be opened: " + Glfw::last_error());
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  return window;
}

float scale_of(GLFWwindow* window, float asked) {
  if (asked > 0) return asked;
  float x = 1, y = 1;
  glfwGetWindowContentScale(window, &x, &y);
  return std::clamp(x, 1.0f, 4.0f);
}

/// Keys that went down since the last frame, and perhaps up again, are down for this one.
void hold_presses([[maybe_unused]] GLFWwindow* window, [[maybe_unused]] bool down) {
#if IMGUI_VERSION_NUM < 18700
  for (const int code : noted_presses())
    if (code >= 0 && code < 512) ImGui::GetIO().KeysDown[code] = down || glfwGetKey(window, code) == GLFW_PRESS;
#endif
}

void draw(GLFWwindow* window, App& app) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  hold_presses(window, true);
  ImGui::GetIO().DeltaTime = std::clamp(ImGui::GetIO().DeltaTime, 1e-4f, 0.1f);
  ImGui::NewFrame();
  app.frame();
  hold_presses(window, false);
  forget_presses();
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  glViewport(0, 0, width, height);
  const ImVec4 background = vec(app.theme.palette.background);
  glClearColor(background.x, background.y, background.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window);
}

void open_dropped(GLFWwindow* window, int count, const char** files) {
  if (count > 0) static_cast<App*>(glfwGetWindowUserPointer(window))->drop({files, files + count});
}

void refresh(App& app, const WindowOptions& options) {
  Refreshed refreshed = options.refresh();
  if (refreshed.run) app.show_run(std::move(*refreshed.run));
  if (!refreshed.error.empty()) app.message = refreshed.error;
  app.running = refreshed.running + (refreshed.running.empty() || foreign(app.session.recording()) ? "" : ". Until then you see gjkdbg's own run.");
}

/// Starts the measurement asked for; shows the one that is done.
void measure(App& app, const WindowOptions& options) {
  if (!app.measuring && app.measure_requested.empty()) return;
  try {
    const bool begin = !app.measuring;
    app.measuring = true;
    const auto file = options.measure(begin ? app.measure_requested : "");
    app.measure_requested.clear();
    if (file) app.measuring = false, app.open(*file);
  } catch (const Error& e) {
    app.measuring = false, app.measure_requested.clear(), app.message = e.line();
  }
}

int& inputs() {
  static int count = 0;
  return count;
}

/// Before ImGui's own callbacks, which call these.
void count_inputs(GLFWwindow* window) {
  glfwSetKeyCallback(window, [](GLFWwindow*, [[maybe_unused]] int key, int, [[maybe_unused]] int action, [[maybe_unused]] int held) {
    ++inputs();
#if IMGUI_VERSION_NUM < 18700
    if (action == GLFW_PRESS) note_press(key, (held & GLFW_MOD_SHIFT) != 0, (held & GLFW_MOD_CONTROL) != 0);
#endif
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow*, int, int, int) { ++inputs(); });
  glfwSetCursorPosCallback(window, [](GLFWwindow*, double, double) { ++inputs(); });
  glfwSetScrollCallback(window, [](GLFWwindow*, double, double) { ++inputs(); });
  glfwSetCharCallback(window, [](GLFWwindow*, unsigned) { ++inputs(); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow*, int, int) { ++inputs(); });
}

/// Draws while something changes; otherwise sleeps until there is input. A few frames follow every input, for what takes ImGui
/// more than one to settle: a button that goes down and up at once is pressed in the second.
void loop(GLFWwindow* window, App& app, const WindowOptions& options) {
  int frames_left = 3, seen = 0;
  std::string title;
  while (!glfwWindowShouldClose(window) && !app.quit) {
    if (std::exchange(seen, inputs()) != inputs()) frames_left = 3;
    if (app.moving()) glfwPollEvents();
    else if (frames_left > 0) glfwPollEvents(), --frames_left;
    else if (options.refresh || app.measuring) glfwWaitEventsTimeout(0.33), frames_left = 1;
    else glfwWaitEvents(), frames_left = 3;
    if (options.refresh) refresh(app, options);
    if (options.measure) measure(app, options);
    draw(window, app);
    if (!app.save_requested.empty() && options.save) {
      app.message = options.save(app, app.save_requested);
      if (app.message.empty()) app.note("saved " + app.save_requested);
      app.save_requested.clear();
    }
    if (app.session.title() != title) {
      title = app.session.title();
      glfwSetWindowTitle(window, (title + " - gjkdbg").c_str());
    }
  }
}

}  // namespace

void run_window(const WindowOptions& options, Gallery gallery) {
  const Glfw glfw;
  GLFWwindow* window = make_window(options);
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  App app(std::move(gallery), scale_of(window, options.scale));
  glfwSetWindowUserPointer(window, &app);
  glfwSetDropCallback(window, open_dropped);
  count_inputs(window);
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  app.preferences = options.preferences;
  app.session.speed = app.preferences.speed;
  if (options.file.empty()) app.open_gallery(options.scene);
  else app.open_or_throw(options.file);
  if (!options.beside.empty()) app.compare_or_throw(options.beside);
  loop(window, app, options);
  if (options.remember) {
    app.preferences.speed = app.session.speed;
    glfwGetWindowSize(window, &app.preferences.width, &app.preferences.height);
    options.remember(app.preferences);
  }
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

}  // namespace gjkdbg
