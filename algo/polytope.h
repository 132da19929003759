// The expanding polytope: a convex hull in D dimensions that grows by one vertex at a time.
//
// In 3D the faces are triangles, in 2D edges, in 1D the two end points. A new vertex p takes away every face it sees
// and closes the hole with faces from the horizon to p; a single face is never split, which would leave a dent:
//
//          p                 f, g  seen by p: removed
//        /   \               a-b-c-d  the horizon, each edge as the removed side had it
//       /     \              new faces (a b p), (b c p), …
//    a-----b-----c
//     \  f | g  /            "Sees" is weak: faces in whose plane p lies go too. So p, when it lies on the line
//      \   |   /             of an edge, never closes a face without area; and as the side of a plane
//       \  |  /              is decided by robust orientation, the faces p sees always form one
//          d                 disc with one loop around it, as for the exact hull.
//
// Faces are numbered in the order they are added, and a number is never used again.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "algo/orientation.h"
#include "algo/simplex.h"

namespace gjkdbg {

template <int D, class S>
struct PolytopeFace {
  std::array<int, D> vertices;     ///< indices into points(); counter-clockwise seen from outside
  std::array<int, D> neighbours;   ///< 3D: across edge (vertices[i], vertices[i+1]); 2D: before, after; 1D: unused
  Vector<D, S> normal;             ///< unit, outwards; zero for a face without area
  S distance;                      ///< of the plane from the origin, negative: the origin is outside
  bool removed = false;
  int asked = 0;                   ///< when a new point last asked whether it sees this face, and what it heard: see Polytope::find_seen
};

/// What one growth did; faces as numbers, the horizon as indices into points().
struct Growth {
  std::vector<int> removed, added;
  std::vector<std::array<int, 2>> horizon;
};

template <int D, class S>
class Polytope {
 public:
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;
  using Face = PolytopeFace<D, S>;

  void clear() { points_.clear(), faces_.clear(), heap_.clear(), far_ = std::numeric_limits<S>::infinity(), reach_ = 0, growths_ = 0; }
  int add_point(const Point& point) {
    points_.push_back(point);
    reach_ = std::max(reach_, point.w.cwiseAbs().maxCoeff());
    return static_cast<int>(points_.size()) - 1;
  }

  /// Starts from D + 1 points that span the space (any orientation).
  void start(std::array<int, D + 1> simplex);

  /// The face with the smallest signed distance; -1 when there is none.
  int nearest() {
    while (!heap_.empty() && faces_[heap_.front().face].removed) pop();
    if (heap_.empty() && far_ < std::numeric_limits<S>::infinity()) {  // more was left out than should have been: rounding
      far_ = std::numeric_limits<S>::infinity();
      for (int i = 0; i < static_cast<int>(faces_.size()); ++i)
        if (!faces_[i].removed) push(i);
    }
    return heap_.empty() ? -1 : heap_.front().face;
  }
  /// Faces farther out than this will not be asked for: a nearer one answers.
  void leave_out_beyond(S distance) { far_ = distance; }

  /// Grows by point p, which must lie outside `seen`. False, and nothing has changed, when no hull with one horizon comes of it.
  bool grow(int p, int seen);
  const Growth& growth() const { return growth_; }  ///< of the last successful grow

  const std::vector<Point>& points() const { return points_; }
  const std::vector<Face>& faces() const { return faces_; }

  /// Weights of the face's vertices with which they make its point nearest the origin (the projection; clamped to the face). `wide`: in
  /// twice the precision, as thin faces need.
  std::array<S, D> weights(const std::array<int, D>& vertices, const V& normal, bool wide) const;

 private:
  struct HeapEntry {
    S distance;
    int face;
    bool operator<(const HeapEntry& o) const { return distance > o.distance || (distance == o.distance && face > o.face); }
  };

  /// Sine of the angle between a face's shorter edges below which its normal is worth less than 1e-13 in double.
  static constexpr S thin = S(1e-3);

  const V& at(int i) const { return points_[i].w; }
  void push(int face) {
    heap_.push_back({faces_[face].distance, face});
    std::push_heap(heap_.begin(), heap_.end());
  }
  void pop() {
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
  }
  int add_face(const std::array<int, D>& vertices, const std::array<int, D>& neighbours);
  void set_plane(Face& face) const;
  void set_plane(Face& face, const V& edge, const V& next, S squared) const;
  bool sees(int p, const Face& face) const;
  void find_seen(int p, int seen);
  bool order_horizon();
  void close(int p);

