// check, GJK's end: what it claims, and what it stopped at.
#include <algorithm>
#include <cmath>
#include <limits>

#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

/// How many dimensions the points span: how often the farthest of them is beyond the flat through those before.
int dimensions_spanned(const std::vector<AnyVector>& points, double tolerance) {
  std::vector<AnyVector> rest;
  for (const AnyVector& p : points) rest.push_back(p - points[0]);
  int spanned = 0;
  for (; spanned < points[0].size(); ++spanned) {
    const auto farthest = std::max_element(rest.begin(), rest.end(), [](const AnyVector& x, const AnyVector& y) { return x.norm() < y.norm(); });
    const double reach = farthest->norm();
    if (!(reach > tolerance)) break;
    const AnyVector axis = *farthest / reach;
    for (AnyVector& p : rest) p -= axis.dot(p) * axis;
  }
  return spanned;
}

}  // namespace

/// What was asked for since the last simplex, and with it comes nearer.
void GjkCheck::note_unkept(double v, const std::vector<int>& all) {
  if (pending_.empty() || all.size() > 6) return;
  const NearestPoint best = nearest_point(points(all));
  if (best.v.norm() >= v - std::max(c_.tolerance, 1e-7 * c_.size)) return;
  std::vector<int> right;
  for (const int i : best.subset) right.push_back(all[static_cast<std::size_t>(i)]);
  const std::string nearer = "though the part " + list_of(right) + " comes as near as " + text_of(best.v.norm());
  c_.unkept = pending_.size() == 1 ? stopping_test(v, nearer) : "Of " + list_of(pending_) + ", asked for since, nothing was kept, " + nearer + ": look at how the simplex was reduced after that (and report it, too, if you give it up).";
}

/// Right after a support the search was over: which test may have ended it.
std::string GjkCheck::stopping_test(double v, const std::string& nearer) const {
  const AnyVector& w = c_.vertices.at(pending_[0]);
  const double along = last_direction_.size() > 0 && last_direction_.allFinite() ? last_direction_.stableNormalized().dot(w) : 0;
  const std::string ended = "The search ended right after support " + std::to_string(pending_[0]) + ", " + nearer + ". ";
  if (!c_.recording.result.signed_distance)
    return ended + (along > 0 ? "That support lies " + text_of(along) + " beyond the origin along its direction (d . w > 0), which proves no gap: go on. The usual cause is the wrong sign in the test whether the support passed the origin, or a test of another vertex, or along another direction, than the last."
                              : "The usual cause is a test whether the support passed the origin that compares other things than d . w with zero.");
  const double lower = best_plane_ - c_.radius, upper = v - c_.radius, share = (v - best_plane_) / v, product = v * (v + along);
  const std::string times = text_of(std::round(1e4 * product / (v * v)) / 1e4) + " times |v|^2";
  if (share <= 0.1)
    return ended + "Its bounds, " + text_of(lower) + " and " + text_of(upper) + ", differ by " + text_of(std::round(1e6 * share) / 1e4) + " % of the distance: the usual cause is a stopping tolerance that is too coarse. The scene asks for a share of " + text_of(c_.recording.settings.tolerance) + ".";
  if (product * c_.unit * c_.unit <= 1e-3)
    return ended + "|v|^2 - v . w is " + text_of(product) + " there: little in itself, but " + times + ". The usual cause is an absolute tolerance in a scene of such lengths: compare with a share of |v|^2.";
  return ended + "|v|^2 - v . w is " + text_of(product) + " there, " + times + ": that is no reason to stop. The usual cause is a stopping test that compares other things" +
         (w.norm() >= v ? ", such as the length of w, " + text_of(w.norm()) + ", with that of v, " + text_of(v) : "") + ", or a tolerance that is far too coarse; or look at how the simplex was reduced after that (and report it, too, if you give it up).";
}

/// A distance between what the supports have proven and what the simplex comes to. What is there may be off, where bounds meet slowly, but not what is returned of it.
void GjkCheck::check_returned(double v) {
  const Result& r = c_.recording.result;
  if (!c_.inferred || !c_.has_supports || !r.signed_distance || r.intersecting) return;
  const double slack = std::max(c_.tolerance, 1e-7 * c_.size), given = *r.signed_distance;
  if (given >= best_plane_ - c_.radius - slack && given <= v - c_.radius + slack) return;
  const Result& right = c_.reference();
  if (std::abs(given - *right.signed_distance) <= 10 * slack + *right.upper_bound - *right.lower_bound) return;
  c_.find("wrong-distance", "signed_distance is " + text_of(given) + ", but the simplex kept last, " + list_of(simplex_) + ", comes to " + text_of(v - c_.radius) + ", and a support plane leaves " + text_of(best_plane_ - c_.radius) +
                                " between the bodies: the distance is between these. What is returned is not what was found.");
}

