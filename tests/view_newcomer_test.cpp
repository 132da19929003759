// What someone who meets the algorithms for the first time must not take for something else: the next direction, letters, where two runs part, the way back.
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "debugger/view/explain.h"
#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

using Newcomer = Window;

template <class Kind>
const Kind* kind_at(const Session& s, std::size_t step) {
  return step < s.count() ? std::get_if<Kind>(&s.recording().events[step]) : nullptr;
}

/// Also where no v says which one it is, or where it is not -v.
TEST_F(Newcomer, SeesTheNextDirectionAfterACut) {
  for (const char* name : {"boolean-hit-3d", "boolean-hit-2d", "boolean-miss-3d", "accelerated-polyak", "accelerated-newton", "accelerated-smoothed", "box-box-deep", "obb-edge-edge"}) {
    app.open_gallery(name);
    int cuts = 0;
    for (std::size_t i = 0; i < session.count(); ++i) {
      if (!kind_at<recorded::SimplexReduced>(session, i)) continue;
      session.go_to(i);
      const auto* next = kind_at<recorded::SupportQueried>(session, i + 1);
      EXPECT_FALSE(session.frame().answered) << name << " " << i;
      const auto& direction = session.frame().direction;
      if (next && next->phase == Phase::gjk) {
        EXPECT_TRUE(direction && *direction == next->direction) << name << " " << i;
      } else {
        EXPECT_FALSE(direction) << name << " " << i;
      }
      ++cuts;
    }
    EXPECT_GT(cuts, 0) << name;
  }
}

/// Both go by A and B: where a sentence may mean either, a body is called one.
TEST_F(Newcomer, TellsVerticesFromBodies) {
  const auto told = [&](std::size_t step) {
    session.go_to(step);
    return explain(session.recording(), session.frame());
  };
  EXPECT_EQ(told(6).title, "The whole triangle is kept");
  EXPECT_NE(told(6).text.find("Every vertex of ABC is needed"), std::string::npos);
  EXPECT_EQ(meaning_of("v = A", false, session.frame(), session.recording()), meaning_of("v", false, session.frame(), session.recording()));
  EXPECT_NE(told(9).text.find("some point of body A is also a point of body B"), std::string::npos);
  EXPECT_NE(told(session.count() - 1).text.find("Moving body B by"), std::string::npos);
}

/// Where no bounds close in SAT's plot has an axis a stem, and a click goes to its step.
TEST_F(Newcomer, GoesThroughTheAxesOfSat) {
  app.open_gallery("sat-box-box");
  session.go_to(0);
  host.frame();
  host.click(780, 730);
  EXPECT_TRUE(kind_at<recorded::AxisTested>(session, session.step())) << session.step();
}

/// Where two bodies of revolution are looked at in one plane EPA is not what the words are about, nor faces in space.
TEST_F(Newcomer, IsToldWhyAnOutlineIsLookedAt) {
  for (const char* name : {"revolution-cone-in-cylinder", "revolution-spheroids"}) {
    app.open_gallery(name);
    int axes = 0;
    for (std::size_t step = 0; step < session.count(); ++step) {
      session.go_to(step);
      const std::string title = pseudo_code(session.recording(), step).title;
      const Explanation told = explain(session.recording(), session.frame());
      const auto says = [&](const char* words) { return told.text.find(words) != std::string::npos; };
      if (kind_at<recorded::GjkEnded>(session, step)) {
        EXPECT_FALSE(says("EPA")) << told.text;
      }
      if (kind_at<recorded::SatBegan>(session, step)) {
        EXPECT_TRUE(says("their axes are parallel")) << told.text;
      }
      if (kind_at<recorded::SatEnded>(session, step)) {
        EXPECT_TRUE(says("No direction leads out sooner")) << told.text;
      }
      if (!kind_at<recorded::AxisTested>(session, step)) continue;
      EXPECT_EQ(told.title, "A way out");
      EXPECT_EQ(title, "Depth of bodies of revolution");
      ++axes;
    }
    EXPECT_GE(axes, 4) << name;
  }
}

