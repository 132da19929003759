#include "debugger/view/thumbnails.h"

#include "debugger/view/draw_items.h"
#include "recordings/replay.h"

namespace gjkdbg {

void Thumbnails::draw(const Gallery& gallery, const std::string& scene, const Theme& theme, ImVec2 from, ImVec2 to) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(from, to, packed(theme.palette.view), theme.px(4));
  auto found = made_so_far_.find(scene);
  if (found == made_so_far_.end()) {
    if (made_) {
      waiting_ = true;
      return;
    }
    made_ = true;
    Thumbnail made;
    try {
      made.recording = record(read_scene(gallery.file(scene)));
      made.meshes = scene_meshes(made.recording.scene.scene, made.recording.settings);
      made.last = frame_at(made.recording, made.recording.events.size() - 1);
    } catch (const Error&) {
      made.broken = true;  // opening it will say why
    }
    found = made_so_far_.emplace(scene, std::move(made)).first;
  }
  const Thumbnail& t = found->second;
  if (t.broken) return;
  const ViewRectangle rectangle{from.x, from.y, to.x - from.x, to.y - from.y};
  Camera camera = fit_world(t.meshes, t.recording);
  const Projection projection(camera, rectangle);
  ViewSettings settings;
  settings.grid = settings.labels = false;
  draw->PushClipRect(from, to, true);
  draw_items(draw, flatten(world_picture(t.meshes, t.recording, t.last, settings, theme.palette, projection), projection), theme, true);
  draw->PopClipRect();
}

const std::string& Thumbnails::description(const Gallery& gallery, const std::string& scene) {
  const auto [found, is_new] = described_.try_emplace(scene);
  if (is_new) {
    try {
      found->second = read_scene(gallery.file(scene)).scene.description;
    } catch (const Error&) {  // opening it will say why
    }
  }
  return found->second;
}

}  // namespace gjkdbg
