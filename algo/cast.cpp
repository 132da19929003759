#include "algo/cast.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "algo/cast_meeting.h"
#include "algo/motion.h"
#include "algo/moving_bodies.h"
#include "algo/ray_cast.h"
#include "algo/root_finding.h"
#include "algo/working_scale.h"
#include "shapes/world_support.h"

namespace gjkdbg {
namespace {

class Caster : MovingBodies {
 public:
  Caster(const Scene& scene, const Settings& settings, TraceSink* trace)
      : MovingBodies(scene), scene_(scene), settings_(settings), at_start_(static_settings(settings)), inner_(with_depth(at_start_)), trace_(trace) {
    for (const Body& body : bodies_) parts_.push_back(convex_parts(body.shape));
    double size = 0;
    for (const double r : reach_) size = std::max(size, r);
    for (const Body& body : bodies_) size = std::max(size, norm_of_any_size(body.pose.position - bodies_[0].pose.position));
    target_ = std::max(settings.tolerance, 4e-15) * std::max(size, 1e-300);
  }

  Result run() {
    find_pairs();
    Meeting first = advance(0);
    note(first);
    const Response response = scene_.motion ? scene_.motion->response : Response::stop;
    if (first.status == CastStatus::hit && response != Response::stop) respond(first, response);
    ended(last_);
    return result();
  }

 private:
  // --- The stretch until the next meeting -----------------------------------------------------------------------------

  void find_pairs() {
    pairs_.clear();
    std::vector<Edge> edges;
    const int n = static_cast<int>(bodies_.size());
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j)
        if (n == 2 || moves_against(i, j)) {  // of two bodies at rest it is asked whether they overlap, of a scene's floor and walls it is not
          edges.push_back({i, j});
          for (const Shape& a : parts_[static_cast<std::size_t>(i)])
            for (const Shape& b : parts_[static_cast<std::size_t>(j)]) pairs_.push_back({i, j, &a, &b});
        }
    if (trace_ && !responded_) (*trace_)(world::CastBegan{edges});  // a cast begins once; after a response it goes on
  }

  /// From the bodies' places at `start` (of the whole interval) until two of them meet or the interval ends.
  Meeting advance(double start) {
    start_ = start;
    if (settings_.name == MethodName::ray_cast) return by_rays();
    Meeting meeting;
    for (Pair& p : pairs_) p.open = true, p.last_time = -1;
    double time = 0;
    while (iterations_ < settings_.max_iterations) {
      ++iterations_;
      double next = 1 - start;
      const Pair* nearest = nullptr;
      for (Pair& p : pairs_) {
        if (!p.open) continue;
        if (time == 0 && separated_by_a_wall(p)) {
          p.open = false;
          continue;
        }
        const Gap gap = gap_of(p, time);
        if (!gap.known) return at_limit(p, time, gap);
        if (gap.distance <= target_) {
          // A pair that only slides along another does not meet it.
          if (gap.closing <= sliding_ * speed(p) && (gap.distance > 0 || start_ > 0)) {
            p.open = false;
            continue;
          }
          meeting = {gap.distance <= 0 && time == 0 && start == 0 ? CastStatus::initially_overlapping : CastStatus::hit, time, p, gap};
          return meeting;
        }
        if (gap.closing <= sliding_ * speed(p)) {
          p.open = false;  // receding: this normal separates them for good, whichever way they turn
          continue;
        }
        const double safe = time + (settings_.name == MethodName::root_finding ? root(p, time, gap) : (gap.distance - target_ / 2) / gap.bound);
        p.last_time = time, p.last_distance = gap.distance, p.last_normal = gap.normal;
        if (safe < next) next = safe, nearest = &p;
      }
      if (!nearest || !(next > time)) {
        if (nearest) meeting = {CastStatus::hit, time, *nearest, gap_of(*nearest, time)};  // time no longer advances: rounding
        if (nearest) return meeting.gap.known ? meeting : at_limit(*nearest, time, meeting.gap);
        meeting.status = CastStatus::miss, meeting.time = 1 - start;
        return meeting;
      }
      time = next;
    }
    return {CastStatus::iteration_limit, time, {-1, -1, nullptr, nullptr}, {}};
  }

