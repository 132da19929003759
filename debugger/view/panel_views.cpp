// The two linked views: draws their pictures, orbits, pans, zooms, selects, moves bodies.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "debugger/view/app.h"
#include "debugger/view/draw_items.h"
#include "debugger/view/explain.h"

namespace gjkdbg {
namespace {

/// A mouse that orbits, pans and zooms. True when it did something.
void steer(Camera& camera, const Projection& projection) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActive()) {
    const bool left = ImGui::IsMouseDragging(ImGuiMouseButton_Left, 2);
    const bool pan = ImGui::IsMouseDragging(ImGuiMouseButton_Right, 0) || ImGui::IsMouseDragging(ImGuiMouseButton_Middle, 0) || (left && camera.flat);
    if (pan) {
      camera.target -= projection.move(io.MouseDelta.x, io.MouseDelta.y);
    } else if (left) {
      camera.yaw -= io.MouseDelta.x * 0.008;
      camera.pitch = std::clamp(camera.pitch + io.MouseDelta.y * 0.008, -1.55, 1.55);
    }
  }
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
    // What lies under the pointer stays there.
    const double factor = std::pow(0.88, io.MouseWheel);
    const ViewRectangle& r = projection.rectangle();
    camera.target += projection.move(io.MousePos.x - (r.x + r.width / 2), io.MousePos.y - (r.y + r.height / 2)) * (1 - factor);
    camera.radius *= factor;
  }
}

/// The selectable vertex under the pointer, if any.
std::optional<int> vertex_under(const std::vector<FlatItem>& items, ImVec2 mouse, float reach) {
  std::optional<int> best;
  double least = reach;
  for (const FlatItem& item : items) {
    if (item.kind != FlatItem::Kind::point || item.vertex < 0) continue;
    const double d = std::hypot(item.points[0].x - mouse.x, item.points[0].y - mouse.y);
    if (d < least) least = d, best = item.vertex;
  }
  return best;
}

/// The text of the label under the pointer; empty where there is none.
std::string label_under(const std::vector<FlatItem>& items, ImVec2 mouse, const Theme& theme) {
  for (const FlatItem& item : items) {
    if (item.kind != FlatItem::Kind::label) continue;
    const ImVec2 from = at(item.points[0]), size = label_size(item, theme), margin{theme.px(3), theme.px(1)};
    if (std::abs(mouse.x - from.x - size.x / 2) <= size.x / 2 + margin.x && std::abs(mouse.y - from.y - size.y / 2) <= size.y / 2 + margin.y) return item.text;
  }
  return "";
}

/// What the mouse holds in the world view.
struct Held {
  int body = -1;
  bool turning = false;
  AnyVector pivot;  ///< of a turn: the body's middle, in its own frame
  enum class Now { nothing, pressed, released } now = Now::nothing;  ///< in this frame
  bool seen_whole[2] = {};  ///< the difference, the world: when it was pressed
};
Held& hand() {
  static Held held;
  return held;
}

/// Where the pose's position is the middle, it is that to the last bit: a turn then leaves it as it is.
AnyVector pivot_of(const DisplayMesh& mesh, const Pose& pose) {
  const ViewPoint m = middle(mesh);
  const AnyVector away = m.head(pose.position.size()) - pose.position;
  if (away.norm() <= 1e-6 * (mesh.points[0] - m).norm()) return AnyVector::Zero(away.size());
  return pose.matrix.transpose() * away;
}

std::vector<BodyHandle> handles_of(const App& app, const Projection& projection) {
  const SceneMeshes& meshes = app.session.meshes();
  std::vector<ViewPoint> middles;
  for (std::size_t i = 0; i < meshes.bodies.size(); ++i) middles.push_back(middle(meshes.bodies[i]) + row_offset(static_cast<int>(i), meshes.dimension, projection));
  return place_handles(middles, projection, app.settings.scale);
}

void draw_letter(const App& app, ImVec2 middle, const std::string& letter, Colour colour) {
  const float size = app.theme.small->FontSize * app.theme.marks;
  const ImVec2 half = app.theme.small->CalcTextSizeA(size, 1e6f, 0, letter.c_str());
  ImGui::GetWindowDrawList()->AddText(app.theme.small, size, {middle.x - half.x / 2, middle.y - half.y / 2}, packed(colour), letter.c_str());
}

float distance(ImVec2 p, ImVec2 q) { return std::hypot(p.x - q.x, p.y - q.y); }

