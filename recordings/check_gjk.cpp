// check, GJK's part.
#include <algorithm>
#include <cmath>
#include <limits>

#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

/// The bits of a vector, signs of zeros aside: equal keys, equal numbers.
std::string key_of(const AnyVector& v) {
  std::string key;
  for (const double x : v) {
    const double plain = x == 0 ? 0 : x;
    key.append(reinterpret_cast<const char*>(&plain), sizeof plain);
  }
  return key;
}

constexpr const char* on_the_spot = "Nothing in between is nearer the origin, by more than rounding tells: stop when |v| no longer falls.";

}  // namespace

std::optional<Repetition::Found> Repetition::add(const AnyVector& direction, std::size_t step) {
  constexpr std::size_t longest = 32;
  directions_.push_back(key_of(direction)), steps_.push_back(step);
  const std::size_t n = directions_.size();
  for (std::size_t period = 1; period <= longest && period * times <= n; ++period) {
    const auto p = static_cast<std::ptrdiff_t>(period), all = static_cast<std::ptrdiff_t>(period * times);
    if (std::equal(directions_.end() - all + p, directions_.end(), directions_.end() - all)) return Found{period, steps_[n - period * times]};
  }
  return std::nullopt;
}

std::vector<AnyVector> GjkCheck::points(const std::vector<int>& numbers) {
  std::vector<AnyVector> out;
  for (const int n : numbers)
    if (const AnyVector* w = c_.vertex(n)) out.push_back(*w);
  return out;
}

/// A solver that asks for no support has no first direction, and none is wrong.
void GjkCheck::operator()(const recorded::GjkBegan& e) {
  const auto& events = c_.recording.events;
  const bool asks = c_.step + 1 < events.size() && std::holds_alternative<recorded::SupportQueried>(events[c_.step + 1]);
  if (asks || !c_.inferred) c_.check_direction(e.direction);
}

/// Whether the solver is done with GJK, and asks for what its polytope lacks: an overlap is claimed before another simplex is reported.
bool GjkCheck::goes_on_to_epa() const {
  const auto& events = c_.recording.events;
  for (std::size_t i = c_.step + 1; i < events.size(); ++i) {
    if (std::holds_alternative<recorded::SimplexReduced>(events[i])) return false;
    const auto* end = std::get_if<recorded::GjkEnded>(&events[i]);
    if (end) return end->status == GjkStatus::enclosed && i + 1 < events.size() && (std::holds_alternative<recorded::PolytopeSeeded>(events[i + 1]) || std::holds_alternative<recorded::FaceChosen>(events[i + 1]));
  }
  return false;
}

/// The next direction must lead from the simplex towards the origin, and across the feature that was kept.
void GjkCheck::check_towards_origin(const AnyVector& direction) {
  const std::vector<AnyVector> w = points(simplex_);
  if (w.empty() || !pending_.empty() || static_cast<int>(w.size()) > c_.dimension) return;
  const NearestPoint nearest = nearest_point(w);
  const AnyVector& v = nearest.v;
  if (v.norm() <= c_.tolerance) return;
  const AnyVector d = direction.stableNormalized();
  // Any point of the feature's plane will do as "the simplex": in Muratori's form the feature may not be the nearest one.
  AnyVector nearest_corner = w[0];
  for (const AnyVector& p : w)
    if (p.dot(d) > nearest_corner.dot(d)) nearest_corner = p;
  const double toward = -d.dot(v) / v.norm();
  if (toward < -1e-9 && nearest_corner.dot(d) > 0 && goes_on_to_epa()) {
    c_.find("origin-not-enclosed", "From here on the simplex " + list_of(simplex_) + " is taken to hold the origin: the direction " + text_of(direction) + " leads away from it, as EPA's do, and no simplex follows. But the origin lies " + text_of(v.norm()) +
                                       " outside, at -v for v = " + text_of(v) + "." + not_enclosed(simplex_, v.norm()));
    return;
  }
  if (toward < -1e-9 && nearest_corner.dot(d) > 0) {
    const std::string message = "The direction " + text_of(direction) + " leads away from the origin: the simplex's nearest point is v = " + text_of(v) + " and d . (-v) is negative (cosine " + text_of(toward) + "). Expected is -v or a multiple. ";
    if (first_negated(direction)) return c_.doubt("direction-away-from-origin", message + "It is the first direction, negated, which some searches ask for second whatever the first support is. But d . w < 0 for the first support, along the first direction, proves the bodies apart already: test it.");
    c_.find("direction-away-from-origin", message + "The usual cause is a flipped cross product or a missing minus sign.");
    return;
  }
  double worst = 0;
  for (const int i : nearest.subset) {
    const AnyVector edge = w[static_cast<std::size_t>(i)] - w[static_cast<std::size_t>(nearest.subset[0])];
    if (edge.norm() > c_.tolerance) worst = std::max(worst, std::abs(d.dot(edge)) / edge.norm());
  }
  // The nearest point is no more exact than its vertices are.
  const bool single = c_.recording.settings.scalar == Scalar::float_precision;
  if (worst > std::max({single ? 1e-2 : 1e-4, 64 * c_.epsilon() * c_.size / v.norm(), c_.rounding_of(w) / v.norm()}))
    c_.find("direction-not-perpendicular", "The direction " + text_of(direction) + " is not perpendicular to the feature that was kept (cosine with an edge " + text_of(worst) + "), though it leads towards the origin. Expected is " +
                                               text_of(AnyVector(-v)) + " or a multiple." + std::string(CheckContext::harmless),
            Finding::Severity::warning);
}

