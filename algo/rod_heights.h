// What the height of A - B is like about a direction, where one of what it is a sum of is a rod: a cylinder, a cone, a disc, a segment (a capsule's core), and the rest bends as ellipsoids do.
//
// A rod is the hull of two discs across one axis, of radii that may be zero. Its height is the greater of theirs, and a disc is an ellipsoid without height, whose bends algo/height_model.h knows. The
// discs are as high as each other along a circle of directions about the axis, those of the rod's side: there is a fold, and A - B's nearest points are often on it, all along the side. About a direction d
// no height is below
//
//   that of one disc, or of a disc between them, p = (1 - k) first + k second, which is within the rod: k is chosen so that the slopes across the fold cancel, which tells most where both bodies
//   together bend more than a ball about the origin does;
//   the lower of both, each on its own side of the fold, where d lies on it (HeightModel::least_on_one_side): the slopes there lead upwards on both sides, whatever the bends.
//
// With d on the fold, d . axis = sin(a), and n = cos(s) d + sin(s) t, u = q t as there, the directions above the fold, n . axis >= sin(a), are those where for x, the part of u towards the axis,
//
//   sin(s) (x / q) cos(a) >= sin(a) (1 - cos(s)),  so  x cos(s / 2) >= tan(a) q^2 / 2
//
// The nearer to the axis, the more a disc's bend changes along the fold. But its height depends on z = n . axis alone, as that of a spheroid about the axis does, of radii a across it and c along it:
// f = sqrt(a^2 + (c^2 - a^2) z^2), of a disc c = 0. For c < a it is concave: from the fold's z0 to z1, the farthest that is asked for, no lower than its chord; otherwise than its tangent at z0. Either way than
//
//   b + k z,   k = (c^2 - a^2) (z0 + z1) / (f(z0) + f(z1))   or   (c^2 - a^2) z0 / f(z0),   b = f(z0) - k z0
//
// which is a ball's of radius b about the point k axis, and bends alike everywhere: a bound that is exact all along the fold.
//
// Next to the axis a disc bends without bound, and all of it is as far along the axis itself: there a point of the disc is taken, the one where the slope vanishes, if there is one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "algo/height_model.h"
#include "algo/revolution_sat.h"

namespace gjkdbg {

/// How far along an axis directions are at most towards its end: of the spherical polygon with these corners, a mean of them over its length, which is no less than one's part along d.
template <class S, std::size_t corners>
S farthest_rise(const Vector<3, S>& axis, int end, const std::array<Vector<3, S>, corners>& ends, const Vector<3, S>& d) {
  const S sign = end == 0 ? S(-1) : S(1);
  S rise = -1, ahead = 1;
  for (const Vector<3, S>& n : ends) rise = std::max(rise, sign * n.dot(axis)), ahead = std::min(ahead, d.dot(n));
  if (rise > 0) rise = ahead > rise ? rise / ahead : S(1);
  return sign * rise;
}

/// A rod's two discs, and the fold between them.
template <class S>
struct BentRod {
  using V = Vector<3, S>;

  Revolved<S> shape;
  BentBody<3, S> disc;   ///< of radius 1, across the rod's axis
  S fold_sin, fold_cos;  ///< of how far the fold is above the plane across the axis

  static BentRod of(const Revolved<S>& rod) {
    const V e = rod.axis.unitOrthogonal();
    BentBody<3, S> disc = BentBody<3, S>::point();
    disc.inverse << e.transpose(), rod.axis.cross(e).transpose(), rod.axis.transpose();
    disc.squares = {1, 1, 0}, disc.greatest = 1;
    const S rise = 2 * rod.half, taper = rod.bottom - rod.top, side = std::hypot(rise, taper);
    return {rod, disc, side > 0 ? taper / side : S(0), side > 0 ? rise / side : S(1)};
  }

  /// With the disc of a rod about the same axis, in whichever direction: both ends are larger by it.
  BentRod with_disc(const V& middle, S radius) const {
    BentRod sum = *this;
    sum.shape.middle += middle, sum.shape.top += radius, sum.shape.bottom += radius;
    return sum;
  }
  /// Whether what is of revolution about that axis (zero: any) is so about this one, within rounding; or nearly.
  bool about(const V& axis) const { return shape.axis.cross(axis).norm() <= 4 * std::numeric_limits<S>::epsilon(); }
  bool nearly_about(const V& axis) const { return shape.axis.cross(axis).norm() <= S(1) / 64; }
  /// That axis, or the rod's for none, the way the rod's leads.
  V along_axis(const V& axis) const { return is_zero(axis) ? shape.axis : axis.dot(shape.axis) < 0 ? V(-axis) : axis; }

