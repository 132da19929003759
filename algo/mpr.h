// MPR (XenoCollide): whether the difference A - B holds the origin, seen from a point inside it.
//
// Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008. From a point v0 inside A - B a ray
// goes through the origin. A portal of D vertices that the ray passes between moves outwards until it is part of the boundary:
//
//        v0                      v1, v2   the portal
//         \                      n        its normal, away from v0
//     v1---\---v2                v3 = support(n): the ray leaves between v1 and v3 or between
//       \   O /                  v3 and v2: that is the new portal
//        \  | /
//          v3                    stop when v3 lies no farther out than the portal
//
// The origin is inside when it lies on v0's side of a portal, and outside when a support plane has it on its far side.
// The depth is the support along the last portal's normal: moving that far along it separates the bodies, but another way may be
// shorter, so it is an upper bound only. The lower bound is the origin's distance from the boundary of the hull of v0 and the portal.
// MPR knows no distance of separated bodies, and nothing of a difference without volume. Deviations: bounds, one plane test for all supports, ends where precision ends.
#pragma once

#include <cmath>
#include <limits>

#include "algo/orientation.h"
#include "algo/signed_volumes.h"
#include "algo/simplex.h"
#include "algo/trace.h"

namespace gjkdbg {

template <int D, class S>
struct MprOptions {
  S tolerance = S(1e-12);  ///< relative advance of the support beyond the portal at which the loop ends
  int max_iterations = 512;
  bool depth = true;       ///< false: ends as soon as yes or no is known
  Vector<D, S> interior = Vector<D, S>::Zero();  ///< a point inside the difference
};

template <int D, class S>
struct MprResult {
  MprStatus status = MprStatus::converged;
  int iterations = 0;
  Vector<D, S> normal = Vector<D, S>::Zero();  ///< unit, from body 0 towards body 1
  S depth = 0;                                 ///< of the bodies along `normal`; negative when separated
  S lower_bound = 0, upper_bound = 0;          ///< of the bodies' depth; valid when `decided`, unless separated or flat
  Vector<D, S> point_a = Vector<D, S>::Zero(), point_b = Vector<D, S>::Zero();  ///< where the ray leaves the portal
  Vector<D, S> way_a = Vector<D, S>::Zero(), way_b = Vector<D, S>::Zero();  ///< valid as the bounds are, with MprOptions::depth: points of the portal with a - b nearest to depth * normal …
  S off = 0;                                                                ///< … and how far it is from it: 0 where they lie on the way out
  bool decided = true;                         ///< false: no plane that separates, and no portal with the origin on its inner side
  bool overlapping() const { return status != MprStatus::separated; }  ///< if decided
};

template <class Difference, class Trace>
class Mpr {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;

 public:
  /// `difference` answers with points of the bodies themselves, radii included (InflatedDifference).
  Mpr(Difference& difference, const MprOptions<D, S>& options, Trace& trace)
      : difference_(difference), options_(options), trace_(trace), floor_(difference.rounding_floor()), v0_(options.interior) {}

  MprResult<D, S> run() {
    trace_(MprBegan<V, Viewed>{v0_});
    // Centres that coincide leave the ray without a direction: any will do.
    if (!(v0_.norm() > floor_)) v0_ = -(floor_ > 0 ? 4 * floor_ : S(1)) * V::Unit(0);
    return finish(search() ? refine() : status_);
  }

 private:
  // --- The search for a first portal ---------------------------------------------------------------------------------

  /// Finds vertices that the ray passes between. False when the answer is known without them (status_).
  bool search() {
    if (!query(V(-v0_), portal_[0])) return false;
    if constexpr (D == 1) return true;
    if constexpr (D == 2) return search_segment();
    if constexpr (D == 3) return search_triangle();
  }

  /// The side of the ray on which x lies: the sign of det(-v0, x - v0).
  S side(const V& x) const requires(D == 2) { return v0_[1] * x[0] - v0_[0] * x[1]; }

  bool search_segment() requires(D == 2) {
    while (true) {
      const V along = w(0) - v0_;
      V across(-along[1], along[0]);
      if (across.dot(v0_) > 0) across = -across;
      if (side(w(0)) == 0) return on_the_ray();
      if (!query(across, portal_[1])) return false;
      if (side(w(0)) * side(w(1)) <= 0) return true;
      if (w(1) == w(0)) return flat();
      portal_[0] = portal_[1];
    }
  }

