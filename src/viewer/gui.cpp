#include "viewer/gui.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <array>
#include <filesystem>
#include <string>

namespace cpslam::viewer {
namespace {

constexpr float kTextPx = 16.0F;
constexpr float kHeadingPx = 21.0F;
constexpr float kSmallPx = 13.5F;

/// Where Debian and Ubuntu have them, the prettiest first; ImGui's own font where there is none.
constexpr std::array<const char*, 3> kFonts{
    "/usr/share/fonts/opentype/inter/Inter-Medium.otf", "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};

std::string find_font() {
  for (const char* const path : kFonts) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path;
  }
  return {};
}

}  // namespace

Gui::Gui(const Window& window) : scale_(static_cast<float>(window.content_scale())) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // the layout is fixed; leave no file behind
  load_fonts();
  set_style();
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::load_fonts() {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  const std::string path = find_font();
  const auto load = [&](float size_px) {
    ImFont* font = nullptr;
    if (!path.empty()) font = fonts.AddFontFromFileTTF(path.c_str(), size_px * scale_);
    return font != nullptr ? font : fonts.AddFontDefault();
  };
  load(kTextPx);
  heading_ = load(kHeadingPx);
  small_ = load(kSmallPx);
}

void Gui::set_style() const {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 8.0F;
  style.FrameRounding = 5.0F;
  style.GrabRounding = 5.0F;
  style.WindowBorderSize = 1.0F;
  style.WindowPadding = {14.0F, 12.0F};
  style.FramePadding = {9.0F, 5.0F};
  style.ItemSpacing = {9.0F, 7.0F};
  style.ItemInnerSpacing = {7.0F, 5.0F};
  style.ScaleAllSizes(scale_);
  const auto set = [&style](ImGuiCol which, Colour colour) { style.Colors[which] = to_vec4(colour); };
  set(ImGuiCol_Text, kText);
  set(ImGuiCol_TextDisabled, kQuietText);
  set(ImGuiCol_WindowBg, faded(kPanel, 0.94));
  set(ImGuiCol_PopupBg, kPanel);
  set(ImGuiCol_Border, kLine);
  set(ImGuiCol_FrameBg, kRaised);
  set(ImGuiCol_FrameBgHovered, kLine);
  set(ImGuiCol_FrameBgActive, kLine);
  set(ImGuiCol_Button, kRaised);
  set(ImGuiCol_ButtonHovered, kLine);
  set(ImGuiCol_ButtonActive, faded(kAccent, 0.6));
  set(ImGuiCol_CheckMark, kAccent);
  set(ImGuiCol_Separator, kLine);
}

void Gui::begin_frame() const {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Gui::draw_frame() const {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace cpslam::viewer
