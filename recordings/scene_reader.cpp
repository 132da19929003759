#include <algorithm>
#include <cmath>

#include "recordings/json_reading.h"
#include "recordings/scene_file.h"
#include "shapes/obj_file.h"

namespace gjkdbg {
namespace {

/// An angle of a rotation. Whole turns are taken off while they are exact, in degrees.
double turn_from_degrees(double degrees) { return radians_from_degrees(std::abs(degrees) > 360 ? std::fmod(degrees, 360) : degrees); }

constexpr int deepest_sum = 16;

/// Reads one scene; holds what every part needs.
class SceneReader {
 public:
  explicit SceneReader(const std::filesystem::path& directory) : directory_(directory) {}

  SceneFile read(const Json& json) {
    const Place root;
    ObjectReader o(json, root);
    if (read_string(o.required("format"), o.at("format")) != "gjk-scene") reject(o.at("format"), "wrong-format", "must be \"gjk-scene\"");
    read_integer(o.required("version"), o.at("version"), 1, 1);
    Scene& scene = file_.scene;
    scene.dimension = dimension_ = read_integer(o.required("dimension"), o.at("dimension"), 1, 3);
    if (const Json* q = o.optional("query")) scene.query = static_cast<Query>(read_enum(*q, o.at("query"), query_names));
    read_texts(json, root);
    const bool moving = scene.query == Query::cast || scene.query == Query::simulate;
    const Json& bodies = o.required("bodies");
    const Place at_bodies = o.at("bodies");
    if (!bodies.is_array()) reject(at_bodies, "wrong-type", "must be an array of bodies");
    const std::size_t least = scene.query == Query::simulate ? 1 : 2;
    if (bodies.size() < least || (!moving && bodies.size() != 2))
      reject(at_bodies, "wrong-count", std::string("must hold ") + (moving ? least == 1 ? "a body" : "two bodies or more" : "two bodies") + ", not " + std::to_string(bodies.size()));
    if (bodies.size() > 1000) reject(at_bodies, "wrong-count", "must hold at most 1000 bodies");
    for (std::size_t i = 0; i < bodies.size(); ++i) scene.bodies.push_back(body(bodies[i], Place(at_bodies, i), scene.query));
    if (moving) scene_motion(o);
    if (const Json* m = o.optional("method")) file_.method = read_method(*m, o.at("method"), dimension_);
    if (const Json* e = o.optional("expect")) expectation(*e, o.at("expect"));
    o.finish();
    keep_notes(json, "");
    file_.directory = directory_;
    return std::move(file_);
  }

 private:
  void read_texts(const Json& json, const Place& place) {
    const auto text = [&](const char* key, std::string& into) {
      if (const auto it = json.find(key); it != json.end()) into = read_string(*it, Place(place, key));
    };
    text("name", file_.scene.name);
    text("description", file_.scene.description);
    text("source", file_.scene.source);
    if (const auto it = json.find("id"); it != json.end()) file_.id = it->dump();
    if (const auto it = json.find("tags"); it != json.end()) file_.scene.tags = read_tags(*it, Place(place, "tags"));
  }

  /// Of what was read and found right. The scene has its own, the bodies' names, and the method's, which is no note.
  void keep_notes(const Json& json, const std::string& pointer) {
    if (json.is_array() && (json.empty() || !json[0].is_object())) return;
    const bool named = pointer.empty() || pointer == "/method" || (pointer.starts_with("/bodies/") && pointer.rfind('/') == std::string_view("/bodies").size());
    Json notes = Json::object();
    for (const auto& [key, value] : json.items()) {
      const bool note = json.is_object() && std::find(note_names.begin(), note_names.end(), key) != note_names.end();
      if (note && !pointer.empty() && !(named && key == "name")) notes[key] = value;
      else if (!note && value.is_structured()) keep_notes(value, pointer + "/" + key);
    }
    if (!notes.empty()) file_.notes[pointer] = notes.dump();
  }

