// The gallery: scenes in lessons, in the order a student walks them.
//
// `lessons.json` lists the lessons; every scene is a file beside it, named after its first column here.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gjkdbg {

struct Lesson {
  std::string title, text;
  std::vector<std::string> scenes;  ///< names; the file is NAME.scene.json
};

struct Gallery {
  std::filesystem::path directory;
  std::vector<Lesson> lessons;

  std::filesystem::path file(const std::string& scene) const { return directory / (scene + ".scene.json"); }
};

/// Reads DIRECTORY/lessons.json. Throws Error when it is not there or not of the form above.
Gallery read_gallery(const std::filesystem::path& directory);

}  // namespace gjkdbg