TEST_F(Newcomer, IsToldWhatIsNearlyABall) {
  app.open_gallery("nearly-balls");
  int axes = 0;
  for (std::size_t step = 0; step < session.count(); ++step) {
    session.go_to(step);
    const Explanation told = explain(session.recording(), session.frame());
    EXPECT_EQ(told.text.find("parallel"), std::string::npos) << told.text;
    if (kind_at<recorded::SatBegan>(session, step)) {
      EXPECT_NE(told.text.find("the largest that rolls within it"), std::string::npos) << told.text;
    }
    if (!kind_at<recorded::AxisTested>(session, step)) continue;
    EXPECT_EQ(pseudo_code(session.recording(), step).title, "Depth of what is nearly balls");
    ++axes;
  }
  EXPECT_GE(axes, 20);
}

TEST_F(Newcomer, IsToldOfBends) {
  app.open_gallery("tilted-spheroids");
  int axes = 0;
  for (std::size_t step = 0; step < session.count(); step += 3) {
    session.go_to(step);
    if (!kind_at<recorded::AxisTested>(session, step)) continue;
    const PseudoCode code = pseudo_code(session.recording(), step);
    EXPECT_EQ(code.title, "Depth by the bends");
    EXPECT_EQ(code.lines[static_cast<std::size_t>(code.current)], "    depth = min(depth, n.w)");
    ++axes;
  }
  EXPECT_GE(axes, 20);
  session.go_to(session.count() - 1);
  EXPECT_NE(explain(session.recording(), session.frame()).text.find("the bends leave nothing less"), std::string::npos);
  for (std::size_t step = 0; step < session.count(); ++step)
    if (kind_at<recorded::SatBegan>(session, step)) session.go_to(step);
  const Explanation told = explain(session.recording(), session.frame());
  EXPECT_NE((told.title + told.text).find("instead of EPA"), std::string::npos) << told.title;
}

/// Sections, EPA, and then the bends: the second time it is told what SAT looks along now.
TEST_F(Newcomer, IsToldWhatFollowsEpa) {
  SceneFile file = session.scene();
  file.scene = {}, file.scene.dimension = 3, file.scene.query = Query::penetration;
  for (const bool flat : {false, true}) {
    Body body{flat ? "flat" : "long", {}, identity_pose(3)};
    if (flat) body.shape.geometry = Cylinder{0.5, 1.0 / 512, 2}, body.pose.matrix = Eigen::AngleAxisd(1e-3, Eigen::Vector3d::UnitX()).toRotationMatrix(), body.pose.rotation = RotationMatrix{body.pose.matrix};
    else body.shape.geometry = Capsule{1, 2.5, 2};
    file.scene.bodies.push_back(body);
  }
  file.method = {};
  app.edit(file);
  std::vector<std::string> titles, codes, short_ones;
  for (std::size_t step = 0; step < session.count(); ++step) {
    if (!kind_at<recorded::SatBegan>(session, step)) continue;
    session.go_to(step);
    titles.push_back(explain(session.recording(), session.frame()).title), codes.push_back(pseudo_code(session.recording(), step).title), short_ones.push_back(summary(session.recording(), step));
  }
  EXPECT_EQ(titles, (std::vector<std::string>{"Sections instead of EPA", "By the bends, after EPA"}));
  EXPECT_EQ(codes, (std::vector<std::string>{"Depth of bodies about nearly one line", "Depth by the bends"}));
  EXPECT_EQ(short_ones, (std::vector<std::string>{"about nearly one line", "by the bends"}));
}

