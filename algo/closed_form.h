// Closed forms: the distance of spheres, capsules and segments by a formula instead of a search.
//
// Their cores are points and segments. With A's core a0 + s u and B's b0 + t v, 0 <= s, t <= 1, their difference is
//
//   w(s, t) = c + s u - t v,   c = a0 - b0        a point, a segment, or a parallelogram
//
// and the derivatives of |w|^2 vanish where the two lines are nearest to each other:
//
//   [ u.u  -u.v ] [s]   [ -c.u ]        det = u.u v.v - (u.v)^2
//   [-u.v   v.v ] [t] = [  c.v ]          s = (u.v c.v - v.v c.u) / det
//
// Where that is out of range the minimum lies on the border of the square: s is clamped, t is the best for this s, and where t must be
// clamped as well, s is the best for that t (Ericson, "Real-Time Collision Detection", 2005, 5.1.9). The plane across w proves the
// answer or shows that det was all rounding, and then it is taken in twice the precision.
// Where the origin lies in the difference the nearest side counts: across u or across v in the plane, across both in space, where the
// difference is flat. In 1D every body is a segment.
// The frame has the world's axes and body 0's position as its origin: no rotation is multiplied with another.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "algo/result.h"
#include "algo/wide.h"
#include "algo/world_trace.h"
#include "shapes/scene.h"

namespace gjkdbg {

/// A core that is a point or a segment: `start + s along`, 0 <= s <= 1, in the body's frame, scaled as its Convex is.
template <int D>
struct CoreSegment {
  Vector<D, double> start, along;
  double radius;
  double reach;  ///< |start| + |along|: no point of the core is farther from the body's origin
  bool centred;  ///< start = -along / 2, as in a capsule
};

/// Unset where the core is no segment. In 1D it always is.
template <int D, class S>
std::optional<CoreSegment<D>> core_segment(const Convex<D, S>& body) {
  using W = Vector<D, double>;
  const auto between = [&](const Vector<D, S>& from, const Vector<D, S>& to) {
    const W start = from.template cast<double>(), along = to.template cast<double>() - start, placed = body.reference() + start;
    return CoreSegment<D>{placed, along, body.radius(), placed.norm() + along.norm(), placed == -along / 2};
  };
  if constexpr (D == 1) {
    return between(body.support(-Vector<1, S>::Ones()), body.support(Vector<1, S>::Ones()));
  }
  if (std::holds_alternative<PointCore<D, S>>(body.core())) return between(Vector<D, S>::Zero(), Vector<D, S>::Zero());
  if (const auto* segment = std::get_if<SegmentCore<D, S>>(&body.core())) {
    const Vector<D, S> end = Vector<D, S>::Unit(segment->axis) * segment->half_height;
    return between(-end, end);
  }
  const auto* points = std::get_if<VerticesCore<D, S>>(&body.core());
  if (points && points->vertices.size() <= 2) return between(points->vertices[0], points->vertices[points->vertices.size() - 1]);
  return std::nullopt;
}

template <int D, class S, class Trace>
class ClosedForm {
  using V = Vector<D, S>;
  using W = Vector<D, double>;

 public:
  /// Lengths of the cores are the world's times `scale`; `frame` has the world's axes and body 0's position. Keeps references.
  ClosedForm(const CoreSegment<D>& a, const CoreSegment<D>& b, const PlacedAxes<D>& pose_a, const PlacedAxes<D>& pose_b, double scale,
             const WorkingFrame<D, S>& frame, Trace& trace)
      : frame_(frame), trace_(trace), radius_a_(a.radius), radius_b_(b.radius) {
    const W along_a = pose_a.rotation * a.along, along_b = pose_b.rotation * b.along;
    const W start_a = a.centred ? W(along_a / -2) : W(pose_a.rotation * a.start), start_b = b.centred ? W(along_b / -2) : W(pose_b.rotation * b.start);
    const W offset = (pose_b.position - pose_a.position) * scale;  // a place far out, times the scale of tiny bodies, may be no number
    a0_ = start_a.template cast<S>(), u_ = along_a.template cast<S>(), v_ = along_b.template cast<S>();
    c_ = W(start_a - (offset + start_b)).template cast<S>();
    uu_ = u_.dot(u_), uv_ = u_.dot(v_), vv_ = v_.dot(v_);
    // R start and R along are off by 5 u of their lengths, the sums that make w by 6 u, w times a unit direction by 5 u.
    const double size = a.reach + b.reach + offset.template lpNorm<1>();
    floor_ = static_cast<S>(16 * static_cast<double>(std::numeric_limits<S>::epsilon()) / 2 * size);
  }

