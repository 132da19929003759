// A right implementation has no findings, whatever it is asked.
#include "recordings/check.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "recordings/gallery.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

std::string text(const std::vector<Finding>& findings) {
  std::string out;
  for (const Finding& f : findings) out += std::to_string(f.step) + " " + f.code + ": " + f.message + "\n";
  return out;
}

TEST(Check, OurOwnRecordingsOfTheGalleryAreClean) {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  for (const Lesson& lesson : gallery.lessons)
    for (const std::string& name : lesson.scenes)
      for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision})
        for (const bool boolean : {false, true}) {
          SceneFile scene = read_scene(gallery.file(name));
          scene.method.scalar = scalar;
          if (boolean && scene.scene.motion) continue;
          if (boolean) change_name(scene.method, MethodName::gjk_boolean), scene.scene.query = Query::intersect;
          EXPECT_EQ(text(check(record(scene))), "") << name << (boolean ? " boolean" : "") << (scalar == Scalar::double_precision ? "" : " float");
        }
}

TEST(Check, PointsOutASceneThatAsksForMoreThanItReads) {
  SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep"));
  EXPECT_EQ(text(check(record(file))), "");
  file.expect = Expectation{true, {}, {}, 1e-9};
  EXPECT_NE(text(check(record(file))).find("asks-too-much"), std::string::npos);
  file.scene.query = Query::intersect;
  EXPECT_EQ(text(check(record(file))), "");
}

TEST(Check, OurOwnRecordingsOfRandomScenesAreClean) {
  RandomScenes random(21);
  const int count = std::getenv("GJKDBG_PAIRS") ? 200 : 2000;
  for (int k = 0; k < count; ++k) {
    SceneFile file;
    file.scene = random.scene(1 + k % 3, static_cast<Family>(k / 3 % family_count), k % 2 == 0);
    file.scene.query = static_cast<Query>(k % 4);
    file.method.closest_point = static_cast<ClosestPoint>(k / 7 % 3);
    if (k / 5 % 3 == 0) file.method.name = MethodName::gjk_accelerated;
    if (file.scene.query == Query::intersect && k % 8 < 4) file.method.name = MethodName::gjk_boolean;
    if (k % 11 == 0) file.method.name = MethodName::mpr;
    if (k % 13 == 0 && k % 2 == 0) file.method.name = MethodName::sat;
    EXPECT_EQ(text(check(record(file))), "") << "scene " << k;
    if (testing::Test::HasFailure()) break;
  }
}

}  // namespace
}  // namespace gjkdbg