  double at_least(ObjectReader& o, const char* key, double value, double low, double high) {
    const Json* j = o.optional(key);
    if (!j) return value;
    const double x = read_number(*j, o.at(key));
    if (!(x >= low && x <= high)) reject(o.at(key), "out-of-range", "must lie between " + Json(low).dump() + " and " + Json(high).dump());
    return x;
  }
  AnyVector bounded(const Json& json, const Place& place, int size) {
    AnyVector v = read_vector(json, place, size);
    // Places, speeds and energies of a whole simulation stay far from overflow.
    if (v.cwiseAbs().maxCoeff() > 1e15) reject(place, "out-of-range", "must not be beyond 1e15");
    return v;
  }

  void scene_motion(ObjectReader& o) {
    SceneMotion m;
    m.gravity = AnyVector::Zero(dimension_);
    if (file_.scene.query == Query::cast) {
      if (const Json* j = o.optional("response")) m.response = static_cast<Response>(read_enum(*j, o.at("response"), response_names));
    } else {
      if (const Json* j = o.optional("gravity")) m.gravity = bounded(*j, o.at("gravity"), dimension_);
      m.time_step = at_least(o, "time_step", m.time_step, 1e-12, 1e6);
      if (const Json* j = o.optional("steps")) m.steps = read_integer(*j, o.at("steps"), 1, 1000000);
      if (const Json* j = o.optional("integrator")) m.integrator = static_cast<Integrator>(read_enum(*j, o.at("integrator"), integrator_names));
    }
    file_.scene.motion = m;
  }

  /// Degrees in files, radians here. In 2D a number.
  AnyVector angular_velocity(const Json& json, const Place& place) {
    if (dimension_ == 1) reject(place, "wrong-dimension", "nothing turns in one dimension");
    AnyVector w(dimension_ == 2 ? 1 : 3);
    if (dimension_ == 2 && json.is_number()) w = bounded(Json::array({json}), place, 1);
    else w = bounded(json, place, dimension_ == 2 ? 1 : 3);
    for (double& x : w) x = radians_from_degrees(x);
    return w;
  }

  Motion motion(ObjectReader& o, Query query) {
    Motion m;
    m.velocity = AnyVector::Zero(dimension_);
    m.angular_velocity = AnyVector::Zero(dimension_ == 1 ? 0 : dimension_ == 2 ? 1 : 3);
    if (const Json* j = o.optional("velocity")) m.velocity = bounded(*j, o.at("velocity"), dimension_);
    if (const Json* j = o.optional("angular_velocity")) m.angular_velocity = angular_velocity(*j, o.at("angular_velocity"));
    m.restitution = at_least(o, "restitution", m.restitution, 0, 1);
    if (query != Query::simulate) return m;
    m.mass = at_least(o, "mass", m.mass, 1e-30, 1e30);
    m.friction = at_least(o, "friction", m.friction, 0, 1e15);
    if (const Json* j = o.optional("static")) m.is_static = read_bool(*j, o.at("static"));
    return m;
  }

  Body body(const Json& json, const Place& place, Query query) {
    ObjectReader o(json, place);
    Body b;
    if (const auto it = json.find("name"); it != json.end()) b.name = read_string(*it, o.at("name"));
    const Place at_shape = o.at("shape");
    b.shape = shape(o.required("shape"), at_shape, 0);
    try {
      validate(b.shape, dimension_);
    } catch (const Error& e) {
      throw e.within(at_shape.pointer());
    }
    const Json* pose_json = o.optional("pose");
    b.pose = pose_json ? pose(*pose_json, o.at("pose")) : identity_pose(dimension_);
    if (query == Query::cast || query == Query::simulate) b.motion = motion(o, query);
    o.finish();
    return b;
  }

  Shape shape(const Json& json, const Place& place, int depth) {
    if (depth > deepest_sum) reject(place, "too-deep", "sums are nested too deeply");
    ObjectReader o(json, place);
    const std::string type = read_string(o.required("type"), o.at("type"));
    Shape s;
    if (const Json* m = o.optional("margin")) s.margin = read_number(*m, o.at("margin"));
    geometry(type, o, s, depth);
    o.finish();
    return s;
  }

