#include "algo/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "algo/flat_feature.h"
#include "algo/status.h"
#include "algo/working_scale.h"
#include "shapes/features.h"

namespace gjkdbg {
namespace {

using Points = std::vector<AnyVector>;

constexpr double alignment_limit = 1 - 1e-9;  ///< cosine: a face whose normal is this near the pair's can be the reference
constexpr double parallel_sine = 1e-9;        ///< sine: lines at more share a point only
constexpr double edge_on = 1e-6;              ///< sine: a face that is seen at less has no part of its own behind another

/// The part of a polygon (or of a segment, two corners) on the inner side of a plane: outward . (x - on) <= 0. What rounding leaves next to the plane is on it: an edge that lies
/// along it would meet it anywhere.
Points clipped(const Points& polygon, const AnyVector& outward, const AnyVector& on) {
  const AnyVector unit = outward.stableNormalized();
  double size = 0;
  for (const AnyVector& p : polygon) size = std::max(size, (p - on).cwiseAbs().maxCoeff());
  const double noise = 1e-12 * size + 8 * std::numeric_limits<double>::epsilon() * on.cwiseAbs().maxCoeff();
  const auto height = [&](const AnyVector& p) {
    const double h = unit.dot(p - on);
    return std::abs(h) <= noise ? 0 : h;
  };
  Points out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const AnyVector &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double hp = height(p), hq = height(q);
    if (hp <= 0) out.push_back(p);
    if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) out.push_back(p + (q - p) * (hp / (hp - hq)));
  }
  return out;
}

/// Clips the incident feature to the sides of the reference face, whose normal is `n`.
Points clip_to_sides(Points incident, const Points& reference, const AnyVector& n) {
  if (n.size() == 2) {
    const AnyVector along = reference[1] - reference[0];
    return clipped(clipped(incident, along, reference[1]), -along, reference[0]);
  }
  for (std::size_t i = 0; i < reference.size() && !incident.empty(); ++i) {
    const Eigen::Vector3d edge = reference[(i + 1) % reference.size()] - reference[i], up = n;
    incident = clipped(incident, edge.cross(up), reference[i]);
  }
  return incident;
}

// --- Discs: nothing of them is a polygon. Their part of the contact's outline is told by points of the rim, those where it meets the other outline among them. ---

/// Points of a disc's rim, an eighth of the way around apart, from the one farthest along a direction on; where none is, from the same one always.
struct Rim {
  Eigen::Vector3d center, u, v;

  Rim(const Disc& disc, const Eigen::Vector3d& first) : center(disc.center) {
    const Eigen::Vector3d along = first - disc.normal * disc.normal.dot(first);
    u = (along.norm() > 1e-9 ? along.normalized() : disc.normal.unitOrthogonal()) * disc.radius, v = disc.normal.cross(u);
  }
  Eigen::Vector3d at(double eighths) const {
    const double angle = eighths * std::numbers::pi / 4;
    return center + std::cos(angle) * u + std::sin(angle) * v;
  }
};

/// Where the line through x along n meets the plane through `on` across m.
Eigen::Vector3d lifted(const Eigen::Vector3d& x, const Eigen::Vector3d& n, const Eigen::Vector3d& on, const Eigen::Vector3d& m) {
  return x + n * (m.dot(on - x) / m.dot(n));
}

/// How far x lies outside the cylinder that a disc sweeps along a direction, if the disc lies across it.
double outside(const Disc& disc, const Eigen::Vector3d& n, const Eigen::Vector3d& x) {
  const Eigen::Vector3d d = x - disc.center;
  return (d - n * n.dot(d)).norm() - disc.radius;
}

/// Whether x, in the polygon's plane or above it, lies within its sides.
bool within(const Points& polygon, const Eigen::Vector3d& normal, const Eigen::Vector3d& x) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d edge = polygon[(i + 1) % polygon.size()] - polygon[i], from = polygon[i];
    if (edge.cross(normal).dot(x - from) > 0) return false;
  }
  return true;
}

/// A polygon's corners, or a line's ends, within the cylinder that a disc sweeps along n, and where its edges enter and leave that: with a from the axis to
/// an edge's beginning and e along the edge, both across n, |a + t e|^2 = r^2.
Points outline_within(const Points& polygon, const Disc& disc, const Eigen::Vector3d& n) {
  Points out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d p = polygon[i], along = polygon[(i + 1) % polygon.size()] - polygon[i], from = p - disc.center;
    const Eigen::Vector3d a = from - n * n.dot(from), e = along - n * n.dot(along);
    if (outside(disc, n, p) <= 0) out.push_back(p);
    const double ee = e.squaredNorm(), ae = a.dot(e), room = ae * ae - ee * (a.squaredNorm() - disc.radius * disc.radius);
    if (ee == 0 || !(room > 0)) continue;
    for (const double root : {-std::sqrt(room), std::sqrt(room)})
      if (const double t = (root - ae) / ee; t > 0 && t < 1) out.push_back(p + along * t);
  }
  return out;
}

