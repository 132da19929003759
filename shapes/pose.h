// Where a body is: a position and a rotation, in any of four notations, and the conversions among them.
//
// Conventions: right-handed, angles in radians here (degrees only in files), quaternions w x y z, a rotation
// matrix maps body coordinates to world coordinates (x_world = R x_body + position).
// Euler angles: `order` names the axes in the order the turns are made, e.g. "zxz"; intrinsic turns are about
// the axes of the turning body (R = R_1 R_2 R_3), extrinsic ones about the fixed axes (R = R_3 R_2 R_1).
#pragma once

#include <array>
#include <string>
#include <variant>

#include "shapes/vector.h"

namespace gjkdbg {

struct Quaternion {
  std::array<double, 4> wxyz{1, 0, 0, 0};
};
struct RotationMatrix {
  AnyMatrix rows;  ///< as given; element (r, c) is row r, column c
};
struct AxisAngle {
  AnyVector axis;  ///< 3 numbers, any length but zero
  double angle = 0;
};
struct Euler {
  std::string order = "xyz";
  bool intrinsic = true;
  std::array<double, 3> angles{0, 0, 0};
};
/// 2D: a counter-clockwise turn.
struct PlaneAngle {
  double angle = 0;
};

/// As a scene gives it; monostate: no rotation.
using Rotation = std::variant<std::monostate, Quaternion, RotationMatrix, AxisAngle, Euler, PlaneAngle>;

struct Pose {
  AnyVector position;
  Rotation rotation;  ///< kept for writing the scene back as it was
  AnyMatrix matrix;   ///< the rotation as numbers, always set and orthonormal: what the algorithms use
};

/// The identity pose of a dimension.
Pose identity_pose(int dimension);

struct ResolvedRotation {
  AnyMatrix matrix;
  double correction = 0;  ///< largest change of a matrix element by orthonormalising; of a quaternion, by how much its length was not 1; 0 when exact to rounding
};

/// Any notation to a matrix. Exact for no rotation and for multiples of a quarter turn; quaternions are divided
/// by their length, matrices orthonormalised (Gram-Schmidt from the first column) unless they are so to rounding already.
/// Throws Error("not-a-rotation", …) when a quaternion's length or a matrix' orthonormality is off by more than
/// 1e-6, when the matrix is a reflection, the axis has no direction, or the notation is not one of the dimension; Error("non-finite", …) for NaN and infinity.
ResolvedRotation resolve(const Rotation& rotation, int dimension);

/// Inverse conversions (3D): all describe the same rotation as `matrix` (orthonormal, 3x3).
Quaternion to_quaternion(const AnyMatrix& matrix);  ///< w >= 0
AxisAngle to_axis_angle(const AnyMatrix& matrix);   ///< angle in [0, pi], unit axis (x for the identity)
/// Radians in [-pi, pi], the middle one in [0, pi] or [-pi/2, pi/2]; at gimbal lock the third angle is 0 (extrinsic: the first). Throws Error("not-a-rotation", …)
/// when `order` is none.
Euler to_euler(const AnyMatrix& matrix, const std::string& order, bool intrinsic);
PlaneAngle to_plane_angle(const AnyMatrix& matrix);  ///< 2D

}  // namespace gjkdbg
