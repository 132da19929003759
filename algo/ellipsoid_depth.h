// How deep ellipsoids, rods and sums of such are in each other, by branch and bound over the directions; in the plane ellipses.
//
// Where many ways out of A - B are nearly as short (from the middle of what is nearly a ball all of them, of what is nearly a spheroid a circle of them), EPA would have to put faces everywhere:
// of width s, each leaves s^2 / 8 of the radius open. But about every direction that was looked along the bends of both bodies say what no height is below, and that is off by far less
// (algo/height_model.h, algo/bent_sum.h). So the sides of a cube, each a square of directions, are divided as long as a height less than the known least, by more than the tolerance, may lie in them: the one
// with the lowest bound first. (Land & Doig 1960.) In each the middle is looked along and then, if that is not enough, by Newton's method the least, or the bottom of the valley, near it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "algo/height_model.h"
#include "algo/lent.h"
#include "algo/sat.h"

namespace gjkdbg {

/// The directions of A - B's heights that are left.
template <int D, class S, class Model>
class DirectionSquares {
  static constexpr std::size_t corners = std::size_t{1} << (D - 1);

 public:
  /// Of a side of the cube about the origin; in the plane of the square's.
  struct Square {
    int side = 0;  ///< its normal's axis, + D for the negative one
    bool divided = false;
    std::array<S, D - 1> middle, half;
    S least = -std::numeric_limits<S>::infinity();  ///< no height is below
    Model model;                                    ///< from within it, or near it
    std::array<Vector<D, S>, corners> ends;         ///< directions of its corners

    void place() {
      for (std::size_t corner = 0; corner < corners; ++corner) {
        std::array<S, D - 1> at = middle;
        for (std::size_t i = 0; i < at.size(); ++i) at[i] += (corner >> i & 1) != 0 ? half[i] : -half[i];
        ends[corner] = direction(at);
      }
    }

    Vector<D, S> direction(const std::array<S, D - 1>& at) const {
      Vector<D, S> d;
      const int axis = side % D;
      d[axis] = side < D ? S(1) : S(-1);
      for (int i = 0; i + 1 < D; ++i) d[(axis + 1 + i) % D] = at[static_cast<std::size_t>(i)];
      return d.normalized();
    }
  };

  DirectionSquares() { squares_.reserve(room), heap_.reserve(room), left_.reserve(room); }
  void clear() { squares_.clear(), heap_.clear(), left_.clear(); }
  bool empty() const { return heap_.empty(); }
  bool full() const { return heap_.size() + 2 > room; }
  S least() const { return heap_.front().least; }
  void push(const Square& square) {
    std::size_t at = squares_.size();
    if (left_.empty()) squares_.push_back(square);
    else at = left_.back(), left_.pop_back(), squares_[at] = square;
    heap_.push_back({square.least, at});
    std::push_heap(heap_.begin(), heap_.end(), higher);
  }
  Square take_least() {
    std::pop_heap(heap_.begin(), heap_.end(), higher);
    const std::size_t at = heap_.back().at;
    heap_.pop_back(), left_.push_back(at);
    return squares_[at];
  }

 private:
  static constexpr std::size_t room = 1024;
  struct Place {
    S least;
    std::size_t at;
  };
  static bool higher(const Place& x, const Place& y) { return x.least > y.least; }
  std::vector<Square> squares_;
  std::vector<Place> heap_;
  std::vector<std::size_t> left_;  ///< places of squares that are taken
};

/// Whether EPA, with so many steps, had a fair chance before its directions are divided: who asks for fewer wants to know how far it comes.
inline bool fair_for_epa(int most) { return most >= 256; }

/// Of directions in body 0's frame. Knows nothing of a trace, so that it is compiled once: who wants to see an axis is called.
template <class Difference, class Pair>
class EllipsoidDepth {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;
  using Model = typename Pair::Model;
  using Squares = DirectionSquares<D, S, Model>;
  using Square = typename Squares::Square;

 public:
  /// Keeps the references.
  EllipsoidDepth(Difference& difference, const Pair& pair, AxisLook<D, S> look) : difference_(difference), pair_(pair), floor_(difference.rounding_floor()), look_(std::move(look)) {}

  /// Goes on from what others found: the axes that were looked along, of which this was the best.
  void go_on(int looked, const V& best) { looked_ = looked, look_along(best); }

  /// The points of a depth that others know, by Newton's method from its axis: near it heights are the same to the last bits where points are not yet.
  OutlineDepth<D, S> sharpened(const OutlineDepth<D, S>& known, S tolerance) {
    tolerance_ = tolerance, least_ = known.sat.depth - known.slack;
    go_on(known.sat.iterations, known.sat.normal);
    OutlineDepth<D, S> found = answer();
    found.sat.status = known.sat.status;
    return found;
  }

  /// `overlapping` where the depth is known within rounding, or the tolerance, a part of it. With some 16 supports for each of `most`, of which EPA's steps would take longer.
  OutlineDepth<D, S> run(S tolerance, int most_steps) {
    const std::int64_t most = looked_ + 16 * std::int64_t{most_steps};
    tolerance_ = tolerance;
    Lent<Squares> lent;
    Squares& squares = *lent;
    squares.clear();
    for (int side = 0; side < 2 * D; ++side) {
      Square all;
      all.side = side, all.middle.fill(0), all.half.fill(1);
      examine(all, squares);
    }
    for (update(squares); !squares.empty() && !near_enough(squares.least()) && !squares.full() && looked_ < most; update(squares)) {
      Square first = squares.take_least(), second;
      const auto i = static_cast<std::size_t>(std::max_element(first.half.begin(), first.half.end()) - first.half.begin());
      const S quarter = first.half[i] / 2;
      first.half[i] = quarter, first.divided = true, second = first, first.middle[i] -= quarter, second.middle[i] += quarter;
      examine(first, squares), examine(second, squares);
    }
    return answer();
  }

