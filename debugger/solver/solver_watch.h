// A solver's run that goes on beside the window, which would otherwise stand still for as long as a loop that never ends is waited for.
#pragma once

#include <filesystem>
#include <future>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "debugger/solver/solver_run.h"

namespace gjkdbg {

/// Runs a solver on a scene, and again whenever a file that its command names has changed: a run that is not done by then is ended.
class SolverWatch {
 public:
  SolverWatch(SceneFile scene, std::string command, SolverLimits limits = {});
  /// Ends the run, too.
  ~SolverWatch();
  SolverWatch(const SolverWatch&) = delete;
  SolverWatch& operator=(const SolverWatch&) = delete;

  struct News {
    std::optional<Recording> run;  ///< one that was not told before
    std::string error;             ///< why there will be none
    std::optional<double> since;   ///< seconds: it is not done yet
  };
  /// To be asked again and again. Most runs are done at once: for a new one it waits a little.
  News ask();

 private:
  bool changed();
  void begin();
  void end();

  SceneFile scene_;
  std::string command_;
  SolverLimits limits_;
  std::vector<std::filesystem::path> files_;
  std::vector<std::filesystem::file_time_type> times_;  ///< of the files when the run began
  std::future<Recording> run_;
  std::stop_source stop_;
  std::chrono::steady_clock::time_point begun_;
  bool ran_ = false;
};

}  // namespace gjkdbg
