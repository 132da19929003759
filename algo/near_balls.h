// How deep ellipsoids are in each other, or in a ball, that are nearly balls themselves; in the plane ellipses that are nearly circles.
//
// From within two concentric balls every way out is as short. Out of what is nearly a ball many ways are nearly as short, and EPA would have to put faces everywhere: where the boundary bends with
// radius R, a face of width s leaves R s^2 / 8 open. But what bends with radius rho at least is the sum of a ball of radius rho, which rolls within it, and of a convex rest (Blaschke's rolling
// theorem; Schneider, Convex Bodies: The Brunn-Minkowski Theory, section 3.2). An ellipsoid bends most at the ends of its longest axis, in the plane of its shortest: rho = shortest^2 / longest.
// A - B is then the sum of a ball of radius rho = rho_A + rho_B and of the rests' difference, its heights are
//
//   h(n) = rho + h_rest(n),   and the depth is   rho + e where O lies in the rests' difference, e deep
//                                                rho - v where it lies outside, v away
//
// The ball counts exactly. The rests are small, as far as the bodies are like balls, and of them not all ways are nearly as short, so GJK and EPA are asked about these: a support of theirs is
// the bodies' own along the same unit n, less rho n, and every one is an axis with its height. Where the rests are more than half of the bodies there is nothing to gain. Where they are those of
// spheroids, but for little, EPA gives up on them as well: then all their directions are divided (algo/ellipsoid_depth.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "algo/ellipsoid_depth.h"
#include "algo/epa.h"
#include "algo/gjk.h"
#include "algo/lent.h"
#include "algo/rolling_balls.h"
#include "algo/sat.h"

namespace gjkdbg {

/// Knows nothing of a trace, so that GJK and EPA on the rests are compiled once: who wants to see an axis is called.
template <class Difference_>
class NearBalls {
  using Difference = Difference_;
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;
  static constexpr S unknown = std::numeric_limits<S>::quiet_NaN();

  /// The rests' difference as GJK and EPA see it. Each of its supports is an axis.
  class Rests {
   public:
    static constexpr int D = Difference::D;
    using S = typename Difference::S;
    using V = Vector<D, S>;
    using Point = SupportPoint<D, S>;

    explicit Rests(NearBalls& of) : of_(of) {}
    Point support(const V& d) {
      const V n = d.stableNormalized();
      Point point = of_.look_along(n);
      point.a -= of_.balls_.a * n, point.b += of_.balls_.b * n, point.w = point.a - point.b;
      return point;
    }
    /// What is open, or off, by less than this is nothing beside the depth, and need not be known.
    S rounding_floor() const { return of_.enough_; }
    SupportDerivative<D, S> support_derivative(const V& d, const Point& point) const { return of_.difference_.support_derivative(d, point); }
    const auto& a() const { return of_.difference_.a(); }
    const auto& b() const { return of_.difference_.b(); }
    V center() const { return of_.difference_.center(); }
    S radius() const { return 0; }
    bool polytope() const { return false; }
    int vertices() const { return 0; }

   private:
    NearBalls& of_;
  };

  /// EPA's nearest face says what no height is below.
  struct Watch : NoTrace {
    NearBalls& of;
    explicit Watch(NearBalls& x) : of(x) {}
    using NoTrace::operator();
    void operator()(const FaceChosen<V, Viewed>& e) const { of.least_ = of.rho_ + e.distance - of.enough_; }
  };

 public:
  /// Keeps the references. `tolerance`: of the depth, relative.
  NearBalls(Difference& difference, const RollingBalls<S>& balls, S tolerance, AxisLook<D, S> look)
      : difference_(difference), balls_(balls), rho_(balls.a + balls.b), tolerance_(tolerance), floor_(difference.rounding_floor()), enough_(std::max(floor_, tolerance * rho_ / 8)), look_(std::move(look)) {}