  bool search_triangle() requires(D == 3) {
    V d = w(0).cross(v0_);
    if (!(d.norm() > floor_ * v0_.norm())) return on_the_ray();
    if (!query(d, portal_[1])) return false;
    d = (w(0) - v0_).cross(w(1) - v0_);
    if (d.dot(v0_) > 0) std::swap(portal_[0], portal_[1]), d = -d;
    while (true) {
      if (!(d.squaredNorm() > 0)) return flat();
      if (!query(d, portal_[2])) return false;
      // With the first two the plane d of v0 faces the origin; the third must close the other two sides.
      if (w(0).cross(w(2)).dot(v0_) < 0) {
        portal_[1] = portal_[2];
      } else if (w(2).cross(w(1)).dot(v0_) < 0) {
        portal_[0] = portal_[2];
      } else {
        return true;
      }
      d = (w(0) - v0_).cross(w(1) - v0_);
    }
  }

  /// The first support lies on the ray itself, beyond the origin: its plane across the ray is a way out.
  bool on_the_ray() {
    status_ = options_.depth ? MprStatus::converged : MprStatus::overlapping;
    portal_size_ = 1;
    lower_ = 0;
    return false;
  }

  /// No room to look from: the inner point is not inside.
  bool flat() {
    status_ = MprStatus::flat;
    return false;
  }

  // --- The portal moves outwards ---------------------------------------------------------------------------------------

  MprStatus refine() {
    portal_size_ = D;
    bool inside = false;
    while (true) {
      const V n = portal_normal();
      if (!(n.dot(w(0) - v0_) > floor_) || in_a_line()) return MprStatus::flat;
      const S distance = n.dot(w(0));
      if (distance >= -floor_ && plane_is_noise() && !hull_holds_origin()) return give_up();
      if (distance >= -floor_) inside = true, lower_ = std::max(lower_, clearance(n, distance));
      trace_portal(n, distance);
      if (inside && !options_.depth) return MprStatus::overlapping;
      if (result_.iterations >= options_.max_iterations) return inside ? MprStatus::iteration_limit : give_up();
      Point next;
      if (!query(n, next)) return MprStatus::separated;
      const S height = n.dot(next.w);
      if (height - distance <= options_.tolerance * std::abs(height) + floor_) {
        if (!inside) lower_ = -reach_of_portal();
        return MprStatus::converged;
      }
      if (in_portal(next.w) || on_the_spot(n)) return inside ? MprStatus::stalled : give_up();
      replace(next);
    }
  }

  /// The ray leaves through the portal at v0 + t (O - v0), t = n . (w - v0) / n . (O - v0), and t must grow. Where the ray meets an edge
  /// of the portal it may stay for a step or two; longer, the sides are told apart by rounding alone.
  bool on_the_spot(const V& n) {
    const S leaves = n.dot(w(0) - v0_) / -n.dot(v0_);
    steps_on_the_spot_ = leaves > leaves_ ? 0 : steps_on_the_spot_ + 1;
    leaves_ = std::max(leaves_, leaves);
    return steps_on_the_spot_ > 8;
  }

  /// How far from the origin a point of A - B lies.
  S reach_of_portal() const {
    std::array<V, D> corners;
    for (int i = 0; i < D; ++i) corners[i] = w(i);
    const ClosestFeature<D, S> nearest = SignedVolumes<D, S>::closest(corners.data(), D);
    V point = V::Zero();
    for (int i = 0; i < nearest.count; ++i) point += nearest.weight[i] * corners[nearest.index[i]];
    return point.norm();
  }

  /// Neither inside nor outside was proven: the depth cannot be told from zero.
  MprStatus give_up() {
    lower_ = 0, unproven_ = true;
    return result_.iterations >= options_.max_iterations ? MprStatus::iteration_limit : MprStatus::stalled;
  }

  V portal_normal() const {
    V n;
    if constexpr (D == 1) n = V::Ones();
    if constexpr (D == 2) n = V(w(1)[1] - w(0)[1], w(0)[0] - w(1)[0]);
    if constexpr (D == 3) n = (w(1) - w(0)).cross(w(2) - w(0));
    if (n.dot(w(0) - v0_) < 0) n = -n;
    return n.stableNormalized();
  }

