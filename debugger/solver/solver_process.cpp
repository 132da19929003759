#include "debugger/solver/solver_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <thread>

#include "shapes/error.h"

namespace gjkdbg {
namespace {

/// No more than a tenth of a second: another thread may end the program.
int milliseconds_until(SolverProcess::Deadline deadline) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
  return static_cast<int>(std::clamp<long long>(left + 1, 0, 100));
}

[[noreturn]] void cannot_start() { throw Error("cannot-start", std::string("cannot be started: ") + std::strerror(errno), "--exec"); }

/// Both ends closed in programs that are started later. (pipe2 does it in one call, but macOS has none.)
void open_pipe(int ends[2]) {
  if (pipe(ends) != 0) cannot_start();
  for (int i = 0; i < 2; ++i) fcntl(ends[i], F_SETFD, FD_CLOEXEC);
}

constexpr int interrupts[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

std::atomic<pid_t> running_group{0};  ///< for the handler; a program runs one solver at a time
struct sigaction before_solver[std::size(interrupts)];

/// The solver's group is its own, so Ctrl-C reaches only us. Whoever ends us ends the solver, which might otherwise run in its loop for ever;
/// then the signal does what it did before.
extern "C" void end_solver(int signal) {
  if (const pid_t group = running_group.exchange(0); group > 0) kill(-group, SIGKILL);
  for (std::size_t i = 0; i < std::size(interrupts); ++i)
    if (interrupts[i] == signal) sigaction(signal, &before_solver[i], nullptr);
  raise(signal);
}

void end_when_interrupted(pid_t group) {
  running_group = group;
  struct sigaction ending = {};
  ending.sa_handler = end_solver;
  for (std::size_t i = 0; i < std::size(interrupts); ++i) {
    sigaction(interrupts[i], nullptr, &before_solver[i]);
    if (before_solver[i].sa_handler != SIG_IGN) sigaction(interrupts[i], &ending, nullptr);
  }
}

void no_longer_interruptible() {
  for (std::size_t i = 0; i < std::size(interrupts); ++i) sigaction(interrupts[i], &before_solver[i], nullptr);
  running_group = 0;
}

[[noreturn]] void run_child(const std::string& command, const int in[2], const int out[2], const int errors[2]) {
  setpgid(0, 0);
  dup2(in[0], STDIN_FILENO);
  dup2(out[1], STDOUT_FILENO);
  dup2(errors[1], STDERR_FILENO);
  signal(SIGPIPE, SIG_DFL);
  execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
  _exit(127);
}

}  // namespace

SolverProcess::SolverProcess(const std::string& command, int errors) : errors_(errors) {
  int in[2], out[2], said[2];
  open_pipe(in), open_pipe(out), open_pipe(said);
  pid_ = fork();
  if (pid_ == 0) run_child(command, in, out, said);
  close(in[0]), close(out[1]), close(said[1]);
  if (pid_ < 0) cannot_start();
  setpgid(pid_, pid_);  // both sides do: whoever comes first
  end_when_interrupted(pid_);
  to_ = in[1], from_ = out[0], complaints_ = said[0];
  for (const int descriptor : {to_, from_, complaints_}) fcntl(descriptor, F_SETFL, O_NONBLOCK);
}

/// Whoever still runs is ended before its input is closed: it would read the end of it, and its complaint would stand before the findings.
SolverProcess::~SolverProcess() {
  if (pid_ > 0) kill(-pid_, SIGKILL);
  close_input();
  if (from_ >= 0) close(from_);
  listen();  // what was said before
  if (complaints_ >= 0) close(complaints_);
  no_longer_interruptible();
  int status = 0;
  if (pid_ > 0) waitpid(pid_, &status, 0);
}

void SolverProcess::end() {
  to_end_ = true;
  if (const pid_t group = pid_; group > 0) kill(-group, SIGKILL);
}

bool SolverProcess::over(Deadline deadline) const { return to_end_ || std::chrono::steady_clock::now() >= deadline; }

/// Passes on what has come of its standard error; not for ever of one that never stops, which has a time limit.
void SolverProcess::listen() {
  constexpr std::size_t kept = 4096;
  char chunk[4096];
  for (int chunks = 0; complaints_ >= 0 && chunks < 16; ++chunks) {
    const ssize_t n = read(complaints_, chunk, sizeof chunk);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) return;
    if (n <= 0) {
      close(complaints_);
      complaints_ = -1;
      return;
    }
    complained_.append(chunk, static_cast<std::size_t>(n));
    if (complained_.size() > kept) complained_.erase(0, complained_.size() - kept);
    for (ssize_t at = 0; at < n;) {
      const ssize_t passed = write(errors_, chunk + at, static_cast<std::size_t>(n - at));
      if (passed > 0) at += passed;
      else if (!(passed < 0 && errno == EINTR)) break;
    }
  }
}

/// Until something can be done with the descriptor, or is said meanwhile, or a tenth of a second is over.
void SolverProcess::poll_one(int descriptor, short events, Deadline deadline) {
  pollfd waiting[2]{{descriptor, events, 0}, {complaints_, POLLIN, 0}};  // of a negative one nothing is heard
  poll(waiting, 2, milliseconds_until(deadline));
  listen();
}

std::string SolverProcess::last_words() {
  listen();
  const std::size_t end = complained_.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "";
  const std::size_t before = complained_.find_last_of('\n', end), begin = before == std::string::npos ? 0 : before + 1;
  return complained_.substr(begin, end + 1 - begin);
}

void SolverProcess::close_input() {
  if (to_ >= 0) close(to_);
  to_ = -1;
}

SolverProcess::Outcome SolverProcess::write_line(const std::string& line, Deadline deadline) {
  const std::string text = line + "\n";
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t n = write(to_, text.data() + sent, text.size() - sent);
    if (n > 0) {
      sent += static_cast<std::size_t>(n);
    } else if (n < 0 && errno == EAGAIN) {
      poll_one(to_, POLLOUT, deadline);
      if (over(deadline)) return Outcome::timeout;
    } else if (!(n < 0 && errno == EINTR)) {
      return Outcome::closed;
    }
  }
  return Outcome::ok;
}

SolverProcess::Outcome SolverProcess::read_line(std::string& line, Deadline deadline) {
  while (true) {
    if (const std::size_t end = buffer_.find('\n'); end != std::string::npos) {
      line = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return Outcome::ok;
    }
    if (buffer_.size() > longest_line) return Outcome::too_long;
    if (over(deadline)) return Outcome::timeout;
    poll_one(from_, POLLIN, deadline);
    char chunk[65536];
    const ssize_t n = read(from_, chunk, sizeof chunk);
    if (n > 0) {
      buffer_.append(chunk, static_cast<std::size_t>(n));
    } else if (n == 0 || (errno != EAGAIN && errno != EINTR)) {
      line = std::move(buffer_);
      buffer_.clear();
      return Outcome::closed;
    }
  }
}

std::optional<std::string> SolverProcess::wait(Deadline deadline) {
  while (true) {
    int status = 0;
    listen();  // who is not heard may not come to its end
    const pid_t done = waitpid(pid_, &status, WNOHANG);
    if (done == pid_) {
      running_group = 0;     // its number may be another's from now on
      kill(-pid_, SIGKILL);  // what it may have left running
      pid_ = -1;
      if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) + ")";
      if (WEXITSTATUS(status) == 127) return "exit status 127 (what a shell says that finds no such program)";
      return WEXITSTATUS(status) == 0 ? "" : "exit status " + std::to_string(WEXITSTATUS(status));
    }
    if (done < 0 || over(deadline)) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace gjkdbg
