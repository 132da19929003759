// The trace: what happened, as events, and where they go.
//
// An event is a view: values and spans into the algorithm's own storage, valid during the call of the sink
// only. A sink is anything callable with every event; nothing flows back. `NoTrace` compiles to nothing.
// Each event declares its fields once, by name and member; the JSON codec, the schema test, the inspector and
// the tests' event log all walk that declaration. Events are templates over the vector type and the list type:
//   algorithm   Vector<D, S> in the working frame,   Viewed   (body 0's axes from its core's reference point; of the
//               closed form the world's axes from body 0's position; lengths times `scale`)
//   solve()     AnyVector in the world's frame,      Viewed   (what a sink sees)
//   recording   AnyVector in the world's frame,      Owned
#pragma once

#include <type_traits>
#include <utility>

#include "algo/event.h"
#include "algo/motion_events.h"

namespace gjkdbg {

/// Where a support query came from.
enum class Phase { gjk, seed, epa, mpr, sat, cast, projections };
inline constexpr std::array<std::string_view, 7> phase_names{"gjk", "seed", "epa", "mpr", "sat", "cast", "projections"};
constexpr std::string_view word_of(Phase x) { return phase_names[static_cast<std::size_t>(x)]; }

/// What a separating axis was taken from.
enum class AxisSource {
  face_a, face_b, edge_pair,
  outline  ///< of a section with an ellipse: a direction between two that are known
};
inline constexpr std::array<std::string_view, 4> axis_source_names{"face_a", "face_b", "edge_pair", "outline"};
constexpr std::string_view word_of(AxisSource x) { return axis_source_names[static_cast<std::size_t>(x)]; }

/// A face of the polytope: D vertices, counter-clockwise seen from outside; `normal` is a unit vector pointing
/// outwards; `distance` is the signed distance of its plane from the origin (negative: the origin is outside).
/// Of the core difference: radii are not included.
template <class V, class Store>
struct FaceEvent {
  int face = -1;
  ListOf<Store, int> vertices;
  V normal;
  double distance = 0;
  static constexpr auto fields() {
    return std::tuple(field("face", &FaceEvent::face), field("vertices", &FaceEvent::vertices),
                      field("normal", &FaceEvent::normal), field("distance", &FaceEvent::distance));
  }
};

template <class V, class Store>
struct GjkBegan {
  static constexpr std::string_view kind = "gjk_began";
  V direction;  ///< the first search direction, not normalised
  static constexpr auto fields() { return std::tuple(field("direction", &GjkBegan::direction)); }
};

/// Vertex `vertex` of the difference: w = a - b is its farthest point along `direction`. The points are those of
/// the cores: a sphere answers with its centre, a margin is left out; of boolean GJK, MPR and a ray cast those of the bodies.
template <class V, class Store>
struct SupportQueried {
  static constexpr std::string_view kind = "support_queried";
  int iteration = 0;
  Phase phase = Phase::gjk;
  V direction;
  int vertex = -1;
  V a, b, w;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &SupportQueried::iteration), field("phase", &SupportQueried::phase),
                      field("direction", &SupportQueried::direction), field("vertex", &SupportQueried::vertex),
                      field("a", &SupportQueried::a), field("b", &SupportQueried::b), field("w", &SupportQueried::w));
  }
};

/// A vertex of the last run's simplex, where the bodies have carried its points since: a of body 0, b of body 1, w = a - b. It lies in the
/// difference, though no longer always on its border.
template <class V, class Store>
struct VertexKept {
  static constexpr std::string_view kind = "vertex_kept";
  int vertex = -1;
  V a, b, w;
  static constexpr auto fields() {
    return std::tuple(field("vertex", &VertexKept::vertex), field("a", &VertexKept::a), field("b", &VertexKept::b), field("w", &VertexKept::w));
  }
};

/// The simplex `before` was cut down to `region`, whose hull holds the point `closest` to the origin, with
/// `barycentric` weights in the order of `region`. Vertices newest first. The bounds are of the signed distance of
/// the bodies, radii included. Boolean GJK computes neither weights nor closest point nor bounds: they are
/// empty (`barycentric`, `closest`) and NaN (null in a file).
template <class V, class Store>
struct SimplexReduced {
  static constexpr std::string_view kind = "simplex_reduced";
  int iteration = 0;
  ListOf<Store, int> before, region;
  ListOf<Store, double> barycentric;
  V closest;
  double lower_bound = 0, upper_bound = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &SimplexReduced::iteration), field("before", &SimplexReduced::before),
                      field("region", &SimplexReduced::region), field("barycentric", &SimplexReduced::barycentric),
                      field("closest", &SimplexReduced::closest), field("lower_bound", &SimplexReduced::lower_bound),
                      field("upper_bound", &SimplexReduced::upper_bound));
  }
};

