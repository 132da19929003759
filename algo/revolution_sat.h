// The separating axis test of two bodies of revolution whose axes are parallel: cylinders, cones, capsules, balls that stand beside or within one another.
//
// EPA builds a polytope around the origin. Where that lies on the axis of A - B, nearest to the side, a whole circle of points is nearest, and a polytope of n sides is
// 1 - cos(pi / n) short of it: for ten digits it would need a hundred thousand. But both bodies stay what they are when they turn about the direction u of their axes, so A - B is a body
// of revolution as well, about the line along u through its centre c. Let e lead across that line to the origin, r away from it. A unit direction is n = cos(t) e' + sin(t) u with e' across u and
// cos(t) >= 0, and the height
//
//   h(n) = g(t) + c . n,   c . n = cos(t) c . e' + sin(t) c . u >= -r cos(t) + sin(t) c . u
//
// is for every t least at e' = e: the nearest point of the boundary lies in the plane of u and e. The section of A - B by it is the sum of A's and -B's sections. Each of these is a trapezoid,
//
//   corners   (+-top, half), (+-bottom, -half)          in the axes e, u about the middle: a cylinder has top = bottom, a cone top = 0,
//   normals   (0, 1), (0, -1), (2 half, bottom - top)   a segment neither, and a point is no half as high, too,
//
// and the normals of the sum's edges are those of both (the mirrored ones lead away from the origin and are never nearer). The depth is the least height along them, as for any polytope
// (algo/sat.h): four axes at most, for the ends share theirs. Its witness points lie on an edge of each section, or at a corner: in the middle of what the edges share.
//
// Axes that are not quite parallel are taken to be while that matters less than the tolerance. Turned upright, by a rotation that takes a unit vector along B's axis by s from where it is, no
// point of B moves by more than s extent_B, and no height changes by more: the least height over all directions is no lower than the least found, less twice that.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "algo/sat.h"

namespace gjkdbg {

/// A body of revolution by its section, and where its axis is.
template <class S>
struct Revolved {
  Vector<3, S> axis;    ///< unit, from bottom to top; zero where every one will do: a point
  Vector<3, S> middle;  ///< of the axis between bottom and top, in the frame of `axis`
  S top, bottom, half;  ///< radii of both ends, half the height

  bool point() const { return top == 0 && bottom == 0 && half == 0; }
  /// The same in another frame.
  Revolved placed(const Matrix<3, S>& rotation, const Vector<3, S>& position) const { return {rotation * axis, rotation * middle + position, top, bottom, half}; }
  /// With the axis the other way round.
  Revolved turned() const { return {-axis, middle, bottom, top, half}; }
};

/// Unset where the core is none, or one whose section has no corners: an ellipsoid.
template <class S, class Core>
std::optional<Revolved<S>> revolved(const Core& core) {
  using V = Vector<3, S>;
  if (std::holds_alternative<PointCore<3, S>>(core)) return Revolved<S>{V::Zero(), V::Zero(), 0, 0, 0};
  if (const auto* x = std::get_if<SegmentCore<3, S>>(&core)) return Revolved<S>{V::Unit(x->axis), V::Zero(), 0, 0, x->half_height};
  if (const auto* x = std::get_if<CylinderCore<S>>(&core)) return Revolved<S>{V::Unit(x->axis), V::Zero(), x->radius, x->radius, x->half_height};
  if (const auto* x = std::get_if<ConeCore<S>>(&core)) return Revolved<S>{V::Unit(x->axis), V::Zero(), 0, x->radius, x->half_height};
  const auto* few = std::get_if<VerticesCore<3, S>>(&core);
  if (!few || few->vertices.size() > 2) return std::nullopt;
  const V first = few->vertices[0], along = few->vertices[few->vertices.size() - 1] - first;
  const S length = along.norm();
  if (length > 0) return Revolved<S>{along / length, first + along / 2, 0, 0, length / 2};
  return Revolved<S>{V::Zero(), first, 0, 0, 0};
}

/// A normal of an edge of the section of A - B, in the axes e, u, of any length.
template <class S>
struct SectionNormal {
  AxisSource source;
  Vector<2, S> n;
};

/// The bodies of a difference, in body 0's frame, about one axis.
template <class S>
struct RevolvedPair {
  Revolved<S> a, b;
  S slack;  ///< how much less than the least height along the normals the depth may be, since the axes are not quite parallel

