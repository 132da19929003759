#include "debugger/view/explain.h"

namespace gjkdbg {
namespace {

/// Whether MPR is still looking for its first portal at this step.
bool frame_before_portal(const Recording& recording, std::size_t step) {
  for (std::size_t i = step + 1; i-- > 0;) {
    if (std::holds_alternative<recorded::PortalFound>(recording.events[i])) return false;
    if (std::holds_alternative<recorded::MprBegan>(recording.events[i])) return true;
  }
  return true;
}

}  // namespace

PseudoCode pseudo_code(const Recording& recording, std::size_t step) {
  const Event& event = recording.events[step];
  const auto* query = std::get_if<recorded::SupportQueried>(&event);
  if (std::holds_alternative<recorded::CastBegan>(event) || std::holds_alternative<recorded::CastAdvanced>(event) || std::holds_alternative<recorded::CastEnded>(event)) {
    PseudoCode code;
    if (recording.settings.name == MethodName::ray_cast) code = {"Ray cast", {"x = 0;  v = x - support(r)", "while |v| > tolerance", "  p = support(v)", "  if x beyond the plane at p:", "    if v.r >= 0: miss", "    x = where the ray meets it", "  v = x - point of P nearest x", "hit at x"}, -1};
    else code = {recording.settings.name == MethodName::root_finding ? "Root finding" : "Conservative advancement", {"t = 0", "repeat", "  d, n = GJK(A at t, B at t)", "  if d within tolerance: hit", "  bound = closing speed along n", "  if bound <= 0: miss", recording.settings.name == MethodName::root_finding ? "  t = where the gap along n closes" : "  t = t + d / bound"}, -1};
    const bool ray = recording.settings.name == MethodName::ray_cast;
    if (std::holds_alternative<recorded::CastBegan>(event)) code.current = 0;
    else if (const auto* e = std::get_if<recorded::CastAdvanced>(&event)) code.current = ray ? 5 : e->bound <= 0 ? 5 : 6;
    else code.current = ray ? (std::get<recorded::CastEnded>(event).status == CastStatus::miss ? 4 : 7) : std::get<recorded::CastEnded>(event).status == CastStatus::miss ? 5 : 3;
    return code;
  }
  if (std::holds_alternative<recorded::State>(event) || std::holds_alternative<recorded::ContactFound>(event) || std::holds_alternative<recorded::ImpulseApplied>(event)) {
    PseudoCode code{"Rigid bodies", {"repeat", "  P += m g h", "  contacts: GJK, EPA for near pairs", "  impulses until none approaches", "  x, R move on by h", "  what overlaps is moved apart"}, -1};
    if (recording.scene.scene.query == Query::cast) code = {"Response", {"move to the time of impact", "take off the velocity into the wall", "go on with what is left"}, -1};
    const bool moving = recording.scene.scene.query == Query::cast;
    if (std::holds_alternative<recorded::State>(event)) code.current = moving ? 2 : 0;
    else if (std::holds_alternative<recorded::ContactFound>(event)) code.current = 2;
    else code.current = moving ? 1 : 3;
    return code;
  }
  if (std::holds_alternative<recorded::MprBegan>(event) || std::holds_alternative<recorded::PortalFound>(event) || std::holds_alternative<recorded::MprEnded>(event) ||
      (query && query->phase == Phase::mpr)) {
    PseudoCode code{"MPR", {"v0 = a point inside A - B", "find a portal the ray v0 O passes", "repeat", "  n = normal of the portal", "  if O on v0's side: overlap", "  w = support(n)", "  if w short of O: apart", "  if w not beyond: depth = n.w", "  portal = the part with w that the ray passes"}, -1};
    if (std::holds_alternative<recorded::MprBegan>(event)) code.current = 0;
    else if (std::holds_alternative<recorded::PortalFound>(event)) code.current = 3;
    else if (query) code.current = frame_before_portal(recording, step) ? 1 : 5;
    else code.current = std::get<recorded::MprEnded>(event).status == MprStatus::separated ? 6 : std::get<recorded::MprEnded>(event).status == MprStatus::overlapping ? 4 : 7;
    return code;
  }
  if (std::holds_alternative<recorded::SatBegan>(event) || std::holds_alternative<recorded::AxisTested>(event) || std::holds_alternative<recorded::PointsProjected>(event) ||
      std::holds_alternative<recorded::SatEnded>(event) ||
      (query && query->phase == Phase::sat)) {
    PseudoCode code{"SAT", {"for n in faces of A, faces of B,", "         edge of A x edge of B", "  w = support(n)", "  if n.w < 0: apart", "  depth = min(depth, n.w)", "overlap, depth"}, -1};
    if (std::holds_alternative<recorded::PointsProjected>(event)) return {"SAT of two boxes, apart", {"a = a point of A at the widest gap", "repeat", "  b = point of B nearest a", "  a = point of A nearest b", "until neither moves"}, 3};
    if (std::holds_alternative<recorded::SatBegan>(event)) code.current = 0;
    else if (query) code.current = 2;
    else if (const auto* axis = std::get_if<recorded::AxisTested>(&event)) code.current = axis->distance > 0 ? 3 : 4;
    else code.current = std::get<recorded::SatEnded>(event).status == SatStatus::separated ? 3 : 5;
    return code;
  }
  if (std::holds_alternative<recorded::ClosedFormBegan>(event) || std::holds_alternative<recorded::LinesSolved>(event) || std::holds_alternative<recorded::ClosedFormEnded>(event)) {
    PseudoCode code{"Closed form", {"c = a0 - b0;  w = c + s u - t v", "s = (u.v c.v - v.v c.u) / det", "clamp s to 0 .. 1", "t = (c + s u).v / v.v", "if t out of range: clamp it, s again", "distance = |w|, or depth if O inside"}, -1};
    code.current = std::holds_alternative<recorded::ClosedFormBegan>(event) ? 0 : std::holds_alternative<recorded::LinesSolved>(event) ? 1 : 5;
    return code;
  }
  if ((query && query->phase != Phase::gjk) || std::holds_alternative<recorded::PolytopeSeeded>(event) || std::holds_alternative<recorded::FaceChosen>(event) ||
      std::holds_alternative<recorded::PolytopeGrown>(event) || std::holds_alternative<recorded::EpaEnded>(event)) {
    PseudoCode code{"EPA", {"P = simplex, completed to enclose O", "repeat", "  f = face of P nearest O", "  w = support(normal of f)", "  if w not beyond f: depth = |f|", "  remove the faces w sees", "  join the horizon to w"}, -1};
    if (query) code.current = query->phase == Phase::seed ? 0 : 3;
    else if (std::holds_alternative<recorded::PolytopeSeeded>(event)) code.current = 0;
    else if (std::holds_alternative<recorded::FaceChosen>(event)) code.current = 2;
    else if (std::holds_alternative<recorded::PolytopeGrown>(event)) code.current = 6;
    else code.current = 4;
    return code;
  }
  PseudoCode code;
  if (recording.settings.name == MethodName::gjk_boolean) {
    code = {"GJK, boolean form", {"W = { support(d) };  d = -w", "repeat", "  w = support(d)", "  if w short of O: apart", "  W = { w } + W", "  W, d = region of O, way to O", "  if W encloses O: overlap"}, -1};
    if (std::holds_alternative<recorded::GjkBegan>(event)) code.current = 0;
    else if (query) code.current = query->iteration == 0 ? 0 : 2;
    else if (std::holds_alternative<recorded::SimplexReduced>(event)) code.current = 5;
    else if (const auto* end = std::get_if<recorded::GjkEnded>(&event)) code.current = end->status == GjkStatus::separated ? 3 : 6;
    return code;
  }
  const bool warm = recording.settings.start == Start::previous;
  const Settings& settings = recording.settings;
  const char* support = settings.name != MethodName::gjk_accelerated ? "  w = support(-v)" : settings.acceleration == Acceleration::newton ? "  w = support(Newton's d or -v)" : "  w = support(momentum's d or -v)";
  code = {"GJK, distance form", {warm ? "W = last simplex, or { support(d) }" : "w = support(d);  W = { w }", "repeat", "  v = point of W nearest O", "  W = the part of W that holds v", "  if v = O: overlap", support, "  if w no nearer O than v: apart", "  W = { w } + W"}, -1};
  if (std::holds_alternative<recorded::GjkBegan>(event) || std::holds_alternative<recorded::VertexKept>(event)) code.current = 0;
  else if (query) code.current = query->iteration == 0 ? 0 : 5;
  else if (std::holds_alternative<recorded::SimplexReduced>(event)) code.current = 3;
  else if (const auto* end = std::get_if<recorded::GjkEnded>(&event)) code.current = end->status == GjkStatus::enclosed || end->status == GjkStatus::touching ? 4 : 6;
  return code;
}

}  // namespace gjkdbg
