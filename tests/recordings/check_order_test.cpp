// Steps of our own recordings that are doubled or left out.
#include <gtest/gtest.h>

#include "recordings/check.h"
#include "recordings/gallery.h"

namespace gjkdbg {
namespace {

Recording recorded_by(const char* scene, MethodName method) {
  SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file(scene));
  change_name(file.method, method);
  return record(file);
}

class CheckOrder : public testing::TestWithParam<std::pair<const char*, MethodName>> {};

TEST_P(CheckOrder, AStepTooManyIsFound) {
  const Recording right = recorded_by(GetParam().first, GetParam().second);
  EXPECT_TRUE(check(right).empty());
  for (std::size_t i = 0; i < right.events.size(); ++i) {
    Recording wrong = right;
    wrong.events.insert(wrong.events.begin() + static_cast<std::ptrdiff_t>(i), right.events[i]);
    EXPECT_FALSE(check(wrong).empty()) << i << " " << kind_name(right.events[i]);
  }
}

/// Some need not be there: a simplex may end the run or not, a portal or a guess may be the last or not.
TEST_P(CheckOrder, AStepTooFewIsFound) {
  const Recording right = recorded_by(GetParam().first, GetParam().second);
  for (std::size_t i = 0; i < right.events.size(); ++i) {
    const std::string_view kind = kind_name(right.events[i]);
    const bool last = i + 1 < right.events.size() && kind_name(right.events[i + 1]).ends_with("_ended");
    if (kind == "portal_found" || kind == "point_predicted" || (kind == "simplex_reduced" && last)) continue;
    Recording wrong = right;
    wrong.events.erase(wrong.events.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(check(wrong).empty()) << i << " " << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, CheckOrder,
                         testing::Values(std::pair("box-box-deep", MethodName::gjk), std::pair("box-box-deep", MethodName::mpr), std::pair("box-box-deep", MethodName::sat),
                                         std::pair("2d-squares-apart", MethodName::gjk), std::pair("boolean-hit-3d", MethodName::gjk_boolean),
                                         std::pair("pair-capsule-cone", MethodName::projections), std::pair("cast-rotating-rod", MethodName::gjk)),
                         [](const auto& tested) { return std::to_string(tested.index) + "_" + std::string(kind_name(recorded_by(tested.param.first, tested.param.second).events.front())); });

}  // namespace
}  // namespace gjkdbg
