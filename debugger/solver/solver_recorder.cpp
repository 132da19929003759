#include "debugger/solver/solver_recorder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "recordings/check_context.h"
#include "recordings/json_writing.h"

namespace gjkdbg {
namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

constexpr const char* not_finite = "not finite";  ///< what a message has in place of a number that is none

/// Numbers that JSON has no word for (NaN, Infinity, as Python and others write them) become a text, outside strings.
std::string without_nan(const std::string& line) {
  std::string out;
  bool in_string = false, escaped = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && !escaped) in_string = !in_string;
    escaped = line[i] == '\\' && !escaped;  // of two backslashes the second is escaped, and escapes nothing
    bool replaced = false;
    for (const std::string word : {"-Infinity", "Infinity", "-NaN", "NaN", "-nan", "nan", "-inf", "inf"})
      if (!in_string && line.compare(i, word.size(), word) == 0) {
        out += std::string("\"") + not_finite + "\"";
        i += word.size() - 1;
        replaced = true;
        break;
      }
    if (!replaced) out += line[i];
  }
  return out;
}

/// Whether a value stands for NaN or an infinity: as above, or quoted, as C#'s Newtonsoft.Json writes them.
bool is_not_finite(const Json& json) { return json == not_finite || json == "NaN" || json == "Infinity" || json == "-Infinity"; }

/// A vector whose components may be null or otherwise not finite.
AnyVector loose_vector(const Json& json, const Place& place, int dimension) {
  if (!json.is_array() || json.size() != static_cast<std::size_t>(dimension)) return read_vector(json, place, dimension);
  AnyVector v(dimension);
  for (std::size_t i = 0; i < json.size(); ++i) v[static_cast<Eigen::Index>(i)] = json[i].is_null() || is_not_finite(json[i]) ? nan : read_number(json[i], Place(place, i));
  return v;
}

}  // namespace

SolverRecorder::SolverRecorder(const SceneFile& scene, const Settings& settings, int max_supports)
    : a_(scene.scene.bodies[0], scene.scene.dimension), b_(scene.scene.bodies[1], scene.scene.dimension), dimension_(scene.scene.dimension), max_supports_(max_supports) {
  recording_.generator = "a solver under " + generator_name();
  recording_.scene = scene;
  recording_.settings = settings;
}

std::string SolverRecorder::scene_message() const {
  std::string out = "{\"type\":\"scene\",\"dimension\":" + std::to_string(dimension_) + ",\"query\":\"" + std::string(word_of(recording_.scene.scene.query)) + "\",\"tolerance\":";
  append_number(out, recording_.settings.tolerance);
  return out + "}";
}

std::string SolverRecorder::take(const std::string& line) {
  const Json json = parse_json(without_nan(line));
  const Place root;
  if (!json.is_object()) reject(root, "bad-message", "is no JSON object");
  const auto type = json.find("type");
  constexpr const char* types = "support, simplex, polytope, face, result";
  if (type == json.end()) reject(Place(root, "type"), "bad-message", std::string("is missing; it is one of ") + types);
  if (!type->is_string()) reject(Place(root, "type"), "bad-message", std::string("must be a string, one of ") + types + ", not " + type->type_name());
  const std::string name = type->get<std::string>();
  note_unknown_fields(name, json);
  if (name == "support") return support(json);
  if (name == "simplex") simplex(json);
  else if (name == "polytope") polytope(json);
  else if (name == "face") face(json);
  else if (name == "result") result(json);
  else reject(Place(root, "type"), "bad-message", "\"" + name + "\" is none of " + types);
  return {};
}

/// A misspelt field would be missed without a word. Other ones are left to the solver, but said, once each.
void SolverRecorder::note_unknown_fields(const std::string& type, const Json& json) {
  static const std::map<std::string, std::set<std::string>> fields{{"support", {"direction"}},
                                                                   {"simplex", {"vertices", "direction", "closest"}},
                                                                   {"polytope", {"faces"}},
                                                                   {"face", {"vertices", "normal", "distance"}},
                                                                   {"result", {"intersecting", "signed_distance", "normal", "witness_a", "witness_b"}}};
  const auto known = fields.find(type);
  if (known == fields.end()) return;
  for (const auto& [key, value] : json.items()) {
    if (key == "type" || key == "id" || known->second.contains(key) || !unknown_fields_.insert(type + "/" + key).second) continue;
    std::string list;
    for (const std::string& field : known->second) list += (list.empty() ? "" : ", ") + field;
    recording_.events.push_back(recorded::Warning{"unknown-field", "The message \"" + type + "\" has a field \"" + key + "\", which is not looked at. It has: " + list + "."});
  }
}