/// Some searches, dyn4j's among them, ask the first direction and then the other way, whatever the first point is.
bool GjkCheck::first_negated(const AnyVector& direction) const {
  return queries_ == 1 && simplex_.size() == 1 && first_direction_.size() > 0 && (direction + first_direction_).stableNorm() <= 1e-12 * direction.stableNorm();
}

/// A query that leaves the simplex as it was is the end, unless the nearest point was put more exactly and the direction has turned. Jolt's rule
/// compares |v|^2 with that of the step before: it asks on until that no longer falls at all.
void GjkCheck::check_progress(const recorded::SupportQueried& e) {
  const bool by_rounding = last_direction_.size() > 0 && e.direction != last_direction_;  // the nearest point was put anew, to the last digit
  const bool same_direction = last_direction_.size() > 0 && (e.direction - last_direction_).stableNorm() <= 1e-12 * e.direction.stableNorm();
  last_direction_ = e.direction;
  if (!repeated_at_ || !pending_.empty() || !same_direction || c_.recording.settings.stopping == Stopping::jolt) return;
  if (by_rounding && stuck_ == 0 && !foreign(c_.recording)) return void(++stuck_);  // one more support was due to the new digits
  const auto find = by_rounding ? &CheckContext::find_stall : &CheckContext::find_cost;
  if (stuck_++ == 0)
    (c_.*find)("no-progress", "The support before left the simplex " + list_of(simplex_) + " of step " + std::to_string(*repeated_from_) + " as it was: nothing nearer the origin exists. The search goes on all the same, in the same direction. "
                           "Stop when |v|^2 - v . w is small beside |v|^2.");
  else
    (c_.*find)("cycle", "The simplex " + list_of(simplex_) + " of step " + std::to_string(*repeated_at_) + " is that of step " + std::to_string(*repeated_from_) +
                         " again, and the search goes on as it did then: it will never end. Stop when a support is no farther along d than the simplex.");
}

void GjkCheck::check_repetition(const AnyVector& direction) {
  const auto found = directions_.add(direction, c_.step);
  if (!found) return;
  const std::string said = "The direction " + text_of(direction) + (found->period == 1 ? " is" : ", and the " + std::to_string(found->period - 1) + " before it, are") + " searched for the fourth time running, as from step " +
                           std::to_string(found->first_step) + " on: the same supports come back, and the search will never end. ";
  if (!reached_.empty() && no_nearer_since(found->first_step))
    c_.find_stall("cycle", said + on_the_spot);
  else if (lost_its_way(found->period))
    c_.find("cycle", said + "Each of them lies farther along its direction than the one before, so no stopping test would have been right to end it: |v| must fall in every step. The usual cause is a region test that drops a vertex the nearest part needs, or a simplex that is cleared.");
  else
    c_.find_cost("cycle", said + "Stop when a support is no farther along d than the simplex.");
}

