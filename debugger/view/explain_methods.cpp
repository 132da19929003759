#include "debugger/view/explain_methods.h"

#include <algorithm>
#include <cmath>

namespace gjkdbg {

bool ExplainMethods::ends_in(MprStatus status) const {
  const auto* end = frame.step + 1 < recording.events.size() ? std::get_if<recorded::MprEnded>(&recording.events[frame.step + 1]) : nullptr;
  return end && end->status == status;
}

Explanation ExplainMethods::operator()(const recorded::MprBegan& e) const {
  return {"MPR begins", "From a point inside " + difference() + ", " + short_vector(e.interior) + ", the difference of two inner points of the bodies, a ray goes through the origin. Where does it leave " + difference() + ": before the origin or beyond it?"};
}

Explanation ExplainMethods::operator()(const recorded::PortalFound& e) const {
  const char* where = e.vertices.size() == 1 ? "The ray goes to this vertex. " : "The ray passes between these vertices. ";
  return {"A portal", where + std::string(e.distance < 0 ? "The origin is still beyond the portal, by " + short_number(-e.distance) + ": is there anything of " + difference() + " farther out?"
                                                                                            : "The origin is on the inner side, by " + short_number(e.distance) + ": the bodies overlap." + (ends_in(MprStatus::overlapping) ? "" : " The portal moves out to the boundary for the depth."))};
}

Explanation ExplainMethods::operator()(const recorded::MprEnded& e) const {
  const std::string title = "MPR ends: " + (e.status == MprStatus::converged ? frame.portal.empty() ? "the ray leads to a vertex" : "the portal is on the boundary" : in_words(word_of(e.status)));
  if (frame.portal.empty() && e.status == MprStatus::overlapping) return {title, "The last vertex lies on the ray itself, and not short of the origin: the bodies overlap, and no more was asked."};
  if (frame.portal.empty() && e.status == MprStatus::converged)
    return {title, "The last vertex lies on the ray itself, so no portal is needed: " + difference() + " ends there. Moving body " + b() + " by " + short_number(e.depth) + " along " + short_vector(e.normal) + " separates the bodies; a shorter way may exist, for MPR looks in one direction only."};
  switch (e.status) {
    case MprStatus::separated: return {title, "The plane of the last support has all of " + difference() + " on its far side: the bodies are apart, by at least " + short_number(-e.depth) + ". How far, MPR does not know."};
    case MprStatus::overlapping: return {title, "The origin lies on the inner side of a portal: the bodies overlap, and no more was asked."};
    case MprStatus::converged:
      return {title, "The portal is part of the boundary. Moving body " + b() + " by " + short_number(e.depth) + " along its normal " + short_vector(e.normal) + " separates the bodies; a shorter way may exist, for MPR looks in one direction only."};
    case MprStatus::flat: return {title, difference() + " has no volume, so no point of it is inside: MPR has nowhere to look from, and GJK and EPA answer instead."};
    case MprStatus::stalled: return {title, "The portal no longer moves in this precision. The bounds say how much is known."};
    case MprStatus::iteration_limit: return {title, "The limit is reached. The bounds say how much is known."};
  }
  return {title, {}};
}

namespace {

/// Whether a shape, or a part of it, is one whose bends are those of discs: see algo/rod_heights.h.
bool has_rod(const Shape& shape) {
  const auto& g = shape.geometry;
  if (const auto* sum = std::get_if<Sum>(&g)) return has_rod(*sum->first) || has_rod(*sum->second);
  return std::holds_alternative<Cylinder>(g) || std::holds_alternative<Cone>(g) || std::holds_alternative<Capsule>(g) || std::holds_alternative<PointSet>(g);
}

/// "2 edges of A's"; "none of B's".
std::string count_of(int edges, const std::string& body) { return edges == 0 ? "none of " + body + "'s" : edges == 1 ? "an edge of " + body + "'s" : std::to_string(edges) + " edges of " + body + "'s"; }

}  // namespace

Explanation ExplainMethods::operator()(const recorded::SatBegan& e) const {
  if (of_near_balls(recording))
    return {"What is nearly balls, instead of EPA", "From the middle of a ball every way out is as short, and here many are nearly: EPA would have to put faces everywhere. But each body is the sum of a ball, the largest that rolls within it, and a small rest. "
                                                    "The balls count exactly, and GJK and EPA look at the rests: every support is a way out of " + difference() + "."};
  if (by_bends(recording, frame.step))
    return {after_epa(recording, frame.step) ? "By the bends, after EPA" : "By the bends, instead of EPA",
            std::string("Many ways out are nearly as short, and EPA ") + (after_epa(recording, frame.step) ? "ran out of steps" : "may run out of steps") + ": between its corners a flat face is all it knows of a round boundary. But how an ellipsoid bends is known" + (rod() ? ", and a rod is all between two discs, ellipsoids without height" : "") + ". So about every direction that is looked along it is known " +
                "what no direction near it comes below. The sides of a cube are squares of directions: those where a shorter way out may be are divided until there are none."};
  if (of_tilted_axes(recording))
    return {"Sections instead of EPA", "Both bodies are bodies of revolution about nearly one line: a whole circle of ways out is nearly as short, and EPA would have to put face after face around it. But " + difference() + " changes little when it turns about that line. So it is looked at in sections through the line, and each "
                                       "says of those beside it how much shorter a way out of them may be: where that is not enough, one between is looked at."};
  if (of_an_outline(recording) && !outline_told(recording) && e.faces_a + e.faces_b == 0)
    return {"Ways out, instead of EPA", "Many ways out of " + difference() + " are as short as one another, or nearly, and EPA would put face after face there. But how these bodies are round is known: " + difference() +
                                            " is looked along until no direction can lead out sooner."};
  if (of_an_outline(recording)) {
    const auto any = [&](auto&& kind) { return std::any_of(recording.scene.scene.bodies.begin(), recording.scene.scene.bodies.end(), [&](const Body& body) { return kind(body.shape.geometry); }); };
    const bool ball = any([](const auto& g) { return std::holds_alternative<Sphere>(g); }), curve = any([](const auto& g) { return std::holds_alternative<Ellipsoid>(g); });
    const std::string why = std::string("Both bodies are bodies of revolution, and their axes are parallel") + (ball ? " (of a ball every one will do)" : "") + ". So " + difference() + " is one as well, and the way out of it lies in the plane through its axis and the origin. ";
    const std::string edges = e.faces_a + e.faces_b == 0 ? "is a curve" : "has " + count_of(e.faces_a, a()) + " and " + count_of(e.faces_b, b()) + (curve ? ", and is a curve besides" : " that may be nearest");
    return {"An outline, instead of EPA", why + "There its outline " + edges + (curve ? ": it is looked along until no direction can lead out sooner." : ".") + " EPA would put face after face around a circle of points that are as near as one another."};
  }
  if (recording.scene.scene.dimension == 2)
    return {"SAT begins", "Two convex polygons are apart exactly when the normal of an edge separates them: " + std::to_string(e.faces_a) + " normals of " + a() + "'s edges and " + std::to_string(e.faces_b) + " of " + b() + "'s." + (e.faces_a == 2 && e.faces_b == 2 ? " Opposite edges of a box share one." : "")};
  return {"SAT begins", "Two polytopes are apart exactly when the normal of a face or the cross product of two edges separates them: " + std::to_string(e.faces_a) + " faces of " + a() + ", " + std::to_string(e.faces_b) +
                            " of " + b() + ", and of " + std::to_string(e.edge_pairs) + " pairs of edges those that make a face of " + difference() + "." +
                            (e.faces_a == 3 && e.faces_b == 3 && e.edge_pairs == 9 ? " Of two boxes opposite faces and parallel edges share an axis." : "")};
}

Explanation ExplainMethods::operator()(const recorded::AxisTested& e) const {
  const std::string normal = (facet() == "edge" ? "the normal of an " : "the normal of a ") + facet() + " of ", from[] = {normal + a(), normal + b(), "across an edge of each"};
  if (of_an_outline(recording)) {
    const bool no_plane = !outline_told(recording) || of_near_balls(recording) || of_tilted_axes(recording) || of_bends(recording);
    const std::string of = e.source == AxisSource::outline ? (no_plane ? "" : ", across the outline") : ", the normal of an edge of the outline that is " + (e.source == AxisSource::face_a ? a() : b()) + "'s";
    const std::string room = e.upper_bound < 0 && e.upper_bound > e.lower_bound ? (no_plane ? " Nowhere is it less than " : " Nowhere on the outline is it less than ") + short_number(-e.upper_bound) + "." : "";
    return {"A way out", "Along " + short_vector(e.direction) + of + ", the bodies overlap by " + short_number(-e.distance) +
                             (e.lower_bound <= e.distance ? ", the least so far: the depth is no more than that." : ", more than along the best one so far.") + room};
  }
  const std::string axis = "Along " + short_vector(e.direction) + ", " + from[static_cast<std::size_t>(e.source)] + ", ";
  if (e.distance > 0) return {"An axis with a gap", axis + "there is a gap of " + short_number(e.distance) + " between the bodies: this axis separates them, and they are at least that far apart."};
  return {"An axis without a gap", axis + "the bodies overlap by " + short_number(-e.distance) + (e.lower_bound <= e.distance ? ", the least so far: the depth is no more than that." : ", more than along the best axis so far.")};
}

Explanation ExplainMethods::operator()(const recorded::PointsProjected& e) const {
  if (frame.stage == Frame::Stage::projections) {
    const std::string points = "b = " + short_place(recording, e.b) + " is the point of " + b() + " nearest to x, and a = " + short_place(recording, e.a) + " that of " + a() + " nearest to b. ";
    if (e.closest.isZero(0)) return {"A point of both bodies", points + "They are the same: the cores overlap."};
    return {"Nearest points in turn", points + "They are " + short_number(e.closest.norm()) + " apart" + (farther(e) ? ", more than before: the step went too far, and part of it is taken back." : ".")};
  }
  const std::string points = "a = " + short_place(recording, e.a) + ", b = " + short_place(recording, e.b) + ", " + short_number(e.closest.norm()) + " apart. ";
  const std::string why = "No axis tells how far the bodies are apart: nearest to each other are " + std::string(recording.scene.scene.dimension == 2 && boxes() ? "" : "a corner and an edge, or ") + "two corners. ";
  if (boxes()) return {"The nearest points, at a corner", why + "Of the " + facet() + "s of " + difference() + " that face O the one nearest to it has them: " + points + "A plane across them has all of " + difference() + " behind it, so nothing is nearer."};
  return {"Points projected in turn", why + "So a point looks for the nearest of the other body, and that for its nearest: " + points + "Two points that are each the nearest to the other are the closest of all."};
}

bool ExplainMethods::rod() const {
  return std::any_of(recording.scene.scene.bodies.begin(), recording.scene.scene.bodies.end(), [](const Body& body) { return has_rod(body.shape); });
}

bool ExplainMethods::boxes() const { return of_two_boxes(recording, frame.step); }

/// Beyond what rounding makes of two equal distances.
bool ExplainMethods::farther(const recorded::PointsProjected& e) const {
  const double digits = recording.settings.scalar == Scalar::float_precision ? 1e-5 : 1e-13, least = e.closest.norm() - digits * (e.a.norm() + e.b.norm() + e.closest.norm());
  for (std::size_t i = frame.step; i-- > 0 && !std::holds_alternative<recorded::ProjectionsBegan>(recording.events[i]);)
    if (const auto* before = std::get_if<recorded::PointsProjected>(&recording.events[i]); before && before->closest.norm() < least) return true;
  return false;
}

bool ExplainMethods::gjk_follows() const { return frame.step + 1 < recording.events.size() && std::holds_alternative<recorded::GjkBegan>(recording.events[frame.step + 1]); }

Explanation ExplainMethods::operator()(const recorded::SatEnded& e) const {
  const std::string title = "SAT ends: " + std::string(word_of(e.status));
  if (of_near_balls(recording) && e.status == SatStatus::overlapping)
    return {title, "The bodies overlap by " + short_number(-e.distance) + " along " + short_vector(e.normal) + ", and no direction leads out sooner: the balls' radii and what is known of the rests leave nothing less. That is the depth."};
  if (by_bends(recording, frame.step) && e.status == SatStatus::overlapping)
    return {title, "The bodies overlap by " + short_number(-e.distance) + " along " + short_vector(e.normal) + ", and no direction leads out sooner: in every square of directions the bends leave nothing less. That is the depth."};
  if (of_tilted_axes(recording) && e.status == SatStatus::overlapping)
    return {title, "The bodies overlap by " + short_number(-e.distance) + " along " + short_vector(e.normal) + ", and no direction leads out sooner, in the sections that were looked at or between them. That is the depth."};
  if (by_bends(recording, frame.step) && frame.step + 1 == recording.events.size()) return {title, "What is left is within rounding, or a limit was reached before the bounds met. EPA's answer stands."};
  if (of_near_balls(recording) || of_tilted_axes(recording) || of_bends(recording)) return {title, "What is left is within rounding, or a limit was reached before the bounds met. EPA goes on."};
  if (of_an_outline(recording) && !outline_told(recording))
    return {title, e.status == SatStatus::overlapping ? "The bodies overlap by " + short_number(-e.distance) + " along " + short_vector(e.normal) + ", and no direction leads out sooner. That is the depth."
                                                      : "What is left is within rounding, or a limit was reached before the bounds met."};
  if (of_an_outline(recording) && e.status == SatStatus::overlapping)
    return {title, "The outline is " + short_number(-e.distance) + " away, along " + short_vector(e.normal) + ". No direction leads out sooner, within the plane or beside it: that is the depth."};
  if (of_an_outline(recording)) return {title, "What is left is within rounding, or the axes are not parallel enough for the tolerance. EPA goes on."};
  if (e.status == SatStatus::separated && frame.step > 0 && std::holds_alternative<recorded::PointsProjected>(recording.events[frame.step - 1]))
    return {title, "An axis separates the bodies (their cores), and " + std::string(boxes() ? "the nearest points are known: " : "the points projected last are each the nearest to the other: ") + short_number(e.distance) + " along " + short_vector(e.normal) + " is the distance."};
  if (e.status == SatStatus::separated)
    return {title, "One separating axis is proof enough: the bodies (their cores) are apart, " + (gjk_follows() ? "by at least " + short_number(e.distance) + ". GJK measures how far." : recording.scene.scene.query == Query::intersect ? "and no more was asked." : short_number(e.distance) + " along " + short_vector(e.normal) + ", from one nearest point to the other.")};
  if (e.status == SatStatus::undecided) return {title, "The widest gap, " + short_number(e.distance) + ", is within rounding. Bodies that touch have none wider, but neither have sharp ones that point at each other from afar. GJK tells them apart."};
  return {title, "No axis separates, so the bodies overlap; the least overlap of all axes, " + short_number(-e.distance) + " along " + short_vector(e.normal) + ", is the depth, exactly."};
}

Explanation ExplainMethods::operator()(const recorded::ClosedFormBegan& e) const {
  const bool a = !e.edge_a.isZero(0), b = !e.edge_b.isZero(0);
  const std::string what = a && b ? "Both cores are segments: " + difference() + " is the parallelogram with the corner c = " : a || b ? "One core is a point, the other a segment: " + difference() + " is a segment from c = " : "Both cores are points: " + difference() + " is the point c = ";
  return {"A formula instead of a search", what + short_vector(e.corner) + (a ? ", edge p = " + short_vector(e.edge_a) : "") + (b ? std::string(a ? " and -q" : ", edge -q") + ", q = " + short_vector(e.edge_b) : "") + ". The radii are added afterwards."};
}

Explanation ExplainMethods::operator()(const recorded::ProjectionsBegan& e) const {
  return {"Projections begin", "For shapes like these a formula gives the point nearest to another. From x = " + short_place(recording, e.point) + " inside " + a() + " to the nearest of " + b() + ", from there to the nearest of " + a() + ", and so on: two points that are each the nearest to the other are the closest of all."};
}

Explanation ExplainMethods::operator()(const recorded::PointPredicted& e) const {
  return {"Newton's step", "How the two points turn and slide when the first one moves is known. So it goes straight to where they should stand still: x = " + short_place(recording, e.point) + "."};
}

Explanation ExplainMethods::operator()(const recorded::ProjectionsEnded& e) const {
  const std::string title = "Projections end: " + std::string(word_of(e.status));
  if (e.status == ProjectionsStatus::separated) return {title, "The plane across the way from a to b leaves no room for points that are nearer: these are the nearest ones, and the bodies are between " + short_number(e.lower_bound) + " and " + short_number(e.upper_bound) + " apart."};
  if (e.status == ProjectionsStatus::overlapping) return {title, std::string("The cores share a point") + (recording.scene.scene.query > Query::distance ? ". How deep they overlap is for GJK and EPA to find." : ".")};
  return {title, "What is left is within rounding, or the points do not settle. GJK decides."};
}

Explanation ExplainMethods::operator()(const recorded::LinesSolved& e) const {
  const auto place = [](double x, const char* name, const std::string& body) { return name + short_number(x) + (x < 0 ? ", before the beginning of " : x > 1 ? ", beyond the end of " : ", within ") + body + "'s segment"; };
  const bool s = !std::isnan(e.s), t = !std::isnan(e.t);
  if (s && t) return {"The lines are solved", "Where both derivatives of |v|\xC2\xB2 vanish the lines are nearest: " + place(e.s, "s = ", a()) + "; " + place(e.t, "t = ", b()) + ". What is out of range is clamped, and the other is taken anew."};
  if (s || t) return {"The line is solved", "The foot of the perpendicular lies at " + (s ? place(e.s, "s = ", a()) : place(e.t, "t = ", b())) + "."};
  if (frame.parallelogram && !frame.parallelogram->edge_a.isZero(0)) return {"The lines are parallel", "The determinant is zero: every place along them is as near as the others, and an end of a segment will do."};
  return {"Nothing to solve", "A point has no parameter."};
}

Explanation ExplainMethods::operator()(const recorded::ClosedFormEnded& e) const {
  const std::string title = "Closed form ends: " + std::string(word_of(e.status)), at = "At s = " + short_number(e.s) + ", t = " + short_number(e.t) + ", ";
  if (e.status == ClosedFormStatus::separated) return {title, at + "v is nearest to the origin, " + short_number(e.closest.norm()) + " away, and the plane across it proves that. Less the radii, that is the bodies' distance."};
  if (e.normal.norm() > 0) return {title, "The origin lies in " + difference() + ". " + at + "the border is nearest, " + short_number(e.closest.norm()) + " along " + short_vector(e.normal) + "; with the radii, that is the depth."};
  return {title, "The origin lies in " + difference() + ", so the bodies overlap; no more was asked."};
}

}  // namespace gjkdbg
