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

}  // namespace gjkdbg
