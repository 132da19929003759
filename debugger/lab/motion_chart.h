// Motion, speed against accuracy: the cast's methods at several tolerances, the integrators at several steps.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shapes/scene.h"

namespace gjkdbg {

struct MotionPoint {
  std::string family, method;
  double parameter = 0;     ///< the tolerance of a cast, the step of an integrator
  double nanoseconds = 0;   ///< a cast; a step
  double worst_error = 0;   ///< how early the worst time of impact is; how far the energy drifts in 2 units of time, relative
  int late = 0;             ///< times after the true one, by more than 1e-12: none
  double queries = 0;       ///< supports a cast; 0 for integrators
};

/// `go_on`, asked after each of `motion_point_count`: false to stop, and what was measured until then is returned.
std::vector<MotionPoint> motion_points(bool quick, const std::function<bool()>& go_on);
int motion_point_count(bool quick);

/// A body in space, where it is and how it moves.
Body moving(const Shape& shape, const Vector<3, double>& position, const Vector<3, double>& velocity, const Vector<3, double>& spin);

struct CastScene {
  Scene scene;
  double time;  ///< of impact, by bisection
};

/// Pairs in space that meet: "balls", "boxes", "boxes, turning". The same ones every time.
std::vector<CastScene> cast_scenes(const std::string& family, int count);

}  // namespace gjkdbg
