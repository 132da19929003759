// Whether what belongs together stands together and nothing covers anything else, in small windows, too.
#include <imgui_internal.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

#include "debugger/view/explain.h"
#include "debugger/view/plot.h"
#include "debugger/view/wrong_step.h"
#include "recordings/scene_file.h"
#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

class SmallWindow : public testing::Test {
 protected:
  explicit SmallWindow(int width = 800, int height = 520) : host(width, height, 1, read_gallery(GJKDBG_GALLERY)), app(host.app()), session(app.session) {
    app.open_gallery("box-box-deep");
    host.frame(), host.frame();
  }
  /// The one in use whose name begins so, or has it within.
  const ImGuiWindow* shown(std::string_view name) const {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (window->WasActive && (window->Name == name || std::string_view(window->Name).find("/" + std::string(name) + "_") != std::string_view::npos)) return window;
    return nullptr;
  }

  Headless host;
  App& app;
  Session& session;
};

TEST_F(SmallWindow, TheFindBarLeavesTheStepInSight) {
  app.open_find_bar();
  host.frame(), host.frame(), host.frame();
  const ImGuiWindow *bar = shown("find"), *step = shown("step");
  ASSERT_TRUE(bar && step);
  EXPECT_LE(bar->Pos.x + bar->Size.x, step->Pos.x);
  app.lecture = true;
  host.frame(), host.frame(), host.frame();
  EXPECT_GT(bar->Size.x, 600) << "across the views, which have the whole width now";
}

TEST_F(SmallWindow, TheFindBarTellsOnlyOfTheStepThatIsShown) {
  app.open_find_bar();
  host.frame(), host.frame();
  host.type("grow");
  host.frame(), host.frame();
  const ImGuiWindow* bar = shown("find");
  ASSERT_TRUE(bar);
  const float told = bar->Size.y;
  const std::size_t found = session.step();
  ASSERT_TRUE(std::holds_alternative<recorded::PolytopeGrown>(session.recording().events[found]));
  session.step_by(1);
  host.frame(), host.frame();
  EXPECT_LT(bar->Size.y, told);
  session.step_by(-1);
  host.frame(), host.frame();
  EXPECT_EQ(bar->Size.y, told);
  app.open_gallery("2d-deep");  // which has that step, too
  session.go_to(std::min(found, session.count() - 1));
  host.frame(), host.frame();
  EXPECT_LT(bar->Size.y, told) << "it was found in another scene";
}

TEST_F(SmallWindow, TheSheetOfKeysFits) {
  app.show_keys = true;
  host.frame(), host.frame(), host.frame();
  const ImGuiWindow* sheet = shown("Keys and mouse");
  ASSERT_TRUE(sheet);
  EXPECT_EQ(sheet->ScrollMax.y, 0);
  EXPECT_GE(sheet->Pos.y, 0);
  EXPECT_LE(sheet->Pos.y + sheet->Size.y, 520);
}

TEST_F(SmallWindow, WhatIsToBeMeasuredIsExplainedWithoutScrolling) {
  app.show_lab = true;
  for (const App::LabTab tab : {App::LabTab::chart, App::LabTab::atlas}) {
    app.lab_tab = tab;
    host.frame(), host.frame(), host.frame();
    const ImGuiWindow* lab = shown("lab");
    ASSERT_TRUE(lab);
    EXPECT_EQ(lab->ScrollMax.y, 0);
    EXPECT_GT(lab->ContentSize.y, 300) << "and not left blank";
  }
}

/// What the rail has opened is gone with the rail.
TEST_F(SmallWindow, EscapeAfterTheRailHasGone) {
  for (const Key hides : {Key::e, Key::x}) {
    host.press(Key::g);
    host.frame(), host.frame();
    host.press(hides);
    host.press(Key::escape);
    host.frame();
    EXPECT_FALSE(app.lecture || app.show_lab);
  }
}

/// Numbers of far-out places are too wide for the panel: they go on in the next line.
TEST_F(SmallWindow, NoNumberIsCutOffInTheStepsPanel) {
  for (const Lesson& lesson : app.gallery().lessons)
    for (const std::string& name : lesson.scenes) {
      if (name.starts_with("sim-")) continue;  // which take long, and have rows like the others'
      app.open_gallery(name);
      session.go_to(session.count() - 1);
      host.frame(), host.frame(), host.frame();  // its bar to scroll it may come or go
      const ImGuiWindow* step = shown("step");
      ASSERT_TRUE(step);
      EXPECT_LE(step->ContentSize.x, step->ContentRegionRect.GetWidth() + 1) << name;
    }
}

struct TinyWindow : SmallWindow {
  TinyWindow() : SmallWindow(340, 240) {}
  std::vector<std::uint8_t> top() const {
    const Image image = host.image();
    return {image.rgb.begin(), image.rgb.begin() + 3 * image.width * 44};
  }
};

TEST_F(TinyWindow, TheResultDoesNotCoverTheButtons) {
  const auto overlapping = top();
  app.open_gallery("box-box-apart");
  host.frame(), host.frame();
  EXPECT_EQ(overlapping, top());
}

using Lines = Window;

