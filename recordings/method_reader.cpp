#include "recordings/json_reading.h"
#include "recordings/scene_file.h"

namespace gjkdbg {
namespace {

std::vector<SimplexPoint> read_simplex(const Json& json, const Place& place, int dimension) {
  if (!json.is_array()) reject(place, "wrong-type", "must be an array of {a, b}");
  std::vector<SimplexPoint> points;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const Place at(place, i);
    ObjectReader o(json[i], at);
    points.push_back({read_vector(o.required("a"), o.at("a"), dimension), read_vector(o.required("b"), o.at("b"), dimension)});
    o.finish();
  }
  return points;
}

}  // namespace

Method read_method(const Json& json, const Place& place, int dimension) {
  ObjectReader o(json, place);
  Method m;
  if (const Json* j = o.optional("name")) m.name = static_cast<MethodName>(read_enum(*j, o.at("name"), method_names));
  if (const Json* j = o.optional("closest_point")) m.closest_point = static_cast<ClosestPoint>(read_enum(*j, o.at("closest_point"), closest_point_names));
  if (const Json* j = o.optional("penetration")) m.penetration = static_cast<Penetration>(read_enum(*j, o.at("penetration"), penetration_names));
  if (const Json* j = o.optional("scalar")) m.scalar = static_cast<Scalar>(read_enum(*j, o.at("scalar"), scalar_names));
  if (const Json* j = o.optional("stopping")) m.stopping = static_cast<Stopping>(read_enum(*j, o.at("stopping"), stopping_names));
  if (const Json* j = o.optional("acceleration")) m.acceleration = static_cast<Acceleration>(read_enum(*j, o.at("acceleration"), acceleration_names));
  if (const Json* j = o.optional("tolerance")) m.tolerance = read_number(*j, o.at("tolerance"));
  if (const Json* j = o.optional("max_iterations")) m.max_iterations = read_integer(*j, o.at("max_iterations"), 1, 1000000);
  if (const Json* j = o.optional("initial_direction"); j && !j->is_null())
    m.initial_direction = read_vector(*j, o.at("initial_direction"), dimension);
  if (const Json* j = o.optional("start")) m.start = static_cast<Start>(read_enum(*j, o.at("start"), start_names));
  if (const Json* j = o.optional("initial_simplex")) m.initial_simplex = read_simplex(*j, o.at("initial_simplex"), dimension);
  o.finish();
  return m;
}

Method method_from_json(const Json& json, const std::string& pointer, int dimension) {
  try {
    return read_method(json, Place(), dimension);
  } catch (const Error& e) {
    throw e.within(pointer);
  }
}

}  // namespace gjkdbg
