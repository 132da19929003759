// Charts and the atlas in the window: opened from files, told by pointing, opened at the worst scene by clicking.
#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>

#include "debugger/view/measurements.h"
#include "shapes/error.h"
#include "tests/support/window_fixture.h"

namespace gjkdbg {
namespace {

constexpr const char* scene_text = R"({"format": "gjk-scene", "version": 1, "name": "worst", "dimension": 3, "query": "penetration", "bodies": [
  {"name": "A", "shape": {"type": "box", "half_extents": [1, 1, 1]}}, {"name": "B", "shape": {"type": "box", "half_extents": [1, 1, 1]}, "pose": {"position": [1.5, 0.25, 0]}}]})";

class Lab : public Window {
 protected:
  Lab() : folder(std::filesystem::temp_directory_path() / ("gjkdbg-lab-test-" + std::to_string(getpid()))) { std::filesystem::create_directories(folder); }
  ~Lab() override { std::filesystem::remove_all(folder); }

  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  std::filesystem::path chart() {
    return write("chart.json", std::string(R"({"format": "gjk-chart", "version": 1, "methods": {"Johnson": {"name": "gjk", "closest_point": "johnson"}}, "families": [
      {"name": "boxes", "title": "boxes", "pairs": 4, "scenes": {"3": )") + scene_text + R"(}, "points": [
        {"method": "Johnson", "tolerance": 1e-6, "nanoseconds": 500, "worst_error": 1e-8, "wrong": 0, "front": true, "worst_pair": 3},
        {"method": "FCL", "tolerance": 1e-6, "nanoseconds": 5000, "worst_error": 0, "wrong": 1, "front": false, "worst_pair": 2}]}],
      "price": [{"what": "spheres", "nanoseconds": 90, "worst_error": 0, "supports": 2}, {"what": "the same as hulls", "nanoseconds": 500, "worst_error": 0.1, "supports": 5}],
      "ladder": [{"shapes": "ellipsoids", "distance": 0.001, "method": "plain", "iterations": 18, "deviation": 2, "nanoseconds": 900, "published": {"iterations": 16, "deviation": 5}},
                 {"shapes": "hulls of 33", "distance": 0.001, "method": "Newton", "iterations": 8, "deviation": 1, "nanoseconds": 800, "vertices": 33, "published_nanoseconds": 800}],
      "motion": [{"family": "free box", "method": "rk4", "parameter": 0.01, "nanoseconds": 234, "worst_error": 1e-9}]})");
  }
  std::filesystem::path atlas() {
    return write("atlas.json", std::string(R"({"format": "gjk-atlas", "version": 1, "families": [{"name": "K1", "what": "cubes kiss", "cells": [
      {"method": "signed volumes", "verdict": "right", "worst_error": 0, "parameter": 1},
      {"method": "MPR", "verdict": "wrong-value", "worst_error": 0.5, "parameter": 1, "why": "MPR is off", "scene": )") + scene_text + "}]}]}");
  }
  /// Clicks over the panel until another scene is open; false when none opens.
  bool click_until_open(float x0, float y0, float x1, float y1, float step) {
    const std::string before = session.title();
    for (float y = y0; y < y1; y += step)
      for (float x = x0; x < x1; x += step) {
        host.click(x, y);
        if (session.title() != before) return true;
      }
    return false;
  }

  std::filesystem::path folder;
};

TEST_F(Lab, TheKeyAndTheButtonsShowIt) {
  const Image scene = host.image();
  host.press(Key::x);
  EXPECT_TRUE(app.show_lab);
  host.frame();
  EXPECT_NE(host.image().rgb, scene.rgb);
  host.click(423, 78);  // Measure now
  EXPECT_EQ(app.measure_requested, "chart");
  app.measure_requested.clear();
  host.click(270, 78);
  EXPECT_EQ(app.lab_tab, App::LabTab::atlas);
  host.click(423, 78);
  EXPECT_EQ(app.measure_requested, "atlas");
  host.click(1190, 78);  // Back to the scene
  EXPECT_FALSE(app.show_lab);
  host.press(Key::x);
  host.press(Key::escape);
  EXPECT_FALSE(app.show_lab);
  EXPECT_EQ(session.title(), "box-box-deep");
}

TEST_F(Lab, ADotOpensItsWorstPairWithItsMethodAndTolerance) {
  app.open(chart());
  ASSERT_TRUE(app.message.empty()) << app.message;
  EXPECT_TRUE(app.show_lab);
  host.frame(), host.frame();
  ASSERT_TRUE(click_until_open(670, 540, 710, 600, 8));  // about where 1e-8 and 500 ns stand
  EXPECT_EQ(session.title(), "boxes-3");
  EXPECT_FALSE(app.show_lab);
  EXPECT_EQ(session.recording().settings.closest_point, ClosestPoint::johnson);
  EXPECT_DOUBLE_EQ(session.recording().settings.tolerance, 1e-6);
  host.frame();
  host.click(1000, 77);  // "Back to the chart"
  EXPECT_TRUE(app.show_lab);
  app.show_lab = false;
  host.frame();
  host.click(1150, 77);  // "Back to box-box-deep"
  EXPECT_EQ(session.title(), "box-box-deep");
}

