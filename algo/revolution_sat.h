// How deep two bodies of revolution are whose axes are parallel: cylinders, cones, capsules, balls, spheroids that stand beside or within one another.
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
// or an ellipse, a spheroid's. Of two trapezoids the normals of the sum's edges are those of both (the mirrored ones lead away from the origin and are never nearer), and the depth is the least
// height along them, as for any polytope (algo/sat.h): four axes at most, for the ends share theirs. Its witness points lie on an edge of each section, or at a corner: in the middle of what the
// edges share.
//
// With an ellipse the least height is searched for, an arc of directions t at a time (algo/outline_arcs.h).
//
// Axes that are not quite parallel are taken to be while that matters less than the tolerance. Turned upright, by a rotation that takes a unit vector along B's axis by s from where it is, no
// point of B moves by more than s extent_B, and no height changes by more: the least height over all directions is no lower than the least found, less twice that.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "algo/outline_arcs.h"
#include "algo/sat.h"

namespace gjkdbg {

/// A body of revolution by its section, a trapezoid or an ellipse, and where its axis is.
template <class S>
struct Revolved {
  Vector<3, S> axis;    ///< unit, from bottom to top; zero where every one will do: a point, a ball
  Vector<3, S> middle;  ///< of the axis between bottom and top, in the frame of `axis`
  S top = 0, bottom = 0, half = 0;  ///< radii of both ends, half the height
  S across = 0, along = 0;          ///< an ellipse's half axes: none is zero, or both are

  S widest() const { return std::max({top, bottom, across}); }
  S highest() const { return half + along; }
  S reach() const { return std::hypot(widest(), highest()); }  ///< from the middle
  /// Along n, in the axes across (outwards) and along the axis.
  S reach_along(const Vector<2, S>& n) const {
    if (ellipse()) return Vector<2, S>(across * n[0], along * n[1]).norm();
    return std::max(top * std::abs(n[0]) + half * n[1], bottom * std::abs(n[0]) - half * n[1]);
  }
  bool ellipse() const { return across > 0; }
  S sharpest() const { return ellipse() ? std::min(across, along) * (std::min(across, along) / std::max(across, along)) : S(0); }  ///< the least radius of its curve
  /// The same in another frame.
  Revolved placed(const Matrix<3, S>& rotation, const Vector<3, S>& position) const { return {rotation * axis, rotation * middle + position, top, bottom, half, across, along}; }
  /// Of all points x the points -x.
  Revolved reversed() const { return {-axis, -middle, top, bottom, half, across, along}; }
  /// With the axis the other way round.
  Revolved turned() const { return {-axis, middle, bottom, top, half, across, along}; }
};

/// Unset where the core is none.
template <class S, class Core>
std::optional<Revolved<S>> revolved(const Core& core) {
  using V = Vector<3, S>;
  if (std::holds_alternative<PointCore<3, S>>(core)) return Revolved<S>{V::Zero(), V::Zero()};
  if (const auto* x = std::get_if<SegmentCore<3, S>>(&core)) return Revolved<S>{V::Unit(x->axis), V::Zero(), 0, 0, x->half_height};
  if (const auto* x = std::get_if<CylinderCore<S>>(&core)) return Revolved<S>{V::Unit(x->axis), V::Zero(), x->radius, x->radius, x->half_height};
  if (const auto* x = std::get_if<ConeCore<S>>(&core)) return Revolved<S>{V::Unit(x->axis), V::Zero(), 0, x->radius, x->half_height};
  if (const auto* x = std::get_if<EllipsoidCore<3, S>>(&core)) {
    const V& r = x->radii;
    for (int k = 0; k < 3; ++k)
      if (const S across = r[(k + 1) % 3], along = r[k]; across == r[(k + 2) % 3]) {
        const V axis = across == along ? V(V::Zero()) : V(V::Unit(k));
        if (across > 0 && along > 0) return Revolved<S>{axis, V::Zero(), 0, 0, 0, across, along};
        return Revolved<S>{axis, V::Zero(), across, across, along};  // a disc, a segment, a point
      }
    return std::nullopt;
  }
  const auto* few = std::get_if<VerticesCore<3, S>>(&core);
  if (!few || few->vertices.size() > 2) return std::nullopt;
  const V first = few->vertices[0], step = few->vertices[few->vertices.size() - 1] - first;
  const S length = step.norm();
  if (length > 0) return Revolved<S>{step / length, first + step / 2, 0, 0, length / 2};
  return Revolved<S>{V::Zero(), first};
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

  bool curved() const { return a.ellipse() || b.ellipse(); }

  /// Of the trapezoids' edges. Each once: those of A's edges come first.
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
    const bool side_a = rise > 0 || taper != 0, side_b = rise_b > 0 || taper_b != 0, same = rise * taper_b == taper * rise_b && rise * rise_b + taper * taper_b > 0;
    add(AxisSource::face_a, side_a, rise, taper);
    add(AxisSource::face_a, a.top > 0, 0, 1);
    add(AxisSource::face_a, a.bottom > 0, 0, -1);
    add(AxisSource::face_b, side_b && !same, rise_b, taper_b);
    add(AxisSource::face_b, b.bottom > 0 && !(a.top > 0), 0, 1);
    add(AxisSource::face_b, b.top > 0 && !(a.bottom > 0), 0, -1);
    return all;
  }