  std::vector<Point> points_;
  std::vector<Face> faces_;
  std::vector<HeapEntry> heap_;
  S far_ = std::numeric_limits<S>::infinity();
  S reach_ = 0;  ///< largest coordinate of a point, in magnitude
  Growth growth_;
  struct Ridge {
    std::array<int, 2> edge;  ///< 3D: from, to as the removed face had it; 2D: edge[0] is the shared vertex
    int outside;              ///< the face that stays
  };
  std::vector<Ridge> horizon_;
  std::vector<Ridge> loop_;    ///< 3D: the horizon in order
  std::vector<int> leaves_;    ///< the ridge that begins at a point
  int growths_ = 0;
};

/// In space the face's own plane decides first. A normal n = e x f is off by 9 u |e| |f| at most, so the unit normal by 9 u over the sine between
/// the edges, which set_plane keeps above `thin`; for points with coordinates up to m, no farther than 2 sqrt(3) m from one another, the height
/// is off by less than 32 u m / thin.
template <int D, class S>
bool Polytope<D, S>::sees(int p, const Face& face) const {
  if constexpr (D == 3) {
    const S height = face.normal.dot(at(p)) - face.distance;
    if (std::abs(height) > 32 * std::numeric_limits<S>::epsilon() / thin * reach_ && face.distance < std::numeric_limits<S>::infinity()) return height > 0;
  }
  if constexpr (D == 3) return orientation<S>(at(face.vertices[0]), at(face.vertices[1]), at(face.vertices[2]), at(p)) >= 0;
  if constexpr (D == 2) return orientation<S>(at(face.vertices[0]), at(face.vertices[1]), at(p)) <= 0;
  if constexpr (D == 1) return face.normal[0] * (at(p)[0] - at(face.vertices[0])[0]) >= 0;
}

/// 3D: n = (b - a) x (c - a); a face too thin for plain arithmetic gets its plane in twice the precision.
template <int D, class S>
void Polytope<D, S>::set_plane(Face& face) const {
  const V& a = at(face.vertices[0]);
  if constexpr (D == 1) {
    face.distance = face.normal[0] * a[0];
  } else if constexpr (D == 2) {
    const V e = at(face.vertices[1]) - a;
    const S length = e.norm();
    face.normal = length > 0 ? V(V(e[1], -e[0]) / length) : V(V::Zero());
    const V& b = at(face.vertices[1]);
    face.distance = length > 0 ? face.normal.dot(a.dot(a) < b.dot(b) ? a : b) : std::numeric_limits<S>::infinity();
  } else {
    const V &b = at(face.vertices[1]), &c = at(face.vertices[2]);
    // The two shorter edges, and the corner nearest the origin. Looked up: which it is, is nothing a processor can guess.
    const V edges[3] = {b - a, c - b, a - c};
    const S squared[3] = {edges[0].dot(edges[0]), edges[1].dot(edges[1]), edges[2].dot(edges[2])};
    const std::size_t longest = ((squared[1] >= squared[0]) & (squared[1] >= squared[2])) != 0 ? 1 : 2 * (squared[2] >= squared[0]);
    constexpr std::size_t after[3] = {1, 2, 0};
    const std::size_t i = after[longest], j = after[i];
    V n = edges[i].cross(edges[j]);
    S length = n.norm();
    const S da = a.dot(a), db = b.dot(b);
    const V* const corners[3] = {&a, &b, &c};
    const V& near = *corners[std::min(da, db) <= c.dot(c) ? db < da : 2];
    if (length * length > thin * thin * squared[i] * squared[j]) {
      face.normal = n / length;
      face.distance = face.normal.dot(near);
      return;
    }
    using W = WideVector<S>;
    const W exact = W::difference(b, a).cross(W::difference(c, a));
    const S scale = exact.template rounded<3>().cwiseAbs().maxCoeff();
    n = exact.template rounded<3>() / (scale > 0 ? scale : S(1));
    length = n.norm();
    face.normal = length > 0 ? V(n / length) : V(V::Zero());
    const Wide<S> along = exact.dot(W(near));
    face.distance = length > 0 ? static_cast<S>(double(along)) / (scale * length) : std::numeric_limits<S>::infinity();
  }
}

/// 3D: with edges from the face's last vertex to its others at hand; `squared` is |edge|^2 |next|^2.
template <int D, class S>
void Polytope<D, S>::set_plane(Face& face, const V& edge, const V& next, S squared) const {
  const V n = edge.cross(next);
  const S area = n.dot(n);
  if (!(area > thin * thin * squared)) return set_plane(face);
  face.normal = n / std::sqrt(area);
  face.distance = face.normal.dot(at(face.vertices[2]));
}

template <int D, class S>
int Polytope<D, S>::add_face(const std::array<int, D>& vertices, const std::array<int, D>& neighbours) {
  const int number = static_cast<int>(faces_.size());
  Face& face = faces_.emplace_back();
  face.vertices = vertices, face.neighbours = neighbours;
  if constexpr (D == 1) face.normal[0] = neighbours[0] > 0 ? S(1) : S(-1);
  set_plane(face);
  if (face.distance <= far_) push(number);
  return number;
}

template <int D, class S>
void Polytope<D, S>::start(std::array<int, D + 1> s) {
  if constexpr (D == 1) {
    if (at(s[0])[0] > at(s[1])[0]) std::swap(s[0], s[1]);
    add_face({s[0]}, {-1});  // 1D: the sign of `neighbours` is the face's side
    add_face({s[1]}, {1});
  } else if constexpr (D == 2) {
    if (orientation<S>(at(s[0]), at(s[1]), at(s[2])) < 0) std::swap(s[1], s[2]);
    for (int i = 0; i < 3; ++i) add_face({s[i], s[(i + 1) % 3]}, {(i + 2) % 3, (i + 1) % 3});
  } else {
    // Seen from outside, 0 2 1 is counter-clockwise when 3 lies on the side from which 0 1 2 is.
    if (orientation<S>(at(s[0]), at(s[1]), at(s[2]), at(s[3])) < 0) std::swap(s[1], s[2]);
    add_face({s[0], s[2], s[1]}, {3, 2, 1});
    add_face({s[0], s[1], s[3]}, {0, 2, 3});
    add_face({s[1], s[2], s[3]}, {0, 3, 1});
    add_face({s[2], s[0], s[3]}, {0, 1, 2});
  }
}

/// The connected faces that p sees, and the ridges around them. Every face is asked once: `asked` becomes 2 k + 1 (seen) or 2 k (not) in growth k.
template <int D, class S>
void Polytope<D, S>::find_seen(int p, int seen) {
  const int not_seen = 2 * ++growths_;
  growth_.removed.assign(1, seen);
  horizon_.clear();
  faces_[seen].asked = not_seen + 1;
  if constexpr (D == 1) return;
  for (std::size_t k = 0; k < growth_.removed.size(); ++k) {
    const Face& face = faces_[growth_.removed[k]];
    for (int i = 0; i < D; ++i) {
      const int other = face.neighbours[i];
      Face& beside = faces_[other];
      if (beside.asked < not_seen) {
        beside.asked = not_seen + sees(p, beside);
        if (beside.asked > not_seen) growth_.removed.push_back(other);
      }
      if (beside.asked == not_seen) horizon_.push_back({{face.vertices[i], face.vertices[i + 1 == D ? 0 : i + 1]}, other});
    }
  }
}

/// Puts the ridges in order; false unless they are one closed loop (2D: exactly two ends) that leaves something standing.
template <int D, class S>
bool Polytope<D, S>::order_horizon() {
  if constexpr (D == 1) return true;
  if constexpr (D == 2) {
    if (horizon_.size() != 2) return false;
    const auto starts = [&](const Ridge& r) { return faces_[r.outside].vertices[1] == r.edge[0]; };
    if (starts(horizon_[0]) == starts(horizon_[1])) return false;
    if (!starts(horizon_[0])) std::swap(horizon_[0], horizon_[1]);
    return true;
  }
  const std::size_t count = horizon_.size();
  if (count < 3) return false;
  leaves_.resize(points_.size());
  for (std::size_t i = 0; i < count; ++i) leaves_[horizon_[i].edge[0]] = static_cast<int>(i);
  // A vertex with two ridges leaving it has one of them left out of the round trip, which then is too short; one with none sends it astray, to a
  // ridge of another growth.
  loop_.resize(count);
  std::size_t at = 0, length = 0;
  do {
    const Ridge& ridge = loop_[length++] = horizon_[at];
    at = static_cast<std::size_t>(leaves_[ridge.edge[1]]);
    if (at >= count || horizon_[at].edge[0] != ridge.edge[1]) return false;
  } while (at != 0 && length < count);
  return at == 0 && length == count;
}

template <int D, class S>
void Polytope<D, S>::close(int p) {
  growth_.added.clear();
  const int first = static_cast<int>(faces_.size()), count = static_cast<int>(horizon_.size());
  if constexpr (D == 1) {
    growth_.horizon.clear();
    growth_.added.push_back(add_face({p}, faces_[growth_.removed[0]].neighbours));
  } else if constexpr (D == 2) {
    const Ridge &start = horizon_[0], &end = horizon_[1];
    growth_.horizon.assign(1, {start.edge[0], end.edge[0]});
    growth_.added = {add_face({start.edge[0], p}, {start.outside, first + 1}),
                     add_face({p, end.edge[0]}, {first, end.outside})};
    faces_[start.outside].neighbours[1] = first;
    faces_[end.outside].neighbours[0] = first + 1;
  } else {
    growth_.horizon.resize(loop_.size()), growth_.added.resize(loop_.size());
    faces_.resize(faces_.size() + loop_.size());
    V edge = at(loop_[0].edge[0]) - at(p);
    S squared = edge.dot(edge);
    for (int k = 0; k < count; ++k) {
      const Ridge& r = loop_[k];
      const V next = at(r.edge[1]) - at(p);
      const S next_squared = next.dot(next);
      const int number = first + k, after = k + 1 == count ? first : number + 1, before = k == 0 ? first + count - 1 : number - 1;
      Face& face = faces_[number];
      face.vertices = {r.edge[0], r.edge[1], p}, face.neighbours = {r.outside, after, before};
      set_plane(face, edge, next, squared * next_squared);
      if (face.distance <= far_) push(number);
      growth_.horizon[k] = r.edge, growth_.added[k] = number;
      auto& outside = faces_[r.outside];  // has the edge the other way round
      outside.neighbours[(outside.vertices[1] == r.edge[1]) + 2 * (outside.vertices[2] == r.edge[1])] = number;
      edge = next, squared = next_squared;
    }
  }
}

template <int D, class S>
bool Polytope<D, S>::grow(int p, int seen) {
  find_seen(p, seen);
  if (!order_horizon()) return false;
  for (const int number : growth_.removed) faces_[number].removed = true;
  close(p);
  return true;
}

/// 3D: the weight of a vertex is the area of the opposite edge with the projected origin, along the normal: n . (w_j x w_k).
template <int D, class S>
std::array<S, D> Polytope<D, S>::weights(const std::array<int, D>& v, const V& normal, [[maybe_unused]] bool wide) const {
  std::array<S, D> weight{};
  weight[0] = 1;
  if constexpr (D == 2) {
    const V e = at(v[1]) - at(v[0]);
    const S length = e.dot(e), t = length > 0 ? -at(v[0]).dot(e) / length : S(0);
    weight[1] = std::clamp(t, S(0), S(1)), weight[0] = 1 - weight[1];
  } else if constexpr (D == 3) {
    const V &a = at(v[0]), &b = at(v[1]), &c = at(v[2]);
    const auto area = [&](const V& p, const V& q) {
      if (!wide) return std::max(S(0), normal.dot(p.cross(q - p)));
      using W = WideVector<S>;
      return std::max(S(0), static_cast<S>(double(W(normal).dot(W(p).cross(W::difference(q, p))))));
    };
    weight = {area(b, c), area(c, a), area(a, b)};
    const S sum = weight[0] + weight[1] + weight[2];
    if (!(sum > 0)) return {1, 0, 0};
    for (S& x : weight) x /= sum;
  }
  return weight;
}

}  // namespace gjkdbg
