// check, EPA's end: whether its polytope came to hold the origin, and the face that the answer is taken from.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "recordings/check_context.h"

namespace gjkdbg {

/// A start that is inside A - B, but does not hold the origin, may be grown until it does, where the face with the least signed distance is taken first: that is the one
/// the origin is outside of. So what counts is whether a later polytope holds it. Then the start explains a wrong answer only where nothing better does; of a right one it is a detour.
void EpaCheck::check_origin() {
  const auto outside = std::find_if(faces_.begin(), faces_.end(), [&](const auto& face) { return face.second.usable && face.second.distance < -std::max(1e-7 * c_.size, c_.tolerance); });
  if (outside != faces_.end() && !outside_)
    outside_ = Finding{c_.step, Finding::Severity::error, "origin-outside-polytope", "The origin lies " + text_of(-outside->second.distance) + " outside " + name(outside->first) +
                                                                                         ". EPA needs a start that holds the origin: begin with a simplex GJK has proven to, and complete one with too few vertices by asking across it."};
  if (outside != faces_.end() || !outside_) return;
  const std::size_t now = std::exchange(c_.step, outside_->step);
  c_.suspect("origin-outside-polytope", outside_->message);
  c_.mention("origin-outside-polytope", outside_->message + " This one grew until it held it, at step " + std::to_string(now) + ": where all else is right it merely costs.");
  c_.step = now;
  outside_.reset();
}

/// The polytope will not grow any more.
void EpaCheck::finish() {
  if (!outside_) return;
  const std::size_t now = std::exchange(c_.step, outside_->step);
  c_.find("origin-outside-polytope", outside_->message);
  c_.step = now;
  outside_.reset();
}

/// A limit on iterations ends the loop where the polytope has just grown; what is returned is then of a face that it no longer has. Where a face was as deep as A - B, and
/// the polytope grew all the same, the depth is right.
void EpaCheck::check_grown_last(const recorded::EpaEnded& e) {
  const Result& r = c_.recording.result;
  if (!c_.inferred || !lost_ || !lost_->face.usable || e.face != lost_->number || !r.signed_distance) return;
  const double slack = std::max(c_.tolerance, 1e-7 * c_.size);
  if (std::abs(-*r.signed_distance - lost_->face.distance) > slack || std::abs(*r.signed_distance - *c_.reference().signed_distance) <= c_.answer_tolerance()) return;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [number, face] : faces_)
    if (face.usable) nearest = std::min(nearest, face.distance);
  c_.find("stopped-early", "EPA ended right after the polytope grew: " + name(lost_->number) + ", whose distance " + text_of(lost_->face.distance) + " is returned for the depth, was removed at step " + std::to_string(lost_->step) + ", since A - B reaches farther there. " +
                               (std::isfinite(nearest) ? "The nearest face is then " + text_of(nearest) + " from the origin. " : "") + "The usual cause is a limit on iterations taken for convergence.");
}

void EpaCheck::operator()(const recorded::EpaEnded& e) {
  finish();
  if (e.status != EpaStatus::converged || !c_.has_supports) return;
  check_grown_last(e);
  const auto found = faces_.find(e.face >= 0 ? e.face : chosen_.value_or(-1));
  if (found == faces_.end() || !found->second.usable) return;
  const Face& face = found->second;
  const double height = c_.height(face.normal);
  // A solver may leave the depth out: then its normal tells, and where that is left out too, nothing is said that could be off.
  const Result& r = c_.recording.result;
  const double said = !c_.inferred || r.signed_distance ? -e.depth : r.normal ? c_.apart_along(*r.normal) : *c_.reference().signed_distance;
  const bool right = std::abs(said - *c_.reference().signed_distance) <= c_.answer_tolerance();
  // Bounds of smooth differences meet slowly, so that a depth may be off; not by more than the search itself left open.
  const double slack = std::max(c_.tolerance, 1e-7 * c_.size), reference = -*c_.reference().signed_distance;
  const bool within = e.depth >= face.distance - slack && e.depth <= height + slack, is_it = std::abs(e.depth - reference) <= 10 * slack + *c_.reference().upper_bound - *c_.reference().lower_bound;
  if (c_.inferred && r.signed_distance && !within && !is_it && -e.depth >= face.distance - slack && -e.depth <= height + slack) {
    c_.explained("wrong-depth");
    c_.find("wrong-depth", "signed_distance is given as " + text_of(-e.depth) + ", above zero, but the bodies overlap, and " + name(found->first) + ", the face chosen last, lies as far from the origin. That is the right length with its sign turned: apart is "
                           "above zero, a depth below.");
  } else if (c_.inferred && r.signed_distance && !within && !is_it)
    c_.find("wrong-depth", "The depth is given as " + text_of(e.depth) + ", but the face chosen last, " + name(found->first) + ", lies " + text_of(face.distance) + " from the origin, and A - B reaches " + text_of(height) +
                               " along its normal: the depth is between these. What is returned is not what was found.");
  if (height - face.distance <= c_.stop * std::max(height, c_.size)) return;
  const std::string message = "EPA ended at " + name(found->first) + ", " + text_of(face.distance) + " from the origin, but A - B reaches " + text_of(height) + " along its normal: the face is not on the boundary. The usual cause is a tolerance that is too coarse, or a "
                              "limit on iterations taken for convergence.";
  right ? c_.short_of_boundary(message) : c_.find("stopped-early", message);
}

}  // namespace gjkdbg
