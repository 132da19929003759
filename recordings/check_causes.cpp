// check, what it makes of its findings: which is the cause, what was harmless, what would tell more.
#include <algorithm>

#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

/// What shows that something went wrong before.
const std::set<std::string_view> consequences{"wrong-witness", "wrong-normal",  "wrong-distance",  "wrong-depth", "wrong-answer", "stopped-early", "origin-not-enclosed", "unjustified-separation",
                                              "cycle",         "no-progress",   "support-limit",   "timeout",     "crash"};

}  // namespace

void CheckContext::find(const char* code, const std::string& message, Finding::Severity severity) {
  if (!seen_.insert(code).second) return;
  findings_.push_back({step, severity, code, message});
}

void CheckContext::find_cost(const char* code, const std::string& message) {
  if (!found(code)) costs_.insert(code);
  find(code, message);
}

bool CheckContext::found_here() const {
  return std::any_of(findings_.begin(), findings_.end(), [this](const Finding& f) { return f.step == step; });
}

void CheckContext::suspect(const char* code, const std::string& message) {
  last_suspicion_ = Finding{step, Finding::Severity::error, code, message};
  if (!suspicion_) suspicion_ = last_suspicion_;
}

void CheckContext::reset(const std::string& message) {
  suspect("wrong-region", message + " The search is taken to begin again. Where it does not, the usual cause is a simplex that is cleared, or a region test with a flipped sign.");
  if (!reset_) reset_ = Finding{step, Finding::Severity::error, "wrong-region", message};
  ++resets_;
}

/// The step that reduced a simplex last.
std::optional<std::size_t> CheckContext::last_simplex() const {
  for (std::size_t i = recording.events.size(); i-- > 0;)
    if (std::holds_alternative<recorded::SimplexReduced>(recording.events[i])) return i;
  return std::nullopt;
}

/// Of one step: what says most exactly what went wrong before what only shows it.
void CheckContext::put_causes_first() {
  static constexpr std::pair<std::string_view, std::string_view> pairs[] = {
      {"unjustified-separation", "stopped-early"}, {"visible-face-kept", "wrong-horizon"}, {"open-polytope", "wrong-horizon"}, {"wrong-face", "not-closest-face"}};
  const auto holds = [this](std::string_view cause) {
    if (cause == "unjustified-separation") return !recording.result.signed_distance || *reference().signed_distance <= 0;  // apart they are: the distance is not yet one
    return cause != "wrong-face" || inferred;  // a solver's faces are known by their vertices, ours by number
  };
  for (const auto& [cause, shown] : pairs) {
    const auto of = [&](std::string_view code) { return std::find_if(findings_.begin(), findings_.end(), [&](const Finding& f) { return f.code == code; }); };
    const auto first = of(shown), second = of(cause);
    if (first != findings_.end() && second != findings_.end() && first < second && first->step == second->step && holds(cause)) std::rotate(first, second, second + 1);
  }
}

/// What explains the first error, of what was harmless by itself.
std::optional<Finding> CheckContext::cause_of(const Finding& root) const {
  const bool shows = consequences.contains(root.code);
  if (last_is_nearest && root.step + 1 == recording.events.size()) return std::nullopt;  // the search came to the right end
  if (resets_ > 1 && reset_->step < root.step && (shows || root.code == "wrong-region")) {
    Finding first = *reset_;
    first.message += " So it goes on, " + std::to_string(resets_) + " times in all, and no search begins anew so often. The usual cause is a region test with a flipped sign, which keeps the newest vertex alone, or a simplex that is cleared.";
    return first;
  }
  if (!shows) return std::nullopt;
  const bool of_the_last = root.code == "origin-not-enclosed" || root.code == "wrong-answer";
  const std::optional<Finding>& cause = of_the_last ? last_suspicion_ : suspicion_;
  const bool is_cause = cause && (!of_the_last || cause->step == last_simplex()) && cause->step < root.step && !seen_.contains(cause->code);
  // A vertex too many in GJK's simplex does EPA no harm.
  if (short_ && !seen_.contains(short_->code) && root.step >= short_->step && (!is_cause || cause->code == "wrong-region")) return short_;
  if (is_cause) return cause;
  return doubt_ && doubt_->step < root.step && !seen_.contains(doubt_->code) ? doubt_ : std::nullopt;
}

