// Bodies that next to nothing keeps from turning: lines, and bodies so small that their inertia is no number to divide by.
#include <gtest/gtest.h>

#include <cmath>

#include "algo/motion.h"
#include "recordings/check.h"
#include "recordings/recording.h"
#include "recordings/scene_file.h"

namespace gjkdbg {
namespace {

SceneFile turning(int dimension, const std::string& integrator, const std::string& bodies) {
  return parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": )" + std::to_string(dimension) + R"(, "query": "simulate", "steps": 20, "time_step": 0.1, "integrator": ")" + integrator +
                         R"(", "bodies": [)" + bodies + "]}",
                     {});
}

const std::vector<std::string> integrators{"explicit-euler", "semi-implicit-euler", "rk4"};

/// A line stays square to its angular momentum, however it lies in its body.
TEST(Turning, ALineKeepsItsAngularMomentum) {
  for (const std::string& integrator : integrators)
    for (const std::string shape : {R"({"type": "segment", "points": [[-1, 0, 0], [1, 0, 0]]})", R"({"type": "segment", "points": [[-1, -1, 0], [1, 1, 0]]})",
                                    R"({"type": "segment", "points": [[0, -1, 0.3], [0.2, 1, 1]]})", R"({"type": "cylinder", "radius": 0, "half_height": 1})",
                                    R"({"type": "capsule", "radius": 0, "half_height": 1, "axis": "z"})", R"({"type": "hull", "points": [[-1, -1, 0], [0, 0, 0], [1, 1, 0]]})"})
      for (const std::string spin : {"[0, 90, 300]", "[20, -70, 100]"}) {
        const Recording recording = record(turning(3, integrator, R"({"shape": )" + shape + R"(, "angular_velocity": )" + spin + "}"));
        for (const Finding& f : check(recording)) ADD_FAILURE() << integrator << ", " << shape << ": " << f.code << ": " << f.message;
      }
}

/// Too small to turn, they fly and meet all the same.
TEST(Turning, TheSmallestBodiesHaveAnswers) {
  for (const std::string& integrator : integrators)
    for (const std::string size : {"1e-40", "1e-59", "1e-61", "1e-100", "1e-140", "1e-155", "1e-170", "1e-300"})
      for (const std::string mass : {"1", "1e-30", "1e30"}) {
        SCOPED_TRACE(integrator + ", size " + size + ", mass " + mass);
        const std::string more = R"(, "mass": )" + mass + R"(, "restitution": 1, "angular_velocity": )";
        for (const int dimension : {2, 3}) {
          const std::string spin = dimension == 2 ? "40}" : "[40, 20, 10]}", half = size + ", " + size + (dimension == 2 ? "" : ", " + size), rest = dimension == 2 ? "]" : ", 0]";
          const std::string ball = dimension == 2 ? "circle" : "sphere";
          const Recording recording = record(turning(dimension, integrator, R"({"shape": {"type": "box", "half_extents": [)" + half + R"(]})" + more + spin + R"(, {"shape": {"type": ")" + ball +
                                                                                  R"(", "radius": )" + size + R"(}, "pose": {"position": [1.9)" + size.substr(1) + ", 1" + size.substr(1) + rest +
                                                                                  R"(}, "velocity": [-2)" + size.substr(1) + ", 0" + rest + more + spin));
          ASSERT_TRUE(std::isfinite(recording.result.energy.value()));
          for (const FinalState& s : recording.result.bodies.value()) {
            EXPECT_TRUE(s.position.allFinite() && s.velocity.allFinite());
            for (const auto* list : {&s.orientation, &s.angular_velocity})
              for (const double x : *list) EXPECT_TRUE(std::isfinite(x));
          }
          if (testing::Test::HasFailure()) return;
        }
      }
}

/// A bound that is too low lets bodies pass through each other.
TEST(Turning, TheSmallestGapsCloseAsFastAsOthers) {
  const auto closes = [](double speed, double change, double gap, double size) { return TurningBound{speed * size, change * size}.until_closed(gap * size) / size; };
  for (const double speed : {1.0, 0.0, -0.5})
    for (const double size : {0x1p-100, 0x1p-460, 0x1p-600, 0x1p-900}) EXPECT_EQ(closes(speed, 1.5, 0.25, size), closes(speed, 1.5, 0.25, 1)) << speed << " " << size;
}

}  // namespace
}  // namespace gjkdbg
