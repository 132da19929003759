// The recording of a gallery scene by a method.
#pragma once

#include "recordings/gallery.h"
#include "recordings/recording.h"

namespace gjkdbg {

/// A scene in motion by its own method.
inline Recording gallery_run(const char* scene, MethodName method = MethodName::gjk) {
  SceneFile file = read_scene(read_gallery(GJKDBG_GALLERY).file(scene));
  if (!file.scene.motion) change_name(file.method, method);
  return record(file);
}

}  // namespace gjkdbg
