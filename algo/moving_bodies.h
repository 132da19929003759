// The bodies of a cast: where they are, and how fast two of them come nearer. Of cast.cpp.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "algo/cast_meeting.h"
#include "algo/motion.h"
#include "shapes/scene.h"

namespace gjkdbg {

class MovingBodies {
 protected:
  explicit MovingBodies(const Scene& scene) : dimension_(scene.dimension), bodies_(scene.bodies) {
    for (const Body& body : bodies_) reach_.push_back(reach_of(body.shape, dimension_));
  }

  const AnyVector& velocity(int i) const { return bodies_[static_cast<std::size_t>(i)].motion->velocity; }
  const AnyVector& spin(int i) const { return bodies_[static_cast<std::size_t>(i)].motion->angular_velocity; }
  bool turns(int i) const { return spin(i).size() > 0 && !spin(i).isZero(0); }
  bool moves_against(int i, int j) const { return turns(i) || turns(j) || velocity(i) != velocity(j); }

  double speed(const Pair& p) const {
    double s = norm_of_any_size(velocity(p.first)) + norm_of_any_size(velocity(p.second));
    for (const int i : {p.first, p.second}) s += spin(i).norm() * reach_[static_cast<std::size_t>(i)];
    return s;
  }

  Scene pair_at(const Pair& p, double time) const {
    Scene two;
    two.dimension = dimension_;
    two.query = Query::penetration;
    for (const int i : {p.first, p.second}) {
      const Body& body = bodies_[static_cast<std::size_t>(i)];
      two.bodies.push_back(moved(Body{body.name, i == p.first ? *p.shape_a : *p.shape_b, body.pose, body.motion}, time, dimension_));
      two.bodies.back().motion.reset();
    }
    return two;
  }

  double closing(const Pair& p, const AnyVector& n) const {
    return (velocity(p.first) - velocity(p.second)).dot(n) + sideways(p.first, n) + sideways(p.second, n);
  }

  /// |w x n| times the reach; in the plane w is across n.
  double sideways(int i, const AnyVector& n) const {
    if (!turns(i)) return 0;
    const double reach = reach_[static_cast<std::size_t>(i)];
    if (dimension_ == 2) return std::abs(spin(i)[0]) * reach;
    const Eigen::Vector3d w = spin(i), n3 = n;
    return w.cross(n3).norm() * reach;
  }

  std::vector<FinalState> states() const {
    std::vector<FinalState> list;
    for (const Body& b : bodies_)
      list.push_back({b.pose.position, orientation_of(b.pose.matrix), b.motion->velocity, in_degrees(b.motion->angular_velocity)});
    return list;
  }

  const int dimension_;
  std::vector<Body> bodies_;  ///< where the stretch begins
  std::vector<double> reach_;
};

}  // namespace gjkdbg
