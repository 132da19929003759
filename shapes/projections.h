// Projections: for kinds of core that have a formula for it, the point nearest to a given one, and how it moves with that one.
//
// Where p moves by dp, its nearest point x moves by J dp. J is symmetric; it keeps nothing of what is across the boundary, so J = T K T^T with the
// directions T in which x can move, D - 1 of them at most (rows of K for others are zero):
//
//   flat parts        x moves as p does: K = I for T orthonormal
//   about an axis     x turns with p, radius rho against sigma: K = rho / sigma along the turn; the profile's line moves as flat parts do
//   an ellipsoid      p - x = t n, n = (x_i / r_i^2), so dp = dx + t (dx_i / r_i^2) + n dt. With dx = T y, T^T n = 0, and W = diag(1 + t / r_i^2):
//                     T^T dp = (T^T W T) y, and K = (T^T W T)^-1, whatever the basis T
//
// The point of an ellipsoid: x_i = r_i^2 p_i / (r_i^2 + t) with f(t) = sum of (r_i p_i / (r_i^2 + t))^2 = 1, t > 0. Newton's method on 1 / sqrt(f) = 1, which
// is nearly linear (Moré, Sorensen, "Computing a trust region step", SIAM J. Sci. Stat. Comput. 4(3), 1983); exact in one step for a ball.
// f tells t only as well as the long radii do: beside the end of a needle it is 1 to 1e-5 where t is still off by more than t, and more than the square of the
// least radius, by which x moves. So a step is the last one only where it is short beside both.
//
// Hart, "Distance to an ellipsoid", Graphics Gems IV (1994); Eberly, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid" (2013).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "shapes/convex.h"

