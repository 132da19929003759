// What is open and what becomes of it: another program's run, breakpoints, answers that are not proven, numbers in columns.
#include <imgui_internal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include "debugger/lab/atlas.h"
#include "debugger/view/explain.h"
#include "debugger/view/measurements.h"
#include "debugger/view/right_step.h"
#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

using OpenRun = Window;

/// As `run` leaves it.
Recording solvers_run() {
  Recording recording = record(read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep")));
  recording.generator = "a solver under gjkdbg";
  recording.result.signed_distance = -0.1;
  return recording;
}

TEST_F(OpenRun, OfAnotherProgramComesBackWithUndo) {
  session.open(solvers_run(), "theirs");
  ASSERT_FALSE(session.findings().empty());
  const std::string first = session.findings()[0].code;
  SceneFile next = session.scene();
  next.method.closest_point = ClosestPoint::johnson;
  app.edit(next);
  EXPECT_EQ(app.message, "");
  EXPECT_FALSE(foreign(session.recording()));
  EXPECT_NE(app.notice.find("Ctrl-Z brings your solver's run back"), std::string::npos);
  next.scene.bodies[1].pose.position[0] += 0.5;
  app.edit(next);
  session.undo(), session.undo();
  ASSERT_TRUE(foreign(session.recording()));
  EXPECT_EQ(*session.recording().result.signed_distance, -0.1);
  ASSERT_FALSE(session.findings().empty());
  EXPECT_EQ(session.findings()[0].code, first);
  session.redo(), session.redo();
  EXPECT_FALSE(foreign(session.recording()));
  EXPECT_EQ(session.scene().scene.bodies[1].pose.position[0], next.scene.bodies[1].pose.position[0]);
}

TEST_F(OpenRun, BeginsAtItsFirstFinding) {
  const auto file = std::filesystem::temp_directory_path() / ("finding-" + std::to_string(getpid()) + ".recording.json");
  Recording wrong = solvers_run();
  wrong.result.signed_distance = record(wrong.scene).result.signed_distance;
  std::get<recorded::SupportQueried>(wrong.events[5]).w[0] += 0.5;
  std::ofstream(file) << recording_to_text(wrong);
  app.open(file);
  std::filesystem::remove(file);
  EXPECT_EQ(app.message, "");
  EXPECT_EQ(session.step(), 5u);
  EXPECT_NE(app.notice.find("first finding"), std::string::npos);
  app.open_gallery("box-box-deep");
  EXPECT_EQ(session.step(), 0u);
}

/// With `view --exec`: the first run, and one after every time the program is saved.
TEST_F(OpenRun, OfASolverComesAtItsFirstFindingAndLeavesTheRestAsItWas) {
  const auto wrong_at = [](std::size_t step) {
    Recording run = solvers_run();
    run.result.signed_distance = record(run.scene).result.signed_distance;
    std::get<recorded::SupportQueried>(run.events[step]).w[0] += 0.5;
    return run;
  };
  app.compare_or_throw(app.gallery().file("two-unit-cubes"));
  app.show_run(wrong_at(5));
  EXPECT_EQ(session.step(), 5u);
  EXPECT_EQ(app.notice, "at the first finding; Home is the beginning");
  EXPECT_TRUE(session.comparing());
  host.frame();
  session.breakpoints = {3, 1000}, app.world_camera.radius *= 2;
  const double zoomed = app.world_camera.radius;
  app.show_run(wrong_at(7));
  host.frame();
  EXPECT_EQ(session.step(), 7u) << "whoever was at the first finding follows it";
  EXPECT_EQ(app.notice, "run again: at the first finding; Home is the beginning");
  EXPECT_EQ(session.breakpoints, std::set<std::size_t>{3});
  EXPECT_EQ(app.world_camera.radius, zoomed);
  session.go_to(2);
  app.show_run(wrong_at(5));
  EXPECT_EQ(session.step(), 2u);
  EXPECT_EQ(app.notice, "run again: the first finding is at step 5");
  Recording right = wrong_at(5);
  right.events = record(right.scene).events;
  app.show_run(right);
  EXPECT_TRUE(session.findings().empty());
  EXPECT_EQ(app.notice, "run again: no findings");
  EXPECT_TRUE(session.comparing());
  app.open_gallery("2d-deep");  // a look at another scene; the program is saved
  app.show_run(wrong_at(5));
  EXPECT_EQ(session.title(), "box-box-deep");
  EXPECT_EQ(session.step(), 5u);
}

/// A run that breaks off says nothing wrong, and has findings all the same: their colour, as of a wrong answer.
TEST_F(OpenRun, ThatBreaksOffIsNotGrey) {
  const auto redder = [&](Recording run) {
    app.show_run(std::move(run));
    app.drop_note();
    host.frame(), host.frame();
    const Image image = host.image();
    const std::size_t at = 3 * (21 * static_cast<std::size_t>(image.width) + 1258);  // in the chip, right of its text
    return image.rgb[at] - image.rgb[at + 2];
  };
  Recording run = solvers_run();
  run.result = {};
  run.events.resize(6);
  run.events.push_back(recorded::Warning{"support-limit", "More than 2 support queries."});
  EXPECT_GT(redder(run), 18);
  Recording right = record(run.scene);
  right.generator = run.generator;
  EXPECT_LT(redder(right), 12);
}

/// Not that |v| is 3e-16, along which to search on.
TEST_F(OpenRun, IsToldToKeepAllThatHoldsTheOrigin) {
  Recording run = solvers_run();
  const auto last = std::find_if(run.events.rbegin(), run.events.rend(), [](const Event& e) { return std::holds_alternative<recorded::SimplexReduced>(e); });
  ASSERT_NE(last, run.events.rend());
  auto& reduced = std::get<recorded::SimplexReduced>(*last);
  ASSERT_EQ(reduced.region.size(), 4u);
  reduced.region.pop_back();
  app.show_run(run);
  session.go_to(static_cast<std::size_t>(run.events.rend() - last) - 1);
  const std::string said = right_step(session.recording(), session.frame());
  EXPECT_TRUE(said.starts_with("Keep all of #")) << said;
  EXPECT_NE(said.find("the origin lies in it, so the bodies overlap. The search is over."), std::string::npos) << said;
}

TEST_F(OpenRun, SaysWhyPlayingStoppedAndThatBookmarksAreTaken) {
  app.stop_when_text = "kind == polytope_seeded";
  session.stop_when = Condition(app.stop_when_text);
  session.speed = 8, session.toggle_play();
  for (int i = 0; i < 200 && session.playing; ++i) host.frame();
  EXPECT_TRUE(std::holds_alternative<recorded::PolytopeSeeded>(session.recording().events[session.step()]));
  EXPECT_EQ(app.notice, "stopped: kind == polytope_seeded");
  for (int i = 0; i < 9; ++i) EXPECT_TRUE(session.add_bookmark());
  host.press(Key::m);
  EXPECT_EQ(app.notice, "all nine bookmarks are taken");
}

TEST_F(OpenRun, IsAtTheStepItWasAtAfterUndo) {
  session.go_to(15);
  SceneFile next = session.scene();
  next.scene.bodies[1].pose.position[0] += 9;  // apart: a short run
  app.edit(next);
  EXPECT_LT(session.count(), 15u);
  session.undo();
  EXPECT_EQ(session.step(), 15u);
}

/// Through all lessons, and the list goes along.
TEST_F(OpenRun, LeafsThroughTheGallery) {
  const auto& lessons = app.gallery().lessons;
  app.open_gallery(lessons[0].scenes.back());
  host.press(Key::page_down);
  EXPECT_EQ(session.title(), lessons[1].scenes.front());
  host.press(Key::page_up);
  EXPECT_EQ(session.title(), lessons[0].scenes.back());
  app.open_gallery(lessons[0].scenes.front());
  host.press(Key::page_up);
  EXPECT_EQ(session.title(), lessons[0].scenes.front());
  EXPECT_EQ(app.notice, "the gallery begins here");
  const auto scrolled = [] {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (std::string_view(window->Name).find("/scenes_") != std::string_view::npos) return window->Scroll.y;
    return -1.f;
  };
  app.left_tab = App::LeftTab::gallery;
  host.frame(), host.frame(), host.frame();
  EXPECT_EQ(scrolled(), 0);
  app.open_gallery(lessons.back().scenes.back());
  host.frame(), host.frame(), host.frame();
  EXPECT_GT(scrolled(), 500);
  host.press(Key::page_down);
  EXPECT_EQ(app.notice, "the gallery ends here");
}

TEST_F(OpenRun, StandsStillBehindAnOpenList) {
  session.go_to(3);
  host.click(178, 516);  // the query's list
  host.frame();
  ASSERT_FALSE(ImGui::GetCurrentContext()->OpenPopupStack.empty());
  host.press(Key::end);
  EXPECT_EQ(session.step(), 3u);
  host.press(Key::escape);  // closes it
  host.frame();
  EXPECT_TRUE(ImGui::GetCurrentContext()->OpenPopupStack.empty());
  host.press(Key::end);
  EXPECT_EQ(session.step() + 1, session.count());
}

TEST_F(OpenRun, GivesWhatIsNotProvenAsTheMostItCanBe) {
  app.open_gallery("mpr-2d-deep");
  EXPECT_EQ(result_text(session.recording()), "overlapping, depth at most 2.5");
  app.open_gallery("end-epa-limit");
  EXPECT_TRUE(result_text(session.recording()).starts_with("overlapping, depth at most ")) << result_text(session.recording());
  app.open_gallery("box-box-deep");
  EXPECT_TRUE(result_text(session.recording()).starts_with("overlapping, depth 0.39")) << result_text(session.recording());
}

TEST_F(OpenRun, IsFoundInTheGalleryByWords) {
  app.left_tab = App::LeftTab::gallery;
  host.frame();
  host.click(130, 117);
  host.type("RIM OF A CONE");  // of its description, in either case
  host.frame();
  host.press(Key::enter);
  host.frame();
  EXPECT_EQ(session.title(), "cone-rim-on-box");
  EXPECT_EQ(session.step(), 0u) << "what is typed is no key";
}

TEST(Numbers, HaveTheirPointsInOneColumn) {
  const std::vector<double> values{0.0, 1.0, -2.5, 0.0652777, 3.09327, 1.54e-14, -1e300, 123456.0, 0.1234567, 7e-5};
  const std::vector<std::string> texts = at_one_point(values);
  ASSERT_EQ(texts.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& text = texts[i];
    EXPECT_NEAR(std::stod(text), values[i], 5e-3 * std::abs(values[i]));
    if (text.find('.') != std::string::npos && text.find('e') == std::string::npos) EXPECT_EQ(text.size() - text.find('.'), 7u) << "'" << text << "'";
    else EXPECT_NE(text.back(), ' ') << "'" << text << "' ends at the column's edge";
  }
}

/// Blanks that align nothing would only move a number off the edge at which all others end.
TEST(Numbers, EndAtTheEdgeWhereNothingIsToBeAligned) {
  EXPECT_EQ(at_one_point({-2.5}), std::vector<std::string>{"-2.5"});
  EXPECT_EQ(at_one_point({5.84e-15, -0.1, 0.1}), (std::vector<std::string>{"5.84e-15", "-0.1", "0.1"}));
  EXPECT_EQ(at_one_point({0.25, 0.5, 1}), (std::vector<std::string>{"0.25", "0.5 ", "1"}));
}

TEST_F(OpenRun, NoFileIsSavedOverUnasked) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("gjkdbg-save-" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  const std::string there = (folder / "there.scene.json").string();
  std::ofstream(there) << "{}";
  const auto ask_to_save = [&](const std::string& name) {
    host.press(Key::s, false, true);
    host.frame();
    host.type(name);  // over the suggested name, which is selected
    host.press(Key::enter);
  };
  ask_to_save(there);
  EXPECT_EQ(app.save_requested, "");
  host.frame();
  host.press(Key::enter);
  EXPECT_EQ(std::exchange(app.save_requested, {}), there);
  app.message = "no room";  // the host's
  host.frame(), host.frame();
  EXPECT_EQ(app.message, "") << "it is said in the dialog, where the name stands";
  EXPECT_TRUE(ImGui::IsPopupOpen("ask", ImGuiPopupFlags_AnyPopupId));
  host.press(Key::escape), host.press(Key::escape);
  EXPECT_FALSE(ImGui::IsPopupOpen("ask", ImGuiPopupFlags_AnyPopupId));
  ask_to_save((folder / "new.txt").string());
  EXPECT_EQ(app.save_requested, "") << "no ending says what is to be saved";
  host.press(Key::escape), host.press(Key::escape);
  ask_to_save((folder / "new.png").string());
  EXPECT_EQ(std::exchange(app.save_requested, {}), (folder / "new.png").string());
  host.frame(), host.frame();
  EXPECT_FALSE(ImGui::IsPopupOpen("ask", ImGuiPopupFlags_AnyPopupId));
  std::filesystem::remove_all(folder);
}

TEST_F(OpenRun, AFileThatCannotBeOpenedLeavesItsName) {
  host.press(Key::o, false, true);
  host.frame();
  host.type("/no/such.scene.json");
  host.press(Key::enter);
  host.frame();
  EXPECT_TRUE(ImGui::IsPopupOpen("ask", ImGuiPopupFlags_AnyPopupId));
  EXPECT_EQ(session.title(), "box-box-deep");
  host.press(Key::escape), host.press(Key::escape);
  host.press(Key::o, false, true);
  host.frame();
  const std::string folder = app.gallery().file("2d-deep").parent_path().string();
  host.type(folder + "/2d-dee");
  ImGui::GetIO().KeysDown[258] = true;  // Tab
  host.frame();
  ImGui::GetIO().KeysDown[258] = false;
  host.frame();
  host.press(Key::enter);
  EXPECT_EQ(session.title(), "2d-deep");
}

TEST_F(OpenRun, ADecimalCommaIsAPoint) {
  host.press(Key::g, false, true);  // letters and points are dropped from a whole number, digits are not
  host.frame();
  host.type("1,");
  host.frame();
  const ImGuiInputTextState& field = ImGui::GetCurrentContext()->InputTextState;
  ASSERT_EQ(field.CurLenW, 2);
  EXPECT_EQ(field.TextW[1], '.');
}

TEST(Measurements, KnowTheAtlassVerdicts) {
  for (std::size_t i = 0; i < verdict_names.size(); ++i) {
    EXPECT_STREQ(atlas_verdicts[i], verdict_names[i]);
    EXPECT_STREQ(atlas_verdict_marks[i], verdict_marks[i]);
  }
}

TEST_F(OpenRun, IsGoneThroughByItsPlot) {
  session.go_to(0);
  host.frame();
  host.click(830, 722);  // in the plot of the bounds
  EXPECT_GT(session.step(), 0u);
  EXPECT_LT(session.step() + 1, session.count());
}

}  // namespace
}  // namespace gjkdbg
