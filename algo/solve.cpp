#include "algo/solve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "algo/cast.h"
#include "algo/closed_form.h"
#include "algo/contact.h"
#include "algo/motion.h"
#include "algo/prepared_pair.h"
#include "algo/simulate.h"
#include "algo/solve_pair.h"
#include "algo/working_scale.h"
#include "shapes/error.h"

namespace gjkdbg {
namespace {

template <int D, class S>
Result solve_convex(const Body& a, const Body& b, const Query query, const Settings& settings, TraceSink* sink, TraceNumbers& numbers, std::vector<SimplexPoint>* simplex) {
  const double scale = working_scale<S>(a, b);
  if (!sink) {
    const auto pair = prepare(a, b, D, settings.scalar, scale);
    if (!simplex) return pair->run(settings, query);
    Settings from = settings;
    from.core_simplex = *simplex;
    const Result result = pair->run(from, query);
    *simplex = pair->simplex();
    return result;
  }
  const Convex<D, S> core_a(a.shape, scale), core_b(b.shape, scale);
  if (settings.name == MethodName::closed_form) {
    const WorkingFrame<D, S> frame(a.pose, scale);
    WorldTrace<D, S> trace(frame, numbers, *sink);
    return ClosedForm<D, S, WorldTrace<D, S>>(core_segment(core_a).value(), core_segment(core_b).value(), a.pose, b.pose, scale, frame, trace).run(query);
  }
  LateFeatures features_a(a.shape, D), features_b(b.shape, D);
  const WorkingFrame<D, S> frame(a.pose, core_a.reference(), scale);
  WorldTrace<D, S> trace(frame, numbers, *sink);
  WarmStart<D, S> warm = warm_start<D, S>(simplex ? *simplex : settings.core_simplex, core_a, core_b, scale);
  const Result result = PairSolver<D, S, WorldTrace<D, S>>(core_a, core_b, a.pose, b.pose, scale, settings, trace, &features_a, &features_b, &warm).run(query);
  if (simplex) *simplex = simplex_points(warm, core_a, core_b, scale);
  return result;
}

/// Of two parts that overlap, one by a depth that was not asked for: its cores do, of the other no more than the radii, which they all share.
bool nearer(const Result& x, const Result& y) {
  if (x.signed_distance && y.signed_distance) return *x.signed_distance < *y.signed_distance;
  return x.intersecting && (!y.intersecting || (!x.signed_distance && y.signed_distance));
}

/// Of a part whose search came to its limit: whether what is known of it leaves open that it is nearer than `nearest`.
bool may_be_nearer(const Result& part, const Result& nearest) {
  if (part.status != word_of(GjkStatus::iteration_limit)) return false;  // EPA's and MPR's limits are called the same
  if (part.lower_bound && nearest.signed_distance) return *part.lower_bound < *nearest.signed_distance;
  return !nearest.intersecting;
}

/// The union of the parts: as near as its nearest part, and its bounds are the least of theirs. Where another part may be nearer the search of the
/// whole has come to its limit.
void merge(std::optional<Result>& total, const Result& part) {
  if (!total) {
    total = part;
    return;
  }
  const bool takes_over = nearer(part, *total);
  const Result& other = takes_over ? *total : part;
  Result merged = takes_over ? part : *total;
  if (may_be_nearer(other, merged)) merged.status = other.status;
  merged.iterations = total->iterations + part.iterations;
  merged.support_calls = total->support_calls + part.support_calls;
  if (part.lower_bound && total->lower_bound) merged.lower_bound = std::min(*part.lower_bound, *total->lower_bound);
  else merged.lower_bound.reset();  // what is not known of a part is not known of the whole
  if (part.upper_bound && total->upper_bound) merged.upper_bound = std::min(*part.upper_bound, *total->upper_bound);
  total = merged;
}

/// Of all parts that are touched along the answer's normal: what lies on several triangles of a flat, or on the edge between two, is a contact with each.
std::vector<ContactPoint> joined_contacts(const std::vector<Result>& parts, const Result& total, const Scene& scene) {
  if (parts.size() == 1) return *parts[0].contacts;
  if (parts.empty() || !total.normal) return {};  // none touches, or one overlaps by a depth that was not asked for
  std::vector<ContactPoint> contacts;
  const double apart = least_apart(size_of(scene.bodies[0].shape), size_of(scene.bodies[1].shape), total.witness_a->stableNorm());
  double size = 0;
  for (const Result& part : parts) {
    if ((*part.normal - *total.normal).norm() > 1e-6) continue;
    for (const ContactPoint& point : *part.contacts) {
      size = std::max(size, (point.point_a - *total.witness_a).stableNorm());
      const auto same = [&](const ContactPoint& other) { return (other.point_a - point.point_a).stableNorm() <= std::max(apart, 1e-9 * size); };
      if (std::none_of(contacts.begin(), contacts.end(), same)) contacts.push_back(point);
    }
  }
  return contacts;
}

template <int D, class S>
Result solve_scene(const Scene& scene, const Settings& settings, TraceSink* sink, TraceNumbers& numbers, std::vector<SimplexPoint>* simplex) {
  const Body &a = scene.bodies[0], &b = scene.bodies[1];
  const std::vector<Shape> parts_a = convex_parts(a.shape), parts_b = convex_parts(b.shape);
  std::optional<Result> total;
  std::vector<Result> parts;
  std::vector<SimplexPoint> none;
  const auto is_mesh = [](const Body& body) { return std::holds_alternative<Mesh>(body.shape.geometry); };
  if (is_mesh(a) || is_mesh(b)) simplex = &none;  // a given simplex was not held against its triangles
  for (const Shape& part_a : parts_a)
    for (const Shape& part_b : parts_b) {
      const Body one{a.name, part_a, a.pose}, other{b.name, part_b, b.pose};
      none.clear();
      Result result = solve_convex<D, S>(one, other, scene.query, settings, sink, numbers, simplex);
      numbers.next_run();
      if (scene.query == Query::contact && result.intersecting && result.normal) result.contacts = contact_points(one, other, result);
      merge(total, result);
      if (scene.query == Query::intersect && total->intersecting) return *total;
      if (result.contacts) parts.push_back(std::move(result));
    }
  if (scene.query == Query::contact) total->contacts = joined_contacts(parts, *total, scene);
  return *total;
}

template <int D, class S>
double floor_of(const Scene& scene) {
  const Body &body_a = scene.bodies[0], &body_b = scene.bodies[1];
  const double scale = working_scale<S>(body_a, body_b);
  const Convex<D, S> a(convex_parts(body_a.shape)[0], scale), b(convex_parts(body_b.shape)[0], scale);
  return static_cast<double>(MinkowskiDifference<D, S, Convex<D, S>>(a, b, body_a.pose, body_b.pose, scale).rounding_floor()) / scale;
}

}  // namespace

double rounding_floor(const Scene& scene, const Settings& settings) {
  const bool single = settings.scalar == Scalar::float_precision;
  switch (scene.dimension) {
    case 1: return single ? floor_of<1, float>(scene) : floor_of<1, double>(scene);
    case 2: return single ? floor_of<2, float>(scene) : floor_of<2, double>(scene);
    default: return single ? floor_of<3, float>(scene) : floor_of<3, double>(scene);
  }
}

Result solve_static(const Scene& scene, const Settings& settings, TraceSink* sink, TraceNumbers& numbers, std::vector<SimplexPoint>* simplex) {
  if (settings.start != Start::previous) simplex = nullptr;
  assert(scene.bodies.size() == 2);
  const bool single = settings.scalar == Scalar::float_precision;
  switch (scene.dimension) {
    case 1: return single ? solve_scene<1, float>(scene, settings, sink, numbers, simplex) : solve_scene<1, double>(scene, settings, sink, numbers, simplex);
    case 2: return single ? solve_scene<2, float>(scene, settings, sink, numbers, simplex) : solve_scene<2, double>(scene, settings, sink, numbers, simplex);
    default: return single ? solve_scene<3, float>(scene, settings, sink, numbers, simplex) : solve_scene<3, double>(scene, settings, sink, numbers, simplex);
  }
}

namespace {

Result solve_any(const Scene& scene, const Settings& settings, TraceSink* sink) {
  if (scene.query == Query::cast) return cast(scene, settings, sink);
  if (scene.query == Query::simulate) return simulate(scene, settings, sink);
  TraceNumbers numbers;
  return solve_static(scene, settings, sink, numbers);
}

}  // namespace

Result solve(const Scene& scene, const Settings& settings) { return solve_any(scene, settings, nullptr); }

Result solve(const Scene& scene, const Settings& settings, TraceSink& trace) {
  for (const SceneWarning& warning : scene.warnings) trace(world::Warning{warning.code, warning.message});
  return solve_any(scene, settings, &trace);
}

}  // namespace gjkdbg
