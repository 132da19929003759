#include "shapes/mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "shapes/convex.h"
#include "shapes/convex_hull.h"

namespace gjkdbg {
namespace {

using Point = Vector<3, double>;
using Tensor = Matrix<3, double>;
using std::numbers::pi;

/// Volume, first and second moments: integrals of 1, x and x x^T.
struct Moments {
  double volume = 0;
  Point first = Point::Zero();
  Tensor second = Tensor::Zero();

  /// A simplex with vertices v_0 … v_k and volume V has first moment V s / (k + 1) and second V (sum v v^T + s s^T) / ((k + 1) (k + 2)),
  /// s the sum of the vertices (integrals of barycentric coordinates: i! j! … k! / (i + j + … + k)!).
  void add(double v, std::initializer_list<Point> vertices) {
    const auto n = static_cast<double>(vertices.size());
    Point s = Point::Zero();
    Tensor squares = Tensor::Zero();
    for (const Point& p : vertices) s += p, squares += p * p.transpose();
    volume += v;
    first += v * s / n;
    second += v * (squares + s * s.transpose()) / (n * (n + 1));
  }

  /// About the centre; inertia = trace(C) - C of the second moment C there.
  MassProperties properties() const {
    MassProperties m;
    if (!(volume > 0)) return m;
    m.center = first / volume;
    const Tensor c = second / volume - m.center * m.center.transpose();
    m.inertia = c.trace() * Tensor::Identity() - c;
    return m;
  }
};

/// Where moments are taken, so that rounding leaves them: fifth powers of small lengths vanish, and of points far out the second moment about the centre is the
/// difference of two large ones. Lengths near 1 by a power of two, places from a reference as in Convex: neither rounds anything.
struct Nearby {
  Point reference;
  double scale;

  explicit Nearby(const std::vector<AnyVector>& points) {
    Point low = in_space(points.front()), high = low;
    for (const AnyVector& p : points) low = low.cwiseMin(in_space(p)), high = high.cwiseMax(in_space(p));
    for (int i = 0; i < 3; ++i) reference[i] = exact_reference(low[i], high[i]);
    const double size = std::max((low - reference).cwiseAbs().maxCoeff(), (high - reference).cwiseAbs().maxCoeff());
    scale = size > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000)) : 1;
  }
  Point operator()(const AnyVector& p) const { return (in_space(p) - reference) * scale; }
  MassProperties back(MassProperties m) const {
    m.center = m.center / scale + reference;
    m.inertia = m.inertia / scale / scale;
    return m;
  }
};

/// Solids by tetrahedra from one point, flat sets by triangles, rods by their segment; a point is left out.
Moments moments_of(const ConvexHull& hull, const std::vector<AnyVector>& points, const Nearby& nearby) {
  const auto at = [&](int i) { return nearby(points[static_cast<std::size_t>(i)]); };
  Moments m;
  const Point o = at(hull.vertices.front());
  if (hull.rank == 1) {
    const Point p = at(hull.vertices.back());
    m.add((p - o).norm(), {o, p});
  }
  for (const auto& face : hull.faces) {
    const Point a = at(face[0]);
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const Point b = at(face[i]), c = at(face[i + 1]);
      if (hull.rank == 3) m.add((a - o).dot((b - o).cross(c - o)) / 6, {o, a, b, c});
      else m.add((b - a).cross(c - a).norm() / 2, {a, b, c});  // in space a flat set has its polygon twice, which divides out
    }
  }
  return m;
}

MassProperties of_points(const std::vector<AnyVector>& points, int dimension) {
  const ConvexHull hull = convex_hull(points, dimension);
  const Nearby nearby(points);
  MassProperties m = moments_of(hull, points, nearby).properties();
  if (hull.rank == 0) m.center = nearby(points[static_cast<std::size_t>(hull.vertices.front())]);
  return nearby.back(m);
}

MassProperties diagonal(double x, double y, double z) {
  MassProperties m;
  m.inertia.diagonal() << x, y, z;
  return m;
}

/// About an axis of symmetry, and across it.
MassProperties around(int axis, double along, double across) {
  MassProperties m = diagonal(across, across, across);
  m.inertia(axis, axis) = along;
  return m;
}

