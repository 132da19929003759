// What people do with the window: drop files on it, take bodies away, type numbers and click elsewhere, undo, make it very small.
#include <imgui_internal.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <string_view>

#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

class Hands : public Window {
 protected:
  Hands() : folder(std::filesystem::temp_directory_path() / ("gjkdbg-hands-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder);
  }
  ~Hands() override { std::filesystem::remove_all(folder); }
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  void drop(const std::vector<std::filesystem::path>& files) {
    app.drop(files);
    host.frame(), host.frame(), host.frame();
  }
  static bool dialog_is_open() { return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel); }
  std::filesystem::path gallery(const char* name) const { return app.gallery().file(name); }

  std::filesystem::path folder;
};

TEST_F(Hands, ADroppedFileIsOpenedOrSaysWhatIsWrongWithIt) {
  for (const auto& [name, text, told] : {std::tuple("broken.json", "{ \"format\": ", "is no JSON"), {"empty.json", "", "there is nothing in it"}, {"blank.json", " \n", "there is nothing in it"},
                                         {"later.json", R"({"format": "gjk-scene", "version": 99, "dimension": 2, "bodies": []})", "must be 1"}, {"list.json", "[]", "must be an object"}, {"noise.png", "\x89PNG", "is no JSON"}}) {
    drop({file(name, text)});
    EXPECT_NE(app.message.find(told), std::string::npos) << name << ": " << app.message;
    EXPECT_NE(app.message.find(name), std::string::npos) << app.message;
    EXPECT_EQ(session.title(), "box-box-deep") << "what was open stays";
  }
  drop({folder});
  EXPECT_NE(app.message.find("is a directory"), std::string::npos) << app.message;
  drop({folder / "gone.json"});
  EXPECT_NE(app.message.find("cannot be read"), std::string::npos) << app.message;
  drop({gallery("2d-deep")});
  EXPECT_EQ(session.title(), "2d-deep");
  EXPECT_EQ(app.message, "");
  drop({gallery("two-unit-cubes"), gallery("2d-deep")});
  EXPECT_EQ(session.title(), "two-unit-cubes");
  EXPECT_NE(app.notice.find("of 2 files the first"), std::string::npos) << app.notice;
}

TEST_F(Hands, AFileDroppedOnADialogIsWhatItAsksFor) {
  host.press(Key::o, false, true);
  host.frame();
  ASSERT_TRUE(dialog_is_open());
  drop({file("broken.json", "{")});
  EXPECT_TRUE(dialog_is_open()) << "which says what is wrong";
  EXPECT_EQ(app.message, "");
  drop({gallery("2d-deep")});
  EXPECT_FALSE(dialog_is_open());
  EXPECT_EQ(session.title(), "2d-deep");
  app.ask(App::Asking::compare);
  host.frame(), host.frame();
  ASSERT_TRUE(dialog_is_open());
  drop({gallery("2d-circle-box")});
  EXPECT_FALSE(dialog_is_open());
  EXPECT_EQ(session.title(), "2d-deep");
  EXPECT_TRUE(session.comparing());
  for (const App::Asking other : {App::Asking::save, App::Asking::go_to}) {
    app.ask(other);
    host.frame(), host.frame();
    ASSERT_TRUE(dialog_is_open());
    drop({gallery(other == App::Asking::save ? "two-unit-cubes" : "box-box-deep")});
    EXPECT_FALSE(dialog_is_open());
    EXPECT_EQ(session.title(), other == App::Asking::save ? "two-unit-cubes" : "box-box-deep");
  }
}

/// Far out or very large the bodies are fitted into the views; so they are when that is taken back.
TEST_F(Hands, UndoBringsTheViewsBackToo) {
  const double radius = app.world_camera.radius;
  SceneFile far = session.scene();
  far.scene.bodies[1].pose.position[0] = 1e4;
  far.expect.reset();
  app.edit(far);
  app.fit_what_has_left();
  EXPECT_GT(app.world_camera.radius, 1e3);
  host.press(Key::z, false, true);
  host.frame();
  EXPECT_NEAR(app.world_camera.radius, radius, 0.01 * radius);
  host.press(Key::y, false, true);
  host.frame();
  EXPECT_GT(app.world_camera.radius, 1e3);
}

/// With a moving scene's bodies stands a cross each, for as long as others are left.
TEST_F(Hands, BodiesCanBeTakenAway) {
  app.open_gallery("cast-many-bodies");
  host.frame(), host.frame();
  ASSERT_EQ(session.scene().scene.bodies.size(), 5u);
  const std::string second = session.scene().scene.bodies[1].name;
  host.click(240, 178);
  host.frame();
  ASSERT_EQ(session.scene().scene.bodies.size(), 4u);
  EXPECT_EQ(session.scene().scene.bodies[0].name, second) << "the first has gone";
  EXPECT_EQ(app.message, "");
  host.press(Key::z, false, true);
  EXPECT_EQ(session.scene().scene.bodies.size(), 5u);
  for (int i = 0; i < 5; ++i) host.click(240, 178), host.frame(), host.frame();
  EXPECT_EQ(session.scene().scene.bodies.size(), 2u) << "a cast is of two bodies";
}

