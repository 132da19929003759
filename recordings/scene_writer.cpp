#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "recordings/json_reading.h"
#include "recordings/scene_file.h"

namespace gjkdbg {

double radians_from_degrees(double degrees) {
  const double quarters = degrees / 90;
  return quarters == std::nearbyint(quarters) ? quarters * (std::numbers::pi / 2) : degrees * (std::numbers::pi / 180);
}

double degrees_from_radians(double radians) {
  // Several decimals lead to the same radians; the shortest that does is what a person wrote. Else search next to the quotient.
  const double near = radians * (180 / std::numbers::pi);
  for (const double decimals : {1.0, 1e3, 1e6, 1e9, 1e12})
    if (const double rounded = std::nearbyint(near * decimals) / decimals; radians_from_degrees(rounded) == radians) return rounded;
  double below = near, above = near;
  for (int i = 0; i < 8; ++i) {
    if (radians_from_degrees(below) == radians) return below;
    if (radians_from_degrees(above) == radians) return above;
    below = std::nextafter(below, -INFINITY), above = std::nextafter(above, INFINITY);
  }
  return near;
}

namespace {

Json json_of(const AnyVector& v) {
  Json list = Json::array();
  for (const double x : v) list.push_back(x);
  return list;
}

Json json_of(const std::vector<AnyVector>& points) {
  Json list = Json::array();
  for (const AnyVector& p : points) list.push_back(json_of(p));
  return list;
}

struct ShapeWriter {
  int dimension;
  MeshNotation notation;

  Json write(const Shape& shape) const {
    Json out{{"type", type_name(shape, dimension)}};
    std::visit([&](const auto& g) { geometry(out, g); }, shape.geometry);
    if (shape.margin != 0) out["margin"] = shape.margin;
    return out;
  }