  /// GJK or EPA came to its limit. That the bodies overlap at the beginning is an answer all the same, where it is proven. Nothing else is: no step
  /// from here is safe, and whether bodies that touch approach, slide or recede hangs on a normal that is not known.
  Meeting at_limit(const Pair& p, double time, const Gap& gap) const {
    if (time == 0 && start_ == 0 && gap.distance <= 0 && gap.at_most <= target_) return {CastStatus::initially_overlapping, 0, p, gap};
    return {CastStatus::iteration_limit, time, {-1, -1, nullptr, nullptr}, {}};
  }

  /// A body that slides along a wall is never nearer to it than it is. What lies behind the same plane it cannot meet either: the next of two
  /// flush tiles, the next triangle of a flat mesh. The nearest points would say otherwise: seen from just above, the tile ahead is met at its
  /// inner edge (a "ghost collision").
  bool separated_by_a_wall(const Pair& p) {
    for (const Wall& wall : axes_) {
      if (wall.body != p.first && wall.body != p.second) continue;
      const AnyVector n = wall.body == p.first ? wall.normal : AnyVector(-wall.normal);
      if (closing(p, n) > sliding_ * speed(p)) continue;
      const Scene two = pair_at(p, 0);
      const WorldSupport a(two.bodies[0], dimension_), b(two.bodies[1], dimension_);
      ++supports_;
      if (n.dot(b(-n, true) - a(n, true)) > 0) return true;
    }
    return false;
  }

  /// GJK at a time, in the trace, and how fast the gap closes at most.
  Gap gap_of(const Pair& p, double time) {
    const Scene two = pair_at(p, time);
    const Result r = solve_static(two, of_time(time), trace_, numbers_, &simplices_[{p.shape_a, p.shape_b}]);
    numbers_.next_run();
    supports_ += r.support_calls;
    Gap gap = gap_from(p, r);
    if (settings_.name != MethodName::root_finding) gap.bound = bound_from_here(p, two, gap);
    if (trace_ && gap.known) (*trace_)(world::CastAdvanced{iterations_, start_ + time, {p.first, p.second}, gap.distance, gap.normal, gap.bound});
    return gap;
  }

  /// With penetration "none" nothing is known of an overlap at the beginning but that it is one. Later on bodies that touch within rounding need a
  /// normal: without one it is not known whether they meet, slide or recede.
  const Settings& of_time(double time) const { return time == 0 && start_ == 0 ? at_start_ : inner_; }
  static Settings with_depth(Settings settings) {
    if (settings.penetration == Penetration::none) settings.penetration = Penetration::epa;
    return settings;
  }

  Gap gap_from(const Pair& p, const Result& r) const {
    if (!r.signed_distance) {
      Gap overlap;
      overlap.known = false, overlap.at_most = r.intersecting ? 0 : std::numeric_limits<double>::infinity();
      return overlap;
    }
    Gap gap{*r.signed_distance, *r.normal, *r.witness_a, *r.witness_b};
    gap.known = r.status != word_of(GjkStatus::iteration_limit), gap.at_most = *r.upper_bound;  // EPA's limit is called the same
    gap.bound = gap.closing = closing(p, gap.normal);
    return gap;
  }

  /// How fast the gap closes at most until it can be closed. Near the top of its arc a rod hardly rises; |w| times its reach would not know.
  double bound_from_here(const Pair& p, const Scene& two, const Gap& gap) {
    if (!(turns(p.first) || turns(p.second)) || !(gap.distance > 0)) return gap.closing;
    TurningBound sum{(velocity(p.first) - velocity(p.second)).dot(gap.normal), 0};
    for (const int i : {p.first, p.second}) {
      const Body& body = two.bodies[i == p.first ? 0 : 1];
      const TurningBound one = turning_bound(body, spin(i), i == p.first ? gap.normal : AnyVector(-gap.normal), reach_[static_cast<std::size_t>(i)]);
      sum.speed += one.speed, sum.change += one.change, supports_ += turns(i);
    }
    return std::min(gap.closing, sum.until_closed(gap.distance));
  }