  bool folds() const { return shape.half > 0 || shape.top != shape.bottom; }
  S radius(int end) const { return end == 0 ? shape.bottom : shape.top; }
  V middle(int end) const { return shape.middle + (end == 0 ? -shape.half : shape.half) * shape.axis; }
  /// Of the fold's circle, at d on it: across d and the circle, towards the axis.
  V above_fold(const V& d) const { return (shape.axis - fold_sin * d) / fold_cos; }
  /// The end on whose side of the fold that is.
  int end_above(const V& n) const { return n.dot(shape.axis) > fold_sin ? 1 : 0; }
  V on_fold(const V& n) const {
    const V across = n - shape.axis * shape.axis.dot(n);
    if (is_zero(across)) return n;  // as far from all of it
    return (fold_cos * across.stableNormalized() + fold_sin * shape.axis).normalized();
  }

  /// Where a direction is of it.
  struct Seen {
    V outwards = V::Zero();  ///< unit, across the axis, where the discs are round: not next to the axis
    bool round = false, on_face = false, on_fold = false;
  };
  Seen along(const V& d) const {
    constexpr S rounding = 4 * std::numeric_limits<S>::epsilon();
    const S rise = d.dot(shape.axis);
    V across = d - rise * shape.axis;
    across -= shape.axis * shape.axis.dot(across);  // next to the axis, of what rounding left of it
    const S length = across.norm();
    const bool round = length > S(1) / 1024;
    return {round ? V(across / length) : V(V::Zero()), round, d == shape.axis || d == -shape.axis, folds() && std::abs(rise * fold_cos - length * fold_sin) <= rounding};
  }
  /// Of an end, what is farthest along d; next to the axis the point with which the slope vanishes, or that is nearest to it, `rest` the other body's.
  V point(int end, const Seen& seen, const V& rest) const {
    if (seen.round) return middle(end) + radius(end) * seen.outwards;
    const V all = rest + middle(end);
    return middle(end) + held(-(all - shape.axis * shape.axis.dot(all)), radius(end));
  }
  /// What a disc between the ends bends by: nothing next to the axis, where it bends without bound.
  void add_disc(BentBodies<3, S>& bends, S radius, const Seen& seen) const {
    if (seen.round) bends.add(disc, radius);
  }

 private:
  static V held(const V& x, S most) {
    const S length = x.norm();
    return length > most ? V(x * (most / length)) : x;
  }
};

/// All but a rod, of a sum, and what of it is no spheroid, or disc, nearly about the rod's axis.
template <class S>
struct BesideRod {
  static constexpr std::size_t most = 4;
  struct Spheroid {
    Vector<3, S> axis;  ///< the way the rod's leads
    S across, along;    ///< squared radii
  };
  BentBodies<3, S> bends, bends_off_axis;
  Vector<3, S> support, support_off_axis;  ///< along the direction that is asked for
  std::array<Spheroid, 2 * most> spheroids;
  std::size_t count = 0;
};

/// Heights about a direction, of the pair's whole difference; unit, in body 0's frame.
template <class S>
class RodHeights {
  using V = Vector<3, S>;

 public:
  RodHeights() = default;
  /// Of A - B. `w`: its support along the unit direction d. Keeps pointers to what bends.
  RodHeights(const BentRod<S>& rod, const BesideRod<S>& others, const V& d, const V& w) : rod_(rod), beside_(others), d_(d), height_(d.dot(w)), seen_(rod.along(d)) {
    for (int i = 0; i < 2; ++i) {
      ends_[at(i)] = others.support + rod.point(i, seen_, others.support);
      models_[at(i)] = model(ends_[at(i)], rod.radius(i));
    }
    higher_ = models_[1].height() > models_[0].height() ? 1 : 0;
    support_ = seen_.round || seen_.on_face ? ends_[at(higher_)] : w;
    if (!rod.folds()) return;
    const V step = ends_[at(1 - higher_)] - ends_[at(higher_)], beside = step - d * d.dot(step), slope = ends_[at(higher_)] - d * d.dot(ends_[at(higher_)]);
    const S share = -slope.dot(beside) / beside.squaredNorm();
    if (!(share > 0)) return;
    between_ = share < 1;
    const S k = std::min(share, S(1));
    const V mean = ends_[at(higher_)] + k * step;
    if (between_ && seen_.on_fold) support_ = mean;
    mean_ = model(mean, rod.radius(higher_) + k * (rod.radius(1 - higher_) - rod.radius(higher_)));
  }

  const V& direction() const { return d_; }
  S height() const { return height_; }
  /// Of what A - B reaches farthest along d with, that which lies least beside it; and how far it does.
  const V& support() const { return support_; }
  S slope() const { return (support_ - d_ * d_.dot(support_)).norm(); }

