#include "debugger/lab/measure.h"

#include <algorithm>
#include <cmath>

#include "algo/solve.h"
#include "shapes/convex.h"

namespace gjkdbg {
std::vector<Variant> variants() {
  std::vector<Variant> out;
  for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
    const std::string suffix = scalar == Scalar::double_precision ? "" : ", float";
    const auto add = [&](const std::string& name, MethodName method, ClosestPoint part) {
      Variant v{name + suffix, {}};
      v.method.name = method, v.method.closest_point = part, v.method.scalar = scalar;
      out.push_back(v);
    };
    add("signed volumes", MethodName::gjk, ClosestPoint::signed_volumes);
    add("Johnson", MethodName::gjk, ClosestPoint::johnson);
    add("Voronoi regions", MethodName::gjk, ClosestPoint::voronoi);
    add("accelerated", MethodName::gjk_accelerated, ClosestPoint::signed_volumes);
  }
  return out;
}

double scene_size(const Scene& scene) {
  const double size = std::max(size_of(scene.bodies[0].shape), size_of(scene.bodies[1].shape));
  return size > 0 ? size : 1;
}

double Reference::error(double value, double size) const {
  if (!std::isfinite(value)) return INFINITY;
  return std::max({0.0, lower - value, value - upper}) / std::max(size, std::abs(signed_distance));
}

Reference reference(const Scene& scene) {
  Method method;
  method.tolerance = 1e-15;
  method.max_iterations = 2000;
  Scene copy = scene;
  copy.query = Query::penetration;
  const Result r = solve(copy, resolve_settings(method, copy));
  return {*r.signed_distance, *r.lower_bound, *r.upper_bound};
}

}  // namespace gjkdbg
