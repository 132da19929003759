// check, how large numbers may be. Squares of 1e160 are infinite, and so are the tolerances made of them, within which then everything lies: no comparison finds
// such a number, so that it is looked for by itself.
#include <cmath>
#include <tuple>

#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

/// Lengths of a scene are below 1e60, its velocities below 1e15 and its times below 1e12: nothing that follows from them comes near. Of numbers up to this the
/// products of four are numbers still.
constexpr double largest = 1e75;

/// The largest of the numbers seen, and the field it stands in.
struct Largest {
  bool foreign;
  std::string_view field = {};
  double number = 0;

  void see(std::string_view name, double x) {
    if (std::isfinite(x) && std::abs(x) > std::abs(number)) field = name, number = x;  // what is not finite is not known
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
      return name == "energy" || name == "angular_velocity" || name == "s" || name == "t" || (foreign && (name == "direction" || name == "normal" || name == "distance"));
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
  if (std::abs(seen.number) <= largest || c.found_here()) return;  // what was found says more
  c.find("out-of-range", "\"" + std::string(seen.field) + "\" holds " + text_of(seen.number) + ". No scene leads to numbers beyond " + text_of(largest) + ": their squares are none, and nothing that follows from them can be judged. "
                             "The usual causes are a division by next to nothing, and memory that was never written.");
}

}  // namespace

void check_extent(CheckContext& c, const Event& event) {
  Largest seen{foreign(c.recording)};
  std::visit([&](const auto& e) { seen.see({}, e); }, event);
  tell(c, seen);
}

void check_extent(CheckContext& c, const Result& r) {
  Largest seen{foreign(c.recording)};
  for (const auto& [name, number] : {std::pair("lower_bound", &r.lower_bound), std::pair("upper_bound", &r.upper_bound), std::pair("signed_distance", &r.signed_distance), std::pair("time", &r.time), std::pair("touching_at", &r.touching_at)})
    if (*number) seen.see(name, **number);
  tell(c, seen);
}

}  // namespace gjkdbg
