#include <limits>

#include "recordings/json_reading.h"
#include "recordings/recording.h"
#include "shapes/input_file.h"

namespace gjkdbg {
namespace {

constexpr int largest_number = std::numeric_limits<int>::max();

/// Reads the fields of events; each overload is one type of field.
struct FieldReader {
  int dimension;

  void read(const Json& json, const Place& place, std::string_view, int& x) const { x = read_integer(json, place, 0, largest_number); }

  void read(const Json& json, const Place& place, std::string_view name, double& x) const {
    const bool bound = name == "lower_bound" || name == "upper_bound";
    x = bound ? number_or_null(json, place) : read_number(json, place);
  }

  void read(const Json& json, const Place& place, std::string_view name, AnyVector& v) const {
    if (name == "closest" && json.is_null()) {
      v = AnyVector();
    } else if (name == "direction" || name == "closest") {
      v = with_nulls(json, place);
    } else {
      v = read_vector(json, place, dimension);
    }
  }

  void read(const Json& json, const Place& place, std::string_view, std::string& text) const { text = read_string(json, place); }
  void read(const Json& json, const Place& place, std::string_view, Phase& p) const {
    p = static_cast<Phase>(read_enum(json, place, phase_names));
  }
  void read(const Json& json, const Place& place, std::string_view, GjkStatus& s) const {
    s = static_cast<GjkStatus>(read_enum(json, place, gjk_status_names));
  }
  void read(const Json& json, const Place& place, std::string_view, EpaStatus& s) const {
    s = static_cast<EpaStatus>(read_enum(json, place, epa_status_names));
  }
  void read(const Json& json, const Place& place, std::string_view, MprStatus& s) const {
    s = static_cast<MprStatus>(read_enum(json, place, mpr_status_names));
  }
  void read(const Json& json, const Place& place, std::string_view, CastStatus& s) const {
    s = static_cast<CastStatus>(read_enum(json, place, cast_status_names));
  }
  void read(const Json& json, const Place& place, std::string_view, recorded::BodyState& body) const { read_fields(json, place, body, false); }
  void read(const Json& json, const Place& place, std::string_view, ClosedFormStatus& s) const {
    s = static_cast<ClosedFormStatus>(read_enum(json, place, closed_form_status_names));
  }
  void read(const Json& json, const Place& place, std::string_view, ProjectionsStatus& s) const {
    s = static_cast<ProjectionsStatus>(read_enum(json, place, projections_status_names));
  }
  void read(const Json& json, const Place& place, std::string_view, SatStatus& s) const {
    s = static_cast<SatStatus>(read_enum(json, place, sat_status_names));
  }
  void read(const Json& json, const Place& place, std::string_view, AxisSource& s) const {
    s = static_cast<AxisSource>(read_enum(json, place, axis_source_names));
  }

  void read(const Json& json, const Place& place, std::string_view, Edge& e) const {
    if (!json.is_array() || json.size() != 2) reject(place, "wrong-count", "must be a pair of vertices");
    for (std::size_t i = 0; i < 2; ++i) e[i] = read_integer(json[i], Place(place, i), 0, largest_number);
  }

  void read(const Json& json, const Place& place, std::string_view, recorded::Face& face) const { read_fields(json, place, face, false); }

  template <class T>
  void read(const Json& json, const Place& place, std::string_view name, std::vector<T>& list) const {
    if (!json.is_array()) reject(place, "wrong-type", "must be an array");
    list.resize(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) read(json[i], Place(place, i), name, list[i]);
  }

