// Which ellipsoids are divided by their bends (algo/ellipsoid_depth.h), for EPA is known to take long.
#pragma once

#include <optional>

#include "algo/height_model.h"
#include "algo/revolution_sat.h"

namespace gjkdbg {

/// Spheroids about nearly one line, which are divided by their bends instead of by sections.
template <class Difference>
std::optional<BentPair<3, typename Difference::S>> tilted_spheroids(const Difference& difference) {
  using S = typename Difference::S;
  const auto pair = BentPair<3, S>::of(difference);
  return pair && RevolvedPair<S>::of_tilted(difference) ? pair : std::nullopt;
}

}  // namespace gjkdbg
