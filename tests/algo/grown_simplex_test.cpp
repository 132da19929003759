// What algo/grown_simplex.h tells of simplices that have grown, against twice the precision; and algo/vertices_pair.h against one body after the other.
#include "algo/grown_simplex.h"

#include <gtest/gtest.h>

#include <random>

#include "algo/gjk.h"
#include "algo/minkowski_difference.h"
#include "algo/signed_volumes.h"

namespace gjkdbg {
namespace {

using GrownPoints = std::array<SupportPoint<3, double>, 4>;

class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Eigen::Vector3d vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }

 private:
  std::mt19937 engine_;
};

/// A feature nearest the origin of one to three vertices, at places of its own, thin by `width`, and a vertex nearer along v.
struct Grown {
  GrownPoints points;
  unsigned old = 0;
  int newest = 0;

  Grown(RandomNumbers& random, int size, double width) {
    const Eigen::Vector3d out = Eigen::Vector3d(random.vector()).normalized(), along = Eigen::Vector3d(out.cross(random.vector())).normalized(), across = out.cross(along);
    const double distance = std::pow(10.0, random.uniform(-6, 0));
    const int first = static_cast<int>(random.uniform(0, 4));
    // Around the foot of the origin, so that all of them belong to the feature.
    const double turned = random.uniform(0, 6);
    for (int i = 0; i < size; ++i) {
      const double angle = turned + 2 * EIGEN_PI * i / size, reach = size == 1 ? 0 : random.uniform(0.1, 1);
      put((first + i) % 4, out * distance + along * (reach * std::cos(angle)) + across * (size == 2 ? 0 : width * reach * std::sin(angle)));
      old |= 1u << (first + i) % 4;
    }
    if (size == 2) {  // through the foot
      const int at = (first + 1) % 4;
      put(at, out * distance - along * random.uniform(0.1, 1)), put(first, out * distance + along * random.uniform(0.1, 1));
    }
    newest = (first + size) % 4;
    put(newest, out * (distance - std::pow(10.0, random.uniform(-5, 0.3))) + along * random.uniform(-1, 1) + across * (width * random.uniform(-1, 1)));
  }
  GrownSimplex<double>::Nearest nearest(ToldInLanes<double>& lanes) const {
    GrownSimplex<double>::Nearest nearest;
    const auto newest_w = Triple<double>::of(points[static_cast<std::size_t>(newest)].w);
    GrownSimplex<double>::find(points, old, newest, newest_w, lanes, [&](const auto& found) { return nearest = found, true; });
    return nearest;
  }
  void put(int place, const Eigen::Vector3d& w) { points[static_cast<std::size_t>(place)] = {w, w, Eigen::Vector3d::Zero(), place}; }
};

TEST(GrownSimplex, TellsThePointNearestTheOrigin) {
  RandomNumbers random(5);
  int told = 0, asked = 0, enclosing = 0;
  double worst = 0, worst_before = 0;
  for (int k = 0; k < 60000; ++k) {
    const int size = 1 + k % 3;
    const double width = k % 2 == 0 ? 1 : std::pow(10.0, random.uniform(-9, 0));
    const Grown grown(random, size, width);
    ToldInLanes<double> lanes;
    const auto found = grown.nearest(lanes);
    ++asked;
    if (found.places == 0) continue;
    ++told;
    std::array<Eigen::Vector3d, 4> w;
    int count = 0;
    double far = 0;
    for (int i = 0; i < 4; ++i)
      if ((grown.old >> i & 1) != 0 || i == grown.newest) w[static_cast<std::size_t>(count++)] = grown.points[static_cast<std::size_t>(i)].w, far = std::max(far, w[static_cast<std::size_t>(count - 1)].norm());
    const auto signed_volumes = SignedVolumes<3, double>::closest(w.data(), count);
    ASSERT_EQ(found.encloses(), signed_volumes.enclosed) << "simplex " << k;
    enclosing += found.encloses();
    const Eigen::Vector3d v = found.v.vector();
    if (!found.encloses()) {
      const auto wide = WideClosestPoint<3, double>::of_boundary(w.data(), count);
      EXPECT_NEAR(v.norm(), std::sqrt(wide.v_squared), 1e-12 * far) << "simplex " << k;  // a normal's last digits, by the sine of 1e-3 from which a triangle is thin
      worst = std::max(worst, std::abs(v.norm() - std::sqrt(wide.v_squared)) / far), worst_before = std::max(worst_before, std::abs(std::sqrt(signed_volumes.v_squared) - std::sqrt(wide.v_squared)) / far);
      for (int i = 0; i < count; ++i) EXPECT_GE(v.dot(w[static_cast<std::size_t>(i)]), found.v_squared - 1e-12 * v.norm() * far) << "simplex " << k;
    }
    ASSERT_NE(found.places >> grown.newest & 1, 0u);
    std::array<double, 4> weights;
    GrownSimplex<double>::weigh(grown.points, found.places, grown.newest, lanes, weights);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double all = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if ((found.places >> i & 1) != 0) {
        EXPECT_GE(weights[i], 0) << "simplex " << k;
        sum += weights[i] * grown.points[i].w, all += weights[i];
      }
    EXPECT_NEAR(all, 1, 1e-14);
    EXPECT_LE((sum - v).norm(), (found.encloses() ? 1e-7 : 1e-9) * far) << "simplex " << k << ", " << size << " vertices, width " << width;
    if (HasFailure()) break;
  }
  EXPECT_GT(told, asked * 9 / 10);
  EXPECT_GT(enclosing, asked / 100);
  std::printf("told of %d of %d simplices, %d around the origin; off by %.1g of the size, SignedVolumes by %.1g\n", told, asked, enclosing, worst, worst_before);
}

