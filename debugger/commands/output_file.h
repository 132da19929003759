// Output that is written whole or not at all.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace gjkdbg {

/// Writes to standard output when the path is empty or "-", else to a temporary file beside the target that takes its place in `commit`.
/// Without a commit nothing is left behind. Throws Error when anything cannot be written.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// False when nobody reads standard output any more.
  bool write(std::string_view text);
  /// What was written, out of our hands; a file still takes its place in `commit` only. False as above.
  bool flush();
  void commit();

 private:
  [[noreturn]] void fail();
  bool unwanted() const;
  std::filesystem::path target_, temporary_;
  std::FILE* file_ = nullptr;
};

/// Of a program that ends where it stands: what is being written is not left behind. Allocates nothing.
void abandon_output();

/// All of it, at once.
void write_output(const std::string& path, std::string_view text);

/// A folder and those above it, if they are not there. Throws Error, also when nothing can be written in it.
void make_folder(const std::string& path);

}  // namespace gjkdbg