  /// Of the corners, of less than half the sphere.
  template <std::size_t corners>
  S least_among(const std::array<V, corners>& ends) const {
    const S least = least_on_both_sides(ends);
    return seen_.on_fold ? std::max(least, std::min(least_on_side(0, ends), least_on_side(1, ends))) : least;
  }
  template <std::size_t corners>
  S least_on_both_sides(const std::array<V, corners>& ends) const {
    S least = models_[at(higher_)].least_among(ends);
    if (seen_.on_face) least = std::max(least, model(beside_.support + rod_.middle(higher_), 0).least_above(ends, rod_.radius(higher_)));
    if (rod_.folds()) least = std::max(least, models_[at(1 - higher_)].least_among(ends));
    return between_ ? std::max(least, mean_.least_among(ends)) : least;
  }
  /// Of those on this end's side of the fold, with d on it; infinite where there are none.
  template <std::size_t corners>
  S least_on_side(int end, const std::array<V, corners>& ends) const {
    const S farthest = farthest_rise<S>(rod_.shape.axis, end, ends, d_), turn = rod_.fold_sin / rod_.fold_cos;
    if (end == 0 ? farthest > rod_.fold_sin + rounding : farthest < rod_.fold_sin - rounding) return std::numeric_limits<S>::infinity();
    const V above = rod_.above_fold(d_);
    const auto bound = [&](const HeightModel<3, S>& model) { return end == 0 ? model.least_on_one_side(ends, V(-above), -turn) : model.least_on_one_side(ends, above, turn); };
    const S least = bound(models_[at(end)]);
    return rod_.radius(end) > 0 || beside_.count > 0 ? std::max(least, bound(about_fold(end, ends))) : least;
  }
  template <std::size_t corners>
  S chord(const std::array<V, corners>& ends) const {
    return models_[0].reach(ends).chord;
  }

  /// Newton's step to where the height is least: of the end that is higher there, or else on the fold.
  V step(S most) const {
    return moved(most, [&](const HeightModel<3, S>& model) { return model.step(most); });
  }
  V step_down(S most) const {
    return moved(most, [&](const HeightModel<3, S>& model) { return model.step_down(most); });
  }

  /// Whether it falls all the way to d + v, as far as slope and bends say.
  bool falls_along(const V& v) const { return (stays_on_fold() ? mean_ : models_[at(higher_)]).falls_along(v); }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  bool stays_on_fold() const { return seen_.on_fold && between_; }
  HeightModel<3, S> model(const V& p, S radius) const {
    BentBodies<3, S> all = beside_.bends;
    rod_.add_disc(all, radius, seen_);
    return HeightModel<3, S>(all, d_, p);
  }
  /// Of a ball and a point, no higher than that end, and all that is nearly about its axis, on its side of the fold. Along an axis that is not quite the rod's, directions there come to no more than the fold's z and
  /// what the axes differ by.
  template <std::size_t corners>
  HeightModel<3, S> about_fold(int end, const std::array<V, corners>& ends) const {
    const S radius = rod_.radius(end);
    S ball = 0;
    V point = beside_.support_off_axis + rod_.middle(end);
    const auto add = [&](const V& axis, S across, S along) {
      const S more = along - across, off = (axis - rod_.shape.axis).norm(), z = d_.dot(axis);
      const auto height = [&](S x) { return std::sqrt(std::max(S(0), across + more * x * x)); };
      S far = farthest_rise<S>(axis, end, ends, d_), near = std::clamp(end == 0 ? rod_.fold_sin + off : rod_.fold_sin - off, S(-1), S(1));
      if (end == 0 ? far > near : far < near) far = near;
      const S slope = more > 0 ? more * z / height(z) : height(far) + height(near) > 0 ? more * (near + far) / (height(far) + height(near)) : S(0);
      ball += std::max(S(0), more > 0 ? height(z) - slope * z : height(near) - slope * near), point += slope * axis;
    };
    if (radius > 0) add(rod_.shape.axis, radius * radius, 0);
    for (std::size_t i = 0; i < beside_.count; ++i) add(beside_.spheroids[i].axis, beside_.spheroids[i].across, beside_.spheroids[i].along);
    static const BentBody<3, S> unit_ball = BentBody<3, S>::unit_ball();
    BentBodies<3, S> all = beside_.bends_off_axis;
    all.add(unit_ball, ball);
    return HeightModel<3, S>(all, d_, point + ball * d_);
  }
  template <class Step>
  V moved(S most, const Step& step) const {
    const HeightModel<3, S>& model = models_[at(higher_)];
    const V& axis = rod_.shape.axis;
    const V face = d_.dot(axis) > 0 ? axis : V(-axis), fold = rod_.folds() ? rod_.on_fold(d_) : d_;
    const auto leads_to = [&](const V& there) { return (there - d_).norm() <= most && model.falls_along(there - d_); };
    if (seen_.round && leads_to(face)) return face;
    const V n = step(model);
    if (!rod_.folds() || (!stays_on_fold() && rod_.end_above(n) == higher_ && !leads_to(fold))) return n;
    if (seen_.on_fold && !between_)
      if (const V other = step(models_[at(1 - higher_)]); rod_.end_above(other) != higher_) return other;
    return rod_.on_fold(between_ ? step(mean_) : n);
  }

  static constexpr S rounding = 4 * std::numeric_limits<S>::epsilon();
  BentRod<S> rod_;
  BesideRod<S> beside_;
  V d_, support_;
  S height_ = 0;
  typename BentRod<S>::Seen seen_;
  std::array<V, 2> ends_;  ///< the support of A - B with the rod's bottom, its top alone
  std::array<HeightModel<3, S>, 2> models_;
  HeightModel<3, S> mean_;  ///< of a disc between them
  int higher_ = 0;
  bool between_ = false;
};

}  // namespace gjkdbg
