// check, EPA's part.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

/// Across a face, not oriented; its length is twice the area (2D: the edge's length, 1D: 1).
AnyVector across(const std::vector<AnyVector>& w, int dimension) {
  if (dimension == 3 && w.size() == 3) return Eigen::Vector3d(w[1] - w[0]).cross(Eigen::Vector3d(w[2] - w[0]));
  if (dimension == 2 && w.size() == 2) return Eigen::Vector2d(w[1][1] - w[0][1], w[0][0] - w[1][0]);
  return AnyVector::Ones(dimension);
}

}  // namespace

/// By its vertices, which a solver knows it by; by its number where the recording has one.
std::string EpaCheck::name(int number) const {
  const auto known = corners_.find(number);
  std::string out = c_.inferred && known != corners_.end() ? "face" : "face " + std::to_string(number);
  return known != corners_.end() ? out + " " + list_of(known->second) : out;
}

/// The vertices in use whose places are known, each once, in order.
std::vector<std::pair<int, const AnyVector*>> EpaCheck::used() const {
  std::vector<int> numbers;
  for (const auto& [number, face] : faces_) numbers.insert(numbers.end(), face.vertices.begin(), face.vertices.end());
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<std::pair<int, const AnyVector*>> out;
  for (const int v : numbers)
    if (const auto found = c_.vertices.find(v); found != c_.vertices.end()) out.emplace_back(v, &found->second);
  return out;
}

/// A point inside: the mean of the vertices in use.
AnyVector EpaCheck::centre() const {
  const auto vertices = used();
  AnyVector sum = AnyVector::Zero(c_.dimension);
  for (const auto& [number, w] : vertices) sum += *w;
  return vertices.empty() ? sum : AnyVector(sum / static_cast<double>(vertices.size()));
}

/// Whether the plane a face claims holds its vertices and has the whole polytope on one side.
bool EpaCheck::supports(const recorded::Face& f, const std::vector<AnyVector>& w) const {
  if (std::abs(f.normal.norm() - 1) > 1e-6 || std::set<int>(f.vertices.begin(), f.vertices.end()).size() != f.vertices.size()) return false;
  for (const AnyVector& p : w)
    if (std::abs(f.normal.dot(p) - f.distance) > 1e-9 * c_.size) return false;
  for (const auto& [number, face] : faces_)
    for (const int v : face.vertices)
      if (const auto found = c_.vertices.find(v); found != c_.vertices.end() && f.normal.dot(found->second) - f.distance > 1e-9 * c_.size) return false;
  return true;
}

void EpaCheck::add(const recorded::Face& f) {
  Face face;
  face.vertices = corners_[f.face] = f.vertices;
  std::vector<AnyVector> w;
  for (const int v : f.vertices)
    if (const AnyVector* p = c_.vertex(v)) w.push_back(*p);
  face.usable = static_cast<int>(w.size()) == c_.dimension && w.size() == f.vertices.size();
  if (face.usable) {
    face.normal = across(w, c_.dimension);
    double longest = 0;
    for (const AnyVector& p : w) longest = std::max(longest, (p - w[0]).norm());
    const double area = face.normal.norm();
    const double scale = c_.dimension == 3 ? longest * longest : c_.size;
    if (c_.dimension > 1 && area <= 1e-7 * scale && supports(f, w)) {
      face.normal = f.normal, face.distance = f.distance;  // thin, so that its corners do not tell its normal; the given one is right
    } else if (c_.dimension > 1 && area <= 1e-15 * scale) {
      tell_no_gain();
      const bool twice = std::set<int>(f.vertices.begin(), f.vertices.end()).size() != f.vertices.size();
      c_.find("zero-area-face", "The face " + list_of(f.vertices) + (twice ? " names a vertex twice, so it has no area and no normal. The usual cause is an index that is off by one, or a wrong row in a table of faces."
                                : " has no area, so it has no normal. The usual cause is a new vertex in line with an edge of the horizon, or one that the polytope already had: stop, or remove the face behind that edge too."));
      face.usable = false;
    } else {
      face.normal /= area;
      face.distance = face.normal.dot(w[0]);
      // Corners known to eps * size tilt it by that over its least height; as far off as the polytope reaches.
      const double height = c_.dimension == 3 ? area / longest : c_.dimension == 2 ? area : c_.size;
      face.uncertain = 4 * std::numeric_limits<double>::epsilon() * c_.size * (c_.size / height);
    }
  }
  faces_[f.face] = face;
}

