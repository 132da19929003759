#include "recordings/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algo/motion.h"
#include "recordings/check_context.h"
#include "recordings/check_record.h"
#include "recordings/region_tests.h"
#include "recordings/json_writing.h"
#include "shapes/convex.h"
#include "shapes/corners.h"

namespace gjkdbg {

NearestPoint nearest_point(const std::vector<AnyVector>& points) {
  NearestPoint best{points[0], {0}};
  for (const RegionTest& test : region_tests({points.begin(), points.begin() + std::min<std::ptrdiff_t>(8, std::ssize(points))}, 1e-12)) {
    if (!test.holds_projection) continue;
    AnyVector v = AnyVector::Zero(points[0].size());
    for (std::size_t i = 0; i < test.part.size(); ++i) v += test.weights[i] * points[static_cast<std::size_t>(test.part[i])];
    if (v.norm() < best.v.norm()) best = {v, test.part};
  }
  return best;
}

std::string text_of(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x == 0 ? 0.0 : x);
  return text;
}

std::string bound_text(double x) { return std::isfinite(x) ? text_of(x) : "(not known)"; }

std::string text_of(const AnyVector& v) {
  std::string out = "(";
  for (Eigen::Index i = 0; i < v.size(); ++i) out += (i > 0 ? ", " : "") + text_of(v[i]);
  return out + ")";
}

std::string list_of(const std::vector<int>& numbers) {
  std::string out = "[";
  for (std::size_t i = 0; i < numbers.size(); ++i) out += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
  return out + "]";
}

std::string by_length(double length) {
  return " The distance is measured with a normal of length " + text_of(length) + ": divide the normal by its length first, or faces of larger area look farther away.";
}

std::string winding_hint(const std::vector<std::vector<int>>& faces) {
  std::map<std::pair<int, int>, const std::vector<int>*> edges;
  const std::string rule = " Where the horizon is what is left when edges are cancelled by their opposite direction, all faces have to be wound alike";
  for (const std::vector<int>& face : faces)
    for (std::size_t i = 0; face.size() == 3 && i < 3; ++i) {
      const auto [other, is_new] = edges.try_emplace({face[i], face[(i + 1) % 3]}, &face);
      if (!is_new)
        return rule + ": before this step the edge " + std::to_string(face[i]) + "-" + std::to_string(face[(i + 1) % 3]) + " ran the same way in " + list_of(*other->second) + " and " + list_of(face) + ". Wind a new face (p, q, new) as the edge (p, q) ran in the face that was removed.";
    }
  return edges.empty() ? "" : rule + ", as they were before this step: then two that share an edge have it in opposite directions, and (p, q) is cancelled by (q, p), not by (p, q).";
}

bool contains(const std::vector<int>& list, int x) { return std::find(list.begin(), list.end(), x) != list.end(); }

/// A point x of a body at p has coordinates of the world up to r = |p| + |x|, and each of them is rounded: with u = epsilon / 2, the point is off by u r, the sum over a body's
/// vertices with weights that sum to 1 only so nearly by 4 u r for the weights and 4 u r for the sum, and its height along a direction, three products and two sums, by 3 u r
/// more. Of two bodies' difference all of this comes together, and the subtraction's own rounding: 13 u (rA + rB), below 8 epsilon (rA + rB). In a cast a body is where its
/// velocity takes it in the meantime, too. This is of doubles, as files have them, whatever is reckoned in: who rounds to single precision in the world, not in the frame of a body, loses
/// what need not be lost, and is told so.
double rounding_in_the_world(const Scene& scene) {
  std::vector<double> reaches;
  for (const Body& b : scene.bodies) reaches.push_back(b.pose.position.stableNorm() + reach_of(b.shape, scene.dimension) + (scene.query == Query::cast && b.motion ? b.motion->velocity.stableNorm() : 0));
  std::sort(reaches.rbegin(), reaches.rend());  // of more than two bodies those farthest out
  if (reaches.size() > 2) reaches.resize(2);
  double sum = 0;
  for (const double reach : reaches) sum += reach;
  return 8 * std::numeric_limits<double>::epsilon() * sum;
}

