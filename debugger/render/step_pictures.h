// The two linked views of one step: the world, and the Minkowski difference. Pure functions of the recording's frame.
#pragma once

#include <cstddef>
#include <optional>

#include "debugger/render/picture.h"
#include "recordings/replay.h"

namespace gjkdbg {

/// So many of an answer's contact points have a number in the picture, and a row in the panel.
constexpr std::size_t numbered_contacts = 8;

/// What is shown besides the algorithm's state.
struct ViewSettings {
  bool difference = true;     ///< the hull of A - B, ghosted
  bool support_plane = true;
  bool dropped = true;        ///< dropped vertices and removed faces
  bool labels = true;
  bool grid = true;
  bool regions = true;        ///< the Voronoi region of the part that is kept
  bool bounds = true;         ///< rings about the origin, as far out as the bounds
  bool newest_first = true;   ///< A is the newest vertex of the simplex; else the oldest
  double scale = 1;           ///< of marks and letters, in pixels
  bool body_letters = false;  ///< drawn in the world; the window has handles with them instead
  std::optional<int> selected;  ///< a vertex, marked in both views
  std::optional<int> pointed;   ///< a vertex under the pointer, lit in both views
};

/// Display hulls of a scene: made once, drawn at every step.
struct SceneMeshes {
  std::vector<DisplayMesh> bodies;
  DisplayMesh difference;  ///< of the first two's cores, or whatever the method works on
  bool whole = false;      ///< the method knows no cores
  double radius = 0;       ///< the sum of the cores' radii; of whole bodies 0
  int dimension = 3;
};
SceneMeshes scene_meshes(const Scene& scene, const Settings& settings);

/// What a body goes by where there is no room for its name: A, B, …, Z, then its number.
std::string body_letter(int body);
/// The middle of what is seen of a body: its pose's position may lie far from it.
ViewPoint middle(const DisplayMesh& mesh);
/// A body's mesh where the frame has it, of those that move.
DisplayMesh placed_mesh(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, int body);
/// Where the letters of moving bodies stand: at their places; of a floor that something smaller hides there, on a part of it that is seen.
std::vector<ViewPoint> letter_places(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const Projection& projection);
/// A ring by which a body is moved and the small disc that turns it.
struct BodyHandle {
  ViewPoint ring, disc;
};
inline constexpr double handle_radius = 9;  ///< pixels, before they are scaled
/// One a body, by their middles: off one another where those lie together in the picture, the discs off the rings.
std::vector<BodyHandle> place_handles(const std::vector<ViewPoint>& middles, const Projection& projection, double scale);
/// The arrow of a direction in the difference, and of one at a body, as shares of half the view's shorter side.
inline constexpr double direction_arrow = 0.42, support_arrow = 0.3, normal_arrow = 0.4, velocity_arrow = 0.35;
/// Half of the view's shorter side, in lengths of the scene.
double half_view(const Projection& projection);
/// Intervals lie over one another: in 1D each is drawn a little off the line.
ViewPoint row_offset(int body, int dimension, const Projection& projection);

Picture world_picture(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const ViewSettings& settings, const Palette& palette,
                      const Projection& projection);
Picture difference_picture(const SceneMeshes& meshes, const Recording& recording, const Frame& frame, const ViewSettings& settings, const Palette& palette,
                           const Projection& projection);

/// Cameras that show everything of a scene, where its bodies go, and the arrows that will be drawn.
Camera fit_world(const SceneMeshes& meshes, const Recording& recording);
Camera fit_difference(const SceneMeshes& meshes, const Recording& recording);

/// What a polytope's border consists of: faces, in the plane edges, on a line endpoints.
std::string facet_name(int dimension);
/// The letter of the vertex at a place of the simplex: A, B, C, D, as the literature has them. Bodies have their letters on discs, and in sentences are called bodies.
char vertex_letter(std::ptrdiff_t place);
/// The letter a vertex goes by at a step: A for the newest of the simplex (or the oldest), then B, C, D; "" when it is not in it. At the
/// step of a cut the letters are those before it, which the step's sentence uses.
std::string simplex_letter(const Frame& frame, int vertex, bool newest_first = true);

}  // namespace gjkdbg
