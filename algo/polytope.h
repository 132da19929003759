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
#include <utility>
#include <vector>

#include "algo/orientation.h"
#include "algo/simplex.h"

namespace gjkdbg {

template <int D, class S>
struct PolytopeFace {
  std::array<int, D> vertices;     ///< indices into points(); counter-clockwise seen from outside
  std::array<int, D> neighbours;   ///< 3D: across edge (vertices[i], vertices[i+1]), as 4 times the face and its edge; 2D: before, after; 1D: unused
  Vector<D, S> normal;             ///< unit, outwards; zero for a face without area
  S distance;                      ///< of the plane from the origin, negative: the origin is outside
  bool removed = false;
  int asked = 0;                   ///< when a new point last asked whether it sees this face, and what it heard: see Polytope::find_seen
  PolytopeFace() {}                // leaves the numbers unset: they are written next
};

/// An edge between a face that a point sees and one that it does not.
struct Ridge {
  std::array<int, 2> edge;  ///< 3D: from, to as the seen face has it; 2D: edge[0] is the shared vertex
  int outside;              ///< the face that stays; 3D: 4 times the face and its edge
};

/// What one growth did; faces as numbers, the horizon's vertices as indices into points().
struct Growth {
  std::vector<int> removed;
  std::vector<Ridge> horizon;    ///< 3D: one after the other around the hole; 2D: where the hole begins and ends
  int first_added = 0, added = 0;  ///< new faces: the first one's number, how many
};

template <int D, class S>
class Polytope {
 public:
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;
  using Face = PolytopeFace<D, S>;

  void clear() { points_.clear(), faces_.clear(), open_.clear(), met_.clear(), far_ = std::numeric_limits<S>::infinity(), reach_ = 0, growths_ = 0; }
  int add_point(const Point& point) {
    points_.push_back(point);
    reach_ = std::max(reach_, point.w.cwiseAbs().maxCoeff());
    return static_cast<int>(points_.size()) - 1;
  }

  /// Starts from D + 1 points that span the space (any orientation).
  void start(std::array<int, D + 1> simplex);

