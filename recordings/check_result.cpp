// check, the answer: against our own core's, within its certificate.
#include <algorithm>
#include <cmath>

#include "recordings/check_context.h"

namespace gjkdbg {

double outside(const Scene& scene, std::size_t body, const AnyVector& point) {
  constexpr double longest = 1e60;  // of a scene's lengths: compared with what is longer all of a body is one point, and the square of 1e155 is none
  if (const double far = point.stableNorm(); !(far <= 2 * longest)) return far;
  Scene probe = scene;
  Body& other = probe.bodies[1 - body];
  other.shape = {PointSet{PointSetKind::point, {AnyVector::Zero(scene.dimension)}, {}}, 0};
  if (scene.dimension == 1) other.shape = {Box{AnyVector::Zero(1), AnyVector::Zero(1), false}, 0};
  other.pose = identity_pose(scene.dimension);
  other.pose.position = point;
  probe.query = Query::distance;
  return *solve(probe, resolve_settings({}, probe)).lower_bound;
}

bool CheckContext::denies_its_distance() {
  const Result& r = recording.result;
  if (!foreign(recording) || unanswered(r) || !r.signed_distance || r.intersecting != (*r.signed_distance > 0)) return false;
  const double right = *reference().signed_distance, limit = answer_tolerance();
  return std::abs(right) > limit && std::abs(*r.signed_distance - right) <= limit;
}

namespace {

struct Judge {
  CheckContext& c;
  const Result& r;
  const Result& right;  ///< penetration query
  double limit;        ///< absolute, on distances
  bool portal;         ///< the depth is MPR's, and more than the right one
  bool limited;        ///< says itself that it is not exact
  bool any_way;        ///< a solver's, said to be MPR: any way out is right that is as long as it says

  void answer(double best_plane) const {
    const double sd = *right.signed_distance;
    if (std::abs(sd) <= limit || unanswered(r)) return;
    if (c.denies_its_distance()) {
      c.explained("wrong-answer");
      return c.find("wrong-answer", std::string("The bodies are called ") + (r.intersecting ? "overlapping" : "apart") + ", but signed_distance is given as " + text_of(*r.signed_distance) + ", which is right: intersecting and signed_distance contradict each other. The distance "
                                        "was found, and what is made of it is wrong: " + (r.intersecting ? "above zero the bodies are apart." : "below zero the bodies overlap."));
    }
    const bool right_answer = r.intersecting == (sd <= 0), asked = best_plane > -1e300;
    // Who asks no support at all may know by other means; who does, goes by what the supports prove.
    if (!r.intersecting && asked && (!right_answer || (c.has_supports && !limited && best_plane - c.radius < -limit)))
      c.find("unjustified-separation", "The bodies are called apart, but no support proves it: the best plane leaves " + text_of(best_plane - c.radius) + " between them, and it takes a positive number. " +
                                             why_apart(best_plane));
    if (right_answer) return;
    c.find("wrong-answer", std::string("The bodies are called ") + (r.intersecting ? "overlapping" : "apart") + ", but they are " + (sd <= 0 ? "overlapping, " + text_of(-sd) + " deep" : "apart by " + text_of(sd)) + ".");
  }

  std::string why_apart(double best_plane) const {
    const std::string radii = r.signed_distance ? c.forgotten_radii(*r.signed_distance) : "";
    if (!radii.empty()) return "signed_distance is given as " + text_of(*r.signed_distance) + "." + radii;
    if (c.radius > 0 && best_plane > limit) return "It leaves " + text_of(best_plane) + " between the cores: the radii around them, " + text_of(c.radius) + " together, have to be taken off.";
    return c.unkept.empty() ? "The usual cause is the wrong sign in the test whether the support passed the origin." : c.unkept;
  }