/// Why a simplex may have been taken to hold the origin, which is so far outside: sentences.
std::string GjkCheck::not_enclosed(const std::vector<int>& simplex, double v) {
  const std::vector<AnyVector> w = points(simplex);
  const auto corners = static_cast<std::size_t>(c_.dimension) + 1;
  if (w.size() < corners) {
    static constexpr const char* names[] = {"A vertex", "An edge", "A triangle"};
    std::string out = w.empty() || w.size() > 3 ? "" : std::string(" ") + names[w.size() - 1] + " encloses nothing in " + std::to_string(c_.dimension) + "D: at most the origin lies on it, and only to rounding.";
    if (v <= 0.1 * c_.size || v * c_.unit <= 1e-3) return out + " The usual cause is |v| compared with a tolerance that is too coarse for this scene, of lengths up to " + text_of(c_.size) + ": an absolute one, or one far above rounding.";
    return out + " The usual cause is " + (w.size() + 1 == corners && w.size() > 1 ? "a test that is right in fewer dimensions, or " : "") + (queries_ > 16 ? "a limit on iterations taken for an overlap." : "a test of something else than |v| against zero.");
  }
  const int spanned = dimensions_spanned(w, c_.tolerance);
  if (w.size() > corners || w.size() != simplex.size() || spanned == c_.dimension) return " The usual cause is a test against a face whose normal points the wrong way.";
  static constexpr const char* flats[] = {"coincide", "lie on one line", "lie in one plane"};
  std::string out = std::string(" Its vertices ") + flats[spanned] + " to rounding, so that no face test can find the origin outside, and none can find it inside.";
  const int newest = *std::max_element(simplex.begin(), simplex.end());
  if (last_direction_.size() == 0 || !last_direction_.allFinite()) return out;
  const AnyVector d = last_direction_.stableNormalized();
  double before = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < w.size(); ++i)
    if (simplex[i] != newest) before = std::max(before, d.dot(w[i]));
  if (d.dot(*c_.vertex(newest)) <= before + c_.tolerance)
    return out + " The last support, " + std::to_string(newest) + ", is no farther along its direction than the vertices before: nothing nearer exists, and the search was over. Stop there, before it is added.";
  return out + " Call an overlap only where the simplex has an extent in every direction, or where |v| is zero to rounding.";
}

void GjkCheck::operator()(const recorded::GjkEnded& e) {
  if (portals_) return;  // which hold the origin's ray, not the origin: the supports and the answer tell
  std::vector<int> last = simplex_;
  if (reported_ && (e.status == GjkStatus::separated || e.status == GjkStatus::converged))
    if (const std::vector<AnyVector> w = points(last); !w.empty()) {
      std::vector<int> all = pending_;
      all.insert(all.end(), last.begin(), last.end());
      const double v = nearest_point(w).v.norm();
      note_unkept(v, all);
      if (e.status == GjkStatus::converged) check_returned(v);
      c_.last_is_nearest = c_.has_supports && c_.inferred && std::abs(v - c_.radius - *c_.reference().signed_distance) <= c_.answer_tolerance();
    }
  if (!reported_ || (e.status != GjkStatus::enclosed && e.status != GjkStatus::touching && e.status != GjkStatus::converged)) return;
  const std::vector<AnyVector> w = points(last);
  if (w.empty()) return;
  const double v = nearest_point(w).v.norm(), limit = std::max(c_.tolerance, 1e-7 * c_.size);
  // The vertices that came after the last reported simplex may have closed it.
  std::vector<int> all = pending_;
  all.insert(all.end(), last.begin(), last.end());
  if (e.status == GjkStatus::converged) {
    const double gap = v - best_plane_;
    const double claimed = v - c_.radius;
    if (v <= limit || !c_.has_supports || gap <= c_.stop * std::max(v, c_.size) || std::abs(claimed - *c_.reference().signed_distance) <= c_.answer_tolerance()) return;
    std::string cause = "The usual cause is a tolerance compared with a squared length, or with a length that was not normalised, or a limit on iterations taken for convergence.";
    if (!c_.unkept.empty()) cause = c_.unkept;
    c_.find("stopped-early", "GJK ended with its bounds " + text_of(best_plane_ - c_.radius) + " and " + text_of(v - c_.radius) + " of the distance still " + text_of(gap) + " apart: there is a nearer point. " + cause);
  } else if (v > limit && !(c_.inferred && c_.denies_its_distance() && std::abs(v - c_.radius - *c_.recording.result.signed_distance) <= c_.answer_tolerance())) {  // how a solver's search ended is taken from its yes or no
    const double lost = c_.rounding_of(points(all));
    if (const double nearest = nearest_point(points(all)).v.norm(); nearest > limit)
      c_.find_unless(nearest <= lost, "origin-not-enclosed", "Overlap is claimed from the simplex " + list_of(last) + ", but the origin lies " + text_of(v) + " outside it." + not_enclosed(last, v));
  }
}

}  // namespace gjkdbg
