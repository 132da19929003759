// The largest balls that roll within two bodies: by which it is told whether these are nearly balls (algo/near_balls.h).
#pragma once

#include <optional>
#include <variant>

#include "shapes/convex.h"

namespace gjkdbg {

/// Radii of the largest balls that roll within A and B.
template <class S>
struct RollingBalls {
  S a, b;

  /// Unset where a body is neither an ellipsoid nor a point, neither is an ellipsoid, or the balls are less than half of the bodies.
  template <class Difference>
  static std::optional<RollingBalls> of(const Difference& difference) {
    const std::optional<S> a = within(difference.a()), b = within(difference.b());
    if (!a || !b || !(2 * (*a + *b) > static_cast<S>(difference.a().extent() + difference.b().extent()))) return std::nullopt;
    return RollingBalls{*a, *b};
  }

 private:
  template <int D>
  static std::optional<S> within(const Convex<D, S>& body) {
    if (std::holds_alternative<PointCore<D, S>>(body.core())) return S(0);
    const auto* ellipsoid = std::get_if<EllipsoidCore<D, S>>(&body.core());
    if (!ellipsoid) return std::nullopt;
    const S least = ellipsoid->radii.minCoeff();
    return least * (least / ellipsoid->radii.maxCoeff());
  }
};

}  // namespace gjkdbg