template <class V, class Store>
struct GjkEnded {
  static constexpr std::string_view kind = "gjk_ended";
  int iteration = 0;
  GjkStatus status = GjkStatus::converged;
  double lower_bound = 0, upper_bound = 0;  ///< of the signed distance of the bodies
  static constexpr auto fields() {
    return std::tuple(field("iteration", &GjkEnded::iteration), field("status", &GjkEnded::status),
                      field("lower_bound", &GjkEnded::lower_bound), field("upper_bound", &GjkEnded::upper_bound));
  }
};

/// What EPA begins with: its vertices and all faces. Distances are of the cores' difference.
template <class V, class Store>
struct PolytopeSeeded {
  static constexpr std::string_view kind = "polytope_seeded";
  ListOf<Store, int> vertices;
  ListOf<Store, FaceEvent<V, Store>> faces;
  static constexpr auto fields() {
    return std::tuple(field("vertices", &PolytopeSeeded::vertices), field("faces", &PolytopeSeeded::faces));
  }
};

/// The face nearest the origin, whose normal (unit, outwards) is asked along next. `distance`: of its plane from the origin, signed, of the cores' difference.
template <class V, class Store>
struct FaceChosen {
  static constexpr std::string_view kind = "face_chosen";
  int iteration = 0;
  int face = -1;
  V normal;
  double distance = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &FaceChosen::iteration), field("face", &FaceChosen::face),
                      field("normal", &FaceChosen::normal), field("distance", &FaceChosen::distance));
  }
};

/// Vertex `vertex` joined the polytope: the faces that saw it were `removed`, leaving the `horizon` (edges in
/// order, each as the removed side had it; in 2D a single pair of vertices, in 1D empty), closed by the faces
/// `added`. The bounds are of the penetration depth of the bodies, radii included.
template <class V, class Store>
struct PolytopeGrown {
  static constexpr std::string_view kind = "polytope_grown";
  int iteration = 0;
  int vertex = -1;
  ListOf<Store, int> removed;
  ListOf<Store, Edge> horizon;
  ListOf<Store, FaceEvent<V, Store>> added;
  double lower_bound = 0, upper_bound = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &PolytopeGrown::iteration), field("vertex", &PolytopeGrown::vertex),
                      field("removed", &PolytopeGrown::removed), field("horizon", &PolytopeGrown::horizon),
                      field("added", &PolytopeGrown::added), field("lower_bound", &PolytopeGrown::lower_bound),
                      field("upper_bound", &PolytopeGrown::upper_bound));
  }
};

/// `face` is the answering face (-1 when the difference is flat), `normal` points from body 0 to body 1, `depth` is
/// that of the bodies, radii included.
template <class V, class Store>
struct EpaEnded {
  static constexpr std::string_view kind = "epa_ended";
  int iteration = 0;
  EpaStatus status = EpaStatus::converged;
  int face = -1;
  V normal;
  double depth = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &EpaEnded::iteration), field("status", &EpaEnded::status),
                      field("face", &EpaEnded::face), field("normal", &EpaEnded::normal),
                      field("depth", &EpaEnded::depth));
  }
};

/// MPR starts at a point inside the difference, from which it looks towards the origin.
template <class V, class Store>
struct MprBegan {
  static constexpr std::string_view kind = "mpr_began";
  V interior;  ///< a - b of two inner points
  static constexpr auto fields() { return std::tuple(field("interior", &MprBegan::interior)); }
};

