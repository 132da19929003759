// Replay: the state of the algorithm after any event of a recording.
//
// frame_at(recording, k) is what a viewer shows at step k: everything that holds after event k. Playing to a step
// and seeking to it give the same frame; Replay keeps snapshots so that seeking in long recordings stays fast.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "recordings/corner_finder.h"
#include "recordings/recording.h"

namespace gjkdbg {

/// A vertex of the difference, as its support query gave it, or kept from the last run.
struct FrameVertex {
  int vertex = -1;
  std::size_t event = 0;  ///< the support_queried or vertex_kept event it came from
  AnyVector a, b, w;
  bool operator==(const FrameVertex&) const = default;
};

struct FrameFace {
  int face = -1;
  std::size_t event = 0;  ///< the event that added it
  std::vector<int> vertices;
  AnyVector normal;
  double distance = 0;
  bool operator==(const FrameFace&) const = default;
};

struct Frame {
  std::size_t step = 0;  ///< index of the event this frame follows
  int iteration = 0;
  enum class Stage { before, gjk, seed, epa, mpr, sat, closed_form, projections, done } stage = Stage::before;

  std::optional<AnyVector> direction;  ///< the latest search direction; after a cut the one that comes next, if any does
  bool answered = false;               ///< whether `newest` is the support along `direction`
  std::optional<int> newest;           ///< vertex of the latest support query

  /// GJK: the current simplex, newest first: after a support query it holds the new vertex too. EPA starts from it and leaves it.
  std::vector<int> simplex;
  /// The vertices in the order of their letters A, B, C, D: the simplex, and at the step of a cut what it was before.
  std::vector<int> lettered;
  std::vector<int> seeds;           ///< EPA: vertices asked for to complete the start, until the polytope stands
  std::vector<int> dropped;         ///< vertices the event at `step` dropped
  std::vector<double> barycentric;  ///< in the order of `simplex`; empty when not known
  std::optional<AnyVector> closest;
  std::optional<double> lower_bound, upper_bound;  ///< of the signed distance; in EPA too (minus the depth's bounds)

  std::map<int, FrameFace> faces;          ///< EPA: the polytope
  std::optional<int> chosen;               ///< the face expanded
  std::vector<FrameFace> removed;          ///< faces the event at `step` removed
  std::vector<Edge> horizon;               ///< of the event at `step`
  std::vector<int> added;                  ///< faces the event at `step` added

  std::vector<int> portal;             ///< MPR: the portal's vertices
  std::optional<AnyVector> interior;   ///< MPR: the point inside the difference that the ray starts from

  /// Closed form: the difference of two segments, all corner + s edge_a - t edge_b with 0 <= s, t <= 1.
  struct Parallelogram {
    AnyVector corner, edge_a, edge_b;
    bool operator==(const Parallelogram&) const = default;
  };
  std::optional<Parallelogram> parallelogram;

  std::optional<AnyVector> predicted;  ///< projections: the point of body 0, or near it, that is projected next

  /// The vertices that simplex, seeds, portal, dropped, newest, faces and removed refer to.
  std::map<int, FrameVertex> vertices;

  /// Cast and simulate: the time, where each body is then, and the pair that was looked at last.
  std::optional<double> time;
  struct Place {
    AnyVector position;
    AnyMatrix rotation;
    AnyVector velocity;
    std::vector<double> angular_velocity;  ///< degrees per unit of time, as in BodyState: 3 numbers in space, 1 in the plane, none on a line
    bool operator==(const Place&) const = default;
  };
  std::vector<Place> places;
  std::array<int, 2> pair{0, 1};

  std::optional<GjkStatus> gjk_status;
  std::optional<EpaStatus> epa_status;
  std::optional<MprStatus> mpr_status;
  std::optional<SatStatus> sat_status;
  std::optional<ClosedFormStatus> closed_form_status;
  std::optional<ProjectionsStatus> projections_status;
  std::optional<AnyVector> normal;  ///< EPA's, MPR's, SAT's or the closed form's answer
  std::optional<double> depth;      ///< theirs too: of the bodies
  bool operator==(const Frame&) const = default;
};

/// Throws std::out_of_range when `step` is not an event of the recording.
Frame frame_at(const Recording& recording, std::size_t step);

/// The simplex that the last GJK run of a static scene ended with, in the bodies' frames: for Start::previous. Empty when there was none.
std::vector<SimplexPoint> last_simplex(const Recording& recording);

/// What would else be looked for in all of a recording, at every step.
struct ReplayIndex {
  explicit ReplayIndex(const Recording& recording);
  std::vector<std::size_t> states;  ///< the steps that say where the bodies are
  CornerFinders finders;
};

class Replay {
 public:
  /// Keeps a reference: the recording must outlive the replay and not change.
  explicit Replay(const Recording& recording);
  /// Stays as it is until another step is asked for.
  const Frame& at(std::size_t step);

 private:
  static constexpr std::size_t snapshot_distance = 256;
  const Recording* recording_;
  std::map<int, std::vector<std::size_t>> vertices_;  ///< the events that gave out each number
  std::vector<std::shared_ptr<const Frame>> snapshots_;  ///< after events 255, 511, …
  ReplayIndex index_;
  Frame current_;
  bool started_ = false, filled_ = false;  ///< filled: with the vertices of the step last asked for
};

}  // namespace gjkdbg
