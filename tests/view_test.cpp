// The window in-process, without a display: keys and clicks through ImGui's own input, the step seen to change, pictures not blank.
#include <gtest/gtest.h>

#include <set>

#include "debugger/render/image_file.h"
#include "debugger/view/explain.h"
#include "debugger/view/hosts.h"

namespace gjkdbg {
namespace {

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

TEST_F(Window, ShowsSomething) {
  EXPECT_TRUE(app.message.empty()) << app.message;
  EXPECT_GT(colours(), 200);
}

TEST_F(Window, StepsByKeys) {
  EXPECT_EQ(session.step(), 0u);
  host.press(Key::right);
  host.press(Key::period);
  EXPECT_EQ(session.step(), 2u);
  host.press(Key::left);
  EXPECT_EQ(session.step(), 1u);
  host.press(Key::comma);
  host.press(Key::comma);
  EXPECT_EQ(session.step(), 0u);
  host.press(Key::end);
  EXPECT_EQ(session.step(), session.count() - 1);
  host.press(Key::right);
  EXPECT_EQ(session.step(), session.count() - 1);
  host.press(Key::home);
  EXPECT_EQ(session.step(), 0u);
  host.press(Key::right, true);
  EXPECT_GT(session.step(), 1u);  // an iteration
  host.press(Key::home);
  host.press(Key::right, false, true);
  EXPECT_EQ(phase_of(session.recording().events[session.step()]), 1);  // EPA
}

TEST_F(Window, StepsByMouse) {
  // The scrubber lies below the transport; a click in its middle seeks to the middle.
  host.click(620, 612);
  EXPECT_GT(session.step(), session.count() / 4);
  EXPECT_LT(session.step(), session.count() * 3 / 4 + 1);
  const std::size_t before = session.step();
  host.drag(620, 612, 900, 612);
  EXPECT_GT(session.step(), before);
}

TEST_F(Window, EveryStepChangesThePicture) {
  std::vector<std::uint8_t> last;
  for (std::size_t i = 0; i < session.count(); ++i) {
    session.go_to(i);
    host.frame();
    const Image image = host.image();
    EXPECT_NE(image.rgb, last) << i;
    last = image.rgb;
  }
}

TEST_F(Window, PlaysAndStopsAtABreakpoint) {
  session.go_to(4);
  host.press(Key::b);
  host.press(Key::home);
  session.speed = 8;
  host.press(Key::space);
  for (int i = 0; i < 200 && session.playing; ++i) host.frame();
  EXPECT_FALSE(session.playing);
  EXPECT_EQ(session.step(), 4u);
}

TEST_F(Window, OrbitsPansAndZooms) {
  const Camera before = app.difference_camera;
  host.drag(760, 200, 820, 240);
  EXPECT_NE(app.difference_camera.yaw, before.yaw);
  host.wheel(760, 200, 2);
  host.frame();
  EXPECT_LT(app.difference_camera.radius, before.radius);
  host.press(Key::f);
  EXPECT_NEAR(app.difference_camera.radius, before.radius, 1e-12);
}

TEST_F(Window, DraggingABodySolvesAgainAndIsUndoneAsOne) {
  const ViewRectangle view{282, 54 + 48 * 0.6, 325, 474 - 48 * 0.6};
  const Projected at = Projection(app.world_camera, view)(to_view(session.scene().scene.bodies[1].pose.position));
  const AnyVector before = session.scene().scene.bodies[1].pose.position;
  const double depth = *session.recording().result.signed_distance;
  host.drag(static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.x) + 70, static_cast<float>(at.y) - 30);
  EXPECT_NE(session.scene().scene.bodies[1].pose.position, before);
  EXPECT_NE(*session.recording().result.signed_distance, depth);
  host.press(Key::z, false, true);
  EXPECT_EQ(session.scene().scene.bodies[1].pose.position, before);
  EXPECT_FALSE(session.can_undo());
  host.press(Key::y, false, true);
  EXPECT_NE(session.scene().scene.bodies[1].pose.position, before);
}

TEST_F(Window, RefusesABadEditAndKeepsTheScene) {
  SceneFile next = session.scene();
  next.scene.bodies[0].shape.geometry = Sphere{-1};
  EXPECT_FALSE(session.edit(next).empty());
  EXPECT_FALSE(session.can_undo());
  app.open("/nonexistent.scene.json");
  EXPECT_NE(app.message.find("/nonexistent.scene.json"), std::string::npos);
  EXPECT_EQ(session.title(), "box-box-deep");
}

TEST_F(Window, ShowsEverySceneOfTheGallery) {
  for (const Lesson& lesson : app.gallery().lessons)
    for (const std::string& name : lesson.scenes) {
      app.open_gallery(name);
      EXPECT_TRUE(app.message.empty()) << app.message;
      for (const std::size_t step : {std::size_t{0}, session.count() / 2, session.count() - 1}) {
        session.go_to(step);
        host.frame();
        EXPECT_FALSE(explain(session.recording(), session.frame()).text.empty());
        EXPECT_GE(pseudo_code(session.recording(), step).current, std::holds_alternative<recorded::Warning>(session.recording().events[step]) ? -1 : 0);
      }
      EXPECT_GT(colours(), 100) << name;
    }
}

TEST_F(Window, ThemesLayoutsAndKeySheet) {
  for (const Key key : {Key::t, Key::v, Key::v, Key::v, Key::g, Key::slash, Key::escape, Key::pad_1, Key::pad_2, Key::pad_3, Key::m, Key::digit_1, Key::left_bracket, Key::right_bracket}) {
    host.press(key);
    EXPECT_GT(colours(), 100);
  }
}

TEST(Pictures, PngAndGifStartAsTheyMust) {
  const std::vector<std::uint8_t> grey(64 * 48 * 3, 128);
  EXPECT_EQ(png_bytes(64, 48, grey).substr(1, 3), "PNG");
  const std::string gif = gif_bytes(64, 48, {grey, grey}, 10);
  EXPECT_EQ(gif.substr(0, 6), "GIF89a");
  EXPECT_EQ(gif.back(), ';');
}

}  // namespace
}  // namespace gjkdbg
