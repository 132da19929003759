// check, bodies that touch, or miss touching by less than distances are judged by. A distance may be off by that much, but yes or no is not: what d . w is, and
// between which bounds the bodies are apart, is known to rounding. Told as warnings: a program may take for touching what it likes, if its maker knows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

/// Whether the program's numbers are those of single precision, though nothing says so: no number has more digits than that, and one has more than chance
/// gives. (0, 1 and 0.5 are in any precision.)
bool counts_in_single(const Recording& recording) {
  bool telling = false, more = false;
  const auto see = [&](double x) {
    if (!std::isfinite(x) || x == 0) return;
    if (static_cast<double>(static_cast<float>(x)) != x) return void(more = true);
    int exponent = 0;
    const double bits = std::ldexp(std::frexp(x, &exponent), 12);  // whole, where 12 binary digits are enough
    telling = telling || bits != std::trunc(bits);
  };
  const auto see_all = [&](const AnyVector& v) { std::for_each(v.begin(), v.end(), see); };
  for (const Event& event : recording.events) {
    if (const auto* e = std::get_if<recorded::SupportQueried>(&event)) see_all(e->direction);
    if (const auto* e = std::get_if<recorded::SimplexReduced>(&event)) see_all(e->closest);
  }
  const Result& r = recording.result;
  if (r.signed_distance) see(*r.signed_distance);
  for (const auto& v : {r.normal, r.witness_a, r.witness_b})
    if (v) see_all(*v);
  return telling && !more;
}

double lost_in_single(double x) { return std::abs(x - static_cast<double>(static_cast<float>(x))); }

/// Whether who computes d . w, plus |d| times the radius, may have come to less than zero. Of n products and their sum, by a direction whose numbers were rounded
/// up to three times on the way (normalised, or not, after it was sent), no more is lost than (n + 3) u times the sum of the lengths of the terms; and where
/// no term is negative, no sum of them is, in any order. u is 2^-53, or 2^-24 in single precision, where w has first lost what a, b and their difference have there.
bool may_be_negative(const recorded::SupportQueried& q, double radius, bool single) {
  const AnyVector d = q.direction.stableNormalized();
  const double u = (single ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon()) / 2;
  double sum = radius, lengths = radius, lost = 0;
  bool negative = radius > 0;  // which is none of the program's terms
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    const double term = d[i] * q.w[i];
    sum += term, lengths += std::abs(term), negative = negative || term < 0;
    if (!single) continue;
    const double of_points = lost_in_single(q.a[i]) + lost_in_single(q.b[i]);
    lost += std::abs(d[i]) * (of_points > 0 ? of_points + u * std::abs(q.w[i]) : lost_in_single(q.w[i]));
  }
  const double slack = (negative || lost > 0 ? static_cast<double>(d.size() + 3) * u * lengths : 0) + lost;
  return sum < 0 || sum < slack;
}

struct Nearly {
  CheckContext& c;
  double best_plane;
  const Result& r = c.recording.result;
  const Result& right = c.reference();
  const bool single = c.recording.settings.scalar == Scalar::float_precision || (foreign(c.recording) && counts_in_single(c.recording));

  void run() const {
    const double far = reach(), rounding = (single ? 1e-6 : 1e-14) * far;
    if (!r.intersecting && *right.upper_bound <= 1e-14 * far) apart(rounding, -*right.upper_bound > 1e-14 * far);  // by our own bounds, which are of double precision
    // What stops at a tolerance may take a gap of that length for none.
    if (r.intersecting && *right.lower_bound > rounding + 8 * c.recording.settings.tolerance * c.size + of_last_simplex())
      warn("wrong-answer", "The bodies are called overlapping, but they are apart by " + text_of(*right.lower_bound) + ": little beside their size, but more than rounding. The usual cause is |v| compared with a tolerance that is far above rounding, or an absolute one.");
  }

  /// The longest length in the numbers that w was made of.
  double reach() const {
    double far = c.size;
    for (const Body& body : c.recording.scene.scene.bodies) far = std::max(far, body.pose.position.stableNorm() + c.size);
    return far;
  }