  /// Three vertices whose plane is rounding's.
  bool in_a_line() const {
    if constexpr (D == 3) {
      const V p = w(1) - w(0), q = w(2) - w(0);
      return !(p.cross(q).norm() > floor_ * std::max(p.norm(), q.norm()));
    }
    return false;
  }

  /// A sliver's, by far more than supports round.
  bool plane_is_noise() const {
    if constexpr (D == 3) return plane_noise(w(1), w(2), w(0)) > 1000 * floor_;
    return false;
  }
  /// The normal of a plane through three points is off by 9 u over the sine between two sides, a line's by 2 u over its part of how far its points are; the plane by that times how far they are.
  static S plane_noise(const V& x, const V& y, const V& corner) {
    const V p = x - corner, q = y - corner;
    const S far = std::max({x.norm(), y.norm(), corner.norm()}), off = 16 * std::numeric_limits<S>::epsilon() * far;
    if constexpr (D == 3) return off * (p.norm() * q.norm()) / p.cross(q).norm();
    return off * far / p.norm();
  }

  /// Whether the origin lies in the hull of v0 and the portal, by signs that are sure: on no face's outer side.
  bool hull_holds_origin() const {
    if constexpr (D == 3) {
      const std::array<V, 4> v{v0_, w(0), w(1), w(2)};
      for (int i = 0; i < 4; ++i) {
        const V &x = v[(i + 1) % 4], &y = v[(i + 2) % 4], &z = v[(i + 3) % 4];
        const int opposite = orientation<S>(x, y, z, v[i]), origin = orientation<S>(x, y, z, V(V::Zero()));
        if (opposite == 0 || origin == -opposite) return false;
      }
    }
    return true;
  }

  /// The ray leaves between the new vertex and all of the portal but one: that one goes.
  void replace(const Point& next) {
    if constexpr (D == 1) {
      portal_[0] = next;
    } else if constexpr (D == 2) {
      portal_[side(next.w) * side(w(0)) > 0 ? 0 : 1] = next;
    } else {
      const V plane = next.w.cross(v0_);
      if (w(0).dot(plane) > 0) {
        portal_[w(1).dot(plane) > 0 ? 0 : 2] = next;
      } else {
        portal_[w(2).dot(plane) > 0 ? 1 : 0] = next;
      }
    }
  }

  bool in_portal(const V& x) const {
    for (int i = 0; i < portal_size_; ++i)
      if (w(i) == x) return true;
    return false;
  }

  /// The origin's distance from the boundary of the hull of v0 and the portal, which lies inside the difference: the depth is no less.
  /// What the planes may be off by is taken off. Where nothing is left of the portal's, the origin may lie beyond, no farther than the portal is; of a side's,
  /// the ray passes it all the same.
  S clearance(const V& normal, S distance) const {
    S least = distance;
    if constexpr (D == 2) least -= plane_noise(w(1), w(1), w(0));
    if constexpr (D == 3) least -= plane_noise(w(1), w(2), w(0));
    const bool beyond = !(least > 0);
    if constexpr (D > 1) {
      for (int i = 0; i < D; ++i) {
        const V &p = w((i + 1) % D), &q = w((i + 2) % D);
        V n;
        if constexpr (D == 2) n = V(p[1] - v0_[1], v0_[0] - p[0]);
        if constexpr (D == 3) n = (p - v0_).cross(q - v0_);
        if (n.dot(w(i) - v0_) > 0) n = -n;  // away from the vertex opposite
        if (!(n.squaredNorm() > 0)) return beyond ? -reach_of_portal() : S(0);
        least = std::min(least, S(n.stableNormalized().dot(v0_)) - plane_noise(p, q, v0_));
      }
    }
    if (beyond) return -reach_of_portal();
    return normal.allFinite() && least > 0 ? least : S(0);
  }

  // --- Supports, planes, the end -----------------------------------------------------------------------------------------

  const V& w(int i) const { return portal_[i].w; }

