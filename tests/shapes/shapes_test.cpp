// Support mappings, poses, hulls.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <span>
#include <utility>

#include "shapes/convex.h"
#include "shapes/convex_hull.h"
#include "shapes/error.h"
#include "shapes/obj_file.h"
#include "shapes/pose.h"
#include "shapes/table_memory.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

using V3 = Eigen::Vector3d;

V3 support(const Shape& shape, const V3& d) {
  const Convex<3, double> convex(shape);
  V3 p = convex.reference() + convex.support(d);
  if (convex.radius() > 0) p += convex.radius() * d.normalized();
  return p;
}

/// Points of a solid of revolution's or box's surface, by its definition.
std::vector<V3> samples(const Shape& shape, RandomScenes& random) {
  std::vector<V3> out;
  for (int i = 0; i < 400; ++i) {
    const double t = random.uniform(0, 6.3), u = random.uniform(-1, 1), r = std::sqrt(random.uniform(0, 1));
    if (const auto* c = std::get_if<Cylinder>(&shape.geometry)) out.emplace_back(r * c->radius * std::cos(t), u * c->half_height, r * c->radius * std::sin(t));
    if (const auto* c = std::get_if<Cone>(&shape.geometry)) {
      const double at = (1 - u) / 2 * c->radius * r;
      out.emplace_back(at * std::cos(t), u * c->half_height, at * std::sin(t));
    }
    if (const auto* s = std::get_if<Sphere>(&shape.geometry)) out.push_back(s->radius * V3(std::cos(t) * std::sqrt(1 - u * u), u, std::sin(t) * std::sqrt(1 - u * u)));
    if (const auto* e = std::get_if<Ellipsoid>(&shape.geometry)) out.push_back(V3(e->radii).cwiseProduct(V3(std::cos(t) * std::sqrt(1 - u * u), u, std::sin(t) * std::sqrt(1 - u * u))));
    if (const auto* b = std::get_if<Box>(&shape.geometry)) out.push_back(V3(b->max).cwiseProduct(V3(u, random.uniform(-1, 1), random.uniform(-1, 1))));
  }
  return out;
}

AnyVector any(const V3& v) { return v; }

TEST(Support, IsFartherThanAnyPointOfTheShape) {
  RandomScenes random(1);
  const V3 half(0.5, 1, 0.25);
  for (const Shape& shape : {Shape{Sphere{2}, 0}, Shape{Box{any(-half), any(half), true}, 0}, Shape{Cylinder{0.5, 2, 1}, 0}, Shape{Cone{0.5, 2, 1}, 0},
                             Shape{Cone{3, 0.1, 1}, 0}, Shape{Ellipsoid{any(V3(1, 2, 0.1))}, 0}}) {
    const auto points = samples(shape, random);
    for (int i = 0; i < 200; ++i) {
      const V3 d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const double height = d.dot(support(shape, d));
      for (const V3& p : points) EXPECT_LE(d.dot(p), height + 1e-12);
    }
  }
}

/// Against differences of supports; a core that has none does not move.
template <int D>
void expect_derivative(const Shape& shape, RandomScenes& random) {
  const Convex<D, double> convex(shape);
  const auto vector = [&] {
    Vector<D, double> v;
    for (double& x : v) x = random.uniform(-1, 1);
    return v;
  };
  for (int i = 0; i < 50; ++i) {
    const Matrix<D, double> axes = random.rotation(D, Family::general);
    const Vector<D, double> d = vector(), change = vector();
    const auto support = [&](const Vector<D, double>& x) { return Vector<D, double>(axes * convex.support(axes.transpose() * x)); };
    SupportDerivative<D, double> derivative;
    convex.add_support_derivative(axes, d, support(d), derivative);
    constexpr double h = 1e-6;
    const Vector<D, double> before = support(d - h * change), after = support(d + h * change), expected = (after - before) / (2 * h);
    if ((after - before).norm() > 1e-2) continue;  // a jump lies between
    EXPECT_LE((derivative * change - expected).norm(), 1e-5 * (1 + expected.norm() / d.norm())) << i;
    EXPECT_LE((derivative * d).norm(), 1e-12);
  }
}

