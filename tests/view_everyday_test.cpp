// What is done every day: a step looked for, names read off the picture, a chart's dot looked at and left again.
#include <gtest/gtest.h>

#include <imgui_internal.h>

#include <cmath>
#include <set>

#include "debugger/view/explain.h"
#include "debugger/view/plot.h"
#include "debugger/view/wrong_step.h"
#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

class Everyday : public Window {};

TEST_F(Everyday, TypingFindsAndTheKeysStepOnBesideTheBar) {
  app.open_gallery("box-box-apart");
  host.frame();
  host.press(Key::f, false, true);
  host.frame();
  host.type("drop");
  host.frame();
  EXPECT_EQ(session.step(), 6u) << "without Enter";
  host.press(Key::f3);
  EXPECT_TRUE(app.finding());
  host.press(Key::enter);
  EXPECT_TRUE(app.finding());
  const std::size_t found = session.step();
  host.press(Key::right);
  EXPECT_EQ(session.step(), found + 1) << "the bar is open, and the keys are the steps' again";
  host.press(Key::enter);
  EXPECT_EQ(session.step(), *find_text(session, "drop", found + 1, false));
  host.press(Key::home);
  EXPECT_EQ(session.step(), 0u);
  host.press(Key::space);
  EXPECT_TRUE(session.playing);
  host.press(Key::space);
  host.press(Key::escape);
  EXPECT_FALSE(app.finding());
}

/// After Return letters still are the text's, not keys; until something else is clicked on.
TEST_F(Everyday, TypingGoesOnAfterReturn) {
  const auto letter = [&](char c, Key key) {
    ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(c));
    host.press(key);
  };
  const auto text = [] {
    const ImGuiInputTextState& field = ImGui::GetCurrentContext()->InputTextState;
    std::string all;
    for (int i = 0; i < field.CurLenW; ++i) all += static_cast<char>(field.TextW[i]);
    return all;
  };
  host.press(Key::f, false, true);
  host.frame();
  host.type("grow");
  host.press(Key::enter);
  const bool dark = app.preferences.dark;
  letter('b', Key::b), letter('t', Key::t);
  host.frame(), host.frame();
  EXPECT_TRUE(session.breakpoints.empty());
  EXPECT_EQ(app.preferences.dark, dark);
  EXPECT_TRUE(ImGui::GetIO().WantTextInput);
  EXPECT_EQ(text(), "growbt");
  host.type("x");
  EXPECT_EQ(text(), "growbtx");
  host.click(620, 612);  // the scrubber
  letter('b', Key::b);
  EXPECT_FALSE(session.breakpoints.empty());
}

TEST_F(Everyday, AConditionThatIsNotFinishedIsNoMistake) {
  app.open_gallery("box-box-apart");
  session.go_to(3);
  host.press(Key::f, false, true);
  host.frame();
  host.type("upper_bound <");
  host.frame();
  EXPECT_EQ(session.step(), 3u);
  EXPECT_TRUE(app.message.empty());
  host.type(" 1e9");
  host.frame();
  EXPECT_EQ(session.step(), *find_text(session, "upper_bound < 1e9", 2, false));
  host.press(Key::escape);
  host.frame();
  EXPECT_FALSE(app.finding());
  host.press(Key::f3, true);
  EXPECT_EQ(session.step(), *find_text(session, "upper_bound < 1e9", *find_text(session, "upper_bound < 1e9", 2, false), true));
}

/// A window beside, not before the others.
TEST_F(Everyday, TheRestCanBeClickedWhileTheBarIsOpen) {
  host.press(Key::f, false, true);
  host.frame();
  host.click(620, 612);  // the scrubber
  EXPECT_GT(session.step(), session.count() / 4);
  EXPECT_TRUE(app.finding());
}

