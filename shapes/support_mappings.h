// Support mappings: for each kind of core, a point of it farthest along a direction.
//
// After van den Bergen, "Collision Detection in Interactive 3D Environments" (2003), chapter 4.3, with three
// deviations: the cone compares support values instead of angles, a tie takes the positive side (sgn 0 = 1),
// and a direction for which every point is farthest (zero, or along an axis) gets a fixed one of them, never NaN.
//
// Every mapping has `support(direction, hint)`: direction in the core's frame, of any length; the result lies
// in the core. `hint` carries a vertex number from one call to the next (hill climbing starts there); it changes
// which of several equally far points is returned, nothing else. Radii are no part of a core.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "shapes/vector.h"

namespace gjkdbg {

/// The core of a sphere: its centre.
template <int D, class S>
struct PointCore {
  Vector<D, S> center() const { return Vector<D, S>::Zero(); }
  Vector<D, S> support(const Vector<D, S>&, int&) const { return Vector<D, S>::Zero(); }
};

/// The core of a capsule: a segment along a coordinate axis.
template <int D, class S>
struct SegmentCore {
  int axis;
  S half_height;
  Vector<D, S> center() const { return Vector<D, S>::Zero(); }
  Vector<D, S> support(const Vector<D, S>& d, int&) const {
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
  Vector<D, S> center() const { return corners[1] + (corners[0] - corners[1]) / 2; }
  Vector<D, S> support(const Vector<D, S>& d, int&) const {
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
    const S scale = sigma > 0 ? radius / sigma : S(0);
    s[i] = scale * d[i];
    s[j] = scale * d[j];
  }
};

template <class S>
struct CylinderCore {
  int axis;
  S radius, half_height;
  Vector<3, S> center() const { return Vector<3, S>::Zero(); }
  Vector<3, S> support(const Vector<3, S>& d, int&) const {
    Vector<3, S> s;
    Around<S>(d, axis).on_circle(d, radius, s);
    s[axis] = d[axis] < 0 ? -half_height : half_height;
    return s;
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
  Vector<3, S> support(const Vector<3, S>& d, int&) const {
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
};

/// The unit ball stretched by the radii: with M = diag(radii), the farthest point along d is M (M d / |M d|).
template <int D, class S>
struct EllipsoidCore {
  Vector<D, S> radii;
  Vector<D, S> center() const { return Vector<D, S>::Zero(); }
  Vector<D, S> support(const Vector<D, S>& d, int&) const {
    const Vector<D, S> stretched = radii.cwiseProduct(d);
    const S length = std::sqrt(stretched.dot(stretched));
    if (!(length > 0)) return Vector<D, S>::Zero();
    return radii.cwiseProduct(stretched) / length;
  }
};

template <class V>
V mean_of(const std::vector<V>& points) {
  V sum = V::Zero();
  for (const V& p : points) sum += p;
  return sum / static_cast<typename V::Scalar>(points.size());
}

/// Few vertices: look at all of them.
template <int D, class S>
struct VerticesCore {
  std::vector<Vector<D, S>> vertices;
  Vector<D, S> center() const { return mean_of(vertices); }
  Vector<D, S> support(const Vector<D, S>& d, int&) const {
    const Vector<D, S>* best = vertices.data();
    S best_dot = best->dot(d);
    for (const Vector<D, S>* v = best + 1; v != vertices.data() + vertices.size(); ++v) {
      const S dot = v->dot(d);
      if (dot > best_dot) best = v, best_dot = dot;
    }
    return *best;
  }
};

/// Many vertices of a convex polytope: walk along edges uphill. On a convex polytope a vertex with no higher
/// neighbour is a highest one. The walk starts at the last answer or at the farthest vertex along the nearest of 26 directions
/// (axes, edges and corners of a cube), whichever is higher: it is short however many vertices there are.
template <int D, class S>
struct HullCore {
  std::vector<Vector<D, S>> vertices;
  std::vector<int> first_neighbour;  ///< of vertex i: neighbours[first_neighbour[i] .. first_neighbour[i + 1])
  std::vector<int> neighbours;
  std::array<int, 27> start{};       ///< by `octant`; set by `find_starts`

  Vector<D, S> center() const { return mean_of(vertices); }

  /// Every component of d is 0, 1 or 2: clearly negative, small beside the largest, clearly positive.
  static std::size_t octant(const Vector<D, S>& d) {
    const S small = S(0.4) * d.cwiseAbs().maxCoeff();
    std::size_t cell = 0;
    for (int i = 0; i < D; ++i) cell = 3 * cell + (d[i] > small ? 2 : d[i] < -small ? 0 : 1);
    return cell;
  }

  /// Puts vertices that are near in space near in memory, along a Morton curve (coordinates quantised to 10 bits, their bits interleaved): a walk
  /// over the hull then touches a fraction of the cache lines.
  void line_up() {
    Vector<D, S> low = vertices.front(), high = low;
    for (const Vector<D, S>& v : vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
    const auto place = [&](const Vector<D, S>& v) {
      unsigned code = 0;
      for (int i = 0; i < D; ++i) {
        const S width = high[i] - low[i];
        const auto cell = static_cast<unsigned>(width > 0 ? (v[i] - low[i]) / width * S(1023) : S(0));
        for (unsigned bit = 0; bit < 10; ++bit) code |= (cell >> bit & 1u) << (bit * D + static_cast<unsigned>(i));
      }
      return code;
    };
    std::vector<std::pair<unsigned, int>> order;
    for (std::size_t i = 0; i < vertices.size(); ++i) order.emplace_back(place(vertices[i]), static_cast<int>(i));
    std::sort(order.begin(), order.end());
    std::vector<int> moved_to(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) moved_to[static_cast<std::size_t>(order[i].second)] = static_cast<int>(i);
    const HullCore before = *this;
    neighbours.clear();
    for (std::size_t i = 0; i < order.size(); ++i) {
      const int old = order[i].second;
      vertices[i] = before.vertices[static_cast<std::size_t>(old)];
      first_neighbour[i] = static_cast<int>(neighbours.size());
      for (int k = before.first_neighbour[old]; k < before.first_neighbour[old + 1]; ++k) neighbours.push_back(moved_to[static_cast<std::size_t>(before.neighbours[k])]);
    }
  }

  void find_starts() {
    for (int cell = 0; cell < 27; ++cell) {
      Vector<D, S> d;
      for (int i = D - 1, rest = cell; i >= 0; --i, rest /= 3) d[i] = static_cast<S>(rest % 3 - 1);
      const auto lower = [&](const Vector<D, S>& x, const Vector<D, S>& y) { return x.dot(d) < y.dot(d); };
      start[static_cast<std::size_t>(cell)] = static_cast<int>(std::max_element(vertices.begin(), vertices.end(), lower) - vertices.begin());
    }
  }

  Vector<D, S> support(const Vector<D, S>& d, int& hint) const {
    int best = start[octant(d)];
    S best_dot = vertices[best].dot(d);
    if (hint >= 0 && hint < static_cast<int>(vertices.size()))
      if (const S dot = vertices[hint].dot(d); dot >= best_dot) best = hint, best_dot = dot;
    for (int from = -1; from != best;) {
      from = best;
      for (int k = first_neighbour[from]; k < first_neighbour[from + 1]; ++k) {
        const S dot = vertices[neighbours[k]].dot(d);
        if (dot > best_dot) best = neighbours[k], best_dot = dot;
      }
    }
    hint = best;
    return vertices[best];
  }
};

template <int D, class S>
class Convex;

/// The Minkowski sum of two cores: supports add up.
template <int D, class S>
struct SumCore {
  std::shared_ptr<const Convex<D, S>> first, second;
  Vector<D, S> support(const Vector<D, S>& d, int& hint) const;
  Vector<D, S> center() const;
};

}  // namespace gjkdbg