Points disc_behind_polygon(const Disc& incident, const Points& reference, const Eigen::Vector3d& n) {
  Points above;
  for (const AnyVector& p : reference) above.push_back(lifted(p, n, incident.center, incident.normal));
  const Rim rim(incident, -n);
  Points out;
  for (int k = 0; k < 8; ++k)
    if (within(reference, n, rim.at(k))) out.push_back(rim.at(k));
  for (const AnyVector& p : outline_within(above, incident, incident.normal)) out.push_back(p);
  return out;
}

Points polygon_behind_disc(const Points& incident, const Disc& reference, const Eigen::Vector3d& n) {
  Points out = outline_within(incident, reference, n);
  const Eigen::Vector3d m = incident.size() < 3 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(normal_of(incident));
  if (std::abs(m.dot(n)) < edge_on) return out;
  const Rim rim(reference, Eigen::Vector3d::Zero());
  for (int k = 0; k < 8; ++k)
    if (const Eigen::Vector3d x = lifted(rim.at(k), n, incident[0], m); within(incident, m, x)) out.push_back(x);
  return out;
}

Points disc_behind_disc(const Disc& incident, const Disc& reference, const Eigen::Vector3d& n) {
  const Rim rim(incident, -n), other(reference, Eigen::Vector3d::Zero());
  Points out;
  for (int k = 0; k < 8; ++k) {
    const double here = outside(reference, n, rim.at(k)), next = outside(reference, n, rim.at(k + 1));
    if (here <= 0) out.push_back(rim.at(k));
    if ((here <= 0) == (next <= 0)) continue;
    double in = here <= 0 ? k : k + 1, beyond = here <= 0 ? k + 1 : k;  // halved until they are neighbours
    for (double middle = (in + beyond) / 2; middle != in && middle != beyond; middle = (in + beyond) / 2) (outside(reference, n, rim.at(middle)) <= 0 ? in : beyond) = middle;
    out.push_back(rim.at(in));
  }
  for (int k = 0; k < 8; ++k)
    if (const Eigen::Vector3d x = lifted(other.at(k), n, incident.center, incident.normal); (x - incident.center).norm() <= incident.radius) out.push_back(x);
  return out;
}

// --- Lines: where no face looks along the normal, an edge or the line on a round side may still lie along another. ---

/// The line of a feature that lies across n and farthest along it: the feature itself, or the edge of a face.
std::optional<Points> line_across(const FlatFeature& feature, const AnyVector& n) {
  if (n.size() != 3 || feature.points.size() < 2) return std::nullopt;
  const auto height = [&](const Points& line) { return n.dot(line[0] + line[1]); };
  Points best{feature.points[0], feature.points[1]};
  for (std::size_t i = 1; i < feature.points.size(); ++i)
    if (const Points edge{feature.points[i], feature.points[(i + 1) % feature.points.size()]}; height(edge) > height(best)) best = edge;
  const AnyVector along = best[1] - best[0];
  if (!(std::abs(n.dot(along)) <= parallel_sine * along.norm()) || along.isZero(0)) return std::nullopt;
  return best;
}

/// The part of b beside a, if they lie along one another.
Points line_beside_line(const Points& a, const Points& b) {
  const Eigen::Vector3d u = a[1] - a[0], v = b[1] - b[0];
  if (u.cross(v).norm() > parallel_sine * u.norm() * v.norm()) return {};
  return clipped(clipped(b, u, a[1]), -u, a[0]);
}

/// The points of the incident feature's outline that lie behind the reference, or above it, and of the reference's outline above the incident feature.
Points common_outline(const FlatFeature& incident, const FlatFeature& reference, const AnyVector& n) {
  if (incident.disc && std::abs(n.dot(incident.disc->normal)) < edge_on) return {};
  if (incident.disc && reference.disc) return disc_behind_disc(*incident.disc, *reference.disc, n);
  if (incident.disc) return disc_behind_polygon(*incident.disc, reference.points, n);
  if (reference.disc) return polygon_behind_disc(incident.points, *reference.disc, n);
  return clip_to_sides(incident.points, reference.points, n);
}

/// How far behind a point x of an edge with a radius the surface lies, along the reference's normal n. In the plane, with the edge from its deeper end on
/// (low) rising by the angle theta, the surface is a line parallel to it, r / cos theta behind x, whose points come from places r tan theta farther down the
/// edge; where the edge ends before, the surface is the ball around `low`: x is h higher than that and s beside it, so h + sqrt(r^2 - s^2).
/// In space x - n r is taken, which lies in the body and on its surface where the feature is level.
double surface_behind(const AnyVector& x, const FlatFeature& incident, const AnyVector& n) {
  const double r = incident.radius;
  if (n.size() != 2 || r == 0 || incident.points.size() != 2) return r;
  const bool in_order = n.dot(incident.points[0]) <= n.dot(incident.points[1]);
  const AnyVector &low = incident.points[in_order ? 0 : 1], &high = incident.points[in_order ? 1 : 0], edge = high - low, along = x - low;
  const double length = edge.norm(), rise = n.dot(edge), level = (edge - n * rise).norm(), h = n.dot(along), s = (along - n * h).norm();
  if (along.norm() * level >= r * rise) return level > 0 ? r * length / level : r;
  return h + std::sqrt(std::max(0.0, r * r - s * s));
}

