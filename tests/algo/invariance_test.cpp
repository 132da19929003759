// What must not change the answer: the order of bodies and vertices, where the pair lies, the unit of length, the first direction,
// and whether anyone is watching.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algo/epa.h"
#include "recordings/check.h"
#include "recordings/gallery.h"
#include "recordings/json_writing.h"
#include "recordings/recording.h"
#include "tests/support/random_scenes.h"

namespace gjkdbg {
namespace {

constexpr int rounds = 400;

Result answer(const Scene& scene, const Method& method = {}) { return solve(scene, resolve_settings(method, scene)); }

std::string text(const Result& r) {
  std::string out;
  append_result(out, r, Query::penetration);
  return out;
}

template <class Check>
void for_random_scenes(unsigned seed, Check check) {
  RandomScenes random(seed);
  for (int k = 0; k < rounds && !testing::Test::HasFailure(); ++k) {
    const int dimension = 1 + k % 3;
    SCOPED_TRACE("scene " + std::to_string(k));
    check(random, random.scene(dimension, static_cast<Family>(k / 3 % family_count), true));
  }
}

double tolerance(const Scene& scene, const Result& r) { return 1e-12 * std::max(size_of(scene), std::abs(*r.signed_distance)); }

TEST(Invariance, SwappingTheBodies) {
  for_random_scenes(11, [](RandomScenes&, Scene scene) {
    const Result r = answer(scene);
    std::swap(scene.bodies[0], scene.bodies[1]);
    EXPECT_NEAR(*answer(scene).signed_distance, *r.signed_distance, tolerance(scene, r));
  });
}

/// Whether the radii reach across the distance is told however coarsely that is asked for.
TEST(Invariance, YesOrNoAtACoarseTolerance) {
  RandomScenes random(19);
  int overlapping = 0, apart = 0;
  for (int k = 0; k < 4000 && !testing::Test::HasFailure(); ++k) {
    const auto ellipsoid = [&] { return Shape{Ellipsoid{Eigen::Vector3d(random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2))}, random.uniform(0, 1)}; };
    Scene scene;
    scene.dimension = 3;
    for (const char* name : {"A", "B"}) scene.bodies.push_back({name, ellipsoid(), identity_pose(3)});
    scene.bodies[1].pose.position = Eigen::Vector3d(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
    scene.query = Query::penetration;
    const Result r = answer(scene);
    if (std::abs(*r.signed_distance) <= 1e-6) continue;
    ++(r.intersecting ? overlapping : apart);
    Method coarse;
    coarse.tolerance = 0.3;
    for (const Query query : {Query::intersect, Query::distance, Query::penetration}) {
      scene.query = query;
      EXPECT_EQ(answer(scene, coarse).intersecting, r.intersecting) << "scene " << k << ", query " << static_cast<int>(query) << ", " << *r.signed_distance;
    }
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_GT(apart, 1000);
}

TEST(Invariance, PermutingTheVertices) {
  for_random_scenes(12, [](RandomScenes& random, Scene scene) {
    const Result r = answer(scene);
    std::mt19937 order(static_cast<unsigned>(random.integer(0, 1000000)));
    for (Body& body : scene.bodies)
      if (auto* set = std::get_if<PointSet>(&body.shape.geometry)) std::shuffle(set->points.begin(), set->points.end(), order);
    EXPECT_NEAR(*answer(scene).signed_distance, *r.signed_distance, tolerance(scene, r));
  });
}

TEST(Invariance, RigidMotions) {
  for_random_scenes(13, [](RandomScenes& random, Scene scene) {
    if (scene.dimension != 3) return;
    const Result r = answer(scene);
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1)).normalized().toRotationMatrix();
    const Eigen::Vector3d shift(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    double far = 1;
    for (Body& body : scene.bodies) {
      body.pose.position = turn * body.pose.position + shift;
      body.pose.matrix = turn * body.pose.matrix;
      far = std::max(far, body.pose.position.norm());
    }
    EXPECT_NEAR(*answer(scene).signed_distance, *r.signed_distance, tolerance(scene, r) + 1e-14 * far);
  });
}

void scale(AnyVector& v, double s) { v *= s; }

void scale(Shape& shape, double s) {
  shape.margin *= s;
  if (auto* ball = std::get_if<Sphere>(&shape.geometry)) ball->radius *= s;
  if (auto* box = std::get_if<Box>(&shape.geometry)) scale(box->min, s), scale(box->max, s);
  if (auto* capsule = std::get_if<Capsule>(&shape.geometry)) capsule->radius *= s, capsule->half_height *= s;
  if (auto* set = std::get_if<PointSet>(&shape.geometry))
    for (AnyVector& p : set->points) scale(p, s);
  if (auto* sum = std::get_if<Sum>(&shape.geometry)) {
    for (auto* part : {&sum->first, &sum->second}) {
      Shape scaled = **part;
      scale(scaled, s);
      *part = std::make_shared<const Shape>(scaled);
    }
  }
}

TEST(Invariance, PowersOfTwoBitForBit) {
  for_random_scenes(14, [](RandomScenes& random, Scene scene) {
    const Result r = answer(scene);
    const double s = std::ldexp(1.0, random.integer(-90, 90));
    for (Body& body : scene.bodies) scale(body.shape, s), scale(body.pose.position, s);
    Result scaled = answer(scene);
    for (auto* x : {&scaled.signed_distance, &scaled.lower_bound, &scaled.upper_bound}) **x /= s;
    for (auto* v : {&scaled.witness_a, &scaled.witness_b}) **v /= s;
    EXPECT_EQ(text(scaled), text(r)) << "scaled by " << s;
  });
}

TEST(Invariance, AnyInitialDirection) {
  for_random_scenes(15, [](RandomScenes& random, const Scene& scene) {
    const Result r = answer(scene);
    for (int i = 0; i < 5; ++i) {
      Method method;
      method.initial_direction = AnyVector(scene.dimension);
      for (double& x : *method.initial_direction) x = random.uniform(-1, 1) * std::pow(10, random.uniform(-20, 20));
      EXPECT_NEAR(*answer(scene, method).signed_distance, *r.signed_distance, tolerance(scene, r));
    }
  });
}

std::vector<SceneFile> gallery_scenes() {
  const Gallery gallery = read_gallery(GJKDBG_GALLERY);
  std::vector<SceneFile> scenes;
  for (const Lesson& lesson : gallery.lessons)
    for (const std::string& name : lesson.scenes) scenes.push_back(read_scene(gallery.file(name)));
  return scenes;
}

TEST(Trace, WatchingChangesNothing) {
  for (const SceneFile& scene : gallery_scenes()) {
    for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
      Method method = scene.method;
      method.scalar = scalar;
      const Settings settings = resolve_settings(method, scene.scene);
      EXPECT_EQ(text(solve(scene.scene, settings)), text(record(scene, settings).result)) << scene.scene.name;
    }
  }
}

/// Every phase that begins ends once; numbers are given out once and never used before.
TEST(Trace, EveryPhaseEndsExactlyOnce) {
  for (const SceneFile& scene : gallery_scenes()) {
    SCOPED_TRACE(scene.scene.name);
    const Recording recording = record(scene);
    bool gjk = false, epa = false, other = false;
    int next_vertex = 0, last_face = -1;
    for (const Event& event : recording.events) {
      if (const auto given = given_vertex(event)) {
        EXPECT_EQ(given->vertex, next_vertex++);
      }
      if (std::holds_alternative<recorded::GjkBegan>(event)) {
        EXPECT_FALSE(gjk || epa || other);
        gjk = true;
      } else if (std::holds_alternative<recorded::MprBegan>(event) || std::holds_alternative<recorded::SatBegan>(event) || std::holds_alternative<recorded::ClosedFormBegan>(event) || std::holds_alternative<recorded::ProjectionsBegan>(event)) {
        EXPECT_FALSE(gjk || epa || other);
        other = true;
      } else if (std::holds_alternative<recorded::MprEnded>(event) || std::holds_alternative<recorded::SatEnded>(event) || std::holds_alternative<recorded::ClosedFormEnded>(event) || std::holds_alternative<recorded::ProjectionsEnded>(event)) {
        EXPECT_TRUE(other);
        other = false;
      } else if (const auto* query = std::get_if<recorded::SupportQueried>(&event)) {
        EXPECT_EQ(gjk, query->phase == Phase::gjk);
        EXPECT_EQ(other, query->phase == Phase::mpr || query->phase == Phase::sat || query->phase == Phase::projections);
        if (query->phase == Phase::seed || query->phase == Phase::epa) epa = true;
      } else if (std::holds_alternative<recorded::GjkEnded>(event)) {
        EXPECT_TRUE(gjk);
        gjk = false;
      } else if (const auto* seeded = std::get_if<recorded::PolytopeSeeded>(&event)) {
        EXPECT_FALSE(gjk);
        epa = true;
        for (const auto& f : seeded->faces) EXPECT_GT(f.face, last_face), last_face = f.face;
      } else if (const auto* grown = std::get_if<recorded::PolytopeGrown>(&event)) {
        EXPECT_TRUE(epa);
        for (const auto& f : grown->added) EXPECT_GT(f.face, last_face), last_face = f.face;
      } else if (std::holds_alternative<recorded::EpaEnded>(event)) {
        EXPECT_TRUE(epa);
        epa = false;
      }
    }
    EXPECT_FALSE(gjk || epa || other);
    EXPECT_FALSE(recording.events.empty());
  }
}

TEST(Trace, EveryStatusIsReachedByTheGallery) {
  std::vector<bool> gjk(gjk_status_names.size()), epa(epa_status_names.size()), mpr(mpr_status_names.size()), sat(sat_status_names.size());
  for (const SceneFile& scene : gallery_scenes())
    for (const Event& event : record(scene).events) {
      if (const auto* e = std::get_if<recorded::GjkEnded>(&event)) gjk[static_cast<std::size_t>(e->status)] = true;
      if (const auto* e = std::get_if<recorded::EpaEnded>(&event)) epa[static_cast<std::size_t>(e->status)] = true;
      if (const auto* e = std::get_if<recorded::MprEnded>(&event)) mpr[static_cast<std::size_t>(e->status)] = true;
      if (const auto* e = std::get_if<recorded::SatEnded>(&event)) sat[static_cast<std::size_t>(e->status)] = true;
    }
  for (std::size_t i = 0; i < mpr.size(); ++i) EXPECT_TRUE(mpr[i] || mpr_status_names[i] == "stalled" || mpr_status_names[i] == "iteration_limit") << "mpr " << mpr_status_names[i];
  for (std::size_t i = 0; i < sat.size(); ++i) EXPECT_TRUE(sat[i]) << "sat " << sat_status_names[i];
  for (std::size_t i = 0; i < gjk.size(); ++i) EXPECT_TRUE(gjk[i] || gjk_status_names[i] == "aborted") << "gjk " << gjk_status_names[i];
  for (std::size_t i = 0; i < epa.size(); ++i) EXPECT_TRUE(epa[i] || epa_status_names[i] == "stalled" || epa_status_names[i] == "aborted") << "epa " << epa_status_names[i];
}

/// A triangle that claims to round nothing: where n . w and the face's distance differ by one rounding, EPA may not stop, and
/// the vertex it is given is one it has.
struct Exacting {
  static constexpr int D = 2;
  using S = double;
  std::array<Vector<2, double>, 3> corners;
  int calls = 3;

