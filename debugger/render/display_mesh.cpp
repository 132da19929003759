#include "debugger/render/display_mesh.h"

#include <cmath>
#include <map>
#include <numbers>

#include "shapes/convex.h"
#include "shapes/convex_hull.h"
#include "shapes/corners.h"
#include "shapes/world_support.h"

namespace gjkdbg {

ViewPoint to_view(const AnyVector& v) { return in_space(v); }

namespace {

using Points = std::vector<AnyVector>;
constexpr double crease_cosine = 0.92;  ///< faces that meet at a sharper angle show their edge
constexpr std::size_t most_pairs = 40000;

/// Directions spread over the sphere (Fibonacci lattice) or the circle, with the axes among them.
Points directions(int dimension) {
  Points out;
  for (int i = 0; i < dimension; ++i)
    for (const double s : {1.0, -1.0}) out.push_back(s * AnyVector::Unit(dimension, i));
  if (dimension == 2) {
    for (int i = 0; i < 128; ++i) {
      const double t = i * std::numbers::pi / 64;
      out.push_back(Eigen::Vector2d(std::cos(t), std::sin(t)));
    }
  }
  if (dimension == 3) {
    // Rings of latitude: they keep the rims of cylinders and cones round.
    for (int i = 1; i < 18; ++i)
      for (int k = 0; k < 36; ++k) {
        const double u = i * std::numbers::pi / 18, t = k * std::numbers::pi / 18;
        out.push_back(Eigen::Vector3d(std::sin(u) * std::cos(t), std::cos(u), std::sin(u) * std::sin(t)));
      }
  }
  return out;
}

template <int D>
Points sampled(const Shape& shape, bool with_radius) {
  const Convex<D, double> convex(shape);
  Points out;
  for (const AnyVector& any : directions(D)) {
    const Vector<D, double> d = any;
    Vector<D, double> p = convex.reference() + convex.support(d);
    if (with_radius) p += convex.radius() * d.normalized();
    out.push_back(p);
  }
  return out;
}

Points points_of(const Shape& shape, int dimension, bool with_radius) {
  if (const auto corners = corners_of(shape, dimension); corners && (!with_radius || corners->radius == 0)) return corners->points;
  if (dimension == 1) return sampled<1>(shape, with_radius);
  return dimension == 2 ? sampled<2>(shape, with_radius) : sampled<3>(shape, with_radius);
}

/// The extreme ones only.
Points extreme(const Points& points, int dimension) {
  Points out;
  for (const int i : convex_hull(points, dimension).vertices) out.push_back(points[static_cast<std::size_t>(i)]);
  return out;
}

void add_edges(DisplayMesh& mesh) {
  std::map<std::pair<int, int>, DisplayMesh::DisplayEdge> edges;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int p = face[i], q = face[(i + 1) % face.size()];
      auto [found, is_new] = edges.try_emplace({std::min(p, q), std::max(p, q)}, DisplayMesh::DisplayEdge{p, q, static_cast<int>(f), -1, true});
      if (!is_new) found->second.face_b = static_cast<int>(f);
    }
  }
  for (auto& [key, edge] : edges) {
    if (mesh.dimension == 3 && edge.face_b >= 0)
      edge.crease = mesh.normals[static_cast<std::size_t>(edge.face_a)].dot(mesh.normals[static_cast<std::size_t>(edge.face_b)]) < crease_cosine;
    mesh.edges.push_back(edge);
  }
}

DisplayMesh hull_mesh(const Points& points, int dimension) {
  DisplayMesh mesh;
  mesh.dimension = dimension;
  for (const AnyVector& p : points) mesh.points.push_back(to_view(p));
  const ConvexHull hull = convex_hull(points, dimension);
  mesh.faces = hull.faces;
  for (const auto& face : mesh.faces) {
    ViewPoint n = ViewPoint::Zero();
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(face[k])]; };
      n += (at(i) - at(0)).cross(at(i + 1) - at(0));
    }
    mesh.normals.push_back(n.stableNormalized());
  }
  if (mesh.faces.empty()) {
    if (hull.rank == 1) mesh.edges.push_back({hull.vertices.front(), hull.vertices.back(), -1, -1, true});
    if (hull.rank == 0) mesh.edges.push_back({hull.vertices.front(), hull.vertices.front(), -1, -1, true});
  } else {
    add_edges(mesh);
  }
  return mesh;
}

DisplayMesh triangle_mesh(const Mesh& mesh, const Pose& pose) {
  DisplayMesh out;
  for (const AnyVector& p : mesh.points) out.points.push_back(to_view(pose.matrix * p + pose.position));
  for (const auto& t : mesh.triangles) {
    out.faces.push_back({t.begin(), t.end()});
    const auto at = [&](std::size_t k) { return out.points[static_cast<std::size_t>(t[k])]; };
    out.normals.push_back((at(1) - at(0)).cross(at(2) - at(0)).stableNormalized());
  }
  add_edges(out);
  for (auto& edge : out.edges) edge.crease = true;
  return out;
}

Points in_world(Points points, const Pose& pose) {
  for (AnyVector& p : points) p = pose.matrix * p + pose.position;
  return points;
}

}  // namespace

DisplayMesh body_mesh(const Body& body, int dimension) {
  if (const Mesh* mesh = std::get_if<Mesh>(&body.shape.geometry)) return triangle_mesh(*mesh, body.pose);
  return hull_mesh(in_world(points_of(body.shape, dimension, true), body.pose), dimension);
}

DisplayMesh difference_mesh(const Body& a, const Body& b, int dimension, bool whole) {
  if (std::holds_alternative<Mesh>(a.shape.geometry) || std::holds_alternative<Mesh>(b.shape.geometry)) return {};
  Points difference;
  const auto corners_a = corners_of(a.shape, dimension), corners_b = corners_of(b.shape, dimension);
  if (!(whole && radius_sum(a, b, dimension) > 0) && corners_a && corners_b && corners_a->points.size() * corners_b->points.size() <= most_pairs) {
    const Points pa = extreme(in_world(corners_a->points, a.pose), dimension), pb = extreme(in_world(corners_b->points, b.pose), dimension);
    for (const AnyVector& p : pa)
      for (const AnyVector& q : pb) difference.push_back(p - q);
  } else {
    // Round, or too many pairs for a picture: supports of the difference, whose every point is on its boundary.
    const WorldSupport support_a(a, dimension), support_b(b, dimension);
    for (const AnyVector& d : directions(dimension)) difference.push_back(support_a(a.pose.matrix * d, whole) - support_b(-(a.pose.matrix * d), whole));
  }
  return hull_mesh(difference, dimension);
}

double radius_sum(const Body& a, const Body& b, int dimension) {
  const auto radius = [&](const Body& body) {
    if (std::holds_alternative<Mesh>(body.shape.geometry)) return body.shape.margin;
    return dimension == 1 ? Convex<1, double>(body.shape).radius() : dimension == 2 ? Convex<2, double>(body.shape).radius() : Convex<3, double>(body.shape).radius();
  };
  return radius(a) + radius(b);
}

}  // namespace gjkdbg
