#include "debugger/lab/peers.h"

#include <algorithm>
#include <limits>

#include "shapes/convex.h"
#include "shapes/convex_hull.h"

#ifdef GJKDBG_WITH_BULLET
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#endif
#ifdef GJKDBG_WITH_FCL
#include <fcl/fcl.h>
#endif
#ifdef GJKDBG_WITH_CCD
#include <ccd/ccd.h>
#endif
#ifdef GJKDBG_WITH_ODE
#include <ode/ode.h>
#endif
#ifdef GJKDBG_WITH_BOX2D
#include <box2d/b2_distance.h>
#endif

namespace gjkdbg {
namespace {

/// Turns a body whose shape lies along `axis` so that a library that lays it along `own` sees the same set.
[[maybe_unused]] Eigen::Matrix3d turned(const Body& body, int axis, int own) {
  Eigen::Matrix3d swap = Eigen::Matrix3d::Identity();
  for (int k = axis; k != own; k = (k + 1) % 3) {
    Eigen::Matrix3d step;  // maps axis k + 1 to axis k, cyclically: what lay along `own` comes to lie along `axis`
    step << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    swap = swap * step;
  }
  return Eigen::Matrix3d(body.pose.matrix) * swap;
}

[[maybe_unused]] bool plain(const Scene& scene) {
  return scene.dimension == 3 && scene.bodies[0].shape.margin == 0 && scene.bodies[1].shape.margin == 0;
}

#ifdef GJKDBG_WITH_BULLET
class BulletPair final : public PeerPair {
 public:
  static std::unique_ptr<PeerPair> prepare(const Scene& scene, double) {
    if (!plain(scene)) return nullptr;
    auto pair = std::make_unique<BulletPair>();
    for (int i = 0; i < 2; ++i)
      if (!pair->set(i, scene.bodies[static_cast<std::size_t>(i)])) return nullptr;
    return pair;
  }

  PeerAnswer ask() override {
    btGjkPairDetector detector(shape_[0].get(), shape_[1].get(), &simplex_, &epa_);
    btDiscreteCollisionDetectorInterface::ClosestPointInput input;
    input.m_transformA = place_[0], input.m_transformB = place_[1];
    btPointCollector collector;
    detector.getClosestPoints(input, collector, nullptr);
    if (!collector.m_hasResult) return {true, std::nullopt};
    return {collector.m_distance <= 0, static_cast<double>(collector.m_distance)};
  }

 private:
  bool set(int i, const Body& body) {
    int axis = 1;
    if (const auto* s = std::get_if<Sphere>(&body.shape.geometry)) {
      shape_[i] = std::make_unique<btSphereShape>(btScalar(s->radius));
    } else if (const auto* b = std::get_if<Box>(&body.shape.geometry)) {
      const AnyVector h = b->max;
      if (!(b->min + b->max).isZero(0)) return false;
      shape_[i] = std::make_unique<btBoxShape>(btVector3(btScalar(h[0]), btScalar(h[1]), btScalar(h[2])));
      shape_[i]->setMargin(0);
    } else if (const auto* c = std::get_if<Capsule>(&body.shape.geometry)) {
      shape_[i] = std::make_unique<btCapsuleShape>(btScalar(c->radius), btScalar(2 * c->half_height)), axis = c->axis;
    } else if (const auto* y = std::get_if<Cylinder>(&body.shape.geometry)) {
      shape_[i] = std::make_unique<btCylinderShape>(btVector3(btScalar(y->radius), btScalar(y->half_height), btScalar(y->radius))), axis = y->axis;
      shape_[i]->setMargin(0);
    } else if (const auto* k = std::get_if<Cone>(&body.shape.geometry)) {
      shape_[i] = std::make_unique<btConeShape>(btScalar(k->radius), btScalar(2 * k->half_height)), axis = k->axis;
      shape_[i]->setMargin(0);
    } else if (const auto* p = std::get_if<PointSet>(&body.shape.geometry)) {
      auto hull = std::make_unique<btConvexHullShape>();
      for (const AnyVector& x : p->points) hull->addPoint(btVector3(btScalar(x[0]), btScalar(x[1]), btScalar(x[2])), false);
      hull->recalcLocalAabb();
      hull->setMargin(0);
      shape_[i] = std::move(hull);
    } else {
      return false;
    }
    const Eigen::Matrix3d m = turned(body, axis, 1);
    const auto cell = [&](int r, int c) { return btScalar(m(r, c)); };
    place_[i] = btTransform(btMatrix3x3(cell(0, 0), cell(0, 1), cell(0, 2), cell(1, 0), cell(1, 1), cell(1, 2), cell(2, 0), cell(2, 1), cell(2, 2)),
                            btVector3(btScalar(body.pose.position[0]), btScalar(body.pose.position[1]), btScalar(body.pose.position[2])));
    return true;
  }

