// check, cast: the answer, whether bodies meet, when and where, whoever computed it. Its steps: check_cast_steps.cpp.
#include <algorithm>
#include <cmath>

#include "recordings/cast_stretch.h"
#include "recordings/check_context.h"
#include "shapes/corners.h"

namespace gjkdbg {
namespace {

struct CastCheck : CastStretch {
  CheckContext& c;
  const Result& result;
  const double limit;  ///< on lengths
  const Result right;  ///< ours, until the first impact

  explicit CastCheck(CheckContext& context)
      : CastStretch{context.recording.scene.scene}, c(context), result(c.recording.result), limit(c.stop * c.size + c.world), right(ours()) {}

  Result ours() const {
    Scene first = scene;
    if (first.motion) first.motion->response = Response::stop;
    return solve(first, resolve_settings({}, first));
  }

  /// False when there is nothing more to judge.
  bool consistent() const {
    const bool met = result.status == "hit" || result.status == "initially_overlapping";
    if ((met || result.status == "miss") && met != result.intersecting) {
      c.find("wrong-answer", "The status is \"" + result.status.text() + "\", but intersecting is " + (result.intersecting ? "true." : "false."));
      return false;
    }
    if (result.time && !(*result.time >= 0 && *result.time <= 1)) c.find("wrong-time", "The time " + text_of(*result.time) + " is not of the interval, 0 to 1.");
    else if (result.status == "miss" && result.time && *result.time < 1 - 1e-9) c.find("wrong-time", "Nothing is met, but the bodies are said to be apart until " + text_of(*result.time) + " only, not 1.");
    if (!result.intersecting) return claims_nothing(), false;
    if (!result.pair || !exists(*result.pair)) {
      c.find("wrong-pair", result.pair ? "The scene has no bodies " + std::to_string((*result.pair)[0]) + " and " + std::to_string((*result.pair)[1]) + " that could meet." : "Bodies meet, but which is not said.");
      return false;
    }
    all_is_said();
    return result.time.has_value();
  }

  /// Of bodies that do not meet there is no impact.
  void claims_nothing() const {
    const char* what = result.pair ? "pair" : result.touching_at ? "touching_at" : result.normal ? "normal" : result.witness_a || result.witness_b ? "witness points" : nullptr;
    if (what) c.find("wrong-answer", "Nothing is met by this result, but it has the " + std::string(what) + " of an impact.");
  }

  /// Ours names the place of every impact; where bodies overlap at the beginning and the search for the way out came to its limit, a warning stands for it.
  void all_is_said() const {
    const auto told = [](const Event& event) {
      const auto* warning = std::get_if<recorded::Warning>(&event);
      return warning && warning->code == "way-out-unknown";
    };
    const bool known = result.normal && result.witness_a && result.witness_b, unknown = !result.normal && !result.witness_a && !result.witness_b;
    const bool warned = std::any_of(c.recording.events.begin(), c.recording.events.end(), told);
    if (foreign(c.recording) || (warned ? unknown && result.status == "initially_overlapping" : known)) return;
    c.find("inconsistent", warned ? "A warning says that the way out is not known, but the result has a normal or a witness point." : "Bodies meet, but the result has not the normal and both witness points.", Finding::Severity::warning);
  }

  void impact() const {
    if (!consistent()) return;
    const std::array<int, 2>& pair = *result.pair;
    const double time = *result.time, gap = gap_at(pair, time);
    const std::string who = names_of(pair);
    if (gap > limit) {
      const bool others = right.pair && *right.pair != pair && std::abs(*right.time - time) * speed(pair) <= limit;
      c.find(others ? "wrong-pair" : "wrong-time", "At time " + text_of(time) + " " + who + " are " + text_of(gap) + " apart" + (right.intersecting ? ", and the first to meet are " + std::to_string((*right.pair)[0]) + " and " + std::to_string((*right.pair)[1]) + ", at " + text_of(*right.time) + "." : "."));
      return;
    }
    if (gap < -limit && result.status != "initially_overlapping") return c.find("wrong-time", "At time " + text_of(time) + " " + who + " overlap by " + text_of(-gap) + " already.");
    if (result.touching_at && (!(*result.touching_at >= time && *result.touching_at <= 1) || gap_at(pair, *result.touching_at) > limit)) c.find("wrong-time", "At " + text_of(*result.touching_at) + " " + who + " do not surely touch.");
    normal_and_witnesses(at(pair, time), gap);
  }

