// The support mapping of a convex polytope with many vertices: a table of directions.
//
// A cube around the origin is cut into cells, about four times as many as the hull has vertices (but no more than 100,000), and every cell knows the
// vertices that are highest along one of its directions: two or three, one in 25 has more than four. A query looks at those and nothing else, however many
// vertices there are. A cell keeps their numbers only: what the support of a large hull waits for is memory, and of a thousand pairs met in turn a table
// with the vertices themselves in every cell is in no cache. Vertices of cells that are next to each other are so too, in memory.
//
//       +---+---+---+        Vertex v is highest along d if (u - v) . d <= 0 for each of its neighbours u: a half of the plane the
//       |   |   | d |        cell lies in. v belongs to the cell if these halves leave something of it: either one of its corners,
//       +---+---+---+        or what is there when the cell has been cut by one after the other (Sutherland, Hodgman 1974).
//       |   |   |   |
//       +---+---+---+
//
// The vertices that are highest somewhere in a cell hang together along edges, as a cell is connected and the directions of
// two vertices meet across an edge: the search for them spreads from one of them. Flat and long hulls have their directions in a few
// cells; so lengths are measured by the hull's box, in which v . d = sum (v_i / e_i) (e_i d_i).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "shapes/convex_hull.h"

namespace gjkdbg {

template <class S>
class HullCore {
  using V = Vector<3, S>;