  void geometry(const std::string& type, ObjectReader& o, Shape& s, int depth) {
    const bool plane = dimension_ == 2, space = dimension_ == 3;
    if (type == "interval" && dimension_ == 1) {
      s.geometry = Box{read_interval_end(o, "min"), read_interval_end(o, "max"), false};
    } else if ((type == "sphere" && space) || (type == "circle" && plane)) {
      s.geometry = Sphere{number(o, "radius")};
    } else if (type == "box" && dimension_ > 1) {
      s.geometry = box(o);
    } else if (type == "capsule" && dimension_ > 1) {
      s.geometry = Capsule{number(o, "radius"), number(o, "half_height"), axis(o)};
    } else if (type == "cylinder" && space) {
      s.geometry = Cylinder{number(o, "radius"), number(o, "half_height"), axis(o)};
    } else if (type == "cone" && space) {
      s.geometry = Cone{number(o, "radius"), number(o, "half_height"), axis(o)};
    } else if ((type == "ellipsoid" && space) || (type == "ellipse" && plane)) {
      s.geometry = Ellipsoid{read_vector(o.required("radii"), o.at("radii"), dimension_)};
    } else if (type == "sum") {
      s.geometry = sum(o, depth);
    } else if (type == "mesh" && space) {
      s.geometry = mesh(o);
    } else if (!point_set(type, o, s)) {
      unknown_type(type, o);
    }
  }

  [[noreturn]] void unknown_type(const std::string& type, ObjectReader& o) {
    static const std::vector<std::string_view> names[] = {
        {"interval", "sum"},
        {"circle", "ellipse", "box", "capsule", "point", "segment", "triangle", "polygon", "sum"},
        {"sphere", "box", "capsule", "cylinder", "cone", "ellipsoid", "point", "segment", "triangle", "hull", "mesh", "sum"}};
    std::string list;
    for (const auto name : names[dimension_ - 1]) list += (list.empty() ? "" : ", ") + std::string(name);
    bool elsewhere = false;
    for (const auto& in : names) elsewhere = elsewhere || std::find(in.begin(), in.end(), type) != in.end();
    const std::string near = nearest_name(type, names[dimension_ - 1]);
    reject(o.at("type"), elsewhere ? "wrong-dimension" : "unknown-type",
           "\"" + type + "\" is no shape of a " + std::to_string(dimension_) + "D scene (" + list + ")" +
               (elsewhere || near.empty() ? "" : "; did you mean \"" + near + "\"?"));
  }

  double number(ObjectReader& o, const char* key) { return read_number(o.required(key), o.at(key)); }

  AnyVector read_interval_end(ObjectReader& o, const char* key) {
    const Json& json = o.required(key);
    if (json.is_array()) return read_vector(json, o.at(key), 1);
    return AnyVector::Constant(1, read_number(json, o.at(key)));
  }

  int axis(ObjectReader& o) {
    const Json* json = o.optional("axis");
    if (!json) return 1;
    return static_cast<int>(read_enum(*json, o.at("axis"), std::array<std::string_view, 3>{"x", "y", "z"}));
  }

  Box box(ObjectReader& o) {
    if (o.has("half_extents") && (o.has("min") || o.has("max")))
      reject(o.at("half_extents"), "conflicting-fields", "give either half_extents or min and max");
    if (o.has("min") || o.has("max"))
      return {read_vector(o.required("min"), o.at("min"), dimension_), read_vector(o.required("max"), o.at("max"), dimension_), false};
    const AnyVector half = read_vector(o.required("half_extents"), o.at("half_extents"), dimension_);
    return {-half, half, true};
  }

  Sum sum(ObjectReader& o, int depth) {
    const Json& of = o.required("of");
    const Place at = o.at("of");
    if (!of.is_array() || of.size() != 2) reject(at, "wrong-count", "must be an array of two shapes");
    return {std::make_shared<const Shape>(shape(of[0], Place(at, std::size_t{0}), depth + 1)),
            std::make_shared<const Shape>(shape(of[1], Place(at, std::size_t{1}), depth + 1))};
  }