CheckContext::CheckContext(const Recording& r, const Recording& as_written, double told_in) : recording(r), written(as_written), unit(told_in), dimension(r.scene.scene.dimension), inferred(r.generator.starts_with("a solver under ")) {
  const auto& bodies = r.scene.scene.bodies;
  const bool moves = r.scene.scene.query == Query::cast || r.scene.scene.query == Query::simulate;
  has_supports = !moves && std::none_of(bodies.begin(), bodies.end(), [](const Body& b) { return std::holds_alternative<Mesh>(b.shape.geometry); });
  double reach = 0;  // about as long as w can be: one of 1e155 is wrong, and must not loosen the tolerances
  for (const Body& b : bodies) size = std::max(size, size_of(b.shape)), reach += 2 * size_of(b.shape);
  reach += moves || bodies.size() < 2 ? std::numeric_limits<double>::max() : (bodies[1].pose.position - bodies[0].pose.position).stableNorm();
  for (const Event& event : r.events)
    if (const auto q = given_vertex(event)) size = std::max(size, std::min(q->w.stableNorm(), reach));
  if (size == 0) size = 1;
  const bool single = r.settings.scalar == Scalar::float_precision;
  world = rounding_in_the_world(r.scene.scene) + 8 * std::numeric_limits<double>::denorm_min() / unit;  // below the normal numbers digits are fewer
  tolerance = (single ? 1e-4 : 1e-9) * size + world;
  stop = std::max(single ? 1e-3 : 1e-6, 8 * r.settings.tolerance);
  if (!has_supports) return;
  a_.emplace(bodies[0], dimension), b_.emplace(bodies[1], dimension);
  radius_ = a_->radius() + b_->radius();
  // Whose vertices are these? Of a simplex that was kept, those of the cores. Else the first query with a direction tells, of MPR's only where there are no others.
  const bool kept = !foreign(r) && std::any_of(r.events.begin(), r.events.end(), [](const Event& event) { return std::holds_alternative<recorded::VertexKept>(event); });
  for (const bool of_mpr : {true, false})
    for (const Event& event : r.events) {
      const auto* q = std::get_if<recorded::SupportQueried>(&event);
      if (!q || (q->phase == Phase::mpr) != of_mpr || kept || !q->direction.allFinite() || q->direction.isZero(0) || radius_ == 0) continue;
      const double along = q->direction.stableNormalized().dot(q->w);
      cores = true;  // which `height` goes by
      told_cores_ = std::abs(along - height(q->direction)) <= std::abs(along - body_height(q->direction));
      break;
    }
  of_cores();
  const bool round = std::any_of(bodies.begin(), bodies.end(), [&](const Body& b) { return !corners_of(b.shape, dimension); });
  if (round || (!cores && radius_ > 0)) stop = std::max(stop, 1e-3);  // bounds on smooth differences meet slowly, in any implementation
}

const Result& CheckContext::reference() {
  if (!reference_) {
    Scene scene = recording.scene.scene;
    scene.query = Query::penetration;
    reference_ = solve(scene, resolve_settings({}, scene));
  }
  return *reference_;
}

double CheckContext::answer_tolerance() {
  const Result& r = reference();
  return stop * std::max(size, std::abs(*r.signed_distance)) + (*r.upper_bound - *r.lower_bound) + world;
}

double CheckContext::height(const AnyVector& direction) const {
  const AnyVector d = direction.stableNormalized();
  return d.dot((*a_)(d, !cores) - (*b_)(-d, !cores));
}

double CheckContext::body_height(const AnyVector& direction) const {
  const AnyVector d = direction.stableNormalized();
  return d.dot((*a_)(d, true) - (*b_)(-d, true));
}

double CheckContext::apart_along(const AnyVector& direction) {
  if (has_supports) return -body_height(direction);
  const Scene& scene = recording.scene.scene;
  if (nearest_.empty()) {
    const double least = *reference().signed_distance + answer_tolerance();
    for (const Shape& part_a : convex_parts(scene.bodies[0].shape))
      for (const Shape& part_b : convex_parts(scene.bodies[1].shape)) {
        Scene parts = scene;
        parts.query = Query::penetration, parts.bodies[0].shape = part_a, parts.bodies[1].shape = part_b;
        if (*solve(parts, resolve_settings({}, parts)).signed_distance <= least) nearest_.emplace_back(WorldSupport(parts.bodies[0], dimension), WorldSupport(parts.bodies[1], dimension));
      }
  }
  const AnyVector d = direction.stableNormalized();
  double apart = -std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : nearest_) apart = std::max(apart, d.dot(b(-d, true) - a(d, true)));
  return apart;
}

double CheckContext::short_of_support(std::size_t body, const AnyVector& direction, const AnyVector& point) const {
  const WorldSupport& support = body == 0 ? *a_ : *b_;
  double least = std::numeric_limits<double>::infinity();
  for (const bool whole : {false, true}) {
    const AnyVector right = support(direction, whole);
    if ((right - point).norm() <= tolerance) return 0;
    least = std::min(least, std::abs(direction.dot(right - point)));
  }
  // Another point of the same height will do where there are several, so long as it is one of the body's.
  return std::max(least, outside(recording.scene.scene, body, point));
}

