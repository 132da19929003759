// The separating axis test of two convex polygons in the plane: the normals of their edges, four at a time.
//
// A - B has the edges of A and those of B turned around, so their separations decide (algo/polygon_separation.h, algo/sat.h). The widest is the distance
// or, below zero, the depth with its sign turned, where the other polygon's corner lies across the edge, or, on edges that lie along one another, an end of
// the edge across that polygon. Else the nearest features are two corners, or a corner and another edge: a point and its nearest on the other polygon, in
// turn, come to them in a few steps: points that are each the nearest to the other are the closest of all, as a plane across at either has the whole polygon behind it
// (alternating projections; Cheney, Goldstein 1959, theorem 2). The separation along their difference proves it. Where it does not, GJK is asked.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algo/box_sat.h"
#include "algo/polygon_separation.h"
#include "algo/sat.h"

namespace gjkdbg {

/// A body's core where it is a polygon, or a box of which no side is zero.
template <class S>
struct PolygonOf {
  std::optional<BoxPolygon<S>> box;
  std::optional<Polygon<S>> polygon;

  template <class Body>
  explicit PolygonOf(const Body& body) {
    if constexpr (requires { body.core(); })
      if (const auto* core = std::get_if<PolygonCore<S>>(&body.core())) polygon = core->polygon();
    if (const auto* solid = solid_box<2, S>(body)) polygon = box.emplace(*solid).polygon();
  }
  PolygonOf(const PolygonOf&) = delete;
  PolygonOf& operator=(const PolygonOf&) = delete;
};

template <class Difference, class Trace>
class PolygonSat {
  using S = typename Difference::S;
  using V = Vector<2, S>;

 public:
  /// Each in its own axes; keeps references.
  PolygonSat(Difference& difference, const Polygon<S>& a, const Polygon<S>& b, Trace& trace)
      : difference_(difference), trace_(trace), floor_(difference.rounding_floor()), pair_{a, b, difference.rotation(), difference.position()} {}

  /// `enough`: the separation that needs no more, >= 0; infinite where the distance is asked for.
  [[gnu::flatten]] const SatResult<2, S>& run(S enough) {
    enough_ = enough + floor_;
    trace_(SatBegan<V, Viewed>{pair_.a.size(), pair_.b.size(), 0});
    const auto [place, corner, separation] = widest();
    if constexpr (!traced<Trace>) difference_.count_supports(result_.iterations);  // an axis is a support of which only the height is wanted
    const int of_a = 4 * pair_.a.count();
    of_a_ = place < of_a;
    edge_ = std::min(of_a_ ? place : place - of_a, face().size() - 1);
    corner_ = corner;
    result_.normal = in_a(of_a_, face().normal(edge_));
    result_.depth = separation == 0 ? 0 : -separation;
    result_.status = separation > floor_ ? SatStatus::separated : separation < -floor_ ? SatStatus::overlapping : SatStatus::undecided;
    if (result_.status == SatStatus::undecided && cross().met) result_.status = SatStatus::overlapping;  // by points of both, within rounding
    if (result_.status == SatStatus::undecided || (result_.status == SatStatus::separated && separation <= enough)) gap_ = find_gap();
    if (gap_) result_.status = SatStatus::separated;
    trace_(SatEnded<V, Viewed>{result_.iterations, result_.status, result_.normal,
                               static_cast<double>(-result_.depth) - static_cast<double>(difference_.radius())});
    return result_;
  }

  /// Of polygons that overlap. Unset where rounding has the last word.
  std::optional<SatWitnesses<2, S>> witnesses() const {
    const Crossing found = cross();
    if (!found.met) return std::nullopt;
    return of_a_ ? SatWitnesses<2, S>{found.on_edge, found.other} : SatWitnesses<2, S>{pair_.to_a(found.other), pair_.to_a(found.on_edge)};
  }

  /// Of polygons that are apart, but by no more than enough. Unset where it is not proven.
  const std::optional<NearestPoints<2, S>>& gap() const { return gap_; }

 private:
  const Polygon<S>& face() const { return of_a_ ? pair_.a : pair_.b; }
  const Polygon<S>& opposite() const { return of_a_ ? pair_.b : pair_.a; }
  /// Points of the opposite polygon in the best edge's axes, and back.
  V to_face(const V& p) const { return of_a_ ? pair_.to_a(p) : pair_.to_b(p); }
  V to_opposite(const V& p) const { return of_a_ ? pair_.to_b(p) : pair_.to_a(p); }
  /// A direction out of A, or of B, as one from A to B, in A's axes.
  V in_a(bool of_a, const V& n) const { return of_a ? n : V(-(pair_.rotation * n)); }

  WidestSeparation<S> widest() {
    const bool all = enough_ == std::numeric_limits<S>::infinity();
#ifdef GJKDBG_AVX2
    if constexpr (!traced<Trace> && sizeof(S) == 8)
      if (all && __builtin_cpu_supports("avx2")) {
        result_.iterations = pair_.a.size() + pair_.b.size();
        return widest_by_avx2(pair_);
      }
#endif
    GreatestOfFours<S> widest;
    if (!separates<true>(widest)) separates<false>(widest);
    const auto [place, separation] = widest.found();
    const int i = static_cast<int>(place), of_a = 4 * pair_.a.count();
    const int corner = i < of_a ? pair_.b.lowest(pair_.rotation.transpose() * pair_.a.normal(i)) : pair_.a.lowest(pair_.rotation * pair_.b.normal(i - of_a));
    return {i, corner, separation};
  }

