// The support mapping of a convex polytope with many vertices: a table of directions.
//
// A cube around the origin is cut into cells, about twice as many as the hull has vertices (but no more than 100,000), and every cell keeps the vertices
// that are highest along one of its directions: three or four, side by side in memory, which is what the support of a large hull waits for. A query looks
// at those and nothing else, however many vertices there are.
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
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "shapes/convex_hull.h"
#include "shapes/table_memory.h"
#include "shapes/vertex_fours.h"
#ifdef GJKDBG_AVX2
#include <immintrin.h>
#endif

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
    across_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(vertices.size()) / 3)), 1, 128);
    for (int i = 0; i < 3; ++i) box_and_half_[i] = box_[i];
    box_and_half_[3] = static_cast<S>(across_) / 2;
    const int cells = 6 * across_ * across_;
    std::vector<int> spread{0};
    std::vector<int> met(vertices.size(), -1);
    std::vector<Cell> table(static_cast<std::size_t>(cells));
    for (int cell = 0; cell < cells; ++cell) {
      spread.assign(1, climb(vertices, hull, spread.front(), direction(cell, S(0.5), S(0.5))));
      met[static_cast<std::size_t>(spread.front())] = cell;
      const std::array<V, 4> corners{direction(cell, 0, 0), direction(cell, 0, 1), direction(cell, 1, 1), direction(cell, 1, 0)};
      for (std::size_t i = 0; i < spread.size(); ++i)
        for (const int other : around(hull, spread[i]))
          if (std::exchange(met[static_cast<std::size_t>(other)], cell) != cell && highest_somewhere(vertices, hull, other, corners)) spread.push_back(other);
      keep(table, static_cast<std::size_t>(cell), vertices, spread);
    }
    cells_.assign(table.begin(), table.end());
  }

  V center() const { return center_; }
  std::size_t candidates() const { return Cell::places * cells_.size(); }  ///< places for them, in all cells

  V support(const V& d) const {
    const Cell* cell = cells_.data() + cell_of(box_.cwiseProduct(d));
    Highest highest = cell->highest(d);
    V best = cell->vertex(highest.place);
    while (cell->next >= 0) {
      cell = cells_.data() + cell->next;
      const Highest other = cell->highest(d);
      if (other.height > highest.height) highest = other, best = cell->vertex(other.place);
    }
    return best;
  }

#ifdef GJKDBG_AVX2
  static constexpr std::size_t stride = 5;  ///< from a vertex's x to its y and to its z, in memory
  /// Where the vertex is that `support` says. d has three numbers and one that is not asked for. Null: `support` has to look at more than one cell.
  [[gnu::target("avx2"), gnu::always_inline]] inline const S* highest_by_avx2(const __m256d& d) const
    requires std::is_same_v<S, double>
  {
    static_assert(stride == Cell::places);
    const __m256d in_box = _mm256_mul_pd(_mm256_loadu_pd(box_and_half_), d), lengths = _mm256_andnot_pd(_mm256_set1_pd(-0.0), in_box);
    const __m128d xy = _mm256_castpd256_pd128(lengths), z = _mm256_extractf128_pd(lengths, 1), y = _mm_unpackhi_pd(xy, xy), greater = _mm_max_sd(xy, y), most = _mm_max_sd(greater, z);
    const int first = _mm_comigt_sd(y, xy), axis = first + (2 - first) * _mm_comigt_sd(z, greater);
    const __m128d half = _mm_load_sd(box_and_half_ + 3);
    const __m128d scale = _mm_and_pd(_mm_div_sd(half, most), _mm_cmpgt_sd(most, _mm_setzero_pd()));
    const __m256d across = _mm256_add_pd(_mm256_mul_pd(in_box, _mm256_broadcastsd_pd(scale)), _mm256_broadcastsd_pd(half));
    alignas(16) int place[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(place), _mm256_cvttpd_epi32(_mm256_min_pd(_mm256_max_pd(across, _mm256_setzero_pd()), _mm256_set1_pd(static_cast<double>(across_) - 0.5))));
    constexpr int after[4] = {1, 2, 0, 1};
    const int negative = _mm256_movemask_pd(_mm256_cmp_pd(d, _mm256_setzero_pd(), _CMP_LT_OQ)) >> axis & 1;
    const Cell& cell = cells_[static_cast<std::size_t>(((2 * axis + negative) * across_ + place[after[axis]]) * across_ + place[after[axis + 1]])];
    if (cell.next >= 0) [[unlikely]] return nullptr;
    const __m256d dx = _mm256_broadcastsd_pd(_mm256_castpd256_pd128(d)), dy = _mm256_permute4x64_pd(d, 0b01010101), dz = _mm256_permute4x64_pd(d, 0b10101010);
    const __m256d height = _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(_mm256_load_pd(cell.x.data()), dx), _mm256_mul_pd(_mm256_loadu_pd(cell.y.data()), dy)), _mm256_mul_pd(_mm256_loadu_pd(cell.z.data()), dz));
    const double last = cell.x[4] * d[0] + cell.y[4] * d[1] + cell.z[4] * d[2];
    const __m256d of_two = _mm256_max_pd(height, _mm256_permute_pd(height, 0b0101)), of_four = _mm256_max_pd(of_two, _mm256_permute2f128_pd(of_two, of_two, 1));
    const unsigned highest = static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(height, of_four, _CMP_EQ_OQ)));
    const std::size_t of_first = static_cast<std::size_t>(__builtin_ctz(highest | 16));
    return cell.x.data() + Cell::chosen(_mm_comigt_sd(_mm_set_sd(last), _mm256_castpd256_pd128(of_four)), 4, of_first);
  }
