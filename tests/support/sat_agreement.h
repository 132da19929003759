// What SAT says of pairs, every query and both scalars, against exact arithmetic.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <variant>

#include "algo/solve.h"
#include "recordings/recording.h"
#include "shapes/world_support.h"
#include "tests/oracle/exact_polytopes.h"

namespace gjkdbg {

inline Settings sat(const Scene& scene, Scalar scalar = Scalar::double_precision) {
  Method method;
  method.name = MethodName::sat, method.scalar = scalar;
  return resolve_settings(method, scene);
}

/// How far the bodies are apart along a unit direction from body 0 to body 1.
inline double across(const Scene& scene, const AnyVector& n) {
  const AnyVector a = WorldSupport(scene.bodies[0], scene.dimension)(n, true), b = WorldSupport(scene.bodies[1], scene.dimension)(-n, true);
  return n.dot(b - a);
}

/// SAT of two polytopes that are apart: the distance within 1e-14, and projections that lead nearer and nearer, with bounds that hold, on points of both
/// bodies (`outside`: how far a point lies outside one, at most). Says how many projections there were.
inline int projections_of_sat(const Scene& scene, double exact, double (*outside)(const Body&, const AnyVector&)) {
  Recorder recorder;
  const Result r = solve(scene, sat(scene), recorder);
  EXPECT_EQ(r.status, "separated");
  EXPECT_NEAR(*r.signed_distance, exact, 1e-14);
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
  int steps = 0;
  for (const auto& event : recorder.take_all())
    if (const auto* e = std::get_if<recorded::PointsProjected>(&event)) {
      EXPECT_LE(e->upper_bound, upper + 1e-15) << "a projection never leads away";
      EXPECT_LE(lower = e->lower_bound, exact);
      EXPECT_GE(upper = e->upper_bound, exact);
      EXPECT_LE(outside(scene.bodies[0], e->a) + outside(scene.bodies[1], e->b), 1e-14);
      ++steps;
    }
  if (steps > 0) {
    EXPECT_LE(upper - lower, 1e-13);
  }
  return steps;
}

struct SatAgreement {
  double (*outside)(const Body&, const AnyVector&);  ///< how far a point lies outside a body, at most
  int more_supports;                                 ///< than steps, where no GJK was asked
  int pairs = 0, overlapping = 0, by_gjk = 0;
  double worst = 0, worst_float = 0;  ///< errors over the size

  void judge(const Scene& scene, double size) {
    const auto exact = oracle::signed_distance(scene);
    ASSERT_TRUE(exact);
    const double place = size + scene.bodies[0].pose.position.norm(), sd = exact->signed_distance;
    const Result r = solve(scene, sat(scene));
    ASSERT_TRUE(r.signed_distance && r.normal && r.witness_a && r.witness_b && r.lower_bound && r.upper_bound);
    // Else GJK gave the distance, at its own tolerance, or the witnesses.
    const bool by_axes = (r.status == "overlapping" || r.status == "separated") && r.support_calls <= r.iterations + more_supports;
    const double error = std::abs(*r.signed_distance - sd) / size, tolerance = by_axes ? 1e-14 : 1e-14 + 1e-12 * std::abs(sd) / size;
    worst = std::max(worst, error);
    EXPECT_LE(error, tolerance) << *r.signed_distance << " for " << sd;
    EXPECT_LE(*r.lower_bound, sd + 1e-15 * std::abs(sd));
    EXPECT_GE(*r.upper_bound, sd - 1e-15 * std::abs(sd));
    EXPECT_LE(*r.upper_bound - *r.lower_bound, 1e-12 * size);
    EXPECT_NEAR(r.normal->norm(), 1, 1e-14);
    EXPECT_LE((*r.witness_b - *r.witness_a - *r.signed_distance * *r.normal).norm(), 1e-14 * place);
    const double off = by_axes ? 1e-14 * place : 1e-10 * size + 1e-14 * place;
    EXPECT_LE(outside(scene.bodies[0], *r.witness_a), off);
    EXPECT_LE(outside(scene.bodies[1], *r.witness_b), off) << r.status << " " << sd << " " << r.support_calls;
    EXPECT_NEAR(across(scene, *r.normal), sd, tolerance * size + 1e-14 * place) << "the normal certifies the distance";
    ++pairs, overlapping += r.intersecting, by_gjk += !by_axes;
    for (const Query query : {Query::intersect, Query::distance}) {
      Scene asked = scene;
      asked.query = query;
      const Result least = solve(asked, sat(asked));
      if (std::abs(sd) > 1e-13 * size) {
        EXPECT_EQ(least.intersecting, sd <= 0);
      }
      if (query == Query::distance) {
        EXPECT_NEAR(*least.signed_distance, std::max(0.0, sd), tolerance * size);
      } else {
        EXPECT_FALSE(least.signed_distance || least.normal || least.lower_bound);
      }
    }
    const Result single = solve(scene, sat(scene, Scalar::float_precision));
    worst_float = std::max(worst_float, std::abs(*single.signed_distance - sd) / size);
  }

  void finish() const {
    EXPECT_LE(worst_float, 1e-5);
    EXPECT_GT(overlapping, pairs / 10);
    std::printf("worst error %.2g, in float %.2g of the size; %d of %d overlap, %d need GJK\n", worst, worst_float, overlapping, pairs, by_gjk);
  }
};

}  // namespace gjkdbg
