// Rigid bodies that touch, and the impulses that keep them from moving into one another.
//
// One contact after the other, round after round, until none approaches (Mirtich, Canny, "Impulse-based Simulation of Rigid Bodies", I3D 1995, for those
// that bounce: what hits is turned back before what is hit moves on). Pushing one corner down lifts another one: what was given to that before is taken
// back, down to nothing, until all corners that bear are at rest (Catto, "Iterative Dynamics with Temporal Coherence", GDC 2005, there for all contacts).
#pragma once

#include <array>
#include <vector>

#include "shapes/vector.h"

namespace gjkdbg {

/// In the plane and on the line the missing coordinates are 0, and only the turn about z exists.
struct RigidBody {
  Eigen::Vector3d x{0, 0, 0}, v{0, 0, 0}, l{0, 0, 0};  ///< world: centre of mass, its velocity, angular momentum about it
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();     ///< rotation from body to world
  Eigen::Vector3d center{0, 0, 0};                                                       ///< of mass, in the body's frame
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(), inverse = Eigen::Matrix3d::Zero();  ///< body axes, about the centre of mass; inverse: 0 across axes without extent
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();                                    ///< of that inertia, the least first
  double mass = 1, inverse_mass = 1, reach = 0;  ///< inverse 0: static; no point is farther than `reach` from x
  bool turns = false;                            ///< whether l and inverse count: neither static nor in 1D, and of some extent

  Eigen::Matrix3d world_inverse() const { return r * inverse * r.transpose(); }
  /// Angular velocity, radians per unit of time, world.
  Eigen::Vector3d w() const { return turns ? Eigen::Vector3d(world_inverse() * l) : Eigen::Vector3d(0, 0, 0); }
  Eigen::Vector3d velocity_at(const Eigen::Vector3d& point) const { return v + w().cross(point - x); }
  void push(const Eigen::Vector3d& impulse, const Eigen::Vector3d& point) {
    v += impulse * inverse_mass;
    if (turns) l += (point - x).cross(impulse);
  }
};

/// A point of contact in a step of a simulation; world frame.
struct Contact {
  int first, second;
  Eigen::Vector3d point, normal;
  double depth;
  double proven;                          ///< of the depth: no more than this they are put apart by
  double restitution, friction;
  double fall_left;                       ///< of the speed of approach: what gravity adds in this step after a bounce
  std::array<Eigen::Vector3d, 2> before;  ///< the bodies' velocities when it was found
  Eigen::Vector3d impulse{0, 0, 0};       ///< on the second body, in this step
  bool bounced = false;                   ///< and not only come to rest
  double leaves = 0;                      ///< how far the bodies move apart along the normal in this step
};

class Impulses {
 public:
  /// `fall`: the speed that gravity adds in a step. Keeps references.
  Impulses(std::vector<RigidBody>& bodies, std::vector<Contact>& contacts, double fall) : bodies_(bodies), contacts_(contacts), fall_(fall), resting_(bodies.size(), false) {}

  /// Which bodies came to rest on one another: they were pushed, and did not bounce.
  const std::vector<bool>& run();

  /// Of the second body at the contact, seen from the first.
  Eigen::Vector3d relative_velocity(const Contact& c) const;

 private:
  bool push(Contact& c, double least);
  bool press(Contact& c, double least);
  bool rub(Contact& c, double least);
  void apply(Contact& c, const Eigen::Vector3d& impulse);
  Eigen::Vector3d change_by(const Contact& c, const Eigen::Vector3d& direction) const;

  std::vector<RigidBody>& bodies_;
  std::vector<Contact>& contacts_;
  double fall_;
  std::vector<bool> resting_;
};

}  // namespace gjkdbg
