// A scene file: the scene, the method it asks for, and the answer it expects. JSON both ways.
//
// The format is documented in recordings/README.md; its schema is recordings/schema/scene.schema.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "algo/settings.h"
#include "shapes/error.h"
#include "shapes/scene.h"

namespace gjkdbg {

/// What a scene says the answer is; only what is set is compared.
struct Expectation {
  std::optional<bool> intersecting;
  std::optional<double> signed_distance;
  std::optional<AnyVector> normal;
  double tolerance = 1e-9;  ///< absolute, on the signed distance and on every component of the normal
};

struct SceneFile {
  Scene scene;
  Method method;
  std::optional<Expectation> expect;
  std::string id;         ///< "id" of a line of `query`, as JSON text (string or number); empty when absent
  std::filesystem::path directory;  ///< where relative mesh paths start; not written
};

/// Parses and validates. Throws Error; place: a JSON pointer, or "line L, column C" when the text is no JSON.
/// `directory` is where relative mesh paths start.
SceneFile parse_scene(std::string_view text, const std::filesystem::path& directory);
SceneFile scene_from_json(const nlohmann::json& json, const std::filesystem::path& directory);

/// Reads a file; Error's place is then "FILE: pointer".
SceneFile read_scene(const std::filesystem::path& file);

/// The scene as JSON: reads back to the same scene, bit for bit. Numbers in shortest round-trip form.
nlohmann::ordered_json scene_to_json(const SceneFile& scene);

}  // namespace gjkdbg
