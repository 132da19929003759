#include "algo/polytope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

using V3 = Vector<3, double>;

template <int D>
SupportPoint<D, double> point(const Vector<D, double>& w) {
  SupportPoint<D, double> p;
  p.w = w;
  return p;
}

template <int D>
Vector<D, double> random_direction(RandomScenes& random) {
  Vector<D, double> d;
  for (int i = 0; i < D; ++i) d[i] = random.uniform(-1, 1);
  return d.normalized();
}

/// Closed, convex, every neighbour the other's, and `nearest` a nearest one.
template <int D>
void expect_sound(Polytope<D, double>& polytope) {
  const auto faces = polytope.faces();
  double least = std::numeric_limits<double>::infinity();
  std::set<int> used;
  std::size_t standing = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& face = faces[f];
    if (face.removed) continue;
    ++standing;
    least = std::min(least, polytope.sharpened(static_cast<int>(f)).distance);
    used.insert(face.vertices.begin(), face.vertices.end());
    for (const auto& p : polytope.points()) ASSERT_LE(face.normal.dot(p.w) - face.distance, 1e-13);
    for (int i = 0; i < D; ++i) {
      const int other = D == 3 ? face.neighbours[i] / 4 : face.neighbours[i], edge = D == 3 ? face.neighbours[i] % 4 : 1 - i;
      const auto& beside = faces[static_cast<std::size_t>(other)];
      ASSERT_FALSE(beside.removed);
      ASSERT_EQ(beside.neighbours[static_cast<std::size_t>(edge)], static_cast<int>(f) * (D == 3 ? 4 : 1) + (D == 3 ? i : 0));
      if constexpr (D == 3) {
        ASSERT_EQ(beside.vertices[static_cast<std::size_t>((edge + 1) % 3)], face.vertices[static_cast<std::size_t>(i)]);
      }
    }
  }
  ASSERT_EQ(standing, D == 3 ? 2 * used.size() - 4 : used.size());  // Euler: no hole, no handle
  const int nearest = polytope.nearest();
  ASSERT_GE(nearest, 0);
  ASSERT_FALSE(faces[static_cast<std::size_t>(nearest)].removed);
  ASSERT_EQ(faces[static_cast<std::size_t>(nearest)].distance, least);
}

/// Rings of 3 to 9 points around one more, some with two that are as good as one: the planes are those of the faces one by one, to the bit.
TEST(Polytope, PlanesOfAFanAreThoseOfItsFaces) {
#ifdef GJKDBG_AVX2
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "needs AVX2";
  RandomScenes random(8);
  int thin = 0, rounded = 0, exact = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int n = 3 + trial % 7;
    std::vector<SupportPoint<3, double>> points(1, point<3>(random_direction<3>(random)));
    std::vector<int> ring;
    for (int k = 0; k < n; ++k) {
      points.push_back(point<3>(random_direction<3>(random)));
      if (k == 1 && trial % 3 == 0) points.back().w = points[1].w + 1e-9 * points.back().w;
      ring.push_back(k + 1);
    }
    for (int k = 0; k < 4; ++k) ring.push_back(1);
    for (const Turn turn : {Turn::around_outer, Turn::around_inner}) {
      std::vector<PolytopeFace<3, double>> faces(static_cast<std::size_t>(n));
      std::vector<double> nearness(static_cast<std::size_t>(n) + 4, 7);
      bool all = true;
      const double allowed = trial % 2 == 0 ? 1e-15 : 1e-13;
      const PlaneRounding<double> rounding{allowed * allowed, 1e-12};
      const bool said = set_fan_by_avx2({points.data(), ring.data(), n, 0, rounding}, turn, faces.data(), nearness.data());
      for (std::size_t k = 0; k < faces.size(); ++k) {
        const V3 &p = points[0].w, from = points[k + 1].w, to = points[(k + 1) % faces.size() + 1].w;
        PolytopeFace<3, double> one;
        double off = 0;
        const bool plain = turn == Turn::around_outer ? set_plane_plainly<double>(one, from - p, to - p, p, rounding, off) : set_plane_plainly<double>(one, to - p, from - p, p, rounding, off);
        all &= plain, thin += !plain, rounded += off > 0, exact += plain && off == 0;
        ASSERT_EQ(plain, std::isfinite(faces[k].distance));
        ASSERT_EQ(nearness[k], off - faces[k].distance);
        if (!plain) continue;
        ASSERT_EQ(faces[k].normal, one.normal);
        ASSERT_EQ(faces[k].distance, one.distance);
      }
      ASSERT_EQ(nearness.back(), 7) << "beyond its room";
      ASSERT_EQ(said, all);
    }
  }
  EXPECT_GT(thin, 500);
  EXPECT_GT(rounded, 500);
  EXPECT_GT(exact, 500);
#else
  GTEST_SKIP() << "needs AVX2";
