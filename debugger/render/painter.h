// What the two views of a step share: grid, meshes, labels, arrows.
#pragma once

#include <algorithm>

#include "debugger/render/step_pictures.h"

namespace gjkdbg {

class Painter {
 public:
  Painter(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const ViewSettings& settings, const Palette& palette,
          const Projection& projection)
      : meshes_(meshes), recording_(recording), frame_(frame), settings_(settings), palette_(palette), projection_(projection) {}

 protected:
  double unit() const { return half_view(projection_); }
  bool flat() const { return meshes_.dimension < 3; }

  ViewPoint one_d_offset(int body) const { return row_offset(body, meshes_.dimension, projection_); }

  bool moves() const { return frame_.places.size() == meshes_.bodies.size() && !frame_.places.empty(); }

  /// The pair that is looked at in the two colours, all others in grey.
  Colour body_colour(int i) const {
    const std::array<int, 2> pair = moves() ? frame_.pair : std::array<int, 2>{0, 1};
    return i == pair[0] ? palette_.body_a : i == pair[1] ? palette_.body_b : palette_.dropped;
  }

  std::string letter_of(int number) const { return simplex_letter(frame_, number, settings_.newest_first); }
  /// Nothing for a vertex the frame does not know.
  const FrameVertex* vertex(int number) const;
  /// A share of the view along a direction, or nothing for a direction that is none.
  ViewPoint arrow_along(const AnyVector& direction, double share = 0.3) const;

  /// The tip of an arrow whose length means nothing: nearer, down to a fifth, where it would touch the view's border.
  ViewPoint tip_in_view(const ViewPoint& from, const ViewPoint& along) const;

  /// For the caption; once.
  void shows(const char* what) {
    if (std::find(picture_.shown.begin(), picture_.shown.end(), what) == picture_.shown.end()) picture_.shown.emplace_back(what);
  }

  double round_step(double pixels) const;
  void grid();
  void mesh(const DisplayMesh& m, Colour colour, double opacity, const ViewPoint& offset);
  void label(const ViewPoint& at, const std::string& text, Colour colour, double dx = 9, double dy = -9);
  /// Of what lies at the point: a face, an arrow.
  void area_label(const ViewPoint& at, const std::string& text, Colour colour, double dx = 9, double dy = -9);
  /// Where there is a free place.
  void spare_label(const ViewPoint& at, const std::string& text, Colour colour, double dx, double dy);
  void small_label(const ViewPoint& at, const std::string& text, Colour colour, bool spare = false);
  /// Of a scale whose numbers are `step` apart.
  void mark_number(const ViewPoint& at, double value, double step, double dx, double dy);
  void mark_selected(const ViewPoint& at) { picture_.points.push_back({at, palette_.text, 10, Mark::ring, -1}); }

  const SceneMeshes& meshes_;
  const Recording& recording_;
  const Frame& frame_;
  const ViewSettings& settings_;
  const Palette& palette_;
  const Projection& projection_;
  Picture picture_;
};

}  // namespace gjkdbg