  double rounding_floor() const { return 1e-300; }
  double radius() const { return 0; }
  bool polytope() const { return true; }
  SupportPoint<2, double> support(const Vector<2, double>& d) {
    SupportPoint<2, double> p;
    p.w = *std::max_element(corners.begin(), corners.end(), [&](const auto& x, const auto& y) { return d.dot(x) < d.dot(y); });
    p.a = p.w, p.b.setZero(), p.vertex = calls++;
    return p;
  }
};

/// Centres so near to each other that the square of the way between them vanishes: it has a direction all the same, and every step holds.
TEST(Invariance, CentresNextToEachOther) {
  for (const char* shapes : {R"({"type": "ellipsoid", "radii": [1, 1.5, 2]}|{"type": "ellipsoid", "radii": [0.5, 1, 1.5]})", R"({"type": "box", "half_extents": [1, 2, 3]}|{"type": "sphere", "radius": 0.5})",
                             R"({"type": "cone", "radius": 1, "half_height": 1}|{"type": "cylinder", "radius": 0.5, "half_height": 1})"})
    for (const char* height : {"1e-170", "-1e-200", "5e-324", "1e-155"})
      for (const char* method : {"gjk", "gjk-boolean", "gjk-accelerated", "mpr"}) {
        const std::string pair = shapes, bar = "|";
        const std::string query = std::string(method) == "gjk-boolean" ? "intersect" : "penetration";
        const Recording recording = record(parse_scene(R"({"format": "gjk-scene", "version": 1, "dimension": 3, "query": ")" + query + R"(", "method": {"name": ")" + method + R"("}, "bodies": [{"shape": )" + pair.substr(0, pair.find(bar)) +
                                                           R"(, "pose": {"position": [0, )" + height + R"(, 0]}}, {"shape": )" + pair.substr(pair.find(bar) + 1) + "}]}", {}));
        EXPECT_TRUE(recording.result.intersecting);
        const auto findings = check(recording);
        EXPECT_TRUE(findings.empty()) << pair << " " << height << " " << method << ": " << findings[0].message;
      }
}

TEST(Trace, EpaStallsWherePrecisionEnds) {
  RandomScenes random(7);
  int stalled = 0;
  for (int k = 0; k < 200; ++k) {
    Exacting difference{{Vector<2, double>(-random.uniform(1, 2), -random.uniform(1, 2)), {random.uniform(1, 2), -random.uniform(1, 2)}, {random.uniform(-1, 1), random.uniform(3, 4)}}};
    Simplex<2, double> simplex;
    for (const auto& w : difference.corners) {
      SupportPoint<2, double> p;
      p.w = p.a = w, p.b.setZero(), p.vertex = simplex.size();
      simplex.add(p);
    }
    EpaOptions<double> options;
    options.tolerance = 1e-300;
    EpaWorkspace<2, double> workspace;
    NoTrace trace;
    const auto result = epa(difference, simplex, options, workspace, trace);
    EXPECT_TRUE(result.status == EpaStatus::stalled || result.status == EpaStatus::converged);
    EXPECT_NEAR(result.depth, result.normal.dot(difference.support(result.normal).w), 1e-15);
    stalled += result.status == EpaStatus::stalled;
  }
  EXPECT_GT(stalled, 0);
}

/// Asks another scene's query at every event.
class Asking : public SinkTaking<Asking> {
 public:
  Asking(const Scene& scene, const Method& method) : scene_(scene), settings_(resolve_settings(method, scene)) {}
  template <class Event>
  void take(const Event&) {
    last_ = solve(scene_, settings_);
  }
  const Result& last() const { return last_; }