#endif

 private:
  static std::span<const int> around(const ConvexHull& hull, int vertex) {
    const auto i = static_cast<std::size_t>(vertex);
    return std::span(hull.neighbours).subspan(static_cast<std::size_t>(hull.first_neighbour[i]), static_cast<std::size_t>(hull.first_neighbour[i + 1] - hull.first_neighbour[i]));
  }

  /// Where d leaves the cube: its largest component says through which side, the others in which of that side's cells.
  int cell_of(const V& d) const {
    const S x = std::abs(d[0]), y = std::abs(d[1]), z = std::abs(d[2]), xy = std::max(x, y);
    const int first = y > x, axis = first + (2 - first) * (z > xy);  // no branch: which it is, is nothing a processor can guess
    constexpr int after[3] = {1, 2, 0};
    const S most = std::max(xy, z), half = static_cast<S>(across_) / 2, scale = most > 0 ? half / most : S(0);
    const int u = place(d[after[axis]] * scale + half), v = place(d[after[after[axis]]] * scale + half);
    return ((2 * axis + (d[axis] < 0)) * across_ + u) * across_ + v;
  }
  int place(S x) const {
    const S inside = x > 0 ? x : S(0);  // lengths that are nearly none may make it infinite, or NaN
    return inside < static_cast<S>(across_) ? static_cast<int>(inside) : across_ - 1;
  }

  /// The direction through a place of a cell, (0.5, 0.5) its middle; in the body's lengths, not the box's.
  V direction(int cell, S u, S v) const {
    const int side = cell / (across_ * across_), axis = side / 2;
    V d;
    d[axis] = side % 2 ? S(-1) : S(1);
    d[(axis + 1) % 3] = 2 * (static_cast<S>(cell / across_ % across_) + u) / static_cast<S>(across_) - 1;
    d[(axis + 2) % 3] = 2 * (static_cast<S>(cell % across_) + v) / static_cast<S>(across_) - 1;
    return d.cwiseQuotient(box_);
  }

  /// On a convex polytope a vertex with no higher neighbour is a highest one. Of vertices as high as one another, around a face across d, rounding may
  /// find each higher than the one before, round and round; no way up comes by more vertices than there are.
  static int climb(const std::vector<V>& vertices, const ConvexHull& hull, int best, const V& d) {
    std::size_t left = vertices.size();
    for (int from = -1; from != best && left > 0; --left) {
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

  struct Highest {
    std::size_t place;
    S height;
  };

  /// Five vertices, coordinate by coordinate; where there are fewer, the last is there again. Two lines of the cache, in float one.
  struct alignas(16 * sizeof(S)) Cell {
    static constexpr std::size_t places = 5;
    std::array<S, places> x, y, z;
    int next = -1;  ///< >= 0: where there are more

    static std::size_t chosen(bool which, std::size_t yes, std::size_t no) { return no ^ ((yes ^ no) & -static_cast<std::size_t>(which)); }  ///< no branch
    V vertex(std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, const V& v) { x[i] = v[0], y[i] = v[1], z[i] = v[2]; }
    Highest highest(const V& d) const {
      std::array<S, places> height;
      for (std::size_t i = 0; i < places; ++i) height[i] = x[i] * d[0] + y[i] * d[1] + z[i] * d[2];
      const S low = std::max(height[1], height[0]), high = std::max(height[3], height[2]), four = std::max(high, low);
      const std::size_t of_low = height[1] > height[0], of_high = 2 + (height[3] > height[2]);
      return {chosen(height[4] > four, 4, chosen(high > low, of_high, of_low)), std::max(height[4], four)};
    }
  };

  static void keep(std::vector<Cell>& table, std::size_t cell, const std::vector<V>& vertices, std::span<const int> highest) {
    for (;;) {
      for (std::size_t i = 0; i < Cell::places; ++i) table[cell].set(i, vertices[static_cast<std::size_t>(highest[std::min(i, highest.size() - 1)])]);
      if (highest.size() <= Cell::places) return;
      highest = highest.subspan(Cell::places);
      table[cell].next = static_cast<int>(table.size());
      cell = table.size();
      table.emplace_back();
    }
  }

  V center_ = V::Zero(), box_;
  S box_and_half_[4];  ///< the box, and half of across_
  int across_;
  std::vector<Cell, TableAllocator<Cell>> cells_;
};

}  // namespace gjkdbg