/// The direction that the last simplex gave for the next support. Where the simplex holds the origin, to the tolerance of `check`, none is due: what is given is rounding. Nor is
/// any due where the search has ended and EPA begins, which the next message tells.
void SolverRecorder::check_announced(const AnyVector& direction) {
  const AnyVector said = std::exchange(announced_, AnyVector());
  if (said.size() == 0 || !said.allFinite() || !direction.allFinite() || direction.isZero(0)) return;
  if (said.norm() <= 1e-9 * std::min(1.0, largest()) || said.stableNormalized().dot(direction.stableNormalized()) >= 0.999) return;
  std::vector<AnyVector> w;
  for (const int v : simplex_)
    if (const auto found = vertices_.find(v); found != vertices_.end()) w.push_back(found->second);
  const double tolerance = recording_.settings.scalar == Scalar::float_precision ? 1e-4 : 1e-9;
  if (!w.empty() && nearest_point(w).v.norm() <= tolerance * largest()) return;
  not_asked_ = {recording_.events.size(), {"direction-not-asked", "The simplex before gave " + text_of(said) + " for the next direction, but the support is asked for along " + text_of(direction) +
                                                                      ". The usual cause is a vector that was written over, or turned into a body's axes, in between."}};
  if (gjk_ended_) tell_not_asked(true);
}

/// Before the support that it is of. (No event's place is remembered before EPA begins.)
void SolverRecorder::tell_not_asked(bool searches_on) {
  if (not_asked_ && searches_on) recording_.events.insert(recording_.events.begin() + static_cast<std::ptrdiff_t>(not_asked_->first), std::move(not_asked_->second));
  not_asked_.reset();
}

/// The longest w so far.
double SolverRecorder::largest() const {
  double size = 0;
  for (const auto& [number, w] : vertices_) size = std::max(size, w.norm());
  return size;
}

void SolverRecorder::begin(const AnyVector& direction) {
  if (began_) return;
  began_ = true;
  recording_.events.push_back(recorded::GjkBegan{direction});
}

std::string SolverRecorder::support(const Json& json) {
  const Place root, at(root, "direction");
  const auto found = json.find("direction");
  if (found == json.end()) reject(at, "bad-message", "is missing");
  const AnyVector d = loose_vector(*found, at, dimension_);
  if (supports_ == max_supports_) {
    asks_too_much_ = true;
    return {};
  }
  begin(d);
  check_announced(d);
  turn_chosen(d);
  const AnyVector a = a_(d, true), b = b_(-d, true), w = a - b;
  const int vertex = supports_++;
  vertices_[vertex] = w;
  int& iteration = gjk_ended_ ? epa_iteration_ : iteration_;
  recording_.events.push_back(recorded::SupportQueried{iteration, gjk_ended_ ? Phase::epa : Phase::gjk, d, vertex, a, b, w});
  if (!gjk_ended_) ++iteration_, pending_.insert(pending_.begin(), vertex);
  else ++epa_iteration_;
  std::string reply = "{\"type\":\"vertex\",\"vertex\":" + std::to_string(vertex);
  for (const auto& [key, point] : {std::pair("w", &w), std::pair("a", &a), std::pair("b", &b)}) {
    reply += std::string(",\"") + key + "\":";
    append_vector(reply, *point);
  }
  return reply + "}";
}

std::vector<int> SolverRecorder::vertex_list(const Json& json, const Place& place) const {
  if (!json.is_array()) reject(place, "bad-message", "must be a list of vertex numbers");
  if (json.empty()) reject(place, "bad-message", "is empty: nothing was kept, but a part of every simplex is nearest the origin, at the least a vertex");
  std::vector<int> list;
  for (std::size_t i = 0; i < json.size(); ++i) list.push_back(read_integer(json[i], Place(place, i), 0, 1000000000));
  return list;
}

/// The vertices of a face: as many as the dimension.
std::vector<int> SolverRecorder::face_vertices(const Json& json, const Place& place) const {
  const std::vector<int> vertices = vertex_list(json, place);
  if (static_cast<int>(vertices.size()) != dimension_) reject(place, "bad-message", "must be " + std::to_string(dimension_) + " vertex numbers");
  return vertices;
}