TEST_F(Everyday, BackFromAChartsDotTheComparisonIsThere) {
  Method sat;
  sat.name = MethodName::sat;
  ASSERT_EQ(session.compare_with(sat, "sat"), "");
  session.loop_from = 2, session.loop_to = 5;
  const std::size_t beside = session.other().events.size();
  session.go_to(4);
  open_measured(app, read_scene(app.gallery().file("2d-deep")), "families-1");
  ASSERT_EQ(session.title(), "families-1");
  EXPECT_FALSE(session.comparing());
  host.frame();
  session.take_up_again();
  host.frame();
  EXPECT_EQ(session.step(), 4u);
  ASSERT_TRUE(session.comparing());
  EXPECT_EQ(session.other().events.size(), beside);
  EXPECT_EQ(session.other_title(), "sat");
  EXPECT_EQ(session.loop_to, std::optional<std::size_t>(5));
  SceneFile next = session.scene();
  next.scene.bodies[1].pose.position[0] += 0.1;
  EXPECT_EQ(session.edit(next), "");
  EXPECT_TRUE(session.comparing()) << "and it is solved again with every edit";
}

/// What lies in one place has its rings side by side, wherever the others are pushed.
TEST_F(Everyday, RingsOfConcentricBodiesAreApart) {
  const Projection projection(Camera{}, {0, 0, 400, 300});
  for (const double scale : {1.0, 2.0})
    for (const double off : {0.0, 1e-6, 0.01, 0.05}) {
      const std::vector<ViewPoint> middles{ViewPoint::Zero(), {off, 0, 0}, {0, off, 0}, {-off, off, 0}, {3 * off, 0, 0}};
      const auto handles = place_handles(middles, projection, scale);
      for (std::size_t i = 0; i < handles.size(); ++i)
        for (std::size_t k = 0; k < handles.size(); ++k) {
          const Projected p = projection(handles[i].ring), q = projection(handles[k].ring), d = projection(handles[k].disc);
          if (i != k) {
            EXPECT_GT(std::hypot(p.x - q.x, p.y - q.y), 2 * handle_radius * scale) << i << " " << k << " " << off;
          }
          EXPECT_GT(std::hypot(p.x - d.x, p.y - d.y), handle_radius * scale) << i << " " << k << " " << off;
        }
    }
}

/// Those of a stack that is small in the picture keep its order.
TEST_F(Everyday, LettersOfAStackKeepTheirOrder) {
  Camera far;
  far.radius = 20, far.flat = true;
  const Projection projection(far, {0, 0, 400, 300});
  std::vector<ViewPoint> middles;
  for (int i = 0; i < 6; ++i) middles.emplace_back(i % 2 == 0 ? 0.02 : -0.02, i, 0);
  const auto handles = place_handles(middles, projection, 1);
  for (std::size_t i = 0; i + 1 < handles.size(); ++i) EXPECT_GT(projection(handles[i].ring).y, projection(handles[i + 1].ring).y + handle_radius / 2) << i;
}

/// No label touches another, nor lies on the point it names, in any step of scenes where much is close together, in small views, too.
TEST_F(Everyday, NamesDoNotTouch) {
  for (const char* scene : {"box-box-deep", "hulls-around-the-way-out", "2d-deep", "box-contact-patch"})
    for (const ViewRectangle view : {ViewRectangle{0, 0, 245, 165}, ViewRectangle{0, 0, 325, 445}}) {
      app.open_gallery(scene);
      int touching = 0;
      for (std::size_t k = 0; k < session.count(); ++k)
        for (const bool world : {true, false}) {
          session.go_to(k);
          const Projection projection(world ? fit_world(session.meshes(), session.recording()) : fit_difference(session.meshes(), session.recording()), view);
          std::vector<FlatItem> names;
          const auto items = flatten((world ? world_picture : difference_picture)(session.meshes(), session.recording(), session.frame(), ViewSettings{}, dark_palette, projection), projection);
          for (const FlatItem& item : items)
            if (item.kind == FlatItem::Kind::label && item.text.find_first_not_of("-.0123456789") != std::string::npos) names.push_back(item);
          for (std::size_t i = 0; i < names.size(); ++i)
            for (std::size_t j = i + 1; j < names.size(); ++j) {
              const Projected &p = names[i].points[0], &q = names[j].points[0];
              const bool meet = p.x < q.x + text_width(names[j].text, names[j].small) && q.x < p.x + text_width(names[i].text, names[i].small) && std::abs(p.y - q.y) < 13;
              touching += meet;
              EXPECT_FALSE(meet) << scene << " " << k << ": " << names[i].text << " and " << names[j].text;
            }
        }
      EXPECT_EQ(touching, 0);
    }
}

