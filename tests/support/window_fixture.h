// The window in-process, without a display, fed with ImGui's own input.
#pragma once

#include <gtest/gtest.h>

#include <set>

#include "debugger/view/hosts.h"

namespace gjkdbg {

class Window : public testing::Test {
 protected:
  Window() : host(1280, 800, 1, read_gallery(GJKDBG_GALLERY)), app(host.app()), session(app.session) {
    app.open_gallery("box-box-deep");
    app.left_tab = App::LeftTab::scene;
    host.frame(), host.frame();
  }
  int colours() {
    const Image image = host.image();
    std::set<int> seen;
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) seen.insert(image.rgb[i] << 16 | image.rgb[i + 1] << 8 | image.rgb[i + 2]);
    return static_cast<int>(seen.size());
  }

  Headless host;
  App& app;
  Session& session;
};

}  // namespace gjkdbg
