// The two linked views: draws their pictures, orbits, pans, zooms, selects, moves bodies.
#include <algorithm>
#include <cmath>

#include "debugger/view/app.h"

namespace gjkdbg {
namespace {

ImVec2 at(const Projected& p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

void draw_dashes(ImDrawList* draw, ImVec2 p, ImVec2 q, ImU32 colour, float width, float scale) {
  const float length = std::hypot(q.x - p.x, q.y - p.y), dash = 7 * scale, gap = 5 * scale;
  if (length < 1 || length > 20000) return;
  const ImVec2 u{(q.x - p.x) / length, (q.y - p.y) / length};
  for (float t = 0; t < length; t += dash + gap) {
    const float end = std::min(t + dash, length);
    draw->AddLine({p.x + u.x * t, p.y + u.y * t}, {p.x + u.x * end, p.y + u.y * end}, colour, width);
  }
}

void draw_line(ImDrawList* draw, const FlatItem& item, float scale) {
  const ImVec2 p = at(item.points[0]), q = at(item.points[1]);
  const auto width = static_cast<float>(item.width) * scale;
  if (item.stroke == Stroke::dashed) return draw_dashes(draw, p, q, packed(item.colour), width, scale);
  const float length = std::hypot(q.x - p.x, q.y - p.y);
  if (!item.arrow || length < 2) {
    draw->AddLine(p, q, packed(item.colour), width);
    return;
  }
  const float head = std::min((6 + 2 * static_cast<float>(item.width)) * scale, length * 0.6f), wide = head * 0.42f;
  const ImVec2 u{(q.x - p.x) / length, (q.y - p.y) / length}, neck{q.x - u.x * head, q.y - u.y * head};
  draw->AddLine(p, neck, packed(item.colour), width);
  draw->AddTriangleFilled(q, {neck.x - u.y * wide, neck.y + u.x * wide}, {neck.x + u.y * wide, neck.y - u.x * wide}, packed(item.colour));
}

void draw_point(ImDrawList* draw, const FlatItem& item, const Theme& theme) {
  const ImVec2 p = at(item.points[0]);
  const float r = static_cast<float>(item.width) * theme.scale;
  const ImU32 colour = packed(item.colour), rim = packed(theme.palette.view);
  switch (item.mark) {
    case Mark::disc:
      draw->AddCircleFilled(p, r + 1.5f * theme.scale, rim, 24);
      draw->AddCircleFilled(p, r, colour, 24);
      break;
    case Mark::ring: draw->AddCircle(p, r, colour, 24, 2 * theme.scale); break;
    case Mark::square:
      draw->AddRectFilled({p.x - r, p.y - r}, {p.x + r, p.y + r}, rim);
      draw->AddRectFilled({p.x - r * 0.8f, p.y - r * 0.8f}, {p.x + r * 0.8f, p.y + r * 0.8f}, colour);
      break;
    case Mark::cross:
      draw->AddLine({p.x - r, p.y}, {p.x + r, p.y}, colour, 2 * theme.scale);
      draw->AddLine({p.x, p.y - r}, {p.x, p.y + r}, colour, 2 * theme.scale);
      break;
  }
}

void draw_items(ImDrawList* draw, const std::vector<FlatItem>& items, const Theme& theme) {
  std::vector<ImVec2> polygon;
  for (const FlatItem& item : items) {
    switch (item.kind) {
      case FlatItem::Kind::polygon: {
        polygon.clear();
        double area = 0;
        for (std::size_t i = 0; i < item.points.size(); ++i) {
          const Projected &p = item.points[i], &q = item.points[(i + 1) % item.points.size()];
          area += p.x * q.y - q.x * p.y;
          polygon.push_back(at(p));
        }
        if (area < 0) std::reverse(polygon.begin(), polygon.end());  // ImGui's soft rim wants one winding
        const ImDrawListFlags before = draw->Flags;
        draw->Flags &= ~ImDrawListFlags_AntiAliasedFill;  // neighbours share their edges: no soft seams between them
        draw->AddConvexPolyFilled(polygon.data(), static_cast<int>(polygon.size()), packed(item.colour));
        draw->Flags = before;
        break;
      }
      case FlatItem::Kind::line: draw_line(draw, item, theme.scale); break;
      case FlatItem::Kind::point: draw_point(draw, item, theme); break;
      case FlatItem::Kind::label: {
        const ImVec2 p = at(item.points[0]);
        draw->AddText(theme.text, theme.text->FontSize, {p.x + 1, p.y + 1}, packed(theme.palette.view), item.text.c_str());
        draw->AddText(theme.text, theme.text->FontSize, p, packed(item.colour), item.text.c_str());
        break;
      }
    }
  }
}

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

/// The middle of what is seen of a body: its pose's position may lie far from it.
ViewPoint middle(const DisplayMesh& mesh) {
  ViewPoint low = mesh.points[0], high = low;
  for (const ViewPoint& p : mesh.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (low + high) / 2;
}

/// A ring in each body's middle; dragging it moves the body in the picture's plane.
void body_handles(App& app, const Projection& projection, ImDrawList* draw) {
  static int dragged = -1;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  for (int i = 0; i < 2; ++i) {
    const Projected p = projection(middle(i == 0 ? app.session.meshes().a : app.session.meshes().b));
    const Colour colour = i == 0 ? app.theme.palette.body_a : app.theme.palette.body_b;
    const float r = app.theme.px(9);
    const bool near = ImGui::IsItemHovered() && std::hypot(mouse.x - p.x, mouse.y - p.y) < r + app.theme.px(4);
    draw->AddCircle(at(p), r, packed(colour.with_alpha(near || dragged == i ? 1 : 0.55)), 24, app.theme.px(2));
    draw->AddText(app.theme.small, app.theme.small->FontSize, {at(p).x - app.theme.px(4), at(p).y - app.theme.px(7)}, packed(colour), i == 0 ? "A" : "B");
    if (near && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) dragged = i, app.session.begin_edit();
  }
  if (dragged < 0) return;
  const ImVec2 delta = ImGui::GetIO().MouseDelta;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    dragged = -1;
    app.session.end_edit();
  } else if (delta.x != 0 || delta.y != 0) {
    SceneFile next = app.session.scene();
    next.expect.reset();
    next.scene.bodies[static_cast<std::size_t>(dragged)].pose.position += projection.move(delta.x, delta.y).head(next.scene.dimension);
    app.message = app.session.edit(next);
  }
}

void one_view(App& app, const Area& area, bool world, bool interactive) {
  const Theme& theme = app.theme;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, vec(theme.palette.view));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  begin_area(world ? "world" : "difference", area);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  Camera& camera = world ? app.world_camera : app.difference_camera;
  const double header = theme.px(48);
  const ViewRectangle rectangle{area.x, area.y + header * 0.6, area.width, area.height - header * 0.6};
  const Projection projection(camera, rectangle);
  const Frame& frame = app.session.frame();
  const auto make = world ? world_picture : difference_picture;
  const auto items = flatten(make(app.session.meshes(), app.session.recording(), frame, app.settings, theme.palette, projection), projection);
  draw_items(draw, items, theme);
  const ImVec2 title{area.x + theme.px(14), area.y + theme.px(10)};
  draw->AddText(theme.text, theme.text->FontSize, title, packed(theme.palette.text), world ? "World" : "Minkowski difference A \xE2\x88\x92 B");
  draw->AddText(theme.small, theme.small->FontSize, {title.x, title.y + theme.px(20)}, packed(theme.palette.text_faint),
                world ? "the two bodies and their supports" : app.session.meshes().radius > 0 ? "of the cores; dotted circle: the sum of the radii" : "simplex, direction, support plane, polytope");
  if (interactive) {
    ImGui::InvisibleButton("canvas", {area.width, area.height}, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    static bool on_handle = false;
    if (world) body_handles(app, projection, draw);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && world) {
      on_handle = false;
      for (const DisplayMesh* mesh : {&app.session.meshes().a, &app.session.meshes().b}) {
        const Projected p = projection(middle(*mesh));
        on_handle = on_handle || std::hypot(ImGui::GetIO().MousePos.x - p.x, ImGui::GetIO().MousePos.y - p.y) < theme.px(13);
      }
    }
    if (!(world && on_handle && ImGui::IsMouseDown(ImGuiMouseButton_Left))) steer(camera, projection);
    const auto under = ImGui::IsItemHovered() ? vertex_under(items, ImGui::GetIO().MousePos, theme.px(11)) : std::nullopt;
    if (under) ImGui::SetTooltip("vertex %d: click to select", *under);
    const ImVec2 drag = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0);
    if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) && std::hypot(drag.x, drag.y) < 3) app.settings.selected = under;
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) app.fit_views();
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

}  // namespace

void view_panels(App& app, const Area& area, bool interactive) {
  const float gap = app.theme.px(6);
  if (app.layout == App::Layout::both) {
    const float half = (area.width - gap) / 2;
    one_view(app, {area.x, area.y, half, area.height}, true, interactive);
    one_view(app, {area.x + half + gap, area.y, half, area.height}, false, interactive);
  } else {
    one_view(app, area, app.layout == App::Layout::world, interactive);
  }
}

}  // namespace gjkdbg
