// BoxQuery::solve for processors with AVX2: what algo/boxes.h derives, three faces or three pairs of edges at a time, with the same numbers.
//
//   lanes 0 1 2                 i of e_i             j of R_j
//   have                        faces of A,          faces of B,
//                               edges along one R_j  edges along one e_i
//   and look at R by            columns              rows
//
// With i k l cyclic, what a lane needs of k and l is in `next` and `last`. Each ending answers by itself, and what is rare is left to solve_plainly.
#include "algo/box_query.h"

#ifdef GJKDBG_AVX2
#include "shapes/three_avx2.h"

namespace gjkdbg {
namespace {

GJKDBG_LANES Lanes all(double x) { return _mm256_set1_pd(x); }
GJKDBG_LANES Lanes plus(const Lanes& a, const Lanes& b) { return _mm256_add_pd(a, b); }
GJKDBG_LANES Lanes minus(const Lanes& a, const Lanes& b) { return _mm256_sub_pd(a, b); }
GJKDBG_LANES Lanes times(const Lanes& a, const Lanes& b) { return _mm256_mul_pd(a, b); }
GJKDBG_LANES Lanes over(const Lanes& a, const Lanes& b) { return _mm256_div_pd(a, b); }
GJKDBG_LANES Lanes sign_of(const Lanes& a) { return _mm256_and_pd(a, all(-0.0)); }
/// Times 1 and -1: `sign`'s sign alone is set.
GJKDBG_LANES Lanes with(const Lanes& a, const Lanes& sign) { return _mm256_xor_pd(a, sign); }
GJKDBG_LANES Lanes clamped(const Lanes& x, const Lanes& half) { return _mm256_min_pd(half, _mm256_max_pd(negative(half), x)); }
/// a x + b y + c z.
GJKDBG_LANES Lanes sum(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& x, const Lanes& y, const Lanes& z) { return plus(plus(times(a, x), times(b, y)), times(c, z)); }

/// Of three lanes, one after the other.
template <class Take>
GJKDBG_LANES double taken(const Lanes& v, const Take& take) {
  const __m128d xy = _mm256_castpd256_pd128(v), z = _mm256_extractf128_pd(v, 1);
  return _mm_cvtsd_f64(take(take(xy, _mm_unpackhi_pd(xy, xy)), z));
}
GJKDBG_LANES double least_of(const Lanes& v) {
  return taken(v, [](const __m128d& a, const __m128d& b) __attribute__((target("avx2"), always_inline)) { return _mm_min_sd(a, b); });
}
GJKDBG_LANES double greatest_of(const Lanes& v) {
  return taken(v, [](const __m128d& a, const __m128d& b) __attribute__((target("avx2"), always_inline)) { return _mm_max_sd(a, b); });
}
GJKDBG_LANES double added(const Lanes& v) {
  return taken(v, [](const __m128d& a, const __m128d& b) __attribute__((target("avx2"), always_inline)) { return _mm_add_sd(a, b); });
}
/// A bit for each of three lanes.
GJKDBG_LANES unsigned bits(const Lanes& mask) { return static_cast<unsigned>(_mm256_movemask_pd(mask)) & 0b111; }
GJKDBG_LANES unsigned equal(const Lanes& v, double x) { return bits(_mm256_cmp_pd(v, all(x), _CMP_EQ_OQ)); }
GJKDBG_LANES int first_of(unsigned bits) { return __builtin_ctz(bits); }

constexpr int after(int i) { return i == 2 ? 0 : i + 1; }

struct Cyclic {
  Lanes own, next, last;
  GJKDBG_LANES explicit Cyclic(const Lanes& v) : own(v), next(_mm256_permute4x64_pd(v, 0b11001001)), last(_mm256_permute4x64_pd(v, 0b11010010)) {}
};

/// All of lane k mod 3.
GJKDBG_LANES Lanes mask_of(int k) {
  alignas(32) static constexpr std::int64_t lanes[5][4] = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {-1, 0, 0, 0}, {0, -1, 0, 0}};
  return _mm256_castsi256_pd(_mm256_load_si256(reinterpret_cast<const __m256i*>(lanes[k])));
}
/// At i, and at the two that follow it.
GJKDBG_LANES Lanes cyclic(int i, const double& at_i, const double& at_k, const double& at_l) {
  return _mm256_blendv_pd(_mm256_blendv_pd(_mm256_broadcast_sd(&at_i), _mm256_broadcast_sd(&at_k), mask_of(i + 1)), _mm256_broadcast_sd(&at_l), mask_of(i + 2));
}

struct Three {
  Lanes of[3];
};
GJKDBG_LANES Three transposed(const Lanes& a, const Lanes& b, const Lanes& c) {
  const Lanes zero = _mm256_setzero_pd(), ab_02 = _mm256_unpacklo_pd(a, b), ab_1 = _mm256_unpackhi_pd(a, b), c_02 = _mm256_unpacklo_pd(c, zero), c_1 = _mm256_unpackhi_pd(c, zero);
  return {{_mm256_permute2f128_pd(ab_02, c_02, 0x20), _mm256_permute2f128_pd(ab_1, c_1, 0x20), _mm256_permute2f128_pd(ab_02, c_02, 0x31)}};
}

/// Half sizes, R's columns and rows, and from A's centre to B's in the axes of both.
struct PlacedBoxes {
  Lanes a, b, p, q, column[3], row[3];

