#include "shapes/obj_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

#include "shapes/error.h"
#include "shapes/input_file.h"
#include "shapes/polygon_triangles.h"
#include "shapes/shape.h"

namespace gjkdbg {
namespace {

/// What OBJ files may hold; of it, vertices and faces matter here.
constexpr std::string_view statements[] = {"v", "vt", "vn", "vp", "p", "l", "f", "g", "s", "o", "mg", "usemtl", "mtllib", "usemap", "maplib", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm",
                                           "trim", "hole", "scrv", "sp", "end", "con", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "ctech", "stech", "call", "csh"};

AnyVector read_vertex(std::istream& words, const std::string& place) {
  AnyVector p(3);
  for (int i = 0; i < 3; ++i) {
    std::string word;
    words >> word;
    char* end = nullptr;
    p[i] = std::strtod(word.c_str(), &end);
    if (word.empty() || end != word.data() + word.size()) throw Error("bad-mesh", "a vertex needs three numbers", place);
    if (!std::isfinite(p[i])) throw Error("non-finite", "a vertex must be finite", place);
    if (std::abs(p[i]) > largest_length) throw Error("too-large", "a vertex must not exceed 1e60 in magnitude", place);
  }
  return p;
}

/// A corner is a vertex, perhaps with texture and normal: 1, 1/2, 1//3, 1/2/3. Vertices count from 1, or from the latest, -1, backwards.
std::vector<int> read_face(std::istream& words, std::size_t so_far, std::size_t in_all, const std::string& place) {
  std::vector<int> corners;
  for (std::string word; words >> word;) {
    int vertex = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), vertex);
    const std::string_view rest(end, word.data() + word.size());
    if (error != std::errc() || (!rest.empty() && rest[0] != '/') || rest.find_first_not_of("/-0123456789") != rest.npos)
      throw Error("bad-mesh", "\"" + word + "\" is no corner of a face", place);
    if (vertex == 0 || (vertex > 0 && static_cast<std::size_t>(vertex) > in_all) || (vertex < 0 && static_cast<std::size_t>(-static_cast<long>(vertex)) > so_far))
      throw Error("wrong-index", "a face names the vertex " + std::to_string(vertex) + ", which is not there", place);
    corners.push_back(vertex > 0 ? vertex - 1 : static_cast<int>(so_far) + vertex);
  }
  if (corners.size() < 3) throw Error("bad-mesh", "a face needs three vertices", place);
  return corners;
}

/// Line by line, what comes before a #; and without the mark some editors put before everything. A line that ends in \ goes on in the next:
/// the statement is written as one, and as many empty lines follow it.
std::string without_comments(std::istream& in) {
  // Lines may end in \r alone, as on old systems.
  std::string all(std::istreambuf_iterator<char>(in), {});
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i] == '\r' && (i + 1 == all.size() || all[i + 1] != '\n')) all[i] = '\n';
  std::istringstream lines(all);
  std::string out, owed;
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::min(line.size(), line.find('#')));
    line.resize(line.find_last_not_of(" \t\r") + 1);
    const bool goes_on = line.ends_with('\\');
    if (goes_on) line.back() = ' ', owed += '\n';
    out += line;
    if (!goes_on) out += '\n' + std::exchange(owed, "");
  }
  out += owed;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  return out.starts_with(byte_order_mark) ? out.substr(byte_order_mark.size()) : out;
}

/// From their lines, so that anything malformed is named with its line. Packaged loaders read single precision, skip what they do not understand, and cut a quadrilateral
/// along its shorter diagonal though that may lie outside.
ObjMesh read_statements(const std::string& text, const std::string& name) {
  ObjMesh mesh;
  const auto for_lines = [&](auto&& line_of) {
    std::istringstream in(text);
    std::string line, keyword;
    for (int number = 1; std::getline(in, line); ++number)
      if (std::istringstream words(line); words >> keyword) line_of(keyword, words, name + ": line " + std::to_string(number));
  };
  for_lines([&](const std::string& keyword, std::istream& words, const std::string& place) {
    if (keyword == "v") mesh.points.push_back(read_vertex(words, place));
    else if (std::find(std::begin(statements), std::end(statements), keyword) == std::end(statements)) throw Error("bad-mesh", "\"" + keyword.substr(0, 40) + "\" is no statement of OBJ", place);
  });
  std::size_t so_far = 0;
  for_lines([&](const std::string& keyword, std::istream& words, const std::string& place) {
    if (keyword == "v") ++so_far;
    if (keyword != "f") return;
    const auto triangles = polygon_triangles(mesh.points, read_face(words, so_far, mesh.points.size(), place));
    mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
  });
  return mesh;
}

}  // namespace

ObjMesh read_obj(const std::filesystem::path& file) {
  const std::string name = file.string();
  auto input = open_input(file);
  ObjMesh mesh = read_statements(without_comments(input), name);
  if (mesh.points.empty()) throw Error("no-points", "holds no vertices", name);
  return mesh;
}

}  // namespace gjkdbg
