// The separating axis test of two boxes: 15 axes in space, 4 in the plane, and no support mapping.
//
// Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996, section 5. A box is its own mirror image in its centre, so of n and -n the one that leads towards the other box
// counts. What the axes tell of the difference, its facets and its nearest points, is derived in algo/boxes.h and, in the plane, algo/rectangles.h. An axis
// or one plane proves the points; where neither does, as where edges are nearly parallel or corners nearly meet, GJK or EPA is asked.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algo/boxes.h"
#include "algo/nearest_points.h"
#include "algo/rectangles.h"
#include "algo/sat.h"

namespace gjkdbg {

/// The body's core where it is a box with no side of zero, else null.
template <int D, class S, class Body>
const BoxCore<D, S>* solid_box(const Body& body) {
  if constexpr (requires { body.core(); }) {
    const auto* box = std::get_if<BoxCore<D, S>>(&body.core());
    return box && (box->half().array() > 0).all() ? box : nullptr;
  }
  return nullptr;
}

/// Two boxes on a line, which A and B both call an axis.
template <class S>
class Intervals {
 public:
  static constexpr int axes = 2;

  template <class Turn>
  Intervals(const Vector<1, S>& half_a, const Vector<1, S>& half_b, const Turn&, S x) : half_a_(half_a[0]), half_b_(half_b[0]), p_(x) {}

  template <int>
  bool is_axis() const { return true; }
  template <int>
  S separation() const { return std::abs(p_) - (half_a_ + half_b_); }
  template <int>
  Vector<1, S> normal() const { return Vector<1, S>(p_ < 0 ? -1 : 1); }
  static AxisSource source(int k) { return k == 0 ? AxisSource::face_a : AxisSource::face_b; }

  BoxPoints<1, S> points(S floor) const {
    const S apart = separation<0>();
    const Vector<1, S> n = normal<0>(), a = n * half_a_;
    return {{a, a + n * apart, n, apart, apart}, axes, apart > floor, false, true};
  }

 private:
  const S half_a_, half_b_, p_;
};

/// Each has `axes` of them, the order they are looked along in; of each `is_axis`, `separation`, `normal` and `source`; and the nearest `points`.
template <int D, class S>
using BoxAxes = std::conditional_t<D == 1, Intervals<S>, std::conditional_t<D == 2, Rectangles<S>, Boxes<S>>>;

/// Half sizes; `turn(i, j)` an element of B's turn; from A's centre to B's, in A's axes.
template <int D, class S, class Turn>
[[gnu::always_inline]] inline BoxAxes<D, S> box_axes(const Vector<D, S>& half_a, const Vector<D, S>& half_b, const Turn& turn, const S (&between)[D]) {
  if constexpr (D == 1) return {half_a, half_b, turn, between[0]};
  else if constexpr (D == 2) return {half_a, half_b, turn, between[0], between[1]};
  else return {half_a, half_b, turn, between[0], between[1], between[2]};
}

template <class Difference, class Trace>
class BoxSat {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Axes = BoxAxes<D, S>;

 public:
  /// No side is zero. Keeps references.
  BoxSat(Difference& difference, const BoxCore<D, S>& a, const BoxCore<D, S>& b, Trace& trace)
      : difference_(difference), trace_(trace), floor_(difference.rounding_floor()), center_(a.center()), axes_(axes_of(difference, a, b, center_)) {}

