#include "algo/root_finding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/motion.h"
#include "shapes/world_support.h"

namespace gjkdbg {
namespace {

constexpr int most_looks = 256;  ///< then GJK looks for a better normal

}  // namespace

RootFinding::RootFinding(Body a, Body b, double reach_a, double reach_b, int dimension, double time, double target, double left)
    : a_(std::move(a)), b_(std::move(b)), reach_a_(reach_a), reach_b_(reach_b), dimension_(dimension), time_(time), target_(target), left_(left) {}

double RootFinding::open_along(const AnyVector& n, double ahead) {
  const Body at_a = moved(a_, time_ + ahead, dimension_), at_b = moved(b_, time_ + ahead, dimension_);
  const WorldSupport a(at_a, dimension_), b(at_b, dimension_);
  ++supports_;
  return n.dot(b(-n, true) - a(n, true));
}

double RootFinding::staying(const Gap& gap) {
  double ahead = 0, distance = gap.distance;
  for (int i = 0; i < most_looks && ahead < left_; ++i) {
    ahead += (distance - target_ / 4) / gap.closing;
    distance = open_along(gap.normal, ahead);
    if (distance <= target_ / 2) break;
  }
  return ahead;
}

double RootFinding::turning(const Gap& gap, const AnyVector& last_normal, double since) {
  const AnyVector& n = gap.normal;
  const double cosine = n.dot(last_normal), sine = (last_normal - cosine * n).norm();
  if (!(cosine > 0.5) || !(sine > 1e-12) || !(since > 0)) return 0;
  const AnyVector m = (cosine * n - last_normal) / sine;
  const double f = std::atan2(sine, cosine) / since, stretch = std::min(left_, 0.05 / f);
  const Body now_a = moved(a_, time_, dimension_), now_b = moved(b_, time_, dimension_);
  const AnyVector x = now_b.pose.position - now_a.pose.position, v = b_.motion->velocity - a_.motion->velocity;
  double closing = -(f * m.dot(x) + n.dot(v)) + stretch * (f * f * (norm_of_any_size(x) + norm_of_any_size(v) * stretch) + 2 * f * norm_of_any_size(v));
  for (const auto& [body, reach] : {std::pair(&a_, reach_a_), std::pair(&b_, reach_b_)}) {
    const AnyVector relative = relative_spin(*body, n, m, f);
    closing += reach * (across(relative, n).norm() + relative.norm() * f * stretch);
  }
  if (!(closing > 0)) return stretch;
  double ahead = 0, distance = gap.distance;
  for (int i = 0; i < most_looks && ahead < stretch; ++i) {
    ahead = std::min(stretch, ahead + (distance - target_ / 4) / closing);
    distance = open_along(std::cos(f * ahead) * n + std::sin(f * ahead) * m, ahead);
    if (distance <= target_ / 2) break;
  }
  return ahead;
}

/// w_n - w: three numbers in space, one in the plane.
AnyVector RootFinding::relative_spin(const Body& body, const AnyVector& n, const AnyVector& m, double f) const {
  AnyVector turn = dimension_ == 3 ? AnyVector(Eigen::Vector3d(n).cross(Eigen::Vector3d(m))) : AnyVector(AnyVector::Constant(1, n[0] * m[1] - n[1] * m[0]));
  turn *= f;
  if (body.motion->angular_velocity.size() > 0) turn -= body.motion->angular_velocity;
  return turn;
}

AnyVector RootFinding::across(const AnyVector& w, const AnyVector& n) const {
  if (dimension_ == 3) return Eigen::Vector3d(w).cross(Eigen::Vector3d(n));
  return w[0] * Eigen::Vector2d(-n[1], n[0]);
}

}  // namespace gjkdbg
