// Puts a C++ program under gjkdbg: gjkdbg run SCENE --exec ./my_gjk
//
// One header, no dependency, C++17. Wait for the scene, ask for supports, report what you do (optional), give the result:
//
//   gjkdbg::Solver solver;                       // reads the scene
//   gjkdbg::Vertex x = solver.support({1, 0, 0});
//   solver.simplex({x.number});
//   solver.result(false, 0.5, {1, 0, 0}, x.a, x.b);
#pragma once

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace gjkdbg {

using Vec = std::vector<double>;  ///< as many numbers as the scene's dimension

/// A support point: w = a - b; `number` is its name in messages.
struct Vertex {
  int number = -1;
  Vec w, a, b;
};

class Solver {
 public:
  int dimension = 3;
  std::string query;
  double tolerance = 0;

  Solver() {
    const std::string line = read();
    dimension = static_cast<int>(number(line, "dimension"));
    tolerance = number(line, "tolerance");
    const std::size_t at = line.find("\"query\":\"") + 9;
    query = line.substr(at, line.find('"', at) - at);
  }

  Vertex support(const Vec& direction) {
    say("{\"type\":\"support\",\"direction\":" + text(direction) + "}");
    const std::string line = read();
    return {static_cast<int>(number(line, "vertex\":")), vector(line, "w"), vector(line, "a"), vector(line, "b")};
  }

  void simplex(const std::vector<int>& newest_first, const Vec& closest = {}) {
    say("{\"type\":\"simplex\",\"vertices\":" + text(newest_first) + (closest.empty() ? "" : ",\"closest\":" + text(closest)) + "}");
  }
  void polytope(const std::vector<std::vector<int>>& faces) {
    std::string list;
    for (const auto& face : faces) list += (list.empty() ? "" : ",") + text(face);
    say("{\"type\":\"polytope\",\"faces\":[" + list + "]}");
  }
  void face(const std::vector<int>& vertices, const Vec& normal, double distance) {
    say("{\"type\":\"face\",\"vertices\":" + text(vertices) + ",\"normal\":" + text(normal) + ",\"distance\":" + text(distance) + "}");
  }
  void result(bool intersecting, std::optional<double> signed_distance = {}, const Vec& normal = {}, const Vec& witness_a = {}, const Vec& witness_b = {}) {
    std::string out = std::string("{\"type\":\"result\",\"intersecting\":") + (intersecting ? "true" : "false");
    if (signed_distance) out += ",\"signed_distance\":" + text(*signed_distance);
    if (!normal.empty()) out += ",\"normal\":" + text(normal);
    if (!witness_a.empty()) out += ",\"witness_a\":" + text(witness_a) + ",\"witness_b\":" + text(witness_b);
    say(out + "}");
  }

 private:
  static void say(const std::string& line) { std::cout << line << std::endl; }
  static std::string read() {
    std::string line;
    if (!std::getline(std::cin, line)) std::exit(1);
    return line;
  }
  static std::string text(double x) {
    char out[32];
    std::snprintf(out, sizeof out, "%.17g", x);
    return out;
  }
  static std::string text(int x) { return std::to_string(x); }
  template <class T>
  static std::string text(const std::vector<T>& list) {
    std::string out = "[";
    for (const T& x : list) out += (out.size() > 1 ? "," : "") + text(x);
    return out + "]";
  }
  /// Where a field's value begins. The replies are written by gjkdbg, without spaces.
  static const char* value(const std::string& line, const std::string& key) {
    const std::string quoted = key.back() == ':' ? "\"" + key : "\"" + key + "\":";
    return line.c_str() + line.find(quoted) + quoted.size();
  }
  static double number(const std::string& line, const std::string& key) { return std::strtod(value(line, key), nullptr); }
  static Vec vector(const std::string& line, const std::string& key) {
    Vec out;
    char* at = const_cast<char*>(value(line, key));
    while (*at != ']' && *at != '\0') out.push_back(std::strtod(at + 1, &at));
    return out;
  }
};

}  // namespace gjkdbg
