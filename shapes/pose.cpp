#include "shapes/pose.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "shapes/error.h"

namespace gjkdbg {
namespace {

using M3 = Eigen::Matrix3d;
using V3 = Eigen::Vector3d;
using std::numbers::pi;

[[noreturn]] void not_a_rotation(const std::string& message, const char* where) { throw Error("not-a-rotation", message, where); }

/// Cosine and sine, exact where the angle is the double nearest to a multiple of a quarter turn.
struct Turn {
  double c, s;
  explicit Turn(double angle) : c(std::cos(angle)), s(std::sin(angle)) {
    const double quarters = std::nearbyint(angle / (pi / 2));
    if (std::abs(quarters) > 64 || quarters * (pi / 2) != angle) return;
    static constexpr double cosines[] = {1, 0, -1, 0};
    const int k = static_cast<int>(quarters) & 3;
    c = cosines[k], s = cosines[(k + 3) & 3];
  }
};

M3 about_axis(int axis, double angle) {
  const Turn turn(angle);
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  M3 m = M3::Identity();
  m(j, j) = turn.c, m(j, k) = -turn.s, m(k, j) = turn.s, m(k, k) = turn.c;
  return m;
}

int axis_index(char c) { return c == 'x' ? 0 : c == 'y' ? 1 : c == 'z' ? 2 : -1; }

void check_order(const std::string& order) {
  const bool valid = order.size() == 3 && std::all_of(order.begin(), order.end(), [](char c) { return axis_index(c) >= 0; }) &&
                     order[0] != order[1] && order[1] != order[2];
  if (!valid) not_a_rotation("order must name three axes, no axis twice in a row, like \"xyz\" or \"zxz\"", "/euler/order");
}

/// R = I + 2 (w K + K K) / |q|^2 with K the cross-product matrix of (x, y, z), all over |q|^2: every entry is a quotient of
/// two sums of products, which are exact for small integer quaternions, and is then rounded once.
M3 from_quaternion(const std::array<double, 4>& q) {
  const auto [w, x, y, z] = q;
  const double squared = w * w + x * x + y * y + z * z;
  M3 m;
  m << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return m / squared;
}

/// Rodrigues' formula: R = c I + s [u] + (1 - c) u u^T.
M3 from_axis_angle(const V3& axis, double angle) {
  const V3 u = axis.stableNormalized();
  for (int i = 0; i < 3; ++i)
    if (std::abs(u[i]) == 1) return about_axis(i, u[i] * angle);
  const Turn turn(angle);
  M3 cross;
  cross << 0, -u[2], u[1], u[2], 0, -u[0], -u[1], u[0], 0;
  return turn.c * M3::Identity() + turn.s * cross + (1 - turn.c) * u * u.transpose();
}

AnyMatrix gram_schmidt(const AnyMatrix& m) {
  AnyMatrix q = m;
  for (int c = 0; c < m.cols(); ++c) {
    for (int round = 0; round < 2; ++round)
      for (int k = 0; k < c; ++k) q.col(c) -= q.col(k) * q.col(k).dot(q.col(c));
    q.col(c) /= q.col(c).norm();
  }
  return q;
}

ResolvedRotation from_matrix(const AnyMatrix& m, int dimension) {
  if (m.rows() != dimension || m.cols() != dimension) {
    const std::string n = std::to_string(dimension);
    not_a_rotation("matrix must have " + n + " rows of " + n + " numbers", "/matrix");
  }
  if (!m.allFinite()) throw Error("non-finite", "must hold finite numbers", "/matrix");
  const double off = (m.transpose() * m - AnyMatrix::Identity(dimension, dimension)).cwiseAbs().maxCoeff();
  if (!(off <= 1e-6)) not_a_rotation("matrix is not orthonormal: off by " + std::to_string(off), "/matrix");
  const double determinant = dimension == 1 ? m(0, 0) : dimension == 2 ? m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0) : M3(m).determinant();
  if (determinant < 0) not_a_rotation("matrix is a reflection (determinant -1)", "/matrix");
  if (off <= 1e-15) return {m, 0};
  const AnyMatrix q = gram_schmidt(m);
  return {q, (q - m).cwiseAbs().maxCoeff()};
}

struct Resolve {
  int dimension;