  GJKDBG_LANES Lanes rotated(const Lanes& v) const { return sum(column[0], column[1], column[2], lane<0>(v), lane<1>(v), lane<2>(v)); }
  /// How far apart they are along a unit direction.
  GJKDBG_LANES double plane(const Lanes& n) const {
    const Lanes of_b = times(b, length_of(sum(row[0], row[1], row[2], lane<0>(n), lane<1>(n), lane<2>(n))));
    return added(times(n, p)) - (added(times(a, length_of(n))) + added(of_b));
  }
};

/// What is said of the points, as SatAnswer does; Eigen would have them go through memory.
struct Answer {
  const BoxQuery<3, double>& query;
  const PlacedAxes<3>& pose;  ///< A's
  const double floor;
  Result& result;

  GJKDBG_LANES bool say(SatStatus status, Lanes a, Lanes b, Lanes normal, double distance, double lower_bound, int axes, int corner) const {
    const double unit = 1 / query.scale, radius_a = query.radius_a, radius_b = query.radius_b;
    const Lanes zero = _mm256_setzero_pd();  // none negative
    a = plus(a, zero), b = plus(b, zero), normal = plus(normal, zero);
    const Lanes n = turned(pose.rotation, normal), middle = plus(turned(pose.rotation, times(times(plus(a, b), all(0.5)), all(unit))), three(pose.position.data()));
    set_bounds(result, lower_bound - floor, distance + floor, radius_a, radius_b, unit);
    result.signed_distance = (distance - (radius_a + radius_b)) * unit + 0.0;
    result.intersecting = distance - (radius_a + radius_b) <= 0;
    const auto set = [](std::optional<AnyVector>& to, const Lanes& v) __attribute__((target("avx2"), always_inline)) { store_three(to.emplace(3).data(), v); };
    set(result.normal, n);
    set(result.witness_a, minus(middle, times(n, all((distance / 2 - radius_a) * unit))));
    set(result.witness_b, plus(middle, times(n, all((distance / 2 - radius_b) * unit))));
    result.status = status;
    result.iterations = axes + corner, result.support_calls = axes;
    return true;
  }
};

/// Boxes::Facet, in the body's own axes: its `on`, `off` and `beyond`.
struct alignas(32) Faces {
  double on[3][4], off[3][4], beyond[4];