  std::vector<AnyVector> points(const Json& json, const Place& at) {
    if (!json.is_array()) reject(at, "wrong-type", "must be an array of points");
    std::vector<AnyVector> list;
    for (std::size_t i = 0; i < json.size(); ++i) list.push_back(read_vector(json[i], Place(at, i), dimension_));
    return list;
  }

  ObjMesh obj(const Json& json, const Place& at, std::string& name) {
    name = read_string(json, at);
    if (name.find('\0') != std::string::npos) reject(at, "bad-value", "must not hold a NUL");  // a file's name would end there
    try {
      return read_obj(directory_ / name);
    } catch (const Error& e) {
      throw Error(e.code(), e.line(), at.pointer());
    }
  }

  bool point_set(const std::string& type, ObjectReader& o, Shape& s) {
    static constexpr std::string_view kinds[] = {"point", "segment", "triangle", "polygon", "hull"};
    const auto kind = std::find(std::begin(kinds), std::end(kinds), type) - std::begin(kinds);
    if (kind == std::ssize(kinds) || dimension_ == 1) return false;
    PointSet set;
    set.kind = static_cast<PointSetKind>(kind);
    if ((set.kind == PointSetKind::polygon && dimension_ != 2) || (set.kind == PointSetKind::hull && dimension_ != 3)) return false;
    const Json* file = set.kind == PointSetKind::hull ? o.optional("mesh") : nullptr;
    if (file && o.has("points")) reject(o.at("mesh"), "conflicting-fields", "give either points or mesh");
    if (file) {
      set.points = obj(*file, o.at("mesh"), set.mesh).points;
    } else if (set.kind == PointSetKind::point && !o.has("points")) {
      o.optional("points");
      set.points = {AnyVector::Zero(dimension_)};
    } else {
      set.points = points(o.required("points"), o.at("points"));
    }
    s.geometry = std::move(set);
    return true;
  }

  Mesh mesh(ObjectReader& o) {
    Mesh m;
    if (const Json* file = o.optional("mesh")) {
      if (o.has("points") || o.has("triangles")) reject(o.at("mesh"), "conflicting-fields", "give either points and triangles or mesh");
      ObjMesh read = obj(*file, o.at("mesh"), m.mesh);
      m.points = std::move(read.points), m.triangles = std::move(read.triangles);
      return m;
    }
    m.points = points(o.required("points"), o.at("points"));
    const Json& list = o.required("triangles");
    const Place at = o.at("triangles");
    if (!list.is_array()) reject(at, "wrong-type", "must be an array of index triples");
    for (std::size_t t = 0; t < list.size(); ++t) {
      const Place here(at, t);
      if (!list[t].is_array() || list[t].size() != 3) reject(here, "wrong-count", "must be three indices");
      std::array<int, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = read_integer(list[t][k], Place(here, k), 0, static_cast<int>(m.points.size()) - 1);
      m.triangles.push_back(triangle);
    }
    return m;
  }

  Pose pose(const Json& json, const Place& place) {
    ObjectReader o(json, place);
    Pose p = identity_pose(dimension_);
    if (const Json* position = o.optional("position")) {
      const Place at = o.at("position");
      p.position = read_vector(*position, at, dimension_);
      for (int i = 0; i < dimension_; ++i)
        if (std::abs(p.position[i]) > largest_length) reject(Place(at, static_cast<std::size_t>(i)), "too-large", "must not exceed 1e60 in magnitude");
    }
    if (const Json* r = o.optional("rotation")) {
      const Place at = o.at("rotation");
      p.rotation = rotation(*r, at);
      try {
        const ResolvedRotation resolved = resolve(p.rotation, dimension_);
        p.matrix = resolved.matrix;
        if (resolved.correction > 4e-15) warn_rotation(at, resolved.correction);
      } catch (const Error& e) {
        throw e.within(at.pointer());
      }
    }
    o.finish();
    return p;
  }

