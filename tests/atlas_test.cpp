// The atlas's verdicts, one answer at a time.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "debugger/lab/atlas.h"

namespace gjkdbg {
namespace {

/// Of bodies of size 2 in double, asked for to 1e-10.
Verdict verdict_on(const Answered& answer, double exact) {
  double error = 0;
  return judge(answer, exact, 2, 2.3e-16, 1e-10, error);
}
Answered told(double value, double lower, double upper, bool unfinished = false) { return {value <= 0, true, value, lower, upper, true, unfinished}; }

TEST(Verdicts, OfOneAnswer) {
  EXPECT_EQ(verdict_on(told(0.5, 0.5, 0.5), 0.5), Verdict::right);
  EXPECT_EQ(verdict_on(told(0.5, 0.4, 0.6), 0.5 + 1e-10), Verdict::right_within_rounding);
  EXPECT_EQ(verdict_on(told(0.5, 0.4, 0.6), 0.55), Verdict::wrong_value) << "the bounds admit it";
  EXPECT_EQ(verdict_on(told(0.5, 0.4, 0.6, true), 0.55), Verdict::gave_up) << "and it says that it came no farther";
  EXPECT_EQ(verdict_on(told(0.5, 0.4, 0.52), 0.55), Verdict::lied);
  EXPECT_EQ(verdict_on(told(0.5, 0.4, 0.52, true), 0.55), Verdict::lied) << "bounds hold, whatever else an answer admits";
  EXPECT_EQ(verdict_on(told(0.5, 0.4, 0.5 - 1e-12), 0.5), Verdict::lied) << "the value is right, and the bounds exclude it";
  EXPECT_EQ(verdict_on(told(0.5, 0.4, 0.5 - 1e-16), 0.5), Verdict::right) << "by less than the truth is known";
  EXPECT_EQ(verdict_on(told(0.1, 0.1, 0.1), -0.1), Verdict::wrong_class);
  EXPECT_EQ(verdict_on(told(1e-15, -1e-14, 1e-14), -1e-15), Verdict::right_within_rounding) << "on the other side of touching, by rounding";
  EXPECT_EQ(verdict_on(told(std::numeric_limits<double>::quiet_NaN(), 0, 0), 0.5), Verdict::not_finite);
  EXPECT_EQ(verdict_on({true, false}, -0.1), Verdict::right) << "a yes or no has no value";
  EXPECT_EQ(verdict_on({true, true, -0.2, 0, 0, false, false}, -0.1), Verdict::lied) << "another library's, which says nothing of bounds";
}

AtlasCell measured(Verdict verdict, double error, int failed) {
  AtlasCell cell;
  cell.verdict = verdict, cell.worst_error = error, cell.failed = failed;
  return cell;
}

TEST(Gate, TellsHowACellIsWorse) {
  const KeptCell was{Verdict::wrong_value, 40, 3, 1e-6};
  const auto worse = [&](Verdict verdict, double error, int failed, int cases = 40, bool only_verdict = false) { return worse_than_kept(measured(verdict, error, failed), cases, was, only_verdict); };
  EXPECT_EQ(worse(Verdict::wrong_value, 1e-6, 3), "");
  EXPECT_EQ(worse(Verdict::gave_up, 1, 40), "") << "less serious";
  EXPECT_EQ(worse(Verdict::lied, 1e-9, 1), "wrong-value -> lied");
  EXPECT_EQ(worse(Verdict::not_applicable, 0, 0), "wrong-value -> not-applicable") << "what was answered is no longer";
  EXPECT_EQ(worse(Verdict::wrong_value, 1e-9, 4), "wrong-value in 3 -> 4 of 40 cases");
  EXPECT_EQ(worse(Verdict::wrong_value, 9e-6, 3), "");
  EXPECT_EQ(worse(Verdict::wrong_value, 2e-5, 3), "wrong-value, error 1e-06 -> 2e-05");
  EXPECT_EQ(worse(Verdict::wrong_value, 1, 9, 12), "") << "of other cases neither can be told";
  EXPECT_EQ(worse(Verdict::wrong_value, 1, 9, 40, true), "");
  EXPECT_EQ(worse_than_kept(measured(Verdict::right, 1e-15, 0), 40, {Verdict::right, 40, 0, 1e-17}, false), "") << "digits of rounding";
  EXPECT_EQ(worse_than_kept(measured(Verdict::right, 0, 0), 40, {Verdict::not_applicable, 40, 0, 0}, false), "");
  EXPECT_EQ(worse_than_kept(measured(Verdict::wrong_value, 1e-6, 40), 40, {Verdict::wrong_value, 40, -1, 1e-6}, false), "") << "kept without a count";
}

}  // namespace
}  // namespace gjkdbg
