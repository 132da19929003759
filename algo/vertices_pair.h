// The support of the difference of two hulls, from the direction to the point in one piece: of 9 to 32 vertices each, or both with a table of directions.
//
// Looked up one body after the other it takes a call each, and the direction and the vertex go through memory on both sides of them: of two hulls of 32
// vertices that is a third of the instructions.
#pragma once

#include <cstddef>
#include <cstdint>
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
  /// For bodies that have no such cores, and on processors that cannot, it says no.
  template <class A, class B>
  VerticesPair([[maybe_unused]] const A& a, [[maybe_unused]] const B& b) {
#ifdef GJKDBG_AVX2
    const auto *of_a = eights_of(a), *of_b = eights_of(b);
    if (of_a && of_b && __builtin_cpu_supports("avx2")) {
      a_ = of_a, b_ = of_b, a_->fetch(), b_->fetch();
    } else if (const auto *table_a = table_of(a), *table_b = table_of(b); table_a && table_b && __builtin_cpu_supports("avx2")) {
      table_a_ = table_a, table_b_ = table_b;
    }
#endif
  }

#ifdef GJKDBG_AVX2
  explicit operator bool() const { return (a_ != nullptr) | (table_a_ != nullptr); }
  /// What MinkowskiDifference::support says, number by number; of vertices as high as one another the one VertexFours::highest takes. All but the point's number.
  /// Not inlined: a caller that is to be flattened (MinkowskiDifference::support) is no code for AVX2.
  [[gnu::noinline]] void support(const RelativePose<3, double>& pose, double x, double y, double z, SupportPoint<3, double>& point);
#endif

 private:
#ifdef GJKDBG_AVX2
  template <class Body>
  static const VertexEights* eights_of(const Body& body) {
    if constexpr (std::is_same_v<Body, Convex<3, double>>)
      if (const auto* core = std::get_if<VerticesCore<3, double>>(&body.core())) return core->eights ? &core->eights : nullptr;
    return nullptr;
  }
  template <class Body>
  static const HullCore<double>* table_of(const Body& body) {
    if constexpr (std::is_same_v<Body, Convex<3, double>>) return std::get_if<HullCore<double>>(&body.core());
    return nullptr;
  }
  /// Where single precision leaves several vertices of a body, whose bits take the place of a vertex's number. Called last, so that `support` has no registers to save.
  template <bool by_a, bool by_b>
  [[gnu::noinline, gnu::target("avx2")]] void settled(const RelativePose<3, double>& pose, SupportPoint<3, double>& point, unsigned a, unsigned b);
  void end(SupportPoint<3, double>& point, const RelativePose<3, double>& pose, unsigned a, unsigned b);
  [[gnu::noinline]] void support_of_tables(const RelativePose<3, double>& pose, double x, double y, double z, SupportPoint<3, double>& point) const;

  const VertexEights *a_ = nullptr, *b_ = nullptr;
  std::uint32_t last_a_ = 0, last_b_ = 0;  ///< places of the vertices met last, a byte each
  const HullCore<double> *table_a_ = nullptr, *table_b_ = nullptr;
#endif
};

}  // namespace gjkdbg
