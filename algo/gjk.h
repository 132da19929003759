// GJK, distance form: how far the difference A - B is from the origin.
//
// Gilbert, Johnson, Keerthi 1988; stopping rule and monotone loop after van den Bergen 1999, with the bounds as in
// Montaut et al. 2024 ("GJK++"), section III. One loop:
//   v = closest point of the simplex to the origin       |v| is an upper bound of the distance
//   w = support(-v)                                      v.w / |v| is a lower one: all of A - B lies beyond that plane
//   stop when the bounds meet; else add w, cut the simplex down to the feature nearest the origin
// Deviations: |v| must fall in every step; where it does not, the simplex is judged again in twice the precision and,
// if that does not help, the loop ends as `stalled` with honest bounds. Bounds include the rounding floor.
// Directions may carry Nesterov's momentum (Montaut et al., section IV): fewer steps where curvature is small; or be Newton's (algo/newton_direction.h).
// The sub-algorithm is a policy: ClosestFeature<D, S> closest(const V* w, int size). One that has a `Grown` (algo/grown_simplex.h) is asked that first.
#pragma once

#include <limits>
#include <new>
#include <span>
#include <utility>

#include "algo/newton_direction.h"
#include "algo/settings.h"
#include "algo/signed_volumes.h"
#include "algo/simplex.h"
#include "algo/trace.h"

namespace gjkdbg {

/// What the caller needs to know; the loop ends as soon as it is known.
enum class GjkGoal {
  intersect,       ///< whether the bodies overlap: ends at the first proof
  distance,        ///< the distance, or that the bodies overlap
  signed_distance  ///< the distance of the cores, however the radii compare with it
};

template <int D, class S>
struct GjkOptions {
  GjkGoal goal = GjkGoal::signed_distance;
  static constexpr S decisive = std::is_same_v<S, double> ? S(1e-10) : S(1e-4);  ///< the gap at which bodies that may or may not touch are told apart, however coarse `tolerance` is
  S tolerance = S(1e-12);  ///< relative gap of the bounds at which the loop ends
  int max_iterations = 512;
  Vector<D, S> direction = Vector<D, S>::Unit(0);  ///< first search direction, not zero
  bool accelerated = false;  ///< directions other than -v, until they no longer help
  bool normalised = false;   ///< both bodies are polytopes: momentum is of unit vectors (Montaut et al. 2024), and Newton's directions are not tried
  Acceleration acceleration = Acceleration::nesterov;
  Stopping stopping = Stopping::bounds;
  std::span<const SupportPoint<D, S>> kept{};  ///< the simplex to begin with instead of the direction's support; at most D + 1
};

template <int D, class S>
struct GjkResult {
  GjkStatus status = GjkStatus::converged;
  int iterations = 0;
  /// The feature nearest the origin, with weights; when enclosed all D + 1 vertices, with the origin's weights unless the signed distance was
  /// asked for: whoever goes on from there has no use for them, but where rounding ends that (`weigh_enclosing`).
  Simplex<D, S> simplex;
  Vector<D, S> v = Vector<D, S>::Zero();   ///< closest point of the cores' difference (zero when enclosed)
  S distance = 0;                          ///< |v|
  S lower_bound = -std::numeric_limits<S>::infinity();  ///< of the signed distance of the cores
  S upper_bound = std::numeric_limits<S>::infinity();

  bool cores_overlap() const { return status == GjkStatus::enclosed || status == GjkStatus::touching; }
};

template <class Difference, class SubAlgorithm, class Trace>
class Gjk {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;
  using Feature = ClosestFeature<D, S>;

 public:
  Gjk(Difference& difference, const GjkOptions<D, S>& options, Trace& trace, GjkResult<D, S>& result)
      : difference_(difference), options_(options), trace_(trace), floor_(difference.rounding_floor()), result_(result) {}

