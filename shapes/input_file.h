// Files that are read.
#pragma once

#include <filesystem>
#include <fstream>

namespace gjkdbg {

/// Opened for reading, bytes as they are. Throws Error that says why it cannot be: not there, a directory, …
std::ifstream open_input(const std::filesystem::path& file);

/// Where the files it names are looked for: beside it; from here, if it is a pipe or a device, as standard input is.
std::filesystem::path directory_of(const std::filesystem::path& file);

}  // namespace gjkdbg
