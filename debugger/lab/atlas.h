// The stability atlas: families of pairs where methods fail, swept, every method a column; exact answers by closed forms.
#pragma once

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
  not_finite
};
inline constexpr std::array<const char*, 7> verdict_names{"right", "right-within-rounding", "gave-up", "wrong-value", "lied", "wrong-class", "not-finite"};

struct AtlasCase {
  double parameter = 0;
  Scene scene;
  double exact = 0;  ///< signed distance of the rounded input, to a few roundings
};

struct AtlasFamily {
  std::string name, what;  ///< `what`: also why methods fail here
  std::vector<AtlasCase> cases;
};
std::vector<AtlasFamily> atlas_families(bool quick);

struct AtlasCell {
  Verdict verdict = Verdict::right;
  double worst_error = 0;  ///< relative to the size
  double parameter = 0;    ///< of the worst case
  Scene scene;             ///< the worst case
};

struct Atlas {
  std::vector<AtlasFamily> families;
  std::vector<Variant> methods;
  std::vector<std::vector<AtlasCell>> cells;  ///< [family][method]; fewer families when interrupted
};
Atlas make_atlas(bool quick, const std::function<bool(double)>& progress);

std::string atlas_csv(const Atlas& atlas);
std::string atlas_json(const Atlas& atlas);
std::string atlas_gnuplot(const Atlas& atlas, const std::string& terminal, const std::string& file);

}  // namespace gjkdbg