/// As in every other field; only Escape leaves what was.
TEST_F(Hands, ATypedToleranceCountsWhereSomethingElseIsClicked) {
  const auto type_into = [&](float y, const char* text) {
    host.click(180, y);
    host.frame();
    host.type(text);
    host.frame();
  };
  const float tolerance = 710, limit = 739;
  type_into(tolerance, "1e-3");
  EXPECT_EQ(session.recording().settings.tolerance, 1e-12) << "half of a number is none";
  host.click(450, 65);
  host.frame();
  EXPECT_EQ(session.recording().settings.tolerance, 1e-3);
  type_into(tolerance, "1e-5");
  host.press(Key::enter);
  host.frame();
  EXPECT_EQ(session.recording().settings.tolerance, 1e-5);
  type_into(tolerance, "1e-2");
  host.press(Key::escape);
  host.frame(), host.frame();
  EXPECT_EQ(session.recording().settings.tolerance, 1e-5);
  type_into(limit, "7");
  host.click(450, 65);
  host.frame();
  EXPECT_EQ(session.recording().settings.max_iterations, 7);
  type_into(tolerance, "5");
  host.click(450, 65);
  host.frame();
  EXPECT_NE(app.message.find("tolerance must be"), std::string::npos) << app.message;
  EXPECT_EQ(session.recording().settings.tolerance, 1e-5);
}

/// A number with more digits than its field shows is not rounded by clicking into the field and out again.
TEST_F(Hands, LookingAtANumberDoesNotChangeIt) {
  SceneFile next = session.scene();
  next.method.tolerance = 1.23456e-7;
  app.edit(next);
  host.frame();
  host.click(180, 710);
  host.frame();
  host.click(450, 65);
  host.frame();
  EXPECT_EQ(session.recording().settings.tolerance, 1.23456e-7);
}

/// The scene is not seen then; what only makes sense with it leads back to it.
TEST_F(Hands, KeysBesideTheChartsChangeNothingOfTheScene) {
  session.go_to(3);
  session.playing = true;
  host.press(Key::x);
  ASSERT_TRUE(app.show_lab);
  EXPECT_FALSE(session.playing) << "it would play on unseen";
  SceneFile next = session.scene();
  next.method.max_iterations = 40;
  app.edit(next);
  const std::size_t step = session.step();
  for (const Key key : {Key::right, Key::left, Key::home, Key::end, Key::space, Key::b, Key::m, Key::left_bracket, Key::page_down, Key::v, Key::digit_1}) host.press(key);
  host.press(Key::z, false, true);
  EXPECT_TRUE(app.show_lab);
  EXPECT_EQ(session.step(), step);
  EXPECT_FALSE(session.playing || session.loop);
  EXPECT_TRUE(session.breakpoints.empty() && session.bookmarks.empty());
  EXPECT_EQ(session.recording().settings.max_iterations, 40);
  const bool dark = app.preferences.dark;
  host.press(Key::t);
  EXPECT_NE(app.preferences.dark, dark);
  host.press(Key::f, false, true);
  EXPECT_TRUE(app.finding() && !app.show_lab);
  host.press(Key::escape);
  host.frame();
  EXPECT_FALSE(app.finding());
  host.press(Key::x), host.press(Key::e);
  EXPECT_TRUE(app.lecture && !app.show_lab);
  host.press(Key::x), host.press(Key::escape);
  EXPECT_TRUE(!app.show_lab);
}

/// What a field offers to be edited is the number, but for half a hundredth: where that has no room beside others the numbers stand in rows.
TEST_F(Hands, FindTheirNumbersInTheFields) {
  const std::vector<double> place{12345.678, 1.5, 1.9e20};
  SceneFile next = session.scene();
  for (int i = 0; i < 3; ++i) next.scene.bodies[0].pose.position[i] = place[static_cast<std::size_t>(i)];
  next.scene.bodies[1].pose.position = next.scene.bodies[0].pose.position;
  ASSERT_EQ(session.edit(next), "");
  host.frame(), host.frame();
  std::set<std::string> offered;
  const ImGuiInputTextState& field = ImGui::GetCurrentContext()->InputTextState;
  for (float y = 170; y < 420; y += 9) {
    host.click(150, y);
    host.frame();
    if (!ImGui::GetIO().WantTextInput) continue;
    std::string text;
    for (int i = 0; i < field.CurLenW; ++i) text += static_cast<char>(field.TextW[i]);
    offered.insert(text);
    host.press(Key::escape);
    host.frame();
  }
  for (const char* text : {"12345.7", "1.5", "1.9e+20"}) EXPECT_TRUE(offered.contains(text)) << text;
  EXPECT_EQ(session.scene().scene.bodies[0].pose.position, next.scene.bodies[0].pose.position) << "a look changes nothing";
}