 private:
  const Scene& scene_;
  const Settings settings_;
  Result last_;
};

TEST(Trace, ASinkMayAskAnotherQuery) {
  RandomScenes random(31);
  for (int k = 0; k < 60 && !testing::Test::HasFailure(); ++k) {
    Scene scene = random.scene(2 + k % 2, Family::general, true), other = random.scene(2 + k % 2, Family::general, true);
    for (Scene* s : {&scene, &other}) s->bodies[1].pose.position = s->bodies[0].pose.position;  // EPA runs
    Method method;
    method.name = k / 2 % 2 == 0 ? MethodName::gjk : MethodName::sat;
    Asking sink(other, method);
    const Settings settings = resolve_settings(method, scene);
    EXPECT_EQ(text(solve(scene, settings, sink)), text(solve(scene, settings))) << "scene " << k;
    EXPECT_EQ(text(sink.last()), text(answer(other, method))) << "scene " << k;
  }
}

/// Faces of bodies of 1e-170 have areas that are no numbers; the ways they face are told all the same.
TEST(Invariance, SatHasItsAxesInAnyUnit) {
  RandomScenes random(23);
  Method sat;
  sat.name = MethodName::sat;
  for (int k = 0; k < 60 && !testing::Test::HasFailure(); ++k) {
    const Scene scene = random.scene(2 + k % 2, Family::general, true);
    const Result right = answer(scene, sat);
    for (const int exponent : {-999, -860, -600, 150}) {
      Scene other = scene;
      for (Body& body : other.bodies) body.shape = scaled(body.shape, std::ldexp(1.0, exponent)), body.pose.position *= std::ldexp(1.0, exponent);
      const Result r = answer(other, sat);
      EXPECT_EQ(r.status, right.status) << "scene " << k << ", 2^" << exponent;
      EXPECT_EQ(r.iterations, right.iterations) << "scene " << k << ", 2^" << exponent;
      EXPECT_EQ(*r.normal, *right.normal) << "scene " << k << ", 2^" << exponent;
    }
  }
}

}  // namespace
}  // namespace gjkdbg