  /// In world coordinates and scene lengths. Query: intersect, distance or penetration; others are answered as penetration. Counts no supports.
  Result run(Query query) {
    trace_(ClosedFormBegan<V, Viewed>{c_, u_, v_});
    Nearest nearest = solve(c_, false);
    if (!nearest.proven(floor_))
      if (const Nearest again = solve(c_, true); again.distance <= nearest.distance) nearest = again;
    if constexpr (traced<Trace>) trace_(LinesSolved<V, Viewed>{static_cast<double>(nearest.free_s), static_cast<double>(nearest.free_t)});
    if (nearest.distance > floor_)
      return finish(ClosedFormStatus::separated, nearest, -nearest.w / nearest.distance, nearest.distance, nearest.plane - floor_, nearest.distance + floor_, query);
    if (query == Query::intersect) return finish(ClosedFormStatus::overlapping, nearest, V::Zero(), 0, -floor_, floor_, query);
    return across(nearest, query);
  }

 private:
  /// The point of the difference nearest to the origin, and the plane across it: no point of the difference is nearer than `plane`.
  struct Nearest {
    S s = 0, t = 0, free_s = 0, free_t = 0;  ///< free: of the lines; NaN where there is none, or they are parallel
    V w = V::Zero();
    S distance = 0, plane = 0;
    bool proven(S floor) const { return distance - plane <= floor; }
  };

  static S clamped(S x) { return std::clamp(x, S(0), S(1)); }

  /// s where the lines are nearest; NaN when they are parallel.
  S line_parameter(const V& c, bool wide) const {
    constexpr S none = std::numeric_limits<S>::quiet_NaN();
    if (!wide) {
      const S det = uu_ * vv_ - uv_ * uv_;
      return det > 0 ? (uv_ * c.dot(v_) - vv_ * c.dot(u_)) / det : none;
    }
    const WideVector<S> wc(c), wu(u_), wv(v_);
    const Wide<S> uu = wu.dot(wu), uv = wu.dot(wv), vv = wv.dot(wv), det = uu * vv - uv * uv;
    return sign(det) > 0 ? static_cast<S>(static_cast<double>(divide(uv * wc.dot(wv) - vv * wc.dot(wu), det))) : none;
  }

  Nearest solve(const V& c, bool wide) const {
    Nearest n;
    const bool line_u = uu_ > 0, line_v = vv_ > 0;
    const S cu = c.dot(u_), cv = c.dot(v_);
    n.free_s = n.free_t = std::numeric_limits<S>::quiet_NaN();
    if (line_u && line_v) n.free_s = line_parameter(c, wide), n.free_t = (n.free_s * uv_ + cv) / vv_;
    else if (line_u) n.free_s = -cu / uu_;
    else if (line_v) n.free_t = cv / vv_;
    n.s = line_u && !std::isnan(n.free_s) ? clamped(n.free_s) : S(0);
    if (line_v) {
      const S t = (n.s * uv_ + cv) / vv_;
      n.t = clamped(t);
      if (line_u && t != n.t) n.s = clamped((n.t * uv_ - cu) / uu_);
    }
    n.w = c + n.s * u_ - n.t * v_;
    stand_upright(c, n);
    n.distance = n.w.norm();
    if (n.distance > 0) {
      const V d = n.w / n.distance;
      n.plane = d.dot(c) + std::min(S(0), d.dot(u_)) - std::max(S(0), d.dot(v_));
    }
    return n;
  }

  /// Inside the square w is perpendicular to both segments, on its border to one: what rounding left along them is taken off, so that the normal
  /// is right however short w is.
  void stand_upright(const V& c, Nearest& n) const {
    const bool free_u = n.s > 0 && n.s < 1, free_v = n.t > 0 && n.t < 1;
    if constexpr (D == 3) {
      if (free_u && free_v) {
        const V &longer = longer_one(), aside = of_shorter_aside();
        constexpr S bar = 1000 * std::numeric_limits<S>::epsilon();
        if (aside.dot(aside) > bar * bar * std::min(uu_, vv_)) {
          const V across = longer.cross(aside);
          n.w = across * (across.dot(c) / across.dot(across));
        } else {  // parallel, but for rounding
          n.w -= longer * (n.w.dot(longer) / longer.dot(longer));
        }
        return;
      }
    }
    if (free_u && !free_v) n.w -= u_ * (n.w.dot(u_) / uu_);
    if (free_v && !free_u) n.w -= v_ * (n.w.dot(v_) / vv_);
  }

