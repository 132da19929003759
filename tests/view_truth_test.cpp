// That what the window says is so: of numbers beyond all bounds, of bounds of an overlap, of ends at which nothing follows, of bodies while a ray is cast.
#include <algorithm>
#include <cmath>
#include <limits>

#include "debugger/view/explain.h"
#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

class Truth : public Window {
 protected:
  std::string told_at_the_end() {
    session.go_to(session.count() - 1);
    return explain(session.recording(), session.frame()).text;
  }
};

/// What is typed may be no number a scene can hold; a file of it could not be read again.
TEST_F(Truth, AnEditThatNoFileCanHoldIsRefused) {
  for (const double x : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), 1e200}) {
    SceneFile next = session.scene();
    next.scene.bodies[1].pose.position[0] = x;
    EXPECT_TRUE(session.edit(next).starts_with("B: position x must ")) << session.edit(next);
  }
  EXPECT_TRUE(session.scene().scene.bodies[1].pose.position.allFinite());
  SceneFile next = session.scene();
  next.scene.bodies[1].pose.position[0] += 0.5;
  EXPECT_EQ(session.edit(next), "");
}

/// The ring of the upper bound lies inside A - B where the bodies overlap.
TEST_F(Truth, BoundsOfAnOverlapAreThoseOfTheDepth) {
  const auto meaning = [&](const char* ring) { return meaning_of(ring, false, session.frame(), session.recording()); };
  session.go_to(17);
  ASSERT_LT(session.frame().upper_bound.value(), 0);
  EXPECT_NE(meaning("depth at least").find("nothing of the border is nearer"), std::string::npos);
  EXPECT_NE(meaning("depth at most").find("at least this near"), std::string::npos);
  app.open_gallery("box-box-apart");
  session.go_to(session.count() - 2);
  EXPECT_NE(meaning("at most").find("at least this near"), std::string::npos);
  EXPECT_NE(meaning("at least").find("nothing of the border is nearer"), std::string::npos);
}

/// A ring of an overlap is named by what it says of the depth, as the panel's rows are of the signed distance.
TEST_F(Truth, RingsOfAnOverlapAreNamedByTheDepth) {
  const auto names = [&] {
    const ViewRectangle view{0, 0, 600, 600};
    std::vector<std::string> all;
    for (const PictureLabel& label : difference_picture(session.meshes(), session.recording(), session.frame(), app.settings, dark_palette, Projection(app.difference_camera, view)).labels)
      if (label.text.find("at ") != std::string::npos) all.push_back(label.text);
    std::sort(all.begin(), all.end());
    return all;
  };
  session.go_to(17);
  ASSERT_LT(session.frame().upper_bound.value(), 0);
  EXPECT_EQ(names(), (std::vector<std::string>{"depth at least", "depth at most"}));
  app.open_gallery("box-box-apart");
  host.frame();
  session.go_to(6);
  ASSERT_GT(session.frame().upper_bound.value(), 0);
  for (const std::string& name : names()) EXPECT_EQ(name.find("depth"), std::string::npos) << name;
}

/// What is shown as the upper bound never rises while EPA goes on: a face's distance does not allow for rounding, the events do.
TEST_F(Truth, TheUpperBoundOfEpaNeverRises) {
  for (const char* name : {"two-unit-cubes", "box-box-deep", "identical-cubes", "2d-deep", "sphere-in-box", "obb-edge-edge", "hull-tetrahedra"}) {
    app.open_gallery(name);
    double last = std::numeric_limits<double>::infinity();
    int seen = 0;
    for (std::size_t i = 0; i < session.count(); ++i) {
      const Event& event = session.recording().events[i];
      if (phase_of(event) != 1 || std::holds_alternative<recorded::EpaEnded>(event)) continue;  // from the end on it is the result's, rounded once more
      session.go_to(i);
      const auto shown = bound_by_first_face(session) ? bound_by_first_face(session) : session.frame().upper_bound;
      if (!shown) continue;
      EXPECT_LE(*shown, last) << name << " " << i;
      last = *shown, ++seen;
    }
    EXPECT_GT(seen, 0) << name;
  }
}

/// The captions tell what is drawn at the step.
TEST_F(Truth, ACaptionIsOfWhatIsDrawn) {
  const auto drawn = [&](std::size_t step, const auto& make, const Camera& camera) {
    session.go_to(step);
    return make(session.meshes(), session.recording(), session.frame(), app.settings, dark_palette, Projection(camera, ViewRectangle{0, 0, 600, 600})).shown;
  };
  using Drawn = std::vector<std::string>;
  EXPECT_EQ(drawn(0, world_picture, app.world_camera), Drawn{});
  EXPECT_EQ(drawn(1, world_picture, app.world_camera), Drawn{"supports"});
  EXPECT_EQ(drawn(4, difference_picture, app.difference_camera), (Drawn{"region", "simplex", "direction", "nearest point", "bounds"}));
  EXPECT_EQ(drawn(17, difference_picture, app.difference_camera), (Drawn{"polytope", "direction", "bounds"}));
  EXPECT_EQ(drawn(session.count() - 1, world_picture, app.world_camera), (Drawn{"witnesses", "normal"}));
}

