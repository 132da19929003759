// check, the runs of GJK and EPA inside a motion: each is that of two bodies at rest, where they are then, and is judged as one.
#include <algorithm>
#include <optional>
#include <utility>

#include "algo/motion.h"
#include "recordings/check_context.h"
#include "recordings/mesh_parts.h"
#include "recordings/replay.h"

namespace gjkdbg {
namespace {

class Runs {
 public:
  explicit Runs(CheckContext& context) : c_(context), events_(context.recording.events), replay_(context.recording) {}

  void run() {
    if (!by_gjk()) return;
    for (std::size_t i = 0; i < events_.size() && told_ < enough; ++i)
      if (std::holds_alternative<recorded::GjkBegan>(events_[i]) && !begins_again(c_.recording, i)) judge(i, end_of(i));
  }

 private:
  using Two = std::array<int, 2>;
  struct Part {
    std::size_t first, last;  ///< events, the last one not included
  };
  struct Candidate {
    Two pair, triangles;
    std::size_t until;  ///< the first step that there is something to find in, if it were these
  };
  static constexpr int enough = 8;  ///< runs with findings: a wrong one is looked at with every pair and triangle

  /// MPR and SAT hand over to GJK in the middle of a query, which then begins elsewhere.
  bool by_gjk() const {
    const Settings& s = c_.recording.settings;
    const bool other = s.name == MethodName::mpr || s.name == MethodName::sat || s.name == MethodName::projections || s.name == MethodName::closed_form;
    return !other && s.penetration != Penetration::mpr;
  }

  std::size_t end_of(std::size_t first) const {
    std::size_t i = first + 1;
    while (i < events_.size() && (of_a_run(events_[i]) || begins_again(c_.recording, i))) ++i;
    return i;
  }
  static bool of_a_run(const Event& e) {
    return std::holds_alternative<recorded::VertexKept>(e) || std::holds_alternative<recorded::SupportQueried>(e) || std::holds_alternative<recorded::SimplexReduced>(e) || std::holds_alternative<recorded::GjkEnded>(e) ||
           std::holds_alternative<recorded::PolytopeSeeded>(e) || std::holds_alternative<recorded::FaceChosen>(e) || std::holds_alternative<recorded::PolytopeGrown>(e) || std::holds_alternative<recorded::EpaEnded>(e);
  }

  /// The step after the run names its bodies, of a simulation where they touch. Else any two that all of it fits will do.
  void judge(std::size_t first, std::size_t last) {
    const Frame& frame = replay_.at(first);
    const auto bodies = static_cast<int>(c_.recording.scene.scene.bodies.size());
    if (static_cast<int>(frame.places.size()) != bodies || !exist(frame.pair, bodies)) return;
    if (std::any_of(frame.places.begin(), frame.places.end(), [](const Frame::Place& p) { return !(p.position.stableNorm() <= 1e60); })) return;  // told elsewhere
    const Part run{first, last};
    std::optional<Candidate> likeliest;
    const bool named = last < events_.size() && (std::holds_alternative<recorded::CastAdvanced>(events_[last]) || std::holds_alternative<recorded::ContactFound>(events_[last]));
    for (const bool fitting : {true, false}) {
      if (clean(frame, frame.pair, run, fitting, likeliest)) return;
      for (int i = 0; !named && i < bodies; ++i)
        for (int j = i + 1; j < bodies; ++j)
          if (near(frame, {i, j}) && clean(frame, {i, j}, run, fitting, likeliest)) return;
    }
    if (!likeliest) return;
    ++told_;
    tell(frame, *likeliest, run);
  }

  /// Others are not looked at by any run of ours: those whose centres of mass, which lie within their reach r of their places, are farther apart than both reach from there, up to 2 r.
  bool near(const Frame& frame, const Two& pair) const {
    double reach = 0;
    for (const int k : pair) reach += 3 * reach_of(c_.recording.scene.scene.bodies[static_cast<std::size_t>(k)].shape, c_.dimension);
    return c_.recording.scene.scene.query == Query::cast || (frame.places[static_cast<std::size_t>(pair[0])].position - frame.places[static_cast<std::size_t>(pair[1])].position).norm() <= reach;
  }
  static bool exist(const Two& pair, int bodies) { return pair[0] != pair[1] && std::min(pair[0], pair[1]) >= 0 && std::max(pair[0], pair[1]) < bodies; }

