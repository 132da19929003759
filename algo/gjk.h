// GJK, distance form: how far the difference A - B is from the origin.
//
// Gilbert, Johnson, Keerthi 1988; stopping rule and monotone loop after van den Bergen 1999, with the bounds as in
// Montaut et al. 2024 ("GJK++"), section III. One loop:
//   v = closest point of the simplex to the origin       |v| is an upper bound of the distance
//   w = support(-v)                                      v.w / |v| is a lower one: all of A - B lies beyond that plane
//   stop when the bounds meet; else add w, cut the simplex down to the feature nearest the origin
// Deviations: |v| must fall in every step; where it does not, the simplex is judged again in twice the precision and,
// if that does not help, the loop ends as `stalled` with honest bounds. Bounds include the rounding floor. At the end |v| must be that of a point of A - B, or v is taken in twice the precision and the loop goes
// on. Whether radii reach across the distance is told to the floor, whatever the tolerance.
// Directions may carry Nesterov's momentum (Montaut et al., section IV): fewer steps where curvature is small; or be Newton's (algo/newton_direction.h);
// or be smoothed in the first steps (algo/leading_direction.h): fewer steps of polytopes.
// The sub-algorithm is a policy: ClosestFeature<D, S> closest(const V* w, int size), called by its address, so that the loop is compiled once for all of them;
// its `Grown`, where that is not void, is asked first, within the loop (algo/grown_simplex.h).
#pragma once

#include <limits>
#include <new>
#include <span>
#include <utility>

#include "algo/gjk_options.h"
#include "algo/gjk_steps.h"
#include "algo/leading_direction.h"
#include "algo/trace.h"
#include "shapes/triple.h"

namespace gjkdbg {

/// Grown: what is asked first of a simplex that has grown by a vertex, or void. leads: directions other than -v in any step, not in the first ones alone.
template <class Difference, class Grown, class Trace, bool leads>
class Gjk {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using T = Triple<S>;
  using Point = typename Difference::Point;
  using Feature = ClosestFeature<D, S>;
  using Options = GjkOptions<D, S>;

 public:
  using Leading = LeadingDirection<Difference, leads>;

  Gjk(Difference& difference, const Options& options, Opinion<D, S> opinion, Trace& trace, GjkResult<D, S>& result, GjkSteps<D, S>& steps, Leading& leading)
      : difference_(difference), options_(options), opinion_(opinion), trace_(trace), floor_(difference.rounding_floor()), result_(result), steps_(steps), leading_(leading) {}

  [[gnu::always_inline]] void run() {
    trace_(GjkBegan<V, Viewed>{options_.direction});
    if (options_.kept.empty()) begin();
    else keep();
    bool asked = false;  // since the simplex was cut down
    do {
      while ((asked = !ended())) {
        ++iterations_;
        T d = -v_;
        S length = distance_;
        const bool led = leading_.next(d, length, {iterations_, v_, v_squared_, distance_, lower_bound_ + floor_});
        const Point& point = query(d, length);
        if (led) {
          if (options_.goal == GjkGoal::intersect && lower_bound_ > difference_.radius()) {
            status_ = GjkStatus::separated;
            break;
          }
          if (brings_nothing(point)) {
            leading_.in_vain();
            continue;
          }
        } else if (proven(point)) {
          break;
        }
        if constexpr (leads) leading_.met(point);
        if (!reduce() && !reduce_again()) {
          places_ &= ~(1u << newest_), status_ = stalled();
          break;
        }
      }
      if (!enclosed_ || options_.goal != GjkGoal::signed_distance) weigh();
    } while (!stands(asked));
    finish();
  }

 private:
  static constexpr bool grows = !std::is_void_v<Grown>;

  /// Asks for the support along d and takes its plane for the lower bound: all x of A - B have d.x <= d.w, so the
  /// signed distance is at least -d.w / |d|. The point lies in a place that is free, and stays so unless the simplex grows by it.
  [[gnu::always_inline]] const Point& query(const T& d, S length) {
    newest_ = std::countr_one(places_);
    const Point& point = *new (&result_.simplex.points[newest_]) Point(difference_.support(vector(d)));  // made where it stays
    if constexpr (traced<Trace>)
      trace_(SupportQueried<V, Viewed>{iterations_, Phase::gjk, vector(d), point.vertex, point.a, point.b, point.w});
    newest_w_ = T::just_written(point.w);
    plane_ = -d.dot(newest_w_) / length;
    lower_bound_ = std::max(lower_bound_, plane_ - floor_);
    if constexpr (leads) leading_.take(vector(d), length, point);
    else leading_.take(d, length, plane_);
    return point;
  }

