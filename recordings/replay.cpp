#include "recordings/replay.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "algo/motion.h"
#include "recordings/frame_vertices.h"
#include "shapes/world_support.h"

namespace gjkdbg {
namespace {

/// What each event does to the frame.
struct Apply {
  Frame& frame;
  std::size_t step;
  const Recording& recording;
  ReplayIndex& index;

  void operator()(const recorded::GjkBegan& e) {
    fresh();
    frame.stage = Frame::Stage::gjk;
    frame.direction = e.direction;
  }

  void operator()(const recorded::VertexKept& e) {
    frame.simplex.insert(frame.simplex.begin(), e.vertex);
    frame.newest = e.vertex;
    frame.direction.reset();
  }

  void operator()(const recorded::SupportQueried& e) {
    frame.iteration = e.iteration, frame.newest = e.vertex;
    frame.direction = e.direction, frame.answered = true;
    if (e.phase == Phase::gjk) {
      frame.simplex.insert(frame.simplex.begin(), e.vertex);
      frame.barycentric.clear();
      frame.closest.reset();
    } else if (e.phase == Phase::cast) {
      frame.stage = Frame::Stage::gjk;
      const auto time = frame.time;
      const double began = last_state_time();  // the ray's supports are those of the bodies where the cast began
      places_after(began, began), frame.time = std::max(began, time.value_or(began));
    } else if (e.phase == Phase::mpr || e.phase == Phase::sat || e.phase == Phase::projections) {
      frame.stage = e.phase == Phase::mpr ? Frame::Stage::mpr : e.phase == Phase::sat ? Frame::Stage::sat : Frame::Stage::projections;
    } else {
      frame.stage = e.phase == Phase::seed ? Frame::Stage::seed : Frame::Stage::epa;
      if (e.phase == Phase::seed) frame.seeds.push_back(e.vertex);
    }
  }

  void operator()(const recorded::SimplexReduced& e) {
    frame.iteration = e.iteration;
    frame.simplex = e.region;
    for (const int v : e.before)
      if (std::find(e.region.begin(), e.region.end(), v) == e.region.end()) frame.dropped.push_back(v);
    frame.barycentric = e.barycentric;
    frame.closest.reset();
    if (e.closest.size() > 0) frame.closest = e.closest;
    next_direction(e.closest);
    bounds(e.lower_bound, e.upper_bound);
  }

  void operator()(const recorded::GjkEnded& e) {
    frame.iteration = e.iteration, frame.gjk_status = e.status;
    // A last support that was proof enough never joined the simplex.
    if (step > 0 && std::holds_alternative<recorded::SupportQueried>(recording.events[step - 1]) && !frame.simplex.empty()) frame.simplex.erase(frame.simplex.begin());
    bounds(e.lower_bound, e.upper_bound);
    frame.stage = Frame::Stage::done;
    if (const auto* last = last_reduced(); last && last->region == frame.simplex) {  // what was kept is the answer: its weights make the witnesses
      frame.barycentric = last->barycentric;
      if (last->closest.size() > 0) frame.closest = last->closest;
    }
  }

  void operator()(const recorded::PolytopeSeeded& e) {
    frame.stage = Frame::Stage::epa;
    frame.simplex.clear(), frame.seeds.clear(), frame.barycentric.clear(), frame.closest.reset(), frame.direction.reset(), frame.newest.reset();
    frame.iteration = 0;
    frame.faces.clear();
    add(e.faces);
  }

  void operator()(const recorded::FaceChosen& e) {
    frame.stage = Frame::Stage::epa;
    frame.iteration = e.iteration;
    frame.chosen = e.face;
    frame.direction = e.normal, frame.answered = false;
  }

  void operator()(const recorded::PolytopeGrown& e) {
    frame.iteration = e.iteration;
    for (const int f : e.removed) {
      const auto found = frame.faces.find(f);
      if (found == frame.faces.end()) continue;
      frame.removed.push_back(found->second);
      frame.faces.erase(found);
    }
    frame.horizon = e.horizon;
    add(e.added);
    // The depth's bounds, turned into those of the signed distance. What GJK knew holds on.
    const double lower = std::max(-e.upper_bound, frame.lower_bound.value_or(-e.upper_bound)), upper = std::min(-e.lower_bound, frame.upper_bound.value_or(-e.lower_bound));
    if (lower <= upper) bounds(lower, upper);
    else bounds(-e.upper_bound, -e.lower_bound);
  }

  void operator()(const recorded::EpaEnded& e) {
    frame.iteration = e.iteration;
    frame.epa_status = e.status;
    if (e.face >= 0) frame.chosen = e.face;
    frame.normal = e.normal, frame.depth = e.depth;
    frame.stage = Frame::Stage::done;
    bounds_of_result();
  }

