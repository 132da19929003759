// check, how large numbers may be, and how long normals. Squares of 1e160 are infinite, and so are the tolerances made of them, within which then everything lies: no comparison finds
// such a number, so that it is looked for by itself.
#include <cmath>
#include <cstdio>
#include <tuple>

#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

/// Lengths of a scene are below 1e60, its velocities below 1e15, degrees or not, and its times below 1e12: what turns about a point so far from it moves at less than
/// 1e75 times pi / 180, and nothing else comes near. Of numbers up to this the products of four are numbers still.
constexpr double largest = 1e75;
/// Places are where such a speed leads through the time of a simulation, below 1e87 times pi / 180. Of masses below 1e30, 1,000 of them, momenta and impulses are below
/// 1e108 times pi / 180. Of both squares are numbers still, and no more is made of them.
constexpr double farthest_place = 1e90, most_momentum = 1e110;

/// The number farthest beyond what its field may hold, as a share of that.
struct Largest {
  const Recording& recording;
  const bool theirs = foreign(recording), simulated = recording.scene.scene.query == Query::simulate;
  std::string_view field = {};
  double number = 0, most = largest;

  double most_of(std::string_view name) const {
    if (!simulated) return largest;
    return name == "momentum" || name == "impulse" ? most_momentum : name == "position" || name == "point" ? farthest_place : largest;
  }
  bool beyond() const { return std::abs(number) > most; }

  void see(std::string_view name, double x) {
    const double share = std::abs(x) / most_of(name);
    if (std::isfinite(x) && share > std::abs(number) / most) field = name, number = x, most = most_of(name);  // what is not finite is not known
  }
  void see(std::string_view name, const AnyVector& v) {
    for (const double x : v) see(name, x);
  }
  template <class T>
  void see(std::string_view name, const std::vector<T>& list) {
    for (const T& x : list) see(name, x);
  }
  /// Energies, spins and the places on a segment are quotients and products themselves, and compared as such. What other programs give as a direction is as long
  /// as it comes, and distances may be measured along it.
  template <class E>
    requires requires { E::fields(); }
  void see(std::string_view, const E& e) {
    const auto free = [&](std::string_view name) {
      return name == "energy" || name == "angular_velocity" || name == "s" || name == "t" || (theirs && (name == "direction" || name == "normal" || name == "distance"));
    };
    const auto one = [&](const auto& f) {
      if (!free(f.name)) see(f.name, e.*f.member);
    };
    std::apply([&](const auto&... f) { (one(f), ...); }, E::fields());
  }
  template <class T>
  void see(std::string_view, const T&) {}
};

void tell(CheckContext& c, const Largest& seen) {
  c.find("out-of-range", "\"" + std::string(seen.field) + "\" holds " + text_of(seen.number) + ". No scene leads to numbers beyond " + text_of(seen.most) + " there: products of them are none, and nothing that follows from them can be judged. "
                             "The usual causes are a division by next to nothing, and memory that was never written.");
}

}  // namespace

/// A normal is written with six digits at the least, as C++ streams do unless told otherwise: coordinates up to 1 are off by 5e-7 then, and its length by no more
/// than sqrt(3) times that, 8.7e-7. Normalised in single precision, u = 2^-24: three products, two sums, a root and a quotient leave less than 6 u of the length (a root
/// that is estimated and put right once as much), and turning it by a matrix so rounded, with five operations a coordinate, less than 10 u: 9.6e-7. Together below 2e-6.
/// Where no more than single precision is asked for, five digits will do: sqrt(3) times 5e-6, 8.7e-6, and the same 9.6e-7, below 1e-5.
std::string CheckContext::not_unit(const AnyVector& normal, const std::string& whose) const {
  const double length = normal.stableNorm(), most = recording.settings.scalar == Scalar::float_precision ? 1e-5 : 2e-6;
  if (std::abs(length - 1) <= most) return "";
  char text[32];  // with as many digits as it takes to see that it is not 1
  std::snprintf(text, sizeof text, "%.8g", length);
  return whose + " " + text_of(normal) + " has length " + text + " instead of 1.";
}

void check_extent(CheckContext& c, const Event& event) {
  Largest seen{c.recording};
  std::visit([&](const auto& e) { seen.see({}, e); }, event);
  if (seen.beyond() && !c.found_here()) tell(c, seen);  // what was found says more
}

/// The points, the velocities, of a motion the places and the times: each by itself may be compared with what is right, and what was found says more.
void check_extent(CheckContext& c, const Result& r) {
  Largest seen{c.recording};
  for (const auto& [name, number] : {std::pair("lower_bound", &r.lower_bound), std::pair("upper_bound", &r.upper_bound), std::pair("signed_distance", &r.signed_distance), std::pair("time", &r.time), std::pair("touching_at", &r.touching_at)})
    if (*number) seen.see(name, **number);
  for (const auto& [name, point] : {std::pair("witness_a", &r.witness_a), std::pair("witness_b", &r.witness_b)})
    if (*point) seen.see(name, **point);
  if (r.contacts)
    for (const ContactPoint& p : *r.contacts) seen.see("point_a", p.point_a), seen.see("point_b", p.point_b), seen.see("depth", p.depth);
  if (r.bodies)
    for (const FinalState& body : *r.bodies) seen.see("position", body.position), seen.see("velocity", body.velocity);
  if (seen.beyond() && !c.found_here()) tell(c, seen);
}

/// Normal, points and bounds are compared by means of the distance: where that is no number that can be, neither can they.
bool distance_out_of_range(CheckContext& c) {
  Largest seen{c.recording};
  if (const auto& distance = c.recording.result.signed_distance) seen.see("signed_distance", *distance);
  if (seen.beyond()) tell(c, seen);
  return seen.beyond();
}

}  // namespace gjkdbg