struct OfGeometry {
  int dimension;
  bool plane() const { return dimension == 2; }

  MassProperties operator()(const Sphere& s) const {
    const double i = (plane() ? 0.5 : 0.4) * s.radius * s.radius;
    return diagonal(i, i, i);
  }
  MassProperties operator()(const Box& b) const {
    const Point half = in_space(AnyVector((b.max - b.min) / 2));
    const Point square = half.cwiseProduct(half) / 3;
    MassProperties m = diagonal(square[1] + square[2], square[0] + square[2], square[0] + square[1]);
    m.center = in_space(AnyVector(b.min + (b.max - b.min) / 2));
    return m;
  }
  /// A cylinder (in the plane a rectangle) and two caps, each a half ball whose centre of mass lies 3/8 r (4 r / 3 pi) beyond the end.
  MassProperties operator()(const Capsule& c) const {
    const double r = c.radius, h = c.half_height;
    if (plane()) {
      const double middle = 4 * h * r, caps = pi * r * r, all = middle + caps;
      if (!(all > 0)) return diagonal(0, 0, h * h / 3);
      return diagonal(0, 0, (middle * (h * h + r * r) / 3 + caps * (r * r / 2 + h * h + 8 * h * r / (3 * pi))) / all);
    }
    const double middle = 2 * h * pi * r * r, caps = 4.0 / 3 * pi * r * r * r, all = middle + caps;
    if (!(all > 0)) return around(c.axis, 0, h * h / 3);
    const double along = (middle * r * r / 2 + caps * 0.4 * r * r) / all;
    const double across = (middle * (r * r / 4 + h * h / 3) + caps * (0.4 * r * r + h * h + 0.75 * h * r)) / all;
    return around(c.axis, along, across);
  }
  MassProperties operator()(const Cylinder& c) const {
    const double r = c.radius * c.radius;
    return around(c.axis, r / 2, r / 4 + c.half_height * c.half_height / 3);
  }
  /// Of height 2 h: the centre of mass lies a quarter of it above the base; across 3/20 r^2 + 3/80 (2 h)^2.
  MassProperties operator()(const Cone& c) const {
    const double r = c.radius * c.radius, h = c.half_height * c.half_height;
    MassProperties m = around(c.axis, 0.3 * r, 0.15 * (r + h));
    m.center[c.axis] = -c.half_height / 2;
    return m;
  }
  MassProperties operator()(const Ellipsoid& e) const {
    const Point radii = in_space(e.radii), square = radii.cwiseProduct(radii) / (plane() ? 4 : 5);
    return diagonal(square[1] + square[2], square[0] + square[2], square[0] + square[1]);
  }
  MassProperties operator()(const PointSet& set) const { return of_points(set.points, dimension); }
  MassProperties operator()(const Mesh&) const { return {}; }
  MassProperties operator()(const Sum&) const { return {}; }
};

// --- What has no formula here, by its support mapping. ---

/// Directions spread evenly: around a circle, or along a spiral over a sphere, by the golden angle.
template <int D>
Vector<D, double> spread(int i, int count) {
  Vector<D, double> d;
  if constexpr (D == 2) {
    const double t = 2 * pi * i / count;
    d << std::cos(t), std::sin(t);
  } else {
    const double z = 1 - (2 * i + 1.0) / count, t = i * pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    d << r * std::cos(t), r * std::sin(t), z;
  }
  return d;
}

