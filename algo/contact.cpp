#include "algo/contact.h"

#include <algorithm>
#include <cmath>

#include "shapes/convex_hull.h"
#include "shapes/corners.h"

namespace gjkdbg {
namespace {

using Points = std::vector<AnyVector>;

constexpr double alignment_limit = 1 - 1e-9;  ///< cosine: a face whose normal is this near the pair's can be the reference

/// The face of a body that looks most along a direction: its corners in order, and how well it is aligned (the cosine;
/// -2 when the body has no face: then `points` are all of its corners).
struct Feature {
  Points points;
  double alignment = -2;
};

double size_of_points(const Points& points) {
  double size = 0;
  for (const AnyVector& p : points) size = std::max(size, (p - points[0]).cwiseAbs().maxCoeff());
  return size;
}

AnyVector normal_of(const Points& face) {
  const int dimension = static_cast<int>(face[0].size());
  if (dimension == 2) {
    const AnyVector e = face[1] - face[0];
    return Eigen::Vector2d(e[1], -e[0]).normalized();
  }
  // Newell's sum: the vector area, whatever the polygon's corners are.
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    const Eigen::Vector3d x = face[i] - face[0], y = face[i + 1] - face[0];
    area += x.cross(y);
  }
  return area.stableNormalized();
}

std::vector<Points> faces_of(const Points& points, int dimension) {
  const ConvexHull hull = convex_hull(points, dimension);
  std::vector<Points> faces;
  if (dimension == 2 && hull.rank == 1) {
    const AnyVector &p = points[static_cast<std::size_t>(hull.vertices.front())], &q = points[static_cast<std::size_t>(hull.vertices.back())];
    return {{p, q}, {q, p}};
  }
  for (const auto& loop : hull.faces) {
    Points corners;
    for (const int i : loop) corners.push_back(points[static_cast<std::size_t>(i)]);
    if (dimension == 3) {
      faces.push_back(corners);
    } else {
      for (std::size_t i = 0; i < corners.size(); ++i) faces.push_back({corners[i], corners[(i + 1) % corners.size()]});
    }
  }
  return faces;
}

/// An edge in the plane with what lies on its line as well: a corner within it may be one of the hull's by rounding.
Points whole_edge(const Points& edge, const Points& all) {
  const AnyVector along = edge[1] - edge[0], n = normal_of(edge);
  Points whole = edge;
  for (const AnyVector& p : all) {
    if (n.dot(p - edge[0]) < -1e-12 * size_of_points(all)) continue;
    if (along.dot(p - whole[0]) < 0) whole[0] = p;
    if (along.dot(p - whole[1]) > 0) whole[1] = p;
  }
  return whole;
}

Feature feature(const Corners& body, const AnyVector& direction) {
  Feature best{body.points, -2};
  for (const Points& face : faces_of(body.points, static_cast<int>(direction.size())))
    if (const double cosine = normal_of(face).dot(direction); cosine > best.alignment) best = {face, cosine};
  if (direction.size() == 2 && best.alignment > -2) best.points = whole_edge(best.points, body.points);
  return best;
}

/// The part of a polygon (or of a segment, two corners) on the inner side of a plane: outward . (x - on) <= 0.
Points clipped(const Points& polygon, const AnyVector& outward, const AnyVector& on) {
  Points out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const AnyVector &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double hp = outward.dot(p - on), hq = outward.dot(q - on);
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

Points in_world(const Points& points, const Pose& pose) {
  Points out;
  for (const AnyVector& p : points) out.push_back(pose.matrix * p + pose.position);
  return out;
}

/// Contacts of an incident feature behind a reference face. `n` is the reference's outward normal.
/// With r0 on the face and x a clipped corner, x lies n . (r0 - x) deep in the core; the radii add to that.
std::vector<ContactPoint> behind(const Points& clipped, const AnyVector& r0, const AnyVector& n, double reference_radius,
                                 double incident_radius, double size, bool reference_is_a) {
  std::vector<ContactPoint> contacts;
  for (const AnyVector& x : clipped) {
    const double depth = n.dot(r0 - x) + reference_radius + incident_radius;
    if (depth < -1e-12 * size) continue;
    const AnyVector on_incident = x - n * incident_radius, on_reference = on_incident + n * depth;
    const auto same = [&](const ContactPoint& c) {
      return ((reference_is_a ? c.point_b : c.point_a) - on_incident).norm() <= 1e-9 * size;
    };
    if (std::any_of(contacts.begin(), contacts.end(), same)) continue;
    contacts.push_back(reference_is_a ? ContactPoint{on_reference, on_incident, std::max(0.0, depth)}
                                      : ContactPoint{on_incident, on_reference, std::max(0.0, depth)});
  }
  return contacts;
}

}  // namespace

std::vector<ContactPoint> contact_points(const Body& a, const Body& b, const Result& result) {
  const std::vector<ContactPoint> witness{{*result.witness_a, *result.witness_b, std::max(0.0, -*result.signed_distance)}};
  const AnyVector n = *result.normal;
  const int dimension = static_cast<int>(n.size());
  auto corners_a = corners_of(a.shape, dimension), corners_b = corners_of(b.shape, dimension);
  if (dimension == 1 || !corners_a || !corners_b) return witness;
  corners_a->points = in_world(corners_a->points, a.pose);
  corners_b->points = in_world(corners_b->points, b.pose);
  const Feature face_a = feature(*corners_a, n), face_b = feature(*corners_b, -n);
  const bool reference_is_a = face_a.alignment >= face_b.alignment - 1e-12;
  const Feature &reference = reference_is_a ? face_a : face_b, &incident = reference_is_a ? face_b : face_a;
  if (reference.alignment < alignment_limit) return witness;
  const AnyVector outward = reference_is_a ? n : AnyVector(-n);
  const Corners &owner = reference_is_a ? *corners_a : *corners_b, &other = reference_is_a ? *corners_b : *corners_a;
  const double size = size_of_points(owner.points) + size_of_points(other.points) + owner.radius + other.radius;
  const Points left = clip_to_sides(incident.points, reference.points, outward);
  const auto contacts = behind(left, reference.points[0], outward, owner.radius, other.radius, size, reference_is_a);
  return contacts.empty() ? witness : contacts;
}

}  // namespace gjkdbg