void SolverRecorder::simplex(const Json& json) {
  const Place root, at(root, "vertices");
  if (!json.contains("vertices")) reject(at, "bad-message", "is missing");
  recorded::SimplexReduced e;
  e.region = vertex_list(json["vertices"], at);
  begin(AnyVector::Zero(dimension_));
  tell_not_asked(true);
  e.iteration = std::max(0, iteration_ - 1);
  e.before = pending_;
  for (const int v : simplex_)
    if (std::find(e.before.begin(), e.before.end(), v) == e.before.end()) e.before.push_back(v);
  if (const auto closest = json.find("closest"); closest != json.end() && !closest->is_null()) e.closest = loose_vector(*closest, Place(root, "closest"), dimension_);
  announced_ = AnyVector();
  if (const auto d = json.find("direction"); d != json.end() && !d->is_null()) announced_ = loose_vector(*d, Place(root, "direction"), dimension_);
  if (static_cast<int>(e.region.size()) > dimension_) announced_ = AnyVector();  // full: it may be the end
  e.lower_bound = e.upper_bound = nan;
  simplex_ = e.region;
  pending_.clear();
  if (!gjk_ended_) return recording_.events.push_back(std::move(e));
  // EPA has begun, and no search is told any more; a vertex that is none is one all the same.
  for (const int v : simplex_)
    if (!vertices_.contains(v)) return recording_.events.push_back(unknown("The simplex", v));
}

recorded::Warning SolverRecorder::unknown(const std::string& what, int vertex) const {
  return {"unknown-vertex", what + " names vertex " + std::to_string(vertex) + ", which was never handed out by a support query; " + std::to_string(supports_) + " were so far."};
}

void SolverRecorder::end_gjk(GjkStatus status) {
  if (gjk_ended_) return;
  begin(AnyVector::Zero(dimension_));
  gjk_ended_ = true;
  recording_.events.push_back(recorded::GjkEnded{std::max(0, iteration_ - 1), status, nan, nan});
}

void SolverRecorder::result(const Json& json) {
  const Place root;
  ObjectReader o(json, root);
  o.optional("type");
  Result& r = recording_.result;
  r.intersecting = read_bool(o.required("intersecting"), o.at("intersecting"));
  const auto given = [&](const char* key) -> const Json* {
    const Json* value = o.optional(key);
    return value && !value->is_null() ? value : nullptr;
  };
  // What is no number is left out, and said: the rest may well tell how it came to that.
  const auto finite = [&](const char* key, bool is) {
    if (!is) recording_.events.push_back(recorded::Warning{"bad-message", std::string("The result's ") + key + " is not finite. The usual cause is a division by the length of v, which is zero where the bodies touch, or by the area of a simplex that has none: test it first."});
    return is;
  };
  const auto point = [&](const char* key) -> std::optional<AnyVector> {
    const Json* x = given(key);
    if (!x) return std::nullopt;
    const AnyVector v = loose_vector(*x, o.at(key), dimension_);
    return finite(key, v.allFinite()) ? std::optional(v) : std::nullopt;
  };
  if (const Json* x = given("signed_distance"); x && finite("signed_distance", !is_not_finite(*x))) r.signed_distance = read_number(*x, o.at("signed_distance"));
  r.normal = point("normal"), r.witness_a = point("witness_a"), r.witness_b = point("witness_b");
  if (recording_.scene.scene.query == Query::intersect) r.signed_distance.reset(), r.normal.reset(), r.witness_a.reset(), r.witness_b.reset();  // not asked for: neither kept nor judged
  const bool measured = r.signed_distance.has_value();
  tell_not_asked(!(r.intersecting && recording_.scene.scene.query > Query::distance));  // of an overlap the depth may have been looked for without a word
  end_gjk(r.intersecting ? GjkStatus::enclosed : measured ? GjkStatus::converged : GjkStatus::separated);
  r.status = "converged";
  if (epa_ || chosen_) {
    const AnyVector normal = r.normal ? *r.normal : chosen_ ? chosen_->normal : AnyVector(AnyVector::Zero(dimension_));
    recording_.events.push_back(recorded::EpaEnded{epa_iteration_, EpaStatus::converged, chosen_ ? chosen_->face : -1, normal, r.signed_distance ? -*r.signed_distance : nearest_face()});
  }
  done_ = true;
}

/// How far the face is that EPA's answer is taken from, where it is not told.
double SolverRecorder::nearest_face() const {
  if (chosen_) return chosen_->distance;
  double least = nan;
  for (const auto& [key, face] : faces_)
    if (!(face.distance >= least)) least = face.distance;
  return std::isfinite(least) ? least : 0;
}

void SolverRecorder::abort(const std::string& code, const std::string& message) {
  tell_not_asked(true);
  if (began_ && !gjk_ended_) end_gjk(GjkStatus::aborted);
  else if (epa_ || chosen_) recording_.events.push_back(recorded::EpaEnded{epa_iteration_, EpaStatus::aborted, -1, AnyVector::Zero(dimension_), 0});
  recording_.events.push_back(recorded::Warning{code, message});
  recording_.result = {};
  recording_.result.status = "aborted";
  done_ = true;
}

Recording SolverRecorder::finish() && {
  recording_.result.iterations = iteration_ + epa_iteration_;
  recording_.result.support_calls = supports_;
  return std::move(recording_);
}

}  // namespace gjkdbg
