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
// Faces are numbered in the order they are added, and the number of a face that stood is never used again.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "algo/orientation.h"
#include "algo/polytope_planes.h"
#include "shapes/fours.h"

namespace gjkdbg {

template <int D, class S>
class Polytope {
 public:
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;
  using Face = PolytopeFace<D, S>;

  Polytope() = default;
  Polytope(const Polytope&) = delete;  // growth_ looks into removed_
  Polytope& operator=(const Polytope&) = delete;

  /// `allowed`: what rounding may hide of the distance of a face that `nearest` returns, and of what makes it the nearest.
  void clear(S allowed) {
    allowed_ = allowed;
    std::fill_n(nearness_.begin(), (places_ + 3) / 4, nobody());
    count_ = places_ = size_ = 0, tidy_at_ = 64, reach_ = 0, growths_ = 0;
  }
  int add_point(const Point& point) {
    return add([&] { return point; });
  }
  /// The point that `make` returns, made where it stays: what was just written number by number is slow to copy.
  template <class Make>
  [[gnu::always_inline]] int add(Make make) {
    if (size_ == points_.size()) points_.resize(2 * size_ + 16), met_.resize(points_.size());
    const Point& point = *new (&points_[size_]) Point(make());
    met_[size_] = 0;
    reach_ = std::max(reach_, point.w.cwiseAbs().maxCoeff());
    return static_cast<int>(size_++);
  }

  /// Starts from D + 1 points that span the space (any orientation).
  void start(std::array<int, D + 1> simplex);

  /// 3D: starts from two points and four between them, counter-clockwise around the way from the second to the first. False, and the polytope is of no
  /// use, unless they are plainly the corners of an octahedron that has the origin inside by more than `floor`.
  bool start_octahedron(const std::array<int, 2>& poles, const std::array<int, 4>& ring, S floor);

  /// The face with the smallest signed distance; -1 when no face is left. A sliver's plane may be off by more than `allowed`: it is looked at as the least that
  /// leaves, and set anew in twice the precision when that makes it the nearest. One look at all there are: they are few, and which of them is nearer is nothing a
  /// processor can guess, as it would have to in a heap.
  int nearest();

  /// A face as `nearest` would return it.
  Face sharpened(int number) const {
    Face face = faces_[number], plain = face;
    if constexpr (D == 3)
      if (set_plane<D, S>(plain, points_.data(), rounding()) > 0) set_widely(face);
    return face;
  }

  /// A face that p lies outside of, by more than `margin`; -1 when there is none.
  int face_below(int p, S margin) const;

  /// Grows by point p, which must lie outside `seen`. False, and no face has changed, when no hull with one horizon comes of it.
  bool grow(int p, int seen);
  const Growth& growth() const { return growth_; }  ///< of the last grow, if it succeeded

  std::span<const Point> points() const { return {points_.data(), size_}; }
  std::span<const Face> faces() const { return {faces_.data(), count_}; }

 private:
  static constexpr S thin = thin_sine<S>;
  static constexpr S gone = -std::numeric_limits<S>::infinity();  ///< as nearness: of no face

  const V& at(int i) const { return points_[i].w; }
  /// Of a point above a face's plane: see `sees`.
  S rounding_of_height() const { return 32 * std::numeric_limits<S>::epsilon() / thin * reach_; }
  void set_widely(Face& face) const { set_plane_widely<S>(face, at(face.vertices[0]), at(face.vertices[1]), at(face.vertices[2]), at(face.vertices[2])); }
  void make_room();
  void add_face(const std::array<int, D>& vertices, const std::array<int, D>& neighbours);
  int add_without_plane(const std::array<int, D>& vertices, const std::array<int, D>& neighbours);
  void set_fan(int first, int n, int apex, Turn turn);
  void remove(int number);
  static Four<S> nobody() {
    Four<S> four;
    for (std::size_t k = 0; k < 4; ++k) four.set(k, gone);
    return four;
  }
  void set_nearness(std::size_t place, S nearness) { nearness_[place / 4].set(place % 4, nearness); }
  PlaneRounding<S> rounding() const { return {allowed_ * allowed_, rounding_of_height()}; }
  /// To `nearest`, as the distance that it has at least; one without area is asked for as well, but last.
  void offer(const Face& face, S off) { set_nearness(face.place, -std::min(face.distance - off, std::numeric_limits<S>::max())); }
  void take_place(Face& face, int number) {
    face.place = static_cast<std::uint32_t>(places_);
    numbers_[places_++] = number;
  }
  void forget_removed();
  bool sees(int p, const Face& face) const;
  bool grow_polygon(int p, int seen);
  bool grow_polyhedron(int p, int seen);
  void undo_growth();