  std::unique_ptr<btConvexShape> shape_[2];
  btTransform place_[2];
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver epa_;
};
#endif

#ifdef GJKDBG_WITH_FCL
class FclPair final : public PeerPair {
 public:
  static std::unique_ptr<PeerPair> prepare(const Scene& scene, double tolerance) {
    if (!plain(scene)) return nullptr;
    auto pair = std::make_unique<FclPair>();
    for (int i = 0; i < 2; ++i) {
      const Body& body = scene.bodies[static_cast<std::size_t>(i)];
      int axis = 2;
      const auto geometry = shape_of(body.shape, axis);
      if (!geometry) return nullptr;
      pair->object_[i] = std::make_unique<fcl::CollisionObjectd>(geometry, turned(body, axis, 2), Eigen::Vector3d(body.pose.position));
    }
    pair->request_.enable_signed_distance = pair->request_.enable_nearest_points = true;
    pair->request_.distance_tolerance = tolerance;
    return pair;
  }

  PeerAnswer ask() override {
    fcl::DistanceResultd result;
    const double d = fcl::distance(object_[0].get(), object_[1].get(), request_, result);
    return {d <= 0, d};
  }

 private:
  static std::shared_ptr<fcl::CollisionGeometryd> shape_of(const Shape& shape, int& axis) {
    if (const auto* s = std::get_if<Sphere>(&shape.geometry)) return std::make_shared<fcl::Sphered>(s->radius);
    if (const auto* b = std::get_if<Box>(&shape.geometry)) {
      if ((b->min + b->max).isZero(0)) return std::make_shared<fcl::Boxd>(Eigen::Vector3d(2 * b->max));
      return nullptr;
    }
    if (const auto* c = std::get_if<Capsule>(&shape.geometry)) return axis = c->axis, std::make_shared<fcl::Capsuled>(c->radius, 2 * c->half_height);
    if (const auto* y = std::get_if<Cylinder>(&shape.geometry)) return axis = y->axis, std::make_shared<fcl::Cylinderd>(y->radius, 2 * y->half_height);
    if (const auto* k = std::get_if<Cone>(&shape.geometry)) return axis = k->axis, std::make_shared<fcl::Coned>(k->radius, 2 * k->half_height);
    if (const auto* e = std::get_if<Ellipsoid>(&shape.geometry)) return std::make_shared<fcl::Ellipsoidd>(Eigen::Vector3d(e->radii));
    if (const auto* p = std::get_if<PointSet>(&shape.geometry)) {
      const ConvexHull hull = convex_hull(p->points, 3);
      if (hull.rank < 3) return nullptr;  // its hulls need faces
      auto vertices = std::make_shared<std::vector<Eigen::Vector3d>>();
      for (const AnyVector& x : p->points) vertices->push_back(x);
      auto faces = std::make_shared<std::vector<int>>();
      for (const auto& face : hull.faces) {
        faces->push_back(static_cast<int>(face.size()));
        faces->insert(faces->end(), face.begin(), face.end());
      }
      return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(hull.faces.size()), faces);
    }
    return nullptr;
  }

  std::unique_ptr<fcl::CollisionObjectd> object_[2];
  fcl::DistanceRequestd request_;
};
#endif

#ifdef GJKDBG_WITH_CCD
/// libccd takes support functions: ours, so that the algorithm is what differs.
class CcdPair final : public PeerPair {
 public:
  enum class Way { gjk, mpr };
  template <Way way>
  static std::unique_ptr<PeerPair> prepare(const Scene& scene, double tolerance) {
    if (scene.dimension != 3) return nullptr;
    return std::make_unique<CcdPair>(scene, tolerance, way);
  }