  /// Who goes by the length of v, and asks along -v: v is no more exact than the vertices that it is made of, to some eps times their size, which beside a short v turns it by a
  /// large angle (64, as in check_towards_origin: for the weights, which are rounded, too). So far may the height along it be off.
  double turned_by_rounding(double v) const { return known_to() / v * c.size; }
  double known_to() const { return 64 * (single ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon()) * c.size; }
  /// What it leaves open of a sliver, if that is what the search ended with.
  double of_last_simplex() const { return c.rounding_of(last_simplex()); }
  std::vector<AnyVector> last_simplex() const {
    std::vector<AnyVector> w;
    for (const Event& event : c.recording.events)
      if (const auto* e = std::get_if<recorded::SimplexReduced>(&event)) {
        w.clear();
        for (const int number : e->region)
          if (const auto found = c.vertices.find(number); found != c.vertices.end()) w.push_back(found->second);
      }
    return w;
  }
  /// Of round bodies: whether the last simplex, or in a recording of our own the points that were projected last, are as far from the origin, or from each other, as the radii
  /// reach, to what v is known to. Either answer is right then.
  bool radii_reach() const {
    if (!(c.radius > 0)) return false;
    const auto reaches = [&](const AnyVector& v) { return std::abs(v.norm() - c.radius) <= known_to(); };
    if (const std::vector<AnyVector> w = last_simplex(); !w.empty()) return reaches(nearest_point(w).v);
    const recorded::PointsProjected* last = nullptr;
    for (const Event& event : c.recording.events)
      if (const auto* e = std::get_if<recorded::PointsProjected>(&event)) last = e;
    return last && !foreign(c.recording) && reaches(last->closest);
  }

  /// How far the last simplex that was told is from the origin; 0 where none was, and where it is farther than what may be taken for touching. One that holds the origin to rounding has
  /// no direction towards it, but the program's own v has, and counts where it is what was asked along.
  double last_v() const {
    std::vector<AnyVector> w;
    AnyVector told;
    bool asked_along = false;
    for (const Event& event : c.recording.events) {
      if (const auto* e = std::get_if<recorded::SimplexReduced>(&event)) {
        w.clear(), told = e->closest;
        for (const int number : e->region)
          if (const auto found = c.vertices.find(number); found != c.vertices.end()) w.push_back(found->second);
      } else if (const auto* q = std::get_if<recorded::SupportQueried>(&event)) {
        asked_along = told.size() > 0 && told.allFinite() && !told.isZero(0) && q->direction.allFinite() && q->direction.stableNormalized().dot(told.stableNormalized()) < -0.999;
      }
    }
    const double v = w.empty() ? 0 : nearest_point(w).v.norm();
    if (v <= known_to()) return asked_along ? told.norm() : 0;
    return v <= (single ? 1e-4 : 1e-7) * c.size ? v : 0;
  }

  void apart(double rounding, bool overlap) const {
    const double measured = r.signed_distance.value_or(0);
    if (measured > 0 && measured <= *right.upper_bound + rounding) return;  // as far apart as they are, to rounding
    if (best_plane > c.radius || radii_reach()) return;
    double least = std::numeric_limits<double>::infinity();
    for (const Event& event : c.recording.events) {
      const auto* q = std::get_if<recorded::SupportQueried>(&event);
      if (!q || !q->direction.allFinite() || !q->w.allFinite() || q->direction.isZero(0)) continue;
      if (may_be_negative(*q, c.radius, single)) return;
      least = std::min(least, q->direction.stableNormalized().dot(q->w) + c.radius);
    }
    const double deep = -*right.upper_bound;
    const bool asked = std::isfinite(least);
    if (!asked && deep <= rounding) return;  // what else it knows is right to rounding
    if (const double v = measured > 0 ? measured : last_v(); v > 0 && least <= turned_by_rounding(v)) return;
    const std::string are = overlap ? "overlap, " + text_of(deep) + " deep: little beside their size, but more than rounding" : "touch, which counts as overlapping";
    if (!asked) return warn("wrong-answer", "The bodies are called apart, but they " + are + ".");
    warn("unjustified-separation", "The bodies are called apart, but they " + are + ". No support proves a gap: that takes d . w < 0, and the least that was found, for d of length 1, is " + text_of(least) + ". The usual cause is " +
                                       (overlap ? "a tolerance in the test whether the support passed the origin, which is to compare with zero." : "d . w <= 0 where d . w < 0 is due (or > where >= is, for an overlap): at zero the plane touches both bodies, and so may they each other."));
  }

  void warn(const char* code, const std::string& message) const { c.find(code, message, Finding::Severity::warning); }
};

}  // namespace

void check_touching(CheckContext& c, double best_plane) {
  const Result& r = c.recording.result;
  if (!foreign(c.recording) && r.signed_distance) return;  // of ours the distance tells
  if (!c.has_supports || unanswered(r) || c.found("wrong-answer") || c.found("unjustified-separation") || c.found("origin-not-enclosed")) return;
  Nearly{c, best_plane}.run();
}

}  // namespace gjkdbg