  /// Looks along all edges of one polygon, or until one of them says enough.
  template <bool of_a>
  bool separates(GreatestOfFours<S>& widest) {
    const Polygon<S>& polygon = of_a ? pair_.a : pair_.b;
    for (int i = 0; i < polygon.count(); ++i) {
      const Four<S> separation = separations<of_a>(polygon.four(i), pair_);
      widest.take(separation);
      if (one_by_one(polygon, of_a ? AxisSource::face_a : AxisSource::face_b, 4 * i, separation)) return true;
    }
    return false;
  }

  bool one_by_one(const Polygon<S>& polygon, AxisSource source, int first, const Four<S>& separation) {
    for (int i = first; i < std::min(first + 4, polygon.size()); ++i) {
      const S apart = separation[static_cast<std::size_t>(i - first)];
      ++result_.iterations;
      if constexpr (traced<Trace>) trace_axis(source, in_a(source == AxisSource::face_a, polygon.normal(i)), apart);
      if (apart > enough_) return true;
    }
    return false;
  }

  /// In a trace the support is asked for in full.
  void trace_axis(AxisSource source, const V& n, S apart) {
    most_traced_ = std::max(most_traced_, apart);
    const auto point = difference_.support(n);
    const double radius = static_cast<double>(difference_.radius());
    trace_(SupportQueried<V, Viewed>{result_.iterations, Phase::sat, n, point.vertex, point.a, point.b, point.w});
    trace_(AxisTested<V, Viewed>{result_.iterations, source, point.vertex, n, static_cast<double>(apart) - radius,
                                 static_cast<double>(most_traced_ - floor_) - radius, std::numeric_limits<double>::quiet_NaN()});
  }

  /// A point on the best edge's line and one of the opposite polygon, both in the edge's axes, apart along its normal.
  struct Crossing {
    V on_edge, other;
    bool met;  ///< whether both are points of their polygons; if not, `on_edge` is the end of the edge nearest to the corner
    int end;   ///< the edge's, at `on_edge`
  };

  Crossing cross() const {
    const Polygon<S>&edges = face(), &corners = opposite();
    const V n = edges.normal(edge_), out = n * result_.depth, here = edges.corner(edge_), edge = edges.corner(edges.next(edge_)) - here;
    const V other = to_face(corners.corner(corner_));
    const S along = edge.dot(other - here);
    if (along >= 0 && along <= edge.dot(edge)) return {other + out, other, true, edge_};
    const int end = along < 0 ? edge_ : edges.next(edge_);
    const V tip = edges.corner(end), across = to_opposite(tip - out);
    return {tip, V(tip - out), near(corners.nearest_beside(across, corner_), across), end};
  }

  /// Across the best edge, or by projections: see above.
  std::optional<NearestPoints<2, S>> find_gap() {
    const Crossing start = cross();
    if (start.met) {
      const auto [a, b] = of_a_ ? std::pair(start.on_edge, start.other) : std::pair(pair_.to_a(start.other), pair_.to_a(start.on_edge));
      return NearestPoints<2, S>{a, b, result_.normal, -result_.depth, -result_.depth - floor_};
    }
    int at_a = of_a_ ? start.end : corner_, at_b = of_a_ ? corner_ : start.end;  // where to look from
    V a = of_a_ ? start.on_edge : pair_.a.nearest(pair_.to_a(start.on_edge), at_a);
    for (int round = 8; round > 0; --round) {
      const V b = pair_.to_a(pair_.b.nearest(pair_.to_b(a), at_b)), before = std::exchange(a, pair_.a.nearest(b, at_a));
      ++result_.iterations;
      if constexpr (traced<Trace>) trace_projection(a, b);
      if (near(a, before)) return proven_gap(a, b);
    }
    return std::nullopt;
  }

  std::optional<NearestPoints<2, S>> proven_gap(const V& a, const V& b) {
    const S distance = (b - a).norm();
    if (!(distance > floor_)) return std::nullopt;
    const V n = (b - a) / distance;
    const S plane = separation(n);
    if (distance - plane > 2 * floor_) return std::nullopt;
    result_.normal = n, result_.depth = -distance;
    return NearestPoints<2, S>{a, b, n, distance, plane - floor_};
  }

  /// Along any unit direction.
  S separation(const V& n) const {
    const V in_b = pair_.rotation.transpose() * n;
    const Polygon<S>&a = pair_.a, &b = pair_.b;
    return n.dot(pair_.position) + in_b.dot(b.corner(b.highest(-in_b))) - n.dot(a.corner(a.highest(n)));
  }

  void trace_projection(const V& a, const V& b) {
    const S distance = (b - a).norm(), plane = distance > 0 ? separation(V((b - a) / distance)) : S(0);
    const double radius = static_cast<double>(difference_.radius());
    trace_(PointsProjected<V, Viewed>{result_.iterations, a, b, V(a - b), static_cast<double>(std::max(plane, -result_.depth) - floor_) - radius,
                                      static_cast<double>(distance + floor_) - radius});
  }

  bool near(const V& p, const V& q) const { return ((p - q).cwiseAbs().array() <= floor_).all(); }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const PolygonPair<S> pair_;
  S enough_ = 0;
  S most_traced_ = -std::numeric_limits<S>::infinity();
  bool of_a_ = true;  ///< the best edge's polygon
  int edge_ = 0;      ///< the best edge
  int corner_ = 0;    ///< the opposite polygon's, nearest to its line
  SatResult<2, S> result_;
  std::optional<NearestPoints<2, S>> gap_;
};

}  // namespace gjkdbg