/// Nothing is called apart that is not proven so.
TEST_F(Truth, SeemingApartIsNoProof) {
  app.open_gallery("end-epa-separated");
  ASSERT_LE(session.recording().result.lower_bound.value(), 0);
  EXPECT_NE(told_at_the_end().find("seem to be apart"), std::string::npos) << told_at_the_end();
  EXPECT_TRUE(result_text(session.recording()).starts_with("seem apart")) << result_text(session.recording());
}

/// The way out may be that of a face which has been removed since.
TEST_F(Truth, AFaceThatIsGoneIsSaidToBe) {
  app.open_gallery("identical-cubes");
  EXPECT_NE(told_at_the_end().find("a face that was there before (face 0, chosen at step 13)"), std::string::npos) << told_at_the_end();
}

/// GJK that ends on the origin has not told touch from overlap where EPA is still to come.
TEST_F(Truth, TouchOrOverlapIsLeftToEpa) {
  app.open_gallery("two-unit-cubes");
  session.go_to(5);
  EXPECT_EQ(explain(session.recording(), session.frame()).title, "GJK ends: touching or overlapping");
}

TEST_F(Truth, NothingIsAnnouncedThatDoesNotCome) {
  app.open_gallery("boolean-round");
  EXPECT_EQ(told_at_the_end().find("EPA will tell"), std::string::npos);
  app.open_gallery("mpr-yes-no");
  EXPECT_NE(told_at_the_end().find("on the inner side"), std::string::npos);
  session.step_by(-1);
  EXPECT_EQ(explain(session.recording(), session.frame()).text.find("moves out"), std::string::npos);
}

TEST_F(Truth, BoundsHaveMetOnlyIfTheyHave) {
  app.open_gallery("needles-a-hair-apart");
  EXPECT_NE(told_at_the_end().find("as near as rounding lets them come"), std::string::npos) << told_at_the_end();
  app.open_gallery("box-box-apart");
  EXPECT_NE(told_at_the_end().find("have met. The signed distance is known"), std::string::npos) << told_at_the_end();
  app.open_gallery("end-stalled");
  EXPECT_NE(told_at_the_end().find("no longer falls"), std::string::npos) << told_at_the_end();
}

/// While a ray is cast the bodies stand where the cast began, and time only goes on.
TEST_F(Truth, BodiesStandWhileARayIsCast) {
  app.open_gallery("cast-ray");
  session.go_to(0);
  const auto places = session.frame().places;
  double time = 0;
  for (std::size_t i = 0; i + 1 < session.count(); ++i) {
    session.go_to(i);
    EXPECT_EQ(session.frame().places, places) << i;
    EXPECT_GE(session.frame().time.value(), time) << i;
    time = session.frame().time.value();
  }
  EXPECT_GT(time, 0.4);
  session.go_to(session.count() - 1);
  EXPECT_NE(session.frame().places, places);
}

/// The boolean form knows no cores: every support is a corner of the difference on show.
TEST_F(Truth, TheBooleanFormIsShownWholeBodies) {
  app.open_gallery("boolean-round");
  EXPECT_EQ(session.meshes().radius, 0);
  session.go_to(5);
  EXPECT_NE(explain(session.recording(), session.frame()).text.find("the bodies touch or overlap"), std::string::npos);
  for (const Event& event : session.recording().events)
    if (const auto* e = std::get_if<recorded::SupportQueried>(&event)) {
      const ViewPoint d = to_view(AnyVector(e->direction.normalized()));
      double reach = -std::numeric_limits<double>::infinity();
      for (const ViewPoint& p : session.meshes().difference.points) reach = std::max(reach, p.dot(d));
      EXPECT_NEAR(to_view(e->w).dot(d), reach, 0.05);
    }
}

TEST(Digits, TellTwoPointsApart) {
  EXPECT_EQ(digits_that_tell(AnyVector(Eigen::Vector3d(1, 2, 3)), AnyVector(Eigen::Vector3d(0.5, 2, 3))), 4);
  EXPECT_EQ(digits_that_tell(AnyVector(Eigen::Vector2d(1e10, 0)), AnyVector(Eigen::Vector2d(1e10 + 0.5, 0))), 13);
  EXPECT_EQ(digits_that_tell(AnyVector(Eigen::Vector2d(1, 1)), AnyVector(Eigen::Vector2d(1, 1))), 4);
}

/// A stall that leaves yes or no open is not the end: who is asked next is said where GJK ends.
TEST_F(Truth, AfterAStallItIsSaidWhoIsAskedNext) {
  app.open_gallery("end-begins-again");
  std::size_t told = 0;
  for (std::size_t step = 0; step + 1 < session.count(); ++step) {
    if (!std::holds_alternative<recorded::GjkEnded>(session.recording().events[step])) continue;
    session.go_to(step);
    told += explain(session.recording(), session.frame()).text.find("signed volumes, which have exact signs to fall back on, begin once more") != std::string::npos;
  }
  EXPECT_EQ(told, 1u);
  EXPECT_EQ(told_at_the_end().find("once more"), std::string::npos);
}

}  // namespace
}  // namespace gjkdbg