  GJKDBG_LANES Lanes point(int i) const { return cyclic(i, on[0][i], on[1][i], on[2][i]); }
  GJKDBG_LANES Lanes way(int i) const { return cyclic(i, off[0][i], off[1][i], off[2][i]); }
};
struct Told {
  Lanes separation, nearness;
};
/// Of a body's three faces; p, from its centre to the other's, and R as these lanes look at it; `halves`: the other's, three times in all lanes.
GJKDBG_LANES Told tell(Faces& faces, const Lanes& p_i, const Lanes& half_i, const Lanes& halves, const Lanes (&r_of)[3]) {
  const Cyclic p(p_i), half(half_i), r[3] = {Cyclic(r_of[0]), Cyclic(r_of[1]), Cyclic(r_of[2])};
  const Lanes c[3] = {with(lane<0>(halves), sign_of(r_of[0])), with(lane<1>(halves), sign_of(r_of[1])), with(lane<2>(halves), sign_of(r_of[2]))};
  const Lanes side = sign_of(p.own);
  const Lanes separation = minus(with(p.own, side), plus(half.own, sum(c[0], c[1], c[2], r[0].own, r[1].own, r[2].own)));
  const Lanes at_k = minus(p.next, with(sum(c[0], c[1], c[2], r[0].next, r[1].next, r[2].next), side));
  const Lanes at_l = minus(p.last, with(sum(c[0], c[1], c[2], r[0].last, r[1].last, r[2].last), side));
  const Lanes on_k = clamped(at_k, half.next), on_l = clamped(at_l, half.last), off_k = minus(at_k, on_k), off_l = minus(at_l, on_l);
  const Lanes beyond = plus(times(off_k, off_k), times(off_l, off_l));
  _mm256_store_pd(faces.on[0], with(half.own, side)), _mm256_store_pd(faces.on[1], on_k), _mm256_store_pd(faces.on[2], on_l);
  _mm256_store_pd(faces.off[0], with(separation, side)), _mm256_store_pd(faces.off[1], off_k), _mm256_store_pd(faces.off[2], off_l);
  _mm256_store_pd(faces.beyond, beyond);
  return {separation, plus(times(separation, separation), beyond)};
}

/// Three pairs of edges: Boxes::Edges, by its names.
struct Edges {
  Lanes r, x, y, r_im, r_in, r_km, r_kn, r_lm, r_ln;
  Lanes a_i, a_k, a_l, b_j, b_m, b_n, p_i, p_k, p_l, q_j;

  /// Of e_i and all R_j.
  GJKDBG_LANES static Edges along_a(const PlacedBoxes& pair, int i) {
    const double *const a = reinterpret_cast<const double*>(&pair.a), *const p = reinterpret_cast<const double*>(&pair.p);
    const int k = after(i), l = after(k);
    const Cyclic of_i(pair.row[i]), of_k(pair.row[k]), of_l(pair.row[l]), b(pair.b);
    return {of_i.own, of_k.own, of_l.own, of_i.next, of_i.last, of_k.next, of_k.last, of_l.next, of_l.last,
            all(a[i]), all(a[k]), all(a[l]), b.own, b.next, b.last, all(p[i]), all(p[k]), all(p[l]), pair.q};
  }
  /// Of all e_i and R_j.
  GJKDBG_LANES static Edges along_b(const PlacedBoxes& pair, int j) {
    const double *const b = reinterpret_cast<const double*>(&pair.b), *const q = reinterpret_cast<const double*>(&pair.q);
    const int m = after(j), n = after(m);
    const Cyclic of_j(pair.column[j]), of_m(pair.column[m]), of_n(pair.column[n]), a(pair.a), p(pair.p);
    return {of_j.own, of_j.next, of_j.last, of_m.own, of_n.own, of_m.next, of_n.next, of_m.last, of_n.last,
            a.own, a.next, a.last, all(b[j]), all(b[m]), all(b[n]), p.own, p.next, p.last, all(q[j])};
  }
  GJKDBG_LANES Lanes squared() const { return plus(times(x, x), times(y, y)); }
  GJKDBG_LANES Lanes across() const { return minus(times(p_l, x), times(p_k, y)); }
  GJKDBG_LANES Lanes of_a() const { return plus(times(with(a_k, sign_of(y)), y), times(with(a_l, sign_of(x)), x)); }
  GJKDBG_LANES Lanes separation() const {
    const Lanes of_m = length_of(minus(times(x, r_lm), times(y, r_km))), of_n = length_of(minus(times(x, r_ln), times(y, r_kn)));
    return over(minus(length_of(across()), plus(plus(of_a(), times(b_m, of_m)), times(b_n, of_n))), _mm256_sqrt_pd(squared()));
  }
};

/// The points on three pairs of edges, and which is the nearest.
struct alignas(32) Crossings {
  double on_a[3][4], on_b[3][4], normal[2][4], separation[4], beyond[4];  ///< of the edges' bodies: along the edge and the two axes that follow it
  double nearness;  ///< of the nearest, infinite where no pair of edges faces p
  int nearest;
  bool plain;       ///< no edges are nearly parallel