/// Of what kind the bodies are where they meet is not known before: what is said holds of every kind.
TEST_F(Newcomer, IsToldNothingWrongOfAnOutlineInACast) {
  SceneFile file = session.scene();
  file.scene = {}, file.scene.dimension = 3, file.scene.query = Query::cast, file.scene.motion = SceneMotion{}, file.scene.motion->gravity = Eigen::Vector3d::Zero();
  for (const double size : {1.0, 0.5}) {
    Body body{size == 1 ? "A" : "B", {}, identity_pose(3)};
    body.shape.geometry = Ellipsoid{AnyVector(Eigen::Vector3d(size, 0.9 * size, 1.1 * size))};
    body.motion = Motion{Eigen::Vector3d(size, 0, 0), Eigen::Vector3d::Zero()};
    file.scene.bodies.push_back(body);
  }
  file.method = {};
  app.edit(file);
  int told = 0;
  for (std::size_t step = 0; step < session.count(); ++step) {
    session.go_to(step);
    if (!kind_at<recorded::SatBegan>(session, step) && !kind_at<recorded::SatEnded>(session, step) && !kind_at<recorded::AxisTested>(session, step)) continue;
    const Explanation e = explain(session.recording(), session.frame());
    for (const char* wrong : {"parallel", "plane", "across the outline"}) EXPECT_EQ(e.text.find(wrong), std::string::npos) << e.text;
    ++told;
  }
  EXPECT_GT(told, 5);
}

TEST_F(Newcomer, IsToldWhatIsAboutNearlyOneLine) {
  app.open_gallery("nearly-one-line");
  int axes = 0;
  for (std::size_t step = 0; step < session.count(); step += 3) {
    session.go_to(step);
    const Explanation told = explain(session.recording(), session.frame());
    EXPECT_EQ(told.text.find("parallel"), std::string::npos) << told.text;
    if (!kind_at<recorded::AxisTested>(session, step)) continue;
    EXPECT_EQ(pseudo_code(session.recording(), step).title, "Depth of bodies about nearly one line");
    ++axes;
  }
  EXPECT_GE(axes, 20);
  for (std::size_t step = 0; step < session.count(); ++step)
    if (kind_at<recorded::SatBegan>(session, step)) session.go_to(step);
  EXPECT_NE(explain(session.recording(), session.frame()).text.find("sections through the line"), std::string::npos);
}

TEST_F(Newcomer, ReadsWhatEachChoiceIs) {
  const auto each_has_one = [](const auto& names) {
    for (const std::string_view name : names) EXPECT_FALSE(meaning_of_choice(name).empty()) << name;
  };
  each_has_one(query_names), each_has_one(method_names), each_has_one(closest_point_names), each_has_one(stopping_names);
  each_has_one(acceleration_names), each_has_one(penetration_names), each_has_one(start_names), each_has_one(scalar_names);
}

TEST_F(Newcomer, SeesTheListThatIsSearched) {
  app.open_find_bar();
  host.frame(), host.frame(), host.frame();
  const ImGuiWindow *dialog = nullptr, *list = nullptr;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    const std::string name = window->Name;
    if (name == "find") dialog = window;
    if (name.find("events") != std::string::npos) list = window;
  }
  ASSERT_TRUE(dialog && list);
  EXPECT_GT(dialog->Pos.y, 48) << "the buttons above stay free";
  EXPECT_LT(dialog->Pos.y + dialog->Size.y, 125);
  EXPECT_GT(list->Pos.y, 400);
}

/// Before it has a face, too.
TEST_F(Newcomer, SeesThePolytopesVerticesByTheirNumbers) {
  app.open_gallery("hulls-around-the-way-out");
  std::size_t seeded = 0;
  while (!kind_at<recorded::PolytopeSeeded>(session, seeded)) ++seeded;
  session.go_to(seeded - 1);
  ASSERT_GE(session.frame().seeds.size(), 2u);
  const Projection projection(fit_difference(session.meshes(), session.recording()), {0, 0, 320, 260});
  std::set<std::string> names;
  for (const PictureLabel& label : difference_picture(session.meshes(), session.recording(), session.frame(), ViewSettings{}, dark_palette, projection).labels) names.insert(label.text);
  EXPECT_TRUE(names.contains("#" + std::to_string(session.frame().seeds[0])));
  EXPECT_TRUE(names.contains("w #" + std::to_string(session.frame().seeds.back())));
}

