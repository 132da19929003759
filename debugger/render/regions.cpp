#include "debugger/render/regions.h"

#include <algorithm>
#include <cmath>

namespace gjkdbg {

namespace {

/// The part of a convex polygon where n . (x - p) >= 0.
std::vector<ViewPoint> clip(const std::vector<ViewPoint>& polygon, const ViewPoint& p, const ViewPoint& n) {
  std::vector<ViewPoint> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ViewPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = n.dot(a - p), db = n.dot(b - p);
    if (da >= 0) out.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) out.push_back(a + (b - a) * (da / (da - db)));
  }
  return out;
}

struct RegionPainter {
  Picture& picture;
  const std::vector<ViewPoint>& simplex;
  const std::vector<int>& part;
  double reach;
  Colour colour;

  const ViewPoint& at(int i) const { return simplex[static_cast<std::size_t>(i)]; }
  bool in_part(int i) const { return std::find(part.begin(), part.end(), i) != part.end(); }
  std::vector<int> others() const {
    std::vector<int> list;
    for (int i = 0; i < static_cast<int>(simplex.size()); ++i)
      if (!in_part(i)) list.push_back(i);
    return list;
  }

  /// A big square, cut by what makes the region: beyond the part as seen from each other vertex, and beside it.
  void plane() {
    std::vector<ViewPoint> region{{-reach, -reach, 0}, {reach, -reach, 0}, {reach, reach, 0}, {-reach, reach, 0}};
    if (part.size() == 1) {
      for (const int o : others()) region = clip(region, at(part[0]), at(part[0]) - at(o));
    } else if (part.size() == 2) {
      const ViewPoint &p = at(part[0]), &q = at(part[1]), e = q - p;
      region = clip(clip(region, p, e), q, -e);
      const ViewPoint normal(-e[1], e[0], 0);
      for (const int o : others()) region = clip(region, p, normal.dot(at(o) - p) > 0 ? ViewPoint(-normal) : normal);
    } else {
      region.clear();
      for (const int i : part) region.push_back(at(i));
    }
    if (region.size() < 3) return;
    for (std::size_t i = 0; i < region.size(); ++i) picture.line(region[i], region[(i + 1) % region.size()], colour.with_alpha(0.45), 1.1, Stroke::dashed);
    picture.faces.push_back({region, colour.with_alpha(0.13)});
  }

  void wall(const ViewPoint& a, const ViewPoint& b, const ViewPoint& c, const ViewPoint& d) {
    picture.faces.push_back({{a, b, c, d}, colour.with_alpha(0.07)});
    picture.line(a, d, colour.with_alpha(0.4), 1, Stroke::dashed), picture.line(b, c, colour.with_alpha(0.4), 1, Stroke::dashed);
  }

  /// The plane through p across e, which bounds the region of an end or of an edge that is all there is of the simplex.
  void across(const ViewPoint& p, const ViewPoint& e) {
    if (e.isZero(0)) return;
    const ViewPoint x = e.stableNormalized().unitOrthogonal() * (reach / 6), y = e.stableNormalized().cross(x), corners[4] = {p + x + y, p + x - y, p - x - y, p - x + y};
    for (int i = 0; i < 4; ++i) picture.line(corners[i], corners[(i + 1) % 4], colour.with_alpha(0.4), 1, Stroke::dashed);
    picture.faces.push_back({{corners[0], corners[1], corners[2], corners[3]}, colour.with_alpha(0.07)});
  }

  /// The normal of face p q r, away from the vertex `from`; of a bare triangle towards the origin.
  ViewPoint outward(int p, int q, int r) const {
    ViewPoint n = (at(q) - at(p)).cross(at(r) - at(p));
    if (n.isZero(0)) return n;
    n.normalize();
    for (int i = 0; i < static_cast<int>(simplex.size()); ++i)
      if (i != p && i != q && i != r) return n.dot(at(i) - at(p)) > 0 ? ViewPoint(-n) : n;
    return n.dot(at(p)) > 0 ? ViewPoint(-n) : n;
  }

  void space() {
    const std::vector<int> rest = others();
    if (part.size() == 3) {
      const ViewPoint n = outward(part[0], part[1], part[2]) * reach;
      for (std::size_t i = 0; i < 3; ++i) {
        const ViewPoint &p = at(part[i]), &q = at(part[(i + 1) % 3]);
        wall(p, q, q + n, p + n);
      }
    } else if (simplex.size() == 2) {
      for (const int i : part) across(at(i), at(1 - i) - at(i));
    } else if (part.size() == 2) {
      // Between the walls along the normals of the faces beside the edge, and between its ends.
      const ViewPoint &p = at(part[0]), &q = at(part[1]);
      for (const int o : rest) {
        const ViewPoint n = outward(part[0], part[1], o) * reach;
        wall(p, q, q + n, p + n);
      }
    } else if (part.size() == 1) {
      for (std::size_t i = 0; i < rest.size(); ++i)
        for (std::size_t j = i + 1; j < rest.size(); ++j) {
          const ViewPoint& p = at(part[0]);
          const ViewPoint n = outward(part[0], rest[i], rest[j]) * reach;
          const ViewPoint away = (p - (at(rest[i]) + at(rest[j])) / 2).stableNormalized() * reach;
          wall(p, p, p + n, p + away);
        }
    }
  }
};

}  // namespace

void draw_region(Picture& picture, const std::vector<ViewPoint>& simplex, const std::vector<int>& part, double reach, Colour colour, int dimension) {
  RegionPainter painter{picture, simplex, part, reach, colour};
  if (dimension == 2) painter.plane();
  if (dimension == 3) painter.space();
}

}  // namespace gjkdbg
