// What a student relies on: that the line of the algorithm is the one that runs, that names stand at their points, that small windows show something, that
// the list follows the step, that a plot shows what happens.
#include <imgui_internal.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "debugger/render/step_pictures.h"
#include "debugger/view/explain.h"
#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

class Student : public Window {
 protected:
  void go_to_the_end() { session.go_to(session.count() - 1), host.frame(); }
  std::string line() const {
    const PseudoCode code = pseudo_code(session.recording(), session.step());
    return code.current < 0 ? "" : code.lines[static_cast<std::size_t>(code.current)];
  }
};

/// The one in use whose name has this within.
const ImGuiWindow* window_in_use(std::string_view name) {
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (window->WasActive && std::string_view(window->Name).find("/" + std::string(name) + "_") != std::string_view::npos) return window;
  return nullptr;
}

TEST_F(Student, SeesTheLineThatEndsACast) {
  const auto at_the_end_of = [&](const char* name) {
    app.open_gallery(name);
    go_to_the_end();
    return line();
  };
  EXPECT_EQ(at_the_end_of("cast-bullet-thin-wall"), "  if d within tolerance: hit");
  EXPECT_EQ(at_the_end_of("cast-receding"), "  if bound <= 0: miss");
  EXPECT_EQ(at_the_end_of("cast-rod-miss"), "  if t past the end: miss") << "the rod still comes nearer when the time is over";
  EXPECT_EQ(at_the_end_of("cast-bounce"), "  if bound <= 0: miss") << "it moves away from the wall that it has hit last";
  EXPECT_EQ(at_the_end_of("cast-ray"), "hit at x");
  EXPECT_EQ(at_the_end_of("cast-at-rest"), "    if v.r >= 0: miss");
  app.open_gallery("cast-ray");
  SceneFile slow = session.scene();
  slow.expect.reset();
  slow.scene.bodies[0].motion->velocity *= 0.25;
  ASSERT_EQ(session.edit(slow), "");
  go_to_the_end();
  ASSERT_EQ(session.recording().result.status, "miss");
  EXPECT_EQ(line(), "    if x past the ray's end: miss");
}

/// In a small view the word has no room beside the point, and stood far off; the letter has, and pointing at it tells the rest.
TEST_F(Student, FindsTheWitnessesAtTheirPoints) {
  go_to_the_end();
  const auto names = [&](double width) {
    const Projection projection(app.world_camera, {0, 0, width, 200});
    std::set<std::string> found;
    for (const PictureLabel& label : world_picture(session.meshes(), session.recording(), session.frame(), app.settings, app.theme.palette, projection).labels) found.insert(label.text);
    return found;
  };
  EXPECT_TRUE(names(400).contains("witness a") && names(400).contains("witness b"));
  EXPECT_TRUE(names(200).contains("a") && names(200).contains("b") && !names(200).contains("witness a"));
  for (const char* name : {"a", "b"}) EXPECT_EQ(meaning_of(name, true, session.frame(), session.recording()), meaning_of("witness a", true, session.frame(), session.recording()));
  session.go_to(1);
  EXPECT_NE(meaning_of("a", true, session.frame(), session.recording()).find("farthest along d"), std::string::npos);
}

TEST_F(Student, ReadsNoNumberUnderAViewsTitle) {
  const Projection projection(Camera{}, {0, 0, 400, 300});
  Picture picture;
  const auto count = [&] { return flatten(picture, projection, 1).size(); };
  picture.scale_marks.push_back({projection.target() + projection.move(0, -130), "4", {}, 0, 0, true});
  EXPECT_EQ(count(), 1u);
  picture.covered = 40;
  EXPECT_EQ(count(), 0u);
}

/// A frame later was too late: while a replay plays, the list showed steps that were long over.
TEST_F(Student, FindsTheStepInTheListAtOnce) {
  app.open_gallery("sim-elastic-ball");
  ASSERT_GT(session.count(), 1000u);
  for (const std::size_t step : {std::size_t{900}, std::size_t{40}, std::size_t{500}}) {
    session.go_to(step);
    host.frame();
    const ImGuiWindow* list = window_in_use("events");
    ASSERT_TRUE(list);
    const float row = list->ContentSize.y / static_cast<float>(session.count()), top = static_cast<float>(step) * row;
    EXPECT_GE(top, list->Scroll.y) << step;
    EXPECT_LE(top + row, list->Scroll.y + list->Size.y + 1) << step;
  }
}

/// A hit at 0.03 left all of the way there in a thirtieth of the plot.
TEST_F(Student, SeesACastOverTheTimeThatItTakes) {
  app.open_gallery("cast-slow-approach");
  host.frame();
  host.click(830, 758);  // half-way across the plot
  EXPECT_LT(session.frame().time.value_or(1), 0.02) << session.step();
  EXPECT_GT(session.step(), 0u) << "nothing was clicked";
}

TEST_F(Student, ChoosesFromAllShapesAtOnce) {
  host.click(178, 178);
  host.frame();
  const ImGuiWindow* list = ImGui::FindWindowByName("##Combo_00");
  ASSERT_TRUE(list && list->WasActive);
  EXPECT_EQ(list->ScrollMax.y, 0);
}

