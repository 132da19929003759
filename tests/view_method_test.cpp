// The method's settings in the window, chosen by the mouse: where GJK begins, and methods that fit the bodies. And what the window says of a step,
// in sentences and in the names of what is drawn.
#include <algorithm>
#include <map>
#include <set>

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
  auto smoothed = titles("accelerated-smoothed");
  EXPECT_GE(smoothed["Support along the smoothed direction"], 1);
  EXPECT_GE(smoothed["Support towards the origin"], 2);
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

class Words : public Window {
 protected:
  Explanation at(std::size_t step) {
    session.go_to(step);
    return explain(session.recording(), session.frame());
  }
  template <class Kind>
  std::size_t first() const {
    const auto& events = session.recording().events;
    return static_cast<std::size_t>(std::find_if(events.begin(), events.end(), [](const Event& e) { return std::holds_alternative<Kind>(e); }) - events.begin());
  }
  std::size_t last() const { return session.count() - 1; }
  /// Every label of the difference view at a step.
  std::set<std::string> names(std::size_t step) {
    session.go_to(step);
    const Projection projection(app.difference_camera, {0, 0, 400, 400});
    std::set<std::string> all;
    for (const PictureLabel& label : difference_picture(session.meshes(), session.recording(), session.frame(), ViewSettings{}, dark_palette, projection).labels) all.insert(label.text);
    return all;
  }
};

TEST_F(Words, SayWhyASimplexIsKeptAndWhatItMeans) {
  app.open_gallery("boolean-hit-2d");
  const std::string hit = at(5).text;
  EXPECT_NE(hit.find("The origin lies in the triangle ABC: the bodies overlap."), std::string::npos) << hit;
  EXPECT_EQ(hit.find("next direction"), std::string::npos) << hit;
  app.open_gallery("2d-squares-apart");
  EXPECT_NE(at(4).text.find("the foot of the perpendicular from O lies within it"), std::string::npos);
  EXPECT_EQ(at(2).text.find("perpendicular"), std::string::npos) << "of a single vertex there is none";
  app.open_gallery("box-box-deep");
  EXPECT_NE(at(first<recorded::GjkEnded>()).text.find("The bodies overlap."), std::string::npos);
  SceneFile round = session.scene();
  round.scene.bodies[0].shape.margin = 0.1;
  ASSERT_EQ(session.edit(round), "");
  EXPECT_NE(at(first<recorded::GjkEnded>()).text.find("The cores overlap."), std::string::npos);
}

TEST_F(Words, NameTheNearestPointAtTheEnd) {
  app.open_gallery("2d-squares-apart");
  EXPECT_TRUE(names(last()).contains("v"));
  app.open_gallery("2d-corner-to-corner");
  EXPECT_TRUE(names(last()).contains("v = A = w")) << "one dot, one label";
  EXPECT_FALSE(names(last()).contains("w"));
}

TEST_F(Words, CallThePolytopesFacesEdgesInThePlane) {
  const std::size_t face = first<recorded::FaceChosen>();
  EXPECT_TRUE(names(face).contains("face " + std::to_string(std::get<recorded::FaceChosen>(session.recording().events[face]).face)));
  EXPECT_TRUE(names(face).contains("#0"));
  EXPECT_TRUE(names(last()).contains("depth"));
  app.open_gallery("2d-deep");
  const std::size_t edge = first<recorded::FaceChosen>();
  EXPECT_TRUE(at(edge).text.starts_with("Edge ")) << at(edge).text;
  EXPECT_TRUE(names(edge).contains("edge " + std::to_string(std::get<recorded::FaceChosen>(session.recording().events[edge]).face)));
  for (std::size_t i = edge; i < session.count(); ++i) {
    const PseudoCode code = pseudo_code(session.recording(), i);
    std::string all = at(i).title + at(i).text + summary(session.recording(), i);
    for (const std::string& line : code.lines) all += line;
    EXPECT_EQ(all.find("face"), std::string::npos) << all;
  }
  app.open_gallery("box-box-deep");
  SceneFile round = session.scene();
  for (Body& body : round.scene.bodies) body.shape = {Ellipsoid{Eigen::Vector3d(1, 0.7, 0.6)}, 0};
  ASSERT_EQ(session.edit(round), "");
  ASSERT_GT(names(last()).size(), 0u);
  ASSERT_GT(session.frame().vertices.size(), 20u);
  for (const std::string& name : names(last())) EXPECT_FALSE(name.starts_with("#")) << "there is no room for so many numbers";
}

