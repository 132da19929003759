// The scene as C++ that builds it with this library: to paste into a test.
#pragma once

#include <string>

#include "recordings/scene_file.h"

namespace gjkdbg {

std::string scene_as_cpp(const SceneFile& scene);

}  // namespace gjkdbg