/// The letter of the floor stood on a log that lay before it.
TEST_F(Student, TellsTheFloorFromWhatLiesOnIt) {
  app.open_gallery("sim-log-pile");
  session.go_to(1);
  const Projection projection(app.world_camera, {0, 0, 325, 440});
  const std::vector<ViewPoint> places = letter_places(session.meshes(), session.recording(), session.frame(), projection);
  ASSERT_EQ(places.size(), 4u);
  const ViewPoint middle = to_view(session.frame().places[0].position);
  EXPECT_GT((places[0] - middle).norm(), 0.5) << "the floor";
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(places[i], to_view(session.frame().places[i].position));
}

/// The picture has letters alone: what is called by a name has its letter beside it.
TEST_F(Student, FindsTheNamedBodiesInThePicture) {
  const auto told = [&](const char* name) {
    app.open_gallery(name);
    go_to_the_end();
    return explain(session.recording(), session.frame()).text;
  };
  EXPECT_NE(told("cast-bullet-thin-wall").find("bullet (A) and wall (B) are"), std::string::npos) << told("cast-bullet-thin-wall");
  EXPECT_NE(told("cast-ray").find(" A and B are"), std::string::npos) << "those are their names already";
  SceneFile unnamed = session.scene();
  for (Body& body : unnamed.scene.bodies) body.name.clear();
  ASSERT_EQ(session.edit(unnamed), "");
  go_to_the_end();
  EXPECT_NE(explain(session.recording(), session.frame()).text.find("body A and body B are"), std::string::npos);
}

/// Whatever heads a part of the step's panel, in every scene.
TEST_F(Student, IsToldWhatTheHeadingsMean) {
  for (const char* name : {"SIMPLEX, BARYCENTRIC WEIGHTS", "EVERY PART: |v|, OR A WEIGHT < 0", "SIGNED DISTANCE, BEFORE THIS STEP", "POLYTOPE", "RESULT: THE FIRST HIT", "VERTEX #3 (A), newest", "at most", "gap", "witness a"})
    EXPECT_FALSE(glossary(name).empty()) << name;
  for (const char* name : {"METHOD", "faces", "x"}) EXPECT_EQ(glossary(name), "") << name;
  for (const char* name : {"box-box-deep", "2d-deep", "boolean-hit-3d", "mpr-box-box", "sat-box-box", "sat-needles", "projections-ellipses", "closed-form-capsules", "cast-ray", "cast-rod-miss", "cast-rotating-rod-roots", "cast-bounce", "sim-elastic-ball"}) {
    app.open_gallery(name);
    for (std::size_t i = 0; i < std::min<std::size_t>(session.count(), 60); ++i) {
      const std::string title = pseudo_code(session.recording(), i).title;
      EXPECT_FALSE(glossary(title).empty()) << title;
    }
  }
  app.open_gallery("box-box-deep");
  session.go_to(4);
  host.frame(), host.frame();
  const auto tip = [&](float x, float y) {
    host.move(x, y);
    host.frame(), host.frame();
    return std::any_of(ImGui::GetCurrentContext()->Windows.begin(), ImGui::GetCurrentContext()->Windows.end(), [](const ImGuiWindow* w) { return w->WasActive && (w->Flags & ImGuiWindowFlags_Tooltip); });
  };
  const ImGuiWindow* step = window_in_use("step");
  ASSERT_TRUE(step);
  EXPECT_TRUE(tip(1040, 207)) << "SIMPLEX, BARYCENTRIC WEIGHTS";
  EXPECT_TRUE(tip(980, 380)) << "at most";
  EXPECT_TRUE(tip(1060, 510)) << "a line of the algorithm";
}

TEST(SmallestWindows, ShowTheirViews) {
  for (const auto& [width, height, least] : {std::tuple(320, 240, 70), {1000, 240, 100}, {640, 300, 150}, {480, 360, 150}}) {
    Headless host(width, height, 1, read_gallery(GJKDBG_GALLERY));
    host.app().open_gallery("box-box-deep");
    host.frame(), host.frame();
    for (const char* name : {"world", "difference"}) {
      const ImGuiWindow* view = window_in_use(name);
      ASSERT_TRUE(view);
      EXPECT_GE(view->Size.y, least) << width << " x " << height;
    }
    const ImGuiWindow* step = window_in_use("step");
    ASSERT_TRUE(step);
    EXPECT_GE(step->Size.y, 45) << "for the step's title";
    EXPECT_LE(step->Pos.y + step->Size.y, static_cast<float>(height));
    host.press(Key::e);  // in big letters: both are still seen, the sentence as a whole
    host.frame(), host.frame();
    const ImGuiWindow *lecture = window_in_use("lecture"), *world = window_in_use("world");
    ASSERT_TRUE(lecture && world);
    EXPECT_GE(world->Size.y, 70) << width << " x " << height;
    EXPECT_EQ(lecture->ScrollMax.y, 0) << width << " x " << height;
  }
}

}  // namespace
}  // namespace gjkdbg
