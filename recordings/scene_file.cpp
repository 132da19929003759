#include "recordings/scene_file.h"

#include <sstream>

#include "recordings/json_reading.h"
#include "shapes/input_file.h"

namespace gjkdbg {

SceneFile parse_scene(std::string_view text, const std::filesystem::path& directory) {
  return scene_from_json(parse_json(text), directory);
}

std::string read_text_file(const std::filesystem::path& file) {
  std::ifstream in = open_input(file);
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) throw Error("missing-file", "cannot be read", file.string());
  return text.str();
}

SceneFile read_scene(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  try {
    return parse_scene(text, directory_of(file));
  } catch (const Error& e) {
    throw e.in(file.string());
  }
}

}  // namespace gjkdbg
