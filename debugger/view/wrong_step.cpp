#include "debugger/view/wrong_step.h"

#include <Eigen/LU>

#include <algorithm>

#include "debugger/view/app.h"
#include "recordings/comparison.h"
#include "recordings/replay.h"

namespace gjkdbg {
namespace {

/// Whether a point lies in the cone that begins at `apex` and goes through the corners, of which there are as many as dimensions.
bool in_cone(const AnyVector& apex, const std::vector<AnyVector>& corners, const AnyVector& point) {
  const auto n = static_cast<Eigen::Index>(corners.size());
  Eigen::MatrixXd edges(n, n);
  for (Eigen::Index i = 0; i < n; ++i) edges.col(i) = corners[static_cast<std::size_t>(i)] - apex;
  const Eigen::FullPivLU<Eigen::MatrixXd> solved(edges);
  if (!solved.isInvertible()) return true;  // nothing to be told by
  return solved.solve(Eigen::VectorXd(point - apex)).minCoeff() >= -1e-9;
}

/// Where a support lies on MPR's ray itself there is no portal: that support is the way out it believes in.
std::optional<WrongStep> ending_on_the_ray(const Recording& run) {
  if (run.events.size() < 2 || !std::holds_alternative<recorded::MprEnded>(run.events.back())) return std::nullopt;
  const std::size_t last = run.events.size() - 2;
  if (!std::holds_alternative<recorded::SupportQueried>(run.events[last])) return std::nullopt;
  const auto is_portal = [](const Event& e) { return std::holds_alternative<recorded::PortalFound>(e); };
  if (std::any_of(run.events.begin(), run.events.end(), is_portal)) return std::nullopt;
  return WrongStep{last, "here MPR goes wrong: this vertex lies on its ray, so it looks no further; the shortest way out leads elsewhere"};
}

std::optional<WrongStep> leaving_portal(const Recording& run, const Recording& truth) {
  const Scene& scene = run.scene.scene;
  if (!truth.result.normal || !truth.result.signed_distance || !truth.result.intersecting) return std::nullopt;
  const double radii = scene_meshes(scene, run.settings).radius;
  const AnyVector nearest = *truth.result.normal * (-*truth.result.signed_distance - radii);  // of the border to O
  Replay replay(run);
  for (std::size_t i = 0; i < run.events.size(); ++i) {
    const auto* found = std::get_if<recorded::PortalFound>(&run.events[i]);
    if (!found || static_cast<int>(found->vertices.size()) != scene.dimension) continue;
    const Frame& frame = replay.at(i);
    std::vector<AnyVector> corners;
    for (const int v : found->vertices)
      if (const auto at = frame.vertices.find(v); at != frame.vertices.end()) corners.push_back(at->second.w);
    if (!frame.interior || corners.size() != found->vertices.size()) continue;
    if (!in_cone(*frame.interior, corners, nearest)) return WrongStep{i, "from here on MPR goes wrong: the shortest way out does not lead through this portal"};
  }
  return ending_on_the_ray(run);
}

}  // namespace

std::optional<WrongStep> where_it_goes_wrong(const Recording& run) {
  if (foreign(run) || run.scene.scene.motion) return std::nullopt;
  const bool mpr = run.settings.name == MethodName::mpr, gjk = run.settings.name == MethodName::gjk;
  if (!mpr && !gjk) return std::nullopt;
  SceneFile scene = run.scene;
  scene.method = Method{};
  try {
    const Recording truth = record(scene);
    if (answers_agree(run.result, truth.result)) return std::nullopt;
    if (mpr) return leaving_portal(run, truth);
    const std::optional<Difference> other = first_other_way(run, truth);
    if (!other || other->event == 0 || other->event >= run.events.size()) return std::nullopt;
    return WrongStep{other->event, "here it parts from GJK by signed volumes, in double"};
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace gjkdbg
