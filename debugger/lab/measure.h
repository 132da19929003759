// What is measured: methods, and the reference they are judged by.
#pragma once

#include <string>
#include <vector>

#include "algo/settings.h"
#include "debugger/lab/peers.h"
#include "shapes/scene.h"

namespace gjkdbg {

/// A method as the charts and the atlas compare them: one of ours, or another library.
struct Variant {
  std::string name;
  Method method;               ///< of ours
  const Peer* peer = nullptr;  ///< of another library
};
/// Every method for signed distances there is, in both scalars, GJK by others' stopping rules in double, and every library this was built with; `in_atlas`:
/// and the one that says yes or no only, and those of casts. (Of a cast GJK's are conservative advancement, with GJK inside.)
std::vector<Variant> variants(bool in_atlas = false);
/// Those whose names begin with one of `names`, whatever the case ("default": the first alone); all when there are none. Each may be several, with commas between.
/// Throws Error for a name that none has.
std::vector<Variant> chosen(const std::vector<Variant>& all, const std::vector<std::string>& names);
/// Whether the method takes such bodies at all. (SAT: polytopes.) Libraries are asked by `Peer::prepare`.
bool applies(const Variant& variant, const Scene& scene);

/// The largest length of the bodies: what errors are relative to.
double scene_size(const Scene& scene);

/// Our best answer and its certificate, in double precision at the tightest tolerance.
struct Reference {
  double signed_distance = 0, lower = 0, upper = 0;
  /// How far a value is outside the certified interval, relative to `size`.
  double error(double value, double size) const;
};
Reference reference(const Scene& scene);
/// What it is found by.
Method reference_method();

}  // namespace gjkdbg