  /// Each once: those of A's edges come first.
  struct Normals {
    std::array<SectionNormal<S>, 4> list;
    int of_a = 0, of_b = 0;
  };
  Normals normals() const {
    Normals all;
    const auto add = [&](AxisSource source, bool has, S along_e, S along_u) {
      if (!has) return;
      all.list[all.of_a + all.of_b] = {source, {along_e, along_u}};
      ++(source == AxisSource::face_a ? all.of_a : all.of_b);
    };
    const S rise = 2 * a.half, taper = a.bottom - a.top, rise_b = 2 * b.half, taper_b = b.top - b.bottom;  // -B stands on its head
    add(AxisSource::face_a, a.half > 0, rise, taper);
    add(AxisSource::face_a, a.top > 0, 0, 1);
    add(AxisSource::face_a, a.bottom > 0, 0, -1);
    add(AxisSource::face_b, b.half > 0 && !(a.half > 0 && rise * taper_b == taper * rise_b), rise_b, taper_b);
    add(AxisSource::face_b, b.bottom > 0 && !(a.top > 0), 0, 1);
    add(AxisSource::face_b, b.top > 0 && !(a.bottom > 0), 0, -1);
    return all;
  }

  /// `tolerance`: relative, of the depth. Unset where the bodies are none of revolution, their axes not parallel, or the sum of their sections has no area.
  template <class Difference>
  static std::optional<RevolvedPair> of(const Difference& difference, S tolerance) {
    if constexpr (requires { difference.a().core(), difference.b().core(); }) {
      const auto a = revolved<S>(difference.a().core());
      if (!a) return std::nullopt;
      const auto b = revolved<S>(difference.b().core());
      if (!b || a->top + a->bottom + b->top + b->bottom == 0 || a->half + b->half == 0) return std::nullopt;
      const S extent = static_cast<S>(difference.b().extent()), depth = static_cast<S>(difference.a().extent()) + extent;  // it is no more than that
      const RevolvedPair pair = about_one_axis(*a, b->placed(difference.rotation(), difference.position()), extent);
      if (pair.bearable(difference.rounding_floor(), tolerance * depth)) return pair;
    }
    return std::nullopt;
  }
  bool bearable(S rounding, S tolerance) const { return slack <= std::max(rounding, tolerance / 2); }

 private:
  static RevolvedPair about_one_axis(Revolved<S> a, Revolved<S> b, S extent) {
    if (a.point()) a.axis = b.axis;
    if (b.point()) b.axis = a.axis;
    if (a.axis.dot(b.axis) < 0) b = b.turned();
    return {a, b, 2 * extent * (a.axis - b.axis).norm()};
  }
};

template <class Difference, class Trace>
class RevolutionSat {
  using S = typename Difference::S;
  using V = Vector<3, S>;
  using Flat = Vector<2, S>;  ///< in the axes e, u

 public:
  /// Keeps references.
  RevolutionSat(Difference& difference, const RevolvedPair<S>& pair, Trace& trace)
      : difference_(difference), trace_(trace), floor_(difference.rounding_floor()), pair_(pair), u_(pair.a.axis), e_(across(u_, pair.b.middle - pair.a.middle)) {}

  /// `overlapping` where the depth is known: within rounding, or this tolerance, a part of it.
  const SatResult<3, S>& run(S tolerance) {
    const auto normals = pair_.normals();
    trace_(SatBegan<V, Viewed>{normals.of_a, normals.of_b, 0});
    for (int i = 0; i < normals.of_a + normals.of_b; ++i) look_along(normals.list[i].source, normals.list[i].n.stableNormalized());
    const bool known = result_.depth > floor_ && pair_.bearable(floor_, tolerance * result_.depth);
    result_.status = known ? SatStatus::overlapping : result_.depth < -floor_ ? SatStatus::separated : SatStatus::undecided;
    trace_(SatEnded<V, Viewed>{result_.iterations, result_.status, result_.normal, static_cast<double>(-result_.depth) - static_cast<double>(difference_.radius())});
    return result_;
  }

