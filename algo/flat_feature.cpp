#include "algo/flat_feature.h"

#include <algorithm>
#include <cmath>

#include "shapes/convex_hull.h"
#include "shapes/corners.h"
#include "shapes/features.h"

namespace gjkdbg {
namespace {

using Points = std::vector<AnyVector>;

double size_of_points(const Points& points) {
  double size = 0;
  for (const AnyVector& p : points) size = std::max(size, (p - points[0]).cwiseAbs().maxCoeff());
  return size;
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

FlatFeature feature_of_corners(const Points& corners, const AnyVector& direction) {
  FlatFeature best;
  best.points = corners, best.size = size_of_points(corners);
  for (const Points& face : faces_of(corners, static_cast<int>(direction.size())))
    if (const double cosine = normal_of(face).dot(direction); cosine > best.alignment) best.points = face, best.alignment = cosine;
  if (direction.size() == 2 && best.alignment > -2) best.points = whole_edge(best.points, corners);
  return best;
}

/// Of a body round about an axis, in its own frame: a disc across the axis, or a line from the rim of one at -half_height to a rim at +half_height.
/// With r the rims' radii and h the half height the line runs along (r1 - r0, 2 h), away from the axis and along it, and faces the way of (2 h, r0 - r1).
class AroundAnAxis {
 public:
  AroundAnAxis(int axis, double half_height, double lower_radius, double upper_radius)
      : axis_(Eigen::Vector3d::Unit(axis)), half_height_(half_height), lower_(lower_radius), upper_(upper_radius) {}

  FlatFeature feature(const Eigen::Vector3d& direction) const {
    FlatFeature best;
    best.size = 2 * std::max({lower_, upper_, half_height_});
    for (const double side : {-1.0, 1.0})
      if (const double radius = side < 0 ? lower_ : upper_; radius > 0 && side * axis_.dot(direction) > best.alignment)
        best.disc = Disc{axis_ * (side * half_height_), axis_ * side, radius}, best.alignment = side * axis_.dot(direction);
    const Eigen::Vector3d across = direction - axis_ * axis_.dot(direction), away = across.stableNormalized();
    const Eigen::Vector3d normal = (2 * half_height_ * away + (lower_ - upper_) * axis_).stableNormalized();
    if (across.isZero(0) || half_height_ == 0 || normal.dot(direction) <= best.alignment) return best;
    best.disc.reset(), best.alignment = -2;  // a line is no face
    best.points = {away * lower_ - axis_ * half_height_, away * upper_ + axis_ * half_height_};
    return best;
  }

 private:
  Eigen::Vector3d axis_;
  double half_height_, lower_, upper_;
};

std::optional<FlatFeature> own_feature(const Shape& shape, const AnyVector& direction) {
  if (direction.size() == 3) {
    if (const auto* c = std::get_if<Cylinder>(&shape.geometry)) return AroundAnAxis(c->axis, c->half_height, c->radius, c->radius).feature(direction);
    if (const auto* c = std::get_if<Cone>(&shape.geometry)) return AroundAnAxis(c->axis, c->half_height, c->radius, 0).feature(direction);
  }
  const auto corners = corners_of(shape, static_cast<int>(direction.size()));
  if (!corners || direction.size() == 1) return std::nullopt;
  FlatFeature found = feature_of_corners(corners->points, direction);
  found.radius = corners->radius - shape.margin;
  return found;
}

}  // namespace

std::optional<FlatFeature> flat_feature(const Body& body, const AnyVector& direction) {
  auto found = own_feature(body.shape, body.pose.matrix.transpose() * direction);
  if (!found) return found;
  found->radius += body.shape.margin;
  for (AnyVector& p : found->points) p = body.pose.matrix * p + body.pose.position;
  if (found->disc) {
    found->disc->center = AnyVector(body.pose.matrix * found->disc->center + body.pose.position);
    found->disc->normal = AnyVector(body.pose.matrix * found->disc->normal);
  }
  return found;
}

}  // namespace gjkdbg
