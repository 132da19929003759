// The families. Sources: the failures of other implementations gathered in the gallery; FCL's kissing boxes, MuJoCo's size ratios,
// libccd's stacked cubes, van den Bergen's "identical shapes". Each exact answer is a closed form of the rounded input.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "debugger/lab/atlas.h"
#include "shapes/error.h"

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

/// The rotation of an integer quaternion: its elements are fractions with the quaternion's squared length below.
AnyMatrix rotation(int w, int x, int y, int z) { return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix(); }

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
  AtlasFamily deep{"C5", "ellipsoids, deep, from one centre on: the polytope closes in on a smooth surface", {}};
  for (const double d : {0.0, 1e-12, 1e-6, 0.1, 0.3, 0.5, 0.9, 1.3}) deep.cases.push_back({d, pair(ellipsoid(vec(0.5, 2, 3), vec(0, 0, 0)), ellipsoid(vec(1, 2, 2), vec(d, 0, 0))), d - 1.5});
  AtlasFamily ring{"C6", "a cone and a cylinder deep in it, on one axis and beside it: a whole circle of points is nearest, or nearly", {}};
  std::vector<double> beside = powers(1e-16, 1e-1, quick);
  beside.insert(beside.begin(), 0);
  for (const double d : beside)  // across the cone's side, along (2, 1) / sqrt 5, the cone reaches 1 / sqrt 5, and the cylinder the other way 2 / sqrt 5
    ring.cases.push_back({d, pair({"", {Cone{1, 1, 2}, 0}, identity_pose(3)}, {"", {Cylinder{0.5, 1, 2}, 0}, identity_pose(3)}), (2 * d - 3) / std::sqrt(5.0)}), ring.cases.back().scene.bodies[1].pose.position = vec(d, 0, 0);
  AtlasFamily tilted{"C7", "spheroids about one middle, one tilted: a whole circle of directions is nearly as near, but not quite", {}};
  for (const double tilt : powers(1e-12, 1, quick)) {  // about x, across which both are thinnest
    tilted.cases.push_back({tilt, pair(ellipsoid(vec(0.75, 0.75, 1.5), vec(0, 0, 0)), ellipsoid(vec(0.5, 0.5, 1), vec(0, 0, 0))), -1.25});
    tilted.cases.back().scene.bodies[1].pose.matrix = Eigen::AngleAxisd(tilt, vec(1, 0, 0)).toRotationMatrix();
  }
  AtlasFamily rod{"C8", "a cylinder on the axis of what is nearly a spheroid: along its side a whole circle of directions is nearly as near", {}};
  for (const double unlike : powers(1e-12, 1, quick))  // across, both are thinnest along x
    rod.cases.push_back({unlike, pair(ellipsoid(vec(0.75, 0.75 * (1 + unlike), 1.5), vec(0, 0, 0)), {"", {Cylinder{0.5, 1, 2}, 0}, identity_pose(3)}), -1.25});
  AtlasFamily flat{"C9", "a cylinder next to flat within a capsule, tilted: all around the way out is hardly longer", {}};
  for (const double tilt : powers(1e-12, 1, quick)) {  // about x: the way out is along that, or where the flat one leans over most; between them its height is concave
    const double leant = 0.5 * std::cos(tilt) + std::sin(tilt) / 512;
    flat.cases.push_back({tilt, pair({"", {Capsule{1, 2.5, 2}, 0}, identity_pose(3)}, {"", {Cylinder{0.5, 1.0 / 512, 2}, 0}, identity_pose(3)}), -1 - std::min(0.5, leant)});
    flat.cases.back().scene.bodies[1].pose.matrix = Eigen::AngleAxisd(tilt, vec(1, 0, 0)).toRotationMatrix();
  }
  AtlasFamily crossed{"F4", "capsules whose middle lines cross at a smaller and smaller angle: their difference is flat, and next to a line", {}};
  for (const double tilt : powers(1e-12, 1, quick)) {
    crossed.cases.push_back({tilt, pair({"", {Capsule{0.5, 2, 2}, 0}, identity_pose(3)}, {"", {Capsule{0.25, 1, 2}, 0}, identity_pose(3)}), -0.75});
    Pose& pose = crossed.cases.back().scene.bodies[1].pose;
    pose.matrix = Eigen::AngleAxisd(tilt, vec(1, 0, 0)).toRotationMatrix(), pose.position = vec(0, 0, 0.375);
  }
  AtlasFamily sides{"P2", "a prism of many sides about a cylinder: through each of the sides the way out is as short", {}};
  for (int count = 4; count <= (quick ? 16 : 256); count *= 2) {
    PointSet prism{PointSetKind::hull, {}, {}};
    for (int i = 0; i < count; ++i)
      for (const double z : {-2.0, 2.0}) prism.points.push_back(vec(std::cos(2 * std::numbers::pi * i / count), std::sin(2 * std::numbers::pi * i / count), z));
    sides.cases.push_back({static_cast<double>(count), pair({"", {prism, 0}, identity_pose(3)}, {"", {Cylinder{0.5, 1, 2}, 0}, identity_pose(3)}), -0.5 - std::cos(std::numbers::pi / count)});
  }
  AtlasFamily shallow{"E1", "stacked boxes, a little deep: the origin lies on a face of the first tetrahedron and the contact is dropped", {}};
  for (const double d : powers(1e-14, 1e-1, quick)) {
    const double z = 0.4 - d;
    shallow.cases.push_back({d, pair(cube(vec(0, 0, 0), 0.2), cube(vec(0, 0, z), 0.2)), z - 0.4});
  }
  out.push_back(stacked), out.push_back(same), out.push_back(spheres), out.push_back(deep), out.push_back(ring), out.push_back(tilted), out.push_back(rod), out.push_back(flat), out.push_back(crossed), out.push_back(sides), out.push_back(shallow);
}

