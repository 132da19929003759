// What the height of A - B is like about a direction, where both bodies are rods: cylinders, cones, discs, segments, capsules' cores.
//
// Each has a fold (algo/rod_heights.h). For the one whose face or fold the direction lies on, of both the higher one, all is as there; and of the other, any disc between its ends is within it, so that for each the bounds
// are those of a rod and a disc. Three are asked: both ends, and the disc with which the slope along the first fold is zero: where the folds cross that takes away what the other's fold rises by, to both sides,
// along the first, which is where the depth of rods is that lie in one another tilted by a little.
//
// Directions n on both folds, n . a = s and n . a' = s', where the axes a, a' are not parallel: with x = a x a', n = k a + k' a' + l x, C = a . a',
//
//   k = (s - C s') / |x|^2,   k' = (s' - C s) / |x|^2,   l^2 |x|^2 = 1 - k s - k' s'
//
// and s - C s' = s - s' + s' |a - a'|^2 / 2, x = a x (a' - a), which nothing of is lost of for nearly parallel axes.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "algo/ellipsoid_depth.h"
#include "algo/rod_heights.h"

namespace gjkdbg {

/// Heights about a direction, of the pair's whole difference; unit, in body 0's frame.
template <class S>
class TwoRodHeights {
  using V = Vector<3, S>;

 public:
  using Rods = std::array<BentRod<S>, 2>;
  using Points = std::array<V, 2>;

  TwoRodHeights() = default;
  /// Of A - B with A and -B, of which these are the supports along the unit direction d.
  TwoRodHeights(const Rods& rods, const V& d, const Points& points) : rods_(&rods), d_(d), points_(points) {
    const V w = points[0] + points[1];
    const auto seen_a = rods[0].along(d), seen_b = rods[1].along(d);
    const auto tells = [](const auto& seen) { return seen.on_face ? 2 : seen.on_fold ? 1 : 0; };
    if (tells(seen_a) != tells(seen_b)) main_ = tells(seen_a) > tells(seen_b) ? 0 : 1;
    else main_ = rods[1].shape.half > rods[0].shape.half ? 1 : 0;
    const auto &first_seen = main_ == 0 ? seen_a : seen_b, &seen = main_ == 0 ? seen_b : seen_a;
    const BentRod<S>&first = rods[at(main_)], &second = rods[at(1 - main_)];
    on_both_ = first_seen.on_fold && seen.on_fold;
    Points ends;
    for (int i = 0; i < 2; ++i) {
      ends[at(i)] = second.point(i, seen, points[at(main_)]);
      models_[at(i)] = Model(first, second.bends(second.radius(i), seen), d, w, ends[at(i)]);
    }
    higher_ = d.dot(ends[1]) > d.dot(ends[0]) ? 1 : 0;
    V of_second = ends[at(higher_)];
    support_ = models_[at(higher_)].support();
    const S share = second.folds() ? cancelling(first_seen.on_fold ? V(d.cross(first.above_fold(d))) : V(V::Zero()), support_, ends[at(1 - higher_)] - of_second) : S(0);
    if (share > 0 && share < 1) {
      between_ = true;
      const V mean = of_second + share * (ends[at(1 - higher_)] - of_second);
      models_[2] = Model(first, second.bends(second.radius(higher_) + share * (second.radius(1 - higher_) - second.radius(higher_)), seen), d, w, mean);
      if (seen.on_fold) of_second = mean, support_ = models_[2].support();
    }
    if (!(first_seen.round || first_seen.on_face) || !(seen.round || seen.on_face)) support_ = w;
    else points_[at(1 - main_)] = of_second, points_[at(main_)] = support_ - of_second;
  }

  const V& direction() const { return d_; }
  S height() const { return models_[0].height(); }
  /// Of what A - B reaches farthest along d with, that which lies least beside it; and how far it does; and those of A and -B that it is the sum of.
  const V& support() const { return support_; }
  S slope() const { return (support_ - d_ * d_.dot(support_)).norm(); }
  const Points& points() const { return points_; }

  /// Of the corners, of less than half the sphere.
  template <std::size_t corners>
  S least_among(const std::array<V, corners>& ends) const {
    constexpr S none = -std::numeric_limits<S>::infinity();
    const bool folded = rods_->at(at(main_)).along(d_).on_fold;
    S least = none, above = none, below = none;
    for (std::size_t i = 0; i < (between_ ? 3 : 2); ++i) {
      least = std::max(least, models_[i].least_on_both_sides(ends));
      if (folded) above = std::max(above, models_[i].least_on_side(1, ends)), below = std::max(below, models_[i].least_on_side(0, ends));
    }
    return std::max(least, std::min(above, below));
  }
  template <std::size_t corners>
  S chord(const std::array<V, corners>& ends) const { return models_[0].chord(ends); }