TEST_F(Everyday, TipsOfARowOfButtonsLieBelowIt) {
  host.move(261, 22);  // Measure
  host.frame(), host.frame(), host.frame();
  const ImGuiWindow* tip = nullptr;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (window->Active && (window->Flags & ImGuiWindowFlags_Tooltip) != 0) tip = window;
  ASSERT_TRUE(tip);
  EXPECT_GE(tip->Pos.y, 36);
}

/// As many digits as tell one from the other: in the panel's fields, at the axes, in sentences.
TEST_F(Everyday, PlacesFarOutAreToldApart) {
  SceneFile far = read_scene(app.gallery().file("2d-squares-apart"));
  for (Body& body : far.scene.bodies) body.pose.position[0] += 1e5;
  far.expect.reset();
  session.open(far, "far");
  host.frame(), host.frame();
  EXPECT_GE(app.place_digits, 6);
  EXPECT_EQ(short_place(session.recording(), AnyVector(Eigen::Vector2d(100000.5, 1))), "(100000.5, 1)");
  const Projection projection(fit_world(session.meshes(), session.recording()), {0, 0, 320, 260});
  std::set<std::string> marks;
  std::size_t count = 0;
  for (const PictureLabel& mark : world_picture(session.meshes(), session.recording(), session.frame(), ViewSettings{}, dark_palette, projection).scale_marks) marks.insert(mark.text), ++count;
  EXPECT_GT(count, 3u);
  EXPECT_EQ(marks.size(), count) << "no number twice";
  session.open_for_a_look(read_scene(app.gallery().file("box-box-deep")), "near");
  host.frame(), host.frame();
  EXPECT_EQ(app.place_digits, 4);
}

TEST_F(Everyday, TipsOfArrowsAreInView) {
  for (const char* scene : {"1d-contained", "1d-overlap", "2d-dyn4j", "2d-corner-to-corner", "cone-rim-on-box", "identical-cubes", "mpr-apart", "mpr-box-box", "sat-2d-apart", "cast-ray", "cast-receding", "cast-ghost-cured"}) {
    app.open_gallery(scene);
    for (const ViewRectangle view : {ViewRectangle{0, 0, 245, 165}, ViewRectangle{0, 0, 325, 445}})
      for (const bool world : {true, false}) {
        const Projection projection(world ? fit_world(session.meshes(), session.recording()) : fit_difference(session.meshes(), session.recording()), view);
        for (std::size_t k = 0; k < session.count(); ++k) {
          session.go_to(k);
          for (const FlatItem& item : flatten((world ? world_picture : difference_picture)(session.meshes(), session.recording(), session.frame(), ViewSettings{}, dark_palette, projection), projection))
            if (item.arrow) {
              const Projected& tip = item.points[1];
              const double border = std::min({tip.x - view.x, view.x + view.width - tip.x, tip.y - view.y, view.y + view.height - tip.y});
              EXPECT_GT(border, 3) << border << " " << scene << " " << k << (world ? " world" : " difference");
            }
        }
      }
  }
}

/// MPR leaves by the portal on its ray: the first one that the shortest way out does not go through is where it is lost.
TEST_F(Everyday, OpensMprWhereItGoesWrong) {
  SceneFile deep = read_scene(app.gallery().file("mpr-2d-deep"));
  open_measured(app, deep, "atlas");
  ASSERT_TRUE(std::holds_alternative<recorded::PortalFound>(session.recording().events[session.step()]));
  EXPECT_LT(session.step() + 1, session.count());
  EXPECT_NE(app.notice.find("shortest way out"), std::string::npos);
  const Recording right = record(read_scene(app.gallery().file("mpr-box-box")));
  EXPECT_EQ(where_it_goes_wrong(right).has_value(), std::abs(*right.result.signed_distance - *record([&] { SceneFile s = right.scene; s.method = Method{}; return s; }()).result.signed_distance) > 1e-9);
}

}  // namespace
}  // namespace gjkdbg