  void need(int wanted, const char* where) const {
    if (dimension != wanted) not_a_rotation("this notation is for " + std::to_string(wanted) + "D scenes", where);
  }
  ResolvedRotation operator()(std::monostate) const { return {AnyMatrix::Identity(dimension, dimension), 0}; }
  ResolvedRotation operator()(const Quaternion& q) const {
    need(3, "/quaternion");
    double squared = 0, length = 0;  // the length of long ones, too, for the message
    for (const double x : q.wxyz) {
      if (!std::isfinite(x)) throw Error("non-finite", "must hold finite numbers", "/quaternion");
      squared += x * x, length = std::hypot(length, x);
    }
    const double off = std::abs(std::sqrt(squared) - 1);
    if (!(off <= 1e-6)) {
      std::ostringstream text;
      text << std::setprecision(9) << length;
      not_a_rotation("quaternion has length " + text.str() + ", not 1", "/quaternion");
    }
    return {from_quaternion(q.wxyz), off > 1e-15 ? off : 0};
  }
  ResolvedRotation operator()(const RotationMatrix& r) const { return from_matrix(r.rows, dimension); }
  ResolvedRotation operator()(const AxisAngle& a) const {
    need(3, "/axis");
    if (a.axis.size() != 3) not_a_rotation("axis needs 3 numbers", "/axis");
    if (!a.axis.allFinite() || !std::isfinite(a.angle)) throw Error("non-finite", "must be finite", a.axis.allFinite() ? "/angle" : "/axis");
    if (a.axis.isZero(0)) not_a_rotation("axis must not be zero", "/axis");
    return {from_axis_angle(a.axis, a.angle), 0};
  }
  ResolvedRotation operator()(const Euler& e) const {
    need(3, "/euler");
    check_order(e.order);
    AnyMatrix m = M3::Identity();
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite(e.angles[i])) throw Error("non-finite", "must be finite", "/euler/angles");
      const M3 turn = about_axis(axis_index(e.order[i]), e.angles[i]);
      m = e.intrinsic ? M3(M3(m) * turn) : M3(turn * M3(m));
    }
    return {m, 0};
  }
  ResolvedRotation operator()(const PlaneAngle& p) const {
    need(2, "/angle");
    if (!std::isfinite(p.angle)) throw Error("non-finite", "must be finite", "/angle");
    const Turn turn(p.angle);
    AnyMatrix m(2, 2);
    m << turn.c, -turn.s, turn.s, turn.c;
    return {m, 0};
  }
};

}  // namespace

Pose identity_pose(int dimension) {
  return {AnyVector::Zero(dimension), std::monostate{}, AnyMatrix::Identity(dimension, dimension)};
}

ResolvedRotation resolve(const Rotation& rotation, int dimension) { return std::visit(Resolve{dimension}, rotation); }

/// Shepperd 1978: of the four components take the largest from the diagonal, the others from sums and differences.
Quaternion to_quaternion(const AnyMatrix& m) {
  const double t = m(0, 0) + m(1, 1) + m(2, 2);
  std::array<double, 4> squares{t, 2 * m(0, 0) - t, 2 * m(1, 1) - t, 2 * m(2, 2) - t};  // 4 q_i^2 - 1
  const int largest = static_cast<int>(std::max_element(squares.begin(), squares.end()) - squares.begin());
  std::array<double, 4> q{};
  if (largest == 0) {
    q = {1 + t, m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
  } else {
    const int i = largest - 1, j = (i + 1) % 3, k = (i + 2) % 3;
    q[0] = m(k, j) - m(j, k);
    q[1 + i] = 1 + squares[largest];
    q[1 + j] = m(i, j) + m(j, i);
    q[1 + k] = m(i, k) + m(k, i);
  }
  double length = 0;
  for (const double x : q) length += x * x;
  length = std::sqrt(length) * (q[0] < 0 ? -1 : 1);
  for (double& x : q) x /= length;
  return {q};
}

/// From the quaternion, which is well conditioned near half and near no turn alike: angle = 2 atan2(|xyz|, w).
AxisAngle to_axis_angle(const AnyMatrix& matrix) {
  const auto q = to_quaternion(matrix).wxyz;
  const V3 xyz(q[1], q[2], q[3]);
  const double s = xyz.norm();
  AnyVector axis = V3::UnitX();
  if (s > 0) axis = xyz / s;
  return {axis, 2 * std::atan2(s, q[0])};
}

/// Extrinsic turns about a, b, c are intrinsic ones about c, b, a. For intrinsic order i j k with i != k (Tait-Bryan) and
/// e = +1 when ijk is an even permutation: R_ik = e sin(beta), R_ij = -e cos(beta) sin(gamma) and so on; for i = k (proper
/// Euler) with l the third axis: R_ii = cos(beta), R_ij = sin(beta) sin(gamma), …. At gimbal lock only one angle is determined.
Euler to_euler(const AnyMatrix& m, const std::string& order, bool intrinsic) {
  check_order(order);
  std::string o = order;
  if (!intrinsic) std::reverse(o.begin(), o.end());
  const int i = axis_index(o[0]), j = axis_index(o[1]);
  const bool proper = o[0] == o[2];
  const int k = proper ? 3 - i - j : axis_index(o[2]);
  const double e = (j - i + 3) % 3 == 1 ? 1 : -1;
  double alpha, beta, gamma = 0;
  if (proper) {
    const double s = std::hypot(m(i, j), m(i, k));
    beta = std::atan2(s, m(i, i));
    if (s > 1e-12) {
      alpha = std::atan2(m(j, i), -e * m(k, i));
      gamma = std::atan2(m(i, j), e * m(i, k));
    } else {
      alpha = std::atan2(e * m(k, j), m(j, j));
    }
  } else {
    const double c = std::hypot(m(i, i), m(i, j));
    beta = std::atan2(e * m(i, k), c);
    if (c > 1e-12) {
      alpha = std::atan2(-e * m(j, k), m(k, k));
      gamma = std::atan2(-e * m(i, j), m(i, i));
    } else {
      alpha = std::atan2(e * m(k, j), m(j, j));
    }
  }
  Euler result{order, intrinsic, {alpha, beta, gamma}};
  if (!intrinsic) std::swap(result.angles[0], result.angles[2]);
  return result;
}

PlaneAngle to_plane_angle(const AnyMatrix& m) { return {std::atan2(m(1, 0), m(0, 0))}; }

}  // namespace gjkdbg
