#include <epoxy/gl.h>
#include <epoxy/egl.h>

#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include "debugger/view/hosts.h"
#include "shapes/error.h"

namespace gjkdbg {

/// EGL without a surface, a framebuffer of our own, an ImGui context.
struct Headless::Context {
  int width, height;
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext egl = EGL_NO_CONTEXT;
  GLuint framebuffer = 0, colour = 0;
  ImGuiContext* imgui = nullptr;

  Context(int w, int h) : width(w), height(h) {
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
      display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display == EGL_NO_DISPLAY) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) fail("EGL is not available");
    eglBindAPI(EGL_OPENGL_API);
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    egl = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (egl == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl)) fail("OpenGL 3.3 is not available");
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glGenRenderbuffers(1, &colour);
    glBindRenderbuffer(GL_RENDERBUFFER, colour);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
    imgui = ImGui::CreateContext();
    ImGui::SetCurrentContext(imgui);
    ImGui_ImplOpenGL3_Init("#version 330 core");
  }

  [[noreturn]] static void fail(const char* what) { throw Error("no-graphics", what); }

  ~Context() {
    ImGui::SetCurrentContext(imgui);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(imgui);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &colour);
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, egl);
  }
};

Headless::Headless(int width, int height, float scale, Gallery gallery) : context_(std::make_unique<Context>(width, height)) {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.MousePos = {-1, -1};
  map_keys();
  app_ = std::make_unique<App>(std::move(gallery), scale);
}

Headless::~Headless() = default;

void Headless::frame(bool picture_only) {
  ImGuiIO& io = ImGui::GetIO();
  io.DeltaTime = 1.0f / 60;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  picture_only ? app_->picture_frame() : app_->frame();
  ImGui::Render();
  glBindFramebuffer(GL_FRAMEBUFFER, context_->framebuffer);
  glViewport(0, 0, context_->width, context_->height);
  const ImVec4 background = vec(app_->theme.palette.background);
  glClearColor(background.x, background.y, background.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

Image Headless::image() const {
  Image image{context_->width, context_->height, {}};
  const auto row = static_cast<std::size_t>(image.width) * 3;
  std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(image.height));
  glBindFramebuffer(GL_FRAMEBUFFER, context_->framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
  image.rgb.reserve(upside_down.size());
  for (int y = image.height - 1; y >= 0; --y) {
    const auto begin = upside_down.begin() + static_cast<std::ptrdiff_t>(row) * y;
    image.rgb.insert(image.rgb.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
  }
  return image;
}

void Headless::press(Key key, bool shift, bool control) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyShift = shift, io.KeyCtrl = control;
  feed_key(key, true);
  frame();
  feed_key(key, false);
  io.KeyShift = io.KeyCtrl = false;
  frame();
}

void Headless::move(float x, float y) {
  ImGui::GetIO().MousePos = {x, y};
  frame();
}

void Headless::click(float x, float y) {
  move(x, y);
  ImGui::GetIO().MouseDown[0] = true;
  frame();
  ImGui::GetIO().MouseDown[0] = false;
  frame();
  frame();
}

void Headless::drag(float x0, float y0, float x1, float y1) {
  move(x0, y0);
  ImGui::GetIO().MouseDown[0] = true;
  frame();
  for (int i = 1; i <= 8; ++i) move(x0 + (x1 - x0) * static_cast<float>(i) / 8, y0 + (y1 - y0) * static_cast<float>(i) / 8);
  ImGui::GetIO().MouseDown[0] = false;
  frame();
}

void Headless::type(const std::string& text) {
  for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
  frame();
  frame();
}

void Headless::wheel(float x, float y, float steps) {
  move(x, y);
  ImGui::GetIO().MouseWheel = steps;
  frame();
}

}  // namespace gjkdbg