const AnyVector* CheckContext::vertex(int number) {
  const auto found = vertices.find(number);
  if (found != vertices.end()) return &found->second;
  find("unknown-vertex", "Vertex " + std::to_string(number) + " was never handed out by a support query; " + std::to_string(vertices.size()) +
                             " were so far. The usual cause is an index that counts from 1, or one into a list that has since been compacted.");
  return nullptr;
}

bool CheckContext::check_direction(const AnyVector& d) {
  if (!d.allFinite()) {
    find("non-finite-direction", "The search direction holds a number that is not finite. The usual cause is normalising a zero vector, or a division by a zero area one step earlier: test the length before dividing.");
    return false;
  }
  if (d.isZero(0)) {
    find("zero-direction", "The search direction is zero. The usual cause is the origin lying on the simplex, where the triple product vanishes, or two centres that coincide at the start: the "
                           "first is an overlap (touching, where no more is asked; for the depth go on across the simplex, along any perpendicular); for the second start along any axis.");
    return false;
  }
  return true;
}

bool CheckContext::of_few_digits(const AnyVector& given, const AnyVector& right, const std::string& what) {
  if (!inferred || !given.allFinite()) return false;
  const double off = (given - right).norm();
  // What single precision leaves of a nearest point: as far away as it should be, and beside it by the root of that.
  const double limit = std::max(1e-5 * right.norm(), 1e-6 * size), beside = std::sqrt(2e-6 * size * (right.norm() + 1e-6 * size));
  bool seven = off <= 1e-5 * right.norm(), single = off <= std::max(limit, beside) && std::abs(given.norm() - right.norm()) <= limit;
  for (double x : given) {
    x *= unit;  // as it stands in the file
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", x);
    seven = seven && std::strtod(text, nullptr) == x;
    single = single && static_cast<double>(static_cast<float>(x)) == x;
  }
  if (!seven && !single) return false;
  find("few-digits", what + " is off by " + text_of(off) + (seven ? ", and has no more than seven digits: print all seventeen (%.17g), or run with --scalar float, which asks for no more."
                                                                  : ", and its numbers are those of single precision: run with --scalar float, which asks for no more; else what follows of it is told as errors."),
       Finding::Severity::warning);
  return true;
}

std::string CheckContext::lost_far_out(const std::vector<int>& numbers, double off) const {
  double far = 0;
  for (const Event& event : recording.events)
    if (const auto given = given_vertex(event); given && contains(numbers, given->vertex)) far = std::max({far, given->a.stableNorm(), given->b.stableNorm()});
  if (far <= 10 * size || off > 4 * std::numeric_limits<float>::epsilon() * far) return "";
  return " The points of the bodies are " + text_of(far) + " from the world's origin, where single precision tells lengths of " + text_of(std::numeric_limits<float>::epsilon() * far) +
         " apart and no less: a - b has lost the rest. Count in double precision, or in the frame of one body, before a and b are rounded.";
}

namespace {

struct Walk {
  CheckContext& c;
  std::optional<GjkCheck> run_gjk;  ///< a mesh makes one run per triangle: each begins anew
  std::optional<EpaCheck> run_epa;
  double best_plane = -1e300;

  explicit Walk(CheckContext& context) : c(context) { begin(); }
  void begin() {
    finish();
    run_gjk.emplace(c), run_epa.emplace(c);
  }
  void finish() {
    if (run_epa) run_epa->finish();
  }

