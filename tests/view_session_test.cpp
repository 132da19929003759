// What is open and what becomes of it: another program's run, breakpoints, answers that are not proven, numbers in columns.
#include <imgui_internal.h>

#include "debugger/view/explain.h"
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

TEST_F(OpenRun, IsAtTheStepItWasAtAfterUndo) {
  session.go_to(15);
  SceneFile next = session.scene();
  next.scene.bodies[1].pose.position[0] += 9;  // apart: a short run
  app.edit(next);
  EXPECT_LT(session.count(), 15u);
  session.undo();
  EXPECT_EQ(session.step(), 15u);
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
  for (const double x : {0.0, 1.0, -2.5, 0.0652777, 3.09327, 1.54e-14, -1e300, 123456.0, 0.1234567, 7e-5}) {
    const std::string text = at_the_point(x);
    EXPECT_EQ(text.size() - text.find_first_of(".e "), 7u) << "'" << text << "'";
    EXPECT_NEAR(std::stod(text), x, 5e-3 * std::abs(x));
  }
}

}  // namespace
}  // namespace gjkdbg
