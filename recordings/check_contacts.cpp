// check, simulation: a contact lies half-way between a point of the first body and one of the second.
#include <algorithm>
#include <cmath>

#include "recordings/check_context.h"

namespace gjkdbg {

/// Ends of the run that a contact comes from.
RunEnds ends_before(const CheckContext& c, std::size_t contact) {
  const auto& events = c.recording.events;
  std::size_t step = contact;
  while (step > 0 && std::holds_alternative<recorded::ContactFound>(events[step])) --step;
  const auto* epa = std::get_if<recorded::EpaEnded>(&events[step]);
  const auto* gjk = std::get_if<recorded::GjkEnded>(&events[step]);
  return {gjk && gjk->status == GjkStatus::iteration_limit, epa && epa->status == EpaStatus::iteration_limit};
}

/// With the depth d along n from the first body to the second, these points are p + d n / 2 and p - d n / 2. One of them is on the surface, on the face that the other
/// body's corner lies behind: farther out along n, or -n, its body ends. Of a depth that is too small both lie inside. A run that came to its limit says that it does not know
/// them; MPR has points of both bodies only where its depth is the right one.
void check_contact(CheckContext& c, const Scene& two, const recorded::ContactFound& e) {
  const std::string who = "The contact of bodies " + std::to_string(e.pair[0]) + " and " + std::to_string(e.pair[1]) + " at " + text_of(e.point) + ", " + text_of(e.depth) + " deep, ";
  const double rounding = std::max({1e-6, 100 * c.digits(), c.stop}) * c.size + rounding_in_the_world(two);
  if (!(e.depth >= -rounding)) return c.find("wrong-contact", who + "is none: a depth is not below zero.");
  if (!e.point.allFinite() || !e.normal.allFinite() || std::abs(e.normal.norm() - 1) > 1e-5 || foreign(c.recording)) return;
  const RunEnds ends = ends_before(c, c.step);
  if (ends.gjk_at_limit || ends.epa_at_limit || c.recording.settings.penetration == Penetration::mpr) return;
  const double slack = 1e-4 * c.size + 10 * rounding;  // the face that is clipped lies across the normal to 4e-5
  bool surface = false;
  for (const std::size_t k : {0U, 1U}) {
    const AnyVector out = k == 0 ? e.normal : AnyVector(-e.normal), end = e.point + e.depth / 2 * out;
    if (const double beside = outside(two, k, end); beside > slack)
      return c.find("wrong-contact", who + "has a point " + text_of(end) + " of body " + std::to_string(e.pair[k]) + " that lies " + text_of(beside) + " outside it.");
    surface = surface || outside(two, k, end + 4 * slack * out) > 0;
  }
  if (!surface) c.find("wrong-contact", who + "is deeper: along the normal its point of either body has more of that body before it.");
}

/// Ours says of every run that came to its limit that the contact is not known, after what contacts it makes of it all the same, and of no other.
void check_limits(CheckContext& c) {
  const Settings& s = c.recording.settings;
  if (foreign(c.recording) || s.penetration == Penetration::mpr || (s.name != MethodName::gjk && s.name != MethodName::gjk_accelerated)) return;  // others hand over to GJK
  bool limited = false;
  for (std::size_t i = 0; i < c.recording.events.size(); ++i) {
    const Event& event = c.recording.events[i];
    c.step = i;
    const auto* warning = std::get_if<recorded::Warning>(&event);
    const auto* gjk = std::get_if<recorded::GjkEnded>(&event);
    const auto* epa = std::get_if<recorded::EpaEnded>(&event);
    const bool told = warning && warning->code == "contact-unknown", next = std::holds_alternative<recorded::GjkBegan>(event) || std::holds_alternative<recorded::State>(event) || std::holds_alternative<recorded::ImpulseApplied>(event);
    if (told && !limited) c.find("inconsistent", "A warning says that a contact is not known, but the run before it did not come to its limit.", Finding::Severity::warning);
    if (next && limited) c.find("inconsistent", "The run before this step came to its limit, and no warning says that its contact is not known.", Finding::Severity::warning);
    if (gjk) limited = gjk->status == GjkStatus::iteration_limit;
    if (epa) limited = epa->status == EpaStatus::iteration_limit;
    const auto* sat = std::get_if<recorded::SatEnded>(&event);
    if (told || next || (sat && sat->status == SatStatus::overlapping)) limited = false;
  }
}

}  // namespace gjkdbg
