// check, a support that is none: what the point is instead; and distances that leave out what is around the cores.
#include <cmath>

#include "recordings/check_context.h"

namespace gjkdbg {

/// What a point that is not the farthest along a direction is instead.
std::string TraceCheck::support_hint(std::size_t body, const AnyVector& direction, const AnyVector& point) const {
  const Pose& pose = c_.recording.scene.scene.bodies[body].pose;
  const AnyVector& position = pose.position;
  const auto farthest = [&](std::size_t of, const AnyVector& d, const AnyVector& p) { return c_.short_of_support(of, d, p) <= c_.tolerance + far_out(p, position); };
  const AnyVector back = -direction, moved = point + position;
  if (farthest(body, back, point)) return " It is the farthest the other way: of A - B, A is asked along d and B along -d.";
  if (farthest(1 - body, direction, point) || farthest(1 - body, back, point)) return " It is a point of body " + std::to_string(1 - body) + ": A and B are interchanged.";
  if (!position.isZero(0) && farthest(body, direction, moved)) return " With the body's position added it is: a support is a point of the world.";
  const bool turned = !pose.matrix.isIdentity(1e-12);
  if (const double out = outside(c_.recording.scene.scene, body, point); out > c_.tolerance + far_out(point, position)) return beside_body(body, out, turned);
  const bool ellipsoid = std::holds_alternative<Ellipsoid>(c_.recording.scene.scene.bodies[body].shape.geometry);
  return std::string(" It is a point of the body, but others lie farther along that direction. The usual cause is ") + (ellipsoid ? "a formula that takes the radii where their squares are due (the point is r^2 d / |r d|, number by number), or " : "") +
         (turned ? "a direction that was not turned into the body's own frame, by the rotation's transpose on the way in, or a point that was not turned back, by the rotation on the way out." : "another direction than the one that is reported, or one in which a sign or two axes are mixed up.");
}

/// A point that no direction leads to. One as far outside as the margin has it twice: the point nearest it lies that far away along the direction, or nearer.
std::string TraceCheck::beside_body(std::size_t body, double out, bool turned) const {
  const double margin = c_.recording.scene.scene.bodies[body].shape.margin;
  const std::string lies = " It lies " + text_of(out) + " outside the body";
  if (margin > 0 && std::abs(out - margin) <= 1e-6 * margin + c_.tolerance) return lies + ", as far as its margin reaches: that has been added twice.";
  return lies + ": no direction leads there. The usual causes are a wrong size (a whole length for a half one, a diameter for a radius), another axis" + (margin > 0 ? ", the margin" : "") +
         (turned ? ", and a rotation that is not the body's: a direction is turned into its frame by the rotation's transpose, the point back by the rotation." : ", and a wrong position.");
}

std::string CheckContext::forgotten_radii(double given) {
  if (!has_supports) return "";
  const double right = *reference().signed_distance, limit = answer_tolerance();
  const auto is = [&](double x) { return std::abs(given - x) <= limit + 1e-6 * std::abs(x); };
  const double of_a = a_->radius(), of_b = b_->radius();
  if (radius_ <= 10 * limit) return "";
  if (is(right + radius_)) return " That is the cores' distance: the radii around them, " + text_of(radius_) + " together, have not been taken off.";
  if (is(right - radius_)) return " The radii around the cores, " + text_of(radius_) + " together, have been taken off twice.";
  for (const auto& [around, name] : {std::pair(of_a, "0"), std::pair(of_b, "1")})
    if (around > 10 * limit && is(right + around)) return std::string(" The radius around the core of body ") + name + ", " + text_of(around) + ", has not been taken off.";
  return "";
}

}  // namespace gjkdbg