/// Contacts of an incident feature behind a reference face. `n` is the reference's outward normal.
/// With r0 on the face and x a clipped corner, x lies n . (r0 - x) deep in the core; the radii add to that.
std::vector<ContactPoint> behind(const Points& clipped, const AnyVector& r0, const AnyVector& n, double reference_radius,
                                 const FlatFeature& incident, double size, bool reference_is_a) {
  std::vector<ContactPoint> contacts;
  for (const AnyVector& x : clipped) {
    const double below = surface_behind(x, incident, n), depth = n.dot(r0 - x) + reference_radius + below;
    if (depth < -1e-12 * size) continue;
    const AnyVector on_incident = x - n * below, on_reference = on_incident + n * depth;
    const auto same = [&](const ContactPoint& c) {
      return ((reference_is_a ? c.point_b : c.point_a) - on_incident).norm() <= 1e-9 * size;
    };
    if (std::any_of(contacts.begin(), contacts.end(), same)) continue;
    contacts.push_back(reference_is_a ? ContactPoint{on_reference, on_incident, std::max(0.0, depth)}
                                      : ContactPoint{on_incident, on_reference, std::max(0.0, depth)});
  }
  return contacts;
}

struct SharedPoints {
  std::vector<ContactPoint> contacts;  ///< empty: the witness points are all there is
  double size = 0;                     ///< of the features they lie on
};
SharedPoints shared_points(const Body& a, const Body& b, const AnyVector& n) {
  const auto face_a = flat_feature(a, n), face_b = flat_feature(b, -n);
  if (!face_a || !face_b) return {};
  const bool reference_is_a = face_a->alignment >= face_b->alignment - 1e-12;
  const FlatFeature &reference = reference_is_a ? *face_a : *face_b, &incident = reference_is_a ? *face_b : *face_a;
  const double size = reference.size + incident.size + reference.radius + incident.radius;
  if (reference.alignment < alignment_limit) {
    const auto line_a = line_across(*face_a, n), line_b = line_across(*face_b, -n);
    if (!line_a || !line_b) return {{}, size};
    return {behind(line_beside_line(*line_a, *line_b), (*line_a)[0], n, face_a->radius, *face_b, size, true), size};
  }
  const AnyVector outward = reference_is_a ? n : AnyVector(-n), on_face = reference.disc ? AnyVector(reference.disc->center) : reference.points[0];
  return {behind(common_outline(incident, reference, outward), on_face, outward, reference.radius, incident, size, reference_is_a), size};
}

/// In units in which products of lengths are numbers, from body 0's place on: in them the way to the world's origin need be none.
SharedPoints shared_in_units(const Body& a, const Body& b, const AnyVector& n, double scale) {
  Body here = a, there = b;
  here.shape = scaled(a.shape, scale), here.pose.position *= 0;
  there.shape = scaled(b.shape, scale), there.pose.position = (b.pose.position - a.pose.position) * scale;
  SharedPoints shared = shared_points(here, there, n);
  for (ContactPoint& c : shared.contacts) c = {a.pose.position + c.point_a / scale, a.pose.position + c.point_b / scale, c.depth / scale};
  shared.size /= scale;
  return shared;
}

}  // namespace

std::vector<ContactPoint> contact_points(const Body& a, const Body& b, const Result& result) {
  const ContactPoint witness{*result.witness_a, *result.witness_b, std::max(0.0, -*result.signed_distance)};
  if (result.status == word_of(EpaStatus::iteration_limit)) return {witness};  // the normal is no side's, nor need it come near
  AnyVector n = *result.normal;
  if (std::abs(n.squaredNorm() - 1) > 1e-12) n.normalize();  // of length 1 in single precision only: sides are told from it by cosines of doubles
  const double scale = working_scale<double>(a, b);
  SharedPoints shared = scale == 1 ? shared_points(a, b, n) : shared_in_units(a, b, n, scale);
  // Of a hull the face that looks along the normal best need not be one at the corner that lies deepest: then the witness points are a contact, too.
  const double known = 1e-7 * shared.size + (result.lower_bound && result.upper_bound ? *result.upper_bound - *result.lower_bound : 0);  // what the depth may be off by
  const auto deep = [&](const ContactPoint& c) { return c.depth >= witness.depth - known; };
  if (std::none_of(shared.contacts.begin(), shared.contacts.end(), deep)) shared.contacts.push_back(witness);
  return shared.contacts;
}

double least_apart(double size_a, double size_b, double far) {
  return 1e-9 * std::min(size_a, size_b) + 64 * std::numeric_limits<double>::epsilon() * (size_a + size_b + far);
}

}  // namespace gjkdbg
