// Centre of mass and inertia of shapes that have no formula of their own, against shapes that have one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Eigenvalues>

#include "shapes/mass.h"

namespace gjkdbg {
namespace {

using Space = Eigen::Vector3d;

Shape sum_of(const Shape& a, const Shape& b) { return {Sum{std::make_shared<const Shape>(a), std::make_shared<const Shape>(b)}, 0}; }
Shape point_at(const AnyVector& p) { return {PointSet{PointSetKind::point, {p}, {}}, 0}; }
Shape segment_to(const AnyVector& p) { return {PointSet{PointSetKind::segment, {-p, p}, {}}, 0}; }

/// Every moment about an axis of the exact one, long or thin, is met by so much of itself.
void expect_mass(const Shape& shape, const MassProperties& exact, int dimension, double share) {
  const MassProperties m = mass_properties(shape, dimension);
  const double size = std::sqrt(exact.inertia.trace());
  EXPECT_LE((m.center - exact.center).norm(), share * size);
  if (dimension == 2) {
    EXPECT_NEAR(m.inertia(2, 2), exact.inertia(2, 2), share * exact.inertia(2, 2));
    return;
  }
  const auto second = [](const MassProperties& x) { return Matrix<3, double>(x.inertia.trace() / 2 * Matrix<3, double>::Identity() - x.inertia); };
  const Eigen::SelfAdjointEigenSolver<Matrix<3, double>> axes(second(exact));
  for (int i = 0; i < 3; ++i) {
    const Space axis = axes.eigenvectors().col(i);
    const double wide = axes.eigenvalues()[i];
    EXPECT_NEAR(axis.dot(second(m) * axis), wide, share * std::max(wide, 1e-7 * size * size)) << "along (" << axis.transpose() << ")";
  }
}

TEST(Mass, OfSumsWithAPointIsThatOfTheShape) {
  for (const double along : {1e-3, 0.05, 1.0, 3.0, 20.0, 1000.0}) {
    const Shape ellipsoid{Ellipsoid{Space(1, along, 1)}, 0}, cylinder{Cylinder{1, along, 1}, 0}, cone{Cone{1, along, 1}, 0}, box{Box{-Space(1, along, 2), Space(1, along, 2)}, 0};
    for (const Shape& shape : {ellipsoid, cylinder, cone, box}) {
      SCOPED_TRACE(std::to_string(shape.geometry.index()) + ", " + std::to_string(along));
      const Space aside(3, -2, 1);
      MassProperties exact = mass_properties(shape, 3);
      exact.center += aside;
      expect_mass(sum_of(shape, point_at(aside)), exact, 3, 2e-3);
      Shape rounded = shape;
      rounded.margin = 1e-9;
      expect_mass(rounded, mass_properties(shape, 3), 3, 2e-3);
    }
    const Shape ellipse{Ellipsoid{Eigen::Vector2d(1, along)}, 0};
    expect_mass(sum_of(ellipse, point_at(Eigen::Vector2d(0, 0))), mass_properties(ellipse, 2), 2, 2e-3);
  }
}

TEST(Mass, OfMarginsIsThatOfTheRoundedShape) {
  Shape ball = point_at(Space(1, 2, 3));
  ball.margin = 0.5;
  MassProperties exact = mass_properties({Sphere{0.5}, 0}, 3);
  exact.center = Space(1, 2, 3);
  expect_mass(ball, exact, 3, 1e-3);
  for (const double length : {0.3, 1.0, 10.0, 300.0}) {  // a capsule that lies askew
    SCOPED_TRACE(length);
    const Space along = length * Space(2, 3, 6) / 7;
    const Matrix<3, double> turned = Eigen::Quaterniond::FromTwoVectors(Space::UnitX(), along).toRotationMatrix();
    MassProperties capsule = mass_properties({Capsule{0.25, length, 0}, 0}, 3);
    capsule.inertia = turned * capsule.inertia * turned.transpose();
    Shape segment = segment_to(along);
    segment.margin = 0.25;
    expect_mass(segment, capsule, 3, 2e-3);
    expect_mass(sum_of(segment_to(along), {Sphere{0.25}, 0}), capsule, 3, 2e-3);
    Shape flat = segment_to(Eigen::Vector2d(length, 0));
    flat.margin = 0.25;
    expect_mass(flat, mass_properties({Capsule{0.25, length, 0}, 0}, 2), 2, 1e-3);
  }
}

/// An eighth of a cube of half a with a margin r: the cube's, three slabs, three quarters of a cylinder, and an eighth of a ball.
TEST(Mass, OfARoundedCube) {
  const double pi = std::acos(-1);
  for (const double a : {0.05, 0.5, 5.0}) {
    const double r = 0.5, aa = a * a, rr = r * r;
    const double volume = a * aa + 3 * aa * r + 3 * a * pi * rr / 4 + pi * rr * r / 6;
    const double cube = a * aa * aa / 3, slabs = aa * (std::pow(a + r, 3) - a * aa) / 3 + 2 * r * a * a * aa / 3;
    const double along = pi * rr / 4 * a * aa / 3, across = 2 * a * (aa * pi * rr / 4 + 2 * a * rr * r / 3 + pi * rr * rr / 16);
    const double ball = aa * pi * rr * r / 6 + a * pi * rr * rr / 8 + pi * rr * rr * r / 30;
    MassProperties exact;
    exact.inertia = Matrix<3, double>::Identity() * (2 * (cube + slabs + along + across + ball) / volume);
    expect_mass({Box{-Space(a, a, a), Space(a, a, a)}, r}, exact, 3, 2e-3);
  }
}

TEST(Mass, OfFlatSumsIsFlat) {
  const Shape plate = sum_of(segment_to(Space(1, 2, 0)), segment_to(Space(-2, 1, 0)));  // a square of side 2 sqrt 5
  MassProperties exact;
  exact.inertia.diagonal() << 20.0 / 12, 20.0 / 12, 40.0 / 12;
  expect_mass(plate, exact, 3, 1e-9);
  expect_mass(sum_of(segment_to(Space(1, 2, 0)), point_at(Space(0, 0, 0))), mass_properties(segment_to(Space(1, 2, 0)), 3), 3, 1e-9);
}

TEST(Mass, OfPointsAndOfWhatIsTooSmallForMoments) {
  const MassProperties twice = mass_properties(sum_of(point_at(Space(1, 2, 3)), point_at(Space(1, 0, 0))), 3);
  EXPECT_EQ(twice.center, Space(2, 2, 3));
  EXPECT_TRUE(twice.inertia.isZero(0));
  EXPECT_EQ(mass_properties(sum_of(point_at(Eigen::Vector2d(1, 2)), point_at(Eigen::Vector2d(1, 0))), 2).center, Space(2, 2, 0));
  for (const double size : {1e-300, 1e-200, 1e-100, 1e60}) {
    const MassProperties exact = mass_properties({Ellipsoid{size * Space(1, 2, 3)}, 0}, 3), m = mass_properties(sum_of({Ellipsoid{size * Space(1, 2, 3)}, 0}, point_at(Space(0, 0, 0))), 3);
    EXPECT_LE((m.inertia - exact.inertia).cwiseAbs().maxCoeff(), 2e-3 * exact.inertia.cwiseAbs().maxCoeff()) << size;
    EXPECT_LE(m.center.stableNorm(), 2e-3 * size) << size;
  }
}

TEST(Mass, OnALineIsTheMiddle) {
  const auto at = [](double x) { return Eigen::Matrix<double, 1, 1>(x); };
  const Shape interval{Box{at(2), at(6)}, 0}, points{PointSet{PointSetKind::segment, {at(-1), at(3)}, {}}, 0};
  EXPECT_EQ(mass_properties(interval, 1).center[0], 4);
  EXPECT_EQ(mass_properties(points, 1).center[0], 1);
  EXPECT_EQ(mass_properties(sum_of(interval, points), 1).center[0], 5);
}

}  // namespace
}  // namespace gjkdbg
