// What the height of A - B is like about a direction, where both are sums of ellipsoids and rods (cylinders, cones, discs, segments, capsules' cores): an ellipsoid and a rod, two rods, Minkowski sums of such.
//
// Each rod has a fold (algo/rod_heights.h). For one of them, that whose face or fold the direction lies on, and else the highest, all is as there; and of the others any disc between their ends is within them, so
// that for each choice the bounds are those of one rod and what bends as ellipsoids do. Three are asked: the ends that are higher, those that are not, and the discs with which the slope along the first fold is zero:
// where folds cross that takes away what the others' folds rise by, to both sides, along the first, which is where the depth of rods is that lie in one another tilted by a little.
//
// Of rods about the same axis the discs are added to the first's ends: a disc on a disc is one.
//
// Directions n on two folds, n . a = s and n . a' = s', where the axes a, a' are not parallel: with x = a x a', n = k a + k' a' + l x, C = a . a',
//
//   k = (s - C s') / |x|^2,   k' = (s' - C s) / |x|^2,   l^2 |x|^2 = 1 - k s - k' s'
//
// and s - C s' = s - s' + s' |a - a'|^2 / 2, x = a x (a' - a), which nothing of is lost of for nearly parallel axes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "algo/rod_heights.h"

namespace gjkdbg {

/// What A and -B are sums of; in body 0's frame.
template <class S>
struct BentParts {
  using V = Vector<3, S>;
  static constexpr std::size_t most = BesideRod<S>::most;  ///< of each kind
  struct Ellipsoid {
    BentBody<3, S> body;
    std::optional<Revolved<S>> spheroid;  ///< if it is one
    std::size_t side;                     ///< 0: of A, 1: of -B
  };
  struct Rod {
    BentRod<S> rod;
    std::size_t side;
  };
  std::array<Ellipsoid, most> ellipsoids;
  std::array<Rod, most> rods;  ///< one at least, which may be a point
  std::array<V, 2> middles{V::Zero(), V::Zero()};  ///< of A, -B: what is a point
  std::size_t ellipsoid_count = 0, rod_count = 0;

  /// False: the core is no such sum, has too many parts, or one that is too flat for its bends to be told.
  template <class Core>
  bool add(const Core& core, const Matrix<3, S>& axes, std::size_t side) {
    if (const auto* sum = std::get_if<SumCore<3, S>>(&core)) return add(sum->first->core(), axes, side) && add(sum->second->core(), axes, side);
    std::optional<Revolved<S>> about_axis = revolved<S>(core);
    if (about_axis) about_axis = about_axis->placed(axes, V::Zero());
    if (about_axis && !about_axis->ellipse()) return add_rod(side == 1 ? about_axis->reversed() : *about_axis, side);
    const auto* ellipsoid = std::get_if<EllipsoidCore<3, S>>(&core);
    if (!ellipsoid || !(ellipsoid->radii.minCoeff() * 1024 > ellipsoid->radii.maxCoeff()) || ellipsoid_count == most) return false;
    ellipsoids[ellipsoid_count++] = {BentBody<3, S>::of(*ellipsoid, axes), about_axis, side};
    return true;
  }
  bool add_rod(const Revolved<S>& rod, std::size_t side) {
    if (is_zero(rod.axis)) {
      middles[side] += rod.middle;
      return true;
    }
    const BentRod<S> bent = BentRod<S>::of(rod);
    for (std::size_t i = 0; i < rod_count; ++i)
      if (rods[i].side == side && rods[i].rod.about(rod.axis) && merge(rods[i].rod, rods[i].rod.shape.axis.dot(rod.axis) < 0 ? BentRod<S>::of(rod.turned()) : bent)) return true;
    if (rod_count == most) return false;
    rods[rod_count++] = {bent, side};
    return true;
  }
  void have_a_rod() {
    if (rod_count == 0) add_rod({V::UnitX(), V::Zero()}, 0);
  }

 private:
  /// Two rods about one axis with one fold are one rod.
  static bool merge(BentRod<S>& sum, const BentRod<S>& rod) {
    if (std::abs(sum.fold_sin - rod.fold_sin) > 4 * std::numeric_limits<S>::epsilon()) return false;
    const Revolved<S>&a = sum.shape, &b = rod.shape;
    sum = BentRod<S>::of({a.axis, a.middle + b.middle, a.top + b.top, a.bottom + b.bottom, a.half + b.half});
    return true;
  }
};

/// Heights about a direction, of the pair's whole difference; unit, in body 0's frame.
template <class S>
class SumHeights {
  using V = Vector<3, S>;
  using Parts = BentParts<S>;