  Recording run_of(const Frame& frame, const Candidate& of) const {
    const Scene& scene = c_.recording.scene.scene;
    Recording run;
    run.generator = c_.recording.generator;
    run.settings = static_settings(c_.recording.settings);
    Scene& two = run.scene.scene;
    two.dimension = scene.dimension;
    two.query = Query::penetration;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto i = static_cast<std::size_t>(of.pair[k]);
      const Body& whole = scene.bodies[i];  // of a mesh no copy: there is a run for each triangle
      Body body{whole.name, of.triangles[k] < 0 ? whole.shape : triangle_of(whole.shape, static_cast<std::size_t>(of.triangles[k])), whole.pose};
      body.pose.position = frame.places[i].position, body.pose.matrix = frame.places[i].rotation;
      body.pose.rotation = RotationMatrix{body.pose.matrix};
      two.bodies.push_back(std::move(body));
    }
    return run;
  }

  /// The triangle of each body, -1 of one that is no mesh: those that the supports fit (neighbours share corners), or all, which a wrong run is held against.
  std::vector<Two> triangles_of(const Frame& frame, const Two& pair, std::size_t first, bool fitting) const {
    Two counts{-1, -1};
    for (std::size_t k = 0; k < 2; ++k)
      if (const auto* mesh = std::get_if<Mesh>(&c_.recording.scene.scene.bodies[static_cast<std::size_t>(pair[k])].shape.geometry)) counts[k] = static_cast<int>(mesh->triangles.size());
    if (counts == Two{-1, -1}) return fitting ? std::vector{counts} : std::vector<Two>();
    Frame of = frame;
    of.pair = pair, of.step = first;
    if (fitting) return fitting_triangles(c_.recording, of, &finders_);
    std::vector<Two> all;
    for (int i = counts[0] < 0 ? -1 : 0; i < std::max(0, counts[0]); ++i)
      for (int j = counts[1] < 0 ? -1 : 0; j < std::max(0, counts[1]); ++j) all.push_back({i, j});
    return all;
  }

  /// Whether there is nothing to find in the run, taken for one of these two bodies. Else those are the likeliest that it fits longest, or the first of all.
  bool clean(const Frame& frame, const Two& pair, const Part& part, bool fitting, std::optional<Candidate>& likeliest) const {
    for (const Two& triangles : triangles_of(frame, pair, part.first, fitting)) {
      Candidate one{pair, triangles, 0};
      Recording run = run_of(frame, one);
      run.events.assign(events_.begin() + static_cast<std::ptrdiff_t>(part.first), events_.begin() + static_cast<std::ptrdiff_t>(part.last));
      const std::vector<Finding> found = check_steps(run, 0);
      if (found.empty()) return true;
      one.until = found.front().step;
      if (!likeliest || one.until > likeliest->until) likeliest = one;
    }
    return false;
  }

  /// Once more, with every event at its own number, which the findings name. What follows from the first error of a run is not told.
  void tell(const Frame& frame, const Candidate& of, const Part& part) {
    Recording run = run_of(frame, of);
    run.events.assign(part.first, recorded::Warning{});
    run.events.insert(run.events.end(), events_.begin() + static_cast<std::ptrdiff_t>(part.first), events_.begin() + static_cast<std::ptrdiff_t>(part.last));
    const std::size_t here = c_.step;
    for (const Finding& f : check_steps(run, part.first)) {
      c_.step = f.step;
      c_.find(f.code.c_str(), f.message, f.severity);
      if (f.severity == Finding::Severity::error) break;
    }
    c_.step = here;
  }

  CheckContext& c_;
  const std::vector<Event>& events_;
  Replay replay_;
  mutable CornerFinders finders_;
  int told_ = 0;
};

}  // namespace

void check_runs(CheckContext& context) { Runs(context).run(); }

}  // namespace gjkdbg