  /// A depth of MPR: no less than the right one, and as far as the bodies reach into each other along its normal.
  bool way_out() const {
    if (!any_way || !r.signed_distance || *r.signed_distance > *right.signed_distance) return false;
    return !r.normal || std::abs(c.apart_along(*r.normal) - *r.signed_distance) <= 10 * c.answer_tolerance();
  }

  void distance() const {
    if (!r.signed_distance) return;
    const bool only_distance = c.recording.scene.scene.query == Query::distance;
    const double sd = only_distance ? std::max(0.0, *right.signed_distance) : *right.signed_distance;
    const double error = std::abs(*r.signed_distance - sd);
    if (error <= limit + (*right.upper_bound - *right.lower_bound) || way_out()) return;
    if (only_distance && sd == 0) {
      if (std::abs(*r.signed_distance - *right.signed_distance) <= limit) return;  // the depth was not asked for, but is no error
      return c.find("wrong-distance", "signed_distance is " + text_of(*r.signed_distance) + ", but the bodies overlap: a distance query's answer is 0.");
    }
    const std::string hint = distance_hint(*r.signed_distance, sd);
    const char* code = sd > 0 ? "wrong-distance" : "wrong-depth";
    if (!hint.empty()) c.explained(code);
    c.find(code, "signed_distance is " + text_of(*r.signed_distance) + ", expected " + text_of(sd) + " (certified between " + text_of(*right.lower_bound) + " and " + text_of(*right.upper_bound) + ")." + hint);
  }

  std::string distance_hint(double given, double sd) const {
    const auto is = [&](double x) { return std::abs(given - x) <= limit + 1e-6 * std::abs(x); };
    if (is(-sd)) return " That is the right length with its sign turned: apart is above zero, a depth below.";
    if (given != 0 && (is(sd * sd) || is(-sd * sd))) return " That is its square: a root has not been taken.";
    return c.forgotten_radii(given);
  }

  /// The result's own bounds hold its distance, and the right one.
  void bounds() const {
    if (!r.lower_bound && !r.upper_bound) return;
    const double lower = r.lower_bound.value_or(-INFINITY), upper = r.upper_bound.value_or(INFINITY);
    const bool off = r.signed_distance && (*r.signed_distance < lower - c.tolerance || *r.signed_distance > upper + c.tolerance);
    const bool only_distance = c.recording.scene.scene.query == Query::distance;
    if (lower > upper + c.tolerance || off)
      c.find("wrong-bounds", "The bounds " + bound_text(lower) + " and " + bound_text(upper) + " do not enclose signed_distance" + (r.signed_distance ? ", " + text_of(*r.signed_distance) : "") + ".");
    else if (lower > (only_distance ? std::max(0.0, *right.upper_bound) : *right.upper_bound) + limit || upper < *right.lower_bound - limit)
      c.find("wrong-bounds", "The bounds " + bound_text(lower) + " and " + bound_text(upper) + " leave out the right distance, " + text_of(*right.signed_distance) + ".");
  }

  /// Whether GJK came to its limit: which way the nearest point lies is then as little known as how far. (EPA and MPR have a direction for what they say.)
  bool cut_short() const {
    const auto& events = c.recording.events;
    const auto ends = [](const Event& e) { return std::holds_alternative<recorded::GjkEnded>(e) || std::holds_alternative<recorded::EpaEnded>(e) || std::holds_alternative<recorded::MprEnded>(e); };
    const auto last = std::find_if(events.rbegin(), events.rend(), ends);
    return r.status == "iteration_limit" && (last == events.rend() || std::holds_alternative<recorded::GjkEnded>(*last));
  }

  /// The normal of bodies apart is v, divided by its length: as in check_touching.cpp, v is known to 64 eps of the size, and to what the world leaves of it, by which a short one is turned.
  double turned_by_rounding() const {
    const double v = r.signed_distance.value_or(0);
    return v > 0 ? std::min(1.0, (64 * c.epsilon() * c.size + c.world) / v) * c.size : 0;
  }

