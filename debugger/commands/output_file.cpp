#include "debugger/commands/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include "shapes/error.h"

namespace gjkdbg {
namespace {

char part[4096];  ///< the file being written, for the handler

extern "C" void remove_part(int signal) {
  abandon_output();
  std::signal(signal, SIG_DFL);
  raise(signal);
}

/// Whoever ends the program while a file is being written leaves none of it behind. A command that handles the signal itself goes on doing so.
void remove_when_interrupted(const std::string& path) {
  if (path.size() >= sizeof part) return;
  std::memcpy(part, path.c_str(), path.size() + 1);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now;
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_DFL) std::signal(signal, remove_part);
  }
}

}  // namespace

void abandon_output() {
  if (part[0] != 0) unlink(part);
}

OutputFile::OutputFile(const std::string& path) {
  if (path.empty() || path == "-") {
    file_ = stdout;
    return;
  }
  target_ = path;
  std::error_code ignored;
  // A device or a pipe is written in place: nothing can take its place.
  const bool special = std::filesystem::exists(target_, ignored) && !std::filesystem::is_regular_file(target_, ignored);
  if (!special) {
    // A link stays: what it points to is what gets replaced, or made.
    std::error_code broken;
    for (int links = 0; links < 40 && std::filesystem::is_symlink(target_, broken); ++links) target_ = target_.parent_path() / std::filesystem::read_symlink(target_, broken);
    temporary_ = target_;
    temporary_ += ".part" + std::to_string(getpid());
    remove_when_interrupted(temporary_.string());
  }
  file_ = std::fopen((special ? target_ : temporary_).c_str(), "wb");
  if (!file_) {
    temporary_.clear(), part[0] = 0;
    fail();
  }
}

OutputFile::~OutputFile() {
  if (file_ && file_ != stdout) std::fclose(file_);
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored), part[0] = 0;
}

/// A reader that has had enough, as in "gjkdbg dump … | head", is no error.
bool OutputFile::unwanted() const { return file_ == stdout && errno == EPIPE; }

void OutputFile::fail() {
  throw Error("cannot-write", std::string("cannot be written: ") + std::strerror(errno), target_.empty() ? "standard output" : target_.string());
}

bool OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) == text.size()) return true;
  if (!unwanted()) fail();
  return false;
}

bool OutputFile::flush() {
  if (std::fflush(file_) == 0) return true;
  if (!unwanted()) fail();
  return false;
}

void OutputFile::commit() {
  flush();
  if (file_ == stdout) return;
  std::FILE* const file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) fail();
  if (temporary_.empty()) return;
  std::error_code error;
  // Who may read what was there may read what takes its place.
  if (const auto before = std::filesystem::status(target_, error); std::filesystem::exists(before)) std::filesystem::permissions(temporary_, before.permissions(), error);
  std::filesystem::rename(temporary_, target_, error);
  if (error) {
    errno = error.value();
    fail();
  }
  temporary_.clear(), part[0] = 0;
}

void write_output(const std::string& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw Error("cannot-write", "cannot be made: " + error.message(), path);
  const OutputFile first((std::filesystem::path(path) / "first").string());  // fails before the work and not after it, and leaves nothing
}

}  // namespace gjkdbg