 private:
  bool any() const { return lowest_ < std::numeric_limits<S>::max(); }
  bool near_enough(S least) const { return lowest_ - least <= std::max(floor_, tolerance_ * lowest_); }

  struct Touch {
    Model model;
    Point point;
  };
  Touch look_along(const V& n) {
    const Point point = difference_.support(n);
    ++looked_;
    const Touch touch{pair_.model(n, point), point};
    if (touch.model.height() < lowest_) lowest_ = touch.model.height(), best_ = touch;
    if (look_) look_(looked_, n, point, lowest_, least_);
    return touch;
  }

  /// Its bound, from where its model is of, its middle, and where Newton's method leads from there. What is not near enough is left to be divided.
  void examine(Square& square, Squares& squares) {
    constexpr int steps = 3;
    square.place();
    if (any()) bound_by(best_.model, square);
    if (square.divided) bound(square);
    for (int k = 0; k < steps && !near_enough(square.least); ++k) {
      const S reach = k > 0 ? square.model.chord(square.ends) : S(0);
      const V n = k > 0 ? square.model.step(reach) : square.direction(square.middle);
      if (k > 0 && (n - square.model.direction()).norm() <= reach / 1024) break;  // it is there
      square.model = look_along(n).model;
      bound(square);
    }
    if (near_enough(square.least)) settled_ = std::min(settled_, square.least);
    else squares.push(square);
  }
  static void bound_by(const Model& model, Square& square) { square.least = std::max(square.least, model.least_among(square.ends)); }
  static void bound(Square& square) { bound_by(square.model, square); }

  void update(const Squares& squares) { least_ = squares.empty() ? settled_ : std::min(settled_, squares.least()); }

  /// How far the next of Newton's steps may lead. Along a valley's bottom, which bends next to nothing, a step leads too far, or, when it may not, not far enough: then to where the slope along it
  /// vanishes, by the secant of both ends'.
  static S next_reach(const Model& from, const Model& to, bool better, S most) {
    const V step = to.direction() - from.direction();
    const S length = step.norm(), fell = -across(from).dot(step), falls = -across(to).dot(step);
    if (better && length < most / 2) return most;
    const S level = fell > falls ? length * fell / (fell - falls) : 8 * length;
    return better ? std::clamp(std::abs(level - length), length / 1024, 8 * length) : std::clamp(level, length / 1024, length / 2);
  }
  static V across(const Model& model) { return model.support() - model.direction() * model.direction().dot(model.support()); }

  /// The least height's slope is what its points are off by: Newton's method takes that away, where heights no longer differ but for rounding.
  OutlineDepth<D, S> answer() {
    constexpr int steps = 12;
    S most = 1;
    for (int k = 0; k < steps && best_.model.slope() > floor_ / 16; ++k) {
      const Touch before = best_, next = look_along(before.model.step_down(most));
      const bool better = next.model.slope() < before.model.slope() && next.model.height() <= before.model.height() + floor_ / 2;
      best_ = better ? next : before;
      most = next_reach(before.model, next.model, better, most);
    }
    const Touch found = best_;
    look_along(V(found.model.direction()));  // so that the last axis is the answer's
    SatResult<D, S> sat{SatStatus::undecided, looked_, found.model.direction(), found.model.height()};
    if (lowest_ < -floor_) sat.status = SatStatus::separated;
    else if (near_enough(least_) && lowest_ > floor_) sat.status = SatStatus::overlapping;
    const bool across = found.model.slope() <= std::max(4 * floor_, tolerance_ * lowest_);
    return {sat, across ? std::optional(pair_.witnesses(found.model, found.point)) : std::nullopt, std::max(S(0), sat.depth - least_)};
  }

  Difference& difference_;
  const Pair& pair_;
  const S floor_;
  const AxisLook<D, S> look_;
  S tolerance_ = 0;
  int looked_ = 0;
  S lowest_ = std::numeric_limits<S>::max();  ///< of the heights
  S settled_ = std::numeric_limits<S>::infinity(), least_ = std::numeric_limits<S>::quiet_NaN();  ///< that a height is, where that is near enough, and everywhere
  Touch best_;  ///< of the least height
};

/// What others left undecided, if there is a pair whose bends are known, and EPA was to have a fair chance as well.
template <class Difference, class Pair, class Trace>
void go_on_by_bends(Difference& difference, const std::optional<Pair>& pair, OutlineDepth<Difference::D, typename Difference::S>& found, typename Difference::S tolerance, int most, Trace& trace) {
  if (!pair || found.sat.status != SatStatus::undecided || !fair_for_epa(most)) return;
  EllipsoidDepth by_bends(difference, *pair, outline_look(difference, trace));
  by_bends.go_on(found.sat.iterations, found.sat.normal);
  found = by_bends.run(tolerance, most);
}

/// Witness points are the caller's to find where there are none. `most`: see EllipsoidDepth::run.
template <class Difference, class Pair, class Trace>
OutlineDepth<Difference::D, typename Difference::S> ellipsoid_depth(Difference& difference, const Pair& pair, typename Difference::S tolerance, int most, Trace& trace) {
  using V = typename Difference::V;
  if constexpr (traced<Trace>) trace(SatBegan<V, Viewed>{0, 0, 0});
  const auto found = EllipsoidDepth(difference, pair, outline_look(difference, trace)).run(tolerance, most);
  if constexpr (traced<Trace>) trace(SatEnded<V, Viewed>{found.sat.iterations, found.sat.status, found.sat.normal, -static_cast<double>(found.sat.depth) - static_cast<double>(difference.radius())});
  return found;
}

}  // namespace gjkdbg