  /// Root finding: for how long from now the gap stays open, along this normal or one that turns on.
  double root(const Pair& p, double time, const Gap& gap) {
    if (!turns(p.first) && !turns(p.second)) return (gap.distance - target_ / 2) / gap.closing;  // the gap along n falls evenly
    const auto body = [&](int i, const Shape& shape) {
      const Body& b = bodies_[static_cast<std::size_t>(i)];
      return Body{b.name, shape, b.pose, b.motion};
    };
    RootFinding finding(body(p.first, *p.shape_a), body(p.second, *p.shape_b), reach_[static_cast<std::size_t>(p.first)], reach_[static_cast<std::size_t>(p.second)], dimension_, time, target_, 1 - start_ - time);
    double ahead = finding.staying(gap);
    if (p.last_time >= 0 && gap.distance > p.last_distance / 16) ahead = std::max(ahead, finding.turning(gap, p.last_normal, time - p.last_time));
    supports_ += finding.support_calls();
    return ahead;
  }

  // --- Rays ----------------------------------------------------------------------------------------------------------------

  Meeting by_rays() {
    Meeting best;
    best.time = 1 - start_;
    for (const Pair& p : pairs_) {
      Meeting m = dimension_ == 1 ? ray<1>(p) : dimension_ == 2 ? ray<2>(p) : ray<3>(p);
      if (m.status == CastStatus::miss || m.time > best.time) continue;
      if (m.status == CastStatus::hit && m.time <= 0 && m.gap.closing <= sliding_ * speed(p)) continue;
      if (best.status == CastStatus::miss || m.time < best.time) best = m;
    }
    return best;
  }

  template <int D>
  Meeting ray(const Pair& p) {
    return settings_.scalar == Scalar::float_precision ? ray<D, float>(p) : ray<D, double>(p);
  }

  template <int D, class S>
  Meeting ray(const Pair& p) {
    const Scene two = pair_at(p, 0);
    const Body &body_a = two.bodies[0], &body_b = two.bodies[1];
    const Vector<D, double> relative = (velocity(p.second) - velocity(p.first)) * (1 - start_);
    const double scale = working_scale<S>(body_a, body_b, relative.cwiseAbs().maxCoeff());
    const Convex<D, S> a(body_a.shape, scale), b(body_b.shape, scale);
    using Difference = MinkowskiDifference<D, S, Convex<D, S>>;
    Difference cores(a, b, body_a.pose, body_b.pose, scale);
    InflatedDifference<Difference> difference(cores);
    const WorkingFrame<D, S> frame(body_a.pose, a.reference(), scale);
    // The ray is -t (vA - vB), seen from body 0.
    const RayOfMotion<Vector<D, S>> along{(frame.rotation.transpose() * Vector<D, double>(relative * scale)).template cast<S>(), start_, {p.first, p.second}};
    const S reach = std::max(static_cast<S>(target_ * scale), S(2) * difference.rounding_floor());
    RayCastResult<D, S> found;
    if (trace_) {
      WorldTrace<D, S> trace(frame, numbers_, *trace_);
      found = ray_cast(difference, along, reach, settings_.max_iterations, trace);
      numbers_.next_run();
    } else {
      NoTrace silent;
      found = ray_cast(difference, along, reach, settings_.max_iterations, silent);
    }
    iterations_ += found.iterations, supports_ += cores.support_calls();
    Meeting m;
    m.status = found.status;
    if (found.status == CastStatus::initially_overlapping && start_ > 0) m.status = CastStatus::hit;
    constexpr double sooner = 1 - 4 * static_cast<double>(std::numeric_limits<S>::epsilon());  // the ray and the place on it are rounded
    m.time = static_cast<double>(found.time) * sooner * (1 - start_);
    m.pair = p;
    if (m.status == CastStatus::miss) return m;
    // The places and the normal at that time, by GJK: the ray's own are as exact as its last plane.
    const Result r = solve_static(pair_at(p, m.time), m.status == CastStatus::initially_overlapping ? at_start_ : inner_, nullptr, numbers_);
    supports_ += r.support_calls;
    m.gap = gap_from(p, r);
    if (!m.gap.known && m.status == CastStatus::hit) m.status = CastStatus::iteration_limit;
    return m;
  }

