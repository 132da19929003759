// The separating axis test: polytopes are apart iff a plane along a face or along two edges separates them.
//
// Gottschalk, "Separating axis theorem", TR 96-024, UNC 1996; pruning by Gauss maps after Gregorius, "The Separating Axis Test
// between Convex Polyhedra", GDC 2013. Along a unit direction n from body 0 to body 1 the bodies are
//
//   distance(n) = -h(n),   h(n) = max over w of A - B of n . w
//
// apart. The faces of A - B face the way of a face of A, against a face of B, or across an edge of each, and the depth is the
// least h over them: exact, in a number of steps known beforehand. Of the pairs of edges only those make a face whose arcs on the
// sphere of directions cross: edge a between the normals a1, a2 of A, and edge b between -b1, -b2 of B. With the edges' directions u, v
// (parallel to a1 x a2 and b1 x b2) the arcs cross iff -b1, -b2 lie on either side of the great circle of a1, a2, the other way
// round too, and both arcs on the same half of the sphere.
// Where the least h is no more than rounding, the origin may still lie well outside, before an edge or a corner so sharp that all faces beside it pass it as
// closely: the bodies are then `undecided`, and GJK is asked. Where A - B is flat, its sides would count as well: `spans` says no, and GJK is asked instead.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "algo/simplex.h"
#include "algo/trace.h"
#include "shapes/features.h"

namespace gjkdbg {

template <int D, class S>
struct SatResult {
  SatStatus status = SatStatus::overlapping;  ///< of the cores
  int iterations = 0;                         ///< axes tested
  Vector<D, S> normal = Vector<D, S>::Zero();  ///< unit, from body 0 towards body 1, body 0's frame: where h is least, or once nearest points are proven from a to b
  S depth = 0;                                ///< of the cores: h along `normal`, or minus the proven distance; negative when separated
};

/// Points of the cores with a - b = depth * normal.
template <int D, class S>
struct SatWitnesses {
  Vector<D, S> a, b;
};

/// What an outline tells of two bodies. The points mean something where it ends as `overlapping`.
template <int D, class S>
struct OutlineDepth {
  SatResult<D, S> sat;
  std::optional<SatWitnesses<D, S>> points;  ///< unset: to be found along the normal
  S slack;  ///< how much less the depth may be than the least height
};

/// Tells a trace of an axis, number `axis`, its support, and the bounds so far: the least height, and what none is below (NaN: not known). `radius`: of both bodies.
template <class Trace, int D, class S>
void tell_axis(Trace& trace, int axis, AxisSource source, const Vector<D, S>& n, const SupportPoint<D, S>& point, S lowest, S least, S floor, double radius) {
  using V = Vector<D, S>;
  trace(SupportQueried<V, Viewed>{axis, Phase::sat, n, point.vertex, point.a, point.b, point.w});
  trace(AxisTested<V, Viewed>{axis, source, point.vertex, n, static_cast<double>(-n.dot(point.w)) - radius, static_cast<double>(-lowest - floor) - radius, static_cast<double>(floor - least) - radius});
}

/// Who wants to see axes: number `axis` with its support, the least height so far, and what none is below (NaN: not known).
template <int D, class S>
using AxisLook = std::function<void(int axis, const Vector<D, S>& n, const SupportPoint<D, S>& support, S lowest, S least)>;
/// Empty where the trace is none. Keeps the reference.
template <class Difference, class Trace>
AxisLook<Difference::D, typename Difference::S> outline_look([[maybe_unused]] const Difference& difference, [[maybe_unused]] Trace& trace) {
  using S = typename Difference::S;
  if constexpr (traced<Trace>)
    return [&trace, radius = static_cast<double>(difference.radius()), floor = difference.rounding_floor()](int axis, const typename Difference::V& n, const typename Difference::Point& point, S lowest, S least) {
      tell_axis(trace, axis, AxisSource::outline, n, point, lowest, least, floor, radius);
    };
  return {};
}

/// An edge of a core, with the normals of the faces beside it: zero where it has none.
template <int D, class S>
struct SatEdge {
  Vector<D, S> direction, left, right;
  bool solid() const { return !left.isZero(0); }
};

/// The features of both cores in body 0's axes; those of body 1 as the difference has them, turned over. Used again by the next query, which then allocates nothing.
template <int D, class S>
struct SatWorkspace {
  std::vector<Vector<D, S>> faces_a, faces_b;
  std::vector<SatEdge<D, S>> edges_a, edges_b;
};

template <class Difference, class Trace>
class Sat {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Edge3 = SatEdge<D, S>;

 public:
  /// Features in each body's axes; `rotation` takes body 1's to body 0's.
  Sat(Difference& difference, const Features& a, const Features& b, const Matrix<D, S>& rotation, SatWorkspace<D, S>& workspace, Trace& trace)
      : difference_(difference), trace_(trace), floor_(difference.rounding_floor()), nearly_flat_(a.nearly_flat || b.nearly_flat), faces_a_(workspace.faces_a),
        faces_b_(workspace.faces_b), edges_a_(workspace.edges_a), edges_b_(workspace.edges_b) {
    faces_a_.clear(), faces_b_.clear(), edges_a_.clear(), edges_b_.clear();
    for (const AnyVector& n : a.face_normals) faces_a_.push_back(local(n));
    for (const AnyVector& n : b.face_normals) faces_b_.push_back(-(rotation * local(n)));
    if constexpr (D == 3) {
      for (const EdgeFeature& e : a.edges) edges_a_.push_back(Edge3{local(e.direction), local(e.left), local(e.right)});
      for (const EdgeFeature& e : b.edges)
        edges_b_.push_back(Edge3{rotation * local(e.direction), V(-(rotation * local(e.left))), V(-(rotation * local(e.right)))});
    }
  }

