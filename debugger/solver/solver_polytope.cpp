// What a solver says of EPA, as events: which faces a polytope lost and gained, and the one chosen.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "debugger/solver/solver_recorder.h"
#include "recordings/check_text.h"

namespace gjkdbg {

/// A face's plane from its vertices; not turned yet.
recorded::Face SolverRecorder::make_face(const std::vector<int>& vertices) {
  recorded::Face face{next_face_++, vertices, AnyVector::Zero(dimension_), 0};
  std::vector<AnyVector> w;
  for (const int v : vertices)
    if (const auto found = vertices_.find(v); found != vertices_.end()) w.push_back(found->second);
  if (w.size() != vertices.size() || static_cast<int>(w.size()) != dimension_) return face;
  if (dimension_ == 3) face.normal = Eigen::Vector3d(w[1] - w[0]).cross(Eigen::Vector3d(w[2] - w[0]));
  else if (dimension_ == 2) face.normal = Eigen::Vector2d(w[1][1] - w[0][1], w[0][0] - w[1][0]);
  else face.normal = AnyVector::Ones(1);
  if (face.normal.norm() > 0) face.normal.stableNormalize();
  face.distance = face.normal.dot(w[0]);
  return face;
}

/// Outwards, seen from the middle of the vertices in use: a solver need not keep a winding.
void SolverRecorder::orient(std::vector<recorded::Face>& faces) const {
  std::set<int> used;
  for (const auto& [key, face] : faces_) used.insert(key.begin(), key.end());
  for (const auto& face : faces) used.insert(face.vertices.begin(), face.vertices.end());
  AnyVector middle = AnyVector::Zero(dimension_);
  int count = 0;
  for (const int v : used)
    if (const auto found = vertices_.find(v); found != vertices_.end()) middle += found->second, ++count;
  if (count > 0) middle /= count;
  for (auto& face : faces)
    if (face.distance < face.normal.dot(middle)) face.normal = -face.normal, face.distance = -face.distance;
}

void SolverRecorder::polytope(const Json& json) {
  announced_ = AnyVector();
  sideless_.reset();
  const Place root, at(root, "faces");
  if (!json.contains("faces") || !json["faces"].is_array()) reject(at, "bad-message", "must be a list of faces");
  if (json["faces"].empty()) reject(at, "bad-message", "is empty: every face was removed, and none was left to join the new vertex to; the usual cause is a test of which faces it sees with its sign turned");
  tell_not_asked(false);
  end_gjk(GjkStatus::enclosed);
  std::set<std::set<int>> wanted;
  std::vector<recorded::Face> added;
  std::string twice;
  for (std::size_t i = 0; i < json["faces"].size(); ++i) {
    const std::vector<int> vertices = face_vertices(json["faces"][i], Place(at, i));
    const std::set<int> key(vertices.begin(), vertices.end());
    if (!wanted.insert(key).second) twice = list_of(vertices);
    else if (!faces_.contains(key)) added.push_back(make_face(vertices));
  }
  if (!twice.empty() && (epa_ || wanted.size() > 1))  // one face and its back are a flat start
    recording_.events.push_back(recorded::Warning{"open-polytope", "The polytope lists the face " + twice + " twice: its edges then belong to four faces instead of 2. The usual cause is " +
                                                                       (epa_ ? std::string("a face that is added to the list before the one it replaces is taken out, or an edge of the horizon that is there twice.") + winding() : "a table of the first faces in which one stands for another.")});
  grow(wanted, std::move(added));
}

/// How the faces of the polytope so far are wound.
std::string SolverRecorder::winding() const {
  std::vector<std::vector<int>> vertices;
  for (const auto& [key, face] : faces_) vertices.push_back(face.vertices);
  return dimension_ == 3 ? winding_hint(vertices) : "";
}

/// The difference to the polytope before, as an event.
void SolverRecorder::grow(const std::set<std::set<int>>& wanted, std::vector<recorded::Face> added) {
  recorded::PolytopeGrown e;
  std::set<int> old;
  for (const auto& [key, face] : faces_) old.insert(key.begin(), key.end());
  std::map<std::array<int, 2>, int> rim;
  for (auto it = faces_.begin(); it != faces_.end();) {
    if (wanted.contains(it->first)) {
      ++it;
      continue;
    }
    e.removed.push_back(it->second.face);
    const auto& v = it->second.vertices;
    for (std::size_t i = 0; i < v.size() && dimension_ == 3; ++i) {
      const int p = v[i], q = v[(i + 1) % v.size()];
      ++rim[{std::min(p, q), std::max(p, q)}];
    }
    gone_[it->first] = recording_.events.size();
    it = faces_.erase(it);
  }
  orient(added);
  for (const auto& face : added) faces_[std::set<int>(face.vertices.begin(), face.vertices.end())] = face;
  if (!epa_) {
    epa_ = true;
    std::set<int> used;
    for (const auto& face : added) used.insert(face.vertices.begin(), face.vertices.end());
    recording_.events.push_back(recorded::PolytopeSeeded{{used.begin(), used.end()}, std::move(added)});
    return;
  }
  if (e.removed.empty() && added.empty()) return;
  for (const auto& [edge, count] : rim)
    if (count == 1) e.horizon.push_back(edge);
  e.iteration = epa_iteration_;
  // The one that the new faces have and no face had; the newest support may be another's, where one is asked for every face as it is made.
  e.vertex = -1;
  for (const auto& face : added)
    for (const int v : face.vertices)
      if (!old.contains(v)) e.vertex = std::max(e.vertex, v);
  if (e.vertex < 0) e.vertex = std::max(0, supports_ - 1);
  e.added = std::move(added);
  e.lower_bound = e.upper_bound = std::numeric_limits<double>::quiet_NaN();
  recording_.events.push_back(std::move(e));
}

void SolverRecorder::face(const Json& json) {
  announced_ = AnyVector();
  const Place root, at(root, "vertices");
  if (!json.contains("vertices")) reject(at, "bad-message", "is missing");
  const std::vector<int> vertices = face_vertices(json["vertices"], at);
  tell_not_asked(false);
  end_gjk(GjkStatus::enclosed);
  // Of a polytope's faces the recording holds the numbers, and `check` sees them; of this one it would not.
  for (const int v : vertices)
    if (!vertices_.contains(v)) {
      recording_.events.push_back(unknown("The face chosen", v));
      break;
    }
  const auto found = faces_.find(std::set<int>(vertices.begin(), vertices.end()));
  recorded::Face face = found != faces_.end() ? found->second : make_face(vertices);
  if (found == faces_.end() && face.distance < 0) face.normal = -face.normal, face.distance = -face.distance;  // away from the origin
  recorded::FaceChosen e{epa_iteration_, face.face, face.normal, face.distance};
  const bool known = found != faces_.end();
  if (!known && epa_) {
    const auto gone = gone_.find(std::set<int>(vertices.begin(), vertices.end()));
    recording_.events.push_back(recorded::Warning{"wrong-face", "The face chosen, " + list_of(vertices) + ", is none of the polytope: it was " + (gone == gone_.end() ? "never there" : "removed at step " + std::to_string(gone->second)) +
                                                                  ". The usual cause is an entry of a list or a queue that outlives its face."});
  }
  const auto given = [&](const char* key) -> const Json* {
    const auto value = json.find(key);
    return value != json.end() && !value->is_null() ? &*value : nullptr;
  };
  const Json *normal = given("normal"), *distance = given("distance");
  if (normal) e.normal = read_vector(*normal, Place(root, "normal"), dimension_);
  if (normal && !known && e.normal.stableNorm() > 0 && vertices_.contains(vertices[0])) e.distance = e.normal.stableNormalized().dot(vertices_.at(vertices[0]));  // along that one
  if (distance) e.distance = read_number(*distance, Place(root, "distance"));
  if (!known && check_area(face) && (normal || distance)) check_plane(face, e, normal != nullptr, distance != nullptr);
  chosen_ = face;
  sideless_.reset();
  if (!known && !normal && std::abs(face.distance) <= 1e-9 * largest()) sideless_ = recording_.events.size();
  recording_.events.push_back(std::move(e));
}

/// Of a face with the origin on it, of which nothing but the vertices is known, either side may be the outer one: it is the one that is asked along.
void SolverRecorder::turn_chosen(const AnyVector& direction) {
  if (!sideless_) return;
  auto& e = std::get<recorded::FaceChosen>(recording_.events[*std::exchange(sideless_, std::nullopt)]);
  if (!direction.allFinite() || direction.isZero(0) || !(e.normal.dot(direction.stableNormalized()) < 0)) return;
  e.normal = -e.normal, e.distance = -e.distance;
  if (chosen_) chosen_->normal = -chosen_->normal, chosen_->distance = -chosen_->distance;
}

/// Of a face of no polytope, too: where it names a vertex twice, or three in a line, it has no area and no normal.
bool SolverRecorder::check_area(const recorded::Face& face) {
  const bool twice = std::set<int>(face.vertices.begin(), face.vertices.end()).size() != face.vertices.size();
  const bool known = std::all_of(face.vertices.begin(), face.vertices.end(), [&](int v) { return vertices_.contains(v); });
  if (!twice && (!known || !face.normal.isZero(0))) return true;
  recording_.events.push_back(recorded::Warning{"zero-area-face", "The face chosen, " + list_of(face.vertices) + (twice ? ", names a vertex twice" : ", has no area") + ", so it has no normal. The usual cause is " +
                                                                      (twice ? "an index that is off by one." : "a new vertex in line with an edge of the horizon, or one that the polytope already had.")});
  return false;
}

/// The plane that is given for a face of no polytope, which `check` knows nothing of, holds its vertices, and has the origin on its inner side: the normal leads out. Where
/// one of normal and distance is not given, it is taken from the vertices.
void SolverRecorder::check_plane(const recorded::Face& face, const recorded::FaceChosen& given, bool normal_given, bool distance_given) {
  const double length = given.normal.stableNorm();
  const std::string said = "The face chosen, " + list_of(face.vertices) + ", is given the " + (normal_given ? "normal " + text_of(given.normal) : "") + (normal_given && distance_given ? " and the " : "") +
                           (distance_given ? "distance " + text_of(given.distance) : "");
  if (!(length > 0)) return recording_.events.push_back(recorded::Warning{"wrong-face", said + ", but a normal has a length."});
  for (const int v : face.vertices) {
    const auto w = vertices_.find(v);
    if (w == vertices_.end()) continue;
    const double at = (given.normal / length).dot(w->second), slack = 1e-6 * (w->second.norm() + std::abs(given.distance)) + 1e-9 * largest();  // as `check` has it of a polytope's faces
    const bool holds = std::abs(at - given.distance) <= slack, other_side = std::abs(at + given.distance) <= slack;
    if (holds && given.distance >= -slack) continue;
    const bool by_its_length = std::abs(length - 1) > 1e-4 && std::abs(std::abs(at) * length - std::abs(given.distance)) <= slack * std::max(length, 1.0);
    recording_.events.push_back(recorded::Warning{"wrong-face", said + ", but its vertex " + std::to_string(v) + " lies at " + text_of(at) + (normal_given ? " along it." : " along its normal.") +
                                                                  (holds || other_side ? " The normal of a face leads away from the origin, and the distance along it is above zero: turn the one whose sign is wrong." : by_its_length ? by_length(length) : "")});
    return;
  }
}

}  // namespace gjkdbg