/// Triangles tip to tip in the plane, wedges edge to edge in space.
AtlasFamily tips(bool quick) {
  AtlasFamily family{"S4", "blades tip to tip: along every face's normal the gap is less than rounding", {}};
  const double gap = 1e-3;
  for (const double thin : powers(1e-1, 1e-12, quick))
    for (const int dimension : {2, 3}) {
      Scene scene;
      scene.dimension = dimension;
      for (const double side : {-1.0, 1.0}) {
        Body body{side < 0 ? "A" : "B", {PointSet{PointSetKind::hull, {}, {}}, 0}, identity_pose(dimension)};
        auto& corners = std::get<PointSet>(body.shape.geometry).points;
        if (dimension == 2) corners = {Eigen::Vector2d(0, 0), Eigen::Vector2d(side, thin), Eigen::Vector2d(side, -thin)};
        for (const double y : {-1.0, 1.0})
          if (dimension == 3) corners.insert(corners.end(), {vec(0, y, 0), vec(side, y, thin), vec(side, y, -thin)});
        if (side > 0) body.pose.position[0] = gap;
        scene.bodies.push_back(body);
      }
      family.cases.push_back({thin, scene, gap});
    }
  return family;
}

/// The line of the edge is `radius - d` from the axis, so the edge d deep, and no direction is shorter: the triangle lies beyond the plane that touches the side there.
AtlasFamily edge_in_a_rod(bool quick) {
  AtlasFamily family{"S5", "the edge of a triangle in the side of a long rod: EPA's faces around the way out are slivers, whose planes lean", {}};
  const double radius = 0.5, half = 1000;
  for (const double d : powers(1e-8, 1e-1, quick))
    for (int turn = 1; turn <= 40; ++turn) {
      const AnyMatrix axes = rotation(5, 1 + turn, 2 - turn % 7, turn % 11);
      const AnyVector along = axes.col(2), out = (axes.col(0) + 0.1 * (turn % 13) * axes.col(1)).normalized();
      const Eigen::Vector3d axis = along, edge = 0.3 * axis + axis.cross(Eigen::Vector3d(out)) * (turn % 5 + 1) / 3;
      const AnyVector corner = -0.7 * edge, other = 1.1 * edge;
      Scene scene = pair(points({corner, other, 0.9 * out + 0.4 * along}), {"", {Cylinder{radius, half, 2}, 0}, identity_pose(3)});
      Pose& pose = scene.bodies[1].pose;
      pose.matrix = axes, pose.rotation = RotationMatrix{axes}, pose.position = (d - radius) * out + 0.3 * along;
      const Eigen::Vector3d across = axis.cross(Eigen::Vector3d(other - corner)).normalized();
      family.cases.push_back({d, scene, std::abs(across.dot(Eigen::Vector3d(pose.position - corner))) - radius});
    }
  return family;
}

