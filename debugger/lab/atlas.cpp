#include "debugger/lab/atlas.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include <nlohmann/json.hpp>

#include "algo/solve.h"
#include "debugger/lab/child.h"
#include "debugger/lab/shrink.h"
#include "recordings/json_writing.h"
#include "shapes/error.h"

namespace gjkdbg {

Verdict judge(const Answered& r, double exact, double size, double unit, double tolerance, double& error) {
  error = 0;
  const double scale = std::max(size, std::abs(exact));
  const bool class_lost = r.overlap != (exact <= 0);
  if (class_lost && std::abs(exact) > 64 * unit * scale) return error = std::abs((r.known ? r.value : 0) - exact) / scale, Verdict::wrong_class;
  if (!r.known) return class_lost ? Verdict::right_within_rounding : Verdict::right;
  if (!std::isfinite(r.value)) return error = std::numeric_limits<double>::infinity(), Verdict::not_finite;
  error = std::abs(r.value - exact) / scale;
  // The bounds count their own rounding; the exact answer here has some, too.
  if (r.bounded && !(exact >= r.lower - 4 * unit * scale && exact <= r.upper + 4 * unit * scale)) return Verdict::lied;
  const double good = std::max(unit > 1e-10 ? 1e-5 : 1e-9, 2 * tolerance);  // what was asked for
  if (error <= 4 * unit && !class_lost) return Verdict::right;
  if (error <= good) return class_lost || error > 64 * unit ? Verdict::right_within_rounding : Verdict::right;
  if (r.unfinished) return Verdict::gave_up;
  return r.bounded ? Verdict::wrong_value : Verdict::lied;
}

namespace {

std::string digits_of(double x, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return text;
}
std::string three_digits(double x) { return digits_of(x, 3); }

/// "this for that", with as many digits as tell them apart, three at least.
std::string beside(double x, double y) {
  int digits = 3;
  while (digits < 17 && x != y && digits_of(x, digits) == digits_of(y, digits)) ++digits;
  return digits_of(x, digits) + " for " + digits_of(y, digits);
}

/// What a method can be asked of a pair: all, or yes or no.
Scene asked(const Variant& variant, Scene scene) {
  if (variant.method.name == MethodName::gjk_boolean && scene.query != Query::cast) scene.query = Query::intersect;
  return scene;
}

Answered ask_ours(const Scene& scene, const Settings& settings) {
  const Result r = solve(scene, settings);
  if (!r.signed_distance) return {r.intersecting, false, 0, 0, 0, false, false};
  return {r.intersecting, true, *r.signed_distance, *r.lower_bound, *r.upper_bound, true, r.status == "iteration_limit" || r.status == "stalled"};
}

Answered ask_theirs(const Scene& scene, const Peer& peer) {
  const auto pair = peer.prepare(scene, 1e-9);
  const PeerAnswer answer = pair->ask();
  return {answer.overlap, answer.signed_distance.has_value(), answer.signed_distance.value_or(0), 0, 0, false, false};
}

/// Judges a cast. At the time it says the bodies are surely apart yet, and no farther than the tolerance from touching; `target` is that gap. What
/// grazes by less may count as a hit or a miss.
Verdict judge_cast(const Result& r, const ExactMotion& exact, double scale, double target, double unit, double& error) {
  error = 0;
  if (r.status == "iteration_limit") return Verdict::gave_up;
  const bool hit = exact.least <= 0;
  if (r.intersecting != hit) {
    if (std::abs(exact.least) <= target) return Verdict::right_within_rounding;
    return error = std::abs(exact.least) / scale, Verdict::wrong_class;
  }
  if (!hit) return Verdict::right;
  const double gap = exact.gap(*r.time), rounding = 64 * unit * scale;
  if (!std::isfinite(gap)) return Verdict::not_finite;
  error = std::abs(gap) / scale;
  if (gap < -rounding) return Verdict::lied;
  return gap <= target + rounding ? Verdict::right : Verdict::wrong_value;
}

struct Judged {
  Verdict verdict = Verdict::not_applicable;
  double error = 0, value = 0;
};

Judged judge_cast_case(const Variant& variant, const AtlasCase& one) {
  Judged out;
  if (variant.peer || !applies(variant, one.scene)) return out;
  const Settings settings = resolve_settings(variant.method, one.scene);
  const Result r = solve(one.scene, settings);
  const double scale = std::max(scene_size(one.scene), (one.scene.bodies[1].pose.position - one.scene.bodies[0].pose.position).norm());
  const double unit = settings.scalar == Scalar::float_precision ? 1.2e-7 : 2.3e-16;
  out.verdict = judge_cast(r, one.motion, scale, 2 * settings.tolerance * scale, unit, out.error);
  return out.value = r.intersecting ? *r.time : std::numeric_limits<double>::infinity(), out;
}

Judged judge_case(const Variant& variant, const Scene& scene, double exact) {
  Judged out;
  if (variant.peer) {
    if (!variant.peer->prepare(scene, 1e-9)) return out;
    Answered answered;
    const ChildEnd end = in_child<Answered>(0.5, answered, [&](Answered& a) { a = ask_theirs(scene, *variant.peer); });
    if (end != ChildEnd::finished) return {Verdict::crashed, 0, 0};
    const double unit = variant.name.ends_with("(float)") ? 1.2e-7 : 2.3e-16;
    out.verdict = judge(answered, exact, scene_size(scene), unit, 1e-6, out.error);  // libraries stop at 1e-6 or so, not at rounding
    return out.value = answered.value, out;
  }
  const Scene question = asked(variant, scene);
  if (!applies(variant, question)) return out;
  const Settings settings = resolve_settings(variant.method, question);
  const Answered answered = ask_ours(question, settings);
  const double unit = settings.scalar == Scalar::float_precision ? 1.2e-7 : 2.3e-16;
  out.verdict = judge(answered, exact, scene_size(scene), unit, settings.tolerance, out.error);
  return out.value = answered.value, out;
}

/// Why a method fails like this.
std::string cause(const Variant& variant, Verdict verdict) {
  if (variant.peer) {
    if (verdict == Verdict::crashed) return "an assertion, a broken address or an endless loop inside the library";
    if (variant.name == "Bullet (float)") return "its scalars are single, and its gap of rest is an absolute length";
    if (variant.name == "libccd MPR" && verdict != Verdict::wrong_class) return "MPR leaves along the line between the centres: no shortest way out";
    if (variant.name == "ODE") return "its routines are made for contacts of bodies that move: depth along one of a few axes";
    return "its stopping rules are absolute lengths, and its simplex is judged in plain arithmetic";
  }
  if (variant.method.name == MethodName::mpr && verdict != Verdict::wrong_class) return "MPR leaves through the portal that the line between the centres meets: an upper bound of the depth, and it says so";
  if (variant.method.stopping == Stopping::opengjk) return "its rule takes squared lengths below 2e-14 for nothing, whatever the scene's size, and ends after 25 iterations";
  if (variant.method.stopping) return "its rule asks for less than bounds that agree";
  if (variant.method.scalar == Scalar::float_precision) return "single precision carries 7 digits of the bodies' sizes, and the answer lies below them";
  return verdict == Verdict::gave_up ? "its steps no longer make progress, and it says so" : "rounding decides, and nothing notices";
}

std::string sentence(const AtlasFamily& family, const Variant& variant, const AtlasCell& cell) {
  static constexpr std::array<const char*, 9> said{"", "", "gives up", "is off, and its bounds admit it", "", "mistakes apart for overlapping", "answers no number", "does not come back", ""};
  std::string verdict = said[static_cast<std::size_t>(cell.verdict)];
  const bool cast = cell.scene.query == Query::cast, missed = cast ? std::isfinite(cell.exact) : cell.exact <= 0;
  if (cell.verdict == Verdict::wrong_class && missed) verdict = "mistakes overlapping for apart";
  if (cell.verdict == Verdict::lied) verdict = cast ? "stops too late" : variant.peer ? "is off, and says it is not" : "gives bounds that exclude the truth";
  return variant.name + " " + verdict + " (" + beside(cell.value, cell.exact) + "): " + cause(variant, cell.verdict) + ". Here: " + family.what + ".";
}

/// The cell's worst scene made as simple as fails like this, with what is answered there. It stays one of its family: about as deep, or as far apart.
void simplify(const Variant& variant, AtlasCell& cell) {
  const Verdict verdict = cell.verdict;
  const double was = cell.exact;
  const auto alike = [&](double exact) { return was == 0 ? exact == 0 : exact / was >= 0.5 && exact / was <= 2; };
  const auto still = [&](const Scene& candidate) {
    const double exact = reference(candidate).signed_distance;
    return alike(exact) && judge_case(variant, candidate, exact).verdict == verdict;
  };
  const bool slow = verdict == Verdict::crashed;  // each time until the end of its patience
  cell.scene = shrunk(cell.scene, still, slow ? 4 : 200);
  if (slow) return;
  const double exact = reference(cell.scene).signed_distance;
  if (const Judged judged = judge_case(variant, cell.scene, exact); judged.verdict == verdict) cell.value = judged.value, cell.exact = exact;
}

AtlasCell sweep(const AtlasFamily& family, const Variant& variant) {
  AtlasCell cell;
  cell.verdict = Verdict::not_applicable;
  bool first = true;
  int failures = 0;
  for (const AtlasCase& one : family.cases) {
    const Judged judged = one.motion.gap ? judge_cast_case(variant, one) : judge_case(variant, one.scene, one.exact);
    if (judged.verdict == Verdict::not_applicable) continue;
    failures += failed(judged.verdict);
    if (first || judged.verdict > cell.verdict || (judged.verdict == cell.verdict && judged.error > cell.worst_error))
      cell = {judged.verdict, judged.error, one.parameter, 0, judged.value, one.exact, one.scene, ""};
    first = false;
  }
  cell.failed = failures;
  if (!failed(cell.verdict)) return cell;
  if (cell.scene.query != Query::cast) simplify(variant, cell);
  cell.why = sentence(family, variant, cell);
  return cell;
}

}  // namespace

Atlas make_atlas(std::vector<AtlasFamily> families, const std::vector<Variant>& methods, const std::function<bool(double)>& progress) {
  Atlas atlas{std::move(families), methods, {}};
  for (std::size_t i = 0; i < atlas.families.size(); ++i) {
    std::vector<AtlasCell> row;
    for (const Variant& variant : atlas.methods) row.push_back(sweep(atlas.families[i], variant));
    atlas.cells.push_back(std::move(row));
    if (!progress(static_cast<double>(i + 1) / static_cast<double>(atlas.families.size()))) break;
  }
  atlas.families.resize(atlas.cells.size());
  return atlas;
}

std::string worse_than_kept(const AtlasCell& now, int cases, const KeptCell& was, bool only_verdict) {
  const auto seriousness = [](Verdict v) { return v == Verdict::not_applicable ? 0 : static_cast<int>(v); };
  const bool given_up_on = now.verdict == Verdict::not_applicable && was.verdict != Verdict::not_applicable;
  if (given_up_on || seriousness(now.verdict) > seriousness(was.verdict)) return std::string(word_of(was.verdict)) + " -> " + word_of(now.verdict);
  if (only_verdict || now.verdict != was.verdict || cases != was.cases) return "";
  if (was.failed >= 0 && now.failed > was.failed) return std::string(word_of(now.verdict)) + " in " + std::to_string(was.failed) + " -> " + std::to_string(now.failed) + " of " + std::to_string(cases) + " cases";
  const bool beyond_rounding = now.verdict != Verdict::right && now.worst_error > 10 * was.worst_error;
  return beyond_rounding ? std::string(word_of(now.verdict)) + ", error " + three_digits(was.worst_error) + " -> " + three_digits(now.worst_error) : "";
}

std::string atlas_csv(const Atlas& atlas) {
  std::string out = "family,method,verdict,worst_error,parameter,failed,cases\n";
  for (std::size_t f = 0; f < atlas.families.size(); ++f)
    for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
      const AtlasCell& cell = atlas.cells[f][m];
      out += atlas.families[f].name + ",\"" + atlas.methods[m].name + "\"," + word_of(cell.verdict) + "," + three_digits(cell.worst_error) + "," + three_digits(cell.parameter) + "," +
             std::to_string(cell.failed) + "," + std::to_string(atlas.families[f].cases.size()) + "\n";
    }
  return out;
}

