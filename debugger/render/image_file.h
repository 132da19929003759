// Pictures and animations as files' bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gjkdbg {

/// PNG. `rgb`: rows from the top, three bytes a pixel.
std::string png_bytes(int width, int height, const std::vector<std::uint8_t>& rgb);

/// An animated GIF that loops: every frame `hundredths` of a second, the last one three seconds. All frames of one size.
std::string gif_bytes(int width, int height, const std::vector<std::vector<std::uint8_t>>& frames, int hundredths);

}  // namespace gjkdbg
