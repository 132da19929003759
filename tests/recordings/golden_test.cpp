// Golden recordings: the same bytes from every compiler at every optimisation level. Written by `gjkdbg dump`.
#include <gtest/gtest.h>

#include "recordings/comparison.h"

namespace gjkdbg {
namespace {

TEST(Golden, RecordingsAreTheSameBitForBit) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GJKDBG_GOLDEN)) {
    const std::string text = read_text_file(entry.path());
    const Recording golden = parse_recording(text, {});
    const auto difference = verify(golden);
    EXPECT_FALSE(difference) << entry.path() << ": " << difference->what << "\n" << difference->left << "\n" << difference->right;
    EXPECT_EQ(recording_to_text(golden), text) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 20);
}

}  // namespace
}  // namespace gjkdbg
