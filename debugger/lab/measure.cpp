#include "debugger/lab/measure.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "algo/solve.h"
#include "shapes/convex.h"
#include "shapes/error.h"

namespace gjkdbg {

std::vector<Variant> variants(bool in_atlas) {
  std::vector<Variant> out;
  for (const Scalar scalar : {Scalar::double_precision, Scalar::float_precision}) {
    const std::string suffix = scalar == Scalar::double_precision ? "" : ", float";
    const auto add = [&](const std::string& name, MethodName method, ClosestPoint part = ClosestPoint::signed_volumes) -> Method& {
      Variant v{name + suffix, {}};
      v.method.name = method, v.method.closest_point = part, v.method.scalar = scalar;
      out.push_back(v);
      return out.back().method;
    };
    add("signed volumes", MethodName::gjk);
    add("Johnson", MethodName::gjk, ClosestPoint::johnson);
    add("Voronoi regions", MethodName::gjk, ClosestPoint::voronoi);
    add("accelerated", MethodName::gjk_accelerated);
    add("Polyak", MethodName::gjk_accelerated).acceleration = Acceleration::polyak;
    add("Newton", MethodName::gjk_accelerated).acceleration = Acceleration::newton;
    add("smoothed", MethodName::gjk_accelerated).acceleration = Acceleration::smoothed;
    add("MPR", MethodName::mpr);
    add("SAT", MethodName::sat);
    add("closed form", MethodName::closed_form);
    add("projections", MethodName::projections);
    add("fastest", MethodName::fastest).closest_point.reset();  // all but the scalar is its choice
    if (in_atlas) add("yes or no", MethodName::gjk_boolean), add("root finding", MethodName::root_finding), add("ray cast", MethodName::ray_cast);
    if (scalar == Scalar::double_precision)
      for (const auto& [whose, rule] : std::initializer_list<std::pair<const char*, Stopping>>{{"van den Bergen", Stopping::van_den_bergen}, {"Bullet", Stopping::bullet}, {"Jolt", Stopping::jolt}, {"openGJK", Stopping::opengjk}})
        add(std::string("rule of ") + whose, MethodName::gjk).stopping = rule;
  }
  for (const Peer& peer : peers()) out.push_back({peer.name, {}, &peer});
  return out;
}

namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// "johnson,sat, float" are "johnson" and "sat, float": what follows a comma is a name of its own, but for the scalar.
std::vector<std::string> apart(const std::vector<std::string>& lists) {
  std::vector<std::string> names;
  for (const std::string& list : lists)
    for (std::size_t from = 0; from <= list.size();) {
      const std::size_t comma = std::min(list.find(',', from), list.size());
      const std::size_t begin = std::min(list.find_first_not_of(' ', from), comma);
      const std::string name = list.substr(begin, comma - begin);
      if (from > 0 && lower(name) == "float") names.back() += ", float";
      else names.push_back(name);
      from = comma + 1;
    }
  return names;
}

}  // namespace

std::vector<Variant> chosen(const std::vector<Variant>& all, const std::vector<std::string>& lists) {
  if (lists.empty()) return all;
  const std::vector<std::string> names = apart(lists);
  std::vector<bool> wanted(all.size(), false);
  for (const std::string& name : names) {
    bool found = false;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (name.empty() ? false : lower(name) == "default" ? i == 0 : lower(all[i].name).starts_with(lower(name))) wanted[i] = found = true;
    if (found) continue;
    std::string list = "default";
    for (const Variant& v : all) list += "; " + v.name;
    throw Error("no-such-method", "no method has this name; there are " + list, name);
  }
  std::vector<Variant> out;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (wanted[i]) out.push_back(all[i]);
  return out;
}

bool applies(const Variant& variant, const Scene& scene) {
  if (variant.peer) return true;
  try {
    (void)resolve_settings(variant.method, scene);
    return true;
  } catch (const Error&) {
    return false;
  }
}

double scene_size(const Scene& scene) {
  const double size = std::max(size_of(scene.bodies[0].shape), size_of(scene.bodies[1].shape));
  return size > 0 ? size : 1;
}

double Reference::error(double value, double size) const {
  if (!std::isfinite(value)) return INFINITY;
  return std::max({0.0, lower - value, value - upper}) / std::max(size, std::abs(signed_distance));
}

Method reference_method() {
  Method method;
  method.tolerance = 1e-15;
  method.max_iterations = 2000;
  return method;
}

Reference reference(const Scene& scene) {
  Scene copy = scene;
  copy.query = Query::penetration;
  const Result r = solve(copy, resolve_settings(reference_method(), copy));
  return {*r.signed_distance, *r.lower_bound, *r.upper_bound};
}

}  // namespace gjkdbg
