#include "debugger/view/explain.h"

#include <algorithm>
#include <optional>

namespace gjkdbg {
namespace {

/// Nothing of the lines holds: a limit was reached, or the solver gave up.
constexpr int no_line = -1;

/// The algorithm an event belongs to, and its line.
struct PseudoCodeOf {
  const Recording& recording;
  std::size_t step;
  const Settings& settings = recording.settings;

  // --- Motion -----------------------------------------------------------------------------------------------------
  bool ray() const { return settings.name == MethodName::ray_cast; }

  PseudoCode cast(int line) const {
    if (ray()) return {"Ray cast", {"x = 0;  v = x - support(r)", "while |v| > tolerance", "  p = support(v)", "  if x beyond the plane at p:", "    if v.r >= 0: miss", "    x = where the ray meets it", "    if x past the ray's end: miss", "  v = x - point of P nearest x", "hit at x"}, line};
    const bool roots = settings.name == MethodName::root_finding;
    return {roots ? "Root finding" : "Conservative advancement",
            {"t = 0", "repeat", "  d, n = GJK(A at t, B at t)", "  if d within tolerance: hit", "  bound = closing speed along n", "  if bound <= 0: miss", roots ? "  t = where it closes along n, or n turning" : "  t = t + d / bound", "  if t past the end: miss"},
            line};
  }
  PseudoCode operator()(const recorded::CastBegan&) const { return cast(0); }
  PseudoCode operator()(const recorded::CastAdvanced& e) const {
    return cast(ray() ? 5 : meets_at(recording, step) ? 3 : e.bound <= 0 ? 5 : 6);
  }
  /// Of a cast without a hit: whether a pair that still comes nearer has to wait until the interval is over. Else every pair recedes. After a
  /// response that is seen without a run: the pair moves away from what it has hit.
  bool time_runs_out() const {
    std::optional<int> iteration;
    for (std::size_t i = step; i-- > 0 && !std::holds_alternative<recorded::State>(recording.events[i]);) {
      const auto* advanced = std::get_if<recorded::CastAdvanced>(&recording.events[i]);
      if (!advanced) continue;
      if (advanced->bound > 0) return true;
      if (iteration.value_or(advanced->iteration) != advanced->iteration) return false;
      iteration = advanced->iteration;
    }
    return false;
  }
  /// A ray that leads away ends with a support; one that is clipped beyond its end is clipped first.
  bool ray_runs_out() const { return step > 0 && std::holds_alternative<recorded::CastAdvanced>(recording.events[step - 1]); }

  PseudoCode operator()(const recorded::CastEnded& e) const {
    if (e.status == CastStatus::iteration_limit) return cast(no_line);
    if (e.status != CastStatus::miss) return cast(ray() ? 8 : 3);
    return cast(ray() ? (ray_runs_out() ? 6 : 4) : time_runs_out() ? 7 : 5);
  }

  PseudoCode moving(int of_response, int of_simulation) const {
    if (recording.scene.scene.query != Query::cast)
      return {"Rigid bodies", {"repeat", "  P += m g h", "  contacts: GJK, EPA for near pairs", "  impulses until none approaches", "  x, R move on by h", "  what overlaps is moved apart"}, of_simulation};
    const bool bounces = recording.scene.scene.motion && recording.scene.scene.motion->response == Response::bounce;
    return {"Response", {"move to the time of impact", bounces ? "turn back the velocity into the wall" : "take off the velocity into the wall", "go on with what is left"}, of_response};
  }
  PseudoCode operator()(const recorded::State&) const { return moving(2, 0); }
  PseudoCode operator()(const recorded::ContactFound&) const { return moving(1, 2); }
  PseudoCode operator()(const recorded::ImpulseApplied&) const { return moving(1, 3); }

  // --- MPR, SAT, the closed form ----------------------------------------------------------------------------------
  PseudoCode mpr(int line) const {
    return {"MPR", {"v0 = a point inside A - B", "find a portal the ray v0 O passes", "repeat", "  n = normal of the portal", "  if O on v0's side: overlap", "  w = support(n)", "  if w short of O: apart", "  if w not beyond: depth = n.w", "  portal = part with w that the ray passes"}, line};
  }
  PseudoCode operator()(const recorded::MprBegan&) const { return mpr(0); }
  PseudoCode operator()(const recorded::PortalFound&) const { return mpr(3); }
  PseudoCode operator()(const recorded::MprEnded& e) const {
    switch (e.status) {
      case MprStatus::separated: return mpr(6);
      case MprStatus::overlapping: return mpr(4);
      case MprStatus::converged:
      case MprStatus::stalled: return mpr(7);
      case MprStatus::flat: return mpr(0);
      case MprStatus::iteration_limit: break;
    }
    return mpr(no_line);
  }
  bool before_the_first_portal() const {
    for (std::size_t i = step + 1; i-- > 0;) {
      if (std::holds_alternative<recorded::PortalFound>(recording.events[i])) return false;
      if (std::holds_alternative<recorded::MprBegan>(recording.events[i])) return true;
    }
    return true;
  }

