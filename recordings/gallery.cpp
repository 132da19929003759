#include "recordings/gallery.h"

#include "recordings/json_reading.h"
#include "recordings/scene_file.h"

namespace gjkdbg {
namespace {

std::vector<Lesson> lessons_from_json(const Json& json) {
  const Place root;
  ObjectReader o(json, root);
  if (read_string(o.required("format"), o.at("format")) != "gjk-lessons") reject(o.at("format"), "wrong-format", "must be \"gjk-lessons\"");
  read_integer(o.required("version"), o.at("version"), 1, 1);
  const Json& list = o.required("lessons");
  const Place at = o.at("lessons");
  if (!list.is_array()) reject(at, "wrong-type", "must be an array of lessons");
  o.finish();
  std::vector<Lesson> lessons;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Place here(at, i);
    ObjectReader l(list[i], here);
    Lesson lesson{read_string(l.required("title"), l.at("title")), read_string(l.required("text"), l.at("text")), {}};
    const Json& scenes = l.required("scenes");
    const Place at_scenes = l.at("scenes");
    if (!scenes.is_array()) reject(at_scenes, "wrong-type", "must be an array of names");
    for (std::size_t k = 0; k < scenes.size(); ++k) lesson.scenes.push_back(read_string(scenes[k], Place(at_scenes, k)));
    l.finish();
    lessons.push_back(std::move(lesson));
  }
  return lessons;
}

}  // namespace

Gallery read_gallery(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / "lessons.json";
  const std::string text = read_text_file(file);
  try {
    return {directory, lessons_from_json(parse_json(text))};
  } catch (const Error& e) {
    throw e.in(file.string());
  }
}

}  // namespace gjkdbg
