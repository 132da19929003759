// Other libraries that answer the same question, where their packages are installed when this is built: to be measured beside our methods on
// the same pairs in one run. Nothing else needs them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shapes/scene.h"

namespace gjkdbg {

struct PeerAnswer {
  bool overlap = false;
  std::optional<double> signed_distance;  ///< unset: the library does not say (libccd and ODE do not when apart, Box2D not when overlapping)
};

/// One pair made ready; `ask` is what is timed: a library's signed query where it has one.
class PeerPair {
 public:
  virtual ~PeerPair() = default;
  virtual PeerAnswer ask() = 0;
};

struct Peer {
  std::string name;
  bool has_tolerance;  ///< whether the tolerance does anything
  std::unique_ptr<PeerPair> (*prepare)(const Scene& scene, double tolerance);  ///< null: the library has no such shapes
};

/// Those this was built with, none perhaps. Box2D takes scenes in 2D, the others in 3D.
const std::vector<Peer>& peers();

}  // namespace gjkdbg
