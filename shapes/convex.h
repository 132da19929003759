// Convex: a shape as the algorithms see it, a core with a support mapping, and a radius around it.
//
// Every shape is the Minkowski sum of a core and a ball: a sphere is a point and a radius, a capsule a segment
// and a radius, a margin adds to the radius. GJK and EPA run on the cores; the radii are added afterwards, exactly.
// The core is moved to a reference point of its own where that costs no rounding (all coordinates of an axis
// within a factor of two of each other, so that subtracting is exact by Sterbenz' lemma): a hull whose points
// lie far from its body's origin is then as accurate as one around it.
#pragma once

#include <utility>
#include <variant>

#include "shapes/hull_core.h"
#include "shapes/polygon_core.h"
#include "shapes/shape.h"
#include "shapes/support_mappings.h"

namespace gjkdbg {

template <int D, class S>
struct CoreVariant {
  using type = std::variant<PointCore<D, S>, SegmentCore<D, S>, BoxCore<D, S>, EllipsoidCore<D, S>, VerticesCore<D, S>,
                            SumCore<D, S>>;
};
template <class S>
struct CoreVariant<2, S> {
  using type = std::variant<PointCore<2, S>, SegmentCore<2, S>, BoxCore<2, S>, EllipsoidCore<2, S>, VerticesCore<2, S>, PolygonCore<S>,
                            SumCore<2, S>>;
};
template <class S>
struct CoreVariant<3, S> {
  using type = std::variant<PointCore<3, S>, SegmentCore<3, S>, BoxCore<3, S>, EllipsoidCore<3, S>, VerticesCore<3, S>,
                            HullCore<S>, SumCore<3, S>, CylinderCore<S>, ConeCore<S>>;
};

template <int D, class S>
class Convex {
 public:
  using Core = typename CoreVariant<D, S>::type;

  /// `shape` must be valid in dimension D (`validate`) and no mesh. Lengths are multiplied by `scale`, which
  /// must be a power of two. A hull, in 2D a polygon, is reduced to its extreme vertices, if it is solid.
  explicit Convex(const Shape& shape, double scale = 1);

  /// A point of the core farthest along `direction`; both relative to `reference()`, axes of the body.
  Vector<D, S> support(const Vector<D, S>& direction) const {
    return std::visit([&](const auto& core) { return core.support(direction); }, core_);
  }

  /// How the support s moves with the direction: see shapes/support_mappings.h.
  void add_support_derivative(const Matrix<D, S>& axes, const Vector<D, S>& direction, const Vector<D, S>& s, SupportDerivative<D, S>& sum) const {
    std::visit([&](const auto& core) {
      if constexpr (requires { core.add_derivative(axes, direction, s, sum); }) core.add_derivative(axes, direction, s, sum);
    }, core_);
  }

  /// A point inside the core (of a flat one, in its plane), relative to `reference()`.
  Vector<D, S> center() const {
    return std::visit([](const auto& core) { return core.center(); }, core_);
  }
  const Core& core() const { return core_; }
  const Vector<D, double>& reference() const { return reference_; }  ///< of the core: in the body's axes from its origin, times `scale`
  double radius() const { return radius_; }                          ///< of the ball around the core, times `scale`
  double extent() const { return extent_; }      ///< times `scale`: no core point is farther from `reference()`, and but for sums one is as far
  bool polytope() const { return polytope_; }    ///< whether the core has finitely many extreme points
  int vertices() const { return vertices_; }     ///< so many of them (of a sum: of the part with more); 0: not finitely many

 private:
  Core core_;
  Vector<D, double> reference_ = Vector<D, double>::Zero();
  double radius_ = 0;
  double extent_ = 0;
  bool polytope_ = true;
  int vertices_ = 1;

  void set(const Sphere& sphere, double scale);
  void set(const Box& box, double scale);
  void set(const Capsule& capsule, double scale);
  void set(const Cylinder& cylinder, double scale);
  void set(const Cone& cone, double scale);
  void set(const Ellipsoid& ellipsoid, double scale);
  void set(const PointSet& point_set, double scale);
  void set(const Mesh& mesh, double scale);
  void set(const Sum& sum, double scale);
  template <class RoundCore, class Geometry>
  void set_round(const Geometry& round, double scale);  ///< a cylinder or a cone
  void set_vertices(std::vector<Vector<D, double>> points, double scale, bool polygon = false);  ///< polygon: corners, counter-clockwise
};

template <int D, class S>
Vector<D, S> SumCore<D, S>::center() const {
  return first->center() + second->center();
}

template <int D, class S>
Vector<D, S> SumCore<D, S>::support(const Vector<D, S>& d) const {
  return first->support(d) + second->support(d);
}

template <int D, class S>
void SumCore<D, S>::add_derivative(const Matrix<D, S>& axes, const Vector<D, S>& d, const Vector<D, S>&, SupportDerivative<D, S>& sum) const {
  const Vector<D, S> own = axes.transpose() * d;
  for (const auto& part : {first, second}) part->add_support_derivative(axes, d, axes * part->support(own), sum);
}

/// From how many vertices a hull has a table of directions. In the first-level cache the table beats a scan from about 50 on (tests/bench/support_bench);
/// but it is nine times as large and its places lie apart, and of a thousand pairs met in turn nothing is in that cache. Two hulls of 128
/// take 0.6 (apart) to 1.0 (deep) of the scan's time with the table where 200 pairs are met in turn, and 0.9 to 1.2 where 1,000 are; of 32, 1.0 to 1.5 (measured with tables in pages of 4 KB).
inline constexpr int table_from = 100;

/// The reference coordinate for values between low and high: the one of smaller magnitude when the two are
/// within a factor of two, so that subtracting it is exact for everything between (Sterbenz); else zero.
double exact_reference(double low, double high);

/// The shape's size: its largest coordinate, radius, half height or margin, in its own frame; of a sum the larger of both.
double size_of(const Shape& shape);

extern template class Convex<1, double>;
extern template class Convex<2, double>;
extern template class Convex<3, double>;
extern template class Convex<1, float>;
extern template class Convex<2, float>;
extern template class Convex<3, float>;

}  // namespace gjkdbg
