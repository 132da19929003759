// Search directions of GJK other than -v: with momentum, or Newton's.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/gjk_options.h"
#include "algo/newton_direction.h"
#include "shapes/triple.h"

namespace gjkdbg {

/// What is known when a direction is asked for.
template <class S>
struct GjkProgress {
  int iterations;
  Triple<S> v;
  S v_squared, distance, plane;  ///< |v|^2, |v|, the farthest plane met
};

/// None at all, where they are not wanted.
template <class Difference, bool leads>
class LeadingDirection {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;

 public:
  LeadingDirection(const Difference&, const GjkOptions<D, S>&) {}
  static constexpr bool by_newton() { return false; }
};

template <class Difference>
class LeadingDirection<Difference, true> {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Point = typename Difference::Point;
  using Progress = GjkProgress<S>;

 public:
  LeadingDirection(const Difference& difference, const GjkOptions<D, S>& options) : options_(options), newton_(difference), floor_(difference.rounding_floor()) {}

  void begin(const V& d, S length, const Point& point) { last_ = point.w, momentum_ = -d / length * point.w.norm(); }
  void keep(const V& v) { last_ = momentum_ = v; }
  /// The support along d, which is `length` long.
  void take(const V& d, S length, const Point& point) {
    if (by_newton()) newton_.take(d, length, point);
  }
  /// It has been found worth adding.
  void met(const Point& point) { last_ = point.w; }
  /// The support along the last direction brought nothing.
  void in_vain() { accelerating_ = false, ++asked_in_vain_; }

  bool by_newton() const { return options_.acceleration == Acceleration::newton; }

  /// A direction other than -v, and its length; false: none is wanted.
  [[gnu::noinline]] bool next(Triple<S>& direction, S& length, const Progress& at) {
    V d;
    if (!found(d, length, at)) return false;
    direction = Triple<S>::of(d);
    return true;
  }

 private:
  bool found(V& d, S& length, const Progress& at) {
    if (by_newton()) return !options_.normalised && asked_in_vain_ < 3 && newton(d, length, at);
    if (!accelerating_) return false;
    d = options_.acceleration == Acceleration::polyak ? polyak(at) : nesterov(at), length = d.norm();
    return true;
  }

  /// Montaut et al. 2024, algorithm 3: with m = (k + 1) / (k + 3), y = m v + (1 - m) s (s the last support), the direction moves to
  /// m d + (1 - m) y. For polytopes v and d enter with length 1, or the momentum of the far start outlives its use.
  V nesterov(const Progress& at) {
    const S m = static_cast<S>(at.iterations + 1) / static_cast<S>(at.iterations + 3);
    const V v = at.v.template vector<D>(), y = options_.normalised ? V(m * v / at.distance + (1 - m) * momentum_.stableNormalized()) : V(m * v + (1 - m) * last_);
    momentum_ = m * momentum_ + (1 - m) * y;
    return moved(v);
  }
  /// Heavy ball: m = 1 / (k + 1), the direction moves to m d + (1 - m) v. (The paper prints Nesterov's m; this is the one of its program,
  /// and the one whose figures it shows.)
  V polyak(const Progress& at) {
    const S m = S(1) / static_cast<S>(at.iterations + 1);
    const V v = at.v.template vector<D>();
    momentum_ = m * momentum_ + (1 - m) * v;
    return moved(v);
  }
  V moved(const V& v) {
    if (momentum_.isZero(0)) accelerating_ = false, momentum_ = v;
    return -momentum_;
  }

  /// Newton's direction; not where the last one left more than a quarter of the gap open, nor where the bounds meet or -v is as good, for in the end the
  /// plane across v is wanted (see Gjk). Before any plane is known as far out as a quarter of |v|, that is taken for the distance.
  bool newton(V& d, S& length, const Progress& at) {
    const S gap = at.distance - at.plane;
    const bool misled = std::exchange(newton_led_, false) && gap > gap_ / 4;
    gap_ = gap;
    if (misled || gap <= options_.tolerance * at.distance + floor_ || !std::isfinite(gap)) return false;  // infinite: nothing was asked yet
    const auto step = newton_.next(std::max(at.plane, at.distance / 4));
    const S towards = -Triple<S>::of(step.x).dot(at.v);
    if (step.on_ridge && !(step.plane - at.plane >= S(0.03) * gap)) return false;  // there already: what the simplex lacks is a vertex of the other side
    if (!(towards > 0 && towards * towards < (1 - options_.tolerance / 2) * step.length * step.length * at.v_squared)) return false;
    d = step.x, length = step.length;
    return newton_led_ = true;
  }

  const GjkOptions<D, S>& options_;
  NewtonDirection<Difference> newton_;
  const S floor_;
  bool accelerating_ = true;  ///< the momentum still helps
  int asked_in_vain_ = 0;     ///< supports of directions that lead, which brought nothing: on a face of a body the model of two pieces never comes right
  bool newton_led_ = false;   ///< the last direction was Newton's
  S gap_ = 0;                 ///< of the bounds, before it
  V momentum_, last_;
};

}  // namespace gjkdbg
