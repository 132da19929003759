// Casts of every kind of depth, and the one beginning and end that a cast has.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "recordings/check.h"
#include "recordings/gallery.h"
#include "recordings/recording.h"

namespace gjkdbg {
namespace {

constexpr std::array casting_methods{MethodName::conservative_advancement, MethodName::root_finding, MethodName::ray_cast};

/// In each dimension two bodies that overlap at the beginning, and two that meet.
std::string two_bodies(int dimension, bool overlapping) {
  const std::string at = overlapping ? "0.7" : "3";
  const char* box = dimension == 1 ? R"({"type": "interval", "min": -1, "max": 1})" : dimension == 2 ? R"({"type": "box", "half_extents": [1, 1.5]})" : R"({"type": "box", "half_extents": [1, 1.5, 2]})";
  const char* round = dimension == 1 ? R"({"type": "interval", "min": -0.5, "max": 0.25, "margin": 0.5})" : dimension == 2 ? R"({"type": "ellipse", "radii": [1, 0.5]})" : R"({"type": "cone", "radius": 1, "half_height": 0.5})";
  const std::string rest = dimension == 1 ? "" : dimension == 2 ? ", 0.2" : ", 0.2, 0.1";
  return R"({"format": "gjk-scene", "version": 1, "dimension": )" + std::to_string(dimension) + R"(, "query": "cast", "bodies": [{"shape": )" + box + R"(, "velocity": [4)" +
         (dimension == 1 ? "" : dimension == 2 ? ", 0" : ", 0, 0") + R"(]}, {"shape": )" + round + R"(, "pose": {"position": [)" + at + rest + "]}}]}";
}

template <class E>
std::size_t count(const Recording& recording) {
  return static_cast<std::size_t>(std::count_if(recording.events.begin(), recording.events.end(), [](const Event& event) { return std::holds_alternative<E>(event); }));
}

std::string findings_in(const Recording& recording) {
  std::string out;
  for (const Finding& f : check(recording)) out += std::to_string(f.step) + " " + f.code + ": " + f.message + "\n";
  return out;
}

Recording cast_of(const std::string& text, MethodName method, Penetration penetration) {
  SceneFile scene = parse_scene(text, {});
  scene.method.name = method, scene.method.penetration = penetration;
  return record(scene);
}

TEST(CheckCast, AnOverlapAtTheBeginningIsToldByEveryKindOfDepth) {
  for (const int dimension : {1, 2, 3})
    for (const MethodName method : casting_methods)
      for (const Penetration penetration : {Penetration::epa, Penetration::mpr, Penetration::none}) {
        const Recording recording = cast_of(two_bodies(dimension, true), method, penetration);
        const Result& r = recording.result;
        const std::string of = std::to_string(dimension) + " " + std::string(word_of(method)) + " " + std::string(word_of(penetration));
        EXPECT_EQ(r.status, "initially_overlapping") << of;
        EXPECT_TRUE(r.intersecting && r.time == 0.0 && r.touching_at == 0.0 && r.pair) << of;
        EXPECT_EQ(r.normal.has_value(), penetration != Penetration::none) << of;
        EXPECT_EQ(r.witness_a.has_value(), penetration != Penetration::none) << of;
        EXPECT_EQ(count<recorded::Warning>(recording), penetration == Penetration::none ? 1u : 0u) << of;
        EXPECT_EQ(findings_in(recording), "") << of;
      }
}

TEST(CheckCast, BodiesThatMeetNeedNoDepth) {
  for (const int dimension : {1, 2, 3})
    for (const MethodName method : casting_methods) {
      const Result right = cast_of(two_bodies(dimension, false), method, Penetration::epa).result;
      for (const Penetration penetration : {Penetration::mpr, Penetration::none}) {
        const Recording recording = cast_of(two_bodies(dimension, false), method, penetration);
        EXPECT_EQ(recording.result.status, "hit");
        EXPECT_EQ(recording.result.time, right.time);
        EXPECT_EQ(recording.result.normal, right.normal);
        EXPECT_EQ(findings_in(recording), "");
      }
    }
}

/// "Every phase that begins ends in exactly one ..._ended": a response is no end.
TEST(CheckCast, BeginsAndEndsOnce) {
  for (const char* scene : {"cast-bounce", "cast-ghost", "cast-corner-caught", "cast-many-bodies"})
    for (const MethodName method : casting_methods) {
      SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file(scene));
      file.method.name = method;
      Recording recording = record(file);
      EXPECT_EQ(count<recorded::CastBegan>(recording), 1u) << scene;
      EXPECT_EQ(count<recorded::CastEnded>(recording), 1u) << scene;
      EXPECT_EQ(findings_in(recording), "") << scene;
      const auto state = std::find_if(recording.events.begin(), recording.events.end(), [](const Event& event) { return std::holds_alternative<recorded::State>(event); });
      if (state == recording.events.end()) continue;
      recording.events.insert(state + 1, recording.events.front());
      EXPECT_NE(findings_in(recording).find("incomplete-trace: The cast begins a second time"), std::string::npos) << scene;
    }
}

}  // namespace
}  // namespace gjkdbg
