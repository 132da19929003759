// What the window remembers from one start to the next.
#pragma once

#include <string>
#include <string_view>

namespace gjkdbg {

enum class Layout { both, stacked, world, difference };

struct Preferences {
  bool dark = true;
  Layout layout = Layout::both;
  bool linked_cameras = false;
  bool newest_first = true;
  float left = 270, right = 330, bottom = 260;  ///< logical pixels, of the panels
  float split = 0.5f;                           ///< the first view's share
  bool difference = true, support_plane = true, dropped = true, labels = true, grid = true, regions = true, bounds = true;
  double speed = 1;
  int width = 1440, height = 900;               ///< of the window
};

std::string preferences_to_text(const Preferences& preferences);
/// What is missing, unknown or out of range keeps its default: an old or broken file never stands in the way.
Preferences preferences_from_text(std::string_view text);

}  // namespace gjkdbg
