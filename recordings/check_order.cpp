// check, the order of our own events. Other programs may report less, or more, in between.
#include <algorithm>
#include <array>
#include <utility>

#include "recordings/check_record.h"

namespace gjkdbg {
namespace {

// Steps by their kind; supports by who asks for them.
constexpr std::string_view start = "the start", a_support = "support_queried of ", first_portal = "support_queried of a first portal";

struct Followers {
  std::string_view step;
  std::array<std::string_view, 5> may_follow;
};

/// What every step may be followed by, beside what is said of ends and beginnings below.
constexpr Followers table[] = {
    {"gjk_began", {"support_queried of gjk", "vertex_kept"}},
    {"vertex_kept", {"vertex_kept", "simplex_reduced"}},
    {"support_queried of gjk", {"simplex_reduced", "gjk_ended"}},
    {"simplex_reduced", {"support_queried of gjk", "simplex_reduced", "gjk_ended"}},
    {"gjk_ended", {"support_queried of seed", "polytope_seeded"}},
    {"support_queried of seed", {"support_queried of seed", "polytope_seeded", "epa_ended"}},
    {"polytope_seeded", {"face_chosen"}},
    {"face_chosen", {"support_queried of epa", "epa_ended"}},
    {"support_queried of epa", {"polytope_grown", "epa_ended"}},
    {"polytope_grown", {"face_chosen"}},
    {"mpr_began", {first_portal}},
    {first_portal, {first_portal, "portal_found", "mpr_ended"}},
    {"portal_found", {"support_queried of mpr", "mpr_ended"}},
    {"support_queried of mpr", {"portal_found", "mpr_ended"}},
    {"mpr_ended", {"support_queried of seed", "polytope_seeded"}},
    {"sat_began", {"support_queried of sat"}},
    {"support_queried of sat", {"axis_tested"}},
    {"axis_tested", {"support_queried of sat", "points_projected", "sat_ended"}},
    {"sat_ended", {"support_queried of seed", "polytope_seeded"}},
    {"projections_began", {"points_projected"}},
    {"points_projected", {"points_projected", "point_predicted", "support_queried of projections", "projections_ended", "sat_ended"}},
    {"point_predicted", {"points_projected", "projections_ended"}},
    {"support_queried of projections", {"support_queried of projections", "point_predicted", "projections_ended"}},
    {"closed_form_began", {"lines_solved"}},
    {"lines_solved", {"closed_form_ended"}},
    {"cast_began", {"support_queried of cast", "cast_ended"}},
    {"support_queried of cast", {"support_queried of cast", "cast_advanced", "cast_ended", "impulse_applied"}},
    {"cast_advanced", {"support_queried of cast", "cast_ended", "impulse_applied"}},
    {"contact_found", {"contact_found", "impulse_applied", "state"}},
    {"impulse_applied", {"impulse_applied", "state"}},
    {"state", {"state", "support_queried of cast", "cast_ended"}},
    {"warning", {"impulse_applied", "state"}},  // that a contact is not known
    {start, {"state", "cast_began", "closed_form_began"}},
};

template <std::size_t n>
bool among(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of a query, once: what may stand where the next pair of bodies, or of parts of meshes, begins.
bool begins_query(std::string_view step) { return among(std::array<std::string_view, 5>{"gjk_began", "mpr_began", "sat_began", "projections_began", "warning"}, step); }
bool ends_query(std::string_view step) { return among(std::array<std::string_view, 5>{"gjk_ended", "epa_ended", "mpr_ended", "sat_ended", "projections_ended"}, step); }

bool may_follow(std::string_view before, std::string_view step) {
  const auto found = std::find_if(std::begin(table), std::end(table), [&](const Followers& f) { return f.step == before; });
  if (found != std::end(table) && among(found->may_follow, step)) return true;
  if (begins_query(step)) return ends_query(before) || among(std::array<std::string_view, 6>{start, "warning", "contact_found", "state", "cast_began", "cast_advanced"}, before);
  return ends_query(before) && among(std::array<std::string_view, 4>{"contact_found", "impulse_applied", "state", "cast_advanced"}, step);
}

}  // namespace

OrderCheck::OrderCheck(CheckContext& context) : c_(context), before_(start) {}

void OrderCheck::operator()(const Event& event) {
  if (foreign(c_.recording)) return;
  std::string step(kind_name(event));
  if (const auto* e = std::get_if<recorded::SupportQueried>(&event)) step = e->phase == Phase::mpr && !portal_ ? std::string(first_portal) : std::string(a_support) + std::string(word_of(e->phase));
  if (step == "mpr_began") portal_ = false;
  if (step == "portal_found") portal_ = true;
  if (step == "cast_began" || step == "cast_ended") casting_ = step == "cast_began";
  const MethodName method = c_.recording.settings.name;
  const bool unkept = step == before_ && step == "support_queried of gjk" && (method == MethodName::gjk_accelerated || (method == MethodName::gjk_boolean && earlier_ == "gjk_began"));  // with momentum; the first two
  const bool yes_or_no = c_.recording.scene.scene.query == Query::intersect;  // MPR tells where GJK stalls
  const bool outline = step == "sat_began" && (before_ == "gjk_ended" || before_ == "epa_ended");
  const bool second = outline || (before_ == "gjk_ended" && step == "mpr_began" && (yes_or_no || c_.recording.settings.penetration == Penetration::mpr));
  const bool answered = casting_ && !second && !begins_again(c_.recording, c_.step) && ends_query(before_) && (begins_query(step) || step == "state" || step == "contact_found" || step == "impulse_applied");  // a cast goes on with its own step
  const auto* end = std::get_if<recorded::CastEnded>(&event);
  const bool unknown = (casting_ && step == "warning" && (ends_query(before_) || before_ == "support_queried of cast")) || (before_ == "warning" && step == "cast_ended");  // that the way out is not known is said before the cast ends
  const bool given_up = end && end->status == CastStatus::iteration_limit && ends_query(before_);  // a run came to its limit: no step from there is safe
  if (!unkept && !given_up && !unknown && (!may_follow(before_, step) || answered))
    c_.find("inconsistent", "\"" + step + "\" comes after " + (before_ == start ? before_ : "\"" + before_ + "\"") + ", where no step of ours leads to it. A step is missing here, or one too many.", Finding::Severity::warning);
  earlier_ = std::exchange(before_, step);
}

}  // namespace gjkdbg