  CcdPair(const Scene& scene, double tolerance, Way way) : bodies_{Placed(scene.bodies[0]), Placed(scene.bodies[1])}, way_(way) {
    CCD_INIT(&ccd_);
    ccd_.support1 = ccd_.support2 = &Placed::support;
    ccd_.center1 = ccd_.center2 = &Placed::center;
    ccd_.max_iterations = 500;
    ccd_.epa_tolerance = ccd_.mpr_tolerance = tolerance;
  }

  PeerAnswer ask() override {
    ccd_real_t depth = 0;
    ccd_vec3_t direction, position;
    const int apart = way_ == Way::gjk ? ccdGJKPenetration(&bodies_[0], &bodies_[1], &ccd_, &depth, &direction, &position)
                                       : ccdMPRPenetration(&bodies_[0], &bodies_[1], &ccd_, &depth, &direction, &position);
    if (apart != 0) return {false, std::nullopt};
    return {true, -depth};
  }

 private:
  struct Placed {
    explicit Placed(const Body& body) : convex(body.shape), rotation(body.pose.matrix), position(body.pose.position + body.pose.matrix * convex.reference()) {}
    static void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
      const Placed& self = *static_cast<const Placed*>(object);
      const Eigen::Vector3d d(direction->v[0], direction->v[1], direction->v[2]);
      const Eigen::Vector3d p = self.rotation * self.convex.support(self.rotation.transpose() * d) + self.position + self.convex.radius() * d.normalized();
      ccdVec3Set(out, p[0], p[1], p[2]);
    }
    static void center(const void* object, ccd_vec3_t* out) {
      const Placed& self = *static_cast<const Placed*>(object);
      const Eigen::Vector3d p = self.rotation * self.convex.center() + self.position;
      ccdVec3Set(out, p[0], p[1], p[2]);
    }
    Convex<3, double> convex;
    Eigen::Matrix3d rotation;
    Eigen::Vector3d position;
  };

  Placed bodies_[2];
  Way way_;
  ccd_t ccd_;
};
#endif

#ifdef GJKDBG_WITH_ODE
class OdePair final : public PeerPair {
 public:
  static std::unique_ptr<PeerPair> prepare(const Scene& scene, double) {
    static const bool ready = dInitODE2(0) != 0;
    if (!ready || !plain(scene)) return nullptr;
    auto pair = std::make_unique<OdePair>();
    for (int i = 0; i < 2; ++i)
      if (!pair->set(i, scene.bodies[static_cast<std::size_t>(i)])) return nullptr;
    return pair;
  }
  OdePair() = default;
  OdePair(const OdePair&) = delete;
  OdePair& operator=(const OdePair&) = delete;
  ~OdePair() override {
    for (const dGeomID geom : geom_)
      if (geom) dGeomDestroy(geom);
  }

  PeerAnswer ask() override {
    dContactGeom contacts[8];
    const int count = dCollide(geom_[0], geom_[1], 8, contacts, sizeof(dContactGeom));
    if (count == 0) return {false, std::nullopt};
    dReal depth = contacts[0].depth;
    for (int i = 1; i < count; ++i) depth = std::max(depth, contacts[i].depth);
    return {true, -static_cast<double>(depth)};
  }

 private:
  bool set(int i, const Body& body) {
    int axis = 2;
    if (const auto* s = std::get_if<Sphere>(&body.shape.geometry)) geom_[i] = dCreateSphere(nullptr, s->radius);
    else if (const auto* b = std::get_if<Box>(&body.shape.geometry); b && (b->min + b->max).isZero(0)) geom_[i] = dCreateBox(nullptr, 2 * b->max[0], 2 * b->max[1], 2 * b->max[2]);
    else if (const auto* c = std::get_if<Capsule>(&body.shape.geometry)) geom_[i] = dCreateCapsule(nullptr, c->radius, 2 * c->half_height), axis = c->axis;
    else return false;
    const Eigen::Matrix3d m = turned(body, axis, 2);
    const dMatrix3 rotation = {m(0, 0), m(0, 1), m(0, 2), 0, m(1, 0), m(1, 1), m(1, 2), 0, m(2, 0), m(2, 1), m(2, 2), 0};
    dGeomSetRotation(geom_[i], rotation);
    dGeomSetPosition(geom_[i], body.pose.position[0], body.pose.position[1], body.pose.position[2]);
    return true;
  }

