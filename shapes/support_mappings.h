// Support mappings: for each kind of core, a point of it farthest along a direction.
//
// After van den Bergen, "Collision Detection in Interactive 3D Environments" (2003), chapter 4.3, with three
// deviations: the cone compares support values instead of angles, a tie takes the positive side (sgn 0 = 1),
// and a direction for which every point is farthest (zero, or along an axis) gets a fixed one of them, never NaN.
//
// Every mapping has `support(direction)`: direction in the core's frame, of any length; the result lies
// in the core. Radii are no part of a core. Hulls of many vertices: shapes/hull_core.h.
//
// Those of curved cores have `add_derivative(axes, direction, s, sum)`: how the support s moves with the direction, both in a frame in which the core's
// axes are the columns of `axes`. Other cores' supports do not move but for jumps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "shapes/vertex_eights.h"

namespace gjkdbg {

/// The core of a sphere: its centre.
template <int D, class S>
struct PointCore {
  Vector<D, S> center() const { return Vector<D, S>::Zero(); }
  Vector<D, S> support(const Vector<D, S>&) const { return Vector<D, S>::Zero(); }
};

/// The core of a capsule: a segment along a coordinate axis.
template <int D, class S>
struct SegmentCore {
  int axis;
  S half_height;
  Vector<D, S> center() const { return Vector<D, S>::Zero(); }
  Vector<D, S> support(const Vector<D, S>& d) const {
    Vector<D, S> s = Vector<D, S>::Zero();
    const S ends[2] = {half_height, -half_height};
    s[axis] = ends[d[axis] < 0];
    return s;
  }
};

/// A box between two corners.
template <int D, class S>
struct BoxCore {
  std::array<Vector<D, S>, 2> corners;  ///< the greatest, the least: looked up by the direction's signs, as no processor can guess those
  Vector<D, S> half() const { return (corners[0] - corners[1]) / 2; }
  Vector<D, S> center() const { return corners[1] + half(); }
  Vector<D, S> support(const Vector<D, S>& d) const {
    Vector<D, S> s;
    for (int i = 0; i < D; ++i) s[i] = corners[d[i] < 0][i];
    return s;
  }
};

/// Length of the part of d that is perpendicular to an axis, and the index of the other two axes.
template <class S>
struct Around {
  int i, j;
  S sigma;
  Around(const Vector<3, S>& d, int axis) : i((axis + 1) % 3), j((axis + 2) % 3), sigma(std::sqrt(d[i] * d[i] + d[j] * d[j])) {}
  /// The point of a circle of this radius farthest along d; its centre when d has no part in the circle's plane.
  void on_circle(const Vector<3, S>& d, S radius, Vector<3, S>& s) const {
    if (!(sigma > least)) [[unlikely]] return on_circle_of_next_to_none(d, radius, s);
    const S scale = radius / sigma;
    s[i] = scale * d[i];
    s[j] = scale * d[j];
  }

 private:
  /// Of a part below this the squares lose digits, or vanish, and radius / sigma would lead beside the circle.
  static constexpr S least = std::is_same_v<S, float> ? S(1e-15) : S(1e-145);

  [[gnu::noinline]] void on_circle_of_next_to_none(const Vector<3, S>& d, S radius, Vector<3, S>& s) const {
    s[i] = s[j] = 0;
    const S most = std::max(std::abs(d[i]), std::abs(d[j]));
    if (!(most > 0)) return;
    const S x = d[i] / most, y = d[j] / most, scale = radius / std::sqrt(x * x + y * y);
    s[i] = scale * x;
    s[j] = scale * y;
  }
};

/// The derivative of a support mapping: symmetric. Number by number, not a matrix: it is summed up from products of vectors and stays in registers.
template <int D, class S>
struct SupportDerivative {
  S at[D][D] = {};  ///< i <= j

  void add(S factor, const Vector<D, S>& v) {
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) at[i][j] += factor * v[i] * v[j];
  }
  Vector<D, S> operator*(const Vector<D, S>& v) const {
    Vector<D, S> product;
    for (int i = 0; i < D; ++i) {
      product[i] = 0;
      for (int j = 0; j < D; ++j) product[i] += at[std::min(i, j)][std::max(i, j)] * v[j];
    }
    return product;
  }
};

/// How a point s of a circle about an axis a moves with the direction d it is farthest along. Its part rho across the axis stays along d's own
/// part sigma: it turns with it, by the change of sigma that way over |sigma|, and lies |rho| out. With a x rho for the way of turning, that is
/// (a x rho) (a x rho)^T / (|rho| |sigma|), and |rho| |sigma| = rho . d.
template <class S>
void add_circle_derivative(const Vector<3, S>& a, const Vector<3, S>& d, const Vector<3, S>& s, SupportDerivative<3, S>& sum) {
  const S lever = d.dot(s) - d.dot(a) * s.dot(a);
  if (lever > 0) sum.add(1 / lever, a.cross(s));
}

