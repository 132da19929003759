// What happens, event by event, in scenes small enough to follow on paper.
#include <gtest/gtest.h>

#include "tests/support/event_log.h"

namespace gjkdbg {
namespace {

using Lines = std::vector<std::string>;

Lines log_of(const std::string& scene) { return event_log(record(read_scene(std::string(GJKDBG_GALLERY) + "/" + scene + ".scene.json"))); }

TEST(EventList, IntervalsApart) {
  EXPECT_EQ(log_of("1d-apart"), (Lines{
                                    "gjk began along 1",
                                    "support 0 (gjk) along 1: w = -2",
                                    "simplex 0 -> 0, v = -2",
                                    "support 1 (gjk) along 2: w = -2",  // no farther: [-5, -2] ends here
                                    "gjk ended converged",
                                }));
}

TEST(EventList, IntervalsOverlap) {
  EXPECT_EQ(log_of("1d-overlap"), (Lines{
                                      "gjk began along 2",
                                      "support 0 (gjk) along 2: w = 1",
                                      "simplex 0 -> 0, v = 1",
                                      "support 1 (gjk) along -1: w = -3",
                                      "simplex 1 0 -> 1 0, v = 0",
                                      "gjk ended enclosed",
                                      "polytope of 1 0, 2 faces",
                                      "face 1 chosen at 1",
                                      "support 2 (epa) along 1: w = 1",
                                      "epa ended converged: depth 1 along 1",
                                  }));
}

TEST(EventList, CornerToEdge) {
  EXPECT_EQ(log_of("2d-corner-to-edge"), (Lines{
                                             "gjk began along 3 0",
                                             "support 0 (gjk) along 3 0: w = -0.5858 1",
                                             "simplex 0 -> 0, v = -0.5858 1",
                                             "support 1 (gjk) along 0.5858 -1: w = -2 -2.414",
                                             "simplex 1 0 -> 1 0, v = -0.8536 0.3536",
                                             "support 2 (gjk) along 0.8536 -0.3536: w = -0.5858 -1",
                                             "simplex 2 1 0 -> 2 0, v = -0.5858 0",
                                             "support 3 (gjk) along 0.5858 0: w = -0.5858 1",
                                             "gjk ended converged",
                                         }));
}

TEST(EventList, CirclesNeedNoEpa) {
  EXPECT_EQ(log_of("2d-circles-overlap"), (Lines{
                                              "gjk began along 3 0",
                                              "support 0 (gjk) along 3 0: w = -3 0",
                                              "simplex 0 -> 0, v = -3 0",
                                              "support 1 (gjk) along 3 0: w = -3 0",
                                              "gjk ended converged",
                                          }));
}

TEST(EventList, DeepInThePlane) {
  EXPECT_EQ(log_of("2d-deep"), (Lines{
                                   "gjk began along 0.5 0.25",
                                   "support 0 (gjk) along 0.5 0.25: w = 2.5 1.75",
                                   "simplex 0 -> 0, v = 2.5 1.75",
                                   "support 1 (gjk) along -2.5 -1.75: w = -3.5 -2.25",
                                   "simplex 1 0 -> 1 0, v = -0.03846 0.05769",
                                   "support 2 (gjk) along 0.03846 -0.05769: w = 2.5 -2.25",
                                   "simplex 2 1 0 -> 2 1 0, v = 0 0",
                                   "gjk ended enclosed",
                                   "polytope of 0 1 2, 3 faces",
                                   "face 0 chosen at 0.06934",
                                   "support 3 (epa) along -0.5547 0.8321: w = -3.5 1.75",
                                   "polytope + 3: -1 +2 faces",
                                   "face 3 chosen at 1.75",
                                   "support 4 (epa) along 0 1: w = 0.5 1.75",
                                   "epa ended converged: depth 1.75 along 0 1",
                               }));
}

/// The origin lies on an edge of the simplex when GJK ends: EPA asks for the vertex that is missing.
TEST(EventList, StackedCubesSeedAMissingVertex) {
  EXPECT_EQ(log_of("stacked-cubes"), (Lines{
                                         "gjk began along 1 0 0",
                                         "support 0 (gjk) along 1 0 0: w = 2 0 -1.9",
                                         "simplex 0 -> 0, v = 2 0 -1.9",
                                         "support 1 (gjk) along -2 0 1.9: w = -2 0 0.1",
                                         "simplex 1 0 -> 1 0, v = -0.36 0 -0.72",
                                         "support 2 (gjk) along 0.36 0 0.72: w = 2 0 0.1",
                                         "simplex 2 1 0 -> 2 1 0, v = 0 0 0",
                                         "gjk ended touching",
                                         "support 3 (seed) along 0 1 0: w = 0 2 -1.9",
                                         "support 4 (seed) along 0 -1 0: w = 0 -2 -1.9",
                                         "polytope of 0 2 1 3, 4 faces",
                                         "face 0 chosen at 0",
                                         "support 5 (epa) along 0 -1 0: w = 0 -2 -1.9",
                                         "polytope + 5: -2 +4 faces",
                                         "face 2 chosen at 0.07071",
                                         "support 6 (epa) along 0 0.7071 0.7071: w = 0 2 0.1",
                                         "polytope + 6: -2 +4 faces",
                                         "face 5 chosen at 0.07071",
                                         "support 7 (epa) along 0 -0.7071 0.7071: w = 0 -2 0.1",
                                         "polytope + 7: -3 +5 faces",
                                         "face 12 chosen at 0.1",
                                         "support 8 (epa) along 0 0 1: w = 0 0 0.1",
                                         "epa ended converged: depth 0.1 along 0 0 1",
                                     }));
}

TEST(EventList, BooleanFormNamesTheRegion) {
  EXPECT_EQ(log_of("boolean-hit-2d"), (Lines{
                                          "gjk began along 1 0",
                                          "support 0 (gjk) along 1 0: w = 4 2",
                                          "support 1 (gjk) along -4 -2: w = -8 -2",
                                          "simplex 1 0 -> 1 0",
                                          "support 2 (gjk) along 32 -96: w = -1 -2",
                                          "simplex 2 1 0 -> 2 1 0",
                                          "gjk ended enclosed",
                                      }));
}

}  // namespace
}  // namespace gjkdbg