  /// Any unit direction along which the bodies are as far apart, or as little deep, as they are at best is a right normal.
  void normal() const {
    if (!r.normal || cut_short()) return;
    const AnyVector& n = *r.normal;
    const double sd = *right.signed_distance;
    if (c.recording.scene.scene.query == Query::distance && sd <= 0) return;
    if (const std::string off = c.not_unit(n); !off.empty()) {
      c.find("wrong-normal", off);
      c.explained("wrong-normal");
      return;
    }
    if (!c.has_supports && limited) return;  // it may be of a triangle that is not the nearest
    const double slack = 10 * limit + (*right.upper_bound - *right.lower_bound) + turned_by_rounding();
    const double along = c.apart_along(n), against = c.apart_along(-n);
    // What is not the best way out is one all the same: the bodies are as deep along it as is said.
    const bool as_said = !limited || !r.signed_distance || along >= *r.signed_distance - 10 * c.answer_tolerance() - turned_by_rounding();
    if (along >= sd - slack && as_said) return;
    if (way_out()) return;
    if (against >= sd - slack)
      c.find("flipped-normal", "The normal " + text_of(n) + " points from body 1 to body 0; expected is " + text_of(AnyVector(-n)) + ", from body 0 towards body 1. " +
                                   (sd > 0 ? "v = a - b leads from body 1 to body 0; the normal is -v / |v|." : "The usual cause is the normal of B - A, or one turned towards the origin: it is that of the nearest face of A - B, away from the origin."));
    else
      c.find("wrong-normal", "Along the normal " + text_of(n) + " the bodies are " + (along > 0 ? "apart by " + text_of(along) : text_of(-along) + " deep") + ", but along " + text_of(*right.normal) + " " + (sd > 0 ? "apart by " + text_of(sd) : "only " + text_of(-sd) + " deep") + ".");
  }

  bool measured() const { return r.normal && r.signed_distance; }
  /// b - a = signed_distance * normal.
  bool belong_together(const AnyVector& a, const AnyVector& b) const { return (b - a - *r.signed_distance * *r.normal).norm() <= 10 * c.answer_tolerance() + rounding(); }
  /// What points of the world have lost far from its origin.
  double rounding() const { return c.digits() * std::max(r.witness_a ? r.witness_a->stableNorm() : 0, r.witness_b ? r.witness_b->stableNorm() : 0); }

  void witnesses() const {
    const Scene& scene = c.recording.scene.scene;
    const double slack = limit + rounding();
    if (way_out() && *r.signed_distance < *right.signed_distance - limit) return;  // no points of both bodies lie that far apart along that normal
    const double out_a = r.witness_a ? outside(scene, 0, *r.witness_a) : 0, out_b = r.witness_b ? outside(scene, 1, *r.witness_b) : 0;
    if (out_a > slack || out_b > slack) {
      const bool a = out_a > slack, swapped = r.witness_a && r.witness_b && outside(scene, 0, *r.witness_b) <= slack && outside(scene, 1, *r.witness_a) <= slack && (!measured() || belong_together(*r.witness_b, *r.witness_a));
      c.find("wrong-witness", std::string("witness_") + (a ? "a " : "b ") + text_of(a ? *r.witness_a : *r.witness_b) + " lies " + text_of(a ? out_a : out_b) + " outside its body. " +
                                   (portal ? "MPR's depth is more than the right one: a way out all the same, but no points of both bodies lie that far apart along its normal."
                                   : swapped ? "Each lies on the other body: they are swapped."
                                             : mistaken("The usual cause is weights that belong to other vertices, or to the wrong face.")));
      return;
    }
    if (c.found("wrong-distance") || c.found("wrong-depth") || c.found("flipped-normal") || c.found("wrong-normal")) return;  // the points may well be right
    if (!r.witness_a || !r.witness_b) return alone(r.witness_a ? 0 : 1, r.witness_a ? r.witness_a : r.witness_b);
    if (!measured() || (scene.query == Query::distance && r.intersecting)) return length(AnyVector(*r.witness_b - *r.witness_a));
    if (belong_together(*r.witness_a, *r.witness_b)) return;
    if (belong_together(*r.witness_b, *r.witness_a))  // of bodies that overlap each may lie on either
      c.find("wrong-witness", "witness_b - witness_a is " + text_of(AnyVector(*r.witness_b - *r.witness_a)) + ", but signed_distance * normal is " + text_of(AnyVector(*r.signed_distance * *r.normal)) + ", which is witness_a - witness_b: they are swapped.");
    else
      c.find("wrong-witness", "witness_b - witness_a is " + text_of(AnyVector(*r.witness_b - *r.witness_a)) + ", but signed_distance * normal is " + text_of(AnyVector(*r.signed_distance * *r.normal)) + ": the points and the distance do not belong together. " +
                                   mistaken("The usual cause is weights of another part than the nearest: of a simplex that was not reduced to it, or of a face whose plane is the nearest while the point lies on a neighbour in the same plane."));
  }