  void operator()(const recorded::MprBegan& e) {
    if (frame.mpr_status) fresh();  // of a mesh's next triangle; after GJK it goes on from there
    frame.stage = Frame::Stage::mpr;
    frame.simplex.clear(), frame.barycentric.clear(), frame.closest.reset(), frame.lower_bound.reset(), frame.upper_bound.reset();
    frame.interior = e.interior, frame.direction = -e.interior, frame.answered = false;
  }

  void operator()(const recorded::PortalFound& e) {
    frame.iteration = e.iteration;
    frame.portal = e.vertices;
    frame.direction = e.normal, frame.answered = false;
    bounds(e.lower_bound, e.upper_bound);
  }

  void operator()(const recorded::MprEnded& e) {
    frame.iteration = e.iteration;
    frame.mpr_status = e.status;
    frame.stage = Frame::Stage::done;
    if (step + 1 == recording.events.size()) bounds_of_result();
    if (e.status != MprStatus::separated) frame.normal = e.normal, frame.depth = e.depth;
  }

  void operator()(const recorded::SatBegan&) {
    fresh();
    frame.stage = Frame::Stage::sat;
  }

  void operator()(const recorded::AxisTested& e) {
    frame.iteration = e.iteration;
    bounds(e.lower_bound, e.upper_bound);
  }

  void operator()(const recorded::PointsProjected& e) {
    frame.iteration = e.iteration, frame.closest = e.closest;
    frame.newest.reset(), frame.direction.reset();
    bounds(e.lower_bound, e.upper_bound);
  }

  void operator()(const recorded::SatEnded& e) {
    frame.iteration = e.iteration;
    frame.sat_status = e.status, frame.stage = Frame::Stage::done;
    if (e.status == SatStatus::overlapping) frame.normal = e.normal, frame.depth = -e.distance;
    if (step + 1 == recording.events.size()) bounds_of_result();
  }

  void operator()(const recorded::ClosedFormBegan& e) {
    fresh();
    frame.stage = Frame::Stage::closed_form;
    frame.parallelogram = {e.corner, e.edge_a, e.edge_b};
  }

  void operator()(const recorded::ClosedFormEnded& e) {
    frame.closed_form_status = e.status;
    frame.closest = e.closest;
    bounds(e.lower_bound, e.upper_bound);
    frame.stage = Frame::Stage::done;
    if (e.status == ClosedFormStatus::overlapping && e.normal.norm() > 0) frame.normal = e.normal, frame.depth = -(e.lower_bound + e.upper_bound) / 2;
  }

  void operator()(const recorded::ProjectionsBegan& e) {
    fresh();
    frame.stage = Frame::Stage::projections;
    frame.predicted = e.point;
  }

  void operator()(const recorded::PointPredicted& e) {
    frame.iteration = e.iteration;
    frame.predicted = e.point;
  }

  void operator()(const recorded::ProjectionsEnded& e) {
    frame.iteration = e.iteration;
    frame.projections_status = e.status, frame.predicted.reset();
    bounds(e.lower_bound, e.upper_bound);
    frame.stage = Frame::Stage::done;
  }

  void operator()(const recorded::LinesSolved&) {}
  void operator()(const recorded::Warning&) {}
  void operator()(const recorded::CastBegan&) {
    run_is_over();
    if (frame.places.empty()) places_after(0, 0);
  }
  void operator()(const recorded::CastAdvanced& e) {
    frame.direction.reset(), frame.newest.reset();
    frame.iteration = e.iteration, frame.pair = e.pair;
    const auto* support = step > 0 ? std::get_if<recorded::SupportQueried>(&recording.events[step - 1]) : nullptr;
    if (support && support->phase == Phase::cast) frame.time = e.time;
    else advance_to(e.time);
    frame.stage = Frame::Stage::done;
  }
  void operator()(const recorded::CastEnded& e) {
    const auto before = frame.time;
    advance_to(e.time);
    if (frame.time != before) run_is_over();  // the last run was about the bodies where they were then
    frame.iteration = e.iteration;
    if (e.pair.size() == 2) frame.pair = {e.pair[0], e.pair[1]};
    frame.stage = Frame::Stage::done;
  }
  void operator()(const recorded::State& e) {
    run_is_over();
    stand(e);
    frame.stage = Frame::Stage::done;
  }
  void operator()(const recorded::ContactFound& e) { frame.pair = e.pair, frame.direction.reset(), frame.newest.reset(); }
  void operator()(const recorded::ImpulseApplied& e) { frame.pair = e.pair, frame.direction.reset(), frame.newest.reset(); }

