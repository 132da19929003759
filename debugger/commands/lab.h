// What chart and atlas share: progress with Ctrl-C, drawings in two formats.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

namespace gjkdbg {

/// A line on the terminal with the time left. Ctrl-C makes the next call return false: what was done is kept; a second one ends the program.
class LabProgress {
 public:
  LabProgress();
  ~LabProgress();
  bool operator()(double share);
  /// After the last call: whether Ctrl-C ended it; then says on standard error that `folder` holds only what was done.
  bool tell_if_interrupted(const std::string& folder) const;

 private:
  std::chrono::steady_clock::time_point began_;
};

/// Draws STEM.svg and STEM.png by gnuplot; `commands(terminal, file)` are what it is told. Says so when gnuplot is not there. Sizes in pixels.
void draw_both(const std::function<std::string(const std::string&, const std::string&)>& commands, const std::filesystem::path& stem, int width, int height);

}  // namespace gjkdbg
