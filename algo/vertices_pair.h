// The support of the difference of two bodies of some vertices each, from the direction to the point in one piece.
//
// Looked up one body after the other it takes a call each, and the direction and the vertex go through memory on both sides of them: of two hulls of 32
// vertices that is a third of the instructions.
#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>

#include "shapes/convex.h"

namespace gjkdbg {

template <int D, class S>
struct SupportPoint;
template <int D, class S>
struct RelativePose;

class VerticesPair {
 public:
  static constexpr std::size_t least = 9, most = 32;  ///< vertices of each

  /// For bodies that have no such cores, and on processors that cannot, it says no.
  template <class A, class B>
  VerticesPair([[maybe_unused]] const A& a, [[maybe_unused]] const B& b) {
#ifdef GJKDBG_AVX2
    const auto *of_a = vertices_of(a), *of_b = vertices_of(b);
    if (of_a && of_b && __builtin_cpu_supports("avx2")) a_ = of_a, b_ = of_b;
#endif
  }
  explicit operator bool() const { return a_ != nullptr; }

#ifdef GJKDBG_AVX2
  /// What MinkowskiDifference::support says, number by number; of vertices as high as one another the one VertexFours::highest takes. All but the point's number.
  /// Not inlined: a caller that is to be flattened (MinkowskiDifference::support) is no code for AVX2.
  [[gnu::noinline]] void support(const RelativePose<3, double>& pose, const Vector<3, double>& d, SupportPoint<3, double>& point) const;
#endif

 private:
  template <class Body>
  static const VertexFours<3, double>* vertices_of(const Body& body) {
    if constexpr (std::is_same_v<Body, Convex<3, double>>)
      if (const auto* core = std::get_if<VerticesCore<3, double>>(&body.core()); core && least <= core->vertices.size() && core->vertices.size() <= most) return &core->vertices;
    return nullptr;
  }

  const VertexFours<3, double>*a_ = nullptr, *b_ = nullptr;
};

}  // namespace gjkdbg
