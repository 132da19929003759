#include "debugger/lab/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <thread>

#include "shapes/error.h"

namespace gjkdbg {

ChildEnd in_child(double seconds, void* answer, std::size_t size, const std::function<void(void*)>& work) {
  // Memory both see: nothing to send, and nothing half sent.
  void* shared = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) throw Error("out-of-memory", "no memory to share with a child process", "");
  std::memcpy(shared, answer, size);
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    signal(SIGABRT, SIG_DFL), signal(SIGINT, SIG_IGN);
    try {
      work(shared);
    } catch (...) {
      _exit(1);
    }
    _exit(0);
  }
  if (child < 0) {
    munmap(shared, size);
    throw Error("out-of-memory", "no child process can be made", "");
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  int status = 0;
  bool late = false;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (!late && std::chrono::steady_clock::now() > end) late = true, kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::memcpy(answer, shared, size);
  munmap(shared, size);
  if (late) return ChildEnd::timed_out;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? ChildEnd::finished : ChildEnd::crashed;
}

}  // namespace gjkdbg