/// A newest vertex that is NaN is nowhere nearer.
TEST(GrownSimplex, TellsNothingOfWhatIsNoNumber) {
  RandomNumbers random(6);
  for (int k = 0; k < 300; ++k) {
    Grown grown(random, 1 + k % 3, 1);
    grown.points[static_cast<std::size_t>(grown.newest)].w[k % 3] = std::numeric_limits<double>::quiet_NaN();
    ToldInLanes<double> lanes;
    const auto found = grown.nearest(lanes);
    EXPECT_FALSE(found.places != 0 && found.v_squared < std::numeric_limits<double>::infinity()) << k;
  }
}

#ifdef GJKDBG_AVX2
/// Where lanes tell, they tell what is told without, number by number; and that is the rule.
TEST(GrownSimplex, TellsTheSameInLanes) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2";
  RandomNumbers random(7);
  int told = 0, asked = 0, edges = 0;
  for (int k = 0; k < 40000; ++k) {
    const Grown grown(random, 2 + k % 2, k % 4 < 2 ? 1 : std::pow(10.0, random.uniform(-9, 0)));
    ToldInLanes<double> lanes;
    const auto found = grown.nearest(lanes);
    ++asked;
    if (lanes.lane < 0) continue;
    ++told, edges += count_of(found.places) == 2;
    const auto alone = GrownSimplex<double>::one_by_one(grown.points, grown.old, grown.newest);
    ASSERT_EQ(found.places, alone.places) << k;
    ASSERT_EQ(found.v_squared, alone.v_squared) << k;
    for (const auto& [x, y] : {std::pair(found.v.x, alone.v.x), std::pair(found.v.y, alone.v.y), std::pair(found.v.z, alone.v.z)}) ASSERT_EQ(x, y) << k;
    std::array<double, 4> weights{}, anew{};
    GrownSimplex<double>::weigh(grown.points, found.places, grown.newest, lanes, weights);
    GrownSimplex<double>::weigh_anew(grown.points, found.places, grown.newest, anew);
    for (std::size_t i = 0; i < 4; ++i) {
      if ((found.places >> i & 1) == 0) continue;
      ASSERT_EQ(weights[i], anew[i]) << k << ", vertex " << i;
    }
  }
  EXPECT_GT(told, asked / 2);
  EXPECT_GT(edges, asked / 50);
  std::printf("lanes told of %d of %d simplices, %d edges\n", told, asked, edges);
}

PointSet random_hull_of(int vertices) {
  RandomNumbers random(static_cast<unsigned>(vertices));
  PointSet hull;
  for (int i = 0; i < vertices; ++i) hull.points.push_back(AnyVector(Eigen::Vector3d(random.vector()).normalized()));
  return hull;
}

/// A body of which the difference does not know what it is made of.
struct AnyBody {
  const Convex<3, double>& body;
  Eigen::Vector3d support(const Eigen::Vector3d& d) const { return body.support(d); }
  const Eigen::Vector3d& reference() const { return body.reference(); }
  double extent() const { return body.extent(); }
};

