// check, simulation: a contact lies half-way between a point of the first body and one of the second, each on the surface of its own.
#include <algorithm>
#include <cmath>

#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

/// Whether the run before a contact says that it knows the way out, and points of both bodies that far apart. (MPR has these only where its depth is the right one.)
bool way_out_known(const CheckContext& c, std::size_t step) {
  const auto& events = c.recording.events;
  if (c.recording.settings.penetration == Penetration::mpr) return false;
  while (step > 0 && std::holds_alternative<recorded::ContactFound>(events[step])) --step;
  const auto* epa = std::get_if<recorded::EpaEnded>(&events[step]);
  const auto* gjk = std::get_if<recorded::GjkEnded>(&events[step]);
  return !(epa && epa->status == EpaStatus::iteration_limit) && !(gjk && gjk->status == GjkStatus::iteration_limit);
}

}  // namespace

/// With the depth d along n from the first body to the second, these are p + d n / 2 and p - d n / 2. Farther out along n, or -n, their bodies end: a depth
/// that is too small has both inside.
void check_contact(CheckContext& c, const Scene& two, const recorded::ContactFound& e) {
  const std::string who = "The contact of bodies " + std::to_string(e.pair[0]) + " and " + std::to_string(e.pair[1]) + " at " + text_of(e.point) + ", " + text_of(e.depth) + " deep, ";
  const double rounding = std::max({1e-6, 100 * c.digits(), c.stop}) * c.size;
  if (!(e.depth >= -rounding)) return c.find("wrong-contact", who + "is none: a depth is not below zero.");
  if (!e.point.allFinite() || !e.normal.allFinite() || std::abs(e.normal.norm() - 1) > 1e-5 || foreign(c.recording) || !way_out_known(c, c.step)) return;
  const double slack = 1e-4 * c.size + 10 * rounding;  // the face that is clipped lies across the normal to 4e-5
  for (const std::size_t k : {0U, 1U}) {
    const AnyVector out = k == 0 ? e.normal : AnyVector(-e.normal), end = e.point + out * (e.depth / 2);
    const std::string body = "body " + std::to_string(e.pair[k]);
    if (const double beside = outside(two, k, end); beside > slack) return c.find("wrong-contact", who + "has a point " + text_of(end) + " of " + body + " that lies " + text_of(beside) + " outside it.");
    if (!(outside(two, k, end + 4 * slack * out) > 0)) return c.find("wrong-contact", who + "has a point " + text_of(end) + " of " + body + " that lies inside it: farther along the normal there is more of the body.");
  }
}

}  // namespace gjkdbg
