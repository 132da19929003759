// One pair, prepared once, solved many times: the core alone, without files, hulls or traces.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algo/result.h"
#include "algo/settings.h"
#include "shapes/scene.h"

namespace gjkdbg {

class PreparedPair {
 public:
  virtual ~PreparedPair() = default;
  virtual Result run(const Settings& settings, Query query) = 0;
};

/// Convex bodies only. In the scalar given; the settings of `run` must ask for the same.
std::unique_ptr<PreparedPair> prepare(const Scene& scene, Scalar scalar);

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