TEST_F(Lines, AFormulaIsNotBroken) {
  app.session.go_to(1);
  ImGui::NewFrame();
  const auto broken = [](const std::string& text, const char* room) { return broken_into_lines(text, ImGui::CalcTextSize(room).x + 1); };
  EXPECT_EQ(broken("It is w = a - b here", "It is w = a"), "It is\nw = a - b\nhere");
  EXPECT_EQ(broken("so that |v| = 1.5, and", "so that |v| ="), "so that\n|v| = 1.5,\nand");
  EXPECT_EQ(broken("the search goes on along -v.", "the search goes on along"), "the search goes on\nalong -v.");
  EXPECT_EQ(broken("of A \xE2\x88\x92 B alone", "of A \xE2\x88\x92 B"), "of A \xE2\x88\x92 B\nalone");
  EXPECT_EQ(broken("w = a - b = (1, 2, 3)", "w = a - b ="), "w = a - b =\n(1, 2, 3)") << "where it is too long for a line it is broken after a sign";
  ImGui::EndFrame();
}

/// Also where its pose's position is somewhere else: points that are far from it would swing out of the picture.
TEST_F(Lines, ABodyIsTurnedAboutItsMiddle) {
  const ViewRectangle view{282, 54 + 48 * 0.6, 325, 474 - 48 * 0.6};
  for (const char* name : {"2d-dyn4j", "hull-tetrahedra", "box-box-deep"}) {
    app.open_gallery(name);
    host.frame(), host.frame();
    const Pose before = session.scene().scene.bodies[0].pose;
    const auto middles = [&] { return std::vector<ViewPoint>{middle(session.meshes().bodies[0]), middle(session.meshes().bodies[1])}; };
    const auto centre = [&] {
      ViewPoint sum = ViewPoint::Zero();
      for (const ViewPoint& p : session.meshes().bodies[0].points) sum += p;
      return ViewPoint(sum / static_cast<double>(session.meshes().bodies[0].points.size()));
    };
    const ViewPoint pivot = middle(session.meshes().bodies[0]), from = centre();
    const Projection projection(app.world_camera, view);
    const Projected disc = projection(place_handles(middles(), projection, app.settings.scale)[0].disc);
    host.drag(static_cast<float>(disc.x), static_cast<float>(disc.y), static_cast<float>(disc.x) - 30, static_cast<float>(disc.y) - 20);
    ASSERT_TRUE(session.can_undo()) << name;
    EXPECT_GT((session.scene().scene.bodies[0].pose.matrix - before.matrix).norm(), 0.05) << name;
    EXPECT_NEAR((centre() - pivot).norm(), (from - pivot).norm(), 1e-9) << name << ": the middle it had stays";
    if (std::string(name) == "box-box-deep") {
      EXPECT_EQ(session.scene().scene.bodies[0].pose.position, before.position);
    }
  }
}

SceneFile mpr_scene(const char* other) {
  return scene_from_json(nlohmann::ordered_json::parse(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": "penetration", "method": {"name": "mpr"}, "bodies": [
      {"shape": {"type": "box", "half_extents": [1, 1, 1]}, "pose": {"position": [0, 0, 0]}}, )" + std::string(other) + "]}"), {});
}

/// No portal is needed there, and none is spoken of.
TEST_F(Lines, MprThatEndsAtAVertexOpensThere) {
  open_measured(app, mpr_scene(R"({"shape": {"type": "box", "half_extents": [1, 1, 1]}, "pose": {"position": [1.999, 1.999, 1.999]}})"), "K3, MPR");
  ASSERT_TRUE(app.message.empty()) << app.message;
  ASSERT_TRUE(std::holds_alternative<recorded::SupportQueried>(session.recording().events[session.step()]));
  EXPECT_EQ(session.step() + 2, session.count());
  EXPECT_NE(app.notice.find("this vertex lies on its ray"), std::string::npos) << app.notice;
  session.go_to(session.count() - 1);
  const Explanation e = explain(session.recording(), session.frame());
  EXPECT_EQ((e.title + e.text).find("The portal"), std::string::npos) << e.title << ": " << e.text;
  EXPECT_NE(e.text.find("a shorter way may exist"), std::string::npos) << e.text;
}

/// A mesh's next triangle is a run of its own, although MPR follows MPR.
TEST_F(Lines, ThePortalOfOneTriangleIsNotThatOfTheNext) {
  const char* floor = R"({"shape": {"type": "mesh", "points": [[-3, 0, -3], [3, 0, -3], [3, 0, 3], [-3, 0, 3]], "triangles": [[0, 1, 2], [0, 2, 3]]}, "pose": {"position": [0, -0.2, 0]}})";
  session.open(mpr_scene(floor), "mesh");
  int runs = 0;
  for (std::size_t i = 0; i < session.count(); ++i) {
    if (!std::holds_alternative<recorded::MprBegan>(session.recording().events[i])) continue;
    session.go_to(i);
    EXPECT_TRUE(session.frame().portal.empty() && session.frame().vertices.empty() && !session.frame().normal) << i;
    ++runs;
  }
  EXPECT_EQ(runs, 2);
}

/// The list gives way, not the heading that says what the dialog is for.
TEST(Dialog, FitsASmallWindow) {
  Headless host(320, 240, 1, read_gallery(GJKDBG_GALLERY));
  App& app = host.app();
  app.open_gallery("box-box-deep");
  host.frame();
  for (const App::Asking what : {App::Asking::open, App::Asking::compare, App::Asking::save, App::Asking::go_to}) {
    app.ask(what);
    host.frame(), host.frame(), host.frame();
    const ImGuiWindow* dialog = ImGui::FindWindowByName("ask");
    ASSERT_TRUE(dialog && dialog->WasActive);
    EXPECT_EQ(dialog->ScrollMax.y, 0) << static_cast<int>(what);
    EXPECT_LE(dialog->Pos.y + dialog->Size.y, 240) << static_cast<int>(what);
    host.press(Key::escape);
  }
}

}  // namespace
}  // namespace gjkdbg
