// The solver protocol: another implementation asks for supports and reports what it does; we answer and record.
// The messages are described in recordings/README.md.
#pragma once

#include <stop_token>
#include <string>

#include "recordings/recording.h"

namespace gjkdbg {

struct SolverLimits {
  int max_supports = 1000;
  double timeout = 10;  ///< seconds, from start to result
  int errors = 2;       ///< the file descriptor its standard error goes to: ours
  std::stop_token stop; ///< asked to stop by another thread, the run ends at once, and what was recorded of it means nothing
};

/// What a scene's method means to a program that has its own: how exact, and in which numbers. Which of ours solves it, by what rule and from where is not the program's affair.
Method method_for_solver(const Method& of_scene);

/// Runs `command` on a scene and records it. A crash, a hang, a bad message, too many queries or a missing result end the recording with a
/// warning event of that name ("crash", …), which `check` turns into a finding; the result's status is then "aborted".
/// Throws Error when the scene cannot be run this way (meshes) or the program not be started.
Recording run_solver(const SceneFile& scene, const Settings& settings, const std::string& command, const SolverLimits& limits);

}  // namespace gjkdbg