AnyVector place_of(const AnyVector& pivot, const Pose& pose) { return pose.position + pose.matrix * pivot; }

/// Turns a body about the view's direction, by the angle that the pointer has gone round the pivot, which stays where it is.
void turn(Body& body, const AnyVector& pivot, const ViewPoint& axis, double angle, int dimension) {
  const AnyVector stays = place_of(pivot, body.pose);
  if (dimension == 2) {
    body.pose.rotation = PlaneAngle{to_plane_angle(body.pose.matrix).angle + angle};
  } else {
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix() * Eigen::Matrix3d(body.pose.matrix);
    body.pose.rotation = to_quaternion(turned);
  }
  body.pose.matrix = resolve(body.pose.rotation, dimension).matrix;
  body.pose.position = stays - body.pose.matrix * pivot;
}

/// The ring of a body with its letter, and the disc beside it. Pressed, it begins an edit.
void body_handle(App& app, int i, const BodyHandle& handle, const Projection& projection, Held& held) {
  const ImVec2 mouse = ImGui::GetIO().MousePos, ring = at(projection(handle.ring)), disc = at(projection(handle.disc));
  const int dimension = app.session.scene().scene.dimension;
  const float radius = static_cast<float>(handle_radius * app.settings.scale);
  const Colour colour = letter_colour(app, i);
  const std::string letter = body_letter(i);
  const bool near = ImGui::IsItemHovered() && distance(mouse, ring) < radius + app.theme.px(3);
  const bool near_disc = ImGui::IsItemHovered() && dimension > 1 && !near && distance(mouse, disc) < app.theme.px(7);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddCircleFilled(ring, radius, packed(app.theme.palette.view.with_alpha(dimension == 1 ? 1 : 0.75)), 24);  // the letter lies on a body of its own colour
  draw->AddCircle(ring, radius, packed(colour.with_alpha(near || (held.body == i && !held.turning) ? 1 : 0.7)), 24, app.theme.px(2));
  if (dimension > 1) draw->AddCircleFilled(disc, app.theme.px(3.5f), packed(colour.with_alpha(near_disc || (held.body == i && held.turning) ? 1 : 0.6)), 16);
  draw_letter(app, ring, letter, colour);
  if (near && held.body < 0) ImGui::SetTooltip("drag: move %s", letter.c_str());
  if (near_disc && held.body < 0) ImGui::SetTooltip("drag: turn %s", letter.c_str());
  if (!(near || near_disc) || !ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
  const auto k = static_cast<std::size_t>(i);
  held = {i, near_disc, pivot_of(app.session.meshes().bodies[k], app.session.scene().scene.bodies[k].pose), Held::Now::pressed, {}};
  app.session.begin_edit();
}

/// The body that is held follows the mouse until it is let go.
void drag_held(App& app, const Projection& projection, Held& held) {
  const ImVec2 mouse = ImGui::GetIO().MousePos, delta = ImGui::GetIO().MouseDelta;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    held.body = -1, held.now = Held::Now::released;
    app.session.end_edit();
    return;
  }
  if (delta.x == 0 && delta.y == 0) return;
  SceneFile next = app.session.scene();
  next.expect.reset();
  Body& body = next.scene.bodies[static_cast<std::size_t>(held.body)];
  const int dimension = next.scene.dimension;
  if (held.turning) {
    const ImVec2 c = at(projection(to_view(place_of(held.pivot, body.pose))));
    const double from = std::atan2(c.y - (mouse.y - delta.y), (mouse.x - delta.x) - c.x), to = std::atan2(c.y - mouse.y, mouse.x - c.x);
    turn(body, held.pivot, projection.towards(), std::remainder(to - from, 2 * M_PI), dimension);
  } else {
    body.pose.position += projection.move(delta.x, delta.y).head(dimension);
  }
  app.edit(next);
}

/// A ring in each body's middle, or beside another's that is there: dragging it moves the body in the picture's plane; the disc beside it turns it.
void body_handles(App& app, const Projection& projection, Held& held) {
  const std::vector<BodyHandle> handles = handles_of(app, projection);
  for (std::size_t i = 0; i < handles.size(); ++i) body_handle(app, static_cast<int>(i), handles[i], projection, held);
  if (held.body >= 0) drag_held(app, projection, held);
}

