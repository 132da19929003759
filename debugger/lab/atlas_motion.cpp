// The families of bodies in motion. Gaps by closed forms of the rounded input.
#include <cmath>
#include <limits>

#include "debugger/lab/atlas.h"
#include "debugger/lab/motion_chart.h"

namespace gjkdbg {
namespace {

Scene cast_of(Body a, Body b) {
  a.name = "A", b.name = "B";
  Scene scene;
  scene.query = Query::cast;
  scene.motion = SceneMotion{};
  scene.motion->gravity = AnyVector::Zero(3);
  scene.bodies = {std::move(a), std::move(b)};
  return scene;
}

Shape solid(double x, double y, double z) {
  const Vector<3, double> half(x, y, z);
  return {Box{AnyVector(-half), AnyVector(half), true}, 0};
}

constexpr double never = std::numeric_limits<double>::infinity();

/// A ball of radius r flies along x = -4 + 8 t over a cube whose edge it meets where the centre is r from it: at height h above the top face
/// sqrt(r^2 - h^2) before the edge. Above the face the gap is h - r.
AtlasCase ball_past_edge(double share) {
  const double r = 0.5, y = 1 + r * (1 + share), h = y - 1;
  const auto gap = [=](double time) { return std::hypot(std::max(std::abs(8 * time - 4) - 1, 0.0), h) - r; };
  const double time = h < r ? (3 - std::sqrt((r - h) * (r + h))) / 8 : never;
  Scene scene = cast_of(moving(solid(1, 1, 1), {0, 0, 0}, {0, 0, 0}, {0, 0, 0}), moving({Sphere{r}, 0}, {-4, y, 0}, {8, 0, 0}, {0, 0, 0}));
  return {share, std::move(scene), time, {gap, h - r}};
}

/// A rod of length 2 turns about its middle under a plate; its round end is highest at sin(w t) + r. The plate's lower face, at the difference of
/// its middle and its half, is exact: so is what is left when the rod is upright.
AtlasCase rod_past_plate(double share) {
  const double r = 1.0 / 128, w = 2.4, middle = 1.125 + r + share, lower = middle - 0.125;
  const auto gap = [=](double time) { return lower - (std::abs(std::sin(w * time)) + r); };
  const double least = lower - r - 1, time = least <= 0 ? std::asin(1 + least) / w : never;
  Scene scene = cast_of(moving({Capsule{r, 1, 0}, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, w}), moving(solid(2, 0.125, 2), {0, middle, 0}, {0, 0, 0}, {0, 0, 0}));
  return {share, std::move(scene), time, {gap, least}};
}

}  // namespace

std::vector<AtlasFamily> moving_families(bool quick) {
  AtlasFamily flying{"T1", "a ball that grazes the edge of a cube, or just does not: the time hangs on the root of what is left", {}};
  AtlasFamily turning{"T2", "a turning rod that grazes a plate when upright, or just does not: bounds of its speed are loose", {}};
  for (double share = 1e-2; share > 0.5e-12; share *= quick ? 1e-2 : 1e-1)
    for (const double sign : {1.0, -1.0}) flying.cases.push_back(ball_past_edge(sign * share)), turning.cases.push_back(rod_past_plate(sign * share));
  return {flying, turning};
}

}  // namespace gjkdbg