  /// Everything E declares, and nothing else.
  template <class E>
  void read_fields(const Json& json, const Place& place, E& event, bool has_kind) const {
    if (!json.is_object()) reject(place, "wrong-type", "must be an object");
    std::size_t known = has_kind ? 1 : 0;
    const auto one = [&](const auto& f) {
      const auto found = json.find(f.name);
      const Place here(place, f.name);
      if (found == json.end()) reject(here, "missing-field", "is missing");
      if constexpr (std::is_same_v<E, recorded::LinesSolved>) event.*f.member = number_or_null(*found, here);  // null: a point, or parallel
      else if constexpr (std::is_same_v<E, recorded::EpaEnded> && std::is_same_v<std::decay_t<decltype(event.*f.member)>, int>)
        event.*f.member = read_integer(*found, here, f.name == "face" ? -1 : 0, largest_number);  // -1: a flat difference has none
      else read(*found, here, f.name, event.*f.member);
      ++known;
    };
    std::apply([&](const auto&... f) { (one(f), ...); }, E::fields());
    if (json.size() != known) reject_unknown<E>(json, place, has_kind);
  }

 private:
  static double number_or_null(const Json& json, const Place& place) {
    return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : read_number(json, place);
  }

  /// What a solver computed may be no number.
  AnyVector with_nulls(const Json& json, const Place& place) const {
    if (!json.is_array() || json.size() != static_cast<std::size_t>(dimension)) return read_vector(json, place, dimension);
    AnyVector v(dimension);
    for (std::size_t i = 0; i < json.size(); ++i) v[static_cast<Eigen::Index>(i)] = number_or_null(json[i], Place(place, i));
    return v;
  }