/// Turns new faces outwards, and compares with the normals the recording gives. Of a polytope so flat that its corners do not tell the sides apart these count.
void EpaCheck::orient(const std::vector<recorded::Face>& added) {
  const AnyVector inside = centre();
  for (const auto& f : added) {
    Face& face = faces_[f.face];
    if (!face.usable) continue;
    const double depth = face.distance - face.normal.dot(inside);
    if (std::abs(depth) <= face.uncertain ? face.normal.dot(f.normal) < 0 : depth < 0) face.normal = -face.normal, face.distance = -face.distance;
    if (check_normal(f.face, f.normal)) check_plane(f.face, f.normal, f.distance);
  }
}

/// False when it points inwards.
bool EpaCheck::check_normal(int number, const AnyVector& given) {
  const AnyVector& right = faces_[number].normal;
  const bool inwards = right.dot(given) < -0.999 * given.norm();  // else it is another face's, and `check_plane` tells
  if (inwards)
    c_.find("flipped-face-normal", "The normal " + text_of(given) + " of " + name(number) + " points into the polytope; expected is " + text_of(right) +
                                       ". The usual cause is a winding that was not kept: turn the normal so that it looks away from a point inside.");
  return !inwards;
}

/// The plane that is given for a face holds its vertices.
void EpaCheck::check_plane(int number, const AnyVector& normal, double distance) {
  if (!normal.allFinite() || !std::isfinite(distance)) return;
  if (const std::string off = c_.inferred ? "" : c_.not_unit(normal, "The normal of " + name(number)); !off.empty())  // a solver may leave its normals as long as they come
    c_.find("wrong-face", off + " Expected is " + text_of(faces_[number].normal) + ".");
  if (normal.isZero(0)) return c_.find("wrong-face", "The normal of " + name(number) + " is zero. Expected is " + text_of(faces_[number].normal) + ".");
  const AnyVector n = normal.stableNormalized();
  for (const int v : faces_[number].vertices) {
    const AnyVector* w = c_.vertex(v);
    const double rounding = std::max(c_.tolerance, 1e-7 * c_.size), length = normal.norm();
    if (!w || std::abs(n.dot(*w) - distance) <= rounding) continue;
    const bool by_its_length = std::abs(length - 1) > 1e-4 && std::abs(normal.dot(*w) - distance) <= rounding * length;
    c_.find("wrong-face", "The plane of " + name(number) + " is given by the normal " + text_of(normal) + " and the distance " + text_of(distance) + ", but its vertex " + std::to_string(v) + " lies at " + text_of(n.dot(*w)) +
                              " along it. Expected are the normal " + text_of(faces_[number].normal) + " and the distance " + text_of(faces_[number].distance) + "." +
                              (by_its_length ? by_length(length) : ""));
    return;
  }
}