 private:
  void stand(const recorded::State& e) {
    frame.places.clear();
    for (const recorded::BodyState& b : e.bodies) {
      AnyMatrix rotation = AnyMatrix::Identity(b.position.size(), b.position.size());
      if (b.position.size() > 1 && b.orientation.size() == 4) {
        const Quaternion q{{b.orientation[0], b.orientation[1], b.orientation[2], b.orientation[3]}};
        const double length = std::hypot(std::hypot(q.wxyz[0], q.wxyz[1]), std::hypot(q.wxyz[2], q.wxyz[3]));
        if (std::abs(length - 1) < 1e-6) rotation = resolve(q, 3).matrix.topLeftCorner(b.position.size(), b.position.size());
      }
      frame.places.push_back({b.position, rotation, b.velocity, b.angular_velocity});
    }
    frame.time = e.time;
  }

  /// After a cut the last direction has done its part. The next one need not be -v: the boolean form has no v, and an accelerated one is led elsewhere.
  void next_direction(const AnyVector& closest) {
    const Event* after = step + 1 < recording.events.size() ? &recording.events[step + 1] : nullptr;
    frame.direction.reset(), frame.answered = false;
    if (after && std::holds_alternative<recorded::GjkEnded>(*after)) return;  // touching, say: v is rounding, and nothing is asked along it
    if (const auto* next = std::get_if<recorded::SupportQueried>(after); next && next->phase == Phase::gjk) frame.direction = next->direction;
    else if (closest.size() > 0 && !closest.isZero(0)) frame.direction = -closest;
  }

  /// Of this run of GJK; null where it has none.
  const recorded::SimplexReduced* last_reduced() const {
    for (std::size_t i = step; i-- > 0 && !std::holds_alternative<recorded::GjkBegan>(recording.events[i]);)
      if (const auto* reduced = std::get_if<recorded::SimplexReduced>(&recording.events[i])) return reduced;
    return nullptr;
  }

  void fresh() {
    run_is_over();
    if (recording.scene.scene.motion) find_pair();
  }
  /// Nothing of it holds any more, but for where the bodies are.
  void run_is_over() {
    Frame next;
    next.step = step;
    next.time = frame.time, next.pair = frame.pair, next.places = std::move(frame.places);
    frame = std::move(next);
  }

  /// Whose run begins: the event that closes it says so, and when; where none does (nothing touched), the first support tells.
  void find_pair() {
    const recorded::SupportQueried* first = nullptr;
    for (std::size_t i = step + 1; i < recording.events.size(); ++i) {
      const Event& event = recording.events[i];
      if ((kind_name(event).ends_with("_began") && !begins_again(recording, i)) || std::holds_alternative<recorded::State>(event)) break;
      if (const auto* advanced = std::get_if<recorded::CastAdvanced>(&event)) {
        frame.pair = advanced->pair;
        return advance_to(advanced->time);
      }
      if (const auto* ended = std::get_if<recorded::CastEnded>(&event)) {  // the run came to its limit, and the cast with it
        advance_to(ended->time);
        if (ended->pair.size() != 2) break;
        frame.pair = {ended->pair[0], ended->pair[1]};
        return;
      }
      if (const auto* contact = std::get_if<recorded::ContactFound>(&event)) return void(frame.pair = contact->pair);
      if (const auto* query = std::get_if<recorded::SupportQueried>(&event); query && !first) first = query;
    }
    const Scene& scene = recording.scene.scene;
    if (!first || !first->direction.allFinite() || first->direction.isZero(0) || frame.places.size() != scene.bodies.size()) return;
    const AnyVector d = first->direction.stableNormalized();
    const auto is_of = [&](std::size_t i, const AnyVector& along, const AnyVector& point) {
      const Shape& shape = scene.bodies[i].shape;
      const Frame::Place& place = frame.places[i];
      const auto* mesh = std::get_if<Mesh>(&shape.geometry);
      const CornerFinder* const corners = mesh ? &index.finders.try_emplace(mesh, *mesh).first->second : nullptr;
      const double reach = corners ? corners->extent() + shape.margin : reach_of(shape, scene.dimension), close = 1e-9 * (reach + point.norm());
      if (const bool far = (point - place.position).norm() > reach + close; far || corners) return !far && corners->any_near(place.rotation.transpose() * (point - place.position), close);
      const WorldSupport support(Body{"", shape, {place.position, {}, place.rotation}}, scene.dimension);
      return std::abs(along.dot(point - support(along, false))) <= close || std::abs(along.dot(point - support(along, true))) <= close;
    };
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      for (std::size_t j = i + 1; j < scene.bodies.size(); ++j)
        if (is_of(i, d, first->a) && is_of(j, -d, first->b)) return void(frame.pair = {static_cast<int>(i), static_cast<int>(j)});
  }