/// Supports that each lie beyond the one before were no reason to stop.
bool GjkCheck::lost_its_way(std::size_t period) const {
  std::vector<const recorded::SupportQueried*> last;  // newest first
  for (std::size_t i = c_.step + 1; i-- > 0 && last.size() <= period;)
    if (const auto* q = std::get_if<recorded::SupportQueried>(&c_.recording.events[i])) last.push_back(q);
  bool beyond = period > 1 && last.size() == period + 1;
  for (std::size_t i = 0; beyond && i < period; ++i) beyond = last[i]->direction.stableNormalized().dot(last[i]->w - last[i + 1]->w) > c_.tolerance;
  return beyond;
}

void GjkCheck::operator()(const recorded::SupportQueried& e) {
  if (!c_.check_direction(e.direction)) {
    pending_.insert(pending_.begin(), e.vertex);
    return;
  }
  // Momentum leads the directions of accelerated GJK astray on purpose, and a support that brings nothing ends the momentum, not the search. A portal leads outwards.
  if (c_.recording.settings.name != MethodName::gjk_accelerated && !portals_) {
    if (reported_ && pending_.empty()) check_towards_origin(e.direction);
    check_progress(e);
  } else {
    last_direction_ = e.direction;
  }
  check_repetition(e.direction);
  if (queries_++ == 0) first_direction_ = e.direction;
  best_plane_ = std::max(best_plane_, -e.direction.stableNormalized().dot(e.w));
  pending_.insert(pending_.begin(), e.vertex);
}

/// Of a tetrahedron, Muratori's form looks at one face after the other and keeps the part of the first that has the origin outside; of a triangle in
/// the plane, others keep the first such edge: not always the nearest part, but one from which the search goes on.
bool GjkCheck::heuristic_region(const std::vector<int>& before, const std::vector<int>& region, const AnyVector& v) {
  const std::vector<AnyVector> w = points(before);
  const std::size_t corners = static_cast<std::size_t>(c_.dimension) + 1;
  if (w.size() != corners) return false;
  for (std::size_t left_out = 0; left_out < corners; ++left_out) {
    std::vector<AnyVector> face;
    for (std::size_t i = 0; i < corners; ++i)
      if (i != left_out) face.push_back(w[i]);
    if (contains(region, before[left_out]) || (c_.dimension == 2 && region.size() != 2)) continue;
    AnyVector n;
    if (c_.dimension == 3) n = Eigen::Vector3d(face[1] - face[0]).cross(Eigen::Vector3d(face[2] - face[0]));
    else if (c_.dimension == 2) n = Eigen::Vector2d(face[1][1] - face[0][1], face[0][0] - face[1][0]);
    else n = AnyVector::Ones(1);
    if (n.dot(w[left_out] - face[0]) > 0) n = -n;
    const bool origin_outside = -n.dot(face[0]) >= -c_.tolerance * n.norm();
    if (origin_outside && std::abs(nearest_point(face).v.norm() - v.norm()) <= c_.tolerance) return true;
  }
  return false;
}

/// With momentum, what was asked for before the newest support and is not kept: where it brought nothing along v (v . w no less than |v|^2, so that the simplex with it is no
/// nearer), it ended the momentum and was never joined to the simplex. (A solver does not tell; with the newest support it may well come nearer.)
bool GjkCheck::given_up(int vertex, const std::vector<int>& region) {
  if (!c_.inferred || simplex_.empty() || !contains(pending_, vertex) || vertex == pending_.front() || contains(region, vertex)) return false;
  const std::vector<AnyVector> w = points(simplex_);
  if (w.empty()) return false;
  const AnyVector v = told_v_.size() > 0 && told_v_.allFinite() ? told_v_ : nearest_point(w).v;  // its own, which is what it goes by
  return v.dot(*c_.vertex(vertex)) >= v.squaredNorm() - c_.tolerance * v.norm();
}

