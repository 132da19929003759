// The window in-process, without a display: keys and clicks through ImGui's own input, the step seen to change, pictures not blank.
#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "debugger/render/image_file.h"
#include "debugger/view/explain.h"
#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

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

TEST_F(Window, TransportButtonsDoWhatTheirKeysDo) {
  const auto button = [&](int i) { host.click(296 + 18 + 41 * static_cast<float>(i), 561); };
  button(4);
  EXPECT_EQ(session.step(), 1u);
  button(5);
  EXPECT_EQ(iteration_of(session.recording().events[session.step()]), 1);
  button(6);
  EXPECT_EQ(session.step(), session.count() - 1);
  button(2);
  EXPECT_EQ(session.step(), session.count() - 2);
  button(1);
  EXPECT_LT(session.step(), session.count() - 2);
  button(0);
  EXPECT_EQ(session.step(), 0u);
  button(3);
  EXPECT_TRUE(session.playing);
  button(3);
  EXPECT_FALSE(session.playing);
}

TEST_F(Window, OpensAndSavesByName) {
  host.press(Key::s, false, true);
  host.frame();
  const bool dark = app.preferences.dark;
  feed_key(Key::enter, true);
  host.frame();
  EXPECT_EQ(std::exchange(app.save_requested, {}), "box-box-deep.scene.json");
  feed_key(Key::enter, false);
  host.press(Key::t);  // in the very next frame: a key again, no text
  EXPECT_NE(app.preferences.dark, dark);
  host.press(Key::o, false, true);
  host.frame();
  host.type(app.gallery().file("2d-deep").string());
  host.press(Key::enter);
  EXPECT_EQ(session.title(), "2d-deep");
}

TEST_F(Window, TopButtonsOpenWhatTheySay) {
  const Image plain = host.image();
  for (const float x : {110.f, 158.f, 205.f, 261.f, 327.f, 380.f, 427.f}) {
    host.click(x, 22);
    host.frame();
    EXPECT_NE(host.image().rgb, plain.rgb) << x;
    host.press(Key::escape);
    host.press(Key::escape);
    app.preferences.dark = true, app.show_keys = false, app.lecture = false;
    host.move(640, 700);
    host.frame(), host.frame();
  }
}

