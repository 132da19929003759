// Steps of our own recordings that are doubled or left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <random>
#include <string>

#include "recordings/check.h"
#include "recordings/gallery.h"
#include "recordings/replay.h"

namespace gjkdbg {
namespace {

struct Run {
  std::string scene;
  MethodName method;
};

void PrintTo(const Run& run, std::ostream* out) { *out << run.scene << " by " << word_of(run.method); }

Recording recorded(const Run& run) {
  SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file(run.scene));
  change_name(file.method, run.method);
  return record(file);
}

class CheckOrder : public testing::TestWithParam<Run> {};

TEST_P(CheckOrder, AStepTooManyIsFound) {
  const Recording right = recorded(GetParam());
  EXPECT_TRUE(check(right).empty());
  for (std::size_t i = 0; i < right.events.size(); ++i) {
    Recording wrong = right;
    wrong.events.insert(wrong.events.begin() + static_cast<std::ptrdiff_t>(i), right.events[i]);
    EXPECT_FALSE(check(wrong).empty()) << i << " " << kind_name(right.events[i]);
  }
}

/// Some need not be there: a simplex may end the run or not, a portal or a guess may be the last or not.
TEST_P(CheckOrder, AStepTooFewIsFound) {
  const Recording right = recorded(GetParam());
  for (std::size_t i = 0; i < right.events.size(); ++i) {
    const std::string_view kind = kind_name(right.events[i]);
    const bool last = i + 1 < right.events.size() && kind_name(right.events[i + 1]).ends_with("_ended");
    if (kind == "portal_found" || kind == "point_predicted" || (kind == "simplex_reduced" && last)) continue;
    Recording wrong = right;
    wrong.events.erase(wrong.events.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(check(wrong).empty()) << i << " " << kind;
  }
}

/// Of whatever is left of a run, in whatever order, nothing is taken for granted that an earlier step would have told.
TEST_P(CheckOrder, AnyPartOfARunIsJudged) {
  const Recording right = recorded(GetParam());
  std::mt19937 random(3);
  for (int run = 0; run < 150; ++run) {
    Recording wrong = right;
    std::shuffle(wrong.events.begin(), wrong.events.end(), random);
    wrong.events.resize(1 + random() % std::min<std::size_t>(right.events.size(), 12));
    EXPECT_FALSE(check(wrong).empty()) << run;
    for (std::size_t step = 0; step < wrong.events.size(); ++step) frame_at(wrong, step);
  }
}

/// Steps of a motion in a scene where nothing moves, and the other way round: judged and shown all the same.
TEST(CheckOrder, StepsOfOtherScenesAreNamed) {
  std::vector<Recording> recordings;
  for (const char* scene : {"cast-bounce", "sim-slope-holds", "2d-squares-apart", "2d-deep"}) recordings.push_back(record(read_scene(read_gallery(GJKDBG_GALLERY).file(scene))));
  for (const Recording& scene : recordings)
    for (const Recording& other : recordings) {
      if (&scene == &other) continue;
      Recording mixed = scene;
      const auto begin = other.events.begin();
      mixed.events.insert(mixed.events.begin() + 2, begin, begin + static_cast<std::ptrdiff_t>(std::min<std::size_t>(40, other.events.size())));
      EXPECT_FALSE(check(mixed).empty());
      for (std::size_t step = 0; step < std::min<std::size_t>(60, mixed.events.size()); ++step) frame_at(mixed, step);
    }
}

/// Pairs of bodies that there are not, and a motion of one body.
TEST(CheckOrder, BodiesThatAreNotThereAreNamed) {
  Recording wrong = recorded({"cast-bounce", MethodName::gjk});
  for (Event& event : wrong.events) {
    if (auto* began = std::get_if<recorded::CastBegan>(&event)) began->pairs = {{7, 9}, {-1, 0}};
    if (auto* advanced = std::get_if<recorded::CastAdvanced>(&event)) advanced->pair = {7, 9};
  }
  EXPECT_FALSE(check(wrong).empty());
  for (std::size_t step = 0; step < wrong.events.size(); ++step) frame_at(wrong, step);
  EXPECT_TRUE(check(recorded({"sim-spinning-box", MethodName::gjk})).empty());
}

INSTANTIATE_TEST_SUITE_P(Of, CheckOrder,
                         testing::Values(Run{"box-box-deep", MethodName::gjk}, Run{"box-box-deep", MethodName::mpr}, Run{"box-box-deep", MethodName::sat}, Run{"2d-squares-apart", MethodName::gjk},
                                         Run{"boolean-hit-3d", MethodName::gjk_boolean}, Run{"pair-capsule-cone", MethodName::projections}, Run{"cast-rotating-rod", MethodName::gjk}));

}  // namespace
}  // namespace gjkdbg
