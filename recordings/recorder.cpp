#include "recordings/recording.h"

namespace gjkdbg {
namespace {

template <class T>
std::vector<T> owned(std::span<const T> list) {
  return {list.begin(), list.end()};
}

std::vector<recorded::Face> owned(std::span<const FaceEvent<AnyVector, Viewed>> faces) {
  std::vector<recorded::Face> out;
  out.reserve(faces.size());
  for (const auto& f : faces) out.push_back({f.face, owned(f.vertices), f.normal, f.distance});
  return out;
}

}  // namespace

void Recorder::operator()(const world::GjkBegan& e) { events_.push_back(recorded::GjkBegan{e.direction}); }
void Recorder::operator()(const world::SupportQueried& e) {
  events_.push_back(recorded::SupportQueried{e.iteration, e.phase, e.direction, e.vertex, e.a, e.b, e.w});
}
void Recorder::operator()(const world::SimplexReduced& e) {
  events_.push_back(recorded::SimplexReduced{e.iteration, owned(e.before), owned(e.region), owned(e.barycentric), e.closest,
                                             e.lower_bound, e.upper_bound});
}
void Recorder::operator()(const world::GjkEnded& e) {
  events_.push_back(recorded::GjkEnded{e.iteration, e.status, e.lower_bound, e.upper_bound});
}
void Recorder::operator()(const world::PolytopeSeeded& e) {
  events_.push_back(recorded::PolytopeSeeded{owned(e.vertices), owned(e.faces)});
}
void Recorder::operator()(const world::FaceChosen& e) {
  events_.push_back(recorded::FaceChosen{e.iteration, e.face, e.normal, e.distance});
}
void Recorder::operator()(const world::PolytopeGrown& e) {
  events_.push_back(recorded::PolytopeGrown{e.iteration, e.vertex, owned(e.removed), owned(e.horizon), owned(e.added),
                                            e.lower_bound, e.upper_bound});
}
void Recorder::operator()(const world::EpaEnded& e) {
  events_.push_back(recorded::EpaEnded{e.iteration, e.status, e.face, e.normal, e.depth});
}
void Recorder::operator()(const world::Warning& e) {
  events_.push_back(recorded::Warning{std::string(e.code), std::string(e.message)});
}

std::string generator_name() { return "gjkdbg " GJKDBG_VERSION; }

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
  recording.events = recorder.take();
  return recording;
}

}  // namespace gjkdbg
