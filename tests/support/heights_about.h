// What a model of heights about a direction says of directions near it or anywhere, against the heights themselves.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "tests/support/rod_scenes.h"

namespace gjkdbg {

/// Of a spherical polygon about this direction, of any size: no height there is below what the model says. `what`: to name a failure by.
template <class Model, class Difference>
void expect_none_below(RodScenes& random, const Model& heights, Difference& difference, const Eigen::Vector3d& about, const std::string& what) {
  std::array<Eigen::Vector3d, 4> corners;
  const double size = std::pow(10, random.uniform(-3, -0.01));
  for (Eigen::Vector3d& corner : corners) corner = (about + size * random.uniform(0, 1) * random.direction()).normalized();
  const double least = heights.least_among(corners);
  for (int j = 0; j < 20; ++j) {
    Eigen::Vector3d within = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& corner : corners) within += random.uniform(0, 1) * corner;
    const Eigen::Vector3d n = within.normalized();
    EXPECT_LE(least, n.dot(difference.support(n).w) + 1e-13) << what;
  }
}

}  // namespace gjkdbg
