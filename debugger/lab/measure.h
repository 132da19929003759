// What is measured: methods, and the reference they are judged by.
#pragma once

#include <string>
#include <vector>

#include "algo/result.h"
#include "algo/settings.h"
#include "shapes/scene.h"

namespace gjkdbg {

/// A method as the charts and the atlas compare them.
struct Variant {
  std::string name;
  Method method;
};
/// Every method for signed distances there is, in both scalars.
std::vector<Variant> variants();

/// The largest length of the bodies: what errors are relative to.
double scene_size(const Scene& scene);

/// Our best answer and its certificate, in double precision at the tightest tolerance.
struct Reference {
  double signed_distance = 0, lower = 0, upper = 0;
  /// How far a value is outside the certified interval, relative to `size`.
  double error(double value, double size) const;
};
Reference reference(const Scene& scene);

}  // namespace gjkdbg