  [[gnu::always_inline]] static V vector(const T& t) { return t.template vector<D>(); }
  V v() const { return vector(v_); }

  [[gnu::always_inline]] void begin() {
    const T d = T::of(options_.direction);
    const S length = options_.direction.norm();
    const Point& point = query(d, length);
    if constexpr (leads) leading_.begin(vector(d), length, point);
    if (!reduce()) places_ = 1u << newest_, result_.simplex.weights[newest_] = 1;  // no number: a simplex has a vertex all the same
  }
  [[gnu::always_inline]] void keep() {
    for (const Point& point : options_.kept) {
      trace_(VertexKept<V, Viewed>{point.vertex, point.a, point.b, point.w});
      result_.simplex.add(point);
    }
    places_ = result_.simplex.places;
    accept(of_list(opinion_));
    if constexpr (leads) leading_.keep(v());
  }

  /// The Frank-Wolfe gap: a support that is no nearer than v along v adds nothing. From there on the plain direction is right, and momentum over.
  [[gnu::always_inline]] bool brings_nothing(const Point& point) const {
    return !(v_.dot(v_ - T::of(point.w)) > options_.tolerance * v_squared_) || holds(point.w);
  }
  [[gnu::always_inline]] bool holds(const V& w) const { return result_.simplex.holds(w, places_); }

  /// Takes the newest point and cuts the simplex down to the feature nearest the origin; false when that is no nearer than before (NaN included).
  [[gnu::always_inline]] bool reduce() {
    if constexpr (grows) {
      bool told = false;
      const bool nearer = Grown::find(result_.simplex.points, places_, newest_, newest_w_, steps_.lanes, [&](const auto& nearest) __attribute__((always_inline)) {
        told = nearest.places != 0;
        return told && accept(nearest);
      });
      if (told) [[likely]] return nearer;
    }
    places_ |= 1u << newest_;
    return accept(of_list(opinion_));
  }
  /// The second opinion, in twice the precision.
  [[gnu::always_inline]] bool reduce_again() {
    places_ |= 1u << newest_;
    return accept(of_list(WideClosestPoint<D, S>::of_boundary), true);
  }
  [[gnu::always_inline]] Feature of_list(Opinion<D, S> opinion) const {
    result_.simplex.places = places_;
    return GjkSteps<D, S>::of_list(result_.simplex, opinion);
  }

  [[gnu::always_inline]] bool accept(const Feature& feature, bool wide = false) {
    if (feature.enclosed && lower_bound_ > 0) return false;  // a support plane has shown the origin outside: rounding speaks
    if (!feature.enclosed && !falls_to(T::of(feature.v), feature.v_squared, wide)) return false;
    if constexpr (traced<Trace>) before_ = vertex_numbers();
    result_.simplex.reduce_to(feature);
    places_ = result_.simplex.places;
    weighed_ = true, enclosed_ = feature.enclosed;
    advance_to(T::of(feature.v), feature.v_squared);
    return true;
  }
  /// Weights are found when somebody wants them.
  template <class Nearest>
  [[gnu::always_inline]] bool accept(const Nearest& nearest) {
    if (nearest.encloses() ? lower_bound_ > 0 : !falls_to(nearest.v, nearest.v_squared)) [[unlikely]] return Grown::forget(steps_.lanes), false;
    enclosed_ = nearest.encloses();
    if constexpr (traced<Trace>) places_ |= 1u << newest_, before_ = vertex_numbers();
    places_ = nearest.places;
    grown_by_ = newest_, weighed_ = false;
    advance_to(nearest.v, nearest.v_squared);
    return true;
  }
  /// Whether that is nearer; or as near, to rounding, and known in twice the precision: other steps on the spot may go around in circles. Newton's directions
  /// bring |v| to its least before it falls by no more than it rounds, where |v| is known to a floor only.
  [[gnu::always_inline]] bool falls_to(const T& v, S v_squared, bool wide = false) {
    if (v_squared < v_squared_) [[likely]] return true;
    if (!wide && !leading_.by_newton()) return false;
    const S rounding = leading_.by_newton() ? 2 * distance_ * floor_ : 8 * std::numeric_limits<S>::epsilon() * v_squared_;
    return steps_.allowed(vector(v_), v_squared_, vector(v), v_squared, rounding);
  }
  [[gnu::always_inline]] void advance_to(const T& v, S v_squared) {
    v_ = v;
    v_squared_ = v_squared;
    distance_ = std::sqrt(v_squared);
    if constexpr (traced<Trace>) trace_reduction();
  }

