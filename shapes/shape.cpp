#include "shapes/shape.h"

#include <cmath>

#include "shapes/error.h"

namespace gjkdbg {
namespace {

std::string axis_name(int i) { return "/" + std::to_string(i); }

void check_finite(double x, const std::string& where) {
  if (!std::isfinite(x)) throw Error("non-finite", "must be a finite number", where);
  if (std::abs(x) > largest_length) throw Error("too-large", "must not exceed 1e60 in magnitude", where);
}

void check_size(double x, const std::string& where) {
  check_finite(x, where);
  if (x < 0) throw Error("negative-size", "must not be negative", where);
}

void check_vector(const AnyVector& v, int dimension, const std::string& where) {
  if (v.size() != dimension) throw Error("wrong-dimension", "must have " + std::to_string(dimension) + " numbers", where);
  for (int i = 0; i < dimension; ++i) check_finite(v[i], where + axis_name(i));
}

/// Walks one geometry; the visitor's state is the dimension.
struct Check {
  int dimension;

  void need(bool exists, const std::string& message) const {
    if (!exists) throw Error("wrong-dimension", message + " (the scene's dimension is " + std::to_string(dimension) + ")", "/type");
  }

  void operator()(const Sphere& s) const {
    need(dimension >= 2, "a ball exists in 2D (circle) and 3D (sphere) only");
    check_size(s.radius, "/radius");
  }
  void operator()(const Box& b) const {
    const char* low = b.from_half_extents && dimension > 1 ? "/half_extents" : "/min";
    const char* high = b.from_half_extents && dimension > 1 ? "/half_extents" : "/max";
    check_vector(b.min, dimension, low);
    check_vector(b.max, dimension, high);
    for (int i = 0; i < dimension; ++i) {
      if (b.min[i] <= b.max[i]) continue;
      const std::string at = dimension == 1 ? "" : axis_name(i);
      if (b.from_half_extents && dimension > 1) throw Error("negative-size", "must not be negative", high + at);
      throw Error("empty-interval", "min must not exceed max", low + at);
    }
  }
  void operator()(const Capsule& c) const {
    need(dimension >= 2, "a capsule exists in 2D and 3D only");
    round_around_axis(c);
  }
  void operator()(const Cylinder& c) const {
    need(dimension == 3, "a cylinder exists in 3D only; in 2D use a box");
    round_around_axis(c);
  }
  void operator()(const Cone& c) const {
    need(dimension == 3, "a cone exists in 3D only; in 2D use a triangle");
    round_around_axis(c);
  }
  void operator()(const Ellipsoid& e) const {
    need(dimension >= 2, "an ellipsoid exists in 2D (ellipse) and 3D only");
    check_vector(e.radii, dimension, "/radii");
    for (int i = 0; i < dimension; ++i) check_size(e.radii[i], "/radii" + axis_name(i));
  }
  void operator()(const PointSet& p) const {
    need(dimension >= 2, "point sets exist in 2D and 3D only; in 1D use an interval");
    if (p.kind == PointSetKind::polygon) need(dimension == 2, "a polygon exists in 2D only; in 3D use a hull");
    if (p.kind == PointSetKind::hull) need(dimension == 3, "a hull exists in 3D only; in 2D use a polygon");
    if (p.points.empty()) throw Error("no-points", "must hold at least one point", "/points");
    const std::size_t wanted = p.kind == PointSetKind::point ? 1 : p.kind == PointSetKind::segment ? 2 : p.kind == PointSetKind::triangle ? 3 : 0;
    if (wanted > 0 && p.points.size() != wanted)
      throw Error("wrong-point-count", "must hold " + std::to_string(wanted) + (wanted == 1 ? " point" : " points"), "/points");
    for (std::size_t i = 0; i < p.points.size(); ++i) check_vector(p.points[i], dimension, "/points/" + std::to_string(i));
  }
  void operator()(const Mesh& m) const {
    need(dimension == 3, "a mesh exists in 3D only");
    for (std::size_t i = 0; i < m.points.size(); ++i) check_vector(m.points[i], dimension, "/points/" + std::to_string(i));
    if (m.triangles.empty()) throw Error("no-points", "must hold at least one triangle", m.mesh.empty() ? "/triangles" : "/mesh");
    for (std::size_t t = 0; t < m.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (m.triangles[t][k] < 0 || m.triangles[t][k] >= static_cast<int>(m.points.size()))
          throw Error("wrong-index", "is no index into the points", "/triangles/" + std::to_string(t) + "/" + std::to_string(k));
  }
  void operator()(const Sum& s) const {
    const Shape* parts[2] = {s.first.get(), s.second.get()};
    for (int i = 0; i < 2; ++i) {
      const std::string where = "/of/" + std::to_string(i);
      if (!parts[i]) throw Error("missing-field", "needs two shapes", "/of");
      if (std::holds_alternative<Mesh>(parts[i]->geometry)) throw Error("not-convex", "a mesh cannot be part of a sum", where);
      try {
        validate(*parts[i], dimension);
      } catch (const Error& e) {
        throw e.within(where);
      }
    }
  }

 private:
  template <class Round>
  void round_around_axis(const Round& r) const {
    check_size(r.radius, "/radius");
    check_size(r.half_height, "/half_height");
    if (r.axis < 0 || r.axis >= dimension) throw Error("wrong-dimension", "names an axis the scene does not have", "/axis");
  }
};

}  // namespace

void validate(const Shape& shape, int dimension) {
  std::visit(Check{dimension}, shape.geometry);
  check_size(shape.margin, "/margin");
}

Shape scaled(const Shape& shape, double by) {
  Shape out = shape;
  out.margin *= by;
  std::visit(
      [by](auto& g) {
        if constexpr (requires { g.radius; }) g.radius *= by;
        if constexpr (requires { g.half_height; }) g.half_height *= by;
        if constexpr (requires { g.radii; }) g.radii *= by;
        if constexpr (requires { g.min, g.max; }) g.min *= by, g.max *= by;
        if constexpr (requires { g.points; })
          for (AnyVector& p : g.points) p *= by;
        if constexpr (requires { g.first, g.second; })
          for (std::shared_ptr<const Shape>* part : {&g.first, &g.second}) *part = std::make_shared<const Shape>(scaled(**part, by));
      },
      out.geometry);
  return out;
}

std::string type_name(const Shape& shape, int dimension) {
  struct Name {
    int dimension;
    std::string operator()(const Sphere&) const { return dimension == 2 ? "circle" : "sphere"; }
    std::string operator()(const Box&) const { return dimension == 1 ? "interval" : "box"; }
    std::string operator()(const Capsule&) const { return "capsule"; }
    std::string operator()(const Cylinder&) const { return "cylinder"; }
    std::string operator()(const Cone&) const { return "cone"; }
    std::string operator()(const Ellipsoid&) const { return dimension == 2 ? "ellipse" : "ellipsoid"; }
    std::string operator()(const PointSet& p) const {
      static constexpr const char* names[] = {"point", "segment", "triangle", "polygon", "hull"};
      return names[static_cast<int>(p.kind)];
    }
    std::string operator()(const Mesh&) const { return "mesh"; }
    std::string operator()(const Sum&) const { return "sum"; }
  };
  return std::visit(Name{dimension}, shape.geometry);
}

}  // namespace gjkdbg
