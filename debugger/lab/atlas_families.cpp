// The families. Sources: the failures of other implementations gathered in the gallery; FCL's kissing boxes, MuJoCo's size ratios,
// libccd's stacked cubes, van den Bergen's "identical shapes". Each exact answer is a closed form of the rounded input.
#include <cmath>

#include "debugger/lab/atlas.h"

namespace gjkdbg {
namespace {

AnyVector vec(double x, double y, double z) { return Eigen::Vector3d(x, y, z); }

Body box(const AnyVector& half, const AnyVector& position) {
  Body body{"", {Box{-half, half, true}, 0}, identity_pose(3)};
  body.pose.position = position;
  return body;
}
Body cube(const AnyVector& position, double half = 1) { return box(vec(half, half, half), position); }

Body points(std::vector<AnyVector> list, const AnyVector& position = vec(0, 0, 0)) {
  Body body{"", {PointSet{PointSetKind::hull, std::move(list), {}}, 0}, identity_pose(3)};
  body.pose.position = position;
  return body;
}

Body sphere(double radius, const AnyVector& position) {
  Body body{"", {Sphere{radius}, 0}, identity_pose(3)};
  body.pose.position = position;
  return body;
}

Body ellipsoid(const AnyVector& radii, const AnyVector& position) {
  Body body{"", {Ellipsoid{radii}, 0}, identity_pose(3)};
  body.pose.position = position;
  return body;
}

Scene pair(Body a, Body b) {
  a.name = "A", b.name = "B";
  Scene scene;
  scene.bodies = {std::move(a), std::move(b)};
  return scene;
}

std::vector<double> gaps(bool quick) {
  std::vector<double> out{0};
  for (const double g : {0x1p-52, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-3})
    if (!quick || g > 0.5e-15)
      for (const double s : {1.0, -1.0}) out.push_back(s * g);
  return out;
}

std::vector<double> powers(double from, double to, bool quick) {
  std::vector<double> out;
  const double step = quick ? 100 : 10;
  for (double x = from; from < to ? x <= to * 1.001 : x >= to * 0.999; x *= from < to ? step : 1 / step) out.push_back(x);
  return out;
}

/// A cube and another, moved: kissing face to face, edge to edge, vertex to vertex. With c = 2 + g rounded, c - 2 is exact.
void kisses(std::vector<AtlasFamily>& out, bool quick) {
  AtlasFamily face{"K1", "cubes kiss face to face; the origin lies in the plane of a face", {}}, edge{"K4", "cubes kiss edge to edge; two normals tie", {}},
      corner{"K3", "cubes kiss corner to corner; three normals tie", {}};
  for (const double g : gaps(quick)) {
    const double c = 2 + g, gap = c - 2;
    face.cases.push_back({g, pair(cube(vec(0, 0, 0)), cube(vec(0.25, 0.125, c))), gap});
    edge.cases.push_back({g, pair(cube(vec(0, 0, 0)), cube(vec(c, 0.25, c))), gap > 0 ? std::sqrt(2.0) * gap : gap});
    corner.cases.push_back({g, pair(cube(vec(0, 0, 0)), cube(vec(c, c, c))), gap > 0 ? std::sqrt(3.0) * gap : gap});
  }
  out.push_back(face), out.push_back(edge), out.push_back(corner);
}

void overlaps(std::vector<AtlasFamily>& out, bool quick) {
  AtlasFamily stacked{"K2", "stacked cubes: the simplex holds the origin after two vertices, and the triple product vanishes", {}};
  for (const double z : {1.9, 1.5, 1.0, 0.5, 0.1}) stacked.cases.push_back({z, pair(cube(vec(0, 0, 0)), cube(vec(0, 0, z))), z - 2});
  AtlasFamily same{"C1", "the same cube twice, and nearly: the first direction is zero, six normals tie", {}};
  same.cases.push_back({0, pair(cube(vec(0, 0, 0)), cube(vec(0, 0, 0))), -2});
  for (const double d : powers(1e-15, 1e-3, quick)) same.cases.push_back({d, pair(cube(vec(0, 0, 0)), cube(vec(d, 0, 0))), d - 2});
  AtlasFamily spheres{"C3", "nearly concentric balls: solved on centres, or EPA never ends", {}};
  for (const double d : powers(1e-12, 1, quick)) spheres.cases.push_back({d, pair(sphere(2, vec(1, 2, 3)), sphere(1.5, vec(1 + d, 2, 3))), (1 + d - 1) - 3.5});
  AtlasFamily deep{"C5", "ellipsoids, deep: the polytope closes in on a smooth surface", {}};
  for (const double d : {0.1, 0.3, 0.5, 0.9, 1.3}) deep.cases.push_back({d, pair(ellipsoid(vec(0.5, 2, 3), vec(0, 0, 0)), ellipsoid(vec(1, 2, 2), vec(d, 0, 0))), d - 1.5});
  AtlasFamily shallow{"E1", "stacked boxes, a little deep: the origin lies on a face of the first tetrahedron and the contact is dropped", {}};
  for (const double d : powers(1e-14, 1e-1, quick)) {
    const double z = 0.4 - d;
    shallow.cases.push_back({d, pair(cube(vec(0, 0, 0), 0.2), cube(vec(0, 0, z), 0.2)), z - 0.4});
  }
  out.push_back(stacked), out.push_back(same), out.push_back(spheres), out.push_back(deep), out.push_back(shallow);
}

void degenerate(std::vector<AtlasFamily>& out, bool quick) {
  AtlasFamily slab{"F1", "flat plates: the difference has next to no volume", {}};
  for (const double t : powers(1e-3, 1e-12, quick)) slab.cases.push_back({t, pair(box(vec(1, 1, t), vec(0, 0, 0)), box(vec(1, 1, t), vec(1.0 / 3, 0.2, t))), -t});
  AtlasFamily flat{"F2", "coplanar triangles, and a gap: the difference is flat", {}};
  for (const double z : {0.0, 1e-12, 1e-8, 1e-4})
    flat.cases.push_back({z, pair(points({vec(0, 0, 0), vec(1, 0, 0), vec(0, 1, 0)}), points({vec(0.25, 0.25, z), vec(2, 0.25, z), vec(0.25, 2, z)})), z});
  AtlasFamily lines{"F3", "parallel segments: edge against edge with no cross product", {}};
  for (const double y : powers(1e-12, 1, quick)) lines.cases.push_back({y, pair(points({vec(0, 0, 0), vec(1, 0, 0)}), points({vec(0.25, y, 0), vec(0.75, y, 0)})), y});
  AtlasFamily needles{"S1", "crossed needles: products of lengths differ by the square of the aspect", {}};
  for (const double l : powers(10, 1e6, quick)) needles.cases.push_back({l, pair(box(vec(l, 1 / l, 1 / l), vec(0, 0, 0)), box(vec(1 / l, l, 1 / l), vec(0, 0, 4 / l))), 4 / l - 2 * (1 / l)});
  AtlasFamily sliver{"S2", "a triangle of vanishing height: its normal is rounding", {}};
  for (const double h : powers(1e-2, 1e-12, quick)) sliver.cases.push_back({h, pair(points({vec(0, 0, 0), vec(1, 0, 0), vec(0.5, h, 0)}), points({vec(0.5, 0, 1)})), 1});
  out.push_back(slab), out.push_back(flat), out.push_back(lines), out.push_back(needles), out.push_back(sliver);
}

void scales(std::vector<AtlasFamily>& out, bool quick) {
  AtlasFamily ratio{"R1", "a small box on a wide slab: tolerances of one are blind to the other", {}};
  for (const double k : powers(1, 1e6, quick)) {
    const double z = 0.34924578666687;
    ratio.cases.push_back({k, pair(box(vec(50 * k, 50 * k, 0.25), vec(0, 0, 0)), cube(vec(0, 0, z), 0.1)), z - 0.35});
  }
  AtlasFamily far{"W1", "far from the origin: differences of large coordinates cancel", {}};
  for (const double t : powers(1, 1e15, quick)) far.cases.push_back({t, pair(cube(vec(t, t, t)), cube(vec(t + 2.5, t, t))), ((t + 2.5) - t) - 2});
  AtlasFamily size{"W2", "tiny and huge scenes: absolute tolerances", {}};
  for (const double s : powers(1e-12, 1e12, quick)) size.cases.push_back({s, pair(cube(vec(0, 0, 0), s), cube(vec(0, 0, 1.9 * s), s)), 1.9 * s - 2 * s});
  out.push_back(ratio), out.push_back(far), out.push_back(size);
}

}  // namespace

std::vector<AtlasFamily> atlas_families(bool quick) {
  std::vector<AtlasFamily> families;
  kisses(families, quick);
  overlaps(families, quick);
  degenerate(families, quick);
  scales(families, quick);
  return families;
}

}  // namespace gjkdbg
