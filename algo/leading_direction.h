// Search directions of GJK other than -v: with momentum, Newton's, or smoothed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Few at most: -v, and where that is wanted (Acceleration::smoothed) a mean of -v and of the best plane's direction in the first steps.
///
/// GJK is column generation: the simplex is the restricted master problem, -v its dual prices, support the pricing problem, and every plane a dual bound. Prices of
/// a simplex of one or two vertices swing: -w of a single corner w points off to the side, the more so the nearer the bodies are, and asks for a corner the nearest face rarely
/// has. The remedy there is to ask between the prices and those of the best bound so far (Wentges 1997, "Weighted Dantzig-Wolfe decomposition for
/// linear mixed-integer programming"). Here, with c = plane / |v| the cosine of the angle that -v and the normal sought can lie apart
/// (v*.v >= |v*|^2 for the nearest point v*, and |v*| is no less than the plane):
///
///   c near 1    -v is right, for w is the nearest vertex already: where the angle is less than that of neighbours among N vertices spread over a sphere,
///               sqrt(4 pi / N), or c more than 1 - 2 pi / N; pairs of 8 to 100 vertices say 1 - 4 / N
///   c below 0   no plane separates the bodies yet; where that is far from it they are deep, and -v encloses the origin as soon
///
/// Supports of 300 random pairs (debugger/lab/families.h), plain and smoothed, 0.001 to 0.1 apart, half apart, and (yes or no) 0.05 deep, of boxes 0.02:
///
///   boxes                  5.7  5.0    4.9  4.6    5.3  4.6
///   hulls of 32 vertices   7.9  6.0    5.1  4.6    5.3  4.3
///   hulls of 100           9.1  6.6    5.5  4.8    5.4  4.2
///   hulls of 1,000        11.4  7.9    5.4  4.8    4.4  4.0
///
/// The best direction weighs |x| + |y| + |z| of v, twice: |v| is a root, which the next support would wait for (0.97 of the time of hulls), and takes as many.
/// One step instead of two takes up to 0.8 more; three, and 1.5 or 3 times, up to 0.3 more in some rows and less in others.
/// Round shapes near each other or a hull ask for 0.85 to 0.95 as many.
template <class Difference, bool leads>
class LeadingDirection {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using T = Triple<S>;

 public:
  LeadingDirection(const Difference& difference, const GjkOptions<D, S>& options) : left_(options.accelerated && options.kept.empty() ? steps : 0) {
    if (left_ > 0) near_ = 1 - S(8) / (vertices(difference.a()) + vertices(difference.b()));
  }
  static constexpr bool by_newton() { return false; }

  /// What the support along d, which is `length` long, shows to lie beyond the plane across it.
  [[gnu::always_inline]] void take(const T& d, S length, S plane) {
    if (left_ == 0 || !(plane > best_)) return;
    best_ = plane, towards_best_ = d * (share / length);
  }
  void in_vain() {}

  [[gnu::always_inline]] bool next(T& direction, S& length, const GjkProgress<S>& at) {
    if (left_ == 0) return false;
    if (!(best_ > far * at.distance && best_ < near_ * at.distance)) return left_ = 0, false;
    --left_;
    direction = towards_best_ * at.v.taxicab() - at.v;
    length = std::sqrt(direction.dot(direction));
    return true;
  }

 private:
  static constexpr int steps = 2;
  static constexpr S share = S(2), far = S(-0.6);
  template <class Body>
  static S vertices(const Body& body) { return body.vertices() > 0 ? S(body.vertices()) : std::numeric_limits<S>::infinity(); }

  int left_;  ///< steps
  S near_ = 0, best_ = -std::numeric_limits<S>::infinity();
  T towards_best_{0, 0, 0};  ///< `share` long
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
    constexpr int longest = 64;  // longer it circles about the answer of long bodies beside short ones, which -v comes to
    if (!accelerating_ || at.iterations > longest) return false;
    d = options_.acceleration == Acceleration::polyak ? polyak(at) : nesterov(at), length = d.norm();
    return true;
  }

  /// Montaut et al. 2024, algorithm 3: with m = (k + 1) / (k + 3), y = m v + (1 - m) s (s the last support), the direction moves to
  /// m d + (1 - m) y. For polytopes y = m v / |v| + (1 - m) d / |d|: lengths of 1, or the momentum of the far start outlives its use, and, unlike the
  /// paper's, the last direction in the place of s.
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