  template <class E>
  void reject_unknown(const Json& json, const Place& place, bool has_kind) const {
    std::vector<std::string_view> names;
    if (has_kind) names.push_back("kind");
    std::apply([&](const auto&... f) { (names.push_back(f.name), ...); }, E::fields());
    for (const auto& [key, value] : json.items()) {
      if (std::find(names.begin(), names.end(), key) != names.end()) continue;
      const std::string near = nearest_name(key, names);
      reject(Place(place, key), "unknown-field", "is not a known field" + (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
    }
  }
};

template <std::size_t I = 0>
Event read_event_of(const std::string& kind, const Json& json, const Place& place, const FieldReader& reader) {
  if constexpr (I == std::variant_size_v<Event>) {
    reject(Place(place, "kind"), "unknown-name", "\"" + kind + "\" is no kind of event");
  } else {
    using E = std::variant_alternative_t<I, Event>;
    if (kind != E::kind) return read_event_of<I + 1>(kind, json, place, reader);
    E event;
    reader.read_fields(json, place, event, true);
    return event;
  }
}

Event read_event(const Json& json, const Place& place, const FieldReader& reader) {
  if (!json.is_object()) reject(place, "wrong-type", "must be an object");
  const auto kind = json.find("kind");
  const Place at(place, "kind");
  if (kind == json.end()) reject(at, "missing-field", "is missing");
  return read_event_of(read_string(*kind, at), json, place, reader);
}

std::optional<double> read_optional_number(ObjectReader& o, const char* key) {
  const Json* json = o.optional(key);
  return !json || json->is_null() ? std::nullopt : std::optional(read_number(*json, o.at(key)));
}

std::optional<AnyVector> read_optional_vector(ObjectReader& o, const char* key, int dimension) {
  const Json* json = o.optional(key);
  return !json || json->is_null() ? std::nullopt : std::optional(read_vector(*json, o.at(key), dimension));
}

Result read_result(const Json& json, const Place& place, int dimension) {
  ObjectReader o(json, place);
  Result r;
  const Json& intersecting = o.required("intersecting");
  r.status = StatusWord::kept(read_string(o.required("status"), o.at("status")));
  if (!(intersecting.is_null() && unanswered(r))) r.intersecting = read_bool(intersecting, o.at("intersecting"));
  r.signed_distance = read_optional_number(o, "signed_distance");
  r.normal = read_optional_vector(o, "normal", dimension);
  r.witness_a = read_optional_vector(o, "witness_a", dimension);
  r.witness_b = read_optional_vector(o, "witness_b", dimension);
  r.lower_bound = read_optional_number(o, "lower_bound");
  r.upper_bound = read_optional_number(o, "upper_bound");
  if (const Json* list = o.optional("contacts")) {
    const Place at = o.at("contacts");
    if (!list->is_array()) reject(at, "wrong-type", "must be an array");
    r.contacts.emplace();
    for (std::size_t i = 0; i < list->size(); ++i) {
      const Place here(at, i);
      ObjectReader c((*list)[i], here);
      r.contacts->push_back({read_vector(c.required("point_a"), c.at("point_a"), dimension),
                             read_vector(c.required("point_b"), c.at("point_b"), dimension), read_number(c.required("depth"), c.at("depth"))});
      c.finish();
    }
  }
  r.time = read_optional_number(o, "time");
  r.touching_at = read_optional_number(o, "touching_at");
  r.energy = read_optional_number(o, "energy");
  if (const Json* pair = o.optional("pair"); pair && !pair->is_null()) {
    if (!pair->is_array() || pair->size() != 2) reject(o.at("pair"), "wrong-count", "must be a pair of bodies");
    r.pair = {read_integer((*pair)[0], o.at("pair"), 0, largest_number), read_integer((*pair)[1], o.at("pair"), 0, largest_number)};
  }
  if (const Json* list = o.optional("bodies"); list && !list->is_null()) {
    const Place at = o.at("bodies");
    if (!list->is_array()) reject(at, "wrong-type", "must be an array");
    r.bodies.emplace();
    for (std::size_t i = 0; i < list->size(); ++i) {
      recorded::BodyState state;
      FieldReader{dimension}.read_fields((*list)[i], Place(at, i), state, false);
      r.bodies->push_back({state.position, state.orientation, state.velocity, state.angular_velocity});
    }
  }
  r.iterations = read_integer(o.required("iterations"), o.at("iterations"), 0, largest_number);
  r.support_calls = read_integer(o.required("support_calls"), o.at("support_calls"), 0, largest_number);
  o.finish();
  return r;
}

}  // namespace

namespace {

/// Everything but the events themselves.
Recording read_head(const Json& json, const std::filesystem::path& directory) {
  const Place root;
  ObjectReader o(json, root);
  if (read_string(o.required("format"), o.at("format")) != "gjk-recording") reject(o.at("format"), "wrong-format", "must be \"gjk-recording\"");
  read_integer(o.required("version"), o.at("version"), 1, 1);
  Recording recording;
  if (const Json* generator = o.optional("generator")) recording.generator = read_string(*generator, o.at("generator"));
  const Json& scene = o.required("scene");
  require_object(scene, o.at("scene"));
  require_object(o.required("method"), o.at("method"));
  try {
    recording.scene = scene_from_json(scene, directory);
  } catch (const Error& e) {
    throw e.within("/scene");
  }
  const int dimension = recording.scene.scene.dimension;
  const Method method = method_from_json(o.required("method"), "/method", dimension);
  try {
    recording.settings = resolve_settings(method, recording.scene.scene);
  } catch (const Error& e) {
    throw e.where() == "/query" ? e.within("/scene") : e;
  }
  if (!o.required("events").is_array()) reject(o.at("events"), "wrong-type", "must be an array of events");
  recording.result = read_result(o.required("result"), o.at("result"), dimension);
  o.finish();
  return recording;
}

}  // namespace

Recording parse_recording(std::string_view text, const std::filesystem::path& directory) {
  Recording recording;
  const Place root, events(root, "events");
  parse_json_in_parts(
      text, "events", [&](const Json& head) { recording = read_head(head, directory); },
      [&](std::size_t i, const Json& json) { recording.events.push_back(read_event(json, Place(events, i), FieldReader{recording.scene.scene.dimension})); });
  return recording;
}

Recording read_recording(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  try {
    return parse_recording(text, directory_of(file));
  } catch (const Error& e) {
    throw e.in(file.string());
  }
}

}  // namespace gjkdbg
