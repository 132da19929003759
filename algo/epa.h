// EPA: how deep the origin lies inside the difference A - B, and which way out is shortest.
//
// van den Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game Objects", GDC 2001. A polytope
// inside A - B that holds the origin grows towards the boundary:
//   f = nearest face                       its distance is a lower bound of the depth
//   w = support(normal of f)               normal . w is an upper bound: moving that far along the normal separates
//   stop when the bounds meet; else add w (algo/polytope.h)
// Deviations: the start may be a simplex of any rank, or more than one (algo/epa_start.h); faces are ordered by *signed* distance, so that a
// start which misses the origin by rounding grows until it holds it; the answer is the direction with the least upper
// bound met, with the face it came from; where precision ends, it is the last good one and the gap is reported.
#pragma once

#include <cmath>
#include <numeric>

#include "algo/epa_result.h"
#include "algo/epa_start.h"
#include "algo/signed_volumes.h"

namespace gjkdbg {

template <class Difference, class Trace>
class Epa {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;
  using Face = PolytopeFace<D, S>;

 public:
  Epa(Difference& difference, const EpaOptions<S>& options, EpaWorkspace<D, S>& workspace, Trace& trace)
      : difference_(difference), options_(options), workspace_(workspace), polytope_(workspace.polytope), trace_(trace),
        floor_(difference.rounding_floor()) {}

  EpaResult<D, S> run(const Simplex<D, S>& simplex) {
    polytope_.clear(floor_);
    EpaStart<Difference, Trace> start(difference_, polytope_, trace_);
    if (!start.run(simplex)) return finish_flat(simplex, start.flat());
    if (!enclose_origin()) return finish(EpaStatus::separated);
    trace_seeded();
    return finish(expand());
  }

 private:
  // --- The loop -----------------------------------------------------------------------------------------------

  EpaStatus expand() {
    while (true) {
      const int number = polytope_.nearest();
      const Face& face = polytope_.faces()[number];
      trace_(FaceChosen<V, Viewed>{result_.iterations, number, face.normal, face.distance});
      if (result_.iterations >= options_.max_iterations) return limit_reached(number, face);
      ++result_.iterations;
      const int newest = polytope_.add([&] { return query(face.normal, Phase::epa); });
      const Point& point = polytope_.points()[newest];
      const S height = face.normal.dot(point.w);
      offer(number, face, height, point);
      if (height < 0 && face.distance < 0) return EpaStatus::separated;
      if (best_height_ - face.distance <= options_.tolerance * best_height_ + floor_) return EpaStatus::converged;
      if (is_corner(face, point.w) || !polytope_.grow(newest, number)) return EpaStatus::stalled;
      trace_grown(point.vertex);
    }
  }

  /// A support that is a corner of the face it was to lie beyond: the two differ by rounding alone.
  bool is_corner(const Face& face, const V& w) const {
    bool corner = false;
    for (const int i : face.vertices) corner |= ((at(i) - w).array() == 0).all();
    return corner;
  }

  /// The answer at the limit: the best direction so far; with none yet, the nearest face's.
  EpaStatus limit_reached(int number, const Face& face) {
    lower_ = face.distance;
    if (result_.face < 0) {
      const Point point = query(face.normal, Phase::epa);
      offer(number, face, face.normal.dot(point.w), point);
    }
    return EpaStatus::iteration_limit;
  }

  /// Keeps the direction with the least support: the depth is at most `height`. The nearest face bounds it from below.
  void offer(int number, const Face& face, S height, const Point& point) {
    lower_ = face.distance;
    const bool better = (height < best_height_) | (result_.face < 0);
    const S reach_a = face.normal.dot(point.a);
    if (!difference_.polytope() && better) best_ = point;
    // From here on choices and no branches: no processor can guess them.
    best_height_ = better ? height : best_height_;
    reach_a_ = better ? reach_a : reach_a_;
    result_.face ^= (result_.face ^ number) & -static_cast<int>(better);
  }

  Point query(const V& d, Phase phase) { return queried_support(difference_, trace_, result_.iterations, phase, d); }
  const V& at(int i) const { return polytope_.points()[i].w; }

  // --- The start encloses the origin ----------------------------------------------------------------------------

