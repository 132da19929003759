// A convex polygon in the plane: its corners one after the other, and which way its edges face.
//
//            normal i                  Four corners stand side by side, coordinate by coordinate, with the edges that begin at them
//               ^                      (shapes/fours.h): four heights, or four edges' separations, at a time. Where fewer than four are
//   corner i+1  |   corner i           left, the last is there again.
//       o-------+-------o
//         edge i                       The height of an edge, offset i, is that of the corner highest along its normal: one of its own
//                                      ends but for rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "shapes/fours.h"
#include "shapes/support_mappings.h"

namespace gjkdbg {

template <class S>
struct PolygonFour {
  std::array<Four<S>, 2> corner, normal;
  Four<S> offset;

  void set(std::size_t k, const Vector<2, S>& c, const Vector<2, S>& n) {
    corner[0].set(k, c[0]), corner[1].set(k, c[1]);
    normal[0].set(k, n[0]), normal[1].set(k, n[1]);
  }
};

/// What the methods see of a polygon, or of a box in the plane; keeps a pointer. Corners counter-clockwise, at least three, edge i from corner i
/// to the next.
template <class S>
class Polygon {
  using V = Vector<2, S>;

 public:
  Polygon(const PolygonFour<S>* fours, int size) : fours_(fours), size_(size) {}

  int size() const { return size_; }
  int count() const { return (size_ + 3) / 4; }  ///< of fours
  const PolygonFour<S>& four(int i) const { return fours_[i]; }
  V corner(int i) const { return at(i, &PolygonFour<S>::corner); }
  V normal(int i) const { return at(i, &PolygonFour<S>::normal); }
  S offset(int i) const { return fours_[i / 4].offset[static_cast<std::size_t>(i % 4)]; }
  /// Asks for what will be looked at, before it is known where.
  void fetch() const {
    const char* const first = reinterpret_cast<const char*>(fours_);
    const auto lines_of = [&](std::size_t fours) {
      for (std::size_t at = 0; at < fours * sizeof(PolygonFour<S>); at += 64) __builtin_prefetch(first + at);
    };
    if (count() == 2) lines_of(2);  // as many as are known beforehand: no loop
    else lines_of(static_cast<std::size_t>(count()));
  }
  int next(int i) const { return i + 1 == size_ ? 0 : i + 1; }
  int previous(int i) const { return i == 0 ? size_ - 1 : i - 1; }

  /// The corner highest along d; of several as high, any.
  int highest(const V& d) const {
    GreatestOfFours<S> heights;
    for (int i = 0; i < count(); ++i) {
      const auto& [x, y] = fours_[i].corner;
      Four<S> height;
      for (int part = 0; part < Four<S>::parts; ++part) height.part[part] = x.part[part] * d[0] + y.part[part] * d[1];
      heights.take(height);
    }
    return static_cast<int>(heights.found().place);
  }

  /// How high along d the lowest corner lies.
  S least_height(const V& d) const {
    using Values = typename Four<S>::Values;
    Values least = Values{} + std::numeric_limits<S>::infinity();
    for (int i = 0; i < count(); ++i) {
      const auto& [x, y] = fours_[i].corner;
      for (int part = 0; part < Four<S>::parts; ++part) least = lesser_of<S>(x.part[part] * d[0] + y.part[part] * d[1], least);
    }
    S lowest = least[0];
    for (int k = 1; k < Four<S>::width; ++k) lowest = std::min(lowest, least[k]);
    return lowest;
  }

  /// The corner lowest along d; of several as low, the first.
  int lowest(const V& d) const {
    int best = 0;
    S least = std::numeric_limits<S>::infinity();
    for (int i = 0; i < size_; ++i) {
      const S height = corner(i).dot(d);
      if (height < least) least = height, best = i;
    }
    return best;
  }