  dGeomID geom_[2] = {nullptr, nullptr};
};
#endif

#ifdef GJKDBG_WITH_BOX2D
/// Its distance of two point sets with radii, begun anew each time; of cores that overlap it knows no depth.
class Box2dPair final : public PeerPair {
 public:
  static std::unique_ptr<PeerPair> prepare(const Scene& scene, double) {
    if (scene.dimension != 2) return nullptr;
    auto pair = std::make_unique<Box2dPair>();
    pair->input_.useRadii = true;
    if (!pair->set(scene.bodies[0], pair->points_[0], pair->input_.proxyA, pair->input_.transformA)) return nullptr;
    if (!pair->set(scene.bodies[1], pair->points_[1], pair->input_.proxyB, pair->input_.transformB)) return nullptr;
    return pair;
  }
  Box2dPair() = default;
  Box2dPair(const Box2dPair&) = delete;  // its proxies point at its points
  Box2dPair& operator=(const Box2dPair&) = delete;

  PeerAnswer ask() override {
    b2SimplexCache cache;
    cache.count = 0;
    b2DistanceOutput output;
    b2Distance(&output, &cache, &input_);
    if (output.distance > 0) return {false, static_cast<double>(output.distance)};
    return {true, std::nullopt};
  }

 private:
  static bool set(const Body& body, std::vector<b2Vec2>& points, b2DistanceProxy& proxy, b2Transform& place) {
    const auto add = [&](double x, double y) { points.emplace_back(static_cast<float>(x), static_cast<float>(y)); };
    double radius = body.shape.margin;
    if (const auto* s = std::get_if<Sphere>(&body.shape.geometry)) {
      radius += s->radius, add(0, 0);
    } else if (const auto* b = std::get_if<Box>(&body.shape.geometry)) {
      add(b->min[0], b->min[1]), add(b->max[0], b->min[1]), add(b->max[0], b->max[1]), add(b->min[0], b->max[1]);
    } else if (const auto* c = std::get_if<Capsule>(&body.shape.geometry)) {
      const Eigen::Vector2d tip = c->half_height * Eigen::Vector2d::Unit(c->axis);
      radius += c->radius, add(tip[0], tip[1]), add(-tip[0], -tip[1]);
    } else if (const auto* p = std::get_if<PointSet>(&body.shape.geometry); p && p->points.size() <= 255) {  // it counts them in a byte
      for (const AnyVector& x : p->points) add(x[0], x[1]);
    } else {
      return false;
    }
    proxy.Set(points.data(), static_cast<int>(points.size()), static_cast<float>(radius));
    place.p.Set(static_cast<float>(body.pose.position[0]), static_cast<float>(body.pose.position[1]));
    place.q.c = static_cast<float>(body.pose.matrix(0, 0)), place.q.s = static_cast<float>(body.pose.matrix(1, 0));
    return true;
  }

  std::vector<b2Vec2> points_[2];
  b2DistanceInput input_;
};
#endif

}  // namespace

const std::vector<Peer>& peers() {
  static const std::vector<Peer> all = {
#ifdef GJKDBG_WITH_BULLET
      {"Bullet (float)", false, &BulletPair::prepare},
#endif
#ifdef GJKDBG_WITH_FCL
      {"FCL", true, &FclPair::prepare},  // with its default solver; its other one fails an assertion of its own on a pair of hulls
#endif
#ifdef GJKDBG_WITH_CCD
      {"libccd GJK", true, &CcdPair::prepare<CcdPair::Way::gjk>},
      {"libccd MPR", true, &CcdPair::prepare<CcdPair::Way::mpr>},
#endif
#ifdef GJKDBG_WITH_ODE
      {"ODE", false, &OdePair::prepare},
#endif
#ifdef GJKDBG_WITH_BOX2D
      {"Box2D (float)", false, &Box2dPair::prepare},
#endif
  };
  return all;
}

}  // namespace gjkdbg