  std::vector<Point> points_;
  std::size_t size_ = 0;  ///< of points_
  std::vector<int> met_;  ///< 3D: by point: the growth in whose horizon it was last
  S allowed_ = 0;
  S reach_ = 0;           ///< largest coordinate of a point, in magnitude

  // Room for what the next growth may add, so that nothing asks on the way and nothing moves in memory.
  std::size_t room_ = 0;
  std::vector<Face> faces_;
  std::size_t count_ = 0;          ///< of faces_
  std::vector<Four<S>> nearness_;  ///< by place: minus the distance of a face that stands; `gone` where there is none
  std::vector<int> numbers_;       ///< by place: the face
  std::size_t places_ = 0;         ///< taken
  std::size_t tidy_at_ = 64;       ///< so many places make `nearest` slow
  std::vector<int> walk_;          ///< 3D: edges still to cross, as neighbours are
  std::vector<int> ring_;          ///< 3D: points around the newest faces' apex, as Fan::ring
  std::vector<int> removed_;

  Growth growth_;
  std::size_t removed_count_ = 0;
  int growths_ = 0;
};

/// In space the face's own plane decides first. A normal n = e x f is off by 9 u |e| |f| at most, so the unit normal by 9 u over the sine between
/// the edges, which set_plane keeps above `thin`; for points with coordinates up to m, no farther than 2 sqrt(3) m from one another, the height
/// is off by less than 32 u m / thin.
template <int D, class S>
bool Polytope<D, S>::sees(int p, const Face& face) const {
  if constexpr (D == 3) {
    const S height = face.normal.dot(at(p)) - face.distance;
    if (std::abs(height) > rounding_of_height() && face.distance < std::numeric_limits<S>::infinity()) return height > 0;
  }
  if constexpr (D == 3) return orientation<S>(at(face.vertices[0]), at(face.vertices[1]), at(face.vertices[2]), at(p)) >= 0;
  if constexpr (D == 2) return orientation<S>(at(face.vertices[0]), at(face.vertices[1]), at(p)) <= 0;
  if constexpr (D == 1) return face.normal[0] * (at(p)[0] - at(face.vertices[0])[0]) >= 0;
}

// --- The faces there are ----------------------------------------------------------------------------------------

template <int D, class S>
int Polytope<D, S>::nearest() {
  if (places_ >= tidy_at_) forget_removed();
  while (true) {
    GreatestOfFours<S> nearness;
    for (std::size_t i = 0; 4 * i < places_; ++i) nearness.take(nearness_[i]);
    const auto found = nearness.found();
    if (!(found.value > gone)) return -1;
    const int number = numbers_[found.place];
    Face& face = faces_[number];
    if (!(face.distance + found.value > 0) || found.value == std::numeric_limits<S>::lowest()) return number;
    if constexpr (D == 3) set_widely(face);  // no nearer than that: how far is it?
    offer(face, 0);
  }
}

/// Leaves the removed ones' places to the others, which keep their order. Which have been removed is nothing a processor can guess.
template <int D, class S>
void Polytope<D, S>::forget_removed() {
  std::size_t standing = 0;
  for (std::size_t i = 0; i < places_; ++i) {
    const int number = numbers_[i];
    const S nearness = nearness_[i / 4][i % 4];
    numbers_[standing] = number;
    set_nearness(standing, nearness);
    faces_[number].place = static_cast<std::uint32_t>(standing);
    standing += !faces_[number].removed;  // the next one comes here, if not
  }
  for (std::size_t i = standing; i < places_; ++i) set_nearness(i, gone);
  places_ = standing;
  tidy_at_ = 2 * places_ + 64;
}

/// A growth adds at most two faces more than it removes, and never has more edges to cross than that.
template <int D, class S>
void Polytope<D, S>::make_room() {
  if (2 * count_ + 8 <= room_) return;
  const std::size_t room = 4 * count_ + 64;
  faces_.resize(room);
  numbers_.resize(room), walk_.resize(room), ring_.resize(room), removed_.resize(room);
  nearness_.resize(room / 4, nobody());
  room_ = room;  // last: an allocation may fail
}

template <int D, class S>
[[gnu::always_inline]] inline int Polytope<D, S>::add_without_plane(const std::array<int, D>& vertices, const std::array<int, D>& neighbours) {
  Face& face = faces_[count_];
  face.vertices = vertices, face.neighbours = neighbours;
  face.removed = false;
  return static_cast<int>(count_++);
}

template <int D, class S>
void Polytope<D, S>::add_face(const std::array<int, D>& vertices, const std::array<int, D>& neighbours) {
  const int number = add_without_plane(vertices, neighbours);
  Face& face = faces_[number];
  if constexpr (D == 1) face.normal[0] = static_cast<S>(neighbours[0]);
  const S off = set_plane<D, S>(face, points_.data(), rounding());
  take_place(face, number);
  offer(face, off);
}

/// 3D: the planes of n faces from number `first` on, which are those of a fan around `apex` with ring_.
template <int D, class S>
[[gnu::always_inline]] inline void Polytope<D, S>::set_fan(int first, int n, int apex, Turn turn) {
  for (int i = n; i < n + 4; ++i) ring_[i] = ring_[0];
  Face* const faces = faces_.data() + first;
  S* const nearness = reinterpret_cast<S*>(nearness_.data()) + places_;
  for (int i = 0; i < n; ++i) take_place(faces[i], first + i);
#ifdef GJKDBG_AVX2
  if constexpr (sizeof(S) == 8)
    if (__builtin_cpu_supports("avx2")) {
      if (set_fan_by_avx2({points_.data(), ring_.data(), n, apex, rounding()}, turn, faces, nearness)) return;
      for (int i = 0; i < n; ++i)
        if (!(faces[i].distance < std::numeric_limits<S>::infinity())) offer(faces[i], set_plane<D, S>(faces[i], points_.data(), rounding()));
      return;
    }
#endif
  for (int i = 0; i < n; ++i) offer(faces[i], set_plane<D, S>(faces[i], points_.data(), rounding()));
}

template <int D, class S>
void Polytope<D, S>::remove(int number) {
  Face& face = faces_[number];
  face.removed = true;
  set_nearness(face.place, gone);
  removed_[removed_count_++] = number;
}

template <int D, class S>
void Polytope<D, S>::start(std::array<int, D + 1> s) {
  make_room();
  if constexpr (D == 1) {
    if (at(s[0])[0] > at(s[1])[0]) std::swap(s[0], s[1]);
    add_face({s[0]}, {-1});
    add_face({s[1]}, {1});
  } else if constexpr (D == 2) {
    if (orientation<S>(at(s[0]), at(s[1]), at(s[2])) < 0) std::swap(s[1], s[2]);
    for (int i = 0; i < 3; ++i) add_face({s[i], s[(i + 1) % 3]}, {(i + 2) % 3, (i + 1) % 3});
  } else {
    // Seen from outside, 0 2 1 is counter-clockwise when 3 lies on the side from which 0 1 2 is.
    if (orientation<S>(at(s[0]), at(s[1]), at(s[2]), at(s[3])) < 0) std::swap(s[1], s[2]);
    constexpr auto across = [](int face, int edge) { return 4 * face + edge; };
    constexpr int vertices[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    constexpr int neighbours[4][3] = {{across(3, 0), across(2, 0), across(1, 0)},
                                      {across(0, 2), across(2, 2), across(3, 1)},
                                      {across(0, 1), across(3, 2), across(1, 1)},
                                      {across(0, 0), across(1, 2), across(2, 1)}};
    for (int i = 0; i < 4; ++i)
      add_face({s[vertices[i][0]], s[vertices[i][1]], s[vertices[i][2]]}, {neighbours[i][0], neighbours[i][1], neighbours[i][2]});
  }
}

/// Face k lies between the first pole and the ring's corners k and k + 1, face 4 + k between those and the other pole; edge 0 of both is the one they
/// share. A closed surface is that of a convex body if it turns outwards at each edge, that is if the corner across it is below the face, and goes
/// around no corner twice, for which four edges are too few: eight half turns. The origin is inside if it is below each face.
template <int D, class S>
bool Polytope<D, S>::start_octahedron(const std::array<int, 2>& poles, const std::array<int, 4>& ring, S floor) {
  make_room();
  std::copy(ring.begin(), ring.end(), ring_.begin());
  for (int side = 0; side < 2; ++side) {
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4, before = (k + 3) % 4;
      if (side == 0) add_without_plane({ring[k], ring[next], poles[0]}, {4 * (4 + k), 4 * next + 2, 4 * before + 1});
      else add_without_plane({ring[next], ring[k], poles[1]}, {4 * k, 4 * (4 + before) + 2, 4 * (4 + next) + 1});
    }
    set_fan(4 * side, 4, poles[side], side == 0 ? Turn::around_outer : Turn::around_inner);
  }
  const S margin = std::max(floor, rounding_of_height());
  bool convex = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const Face &face = faces_[k], &other = faces_[4 + k];
    const V& across = at(ring[(k + 2) % 4]);
    const auto below = [&](const Face& f, const V& w) { return f.normal.dot(w) - f.distance < -margin; };
    for (const Face* f : {&face, &other}) convex = convex && f->distance > floor && f->distance < std::numeric_limits<S>::infinity() && below(*f, across);
    convex = convex && below(face, at(poles[1]));
  }
  return convex;
}