/// The hull of support points, and what is missing of it: over each of its faces a cap, which where the surface is smooth is 3/4 as high on average as at its highest, which another support
/// tells (points spread evenly over a sphere: triangles of nearly equal sides e, that is e^2 / 8 of e^2 / 6). Seen through the map x -> rounder x the directions are spread evenly.
template <int D>
MassProperties filled(const Convex<D, double>& convex, const Matrix<D, double>& rounder, int count) {
  const auto support = [&](const Vector<D, double>& d) { return Vector<D, double>(convex.support(d) + convex.radius() * d.normalized()); };
  std::vector<AnyVector> points;
  for (int i = 0; i < count; ++i)
    if (const Vector<D, double> d = rounder * spread<D>(i, count); d.norm() > 0) points.push_back(support(d));
  const ConvexHull hull = convex_hull(points, D);
  const Nearby nearby(points);
  Moments m = moments_of(hull, points, nearby);
  if constexpr (D == 3)
    for (const auto& face : hull.faces) {
      if (hull.rank < 3) break;
      const auto at = [&](std::size_t i) { return nearby(points[static_cast<std::size_t>(face[i])]); };
      Point area = Point::Zero();
      for (std::size_t i = 1; i + 1 < face.size(); ++i) area += (at(i) - at(0)).cross(at(i + 1) - at(0)) / 2;
      const Point n = area.normalized();
      if (!(n.norm() > 0)) continue;
      const double height = 0.75 * n.dot(nearby(support(n)) - at(0));
      if (!(height > 0)) continue;
      const Point middle = n * height / 2;
      for (std::size_t i = 1; i + 1 < face.size(); ++i)
        m.add((at(i) - at(0)).cross(at(i + 1) - at(0)).norm() / 2 * height, {at(0) + middle, at(i) + middle, at(i + 1) + middle});
    }
  return nearby.back(m.properties());
}

/// Takes x to where the body is as wide in every direction: the inverse root of its second moment. Across a body that is flat there is nothing to be told apart: 0.
template <int D>
Matrix<D, double> rounder_of(const MassProperties& m) {
  const Tensor second = m.inertia.trace() / 2 * Tensor::Identity() - m.inertia;
  const Eigen::SelfAdjointEigenSolver<Matrix<D, double>> axes(second.topLeftCorner<D, D>());
  Vector<D, double> wide = axes.eigenvalues();
  const double most = wide.maxCoeff();
  if (!(most > 0)) return Matrix<D, double>::Identity();  // a point, or so small that its moments are no numbers
  for (int i = 0; i < D; ++i) wide[i] = wide[i] > 1e-24 * most ? std::sqrt(most / wide[i]) : 0;
  return axes.eigenvectors() * wide.asDiagonal() * axes.eigenvectors().transpose();
}

template <int D>
MassProperties sampled(const Shape& shape) {
  const Convex<D, double> convex(shape);
  // A body that is long one way has nearly all its normals across it: the first points are spread for the box about it, and then for what they say.
  Vector<D, double> extent;
  for (int i = 0; i < D; ++i) extent[i] = convex.support(Vector<D, double>::Unit(i))[i] - convex.support(-Vector<D, double>::Unit(i))[i] + 2 * convex.radius();
  const double most = extent.maxCoeff();
  for (int i = 0; i < D; ++i) extent[i] = most == 0 ? 1 : extent[i] > 1e-12 * most ? most / extent[i] : 0;
  constexpr int few = D == 2 ? 90 : 150, many = D == 2 ? 720 : 800;
  MassProperties m = filled<D>(convex, extent.asDiagonal(), few);
  for (const int count : {few, many}) m = filled<D>(convex, rounder_of<D>(m), count);
  m.center += in_space(AnyVector(convex.reference()));
  return m;
}

}  // namespace

MassProperties mass_properties(const Shape& shape, int dimension) {
  if (dimension == 1) {
    MassProperties m;
    if (std::holds_alternative<Mesh>(shape.geometry)) return m;
    const Convex<1, double> interval(shape);
    using Along = Vector<1, double>;
    const double low = interval.support(Along(-1))[0], high = interval.support(Along(1))[0];
    m.center[0] = interval.reference()[0] + (low + (high - low) / 2);
    return m;
  }
  Shape whole = shape;
  if (Sphere* s = std::get_if<Sphere>(&whole.geometry)) s->radius += whole.margin, whole.margin = 0;
  if (Capsule* c = std::get_if<Capsule>(&whole.geometry)) c->radius += whole.margin, whole.margin = 0;
  if (whole.margin == 0 && !std::holds_alternative<Sum>(whole.geometry)) return std::visit(OfGeometry{dimension}, whole.geometry);
  return dimension == 2 ? sampled<2>(whole) : sampled<3>(whole);
}

}  // namespace gjkdbg
