// EPA's start: points of the difference that span the space, where one can do so near the way out.
//
// GJK ends with the origin in a simplex of rank 0 to D. Its vertices are taken as far as they add a dimension; what is missing is asked for across
// what is there, both ways, and the farther point taken. When neither leaves it, A - B is flat there: depth 0.
//
// Of hulls with many vertices a whole tetrahedron is a poor start: each of its faces has to be grown out to where it is no longer the nearest, most
// of them on the far side. So four more points are asked for around the way out, where the answer is expected: see `ring`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algo/polytope.h"
#include "algo/trace.h"

namespace gjkdbg {

/// A support that the trace shows.
template <class Difference, class Trace>
auto queried_support(Difference& difference, Trace& trace, [[maybe_unused]] int iteration, [[maybe_unused]] Phase phase, const Vector<Difference::D, typename Difference::S>& d) {
  const auto point = difference.support(d);
  if constexpr (traced<Trace>)
    trace(SupportQueried<Vector<Difference::D, typename Difference::S>, Viewed>{iteration, phase, d, point.vertex, point.a, point.b, point.w});
  return point;
}

/// A difference that lies in a plane, or in less.
template <class V>
struct FlatDifference {
  V normal = V::Zero();  ///< unit, across it, to the side where its support is least
  typename V::Scalar height = std::numeric_limits<typename V::Scalar>::infinity();  ///< that support
};

template <class Difference, class Trace>
class EpaStart {
  static constexpr int D = Difference::D;
  using S = typename Difference::S;
  using V = Vector<D, S>;
  using Point = SupportPoint<D, S>;

 public:
  /// `polytope`: cleared.
  EpaStart(Difference& difference, Polytope<D, S>& polytope, Trace& trace)
      : difference_(difference), polytope_(polytope), trace_(trace), floor_(difference.rounding_floor()) {}

  /// The polytope stands, and has the origin inside but for what `simplex`, GJK's last, has outside. False: the difference is flat.
  bool run(const Simplex<D, S>& simplex) {
    if (plainly_spans(simplex)) {
      if constexpr (D == 3)
        if (difference_.vertices() > 16 && ring(simplex)) return true;
      start_from(simplex);
      return true;
    }
    std::array<int, D + 1> chosen{};
    chosen[0] = polytope_.add_point(simplex[0]);
    for (int rank = 0; rank < D; ++rank) {
      const int point = next_point(simplex, chosen, rank);
      if (point < 0) return false;
      chosen[rank + 1] = point;
    }
    polytope_.start(chosen);
    return true;
  }

  const FlatDifference<V>& flat() const { return flat_; }  ///< when run() was false

 private:
  Point query(const V& d) { return queried_support(difference_, trace_, 0, Phase::seed, d); }

  // --- From a whole tetrahedron --------------------------------------------------------------------------------

  /// A tetrahedron that plain arithmetic shows not to be flat: no edge short, no corner sharp, the last point well off the others' plane.
  bool plainly_spans(const Simplex<D, S>& simplex) const {
    if constexpr (D == 3) {
      if (simplex.size() != 4) return false;
      const V x = simplex[1].w - simplex[0].w, y = simplex[2].w - simplex[0].w, z = simplex[3].w - simplex[0].w;
      const V n = x.cross(y);
      const S xx = x.dot(x), yy = y.dot(y), nn = n.dot(n), off = n.dot(z), far = 64 * floor_;
      return std::min(xx, yy) > far * far && nn > S(1e-6) * xx * yy && off * off > far * far * nn;
    }
    return false;
  }

  void start_from(const Simplex<D, S>& simplex) {
    std::array<int, D + 1> all{};
    for (int i = 0; i <= D; ++i) all[i] = polytope_.add_point(simplex[i]);
    polytope_.start(all);
  }

  /// From the middle c of A - B the way out through the origin is a = -c / |c|. With t the simplex's corner highest along a, b the lowest, the start is
  /// an octahedron around the axis a: poles t and b, and four supports at an angle theta from a, each a quarter turn from the one before.
  ///
  ///            t             Let A - B be a ball of radius R = h + |c| around c, h = a . t, delta = h / R. The faces at t are nearer to the origin o than
  ///        r--´ | `--r       the boundary by no more than R theta^2 / 2: the narrower the ring, the nearer the start is to the answer. But the other
  ///         |   o   |        faces must not be nearer than h, or they are what EPA has to grow first. In the plane through the axis and the middle of
  ///          |  |  |         one of the ring's edges, that face leads from (0, -R) to (R theta / sqrt 2, R (1 - theta^2 / 2)), seen from c, and passes
  ///           | c |          o = (0, R - h) at about R theta / sqrt 2. So theta >= sqrt 2 delta.
  ///            |||
  ///             b            And of a hull with N vertices each is the support of about 4 pi / N of all directions: closer than
  ///                          sqrt(4 pi / N) = 3.5 / sqrt N, the four are the same vertices.
  ///
  /// So theta = 1.4 delta + 3 / sqrt N. Of 200 pairs of hulls each, of 32 to 3,000 vertices and 0.02 to 0.3 deep, none takes more than 2.2 supports
  /// a query more or less with factors of 1 to 2 and 2 to 4. The cap beyond the origin holds N delta / 2 vertices: with two or less EPA is at its end
  /// before the ring pays (hulls of up to 16 vertices, shallow ones of 32: a quarter to a half more time with it).
  ///
  /// Where the six are not the corners of an octahedron around the origin, the polytope is the tetrahedron, grown by those of the ring that lie outside.
  ///
  /// Out of line: four supports inlined in EPA cost two boxes, which have no ring, a twentieth of their time.
  [[gnu::noinline]] bool ring(const Simplex<D, S>& simplex) {
    const V c = difference_.center();
    const S length = c.norm(), vertices = static_cast<S>(difference_.vertices());
    if (!(length > 64 * floor_)) return false;
    const V a = c / -length;
    int top = 0, bottom = 0;
    std::array<S, 4> height;
    for (int i = 0; i < 4; ++i) {
      height[i] = a.dot(simplex[i].w);
      if (height[i] > height[top]) top = i;
      if (height[i] < height[bottom]) bottom = i;
    }
    const S delta = height[top] / (height[top] + length);
    if (!(vertices * delta > 4)) return false;
    const V u = a.unitOrthogonal() * (S(1.4) * delta + 3 / std::sqrt(vertices)), v = a.cross(u);
    const std::array<V, 4> directions{a + u, a + v, a - u, a - v};
    std::array<int, 4> numbers;
    for (int k = 0; k < 4; ++k) numbers[k] = polytope_.add([&] { return query(directions[k]); });
    if (polytope_.start_octahedron({polytope_.add_point(simplex[top]), polytope_.add_point(simplex[bottom])}, numbers, floor_)) return true;
    std::array<Point, 4> around;
    std::copy_n(polytope_.points().begin(), 4, around.begin());
    polytope_.clear(floor_);
    start_from(simplex);
    for (const Point& point : around) {
      const int number = polytope_.add_point(point), face = polytope_.face_below(number, 64 * floor_);
      if (face >= 0) polytope_.grow(number, face);
    }
    return true;
  }

