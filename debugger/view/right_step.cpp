#include "debugger/view/right_step.h"

#include <algorithm>

#include "debugger/view/explain.h"
#include "recordings/check_context.h"

namespace gjkdbg {
namespace {

struct RightStep {
  const Recording& recording;
  const Frame& frame;

  /// The nearest part of the vertices in a list, or nothing when one is not known.
  std::optional<NearestPoint> nearest(const std::vector<int>& numbers) const {
    std::vector<AnyVector> points;
    for (const int n : numbers) {
      const auto found = frame.vertices.find(n);
      if (found == frame.vertices.end()) return std::nullopt;
      points.push_back(found->second.w);
    }
    if (points.empty() || points.size() > 6) return std::nullopt;
    return nearest_point(points);
  }

  /// But for rounding; a simplex of as many vertices as there can be is nearest only where the origin is within.
  bool holds_the_origin(const NearestPoint& best, const std::vector<int>& of) const {
    if (static_cast<int>(best.subset.size()) == recording.scene.scene.dimension + 1) return true;
    double farthest = 0;
    for (const int n : of) farthest = std::max(farthest, frame.vertices.at(n).w.norm());
    return best.v.norm() <= 1e-15 * farthest;
  }

  std::string operator()(const recorded::SupportQueried& e) const {
    if (e.phase != Phase::gjk || frame.simplex.size() < 2) return {};
    const auto best = nearest({frame.simplex.begin() + 1, frame.simplex.end()});
    if (!best || best->v.isZero(0)) return {};
    return "From the simplex it had, search along -v = " + short_vector(-best->v) + ", or a multiple of it.";
  }

  std::string operator()(const recorded::SimplexReduced& e) const {
    std::vector<int> had = frame.simplex;
    had.insert(had.end(), frame.dropped.begin(), frame.dropped.end());
    const auto best = nearest(had);
    if (!best) return {};
    std::vector<int> right;
    for (const int i : best->subset) right.push_back(had[static_cast<std::size_t>(i)]);
    std::sort(right.rbegin(), right.rend());  // newest first
    std::string kept = right.size() == had.size() ? "Keep all of" : right.size() == e.region.size() ? "Keep" : "Keep only";
    for (const int v : right) kept += " #" + std::to_string(v);
    if (holds_the_origin(*best, had)) return kept + ": the origin lies in it, so the bodies overlap. The search is over.";
    return kept + ": |v| = " + short_number(best->v.norm()) + ", v = " + short_vector(best->v) + ". Then search along -v.";
  }

  std::string operator()(const recorded::FaceChosen&) const {
    const FrameFace* best = nullptr;
    for (const auto& [number, face] : frame.faces)
      if (!best || face.distance < best->distance) best = &face;
    if (!best) return {};
    std::string vertices;
    for (const int v : best->vertices) vertices += " #" + std::to_string(v);
    return "Choose " + facet_name(recording) + " " + std::to_string(best->face) + " (vertices" + vertices + "), the nearest, at " + short_number(best->distance) + ", and ask along " + short_vector(best->normal) + ".";
  }

  template <class Other>
  std::string operator()(const Other&) const {
    return {};
  }
};

}  // namespace

std::string right_step(const Recording& recording, const Frame& frame) {
  if (recording.generator == generator_name()) return {};
  return std::visit(RightStep{recording, frame}, recording.events[frame.step]);
}

}  // namespace gjkdbg