TEST_F(Words, PutAWarningWhereItWasGiven) {
  Recording theirs = session.recording();
  theirs.generator = "another solver";
  const std::size_t chosen = first<recorded::FaceChosen>();
  const int iteration = std::get<recorded::FaceChosen>(theirs.events[chosen]).iteration;
  theirs.events.resize(chosen + 1);
  theirs.events.emplace_back(recorded::EpaEnded{iteration, EpaStatus::aborted, -1, AnyVector(AnyVector::Zero(3)), 0});
  theirs.events.emplace_back(recorded::Warning{"bad-message", "Not a message of the protocol."});
  theirs.result = {};
  theirs.result.status = "aborted";
  session.open(theirs, "theirs");
  session.go_to(last());
  EXPECT_TRUE(place_text(session).ends_with("EPA iteration " + std::to_string(iteration))) << place_text(session);
  EXPECT_EQ(summary(session.recording(), last() - 1), "aborted");
  EXPECT_FALSE(names(last() - 1).contains("depth"));
  host.frame(), host.frame();
  // A phase back from the warning is out of EPA.
  host.press(Key::left, false, true);
  EXPECT_EQ(phase_of(session.recording().events[session.step()]), 0);
}

TEST_F(Words, AnswerForTheRunOfAnotherSolver) {
  session.go_to(3);
  host.frame(), host.frame();
  const Image ours = host.image();
  Recording theirs = session.recording();
  theirs.generator = "another solver";
  session.open(theirs, "box-box-deep");
  EXPECT_TRUE(session.findings().empty());
  session.go_to(3);
  host.frame(), host.frame();
  EXPECT_NE(host.image().rgb, ours.rgb) << "another chip, and that every step holds";
  std::get<recorded::SupportQueried>(theirs.events[3]).direction *= -1;
  session.open(theirs, "box-box-deep");
  ASSERT_FALSE(session.findings().empty());
  host.frame(), host.frame();
}

TEST_F(Words, AreFoundInSentencesToo) {
  app.open_gallery("box-box-apart");
  EXPECT_EQ(find_text(session, "dropped", 0, false), std::size_t{6});
  EXPECT_EQ(find_text(session, "Dropped", 0, true), std::size_t{6});
  EXPECT_EQ(find_text(session, "simplex", 0, false), std::size_t{2}) << "what the list shows comes first";
  EXPECT_FALSE(find_text(session, "zeppelin", 0, false));
  // The old text is selected when the dialog opens again: typing replaces it.
  for (const char* text : {"grow", "dropped"}) {
    host.press(Key::f, false, true);
    host.frame();
    host.type(text);
    host.press(Key::enter);
    host.press(Key::escape);
    host.frame();
  }
  EXPECT_EQ(session.step(), 6u);
  host.press(Key::f, false, true);
  host.frame();
  host.type("nonsense < 3");
  host.press(Key::enter);
  host.press(Key::escape);
  host.frame();
  host.press(Key::f3);
  EXPECT_NE(app.message.find("nonsense"), std::string::npos) << app.message;
}

TEST_F(Words, SayInSteps) {
  Method steps;
  steps.max_iterations = 2;
  ASSERT_EQ(session.compare_with(steps, "two steps"), "");
  const std::string part = "they part at step " + std::to_string(session.parting()->event);
  EXPECT_TRUE(parting_text(session).starts_with("the same so far; " + part)) << parting_text(session);
  session.go_to(last());
  EXPECT_TRUE(parting_text(session).starts_with(part)) << parting_text(session);
  EXPECT_FALSE(answers_agree(session.recording().result, session.other().result));
  Method other;
  other.closest_point = ClosestPoint::johnson;
  ASSERT_EQ(session.compare_with(other, "johnson"), "");
  EXPECT_TRUE(answers_agree(session.recording().result, session.other().result));
  host.frame();
}