void degenerate(std::vector<AtlasFamily>& out, bool quick) {
  AtlasFamily slab{"F1", "flat plates: the difference has next to no volume, or none", {}};
  for (const double t : powers(1e-3, 1e-12, quick)) slab.cases.push_back({t, pair(box(vec(1, 1, t), vec(0, 0, 0)), box(vec(1, 1, t), vec(1.0 / 3, 0.2, t))), -t});
  slab.cases.push_back({0, pair(box(vec(1, 1, 0), vec(0, 0, 0)), box(vec(1, 1, 0), vec(1.0 / 3, 0.2, 0))), 0});
  AtlasFamily flat{"F2", "coplanar triangles, and a gap: the difference is flat", {}};
  for (const double z : {0.0, 1e-12, 1e-8, 1e-4})
    flat.cases.push_back({z, pair(points({vec(0, 0, 0), vec(1, 0, 0), vec(0, 1, 0)}), points({vec(0.25, 0.25, z), vec(2, 0.25, z), vec(0.25, 2, z)})), z});
  AtlasFamily lines{"F3", "parallel segments, and two in one line: edge against edge with no cross product", {}};
  for (const double y : powers(1e-12, 1, quick)) lines.cases.push_back({y, pair(points({vec(0, 0, 0), vec(1, 0, 0)}), points({vec(0.25, y, 0), vec(0.75, y, 0)})), y});
  lines.cases.push_back({0, pair(points({vec(0, 0, 0), vec(1, 0, 0)}), points({vec(2, 0, 0), vec(3, 0, 0)})), 1});
  AtlasFamily needles{"S1", "crossed needles: products of lengths differ by the square of the aspect", {}};
  for (const double l : powers(10, 1e9, quick)) needles.cases.push_back({l, pair(box(vec(l, 1 / l, 1 / l), vec(0, 0, 0)), box(vec(1 / l, l, 1 / l), vec(0, 0, 4 / l))), 4 / l - 2 * (1 / l)});
  AtlasFamily sliver{"S2", "a triangle of vanishing height: its normal is rounding", {}};
  for (const double h : powers(1e-2, 1e-12, quick)) sliver.cases.push_back({h, pair(points({vec(0, 0, 0), vec(1, 0, 0), vec(0.5, h, 0)}), points({vec(0.5, 0, 1)})), 1});
  out.push_back(slab), out.push_back(flat), out.push_back(lines), out.push_back(needles), out.push_back(sliver), out.push_back(tips(quick)), out.push_back(edge_in_a_rod(quick));
}

/// A cylinder that pokes through a triangle far larger than itself leaves across the triangle's plane: as deep as its support, r |a_xy| + h |a_z| with
/// a its axis, lies below the plane.
AtlasFamily pierced(bool quick) {
  AtlasFamily family{"R2", "a small cylinder through a larger and larger triangle: what begins at its middle begins far away", {}};
  const double radius = 0.02, half = 0.07;
  for (const double k : powers(1e-2, 1e4, quick))
    for (const double height : {0.000361, 0.03}) {
      Scene scene = pair(points({vec(0, 0, 0), vec(100 * k, 320 * k, 0), vec(0, 320 * k, 0)}), {"", {Cylinder{radius, half, 2}, 0}, identity_pose(3)});
      scene.bodies[1].pose.position = vec(20 * k, 200 * k, height), scene.bodies[1].pose.matrix = rotation(5, 1, 2, 0);
      const AnyVector axis = scene.bodies[1].pose.matrix.col(2);
      family.cases.push_back({k, scene, height - (radius * std::hypot(axis[0], axis[1]) + half * std::abs(axis[2]))});
    }
  return family;
}

