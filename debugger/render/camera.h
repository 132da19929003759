// The camera of a view: orbits a target in 3D, slides over the plane in 2D and 1D.
#pragma once

#include <algorithm>
#include <cmath>

#include "debugger/render/display_mesh.h"

namespace gjkdbg {

struct Camera {
  double yaw = 0.6, pitch = 0.45;  ///< radians
  ViewPoint target = ViewPoint::Zero();
  double radius = 1;  ///< scene length that half the shorter side of the view spans
  bool flat = false;  ///< look straight down z: 1D and 2D scenes
};

/// A view's rectangle in pixels.
struct ViewRectangle {
  double x = 0, y = 0, width = 1, height = 1;
  bool contains(double px, double py) const { return px >= x && px < x + width && py >= y && py < y + height; }
};

struct Projected {
  double x = 0, y = 0;
  double depth = 0;  ///< larger is nearer
};

/// A camera over a rectangle.
class Projection {
 public:
  Projection(const Camera& camera, const ViewRectangle& rectangle) : camera_(camera), rectangle_(rectangle) {
    const double cy = std::cos(camera.yaw), sy = std::sin(camera.yaw), cp = std::cos(camera.pitch), sp = std::sin(camera.pitch);
    if (camera.flat) {
      right_ = ViewPoint::UnitX(), up_ = ViewPoint::UnitY(), towards_ = ViewPoint::UnitZ();
    } else {
      towards_ = ViewPoint(sy * cp, sp, cy * cp);
      right_ = ViewPoint(cy, 0, -sy);
      up_ = towards_.cross(right_);
    }
    scale_ = std::min(rectangle.width, rectangle.height) / 2 / camera.radius;
  }

  Projected operator()(const ViewPoint& p) const {
    const ViewPoint v = p - camera_.target;
    const double depth = v.dot(towards_) / camera_.radius;
    // A mild perspective: the eye is six view radii away.
    const double s = camera_.flat ? scale_ : scale_ * eye_ / std::max(0.2, eye_ - depth);
    return {rectangle_.x + rectangle_.width / 2 + s * v.dot(right_), rectangle_.y + rectangle_.height / 2 - s * v.dot(up_), depth};
  }

  /// The scene vector in the picture's plane that a move in pixels stands for.
  ViewPoint move(double dx, double dy) const { return (right_ * dx - up_ * dy) / scale_; }
  const ViewPoint& target() const { return camera_.target; }
  const ViewPoint& towards() const { return towards_; }
  const ViewPoint& right() const { return right_; }
  const ViewPoint& up() const { return up_; }
  double pixels_per_length() const { return scale_; }
  const ViewRectangle& rectangle() const { return rectangle_; }
  bool faces_eye(const ViewPoint& normal, const ViewPoint& point) const {
    return camera_.flat || normal.dot(camera_.target + towards_ * (eye_ * camera_.radius) - point) > 0;
  }

 private:
  static constexpr double eye_ = 6;
  Camera camera_;
  ViewRectangle rectangle_;
  ViewPoint right_, up_, towards_;
  double scale_;
};

}  // namespace gjkdbg