/// However long the run beside it is: at the end of this one its end.
TEST_F(Words, TheRunBesideEndsWithThisOne) {
  SceneFile next = session.scene();
  next.method.max_iterations = 2;
  ASSERT_EQ(session.edit(next), "");
  ASSERT_EQ(session.compare_with(Method{}, "to the end"), "");
  ASSERT_GT(session.other().events.size(), session.count());
  session.go_to(1);
  EXPECT_EQ(session.other_step(), 1u);
  session.go_to(last());
  EXPECT_EQ(session.other_frame().step, session.other().events.size() - 1);
  host.frame();
}

TEST_F(Words, AreOfThePairThatIsLookedAt) {
  app.open_gallery("sim-stack-of-five");
  for (std::size_t i = 0; i < session.count(); ++i) {
    session.go_to(i);
    if (session.frame().pair != std::array{1, 2} || !std::holds_alternative<recorded::SupportQueried>(session.recording().events[i])) continue;
    const std::string text = explain(session.recording(), session.frame()).text;
    EXPECT_NE(text.find("farthest point of B - C"), std::string::npos) << text;
    return;
  }
  FAIL() << "no such step";
}

/// What GJK and EPA measure is the cores' distance or depth: the sentences say what becomes of it.
TEST_F(Words, TellTheCoresFromTheBodies) {
  app.open_gallery("sphere-in-box");
  session.go_to(session.count() - 1);
  EXPECT_NE(explain(session.recording(), session.frame()).text.find("0.6 of the cores, with the radii, 0.5 together, is the depth. Moving body B by 1.1"), std::string::npos);
  app.open_gallery("margin-boxes");
  session.go_to(session.count() - 1);
  const std::string text = explain(session.recording(), session.frame()).text;
  EXPECT_NE(text.find("|v| = 0.25 between the cores, less the radii, 0.2 together"), std::string::npos) << text;
  EXPECT_FALSE(session.frame().barycentric.empty()) << "the weights that make the witnesses stay";
}

/// What EPA asks for before it grows is what GJK's simplex lacks, or corners nearer to the answer than a whole tetrahedron's.
TEST_F(Words, SayWhatEpaStartsFrom) {
  for (const char* name : {"hulls-around-the-way-out", "hulls-no-octahedron"}) {
    app.open_gallery(name);
    for (int k = 1; k <= 4; ++k) EXPECT_EQ(at(first<recorded::PolytopeSeeded>() - static_cast<std::size_t>(k)).title, "Support around the way out") << name;
  }
  EXPECT_EQ(at(first<recorded::PolytopeSeeded>()).title, "EPA begins with 12 faces");
  app.open_gallery("concentric-boxes");
  EXPECT_EQ(at(first<recorded::PolytopeSeeded>() - 1).title, "Support for EPA's start");
}

TEST_F(Words, OfARefusedNumberAreThePanels) {
  SceneFile next = session.scene();
  next.method.tolerance = 7;
  EXPECT_EQ(session.edit(next), "tolerance must be greater than 0 and less than 1");
  // One click in a number's field, and typing begins.
  host.click(180, 262);
  host.frame();
  host.type("2.5");
  host.press(Key::enter);
  EXPECT_EQ(session.scene().scene.bodies[0].pose.position[1], 2.5);
}

TEST_F(Words, APhaseOfAMotionIsWhereItMovesOn) {
  app.open_gallery("cast-bounce");
  std::size_t stops = 0, moves = 0;
  for (const Event& e : session.recording().events)
    moves += std::holds_alternative<recorded::CastAdvanced>(e) || std::holds_alternative<recorded::State>(e) || std::holds_alternative<recorded::ImpulseApplied>(e);
  ASSERT_GT(moves, 3u);
  while (session.step() < last()) session.step_phase(1), ++stops;
  EXPECT_GE(stops, moves);
  EXPECT_LT(stops, session.count() / 2);
  session.step_phase(-1);
  EXPECT_LT(session.step(), last());
  EXPECT_GT(session.step(), 0u);
  EXPECT_NE(at(last()).text, "");
}

