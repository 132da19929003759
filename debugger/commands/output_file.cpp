#include "debugger/commands/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "shapes/error.h"

namespace gjkdbg {

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
    // A link stays: what it points to is what gets replaced.
    std::error_code broken;
    if (const auto real = std::filesystem::canonical(target_, broken); !broken) target_ = real;
    temporary_ = target_;
    temporary_ += ".part" + std::to_string(getpid());
  }
  file_ = std::fopen((special ? target_ : temporary_).c_str(), "wb");
  if (!file_) {
    temporary_.clear();
    fail();
  }
}

OutputFile::~OutputFile() {
  if (file_ && file_ != stdout) std::fclose(file_);
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

/// A reader that has had enough, as in "gjkdbg dump … | head", is no error.
bool OutputFile::unwanted() const { return file_ == stdout && errno == EPIPE; }

void OutputFile::fail() {
  throw Error("cannot-write", std::string("cannot be written: ") + std::strerror(errno), target_.empty() ? "standard output" : target_.string());
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() && !unwanted()) fail();
}

void OutputFile::commit() {
  if (std::fflush(file_) != 0 && !unwanted()) fail();
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
  temporary_.clear();
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
}

}  // namespace gjkdbg
