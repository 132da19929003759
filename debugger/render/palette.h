// Colours: one meaning, one colour, everywhere. Safe for colour-blind eyes (Okabe and Ito, "Color Universal Design", 2008).
#pragma once

#include <cstdint>

namespace gjkdbg {

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  constexpr Colour with_alpha(double alpha) const { return {r, g, b, static_cast<std::uint8_t>(alpha * 255 + 0.5)}; }
  /// Towards white (t > 0) or black (t < 0).
  constexpr Colour shaded(double t) const {
    const auto mix = [t](std::uint8_t c) { return static_cast<std::uint8_t>(t >= 0 ? c + (255 - c) * t : c * (1 + t)); };
    return {mix(r), mix(g), mix(b), a};
  }
  /// Halfway to another.
  constexpr Colour mixed(Colour o) const {
    const auto half = [](int x, int y) { return static_cast<std::uint8_t>((x + y) / 2); };
    return {half(r, o.r), half(g, o.g), half(b, o.b), a};
  }
  bool operator==(const Colour&) const = default;
};

constexpr Colour rgb(std::uint32_t hex) {
  return {static_cast<std::uint8_t>(hex >> 16), static_cast<std::uint8_t>(hex >> 8), static_cast<std::uint8_t>(hex), 255};
}

struct Palette {
  Colour background, panel, view, field, hover, text, text_soft, text_faint, grid, origin;
  Colour accent;
  Colour body_a, body_b;   ///< A, B
  Colour simplex;          ///< simplex and search direction
  Colour support;          ///< support points
  Colour newest;           ///< newest vertex, findings
  Colour chosen;           ///< chosen face
  Colour frontier;         ///< support plane, horizon, new faces
  Colour dropped;          ///< dropped vertices, removed faces
};

inline constexpr Palette dark_palette{
    rgb(0x14171d), rgb(0x191d24), rgb(0x0f1217), rgb(0x242a35), rgb(0x2f3745), rgb(0xe6ecf4), rgb(0xc8d0dc), rgb(0x8f9aaa), rgb(0x262d38), rgb(0xffffff),
    rgb(0x3d8bdd), rgb(0x4c9be8), rgb(0xe8a33d), rgb(0x56b4e9), rgb(0x2fbf8f), rgb(0xe0603a), rgb(0xcc79a7), rgb(0xf0e442), rgb(0x6b7686)};

inline constexpr Palette light_palette{
    rgb(0xe9ecf1), rgb(0xf6f7f9), rgb(0xffffff), rgb(0xe1e6ed), rgb(0xd0d8e3), rgb(0x14181f), rgb(0x303946), rgb(0x5a6675), rgb(0xe4e8ee), rgb(0x000000),
    rgb(0x1f6fc4), rgb(0x1f6fc4), rgb(0xb36b00), rgb(0x0f7fb8), rgb(0x00785a), rgb(0xc0431e), rgb(0xa34f80), rgb(0x8a7d00), rgb(0x7d8794)};

}  // namespace gjkdbg
