// Time of impact beside Bullet's continuous collision and FCL's conservative advancement, where Debian's packages of them are installed
// (libbullet-dev, libfcl-dev): the same casts, in one run. Counters: `late`, answers after the true time by more than 1e-6 of it, which let a
// body in; `missed`, impacts not found; `early`, the worst time before the true one.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "algo/motion.h"
#include "debugger/lab/motion_chart.h"

#ifdef GJKDBG_WITH_BULLET
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#endif
#ifdef GJKDBG_WITH_FCL
#include <fcl/fcl.h>
#endif

namespace gjkdbg {
namespace {

constexpr int count = 200;

/// The time of impact a peer finds, above 1 for none.
using Cast = std::function<double(const CastScene&)>;

void run(benchmark::State& state, const std::string& family, const Cast& cast) {
  static std::map<std::string, std::vector<CastScene>> made;
  std::vector<CastScene>& scenes = made[family];
  if (scenes.empty()) scenes = cast_scenes(family, count);
  int late = 0, missed = 0;
  double early = 0;
  for (const CastScene& c : scenes) {
    const double time = cast(c);
    if (time > 1) ++missed;
    else late += time > c.time * (1 + 1e-6), early = std::max(early, c.time - time);
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(cast(scenes[++i % scenes.size()]));
  state.counters["late"] = late, state.counters["missed"] = missed, state.counters["early"] = early;
}

double ours(const CastScene& c, MethodName name) {
  Method method;
  method.name = name, method.tolerance = 1e-6;
  const Result r = solve(c.scene, resolve_settings(method, c.scene));
  return r.intersecting ? *r.time : 2;
}

#ifdef GJKDBG_WITH_BULLET
btTransform placed(const Body& body) {
  btMatrix3x3 r;
  for (int i = 0; i < 3; ++i) r[i].setValue(static_cast<btScalar>(body.pose.matrix(i, 0)), static_cast<btScalar>(body.pose.matrix(i, 1)), static_cast<btScalar>(body.pose.matrix(i, 2)));
  const AnyVector& p = body.pose.position;
  return btTransform(r, btVector3(static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]), static_cast<btScalar>(p[2])));
}

std::unique_ptr<btConvexShape> bullet_shape(const Shape& shape) {
  if (const Sphere* s = std::get_if<Sphere>(&shape.geometry)) return std::make_unique<btSphereShape>(static_cast<btScalar>(s->radius));
  const Box& b = std::get<Box>(shape.geometry);
  auto box = std::make_unique<btBoxShape>(btVector3(static_cast<btScalar>(b.max[0]), static_cast<btScalar>(b.max[1]), static_cast<btScalar>(b.max[2])));
  box->setMargin(0);
  return box;
}

double bullet(const CastScene& c) {
  const Body &a = c.scene.bodies[0], &b = c.scene.bodies[1];
  const auto shape_a = bullet_shape(a.shape), shape_b = bullet_shape(b.shape);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btContinuousConvexCollision cast(shape_a.get(), shape_b.get(), &simplex, &depth);
  btConvexCast::CastResult result;
  const bool hit = cast.calcTimeOfImpact(placed(a), placed(moved(a, 1, 3)), placed(b), placed(moved(b, 1, 3)), result);
  return hit ? static_cast<double>(result.m_fraction) : 2;
}
#endif

#ifdef GJKDBG_WITH_FCL
fcl::Transform3d fcl_place(const Body& body) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = Eigen::Matrix3d(body.pose.matrix);
  t.translation() = Eigen::Vector3d(body.pose.position);
  return t;
}

std::shared_ptr<fcl::CollisionGeometryd> fcl_shape(const Shape& shape) {
  if (const Sphere* s = std::get_if<Sphere>(&shape.geometry)) return std::make_shared<fcl::Sphered>(s->radius);
  const Box& b = std::get<Box>(shape.geometry);
  return std::make_shared<fcl::Boxd>(2 * b.max[0], 2 * b.max[1], 2 * b.max[2]);
}

double fcl_advancement(const CastScene& c) {
  const Body &a = c.scene.bodies[0], &b = c.scene.bodies[1];
  const auto shape_a = fcl_shape(a.shape), shape_b = fcl_shape(b.shape);
  fcl::ContinuousCollisionRequestd request;
  request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  request.ccd_motion_type = fcl::CCDM_LINEAR;
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.toc_err = 1e-6;
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(shape_a.get(), fcl_place(a), fcl_place(moved(a, 1, 3)), shape_b.get(), fcl_place(b), fcl_place(moved(b, 1, 3)), request, result);
  return result.is_collide ? result.time_of_contact : 2;
}
#endif

int registered = [] {
  for (const char* family : {"balls", "boxes", "boxes, turning"}) {
    const auto add = [&](const char* who, const Cast& cast) {
      benchmark::RegisterBenchmark((std::string(family) + "/" + who).c_str(), [family, cast](benchmark::State& state) { run(state, family, cast); });
    };
    add("conservative advancement", [](const CastScene& c) { return ours(c, MethodName::conservative_advancement); });
    add("root finding", [](const CastScene& c) { return ours(c, MethodName::root_finding); });
    if (std::string(family) != "boxes, turning") add("ray cast", [](const CastScene& c) { return ours(c, MethodName::ray_cast); });
#ifdef GJKDBG_WITH_BULLET
    add("Bullet, continuous", bullet);
#endif
#ifdef GJKDBG_WITH_FCL
    add("FCL, conservative advancement", fcl_advancement);
#endif
  }
  return 0;
}();

}  // namespace
}  // namespace gjkdbg

BENCHMARK_MAIN();
