#include "shapes/convex.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "shapes/convex_hull.h"

namespace gjkdbg {
namespace {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

}  // namespace

double exact_reference(double low, double high) {
  const double near = std::min(std::abs(low), std::abs(high)), far = std::max(std::abs(low), std::abs(high));
  if ((low > 0) != (high > 0) || near == 0 || far > 2 * near) return 0;
  return std::abs(low) < std::abs(high) ? low : high;
}

template <int D, class S>
void Convex<D, S>::set_vertices(std::vector<Vector<D, double>> points, double scale, bool polygon) {
  Vector<D, double> low = points.front(), high = points.front();
  for (const auto& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  for (int i = 0; i < D; ++i) reference_[i] = exact_reference(low[i], high[i]);
  for (auto& p : points) {
    p = (p - reference_) * scale;  // before it is squared: squares of lengths below 1e-162 vanish
    extent_ = std::max(extent_, p.norm());
  }
  reference_ *= scale;
  vertices_ = static_cast<int>(points.size());
  if constexpr (D == 2)
    if (polygon) {
      core_ = PolygonCore<S>(points);
      return;
    }
  core_ = VerticesCore<D, S>(points);
}

template <int D, class S>
void Convex<D, S>::set(const Sphere& sphere, double scale) {
  radius_ = sphere.radius * scale;
}

template <int D, class S>
void Convex<D, S>::set(const Box& box, double scale) {
  Vector<D, double> low = box.min, high = box.max;
  for (int i = 0; i < D; ++i) reference_[i] = exact_reference(low[i], high[i]);
  low = (low - reference_) * scale, high = (high - reference_) * scale;
  BoxCore<D, S> core;
  core.corners = {high.template cast<S>(), low.template cast<S>()};
  core_ = core;
  extent_ = low.cwiseAbs().cwiseMax(high.cwiseAbs()).norm();
  reference_ *= scale;
  vertices_ = 1 << D;
}

template <int D, class S>
void Convex<D, S>::set(const Capsule& capsule, double scale) {
  core_ = SegmentCore<D, S>{capsule.axis, static_cast<S>(capsule.half_height * scale)};
  extent_ = capsule.half_height * scale;
  radius_ = capsule.radius * scale;
  vertices_ = 2;
}

template <int D, class S>
void Convex<D, S>::set(const Ellipsoid& ellipsoid, double scale) {
  const Vector<D, double> radii = ellipsoid.radii;
  if (radii.minCoeff() == radii.maxCoeff()) return set(Sphere{radii[0]}, scale);  // however it is written, a ball is a centre and a radius
  core_ = EllipsoidCore<D, S>{(radii * scale).template cast<S>()};
  extent_ = radii.maxCoeff() * scale;
  polytope_ = false, vertices_ = 0;
}

template <int D, class S>
void Convex<D, S>::set(const Cylinder& cylinder, double scale) {
  set_round<CylinderCore<S>>(cylinder, scale);
}
template <int D, class S>
void Convex<D, S>::set(const Cone& cone, double scale) {
  set_round<ConeCore<S>>(cone, scale);
}

template <int D, class S>
template <class RoundCore, class Geometry>
void Convex<D, S>::set_round(const Geometry& round, double scale) {
  if constexpr (D == 3) core_ = RoundCore{round.axis, static_cast<S>(round.radius * scale), static_cast<S>(round.half_height * scale)};
  extent_ = std::hypot(round.radius, round.half_height) * scale;
  polytope_ = round.radius == 0, vertices_ = polytope_ ? 2 : 0;
}

template <int D, class S>
void Convex<D, S>::set(const PointSet& point_set, double scale) {
  const bool reduce = point_set.kind == PointSetKind::hull || point_set.kind == PointSetKind::polygon;
  std::vector<Vector<D, double>> points(point_set.points.begin(), point_set.points.end());
  if (!reduce && (D != 2 || points.size() < 3)) return set_vertices(std::move(points), scale);
  const ConvexHull hull = convex_hull(point_set.points, D);
  if (hull.rank < D) return set_vertices(std::move(points), scale);  // flat to 1e-14 of the size, which is more than is rounded off elsewhere
  points.clear();
  const bool polygon = D == 2 && hull.faces.front().size() >= 3;
  std::vector<int> corners = polygon ? hull.faces.front() : hull.vertices;
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());  // as given, where they are given in this order
  for (const int i : corners) points.push_back(point_set.points[i]);
  set_vertices(std::move(points), scale, polygon);
  if constexpr (D == 3)
    if (hull.rank == 3 && hull.vertices.size() >= table_from && !hull.neighbours.empty()) {
      const VertexFours<D, S>& in_core = std::get<VerticesCore<D, S>>(core_).vertices;
      std::vector<Vector<D, S>> vertices;
      for (std::size_t i = 0; i < in_core.size(); ++i) vertices.push_back(in_core[i]);
      core_ = HullCore<S>(vertices, hull);
    }
}

template <int D, class S>
void Convex<D, S>::set(const Mesh&, double) {
  assert(false && "a mesh is not convex: its triangles are");
}

template <int D, class S>
void Convex<D, S>::set(const Sum& sum, double scale) {
  const auto first = std::make_shared<const Convex>(*sum.first, scale), second = std::make_shared<const Convex>(*sum.second, scale);
  core_ = SumCore<D, S>{first, second};
  reference_ = first->reference() + second->reference();
  extent_ = first->extent() + second->extent();
  radius_ = first->radius() + second->radius();
  polytope_ = first->polytope() && second->polytope();
  vertices_ = polytope_ ? std::max(first->vertices(), second->vertices()) : 0;
  if (std::holds_alternative<PointCore<D, S>>(first->core())) core_ = Core(second->core());
  if (std::holds_alternative<PointCore<D, S>>(second->core())) core_ = Core(first->core());
}

template <int D, class S>
Convex<D, S>::Convex(const Shape& shape, double scale) {
  std::visit([&](const auto& geometry) { set(geometry, scale); }, shape.geometry);
  radius_ += shape.margin * scale;
}

double size_of(const Shape& shape) {
  const auto largest = [](const std::vector<AnyVector>& points) {
    double size = 0;
    for (const AnyVector& p : points) size = std::max(size, p.cwiseAbs().maxCoeff());
    return size;
  };
  const double core = std::visit(
      Overloaded{[](const Sphere& s) { return s.radius; },
                 [](const Box& b) { return std::max(b.min.cwiseAbs().maxCoeff(), b.max.cwiseAbs().maxCoeff()); },
                 [](const Ellipsoid& e) { return e.radii.maxCoeff(); },
                 [&](const PointSet& p) { return largest(p.points); }, [&](const Mesh& m) { return largest(m.points); },
                 [](const Sum& s) { return std::max(size_of(*s.first), size_of(*s.second)); },
                 [](const auto& round) { return std::max(round.radius, round.half_height); }},
      shape.geometry);
  return std::max(core, shape.margin);
}

template class Convex<1, double>;
template class Convex<2, double>;
template class Convex<3, double>;
template class Convex<1, float>;
template class Convex<2, float>;
template class Convex<3, float>;

}  // namespace gjkdbg