TEST(Support, MovesByItsDerivative) {
  RandomScenes random(3);
  const auto shared = [](const Shape& shape) { return std::make_shared<const Shape>(shape); };
  const V3 half(0.5, 1, 0.25);
  const Shape ellipsoid{Ellipsoid{any(V3(1, 2, 0.5))}, 0}, cylinder{Cylinder{0.5, 2, 1}, 0};
  for (const Shape& shape : {ellipsoid, cylinder, Shape{Cone{0.5, 2, 2}, 0}, Shape{Cone{3, 0.5, 0}, 0}, Shape{Sphere{2}, 0}, Shape{Box{any(-half), any(half), true}, 0},
                             Shape{Sum{shared(ellipsoid), shared(cylinder)}, 0}})
    expect_derivative<3>(shape, random);
  expect_derivative<2>({Ellipsoid{AnyVector(Eigen::Vector2d(1, 3))}, 0}, random);
}

TEST(Support, IsExactOnTheAxis) {
  EXPECT_EQ(support({Cylinder{0.5, 2, 1}, 0}, V3(0, 1, 0))[1], 2);
  EXPECT_EQ(support({Cylinder{0.5, 2, 1}, 0}, V3(0, -1e-300, 0))[1], -2);
  EXPECT_EQ(support({Cone{0.5, 2, 1}, 0}, V3(0, 1, 0)), V3(0, 2, 0));
  EXPECT_EQ(support({Cone{0.5, 2, 1}, 0}, V3(0, -1, 0))[1], -2);
  EXPECT_EQ(support({Ellipsoid{any(V3(1, 2, 3))}, 0}, V3(0, 0, -5)), V3(0, 0, -3));
}

/// Along the axis but for what rounding left: in single precision the squares of that vanish, or lose digits, and the point lay up to the radius beside the rim.
TEST(Support, LiesOnTheRimHoweverLittleLeadsThere) {
  const auto off_the_rim = []<class S>(const Shape& shape, const Vector<3, S>& d) {
    const Vector<3, S> p = Convex<3, S>(shape).support(d);
    return std::abs(static_cast<double>(std::hypot(p[0], p[2])) - 0.5);
  };
  for (const Shape& shape : {Shape{Cylinder{0.5, 1, 1}, 0}, Shape{Cone{0.5, 1, 1}, 0}})
    for (double little = 1; little > 1e-37; little /= 7) {
      EXPECT_LT(off_the_rim(shape, Vector<3, float>(static_cast<float>(little), -2e-6F, static_cast<float>(little / 3))), 1e-6) << little;
      EXPECT_LT(off_the_rim(shape, Vector<3, double>(std::pow(little, 7), -2e-6, 0)), 1e-15) << little;
    }
}

TEST(Support, OfAZeroDirectionIsAPointOfTheShape) {
  const V3 half(1, 1, 1);
  for (const Shape& shape : {Shape{Box{any(-half), any(half), true}, 0}, Shape{Cylinder{1, 1, 1}, 0}, Shape{Cone{1, 1, 1}, 0}, Shape{Ellipsoid{any(half)}, 0}}) {
    const Convex<3, double> convex(shape);
    const V3 p = convex.support(V3::Zero());
    EXPECT_TRUE(p.allFinite());
    EXPECT_LE(p.cwiseAbs().maxCoeff(), 1);
  }
}

/// Against a scan of all points, also along directions in which several are as high, and for hulls as thin as the last bits allow.
void expect_supports_of_a_scan(const std::vector<V3>& points, RandomScenes& random) {
  PointSet set;
  double size = 0;
  for (const V3& p : points) set.points.push_back(any(p)), size = std::max(size, p.norm());
  const Convex<3, double> convex(Shape{set, 0});
  for (int i = 0; i < 500; ++i) {
    V3 d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (i % 5 == 0) d = (points[static_cast<std::size_t>(i) % points.size()] - points[0]).cross(points[static_cast<std::size_t>(i / 5) % points.size()] - points[0]);
    if (i % 7 == 0) d[i % 3] = 0;
    if (i % 11 == 0) d = V3::Unit(i % 3) * (i % 2 == 0 ? 1 : -1);
    double most = -std::numeric_limits<double>::infinity();
    for (const V3& p : points) most = std::max(most, d.dot(p));
    ASSERT_NEAR(d.dot(convex.reference() + convex.support(d)), most, 1e-14 * size * d.norm()) << d.transpose();
  }
}

/// No answer may depend on the processor: whole numbers make many vertices as high as one another.
TEST(Support, AScanOfAllFoursTakesTheVertexThatFourByFourIsTaken) {
  RandomScenes random(6);
  const auto whole = [&](double most) { return std::round(random.uniform(-most, most)); };
  for (const int count : {1, 4, 9, 12, 33, 149})
    for (int run = 0; run < 200; ++run) {
      VertexFours<3, double> vertices;
      std::vector<V3> list;
      for (int i = 0; i < count; ++i) list.push_back(V3{whole(3), whole(3), whole(3)}), vertices.push_back(list.back());
      const V3 d{whole(2), whole(2), run % 3 == 0 ? random.uniform(-1, 1) : whole(2)}, highest = vertices.highest(d);
      EXPECT_EQ(highest, vertices.highest_anywhere(d));
      const auto height = [&](const V3& v) { return v[0] * d[0] + v[1] * d[1] + v[2] * d[2]; };  // rounds as the scan does
      for (const V3& v : list) EXPECT_LE(height(v), height(highest));
    }
}

