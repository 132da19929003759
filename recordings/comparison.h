// Where two recordings part, and whether an answer is the expected one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recordings/recording.h"

namespace gjkdbg {

/// The first difference of two recordings.
struct Difference {
  std::size_t event = 0;            ///< index; the number of common events when only the results differ
  std::string what;                 ///< "event 12", "result": for people
  std::vector<std::string> fields;  ///< which of its fields differ; empty when the kinds differ or one side has ended
  std::string left, right;          ///< both sides as JSON, empty where a side has ended
  std::vector<double> by;           ///< of each of `fields` by how much its numbers differ at most; NaN where more than the size of numbers differs
};

/// Compares events, then results, bit for bit (the sign of zero counts). Scene, method and generator are not compared.
std::optional<Difference> first_difference(const Recording& a, const Recording& b);

/// Which of "scene" and "method" are not the same.
std::vector<std::string> differing_premises(const Recording& a, const Recording& b);

/// The first event in which they go different ways, of runs in different precisions: kinds, vertices, faces and statuses count, numbers only
/// where they differ by more than 1e-4 of their size or the scene's. `fields` and the results as above.
std::optional<Difference> first_other_way(const Recording& a, const Recording& b);

/// The first event, from `from` on, in which runs of two methods differ in more than rounding and in what only one of them computes, as boolean
/// GJK no bounds. Within one algorithm: of two that begin with different kinds of events no step is the other's, and it is that one.
std::optional<Difference> first_other_step(const Recording& a, const Recording& b, std::size_t from = 0);

/// Runs the recording's scene again with the recording's method; the difference, if any (left: the recording).
std::optional<Difference> verify(const Recording& recording);

/// What of the expectation a result misses, a sentence each; empty when it is met.
std::vector<std::string> missed_expectations(const SceneFile& scene, const Result& result);

/// The same of another program's run under the solver protocol: of what it answered, all but yes or no being optional, and within the tolerances that `check` judges distances by where
/// these are coarser: an expectation is written for what our own methods come to. A depth is no miss where a distance was asked for; what came to no answer has missed nothing more.
std::vector<std::string> missed_by_solver(const SceneFile& scene, const Recording& run);

}  // namespace gjkdbg