  /// To where the height is least, by one rod's heights, but no farther than the other's fold.
  V step(S most) const {
    return moved(most, [&](const Model& model) { return model.step(most); });
  }
  V step_down(S most) const {
    return moved(most, [&](const Model& model) { return model.step_down(most); });
  }

 private:
  using Model = RodHeights<S>;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const BentRod<S>& second() const { return (*rods_)[at(1 - main_)]; }

  /// How much of the step to take from p, so that along this way, or if it is zero along the step, nothing is left beside d.
  S cancelling(const V& way, const V& p, const V& step) const {
    const V slope = p - d_ * d_.dot(p), beside = step - d_ * d_.dot(step), along = is_zero(way) ? beside : way;
    return -slope.dot(along) / beside.dot(along);
  }

  /// On the second's fold; where n is on the first's, too, on both: the crossing that is nearest, if there is one.
  std::optional<V> to_fold(const V& n) const {
    const BentRod<S>& first = (*rods_)[at(main_)];
    if (!first.along(n).on_fold) return second().on_fold(n);
    const V& axis = first.shape.axis;
    const bool turned = axis.dot(second().shape.axis) < 0;
    const V other = turned ? V(-second().shape.axis) : second().shape.axis, off = other - axis, across = axis.cross(off);
    const S s = first.fold_sin, t = turned ? -second().fold_sin : second().fold_sin, square = across.squaredNorm(), less = off.squaredNorm() / 2;
    const S along = (s - t + t * less) / square, along_other = (t - s + s * less) / square, rest = 1 - along * s - along_other * t;
    if (!(square > 0) || !(rest >= 0)) return std::nullopt;
    const V unit = across / std::sqrt(square), there = along * axis + along_other * other + std::copysign(std::sqrt(rest), unit.dot(n)) * unit;
    return there.normalized();
  }

  template <class Step>
  V moved(S most, const Step& step) const {
    if (on_both_ && between_) return to_fold(step(models_[2])).value_or(d_);
    const V& axis = second().shape.axis;
    const V face = d_.dot(axis) > 0 ? axis : V(-axis);
    if (d_ != face && (face - d_).norm() <= most && models_[at(higher_)].falls_along(face - d_)) return face;
    const V n = step(models_[at(higher_)]);
    if (!second().folds()) return n;
    const bool beyond = second().end_above(n) != higher_;
    if (on_both_)
      if (const V other = step(models_[at(1 - higher_)]); beyond && second().end_above(other) != higher_) return other;
    const std::optional<V> there = to_fold(n);
    if (!there || (*there - d_).norm() > most) return n;
    return beyond || models_[at(higher_)].falls_along(*there - d_) ? *there : n;
  }

  const Rods* rods_ = nullptr;
  V d_, support_;
  Points points_;
  std::array<Model, 3> models_;  ///< of the first with the second's bottom, its top, and a disc between them
  int main_ = 0, higher_ = 0;    ///< the first; the second's end
  bool on_both_ = false, between_ = false;
};

/// Two rods, in body 0's frame.
template <class S>
struct TwoRods {
  using Model = TwoRodHeights<S>;
  typename Model::Rods rods;  ///< A, -B

  /// Unset where one is none.
  template <class Difference>
  static std::optional<TwoRods> of(const Difference& difference) {
    if constexpr (Difference::D == 3 && requires { difference.a().core(), difference.b().core(); }) {
      const auto a = revolved<S>(difference.a().core()), b = revolved<S>(difference.b().core());
      if (is_rod(a) && is_rod(b)) return TwoRods{{BentRod<S>::of(*a), BentRod<S>::of(b->placed(difference.rotation(), difference.position()).reversed())}};
    }
    return std::nullopt;
  }

  template <class Point>
  Model model(const Vector<3, S>& d, const Point& point) const { return Model(rods, d, {Vector<3, S>(point.a), Vector<3, S>(-point.b)}); }
  /// Of A and B, that are apart along d as far as anything of them is.
  template <class Point>
  SatWitnesses<3, S> witnesses(const Model& model, const Point&) const { return {model.points()[0], -model.points()[1]}; }
};

/// Whether the bends tell how deep they are: an ellipsoid with another, with a ball, or with a rod, or two rods.
template <class Difference>
bool has_bends(const Difference& difference) {
  using S = typename Difference::S;
  return BentPair<Difference::D, S>::of(difference) || RodPair<S>::of(difference) || TwoRods<S>::of(difference);
}

}  // namespace gjkdbg
