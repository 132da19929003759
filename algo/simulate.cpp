#include "algo/simulate.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "algo/contact.h"
#include "algo/impulses.h"
#include "algo/motion.h"
#include "shapes/mass.h"

namespace gjkdbg {
namespace {

using V3 = Eigen::Vector3d;
using M3 = Eigen::Matrix3d;

constexpr double left_over = 1e-3;    ///< of the size: overlap that is left where it is
constexpr double moved_apart = 0.4;   ///< share of the rest that a step takes away
constexpr double least_arm = 1e-60;   ///< of gyration: less is a point. Spins are speeds by arms, and their squares have to stay numbers, as those of the longest lengths
constexpr double most_turn = 1e15;    ///< radians a step: of more no digit says where it ends

class Simulation {
 public:
  Simulation(const Scene& scene, const Settings& settings, TraceSink* trace)
      : scene_(scene), settings_(static_settings(settings)), trace_(trace), dimension_(scene.dimension), h_(scene.motion->time_step),
        gravity_(in_space(scene.motion->gravity)) {
    for (const Body& body : scene.bodies) bodies_.push_back(make(body)), parts_.push_back(convex_parts(body.shape));
  }

  Result run() {
    emit_state();
    for (int i = 0; i < scene_.motion->steps; ++i) {
      step();
      time_ = (i + 1) * h_;
      emit_state();
    }
    return result();
  }

 private:
  AnyVector in_scene(const V3& v) const { return v.head(dimension_); }

  RigidBody make(const Body& body) const {
    const Motion& m = *body.motion;
    RigidBody b;
    b.r.topLeftCorner(dimension_, dimension_) = body.pose.matrix;
    const MassProperties mass = mass_properties(body.shape, dimension_);
    b.center = mass.center;
    b.x = in_space(body.pose.position) + b.r * b.center;
    b.reach = reach_of(body.shape, dimension_, b.center);
    b.mass = m.mass;
    b.inverse_mass = m.is_static ? 0 : 1 / m.mass;
    if (m.is_static) return b;
    const V3 w = dimension_ == 3 ? V3(m.angular_velocity) : dimension_ == 2 ? V3(0, 0, m.angular_velocity[0]) : V3(V3::Zero());
    b.v = in_space(m.velocity) + w.cross(b.r * b.center);
    b.inertia = m.mass * mass.inertia;
    if (dimension_ == 2) b.inertia = V3(0, 0, b.inertia(2, 2)).asDiagonal();
    // What has no extent across an axis does not resist turning about it, and does not turn; nor does what has next to none about any.
    const Eigen::SelfAdjointEigenSolver<M3> axes(b.inertia);
    const double most = axes.eigenvalues().cwiseAbs().maxCoeff();
    if (dimension_ > 1 && most > m.mass * least_arm * least_arm) {
      V3 inverse = V3::Zero();
      for (int i = 0; i < 3; ++i)
        if (axes.eigenvalues()[i] > 1e-12 * most) inverse[i] = 1 / axes.eigenvalues()[i];
      b.axes = axes.eigenvectors();
      if (b.axes.determinant() < 0) b.axes.col(2) *= -1;
      b.inverse = b.axes * inverse.asDiagonal() * b.axes.transpose();
      b.turns = true;
      b.l = b.r * b.inertia * b.r.transpose() * w;
    }
    return b;
  }

  bool movable(const RigidBody& b) const { return b.inverse_mass > 0; }

  // --- A step -------------------------------------------------------------------------------------------------------------

  void step() {
    const bool old_rates = scene_.motion->integrator == Integrator::explicit_euler;
    if (old_rates) {
      find_contacts();
      apply_impulses();
      move();
      fall();
    } else {
      const bool exact = scene_.motion->integrator == Integrator::rk4;
      fall();
      find_contacts();
      apply_impulses();
      move();
      if (exact) lift();
    }
    push_apart();
  }

  void fall() {
    for (RigidBody& b : bodies_)
      if (movable(b)) b.v += gravity_ * h_;
  }

  /// Runge and Kutta's rule integrates the fall exactly: x + v h + g h^2 / 2, where the new velocity alone gives g h^2. A body at rest on
  /// something has had its fall taken from it and keeps its place.
  void lift() {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (movable(bodies_[i]) && !resting_[i]) bodies_[i].x -= gravity_ * (h_ * h_ / 2);
  }