/// To the bit, and of vertices that are as high as one another the same: those that single precision cannot tell apart, beyond its numbers and below them, too.
TEST(VerticesPair, SaysWhatOneBodyAfterTheOtherSays) {
  RandomNumbers random(7);
  int compared = 0;
  for (int k = 0; k < 600; ++k) {
    const int kind = k % 6;
    const double scale = kind == 4 ? (k % 4 < 2 ? 1e150 : 1e-150) : kind == 5 ? 1e20 : k % 5 == 0 ? 1e-30 : 1;
    const auto body = [&](int n) {
      PointSet hull;
      hull.kind = PointSetKind::segment;  // as they are: vertices that hardly stand out are what is wanted
      for (int i = 0; i < n; ++i) {
        Eigen::Vector3d p = Eigen::Vector3d(random.vector()).normalized();
        if (kind == 0) p = (p * 2).array().round();                                                                   // many as high as one another along an axis
        if (kind == 1) p = Eigen::Vector3d(1, 2, 3) + p * std::pow(10.0, random.uniform(-16, -5));                    // all but one another
        if (kind == 2) p[2] *= 1e-9;                                                                                 // flat
        if (kind == 3) p += Eigen::Vector3d(1e6, -1e6, 3e5);                                                         // far off
        hull.points.push_back(AnyVector(p * scale));
      }
      return Convex<3, double>(Shape{hull, 0});
    };
    const Convex<3, double> a = body(9 + k / 6 % 24), b = body(9 + k / 6 * 7 % 24);
    Pose pose_a = identity_pose(3), pose_b = identity_pose(3);
    pose_b.position = AnyVector(random.vector() * (3 * scale));
    if (kind != 0) pose_b.matrix = AnyMatrix(Eigen::AngleAxisd(random.uniform(0, 3), Eigen::Vector3d(random.vector()).normalized()).toRotationMatrix());
    MinkowskiDifference<3, double, Convex<3, double>> together(a, b, pose_a, pose_b, 1);
    const AnyBody any_a{a}, any_b{b};
    MinkowskiDifference<3, double, AnyBody> one_by_one(any_a, any_b, pose_a, pose_b, 1);
    ASSERT_EQ(static_cast<bool>(VerticesPair(a, b)), __builtin_cpu_supports("avx2") != 0) << k;
    for (int i = 0; i < 200; ++i) {
      Eigen::Vector3d d = random.vector();
      if (i < 26) d = Eigen::Vector3d((i + 1) % 3 - 1, (i + 1) / 3 % 3 - 1, (i + 1) / 9 - 1);  // along axes and diagonals
      if (i % 3 == 1) {                                                                         // across an edge, or nearly
        const auto& vertices = std::get<VerticesCore<3, double>>(a.core()).vertices;
        d = d.cross((vertices[static_cast<std::size_t>(i) % vertices.size()] - vertices[static_cast<std::size_t>(i / 3) % vertices.size()]) / scale);
      }
      if (kind == 5) d *= std::pow(10.0, random.uniform(17, 19)) / d.norm();  // heights about the greatest number of single precision
      if (i % 10 == 9) d *= std::pow(10.0, random.uniform(-320, 150));
      const auto found = together.support(d), expected = one_by_one.support(d);
      ASSERT_EQ(found.a, expected.a) << "pair " << k << ", direction " << i << ": " << d.transpose();
      ASSERT_EQ(found.b, expected.b) << "pair " << k << ", direction " << i;
      ASSERT_EQ(found.w, expected.w) << "pair " << k << ", direction " << i;
      ASSERT_EQ(found.vertex, expected.vertex);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 600 * 200);
}

/// Asks the other difference, too, what GJK asks.
struct AskedTwice {
  MinkowskiDifference<3, double, AnyBody>& other;
  int asked = 0;

  template <class Event>
  void operator()([[maybe_unused]] const Event& event) {
    if constexpr (Event::kind == std::string_view("support_queried")) {
      const auto expected = other.support(event.direction);
      EXPECT_EQ(event.a, expected.a);
      EXPECT_EQ(event.b, expected.b);
      EXPECT_EQ(event.w, expected.w);
      ++asked;
    }
  }
};

/// Where the nearest points lie on edges and faces, every vertex of these is as high as the others along the last directions; they are the ones met before.
TEST(VerticesPair, SaysTheSameToGjk) {
  RandomNumbers random(11);
  int asked = 0;
  for (int k = 0; k < 400; ++k) {
    const auto body = [&](int n) { return Convex<3, double>(Shape{random_hull_of(n), 0}); };
    const Convex<3, double> a = body(9 + k % 24), b = body(9 + k * 7 % 24);
    Pose pose_a = identity_pose(3), pose_b = identity_pose(3);
    pose_b.position = AnyVector(Eigen::Vector3d(random.vector()).normalized() * (2 + random.uniform(0, 0.5)));
    pose_b.matrix = AnyMatrix(Eigen::AngleAxisd(random.uniform(0, 3), Eigen::Vector3d(random.vector()).normalized()).toRotationMatrix());
    MinkowskiDifference<3, double, Convex<3, double>> together(a, b, pose_a, pose_b, 1);
    const AnyBody any_a{a}, any_b{b};
    MinkowskiDifference<3, double, AnyBody> one_by_one(any_a, any_b, pose_a, pose_b, 1);
    GjkOptions<3, double> options;
    options.direction = together.towards_b();
    AskedTwice twice{one_by_one};
    GjkResult<3, double> found;
    gjk<SignedVolumes<3, double>>(together, options, twice, found);
    ASSERT_FALSE(HasFailure()) << "pair " << k;
    asked += twice.asked;
  }
  EXPECT_GT(asked, 1600);
}

/// The same of two tables of directions: of round hulls, flat ones, far-off ones, and prisms, of which a cell has more vertices than it has room for.
TEST(VerticesPair, SaysWhatOneTableAfterTheOtherSays) {
  RandomNumbers random(9);
  for (int k = 0; k < 40; ++k) {
    const int kind = k % 4;
    const auto body = [&](int n) {
      PointSet hull = random_hull_of(n);
      for (std::size_t i = 0; i < hull.points.size(); ++i) {
        auto& p = hull.points[i];
        const double turn = 6.283185307179586 * static_cast<double>(i / 2) / (n / 2);
        if (kind == 1) p[2] *= 1e-6;
        if (kind == 2) p += AnyVector(Eigen::Vector3d(1e6, -1e6, 3e5));
        if (kind == 3) p = AnyVector(Eigen::Vector3d(std::cos(turn), std::sin(turn), i % 2 == 0 ? 1 : -1));
      }
      return Convex<3, double>(Shape{hull, 0});
    };
    const Convex<3, double> a = body(100 + 37 * k), b = body(1600 - 37 * k);
    Pose pose_b = identity_pose(3);
    pose_b.position = AnyVector(random.vector() * 3);
    if (k % 8 < 4) pose_b.matrix = AnyMatrix(Eigen::AngleAxisd(random.uniform(0, 3), Eigen::Vector3d(random.vector()).normalized()).toRotationMatrix());
    MinkowskiDifference<3, double, Convex<3, double>> together(a, b, identity_pose(3), pose_b, 1);
    const AnyBody any_a{a}, any_b{b};
    MinkowskiDifference<3, double, AnyBody> one_by_one(any_a, any_b, identity_pose(3), pose_b, 1);
    ASSERT_EQ(static_cast<bool>(VerticesPair(a, b)), __builtin_cpu_supports("avx2") != 0) << k;
    for (int i = 0; i < 1000; ++i) {
      Eigen::Vector3d d = random.vector();
      if (i < 27) d = Eigen::Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (i % 3 == 1) d = d.normalized() + Eigen::Vector3d::Unit(i % 5 % 3) * random.uniform(-100, 100);
      if (i % 10 == 9) d *= std::pow(10.0, random.uniform(-323, 150));
      const auto found = together.support(d), expected = one_by_one.support(d);
      ASSERT_EQ(found.a, expected.a) << "pair " << k << ", direction " << i << ": " << d.transpose();
      ASSERT_EQ(found.b, expected.b) << "pair " << k << ", direction " << i;
      ASSERT_EQ(found.w, expected.w) << "pair " << k << ", direction " << i;
    }
  }
}

/// A number that is none makes no answer, and harms nothing.
class NoNumbers : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(VerticesPair, NoNumbers, testing::Values(20, 300));
TEST_P(NoNumbers, MakeNoAnswerAndNoHarm) {
  const Convex<3, double> a(Shape{random_hull_of(GetParam()), 0}), b(Shape{random_hull_of(GetParam() * 3 / 5), 0});
  MinkowskiDifference<3, double, Convex<3, double>> difference(a, b, identity_pose(3), identity_pose(3), 1);
  const double none = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& d : {Eigen::Vector3d(none, 1, 2), Eigen::Vector3d(none, none, none), Eigen::Vector3d(infinite, 0, 1), Eigen::Vector3d(-infinite, infinite, 1), Eigen::Vector3d(0, 0, 0)})
    EXPECT_TRUE(difference.support(d).w.allFinite()) << d.transpose();
}
#endif

}  // namespace
}  // namespace gjkdbg
