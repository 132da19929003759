// What commands are given: scenes by file or gallery name, settings by flag.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "algo/settings.h"
#include "recordings/gallery.h"
#include "recordings/scene_file.h"

namespace CLI {
class App;
class Validator;
}

namespace gjkdbg {

/// Where the gallery is: $GJKDBG_GALLERY, beside an installed program, or in the source tree.
std::filesystem::path gallery_directory();
/// This program's own file.
std::filesystem::path program_path();

/// The file a command's argument means: itself when it exists, else the gallery scene of that name, else itself (and reading it
/// will say that it is not there).
std::filesystem::path scene_path(const std::string& argument);

/// What is printed of an error: one line, whatever names the input brought along.
std::string one_line(std::string text);

/// "-" is the standard input, as it is for query.
std::string input_path(const std::string& argument);

/// Of options that name a file, a folder or a program: not empty.
CLI::Validator named();
/// Of options that choose by name.
CLI::Validator one_of(std::vector<std::string> names);
/// Of options that are a number: from `low` to `high`, and no NaN.
CLI::Validator between(double low, double high);
/// A whole number, however it is written: 010, 10.0 and 1e1 are ten. For `transform`.
CLI::Validator whole_between(double low, double high);

/// The method's settings as flags, named as in a scene file; those given override the scene's.
class MethodFlags {
 public:
  void add_to(CLI::App& app);
  void override_in(Method& method) const;
  bool given() const;  ///< whether any is

  /// The settings for a scene read from `source`; throws Error that names the flag, or the place in the file.
  Settings resolve(const SceneFile& scene, const std::string& source) const;

 private:
  std::optional<std::string> name_, closest_point_, penetration_, scalar_, stopping_, acceleration_, start_;
  std::string start_from_;
  std::optional<double> tolerance_;
  std::optional<int> max_iterations_;
  std::vector<double> initial_direction_;
};

}  // namespace gjkdbg
