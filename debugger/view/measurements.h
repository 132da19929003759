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
  int wrong = 0, worst_pair = 0;
  bool front = false;
};

struct MeasuredFamily {
  std::string name, title;
  int pairs = 0;
  std::vector<MeasuredDot> dots;
  std::map<int, SceneFile> scenes;  ///< the worst ones, by number
};

struct MeasuredChart {
  std::vector<std::string> methods;
  std::vector<std::optional<Method>> settings;  ///< of the methods; unset: another library's
  std::vector<MeasuredFamily> families;
};

/// How serious, in the order of the atlas's verdicts; the last two: crashed, not applicable.
inline constexpr std::array<const char*, 9> atlas_verdicts{"right", "right-within-rounding", "gave-up", "wrong-value", "lied", "wrong-class", "not-finite", "crashed", "not-applicable"};

struct MeasuredCell {
  int verdict = 0;
  double worst_error = 0, parameter = 0;  ///< error: infinite for an answer that is no number
  std::string why;
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