  // --- From less --------------------------------------------------------------------------------------------------

  /// A point farthest off the hull of the first `rank` + 1 chosen ones: of the simplex, else of new supports.
  int next_point(const Simplex<D, S>& simplex, const std::array<int, D + 1>& chosen, int rank) {
    S best = 64 * floor_;
    int from = -1;
    for (int i = 1; i < simplex.size(); ++i)
      if (const S off = off_hull(simplex[i].w, chosen, rank); off > best) best = off, from = i;
    if (from >= 0) return polytope_.add_point(simplex[from]);
    best = floor_, flat_ = {};
    Point farthest;
    const V normal = across(chosen, rank);
    for (const V& axis : directions_across(chosen, rank)) {
      for (const V& d : {V(axis), V(-axis)}) {
        const Point point = query(d);
        if (const S off = off_hull(point.w, chosen, rank); off > best) best = off, farthest = point;
        if (std::abs(d.dot(normal)) >= S(0.5)) note_flat(d, point.w);
      }
    }
    return farthest.vertex < 0 ? -1 : polytope_.add_point(farthest);
  }

  const V& at(int i) const { return polytope_.points()[i].w; }

  /// Distance of w from the point, line or plane through the chosen points.
  S off_hull(const V& w, const std::array<int, D + 1>& chosen, int rank) const {
    const V x = w - at(chosen[0]);
    if (rank == 0) return x.norm();
    const V e = (at(chosen[1]) - at(chosen[0])).normalized();
    if (rank == 1) return (x - e * e.dot(x)).norm();
    if constexpr (D == 3) return std::abs(x.dot(plane_normal(chosen)));
    return 0;
  }

  V plane_normal(const std::array<int, D + 1>& chosen) const {
    if constexpr (D == 3) {
      using W = WideVector<S>;
      const W n = W::difference(at(chosen[1]), at(chosen[0])).cross(W::difference(at(chosen[2]), at(chosen[0])));
      return n.template rounded<3>().stableNormalized();
    }
    return V::Zero();
  }

  /// A unit direction across the chosen points; where these are a line that passes beside the origin, the way from the one to the other.
  V across(const std::array<int, D + 1>& chosen, int rank) const {
    if constexpr (D == 3) {
      if (rank == 2) return plane_normal(chosen);
      if (rank == 1) {
        using W = WideVector<S>;
        const W e = W::difference(at(chosen[1]), at(chosen[0]));
        const V off = e.cross(W(at(chosen[0])).cross(e)).template rounded<3>();  // |e|^2 times the way from the origin to the line
        const S length = off.norm();
        if (length > floor_ * e.template rounded<3>().squaredNorm()) return off / length;
      }
    }
    if (rank == 0) return V::Unit(0);
    const V e = (at(chosen[1]) - at(chosen[0])).normalized();
    if constexpr (D == 2) return V(e[1], -e[0]);
    int least = 0;
    e.cwiseAbs().minCoeff(&least);
    V n = V::Unit(least) - e * e[least];
    return n.normalized();
  }

  /// At most D directions.
  struct Directions {
    std::array<V, D> list;
    int count = 0;
    const V* begin() const { return list.data(); }
    const V* end() const { return list.data() + count; }
  };

  /// Directions that span what is missing.
  Directions directions_across(const std::array<int, D + 1>& chosen, int rank) const {
    Directions across_chosen;
    const auto add = [&](const V& d) { across_chosen.list[across_chosen.count++] = d; };
    if (rank == 0) {
      for (int i = 0; i < D; ++i) add(V::Unit(i));
      return across_chosen;
    }
    const V n = across(chosen, rank);
    add(n);
    if constexpr (D == 3)
      if (rank == 1) add((at(chosen[1]) - at(chosen[0])).normalized().cross(n));
    return across_chosen;
  }

  /// Should A - B turn out flat, the way out is across it, to the side where its support is least.
  void note_flat(const V& d, const V& w) {
    const S height = d.dot(w);
    if (flat_.height > height) flat_ = {d, height};
  }

  Difference& difference_;
  Polytope<D, S>& polytope_;
  Trace& trace_;
  const S floor_;
  FlatDifference<V> flat_;
};

}  // namespace gjkdbg