  /// The point of the two edges at a corner that is nearest to p.
  V nearest_beside(const V& p, int at) const {
    const auto on_edge = [&](int from) {
      const V here = corner(from), edge = corner(next(from)) - here;
      const S along = edge.dot(p - here), squared = edge.dot(edge);
      return along <= 0 ? here : along < squared ? V(here + edge * (along / squared)) : V(here + edge);
    };
    const V before = on_edge(previous(at)), after = on_edge(at);
    return (p - before).squaredNorm() < (p - after).squaredNorm() ? before : after;
  }

  /// The point nearest to p, outside, downhill along the boundary from a corner that faces p: of a convex polygon the nearest there is. `from` becomes a
  /// corner of the edge it lies on.
  V nearest(const V& p, int& from) const {
    for (const bool forward : {true, false})
      for (int steps = 0; steps < size_; ++steps) {
        const int to = forward ? next(from) : previous(from);
        const V here = corner(from), edge = corner(to) - here, way = p - here;
        const S along = way.dot(edge), squared = edge.dot(edge);
        if (!(along > 0) || !(normal(forward ? from : to).dot(way) > 0)) {
          if (steps > 0) return here;
          break;
        }
        if (along < squared) return here + edge * (along / squared);
        from = to;
      }
    return corner(from);
  }

 private:
  V at(int i, std::array<Four<S>, 2> PolygonFour<S>::*which) const {
    const auto place = static_cast<std::size_t>(i);
    const auto& four = fours_[place / 4].*which;
    return {four[0][place % 4], four[1][place % 4]};
  }

  const PolygonFour<S>* fours_;
  int size_;
};

template <class S>
class PolygonCore {
 public:
  /// Corners counter-clockwise, at least three, no two next to each other the same.
  explicit PolygonCore(const std::vector<Vector<2, double>>& corners) : size_(static_cast<int>(corners.size())) {
    fours_.resize((corners.size() + 3) / 4);
    const auto each_place = [&](auto&& set) {
      for (std::size_t place = 0; place < 4 * fours_.size(); ++place) set(fours_[place / 4], place % 4, std::min(place, corners.size() - 1));
    };
    each_place([&](PolygonFour<S>& four, std::size_t k, std::size_t i) {
      const Vector<2, double> edge = corners[(i + 1) % corners.size()] - corners[i], normal = Vector<2, double>(edge[1], -edge[0]).stableNormalized();
      four.set(k, corners[i].template cast<S>(), normal.template cast<S>());
    });
    each_place([&](PolygonFour<S>& four, std::size_t k, std::size_t i) {
      const Vector<2, S> normal = polygon().normal(static_cast<int>(i));
      four.offset.set(k, normal.dot(support(normal)));
    });
  }

  Polygon<S> polygon() const { return {fours_.data(), size_}; }
  Vector<2, S> center() const {
    Vector<2, S> sum = Vector<2, S>::Zero();
    for (int i = 0; i < size_; ++i) sum += polygon().corner(i);
    return sum / static_cast<S>(size_);
  }
  Vector<2, S> support(const Vector<2, S>& d) const { return polygon().corner(polygon().highest(d)); }

 private:
  std::vector<PolygonFour<S>> fours_;
  int size_;
};

/// A box in the plane, none of its sides zero, as a polygon.
template <class S>
class BoxPolygon {
 public:
  explicit BoxPolygon(const BoxCore<2, S>& box) {
    const auto& [high, low] = box.corners;
    set(0, {low[0], low[1]}, {0, -1}, -low[1]);
    set(1, {high[0], low[1]}, {1, 0}, high[0]);
    set(2, {high[0], high[1]}, {0, 1}, high[1]);
    set(3, {low[0], high[1]}, {-1, 0}, -low[0]);
  }
  Polygon<S> polygon() const { return {&four_, 4}; }

 private:
  void set(std::size_t k, const Vector<2, S>& corner, const Vector<2, S>& normal, S offset) {
    four_.set(k, corner, normal);
    four_.offset.set(k, offset);
  }

  PolygonFour<S> four_;
};

}  // namespace gjkdbg
