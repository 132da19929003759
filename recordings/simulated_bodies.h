// The bodies of a simulation at a time, as a recording's states tell them: centres of mass, spins, energy and momentum.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "recordings/recording.h"
#include "shapes/mass.h"

namespace gjkdbg {

/// A body at a time: its centre of mass and how that moves.
struct Moving {
  Eigen::Vector3d place = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

/// What places and velocities make of energy and momentum; the scales are sums of magnitudes.
struct SumsOfMotion {
  double energy = 0, energy_scale = 0, momentum_scale = 0;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
};

struct SimulatedBodies {
  using V3 = Eigen::Vector3d;
  using M3 = Eigen::Matrix3d;

  const Scene& scene;
  const SceneMotion& motion;
  const V3 gravity;
  std::vector<MassProperties> mass;

  explicit SimulatedBodies(const Scene& of_simulation) : scene(of_simulation), motion(*scene.motion), gravity(in_space(motion.gravity)) {
    for (const Body& body : scene.bodies) mass.push_back(mass_properties(body.shape, scene.dimension));
  }

  const Motion& of(std::size_t i) const { return *scene.bodies[i].motion; }

  Moving moving(const recorded::State& state, std::size_t i) const {
    const recorded::BodyState& b = state.bodies[i];
    Moving m;
    if (b.orientation.size() == 4) m.rotation = Eigen::Quaterniond(b.orientation[0], b.orientation[1], b.orientation[2], b.orientation[3]).normalized().toRotationMatrix();
    if (b.angular_velocity.size() == 3) m.spin = V3(b.angular_velocity[0], b.angular_velocity[1], b.angular_velocity[2]);
    if (b.angular_velocity.size() == 1) m.spin = V3(0, 0, b.angular_velocity[0]);
    m.spin *= M_PI / 180;
    const V3 arm = m.rotation * mass[i].center;
    m.place = in_space(b.position) + arm, m.velocity = in_space(b.velocity) + m.spin.cross(arm);
    return m;
  }

  /// Of the body in its own axes. In the plane it turns about the axis across.
  M3 inertia(std::size_t i) const {
    const M3 all = of(i).mass * mass[i].inertia;
    return scene.dimension == 2 ? M3(V3(0, 0, all(2, 2)).asDiagonal()) : all;
  }
  V3 angular_momentum(const Moving& m, std::size_t i) const { return m.rotation * inertia(i) * m.rotation.transpose() * m.spin; }

  /// Of a state with all bodies.
  SumsOfMotion sums_of(const recorded::State& state) const {
    SumsOfMotion sums;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (of(i).is_static) continue;
      const Moving m = moving(state, i);
      const double moves = of(i).mass * m.velocity.squaredNorm() / 2, turns = m.spin.dot(angular_momentum(m, i)) / 2, falls = -of(i).mass * gravity.dot(m.place);
      sums.energy += moves + turns + falls, sums.energy_scale += moves + std::abs(turns) + std::abs(falls);
      sums.momentum += of(i).mass * m.velocity, sums.momentum_scale += of(i).mass * m.velocity.norm();
    }
    return sums;
  }
};

}  // namespace gjkdbg