/// The horizon is what the faces removed leave open: the edges (2D: the vertices) that one of them alone has.
void EpaCheck::check_horizon(const recorded::PolytopeGrown& e) {
  if (c_.dimension == 1 || (c_.dimension == 2 && e.horizon.empty())) return;
  std::map<std::array<int, 2>, int> rim;
  std::set<std::array<int, 2>> right, given;
  for (std::size_t i = 0; i < e.removed.size(); ++i) {
    const int number = e.removed[i];
    const auto found = faces_.find(number);
    const bool twice = std::find(e.removed.begin(), e.removed.begin() + static_cast<std::ptrdiff_t>(i), number) != e.removed.begin() + static_cast<std::ptrdiff_t>(i);
    if (found == faces_.end() || twice) return c_.find("wrong-face", "Of the faces removed, " + name(number) + (twice ? " is named twice." : " is none of the polytope."));
    const std::vector<int>& v = found->second.vertices;
    for (std::size_t k = 0; k < v.size(); ++k) {
      const int next = c_.dimension == 3 ? v[(k + 1) % v.size()] : v[k];
      ++rim[{std::min(v[k], next), std::max(v[k], next)}];
    }
  }
  for (const auto& [edge, count] : rim)
    if (count == 1) right.insert(edge);
  for (const Edge& edge : e.horizon) {
    if (c_.dimension == 3) given.insert({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
    else given.insert({{edge[0], edge[0]}, {edge[1], edge[1]}});
  }
  if (right == given) return;
  std::string expected;
  for (const auto& edge : right) expected += " " + std::to_string(edge[0]) + (c_.dimension == 3 ? "-" + std::to_string(edge[1]) : "");
  c_.find("wrong-horizon", "The horizon is not the rim of the faces removed. Expected is" + expected + ". The usual cause is an edge that two of these faces share, left in, or one that they do not, left out.");
}

void EpaCheck::operator()(const recorded::PolytopeSeeded& e) {
  finish();
  faces_.clear(), chosen_.reset(), no_gain_.reset(), lost_.reset(), directions_.forget();
  for (const int v : e.vertices) c_.vertex(v);
  for (const auto& f : e.faces) add(f);
  orient(e.faces);
  check_closed({});
  vertices_.clear();
  check_convex(e.faces, std::nullopt);
  check_origin();
}

void EpaCheck::operator()(const recorded::PolytopeGrown& e) {
  directions_.forget();
  if (!c_.vertex(e.vertex)) return;
  check_horizon(e);
  check_gain(e.vertex);
  const std::map<int, Face> before = faces_;
  if (const auto chosen = faces_.find(chosen_.value_or(-1)); chosen != faces_.end() && contains(e.removed, *chosen_)) lost_ = LostFace{c_.step, *chosen_, chosen->second};
  for (const int f : e.removed) faces_.erase(f);
  for (const auto& f : e.added) add(f);
  orient(e.added);
  check_kept(e.vertex, e.removed);
  if (check_closed(before)) check_removed(e, before);  // a face that is lost leaves a hole
  check_convex(e.added, e.vertex);
  check_origin();
}

/// The newest vertex lies beyond the face it was asked for across, or nothing was gained. (In a motion of ours a pair may be so small that all is rounding.)
void EpaCheck::check_gain(int newest) {
  if (!c_.inferred) return;
  const auto face = faces_.find(chosen_.value_or(-1));
  if (face == faces_.end() || !face->second.usable) return;
  const double beyond = face->second.normal.dot(*c_.vertex(newest)) - face->second.distance;
  if (std::abs(beyond) <= 4 * std::numeric_limits<double>::epsilon() * c_.size) no_gain_ = NoGain{c_.step, newest, *chosen_};
}

/// The newest vertex sees every face that went.
void EpaCheck::check_removed(const recorded::PolytopeGrown& e, const std::map<int, Face>& before) {
  for (const int number : e.removed) {
    const auto found = before.find(number);
    if (found == before.end() || !found->second.usable) continue;
    const double behind = found->second.distance - found->second.normal.dot(*c_.vertex(e.vertex));
    if (behind <= std::max(1e-6 * c_.size, c_.tolerance) + found->second.uncertain) continue;
    c_.find("hidden-face-removed", "Vertex " + std::to_string(e.vertex) + " lies " + text_of(behind) + " behind " + name(number) + ", which was removed all the same: it does not see it. Faces with normal . w > distance must go, and no others. "
                                   "The usual cause is comparing normal . w with zero instead of with the face's own distance.");
    return;
  }
}

/// How the faces were wound before the polytope came open.
std::string EpaCheck::winding_of(const std::map<int, Face>& faces) const {
  std::vector<std::vector<int>> vertices;
  for (const auto& [number, face] : faces) vertices.push_back(face.vertices);
  return c_.dimension == 3 ? winding_hint(vertices) : "";
}

/// Every edge joins exactly two faces (2D: every vertex two edges; 1D: two ends).
bool EpaCheck::check_closed(const std::map<int, Face>& before) {
  std::map<std::array<int, 2>, int> uses;
  if (c_.dimension == 1 && faces_.size() != 2) {
    c_.find("open-polytope", "In 1D a polytope is an interval: it has " + std::to_string(faces_.size()) + (faces_.size() == 1 ? " end" : " ends") + " instead of 2.");
    return false;
  }
  for (const auto& [number, face] : faces_) {
    const std::size_t n = face.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const int p = face.vertices[i], q = face.vertices[(i + 1) % n];
      if (c_.dimension == 3) ++uses[{std::min(p, q), std::max(p, q)}];
      else if (c_.dimension == 2) ++uses[{p, p}];
    }
  }
  for (const auto& [edge, count] : uses)
    if (count != 2) {
      c_.find("open-polytope", (c_.dimension == 3 ? "The edge " + std::to_string(edge[0]) + "-" + std::to_string(edge[1]) : "The vertex " + std::to_string(edge[0])) + " belongs to " + std::to_string(count) +
                                   (c_.dimension == 3 ? " faces" : " edges") + " instead of 2: the polytope is not closed. The usual cause is a horizon that was collected with shared edges left in, or with one lost." + (count > 2 ? winding_of(before) : ""));
      return false;
    }
  return true;
}

/// A face the newest vertex sees should have gone.
void EpaCheck::check_kept(int newest, const std::vector<int>& removed) {
  const AnyVector& w = *c_.vertex(newest);
  for (const auto& [number, face] : faces_) {
    if (!face.usable || face.normal.dot(w) - face.distance <= std::max(1e-6 * c_.size, c_.tolerance) + face.uncertain) continue;
    c_.find("visible-face-kept", "Vertex " + std::to_string(newest) + " sees " + name(number) + " from " + text_of(face.normal.dot(w) - face.distance) + " beyond it, but the face was kept. Every face with normal . w > distance must go before the horizon is closed." +
                                     (number == chosen_ && c_.dimension == 2 ? " It is the edge that was chosen: in a list of corners the new one belongs between the two ends of that edge."
                                      : removed.size() == 1 && removed[0] == chosen_ ? " Only the face chosen was removed: look at all the others, too." : ""));
    return;
  }
}

/// No vertex may lie beyond a face; of the newest one `check_kept` has told. What was there before has been compared: the faces added are compared with
/// every vertex, the others only with vertices the polytope had not.
void EpaCheck::check_convex(const std::vector<recorded::Face>& added, std::optional<int> newest) {
  std::vector<std::pair<int, const AnyVector*>> all = used(), others;
  std::set<int> fresh;
  for (const auto& f : added) fresh.insert(f.face);
  for (const auto& [v, w] : all)
    if (v != newest && !std::binary_search(vertices_.begin(), vertices_.end(), v)) others.emplace_back(v, w);
  vertices_.clear();
  for (const auto& [v, w] : all) vertices_.push_back(v);
  if (newest) all.erase(std::remove_if(all.begin(), all.end(), [&](const auto& vertex) { return vertex.first == *newest; }), all.end());
  const double limit = std::max(1e-6 * c_.size, c_.tolerance);
  for (const auto& [number, face] : faces_) {
    if (!face.usable) continue;
    for (const auto& [v, w] : fresh.count(number) > 0 ? all : others) {
      const double beyond = face.normal.dot(*w) - face.distance;
      if (beyond <= limit + face.uncertain) continue;
      c_.find("non-convex-polytope", "Vertex " + std::to_string(v) + " lies " + text_of(beyond) + " beyond " + name(number) + ": the polytope is not convex. The usual cause is splitting only the nearest face instead of removing every face the new vertex sees, or removing others as well.");
      return;
    }
  }
}

/// Who grows the polytope once more and then ends has lost nothing by it.
void EpaCheck::tell_no_gain() {
  if (!no_gain_) return;
  const std::size_t now = std::exchange(c_.step, no_gain_->step);
  c_.find_cost("no-progress", "Vertex " + std::to_string(no_gain_->vertex) + " lies no farther out than " + name(no_gain_->face) + ", across which it was asked for: the face is part of the boundary, and the search was over. It grows the polytope all the same. "
                           "Stop when normal . w is no more than the face's distance and a tolerance.");
  c_.step = now;
  no_gain_.reset();
}

/// Whether a support that came again should have ended the search, or made the polytope grow.
std::string EpaCheck::why_not_grown(const AnyVector& w) const {
  const auto face = faces_.find(chosen_.value_or(-1));
  const bool known = face != faces_.end() && face->second.usable && w.size() == c_.dimension && w.allFinite();
  const double beyond = known ? face->second.normal.dot(w) - face->second.distance : 0, limit = known ? std::max(1e-6 * c_.size, c_.tolerance) + face->second.uncertain : 0;
  if (!known) return "Stop when normal . w is no more than the face's distance and a tolerance, else remove the faces that w sees.";
  if (beyond > limit) return "The support lies " + text_of(beyond) + " beyond " + name(*chosen_) + ", so there is more to come: remove every face that it sees (normal . w > distance), and join the rim of the hole to it. None was removed.";
  return "The support lies no farther out than " + name(*chosen_) + ", so the search was over: stop when normal . w is no more than the face's distance and a tolerance.";
}

/// After a face is chosen, the support is asked for across it. A solver may ask as it likes, but not along the way back.
void EpaCheck::operator()(const recorded::SupportQueried& e) {
  const AnyVector n = std::exchange(chosen_normal_, AnyVector());
  tell_no_gain();
  if (const auto found = e.phase == Phase::epa ? directions_.add(e.direction, c_.step) : std::nullopt)
    c_.find_cost("cycle", "The direction " + text_of(e.direction) + (found->period == 1 ? " is" : ", and the " + std::to_string(found->period - 1) + " before it, are") + " asked along for the fourth time running, as from step " +
                         std::to_string(found->first_step) + " on, and the polytope has not grown: the same supports come back, and EPA will never end. " + why_not_grown(e.w));
  if (e.phase != Phase::epa || n.size() == 0 || n.isZero(0) || !n.allFinite()) return;
  const AnyVector d = e.direction.stableNormalized(), across = n.stableNormalized();
  if (d.dot(across) < -0.999)
    c_.find("direction-away-from-origin", "The direction " + text_of(e.direction) + " leads from the face chosen back into the polytope: expected is the face's normal " + text_of(n) + ", away from the origin. The usual cause is a minus sign that belongs to GJK's direction.");
  else if (c_.inferred && (d - across).norm() > 1e-4)
    c_.suspect("direction-not-perpendicular", "The direction " + text_of(e.direction) + " is not the normal of the face chosen, " + text_of(n) + ": how far A - B reaches along another says nothing of that face. Ask along its normal. The usual cause is the normal of the "
                                                  "round before, or the way to the middle of the face in its place.");
  else if ((d - across).norm() > 1e-4)
    c_.find("direction-not-perpendicular", "The direction " + text_of(e.direction) + " is not the normal of the face chosen, " + text_of(n) + ".", Finding::Severity::warning);
}

void EpaCheck::operator()(const recorded::FaceChosen& e) {
  chosen_ = e.face, chosen_normal_ = e.normal, lost_.reset();
  const auto found = faces_.find(e.face);
  if (found == faces_.end() && (!faces_.empty() || !c_.inferred))
    c_.find("wrong-face", "The face chosen, " + name(e.face) + ", is none of the polytope: it was removed, or never there.");
  if (found == faces_.end() || !found->second.usable) return;
  const Face& face = found->second;
  const bool outwards = check_normal(e.face, e.normal);
  int nearest = e.face;
  for (const auto& [number, other] : faces_)
    if (other.usable && other.distance < faces_.at(nearest).distance) nearest = number;
  if (faces_.at(nearest).distance < face.distance - std::max(1e-7 * c_.size, c_.tolerance))
    c_.find("not-closest-face", "The face chosen, " + name(e.face) + ", is " + text_of(face.distance) + " from the origin, but " + name(nearest) + " is nearer, at " + text_of(faces_.at(nearest).distance) +
                                    ". EPA's bound holds for the nearest face only. The usual cause is comparing distances of normals that were not normalised, or a stale queue entry.");
  if (outwards) check_plane(e.face, e.normal, e.distance);
}

}  // namespace gjkdbg