/// The portal: D vertices of the difference that the ray from the interior point through the origin passes between. `normal` is
/// a unit vector away from the interior point, `distance` the signed distance of the portal's plane from the origin (negative:
/// the origin is still beyond it). The bounds are of the signed distance of the bodies; null where nothing is known.
template <class V, class Store>
struct PortalFound {
  static constexpr std::string_view kind = "portal_found";
  int iteration = 0;
  ListOf<Store, int> vertices;
  V normal;
  double distance = 0;
  double lower_bound = 0, upper_bound = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &PortalFound::iteration), field("vertices", &PortalFound::vertices),
                      field("normal", &PortalFound::normal), field("distance", &PortalFound::distance),
                      field("lower_bound", &PortalFound::lower_bound), field("upper_bound", &PortalFound::upper_bound));
  }
};

/// `normal` and `depth`: moving body 1 by depth * normal separates the bodies, though not always by the shortest way. Negative when
/// `separated`: the bodies are at least that far apart.
template <class V, class Store>
struct MprEnded {
  static constexpr std::string_view kind = "mpr_ended";
  int iteration = 0;
  MprStatus status = MprStatus::converged;
  V normal;
  double depth = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &MprEnded::iteration), field("status", &MprEnded::status),
                      field("normal", &MprEnded::normal), field("depth", &MprEnded::depth));
  }
};

/// How many axes there are to test, by where they come from.
template <class V, class Store>
struct SatBegan {
  static constexpr std::string_view kind = "sat_began";
  int faces_a = 0, faces_b = 0, edge_pairs = 0;
  static constexpr auto fields() {
    return std::tuple(field("faces_a", &SatBegan::faces_a), field("faces_b", &SatBegan::faces_b),
                      field("edge_pairs", &SatBegan::edge_pairs));
  }
};

/// Along the unit axis `direction` (from body 0 towards body 1) the bodies are `distance` apart; negative: they overlap by
/// that much. `vertex` is the support that says so. `lower_bound` is of the bodies' signed distance, by the widest axis so far; `upper_bound` is NaN
/// (null in a file), for axes give none, but of an outline that is not all edges (algo/outline_depth.h).
template <class V, class Store>
struct AxisTested {
  static constexpr std::string_view kind = "axis_tested";
  int iteration = 0;
  AxisSource source = AxisSource::face_a;
  int vertex = -1;
  V direction;
  double distance = 0;
  double lower_bound = 0, upper_bound = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &AxisTested::iteration), field("source", &AxisTested::source),
                      field("vertex", &AxisTested::vertex), field("direction", &AxisTested::direction),
                      field("distance", &AxisTested::distance), field("lower_bound", &AxisTested::lower_bound),
                      field("upper_bound", &AxisTested::upper_bound));
  }
};

/// A point of each core, `b` the nearest to the one before (or to the point predicted) and `a` the nearest to `b`; `closest` is a - b. Also of two boxes or
/// polygons no axis of which tells the distance (of boxes the nearest at once; then `b` is the nearest to the last `a`). The bounds are of the bodies' signed distance.
template <class V, class Store>
struct PointsProjected {
  static constexpr std::string_view kind = "points_projected";
  int iteration = 0;
  V a, b, closest;
  double lower_bound = 0, upper_bound = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &PointsProjected::iteration), field("a", &PointsProjected::a), field("b", &PointsProjected::b),
                      field("closest", &PointsProjected::closest), field("lower_bound", &PointsProjected::lower_bound),
                      field("upper_bound", &PointsProjected::upper_bound));
  }
};

/// `normal` is the axis of least overlap or, when `separated`, the one that separates, the direction between the nearest points where these are known;
/// `distance` as in AxisTested.
template <class V, class Store>
struct SatEnded {
  static constexpr std::string_view kind = "sat_ended";
  int iteration = 0;
  SatStatus status = SatStatus::overlapping;
  V normal;
  double distance = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &SatEnded::iteration), field("status", &SatEnded::status),
                      field("normal", &SatEnded::normal), field("distance", &SatEnded::distance));
  }
};

/// The cores are segments (or points): their difference is corner + s edge_a - t edge_b, 0 <= s, t <= 1.
template <class V, class Store>
struct ClosedFormBegan {
  static constexpr std::string_view kind = "closed_form_began";
  V corner, edge_a, edge_b;
  static constexpr auto fields() {
    return std::tuple(field("corner", &ClosedFormBegan::corner), field("edge_a", &ClosedFormBegan::edge_a), field("edge_b", &ClosedFormBegan::edge_b));
  }
};