  /// Of cores that overlap. Along the normal A's edge and B's lie `depth` from each other, and side by side, for the nearest point of A - B is within its edge. What lies on both is as near as
  /// any: the middle of it is taken. (x, z) = height n + t along gives a point from its distance along n and across it.
  SatWitnesses<3, S> witnesses() const {
    const Revolved<S> &a = pair_.a, &b = pair_.b;
    const Flat along(-n_[1], n_[0]);
    const V across_n = e_ * along[0] + u_ * along[1];
    const auto [low_a, high_a] = edge(a, n_, along);
    const auto [low_b, high_b] = edge(b, -n_, along);
    const S from_a = across_n.dot(b.middle - a.middle);
    const S t = (std::max(low_a, low_b + from_a) + std::min(high_a, high_b + from_a)) / 2;
    const V nearest = a.middle + result_.normal * highest(a, n_) + across_n * t;
    return {nearest, nearest - result_.normal * result_.depth};
  }

 private:
  /// Across the axis towards B, the way from the middle of A - B to the origin. Where there is none, or none but rounding, every way is as near.
  static V across(const V& u, const V& towards) {
    V e = towards - u * u.dot(towards);
    e -= u * u.dot(e);
    const S length = e.stableNorm();
    if (length > std::numeric_limits<S>::epsilon() * towards.stableNorm()) return e / length;
    Eigen::Index least = 0;
    u.cwiseAbs().minCoeff(&least);
    return u.cross(V(V::Unit(least))).normalized();
  }

  void look_along(AxisSource source, const Flat& flat) {
    const V n = e_ * flat[0] + u_ * flat[1];
    const auto point = difference_.support(n);
    const S height = n.dot(point.w);
    ++result_.iterations;
    if (result_.iterations == 1 || height < result_.depth) result_.depth = height, result_.normal = n, n_ = flat;
    if constexpr (traced<Trace>) {
      const double radius = static_cast<double>(difference_.radius());
      trace_(SupportQueried<V, Viewed>{result_.iterations, Phase::sat, n, point.vertex, point.a, point.b, point.w});
      trace_(AxisTested<V, Viewed>{result_.iterations, source, point.vertex, n, static_cast<double>(-height) - radius,
                                   static_cast<double>(-result_.depth - floor_) - radius, std::numeric_limits<double>::quiet_NaN()});
    }
  }

  static std::array<Flat, 4> corners(const Revolved<S>& r) { return {{{r.top, r.half}, {-r.top, r.half}, {r.bottom, -r.half}, {-r.bottom, -r.half}}}; }
  static S highest(const Revolved<S>& r, const Flat& n) {
    S most = -std::numeric_limits<S>::infinity();
    for (const Flat& corner : corners(r)) most = std::max(most, n.dot(corner));
    return most;
  }
  /// Where the corners that are the farthest along n, but for rounding, lie along an edge across it.
  std::pair<S, S> edge(const Revolved<S>& r, const Flat& n, const Flat& along) const {
    const S bar = highest(r, n) - floor_;
    S low = std::numeric_limits<S>::infinity(), high = -low;
    for (const Flat& corner : corners(r))
      if (n.dot(corner) >= bar) low = std::min(low, along.dot(corner)), high = std::max(high, along.dot(corner));
    return {low, high};
  }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const RevolvedPair<S>& pair_;
  const V u_, e_;  ///< along the axes, and across them towards the origin
  Flat n_ = Flat::Zero();  ///< the normal
  SatResult<3, S> result_;
};

/// What SAT tells of two bodies of revolution. The points mean something where it ends as `overlapping`.
template <class S>
struct RevolutionDepth {
  SatResult<3, S> sat;
  SatWitnesses<3, S> points;
  S slack;  ///< how much less the depth may be than the least height
};

/// Unset where they are none, their axes are not parallel within the tolerance (relative, of the depth), or their difference has no volume.
template <class Difference, class Trace>
std::optional<RevolutionDepth<typename Difference::S>> revolution_sat(Difference& difference, typename Difference::S tolerance, Trace& trace) {
  using S = typename Difference::S;
  const auto pair = RevolvedPair<S>::of(difference, tolerance);
  if (!pair) return std::nullopt;
  RevolutionSat<Difference, Trace> sat(difference, *pair, trace);
  const SatResult<3, S> found = sat.run(tolerance);
  return RevolutionDepth<S>{found, sat.witnesses(), pair->slack};
}

}  // namespace gjkdbg