void GjkCheck::check_region(const recorded::SimplexReduced& e) {
  // What there was to keep: the last simplex, what was asked for since, and what the event itself says. While momentum lasts, a support that
  // brings nothing along v ends it and is not kept.
  const bool momentum = c_.recording.settings.name == MethodName::gjk_accelerated && !e.before.empty();
  std::vector<int> before = momentum ? std::vector<int>() : pending_;
  for (const std::vector<int>* list : {&std::as_const(simplex_), &e.before})
    for (const int n : *list)
      if (!contains(before, n) && !(momentum && given_up(n, e.region))) before.push_back(n);
  const std::vector<AnyVector> all = points(before), kept = points(e.region);
  if (kept.empty() || all.empty() || all.size() > 6) return;
  const NearestPoint best = nearest_point(all);
  const AnyVector v = nearest_point(kept).v;
  if (v.norm() <= best.v.norm() + c_.tolerance) return check_no_more_kept(e.region, kept);
  if (e.closest.size() == 0 && heuristic_region(before, e.region, v)) return;  // who gives the nearest point says that no part is nearer
  std::vector<int> right;
  for (const int i : best.subset) right.push_back(before[static_cast<std::size_t>(i)]);
  // What a search begins with is its own affair: some try a few supports first, and then start from one of them.
  const bool starts = c_.inferred && !reported_ && pending_.size() > 1 && e.region.size() < pending_.size();
  const bool holds_origin = static_cast<int>(right.size()) == c_.dimension + 1 || best.v.norm() <= c_.digits() * c_.size;
  const std::string nearer = (right.size() == before.size() ? "The whole of it " : "The part " + list_of(right) + " ") +
                             (holds_origin ? "holds the origin: the bodies overlap, and the search is over" : "comes as near as " + text_of(best.v.norm()));
  const std::string message = "Of " + list_of(before) + " the part " + list_of(e.region) + " was kept, whose nearest point is " + text_of(v.norm()) + " from the origin. " + nearer + ". The usual cause is a region test with a flipped sign, or one made before the vertices were reordered.";
  c_.find_unless(starts || v.norm() <= best.v.norm() + c_.rounding_of(all), "wrong-region", message);
}

/// What was kept is the nearest part and nothing else: the point nearest the origin on the plane (line, space) of all that was kept is that of the part.
/// Boolean GJK keeps what it knows the origin not to be behind; and where the answer is right all the same, no harm was done.
void GjkCheck::check_no_more_kept(const std::vector<int>& region, const std::vector<AnyVector>& kept) {
  const NearestPoint nearest = nearest_point(kept);
  if (c_.recording.scene.scene.query == Query::intersect || nearest.subset.size() == kept.size() || nearest.v.norm() <= c_.tolerance) return;
  AnyVector on_plane = kept[0];
  std::vector<AnyVector> axes;
  for (const AnyVector& p : kept) {
    AnyVector axis = p - kept[0];
    for (int twice = 0; twice < 2; ++twice)
      for (const AnyVector& a : axes) axis -= a.dot(axis) * a;
    if (axis.norm() <= 1e-6 * (p - kept[0]).norm() || axis.norm() <= c_.tolerance) continue;
    axes.push_back(axis.normalized());
    on_plane -= axes.back().dot(on_plane) * axes.back();
  }
  if (nearest.v.norm() - on_plane.norm() <= std::max(10 * c_.tolerance, 1e-6 * c_.size)) return;
  std::vector<int> right, idle;
  for (std::size_t i = 0; i < region.size(); ++i) (contains(nearest.subset, static_cast<int>(i)) ? right : idle).push_back(region[i]);
  c_.suspect("wrong-region", "Of " + list_of(region) + ", which was kept, " + list_of(idle) + " has no part in the nearest point: it lies on " + list_of(right) + " alone, " + text_of(nearest.v.norm()) +
                              " from the origin. Keep that and drop the rest: it takes the place of vertices still to come, and the search is led across a part that is not nearest. The usual cause is an edge or a vertex region that is not tested for.");
}

