// What the height of A - B is like about a direction, where one body is an ellipsoid and the other a rod: a cylinder, a cone, a disc, a segment (a capsule's core).
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

/// Heights about a direction, of the pair's whole difference; unit, in body 0's frame.
template <class S>
class RodHeights {
  using V = Vector<3, S>;

 public:
  /// Of A - B, with what is said of B turned about the origin.
  struct Bodies {
    BentBody<3, S> ellipsoid, disc;  ///< the disc, of radius 1, is across the rod's axis
    Revolved<S> rod;
    S fold_sin, fold_cos;  ///< of how far the fold is above the plane across the axis

    bool folds() const { return rod.half > 0 || rod.top != rod.bottom; }
    S radius(int end) const { return end == 0 ? rod.bottom : rod.top; }
    V middle(int end) const { return rod.middle + (end == 0 ? -rod.half : rod.half) * rod.axis; }
  };

  RodHeights() = default;
  /// `w`: A - B's support along the unit direction d; `other`: the ellipsoid's part of it.
  RodHeights(const Bodies& bodies, const V& d, const V& w, const V& other) : bodies_(&bodies), d_(d), other_(other), height_(d.dot(w)) {
    const S rise = d.dot(bodies.rod.axis);
    const V across = d - rise * bodies.rod.axis;
    const S length = across.norm();
    round_ = length > S(1) / 1024, on_face_ = d == bodies.rod.axis || d == -bodies.rod.axis;
    for (int i = 0; i < 2; ++i) {
      V& p = ends_[at(i)] = other + bodies.middle(i);
      if (round_) p += bodies.radius(i) / length * across;
      else p += held(-(p - bodies.rod.axis * bodies.rod.axis.dot(p)), bodies.radius(i));
      models_[at(i)] = model(p, bodies.radius(i));
    }
    higher_ = models_[1].height() > models_[0].height() ? 1 : 0;
    support_ = round_ || on_face_ ? ends_[at(higher_)] : w;
    if (!bodies.folds()) return;
    constexpr S rounding = 4 * std::numeric_limits<S>::epsilon();
    on_fold_ = std::abs(rise - bodies.fold_sin) <= rounding;
    const V step = ends_[at(1 - higher_)] - ends_[at(higher_)], beside = step - d * d.dot(step), slope = ends_[at(higher_)] - d * d.dot(ends_[at(higher_)]);
    const S share = -slope.dot(beside) / beside.squaredNorm();
    if (!(share > 0)) return;
    between_ = share < 1;
    const S k = std::min(share, S(1));
    const V mean = ends_[at(higher_)] + k * step;
    if (between_ && on_fold_) support_ = mean;
    mean_ = model(mean, bodies.radius(higher_) + k * (bodies.radius(1 - higher_) - bodies.radius(higher_)));
  }

  const V& direction() const { return d_; }
  S height() const { return height_; }
  /// Of what A - B reaches farthest along d with, that which lies least beside it; and how far it does.
  const V& support() const { return support_; }
  S slope() const { return (support_ - d_ * d_.dot(support_)).norm(); }