/// The pairs that broke FCL, by the number. The depth of 395 is SAT's, as in the gallery; the others lie along axes.
AtlasFamily replayed() {
  AtlasFamily family{"E2", "pairs that broke FCL: faces of no area, vertices in line with an edge, the wrong feature", {}};
  Scene plate = pair(box(vec(0.23, 0.24, 0.005), vec(-0.721, -0.772, 0.81)), box(vec(0.0247605, 0.073, 0.03625), vec(-0.42677133002999, -0.76596851247747, 0.80746731400091)));
  plate.bodies[1].pose.matrix = Eigen::Matrix3d{{0.10758262492982967, -0.662488185001523, -0.7413065381787722},
                                                {0.2268218488512493, -0.7096140407752535, 0.6670830248314807},
                                                {-0.967976150376087, -0.23991106241272975, 0.07392465377048896}};
  Scene can = pair(cube(vec(0, 0, 0), 0.5), {"", {Cylinder{0.25, 0.125, 2}, 0}, identity_pose(3)});
  can.bodies[1].pose.position = vec(0.2, 0, 0);
  family.cases = {{388, pair(sphere(0.06, vec(1.7855e-10, 0.04, 0.33)), cube(vec(0.05, 0.15, 0.35), 0.05)), (0.15 - 0.05 - 0.04) - 0.06},
                  {395, plate, -0.01340861377399064},
                  {395.5, can, -0.55},
                  {398, pair(box(vec(0.307, 1.5, 0.185), vec(-0.675, 0, 0.9115)), box(vec(0.247, 0.276, 0.005), vec(-0.692, 0, 0.935))), (0.935 - 0.9115) - (0.185 + 0.005)},
                  {428, pair(box(vec(0.1, 0.165, 0.05), vec(-0.071, -0.772, 0.8)), box(vec(0.226, 0.135, 0.3), vec(0.121, -0.787696056927277, 0.5342204419612515))),
                   (0.8 - 0.5342204419612515) - (0.05 + 0.3)}};
  return family;
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
  out.push_back(ratio), out.push_back(far), out.push_back(size), out.push_back(pierced(quick)), out.push_back(replayed());
}

/// Turned cubes. The first two have edges of length 2 at height 1.4 (0.6 + 0.8), across one another; the next two share their axes.
void turned(std::vector<AtlasFamily>& out, bool quick) {
  AtlasFamily edges{"K5", "cubes on their edges, crossed: one axis of 22 is right", {}};
  for (const double g : gaps(quick)) {
    const double c = 2.8 + g;
    Scene scene = pair(cube(vec(0, 0, 0)), cube(vec(0, 0, c)));
    scene.bodies[0].pose.matrix = rotation(2, 0, 1, 0), scene.bodies[1].pose.matrix = rotation(2, 1, 0, 0);
    edges.cases.push_back({g, scene, static_cast<double>(c - 2.8L)});
  }
  AtlasFamily tilted{"K6", "tilted cubes kiss: a face in no coordinate plane, and sizes from small to large", {}};
  for (const double size : {0.01, 0.25, 0.5, 10.0, 1000.0})
    for (const double d : {0.0, 1e-15, -1e-15, 1e-9, -1e-9}) {
      const AnyMatrix turn = rotation(1, 2, 3, 4);
      const double apart = size + d * std::max(1.0, size);
      Scene scene = pair(cube(vec(0, 0, 0), size / 2), cube(turn * vec(0, 0, apart), size / 2));
      scene.bodies[0].pose.matrix = scene.bodies[1].pose.matrix = turn;
      long double along = 0;
      for (int i = 0; i < 3; ++i) along += static_cast<long double>(turn(i, 2)) * static_cast<long double>(scene.bodies[1].pose.position[i]);
      tilted.cases.push_back({size, scene, static_cast<double>(along - static_cast<long double>(size))});
    }
  AtlasFamily thin{"K7", "thin plates graze, turned in their plane: the gap is below the usual tolerance of 1e-6", {}};
  for (const double t : powers(1e-1, 1e-6, quick))
    for (const double g : {7.6932723539930488e-07, -7.6932723539930488e-07}) {
      const double apart = 2 * t + g;  // the gap, or less, of MuJoCo's thin boxes; the difference below is exact
      Scene scene = pair(box(vec(0.25, 0.25, t), vec(0, 0, 0)), box(vec(0.25, 0.25, t), vec(0.01, -0.02, apart)));
      scene.bodies[1].pose.matrix = rotation(3, 0, 0, 1);
      thin.cases.push_back({t, scene, apart - 2 * t});
    }
  out.push_back(edges), out.push_back(tilted), out.push_back(thin);
}