namespace gjkdbg {

/// In the core's frame.
template <int D, class S>
struct Projection {
  static constexpr int tangents = D > 1 ? D - 1 : 1;
  Vector<D, S> point;
  std::array<Vector<D, S>, tangents> tangent;  ///< T
  S k00, k01, k11;                             ///< K, symmetric
  int flat;                                    ///< how many of the first tangents are straight lines in the core's border
  bool inside;                                 ///< the point itself is of the core: the tangents say nothing
};

/// Where the search for an ellipsoid's t begins: where the last one for the same core ended; 0: there was none.
template <class S>
struct ProjectionStart {
  S t = 0;
};

template <int D, class S>
void fixed_point(const Vector<D, S>& x, Projection<D, S>& out) {
  out.point = x;
  for (auto& v : out.tangent) v.setZero();
  out.k00 = out.k01 = out.k11 = 0, out.flat = 0, out.inside = false;
}

/// A point is its own nearest.
template <int D, class S>
void held_point(const Vector<D, S>& p, Projection<D, S>& out) {
  fixed_point(p, out);
  out.inside = true;
}

template <int D, class S>
void project(const PointCore<D, S>&, const Vector<D, S>& p, ProjectionStart<S>&, Projection<D, S>& out) {
  fixed_point<D, S>(Vector<D, S>::Zero(), out);
  out.inside = p.isZero(0);
}

template <int D, class S>
void project(const SegmentCore<D, S>& core, const Vector<D, S>& p, ProjectionStart<S>&, Projection<D, S>& out) {
  fixed_point<D, S>(Vector<D, S>::Zero(), out);
  const S y = p[core.axis], along = std::clamp(y, -core.half_height, core.half_height);
  out.point[core.axis] = along, out.tangent[0][core.axis] = 1;
  out.k00 = y == along, out.flat = y == along;
  out.inside = out.point == p;
}

template <int D, class S>
void project(const BoxCore<D, S>& core, const Vector<D, S>& p, ProjectionStart<S>&, Projection<D, S>& out) {
  fixed_point<D, S>(p, out);
  int free = 0;
  for (int i = 0; i < D; ++i) {
    out.point[i] = std::clamp(p[i], core.corners[1][i], core.corners[0][i]);
    if (out.point[i] != p[i]) continue;
    if (free < Projection<D, S>::tangents) out.tangent[static_cast<std::size_t>(free)][i] = 1;
    ++free;
  }
  out.k00 = free > 0, out.k11 = free > 1, out.flat = free;
  out.inside = free == D;
}

/// A disc's inside, square to the axis.
template <class S>
void on_disc(int i, int j, Projection<3, S>& out) {
  out.tangent[0][i] = 1, out.tangent[1][j] = 1;
  out.k00 = out.k11 = 1, out.flat = 2;
}

/// The point at distance rho from the axis, on p's side; `one_over_sigma`: 1 / p's own distance from the axis, 0 on it. The second tangent leads round.
template <class S>
void on_rim(int i, int j, const Vector<3, S>& p, S rho, S one_over_sigma, Projection<3, S>& out) {
  const S ci = p[i] * one_over_sigma, cj = p[j] * one_over_sigma;
  out.point[i] = rho * ci, out.point[j] = rho * cj;
  out.tangent[1][i] = -cj, out.tangent[1][j] = ci;
  out.k11 = rho * one_over_sigma;
}

template <class S>
void project(const CylinderCore<S>& core, const Vector<3, S>& p, ProjectionStart<S>&, Projection<3, S>& out) {
  const int axis = core.axis, i = (axis + 1) % 3, j = (axis + 2) % 3;
  fixed_point<3, S>(p, out);
  const S y = std::clamp(p[axis], -core.half_height, core.half_height), squared = p[i] * p[i] + p[j] * p[j];
  out.point[axis] = y;
  if (squared > core.radius * core.radius) {
    on_rim(i, j, p, core.radius, 1 / std::sqrt(squared), out);
    out.tangent[0][axis] = 1, out.k00 = y == p[axis], out.flat = y == p[axis];
  } else {
    on_disc(i, j, out);
    out.inside = y == p[axis];
  }
}

/// The side's profile leads from the rim (radius, -h) to the apex (0, h): with c = (-radius, 2 h), its point for (sigma, y) is at
/// t = ((sigma - radius, y + h) . c) / c . c of the way.
template <class S>
void project(const ConeCore<S>& core, const Vector<3, S>& p, ProjectionStart<S>&, Projection<3, S>& out) {
  const int axis = core.axis, i = (axis + 1) % 3, j = (axis + 2) % 3;
  const S h = core.half_height, y = p[axis], sigma = std::sqrt(p[i] * p[i] + p[j] * p[j]);
  fixed_point<3, S>(p, out);
  const bool under = y < -h;
  if (sigma <= core.radius && (under || (y <= h && 2 * h * (sigma - core.radius) + core.radius * (y + h) <= 0))) {
    if (under) out.point[axis] = -h, on_disc(i, j, out);
    else out.inside = true;
    return;
  }
  const S squared = core.radius * core.radius + 4 * h * h;
  const S t = squared > 0 ? ((core.radius - sigma) * core.radius + 2 * h * (y + h)) / squared : S(1);
  out.point.setZero();
  if (!(t < 1)) {
    out.point[axis] = h;
    return;
  }
  const S up = std::max(t, S(0)), one = sigma > 0 ? 1 / sigma : S(0);
  out.point[axis] = 2 * h * up - h;
  on_rim(i, j, p, core.radius * (1 - up), one, out);
  if (t > 0) {
    out.tangent[0][i] = -core.radius * p[i] * one, out.tangent[0][j] = -core.radius * p[j] * one, out.tangent[0][axis] = 2 * h;
    out.k00 = 1 / squared, out.flat = 1;
  }
}

/// No radius may be zero.
template <int D, class S>
void project(const EllipsoidCore<D, S>& core, const Vector<D, S>& p, ProjectionStart<S>& start, Projection<D, S>& out) {
  S squared[D], stretched[D], inverse[D], scaled = 0, length = 0, least = std::numeric_limits<S>::infinity();  // one by one, as they are read: see MinkowskiDifference::support
  for (int i = 0; i < D; ++i) {
    const S r = core.radii[i], q = p[i] / r;
    squared[i] = r * r, stretched[i] = r * p[i];
    scaled += q * q, length += p[i] * p[i], least = std::min(least, squared[i]);
  }
  if (!(scaled > 1)) return held_point(p, out);
  S& t = start.t;
  // Where to begin: of a ball of radius r it is t = r (|p| - r) = r^2 (|p| / r - 1), and r^2 = |p|^2 / q with q = sum (p_i / r_i)^2.
  if (!(t > 0)) t = length * (std::sqrt(scaled) - 1) / scaled;
  S f = 0, slope = 0;  // -f' / 2
  const auto evaluate = [&] {
    f = slope = 0;
    for (int i = 0; i < D; ++i) {
      const S q = stretched[i] * inverse[i];
      f += q * q, slope += q * q * inverse[i];
    }
  };
  for (int round = 0; round < 64; ++round) {
    for (int i = 0; i < D; ++i) inverse[i] = 1 / (squared[i] + t);
    evaluate();
    const S step = (std::sqrt(f) - 1) * f / slope;
    if (std::abs(f - 1) < S(1e-5)) {
      if (std::abs(step) < S(1e-4) * (least + t)) [[likely]] {  // the last step squares that: no need to divide again
        t += step;
        for (int i = 0; i < D; ++i) inverse[i] -= step * inverse[i] * inverse[i] * (1 - step * inverse[i]);
        break;
      }
      if (std::abs(f - 1) <= 8 * std::numeric_limits<S>::epsilon()) break;  // which is what f rounds
    }
    t = t + step > 0 ? t + step : t / 8;
  }
  evaluate();
  // What the last step left open of t. Brought onto the surface towards the centre instead, a point beside the rim of a thin disc would move along the disc: that
  // is for a t that f does not tell so well, where p is next to nothing along a short axis.
  const S off = f - 1, last = off / (2 * slope);
  const bool told = std::abs(last) < S(1e-3) * (least + t);
  const S onto = told ? S(1) : off * off < std::numeric_limits<S>::epsilon() ? 1 - off / 2 : 1 / std::sqrt(f);
  const S more = told ? last : S(0);
  t += more;
  S n[D];
  int m = 0;
  for (int i = 0; i < D; ++i) {
    n[i] = p[i] * inverse[i] * (1 - more * inverse[i]) * onto;
    out.point[i] = squared[i] * n[i];
    if (std::abs(n[i]) > std::abs(n[m])) m = i;
  }
  out.inside = false, out.flat = 0;
  if constexpr (D == 3) {
    // With u = n / n_m the tangents are e_i - u_i e_m and e_j - u_j e_m, and the determinant is a sum (Cauchy, Binet): w_i w_j + u_i^2 w_j w_m + u_j^2 w_i w_m.
    const int i = (m + 1) % 3, j = (m + 2) % 3;
    const S ui = n[i] / n[m], uj = n[j] / n[m];
    const S wi = 1 + t / squared[i], wj = 1 + t / squared[j], wm = 1 + t / squared[m];
    out.tangent[0][i] = 1, out.tangent[0][j] = 0, out.tangent[0][m] = -ui;
    out.tangent[1][i] = 0, out.tangent[1][j] = 1, out.tangent[1][m] = -uj;
    const S a = wi + ui * ui * wm, b = ui * uj * wm, c = wj + uj * uj * wm, one = 1 / (wi * wj + ui * ui * wj * wm + uj * uj * wi * wm);
    out.k00 = c * one, out.k01 = -b * one, out.k11 = a * one;
  } else if constexpr (D == 2) {
    out.tangent[0] = Vector<2, S>(-n[1], n[0]);
    out.k00 = 1 / (n[1] * n[1] * (1 + t / squared[0]) + n[0] * n[0] * (1 + t / squared[1]));
    out.k01 = out.k11 = 0;
  }
}

/// Whether `project` knows this core.
template <int D, class S>
bool projectable(const Convex<D, S>& body) {
  return std::visit(
      [](const auto& core) {
        using Core = std::decay_t<decltype(core)>;
        if constexpr (std::is_same_v<Core, EllipsoidCore<D, S>>) return (core.radii.array().square() > 0).all();
        else return requires(Vector<D, S> p, ProjectionStart<S> start, Projection<D, S> out) { project(core, p, start, out); };
      },
      body.core());
}

/// The point of the core nearest to `p`, which is relative to `reference()` and in the body's axes. The body must be `projectable`.
template <int D, class S>
void project_onto(const Convex<D, S>& body, const Vector<D, S>& p, ProjectionStart<S>& start, Projection<D, S>& out) {
  std::visit(
      [&](const auto& core) {
        if constexpr (requires { project(core, p, start, out); }) project(core, p, start, out);
      },
      body.core());
}

}  // namespace gjkdbg