  void warn_rotation(const Place& at, double correction) {
    std::ostringstream message;
    message << at.pointer() << " was off by " << correction << " and has been orthonormalised";
    file_.scene.warnings.push_back({"rotation-orthonormalised", message.str()});
  }

  Rotation rotation(const Json& json, const Place& place) {
    ObjectReader o(json, place);
    const int given = o.has("quaternion") + o.has("matrix") + o.has("axis") + o.has("euler") + (o.has("angle") && !o.has("axis"));
    if (given != 1) reject(place, "conflicting-fields", "needs exactly one of quaternion, matrix, axis and angle, euler, angle (2D)");
    Rotation r;
    if (const Json* q = o.optional("quaternion")) {
      r = quaternion(*q, o.at("quaternion"));
    } else if (const Json* m = o.optional("matrix")) {
      r = matrix(*m, o.at("matrix"));
    } else if (const Json* a = o.optional("axis")) {
      r = AxisAngle{read_vector(*a, o.at("axis"), 3), turn_from_degrees(number(o, "angle"))};
    } else if (const Json* e = o.optional("euler")) {
      r = euler(*e, o.at("euler"));
    } else {
      r = PlaneAngle{turn_from_degrees(number(o, "angle"))};
    }
    o.finish();
    return r;
  }

  Quaternion quaternion(const Json& json, const Place& place) {
    if (!json.is_array() || json.size() != 4) reject(place, "wrong-count", "must have 4 numbers: w, x, y, z");
    Quaternion q;
    for (std::size_t i = 0; i < 4; ++i) q.wxyz[i] = read_number(json[i], Place(place, i));
    return q;
  }

  RotationMatrix matrix(const Json& json, const Place& place) {
    const auto n = static_cast<std::size_t>(dimension_);
    if (!json.is_array() || json.size() != n) reject(place, "wrong-count", "must have " + std::to_string(n) + " rows");
    RotationMatrix r{AnyMatrix(dimension_, dimension_)};
    for (std::size_t i = 0; i < n; ++i) r.rows.row(static_cast<Eigen::Index>(i)) = read_vector(json[i], Place(place, i), dimension_);
    return r;
  }

  Euler euler(const Json& json, const Place& place) {
    ObjectReader o(json, place);
    Euler e;
    if (const Json* order = o.optional("order")) e.order = read_string(*order, o.at("order"));
    if (const Json* frame = o.optional("frame"))
      e.intrinsic = read_enum(*frame, o.at("frame"), std::array<std::string_view, 2>{"intrinsic", "extrinsic"}) == 0;
    const AnyVector angles = read_vector(o.required("angles"), o.at("angles"), 3);
    for (int i = 0; i < 3; ++i) e.angles[static_cast<std::size_t>(i)] = turn_from_degrees(angles[i]);
    o.finish();
    return e;
  }

  void expectation(const Json& json, const Place& place) {
    ObjectReader o(json, place);
    Expectation e;
    if (const Json* j = o.optional("intersecting")) e.intersecting = read_bool(*j, o.at("intersecting"));
    if (const Json* j = o.optional("signed_distance")) e.signed_distance = read_number(*j, o.at("signed_distance"));
    if (const Json* j = o.optional("normal")) e.normal = read_vector(*j, o.at("normal"), dimension_);
    if (const Json* j = o.optional("time")) e.time = read_number(*j, o.at("time"));
    if (const Json* j = o.optional("tolerance")) e.tolerance = read_number(*j, o.at("tolerance"));
    if (!(e.tolerance >= 0)) reject(o.at("tolerance"), "out-of-range", "must not be negative");
    o.finish();
    file_.expect = e;
  }

  const std::filesystem::path& directory_;
  int dimension_ = 3;
  SceneFile file_;
};

}  // namespace

SceneFile scene_from_json(const Json& json, const std::filesystem::path& directory) { return SceneReader(directory).read(json); }

}  // namespace gjkdbg