  void run() {
    trace_(GjkBegan<V, Viewed>{options_.direction});
    if (options_.kept.empty()) begin(options_.direction, options_.direction.norm());
    else keep();
    while (!ended()) {
      ++result_.iterations;
      S length = result_.distance;
      const bool led = options_.accelerated && lead(towards_, length);
      const Point& point = query(towards_, length);
      if (led) {
        if (options_.goal == GjkGoal::intersect && result_.lower_bound > difference_.radius()) return finish(GjkStatus::separated);
        if (brings_nothing(point)) {
          accelerating_ = false, ++asked_in_vain_, towards_ = -result_.v;
          continue;
        }
      } else if (proven(point)) {
        break;
      }
      if (options_.accelerated) last_ = point.w;
      if (!reduce() && !reduce_again()) {
        result_.simplex.places &= ~(1u << newest_);
        return finish(GjkStatus::stalled);
      }
    }
    finish(status_);
  }

 private:
  template <class Sub>
  static constexpr bool grows = requires { typename Sub::Grown; };

  /// Asks for the support along d and takes its plane for the lower bound: all x of A - B have d.x <= d.w, so the
  /// signed distance is at least -d.w / |d|. The point lies in a place that is free, and stays so unless the simplex grows by it.
  const Point& query(const V& d, S length) {
    newest_ = result_.simplex.free_place();
    const Point& point = *new (&result_.simplex.points[newest_]) Point(difference_.support(d));  // made where it stays
    if constexpr (traced<Trace>)
      trace_(SupportQueried<V, Viewed>{result_.iterations, Phase::gjk, d, point.vertex, point.a, point.b, point.w});
    plane_ = -along(d, point.w) / length;
    result_.lower_bound = std::max(result_.lower_bound, plane_ - floor_);
    if (by_newton()) newton_.take(d, length, point);
    return point;
  }

  /// d . w, d as it is written (see advance_to).
  [[gnu::always_inline]] static S along(const V& d, const V& w) {
    S sum = d[0] * w[0];
    for (int i = 1; i < D; ++i) sum += d[i] * w[i];
    return sum;
  }

  [[gnu::noinline]] void begin(const V& d, S length) {
    const Point& point = query(d, length);
    if (options_.accelerated) last_ = point.w, momentum_ = -d / length * point.w.norm();
    if (!reduce()) result_.simplex.places = 1u << newest_, result_.simplex.weights[newest_] = 1;  // no number: a simplex has a vertex all the same
  }

  void keep() {
    for (const Point& point : options_.kept) {
      trace_(VertexKept<V, Viewed>{point.vertex, point.a, point.b, point.w});
      result_.simplex.add(point);
    }
    accept(of_list([](const V* w, int size) { return SubAlgorithm::closest(w, size); }));
    if (options_.accelerated) last_ = momentum_ = result_.v;
  }

  /// Montaut et al. 2024, algorithm 3: with m = (k + 1) / (k + 3), y = m v + (1 - m) s (s the last support), the direction moves to
  /// m d + (1 - m) y. For polytopes v and d enter with length 1, or the momentum of the far start outlives its use.
  V accelerated_direction() {
    if (options_.acceleration == Acceleration::polyak) return polyak_direction();
    const S m = static_cast<S>(result_.iterations + 1) / static_cast<S>(result_.iterations + 3);
    const V y = options_.normalised ? V(m * result_.v / result_.distance + (1 - m) * momentum_.stableNormalized()) : V(m * result_.v + (1 - m) * last_);
    momentum_ = m * momentum_ + (1 - m) * y;
    if (momentum_.isZero(0)) accelerating_ = false, momentum_ = result_.v;
    return -momentum_;
  }

  /// Heavy ball: m = 1 / (k + 1), the direction moves to m d + (1 - m) v. (The paper prints Nesterov's m; this is the one of its program,
  /// and the one whose figures it shows.)
  V polyak_direction() {
    const S m = S(1) / static_cast<S>(result_.iterations + 1);
    momentum_ = m * momentum_ + (1 - m) * result_.v;
    if (momentum_.isZero(0)) accelerating_ = false, momentum_ = result_.v;
    return -momentum_;
  }

  bool by_newton() const { return options_.accelerated && options_.acceleration == Acceleration::newton; }