/// Where the lines through the segments are nearest to each other (a point to a line), in or out of range. A parameter is NaN (null in a file)
/// where its own core is a point; both are where the lines are parallel.
template <class V, class Store>
struct LinesSolved {
  static constexpr std::string_view kind = "lines_solved";
  double s = 0, t = 0;
  static constexpr auto fields() { return std::tuple(field("s", &LinesSolved::s), field("t", &LinesSolved::t)); }
};

/// `closest` is the point of the difference nearest to the origin, or, when `overlapping`, of its border; s and t are the parameters that give
/// it. `normal` points from body 0 to body 1 (zero when they overlap and only that was asked). The bounds are of the bodies' signed distance.
template <class V, class Store>
struct ClosedFormEnded {
  static constexpr std::string_view kind = "closed_form_ended";
  ClosedFormStatus status = ClosedFormStatus::separated;
  double s = 0, t = 0;
  V closest, normal;
  double lower_bound = 0, upper_bound = 0;
  static constexpr auto fields() {
    return std::tuple(field("status", &ClosedFormEnded::status), field("s", &ClosedFormEnded::s), field("t", &ClosedFormEnded::t),
                      field("closest", &ClosedFormEnded::closest), field("normal", &ClosedFormEnded::normal),
                      field("lower_bound", &ClosedFormEnded::lower_bound), field("upper_bound", &ClosedFormEnded::upper_bound));
  }
};

/// Projections begin at this point of body 0's core.
template <class V, class Store>
struct ProjectionsBegan {
  static constexpr std::string_view kind = "projections_began";
  V point;
  static constexpr auto fields() { return std::tuple(field("point", &ProjectionsBegan::point)); }
};

/// Where Newton's step, or part of it, expects body 0's nearest point: what is projected next.
template <class V, class Store>
struct PointPredicted {
  static constexpr std::string_view kind = "point_predicted";
  int iteration = 0;
  V point;
  static constexpr auto fields() { return std::tuple(field("iteration", &PointPredicted::iteration), field("point", &PointPredicted::point)); }
};

/// The bounds are of the bodies' signed distance.
template <class V, class Store>
struct ProjectionsEnded {
  static constexpr std::string_view kind = "projections_ended";
  int iteration = 0;
  ProjectionsStatus status = ProjectionsStatus::undecided;
  double lower_bound = 0, upper_bound = 0;
  static constexpr auto fields() {
    return std::tuple(field("iteration", &ProjectionsEnded::iteration), field("status", &ProjectionsEnded::status),
                      field("lower_bound", &ProjectionsEnded::lower_bound), field("upper_bound", &ProjectionsEnded::upper_bound));
  }
};

/// `code`: a short word that programs can rely on; `message`: for people.
template <class V, class Store>
struct Warning {
  static constexpr std::string_view kind = "warning";
  typename Store::Text code, message;
  static constexpr auto fields() {
    return std::tuple(field("code", &Warning::code), field("message", &Warning::message));
  }
};

template <class... Events>
struct EventList {};

/// Every kind of event: what a sink is asked to take and a recording can hold.
template <class V, class Store>
using AllEvents = EventList<GjkBegan<V, Store>, VertexKept<V, Store>, SupportQueried<V, Store>, SimplexReduced<V, Store>, GjkEnded<V, Store>,
                            PolytopeSeeded<V, Store>, FaceChosen<V, Store>, PolytopeGrown<V, Store>, EpaEnded<V, Store>,
                            MprBegan<V, Store>, PortalFound<V, Store>, MprEnded<V, Store>, SatBegan<V, Store>,
                            AxisTested<V, Store>, PointsProjected<V, Store>, SatEnded<V, Store>, ClosedFormBegan<V, Store>, LinesSolved<V, Store>,
                            ClosedFormEnded<V, Store>, ProjectionsBegan<V, Store>, PointPredicted<V, Store>, ProjectionsEnded<V, Store>, CastBegan<V, Store>, CastAdvanced<V, Store>,
                            CastEnded<V, Store>, State<V, Store>, ContactFound<V, Store>, ImpulseApplied<V, Store>,
                            Warning<V, Store>>;

/// The sink that costs nothing.
struct NoTrace {
  template <class Event>
  constexpr void operator()(const Event&) const noexcept {}
};

template <class Trace>
inline constexpr bool traced = !std::is_base_of_v<NoTrace, std::remove_cvref_t<Trace>>;

}  // namespace gjkdbg