  [[gnu::always_inline]] void weigh() {
    if constexpr (grows)
      if (!weighed_) Grown::weigh(result_.simplex.points, places_, grown_by_, steps_.lanes, result_.simplex.weights);
    weighed_ = true;
  }

  /// Whether |v| bounds the distance: the point of A - B that the weights make is as near. If not, v is taken in twice the precision; true where that has led no farther before.
  /// `asked`: the newest point was asked for since the simplex was cut down, and counts as well.
  [[gnu::always_inline]] bool stands(bool asked) {
    // The floor is 8 epsilon times how far a vertex can be, or more: of vertices no farther than 16 |v| the formulas do not round apart by more than it.
    constexpr S near = 128 * std::numeric_limits<S>::epsilon();
    if (stands_ || enclosed_ || options_.goal == GjkGoal::intersect || (floor_ <= near * distance_ && plane_ <= distance_)) [[likely]] return true;
    if (asked) places_ |= 1u << newest_;
    if constexpr (traced<Trace>) before_ = vertex_numbers();
    if (asked) places_ &= ~(1u << newest_);
    result_.simplex.places = places_;
    V corrected = v();
    stands_ = steps_.within_reach(result_.simplex, asked ? newest_ : -1, corrected, distance_ + floor_, floor_);
    if (corrected == v()) return true;
    places_ = result_.simplex.places;
    if constexpr (grows) Grown::forget(steps_.lanes);
    advance_to(T::of(corrected), corrected.squaredNorm());
    return stands_;
  }

  /// Whether what is known settles the matter.
  [[gnu::always_inline]] bool ended() {
    if (enclosed_) return end_as(GjkStatus::enclosed);
    if (distance_ <= floor_) return end_as(GjkStatus::touching);
    if (options_.goal != GjkGoal::signed_distance) {
      if (distance_ + floor_ <= difference_.radius()) return end_as(GjkStatus::within_radius);
      if (options_.goal == GjkGoal::intersect && lower_bound_ > difference_.radius()) return end_as(GjkStatus::separated);  // by the first plane
    }
    if (iterations_ >= options_.max_iterations) return end_as(GjkStatus::iteration_limit);
    return false;
  }

  /// Whether the newest support point settles it. The plane must be the one across v itself, not the best one met: then
  /// the normal -v / |v| is certified as well as the distance. A point met before cannot bring anything new, and no vertex of the simplex
  /// is nearer along v than v is, but for rounding: where that is more, `reduce_again` has the last word on v.
  [[gnu::always_inline]] bool proven(const Point& point) {
    if (options_.goal == GjkGoal::intersect && lower_bound_ > difference_.radius()) return end_as(GjkStatus::separated);
    const S gap = distance_ - plane_;
    within_tolerance_ = gap <= options_.tolerance * distance_ + floor_;
    if (options_.stopping != Stopping::bounds) {
      if (rule_met(point.w)) return end_as(within_tolerance_ ? GjkStatus::converged : GjkStatus::rule_met);
    } else if (within_tolerance_ && (gap <= floor_ || !straddles())) {
      return end_as(GjkStatus::converged);
    }
    return gap <= floor_ && holds(point.w) && end_as(stalled());
  }

  /// Whether the bounds leave open if the radii reach across the distance. (Without radii a plane that is met at all has the origin outside.) Then only rounding ends the search, whatever the tolerance.
  [[gnu::always_inline]] bool straddles() const {
    const S radius = difference_.radius();
    return radius > 0 && lower_bound_ <= radius && distance_ + floor_ > radius;
  }

  /// Where nothing brings v nearer: a yes or no is open then, a distance within the tolerance is known.
  [[gnu::always_inline]] GjkStatus stalled() const { return within_tolerance_ && options_.goal != GjkGoal::intersect ? GjkStatus::converged : GjkStatus::stalled; }