std::string atlas_json(const Atlas& atlas) {
  nlohmann::ordered_json out{{"format", "gjk-atlas"}, {"version", 1}, {"generator", generator_name()}};
  out["families"] = nlohmann::ordered_json::array();
  for (std::size_t f = 0; f < atlas.families.size(); ++f) {
    nlohmann::ordered_json family{{"name", atlas.families[f].name}, {"what", atlas.families[f].what}, {"cases", atlas.families[f].cases.size()}};
    family["cells"] = nlohmann::ordered_json::array();
    for (std::size_t m = 0; m < atlas.methods.size(); ++m) {
      const AtlasCell& cell = atlas.cells[f][m];
      nlohmann::ordered_json entry{{"method", atlas.methods[m].name}, {"verdict", word_of(cell.verdict)}, {"parameter", cell.parameter}};
      entry["worst_error"] = std::isfinite(cell.worst_error) ? nlohmann::ordered_json(cell.worst_error) : nlohmann::ordered_json(nullptr);
      entry["failed"] = cell.failed;
      if (failed(cell.verdict)) {
        entry["why"] = cell.why;
        SceneFile worst;
        worst.scene = asked(atlas.methods[m], cell.scene);
        worst.scene.name = atlas.families[f].name + ", " + atlas.methods[m].name;
        worst.method = atlas.methods[m].method;  // of another library: the default, to compare with
        entry["scene"] = scene_to_json(worst);
      }
      family["cells"].push_back(entry);
    }
    out["families"].push_back(family);
  }
  return pretty_json(out) + "\n";
}

}  // namespace gjkdbg