  /// Ends at the first gap, which is measured unless it is wider than `enough`, >= 0; infinite where the distance or depth is asked for: then at once.
  const SatResult<D, S>& run(S enough) {
    trace_(SatBegan<V, Viewed>{D, D, D == 3 ? 9 : 0});
    constexpr auto all = std::make_integer_sequence<int, Axes::axes>{};
    if (std::isinf(enough)) {
      const BoxPoints<D, S> found = axes_.points(floor_);
      tested_ = found.axes;
      if constexpr (traced<Trace>) look_along(enough, D == 3 && found.axes == 2 * D ? 2 * D : Axes::axes, all);
      take(found);
    } else {
      look_along(floor_, Axes::axes, all);
      result_.depth = -widest_;
      result_.status = widest_ > floor_ ? SatStatus::separated : SatStatus::overlapping;
      if (widest_ > floor_ && widest_ <= enough + floor_) take(axes_.points(floor_));
    }
    if constexpr (!traced<Trace>) difference_.count_supports(tested_);  // an axis is a support of which only the height is wanted
    if (result_.depth == 0) result_.depth = 0;
    trace_(SatEnded<V, Viewed>{result_.iterations, result_.status, result_.normal, static_cast<double>(-result_.depth) - static_cast<double>(difference_.radius())});
    return result_;
  }

  /// Of boxes that overlap. Unset where rounding has the last word.
  const std::optional<SatWitnesses<D, S>>& witnesses() const { return witnesses_; }
  /// Of boxes that are apart, but by no more than enough. Unset where it is not proven.
  const std::optional<NearestPoints<D, S>>& gap() const { return gap_; }

 private:
  static Axes axes_of(const Difference& difference, const BoxCore<D, S>& a, const BoxCore<D, S>& b, const V& center) {
    const V between = difference.position() + difference.rotation() * b.center() - center;
    S p[D];
    for (int i = 0; i < D; ++i) p[i] = between[i];
    return box_axes<D, S>(a.half(), b.half(), difference.rotation(), p);
  }

  /// One axis after the other, until one says enough, or `last` of them.
  template <int... k>
  void look_along(S enough, int last, std::integer_sequence<int, k...>) {
    tested_ = 0;
    ((k == last || (axes_.template is_axis<k>() && separates<k>(enough))) || ...);
    result_.iterations = tested_;
  }
  template <int k>
  bool separates(S enough) {
    const S separation = axes_.template separation<k>();
    if (tested_ == 0 || separation > widest_) widest_ = separation, result_.normal = axes_.template normal<k>();
    ++tested_;
    if constexpr (traced<Trace>) trace_axis(Axes::source(k), axes_.template normal<k>(), separation);
    return separation > enough;
  }

  /// In a trace the support is asked for in full.
  void trace_axis(AxisSource source, const V& n, S separation) {
    const auto point = difference_.support(n);
    const double radius = static_cast<double>(difference_.radius());
    trace_(SupportQueried<V, Viewed>{tested_, Phase::sat, n, point.vertex, point.a, point.b, point.w});
    trace_(AxisTested<V, Viewed>{tested_, source, point.vertex, n, static_cast<double>(separation) - radius, static_cast<double>(widest_ - floor_) - radius,
                                 std::numeric_limits<double>::quiet_NaN()});
  }

  void take(const BoxPoints<D, S>& found) {
    result_.iterations = tested_;
    result_.status = found.apart ? SatStatus::separated : SatStatus::overlapping;
    result_.normal = found.normal, result_.depth = -found.distance;
    if (!found.proven) return;
    const V a = center_ + found.a, b = center_ + found.b;
    if (!found.apart) {
      witnesses_ = SatWitnesses<D, S>{a, b};
      return;
    }
    gap_ = NearestPoints<D, S>{a, b, found.normal, found.distance, found.lower_bound - floor_};
    if (!found.corner) return;
    ++result_.iterations;
    if constexpr (traced<Trace>) {
      const double radius = static_cast<double>(difference_.radius());
      trace_(PointsProjected<V, Viewed>{result_.iterations, a, b, V(a - b), static_cast<double>(gap_->lower_bound) - radius, static_cast<double>(found.distance + floor_) - radius});
    }
  }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const V center_;  ///< A's
  const Axes axes_;
  int tested_ = 0;
  S widest_ = 0;
  SatResult<D, S> result_;
  std::optional<SatWitnesses<D, S>> witnesses_;
  std::optional<NearestPoints<D, S>> gap_;
};

}  // namespace gjkdbg