TEST_F(Window, ABookmarkAListRowAndANumberLeadToTheirSteps) {
  session.go_to(5);
  host.press(Key::m);
  host.press(Key::home);
  host.press(Key::digit_1);
  EXPECT_EQ(session.step(), 5u);
  host.click(420, 690);  // a row of the event list
  EXPECT_NE(session.step(), 5u);
  session.go_to(session.count() - 1);
  host.frame();
  // Every right-aligned number of the step panel: a click leads to an earlier step or stays.
  bool led = false;
  for (float y = 120; y < 780 && !led; y += 6) {
    host.click(1240, y);
    led = session.step() + 1 != session.count();
  }
  EXPECT_TRUE(led);
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

TEST_F(Window, ShowsAndEditsEverySceneOfTheGallery) {
  double worst = 0;  // not a test of speed, which machines differ in: prints what the slowest scene takes
  std::string slowest;
  int scenes = 0;
  for (const Lesson& lesson : app.gallery().lessons)
    for (const std::string& name : lesson.scenes) {
      if (scenes++ % 3 != 0 && std::getenv("GJKDBG_PAIRS")) continue;  // with sanitizers fewer of everything
      app.open_gallery(name);
      EXPECT_TRUE(app.message.empty()) << app.message;
      const auto begin = std::chrono::steady_clock::now();
      EXPECT_EQ(session.edit(SceneFile(session.scene())), "");
      session.frame();
      const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
      if (ms > worst) worst = ms, slowest = name;
      for (const std::size_t step : {std::size_t{0}, session.count() / 2, session.count() - 1}) {
        session.go_to(step);
        host.frame();
        EXPECT_FALSE(explain(session.recording(), session.frame()).text.empty());
        const PseudoCode code = pseudo_code(session.recording(), step);
        const bool no_line = std::holds_alternative<recorded::Warning>(session.recording().events[step]) || explain(session.recording(), session.frame()).title.ends_with("iteration limit");
        EXPECT_EQ(code.current == -1, no_line) << name << " " << step;
        EXPECT_LT(code.current, static_cast<int>(code.lines.size()));
      }
      EXPECT_GT(colours(), 100) << name;
    }
  std::printf("slowest edit: %s, %.1f ms\n", slowest.c_str(), worst);
}

TEST_F(Window, ThemesLayoutsAndKeySheet) {
  for (const Key key : {Key::t, Key::v, Key::v, Key::v, Key::g, Key::slash, Key::escape, Key::pad_1, Key::pad_2, Key::pad_3, Key::m, Key::digit_1, Key::left_bracket, Key::right_bracket, Key::e, Key::e, Key::l, Key::f1, Key::f1, Key::f}) {
    host.press(key);
    EXPECT_GT(colours(), 100);
  }
}

TEST_F(Window, FindsByTextAndByCondition) {
  host.press(Key::f, false, true);
  host.type("grow");
  host.press(Key::enter);
  ASSERT_TRUE(std::holds_alternative<recorded::PolytopeGrown>(session.recording().events[session.step()]));
  const std::size_t first = session.step();
  host.press(Key::escape);
  host.frame();
  host.press(Key::f3);
  EXPECT_GT(session.step(), first);
  host.press(Key::f3, true);
  EXPECT_EQ(session.step(), first);
  const auto seeded = find_text(session, "kind == polytope_seeded", 0, false);
  ASSERT_TRUE(seeded);
  EXPECT_EQ(kind_name(session.recording().events[*seeded]), "polytope_seeded");
  EXPECT_THROW(find_text(session, "nonsense < 3", 0, false), Error);
}

TEST_F(Window, GoesToAStepByNumber) {
  host.press(Key::g, false, true);
  host.frame();
  host.type("7");
  host.press(Key::enter);
  EXPECT_EQ(session.step(), 7u);
  host.press(Key::g, false, true);
  host.frame();
  host.press(Key::escape);
  host.frame();
  EXPECT_EQ(session.step(), 7u);
}

TEST_F(Window, StopsWhereAConditionHolds) {
  session.stop_when = Condition("region.size == 3");
  session.speed = 8;
  host.press(Key::space);
  for (int i = 0; i < 300 && session.playing; ++i) host.frame();
  const auto* e = std::get_if<recorded::SimplexReduced>(&session.recording().events[session.step()]);
  ASSERT_TRUE(e);
  EXPECT_EQ(e->region.size(), 3u);
}

TEST_F(Window, ARunBesideIsToldByWhatDiffers) {
  const std::string gallery = GJKDBG_GALLERY;
  app.compare_or_throw(gallery + "/box-box-apart.scene.json");
  EXPECT_EQ(session.other_title(), "box-box-apart");
  app.compare_or_throw(gallery + "/box-box-deep.scene.json");  // the scene that is open
  EXPECT_EQ(session.other_title(), "gjk · double");
  EXPECT_THROW(app.compare_or_throw(gallery + "/no-such.scene.json"), Error);
  EXPECT_EQ(session.other_title(), "gjk · double");
}

TEST_F(Window, ComparesTwoMethodsInStep) {
  Method single;
  single.scalar = Scalar::float_precision;
  EXPECT_EQ(session.compare_with(single, "single precision"), "");
  ASSERT_TRUE(session.comparing());
  EXPECT_FALSE(session.parting()) << "they round differently, and decide alike";
  Method steps;
  steps.max_iterations = 2;
  EXPECT_EQ(session.compare_with(steps, "two steps"), "");
  ASSERT_TRUE(session.parting());
  EXPECT_GT(session.parting()->event, 2u);
  EXPECT_EQ(session.compare_with(single, "single precision"), "");
  const Image alone = host.image();
  host.frame(), host.frame();
  EXPECT_NE(host.image().rgb, alone.rgb);
  session.go_to(session.count() - 1);
  host.frame();
  // An edit solves both again; a scene the other method does not take ends the comparison.
  SceneFile next = session.scene();
  next.scene.bodies[1].pose.position[0] += 0.01;
  EXPECT_EQ(session.edit(next), "");
  EXPECT_TRUE(session.comparing());
  Method sat;
  sat.name = MethodName::sat;
  EXPECT_EQ(session.compare_with(sat, "sat"), "");
  next.scene.bodies[0].shape = {Cylinder{0.5, 0.5, 1}, 0};
  EXPECT_EQ(session.edit(next), "");
  EXPECT_FALSE(session.comparing());
  EXPECT_NE(session.compare_with(sat, "sat"), "");
  host.frame();
}

TEST_F(Window, KeepsTheCorrespondingStepThroughAnEdit) {
  for (std::size_t i = 0; i < session.count(); ++i)
    if (std::holds_alternative<recorded::PolytopeSeeded>(session.recording().events[i])) session.go_to(i);
  SceneFile next = session.scene();
  next.scene.bodies[1].pose.position[0] += 0.2;
  ASSERT_EQ(session.edit(next), "");
  EXPECT_TRUE(std::holds_alternative<recorded::PolytopeSeeded>(session.recording().events[session.step()]));
}

TEST_F(Window, CopiesTheSceneAsJsonAndAsCpp) {
  host.press(Key::c, false, true);
  const std::string json = ImGui::GetClipboardText();
  EXPECT_EQ(parse_scene(json, {}).scene.bodies.size(), 2u);
  host.press(Key::c, true, true);
  EXPECT_NE(std::string(ImGui::GetClipboardText()).find("scene.bodies[1].shape = Shape{Box{AnyVector{{-0.55"), std::string::npos) << ImGui::GetClipboardText();
}

TEST_F(Window, SplittersMoveAndAreRemembered) {
  const float left = app.preferences.left, split = app.preferences.split, bottom = app.preferences.bottom;
  host.drag(279, 300, 329, 300);
  EXPECT_NEAR(app.preferences.left, left + 50, 1);
  host.frame();
  const float x = 282 + 50 + (1280 - 270 - 50 - 330 - 24 - 6) * split + 3;
  host.drag(x, 200, x + 60, 200);
  EXPECT_GT(app.preferences.split, split + 0.05f);
  host.drag(700, 531, 700, 491);
  EXPECT_NEAR(app.preferences.bottom, bottom + 40, 2);
  const Preferences read = preferences_from_text(preferences_to_text(app.preferences));
  EXPECT_EQ(read.left, app.preferences.left);
  EXPECT_EQ(read.split, app.preferences.split);
  EXPECT_EQ(preferences_from_text("not json").left, Preferences{}.left);
  EXPECT_LE(preferences_from_text(R"({"left": 1e9, "split": "x"})").left, 900);
}

TEST_F(Window, TurnsABodyByItsDisc) {
  const ViewRectangle view{282, 54 + 48 * 0.6, 325, 474 - 48 * 0.6};
  const Projected at = Projection(app.world_camera, view)(to_view(session.scene().scene.bodies[0].pose.position));
  const AnyMatrix before = session.scene().scene.bodies[0].pose.matrix;
  const AnyVector place = session.scene().scene.bodies[0].pose.position;
  const float x = static_cast<float>(at.x) + 17, y = static_cast<float>(at.y) - 13.5f;
  host.drag(x, y, x + 30, y + 60);
  EXPECT_NE(session.scene().scene.bodies[0].pose.matrix, before);
  EXPECT_EQ(session.scene().scene.bodies[0].pose.position, place);
  host.press(Key::z, false, true);
  EXPECT_EQ(session.scene().scene.bodies[0].pose.matrix, before);
}

TEST_F(Window, LinkedCamerasTurnTogether) {
  host.press(Key::l);
  host.drag(760, 200, 820, 240);
  EXPECT_EQ(app.world_camera.yaw, app.difference_camera.yaw);
  EXPECT_EQ(app.world_camera.pitch, app.difference_camera.pitch);
}

TEST_F(Window, ShowsABrokenFileInTheWindowAndKeepsTheLast) {
  const auto folder = std::filesystem::temp_directory_path() / ("gjkdbg-view-test-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto file = folder / "broken.scene.json";
  { std::ofstream(file) << "{\"format\": \"gjk-scene\", \"version\": 1, \"dimension\": 7}"; }
  const Image before = host.image();
  app.open(file);
  host.frame(), host.frame();
  EXPECT_NE(app.message.find("/dimension"), std::string::npos) << app.message;
  EXPECT_EQ(session.title(), "box-box-deep");
  EXPECT_NE(host.image().rgb, before.rgb);
  host.press(Key::escape);
  EXPECT_TRUE(app.message.empty());
  std::filesystem::remove_all(folder);
}

TEST_F(Window, EditingTypesChangesShapesOfEveryDimension) {
  for (const char* name : {"1d-overlap", "2d-deep", "box-box-deep"}) {
    app.open_gallery(name);
    app.left_tab = App::LeftTab::scene;
    host.frame();
    host.frame();
    EXPECT_TRUE(app.message.empty());
  }
}

TEST_F(Window, GalleryShowsThumbnailsInTime) {
  app.left_tab = App::LeftTab::gallery;
  host.frame();
  for (int i = 0; i < 40 && app.thumbnails().busy(); ++i) host.frame();
  EXPECT_FALSE(app.thumbnails().busy());
  EXPECT_GT(colours(), 200);
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
