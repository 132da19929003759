// What `chart` and `atlas` wrote, read back to be shown.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "recordings/scene_file.h"

namespace gjkdbg {

/// A method at a tolerance on a family of pairs.
struct MeasuredDot {
  int method = 0;         ///< index into `methods`
  double tolerance = 0, nanoseconds = 0, worst_error = 0;
  double median_gap = 0;  ///< between the bounds; 0: another library's, which has none
  int wrong = 0, worst_pair = 0;
  bool front = false;
};

struct MeasuredFamily {
  std::string name, title;
  int pairs = 0;
  std::vector<MeasuredDot> dots;
  std::map<int, SceneFile> scenes;  ///< the worst ones, by number
};

/// A way of GJK at a distance: iterations, time, and what was published.
struct MeasuredRung {
  std::string shapes, method;
  double distance = 0, iterations = 0, deviation = 0, nanoseconds = 0;
  int vertices = 0;  ///< of a hull; 0: ellipsoids
  std::optional<double> published, published_deviation, published_nanoseconds;
};

struct MeasuredPrice {
  std::string what;
  double nanoseconds = 0, worst_error = 0, supports = 0;
};

struct MeasuredMotion {
  std::string family, method;
  double parameter = 0, nanoseconds = 0, worst_error = 0;
};

struct MeasuredChart {
  std::vector<std::string> methods;
  std::vector<std::optional<Method>> settings;  ///< of the methods; unset: another library's
  std::vector<MeasuredFamily> families;
  std::vector<MeasuredRung> ladder;
  std::vector<MeasuredPrice> price;
  std::vector<MeasuredMotion> motion;
};

/// In the order of debugger/lab/atlas.h, whose numbers and words they are: the window reads files and knows no lab. A test holds them together.
inline constexpr std::array<const char*, 9> atlas_verdict_marks{"", "\xE2\x89\x88", "?", "\xE2\x89\xA0", "!", "\xC2\xB1", "\xE2\x88\x9E", "\xC3\x97", ""};
inline constexpr std::array<const char*, 9> atlas_verdict_meanings{"the right answer", "the right answer, or one that the input's own rounding could make right", "a limit or a stall is admitted, and the answer is off", "the value is off, and the bounds admit it",
                                                                  "converged, it says, with bounds that exclude the truth", "apart is called overlapping, or overlapping apart", "the answer holds a number that is not finite", "crashed or never ended", "the method does not take such bodies"};
inline constexpr std::array<const char*, 9> atlas_verdicts{"right", "right-within-rounding", "gave-up", "wrong-value", "lied", "wrong-class", "not-finite", "crashed", "not-applicable"};

struct MeasuredCell {
  int verdict = 0;
  double worst_error = 0, parameter = 0;  ///< error: infinite for an answer that is no number
  std::string why, how_often;             ///< how_often: of the family's cases, where the file says so
  std::optional<SceneFile> scene;         ///< where it failed
};

struct MeasuredAtlas {
  std::vector<std::string> methods;
  struct Family {
    std::string name, what;
    std::vector<MeasuredCell> cells;  ///< one a method
  };
  std::vector<Family> families;
};

struct Measurements {
  std::optional<MeasuredChart> chart;
  std::optional<MeasuredAtlas> atlas;
  bool any() const { return chart || atlas; }
};

enum class MeasurementKind { neither, chart, atlas };
/// Reads a chart.json or an atlas.json into `measurements`; `neither`, and nothing has changed, for other files. Throws Error (FILE: pointer) for one that
/// is broken.
MeasurementKind read_measurements(const std::filesystem::path& file, Measurements& measurements);

}  // namespace gjkdbg
