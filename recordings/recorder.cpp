#include "recordings/recording.h"

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