  /// The face with the smallest signed distance, of two the older one; -1 when there is none. One look at all that may answer: there are few, and
  /// which of them is nearer is nothing a processor can guess, as it would have to in a heap.
  int nearest() {
    int face = nearest_open();
    if (face < 0 && far_ < std::numeric_limits<S>::infinity()) {  // more was left out than should have been: rounding
      far_ = std::numeric_limits<S>::infinity();
      for (int i = 0; i < static_cast<int>(faces_.size()); ++i) open_.push_back({faces_[i].distance, i});
      face = nearest_open();
    }
    return face;
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
  struct OpenFace {
    S distance;
    int face;
  };

  /// Sine of the angle between a face's shorter edges below which its normal is worth less than 1e-13 in double.
  static constexpr S thin = S(1e-3);

  const V& at(int i) const { return points_[i].w; }
  /// The nearest of open_, which loses what was removed or lies too far out, and keeps its order.
  int nearest_open() {
    OpenFace* kept = open_.data();
    for (const OpenFace& entry : open_) *kept = entry, kept += !faces_[entry.face].removed & (entry.distance <= far_);
    open_.resize(static_cast<std::size_t>(kept - open_.data()));
    S least = std::numeric_limits<S>::infinity();
    for (const OpenFace& entry : open_) least = std::min(least, entry.distance);
    for (const OpenFace& entry : open_)
      if (entry.distance == least) return entry.face;
    return -1;
  }
  int add_face(const std::array<int, D>& vertices, const std::array<int, D>& neighbours);
  void set_plane(Face& face) const;
  void set_plane(Face& face, const V& edge, const V& next, S squared) const;
  bool sees(int p, const Face& face) const;
  void find_seen(int p, int seen);
  bool one_horizon();
  void close(int p);

  std::vector<Point> points_;
  std::vector<Face> faces_;
  std::vector<OpenFace> open_;  ///< faces that may be asked for
  S far_ = std::numeric_limits<S>::infinity();
  S reach_ = 0;  ///< largest coordinate of a point, in magnitude
  Growth growth_;
  std::vector<int> walk_;  ///< 3D: edges still to cross, as neighbours are
  std::vector<int> met_;   ///< 3D: the growth in whose horizon a point was last
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
  open_.push_back({face.distance, number});
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
    constexpr auto across = [](int face, int edge) { return 4 * face + edge; };
    add_face({s[0], s[2], s[1]}, {across(3, 0), across(2, 0), across(1, 0)});
    add_face({s[0], s[1], s[3]}, {across(0, 2), across(2, 2), across(3, 1)});
    add_face({s[1], s[2], s[3]}, {across(0, 1), across(3, 2), across(1, 1)});
    add_face({s[2], s[0], s[3]}, {across(0, 0), across(1, 2), across(2, 1)});
  }
}

/// The connected faces that p sees, and the ridges around them. Every face is asked once: `asked` becomes 2 k + 1 (seen) or 2 k (not) in growth k.
/// In space the walk goes from face to face counter-clockwise from the edge it came across, and comes to the ridges in their order around the hole.
template <int D, class S>
void Polytope<D, S>::find_seen(int p, int seen) {
  const int not_seen = 2 * ++growths_;
  growth_.removed.clear(), growth_.removed.push_back(seen);
  growth_.horizon.clear();
  faces_[seen].asked = not_seen + 1;
  const auto newly_seen = [&](int number) {
    Face& face = faces_[number];
    if (face.asked >= not_seen) return false;
    face.asked = not_seen + sees(p, face);
    if (face.asked > not_seen) growth_.removed.push_back(number);
    return face.asked > not_seen;
  };
  if constexpr (D == 2) {
    for (std::size_t k = 0; k < growth_.removed.size(); ++k) {
      const Face& face = faces_[growth_.removed[k]];
      for (int i = 0; i < 2; ++i) {
        const int other = face.neighbours[i];
        newly_seen(other);
        if (faces_[other].asked == not_seen) growth_.horizon.push_back({{face.vertices[i], face.vertices[1 - i]}, other});
      }
    }
  } else if constexpr (D == 3) {
    constexpr std::array<int, 3> after{1, 2, 0};
    const auto& [first, second, third] = faces_[seen].neighbours;
    walk_.assign({third, second, first});
    while (!walk_.empty()) {
      const int across = walk_.back(), edge = across & 3;
      walk_.pop_back();
      const Face& beside = faces_[across >> 2];
      if (newly_seen(across >> 2)) {
        walk_.push_back(beside.neighbours[after[after[edge]]]), walk_.push_back(beside.neighbours[after[edge]]);
      } else if (beside.asked == not_seen) {
        growth_.horizon.push_back({{beside.vertices[after[edge]], beside.vertices[edge]}, across});
      }
    }
  }
}

/// Whether the ridges are one closed loop that comes by no vertex twice (2D: exactly two ends, put in order) and leaves something standing.
template <int D, class S>
bool Polytope<D, S>::one_horizon() {
  auto& horizon = growth_.horizon;
  if constexpr (D == 2) {
    if (horizon.size() != 2) return false;
    const auto starts = [&](const Ridge& r) { return faces_[r.outside].vertices[1] == r.edge[0]; };
    if (starts(horizon[0]) == starts(horizon[1])) return false;
    if (!starts(horizon[0])) std::swap(horizon[0], horizon[1]);
  } else if constexpr (D == 3) {
    if (horizon.size() < 3) return false;
    met_.resize(points_.size(), 0);
    int at = horizon.back().edge[1];
    bool one = true;
    for (const Ridge& ridge : horizon) {
      one &= ridge.edge[0] == at && std::exchange(met_[at], growths_) != growths_;
      at = ridge.edge[1];
    }
    return one;
  }
  return true;
}

template <int D, class S>
void Polytope<D, S>::close(int p) {
  const auto& horizon = growth_.horizon;
  const int first = static_cast<int>(faces_.size()), count = D == 3 ? static_cast<int>(horizon.size()) : D;
  growth_.first_added = first, growth_.added = count;
  if constexpr (D == 1) {
    add_face({p}, faces_[growth_.removed[0]].neighbours);
  } else if constexpr (D == 2) {
    const Ridge &start = horizon[0], &end = horizon[1];
    add_face({start.edge[0], p}, {start.outside, first + 1});
    add_face({p, end.edge[0]}, {first, end.outside});
    faces_[start.outside].neighbours[1] = first;
    faces_[end.outside].neighbours[0] = first + 1;
  } else {
    faces_.resize(faces_.size() + horizon.size());
    V edge = at(horizon[0].edge[0]) - at(p);
    S squared = edge.dot(edge);
    int before = first + count - 1;
    for (int number = first; number < first + count; before = number++) {
      const Ridge& r = horizon[number - first];
      const int after = number + 1 < first + count ? number + 1 : first;
      const V next = at(r.edge[1]) - at(p);
      const S next_squared = next.dot(next);
      Face& face = faces_[number];
      face.vertices = {r.edge[0], r.edge[1], p}, face.neighbours = {r.outside, 4 * after + 2, 4 * before + 1};
      set_plane(face, edge, next, squared * next_squared);
      open_.push_back({face.distance, number});
      faces_[r.outside >> 2].neighbours[r.outside & 3] = 4 * number;
      edge = next, squared = next_squared;
    }
  }
}

template <int D, class S>
bool Polytope<D, S>::grow(int p, int seen) {
  find_seen(p, seen);
  if (!one_horizon()) return false;
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