TEST(Support, TheTableOfAHullFindsWhatAScanFinds) {
  RandomScenes random(2);
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.7, V3(1, 2, 3).normalized()).toRotationMatrix();
  for (const int count : {table_from, 30, 100, 500}) {
    std::vector<V3> round, rings;
    for (int i = 0; i < count * 2; ++i) round.push_back(V3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized() * random.uniform(0.97, 1));
    for (int i = 0; i < count; ++i) rings.push_back(V3(std::cos(6.28 * i / count), std::sin(6.28 * i / count), i % 2 == 0 ? 1 : -1));
    for (const std::vector<V3>& points : {round, rings})
      for (const V3& stretch : {V3(1, 1, 1), V3(1, 1, 1e-6), V3(1e-6, 1, 1e-3), V3(1, 1e-4, 1e-4)})
        for (const Eigen::Matrix3d& rotation : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turned})
          for (const V3& place : {V3(0, 0, 0), V3(1000, 0, -3)}) {
            std::vector<V3> placed;
            for (const V3& p : points) placed.push_back(rotation * p.cwiseProduct(stretch) + place);
            SCOPED_TRACE(std::to_string(points.size()) + " points stretched by " + std::to_string(stretch[0]) + " " + std::to_string(stretch[1]) + " " + std::to_string(stretch[2]));
            expect_supports_of_a_scan(placed, random);
            if (testing::Test::HasFailure()) return;
          }
  }
}

/// A disc that is flat in float: every vertex of the rim is a candidate along its axis, and along no other direction.
TEST(Support, ADiscWithoutThicknessInFloat) {
  std::vector<AnyVector> points;
  for (int i = 0; i < 400; ++i) points.push_back(any(V3(std::cos(6.28 * i / 400), std::sin(6.28 * i / 400), i % 2 == 0 ? 1e-11 : -1e-11)));
  std::vector<Eigen::Vector3f> vertices;
  const ConvexHull hull = convex_hull(points, 3);
  for (const int i : hull.vertices) vertices.push_back(Eigen::Vector3d(points[static_cast<std::size_t>(i)][0], points[static_cast<std::size_t>(i)][1], 0).cast<float>());
  ASSERT_EQ(hull.rank, 3);
  const HullCore<float> core(vertices, hull);
  EXPECT_LT(core.candidates(), 40 * vertices.size());
  RandomScenes random(5);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f d = Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).cast<float>();
    float most = -10;
    for (const auto& v : vertices) most = std::max(most, d.dot(v));
    EXPECT_NEAR(d.dot(core.support(d)), most, 1e-6f);
  }
}

/// Points of a grid within a ball: of some of their faces, across which a cell of the table looks, rounding finds each corner higher than the one before, all the
/// way round. Whoever climbs as long as there is a higher one never comes back.
TEST(Support, TheTableOfAHullWithCornersHigherThanOneAnother) {
  PointSet grid{PointSetKind::hull, {}, {}};
  constexpr double spacing = 0.046928760239587371;
  for (int x = -9; x <= 9; ++x)
    for (int y = -9; y <= 9; ++y)
      for (int z = -9; z <= 9; ++z)
        if (x * x + y * y + z * z <= 85) grid.points.push_back(any(spacing * V3(x, y, z)));
  const Convex<3, float> hull(Shape{grid, 0});
  ASSERT_TRUE(std::holds_alternative<HullCore<float>>(hull.core()));
  EXPECT_FLOAT_EQ(hull.support(Eigen::Vector3f(1, 0, 0))[0], static_cast<float>(9 * spacing));
}

/// Of the smallest lengths, too, whose areas' squares are no numbers.
TEST(Hull, IsTheSameAtEveryScale) {
  RandomScenes random(17);
  for (int k = 0; k < 50; ++k) {
    std::vector<AnyVector> points;
    for (int i = 0; i < 12; ++i) points.push_back(any(V3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1) * (k % 5 == 0 ? 1e-9 : 1))));
    const ConvexHull hull = convex_hull(points, 3);
    for (const int power : {-900, -540, -270, 300, 900}) {
      std::vector<AnyVector> scaled = points;
      for (AnyVector& p : scaled) p *= std::ldexp(1.0, power);
      const ConvexHull same = convex_hull(scaled, 3);
      EXPECT_EQ(same.vertices, hull.vertices) << power;
      EXPECT_EQ(same.faces, hull.faces) << power;
      EXPECT_EQ(same.rank, hull.rank) << power;
    }
  }
}

