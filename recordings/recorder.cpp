#include "recordings/recording.h"

#include <cmath>

namespace gjkdbg {
std::string generator_name() { return "gjkdbg " GJKDBG_VERSION; }
bool foreign(const Recording& recording) { return !recording.generator.starts_with("gjkdbg "); }

std::optional<GivenVertex> given_vertex(const Event& event) {
  if (const auto* e = std::get_if<recorded::SupportQueried>(&event)) return GivenVertex{e->vertex, e->a, e->b, e->w};
  if (const auto* e = std::get_if<recorded::VertexKept>(&event)) return GivenVertex{e->vertex, e->a, e->b, e->w};
  return std::nullopt;
}

std::string_view kind_name(const Event& event) {
  return std::visit([](const auto& e) { return e.kind; }, event);
}

bool begins_again(const Recording& recording, std::size_t step) {
  const std::vector<Event>& events = recording.events;
  const auto* began = std::get_if<recorded::GjkBegan>(&events[step]);
  const auto* ended = step > 0 ? std::get_if<recorded::GjkEnded>(&events[step - 1]) : nullptr;
  if (!began || !ended || ended->status != GjkStatus::stalled || ended->lower_bound > 0 || recording.settings.closest_point == ClosestPoint::signed_volumes) return false;
  for (std::size_t i = step - 1; i-- > 0 && !std::holds_alternative<recorded::GjkBegan>(events[i]);) {
    const auto* last = std::get_if<recorded::SimplexReduced>(&events[i]);
    if (!last) continue;
    const AnyVector &v = last->closest, &d = began->direction;
    if (v.size() != d.size() || !v.allFinite() || !d.allFinite() || v.isZero(0) || d.isZero(0)) return false;
    // The direction is in the lengths that GJK works in, a power of two times the world's: the same digits.
    const int by = std::ilogb(d.cwiseAbs().maxCoeff()) - std::ilogb(v.cwiseAbs().maxCoeff());
    return d == v.unaryExpr([&](double x) { return -std::ldexp(x, by); });
  }
  return false;
}

Recording record(const SceneFile& scene) {
  return record(scene, resolve_settings(scene.method, scene.scene));
}

Recording record(const SceneFile& scene, const Settings& settings) {
  Recorder recorder;
  Recording recording{generator_name(), scene, settings, {}, {}};
  recording.result = solve(scene.scene, settings, recorder);
  recording.events = recorder.take_all();
  return recording;
}

}  // namespace gjkdbg