  /// How far the difference reaches along a unit direction.
  S height(const V& n) const { return n.dot(c_) + std::max(S(0), n.dot(u_)) - std::min(S(0), n.dot(v_)); }

  /// The origin is in the difference: the nearest side, and the point on it.
  Result across(const Nearest& inside, Query query) {
    V best = V::Unit(0);
    S depth = std::numeric_limits<S>::infinity();
    const auto consider = [&](const V& n) {
      if (const S h = height(n); h < depth) depth = h, best = n;
    };
    if constexpr (D == 1) {
      consider(V(1)), consider(V(-1));
    } else if constexpr (D == 2) {
      for (const V& side : {u_, v_})
        if (const V n(-side[1], side[0]); !n.isZero(0)) consider(n.normalized()), consider(-n.normalized());
    } else {
      const V n = normal_in_space();
      consider(n), consider(-n);
    }
    if (!(depth < std::numeric_limits<S>::infinity())) depth = height(best);  // two points in one place
    depth = std::max(S(0), depth);
    Nearest border = solve(c_ - depth * best, false);
    border.free_s = inside.free_s, border.free_t = inside.free_t;
    const S at_most = D == 3 ? S(0) : -depth;  // in space the difference is flat
    Result r = finish(ClosedFormStatus::overlapping, border, best, -depth, -depth - floor_, at_most + floor_, query);
    if (query == Query::distance) set_common_point(r, frame_, V(a0_ + inside.s * u_), V(a0_ - c_ + inside.t * v_), radius_a_, radius_b_);  // of the cores as they stand
    return r;
  }

  const V& longer_one() const { return uu_ < vv_ ? v_ : u_; }
  /// What of the shorter segment is across the longer one, which must have a length; taken twice, so that none of the rounding lies along it. Of nearly parallel ones u x v is next to all rounding, and the
  /// difference would reach far along it; what is across the longer one and this is across the shorter one, too, but for the rounding of its length.
  V of_shorter_aside() const {
    const V& longer = longer_one();
    const S squared = longer.dot(longer);
    V aside = uu_ < vv_ ? u_ : v_;
    for (int twice = 0; twice < 2; ++twice) aside -= longer * (longer.dot(aside) / squared);
    return aside;
  }
  /// Across both segments, or the longer one where they are parallel.
  V normal_in_space() const requires(D == 3) {
    const V& longer = longer_one();
    if (longer.isZero(0)) return V::Unit(0);
    V aside = of_shorter_aside();
    if (aside.isZero(0)) {
      Eigen::Index least = 0;
      longer.cwiseAbs().minCoeff(&least);
      aside = V::Unit(least);
    }
    return longer.cross(aside).stableNormalized();
  }

  /// `core_distance`: of the cores, signed; `lower` and `upper` its bounds.
  Result finish(ClosedFormStatus status, const Nearest& n, const V& normal, S core_distance, S lower, S upper, Query query) {
    const double radius = radius_a_ + radius_b_;
    Result r;
    r.status = status;
    r.iterations = 1;
    r.intersecting = static_cast<double>(core_distance) <= radius;
    const double low = static_cast<double>(lower) - radius, high = static_cast<double>(upper) - radius;
    trace_(ClosedFormEnded<V, Viewed>{status, static_cast<double>(n.s), static_cast<double>(n.t), core_distance < 0 ? V(-core_distance * normal) : n.w, normal, low, high});
    if (query == Query::intersect) return r;
    const V a = a0_ + n.s * u_, b = a0_ - c_ + n.t * v_;
    const bool clipped = query == Query::distance;
    r.lower_bound = (clipped ? std::max(0.0, low) : low) * frame_.unit;
    r.upper_bound = (clipped ? std::max(0.0, high) : high) * frame_.unit;
    if (clipped && r.intersecting) set_common_point(r, frame_, a, b, radius_a_, radius_b_);
    else set_witnesses(r, frame_, a, b, normal, static_cast<double>(core_distance), radius_a_, radius_b_);
    return r;
  }

  const WorkingFrame<D, S>& frame_;
  Trace& trace_;
  const double radius_a_, radius_b_;
  V a0_, c_, u_, v_;
  S uu_, uv_, vv_, floor_;
};

}  // namespace gjkdbg
