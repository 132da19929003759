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
#include "algo/polygon_points.h"
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

  /// Ends at the first gap, which is measured unless it is wider than `enough`, >= 0; infinite where the distance or depth is asked for: then along all edges.
  [[gnu::flatten]] const SatResult<2, S>& run(S enough) {
    ends_at_ = std::isinf(enough) ? enough : floor_;
    trace_(SatBegan<V, Viewed>{pair_.a.size(), pair_.b.size(), 0});
    GreatestOfFours<S> widest;
    if (!separates<true>(widest)) separates<false>(widest);
    if constexpr (!traced<Trace>) difference_.count_supports(result_.iterations);  // an axis is a support of which only the height is wanted
    const auto [place, separation] = widest.found();
    const int edge = static_cast<int>(place), of_a = 4 * pair_.a.count();
    if (edge < of_a) conclude<true>(std::min(edge, pair_.a.size() - 1), separation, enough);
    else conclude<false>(std::min(edge - of_a, pair_.b.size() - 1), separation, enough);
    trace_(SatEnded<V, Viewed>{result_.iterations, result_.status, result_.normal,
                               static_cast<double>(-result_.depth) - static_cast<double>(difference_.radius())});
    return result_;
  }

  /// Of polygons that overlap. Unset where rounding has the last word, and where a yes or no was asked for.
  const std::optional<SatWitnesses<2, S>>& witnesses() const { return witnesses_; }
  /// Of polygons that are apart, but by no more than enough. Unset where it is not proven.
  const std::optional<NearestPoints<2, S>>& gap() const { return gap_; }

 private:
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
      if constexpr (traced<Trace>) trace_axis(source, source == AxisSource::face_a ? polygon.normal(i) : V(-(pair_.rotation * polygon.normal(i))), apart);
      if (apart > ends_at_) return true;
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

  /// What the edge found leads to.
  template <bool of_a>
  void conclude(int edge, S separation, S enough) {
    const V out = (of_a ? pair_.a : pair_.b).normal(edge), turned = of_a ? V(pair_.rotation.transpose() * out) : V(pair_.rotation * out);
    const int corner = (of_a ? pair_.b : pair_.a).lowest(turned);
    result_.normal = of_a ? out : V(-turned);
    result_.depth = separation == 0 ? 0 : -separation;
    const bool apart = separation > floor_, overlapping = separation < -floor_;
    result_.status = apart ? SatStatus::separated : overlapping ? SatStatus::overlapping : SatStatus::undecided;
    if (apart ? separation > enough : overlapping && std::isfinite(enough)) return;  // yes or no
    const EdgeAndCorner<of_a, S> nearest(pair_, edge, corner, separation);
    const PolygonPoints<S> points = nearest.is_across() ? nearest.points_across() : nearest.points_at_end(floor_);
    if (points.across && apart) {
      gap_ = NearestPoints<2, S>{points.a, points.b, result_.normal, separation, separation - floor_};
    } else if (points.across) {
      witnesses_ = SatWitnesses<2, S>{points.a, points.b};
      result_.status = SatStatus::overlapping;  // within rounding, too: by points of both
    } else if (!overlapping) {
      gap_ = find_gap(points);
      if (gap_) result_.status = SatStatus::separated;
    }
  }

  /// From points at the end of the edge, by projections if need be: see above.
  std::optional<NearestPoints<2, S>> find_gap(const PolygonPoints<S>& from) {
    V a = from.a, b = from.b;
    int at_a = from.at_a, at_b = from.at_b;
    std::optional<NearestPoints<2, S>> gap = proven_gap(pair_, a, b, floor_);
    if (gap) count_projection(a, b);
    bool moved = true;
    for (int round = 8; round > 0 && moved && !gap; --round) {
      b = pair_.to_a(pair_.b.nearest(pair_.to_b(a), at_b));
      const V before = std::exchange(a, pair_.a.nearest(b, at_a));
      moved = ((a - before).cwiseAbs().array() > floor_).any();
      count_projection(a, b);
      gap = proven_gap(pair_, a, b, floor_);
    }
    if (gap) result_.normal = gap->normal, result_.depth = -gap->distance;
    return gap;
  }

  void count_projection(const V& a, const V& b) {
    ++result_.iterations;
    if constexpr (traced<Trace>) trace_projection(a, b);
  }

  void trace_projection(const V& a, const V& b) {
    const S distance = (b - a).norm(), plane = distance > 0 ? separation_along(pair_, V((b - a) / distance)) : S(0);
    const double radius = static_cast<double>(difference_.radius());
    trace_(PointsProjected<V, Viewed>{result_.iterations, a, b, V(a - b), static_cast<double>(std::max(plane, -result_.depth) - floor_) - radius,
                                      static_cast<double>(distance + floor_) - radius});
  }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const PolygonPair<S> pair_;
  S ends_at_ = 0;
  S most_traced_ = -std::numeric_limits<S>::infinity();
  SatResult<2, S> result_;
  std::optional<SatWitnesses<2, S>> witnesses_;
  std::optional<NearestPoints<2, S>> gap_;
};

}  // namespace gjkdbg
