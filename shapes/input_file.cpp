#include "shapes/input_file.h"

#include <cerrno>
#include <cstring>

#include "shapes/error.h"

namespace gjkdbg {

std::ifstream open_input(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw Error("missing-file", "cannot be read: is a directory", file.string());
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error("missing-file", std::string("cannot be read") + (errno != 0 ? std::string(": ") + std::strerror(errno) : ""), file.string());
  return in;
}

std::filesystem::path directory_of(const std::filesystem::path& file) {
  std::error_code ignored;
  const bool other = std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored);
  return other ? std::filesystem::path() : file.parent_path();
}

}  // namespace gjkdbg