void centred(std::vector<AtlasFamily>& out, bool quick) {
  AtlasFamily boxes{"C2", "boxes with one centre, and nearly: two normals tie", {}};
  boxes.cases.push_back({0, pair(box(vec(1, 1, 1), vec(0, 0, 0)), box(vec(0.6, 0.8, 1), vec(0, 0, 0))), -1.6});
  for (const double d : powers(1e-15, 1e-1, quick)) boxes.cases.push_back({d, pair(box(vec(1, 1, 1), vec(0, 0, 0)), box(vec(0.6, 0.8, 1), vec(d, 0, 0))), d - 1.6});
  AtlasFamily ball{"C4", "a ball's centre in, on and at the corner of a cube: the core is a point on the border", {}};
  for (const double z : {0.0, 0.5, 1 - 1e-9, 1.0, 1 + 1e-9}) ball.cases.push_back({z, pair(cube(vec(0, 0, 0)), sphere(0.5, vec(0, 0, z))), (z - 1) - 0.5});
  ball.cases.push_back({3, pair(cube(vec(0, 0, 0)), sphere(0.5, vec(1, 1, 1))), -0.5});
  out.push_back(boxes), out.push_back(ball);
}

/// Convex bodies with a flat fan of many triangles: a prism of n sides, with the middles of its end faces, and every third vertex twice.
void fans(std::vector<AtlasFamily>& out, bool quick) {
  AtlasFamily fan{"S3", "prisms of many sides: flat fans, coplanar and double vertices", {}};
  for (const int n : quick ? std::vector<int>{8, 64} : std::vector<int>{8, 32, 128, 512, 4096}) {
    std::vector<AnyVector> prism{vec(0, 0, 1), vec(0, 0, -1)};
    for (int i = 0; i < n; ++i)
      for (const double z : {-1.0, 1.0})
        for (int twice = 0; twice <= (i % 3 == 0); ++twice) prism.push_back(vec(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), z));
    fan.cases.push_back({static_cast<double>(n), pair(points(prism), points(prism, vec(0, 0, 2.5))), 0.5});
    if (n <= 512) fan.cases.push_back({-static_cast<double>(n), pair(points(prism), points(prism, vec(0, 0, 1.9))), 1.9 - 2});
  }
  out.push_back(fan);
}

/// An ellipsoid and another, put where their tangent planes across a direction are a gap apart, touching along it: strictly convex bodies are nearest
/// there. With M = diag(radii) and R the rotation the farthest point along n is R M M R^T n / |M R^T n|.
Scene facing_ellipsoids(const AnyVector& radii_a, const AnyVector& radii_b, const AnyMatrix& turn, double gap) {
  const Eigen::Vector3d n = Eigen::Vector3d(1, 2, 3).normalized();
  const auto farthest = [&](const AnyVector& radii, const Eigen::Matrix3d& r) {
    const Eigen::Vector3d m = radii, local = m.cwiseProduct(r.transpose() * n);
    return Eigen::Vector3d(r * m.cwiseProduct(local) / local.norm());
  };
  Scene scene = pair(ellipsoid(radii_a, vec(0, 0, 0)), ellipsoid(radii_b, farthest(radii_a, Eigen::Matrix3d::Identity()) + gap * n + farthest(radii_b, turn)));
  scene.bodies[1].pose.matrix = turn;
  return scene;
}

