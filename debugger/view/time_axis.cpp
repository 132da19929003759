// Above the timeline of a moving scene: the time.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "debugger/view/app.h"
#include "debugger/view/explain.h"

namespace gjkdbg {
namespace {

/// A time of a simulation, whose steps are alike: to a hundredth of the whole or finer.
std::string time_of_step(double time, double end) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(2 - std::log10(std::max(end, 1e-9)))), 0, 9);
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, time);
  return text;
}

}  // namespace

/// The time of a moving scene over its events: a mark where it moves on.
void time_axis(App& app) {
  const Session& s = app.session;
  const Theme& theme = app.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, theme.px(15)};
  ImGui::Dummy(size);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float cell = size.x / static_cast<float>(s.count());
  float free = at.x;
  double last = -1;
  std::string told;  ///< the time that was written last: what differs from it in digits that are not shown is not written again
  std::size_t since = 0;  ///< the last time that was told
  const double end = s.recording().scene.scene.query == Query::simulate ? s.recording().result.time.value_or(0) : 0;
  for (std::size_t i = 0; i < s.count(); ++i) {
    std::optional<double> time;
    const Event& event = s.recording().events[i];
    if (const auto* e = std::get_if<recorded::State>(&event)) time = e->time;
    if (const auto* e = std::get_if<recorded::CastAdvanced>(&event)) time = e->time;
    if (const auto* e = std::get_if<recorded::CastEnded>(&event)) time = e->time;
    if (!time) continue;
    const std::size_t begin = std::exchange(since, i + 1);
    if (*time == last) continue;
    last = *time;
    // In a cast what leads to an advance is about the bodies where they are then; but a ray moves on alone.
    const auto* support = i > 0 ? std::get_if<recorded::SupportQueried>(&s.recording().events[i - 1]) : nullptr;
    const bool ray = support && support->phase == Phase::cast;
    const float x = at.x + (static_cast<float>(end > 0 || ray ? i : begin) + 0.5f) * cell;
    if (x < free) continue;
    const std::string text = "t " + (end > 0 ? time_of_step(*time, end) : short_number(*time));
    const float width = theme.small->CalcTextSizeA(theme.small->FontSize * 0.85f, 1000, 0, text.c_str()).x;
    draw->AddLine({x, at.y + theme.px(2)}, {x, at.y + size.y + theme.px(4)}, packed(theme.palette.accent), 1);
    if (text == told) {
      free = x + theme.px(12);
      continue;
    }
    if (x + width + theme.px(4) < at.x + size.x) told = text, draw->AddText(theme.small, theme.small->FontSize * 0.85f, {x + theme.px(3), at.y + theme.px(1)}, packed(theme.palette.text_faint), text.c_str());
    free = x + width + theme.px(12);
  }
}

}  // namespace gjkdbg
