// A scene file: the scene, the method it asks for, and the answer it expects. JSON both ways.
//
// The format is documented in recordings/README.md; its schema is recordings/schema/scene.schema.json.
#pragma once

#include <filesystem>
#include <map>
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
  std::optional<double> time;  ///< of a cast
  double tolerance = 1e-9;  ///< absolute: on the signed distance, on `time` and on every component of the normal
};

struct SceneFile {
  Scene scene;
  Method method;
  std::optional<Expectation> expect;
  std::string id;         ///< "id", anything, as JSON text; empty when absent
  std::map<std::string, std::string> notes;  ///< by JSON pointer: what anything below the top level carries of `id`, `name`, `description`, `source` and `tags`, a JSON object
  std::filesystem::path directory;  ///< where relative mesh paths start; not written
};

/// Parses and validates. Throws Error; place: a JSON pointer, or "line L, column C" when the text is no JSON.
/// `directory` is where relative mesh paths start.
SceneFile parse_scene(std::string_view text, const std::filesystem::path& directory);
SceneFile scene_from_json(const nlohmann::ordered_json& json, const std::filesystem::path& directory);

/// The whole of a file. Throws Error when it cannot be read.
std::string read_text_file(const std::filesystem::path& file);

/// Reads a file; Error's place is then "FILE: pointer".
SceneFile read_scene(const std::filesystem::path& file);

/// How points that came from an OBJ file are written: as the file's name, or in place (in a recording, which must stand alone).
enum class MeshNotation { by_name, in_place };

/// The scene as JSON: reads back to the same scene, bit for bit. Numbers in shortest round-trip form.
nlohmann::ordered_json scene_to_json(const SceneFile& scene, MeshNotation notation = MeshNotation::by_name);

/// A method's settings alone, as in a scene; of a scene of the given dimension. Throws Error under `pointer`.
Method method_from_json(const nlohmann::ordered_json& json, const std::string& pointer, int dimension);

/// Degrees, as files have them, and radians, as the code has them. Quarter turns are exact, and degrees that were read are
/// written back so that they give the same radians bit for bit.
double radians_from_degrees(double degrees);
double degrees_from_radians(double radians);

}  // namespace gjkdbg