#endif
}

/// Enough growths that storage moves and removed faces are forgotten, several times; twice, as a workspace is used.
template <int D>
void grow_from_random_points() {
  RandomScenes random(3);
  Polytope<D, double> polytope;
  for (int run = 0; run < 2; ++run) {
    polytope.clear(1e-15);
    std::array<int, D + 1> simplex;
    for (int& i : simplex) i = polytope.add_point(point<D>(random_direction<D>(random)));
    polytope.start(simplex);
    expect_sound(polytope);
    for (int i = 0; i < 300 && !testing::Test::HasFatalFailure(); ++i) {
      const Vector<D, double> w = random_direction<D>(random) * random.uniform(0.95, 1);
      const auto faces = polytope.faces();
      std::size_t seen = 0;
      while (seen < faces.size() && (faces[seen].removed || faces[seen].normal.dot(w) - faces[seen].distance <= 0)) ++seen;
      if (seen == faces.size()) continue;
      const std::size_t before = faces.size();
      ASSERT_TRUE(polytope.grow(polytope.add_point(point<D>(w)), static_cast<int>(seen)));
      const Growth& growth = polytope.growth();
      ASSERT_EQ(growth.first_added, before);
      ASSERT_EQ(before + static_cast<std::size_t>(growth.added), polytope.faces().size());
      ASSERT_LE(static_cast<std::size_t>(growth.added), D == 3 ? growth.removed.size() + 2 : 2);  // fewer where a vertex goes
      for (const int number : growth.removed) ASSERT_TRUE(polytope.faces()[static_cast<std::size_t>(number)].removed);
      expect_sound(polytope);
    }
  }
}

TEST(Polytope, GrowsFromRandomPointsInThePlane) { grow_from_random_points<2>(); }
TEST(Polytope, GrowsFromRandomPointsInSpace) { grow_from_random_points<3>(); }

using Solid = Polytope<3, double>;

/// Poles up and down the z axis, a ring around it.
bool start_octahedron(Solid& polytope, const V3& top, const V3& bottom, const std::array<V3, 4>& ring) {
  std::array<int, 4> numbers;
  std::transform(ring.begin(), ring.end(), numbers.begin(), [&](const V3& corner) { return polytope.add_point(point<3>(corner)); });
  return polytope.start_octahedron({polytope.add_point(point<3>(top)), polytope.add_point(point<3>(bottom))}, numbers, 1e-15);
}

TEST(Polytope, StartsFromAnOctahedron) {
  Solid polytope;
  RandomScenes random(5);
  int started = 0;
  for (int k = 0; k < 400 && !testing::Test::HasFatalFailure(); ++k) {
    const auto off = [&] { return V3(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4)); };
    polytope.clear(1e-15);
    if (!start_octahedron(polytope, V3(0, 0, 1) + off(), V3(0, 0, -1) + off(), {V3(1, 0, 0) + off(), V3(0, 1, 0) + off(), V3(-1, 0, 0) + off(), V3(0, -1, 0) + off()})) continue;
    ++started;
    expect_sound(polytope);
    const int above = polytope.face_below(polytope.add_point(point<3>(V3(1.5, 1.5, 1.5))), 1e-9);
    ASSERT_GE(above, 0);
    ASSERT_TRUE(polytope.grow(static_cast<int>(polytope.points().size()) - 1, above));
    expect_sound(polytope);
    EXPECT_EQ(polytope.face_below(polytope.add_point(point<3>(V3(0, 0, 0))), 1e-9), -1);
  }
  EXPECT_GT(started, 200);
  EXPECT_LT(started, 400);
}

TEST(Polytope, RefusesWhatIsNoOctahedronAroundTheOrigin) {
  const V3 up(0, 0, 1), down(0, 0, -1), x(1, 0, 0), y(0, 1, 0);
  const auto starts = [](const V3& top, const V3& bottom, const std::array<V3, 4>& ring) {
    Solid polytope;
    return start_octahedron(polytope, top, bottom, ring);
  };
  EXPECT_TRUE(starts(up, down, {x, y, -x, -y}));
  EXPECT_FALSE(starts(up, down, {x, -y, -x, y})) << "inside out";
  EXPECT_FALSE(starts(up, down, {x, x, -x, -y})) << "a corner twice";
  EXPECT_FALSE(starts(up, up, {x, y, -x, -y})) << "a pole twice";
  EXPECT_FALSE(starts(up, x, {x, y, -x, -y})) << "a pole in the ring";
  EXPECT_FALSE(starts(up, down, {V3(0.05, 0, 0), V3(0.3, 0.9, 0), -x, V3(0.3, -0.9, 0)})) << "dented at the first corner";
  EXPECT_FALSE(starts(up, V3(0, 0, 0.1), {x, y, -x, -y})) << "dented below, and the origin outside";
  EXPECT_FALSE(starts(up, down, {V3(3, 0, 0), V3(2, 1, 0), V3(1, 0, 0), V3(2, -1, 0)})) << "the origin outside";
  EXPECT_FALSE(starts(up, down, {V3(1, 0, 0), V3(0.5, 0.5, 0), V3(0, 1, 0), -x - y})) << "two faces in a plane";
}