  /// From where the last state left the bodies, or where the scene has them.
  void places_after(double from, double time) {
    const Scene& scene = recording.scene.scene;
    std::vector<Frame::Place> places;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      Body body = without_shape(scene.bodies[i]);
      const bool placed = i < frame.places.size() && from > 0;
      if (placed) body.pose.position = frame.places[i].position, body.pose.matrix = frame.places[i].rotation;
      if (placed && body.motion) body.motion->velocity = frame.places[i].velocity;
      const Body at = moved(body, time - from, scene.dimension);
      Frame::Place place{at.pose.position, at.pose.matrix, AnyVector::Zero(scene.dimension), {}};
      if (at.motion) place.velocity = at.motion->velocity, place.angular_velocity = in_degrees(at.motion->angular_velocity);
      places.push_back(std::move(place));
    }
    frame.places = std::move(places);
    frame.time = time;
  }

  void advance_to(double time) { places_after(last_state_time(), time); }

  /// The time of the last response before this step; before the first, 0.
  double last_state_time() {
    const auto after = std::lower_bound(index.states.begin(), index.states.end(), step);
    if (after == index.states.begin()) return 0;
    const auto& state = std::get<recorded::State>(recording.events[*std::prev(after)]);
    if (frame.time != state.time) stand(state);
    return state.time;
  }

  void add(const std::vector<recorded::Face>& faces) {
    for (const auto& f : faces) {
      frame.faces[f.face] = {f.face, step, f.vertices, f.normal, f.distance};
      frame.added.push_back(f.face);
    }
  }
  void bounds(double lower, double upper) {
    frame.lower_bound.reset(), frame.upper_bound.reset();
    if (std::isfinite(lower)) frame.lower_bound = lower;
    if (std::isfinite(upper)) frame.upper_bound = upper;
  }
  /// For an event that ends the run and has no bounds: the last step narrowed them to the result's. (Of a motion the result is another, of a mesh
  /// that of all triangles.)
  void bounds_of_result() {
    const Result& result = recording.result;
    const auto& bodies = recording.scene.scene.bodies;
    const bool one_run = !recording.scene.scene.motion && std::none_of(bodies.begin(), bodies.end(), [](const Body& b) { return std::holds_alternative<Mesh>(b.shape.geometry); });
    if (one_run && result.lower_bound && result.upper_bound) bounds(*result.lower_bound, *result.upper_bound);
  }
};

void apply(Frame& frame, const Recording& recording, std::size_t step, ReplayIndex& index) {
  frame.step = step;
  frame.dropped.clear(), frame.removed.clear(), frame.horizon.clear(), frame.added.clear();
  std::visit(Apply{frame, step, recording, index}, recording.events[step]);
  const auto* cut = std::get_if<recorded::SimplexReduced>(&recording.events[step]);
  frame.lettered = cut ? cut->before : frame.simplex;
}

}  // namespace

Frame frame_at(const Recording& recording, std::size_t step) {
  if (step >= recording.events.size()) throw std::out_of_range("no such step");
  Frame frame;
  ReplayIndex index(recording);
  for (std::size_t i = 0; i <= step; ++i) apply(frame, recording, i, index);
  fill_vertices(frame, recording, index_vertices(recording));
  return frame;
}

ReplayIndex::ReplayIndex(const Recording& recording) {
  for (std::size_t i = 0; i < recording.events.size(); ++i)
    if (std::holds_alternative<recorded::State>(recording.events[i])) states.push_back(i);
}

Replay::Replay(const Recording& recording) : recording_(&recording), vertices_(index_vertices(recording)), index_(recording) {}

const Frame& Replay::at(std::size_t step) {
  if (step >= recording_->events.size()) throw std::out_of_range("no such step");
  if (started_ && filled_ && step == current_.step) return current_;
  if (!started_ || step < current_.step || step > current_.step + snapshot_distance) {
    const std::size_t snapshot = std::min(step / snapshot_distance, snapshots_.size());
    started_ = snapshot > 0;
    current_ = snapshot > 0 ? *snapshots_[snapshot - 1] : Frame{};
  }
  while (!started_ || current_.step < step) {
    const std::size_t next = started_ ? current_.step + 1 : 0;
    apply(current_, *recording_, next, index_);
    started_ = true;
    if ((next + 1) % snapshot_distance == 0 && snapshots_.size() < (next + 1) / snapshot_distance)
      snapshots_.push_back(std::make_shared<const Frame>(current_));
  }
  fill_vertices(current_, *recording_, vertices_);
  filled_ = true;
  return current_;
}

}  // namespace gjkdbg