/// Bodies that have moved on cannot be dragged, and keep their letters.
void body_letters(App& app, const Projection& projection) {
  const int dimension = app.session.meshes().dimension;
  const std::vector<ViewPoint> places = letter_places(app.session.meshes(), app.session.recording(), app.session.frame(), projection);
  const std::vector<BodyHandle> handles = place_handles(places, projection, app.settings.scale);
  for (int i = 0; i < static_cast<int>(places.size()); ++i) {
    const ImVec2 c = at(projection(handles[static_cast<std::size_t>(i)].ring));
    // On a body, which has the letter's colour.
    ImGui::GetWindowDrawList()->AddCircleFilled(c, app.theme.px(dimension == 1 ? 8.f : 7.f) * app.theme.marks, packed(app.theme.palette.view.with_alpha(dimension == 1 ? 1 : 0.75)), 24);
    draw_letter(app, c, body_letter(i), letter_colour(app, i));
  }
}

bool is_seen_whole(const SceneMeshes& meshes, bool world, const Projection& projection) {
  const auto seen = [&](const DisplayMesh& mesh, const ViewPoint& offset) {
    return std::all_of(mesh.points.begin(), mesh.points.end(), [&](const ViewPoint& p) {
      const Projected at = projection(p + offset);
      return projection.rectangle().contains(at.x, at.y);
    });
  };
  if (!world) return seen(meshes.difference, ViewPoint::Zero());
  for (std::size_t i = 0; i < meshes.bodies.size(); ++i)
    if (!seen(meshes.bodies[i], row_offset(static_cast<int>(i), meshes.dimension, projection))) return false;
  return true;
}

/// Which run and which of its pictures a view shows.
struct Shown {
  bool world = true;
  bool other = false;
};

/// In a narrow view fewer of the words, before any of the letters goes.
std::string title_of(App& app, const Shown& shown, float room) {
  const auto& pair = app.session.frame().pair;
  const std::string difference = body_letter(pair[0]) + " \xE2\x88\x92 " + body_letter(pair[1]);
  const std::string run = app.session.comparing() ? ": " + (shown.other ? app.session.other_title() : method_text(app.session.recording())) : "";
  std::string title;
  for (const char* words : {"Minkowski difference ", "Difference ", ""}) {
    title = (shown.world ? "World" : words + difference) + run;
    if (app.theme.text->CalcTextSizeA(app.theme.text->FontSize, 1e6f, 0, title.c_str()).x <= room) break;
  }
  return shortened(app.theme.text, title, room);
}

/// "a, b and c"
std::string in_a_row(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
  return text;
}

/// `drawn`: what the picture shows of the step.
std::string subtitle_of(App& app, const Shown& shown, std::vector<std::string> drawn) {
  if (shown.other && app.session.step() != app.session.other_step()) return (app.session.step() > app.session.other_step() ? "has ended at step " : "ends later, at step ") + std::to_string(app.session.other_step());
  if (shown.world && app.session.meshes().bodies.size() < 2) return "a body alone";
  if (shown.world && app.session.meshes().bodies.size() > 2) return "the bodies; in colour the two that are looked at" + (drawn.empty() ? "" : "; " + in_a_row(drawn));
  if (shown.world) return drawn.insert(drawn.begin(), "the two bodies"), in_a_row(drawn);
  if (app.session.meshes().radius > 0) return "of the cores; yellow ring: the sum of the radii" + (drawn.empty() ? "" : "; " + in_a_row(drawn));
  if (drawn.empty()) return "the bodies overlap if O lies in it";
  const Frame& frame = app.session.frame();
  if (!shown.other && (frame.gjk_status || frame.epa_status || frame.stage == Frame::Stage::gjk)) return in_a_row(drawn);  // where another method handed over
  switch (shown.other ? app.session.other().settings.name : app.session.recording().settings.name) {
    case MethodName::sat: return "every axis that could separate it from O";
    case MethodName::mpr: return "from a point inside, through O, out to the portal";
    case MethodName::closed_form: return "of two segments, a parallelogram";
    case MethodName::projections: return "v, the difference of the two points";
    default: return in_a_row(drawn);
  }
}

void link_cameras(App& app, bool from_world) {
  if (!app.preferences.linked_cameras) return;
  const Camera& from = from_world ? app.world_camera : app.difference_camera;
  Camera& to = from_world ? app.difference_camera : app.world_camera;
  to.yaw = from.yaw, to.pitch = from.pitch;
}