  // --- What becomes of the motion --------------------------------------------------------------------------------------------

  void respond(const Meeting& first, Response response) {
    Meeting meeting = first;
    double now = 0;
    std::vector<Wall> walls;
    for (int k = 0; k < most_responses; ++k) {
      if (meeting.time > 0) walls.clear();
      for (Body& body : bodies_) body = moved(body, meeting.time, dimension_);
      now += meeting.time;
      const AnyVector& n = meeting.gap.normal;
      const Motion &a = *bodies_[static_cast<std::size_t>(meeting.pair.first)].motion, &b = *bodies_[static_cast<std::size_t>(meeting.pair.second)].motion;
      const bool moves_a = !a.velocity.isZero(0), moves_b = !b.velocity.isZero(0);
      const double approach = (a.velocity - b.velocity).dot(n), e = response == Response::bounce ? std::max(a.restitution, b.restitution) : 0;
      const double change = (1 + e) * std::max(0.0, approach), share = moves_a && moves_b ? 0.5 : 1;
      const std::vector<AnyVector> before{a.velocity, b.velocity};
      if (moves_a) turn_off(meeting.pair.first, n, change * share, walls, response);
      if (moves_b) turn_off(meeting.pair.second, -n, change * share, walls, response);
      emit_response(now, meeting, before);
      if (at_rest()) {
        last_ = meeting, last_.status = CastStatus::at_rest, last_.time = now;
        return;
      }
      find_pairs();
      meeting = advance(now);
      last_ = meeting, last_.time = now + meeting.time;
      if (meeting.status != CastStatus::hit) break;
    }
    for (Body& body : bodies_) body = moved(body, meeting.time, dimension_);
  }

  bool at_rest() const {
    return std::all_of(bodies_.begin(), bodies_.end(), [&](const Body& body) { return norm_of_any_size(body.motion->velocity) <= 1e-12 * scene_speed(); });
  }

  double scene_speed() const {
    double s = 0;
    for (const Body& body : scene_.bodies) s = std::max(s, norm_of_any_size(body.motion->velocity));
    return s;
  }

  /// Takes `change` of the velocity along n (into the wall) off. Caught by two walls at once, the body keeps what leads along both, if anything.
  void turn_off(int i, const AnyVector& n, double change, std::vector<Wall>& walls, Response response) {
    Motion& m = *bodies_[static_cast<std::size_t>(i)].motion;
    m.velocity -= change * n;
    if (response == Response::slide) {
      for (const Wall& wall : walls) {
        if (wall.body != i || !(m.velocity.dot(wall.normal) > 0)) continue;
        if (dimension_ == 3) {
          const Eigen::Vector3d crease = Eigen::Vector3d(n).cross(Eigen::Vector3d(wall.normal)).stableNormalized(), v = m.velocity;
          m.velocity = crease * crease.dot(v);
        } else {
          m.velocity.setZero();
        }
      }
    }
    walls.push_back({i, n});
    axes_.push_back({i, n});
  }

  void emit_response(double now, const Meeting& m, const std::vector<AnyVector>& before) {
    responded_ = true;
    if (!trace_) return;
    const std::vector<AnyVector> after{velocity(m.pair.first), velocity(m.pair.second)};
    (*trace_)(world::ImpulseApplied{now, {m.pair.first, m.pair.second}, m.gap.witness_a, m.gap.normal, AnyVector(after[1] - before[1]), before, after});
    state(now);
  }

