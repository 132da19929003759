// Ten steps, drawn and held against kept pictures. Drivers and fonts differ a little from one machine to the next, so a few pixels may.
//
// GJKDBG_KEEP_PICTURES=1 writes the pictures anew: look at each before it is committed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "debugger/render/image_file.h"
#include "debugger/render/picture.h"
#include "debugger/render/step_pictures.h"
#include "debugger/view/hosts.h"

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_FAILURE_STRINGS
#include <stb_image.h>

namespace gjkdbg {
namespace {

struct Kept {
  const char* name;
  const char* scene;
  int step;  ///< negative: from the end
  int width, height;
  float scale;
  bool light, window;
};

constexpr Kept kept_pictures[] = {
    {"1d", "1d-overlap", 3, 640, 360, 1, false, false},
    {"2d-region", "2d-deep", 4, 640, 360, 1, false, false},
    {"2d-answer", "2d-corner-to-corner", -1, 640, 360, 1, false, false},
    {"3d-simplex", "box-box-apart", 6, 640, 360, 1, false, false},
    {"epa-grown", "box-box-deep", 13, 640, 360, 1, false, false},
    {"epa-end-light", "box-box-deep", -1, 640, 360, 1, true, false},
    {"mpr-portal", "mpr-box-box", 4, 640, 360, 1, false, false},
    {"window", "box-box-deep", 14, 1280, 800, 1, false, true},
    {"window-small-light", "2d-deep", 4, 800, 520, 1, true, true},
    {"window-scale-2", "pair-capsule-capsule", 2, 1600, 1000, 2, false, true},
};

class KeptPicture : public testing::TestWithParam<Kept> {};

/// The share of pixels that differ by more than a shade, after a blur of two pixels that swallows where a line falls between two.
double different_share(const Image& image, const std::uint8_t* kept) {
  const auto mean = [&](const std::uint8_t* rgb, int x, int y, int c) {
    int sum = 0;
    for (int dy = 0; dy < 2; ++dy)
      for (int dx = 0; dx < 2; ++dx) sum += rgb[((y + dy) * image.width + x + dx) * 3 + c];
    return sum / 4;
  };
  int different = 0, all = 0;
  for (int y = 0; y + 1 < image.height; y += 2)
    for (int x = 0; x + 1 < image.width; x += 2) {
      int most = 0;
      for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(mean(image.rgb.data(), x, y, c) - mean(kept, x, y, c)));
      different += most > 40, ++all;
    }
  return static_cast<double>(different) / all;
}

TEST_P(KeptPicture, LooksAsKept) {
  const Kept& k = GetParam();
  Headless host(k.width, k.height, k.scale, read_gallery(GJKDBG_GALLERY));
  App& app = host.app();
  app.preferences.dark = !k.light;
  apply_colours(app.theme, !k.light);
  app.open_gallery(k.scene);
  ASSERT_TRUE(app.message.empty()) << app.message;
  app.left_tab = App::LeftTab::scene;
  const int count = static_cast<int>(app.session.count());
  app.session.go_to(static_cast<std::size_t>(k.step < 0 ? count + k.step : k.step));
  host.frame(!k.window), host.frame(!k.window);
  const Image image = host.image();
  const std::string file = std::string(GJKDBG_PICTURES) + "/" + k.name + ".png";
  if (std::getenv("GJKDBG_KEEP_PICTURES")) std::ofstream(file, std::ios::binary) << png_bytes(image.width, image.height, image.rgb);
  int width = 0, height = 0, channels = 0;
  std::uint8_t* kept = stbi_load(file.c_str(), &width, &height, &channels, 3);
  ASSERT_TRUE(kept) << file;
  ASSERT_EQ(width, image.width);
  ASSERT_EQ(height, image.height);
  const double share = different_share(image, kept);
  stbi_image_free(kept);
  EXPECT_LT(share, 0.004) << file;
}

INSTANTIATE_TEST_SUITE_P(Pictures, KeptPicture, testing::ValuesIn(kept_pictures), [](const auto& p) {
  std::string name = p.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// The measure itself: another step of the same scene is told apart.
TEST(KeptPictures, AnotherStepIsNoticed) {
  Headless host(640, 360, 1, read_gallery(GJKDBG_GALLERY));
  host.app().open_gallery("2d-deep");
  host.app().session.go_to(4);
  host.frame(true), host.frame(true);
  const Image image = host.image();
  host.app().session.go_to(6);
  host.frame(true), host.frame(true);
  EXPECT_GT(different_share(image, host.image().rgb.data()), 0.004);
}

TEST(Labels, KeepOffWhatATitleCovers) {
  Camera camera;
  camera.flat = true;
  for (const double covered : {0.0, 40.0}) {
    Picture picture;
    picture.labels.push_back({ViewPoint(0, 0.88, 0), "d", {}});  // 18 pixels below the border
    picture.covered = covered;
    const auto items = flatten(picture, Projection(camera, {0, 0, 300, 300}));
    ASSERT_EQ(items.size(), 1u);
    EXPECT_GE(items.back().points[0].y, covered);
    EXPECT_LT(items.back().points[0].y, covered + 40);
  }
}

/// The witness points lie near each other: the line that leads to the one must not run through the other's name.
TEST(Labels, AreNotStruckOutByOthersLines) {
  Headless host(1280, 800, 1, read_gallery(GJKDBG_GALLERY));
  App& app = host.app();
  for (const char* name : {"jolt-671", "pair-sphere-sphere", "box-box-deep", "pair-box-box", "jolt-unit-spheres", "coal-307"}) {
    app.open_gallery(name);
    app.session.go_to(app.session.count() - 1);
    for (const auto& [width, scale] : {std::pair(330.0, 1.0), {490.0, 1.0}, {608.0, 2.0}, {800.0, 2.0}, {945.0, 2.8}, {1100.0, 2.8}}) {
      app.settings.scale = scale;
      const Projection projection(fit_world(app.session.meshes(), app.session.recording()), {0, 0, width, 588});
      const auto items = flatten(world_picture(app.session.meshes(), app.session.recording(), app.session.frame(), app.settings, app.theme.palette, projection), projection, scale);
      for (const FlatItem& line : items) {
        const auto leads_to = [&](const std::optional<AnyVector>& witness) {
          const Projected at = projection(to_view(*witness));
          return line.kind == FlatItem::Kind::line && line.width == 1 && line.points[1].x == at.x && line.points[1].y == at.y;
        };
        const bool a = leads_to(app.session.recording().result.witness_a), b = leads_to(app.session.recording().result.witness_b);
        if (!a && !b) continue;
        for (const FlatItem& label : items) {
          if (label.kind != FlatItem::Kind::label || label.text != (a ? "witness b" : "witness a")) continue;
          const double x = label.points[0].x, y = label.points[0].y;
          for (double t = 0; t <= 1; t += 0.02) {
            const double px = line.points[0].x + t * (line.points[1].x - line.points[0].x), py = line.points[0].y + t * (line.points[1].y - line.points[0].y);
            EXPECT_FALSE(px > x && px < x + 60 * scale && py > y && py < y + 17 * scale) << name << " at " << width << ": " << label.text;
          }
        }
      }
    }
  }
}

/// The ring on which the only vertex lies is as wide as the view: it was without a name.
TEST(Labels, NameRingsThatLeaveTheViewToTheRight) {
  Headless host(1280, 800, 1, read_gallery(GJKDBG_GALLERY));
  App& app = host.app();
  app.open_gallery("pair-sphere-sphere");
  app.session.go_to(2);
  const Projection projection(fit_difference(app.session.meshes(), app.session.recording()), {0, 0, 325, 475});
  bool named = false;
  for (const PictureLabel& label : difference_picture(app.session.meshes(), app.session.recording(), app.session.frame(), app.settings, app.theme.palette, projection).labels) named |= label.text == "at most";
  EXPECT_TRUE(named);
}

}  // namespace
}  // namespace gjkdbg