  /// `tolerance`: relative, of the depth. Unset where the bodies are none of revolution, their axes not parallel, or the sum of their sections has no area.
  template <class Difference>
  static std::optional<RevolvedPair> of(const Difference& difference, S tolerance) {
    const auto pair = of_any(difference);
    if (!pair) return std::nullopt;
    const S rounding = difference.rounding_floor();
    if (pair->slack <= rounding) return pair;
    return pair->bearable(rounding, tolerance * pair->about_as_deep()) ? pair : std::nullopt;
  }
  bool bearable(S rounding, S tolerance) const { return slack <= std::max(rounding, tolerance / 2); }

  /// Where their axes are nearly parallel, and nearly on one line, so that EPA would need hundreds of faces, or more: see algo/tilted_axes.h.
  template <class Difference>
  static std::optional<RevolvedPair> of_tilted(const Difference& difference) {
    const auto pair = of_any(difference);
    return pair && pair->nearly_on_one_line() ? pair : std::nullopt;
  }

 private:
  /// The depth, if the axes were parallel; with an ellipse a quarter of a few heights' least, which seldom is more than that.
  S about_as_deep() const {
    using Flat = Vector<2, S>;
    const Vector<3, S> c = b.middle - a.middle;
    const S along = a.axis.dot(c), aside = (c - a.axis * along).norm();
    S least = std::numeric_limits<S>::infinity();
    const auto consider = [&](const Flat& n) { least = std::min(least, a.reach_along(n) + b.reach_along(-n) - aside * n[0] - along * n[1]); };
    const Normals edges = normals();
    for (int i = 0; i < edges.of_a + edges.of_b; ++i) consider(edges.list[i].n.stableNormalized());
    if (!curved()) return least;
    consider({1, 0}), consider({0, 1}), consider({0, -1});
    return least / 4;
  }

  static constexpr S most_tilt = S(1) / 4, most_aside = S(1) / 64;  // of a radian; of the larger body

  bool nearly_on_one_line() const {
    const Vector<3, S> c = b.middle - a.middle;
    return (a.axis - b.axis).norm() < most_tilt && (c - a.axis * a.axis.dot(c)).norm() < most_aside * std::max(a.reach(), b.reach());
  }

  template <class Difference>
  static std::optional<RevolvedPair> of_any(const Difference& difference) {
    if constexpr (requires { difference.a().core(), difference.b().core(); }) {
      const auto a = revolved<S>(difference.a().core());
      if (!a) return std::nullopt;
      const auto b = revolved<S>(difference.b().core());
      if (!b || a->widest() + b->widest() == 0 || a->highest() + b->highest() == 0) return std::nullopt;
      return about_one_axis(*a, b->placed(difference.rotation(), difference.position()), static_cast<S>(difference.b().extent()));
    }
    return std::nullopt;
  }
  static RevolvedPair about_one_axis(Revolved<S> a, Revolved<S> b, S extent) {
    if (is_zero(a.axis)) a.axis = is_zero(b.axis) ? Vector<3, S>(Vector<3, S>::Unit(1)) : b.axis;
    if (is_zero(b.axis)) b.axis = a.axis;
    if (a.axis.dot(b.axis) < 0) b = b.turned();
    return {a, b, 2 * extent * (a.axis - b.axis).norm()};
  }
};

template <class Difference, class Trace>
class RevolutionSat {
  using S = typename Difference::S;
  using V = Vector<3, S>;
  using Flat = Vector<2, S>;  ///< in the axes e, u
  static constexpr S unknown = std::numeric_limits<S>::quiet_NaN();

