// The conditions that playing stops at and a search finds.
#include <gtest/gtest.h>

#include "debugger/view/condition.h"
#include "recordings/gallery.h"

namespace gjkdbg {
namespace {

TEST(Conditions, SayWhatIsWrong) {
  for (const char* bad : {"< 3", "upper_bound <", "nonsense == 1", "iteration == 1 maybe", "iteration == 1 and"})
    EXPECT_THROW(Condition{bad}, Error) << bad;
  Recording recording = record(read_scene(read_gallery(GJKDBG_GALLERY).file("box-box-deep")));
  const auto count = [&](const char* text) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < recording.events.size(); ++i) n += Condition(text).holds(recording, {}, i);
    return n;
  };
  EXPECT_EQ(count(""), 0u);
  EXPECT_EQ(count("kind == gjk_began"), 1u);
  EXPECT_EQ(count("gjk_began"), 1u);
  EXPECT_EQ(count("step >= 0"), recording.events.size());
  EXPECT_EQ(count("phase == epa") + count("phase == gjk") + count("phase == seed"), count("support_queried"));
  EXPECT_EQ(count("region.size == 1 or region.size == 2 or region.size == 3 or region.size == 4"), count("simplex_reduced"));
  EXPECT_EQ(count("closest.norm > 0 and region.size < 9"), count("closest.norm > 0"));
  EXPECT_EQ(count("status == enclosed"), 1u);
  EXPECT_EQ(count("status != enclosed"), 1u);  // EPA's
  EXPECT_EQ(count("any warning"), 0u);
  EXPECT_EQ(count("direction.x >= -2 and direction.x <= 2"), count("direction"));
}

}  // namespace
}  // namespace gjkdbg
