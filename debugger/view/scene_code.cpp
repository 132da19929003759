#include "debugger/view/scene_code.h"

#include <charconv>

namespace gjkdbg {
namespace {

/// Shortest text that reads back to the same double, and is a double in C++ too.
std::string number(double x) {
  char text[40];
  std::string out(text, std::to_chars(text, text + sizeof text, x).ptr);
  return out.find_first_of(".en") == std::string::npos ? out + ".0" : out;
}

std::string vector(const AnyVector& v) {
  std::string out = "AnyVector{{";
  for (Eigen::Index i = 0; i < v.size(); ++i) out += (i > 0 ? ", " : "") + number(v[i]);
  return out + "}}";
}

std::string points(const std::vector<AnyVector>& list) {
  std::string out = "{";
  for (std::size_t i = 0; i < list.size(); ++i) out += (i > 0 ? ", " : "") + vector(list[i]);
  return out + "}";
}

std::string shape(const Shape& s);

struct Geometry {
  std::string operator()(const Sphere& s) const { return "Sphere{" + number(s.radius) + "}"; }
  std::string operator()(const Box& b) const { return "Box{" + vector(b.min) + ", " + vector(b.max) + ", " + (b.from_half_extents ? "true" : "false") + "}"; }
  template <class Along>
  static std::string along(const char* name, const Along& s) {
    return std::string(name) + "{" + number(s.radius) + ", " + number(s.half_height) + ", " + std::to_string(s.axis) + "}";
  }
  std::string operator()(const Capsule& s) const { return along("Capsule", s); }
  std::string operator()(const Cylinder& s) const { return along("Cylinder", s); }
  std::string operator()(const Cone& s) const { return along("Cone", s); }
  std::string operator()(const Ellipsoid& e) const { return "Ellipsoid{" + vector(e.radii) + "}"; }
  std::string operator()(const PointSet& set) const {
    static const char* const kinds[] = {"point", "segment", "triangle", "polygon", "hull"};
    return std::string("PointSet{PointSetKind::") + kinds[static_cast<std::size_t>(set.kind)] + ", " + points(set.points) + ", {}}";
  }
  std::string operator()(const Mesh& m) const {
    std::string out = "Mesh{" + points(m.points) + ", {";
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const auto& t = m.triangles[i];
      out += (i > 0 ? ", {{" : "{{") + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) + "}}";
    }
    return out + "}, {}}";
  }
  std::string operator()(const Sum& s) const { return "Sum{std::make_shared<const Shape>(" + shape(*s.first) + "), std::make_shared<const Shape>(" + shape(*s.second) + ")}"; }
};

std::string shape(const Shape& s) { return "Shape{" + std::visit(Geometry{}, s.geometry) + ", " + number(s.margin) + "}"; }

std::string matrix(const AnyMatrix& m) {
  std::string out;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) out += (i + j > 0 ? ", " : "") + number(m(i, j));
  return out;
}

}  // namespace

std::string scene_as_cpp(const SceneFile& file) {
  const Scene& scene = file.scene;
  static const char* const queries[] = {"intersect", "distance", "penetration", "contact", "cast", "simulate"};
  std::string out = "// #include \"algo/solve.h\"; link gjkdbg::algo\nusing namespace gjkdbg;\nScene scene;\nscene.name = \"" + scene.name + "\";\nscene.dimension = " +
                    std::to_string(scene.dimension) + ";\nscene.query = Query::" + queries[static_cast<std::size_t>(scene.query)] + ";\nscene.bodies.resize(" + std::to_string(scene.bodies.size()) + ");\n";
  if (scene.motion) {
    const SceneMotion& m = *scene.motion;
    static const char* const responses[] = {"stop", "slide", "bounce"};
    static const char* const integrators[] = {"explicit_euler", "semi_implicit_euler", "rk4"};
    out += std::string("scene.motion = SceneMotion{Response::") + responses[static_cast<std::size_t>(m.response)] + ", " + vector(m.gravity) + ", " + number(m.time_step) + ", " + std::to_string(m.steps) +
           ", Integrator::" + integrators[static_cast<std::size_t>(m.integrator)] + "};\n";
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const std::string it = "scene.bodies[" + std::to_string(i) + "]";
    out += it + ".name = \"" + body.name + "\";\n" + it + ".shape = " + shape(body.shape) + ";\n" + it + ".pose = identity_pose(" + std::to_string(scene.dimension) + ");\n" + it + ".pose.position = " +
           vector(body.pose.position) + ";\n";
    if (body.motion) {
      const Motion& m = *body.motion;
      out += it + ".motion = Motion{" + vector(m.velocity) + ", " + (m.angular_velocity.size() > 0 ? vector(m.angular_velocity) : "{}") + ", " + number(m.mass) + ", " + number(m.restitution) + ", " +
             number(m.friction) + ", " + (m.is_static ? "true" : "false") + "};  // angular velocity in radians\n";
    }
    if (!body.pose.matrix.isIdentity(0)) out += it + ".pose.matrix << " + matrix(body.pose.matrix) + ";  // by rows\n";
  }
  return out + "const Result result = solve(scene, resolve_settings({}, scene));\n";
}

}  // namespace gjkdbg