  /// A witness without the other: as far from the other body as the bodies are apart.
  void alone(std::size_t body, const std::optional<AnyVector>& point) const {
    if (!point || limited || *right.signed_distance <= limit) return;
    const double far = outside(c.recording.scene.scene, 1 - body, *point);
    if (far <= *right.signed_distance + 10 * c.answer_tolerance()) return;
    c.find("wrong-witness", std::string("witness_") + (body == 0 ? "a " : "b ") + text_of(*point) + " is " + text_of(far) + " from the other body, but the bodies are " + text_of(*right.signed_distance) + " apart: it is not the nearest point of its own.");
  }

  /// Witnesses without a normal, or of an overlap of which only the distance is asked, are as far from each other as is said.
  void length(const AnyVector& between) const {
    if (limited || unanswered(r)) return;
    const bool common = c.recording.scene.scene.query == Query::distance && r.intersecting;
    const double said = std::abs(r.signed_distance.value_or(common ? 0 : *right.signed_distance)), length = between.stableNorm(), off = std::abs(length - said);
    if (off <= 10 * c.answer_tolerance() || (common && std::abs(length - std::abs(*right.signed_distance)) <= 10 * c.answer_tolerance())) return;
    c.find("wrong-witness", "The witness points are " + text_of(length) + " from each other, " + (common && said == 0 ? "but the bodies overlap: where only the distance is asked for, they are one point of both." : "but the bodies are " + text_of(said) + (*right.signed_distance > 0 ? " apart." : " deep.")) + mistaken("", " "));
  }

  /// What the witnesses are instead, where that can be told; else the usual cause.
  std::string mistaken(const std::string& usual, const std::string& before = "") const {
    const std::string known = mistaken_witnesses(c, 10 * limit + rounding());
    if (!known.empty()) c.explained("wrong-witness");
    return known.empty() ? usual : before + known;
  }

