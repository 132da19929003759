#include "shapes/obj_file.h"

#include <tiny_obj_loader.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "shapes/error.h"

namespace gjkdbg {
namespace {

/// tinyobjloader reads single precision and skips what it cannot read; vertices are therefore taken from their lines,
/// in double, and anything malformed is named.
std::vector<AnyVector> read_vertices(std::istream& in, const std::string& name) {
  std::vector<AnyVector> points;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string keyword;
    if (!(words >> keyword) || keyword != "v") continue;
    AnyVector p(3);
    const std::string place = name + ": line " + std::to_string(number);
    for (int i = 0; i < 3; ++i) {
      std::string word;
      words >> word;
      char* end = nullptr;
      p[i] = std::strtod(word.c_str(), &end);
      if (word.empty() || *end != '\0') throw Error("bad-mesh", "a vertex needs three numbers", place);
      if (!std::isfinite(p[i])) throw Error("non-finite", "a vertex must be finite", place);
    }
    points.push_back(p);
  }
  return points;
}

}  // namespace

ObjMesh read_obj(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) throw Error("missing-file", "cannot be read", name);
  std::ostringstream whole;
  whole << in.rdbuf();
  std::istringstream lines(whole.str()), text(whole.str());
  ObjMesh mesh;
  mesh.points = read_vertices(lines, name);
  if (mesh.points.empty()) throw Error("no-points", "holds no vertices", name);

  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::string warning, error;
  if (!tinyobj::LoadObj(&attributes, &shapes, nullptr, &warning, &error, &text, nullptr, true))
    throw Error("bad-mesh", error.empty() ? "is no OBJ file" : error.substr(0, error.find('\n')), name);
  for (const tinyobj::shape_t& shape : shapes) {
    const auto& indices = shape.mesh.indices;
    for (std::size_t k = 0; k + 2 < indices.size(); k += 3) {
      std::array<int, 3> triangle{};
      for (int i = 0; i < 3; ++i) {
        triangle[i] = indices[k + i].vertex_index;
        if (triangle[i] < 0 || triangle[i] >= static_cast<int>(mesh.points.size()))
          throw Error("wrong-index", "a face names a vertex that is not there", name);
      }
      mesh.triangles.push_back(triangle);
    }
  }
  return mesh;
}

}  // namespace gjkdbg