TEST(Hull, KeepsExtremeVerticesOnly) {
  std::vector<AnyVector> points;
  for (int i = 0; i < 8; ++i) points.push_back(any(V3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  points.push_back(any(V3(0, 0, 0)));
  points.push_back(any(V3(1, 0, 0)));
  points.push_back(any(V3(1, 1, 0)));
  points.push_back(points[0]);
  const ConvexHull hull = convex_hull(points, 3);
  EXPECT_EQ(hull.rank, 3);
  EXPECT_EQ(hull.vertices, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(hull.faces.size(), 6u);
  EXPECT_EQ(hull.edges.size(), 12u);
}

TEST(Hull, OfFlatCollinearAndSinglePoints) {
  const std::vector<AnyVector> square{any(V3(0, 0, 5)), any(V3(1, 0, 5)), any(V3(1, 1, 5)), any(V3(0, 1, 5)), any(V3(0.5, 0.5, 5))};
  EXPECT_EQ(convex_hull(square, 3).rank, 2);
  EXPECT_EQ(convex_hull(square, 3).vertices.size(), 4u);
  const std::vector<AnyVector> line{any(V3(0, 0, 0)), any(V3(1, 1, 1)), any(V3(0.25, 0.25, 0.25))};
  EXPECT_EQ(convex_hull(line, 3).rank, 1);
  EXPECT_EQ(convex_hull(line, 3).vertices, (std::vector<int>{0, 1}));
  const std::vector<AnyVector> point{any(V3(1, 2, 3)), any(V3(1, 2, 3))};
  EXPECT_EQ(convex_hull(point, 3).rank, 0);
  EXPECT_EQ(convex_hull(point, 3).vertices.size(), 1u);
}

TEST(Pose, AllNotationsDescribeTheSameTurn) {
  const double pi = std::numbers::pi;
  const AnyMatrix m = resolve(AxisAngle{any(V3(1, 2, -0.5)), 0.7}, 3).matrix;
  EXPECT_LE((resolve(to_quaternion(m), 3).matrix - m).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LE((resolve(to_axis_angle(m), 3).matrix - m).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LE((resolve(RotationMatrix{m}, 3).matrix - m).cwiseAbs().maxCoeff(), 1e-15);
  for (const char* order : {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"})
    for (const bool intrinsic : {true, false})
      EXPECT_LE((resolve(to_euler(m, order, intrinsic), 3).matrix - m).cwiseAbs().maxCoeff(), 4e-15) << order << intrinsic;
  // Intrinsic turns about x then y are extrinsic turns about y then x.
  EXPECT_LE((resolve(Euler{"xyz", true, {0.1, 0.2, 0.3}}, 3).matrix - resolve(Euler{"zyx", false, {0.3, 0.2, 0.1}}, 3).matrix).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(resolve(AxisAngle{any(V3(0, 0, 2)), pi / 2}, 3).matrix * any(V3(1, 0, 0)), any(V3(0, 1, 0)));
  EXPECT_EQ(resolve(PlaneAngle{pi}, 2).matrix(0, 0), -1);
  EXPECT_EQ(resolve(PlaneAngle{pi}, 2).matrix(1, 0), 0);
}

TEST(Pose, RefusesWhatIsNoRotation) {
  const auto code = [](const Rotation& r) -> std::string {
    try {
      resolve(r, 3);
    } catch (const Error& e) {
      return e.code();
    }
    return "accepted";
  };
  EXPECT_EQ(code(Quaternion{{1, 0, 0, 0.01}}), "not-a-rotation");
  EXPECT_EQ(code(Quaternion{{0, 0, 0, 0}}), "not-a-rotation");
  EXPECT_EQ(code(Quaternion{{1, 0, 0, 1e-7}}), "accepted");
  AnyMatrix mirror = AnyMatrix::Identity(3, 3);
  mirror(2, 2) = -1;
  EXPECT_EQ(code(RotationMatrix{mirror}), "not-a-rotation");
  EXPECT_EQ(code(AxisAngle{any(V3(0, 0, 0)), 1}), "not-a-rotation");
}

/// What is read of an OBJ file, or where and why it is refused.
std::string obj(const std::string& text) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("gjkdbg-shapes-test-" + std::to_string(getpid()) + ".obj");
  std::ofstream(file, std::ios::binary) << text;
  std::string out;
  try {
    const ObjMesh mesh = read_obj(file);
    out = std::to_string(mesh.points.size()) + " points, " + std::to_string(mesh.triangles.size()) + " triangles";
  } catch (const Error& e) {
    const std::size_t line = e.where().find(": line ");
    out = (line == std::string::npos ? "whole file" : e.where().substr(line + 2)) + " " + e.code();
  }
  std::filesystem::remove(file);
  return out;
}

TEST(TableMemory, IsAlignedApartAndTakenAgain) {
  std::vector<std::pair<std::span<unsigned char>, unsigned char>> taken;
  for (std::size_t i = 0; i < 300; ++i) {
    const std::size_t bytes = 1 + (i * 7919) % 100000;
    auto* const memory = static_cast<unsigned char*>(take_table_memory(bytes));
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(memory) % 128, 0u);
    taken.push_back({{memory, bytes}, static_cast<unsigned char>(i)});
    std::ranges::fill(taken.back().first, taken.back().second);
  }
  for (const auto& [memory, value] : taken) ASSERT_EQ(std::ranges::count(memory, value), std::ssize(memory)) << "shared with another";
  for (const auto& [memory, value] : taken) give_table_memory_back(memory.data(), memory.size());
  void* const again = take_table_memory(taken.back().first.size());
  EXPECT_EQ(again, taken.back().first.data());
  give_table_memory_back(again, taken.back().first.size());
  std::vector<int, TableAllocator<int>> list(1000, 3);
  const auto copy = list;
  EXPECT_EQ(list, copy);
}

TEST(Obj, IsReadOrRefusedWithItsLine) {
  const std::string corners = "# four\r\nv 0 0 0\r\nv 1 0 0 1\nv 0 1 0 0.5 0.5 0.5\n\nv 0 0 1e60\n";
  EXPECT_EQ(obj(corners), "4 points, 0 triangles");
  EXPECT_EQ(obj(corners + "mtllib a.mtl\no tetra\ng a b\nusemtl c\ns off\nvt 0 0\nvn 0 0 1\nf 1 2 3\nf 1/1 2/1 3/1 4/1\nf 1//1 2//1 -1//1\nf -4/1/1 -3/1/1 -1/1/1\nl 1 2\n"), "4 points, 5 triangles");
  EXPECT_EQ(obj("f 1 2 3\n" + corners), "4 points, 1 triangles");
  EXPECT_EQ(obj(corners + "f 1.5 2 3\n"), "line 7 bad-mesh");
  EXPECT_EQ(obj(corners + "f 1 2\n"), "line 7 bad-mesh");
  EXPECT_EQ(obj(corners + "f 1 2 3 # comments may stand anywhere\n"), "4 points, 1 triangles");
  EXPECT_EQ(obj(corners + "f 1 2 # 3\n"), "line 7 bad-mesh");
  EXPECT_EQ(obj(corners + "f 1 2 \\\n 4\nf 1 2 3\n"), "4 points, 2 triangles") << "a statement may go on in the next line";
  EXPECT_EQ(obj(corners + "f 1 2 \\\n 4\nf 1 2\n"), "line 9 bad-mesh");
  EXPECT_EQ(obj("\xEF\xBB\xBF" + corners), "4 points, 0 triangles") << "a byte order mark";
  EXPECT_EQ(obj("\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0\n"), "line 4 bad-mesh");
  EXPECT_EQ(obj(corners + "f 1 2 x\n"), "line 7 bad-mesh");
  EXPECT_EQ(obj(corners + "f 1 2 99999999999\n"), "line 7 bad-mesh");
  EXPECT_EQ(obj(corners + "\nf 1 2 5\n"), "line 8 wrong-index");
  EXPECT_EQ(obj(corners + "f 0 1 2\n"), "line 7 wrong-index");
  EXPECT_EQ(obj(corners + "f 1 2 -5\n"), "line 7 wrong-index");
  EXPECT_EQ(obj(corners + "v 0 0 1e61\n"), "line 7 too-large");
  EXPECT_EQ(obj(corners + "v 0 0 1e999\n"), "line 7 non-finite");
  EXPECT_EQ(obj(corners + "v 0 0\n"), "line 7 bad-mesh");
  EXPECT_EQ(obj(corners + "this is no mesh\n"), "line 7 bad-mesh");
  EXPECT_EQ(obj(""), "whole file no-points");
}

}  // namespace
}  // namespace gjkdbg