template <int D, class S>
int Polytope<D, S>::face_below(int p, S margin) const {
  for (std::size_t f = 0; f < count_; ++f)
    if (!faces_[f].removed && faces_[f].normal.dot(at(p)) - faces_[f].distance > margin && sees(p, faces_[f])) return static_cast<int>(f);
  return -1;
}

// --- Growth -----------------------------------------------------------------------------------------------------

template <int D, class S>
bool Polytope<D, S>::grow(int p, int seen) {
  make_room();
  removed_count_ = 0;
  growth_.first_added = static_cast<int>(count_);
  ++growths_;
  remove(seen);
  bool closed = true;
  if constexpr (D == 1) add_face({p}, faces_[seen].neighbours);
  if constexpr (D == 2) closed = grow_polygon(p, seen);
  if constexpr (D == 3) closed = grow_polyhedron(p, seen);
  growth_.removed = {removed_.data(), removed_count_};
  growth_.added = static_cast<int>(count_) - growth_.first_added;
  if (!closed) undo_growth();
  return closed;
}

template <int D, class S>
bool Polytope<D, S>::grow_polygon(int p, int seen) {
  int before = faces_[seen].neighbours[0], after = faces_[seen].neighbours[1];
  for (; !faces_[before].removed && sees(p, faces_[before]); before = faces_[before].neighbours[0]) remove(before);
  for (; !faces_[after].removed && sees(p, faces_[after]); after = faces_[after].neighbours[1]) remove(after);
  if (faces_[before].removed || faces_[after].removed) return false;
  const int first = growth_.first_added;
  add_face({faces_[before].vertices[1], p}, {before, first + 1});
  add_face({p, faces_[after].vertices[0]}, {first, after});
  faces_[before].neighbours[1] = first;
  faces_[after].neighbours[0] = first + 1;
  return true;
}