  /// Grows the start until no face has the origin outside. False when a support plane proves that it lies outside A - B.
  bool enclose_origin() {
    result_.face = -1, best_height_ = std::numeric_limits<S>::infinity();
    for (int i = 0; i < options_.max_iterations; ++i) {
      const int number = polytope_.nearest();
      const Face face = polytope_.faces()[number];
      if (face.distance >= -floor_) return true;
      const Point point = query(face.normal, Phase::seed);
      const S height = face.normal.dot(point.w);
      if (height < 0 && height - face.distance <= floor_) {
        offer(number, face, height, point);
        return false;
      }
      if (!polytope_.grow(polytope_.add_point(point), number)) return true;
    }
    return true;
  }

  // --- The end ------------------------------------------------------------------------------------------------

  /// A - B lies in a plane (or what spans less). Its support across that, to the nearer side, is the plane's distance from the origin, negative: more
  /// than rounding, and the bodies are apart by as much, however little GJK could tell. No farther than its simplex.
  EpaResult<D, S> finish_flat(Simplex<D, S> simplex, const FlatDifference<V>& flat) {
    if (simplex.size() == D + 1) weigh_enclosing(simplex);
    best_height_ = flat.height, result_.normal = flat.normal;
    if (best_height_ < -floor_) {
      lower_ = std::min(best_height_, -(simplex.point_a() - simplex.point_b()).norm());
      return finish(EpaStatus::separated);
    }
    lower_ = std::min(S(0), best_height_), best_height_ = 0;
    return finish(EpaStatus::flat);
  }

  EpaResult<D, S> finish(EpaStatus status) {
    result_.status = status;
    if (status == EpaStatus::separated && !polytope_.faces().empty()) lower_ = std::min(lower_, -reach_of_nearest_face());
    result_.depth = best_height_ == 0 ? S(0) : best_height_;
    result_.lower_bound = lower_ - floor_;
    result_.upper_bound = best_height_ + floor_;
    if (result_.face >= 0) {
      const Face& answer = polytope_.faces()[static_cast<std::size_t>(result_.face)];
      result_.normal = answer.normal;
      set_points(answer.vertices);
    }
    const double radius = static_cast<double>(difference_.radius());
    trace_(EpaEnded<V, Viewed>{result_.iterations, status, result_.face, result_.normal, result_.depth + radius});
    return result_;
  }

  /// The origin's projection on the answering plane, as a combination of a face's vertices. Where that plane carries several
  /// faces, the projection lies in one of them only, not always in the one that was asked first: an edge of A and one of B make a parallelogram of two.
  void set_points(const std::array<int, D>& asked_first) {
    std::array<int, D> vertices;
    std::array<S, D> weights;
    S miss = std::numeric_limits<S>::infinity();
    const auto take = [&](const std::array<int, D>& corners, bool wide) {
      const auto found = weights_in(corners, wide);
      if (const S error = projection_error(corners, found); !(error >= miss)) miss = error, weights = found, vertices = corners;
    };
    take(asked_first, false);
    for (const bool wide : {false, true}) {
      if (wide && miss > floor_) take(asked_first, true);
      for (const Face& face : polytope_.faces()) {
        if (!(miss > floor_)) break;
        if (!face.removed && face.distance <= best_height_ + 8 * floor_ && face.normal.dot(result_.normal) >= S(0.999)) take(face.vertices, wide);
      }
    }
    for (int i = 0; i < D; ++i) {
      result_.point_a += weights[i] * polytope_.points()[vertices[i]].a;
      result_.point_b += weights[i] * polytope_.points()[vertices[i]].b;
    }
    if (difference_.polytope()) return;
    // Of round bodies these lie within the chords; each body reaches as far along the normal as its support did.
    const V& n = result_.normal;
    const S short_a = reach_a_ - n.dot(result_.point_a), short_b = reach_a_ - best_height_ - n.dot(result_.point_b);
    result_.point_a += n * short_a, result_.point_b += n * short_b;
    // Where the origin's projection lies beside the face, they are off across the normal too; where all faces there are slivers, that is rounding's, they lie far within. The points of the support lie on
    // their bodies, and may be off by less.
    const auto off = [&](const V& a, const V& b) { return V(a - b - n * best_height_).norm(); };
    if (off(best_.a, best_.b) < off(result_.point_a, result_.point_b) + std::abs(short_a) + std::abs(short_b)) result_.point_a = best_.a, result_.point_b = best_.b;
  }