  PseudoCode sat(int line) const {
    if (of_near_balls(recording)) return {"Depth of what is nearly balls", {"rho = balls that roll within A and B", "for n of GJK, EPA on what they leave", "  w = support(n)", "  if n.w < 0: apart", "  depth = min(depth, n.w)", "rho and the rests' depth are no less: depth"}, line};
    if (by_bends(recording, step)) return {"Depth by the bends", {"for squares of directions n", "  for its middle n, then Newton's n", "    w = support(n)", "    if n.w < 0: apart", "    depth = min(depth, n.w)", "  by the bends some n is lower: divide", "no n can be any lower: depth"}, line == 5 ? 6 : line};
    if (of_tilted_axes(recording)) return {"Depth of bodies about nearly one line", {"for sections through the line", "  for n of the section", "    w = support(n)", "    if n.w < 0: apart", "    depth = min(depth, n.w)", "no section between is less deep: depth"}, line};
    if (of_an_outline(recording)) return {"Depth of bodies of revolution", {"e = across the axes, towards O", "for normals n of the outline", "  w = support(n)", "  if n.w < 0: apart", "  depth = min(depth, n.w)", "no way out is shorter: depth"}, line};
    const bool plane = recording.scene.scene.dimension == 2, yes_or_no = recording.scene.scene.query == Query::intersect;
    return {"SAT", {plane ? "for n in normals of edges of A," : "for n in faces of A, faces of B,", plane ? "         of edges of B" : "         edge of A x edge of B", "  w = support(n)", yes_or_no ? "  if n.w < 0: apart" : "  if n.w < 0: apart, by -n.w or more", "  depth = min(depth, n.w)", "no gap: overlap, depth"}, line};
  }
  PseudoCode operator()(const recorded::SatBegan&) const { return sat(0); }
  PseudoCode operator()(const recorded::AxisTested& e) const { return sat(e.distance > 0 ? 3 : 4); }
  PseudoCode projections(int line) const {
    return {"Projections", {"x = a point inside A", "repeat", "  b = point of B nearest x", "  a = point of A nearest b", "  if a = b: overlap", "  if w across a - b is no nearer: apart", "  x = Newton's step for a = x"}, line};
  }
  PseudoCode operator()(const recorded::ProjectionsBegan&) const { return projections(0); }
  PseudoCode operator()(const recorded::PointPredicted&) const { return projections(6); }
  PseudoCode operator()(const recorded::ProjectionsEnded& e) const { return projections(e.status == ProjectionsStatus::separated ? 5 : e.status == ProjectionsStatus::overlapping ? 4 : no_line); }
  PseudoCode operator()(const recorded::PointsProjected&) const {
    if (settings.name == MethodName::projections) return projections(3);
    if (of_two_boxes(recording, step)) return {"SAT, apart across no axis", {"for f in " + facet_name(recording) + "s of A - B that face O", "  v = point of f nearest O", "  keep the shortest v", "v = a - b", "plane across v: nothing is nearer"}, 3};
    return {"SAT, apart across no axis", {"a = a point of A at the widest gap", "repeat", "  b = point of B nearest a", "  a = point of A nearest b", "until the plane across proves it"}, 3};
  }
  PseudoCode operator()(const recorded::SatEnded& e) const { return sat(e.status == SatStatus::separated ? 3 : e.status == SatStatus::overlapping ? 5 : no_line); }

  PseudoCode closed_form(int line) const {
    return {"Closed form", {"c = a0 - b0;  v = c + s p - t q", "s = (p.q c.q - q.q c.p) / det", "clamp s to 0 .. 1", "t = (c + s p).q / q.q", "if t out of range: clamp it, s again", "distance = |v|, or depth if O inside"}, line};
  }
  PseudoCode operator()(const recorded::ClosedFormBegan&) const { return closed_form(0); }
  PseudoCode operator()(const recorded::LinesSolved&) const { return closed_form(1); }
  PseudoCode operator()(const recorded::ClosedFormEnded&) const { return closed_form(5); }