/// Where no handles stand on the bodies: in what is rendered.
TEST_F(Newcomer, SeesInAPictureWhichBodyIsWhich) {
  const Projection projection(fit_world(session.meshes(), session.recording()), {0, 0, 320, 260});
  ViewSettings settings;
  for (const bool letters : {false, true}) {
    settings.body_letters = letters;
    std::set<std::string> names;
    for (const PictureLabel& label : world_picture(session.meshes(), session.recording(), session.frame(), settings, dark_palette, projection).labels) names.insert(label.text);
    EXPECT_EQ(names.contains("A") && names.contains("B"), letters);
  }
}

/// Counted from the oldest, the letters of the sentence and of the list are still the picture's.
TEST_F(Newcomer, ReadsTheLettersOfThePicture) {
  for (const char* name : {"box-box-apart", "box-box-deep"}) {
    app.open_gallery(name);
    for (std::size_t i = 0; i < session.count(); ++i) {
      const auto* cut = kind_at<recorded::SimplexReduced>(session, i);
      if (!cut || cut->before.size() < 2) continue;
      session.go_to(i);
      std::string all, kept;
      for (const int v : cut->before) all += simplex_letter(session.frame(), v, false);
      for (const int v : cut->region) kept += simplex_letter(session.frame(), v, false);
      std::sort(all.begin(), all.end()), std::sort(kept.begin(), kept.end());
      EXPECT_TRUE(summary(session.recording(), i, false).starts_with(all + " -> " + kept)) << summary(session.recording(), i, false);
      const Explanation e = explain(session.recording(), session.frame(), false);
      EXPECT_NE(e.title.find(all == kept ? "whole" : " " + kept), std::string::npos) << e.title;
      EXPECT_NE(e.text.find(all), std::string::npos) << e.text;
    }
  }
}

TEST_F(Newcomer, IsToldWhereTwoRunsReallyPart) {
  app.open_gallery("boolean-hit-3d");
  Method other;
  other.name = MethodName::gjk;
  ASSERT_EQ(session.compare_with(other, "gjk"), "");
  EXPECT_FALSE(session.unlike());
  ASSERT_TRUE(session.parting());
  EXPECT_NE(parting_text(session).find("supports are the same"), std::string::npos) << parting_text(session);
  app.open_gallery("box-box-deep");
  Recording without = session.recording();
  for (Event& event : without.events)
    if (auto* cut = std::get_if<recorded::SimplexReduced>(&event)) cut->barycentric.clear(), cut->upper_bound = NAN;
  session.compare_with(without, "without bounds");
  EXPECT_FALSE(session.parting()) << "that one tells no bounds is no parting";
  EXPECT_EQ(parting_text(session), "the same in what both compute, step by step");
  other.name = MethodName::sat;
  ASSERT_EQ(session.compare_with(other, "sat"), "");
  EXPECT_TRUE(session.unlike());
  EXPECT_FALSE(session.parting());
  EXPECT_TRUE(parting_text(session).starts_with("two algorithms")) << parting_text(session);
  Method steps;
  steps.max_iterations = 2;
  ASSERT_EQ(session.compare_with(steps, "two steps"), "");
  EXPECT_NE(parting_text(session).find("\"support\" here, \"end\" beside"), std::string::npos) << parting_text(session);
  host.frame();
}

