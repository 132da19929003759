// Small pictures of the gallery's scenes: made when first seen, one a frame, so that scrolling never waits.
#pragma once

#include <map>
#include <string>

#include "debugger/render/step_pictures.h"
#include "debugger/view/theme.h"
#include "recordings/gallery.h"

namespace gjkdbg {

class Thumbnails {
 public:
  /// The last step of a scene in the world, in a rectangle.
  void draw(const Gallery& gallery, const std::string& scene, const Theme& theme, ImVec2 from, ImVec2 to);
  /// What the scene says of itself. Read when first asked for.
  const std::string& description(const Gallery& gallery, const std::string& scene);
  /// Call once a frame: allows the next one to be made.
  void next_frame() { made_ = false, busy_ = waiting_, waiting_ = false; }
  /// Whether some are still to be made.
  bool busy() const { return busy_; }

 private:
  struct Thumbnail {
    SceneMeshes meshes;
    Recording recording;
    Frame last;
    bool broken = false;
  };
  std::map<std::string, Thumbnail> made_so_far_;
  std::map<std::string, std::string> described_;
  bool made_ = false, waiting_ = false, busy_ = false;
};

}  // namespace gjkdbg