/// Mouse on a view: handles, orbit, the vertex under the pointer.
void interact(App& app, const Area& area, const Shown& shown, Camera& camera, const Projection& projection, const std::vector<FlatItem>& items,
              std::optional<int>& pointed) {
  Held& held = hand();
  const Theme& theme = app.theme;
  ImGui::SetCursorScreenPos({area.x, area.y});
  ImGui::InvisibleButton("canvas", {area.width, area.height}, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  const bool movable = shown.world && !shown.other && (app.session.frame().places.empty() || app.session.step() == 0);
  if (movable) body_handles(app, projection, held);
  else if (shown.world && !shown.other) body_letters(app, projection);
  if (!(movable && held.body >= 0)) steer(camera, projection), link_cameras(app, shown.world);
  if (!ImGui::IsItemHovered()) return;
  const auto under = vertex_under(items, ImGui::GetIO().MousePos, theme.px(11));
  pointed = under;
  const Frame& frame = shown.other ? app.session.other_frame() : app.session.frame();
  const auto& vertices = frame.vertices;
  if (const auto found = under ? vertices.find(*under) : vertices.end(); found != vertices.end()) {
    const FrameVertex& v = found->second;
    ImGui::SetTooltip("vertex #%d\nw = %s\na = %s\nb = %s\nclick to select", *under, short_vector(v.w).c_str(), short_vector(v.a, digits_that_tell(v.a, v.b)).c_str(), short_vector(v.b, digits_that_tell(v.a, v.b)).c_str());
  } else if (const std::string label = label_under(items, ImGui::GetIO().MousePos, theme); !label.empty()) {
    if (const std::string meaning = meaning_of(label, shown.world, frame, shown.other ? app.session.other() : app.session.recording()); !meaning.empty()) tooltip(theme, meaning);
  }
  const ImVec2 drag = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0);
  if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && std::hypot(drag.x, drag.y) < 3) app.settings.selected = under;
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) app.fit_views();
}

/// What was seen as a whole before a body was dragged is so when it is let go. Whoever has gone near to look at a part stays there.
void follow_the_hand(App& app, const Shown& shown, const Projection& projection) {
  Held& held = hand();
  if (held.now == Held::Now::nothing) return;
  const bool whole = is_seen_whole(app.session.meshes(), shown.world, projection);
  if (held.now == Held::Now::pressed) held.seen_whole[shown.world] = whole;
  else if (held.seen_whole[shown.world] && !whole) app.fit_views();
}

/// What a view's title takes of it, in pixels: the lower the view, the less.
struct TitleSpace {
  bool subtitle;      ///< in a low view the title is alone
  float font;         ///< of the title, times its own size
  ImVec2 corner;      ///< where it begins
  float solid, faded; ///< so far down nothing is drawn below it, and from there on all
  float left_free;    ///< above the picture, whose middle is lower by half of it
  double covered;     ///< of the picture: labels keep off that
};

/// `large`: times the size, in a hall.
TitleSpace title_space(const Theme& theme, float height, float large) {
  if (height < theme.px(105)) return {false, 0.85f, {theme.px(8), theme.px(2)}, 0, 0, 0, theme.px(16)};  // no room at all: it lies on the picture
  const bool low = height < theme.px(140);
  const float solid = theme.px(low ? 22 : 38) * large, faded = theme.px(low ? 34 : 56) * large, left_free = theme.px(low ? 18 : 28.8f) * large;
  return {!low, large, {theme.px(14), theme.px(low ? 4 : 10)}, solid, faded, left_free, (solid + faded) / 2 - left_free};
}

/// The title and what fades out below it.
void draw_title(App& app, const Area& area, const Shown& shown, const TitleSpace& space, const std::vector<std::string>& drawn) {
  const Theme& theme = app.theme;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 cover = packed(theme.palette.view), clear = packed(theme.palette.view.with_alpha(0));
  const float right = area.x + area.width, faint_from = area.y + space.solid;
  draw->AddRectFilled({area.x, area.y}, {right, faint_from}, packed(theme.palette.view.with_alpha(1)));
  draw->AddRectFilledMultiColor({area.x, faint_from}, {right, area.y + space.faded}, cover, cover, clear, clear);
  const ImVec2 title{area.x + space.corner.x, area.y + space.corner.y};
  const float room = (right - theme.px(8) - title.x) / space.font;
  draw->AddText(theme.text, theme.text->FontSize * space.font, title, packed(shown.other ? theme.palette.text_soft : theme.palette.text), title_of(app, shown, room).c_str());
  if (space.subtitle) draw->AddText(theme.small, theme.small->FontSize * space.font, {title.x, title.y + theme.px(20) * space.font}, packed(theme.palette.text_faint), shortened(theme.small, subtitle_of(app, shown, drawn), room).c_str());
}