  /// Of the corners, of less than half the sphere.
  template <std::size_t corners>
  S least_among(const std::array<V, corners>& ends) const {
    S least = models_[at(higher_)].least_among(ends);
    if (on_face_) least = std::max(least, about_face().least_above(ends, bodies_->radius(higher_)));
    if (!bodies_->folds()) return least;
    least = std::max(least, models_[at(1 - higher_)].least_among(ends));
    if (between_) least = std::max(least, mean_.least_among(ends));
    if (on_fold_) {
      const V up = (bodies_->rod.axis - bodies_->fold_sin * d_) / bodies_->fold_cos;
      const S turn = bodies_->fold_sin / bodies_->fold_cos;
      least = std::max(least, std::min(models_[1].least_on_one_side(ends, up, turn), models_[0].least_on_one_side(ends, V(-up), -turn)));
    }
    return least;
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

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static V held(const V& x, S most) {
    const S length = x.norm();
    return length > most ? V(x * (most / length)) : x;
  }
  HeightModel<3, S> model(const V& p, S radius) const {
    BentBody<3, S> disc = bodies_->disc;
    disc.greatest = round_ ? radius : S(0);
    return HeightModel<3, S>({bodies_->ellipsoid, disc}, d_, p);
  }
  /// d is its normal.
  HeightModel<3, S> about_face() const { return model(other_ + bodies_->middle(higher_), 0); }
  /// The end on whose side of the fold that is.
  int end_above(const V& n) const { return n.dot(bodies_->rod.axis) > bodies_->fold_sin ? 1 : 0; }
  V on_fold(const V& n) const {
    const V& axis = bodies_->rod.axis;
    const V across = n - axis * axis.dot(n);
    if (is_zero(across)) return n;  // as far from all of it
    return (bodies_->fold_cos * across.stableNormalized() + bodies_->fold_sin * axis).normalized();
  }
  template <class Step>
  V moved(S most, const Step& step) const {
    const HeightModel<3, S>& model = models_[at(higher_)];
    const V& axis = bodies_->rod.axis;
    const V face = d_.dot(axis) > 0 ? axis : V(-axis), fold = bodies_->folds() ? on_fold(d_) : d_;
    const auto leads_to = [&](const V& there) { return (there - d_).norm() <= most && model.falls_along(there - d_); };
    if (round_ && leads_to(face)) return face;
    const V n = step(model);
    if (!bodies_->folds() || (!(on_fold_ && between_) && end_above(n) == higher_ && !leads_to(fold))) return n;
    if (on_fold_ && !between_)
      if (const V other = step(models_[at(1 - higher_)]); end_above(other) != higher_) return other;
    return on_fold(between_ ? step(mean_) : n);
  }

  const Bodies* bodies_ = nullptr;
  V d_, other_, support_;
  S height_ = 0;
  std::array<V, 2> ends_;  ///< the support of A - B with the rod's bottom, its top alone
  std::array<HeightModel<3, S>, 2> models_;
  HeightModel<3, S> mean_;  ///< of a disc between them
  int higher_ = 0;
  bool round_ = false, on_face_ = false, on_fold_ = false, between_ = false;
};

/// An ellipsoid and a rod, in body 0's frame.
template <class S>
struct RodPair {
  using Model = RodHeights<S>;
  typename Model::Bodies bodies;
  bool rod_is_b;

  /// Unset where they are not, or the ellipsoid is too flat for its bends to be told.
  template <class Difference>
  static std::optional<RodPair> of(const Difference& difference) {
    if constexpr (Difference::D == 3 && requires { difference.a().core(), difference.b().core(); }) {
      const auto a = revolved<S>(difference.a().core()), b = revolved<S>(difference.b().core());
      const Matrix<3, S> none = Matrix<3, S>::Identity();
      if (b && is_rod(*b))
        if (const auto round = BentPair<3, S>::bent(difference.a().core(), none); round && round->greatest > 0) {
          const Revolved<S> rod = b->placed(difference.rotation(), difference.position());
          return RodPair{of_bodies(*round, {-rod.axis, -rod.middle, rod.top, rod.bottom, rod.half}), true};
        }
      if (a && is_rod(*a))
        if (const auto round = BentPair<3, S>::bent(difference.b().core(), difference.rotation()); round && round->greatest > 0) return RodPair{of_bodies(*round, *a), false};
    }
    return std::nullopt;
  }

  template <class Point>
  Model model(const Vector<3, S>& d, const Point& point) const {
    return Model(bodies, d, point.w, rod_is_b ? Vector<3, S>(point.a) : Vector<3, S>(-point.b));
  }
  /// Of A and B, that are apart along d as far as anything of them is.
  template <class Point>
  SatWitnesses<3, S> witnesses(const Model& model, const Point& point) const {
    const Vector<3, S>& w = model.support();
    if (rod_is_b) return {point.a, point.a - w};
    return {point.b + w, point.b};
  }

 private:
  static bool is_rod(const Revolved<S>& body) { return !body.ellipse() && !is_zero(body.axis); }
  static typename Model::Bodies of_bodies(const BentBody<3, S>& ellipsoid, const Revolved<S>& rod) {
    const Vector<3, S> e = rod.axis.unitOrthogonal();
    BentBody<3, S> disc{};
    disc.inverse << e.transpose(), rod.axis.cross(e).transpose(), rod.axis.transpose();
    disc.squares = {1, 1, 0}, disc.greatest = 1;
    const S rise = 2 * rod.half, taper = rod.bottom - rod.top, side = std::hypot(rise, taper);
    return {ellipsoid, disc, rod, side > 0 ? taper / side : S(0), side > 0 ? rise / side : S(1)};
  }
};

/// Whether the bends tell how deep they are: an ellipsoid with another, with a ball, or with a rod.
template <class Difference>
bool has_bends(const Difference& difference) {
  using S = typename Difference::S;
  return BentPair<Difference::D, S>::of(difference) || RodPair<S>::of(difference);
}

}  // namespace gjkdbg
