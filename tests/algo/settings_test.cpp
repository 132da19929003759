// What a method is where the scene does not say: the defaults that recordings/README.md promises.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/solve.h"
#include "recordings/scene_file.h"

namespace gjkdbg {
namespace {

const std::string box = R"({"type": "box", "half_extents": [1, 1, 1]})", rounded_box = R"({"type": "box", "half_extents": [1, 1, 1], "margin": 0.1})",
                  cone = R"({"type": "cone", "radius": 1, "half_height": 1})", ball = R"({"type": "sphere", "radius": 1})";

Settings settings_of(const std::string& first, const std::string& second, const std::string& method = "{}", const std::string& query = "penetration") {
  const std::string moves = query == "cast" ? R"(, "velocity": [1, 0, 0])" : "";
  const SceneFile file = parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": ")" + query + R"(", "method": )" + method + R"(, "bodies": [{"shape": )" + first + moves +
                                         R"(}, {"shape": )" + second + R"(, "pose": {"position": [5, 0, 0]}}]})", {});
  return resolve_settings(file.method, file.scene);
}

TEST(Settings, ToleranceGoesByTheShapesAndThePrecision) {
  const std::string single = R"({"scalar": "float"})";
  for (const std::string& polytope : {box, rounded_box, ball}) {
    EXPECT_EQ(settings_of(box, polytope).tolerance, 1e-12) << polytope;
    EXPECT_EQ(settings_of(box, polytope, single).tolerance, 1e-6) << polytope;
  }
  const std::string sum = R"({"type": "sum", "of": [)" + ball + ", " + cone + "]}";
  for (const std::string& round : {cone, sum}) {
    EXPECT_EQ(settings_of(box, round).tolerance, 1e-10) << round;
    EXPECT_EQ(settings_of(round, box, single).tolerance, 1e-4) << round;
  }
  EXPECT_EQ(settings_of(box, cone, "{}", "cast").tolerance, 1e-9);
  EXPECT_EQ(settings_of(box, cone, single, "cast").tolerance, 1e-5);
  EXPECT_EQ(settings_of(box, cone, R"({"tolerance": 0.25})").tolerance, 0.25);
}

TEST(Settings, TheRestIsGjkWithEpaAndItsLimitGrowsWithTheCorners) {
  const Settings plain = settings_of(box, cone);
  EXPECT_EQ(plain.name, MethodName::gjk);
  EXPECT_EQ(plain.closest_point, ClosestPoint::signed_volumes);
  EXPECT_EQ(plain.penetration, Penetration::epa);
  EXPECT_EQ(plain.scalar, Scalar::double_precision);
  EXPECT_EQ(plain.stopping, Stopping::bounds);
  EXPECT_EQ(plain.start, gjkdbg::Start::centres);
  EXPECT_EQ(plain.max_iterations, 512);
  EXPECT_EQ(settings_of(box, cone, R"({"name": "mpr"})").penetration, Penetration::mpr);
  EXPECT_EQ(settings_of(box, cone, R"({"initial_direction": [0, 1, 0]})").start, gjkdbg::Start::given);
  EXPECT_EQ(settings_of(box, cone, "{}", "cast").name, MethodName::conservative_advancement);
  const auto corners = [](int count) {
    std::string points;
    for (int i = 0; i < count; ++i) {
      const double z = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - z * z), turn = 2.4 * i;
      points += (points.empty() ? "[" : ", [") + std::to_string(r * std::cos(turn)) + ", " + std::to_string(r * std::sin(turn)) + ", " + std::to_string(z) + "]";
    }
    return R"({"type": "hull", "points": [)" + points + "]}";
  };
  EXPECT_EQ(settings_of(corners(64), corners(64)).max_iterations, 512);
  EXPECT_EQ(settings_of(corners(150), corners(50)).max_iterations, 800);
  EXPECT_EQ(settings_of(corners(150), cone).max_iterations, 64 * 150);
  EXPECT_EQ(settings_of(cone, cone).max_iterations, 512);
}

}  // namespace
}  // namespace gjkdbg