  GJKDBG_LANES void find(const Edges& e, double floor) {
    const Lanes squared = e.squared(), across = e.across(), side = sign_of(across);
    const Lanes ak = with(e.a_k, sign_of(e.y)), al = with(e.a_l, sign_of(e.x)), bm = with(e.b_m, sign_of(e.r_in)), bn = with(e.b_n, sign_of(e.r_im));
    const Lanes times_length = minus(with(across, side), plus(plus(e.of_a(), times(bm, e.r_in)), times(bn, e.r_im))), inverse = over(all(1), squared);
    plain = bits(_mm256_cmp_pd(squared, all(1.0 / 64), _CMP_LT_OQ)) == 0;
    const Lanes u = minus(e.p_i, with(minus(times(bm, e.r_im), times(bn, e.r_in)), side)), v = minus(e.q_j, with(minus(times(al, e.y), times(ak, e.x)), side));
    Lanes s = clamped(times(minus(u, times(e.r, v)), inverse), e.a_i);
    const Lanes t = clamped(minus(v, times(e.r, s)), e.b_j);
    s = clamped(minus(u, times(e.r, t)), e.a_i);
    const Lanes off_i = minus(minus(u, s), times(e.r, t)), off_j = minus(minus(v, times(e.r, s)), t), across_j = minus(off_i, times(e.r, off_j));
    const Lanes off = plus(times(across_j, across_j), times(squared, times(off_j, off_j)));
    const Lanes faces_p = _mm256_cmp_pd(plus(times_length, all(floor)), _mm256_setzero_pd(), _CMP_GT_OQ);
    const Lanes near = _mm256_blendv_pd(all(std::numeric_limits<double>::infinity()), times(plus(times(times_length, times_length), off), inverse), faces_p);
    nearness = least_of(near);
    nearest = first_of(equal(near, nearness) | 0b1000);
    const Lanes length = with(_mm256_sqrt_pd(squared), side);
    _mm256_store_pd(on_a[0], s), _mm256_store_pd(on_a[1], negative(with(ak, side))), _mm256_store_pd(on_a[2], with(al, side));
    _mm256_store_pd(on_b[0], t), _mm256_store_pd(on_b[1], with(bm, side)), _mm256_store_pd(on_b[2], negative(with(bn, side)));
    _mm256_store_pd(normal[0], over(negative(e.y), length)), _mm256_store_pd(normal[1], over(e.x, length));
    _mm256_store_pd(separation, e.separation()), _mm256_store_pd(beyond, times(plus(off, all((floor / 8) * (floor / 8))), inverse));
  }
  GJKDBG_LANES Lanes point_a(int i, int at) const { return cyclic(i, on_a[0][at], on_a[1][at], on_a[2][at]); }
  GJKDBG_LANES Lanes point_b(const PlacedBoxes& pair, int j, int at) const { return minus(pair.p, pair.rotated(cyclic(j, on_b[0][at], on_b[1][at], on_b[2][at]))); }
  GJKDBG_LANES Lanes normal_of(int i, int at) const {
    const double along = 0;
    return cyclic(i, along, normal[0][at], normal[1][at]);
  }
};

/// Boxes::nearest_beyond: across the ends that p lies beyond of face i of A (`of_a`) or B.
template <bool of_a>
[[gnu::target("avx2"), gnu::noinline]] bool nearest_beyond(const PlacedBoxes& pair, const Faces& faces, int i, double most, const Answer& answer) {
  const double floor = answer.floor;
  const int k = after(i), l = after(k);
  const bool beyond_k = std::abs(faces.off[1][i]) > floor, beyond_l = std::abs(faces.off[2][i]) > floor;
  if (!beyond_k && !beyond_l) return false;
  Crossings found[2];
  const auto find = [&](int which, int along) __attribute__((target("avx2"), always_inline)) { found[which].find(of_a ? Edges::along_a(pair, along) : Edges::along_b(pair, along), floor); };
  int along = beyond_l ? k : l, other = along;
  if (beyond_k && beyond_l) along = std::min(k, l), other = std::max(k, l);
  find(0, along);
  bool plain = found[0].plain;
  int which = 0;
  if (other != along) {
    find(1, other);
    plain &= found[1].plain;
    if (found[1].nearness < found[0].nearness) which = 1, along = other;
  }
  const Crossings& edges = found[which];
  if (!plain || !(edges.nearness < std::numeric_limits<double>::infinity())) return false;
  const int at = edges.nearest, on_a = of_a ? along : at, on_b = of_a ? at : along;
  const Lanes point = edges.point_a(on_a, at), way = minus(edges.point_b(pair, on_b, at), point);
  const double separation = edges.separation[at], widest = std::max(most, separation);
  if (edges.beyond[at] <= floor * floor) {
    if (!(widest - separation <= 2 * floor)) return false;
    const Lanes normal = edges.normal_of(on_a, at);
    return answer.say(SatStatus::separated, point, plus(point, times(normal, all(separation))), normal, separation, widest, 15, 0);
  }
  const double distance = std::sqrt(added(times(way, way)));
  const Lanes normal = over(way, all(distance));
  const double apart = pair.plane(normal);
  return distance - apart <= 2 * floor && answer.say(SatStatus::separated, point, plus(point, way), normal, distance, std::max(widest, apart), 15, 1);
}

/// Boxes::least_overlap, where no axis has more than `floor` between.
[[gnu::target("avx2"), gnu::noinline]] bool least_overlap(const PlacedBoxes& pair, const Faces& of_a, const Faces& of_b, const Told& a, const Told& b, double most, const Answer& answer) {
  const double floor = answer.floor;
  const Lanes edges[3] = {Edges::along_a(pair, 0).separation(), Edges::along_a(pair, 1).separation(), Edges::along_a(pair, 2).separation()};
  const double widest = greatest_of(_mm256_max_pd(_mm256_max_pd(edges[0], edges[1]), edges[2]));
  const auto say = [&](const Lanes& point, const Lanes& normal, double separation) __attribute__((target("avx2"), always_inline)) {
    return answer.say(SatStatus::overlapping, point, plus(point, times(normal, all(separation))), normal, separation, separation, 15, 0);
  };
  if (widest > most) {
    if (widest > floor) return false;
    const int of_nine = first_of(equal(edges[0], widest) | equal(edges[1], widest) << 3 | equal(edges[2], widest) << 6), i = of_nine / 3, at = of_nine % 3;
    Crossings found;
    found.find(Edges::along_a(pair, i), floor);
    return found.beyond[at] <= floor * floor && say(found.point_a(i, at), found.normal_of(i, at), widest);
  }
  const int face = first_of(equal(a.separation, most) | equal(b.separation, most) << 3), i = face % 3;
  const Faces& faces = face < 3 ? of_a : of_b;
  if (!(faces.beyond[i] <= floor * floor)) return false;
  const double side = std::copysign(1.0, faces.on[0][i]), along = 0;
  const Lanes normal = cyclic(i, side, along, along), point = faces.point(i);
  return face < 3 ? say(point, normal, most) : say(minus(pair.p, pair.rotated(plus(point, faces.way(i)))), pair.rotated(normal), most);
}

/// Of bodies that some axis has `most` between: across face i of A (`of_a`) or B, which p is nearest to.
template <bool of_a>
[[gnu::target("avx2"), gnu::noinline]] bool across_face(const PlacedBoxes& pair, const Faces& faces, int i, double nearness, double most, const Answer& answer) {
  const double floor = answer.floor;
  Lanes point = faces.point(i), way = faces.way(i);
  if constexpr (!of_a) point = minus(pair.p, pair.rotated(plus(point, way))), way = pair.rotated(way);
  const double distance = std::sqrt(nearness);
  const Lanes normal = over(way, all(distance));
  const double apart = pair.plane(normal);
  if (distance - apart <= 2 * floor) return answer.say(SatStatus::separated, point, plus(point, way), normal, distance, std::max(most, apart), 6, faces.beyond[i] > floor * floor);
  return nearest_beyond<of_a>(pair, faces, i, most, answer);
}

}  // namespace