TEST_F(Words, AndEveryNameDrawnHasAMeaning) {
  const Projection projection(Camera{}, {0, 0, 300, 300});
  std::set<std::string> without;
  for (const Lesson& lesson : app.gallery().lessons)
    for (const std::string& scene : lesson.scenes) {
      app.open_gallery(scene);
      const std::size_t every = 1 + session.count() / 40;
      for (std::size_t k = 0; k < session.count(); k += every) {
        session.go_to(k);
        for (const bool world : {true, false})
          for (const PictureLabel& label : (world ? world_picture : difference_picture)(session.meshes(), session.recording(), session.frame(), ViewSettings{}, dark_palette, projection).labels)
            if (label.text[0] != '#' && meaning_of(label.text, world, session.frame(), session.recording()).empty()) without.insert((world ? "world: " : "difference: ") + label.text);
      }
    }
  EXPECT_EQ(without, std::set<std::string>{});
}

/// Nothing lies under a label: the axes' numbers give way, and a label that found no room beside its dot has a line to it.
TEST_F(Words, StandFree) {
  int led = 0;
  for (const char* scene : {"2d-deep", "2d-corner-to-corner", "cast-rotating-rod", "box-box-deep"}) {
    app.open_gallery(scene);
    const ViewRectangle view{0, 0, 360, 300};
    const Projection projection(fit_world(session.meshes(), session.recording()), view);
    for (std::size_t k = 0; k < session.count(); ++k) {
      session.go_to(k);
      const auto items = flatten(world_picture(session.meshes(), session.recording(), session.frame(), ViewSettings{}, dark_palette, projection), projection);
      const auto is_mark = [](const FlatItem& item) { return item.small && item.text.find_first_not_of("-.0123456789") == std::string::npos; };
      for (std::size_t i = 0; i < items.size(); ++i) {
        if (items[i].kind != FlatItem::Kind::label || is_mark(items[i])) continue;
        const Projected& at = items[i].points[0];
        const double w = text_width(items[i].text, items[i].small), h = 17;
        for (const FlatItem& mark : items)
          if (mark.kind == FlatItem::Kind::label && is_mark(mark)) {
            const Projected& m = mark.points[0];
            EXPECT_FALSE(m.x < at.x + w && at.x < m.x + text_width(mark.text, true) && m.y < at.y + h && at.y < m.y + 11) << scene << " " << k << ": " << items[i].text << " over " << mark.text;
          }
        led += i > 0 && items[i - 1].kind == FlatItem::Kind::line && items[i - 1].width == 1 && !items[i].small;
      }
    }
  }
  EXPECT_GT(led, 0);
  EXPECT_EQ(body_letter(25) + " " + body_letter(26), "Z 26");
}

TEST_F(Words, AndTheArrowsTheyNameAreInView) {
  for (const char* scene : {"2d-squares-apart", "2d-deep", "box-box-apart", "box-box-deep"}) {
    app.open_gallery(scene);
    const Camera world = fit_world(session.meshes(), session.recording()), difference = fit_difference(session.meshes(), session.recording());
    const ViewRectangle view{0, 0, 300, 300};
    const Projection in_world(world, view), in_difference(difference, view);
    for (const Event& event : session.recording().events) {
      const auto* e = std::get_if<recorded::SupportQueried>(&event);
      if (!e) continue;
      const ViewPoint d = to_view(AnyVector(e->direction.normalized()));
      const Projected o = in_difference(ViewPoint(d * direction_arrow * difference.radius)), a = in_world(ViewPoint(to_view(e->a) + d * support_arrow * world.radius)),
                      b = in_world(ViewPoint(to_view(e->b) - d * support_arrow * world.radius));
      for (const Projected& tip : {o, a, b}) EXPECT_TRUE(view.contains(tip.x, tip.y)) << scene << " " << tip.x << " " << tip.y;
    }
  }
}

}  // namespace
}  // namespace gjkdbg