  void operator()(const recorded::GjkBegan& e) {
    begin();
    (*run_gjk)(e);
  }
  void operator()(const recorded::SupportQueried& e) {
    if (e.phase == Phase::gjk) {
      (*run_gjk)(e);
      best_plane = std::max(best_plane, run_gjk->best_plane());
    } else if (c.check_direction(e.direction)) {
      (*run_epa)(e);
    }
    c.vertices[e.vertex] = e.w;
  }
  void operator()(const recorded::VertexKept& e) {
    c.vertices[e.vertex] = e.w;
    (*run_gjk)(e);
  }
  void operator()(const recorded::SimplexReduced& e) { (*run_gjk)(e); }
  void operator()(const recorded::GjkEnded& e) { (*run_gjk)(e); }
  void operator()(const recorded::PolytopeSeeded& e) { (*run_epa)(e); }
  void operator()(const recorded::FaceChosen& e) { (*run_epa)(e); }
  void operator()(const recorded::PolytopeGrown& e) { (*run_epa)(e); }
  void operator()(const recorded::EpaEnded& e) { (*run_epa)(e); }
  /// Our own methods alone report these; the answer is judged at the end.
  void operator()(const recorded::MprBegan&) { c.of_bodies(); }
  void operator()(const recorded::PortalFound&) {}
  void operator()(const recorded::MprEnded&) {}
  void operator()(const recorded::SatBegan&) {}
  void operator()(const recorded::AxisTested& e) { best_plane = std::max(best_plane, e.distance + c.radius); }
  void operator()(const recorded::PointsProjected& e) { best_plane = std::max(best_plane, e.lower_bound + c.radius); }
  void operator()(const recorded::SatEnded&) {}
  void operator()(const recorded::ClosedFormBegan&) {}
  void operator()(const recorded::LinesSolved&) {}
  void operator()(const recorded::ClosedFormEnded& e) { best_plane = std::max(best_plane, e.lower_bound + c.radius); }
  void operator()(const recorded::ProjectionsBegan&) {}
  void operator()(const recorded::PointPredicted&) {}
  void operator()(const recorded::ProjectionsEnded& e) { best_plane = std::max(best_plane, e.lower_bound + c.radius); }
  /// Judged as a whole by check_cast and check_simulation.
  void operator()(const recorded::CastBegan&) {}
  void operator()(const recorded::CastAdvanced&) {}
  void operator()(const recorded::CastEnded&) {}
  void operator()(const recorded::State&) {}
  void operator()(const recorded::ContactFound&) {}
  void operator()(const recorded::ImpulseApplied&) {}
  /// What `run` noted when a solver failed, or named what it had not been given.
  void operator()(const recorded::Warning& e) {
    for (const char* code : {"timeout", "crash", "bad-message", "support-limit", "no-result", "unknown-vertex", "wrong-face", "open-polytope", "zero-area-face"})
      if (e.code == code) c.find(code, e.message, e.code == "timeout" && c.recording.result.status != "aborted" ? Finding::Severity::warning : Finding::Severity::error);  // after the result it merely costs
    for (const char* code : {"unknown-field", "direction-not-asked"})
      if (e.code == code) c.find(code, e.message, Finding::Severity::warning);
  }
};

}  // namespace

std::vector<Finding> check_steps(const Recording& run, std::size_t first) {
  CheckContext context(run);
  TraceCheck trace(context);
  Walk walk(context);
  RecordCheck record(context);
  bool any = false;
  for (std::size_t i = first; i < run.events.size(); ++i) {
    context.step = i;
    const Event& event = run.events[i];
    if (const auto given = given_vertex(event); given && !std::exchange(any, true)) record.goes_on(given->vertex);
    trace.order(event);
    std::visit(walk, event);
    trace.values(event);
    record(event);
    check_extent(context, event);
  }
  walk.finish();
  return context.take();
}

namespace {

std::vector<Finding> judged(CheckContext context) {
  const Recording& recording = context.recording;
  TraceCheck trace(context);
  Walk walk(context);
  RecordCheck record(context);
  OrderCheck steps(context);
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    context.step = i;
    trace.order(recording.events[i]);
    std::visit(walk, recording.events[i]);
    trace.values(recording.events[i]);
    record(recording.events[i]);
    steps(recording.events[i]);
    check_extent(context, recording.events[i]);
    if (std::holds_alternative<recorded::MprEnded>(recording.events[i])) context.of_cores();
  }
  walk.finish();
  trace.finish();
  const Query query = recording.scene.scene.query;
  if (query == Query::cast || query == Query::simulate) {
    query == Query::cast ? check_cast(context) : check_simulation(context);
    check_runs(context);
    record.motion();
    check_extent(context, recording.result);
    return context.take();
  }
  if (recording.result.status != "aborted" || !foreign(recording)) {
    const bool yes_or_no = distance_out_of_range(context);
    check_result(context, walk.best_plane, yes_or_no);
    if (!yes_or_no) record.result();
  }
  check_extent(context, recording.result);
  check_need(context);
  return context.take();
}

}  // namespace

std::vector<Finding> check(const Recording& recording) {
  const std::optional<InOtherUnits> small = in_units_of_its_own(recording);
  std::vector<Finding> findings = small ? told_in_units(judged({small->recording, recording, small->unit}), *small) : judged(CheckContext(recording));
  tell_changed(recording, findings);
  return findings;
}

std::string findings_to_json(const std::vector<Finding>& findings) {
  std::string out = "{\"findings\": [";
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Finding& f = findings[i];
    out += i == 0 ? "\n" : ",\n";
    out += "{\"step\": " + std::to_string(f.step) + ", \"severity\": \"" + (f.severity == Finding::Severity::error ? "error" : "warning") + "\", \"code\": \"" + f.code + "\", \"message\": ";
    append_string(out, f.message);
    out += '}';
  }
  return out + (findings.empty() ? "]}\n" : "\n]}\n");
}

}  // namespace gjkdbg
