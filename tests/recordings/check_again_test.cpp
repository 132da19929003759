// What was changed by hand in a recording of ours and contradicts nothing near it: the same run once more shows it, at its step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "recordings/check.h"
#include "tests/support/gallery_run.h"

namespace gjkdbg {
namespace {

/// The step and the code of what is told first; "none".
std::string first_told(const Recording& recording) {
  const std::vector<Finding> findings = check(recording);
  return findings.empty() ? "none" : std::to_string(findings[0].step) + " " + findings[0].code;
}
std::string told_of_edit(Recording recording, const std::function<void(Recording&)>& edit) {
  EXPECT_EQ(first_told(recording), "none");
  edit(recording);
  return first_told(recording);
}
template <class E>
E& at(Recording& r, std::size_t step) {
  return std::get<E>(r.events.at(step));
}

TEST(CheckAgain, NamesTheStepThatWasChanged) {
  const Recording deep = gallery_run("box-box-deep");
  EXPECT_EQ(told_of_edit(deep, [](Recording& r) { at<recorded::GjkBegan>(r, 0).direction *= -1; }), "0 inconsistent");
  EXPECT_EQ(told_of_edit(deep, [](Recording& r) { at<recorded::SupportQueried>(r, 3).direction *= 0.5; }), "3 inconsistent");
  const std::size_t seeded = static_cast<std::size_t>(std::find_if(deep.events.begin(), deep.events.end(), [](const Event& e) { return std::holds_alternative<recorded::PolytopeSeeded>(e); }) - deep.events.begin());
  EXPECT_EQ(told_of_edit(deep, [&](Recording& r) { std::swap(at<recorded::PolytopeSeeded>(r, seeded).vertices[0], at<recorded::PolytopeSeeded>(r, seeded).vertices[1]); }), std::to_string(seeded) + " inconsistent");
  const std::string faces = told_of_edit(deep, [&](Recording& r) { std::swap(at<recorded::PolytopeSeeded>(r, seeded).faces[0].face, at<recorded::PolytopeSeeded>(r, seeded).faces[1].face); });
  EXPECT_TRUE(faces.starts_with(std::to_string(seeded) + " ")) << faces;
  const Recording apart = gallery_run("box-box-apart");
  EXPECT_EQ(told_of_edit(apart, [](Recording& r) { *r.result.upper_bound += 1e-10; }), std::to_string(apart.events.size() - 1) + " inconsistent");
}

TEST(CheckAgain, AnEventThatIsMissingOrOneTooMany) {
  const Recording deep = gallery_run("box-box-deep");
  for (const std::size_t step : {std::size_t{2}, deep.events.size() - 2}) {
    EXPECT_NE(told_of_edit(deep, [&](Recording& r) { r.events.erase(r.events.begin() + static_cast<std::ptrdiff_t>(step)); }), "none") << step;
    EXPECT_NE(told_of_edit(deep, [&](Recording& r) { r.events.insert(r.events.begin() + static_cast<std::ptrdiff_t>(step), r.events[step]); }), "none") << step;
  }
}

TEST(CheckAgain, AnErrorOfAnotherStepIsToldWhereItComesFrom) {
  Recording cast = gallery_run("cast-rotating-rod");
  const auto third = [&] {
    std::size_t seen = 0;
    for (std::size_t i = 0; i < cast.events.size(); ++i)
      if (std::holds_alternative<recorded::CastAdvanced>(cast.events[i]) && seen++ == 2) return i;
    return cast.events.size();
  }();
  at<recorded::CastAdvanced>(cast, third).time *= 0.5;
  const std::vector<Finding> findings = check(cast);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].step, third);
  EXPECT_EQ(findings[0].code, "wrong-time");
  EXPECT_EQ(findings[0].severity, Finding::Severity::error);
}

/// Of another build every number may be another one, and of another program every step.
TEST(CheckAgain, OtherRunsOfTheSameSceneAreRight) {
  Recording other = gallery_run("box-box-apart");
  other.generator = "another engine 1.0";
  at<recorded::SupportQueried>(other, 1).direction *= 0.5;
  at<recorded::GjkBegan>(other, 0).direction *= 0.5;
  EXPECT_EQ(first_told(other), "none");
  Recording last_digits = gallery_run("pair-hull-hull");
  at<recorded::GjkBegan>(last_digits, 0).direction *= 1 + 1e-15;
  for (Event& e : last_digits.events)
    if (auto* query = std::get_if<recorded::SupportQueried>(&e)) query->direction *= 1 + 1e-15;
  for (Event& e : last_digits.events)
    if (auto* reduced = std::get_if<recorded::SimplexReduced>(&e)) reduced->closest *= 1 + 1e-15, reduced->upper_bound = std::nextafter(reduced->upper_bound, 1e300);
  EXPECT_EQ(first_told(last_digits), "none");
}

}  // namespace
}  // namespace gjkdbg