  /// `overlapping` where the depth is known: within rounding, or the tolerance. `undecided` with the least height that was found.
  OutlineDepth<D, S> run(int most) {
    Rests rests(*this);
    GjkOptions<D, S> from_b;
    from_b.tolerance = tolerance_, from_b.max_iterations = most, from_b.direction = difference_.towards_b();
    GjkResult<D, S> nearest;
    NoTrace silent;
    gjk<SignedVolumes<D, S>>(rests, from_b, silent, nearest);
    if (nearest.cores_overlap()) inside(rests, nearest.simplex, most);
    else outside(nearest);
    const S height = normal_.dot(look_along(normal_).w);  // the last axis is the answer's
    SatResult<D, S> found{SatStatus::undecided, looked_, normal_, height};
    const bool known = height - least_ <= std::max(4 * floor_, tolerance_ * height);
    if (height < -floor_) found.status = SatStatus::separated;
    else if (known && height > floor_) found.status = SatStatus::overlapping;
    else found.normal = lowest_along_, found.depth = lowest_;
    return {found, SatWitnesses<D, S>{V(point_a_ + balls_.a * normal_), V(point_b_ - balls_.b * normal_)}, std::max(S(0), height - least_)};
  }

 private:
  /// O lies in the rests' difference, or within `enough_` of it.
  void inside(Rests& rests, const Simplex<D, S>& simplex, int most) {
    EpaOptions<S> options;
    options.tolerance = tolerance_, options.max_iterations = most;
    Lent<EpaWorkspace<D, S>> workspace;
    Watch watch(*this);
    const EpaResult<D, S> found = epa(rests, simplex, options, *workspace, watch);
    const bool flat = found.face < 0;
    Simplex<D, S> weighed = simplex;
    if (flat && weighed.size() == D + 1) weigh_enclosing(weighed);
    point_a_ = flat ? weighed.point_a() : found.point_a, point_b_ = flat ? weighed.point_b() : found.point_b;
    normal_ = found.normal, least_ = rho_ + found.lower_bound;
  }
  void outside(const GjkResult<D, S>& nearest) {
    point_a_ = nearest.simplex.point_a(), point_b_ = nearest.simplex.point_b();
    normal_ = -nearest.v / nearest.distance, least_ = rho_ - nearest.upper_bound;
  }

  Point look_along(const V& n) {
    const Point point = difference_.support(n);
    ++looked_;
    if (const S height = n.dot(point.w); height < lowest_) lowest_ = height, lowest_along_ = n;
    if (look_) look_(looked_, n, point, lowest_, least_);
    return point;
  }

  Difference& difference_;
  const RollingBalls<S> balls_;
  const S rho_, tolerance_, floor_, enough_;
  const AxisLook<D, S> look_;
  int looked_ = 0;
  S lowest_ = std::numeric_limits<S>::infinity();  ///< of the heights
  S least_ = unknown;                              ///< that a height is, as far as is known
  V lowest_along_ = V::Zero(), normal_ = V::Zero();
  V point_a_ = V::Zero(), point_b_ = V::Zero();  ///< of the rests
};

/// Unset where the bodies are nothing like balls: see RollingBalls. `most`: iterations of GJK, and of EPA.
template <class Difference, class Trace>
std::optional<OutlineDepth<Difference::D, typename Difference::S>> near_balls(Difference& difference, typename Difference::S tolerance, int most, Trace& trace) {
  constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  if constexpr (D > 1 && requires { difference.a().core(), difference.b().core(); }) {
    const auto balls = RollingBalls<S>::of(difference);
    if (!balls) return std::nullopt;
    const double radius = static_cast<double>(difference.radius());
    if constexpr (traced<Trace>) trace(SatBegan<V, Viewed>{0, 0, 0});
    OutlineDepth<D, S> found = NearBalls<Difference>(difference, *balls, tolerance, outline_look(difference, trace)).run(most);
    go_on_by_bends(difference, BentPair<D, S>::of(difference), found, tolerance, most, trace);
    if constexpr (traced<Trace>) trace(SatEnded<V, Viewed>{found.sat.iterations, found.sat.status, found.sat.normal, -static_cast<double>(found.sat.depth) - radius});
    return found;
  }
  return std::nullopt;
}

}  // namespace gjkdbg
