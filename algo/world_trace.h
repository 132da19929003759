// From the frame the algorithms work in (body 0's axes, its core's reference point, scaled) to the world's.
#pragma once

#include <span>
#include <vector>

#include "algo/minkowski_difference.h"
#include "algo/solve.h"

namespace gjkdbg {

/// Where the working frame lies in the world. With x, R body 0's pose and c the (scaled) reference point, a point p is
/// R (p + c) / scale + x in the world, and a vector v is R v / scale.
template <int D, class S>
struct WorkingFrame {
  Matrix<D, double> rotation;
  Vector<D, double> origin;
  double unit;  ///< 1 / scale, a power of two

  /// The world's axes, the pose's position.
  WorkingFrame(const PlacedAxes<D>& pose, double scale) : rotation(Matrix<D, double>::Identity()), origin(pose.position), unit(1 / scale) {}
  WorkingFrame(const PlacedAxes<D>& pose, const Vector<D, double>& reference, double scale)
      : rotation(pose.rotation), origin(pose.position), unit(1 / scale) {
    if (!is_zero(reference)) origin += rotation * (reference * unit);
  }
  Vector<D, double> vector(const Vector<D, S>& v) const { return rotation * (v.template cast<double>() * unit); }
  Vector<D, double> direction(const Vector<D, S>& d) const { return rotation * d.template cast<double>(); }
  Vector<D, double> point(const Vector<D, S>& p) const { return vector(p) + origin; }
};

/// As assigning does, without asking at run time how long the vector is.
template <int D>
void set(std::optional<AnyVector>& to, const Vector<D, double>& v) {
  to.emplace(D);
  for (int i = 0; i < D; ++i) (*to)[i] = v[i];
}

/// From core points a, b (b - a along the normal, up to rounding) and the cores' signed distance to those of the bodies.
/// Both are set from their middle, so that b - a = signed distance * normal holds to the last bit or two.
template <int D, class S>
void set_witnesses(Result& result, const WorkingFrame<D, S>& frame, const Vector<D, S>& a, const Vector<D, S>& b, const Vector<D, S>& normal, double core_distance,
                   double radius_a, double radius_b) {
  const double distance = core_distance - (radius_a + radius_b);
  const Vector<D, double> n = frame.direction(normal), middle = frame.point(Vector<D, S>((a + b) / 2));
  result.signed_distance = distance * frame.unit + 0.0;  // no negative zero
  result.intersecting = distance <= 0;
  set<D>(result.normal, n);
  set<D>(result.witness_a, middle - n * ((core_distance / 2 - radius_a) * frame.unit));
  set<D>(result.witness_b, middle + n * ((core_distance / 2 - radius_b) * frame.unit));
}

/// The bodies' bounds, from those of the cores' signed distance. The radii are sums, and taking them off rounds once more.
inline void set_bounds(Result& result, double lower, double upper, double radius_a, double radius_b, double unit) {
  const double radius = radius_a + radius_b, rounding = 2 * std::numeric_limits<double>::epsilon() * radius;
  result.lower_bound = (lower - radius - rounding) * unit + 0.0;  // no negative zero
  result.upper_bound = (upper - radius + rounding) * unit + 0.0;
}

/// The answer of a distance query to an overlap: a point of both bodies between the nearest points of their cores.
template <int D, class S>
void set_common_point(Result& result, const WorkingFrame<D, S>& frame, const Vector<D, S>& a, const Vector<D, S>& b, double radius_a, double radius_b) {
  result.signed_distance = 0;
  const S share = radius_a + radius_b > 0 ? static_cast<S>(radius_a / (radius_a + radius_b)) : S(0.5);
  result.witness_a = result.witness_b = frame.point(Vector<D, S>(a + share * (b - a)));
}

/// Vertex and face numbers of several runs in one trace: none is used twice.
struct TraceNumbers {
  int first_vertex = 0, first_face = 0, next_vertex = 0, next_face = 0;
  /// From here on numbers start after all that have been used.
  void next_run() { first_vertex = next_vertex, first_face = next_face; }
};

/// Hands the algorithms' events on to a sink, in world coordinates.
template <int D, class S>
class WorldTrace {
  using V = Vector<D, S>;

 public:
  WorldTrace(const WorkingFrame<D, S>& frame, TraceNumbers& numbers, TraceSink& sink)
      : frame_(frame), numbers_(numbers), sink_(sink) {}

  void operator()(const GjkBegan<V, Viewed>& e) { sink_(world::GjkBegan{frame_.direction(e.direction)}); }

  void operator()(const VertexKept<V, Viewed>& e) { sink_(world::VertexKept{vertex(e.vertex), frame_.point(e.a), frame_.point(e.b), frame_.vector(e.w)}); }

  void operator()(const SupportQueried<V, Viewed>& e) {
    sink_(world::SupportQueried{e.iteration, e.phase, frame_.direction(e.direction), vertex(e.vertex), frame_.point(e.a),
                                frame_.point(e.b), frame_.vector(e.w)});
  }

  void operator()(const SimplexReduced<V, Viewed>& e) {
    make_room(e.before.size() + e.region.size());
    AnyVector closest;
    if (!e.closest.hasNaN()) closest = frame_.vector(e.closest);
    const std::span<const int> before = vertices(e.before), region = vertices(e.region);
    sink_(world::SimplexReduced{e.iteration, before, region, e.barycentric, closest, length(e.lower_bound), length(e.upper_bound)});
  }

  void operator()(const GjkEnded<V, Viewed>& e) {
    sink_(world::GjkEnded{e.iteration, e.status, length(e.lower_bound), length(e.upper_bound)});
  }