 public:
  using Points = std::array<V, 2>;

  SumHeights() = default;
  /// Of A - B with A and -B, of which these are the supports along the unit direction d. Keeps a reference.
  SumHeights(const Parts& parts, const V& d, const Points& points) : parts_(&parts), d_(d), points_(points) {
    const V w = points[0] + points[1];
    std::array<typename BentRod<S>::Seen, Parts::most> seen;
    bool exact = true;
    const auto tells = [&](std::size_t i) { return seen[i].on_face ? 2 : seen[i].on_fold ? 1 : 0; };
    for (std::size_t i = 0; i < parts.rod_count; ++i) {
      seen[i] = rod(i).along(d), exact = exact && (seen[i].round || seen[i].on_face);
      if (tells(i) > tells(main_) || (tells(i) == tells(main_) && rod(i).shape.half > rod(main_).shape.half)) main_ = i;
    }
    Points round = parts.middles;
    for (std::size_t i = 0; i < parts.ellipsoid_count; ++i) {
      supports_[i] = parts.ellipsoids[i].body.support(d), round[parts.ellipsoids[i].side] += supports_[i];
    }
    std::array<Disc, Parts::most> higher, lower, between;
    V rest = round[0] + round[1];
    for (std::size_t i = 0; i < parts.rod_count; ++i) {
      if (i == main_) continue;
      const std::array<V, 2> ends{rod(i).point(0, seen[i], rest), rod(i).point(1, seen[i], rest)};
      ends_[i] = d.dot(ends[1]) > d.dot(ends[0]) ? 1 : 0;
      const int end = ends_[i];
      higher[i] = Disc::at_end(rod(i), end, ends[at(end)]), lower[i] = Disc::at_end(rod(i), 1 - end, ends[at(1 - end)]), rest += higher[i].point;
    }
    models_[0] = model(seen, higher), support_ = models_[0].support();
    between = higher;
    if (parts.rod_count > 1) {
      models_[count_++] = model(seen, lower);
      // Along the first fold; or, where d is not on it, along all that can be taken away.
      const V way = seen[main_].on_fold ? V(d.cross(rod(main_).above_fold(d))) : V(V::Zero());
      V left = support_;
      bool all_on_folds = true;
      for (std::size_t i = 0; i < parts.rod_count; ++i) {
        if (i == main_ || !rod(i).folds()) continue;
        const V step = lower[i].point - higher[i].point;
        const S share = cancelling(way, left, step);
        if (!(share > 0 && share < 1)) continue;
        between[i] = higher[i].towards(lower[i], share), left += share * step;
        between_[i] = true, all_on_folds = all_on_folds && seen[i].on_fold;
      }
      if (std::find(between_.begin(), between_.end(), true) != between_.end()) {
        models_[count_++] = model(seen, between);
        if (all_on_folds) stays_ = true, support_ = models_[2].support();
      }
    }
    on_main_fold_ = seen[main_].on_fold;
    for (std::size_t i = 0; i < parts.rod_count; ++i) on_fold_[i] = seen[i].on_fold;
    if (!exact) {
      support_ = w;
      return;
    }
    points_ = round;
    for (std::size_t i = 0; i < parts.rod_count; ++i)
      if (i != main_) points_[parts.rods[i].side] += stays_ ? between[i].point : higher[i].point;
    const std::size_t side = parts.rods[main_].side;
    points_[side] = support_ - points_[1 - side];
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
    S least = none, above = none, below = none;
    for (std::size_t i = 0; i < count_; ++i) {
      least = std::max(least, models_[i].least_on_both_sides(ends));
      if (on_main_fold_) above = std::max(above, models_[i].least_on_side(1, ends)), below = std::max(below, models_[i].least_on_side(0, ends));
    }
    return std::max(least, std::min(above, below));
  }
  template <std::size_t corners>
  S chord(const std::array<V, corners>& ends) const { return models_[0].chord(ends); }

  /// To where the height is least, by one rod's heights, but no farther than another's fold.
  V step(S most) const {
    return moved(most, [&](const RodHeights<S>& model) { return model.step(most); });
  }
  V step_down(S most) const {
    return moved(most, [&](const RodHeights<S>& model) { return model.step_down(most); });
  }

