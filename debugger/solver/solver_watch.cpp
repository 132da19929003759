#include "debugger/solver/solver_watch.h"

#include <chrono>
#include <sstream>
#include <utility>

#include "shapes/error.h"

namespace gjkdbg {

SolverWatch::SolverWatch(SceneFile scene, std::string command, SolverLimits limits) : scene_(std::move(scene)), command_(std::move(command)), limits_(std::move(limits)) {
  std::istringstream words(command_);
  for (std::string word; words >> word;)
    if (std::error_code ignored; std::filesystem::is_regular_file(word, ignored)) files_.push_back(word);
}

SolverWatch::~SolverWatch() { end(); }

/// Since the run began; a file that is missing is being saved.
bool SolverWatch::changed() {
  std::vector<std::filesystem::file_time_type> times;
  for (const auto& file : files_) {
    std::error_code missing;
    times.push_back(std::filesystem::last_write_time(file, missing));
    if (missing) return false;
  }
  const bool first = !std::exchange(ran_, true);
  return std::exchange(times_, times) != times || first;
}

void SolverWatch::end() {
  stop_.request_stop();
  if (run_.valid()) run_.wait();
  run_ = {};
}

void SolverWatch::begin() {
  end();
  stop_ = {};
  SolverLimits limits = limits_;
  limits.stop = stop_.get_token();
  begun_ = std::chrono::steady_clock::now();
  run_ = std::async(std::launch::async, [this, limits] { return run_solver(scene_, resolve_settings(scene_.method, scene_.scene), command_, limits); });
}

SolverWatch::News SolverWatch::ask() {
  const bool anew = changed();
  if (anew) begin();
  News news;
  if (!run_.valid()) return news;
  if (run_.wait_for(std::chrono::milliseconds(anew ? 250 : 0)) != std::future_status::ready) {
    news.since = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
    return news;
  }
  try {
    news.run = run_.get();
  } catch (const Error& e) {
    news.error = e.line();
  }
  return news;
}

}  // namespace gjkdbg
