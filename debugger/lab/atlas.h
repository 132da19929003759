// The stability atlas: families of pairs where methods fail, swept, every method a column; exact answers by closed forms.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "debugger/lab/measure.h"

namespace gjkdbg {

/// What came of a family under a method, least serious first.
enum class Verdict {
  right,
  right_within_rounding,  ///< the class or the last digits are lost where the input's own rounding could take them
  gave_up,                ///< says so: limit reached or stalled, and the answer is off
  wrong_value,            ///< off, with bounds that admit it
  lied,                   ///< said converged, with bounds that exclude the truth
  wrong_class,            ///< apart for overlapping, or the other way round
  not_finite,
  crashed,                ///< or did not end: another library, in a process of its own
  not_applicable          ///< the method does not take such bodies, or says nothing but yes and no here
};
inline constexpr std::array<const char*, 9> verdict_names{"right", "right-within-rounding", "gave-up", "wrong-value", "lied", "wrong-class", "not-finite", "crashed", "not-applicable"};
constexpr const char* word_of(Verdict x) { return verdict_names[static_cast<std::size_t>(x)]; }
/// Beside the colour, in every cell: no verdict is told by colour alone.
inline constexpr std::array<const char*, 9> verdict_marks{"", "\xE2\x89\x88", "?", "\xE2\x89\xA0", "!", "\xC2\xB1", "\xE2\x88\x9E", "\xC3\x97", ""};
inline bool failed(Verdict verdict) { return verdict >= Verdict::gave_up && verdict != Verdict::not_applicable; }

/// What was answered, of whichever method.
struct Answered {
  bool overlap = false, known = true;  ///< known: the value is
  double value = 0, lower = 0, upper = 0;
  bool bounded = false, unfinished = false;
};
/// Judges one answer, and tells its `error` relative to the size. `unit` is the rounding of the method's scalar; the exact answer itself carries a few roundings of the sizes.
Verdict judge(const Answered& answer, double exact, double size, double unit, double tolerance, double& error);

/// What is known of two bodies in motion, for a cast.
struct ExactMotion {
  std::function<double(double)> gap;  ///< between the bodies, by time
  double least = 0;                   ///< over the whole motion; negative: they would pass through each other
};

struct AtlasCase {
  double parameter = 0;
  Scene scene;
  double exact = 0;  ///< signed distance of the rounded input, to a few roundings; of a cast, the time they meet, infinite when they do not
  ExactMotion motion{};
};

struct AtlasFamily {
  std::string name, what;  ///< `what`: also why methods fail here
  std::vector<AtlasCase> cases;
};
/// By name; none: all. Throws Error where there is no family of a name.
std::vector<AtlasFamily> atlas_families(bool quick, const std::vector<std::string>& names = {});
/// T1 and T2: bodies in motion that graze, or just miss.
std::vector<AtlasFamily> moving_families(bool quick);

struct AtlasCell {
  Verdict verdict = Verdict::right;
  double worst_error = 0;  ///< relative to the size
  double parameter = 0;    ///< of the worst case
  int failed = 0;          ///< of the family's cases
  double value = 0, exact = 0;  ///< what it answered in `scene`, and the truth
  Scene scene;             ///< the worst case; where the cell failed, made as simple as still fails the same way
  std::string why;         ///< a sentence, where the cell failed
};

struct Atlas {
  std::vector<AtlasFamily> families;
  std::vector<Variant> methods;
  std::vector<std::vector<AtlasCell>> cells;  ///< [family][method]; fewer families when interrupted
};
/// Of these families and methods; `progress(share done)` returns false to stop.
Atlas make_atlas(std::vector<AtlasFamily> families, const std::vector<Variant>& methods, const std::function<bool(double)>& progress);

/// What a kept atlas says of a cell.
struct KeptCell {
  Verdict verdict = Verdict::right;
  int cases = 0, failed = -1;  ///< -1: it does not say
  double worst_error = 0;
};
/// How a cell of so many cases is worse than it was kept, or nothing: a verdict more serious; of as many cases, more that fail; or, beyond rounding, an
/// error more than ten times as large. Of another library only the verdict counts, for how often it does not come back is a matter of time.
std::string worse_than_kept(const AtlasCell& now, int cases, const KeptCell& was, bool only_verdict);

std::string atlas_csv(const Atlas& atlas);
std::string atlas_json(const Atlas& atlas);
/// Commands for gnuplot that draw a heat map with the given terminal, which is to have this size, into `file`.
std::string atlas_gnuplot(const Atlas& atlas, const std::string& terminal, const std::string& file);
std::array<int, 2> atlas_picture_size(const Atlas& atlas);  ///< width and height in pixels

}  // namespace gjkdbg
