// The method's settings in the window, chosen by the mouse: where GJK begins, and methods that fit the bodies.
#include <algorithm>
#include <map>

#include "debugger/view/explain.h"
#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

std::size_t kept_vertices(const Session& session) {
  const auto& events = session.recording().events;
  return static_cast<std::size_t>(std::count_if(events.begin(), events.end(), [](const Event& e) { return std::holds_alternative<recorded::VertexKept>(e); }));
}

class MethodPanel : public Window {
 protected:
  /// Opens a setting's list at this height and takes an entry, counted from 0.
  void choose(float y, int entry) {
    host.click(178, y);
    host.frame();
    host.click(178, y + 26 + 22 * static_cast<float>(entry));
    host.frame();
  }
};

TEST_F(MethodPanel, StartsFromThePreviousSimplex) {
  choose(594, 2);
  EXPECT_EQ(session.scene().method.start, Start::previous);
  const std::size_t all = kept_vertices(session);
  EXPECT_EQ(all, 4u) << "deep in one another: the simplex that encloses the origin";
  // A body moves, and the search goes on from what is shown.
  SceneFile next = session.scene();
  next.scene.bodies[1].pose.position[0] += 0.01;
  EXPECT_EQ(session.edit(next), "");
  EXPECT_EQ(kept_vertices(session), 4u);
  EXPECT_EQ(session.scene().method.initial_simplex.size(), 4u);
  // A body that no longer holds its points: begun anew.
  next = session.scene();
  next.scene.bodies[0].shape = {Box{Eigen::Vector3d(-0.1, -0.1, -0.1), Eigen::Vector3d(0.1, 0.1, 0.1)}, 0};
  EXPECT_EQ(session.edit(next), "");
  EXPECT_EQ(kept_vertices(session), 0u);
  session.go_to(0);
  host.frame();
  choose(594, 0);
  EXPECT_EQ(session.scene().method.start, Start::centres);
  EXPECT_TRUE(session.scene().method.initial_simplex.empty());
}

TEST_F(MethodPanel, StartsAlongAGivenDirection) {
  choose(594, 1);
  ASSERT_TRUE(session.recording().settings.initial_direction);
  EXPECT_EQ(std::get<recorded::GjkBegan>(session.recording().events[0]).direction, AnyVector(Eigen::Vector3d(1, 0, 0)));
  host.drag(225, 623, 265, 623);  // z of the direction, below
  EXPECT_GT((*session.recording().settings.initial_direction)[2], 0);
}

TEST_F(MethodPanel, SaysWhichDirectionsAreNotMinusV) {
  const auto titles = [&](const char* scene) {
    app.open_gallery(scene);
    std::map<std::string, int> count;
    for (std::size_t step = 0; step < session.count(); ++step) session.go_to(step), ++count[explain(session.recording(), session.frame()).title];
    return count;
  };
  auto newton = titles("accelerated-newton");
  EXPECT_GE(newton["Support along Newton's direction"], 2);
  EXPECT_GE(newton["Support towards the origin"], 1) << "the last plane is across v";
  auto momentum = titles("accelerated-polyak");
  EXPECT_GE(momentum["Support along the momentum"], 3);
  EXPECT_EQ(momentum.count("Support along Newton's direction"), 0u);
  EXPECT_EQ(titles("2d-ellipses-apart").count("Support along the momentum"), 0u);
}

TEST_F(MethodPanel, OffersOnlyMethodsThatFit) {
  choose(536, 3);  // for boxes: gjk, gjk-accelerated, mpr, sat, projections, fastest
  EXPECT_EQ(session.scene().method.name, MethodName::sat);
  choose(536, 0);
  choose(536, 5);
  EXPECT_EQ(session.scene().method.name, MethodName::fastest);
  EXPECT_EQ(session.recording().settings.name, MethodName::sat) << "the fastest for boxes";
  choose(536, 6);
  EXPECT_EQ(session.scene().method.name, MethodName::fastest) << "the list ends there";
  host.press(Key::escape);
  app.open_gallery("closed-form-capsules");
  app.left_tab = App::LeftTab::scene;
  host.frame(), host.frame();
  EXPECT_TRUE(std::holds_alternative<recorded::ClosedFormBegan>(session.recording().events[0]));
  choose(606, 0);
  EXPECT_EQ(session.recording().settings.name, MethodName::gjk);
  choose(606, 4);
  EXPECT_EQ(session.recording().settings.name, MethodName::closed_form);
}

}  // namespace
}  // namespace gjkdbg