 private:
  /// Of a rod, between its ends: what of it is farthest along d, and its middle.
  struct Disc {
    V point, middle;
    S radius;
    static Disc at_end(const BentRod<S>& rod, int end, const V& point) { return {point, rod.middle(end), rod.radius(end)}; }
    Disc towards(const Disc& other, S share) const { return {point + share * (other.point - point), middle + share * (other.middle - middle), radius + share * (other.radius - radius)}; }
  };
  using Discs = std::array<Disc, Parts::most>;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const BentRod<S>& rod(std::size_t i) const { return parts_->rods[i].rod; }

  template <class Seen>
  RodHeights<S> model(const Seen& seen, const Discs& discs) const {
    BentRod<S> first = rod(main_);
    BesideRod<S> beside;
    beside.support_off_axis = parts_->middles[0] + parts_->middles[1];
    V on_axis = V::Zero();
    for (std::size_t i = 0; i < parts_->rod_count; ++i) {
      if (i == main_) continue;
      if (first.about(rod(i).shape.axis)) first = first.with_disc(discs[i].middle, discs[i].radius);
      else if (const V& axis = rod(i).shape.axis; seen[i].round && first.nearly_about(axis)) {
        rod(i).add_disc(beside.bends, discs[i].radius, seen[i]), beside.support_off_axis += discs[i].middle, on_axis += discs[i].point - discs[i].middle;
        beside.spheroids[beside.count++] = {first.along_axis(axis), discs[i].radius * discs[i].radius, 0};
      } else {
        for (BentBodies<3, S>* bends : {&beside.bends, &beside.bends_off_axis}) rod(i).add_disc(*bends, discs[i].radius, seen[i]);
        beside.support_off_axis += discs[i].point;
      }
    }
    for (std::size_t i = 0; i < parts_->ellipsoid_count; ++i) {
      const auto& [body, spheroid, side] = parts_->ellipsoids[i];
      beside.bends.add(body, body.greatest);
      if (spheroid && first.nearly_about(spheroid->axis)) beside.spheroids[beside.count++] = {first.along_axis(spheroid->axis), spheroid->across * spheroid->across, spheroid->along * spheroid->along}, on_axis += supports_[i];
      else beside.bends_off_axis.add(body, body.greatest), beside.support_off_axis += supports_[i];
    }
    beside.support = beside.support_off_axis + on_axis;
    return RodHeights<S>(first, beside, d_, points_[0] + points_[1]);
  }

  /// How much of the step to take from p, so that along this way, or if it is zero along the step, nothing is left beside d.
  S cancelling(const V& way, const V& p, const V& step) const {
    const V slope = p - d_ * d_.dot(p), beside = step - d_ * d_.dot(step), along = is_zero(way) ? beside : way;
    return -slope.dot(along) / beside.dot(along);
  }

  /// On that rod's fold; where n is on the first's, too, on both: the crossing that is nearest, if there is one.
  std::optional<V> to_fold(const V& n, std::size_t i) const {
    if (!rod(main_).along(n).on_fold) return rod(i).on_fold(n);
    const V& axis = rod(main_).shape.axis;
    const bool turned = axis.dot(rod(i).shape.axis) < 0;
    const V other = turned ? V(-rod(i).shape.axis) : rod(i).shape.axis, off = other - axis, across = axis.cross(off);
    const S s = rod(main_).fold_sin, t = turned ? -rod(i).fold_sin : rod(i).fold_sin, square = across.squaredNorm(), less = off.squaredNorm() / 2;
    const S along = (s - t + t * less) / square, along_other = (t - s + s * less) / square, rest = 1 - along * s - along_other * t;
    if (!(square > 0) || !(rest >= 0)) return std::nullopt;
    const V unit = across / std::sqrt(square), there = along * axis + along_other * other + std::copysign(std::sqrt(rest), unit.dot(n)) * unit;
    return there.normalized();
  }

  template <class Step>
  V moved(S most, const Step& step) const {
    const RodHeights<S>& nearest = models_[stays_ ? 2 : 0];
    const auto leads_to = [&](const V& there) { return (there - d_).norm() <= most && nearest.falls_along(there - d_); };
    for (std::size_t i = 0; i < parts_->rod_count; ++i) {
      const V face = d_.dot(rod(i).shape.axis) > 0 ? rod(i).shape.axis : V(-rod(i).shape.axis);
      if (i != main_ && d_ != face && leads_to(face)) return face;
    }
    V n = step(nearest);
    for (std::size_t i = 0; i < parts_->rod_count; ++i) {
      if (i == main_ || !rod(i).folds()) continue;
      if (stays_ && between_[i]) {
        n = to_fold(n, i).value_or(d_);
        continue;
      }
      const bool beyond = rod(i).end_above(n) != ends_[i];
      if (beyond && on_fold_[i])
        if (const V other = step(models_[1]); rod(i).end_above(other) != ends_[i]) return other;
      const std::optional<V> there = to_fold(n, i);
      if (there && (beyond ? (*there - d_).norm() <= most : leads_to(*there))) return *there;
    }
    return n;
  }