  void state(double now) {
    std::vector<FinalState> kept = states();
    std::vector<world::BodyState> views;
    for (const FinalState& s : kept) views.push_back({s.position, s.orientation, s.velocity, s.angular_velocity});
    (*trace_)(world::State{now, views, 0, AnyVector::Zero(dimension_)});
  }

  // --- The answer --------------------------------------------------------------------------------------------------------------

  /// The first meeting is the answer; what follows are responses.
  void note(const Meeting& meeting) {
    first_ = last_ = meeting;
    if (meeting.status == CastStatus::hit || meeting.status == CastStatus::initially_overlapping) touching_at_ = surely_touching(meeting);
  }

  /// A time at which the pair certainly touches: now, or a little later, and if that is too little, a little more.
  std::optional<double> surely_touching(const Meeting& m) {
    if (!m.gap.known && at_start_.penetration == Penetration::none) return m.time;
    const double first = std::max(2 * m.gap.distance / std::max(m.gap.bound, 1e-300), 4e-16);
    double step = 0;
    for (int k = 0; k < 60 && m.time + step <= 1; ++k, step = std::max(first, 2 * step)) {
      TraceNumbers unused;
      const Result r = solve_static(pair_at(m.pair, m.time + step), inner_, nullptr, unused);
      supports_ += r.support_calls;
      if (*r.upper_bound <= 0) return m.time + step;
    }
    return std::nullopt;
  }

  void ended(const Meeting& m) {
    if (!trace_) return;
    if (m.status == CastStatus::initially_overlapping && !m.gap.known)
      (*trace_)(world::Warning{"way-out-unknown", at_start_.penetration == Penetration::none
                                                       ? "The bodies overlap, which is proven. With penetration \"none\" the nearest way out is not looked for: the result has no normal and no witness points."
                                                       : "The bodies overlap, which is proven. The search for the nearest way out came to its limit: the result has no normal and no witness points."});
    std::vector<int> pair;
    if (m.pair.first >= 0 && m.status != CastStatus::miss) pair = {m.pair.first, m.pair.second};
    (*trace_)(world::CastEnded{iterations_, m.status, m.time, pair});
  }

  Result result() const {
    Result r;
    r.status = first_.status;
    r.intersecting = first_.status == CastStatus::hit || first_.status == CastStatus::initially_overlapping;
    r.iterations = iterations_, r.support_calls = supports_;
    r.time = first_.time, r.touching_at = touching_at_;
    if (r.intersecting) {
      r.pair = {first_.pair.first, first_.pair.second};
    }
    if (r.intersecting && first_.gap.known) {
      r.normal = first_.gap.normal, r.witness_a = first_.gap.witness_a, r.witness_b = first_.gap.witness_b;
    }
    if (responded_) r.bodies = states();
    return r;
  }

  /// Below this share of the speed a pair slides and does not approach.
  static constexpr double sliding_ = 1e-12;

  const Scene& scene_;
  const Settings& settings_;
  const Settings at_start_;  ///< of GJK's first runs
  const Settings inner_;     ///< of all others: the same, with a depth
  std::map<std::pair<const Shape*, const Shape*>, std::vector<SimplexPoint>> simplices_;  ///< of Start::previous
  TraceSink* trace_;
  double target_ = 0, start_ = 0;
  std::vector<std::vector<Shape>> parts_;
  std::vector<Pair> pairs_;
  std::vector<Wall> axes_;  ///< of all responses so far
  TraceNumbers numbers_;
  int iterations_ = 0, supports_ = 0;
  bool responded_ = false;
  Meeting first_, last_;
  std::optional<double> touching_at_;
};

}  // namespace

Result cast(const Scene& scene, const Settings& settings, TraceSink* trace) { return Caster(scene, settings, trace).run(); }

}  // namespace gjkdbg