void ellipsoids(std::vector<AtlasFamily>& out, bool quick) {
  AtlasFamily ladder{"A1", "ellipsoids, longer and longer, near and slightly overlapping: every step gains less", {}};
  for (const double aspect : {1.0, 3.0, 10.0, 30.0, 100.0})
    for (const double d : powers(1e-1, 1e-8, quick))
      for (const double gap : {d, -d / 100}) ladder.cases.push_back({aspect, facing_ellipsoids(vec(0.5, 0.5 * aspect, 0.7), vec(0.4 * aspect, 0.6, 0.5), rotation(2, 1, 3, 1), gap), gap});
  AtlasFamily slow{"A2", "small ellipsoids of one shape that barely overlap: slow to converge", {}};
  for (const double d : powers(1e-3, 1e-9, quick)) slow.cases.push_back({d, facing_ellipsoids(vec(0.05, 0.07, 0.15), vec(0.05, 0.07, 0.15), rotation(3, 1, 2, 1), -d), -d});
  out.push_back(ladder), out.push_back(slow);
}

/// The same pair of hulls told in other ways: the other one first, its vertices backwards and twice, all of it elsewhere, turned by a quarter.
void retold(std::vector<AtlasFamily>& out, bool) {
  AtlasFamily family{"P1", "one pair told in eight ways: the answer must not depend on the order, the place or the axes", {}};
  std::vector<AnyVector> corners, roof{vec(-1, -1, 0), vec(1, -1, 0), vec(1, 1, 0), vec(-1, 1, 0), vec(0, 0, 2)};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0}) corners.push_back(vec(x, y, z));
  for (const double z : {1.25, 0.75})  // a gap and an overlap of a quarter, face against face
    for (int way = 0; way < 8; ++way) {
      std::vector<AnyVector> a = corners, b = roof;
      if (way & 1) std::reverse(a.begin(), a.end()), std::reverse(b.begin(), b.end()), a.insert(a.end(), corners.begin(), corners.end());
      Scene scene = pair(points(a), points(b, vec(0.25, 0.125, z)));
      if (way & 2) std::swap(scene.bodies[0], scene.bodies[1]);
      if (way & 4) {
        const AnyMatrix quarter = Eigen::Matrix3d{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
        for (Body& body : scene.bodies) body.pose.position = AnyVector(quarter * body.pose.position + vec(1024, -512, 256)), body.pose.matrix = quarter;
      }
      family.cases.push_back({static_cast<double>(way), scene, z - 1});
    }
  out.push_back(family);
}

}  // namespace

std::vector<AtlasFamily> atlas_families(bool quick, const std::vector<std::string>& names) {
  std::vector<AtlasFamily> families;
  kisses(families, quick);
  overlaps(families, quick);
  degenerate(families, quick);
  scales(families, quick);
  turned(families, quick);
  centred(families, quick);
  fans(families, quick);
  ellipsoids(families, quick);
  retold(families, quick);
  for (AtlasFamily& family : moving_families(quick)) families.push_back(std::move(family));
  std::stable_sort(families.begin(), families.end(), [](const AtlasFamily& a, const AtlasFamily& b) { return a.name < b.name; });
  if (names.empty()) return families;
  std::string all;
  for (const AtlasFamily& family : families) all += (all.empty() ? "" : ", ") + family.name;
  for (const std::string& name : names)
    if (std::none_of(families.begin(), families.end(), [&](const AtlasFamily& family) { return family.name == name; })) throw Error("no-such-family", "no family has this name; there are " + all, name);
  std::erase_if(families, [&](const AtlasFamily& family) { return std::find(names.begin(), names.end(), family.name) == names.end(); });
  return families;
}

}  // namespace gjkdbg