/// Up, Down and Return, as in any list.
TEST_F(Hands, ChooseFromAListByKeys) {
  const auto down = [&] {
#if IMGUI_VERSION_NUM < 18700
    bool& key = ImGui::GetIO().KeysDown[ImGui::GetIO().KeyMap[ImGuiKey_DownArrow]];
    key = true, host.frame(), key = false, host.frame();
#else
    ImGui::GetIO().AddKeyEvent(ImGuiKey_DownArrow, true), host.frame();
    ImGui::GetIO().AddKeyEvent(ImGuiKey_DownArrow, false), host.frame();
#endif
  };
  const auto open_list = [&] {
    host.click(180, 181);  // what body A is
    host.frame(), host.frame();
    return list_is_open();
  };
  session.go_to(3);
  const std::string before = type_name(session.scene().scene.bodies[0].shape, 3);
  ASSERT_TRUE(open_list());
  down();
  host.press(Key::escape);
  host.frame();
  EXPECT_FALSE(list_is_open());
  EXPECT_EQ(type_name(session.scene().scene.bodies[0].shape, 3), before);
  ASSERT_TRUE(open_list());
  down();
  host.press(Key::enter);
  host.frame();
  EXPECT_FALSE(list_is_open());
  EXPECT_EQ(type_name(session.scene().scene.bodies[0].shape, 3), "sphere") << "the one below";
  EXPECT_EQ(ImGui::GetIO().ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard, 0) << "the arrows are the steps' again";
}

/// A body that is dragged out of what is seen, or that drags the difference out of it; but not the view of whoever looks at a part.
TEST_F(Hands, LetGoOfABodyWithinTheView) {
  const ViewRectangle view{282, 54 + 48 * 0.6, 325, 474 - 48 * 0.6};
  const auto drag = [&](float dx, float dy) {
    const Projected at = Projection(app.world_camera, view)(to_view(session.scene().scene.bodies[1].pose.position));
    const auto x = static_cast<float>(at.x), y = static_cast<float>(at.y);
    host.drag(x, y, x + dx, y + dy);
    host.frame(), host.frame();
  };
  const auto whole = [&] {
    const Projection projection(app.world_camera, view);
    for (const DisplayMesh& mesh : session.meshes().bodies)
      for (const ViewPoint& p : mesh.points)
        if (const Projected at = projection(p); !view.contains(at.x, at.y)) return false;
    return true;
  };
  ASSERT_TRUE(whole());
  const double radius = app.world_camera.radius;
  drag(8, -4);
  EXPECT_EQ(app.world_camera.radius, radius) << "all of it is still seen";
  drag(76, -58);
  EXPECT_TRUE(whole());
  EXPECT_NE(app.world_camera.radius, radius);
  app.world_camera.radius /= 3, app.difference_camera.radius /= 5;
  app.world_camera.target = to_view(session.scene().scene.bodies[1].pose.position);
  host.frame();
  ASSERT_FALSE(whole());
  const double near = app.world_camera.radius;
  drag(20, -10);
  EXPECT_EQ(app.world_camera.radius, near);
}

/// Of what people make of a window at the edge of their screen.
class VerySmall : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  VerySmall() : host(GetParam().first, GetParam().second, 1, read_gallery(GJKDBG_GALLERY)), app(host.app()) {}
  static const ImGuiWindow* shown(std::string_view name) {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (window->WasActive && std::string_view(window->Name).find("/" + std::string(name) + "_") != std::string_view::npos) return window;
    return nullptr;
  }
  /// Whether a panel is within the window, and all that stands in it within the panel.
  void expect_whole(const char* name) const {
    const ImGuiWindow* window = shown(name);
    ASSERT_TRUE(window) << name;
    EXPECT_LE(window->ContentSize.x, window->ContentRegionRect.GetWidth() + app.theme.px(8)) << name;
    EXPECT_LE(window->Pos.x + window->Size.x, static_cast<float>(GetParam().first)) << name;
    EXPECT_LE(window->Pos.y + window->Size.y, static_cast<float>(GetParam().second)) << name;
  }

  Headless host;
  App& app;
};

TEST_P(VerySmall, NothingIsCutOffAtTheRight) {
  for (const char* name : {"box-box-deep", "cast-bullet-thin-wall", "sat-box-box"}) {
    app.open_gallery(name);
    SCOPED_TRACE(name);
    app.session.go_to(app.session.count() / 2);
    host.frame(), host.frame(), host.frame();
    for (const char* panel : {"top", "timeline", "step", "world"}) expect_whole(panel);
    EXPECT_GT(shown("step")->Size.x, app.theme.px(180)) << "words have room";
    EXPECT_GT(shown("world")->Size.y, app.theme.px(30));
  }
}

TEST_P(VerySmall, TheWayBackFromTheChartsIsInSight) {
  app.open_gallery("box-box-deep");
  app.show_lab = true;
  host.frame(), host.frame(), host.frame();
  const ImGuiWindow* lab = shown("lab");
  ASSERT_TRUE(lab);
  EXPECT_LE(lab->ContentSize.x, lab->ContentRegionRect.GetWidth() + app.theme.px(8));
}

INSTANTIATE_TEST_SUITE_P(Sizes, VerySmall, testing::Values(std::pair(320, 240), std::pair(400, 300), std::pair(500, 400), std::pair(480, 800), std::pair(599, 400), std::pair(640, 400)));

}  // namespace
}  // namespace gjkdbg
