// What GJK's loop (algo/gjk.h) results in, and what it does seldom.
#pragma once

#include <array>
#include <limits>
#include <type_traits>

#include "algo/closest_point_wide.h"
#include "algo/gjk_options.h"
#include "algo/grown_simplex.h"
#include "algo/signed_volumes.h"
#include "algo/simplex.h"

namespace gjkdbg {

template <int D, class S>
struct GjkResult {
  GjkStatus status = GjkStatus::converged;
  int iterations = 0;
  /// The feature nearest the origin, with weights; when enclosed all D + 1 vertices, with the origin's weights unless the signed distance was
  /// asked for: whoever goes on from there has no use for them, but where rounding ends that (`weigh_enclosing`).
  Simplex<D, S> simplex;
  Vector<D, S> v = Vector<D, S>::Zero();   ///< closest point of the cores' difference (zero when enclosed)
  S distance = 0;                          ///< |v|
  S lower_bound = -std::numeric_limits<S>::infinity();  ///< of the signed distance of the cores
  S upper_bound = std::numeric_limits<S>::infinity();

  bool cores_overlap() const { return status == GjkStatus::enclosed || status == GjkStatus::touching; }
};

/// The feature of `size` vertices that is nearest the origin.
template <int D, class S>
using Opinion = ClosestFeature<D, S> (*)(const Vector<D, S>* w, int size);

/// That the origin is inside is a proof, and has to be exact: where another sub-algorithm says so, signed volumes have the last word.
template <class SubAlgorithm, int D, class S>
ClosestFeature<D, S> opinion_of(const Vector<D, S>* w, int size) {
  const ClosestFeature<D, S> feature = SubAlgorithm::closest(w, size);
  if constexpr (!std::is_same_v<SubAlgorithm, SignedVolumes<D, S>>)
    if (feature.enclosed) return SignedVolumes<D, S>::closest(w, size);
  return feature;
}

/// What rarely happens, apart from the loop's own numbers, which stay in registers as long as nothing else is shown where they lie.
template <int D, class S>
struct GjkSteps {
  using V = Vector<D, S>;
  int on_the_spot = 0;
  V stepped_to;  ///< by the last of these
  ToldInLanes<S> lanes;

  /// |v| must fall, and has not. Where the plane still turns but |v| falls by less than it rounds (a nearly flat part of A - B met at
  /// a grazing angle), a few steps on the spot are allowed, not twice to the same.
  [[gnu::noinline]] bool allowed(V before, S squared_before, V v, S v_squared, S rounding) {
    if (v == before || (on_the_spot > 0 && v == stepped_to) || !(v_squared <= squared_before + rounding) || ++on_the_spot > 8) return false;
    stepped_to = v;
    return true;
  }

  int corrections = 0;
  /// Whether the point of A - B that the weights make is as near as v is said to be. The formulas for v and for the weights round apart where the simplex is next to flat, a long body's beside a short one's:
  /// then v may lie nearer than any point of it. If so both are taken in twice the precision, of the point at the place `newest`, too, and v is never nearer than what the weights make. True where that was done
  /// before and led no farther.
  [[gnu::noinline]] bool within_reach(Simplex<D, S>& simplex, int newest, V& v, S most, S floor) {
    if (simplex.point().squaredNorm() <= most * most) return true;
    if (newest >= 0) simplex.places |= 1u << newest;
    const ClosestFeature<D, S> feature = of_list(simplex, WideClosestPoint<D, S>::of_boundary);
    simplex.reduce_to(feature);
    const V at = simplex.point();
    v = at.norm() > feature.v.norm() + floor ? at : feature.v;
    return ++corrections > 3;
  }

  /// A sub-algorithm's opinion of all vertices.
  [[gnu::noinline]] static ClosestFeature<D, S> of_list(const Simplex<D, S>& simplex, Opinion<D, S> opinion) {
    std::array<V, D + 1> w;
    const int size = simplex.size();
    for (int i = 0; i < size; ++i) w[i] = simplex[i].w;
    return opinion(w.data(), size);
  }
};

}  // namespace gjkdbg