  /// The share of a step's fall that comes after a bounce. Runge and Kutta's parabolas bounce at the step's beginning. A semi-implicit fall from
  /// rest is h |v| / 2 lower than a true one, and so is what rises: turned back before the fall a body loses m g h |v| in a bounce, turned back
  /// after it, it gains as much, and in the middle neither. The explicit method falls when all is done.
  double left_to_fall() const {
    switch (scene_.motion->integrator) {
      case Integrator::explicit_euler: return 0;
      case Integrator::semi_implicit_euler: return 0.5;
      case Integrator::rk4: return 1;
    }
    return 0;
  }

  void move() {
    for (RigidBody& b : bodies_) {
      if (!movable(b)) continue;
      b.x += b.v * h_;
      if (!b.turns || b.l.isZero(0) || !(b.w().norm() * h_ < most_turn)) continue;
      switch (scene_.motion->integrator) {
        case Integrator::explicit_euler: turn_as_taught(b); break;
        case Integrator::semi_implicit_euler: turn_by_exponential(b); break;
        case Integrator::rk4: turn_rk4(b); break;
      }
    }
  }

  static M3 rotation(const V3& turn) {
    const double angle = turn.norm();
    return angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : M3(M3::Identity());
  }

  /// exp(w h) R with the w of the middle of the step, R being half way there: of second order.
  void turn_by_exponential(RigidBody& b) const {
    RigidBody half = b;
    half.r = rotation(b.w() * (h_ / 2)) * b.r;
    b.r = rotation(half.w() * h_) * b.r;
  }

  /// R' = [w] R for the principal axes, then Gram and Schmidt from the one of least inertia on. That one moves as told, by h w x u, and so a line u, which has no inertia
  /// about itself, stays square to L = I w: where it is turned aside, L has a part along it that it cannot turn with.
  void turn_as_taught(RigidBody& b) const {
    M3 cross, u = b.r * b.axes;
    const V3 w = b.w();
    cross << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    u += h_ * cross * u;
    u.col(0).normalize();
    u.col(1) = (u.col(1) - u.col(0) * u.col(0).dot(u.col(1))).normalized();
    u.col(2) = u.col(0).cross(u.col(1));
    b.r = u * b.axes.transpose();
  }

  /// q' = w q / 2 with w = I(q)^-1 L, L constant between impulses.
  void turn_rk4(RigidBody& b) const {
    using Q = Eigen::Vector4d;  // x y z w
    const auto rate = [&](const Q& q) {
      const Eigen::Quaterniond unit = Eigen::Quaterniond(q).normalized();
      const M3 r = unit.toRotationMatrix();
      const V3 w = r * b.inverse * (r.transpose() * b.l);
      const Eigen::Quaterniond d = Eigen::Quaterniond(0, w[0], w[1], w[2]) * Eigen::Quaterniond(q);
      return Q(d.coeffs() * 0.5);
    };
    const Q q = Eigen::Quaterniond(b.r).coeffs();
    const Q k1 = rate(q), k2 = rate(q + h_ / 2 * k1), k3 = rate(q + h_ / 2 * k2), k4 = rate(q + h_ * k3);
    b.r = Eigen::Quaterniond(Q(q + h_ / 6 * (k1 + 2 * k2 + 2 * k3 + k4))).normalized().toRotationMatrix();
  }

  // --- Contacts -------------------------------------------------------------------------------------------------------------

  Body placed(std::size_t i) const {
    Body body = scene_.bodies[i];
    const RigidBody& b = bodies_[i];
    body.motion.reset();
    body.pose.matrix = b.r.topLeftCorner(dimension_, dimension_);
    body.pose.rotation = RotationMatrix{body.pose.matrix};
    body.pose.position = in_scene(V3(b.x - b.r * b.center));
    return body;
  }

  void find_contacts() {
    contacts_.clear();
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for (std::size_t j = i + 1; j < bodies_.size(); ++j) {
        if (!movable(bodies_[i]) && !movable(bodies_[j])) continue;
        if ((bodies_[i].x - bodies_[j].x).norm() > bodies_[i].reach + bodies_[j].reach) continue;
        contacts_of(i, j);
      }
  }