  /// Whether the faces and edges are known and span the space, as the theorem needs.
  bool spans() const {
    if constexpr (D == 1) return true;
    if (nearly_flat_) return false;
    if constexpr (D == 2) return not_parallel();
    if (has_solid(edges_a_) || has_solid(edges_b_)) return true;
    // No solid: the difference has volume iff three of the edges do.
    S most = 0;
    const auto each = [&](auto&& action) {
      for (const auto* list : {&edges_a_, &edges_b_})
        for (const Edge3& e : *list) action(e.direction);
    };
    V u = V::Zero(), normal = V::Zero();
    each([&](const V& e) { if (u.isZero(0)) u = e; });
    each([&](const V& e) { if (V n = cross(u, e); n.norm() > normal.norm()) normal = n; });
    each([&](const V& e) { most = std::max(most, std::abs(normal.dot(e))); });
    return most > S(1024) * std::numeric_limits<S>::epsilon();
  }

  /// Ends at the first gap: how wide it is, is nothing that faces and edges alone can tell.
  SatResult<D, S> run() {
    const int pairs = static_cast<int>(edges_a_.size() * edges_b_.size());
    trace_(SatBegan<V, Viewed>{static_cast<int>(faces_a_.size()), static_cast<int>(faces_b_.size()), pairs});
    return finish(all_axes());
  }

 private:
  static V local(const AnyVector& v) {
    if (v.size() == 0) return V::Zero();
    const Vector<D, double> fixed = v;
    return fixed.template cast<S>();
  }
  static V cross(const V& x, const V& y) {
    if constexpr (D == 3) return x.cross(y);
    return V::Zero();
  }
  /// In the plane: two faces that face different ways.
  bool not_parallel() const requires(D == 2) {
    const auto differ = [](const V& m, const V& n) { return std::abs(m[0] * n[1] - m[1] * n[0]) > S(64) * std::numeric_limits<S>::epsilon(); };
    for (const auto* list : {&faces_a_, &faces_b_})
      for (const V& n : *list)
        if (differ(n, faces_a_.empty() ? faces_b_.front() : faces_a_.front())) return true;
    return false;
  }
  static bool has_solid(const std::vector<Edge3>& edges) { return !edges.empty() && edges.front().solid(); }

  SatStatus all_axes() {
    for (const V& n : faces_a_)
      if (separates(n, AxisSource::face_a)) return SatStatus::separated;
    for (const V& n : faces_b_)
      if (separates(n, AxisSource::face_b)) return SatStatus::separated;
    for (const Edge3& a : edges_a_)
      for (const Edge3& b : edges_b_)
        if (pair_separates(a, b)) return SatStatus::separated;
    return result_.depth < -floor_ ? SatStatus::separated : result_.depth > floor_ ? SatStatus::overlapping : SatStatus::undecided;
  }

  bool pair_separates(const Edge3& a, const Edge3& b) {
    const V across = cross(a.direction, b.direction);
    // Parallel edges make no face of their own; the faces beside them have been tested.
    if (!(across.norm() > S(64) * std::numeric_limits<S>::epsilon())) return false;
    const V n = across.normalized();
    if (!a.solid() || !b.solid()) return separates(n, AxisSource::edge_pair) || separates(V(-n), AxisSource::edge_pair);
    if (!arcs_cross(a, b)) return false;
    return separates(n.dot(a.left + a.right) < 0 ? V(-n) : n, AxisSource::edge_pair);
  }

  /// Touching arcs count: better one axis too many than the right one missed.
  bool arcs_cross(const Edge3& a, const Edge3& b) const {
    const S slack = S(16) * std::numeric_limits<S>::epsilon();
    const S left = b.left.dot(a.direction), right = b.right.dot(a.direction);
    if (left * right > slack) return false;
    const S first = a.left.dot(b.direction), second = a.right.dot(b.direction);
    if (first * second > slack) return false;
    const V n = cross(a.direction, b.direction);
    const S half_a = n.dot(a.left + a.right), half_b = n.dot(b.left + b.right);
    return half_a * half_b >= -slack;
  }

  bool separates(const V& n, AxisSource source) {
    const auto point = difference_.support(n);
    const S height = n.dot(point.w);
    ++result_.iterations;
    if (result_.iterations == 1 || height < result_.depth) result_.depth = height, result_.normal = n;
    if constexpr (traced<Trace>) tell_axis(trace_, result_.iterations, source, n, point, result_.depth, std::numeric_limits<S>::quiet_NaN(), floor_, static_cast<double>(difference_.radius()));
    return -height > floor_;
  }

  SatResult<D, S> finish(SatStatus status) {
    result_.status = status;
    if (result_.depth == 0) result_.depth = 0;
    trace_(SatEnded<V, Viewed>{result_.iterations, status, result_.normal,
                               static_cast<double>(-result_.depth) - static_cast<double>(difference_.radius())});
    return result_;
  }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const bool nearly_flat_;
  std::vector<V> &faces_a_, &faces_b_;
  std::vector<Edge3> &edges_a_, &edges_b_;
  SatResult<D, S> result_;
};

}  // namespace gjkdbg