void start(Solid& polytope, std::initializer_list<V3> corners) {
  std::array<int, 4> simplex;
  std::transform(corners.begin(), corners.end(), simplex.begin(), [&](const V3& corner) { return polytope.add_point(point<3>(corner)); });
  polytope.start(simplex);
}

bool grow(Solid& polytope, const V3& w, int seen) { return polytope.grow(polytope.add_point(point<3>(w)), seen); }

/// The first standing face that the condition holds for.
template <class Condition>
int face_with(const Solid& polytope, Condition condition) {
  for (std::size_t f = 0; f < polytope.faces().size(); ++f)
    if (!polytope.faces()[f].removed && condition(polytope.faces()[f])) return static_cast<int>(f);
  return -1;
}

/// Of every face: its neighbours, and whether it stands; at last, the nearest.
std::vector<int> state(Solid& polytope) {
  std::vector<int> all;
  for (const auto& face : polytope.faces()) all.insert(all.end(), face.neighbours.begin(), face.neighbours.end()), all.push_back(face.removed);
  all.push_back(polytope.nearest());
  return all;
}

/// A point in the plane of a flat polytope sees every face of it; one above sees half.
TEST(Polytope, AGrowthThatSeesEveryFaceChangesNone) {
  Solid polytope;
  start(polytope, {V3(0, 0, 1), V3(4, 0, 1), V3(0, 4, 1), V3(5, 5, 1)});
  const std::vector<int> before = state(polytope);
  EXPECT_FALSE(grow(polytope, V3(9, 2, 1), 0));
  EXPECT_EQ(state(polytope), before);
  EXPECT_TRUE(grow(polytope, V3(2, 2, 3), face_with(polytope, [](const auto& face) { return face.normal[2] > 0; })));
  EXPECT_EQ(polytope.growth().first_added, 4);
}

/// A pyramid, and a point above three of its sides that is said to see a half of its base too: the hole is pinched at a corner of it.
TEST(Polytope, AGrowthWithAPinchedHorizonChangesNothing) {
  Solid polytope;
  start(polytope, {V3(0, 0, 0), V3(1, 0, 0), V3(1, 1, 0), V3(0.5, 0.5, 1)});
  const auto below = [](const auto& face) { return face.normal[2] < -0.5; };
  ASSERT_TRUE(grow(polytope, V3(0, 1, 0), face_with(polytope, below)));
  const V3 w(0.2, 0.5, 1.5);
  const int wrong = face_with(polytope, [&](const auto& face) {
    return below(face) && std::count(face.vertices.begin(), face.vertices.end(), 0) == 0;  // not at the corner below w
  });
  ASSERT_GE(wrong, 0);
  const std::vector<int> before = state(polytope);
  EXPECT_FALSE(grow(polytope, w, wrong));
  EXPECT_GT(polytope.growth().added, 0);  // it was noticed late
  EXPECT_EQ(state(polytope), before);
  EXPECT_TRUE(grow(polytope, w, face_with(polytope, [&](const auto& face) { return face.normal.dot(w) > face.distance + 0.1; })));
  expect_sound(polytope);
}

template <class S>
void expect_greatest(const std::vector<S>& numbers) {
  GreatestOfFours<S> greatest;
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    Four<S> four;
    for (std::size_t k = 0; k < 4; ++k) four.set(k, numbers[i + k]);
    greatest.take(four);
  }
  const auto found = greatest.found();
  EXPECT_EQ(found.value, *std::max_element(numbers.begin(), numbers.end()));
  EXPECT_EQ(numbers[found.place], found.value);
}

TEST(Fours, TheGreatestIsFoundWhereverItIs) {
  RandomScenes random(4);
  for (const std::size_t count : {4u, 8u, 20u, 64u})
    for (int run = 0; run < 200; ++run) {
      std::vector<double> numbers;
      for (std::size_t i = 0; i < count; ++i) numbers.push_back(std::floor(random.uniform(-5, 5)));  // some are alike
      if (run % 3 == 0) numbers[static_cast<std::size_t>(run) % count] = -std::numeric_limits<double>::infinity();
      if (run % 5 == 0) numbers.assign(count, -std::numeric_limits<double>::infinity());
      if (run % 10 == 0) numbers[static_cast<std::size_t>(run / 10) % count] = -7;
      expect_greatest(numbers);
      expect_greatest(std::vector<float>(numbers.begin(), numbers.end()));
    }
}

}  // namespace
}  // namespace gjkdbg