  void contacts_of(std::size_t i, std::size_t j) {
    const Body a = placed(i), b = placed(j);
    for (const Shape& part_a : parts_[i])
      for (const Shape& part_b : parts_[j]) contacts_of(i, j, Body{a.name, part_a, a.pose}, Body{b.name, part_b, b.pose}, simplices_[{&part_a, &part_b}]);
  }

  /// A mesh has a part for each triangle.
  void contacts_of(std::size_t i, std::size_t j, const Body& part_a, const Body& part_b, std::vector<SimplexPoint>& simplex) {
    Scene two;
    two.dimension = dimension_;
    two.query = Query::contact;
    two.bodies = {part_a, part_b};
    const Result r = solve_static(two, settings_, trace_, numbers_, &simplex);
    numbers_.next_run();
    supports_ += r.support_calls, iterations_ += r.iterations;
    const bool limited = r.status == word_of(GjkStatus::iteration_limit), touch = r.intersecting && r.normal && r.contacts;  // EPA's limit is called the same
    if (touch) keep_contacts(i, j, r, limited);
    limited_ |= limited;
    if (limited && trace_) tell_limit(i, j, touch);
  }

  /// Where GJK or EPA came to its limit the normal may be another, and the depth less: a bounce along it, or all of the depth put apart, could gain energy. Such contacts
  /// only hold: along any direction an impulse that ends the approach takes energy away, and no way out is shorter than what is proven of the depth.
  void keep_contacts(std::size_t i, std::size_t j, const Result& r, bool limited) {
    const Motion &a = *scene_.bodies[i].motion, &b = *scene_.bodies[j].motion;
    const double falls = (movable(bodies_[i]) ? 1 : 0) - (movable(bodies_[j]) ? 1 : 0), fall_left = falls * left_to_fall() * h_ * gravity_.dot(in_space(*r.normal));
    const double restitution = limited ? 0 : std::max(a.restitution, b.restitution);
    for (const ContactPoint& c : *r.contacts) {
      const double proven = limited ? std::min(c.depth, std::max(0.0, -r.upper_bound.value_or(0))) : c.depth;
      Contact contact{static_cast<int>(i), static_cast<int>(j), in_space(AnyVector((c.point_a + c.point_b) / 2)), in_space(*r.normal).normalized(), c.depth, proven,
                      restitution, std::sqrt(a.friction * b.friction), fall_left, {bodies_[i].v, bodies_[j].v}};
      if (is_known(contact)) continue;
      contacts_.push_back(contact);
      if (trace_)
        (*trace_)(world::ContactFound{time_, {contact.first, contact.second}, in_scene(contact.point), in_scene(contact.normal), contact.depth});
    }
  }

  /// On the edge that two triangles share it is a contact of each.
  bool is_known(const Contact& contact) const {
    const auto first = static_cast<std::size_t>(contact.first), second = static_cast<std::size_t>(contact.second);
    if (parts_[first].size() * parts_[second].size() == 1) return false;
    const double apart = least_apart(bodies_[first].reach, bodies_[second].reach, contact.point.norm());
    return std::any_of(contacts_.begin(), contacts_.end(), [&](const Contact& c) {
      return c.first == contact.first && c.second == contact.second && (c.point - contact.point).norm() <= apart && std::abs(c.depth - contact.depth) <= apart &&
             std::abs(c.proven - contact.proven) <= apart && (c.normal - contact.normal).norm() <= 1e-6;
    });
  }

  void tell_limit(std::size_t i, std::size_t j, bool touch) {
    const std::string message = "The search between bodies " + std::to_string(i) + " and " + std::to_string(j) + " came to its limit. " +
                                (touch ? "Which way they touch, and how deep, is not known: they are kept from moving into each other, do not bounce, and are put apart by no more than is proven."
                                       : "Whether they touch is not known: they are taken for apart.");
    (*trace_)(world::Warning{"contact-unknown", message});
  }

  // --- Impulses ---------------------------------------------------------------------------------------------------------------