 public:
  /// Keeps references.
  RevolutionSat(Difference& difference, const RevolvedPair<S>& pair, Trace& trace)
      : difference_(difference), trace_(trace), floor_(difference.rounding_floor()), pair_(pair), bend_(pair.a.sharpest() + pair.b.sharpest()), u_(pair.a.axis), e_(across(u_, pair.b.middle - pair.a.middle)) {}

  /// `overlapping` where the depth is known: within rounding, or this tolerance, a part of it. With an ellipse in no more than `most` steps, or three more than the trapezoid has edges.
  const SatResult<3, S>& run(S tolerance, int most) {
    const auto normals = pair_.normals();
    trace_(SatBegan<V, Viewed>{normals.of_a, normals.of_b, 0});
    const bool proven = pair_.curved() ? search(normals, tolerance, most) : look_along_all(normals);
    witnesses_ = of_features();
    const bool known = proven && result_.depth > floor_ && pair_.bearable(floor_, tolerance * result_.depth);
    result_.status = known ? SatStatus::overlapping : result_.depth < -floor_ ? SatStatus::separated : SatStatus::undecided;
    trace_(SatEnded<V, Viewed>{result_.iterations, result_.status, result_.normal, static_cast<double>(-result_.depth) - static_cast<double>(difference_.radius())});
    return result_;
  }

  /// How much less than what was found the depth may be.
  S slack() const { return pair_.slack + (pair_.curved() ? std::max(S(0), result_.depth - least_) : S(0)); }
  /// Of an `overlapping` end.
  const SatWitnesses<3, S>& witnesses() const { return witnesses_; }

 private:
  using Normals = typename RevolvedPair<S>::Normals;

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
  V in_space(const Flat& flat) const { return e_ * flat[0] + u_ * flat[1]; }

  SupportPoint<3, S> look_along(const Flat& flat) {
    const V n = in_space(flat);
    const SupportPoint<3, S> point = difference_.support(n);
    const S height = n.dot(point.w);
    ++result_.iterations;
    if (result_.iterations == 1 || height < result_.depth) result_.depth = height, result_.normal = n, n_ = flat;
    if constexpr (traced<Trace>) trace_(SupportQueried<V, Viewed>{result_.iterations, Phase::sat, n, point.vertex, point.a, point.b, point.w});
    return point;
  }
  /// `least`: that the depth is, as far as is known.
  void tell([[maybe_unused]] AxisSource source, [[maybe_unused]] const Flat& flat, [[maybe_unused]] const SupportPoint<3, S>& point, [[maybe_unused]] S least) {
    if constexpr (traced<Trace>) {
      const double radius = static_cast<double>(difference_.radius());
      const V n = in_space(flat);
      trace_(AxisTested<V, Viewed>{result_.iterations, source, point.vertex, n, static_cast<double>(-n.dot(point.w)) - radius, static_cast<double>(-result_.depth - floor_) - radius,
                                   static_cast<double>(floor_ - least) - radius});
    }
  }

  // --- Two trapezoids ---------------------------------------------------------------------------------------------

  bool look_along_all(const Normals& normals) {
    for (int i = 0; i < normals.of_a + normals.of_b; ++i) {
      const Flat n = normals.list[i].n.stableNormalized();
      tell(normals.list[i].source, n, look_along(n), unknown);
    }
    return true;
  }

  /// Along the normal an edge of A's section, or a point, and one of B's lie `depth` from each other, and side by side, for the nearest point of A - B is within its edge (of an ellipse but for
  /// the tolerance). What lies on both is as near as any: the middle of it is taken. (x, z) = height n + t along gives a point from its distance along n and across it.
  SatWitnesses<3, S> of_features() const {
    const Revolved<S> &a = pair_.a, &b = pair_.b;
    const Flat along(-n_[1], n_[0]);
    const V across_n = in_space(along);
    const auto [low_a, high_a] = edge(a, n_, along);
    const auto [low_b, high_b] = edge(b, -n_, along);
    const S from_a = across_n.dot(b.middle - a.middle);
    S t = (std::max(low_a, low_b + from_a) + std::min(high_a, high_b + from_a)) / 2;
    // Beside a corner there is nothing; of two curves the one that bends less reaches nearly as far beside its farthest point.
    if (a.ellipse() && b.ellipse()) t = (low_a * bend_at(b, n_) + (low_b + from_a) * bend_at(a, n_)) / (bend_at(a, n_) + bend_at(b, n_));
    if (!a.ellipse()) t = std::clamp(t, low_a, high_a);
    if (!b.ellipse()) t = std::clamp(t, low_b + from_a, high_b + from_a);
    const V nearest = a.middle + result_.normal * a.reach_along(n_) + across_n * t;
    return {nearest, nearest - result_.normal * result_.depth};
  }