/// Where supports and the answer are all there is, the step that went wrong cannot be told.
void CheckContext::tell_what_to_report(Finding& root) const {
  if (!inferred || !consequences.contains(root.code) || root.code == "crash" || explained_.contains(root.code)) return;
  int supports = 0;
  bool simplex = false, faces = false;
  for (const Event& event : recording.events) {
    supports += std::holds_alternative<recorded::SupportQueried>(event) ? 1 : 0;
    simplex = simplex || std::holds_alternative<recorded::SimplexReduced>(event);
    faces = faces || std::holds_alternative<recorded::PolytopeSeeded>(event) || std::holds_alternative<recorded::FaceChosen>(event);
  }
  const bool of_the_depth = recording.result.intersecting && (root.code == "wrong-depth" || root.code == "wrong-normal" || root.code == "wrong-witness");
  if (supports < 2 || faces) return;
  if (!simplex) root.message += std::string(" No more than supports and the answer was reported: report the simplex after every step") + (recording.result.intersecting && recording.scene.scene.query > Query::distance ? ", and EPA's polytope," : "") + " and the step that goes wrong can be named.";
  else if (of_the_depth) root.message += " Of the search for the depth nothing was reported: report EPA's polytope and the faces chosen, and the step that goes wrong can be named.";
}

/// What was to stop, and then ends by itself with the right answer, has cost time and no more. Of ours that is known where rounding alone led it round, whatever ended it: a limit says so itself.
void CheckContext::soften_what_only_costs() {
  const Result& r = recording.result;
  const bool ended = !r.status.empty() && r.status != "iteration_limit" && !unanswered(r);
  if (foreign(recording) && !ended) return;
  if (std::any_of(findings_.begin(), findings_.end(), [&](const Finding& f) { return f.severity == Finding::Severity::error && !costs_.contains(f.code); })) return;
  for (Finding& f : findings_) {
    if (!(foreign(recording) ? costs_ : stalls_).contains(f.code)) continue;
    f.severity = Finding::Severity::warning;
    for (const std::string_view endless : {"the search will never end", "EPA will never end", "it will never end"})
      if (const std::size_t at = f.message.find(endless); at != std::string::npos) f.message.replace(at, endless.size(), "nothing is gained by it");
    if (ended) f.message += " It ended all the same, and with the right answer: here it merely costs.";
  }
}

std::vector<Finding> CheckContext::take() {
  soften_what_only_costs();
  std::vector<Finding> out = told();
  for (const Finding& f : mentioned_) {
    const auto says_more = [&](const Finding& other) { return other.code == f.code || (other.severity == Finding::Severity::error && other.step < f.step); };
    if (std::none_of(out.begin(), out.end(), says_more)) out.insert(std::find_if(out.begin(), out.end(), [&](const Finding& other) { return other.step > f.step; }), f);
  }
  return out;
}

std::vector<Finding> CheckContext::told() {
  const auto is_error = [](const Finding& f) { return f.severity == Finding::Severity::error; };
  const auto by_step = [](const Finding& x, const Finding& y) { return x.step < y.step; };
  std::stable_sort(findings_.begin(), findings_.end(), [&](const Finding& x, const Finding& y) { return x.step != y.step ? x.step < y.step : is_error(x) && !is_error(y); });
  put_causes_first();
  auto root = std::find_if(findings_.begin(), findings_.end(), is_error);
  if (root == findings_.end()) return std::move(findings_);
  if (const std::optional<Finding> cause = cause_of(*root)) {
    findings_.insert(root, *cause);
    std::stable_sort(findings_.begin(), findings_.end(), by_step);
    root = std::find_if(findings_.begin(), findings_.end(), is_error);
    findings_.erase(std::remove_if(root + 1, findings_.end(), [&](const Finding& f) { return f.code == cause->code; }), findings_.end());
  }
  for (Finding& f : findings_) {
    if (f.code != "direction-not-perpendicular") continue;
    if (const std::size_t at = f.message.find(harmless); at != std::string::npos) f.message.erase(at, harmless.size());
    if (f.step < root->step) f.message += " The run goes wrong at step " + std::to_string(root->step) + ".", root->message += " It may come of the direction of step " + std::to_string(f.step) + ".";
  }
  if (const auto digits = std::find_if(findings_.begin(), root, [](const Finding& f) { return f.code == "few-digits"; }); digits != root) root->message += " It may come of the digits that are lacking at step " + std::to_string(digits->step) + ".";
  tell_what_to_report(*root);
  for (auto f = root + 1; f != findings_.end(); ++f) f->message = (f->step == root->step ? "Of the same cause, probably. " : "Follows from step " + std::to_string(root->step) + ", probably. ") + f->message;
  return std::move(findings_);
}

}  // namespace gjkdbg