  void normal_and_witnesses(const Scene& two, double gap) const {
    if (!result.normal) return;
    const AnyVector& n = *result.normal;
    if (const std::string off = c.not_unit(n); !off.empty()) return c.find("wrong-normal", off);
    if (has_mesh(*result.pair)) return;
    if (any_way_out(c.recording.settings, gap) && result.status == "initially_overlapping") return way_out(n, along(two, n));
    if (along(two, n) < gap - 10 * limit) {
      const bool flipped = along(two, -n) >= gap - 10 * limit;
      c.find(flipped ? "flipped-normal" : "wrong-normal", "At the impact the bodies are " + text_of(gap) + " apart, but along the normal " + text_of(n) + " " + text_of(along(two, n)) + (flipped ? ": it points from the second body to the first." : "."));
    }
    if (!result.witness_a || !result.witness_b) return;
    // Along a smooth surface points are known less well than distances.
    const bool round = std::any_of(two.bodies.begin(), two.bodies.end(), [&](const Body& b) { return !corners_of(b.shape, scene.dimension); });
    const double slack = round ? std::max(10 * limit, 1e-3 * c.size) : 10 * limit;
    const double out_a = outside(two, 0, *result.witness_a), out_b = outside(two, 1, *result.witness_b);
    if (std::max(out_a, out_b) > slack) c.find("wrong-witness", std::string("At the time of impact witness_") + (out_a > out_b ? "a" : "b") + " lies " + text_of(std::max(out_a, out_b)) + " outside its body.");
    else if ((*result.witness_b - *result.witness_a - gap * n).norm() > slack) c.find("wrong-witness", "The witness points are " + text_of((*result.witness_b - *result.witness_a).norm()) + " from each other, but the bodies " + text_of(gap) + ".");
  }

  /// The witness points of a depth by MPR keep its normal's line, and need not lie on both bodies.
  void way_out(const AnyVector& n, double apart) const {
    if (!result.witness_a || !result.witness_b || (*result.witness_b - *result.witness_a - apart * n).norm() <= std::max(10 * limit, 1e-3 * c.size)) return;
    c.find("wrong-witness", "The witness points are " + text_of((*result.witness_b - *result.witness_a).norm()) + " from each other, but along the normal the bodies overlap by " + text_of(-apart) + ".");
  }

  /// The bodies are apart until `time`, whatever pair was named: at samples between, and where our own cast has them meet, as often as it takes
  /// to see whether they go in.
  void tunnelling() const {
    if (!result.time || result.status == "initially_overlapping" || result.status == "iteration_limit") return;
    constexpr int samples = 64;
    const double until = result.intersecting ? std::min(1.0, *result.time) : 1;
    const int n = static_cast<int>(scene.bodies.size());
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        const std::array<int, 2> pair{i, j};
        if (!(speed(pair) > 0)) continue;
        std::vector<double> times;
        for (int k = 1; k < samples; ++k) times.push_back(until * k / samples);
        if (right.intersecting && right.pair == pair)
          for (int k = 1; k < samples; ++k) times.push_back(*right.time + 2 * k * limit / speed(pair));
        for (const double t : times) {
          if (t >= until) continue;
          const double gap = gap_at(pair, t);
          if (gap >= -limit) continue;
          c.find("tunnelling", "Bodies " + std::to_string(i) + " and " + std::to_string(j) + " overlap by " + text_of(-gap) + " at time " + text_of(t) + (result.intersecting ? ", before the time of impact " + text_of(until) : ", but no impact is reported") + ".");
          return;
        }
      }
  }

  void met_against_the_normal() const {
    if (!result.intersecting || !result.normal || !result.pair || !exists(*result.pair) || result.status == "initially_overlapping") return;
    const std::array<int, 2>& pair = *result.pair;
    const double closing = approach(pair, *result.normal);
    if (turns(pair[0]) || turns(pair[1]) || closing >= -1e-9 * speed(pair)) return;
    c.find("normal-against-approach", "The bodies come together against the normal " + text_of(*result.normal) + ": their velocity along it is " + text_of(closing) + ". It should point from the first body to the second.");
  }

  /// What looks along a wall, bounds how fast bodies turn and makes sure that they touch asks supports without a trace: only the same again tells how many.
  void counts() const {
    if (c.recording.generator != generator_name()) return;
    const Result again = c.once_more();
    if (result.support_calls != again.support_calls)
      c.find("inconsistent", "The result counts " + std::to_string(result.support_calls) + " support calls; the scene takes " + std::to_string(again.support_calls) + ".", Finding::Severity::warning);
    if (result.intersecting && (result.touching_at.has_value() != again.touching_at.has_value() || std::abs(result.touching_at.value_or(0) - again.touching_at.value_or(0)) > 1e-7))
      c.find("inconsistent", "The bodies surely touch at " + (again.touching_at ? text_of(*again.touching_at) : "no time that is known") + ", but the result says " + (result.touching_at ? text_of(*result.touching_at) : "none") + ".", Finding::Severity::warning);
  }
};

}  // namespace

void check_cast(CheckContext& c) {
  const CastCheck judge(c);
  check_cast_steps(c);
  judge.met_against_the_normal();
  judge.tunnelling();
  judge.impact();
  judge.counts();
}

}  // namespace gjkdbg