/// The walk goes from seen face to seen face, counter-clockwise from the edge it came across, so that it comes to the edges of the horizon
/// in their order around the hole and closes it on the way. False: they are not one loop that comes by no vertex twice.
template <int D, class S>
bool Polytope<D, S>::grow_polyhedron(int p, int seen) {
  constexpr std::array<int, 3> after{1, 2, 0};
  const int first = growth_.first_added;
  int* end = walk_.data();
  const auto& [edge_0, edge_1, edge_2] = faces_[seen].neighbours;
  *end++ = edge_2, *end++ = edge_1, *end++ = edge_0;
  bool one_loop = true;
  int to = -1;
  while (end > walk_.data()) {
    const int across = *--end, edge = across & 3;
    Face& beside = faces_[across >> 2];
    if (beside.removed) continue;  // seen, and met from another side before
    if (sees(p, beside)) {
      remove(across >> 2);
      *end++ = beside.neighbours[after[after[edge]]], *end++ = beside.neighbours[after[edge]];
      continue;
    }
    const int from = beside.vertices[after[edge]], number = static_cast<int>(count_);
    one_loop &= ((from == to) | (number == first)) & (std::exchange(met_[from], growths_) != growths_);
    to = beside.vertices[edge];
    beside.neighbours[edge] = 4 * number;
    ring_[number - first] = from;
    add_without_plane({from, to, p}, {across, 4 * (number + 1) + 2, 4 * (number - 1) + 1});
  }
  const int last = static_cast<int>(count_) - 1;
  if (!one_loop || last < first + 2 || to != faces_[first].vertices[0]) return false;
  faces_[first].neighbours[2] = 4 * last + 1;
  faces_[last].neighbours[1] = 4 * first + 2;
  set_fan(first, last - first + 1, p, Turn::around_outer);
  return true;
}

/// What was removed stands again; in 3D its neighbours may already know what was to take its place.
template <int D, class S>
void Polytope<D, S>::undo_growth() {
  count_ = static_cast<std::size_t>(growth_.first_added);  // they have no places yet
  for (const int number : growth_.removed) {
    Face& face = faces_[number];
    face.removed = false;
    Face plain = face;
    offer(face, set_plane<D, S>(plain, points_.data(), rounding()));
    if constexpr (D == 3)
      for (int edge = 0; edge < 3; ++edge) faces_[face.neighbours[edge] >> 2].neighbours[face.neighbours[edge] & 3] = 4 * number + edge;
  }
}

}  // namespace gjkdbg
