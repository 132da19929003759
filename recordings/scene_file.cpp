#include "recordings/scene_file.h"

#include <fstream>
#include <sstream>

#include "recordings/json_reading.h"

namespace gjkdbg {

SceneFile parse_scene(std::string_view text, const std::filesystem::path& directory) {
  return scene_from_json(parse_json(text), directory);
}

std::string read_text_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) throw Error("missing-file", "cannot be read", file.string());
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) throw Error("missing-file", "cannot be read", file.string());
  return text.str();
}

SceneFile read_scene(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  try {
    return parse_scene(text, file.parent_path());
  } catch (const Error& e) {
    throw Error(e.code(), e.message(), file.string() + (e.where().empty() ? "" : ": " + e.where()));
  }
}

}  // namespace gjkdbg
