#include "debugger/view/theme.h"

#include <filesystem>
#include <initializer_list>

namespace gjkdbg {
namespace {

const ImWchar text_ranges[] = {0x20, 0xFF, 0x0370, 0x03FF, 0x2010, 0x2027, 0x2190, 0x21FF, 0x2200, 0x22FF, 0};

const char* first_existing(std::initializer_list<const char*> files) {
  for (const char* file : files)
    if (std::error_code ignored; std::filesystem::exists(file, ignored)) return file;
  return nullptr;
}

ImFont* load(const char* file, const char* fallback, float size) {
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  if (!file) file = fallback;
  if (!file) {
    ImFontConfig config;
    config.SizePixels = size;
    return atlas->AddFontDefault(&config);
  }
  ImFontConfig config;
  config.OversampleH = 2, config.OversampleV = 1;
  ImFont* font = atlas->AddFontFromFileTTF(file, size, &config, text_ranges);
  if (fallback && fallback != file) {
    config.MergeMode = true;
    atlas->AddFontFromFileTTF(fallback, size, &config, text_ranges);
  }
  return font;
}

}  // namespace

void load_fonts(Theme& theme, float scale) {
  theme.scale = scale;
  const char* const dejavu = first_existing({"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"});
  const char* const inter = first_existing({"/usr/share/fonts/opentype/inter/Inter-Regular.otf", "/usr/share/fonts/rsms-inter-fonts/Inter-Regular.otf", "/Library/Fonts/Inter-Regular.otf"});
  const char* const bold = first_existing({"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf", "/usr/share/fonts/rsms-inter-fonts/Inter-SemiBold.otf"});
  const char* const mono = first_existing({"/usr/share/fonts/truetype/jetbrains-mono/JetBrainsMono-Regular.ttf", "/usr/share/fonts/jetbrains-mono-fonts/JetBrainsMono-Regular.ttf"});
  ImGui::GetIO().Fonts->Clear();
  theme.text = load(inter, dejavu, 15 * scale);
  theme.small = load(inter, dejavu, 13 * scale);
  theme.title = load(bold ? bold : inter, dejavu, 18 * scale);
  theme.mono = load(mono, dejavu, 13.5f * scale);
  theme.lecture = load(inter, dejavu, 46 * scale);
  theme.lecture_title = load(bold ? bold : inter, dejavu, 64 * scale);
}

void apply_colours(Theme& theme, bool dark) {
  theme.dark = dark;
  theme.palette = dark ? dark_palette : light_palette;
  const Palette& p = theme.palette;
  ImGuiStyle style;
  style.WindowRounding = 0, style.ChildRounding = 6, style.FrameRounding = 4, style.PopupRounding = 6, style.ScrollbarRounding = 4, style.GrabRounding = 4;
  style.WindowBorderSize = 0, style.ChildBorderSize = 0, style.FrameBorderSize = 0;
  style.FramePadding = {8, 4}, style.ItemSpacing = {8, 6}, style.WindowPadding = {14, 12}, style.ScrollbarSize = 10;
  style.ScaleAllSizes(theme.scale);
  ImVec4* c = style.Colors;
  c[ImGuiCol_Text] = vec(p.text), c[ImGuiCol_TextDisabled] = vec(p.text_faint);
  c[ImGuiCol_WindowBg] = vec(p.background), c[ImGuiCol_ChildBg] = vec(p.panel), c[ImGuiCol_PopupBg] = vec(p.panel);
  c[ImGuiCol_Border] = vec(p.hover), c[ImGuiCol_FrameBg] = vec(p.field), c[ImGuiCol_FrameBgHovered] = vec(p.hover), c[ImGuiCol_FrameBgActive] = vec(p.hover);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = vec(p.field);
  c[ImGuiCol_MenuBarBg] = vec(p.panel), c[ImGuiCol_ScrollbarBg] = vec(p.panel.with_alpha(0)), c[ImGuiCol_ScrollbarGrab] = vec(p.hover);
  c[ImGuiCol_ScrollbarGrabHovered] = vec(p.text_faint), c[ImGuiCol_ScrollbarGrabActive] = vec(p.text_faint);
  c[ImGuiCol_CheckMark] = vec(p.accent), c[ImGuiCol_SliderGrab] = vec(p.accent), c[ImGuiCol_SliderGrabActive] = vec(p.accent);
  c[ImGuiCol_Button] = vec(p.field), c[ImGuiCol_ButtonHovered] = vec(p.hover), c[ImGuiCol_ButtonActive] = vec(p.accent);
  c[ImGuiCol_Header] = vec(p.field), c[ImGuiCol_HeaderHovered] = vec(p.hover), c[ImGuiCol_HeaderActive] = vec(p.accent.with_alpha(0.5));
  c[ImGuiCol_Separator] = vec(p.field), c[ImGuiCol_NavHighlight] = vec(p.accent);
  c[ImGuiCol_TextSelectedBg] = vec(p.accent.with_alpha(0.4)), c[ImGuiCol_ModalWindowDimBg] = vec(p.background.with_alpha(0.6));
  ImGui::GetStyle() = style;
}

}  // namespace gjkdbg
