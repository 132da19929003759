#include "debugger/render/image_file.h"

#include <gif_lib.h>
#include <stb_image_write.h>


#include "shapes/error.h"

namespace gjkdbg {

std::string png_bytes(int width, int height, const std::vector<std::uint8_t>& rgb) {
  std::string out;
  const auto append = [](void* to, void* data, int size) { static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size)); };
  if (stbi_write_png_to_func(append, &out, width, height, 3, rgb.data(), width * 3) == 0) throw Error("cannot-write", "no PNG could be made");
  return out;
}

namespace {

/// 6 levels of red and blue, 7 of green: 252 colours, enough for flat drawings, the same for every frame.
struct Colours {
  ColorMapObject* map = GifMakeMapObject(256, nullptr);
  Colours() {
    for (int i = 0; i < 256; ++i) {
      const int k = i < 252 ? i : 251;
      map->Colors[i] = {static_cast<GifByteType>(k / 42 * 51), static_cast<GifByteType>(k / 6 % 7 * 255 / 6), static_cast<GifByteType>(k % 6 * 51)};
    }
  }
  ~Colours() { GifFreeMapObject(map); }
};

/// Ordered dithering hides the steps between the levels.
GifByteType nearest(const std::uint8_t* p, int x, int y) {
  static constexpr int bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  const int t = bayer[y & 3][x & 3] * 2 - 15;  // -15 .. 15
  const auto level = [t](int c, int steps) {
    const int dithered = c + t * 255 / steps / 32;
    const int l = (dithered * steps + 127) / 255;
    return l < 0 ? 0 : l > steps ? steps : l;
  };
  return static_cast<GifByteType>(level(p[0], 5) * 42 + level(p[1], 6) * 6 + level(p[2], 5));
}

int append(GifFileType* gif, const GifByteType* data, int size) {
  static_cast<std::string*>(gif->UserData)->append(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
  return size;
}

void check(int status) {
  if (status == GIF_ERROR) throw Error("cannot-write", "no GIF could be made");
}

void write_frame(GifFileType* gif, int width, int height, const std::vector<std::uint8_t>& rgb, int hundredths) {
  GifByteType control[4] = {1 << 2, static_cast<GifByteType>(hundredths & 0xff), static_cast<GifByteType>(hundredths >> 8), 0};
  check(EGifPutExtension(gif, GRAPHICS_EXT_FUNC_CODE, 4, control));
  check(EGifPutImageDesc(gif, 0, 0, width, height, false, nullptr));
  std::vector<GifByteType> line(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) line[static_cast<std::size_t>(x)] = nearest(&rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3], x, y);
    check(EGifPutLine(gif, line.data(), width));
  }
}

}  // namespace

std::string gif_bytes(int width, int height, const std::vector<std::vector<std::uint8_t>>& frames, int hundredths) {
  std::string out;
  int error = 0;
  GifFileType* gif = EGifOpen(&out, append, &error);
  if (!gif) throw Error("cannot-write", "no GIF could be made");
  const Colours colours;
  EGifSetGifVersion(gif, true);
  check(EGifPutScreenDesc(gif, width, height, 8, 0, colours.map));
  GifByteType forever[3] = {1, 0, 0};
  check(EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE));
  check(EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0"));
  check(EGifPutExtensionBlock(gif, 3, forever));
  check(EGifPutExtensionTrailer(gif));
  for (std::size_t i = 0; i < frames.size(); ++i) write_frame(gif, width, height, frames[i], i + 1 == frames.size() ? 300 : hundredths);
  EGifCloseFile(gif, &error);
  return out;
}

}  // namespace gjkdbg