  /// A direction other than -v, and its length; false: none is wanted. Not in the loop's own code, most of whose runs have no use for it.
  [[gnu::noinline]] bool lead(V& d, S& length) {
    if (by_newton()) return !options_.normalised && asked_in_vain_ < 3 && newton(d, length);
    if (!accelerating_) return false;
    d = accelerated_direction(), length = d.norm();
    return true;
  }

  /// Newton's direction; not where the last one left more than a quarter of the gap open, nor where the bounds meet or -v is as good, for in the end the
  /// plane across v is wanted (see `proven`). Before any plane is known as far out as a quarter of |v|, that is taken for the distance.
  bool newton(V& d, S& length) {
    const S plane = result_.lower_bound + floor_, gap = result_.distance - plane;
    const bool misled = std::exchange(newton_led_, false) && gap > gap_ / 4;
    gap_ = gap;
    if (misled || gap <= options_.tolerance * result_.distance + floor_ || !std::isfinite(gap)) return false;  // infinite: nothing was asked yet
    const auto step = newton_.next(std::max(plane, result_.distance / 4));
    const S towards = -step.x.dot(result_.v);
    if (step.on_ridge && !(step.plane - plane >= S(0.03) * gap)) return false;  // there already: what the simplex lacks is a vertex of the other side
    if (!(towards > 0 && towards * towards < (1 - options_.tolerance / 2) * step.length * step.length * v_squared_)) return false;
    d = step.x, length = step.length;
    return newton_led_ = true;
  }

  /// The Frank-Wolfe gap: a support that is no nearer than v along v adds nothing. From there on the plain direction is right, and momentum over.
  bool brings_nothing(const Point& point) const {
    return !(result_.v.dot(result_.v - point.w) > options_.tolerance * v_squared_) || result_.simplex.holds(point.w);
  }

  /// Takes the newest point and cuts the simplex down to the feature nearest the origin; false when that is no nearer than before (NaN included).
  [[gnu::always_inline]] bool reduce() {
    if constexpr (grows<SubAlgorithm>) {
      const auto nearest = SubAlgorithm::Grown::closest(result_.simplex.points, result_.simplex.places, newest_);
      if (nearest.places != 0) [[likely]] return accept(nearest);
    }
    result_.simplex.places |= 1u << newest_;
    return accept(of_list([](const V* w, int size) { return SubAlgorithm::closest(w, size); }));
  }

  template <class Closest>
  [[gnu::noinline]] Feature of_list(Closest closest) const {
    const auto& simplex = result_.simplex;
    std::array<V, D + 1> w;
    const int size = simplex.size();
    for (int i = 0; i < size; ++i) w[i] = simplex[i].w;
    return closest(w.data(), size);
  }

  /// The second opinion, in twice the precision.
  bool reduce_again() {
    result_.simplex.places |= 1u << newest_;
    return accept(of_list([](const V* w, int size) { return WideClosestPoint<D, S>::of_boundary(w, size); }));
  }

  bool accept(const Feature& feature) {
    if (feature.enclosed && result_.lower_bound > 0) return false;  // a support plane has shown the origin outside: rounding speaks
    if (!feature.enclosed && !falls_to(feature.v, feature.v_squared)) return false;
    if constexpr (traced<Trace>) before_ = vertex_numbers();
    result_.simplex.reduce_to(feature);
    weighed_ = true;
    enclosed_ = feature.enclosed;
    advance_to(feature.v[0], D > 1 ? feature.v[1 % D] : 0, D > 2 ? feature.v[2 % D] : 0, feature.v_squared);
    return true;
  }
  /// Weights are found when somebody wants them.
  template <class Nearest>
  [[gnu::always_inline]] bool accept(const Nearest& nearest) {
    if (nearest.encloses() ? result_.lower_bound > 0 : !(nearest.v_squared < v_squared_) && !falls_to(nearest.v.vector(), nearest.v_squared)) [[unlikely]]
      return false;
    enclosed_ = nearest.encloses();
    if constexpr (traced<Trace>) result_.simplex.places |= 1u << newest_, before_ = vertex_numbers();
    result_.simplex.places = nearest.places;
    grown_by_ = newest_, weighed_ = false;
    advance_to(nearest.v.x, nearest.v.y, nearest.v.z, nearest.v_squared);
    return true;
  }