  const Parts* parts_ = nullptr;
  V d_, support_;
  Points points_;
  std::array<V, Parts::most> supports_;  ///< of the ellipsoids
  std::array<RodHeights<S>, 3> models_;  ///< of the first rod with the others' higher ends, their lower ones, and discs between them
  std::size_t main_ = 0, count_ = 1;     ///< the first; models
  std::array<int, Parts::most> ends_{};  ///< the others' higher ones
  std::array<bool, Parts::most> between_{}, on_fold_{};
  bool on_main_fold_ = false, stays_ = false;  ///< on the folds of all that have a disc between
};

/// Two sums of ellipsoids and rods.
template <class S>
struct BentSum {
  using Model = SumHeights<S>;
  BentParts<S> parts;

  /// Unset where one is none.
  template <class Difference>
  static std::optional<BentSum> of(const Difference& difference) {
    if constexpr (Difference::D == 3 && requires { difference.a().core(), difference.b().core(); }) {
      BentSum sum;
      if (!sum.parts.add(difference.a().core(), Matrix<3, S>::Identity(), 0) || !sum.parts.add(difference.b().core(), difference.rotation(), 1)) return std::nullopt;
      sum.parts.middles[1] -= difference.position();
      if (sum.parts.rod_count + sum.parts.ellipsoid_count == 0) return std::nullopt;  // two points
      sum.parts.have_a_rod();
      return sum;
    }
    return std::nullopt;
  }

  template <class Point>
  Model model(const Vector<3, S>& d, const Point& point) const { return Model(parts, d, {Vector<3, S>(point.a), Vector<3, S>(-point.b)}); }
  /// Of A and B, that are apart along d as far as anything of them is.
  template <class Point>
  SatWitnesses<3, S> witnesses(const Model& model, const Point&) const { return {model.points()[0], -model.points()[1]}; }
};

/// In the plane, of whatever is ellipses and what has corners, and sums of such: a corner is a point, and where another takes over the height has a kink that leads upwards, which dividing soon comes to.
template <class S>
struct BentOutline {
  using Model = HeightModel<2, S>;
  static constexpr std::size_t most = BentBodies<2, S>::most;
  std::array<BentBody<2, S>, most> ellipses;
  std::size_t count = 0;

  /// Unset where none is an ellipse, or one is too flat for its bends to be told.
  template <class Difference>
  static std::optional<BentOutline> of(const Difference& difference) {
    if constexpr (Difference::D == 2 && requires { difference.a().core(), difference.b().core(); }) {
      BentOutline found;
      if (found.add(difference.a().core(), Matrix<2, S>::Identity()) && found.add(difference.b().core(), difference.rotation()) && found.count > 0) return found;
    }
    return std::nullopt;
  }

  template <class Point>
  Model model(const Vector<2, S>& d, const Point& point) const {
    BentBodies<2, S> bent;
    for (std::size_t i = 0; i < count; ++i) bent.add(ellipses[i], ellipses[i].greatest);
    return Model(bent, d, point.w);
  }
  template <class Point>
  SatWitnesses<2, S> witnesses(const Model&, const Point& point) const { return {point.a, point.b}; }

 private:
  template <class Core>
  bool add(const Core& core, const Matrix<2, S>& axes) {
    if (const auto* sum = std::get_if<SumCore<2, S>>(&core)) return add(sum->first->core(), axes) && add(sum->second->core(), axes);
    const auto* ellipse = std::get_if<EllipsoidCore<2, S>>(&core);
    if (!ellipse || ellipse->radii.minCoeff() == 0) return true;
    if (!(ellipse->radii.minCoeff() * 1024 > ellipse->radii.maxCoeff()) || count == most) return false;
    ellipses[count++] = BentBody<2, S>::of(*ellipse, axes);
    return true;
  }
};

/// Whether the bends tell how deep they are: of ellipsoids and rods, and sums of such; in the plane of all that has an ellipse.
template <class Difference>
bool has_bends(const Difference& difference) {
  using S = typename Difference::S;
  return BentPair<Difference::D, S>::of(difference) || BentSum<S>::of(difference) || BentOutline<S>::of(difference);
}

}  // namespace gjkdbg