  static std::array<Flat, 4> corners(const Revolved<S>& r) { return {{{r.top, r.half}, {-r.top, r.half}, {r.bottom, -r.half}, {-r.bottom, -r.half}}}; }
  /// How far an ellipse reaches along n, and across it there: its farthest point is (across^2 n_e, along^2 n_u) / |(across n_e, along n_u)|.
  static Flat of_ellipse(const Revolved<S>& r, const Flat& n, const Flat& beside) {
    const Flat stretched(r.across * n[0], r.along * n[1]);
    const S height = stretched.norm();
    return {height, beside.dot(Flat(r.across * stretched[0], r.along * stretched[1])) / height};
  }
  /// The radius of its curve there: (across along)^2 / height^3.
  static S bend_at(const Revolved<S>& r, const Flat& n) {
    const S height = of_ellipse(r, n, n)[0], p = r.across / height, q = r.along / height;
    return p * q * q * r.across;
  }
  /// Where the corners that are the farthest along n, but for rounding, lie along an edge across it.
  std::pair<S, S> edge(const Revolved<S>& r, const Flat& n, const Flat& along) const {
    if (r.ellipse()) {
      const S at = of_ellipse(r, n, along)[1];
      return {at, at};
    }
    const S bar = r.reach_along(n) - floor_;
    S low = std::numeric_limits<S>::infinity(), high = -low;
    for (const Flat& corner : corners(r))
      if (n.dot(corner) >= bar) low = std::min(low, along.dot(corner)), high = std::max(high, along.dot(corner));
    return {low, high};
  }

  // --- An ellipse among them --------------------------------------------------------------------------------------

  bool search(const Normals& normals, S tolerance, int most) {
    OutlineArcs<S> arcs(bend_);
    for (int i = 0; i < normals.of_a + normals.of_b; ++i) add(arcs, normals.list[i].source, normals.list[i].n.stableNormalized());
    for (const Flat& n : {Flat(0, -1), Flat(0, 1), Flat(1, 0)}) add(arcs, AxisSource::outline, n);
    const auto proven = [&] { return result_.depth - arcs.least().height <= std::max(floor_, tolerance * result_.depth - pair_.slack); };
    for (int before = 0; !proven() && arcs.count() > before && !arcs.full() && result_.iterations < most;) {
      before = arcs.count();
      const Flat next = arcs.least().towards;  // which moves on
      add(arcs, AxisSource::outline, next);
    }
    least_ = arcs.least().height;
    return proven();
  }

  void add(OutlineArcs<S>& arcs, AxisSource source, const Flat& n) {
    if (arcs.knows(n)) return;  // an end of a cylinder
    const SupportPoint<3, S> point = look_along(n);
    arcs.add(n, Flat(e_.dot(point.w), u_.dot(point.w)));
    tell(source, n, point, arcs.all_round() ? arcs.least().height : unknown);
  }

  Difference& difference_;
  Trace& trace_;
  const S floor_;
  const RevolvedPair<S>& pair_;
  const S bend_;   ///< radius of the discs of the sharpest bends
  const V u_, e_;  ///< along the axes, and across them towards the origin
  Flat n_ = Flat::Zero();  ///< the normal
  S least_ = 0;            ///< that a height is, by all bounds
  SatResult<3, S> result_;
  SatWitnesses<3, S> witnesses_{V::Zero(), V::Zero()};
};

/// Unset where they are none, their axes are not parallel within the tolerance (relative, of the depth), or their difference has no volume. `most`: see RevolutionSat::run.
template <class Difference, class Trace>
std::optional<OutlineDepth<3, typename Difference::S>> revolution_sat(Difference& difference, typename Difference::S tolerance, int most, Trace& trace) {
  using S = typename Difference::S;
  const auto pair = RevolvedPair<S>::of(difference, tolerance);
  if (!pair) return std::nullopt;
  RevolutionSat<Difference, Trace> outline(difference, *pair, trace);
  const SatResult<3, S> found = outline.run(tolerance, most);
  return OutlineDepth<3, S>{found, outline.witnesses(), outline.slack()};
}

}  // namespace gjkdbg