  /// How far from the origin a point of A - B lies: the plane of a face alone would be nearer, where the origin is beside the face.
  S reach_of_nearest_face() {
    return std::sqrt(SignedVolumes<D, S>::closest(corners(polytope_.faces()[polytope_.nearest()].vertices).data(), D).v_squared);
  }

  std::array<V, D> corners(const std::array<int, D>& vertices) const {
    std::array<V, D> w;
    for (int i = 0; i < D; ++i) w[i] = at(vertices[i]);
    return w;
  }
  std::array<S, D> weights_in(const std::array<int, D>& vertices, bool wide) const { return projection_weights<D, S>(corners(vertices), result_.normal, wide); }

  S projection_error(const std::array<int, D>& vertices, const std::array<S, D>& weights) const {
    V w = -result_.normal * best_height_;
    for (int i = 0; i < D; ++i) w += weights[i] * polytope_.points()[vertices[i]].w;
    return w.norm();
  }

  // --- The trace: indices into the polytope's points become vertex numbers ---------------------------------------

  int vertex_number(int i) const { return polytope_.points()[i].vertex; }

  void describe(const std::vector<int>& faces) {
    auto& events = workspace_.face_events;
    auto& vertices = workspace_.face_vertices;
    events.clear();
    vertices.resize(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const Face face = polytope_.sharpened(faces[i]);
      for (int k = 0; k < D; ++k) vertices[i][k] = vertex_number(face.vertices[k]);
      events.push_back({faces[i], std::span<const int>(vertices[i]), face.normal, face.distance});
    }
  }

  void trace_seeded() {
    if constexpr (traced<Trace>) {
      std::vector<int> faces;
      auto& vertices = workspace_.numbers;
      vertices.clear();
      for (std::size_t f = 0; f < polytope_.faces().size(); ++f) {
        if (polytope_.faces()[f].removed) continue;
        faces.push_back(static_cast<int>(f));
        for (const int i : polytope_.faces()[f].vertices)
          if (std::find(vertices.begin(), vertices.end(), vertex_number(i)) == vertices.end()) vertices.push_back(vertex_number(i));
      }
      describe(faces);
      trace_(PolytopeSeeded<V, Viewed>{vertices, workspace_.face_events});
    }
  }

  void trace_grown(int vertex) {
    if constexpr (traced<Trace>) {
      const Growth& growth = polytope_.growth();
      auto& edges = workspace_.edges;
      edges.clear();
      const Face* added_faces = polytope_.faces().data() + growth.first_added;
      if constexpr (D == 2) edges.push_back({vertex_number(added_faces[0].vertices[0]), vertex_number(added_faces[1].vertices[1])});
      if constexpr (D == 3)
        for (int i = 0; i < growth.added; ++i) edges.push_back({vertex_number(added_faces[i].vertices[0]), vertex_number(added_faces[i].vertices[1])});
      std::vector<int> added(static_cast<std::size_t>(growth.added));
      std::iota(added.begin(), added.end(), growth.first_added);
      describe(added);
      const double radius = static_cast<double>(difference_.radius());
      const double lower = static_cast<double>(polytope_.faces()[polytope_.nearest()].distance - floor_);
      trace_(PolytopeGrown<V, Viewed>{result_.iterations, vertex, growth.removed, edges, workspace_.face_events, lower + radius,
                                      static_cast<double>(best_height_ + floor_) + radius});
    }
  }

  Difference& difference_;
  const EpaOptions<S>& options_;
  EpaWorkspace<D, S>& workspace_;
  Polytope<D, S>& polytope_;
  Trace& trace_;
  const S floor_;
  EpaResult<D, S> result_;
  S best_height_ = std::numeric_limits<S>::infinity();
  Point best_;     ///< of round bodies: the support of that height
  S reach_a_ = 0;  ///< of A along the direction of the best height: B's share is the rest
  S lower_ = 0;
};

/// Runs EPA from the simplex GJK ended with: the origin lies in its hull, to rounding. Frame of body 0.
template <class Difference, class Trace>
auto epa(Difference& difference, const Simplex<Difference::D, typename Difference::S>& simplex,
         const EpaOptions<typename Difference::S>& options, EpaWorkspace<Difference::D, typename Difference::S>& workspace,
         Trace& trace) {
  return Epa<Difference, Trace>(difference, options, workspace, trace).run(simplex);
}

}  // namespace gjkdbg