  /// Other libraries' rules, as their sources have them (see Stopping); v.w and |v|^2 are not yet those of the next simplex.
  [[gnu::always_inline]] bool rule_met(const V& w) {
    constexpr S epsilon = std::numeric_limits<S>::epsilon();
    const S gap = v_squared_ - v_.dot(T::of(w));
    switch (options_.stopping) {
      case Stopping::van_den_bergen: return distance_ - std::max(S(0), lower_bound_ + floor_) <= options_.tolerance * distance_;
      case Stopping::bullet: return gap <= v_squared_ * (std::is_same_v<S, float> ? S(1e-6) : S(1e-12));
      case Stopping::jolt: {
        const S before = std::exchange(last_squared_, v_squared_);
        return before - v_squared_ <= epsilon * before;
      }
      case Stopping::opengjk: return gap <= S(1e4) * epsilon * v_squared_ || gap < S(1e2) * epsilon || iterations_ >= 25;
      case Stopping::bounds: break;
    }
    return false;
  }

  [[gnu::always_inline]] bool end_as(GjkStatus status) {
    status_ = status;
    return true;
  }

  [[gnu::always_inline]] void finish() {
    result_.v = v();
    result_.status = status_, result_.iterations = iterations_, result_.simplex.places = places_;
    result_.distance = distance_, result_.lower_bound = lower_bound_, result_.upper_bound = distance_ + floor_;
    const double radius = static_cast<double>(difference_.radius());
    trace_(GjkEnded<V, Viewed>{iterations_, status_, result_.lower_bound - radius, result_.upper_bound - radius});
  }

  struct Numbers {
    std::array<int, D + 1> vertex;
    int size = 0;
    std::span<const int> view() const { return {vertex.data(), static_cast<std::size_t>(size)}; }
  };

  /// Vertex numbers, newest first. `order_` remembers the way there.
  Numbers vertex_numbers() {
    result_.simplex.places = places_;
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
    trace_(SimplexReduced<V, Viewed>{iterations_, before_.view(), region.view(), std::span<const double>(weights.data(), region.size), v(),
                                     lower_bound_ - radius, distance_ + floor_ - radius});
  }

  Difference& difference_;
  const Options& options_;
  const Opinion<D, S> opinion_;
  Trace& trace_;
  const S floor_;
  GjkResult<D, S>& result_;
  GjkSteps<D, S>& steps_;
  T v_{0, 0, 0};
  S v_squared_ = std::numeric_limits<S>::infinity(), distance_ = 0, lower_bound_ = -std::numeric_limits<S>::infinity(), plane_ = 0;
  int iterations_ = 0;
  unsigned places_ = 0;    ///< those of the simplex
  int newest_ = 0;         ///< the place of the last point asked for
  T newest_w_{0, 0, 0};    ///< its w
  int grown_by_ = 0;       ///< that of the newest vertex in the simplex
  bool weighed_ = true;    ///< the simplex has its weights
  bool enclosed_ = false, within_tolerance_ = false;
  bool stands_ = false;  ///< it was asked of this v
  GjkStatus status_ = GjkStatus::converged;
  S last_squared_ = std::numeric_limits<S>::max();
  std::conditional_t<leads, Leading&, Leading> leading_;  ///< in its own place where it is shown to others, for its numbers are to stay in registers, too
  std::array<int, D + 1> order_;
  Numbers before_;
};

/// The loop for all sub-algorithms with the same `Grown`, or with none.
template <class Grown, class Difference, class Trace>
void run_gjk_loop(Difference& difference, const GjkOptions<Difference::D, typename Difference::S>& options, Opinion<Difference::D, typename Difference::S> opinion,
                  Trace& trace, GjkResult<Difference::D, typename Difference::S>& result) {
  GjkSteps<Difference::D, typename Difference::S> steps;
  const auto run = [&]<bool leads>(LeadingDirection<Difference, leads> leading) __attribute__((always_inline)) {
    Gjk<Difference, Grown, Trace, leads>(difference, options, opinion, trace, result, steps, leading).run();
  };
  if (options.accelerated && options.acceleration != Acceleration::smoothed) run(LeadingDirection<Difference, true>(difference, options));
  else run(LeadingDirection<Difference, false>(difference, options));
}

/// Runs GJK on a difference, into a new result. Directions, points and v are in the frame of body 0.
template <class SubAlgorithm, class Difference, class Trace>
void gjk(Difference& difference, const GjkOptions<Difference::D, typename Difference::S>& options, Trace& trace,
         GjkResult<Difference::D, typename Difference::S>& result) {
  run_gjk_loop<typename SubAlgorithm::Grown>(difference, options, opinion_of<SubAlgorithm, Difference::D, typename Difference::S>, trace, result);
}

}  // namespace gjkdbg
