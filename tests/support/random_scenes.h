// Random pairs of every shape, from easy to nasty: separated, touching, shallow, deep, on integer lattices (ties, parallel
// edges, coplanar faces, exact touches), slivers, size ratios, offsets, identical bodies.
#pragma once

#include <cstdlib>
#include <random>

#include "shapes/scene.h"

namespace gjkdbg {

enum class Family {
  general,   ///< sizes near 1, any rotation
  lattice,   ///< integer coordinates, quarter turns
  slivers,   ///< flattened and stretched by up to 1e6
  ratio,     ///< sizes that differ by up to 1e6
  offset,    ///< both bodies up to 1e6 from the origin
  identical  ///< the same body twice
};
inline constexpr int family_count = 6;

class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : random_(seed) {}

  AnyMatrix rotation(int dimension, Family family);
  /// A penetration scene of the dimension. `polytopes`: only shapes whose answer the exact oracle knows.
  Scene scene(int dimension, Family family, bool polytopes);
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

 private:
  Shape shape(int dimension, Family family, bool polytopes, double size);
  AnyVector vector(int dimension, Family family, double size);
  double length(Family family, double size);
  PointSet points(int dimension, Family family, double size, int count);

  std::mt19937_64 random_;
};

/// How many pairs a test of random ones takes: `usual`, or where GJKDBG_PAIRS is set, as for the sanitizers, so many for each 20,000 of them.
inline int pairs_asked(int usual) {
  const char* given = std::getenv("GJKDBG_PAIRS");
  return given ? static_cast<int>(std::int64_t{usual} * std::atoi(given) / 20000) : usual;
}

/// The largest length of a scene's bodies: what errors are measured against.
double size_of(const Scene& scene);

}  // namespace gjkdbg