[[gnu::target("avx2")]] bool solved_by_avx2(const BoxQuery<3, double>& query, const PlacedAxes<3>& pose_a, const PlacedAxes<3>& pose_b, Result& result) {
  const double *const turn_a = pose_a.rotation.data(), *const turn_b = pose_b.rotation.data();
  const Three of_a = transposed(_mm256_loadu_pd(turn_a), _mm256_loadu_pd(turn_a + 3), three(turn_a + 6));
  const auto seen_from_a = [&](const Lanes& x, const Lanes& y, const Lanes& z) __attribute__((target("avx2"), always_inline)) { return sum(of_a.of[0], of_a.of[1], of_a.of[2], x, y, z); };
  PlacedBoxes pair;
  for (int j = 0; j < 3; ++j) pair.column[j] = seen_from_a(all(turn_b[3 * j]), all(turn_b[3 * j + 1]), all(turn_b[3 * j + 2]));
  const Lanes least = _mm256_min_pd(_mm256_min_pd(length_of(pair.column[0]), length_of(pair.column[1])), length_of(pair.column[2]));
  if (bits(_mm256_cmp_pd(least, all(Boxes<double>::next_to_zero), _CMP_LE_OQ)) != 0) [[unlikely]] return false;
  // relative_pose(): the difference of the positions in twice the precision (Knuth's sum).
  const Lanes to_b = times(three(pose_b.position.data()), all(query.scale)), from_a = negative(times(three(pose_a.position.data()), all(query.scale)));
  const Lanes high = plus(to_b, from_a), of_b = minus(high, to_b), low = plus(minus(to_b, minus(high, of_b)), minus(from_a, of_b));
  pair.p = plus(seen_from_a(lane<0>(high), lane<1>(high), lane<2>(high)), seen_from_a(lane<0>(low), lane<1>(low), lane<2>(low)));
  const double floor = rounding_floor_of(query.extents, added(times(pair.p, pair.p)));
  const Three rows = transposed(pair.column[0], pair.column[1], pair.column[2]);
  for (int i = 0; i < 3; ++i) pair.row[i] = rows.of[i];
  pair.q = sum(pair.row[0], pair.row[1], pair.row[2], lane<0>(pair.p), lane<1>(pair.p), lane<2>(pair.p));
  pair.a = three(query.half_a.data()), pair.b = three(query.half_b.data());

  Faces faces_a, faces_b;
  const Told a = tell(faces_a, pair.p, pair.a, pair.b, pair.column), b = tell(faces_b, pair.q, pair.b, pair.a, pair.row);
  const double most = greatest_of(_mm256_max_pd(a.separation, b.separation));
  const Answer answer{query, pose_a, floor, result};
  if (!(most > floor)) return least_overlap(pair, faces_a, faces_b, a, b, most, answer);
  const double nearness = least_of(_mm256_min_pd(a.nearness, b.nearness));
  const unsigned nearest_of_a = equal(a.nearness, nearness), nearest_of_b = equal(b.nearness, nearness) | 0b1000;
  return nearest_of_a != 0 ? across_face<true>(pair, faces_a, first_of(nearest_of_a), nearness, most, answer)
                           : across_face<false>(pair, faces_b, first_of(nearest_of_b), nearness, most, answer);
}

}  // namespace gjkdbg
#endif