 private:
  void geometry(Json& out, const Sphere& s) const { out["radius"] = s.radius; }
  void geometry(Json& out, const Box& b) const {
    if (dimension == 1) {
      out["min"] = b.min[0], out["max"] = b.max[0];
    } else if (b.from_half_extents) {
      out["half_extents"] = json_of(b.max);
    } else {
      out["min"] = json_of(b.min), out["max"] = json_of(b.max);
    }
  }
  template <class AlongAxis>
  void along_axis(Json& out, const AlongAxis& s) const {
    out["radius"] = s.radius, out["half_height"] = s.half_height;
    if (s.axis != 1) out["axis"] = std::string(1, "xyz"[s.axis]);
  }
  void geometry(Json& out, const Capsule& s) const { along_axis(out, s); }
  void geometry(Json& out, const Cylinder& s) const { along_axis(out, s); }
  void geometry(Json& out, const Cone& s) const { along_axis(out, s); }
  void geometry(Json& out, const Ellipsoid& e) const { out["radii"] = json_of(e.radii); }
  void geometry(Json& out, const PointSet& set) const {
    if (set.mesh.empty() || notation == MeshNotation::in_place) {
      out["points"] = json_of(set.points);
    } else {
      out["mesh"] = set.mesh;
    }
  }
  void geometry(Json& out, const Mesh& mesh) const {
    if (!mesh.mesh.empty() && notation == MeshNotation::by_name) {
      out["mesh"] = mesh.mesh;
      return;
    }
    out["points"] = json_of(mesh.points);
    out["triangles"] = mesh.triangles;
  }
  void geometry(Json& out, const Sum& sum) const { out["of"] = Json::array({write(*sum.first), write(*sum.second)}); }
};

struct RotationWriter {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(const Quaternion& q) const { return {{"quaternion", q.wxyz}}; }
  Json operator()(const RotationMatrix& m) const {
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < m.rows.rows(); ++i) rows.push_back(json_of(AnyVector(m.rows.row(i).transpose())));
    return {{"matrix", rows}};
  }
  Json operator()(const AxisAngle& a) const { return {{"axis", json_of(a.axis)}, {"angle", degrees_from_radians(a.angle)}}; }
  Json operator()(const Euler& e) const {
    Json angles = Json::array();
    for (const double a : e.angles) angles.push_back(degrees_from_radians(a));
    return {{"euler", {{"order", e.order}, {"frame", e.intrinsic ? "intrinsic" : "extrinsic"}, {"angles", angles}}}};
  }
  Json operator()(const PlaneAngle& a) const { return {{"angle", degrees_from_radians(a.angle)}}; }
};

/// What differs from rest and the defaults.
void write_motion(Json& out, const Motion& m) {
  if (!m.velocity.isZero(0)) out["velocity"] = json_of(m.velocity);
  if (m.angular_velocity.size() > 0 && !m.angular_velocity.isZero(0)) {
    Json degrees = Json::array();
    for (const double x : m.angular_velocity) degrees.push_back(degrees_from_radians(x));
    out["angular_velocity"] = m.angular_velocity.size() == 1 ? degrees[0] : degrees;
  }
  if (m.mass != 1) out["mass"] = m.mass;
  if (m.restitution != 0) out["restitution"] = m.restitution;
  if (m.friction != 0) out["friction"] = m.friction;
  if (m.is_static) out["static"] = true;
}

Json json_of(const Body& body, int dimension, MeshNotation notation) {
  Json out = Json::object();
  if (!body.name.empty()) out["name"] = body.name;
  out["shape"] = ShapeWriter{dimension, notation}.write(body.shape);
  out["pose"] = {{"position", json_of(body.pose.position)}};
  // Bodies that were turned in memory have the rotation as numbers only.
  const bool as_given = resolve(body.pose.rotation, dimension).matrix == body.pose.matrix;
  const Rotation written = as_given ? body.pose.rotation : Rotation(RotationMatrix{body.pose.matrix});
  if (const Json rotation = std::visit(RotationWriter{}, written); !rotation.is_null()) out["pose"]["rotation"] = rotation;
  if (body.motion) write_motion(out, *body.motion);
  return out;
}

Json json_of(const Method& m) {
  Json out = Json::object();
  if (m.name) out["name"] = word_of(*m.name);
  if (m.closest_point) out["closest_point"] = word_of(*m.closest_point);
  if (m.penetration) out["penetration"] = word_of(*m.penetration);
  if (m.scalar) out["scalar"] = word_of(*m.scalar);
  if (m.stopping) out["stopping"] = word_of(*m.stopping);
  if (m.acceleration) out["acceleration"] = word_of(*m.acceleration);
  if (m.tolerance) out["tolerance"] = *m.tolerance;
  if (m.max_iterations) out["max_iterations"] = *m.max_iterations;
  if (m.initial_direction) out["initial_direction"] = json_of(*m.initial_direction);
  if (m.start) out["start"] = word_of(*m.start);
  for (const SimplexPoint& p : m.initial_simplex) out["initial_simplex"].push_back({{"a", json_of(p.a)}, {"b", json_of(p.b)}});
  return out;
}

Json json_of(const Expectation& e) {
  Json out = Json::object();
  if (e.intersecting) out["intersecting"] = *e.intersecting;
  if (e.signed_distance) out["signed_distance"] = *e.signed_distance;
  if (e.normal) out["normal"] = json_of(*e.normal);
  if (e.time) out["time"] = *e.time;
  out["tolerance"] = e.tolerance;
  return out;
}

}  // namespace

Json scene_to_json(const SceneFile& file, MeshNotation notation) {
  const Scene& scene = file.scene;
  Json out{{"format", "gjk-scene"}, {"version", 1}};
  if (!file.id.empty()) out["id"] = Json::parse(file.id);
  if (!scene.name.empty()) out["name"] = scene.name;
  if (!scene.description.empty()) out["description"] = scene.description;
  if (!scene.source.empty()) out["source"] = scene.source;
  if (!scene.tags.empty()) out["tags"] = scene.tags;
  out["dimension"] = scene.dimension;
  out["query"] = word_of(scene.query);
  out["bodies"] = Json::array();
  for (const Body& body : scene.bodies) out["bodies"].push_back(json_of(body, scene.dimension, notation));
  if (scene.motion && scene.query == Query::cast && scene.motion->response != Response::stop) out["response"] = word_of(scene.motion->response);
  if (scene.motion && scene.query == Query::simulate) {
    if (!scene.motion->gravity.isZero(0)) out["gravity"] = json_of(scene.motion->gravity);
    out["time_step"] = scene.motion->time_step;
    out["steps"] = scene.motion->steps;
    out["integrator"] = word_of(scene.motion->integrator);
  }
  if (const Json method = json_of(file.method); !method.empty()) out["method"] = method;
  if (file.expect) out["expect"] = json_of(*file.expect);
  for (const auto& [pointer, text] : file.notes) {
    const Json::json_pointer place(pointer);
    if (!out.contains(place) || !out[place].is_object()) continue;  // written in another way
    Json noted = Json::parse(text);
    noted.update(out[place]);
    out[place] = noted;
  }
  return out;
}

}  // namespace gjkdbg