/// The weights make the nearest point of the vertices, and it is the nearest.
void GjkCheck::check_closest(const recorded::SimplexReduced& e) {
  const std::vector<AnyVector> w = points(e.region);
  if (w.size() != e.region.size() || e.closest.size() == 0) return;
  if (!e.closest.allFinite()) {
    c_.find("wrong-closest", "The nearest point of " + list_of(e.region) + " is given as " + text_of(e.closest) + ", which is no point. The usual cause is a division by the length, area or volume of a simplex that has none.");
    return;
  }
  const double limit = std::max(c_.tolerance, 1e-7 * c_.size);
  const AnyVector right = nearest_point(w).v;
  const double nearest = right.norm();
  if (!e.barycentric.empty()) {
    AnyVector sum = AnyVector::Zero(c_.dimension);
    double total = 0, least = 0;
    for (std::size_t i = 0; i < std::min(w.size(), e.barycentric.size()); ++i) sum += e.barycentric[i] * w[i], total += e.barycentric[i], least = std::min(least, e.barycentric[i]);
    if (e.barycentric.size() != w.size() || std::abs(total - 1) > 1e-4 || least < -1e-4 || (sum - e.closest).norm() > limit) {
      const bool well_formed = e.barycentric.size() == w.size() && std::abs(total - 1) <= 1e-4 && least >= -1e-4;
      c_.find_unless(well_formed && (sum - e.closest).norm() <= c_.rounding_of(w), "wrong-closest", "The weights, which sum to " + text_of(total) + ", make " + text_of(sum) + " of the vertices " + list_of(e.region) + ", but the nearest point is given as " + text_of(e.closest) +
                                   ". Weights are as many as vertices, in their order, none negative, and sum to 1.");
      return;
    }
  }
  // A point off by x sideways is farther by only x^2 / (2 nearest).
  const double off = (e.closest - right).norm(), farther = e.closest.norm() - nearest;
  if (off <= std::max(limit, std::sqrt(2 * limit * (nearest + limit))) && std::abs(farther) <= limit) return;
  if (c_.of_few_digits(e.closest, right, "The nearest point of " + list_of(e.region))) return;
  const std::string given = "The nearest point of " + list_of(e.region) + " is given as " + text_of(e.closest) + ", " + text_of(e.closest.norm()) + " from the origin; it is " + text_of(right) + ", at " + text_of(nearest) + ".";
  if (c_.found("wrong-closest")) return;
  if (off <= c_.rounding_of(w)) return c_.suspect("wrong-closest", given + " The simplex is a sliver: rounding has lost it.");
  const std::string lost = c_.lost_far_out(e.region, off);
  if (!lost.empty()) c_.find("wrong-closest", given + lost);
  else if (w.size() == 1 && (e.closest + right).norm() > limit) c_.find("wrong-closest", given + " One vertex has no weights: its nearest point is w itself. The usual cause is the point of an older simplex, or of other coordinates than the support's.");
  else if ((e.closest + right).norm() <= limit) c_.find("wrong-closest", given + " That is the same point with its sign turned: is your w = b - a, or did you give the next direction?");
  else if (farther < -limit) c_.find("wrong-closest", given + " What is nearer lies outside the simplex. The usual cause is weights that are not clamped, or a vertex or edge region that is not tested for.");
  else c_.find("wrong-closest", given + " The usual cause is weights that belong to other vertices.");
}

/// Remembers simplices by where their vertices are.
void GjkCheck::check_cycle(const std::vector<int>& region) {
  const std::vector<AnyVector> vertices = points(region);
  if (vertices.empty()) return;
  std::vector<std::string> keys;
  for (const AnyVector& w : vertices) keys.push_back(key_of(w));
  std::sort(keys.begin(), keys.end());
  std::string key;
  for (const std::string& k : keys) key += k;
  const auto [found, is_new] = regions_.try_emplace(key, c_.step);
  repeated_from_.reset(), repeated_at_.reset();
  const bool other_between = last_region_ != key;
  last_region_ = key;
  unasked_ = !other_between && !is_new && pending_.empty() ? unasked_ + 1 : 0;
  if (unasked_ == 3) {  // a program may tell one step twice
    c_.find_cost("cycle", "The simplex " + list_of(region) + " is that of step " + std::to_string(found->second) + " again, for the fourth time running, and no support was asked for in between: nothing new comes in, and the search will never end.");
    return;
  }
  const bool asks_on = other_between && c_.recording.settings.stopping == Stopping::jolt;  // until |v|^2 no longer falls, were it by rounding
  if (is_new || asks_on || pending_.empty() || nearest_point(vertices).v.norm() <= c_.tolerance) return;
  if (other_between && no_nearer_since(found->second))
    c_.find_stall("cycle", "The simplex " + list_of(region) + " is that of step " + std::to_string(found->second) + " again: the search will never end. " + on_the_spot);
  else if (other_between)
    c_.find("cycle", "The simplex " + list_of(region) + " is that of step " + std::to_string(found->second) + " again: from here on everything repeats, and the search will never end. |v| must fall in every step; the usual cause is a region test that drops a vertex the nearest part needs.");
  else
    repeated_from_ = found->second, repeated_at_ = c_.step;
}