  // --- EPA --------------------------------------------------------------------------------------------------------
  PseudoCode epa(int line) const {
    if (recording.scene.scene.dimension == 1)
      return {"EPA", {"polytope = simplex, completed round O", "repeat", "  e = its endpoint nearest O", "  w = support(normal of e)", "  if w not beyond e: depth = |e|", "  remove e", "  w is an endpoint"}, line};
    if (recording.scene.scene.dimension == 2)
      return {"EPA", {"polytope = simplex, completed round O", "repeat", "  e = its edge nearest O", "  w = support(normal of e)", rounded(recording.scene.scene) ? "  if w not beyond e: depth = |e| + radii" : "  if w not beyond e: depth = |e|", "  remove the edges w sees", "  join the ends of the gap to w"}, line};
    return {"EPA", {"polytope = simplex, completed round O", "repeat", "  f = its face nearest O", "  w = support(normal of f)", rounded(recording.scene.scene) ? "  if w not beyond f: depth = |f| + radii" : "  if w not beyond f: depth = |f|", "  remove the faces w sees", "  join the horizon to w"}, line};
  }
  bool has_grown() const {
    const auto grown = [](const Event& event) { return std::holds_alternative<recorded::PolytopeGrown>(event); };
    return std::any_of(recording.events.begin(), recording.events.begin() + static_cast<std::ptrdiff_t>(step), grown);
  }
  /// It ends with the choice of a face that is as far out as a way that is known: nothing is asked along it.
  bool chosen_last() const { return step > 0 && std::holds_alternative<recorded::FaceChosen>(recording.events[step - 1]); }
  PseudoCode operator()(const recorded::PolytopeSeeded&) const { return epa(0); }
  PseudoCode operator()(const recorded::FaceChosen&) const { return epa(2); }
  PseudoCode operator()(const recorded::PolytopeGrown&) const { return epa(6); }
  PseudoCode operator()(const recorded::EpaEnded& e) const {
    switch (e.status) {
      case EpaStatus::converged: return epa(chosen_last() && !foreign(recording) ? 2 : 4);
      case EpaStatus::stalled: return epa(4);
      case EpaStatus::separated: return epa(has_grown() ? 3 : 0);  // a support plane has O beyond it
      case EpaStatus::flat: return epa(0);  // nothing could be completed
      case EpaStatus::iteration_limit:
      case EpaStatus::aborted: break;
    }
    return epa(no_line);
  }

  // --- GJK --------------------------------------------------------------------------------------------------------
  bool boolean() const { return settings.name == MethodName::gjk_boolean; }

  PseudoCode gjk(int line) const {
    if (boolean()) return {"GJK, boolean form", {"W = { support(d) };  d = -w", "repeat", "  w = support(d)", "  if w short of O: apart", "  W = { w } + W", "  W, d = region of O, way to O", "  if W encloses O: overlap"}, line};
    const bool yes_or_no = recording.scene.scene.query == Query::intersect;
    const char* support = settings.name != MethodName::gjk_accelerated ? "  w = support(-v)" : settings.acceleration == Acceleration::newton ? "  w = support(Newton's d or -v)" : settings.acceleration == Acceleration::smoothed ? "  w = support(best plane's d - v, or -v)" : "  w = support(momentum's d or -v)";
    return {foreign(recording) ? "GJK, distance form; yours may differ" : "GJK, distance form",
            {settings.start == Start::previous ? "W = last simplex, or { support(d) }" : "w = support(d);  W = { w }", "repeat", "  v = point of W nearest O", "  W = the part of W that holds v",
             yes_or_no ? "  if |v| <= radii: overlap" : "  if v = O: overlap", support, yes_or_no ? "  if w short of O: apart" : rounded(recording.scene.scene) ? "  if w no farther along -v: return |v| - radii" : "  if w no farther along -v: return |v|", "  W = { w } + W"},
            line};
  }
  PseudoCode operator()(const recorded::GjkBegan&) const { return gjk(0); }
  PseudoCode operator()(const recorded::VertexKept&) const { return gjk(0); }
  PseudoCode operator()(const recorded::SimplexReduced&) const { return gjk(boolean() ? 5 : 3); }
  PseudoCode operator()(const recorded::GjkEnded& e) const {
    if (foreign(recording)) return gjk(no_line);
    switch (e.status) {
      case GjkStatus::enclosed:
      case GjkStatus::touching:
      case GjkStatus::within_radius: return gjk(boolean() ? 6 : 4);
      case GjkStatus::separated: return gjk(boolean() ? 3 : 6);
      case GjkStatus::converged:
      case GjkStatus::stalled:
      case GjkStatus::rule_met: return gjk(boolean() ? no_line : 6);
      case GjkStatus::iteration_limit:
      case GjkStatus::aborted: break;
    }
    return gjk(no_line);
  }

  PseudoCode operator()(const recorded::SupportQueried& e) const {
    switch (e.phase) {
      case Phase::mpr: return mpr(before_the_first_portal() ? 1 : 5);
      case Phase::sat: return sat(2);
      case Phase::projections: return projections(5);
      case Phase::cast: return cast(e.iteration == 0 ? 0 : 2);
      case Phase::seed: return epa(0);
      case Phase::epa: return epa(3);
      case Phase::gjk: break;
    }
    return gjk(e.iteration == 0 ? 0 : boolean() ? 2 : 5);
  }

  /// Of what ran before it.
  PseudoCode operator()(const recorded::Warning&) const {
    PseudoCode code = step > 0 ? pseudo_code(recording, step - 1) : gjk(no_line);
    code.current = no_line;
    return code;
  }
};

}  // namespace

PseudoCode pseudo_code(const Recording& recording, std::size_t step) { return std::visit(PseudoCodeOf{recording, step}, recording.events[step]); }

}  // namespace gjkdbg