  /// Asks for the support along d. The plane there bounds the depth; false when it leaves the origin outside.
  bool query(const V& d, Point& point) {
    const V n = d.stableNormalized();
    point = difference_.support(n);
    ++result_.iterations;
    if constexpr (traced<Trace>)
      trace_(SupportQueried<V, Viewed>{result_.iterations, Phase::mpr, n, point.vertex, point.a, point.b, point.w});
    const S height = n.dot(point.w);
    if (height < upper_) upper_ = height, result_.normal = n;
    if (height >= -floor_) {
      if (portal_size_ == D || result_.iterations <= options_.max_iterations) return true;
      status_ = MprStatus::iteration_limit;
      return false;
    }
    status_ = MprStatus::separated;
    return false;
  }

  void trace_portal(const V& n, S distance) {
    if constexpr (traced<Trace>) {
      std::array<int, D> vertices;
      for (int i = 0; i < D; ++i) vertices[i] = portal_[i].vertex;
      trace_(PortalFound<V, Viewed>{result_.iterations, vertices, n, static_cast<double>(distance), static_cast<double>(-(upper_ + floor_)),
                                    std::isfinite(lower_) ? static_cast<double>(2 * floor_ - lower_) : std::numeric_limits<double>::quiet_NaN()});
    }
  }

  MprResult<D, S> finish(MprStatus status) {
    result_.status = status;
    result_.decided = status != MprStatus::flat && !unproven_ && (status != MprStatus::iteration_limit || portal_size_ == D);
    result_.depth = upper_ == 0 ? S(0) : upper_;
    result_.lower_bound = (std::isfinite(lower_) ? lower_ : S(0)) - 2 * floor_;  // what is taken for the inner side may be beyond by a floor
    result_.upper_bound = upper_ + floor_;
    leave_at_the_portal();
    if (options_.depth && result_.overlapping() && status != MprStatus::flat) lie_on_the_way_out();
    trace_(MprEnded<V, Viewed>{result_.iterations, status, result_.normal, static_cast<double>(result_.depth)});
    return result_;
  }

  /// The ray meets the portal at a combination of its vertices: weight i is the volume of v0, O and the others.
  void leave_at_the_portal() {
    std::array<S, D> weights{};
    S sum = 0;
    for (int i = 0; i < portal_size_; ++i) {
      S weight = 1;
      if constexpr (D == 2)
        if (portal_size_ == 2) weight = std::abs(side(w(1 - i)));
      if constexpr (D == 3)
        if (portal_size_ == 3) weight = std::abs(v0_.dot(w((i + 1) % 3).cross(w((i + 2) % 3))));
      weights[i] = weight, sum += weight;
    }
    for (int i = 0; i < portal_size_; ++i) {
      const S share = sum > 0 ? weights[i] / sum : S(1) / static_cast<S>(portal_size_);
      result_.point_a += share * portal_[i].a;
      result_.point_b += share * portal_[i].b;
    }
  }

  void lie_on_the_way_out() {
    const V out = result_.normal * result_.depth;
    std::array<V, D + 1> from_out;
    for (int i = 0; i < portal_size_; ++i) from_out[i] = w(i) - out;
    const ClosestFeature<D, S> nearest = SignedVolumes<D, S>::closest(from_out.data(), portal_size_);
    for (int i = 0; i < nearest.count; ++i) {
      result_.way_a += nearest.weight[i] * portal_[nearest.index[i]].a;
      result_.way_b += nearest.weight[i] * portal_[nearest.index[i]].b;
    }
    result_.off = std::sqrt(nearest.v_squared);
  }

  Difference& difference_;
  const MprOptions<D, S>& options_;
  Trace& trace_;
  const S floor_;
  V v0_;
  std::array<Point, D> portal_{};
  int portal_size_ = 1;
  bool unproven_ = false;  ///< the search has ended before it was known on which side of the portal the origin lies
  MprStatus status_ = MprStatus::separated;
  MprResult<D, S> result_;
  S leaves_ = 0;
  int steps_on_the_spot_ = 0;
  S upper_ = std::numeric_limits<S>::infinity(), lower_ = -std::numeric_limits<S>::infinity();
};

/// Runs MPR on a difference of bodies. Frame of body 0.
template <class Difference, class Trace>
auto mpr(Difference& difference, const MprOptions<Difference::D, typename Difference::S>& options, Trace& trace) {
  return Mpr<Difference, Trace>(difference, options, trace).run();
}

}  // namespace gjkdbg
