#include "debugger/lab/shrink.h"

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "shapes/error.h"

namespace gjkdbg {
namespace {

/// The number with so many digits.
double rounded(double x, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return std::strtod(text, nullptr);
}

/// What a shape is made of, each number with its mirror image in a box about the origin. Not of sums, whose parts are shared, nor of meshes.
struct ShapeNumbers {
  std::vector<std::vector<double*>> groups;
  void add(double& x) { groups.push_back({&x}); }
  void add(AnyVector& v) {
    for (double& x : v) add(x);
  }
  void operator()(Sphere& s) { add(s.radius); }
  void operator()(Box& b) {
    const bool centred = b.from_half_extents && b.min == -b.max;
    for (Eigen::Index i = 0; i < b.min.size(); ++i) {
      if (centred) groups.push_back({&b.max[i], &b.min[i]});
      else add(b.max[i]), add(b.min[i]);
    }
  }
  void operator()(Capsule& s) { add(s.radius), add(s.half_height); }
  void operator()(Cylinder& s) { add(s.radius), add(s.half_height); }
  void operator()(Cone& s) { add(s.radius), add(s.half_height); }
  void operator()(Ellipsoid& e) { add(e.radii); }
  void operator()(PointSet& set) {
    for (AnyVector& p : set.points) add(p);
  }
  void operator()(Mesh&) {}
  void operator()(Sum&) {}
};

std::vector<std::vector<double*>> numbers_of(Scene& scene) {
  ShapeNumbers numbers;
  for (Body& body : scene.bodies) {
    numbers.add(body.pose.position);
    std::visit(numbers, body.shape.geometry);
    if (body.shape.margin > 0) numbers.add(body.shape.margin);
  }
  return std::move(numbers.groups);
}

class Shrinking {
 public:
  Shrinking(Scene scene, const std::function<bool(const Scene&)>& still, int most) : scene_(std::move(scene)), still_(still), left_(most) {}

  Scene run() {
    if (!fails(scene_)) return std::move(scene_);
    attempt([](Scene& s) {
      const AnyVector offset = s.bodies[0].pose.position;
      for (Body& body : s.bodies) body.pose.position -= offset;
    });
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
      attempt([b](Scene& s) {
        const AnyVector position = s.bodies[b].pose.position;
        s.bodies[b].pose = identity_pose(s.dimension), s.bodies[b].pose.position = position;
      });
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) drop_points(b);
    const std::size_t numbers = numbers_of(scene_).size();
    for (int digits = 1; digits <= 8; ++digits)
      for (std::size_t k = 0; k < numbers && left_ > 0; ++k)
        attempt([&](Scene& s) {
          const std::vector<double*> group = numbers_of(s)[k];
          const double x = rounded(*group.front(), digits);
          for (std::size_t i = 0; i < group.size(); ++i) *group[i] = i == 0 ? x : -x;
        });
    return std::move(scene_);
  }

 private:
  bool fails(const Scene& candidate) {
    if (left_-- <= 0) return false;
    try {
      for (const Body& body : candidate.bodies) validate(body.shape, candidate.dimension);
      return still_(candidate);
    } catch (const Error&) {
      return false;
    }
  }

  void attempt(const std::function<void(Scene&)>& change) {
    Scene candidate = scene_;
    change(candidate);
    if (!same(candidate) && fails(candidate)) scene_ = std::move(candidate);
  }

  /// Nothing was gained.
  bool same(Scene& other) {
    const auto mine = numbers_of(scene_), theirs = numbers_of(other);
    if (mine.size() != theirs.size()) return false;
    for (std::size_t i = 0; i < mine.size(); ++i)
      if (*mine[i].front() != *theirs[i].front()) return false;
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
      if (scene_.bodies[b].pose.matrix != other.bodies[b].pose.matrix) return false;
    return true;
  }

  /// Half of them at once, then a quarter, … and each alone.
  void drop_points(std::size_t b) {
    const auto points_of = [b](Scene& s) { return std::get_if<PointSet>(&s.bodies[b].shape.geometry); };
    const PointSet* const set = points_of(scene_);
    for (std::size_t some = set ? set->points.size() / 2 : 0; some > 0; some /= 2)
      for (std::size_t end = points_of(scene_)->points.size(); end > some && left_ > 0; end -= some)
        attempt([&](Scene& s) {
          auto& points = points_of(s)->points;
          if (end <= points.size()) points.erase(points.begin() + static_cast<std::ptrdiff_t>(end - some), points.begin() + static_cast<std::ptrdiff_t>(end));
        });
  }

  Scene scene_;
  const std::function<bool(const Scene&)>& still_;
  int left_;
};

}  // namespace

Scene shrunk(Scene scene, const std::function<bool(const Scene&)>& still, int most) { return Shrinking(std::move(scene), still, most).run(); }

}  // namespace gjkdbg