/// Some programs search for yes or no first, and then once more, from the beginning, for the distance: with vertices of which the last simplex had none,
/// though with these they would come nearer. Nothing of the search before counts any longer.
bool GjkCheck::begins_again(const recorded::SimplexReduced& e) {
  if (!c_.inferred || !reported_ || simplex_.empty() || e.region.empty() || std::any_of(e.region.begin(), e.region.end(), [&](int n) { return contains(simplex_, n); })) return false;
  std::vector<int> hand = pending_;
  hand.insert(hand.end(), simplex_.begin(), simplex_.end());
  const std::vector<AnyVector> kept = points(e.region), all = points(hand);
  if (kept.size() != e.region.size() || all.empty() || all.size() > 6) return false;
  const double best = nearest_point(all).v.norm(), now = nearest_point(kept).v.norm();
  if (now <= best + c_.tolerance) return false;
  c_.reset("Of the simplex before, " + list_of(simplex_) + ", nothing was kept: " + list_of(e.region) + " is " + text_of(now) + " from the origin, " + list_of(hand) + " comes as near as " + text_of(best) + ".");
  simplex_.clear(), pending_.clear(), directions_.forget(), regions_.clear(), reached_.clear(), last_region_.clear(), last_direction_ = AnyVector();
  repeated_from_.reset(), repeated_at_.reset(), stuck_ = 0;  // the planes have proven what they have
  return true;
}

void GjkCheck::operator()(const recorded::SimplexReduced& e) {
  for (const auto* list : {&e.before, &e.region}) points(*list);
  const bool again = !portals_ && begins_again(e);
  std::vector<int> sorted = e.region;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<AnyVector> w = points(e.region);
  if (e.region.empty()) {
    c_.find("wrong-region", "Nothing was kept of " + list_of(e.before) + ". One part of every simplex is nearest the origin: at the least a vertex.");
    return;
  }
  bool twice = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  for (std::size_t i = 0; i < w.size(); ++i)
    for (std::size_t j = i + 1; j < w.size(); ++j) twice = twice || w[i] == w[j];
  if (twice)
    c_.find("duplicate-vertex", "The simplex " + list_of(e.region) + " holds the same point twice, so it has no volume and its normal is zero. The usual cause is going on after a support that the simplex already had: stop there.");
  if (static_cast<int>(e.region.size()) > c_.dimension + 1)
    c_.find("simplex-too-large", "The simplex " + list_of(e.region) + " has " + std::to_string(e.region.size()) + " vertices; in " + std::to_string(c_.dimension) + "D it has at most " + std::to_string(c_.dimension + 1) +
                                     ". The usual cause is a new vertex that is added before the old simplex was reduced.");
  else if (!twice && again)
    check_closest(e);
  else if (!twice && !portals_)
    check_region(e), check_closest(e);
  if (const AnyVector v = w.empty() || w.size() > 6 ? AnyVector() : nearest_point(w).v; v.size() > 0) reached_.push_back({c_.step, v, std::max(64 * c_.epsilon() * c_.size, c_.rounding_of(w))});
  if (!portals_) check_cycle(e.region);
  reported_ = true;
  simplex_ = e.region, told_v_ = e.closest;
  pending_.clear();
}

}  // namespace gjkdbg