  /// |v| must fall. Where the plane still turns but |v| falls by less than it rounds (a nearly flat part of A - B met at
  /// a grazing angle), a few steps on the spot are allowed, not twice to the same. Newton's directions bring |v| to its least before that, where |v| is known to a floor only.
  [[gnu::noinline]] bool falls_to(const V& v, S v_squared) {
    if (v_squared < v_squared_) return true;
    const S rounding = by_newton() ? 2 * result_.distance * floor_ : 8 * std::numeric_limits<S>::epsilon() * v_squared_;
    if (v == result_.v || (steps_on_the_spot_ > 0 && v == stepped_to_) || !(v_squared <= v_squared_ + rounding) || ++steps_on_the_spot_ > 8) return false;
    stepped_to_ = v;
    return true;
  }

  /// Number by number: two at once are waited for where one of them was written just before, and -v is what everything waits for.
  [[gnu::always_inline]] void advance_to(S x, S y, S z, S v_squared) {
    towards_[0] = -x, result_.v[0] = x;
    if constexpr (D > 1) towards_[1] = -y, result_.v[1] = y;
    if constexpr (D > 2) towards_[2] = -z, result_.v[2] = z;
    v_squared_ = v_squared;
    result_.distance = std::sqrt(v_squared);
    result_.upper_bound = result_.distance + floor_;
    if constexpr (traced<Trace>) trace_reduction();
  }

  void weigh() {
    if constexpr (grows<SubAlgorithm>)
      if (!weighed_) SubAlgorithm::Grown::weigh(result_.simplex.points, result_.simplex.places, grown_by_, result_.simplex.weights);
    weighed_ = true;
  }

  /// Whether the simplex alone settles the matter.
  bool ended() {
    if (enclosed_) return end_as(GjkStatus::enclosed);
    if (result_.distance <= floor_) return end_as(GjkStatus::touching);
    if (options_.goal != GjkGoal::signed_distance && result_.upper_bound <= difference_.radius())
      return end_as(GjkStatus::within_radius);
    if (result_.iterations >= options_.max_iterations) return end_as(GjkStatus::iteration_limit);
    return false;
  }

  /// Whether the newest support point settles it. The plane must be the one across v itself, not the best one met: then
  /// the normal -v / |v| is certified as well as the distance. A point met before cannot bring anything new.
  bool proven(const Point& point) {
    if (options_.goal == GjkGoal::intersect && result_.lower_bound > difference_.radius())
      return end_as(GjkStatus::separated);
    const S gap = result_.distance - plane_;
    const bool met = gap <= options_.tolerance * result_.distance + floor_ && (gap <= GjkOptions<D, S>::decisive * result_.distance + floor_ || !straddles());
    if (options_.stopping != Stopping::bounds) {
      if (rule_met(point)) return end_as(met ? GjkStatus::converged : GjkStatus::rule_met);
    } else if (met) {
      return end_as(GjkStatus::converged);
    }
    if (result_.simplex.holds(point.w)) return end_as(GjkStatus::stalled);
    return false;
  }

  /// Whether the bounds leave open if the radii reach across the distance. (Without radii a plane that is met at all has the origin outside.)
  bool straddles() const {
    const S radius = difference_.radius();
    return radius > 0 && result_.lower_bound <= radius && result_.upper_bound > radius;
  }

  /// Other libraries' rules, as their sources have them (see Stopping); v.w and |v|^2 are not yet those of the next simplex.
  bool rule_met(const Point& point) {
    constexpr S epsilon = std::numeric_limits<S>::epsilon();
    const S gap = v_squared_ - result_.v.dot(point.w);
    switch (options_.stopping) {
      case Stopping::van_den_bergen: return result_.distance - std::max(S(0), result_.lower_bound + floor_) <= options_.tolerance * result_.distance;
      case Stopping::bullet: return gap <= v_squared_ * (std::is_same_v<S, float> ? S(1e-6) : S(1e-12));
      case Stopping::jolt: {
        const S before = std::exchange(last_squared_, v_squared_);
        return before - v_squared_ <= epsilon * before;
      }
      case Stopping::opengjk: return gap <= S(1e4) * epsilon * v_squared_ || gap < S(1e2) * epsilon || result_.iterations >= 25;
      case Stopping::bounds: break;
    }
    return false;
  }