template <class S>
struct CylinderCore {
  int axis;
  S radius, half_height;
  Vector<3, S> center() const { return Vector<3, S>::Zero(); }
  Vector<3, S> support(const Vector<3, S>& d) const {
    Vector<3, S> s;
    Around<S>(d, axis).on_circle(d, radius, s);
    s[axis] = d[axis] < 0 ? -half_height : half_height;
    return s;
  }
  void add_derivative(const Matrix<3, S>& axes, const Vector<3, S>& d, const Vector<3, S>& s, SupportDerivative<3, S>& sum) const {
    add_circle_derivative<S>(axes.col(axis), d, s, sum);
  }
};

/// Apex at +half_height, base circle of `radius` at -half_height. With y the axial part of d and sigma the rest,
/// the apex is worth y h and the best point of the base radius sigma - y h, so the apex wins where
/// 2 h y > radius sigma. Dividing by |d| sqrt(radius^2 + 4 h^2) gives van den Bergen's y > |d| sin(alpha),
/// but this form needs no angle and holds for radius = 0 and for h = 0.
template <class S>
struct ConeCore {
  int axis;
  S radius, half_height;
  Vector<3, S> center() const { return Vector<3, S>::Unit(axis) * (-half_height / 2); }
  Vector<3, S> support(const Vector<3, S>& d) const {
    Vector<3, S> s = Vector<3, S>::Zero();
    const Around<S> around(d, axis);
    if (2 * half_height * d[axis] > radius * around.sigma) {
      s[axis] = half_height;
    } else {
      around.on_circle(d, radius, s);
      s[axis] = -half_height;
    }
    return s;
  }
  /// The apex stays.
  void add_derivative(const Matrix<3, S>& axes, const Vector<3, S>& d, const Vector<3, S>& s, SupportDerivative<3, S>& sum) const {
    if (!(axes.col(axis).dot(s) > 0)) add_circle_derivative<S>(axes.col(axis), d, s, sum);
  }
};

/// The unit ball stretched by the radii: with M = diag(radii), the farthest point along d is M (M d / |M d|).
template <int D, class S>
struct EllipsoidCore {
  Vector<D, S> radii;
  Vector<D, S> center() const { return Vector<D, S>::Zero(); }
  Vector<D, S> support(const Vector<D, S>& d) const {
    const Vector<D, S> stretched = radii.cwiseProduct(d);
    const S length = std::sqrt(stretched.dot(stretched));
    if (!(length > 0)) return Vector<D, S>::Zero();
    return radii.cwiseProduct(stretched) / length;
  }
  /// Of s = M^2 d / |M d|: (M^2 - s s^T) / |M d|, and |M d| = d . s.
  void add_derivative(const Matrix<D, S>& axes, const Vector<D, S>& d, const Vector<D, S>& s, SupportDerivative<D, S>& sum) const {
    const S height = d.dot(s);
    if (!(height > 0)) return;
    const S inverse = 1 / height;
    sum.add(-inverse, s);
    for (int i = 0; i < D; ++i) sum.add(inverse * radii[i] * radii[i], axes.col(i));
  }
};

/// Few vertices: look at all of them.
template <int D, class S>
struct VerticesCore {
  VertexFours<D, S> vertices;
  Vector<D, S> middle = Vector<D, S>::Zero();  ///< their mean
#ifdef GJKDBG_AVX2
  VertexEights eights;  ///< of 9 to 32 vertices in space, in double
#endif

  VerticesCore() = default;
  explicit VerticesCore(const std::vector<Vector<D, double>>& points) {
    for (const auto& p : points) vertices.push_back(p.template cast<S>());
    for (std::size_t i = 0; i < vertices.size(); ++i) middle += vertices[i];
    middle /= static_cast<S>(vertices.size());
#ifdef GJKDBG_AVX2
    if constexpr (D == 3 && sizeof(S) == 8)
      if (VertexEights::least <= vertices.size() && vertices.size() <= VertexEights::most) eights = VertexEights(vertices);
#endif
  }
  const Vector<D, S>& center() const { return middle; }
  Vector<D, S> support(const Vector<D, S>& d) const { return vertices.highest(d); }
};

template <int D, class S>
class Convex;

/// The Minkowski sum of two cores: supports add up.
template <int D, class S>
struct SumCore {
  std::shared_ptr<const Convex<D, S>> first, second;
  Vector<D, S> support(const Vector<D, S>& d) const;
  void add_derivative(const Matrix<D, S>& axes, const Vector<D, S>& d, const Vector<D, S>& s, SupportDerivative<D, S>& sum) const;
  Vector<D, S> center() const;
};

}  // namespace gjkdbg