  /// Points of the bodies as far behind one another as is said, and no farther than the bodies are deep.
  void contacts() const {
    if (!r.contacts) return;
    const Scene& scene = c.recording.scene.scene;
    const double slack = 1e-4 * c.size + 10 * limit;  // the face that is clipped lies across the normal to 4e-5
    const bool none = r.contacts->empty() && c.recording.settings.penetration == Penetration::none && !c.inferred;  // no depth, no contact points
    if (!none && r.contacts->empty() == r.intersecting && std::abs(*right.signed_distance) > limit)
      c.find("wrong-contact", r.intersecting ? "The bodies overlap, but there is no contact point." : "The bodies are apart, but there are contact points.");
    for (std::size_t i = 0; i < r.contacts->size(); ++i) {
      const ContactPoint& p = (*r.contacts)[i];
      const std::string name = "Contact point " + std::to_string(i) + ", " + text_of(p.point_a) + " and " + text_of(p.point_b) + ", " + text_of(p.depth) + " deep, ";
      for (std::size_t before = 0; before < i && c.world <= 1e-10 * c.size; ++before)  // far out in the world neighbours may round to one point
        if (const ContactPoint& q = (*r.contacts)[before]; (p.point_a - q.point_a).norm() <= 1e-10 * c.size && (p.point_b - q.point_b).norm() <= 1e-10 * c.size)  // ours joins what is within 1e-9 of the bodies; in single precision, too: neighbours may be as near as that rounds
          c.find("wrong-contact", name + "is point " + std::to_string(before) + " again.", Finding::Severity::warning);
      const double off = r.normal ? AnyVector(p.point_b - p.point_a + p.depth * *r.normal).stableNorm() : std::abs(AnyVector(p.point_b - p.point_a).stableNorm() - std::abs(p.depth));
      const double out = std::max(outside(scene, 0, p.point_a), outside(scene, 1, p.point_b));
      if (off > slack) c.find("wrong-contact", name + "is off by " + text_of(off) + ": point_b - point_a is -depth * normal.");
      else if (out > slack) c.find("wrong-contact", name + "lies " + text_of(out) + " outside one of the bodies.");
      else if (p.depth < 0 || p.depth > slack - *right.signed_distance) c.find("wrong-contact", name + "is deeper than the bodies, which are " + text_of(-*right.signed_distance) + " deep, or not at all.");
    }
  }
};

}  // namespace

void check_result(CheckContext& c, double best_plane, bool yes_or_no) {
  const Recording& recording = c.recording;
  // MPR's depth is an upper bound by design.
  const bool portal = recording.settings.penetration == Penetration::mpr && recording.result.intersecting;
  const bool limited = recording.result.status == "iteration_limit" || recording.result.status == "stalled" || portal;
  const Result& right = c.reference();
  double limit = c.answer_tolerance();
  // What says itself that it is not exact is judged by its own bounds.
  // MPR's depth may be the right one, and then its points are, too. What is off sideways by x makes the depth of round bodies wrong by x^2 only.
  const bool exact = recording.result.signed_distance && std::abs(*recording.result.signed_distance - *right.signed_distance) <= limit * limit / c.size;
  if (limited && !(portal && exact) && recording.result.lower_bound && recording.result.upper_bound) limit += *recording.result.upper_bound - *recording.result.lower_bound;
  if (!recording.events.empty()) c.step = recording.events.size() - 1;
  const bool any_way = c.inferred && portal && recording.settings.name == MethodName::mpr && *right.signed_distance <= 0;
  const Judge judge{c, recording.result, right, limit, portal && !exact && !c.inferred, limited, any_way};  // a solver may answer a scene of MPR by other means
  judge.answer(best_plane);
  if (!limited) check_touching(c, best_plane);
  if (yes_or_no) return;
  judge.distance();
  judge.bounds();
  judge.normal();
  judge.witnesses();
  judge.contacts();
}

void check_need(CheckContext& c) {
  const SceneFile& file = c.recording.scene;
  const Query query = file.scene.query;
  if (c.recording.generator != generator_name()) return;  // what another solver spends is its own affair
  const bool costly = query == Query::distance || query == Query::penetration || query == Query::contact;
  // MPR's depth is an upper bound, so that a scene of it may well expect yes or no alone.
  if (!costly || !file.expect || !file.expect->intersecting || file.expect->signed_distance || file.expect->normal || c.recording.settings.penetration == Penetration::mpr) return;
  c.step = 0;
  c.find("asks-too-much", "The scene expects yes or no, but asks for \"" + std::string(word_of(query)) + "\", which took " + std::to_string(c.recording.result.support_calls) +
                              " support queries: \"query\": \"intersect\" would do, and ends at the first proof.",
         Finding::Severity::warning);
}

}  // namespace gjkdbg