TEST_F(Lab, AllOfAChartIsShown) {
  app.open(chart());
  ASSERT_TRUE(app.message.empty()) << app.message;
  ASSERT_EQ(app.measured.chart->ladder.size(), 2u);
  EXPECT_EQ(app.measured.chart->ladder[0].published, 16);
  EXPECT_EQ(app.measured.chart->ladder[1].published_nanoseconds, 800);
  EXPECT_EQ(app.measured.chart->price.size(), 2u);
  EXPECT_EQ(app.measured.chart->motion.size(), 1u);
  std::vector<Image> pictures;
  for (const auto& [x, view] : {std::pair(40.f, App::ChartView::error), {118, App::ChartView::gap}, {206, App::ChartView::iterations}, {311, App::ChartView::price}, {408, App::ChartView::motion}}) {
    host.click(x, 107);
    EXPECT_EQ(app.chart_view, view);
    host.move(2, 2);
    host.frame(), host.frame();
    for (const Image& other : pictures) EXPECT_NE(host.image().rgb, other.rgb);
    pictures.push_back(host.image());
  }
  // Where something is pointed at, it is told: on the way down from the top over the one dot of a line.
  for (const auto& [view, x] : {std::pair(App::ChartView::iterations, 209.f), {App::ChartView::motion, 638.f}}) {
    app.chart_view = view;
    host.move(2, 2);
    host.frame(), host.frame();
    const Image before = host.image();
    int told = 0;
    for (float y = 200; y < 780; y += 10) {
      host.move(x, y);
      told += host.image().rgb != before.rgb;
    }
    EXPECT_GT(told, 0);
    EXPECT_LT(told, 8);
  }
}

TEST_F(Lab, AChartOfSomeFamiliesHasNoMore) {
  app.open(write("chart.json", R"({"format": "gjk-chart", "version": 1, "families": []})"));
  ASSERT_TRUE(app.message.empty()) << app.message;
  for (const App::ChartView view : {App::ChartView::error, App::ChartView::gap, App::ChartView::iterations, App::ChartView::price, App::ChartView::motion}) {
    app.chart_view = view;
    host.frame(), host.frame();
    EXPECT_TRUE(app.message.empty());
  }
  app.open(write("broken.json", R"({"format": "gjk-chart", "version": 1, "families": [], "price": [{"what": "spheres", "nanoseconds": 0}]})"));
  EXPECT_NE(app.message.find("/price/0/nanoseconds"), std::string::npos) << app.message;
}

TEST_F(Lab, ACellOpensTheSceneThatFails) {
  app.open(atlas());
  ASSERT_TRUE(app.message.empty()) << app.message;
  EXPECT_EQ(app.lab_tab, App::LabTab::atlas);
  host.frame(), host.frame();
  ASSERT_TRUE(click_until_open(190, 170, 200, 300, 8));
  EXPECT_EQ(session.title(), "K1, MPR");
  EXPECT_TRUE(session.step() + 1 == session.count() || !session.findings().empty());
}

TEST_F(Lab, TellsWhatIsPointedAt) {
  app.open(atlas());
  ASSERT_TRUE(app.show_lab) << app.message;
  host.frame(), host.frame();
  const Image before = host.image();
  int told = 0;
  for (float y = 170; y < 260; y += 10) {
    host.move(200, y);
    host.frame();
    told += host.image().rgb != before.rgb;
  }
  EXPECT_GT(told, 2);
}

TEST_F(Lab, AFileThatIsBrokenSaysWhereAndLeavesWhatWas) {
  app.open(chart());
  std::string text = R"({"format": "gjk-chart", "version": 1, "families": [{"name": "boxes", "title": "boxes", "pairs": 4, "points": [{"method": "Johnson", "tolerance": 1e-6, "nanoseconds": "fast"}]}]})";
  app.open(write("broken.json", text));
  EXPECT_NE(app.message.find("/families/0/points/0/nanoseconds"), std::string::npos) << app.message;
  ASSERT_TRUE(app.measured.chart);
  EXPECT_EQ(app.measured.chart->families.size(), 1u);
  EXPECT_EQ(session.title(), "box-box-deep");
  app.open(write("torn.json", text.substr(0, 90)));
  EXPECT_NE(app.message.find("torn.json"), std::string::npos) << app.message;
}

TEST(LabSizes, FitASmallWindowAndALargeScale) {
  for (const auto& [width, height, scale] : {std::tuple(800, 520, 1.f), {1600, 1000, 2.f}}) {
    Headless host(width, height, scale, read_gallery(GJKDBG_GALLERY));
    host.app().open_gallery("box-box-deep");
    for (const App::LabTab tab : {App::LabTab::chart, App::LabTab::atlas}) {
      host.app().show_lab = true, host.app().lab_tab = tab;
      host.frame(), host.frame();
      EXPECT_TRUE(host.app().message.empty());
    }
  }
}

}  // namespace
}  // namespace gjkdbg