void one_view(App& app, const Area& area, const Shown& shown, bool interactive, std::optional<int>& pointed) {
  const Theme& theme = app.theme;
  Session& s = app.session;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, vec(theme.palette.view));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  begin_area(shown.other ? "other" : shown.world ? "world" : "difference", area);
  ImGui::PopStyleVar();  // tooltips have their padding
  Camera& camera = shown.world ? app.world_camera : app.difference_camera;
  const TitleSpace space = title_space(theme, area.height, std::max(1.f, theme.marks / 1.4f));  // in a hall, as large as the sentence
  const Projection projection(camera, {area.x, area.y + space.left_free, area.width, area.height - space.left_free});
  app.settings.scale = theme.px(theme.marks);
  const auto make = shown.world ? world_picture : difference_picture;
  const Recording& recording = shown.other ? s.other() : s.recording();
  Picture picture = make(shown.other ? s.other_meshes() : s.meshes(), recording, shown.other ? s.other_frame() : s.frame(), app.settings, theme.palette, projection);
  picture.covered = space.covered;
  const auto items = flatten(picture, projection, theme.px(theme.marks));
  draw_items(ImGui::GetWindowDrawList(), items, theme);
  draw_title(app, area, shown, space, picture.shown);
  if (interactive) interact(app, area, shown, camera, projection, items, pointed);
  if (interactive && !shown.other) follow_the_hand(app, shown, projection);
  ImGui::EndChild();
  ImGui::PopStyleColor();
}

/// The border between two views.
void view_splitter(App& app, const Area& area, bool side_by_side, float whole) {
  ImGui::SetCursorScreenPos({area.x, area.y});
  ImGui::InvisibleButton("##views", {area.width, area.height});
  if (!ImGui::IsItemHovered() && !ImGui::IsItemActive()) return;
  ImGui::SetMouseCursor(side_by_side ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (ImGui::IsItemActive()) app.preferences.split = std::clamp(app.preferences.split + (side_by_side ? moved.x : moved.y) / whole, 0.15f, 0.85f);
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) app.preferences.split = 0.5f;
}

}  // namespace

Colour letter_colour(App& app, int body) {
  const auto& pair = app.session.frame().pair;
  return body == pair[0] ? app.theme.palette.body_a : body == pair[1] ? app.theme.palette.body_b : app.theme.palette.text_soft;
}

void view_panels(App& app, const Area& area, bool interactive) {
  const float gap = app.theme.px(6);
  const Layout layout = app.preferences.layout;
  hand().now = Held::Now::nothing;
  std::optional<int> pointed;
  const bool alone = app.session.meshes().bodies.size() < 2;  // a body that only moves: there is no difference
  const bool worlds = alone || layout == Layout::world, two = app.session.comparing() || (!alone && (layout == Layout::both || layout == Layout::stacked));
  if (!two) {
    one_view(app, area, {worlds, false}, interactive, pointed);
    app.settings.pointed = pointed;
    return;
  }
  // Compared runs are shown by their differences, or by the world where that alone is chosen.
  const Shown first{app.session.comparing() ? worlds : true, false};
  const Shown second{app.session.comparing() && worlds, app.session.comparing()};
  const float share = interactive ? app.preferences.split : 0.5f;
  if (layout != Layout::stacked) {
    const float left = (area.width - gap) * share;
    one_view(app, {area.x, area.y, left, area.height}, first, interactive, pointed);
    one_view(app, {area.x + left + gap, area.y, area.width - gap - left, area.height}, second, interactive, pointed);
    if (interactive) view_splitter(app, {area.x + left, area.y, gap, area.height}, true, area.width);
  } else {
    const float above = (area.height - gap) * share;
    one_view(app, {area.x, area.y, area.width, above}, first, interactive, pointed);
    one_view(app, {area.x, area.y + above + gap, area.width, area.height - gap - above}, second, interactive, pointed);
    if (interactive) view_splitter(app, {area.x, area.y + above, area.width, gap}, false, area.height);
  }
  app.settings.pointed = pointed;
}

}  // namespace gjkdbg
