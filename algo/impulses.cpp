#include "algo/impulses.h"

#include <algorithm>
#include <cmath>

namespace gjkdbg {
namespace {

using V3 = Eigen::Vector3d;

constexpr int most_rounds = 200;  ///< within a step

}  // namespace

const std::vector<bool>& Impulses::run() {
  double speed = 0;
  for (const RigidBody& b : bodies_) speed = std::max(speed, b.v.norm() + b.w().norm() * b.reach);
  for (int round = 0; round < most_rounds; ++round) {
    bool approached = false;
    for (Contact& c : contacts_) approached |= push(c, 1e-12 * speed);
    if (!approached) break;
  }
  return resting_;
}

/// True when it was not at rest already.
bool Impulses::push(Contact& c, double least) {
  const bool pressed = press(c, least);
  return rub(c, least) || pressed;
}

/// The bounce turns back what was there before the rest of the fall: with u the speed of approach and r that rest, u - r becomes -e (u - r), by an
/// impulse of (1 + e) (u - r). Where that leaves them approaching there is none.
bool Impulses::press(Contact& c, double least) {
  const double approach = -relative_velocity(c).dot(c.normal), given = c.impulse.dot(c.normal), to_rest = approach / c.normal.dot(change_by(c, c.normal));
  if (approach > least) {
    const bool resting = approach <= 2 * fall_;
    const double bounced = resting ? 0 : (1 + c.restitution) * (approach - c.fall_left);
    if (bounced <= approach) resting_[static_cast<std::size_t>(c.first)] = resting_[static_cast<std::size_t>(c.second)] = true;
    else c.bounced = true;
    apply(c, std::max(1.0, bounced / approach) * to_rest * c.normal);
    return true;
  }
  if (c.bounced || !(approach < -least) || !(given > 0)) return false;
  apply(c, to_rest > -given ? V3(to_rest * c.normal) : V3(-c.impulse));  // where nothing presses, nothing rubs
  return true;
}

/// Coulomb's cone holds for the whole of the step's impulse, not for each part of it.
bool Impulses::rub(Contact& c, double least) {
  const double pressed = c.impulse.dot(c.normal);
  const V3 rubbed = c.impulse - pressed * c.normal, along = relative_velocity(c), slip = along - c.normal * c.normal.dot(along);
  V3 wanted = rubbed;
  if (c.friction > 0 && slip.norm() > least) wanted -= slip / slip.normalized().dot(change_by(c, slip.normalized()));
  if (const double most = c.friction * std::max(0.0, pressed), size = wanted.norm(); size > most) wanted *= most / size;
  const V3 change = wanted - rubbed;
  if (!(change.norm() > 1e-12 * std::abs(pressed))) return false;
  apply(c, change);
  return true;
}

/// How the relative velocity at the contact changes by a unit impulse along a direction.
V3 Impulses::change_by(const Contact& c, const V3& direction) const {
  V3 change = V3::Zero();
  for (const int i : {c.first, c.second}) {
    const RigidBody& b = bodies_[static_cast<std::size_t>(i)];
    change += b.inverse_mass * direction;
    const V3 arm = c.point - b.x;
    if (b.turns) change += (b.world_inverse() * arm.cross(direction)).cross(arm);
  }
  return change;
}

V3 Impulses::relative_velocity(const Contact& c) const {
  return bodies_[static_cast<std::size_t>(c.second)].velocity_at(c.point) - bodies_[static_cast<std::size_t>(c.first)].velocity_at(c.point);
}

void Impulses::apply(Contact& c, const V3& impulse) {
  bodies_[static_cast<std::size_t>(c.second)].push(impulse, c.point);
  bodies_[static_cast<std::size_t>(c.first)].push(-impulse, c.point);
  c.impulse += impulse;
}

}  // namespace gjkdbg
