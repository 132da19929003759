// What the best edge of two polygons that are apart, or overlap, leads to: the points nearest to each other.
//
// Where the other polygon's corner nearest to the edge's line lies across the edge, it and the point below it on that line are the ones. So are they where
// the edge's end lies across an edge beside that corner, as of edges that lie along one another. Else the end of the edge and what is nearest to it beside
// the corner nearly always are; the plane across them proves it.
#pragma once

#include <optional>

#include "algo/nearest_points.h"
#include "algo/polygon_separation.h"

namespace gjkdbg {

/// In A's axes.
template <class S>
struct PolygonPoints {
  Vector<2, S> a, b;
  int at_a, at_b;  ///< corners by them
  bool across;     ///< b - a is along the edge's normal, and as long as the separation
};

/// An edge of A (`of_a`) or of B, and the other's corner nearest to its line, `separation` above it. Keeps the reference.
template <bool of_a, class S>
class EdgeAndCorner {
  using V = Vector<2, S>;

 public:
  EdgeAndCorner(const PolygonPair<S>& pair, int edge, int corner, S separation)
      : pair_(pair), edge_(edge), corner_(corner), separation_(separation), out_(edges().normal(edge) * separation), begin_(edges().corner(edge)),
        way_(edges().corner(edges().next(edge)) - begin_), other_(to_edges(corners().corner(corner))), along_(way_.dot(other_ - begin_)) {}

  bool is_across() const { return along_ >= 0 && along_ <= way_.dot(way_); }
  PolygonPoints<S> points_across() const { return placed(other_ - out_, other_, edge_, true); }

  /// Where it is not: at the end of the edge. Points across there are within `floor` of both polygons.
  PolygonPoints<S> points_at_end(S floor) const {
    const int end = along_ < 0 ? edge_ : edges().next(edge_);
    // Of points outside, those across are the nearest; inside, another edge may be nearer.
    const V tip = edges().corner(end), across = to_corners(tip + out_), nearest = corners().nearest_beside(separation_ > floor ? to_corners(tip) : across, corner_);
    if (((nearest - across).cwiseAbs().array() <= floor).all()) return placed(tip, tip + out_, end, true);
    return placed(tip, to_edges(nearest), end, false);
  }

 private:
  const Polygon<S>& edges() const { return of_a ? pair_.a : pair_.b; }
  const Polygon<S>& corners() const { return of_a ? pair_.b : pair_.a; }
  V to_edges(const V& p) const { return of_a ? pair_.to_a(p) : pair_.to_b(p); }
  V to_corners(const V& p) const { return of_a ? pair_.to_b(p) : pair_.to_a(p); }
  PolygonPoints<S> placed(const V& on_edge, const V& other, int end, bool across) const {
    if constexpr (of_a) return {on_edge, other, end, corner_, across};
    else return {pair_.to_a(other), pair_.to_a(on_edge), corner_, end, across};
  }

  const PolygonPair<S>& pair_;
  const int edge_, corner_;
  const S separation_;
  const V out_, begin_, way_, other_;  ///< in the axes of the edge's polygon
  const S along_;                      ///< how far along the edge the corner lies, times the edge's length
};

/// How far apart the polygons are along a unit direction, from A towards B.
template <class S>
S separation_along(const PolygonPair<S>& pair, const Vector<2, S>& n) {
  return n.dot(pair.position) + pair.b.least_height(pair.rotation.transpose() * n) + pair.a.least_height(-n);
}

/// Of points of A and of B, if the plane across proves that none are nearer.
template <class S>
std::optional<NearestPoints<2, S>> proven_gap(const PolygonPair<S>& pair, const Vector<2, S>& a, const Vector<2, S>& b, S floor) {
  const S distance = (b - a).norm();
  if (!(distance > floor)) return std::nullopt;
  const Vector<2, S> n = (b - a) / distance;
  const S plane = separation_along(pair, n);
  if (distance - plane > 2 * floor) return std::nullopt;
  return NearestPoints<2, S>{a, b, n, distance, plane - floor};
}

}  // namespace gjkdbg