  bool end_as(GjkStatus status) {
    status_ = status;
    return true;
  }

  void finish(GjkStatus status) {
    if (!enclosed_ || options_.goal != GjkGoal::signed_distance) weigh();
    result_.status = status;
    const double radius = static_cast<double>(difference_.radius());
    trace_(GjkEnded<V, Viewed>{result_.iterations, status, result_.lower_bound - radius, result_.upper_bound - radius});
  }

  struct Numbers {
    std::array<int, D + 1> vertex;
    int size = 0;
    std::span<const int> view() const { return {vertex.data(), static_cast<std::size_t>(size)}; }
  };

  /// Vertex numbers, newest first. `order_` remembers the way there.
  Numbers vertex_numbers() {
    const auto& simplex = result_.simplex;
    Numbers numbers;
    numbers.size = simplex.size();
    const auto newer = [&](int i, int j) { return simplex[i].vertex > simplex[j].vertex; };
    for (int i = 0; i < numbers.size; ++i) {
      order_[i] = i;
      for (int k = i; k > 0 && newer(order_[k], order_[k - 1]); --k) std::swap(order_[k], order_[k - 1]);
    }
    for (int i = 0; i < numbers.size; ++i) numbers.vertex[i] = simplex[order_[i]].vertex;
    return numbers;
  }

  void trace_reduction() {
    weigh();
    const Numbers region = vertex_numbers();
    std::array<double, D + 1> weights{};
    for (int i = 0; i < region.size; ++i) weights[i] = static_cast<double>(result_.simplex.weight(order_[i]));
    const double radius = static_cast<double>(difference_.radius());
    trace_(SimplexReduced<V, Viewed>{result_.iterations, before_.view(), region.view(),
                                     std::span<const double>(weights.data(), region.size), result_.v,
                                     result_.lower_bound - radius, result_.upper_bound - radius});
  }

  Difference& difference_;
  const GjkOptions<D, S>& options_;
  Trace& trace_;
  const S floor_;
  GjkResult<D, S>& result_;
  S v_squared_ = std::numeric_limits<S>::infinity();
  S last_squared_ = std::numeric_limits<S>::max();
  V towards_;              ///< the origin, from v
  S plane_ = 0;
  bool enclosed_ = false;
  int newest_ = 0;                            ///< the place of the last point asked for
  int grown_by_ = 0;                          ///< that of the newest vertex in the simplex
  bool weighed_ = true;                       ///< the simplex has its weights
  int steps_on_the_spot_ = 0;
  V stepped_to_;                              ///< by the last of these
  bool accelerating_ = options_.accelerated;  ///< the momentum still helps
  int asked_in_vain_ = 0;                     ///< supports of directions that lead, which brought nothing: on a face of a body the model of two pieces never comes right
  bool newton_led_ = false;                   ///< the last direction was Newton's
  S gap_ = 0;                                 ///< of the bounds, before it
  NewtonDirection<Difference> newton_{difference_};
  V momentum_, last_;  ///< where accelerated
  GjkStatus status_ = GjkStatus::converged;
  std::array<int, D + 1> order_;
  Numbers before_;
};

/// Runs GJK on a difference, into a new result. Directions, points and v are in the frame of body 0.
template <class SubAlgorithm, class Difference, class Trace>
void gjk(Difference& difference, const GjkOptions<Difference::D, typename Difference::S>& options, Trace& trace,
         GjkResult<Difference::D, typename Difference::S>& result) {
  Gjk<Difference, SubAlgorithm, Trace>(difference, options, trace, result).run();
}

}  // namespace gjkdbg