TEST_F(Newcomer, GoesToTheEndOfTheLongerRun) {
  SceneFile next = session.scene();
  next.method.max_iterations = 2;
  ASSERT_EQ(session.edit(next), "");
  ASSERT_EQ(session.compare_with(Method{}, "to the end"), "");
  const std::size_t here = session.count(), beside = session.other().events.size();
  ASSERT_LT(here, beside);
  EXPECT_TRUE(ending_text(session).starts_with("it goes on for " + std::to_string(beside - here) + " steps")) << ending_text(session);
  session.swap_compared("two steps");
  ASSERT_TRUE(session.comparing());
  EXPECT_EQ(session.count(), beside);
  EXPECT_EQ(session.other().events.size(), here);
  EXPECT_EQ(session.other_title(), "two steps");
  session.go_to(beside - 1);
  EXPECT_EQ(ending_text(session), "it has ended, at step " + std::to_string(here - 1));
  host.frame();
  session.undo();
  EXPECT_EQ(session.count(), here);
  // A recording of another scene changes places with this one.
  app.compare_or_throw(std::string(GJKDBG_GALLERY) + "/box-box-apart.scene.json");
  session.swap_compared("deep");
  EXPECT_EQ(session.title(), "box-box-apart");
  EXPECT_EQ(session.other_title(), "deep");
}

/// The words of a scene are of its bodies as they were.
TEST_F(Newcomer, IsNotToldAnEditedSceneByItsOldWords) {
  const std::string words = session.scene().scene.description;
  SceneFile next = session.scene();
  next.method.closest_point = ClosestPoint::johnson;
  ASSERT_EQ(session.edit(next), "");
  EXPECT_EQ(session.scene_to_keep().scene.description, words) << "which do not speak of the method";
  next.scene.bodies[1].pose.position[0] += 5;
  ASSERT_EQ(session.edit(next), "");
  EXPECT_EQ(session.scene_to_keep().scene.description, "edited, from: " + words);
  session.open(session.scene_to_keep(), "again");
  next = session.scene();
  next.scene.bodies[1].pose.position[0] += 1;
  ASSERT_EQ(session.edit(next), "");
  EXPECT_EQ(session.scene_to_keep().scene.description, "edited, from: " + words) << "once is enough";
}

TEST_F(Newcomer, ReadsOfEndpointsOnALine) {
  app.open_gallery("1d-overlap");
  for (std::size_t i = 0; i < session.count(); ++i) {
    session.go_to(i);
    const Explanation e = explain(session.recording(), session.frame());
    EXPECT_EQ((e.title + e.text + summary(session.recording(), i)).find(" face"), std::string::npos) << e.title << ": " << e.text;
    EXPECT_TRUE(!kind_at<recorded::FaceChosen>(session, i) || e.text.starts_with("Endpoint ")) << e.text;
  }
}

TEST_F(Newcomer, FindsTheWayBackFromALook) {
  session.go_to(7), session.toggle_breakpoint();
  SceneFile next = session.scene();
  next.scene.bodies[1].pose.position[0] += 0.01;
  ASSERT_EQ(session.edit(next), "");
  const std::size_t step = session.step();
  const SceneFile look = read_scene(app.gallery().file("box-box-apart")), another = read_scene(app.gallery().file("2d-deep"));
  session.open_for_a_look(look, "a look");
  session.open_for_a_look(another, "another");
  ASSERT_TRUE(session.waiting_title());
  EXPECT_EQ(*session.waiting_title(), "box-box-deep");
  host.frame(), host.frame();
  session.take_up_again();
  host.frame();
  EXPECT_EQ(session.title(), "box-box-deep");
  EXPECT_EQ(session.step(), step);
  EXPECT_EQ(session.scene().scene.bodies[1].pose.position[0], next.scene.bodies[1].pose.position[0]);
  EXPECT_TRUE(session.breakpoints.contains(7) && session.can_undo() && !session.waiting_title());
  session.open_for_a_look(look, "a look");
  app.open_gallery("2d-deep");
  EXPECT_FALSE(session.waiting_title()) << "what is opened is all there is";
}

}  // namespace
}  // namespace gjkdbg