 public:
  /// The vertices of a solid hull, as in hull.vertices, and its adjacency.
  HullCore(const std::vector<V>& vertices, const ConvexHull& hull) {
    V low = vertices.front(), high = low;
    for (const V& v : vertices) center_ += v, low = low.cwiseMin(v), high = high.cwiseMax(v);
    center_ /= static_cast<S>(vertices.size());
    box_ = (high - low).cwiseMax((high - low).maxCoeff() * std::numeric_limits<S>::epsilon());  // in float a thin hull may have no thickness left
    across_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(vertices.size()) / 1.5)), 1, 128);
    const int cells = 6 * across_ * across_;
    std::vector<int> spread{0};
    std::vector<int> met(vertices.size(), -1), numbers(vertices.size(), -1);
    cells_.resize(static_cast<std::size_t>(cells));
    for (int cell = 0; cell < cells; ++cell) {
      spread.assign(1, climb(vertices, hull, spread.front(), direction(cell, S(0.5), S(0.5))));
      met[static_cast<std::size_t>(spread.front())] = cell;
      const std::array<V, 4> corners{direction(cell, 0, 0), direction(cell, 0, 1), direction(cell, 1, 1), direction(cell, 1, 0)};
      for (std::size_t i = 0; i < spread.size(); ++i)
        for (const int other : around(hull, spread[i]))
          if (std::exchange(met[static_cast<std::size_t>(other)], cell) != cell && highest_somewhere(vertices, hull, other, corners)) spread.push_back(other);
      for (const int i : spread)
        if (int& number = numbers[static_cast<std::size_t>(i)]; number < 0) number = static_cast<int>(vertices_.size()), vertices_.push_back(vertices[static_cast<std::size_t>(i)]);
      keep(static_cast<std::size_t>(cell), numbers, spread);
    }
  }

  V center() const { return center_; }
  std::size_t bytes() const { return sizeof(Cell) * cells_.size() + sizeof(V) * vertices_.size(); }  ///< that a query may look at

  /// Which vertex is highest, and in which cell d lies, is nothing a processor can guess: no comparison is a branch.
  V support(const V& d) const {
    const Cell& cell = cells_[cell_of(box_.cwiseProduct(d))];
    if (goes_on(cell)) [[unlikely]] return highest_of_many(cell, d);
    const std::uint32_t i = cell[0], j = cell[1], k = cell[2], l = cell[3];
    const S height_i = height(i, d), height_j = height(j, d), height_k = height(k, d), height_l = height(l, d);
    const std::uint32_t of_first = chosen(height_j > height_i, j, i), of_last = chosen(height_l > height_k, l, k);
    return vertices_[chosen(std::max(height_k, height_l) > std::max(height_i, height_j), of_last, of_first)];
  }

 private:
  /// Numbers of vertices; where there are fewer than four, the last is there again. Of more, three are here, and instead of the fourth, with the
  /// highest bit set, the number of the cell with the others.
  static constexpr std::size_t places = 4;
  static constexpr std::uint32_t on = std::uint32_t{1} << 31;
  struct alignas(16) Cell : std::array<std::uint32_t, places> {};
  static bool goes_on(const Cell& cell) { return cell[3] >= on; }

  S height(std::uint32_t i, const V& d) const {
    const V& v = vertices_[i];
    return v[0] * d[0] + v[1] * d[1] + v[2] * d[2];
  }
  static std::uint32_t chosen(bool which, std::uint32_t yes, std::uint32_t no) { return no ^ ((yes ^ no) & -static_cast<std::uint32_t>(which)); }

  [[gnu::noinline]] V highest_of_many(const Cell& first, const V& d) const {
    std::uint32_t best = first[0];
    const auto offer = [&](std::uint32_t i) {
      if (height(i, d) > height(best, d)) best = i;
    };
    const Cell* cell = &first;
    for (; goes_on(*cell); cell = &cells_[(*cell)[3] - on]) offer((*cell)[0]), offer((*cell)[1]), offer((*cell)[2]);
    for (const std::uint32_t i : *cell) offer(i);
    return vertices_[best];
  }

  static std::span<const int> around(const ConvexHull& hull, int vertex) {
    const auto i = static_cast<std::size_t>(vertex);
    return std::span(hull.neighbours).subspan(static_cast<std::size_t>(hull.first_neighbour[i]), static_cast<std::size_t>(hull.first_neighbour[i + 1] - hull.first_neighbour[i]));
  }

  /// Where d leaves the cube: its largest component says through which side, the others in which of that side's cells.
  int cell_of(const V& d) const {
    const S x = std::abs(d[0]), y = std::abs(d[1]), z = std::abs(d[2]), xy = std::max(x, y);
    const int first = y > x, axis = first + (2 - first) * (z > xy);
    constexpr int after[3] = {1, 2, 0};
    const S most = std::max(xy, z), half = static_cast<S>(across_) / 2, scale = most > 0 ? half / most : S(0);
    const int u = place(d[after[axis]] * scale + half), v = place(d[after[after[axis]]] * scale + half);
    return ((2 * axis + (d[axis] < 0)) * across_ + u) * across_ + v;
  }
  int place(S x) const { return x < static_cast<S>(across_) ? static_cast<int>(x) : across_ - 1; }  // infinite or NaN: the last

  /// The direction through a place of a cell, (0.5, 0.5) its middle; in the body's lengths, not the box's.
  V direction(int cell, S u, S v) const {
    const int side = cell / (across_ * across_), axis = side / 2;
    V d;
    d[axis] = side % 2 ? S(-1) : S(1);
    d[(axis + 1) % 3] = 2 * (static_cast<S>(cell / across_ % across_) + u) / static_cast<S>(across_) - 1;
    d[(axis + 2) % 3] = 2 * (static_cast<S>(cell % across_) + v) / static_cast<S>(across_) - 1;
    return d.cwiseQuotient(box_);
  }

  /// On a convex polytope a vertex with no higher neighbour is a highest one.
  static int climb(const std::vector<V>& vertices, const ConvexHull& hull, int best, const V& d) {
    for (int from = -1; from != best;) {
      from = best;
      for (const int other : around(hull, from))
        if ((vertices[static_cast<std::size_t>(other)] - vertices[static_cast<std::size_t>(best)]).dot(d) > 0) best = other;
    }
    return best;
  }

  /// In the box's lengths all vertices lie within 1 and the corners within sqrt(3): what is higher by less than `rounding` may be so by mistake.
  static bool highest_somewhere(const std::vector<V>& vertices, const ConvexHull& hull, int vertex, const std::array<V, 4>& corners) {
    constexpr S rounding = 64 * std::numeric_limits<S>::epsilon();
    const auto up_to = [&](int other) { return V(vertices[static_cast<std::size_t>(other)] - vertices[static_cast<std::size_t>(vertex)]); };
    unsigned left_corners = 0b1111;
    for (const int other : around(hull, vertex)) {
      const V up = up_to(other);
      unsigned higher = 0;
      for (std::size_t k = 0; k < 4; ++k) higher |= static_cast<unsigned>(up.dot(corners[k]) > rounding) << k;
      if (higher == 0b1111) return false;
      left_corners &= ~higher;
    }
    if (left_corners != 0) return true;
    std::vector<V> left(corners.begin(), corners.end()), cut;
    for (const int other : around(hull, vertex)) {
      const V up = up_to(other);
      cut.clear();
      for (std::size_t i = 0; i < left.size(); ++i) {
        const V &from = left[i], &to = left[(i + 1) % left.size()];
        const S height = up.dot(from) - rounding, next = up.dot(to) - rounding;
        if (height <= 0) cut.push_back(from);
        if ((height < 0 && next > 0) || (height > 0 && next < 0)) cut.push_back(from + (to - from) * (height / (height - next)));
      }
      left.swap(cut);
    }
    return !left.empty();
  }

  void keep(std::size_t cell, std::span<const int> numbers, std::span<const int> highest) {
    for (;;) {
      for (std::size_t i = 0; i < places; ++i) cells_[cell][i] = static_cast<std::uint32_t>(numbers[static_cast<std::size_t>(highest[std::min(i, highest.size() - 1)])]);
      if (highest.size() <= places) return;
      highest = highest.subspan(places - 1);
      cells_[cell][3] = on + static_cast<std::uint32_t>(cells_.size());
      cell = cells_.size();
      cells_.emplace_back();
    }
  }

  V center_ = V::Zero(), box_;
  int across_;
  std::vector<Cell> cells_;
  std::vector<V> vertices_;  ///< as the cells come by them
};

}  // namespace gjkdbg