  void operator()(const PolytopeSeeded<V, Viewed>& e) {
    make_room(e.vertices.size() + D * e.faces.size());
    const std::span<const int> list = vertices(e.vertices);
    sink_(world::PolytopeSeeded{list, faces(e.faces)});
  }

  void operator()(const FaceChosen<V, Viewed>& e) {
    sink_(world::FaceChosen{e.iteration, face(e.face), frame_.direction(e.normal), length(e.distance)});
  }

  void operator()(const PolytopeGrown<V, Viewed>& e) {
    make_room(e.removed.size() + D * e.added.size());
    for (const int f : e.removed) lists_.push_back(face(f));
    const std::span<const int> removed(lists_);
    horizon_.clear();
    for (const Edge& edge : e.horizon) horizon_.push_back({vertex(edge[0]), vertex(edge[1])});
    sink_(world::PolytopeGrown{e.iteration, vertex(e.vertex), removed, horizon_, faces(e.added), length(e.lower_bound), length(e.upper_bound)});
  }

  void operator()(const EpaEnded<V, Viewed>& e) {
    sink_(world::EpaEnded{e.iteration, e.status, face(e.face), frame_.direction(e.normal), length(e.depth)});
  }

  void operator()(const MprBegan<V, Viewed>& e) { sink_(world::MprBegan{frame_.vector(e.interior)}); }

  void operator()(const PortalFound<V, Viewed>& e) {
    make_room(e.vertices.size());
    sink_(world::PortalFound{e.iteration, vertices(e.vertices), frame_.direction(e.normal), length(e.distance), length(e.lower_bound),
                             length(e.upper_bound)});
  }

  void operator()(const MprEnded<V, Viewed>& e) {
    sink_(world::MprEnded{e.iteration, e.status, frame_.direction(e.normal), length(e.depth)});
  }

  void operator()(const SatBegan<V, Viewed>& e) { sink_(world::SatBegan{e.faces_a, e.faces_b, e.edge_pairs}); }

  void operator()(const AxisTested<V, Viewed>& e) {
    sink_(world::AxisTested{e.iteration, e.source, vertex(e.vertex), frame_.direction(e.direction), length(e.distance),
                            length(e.lower_bound), length(e.upper_bound)});
  }

  void operator()(const PointsProjected<V, Viewed>& e) {
    sink_(world::PointsProjected{e.iteration, frame_.point(e.a), frame_.point(e.b), frame_.vector(e.closest), length(e.lower_bound), length(e.upper_bound)});
  }

  void operator()(const SatEnded<V, Viewed>& e) {
    sink_(world::SatEnded{e.iteration, e.status, frame_.direction(e.normal), length(e.distance)});
  }

  void operator()(const ClosedFormBegan<V, Viewed>& e) { sink_(world::ClosedFormBegan{frame_.vector(e.corner), frame_.vector(e.edge_a), frame_.vector(e.edge_b)}); }

  void operator()(const LinesSolved<V, Viewed>& e) { sink_(world::LinesSolved{e.s, e.t}); }

  void operator()(const ClosedFormEnded<V, Viewed>& e) {
    sink_(world::ClosedFormEnded{e.status, e.s, e.t, frame_.vector(e.closest), frame_.direction(e.normal), length(e.lower_bound), length(e.upper_bound)});
  }

  void operator()(const ProjectionsBegan<V, Viewed>& e) { sink_(world::ProjectionsBegan{frame_.point(e.point)}); }

  void operator()(const PointPredicted<V, Viewed>& e) { sink_(world::PointPredicted{e.iteration, frame_.point(e.point)}); }

  void operator()(const ProjectionsEnded<V, Viewed>& e) { sink_(world::ProjectionsEnded{e.iteration, e.status, length(e.lower_bound), length(e.upper_bound)}); }

  void operator()(const CastAdvanced<V, Viewed>& e) {
    sink_(world::CastAdvanced{e.iteration, e.time, e.pair, length(e.distance), frame_.direction(e.normal), length(e.bound)});
  }

  void operator()(const Warning<V, Viewed>& e) { sink_(world::Warning{e.code, e.message}); }

 private:
  double length(double x) const { return x * frame_.unit; }
  int vertex(int v) { return number(v, numbers_.first_vertex, numbers_.next_vertex); }
  int face(int f) { return number(f, numbers_.first_face, numbers_.next_face); }
  static int number(int n, int first, int& next) {
    if (n < 0) return n;
    next = std::max(next, first + n + 1);
    return first + n;
  }
  /// For the lists of one event: they lie one after the other, and none may move while the next is written.
  void make_room(std::size_t numbers) { lists_.clear(), lists_.reserve(numbers); }
  std::span<const int> vertices(std::span<const int> numbers) {
    const std::size_t first = lists_.size();
    for (const int v : numbers) lists_.push_back(vertex(v));
    return std::span(lists_).subspan(first);
  }
  std::span<const FaceEvent<AnyVector, Viewed>> faces(std::span<const FaceEvent<V, Viewed>> faces) {
    faces_.clear();
    for (const auto& f : faces) faces_.push_back({face(f.face), vertices(f.vertices), frame_.direction(f.normal), length(f.distance)});
    return faces_;
  }

  const WorkingFrame<D, S>& frame_;
  TraceNumbers& numbers_;
  TraceSink& sink_;
  // Of the event at hand; kept for the next, so that events do not allocate.
  std::vector<int> lists_;
  std::vector<Edge> horizon_;
  std::vector<FaceEvent<AnyVector, Viewed>> faces_;
};

}  // namespace gjkdbg
