// A program of someone else's, run under our eyes: lines to its standard input, lines from its standard output, within limits.
// POSIX (Linux, macOS); on Windows it would need job objects and is not available.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

namespace gjkdbg {

class SolverProcess {
 public:
  /// Starts `command` by /bin/sh in a process group of its own; its standard error goes on to the descriptor `errors`. Throws Error when that fails.
  SolverProcess(const std::string& command, int errors);
  /// Kills the whole group it started, and nothing else. So does a signal that ends us while it runs (Ctrl-C).
  ~SolverProcess();
  SolverProcess(const SolverProcess&) = delete;
  SolverProcess& operator=(const SolverProcess&) = delete;

  using Deadline = std::chrono::steady_clock::time_point;
  enum class Outcome { ok, timeout, closed, too_long };

  Outcome write_line(const std::string& line, Deadline deadline);
  /// A line without its end. `closed`: the program has closed its output; an unfinished last line is in `line`.
  Outcome read_line(std::string& line, Deadline deadline);
  void close_input();
  /// Kills the group, for another thread: who waits for the program is told that its time is up.
  void end();
  /// How it ended, if it does by the deadline: "exit status 3", "signal 11 (Segmentation fault)"; "" for exit status 0.
  std::optional<std::string> wait(Deadline deadline);
  /// The last line that is not blank of what it wrote to its standard error so far; "" if there is none.
  std::string last_words();

 private:
  bool over(Deadline deadline) const;
  void listen();
  void poll_one(int descriptor, short events, Deadline deadline);

  static constexpr std::size_t longest_line = 1 << 20;
  std::atomic<pid_t> pid_ = -1;
  std::atomic<bool> to_end_ = false;
  int to_ = -1, from_ = -1, complaints_ = -1;
  const int errors_;
  std::string buffer_, complained_;  ///< the latter: the last of it
};

}  // namespace gjkdbg