  void apply_impulses() {
    Impulses impulses(bodies_, contacts_, gravity_.norm() * h_);
    resting_ = impulses.run();
    for (Contact& c : contacts_) {
      c.leaves = std::max(0.0, impulses.relative_velocity(c).dot(c.normal)) * h_;
      if (!trace_ || c.impulse.isZero(0)) continue;
      const std::vector<AnyVector> before{in_scene(c.before[0]), in_scene(c.before[1])};
      const std::vector<AnyVector> after{in_scene(bodies_[static_cast<std::size_t>(c.first)].v), in_scene(bodies_[static_cast<std::size_t>(c.second)].v)};
      (*trace_)(world::ImpulseApplied{time_, {c.first, c.second}, in_scene(c.point), in_scene(c.normal), in_scene(c.impulse), before, after});
    }
  }

  /// Places alone: no velocity, hence no kinetic energy; and no more than is left once the bodies have moved, or every bounce would lift them.
  void push_apart() {
    for (const Contact& c : contacts_) {
      RigidBody &a = bodies_[static_cast<std::size_t>(c.first)], &b = bodies_[static_cast<std::size_t>(c.second)];
      const double slop = left_over * std::min(a.reach, b.reach), extra = c.proven - c.leaves - slop;
      const double weight = a.inverse_mass + b.inverse_mass;
      if (!(extra > 0) || !(weight > 0)) continue;
      const auto points = static_cast<double>(std::count_if(contacts_.begin(), contacts_.end(), [&](const Contact& o) { return o.first == c.first && o.second == c.second; }));
      const V3 shift = c.normal * (moved_apart * extra / weight / points);
      a.x -= shift * a.inverse_mass;
      b.x += shift * b.inverse_mass;
    }
  }

  // --- What is told ---------------------------------------------------------------------------------------------------------

  double energy() const {
    double e = 0;
    for (const RigidBody& b : bodies_)
      if (movable(b)) e += b.mass * b.v.squaredNorm() / 2 + b.w().dot(b.l) / 2 - b.mass * gravity_.dot(b.x);
    return e;
  }

  V3 momentum() const {
    V3 p = V3::Zero();
    for (const RigidBody& b : bodies_)
      if (movable(b)) p += b.mass * b.v;
    return p;
  }

  std::vector<FinalState> states() const {
    std::vector<FinalState> list;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body at = placed(i);
      const RigidBody& b = bodies_[i];
      const V3 w = b.w();
      const AnyVector spin = dimension_ == 3 ? AnyVector(w) : AnyVector(w.tail(dimension_ == 2 ? 1 : 0));
      list.push_back({at.pose.position, orientation_of(at.pose.matrix), in_scene(V3(b.v - w.cross(b.r * b.center))), in_degrees(spin)});
    }
    return list;
  }

  void emit_state() {
    if (!trace_) return;
    const std::vector<FinalState> kept = states();
    std::vector<world::BodyState> views;
    for (const FinalState& s : kept) views.push_back({s.position, s.orientation, s.velocity, s.angular_velocity});
    (*trace_)(world::State{time_, views, energy(), in_scene(momentum())});
  }

  Result result() const {
    Result r;
    r.status = limited_ ? StatusWord("contact_unknown") : StatusWord("completed");
    r.intersecting = !contacts_.empty();
    r.iterations = iterations_, r.support_calls = supports_;
    r.time = time_;
    r.energy = energy();
    r.bodies = states();
    return r;
  }

  const Scene& scene_;
  const Settings settings_;
  TraceSink* trace_;
  const int dimension_;
  const double h_;
  const V3 gravity_;
  std::vector<RigidBody> bodies_;
  std::vector<std::vector<Shape>> parts_;
  std::map<std::pair<const Shape*, const Shape*>, std::vector<SimplexPoint>> simplices_;  ///< of Start::previous
  std::vector<Contact> contacts_;
  bool limited_ = false;  ///< some search came to its limit
  std::vector<bool> resting_;  ///< on something, in this step
  TraceNumbers numbers_;
  double time_ = 0;
  int iterations_ = 0, supports_ = 0;
};

}  // namespace

Result simulate(const Scene& scene, const Settings& settings, TraceSink* trace) { return Simulation(scene, settings, trace).run(); }

}  // namespace gjkdbg
