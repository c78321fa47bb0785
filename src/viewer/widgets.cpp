#include "viewer/widgets.h"

#include <array>
#include <cfloat>
#include <cstdarg>
#include <cstdio>

namespace cpslam::viewer {

std::string text(const char* format, ...) {
  std::array<char, 256> buffer{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
  va_end(arguments);
  return buffer.data();
}

std::string grouped(std::size_t count) {
  const std::string digits = std::to_string(count);
  std::string result;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) result += ' ';
    result += digits[i];
  }
  return result;
}

void pill(const Gui& gui, const char* word, Colour colour) {
  ImGui::PushFont(gui.small());
  const ImVec2 extent = ImGui::CalcTextSize(word);
  const ImVec2 margin(9.0F * gui.scale(), 4.0F * gui.scale());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + extent.x + 2.0F * margin.x, at.y + extent.y + 2.0F * margin.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, end, to_u32(colour), 0.5F * (end.y - at.y));
  list.AddText({at.x + margin.x, at.y + margin.y}, to_u32(kText), word);
  ImGui::Dummy({end.x - at.x, end.y - at.y});
  ImGui::PopFont();
}

void label(const Gui& gui, ImVec2 corner, const std::string& words, Colour colour) {
  const float size = gui.small()->FontSize;
  const ImVec2 extent = gui.small()->CalcTextSizeA(size, FLT_MAX, 0.0F, words.c_str());
  const float margin = 3.0F * gui.scale();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({corner.x, corner.y}, {corner.x + extent.x + 2.0F * margin, corner.y + extent.y + 2.0F},
                     to_u32(faded(kBackground, 0.7)), 3.0F);
  list.AddText(gui.small(), size, {corner.x + margin, corner.y + 1.0F}, to_u32(colour), words.c_str());
}

void dot(Colour colour) {
  const float height = ImGui::GetTextLineHeight();
  const float radius = 0.3F * height;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddCircleFilled({at.x + radius, at.y + 0.5F * height}, radius, to_u32(colour),
                                              16);
  ImGui::Dummy({2.0F * radius, height});
  ImGui::SameLine();
}

void quiet(const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, to_vec4(kQuietText));
  ImGui::TextUnformatted(words.c_str());
  ImGui::PopStyleColor();
}

void right_aligned(const std::string& words) {
  const float width = ImGui::CalcTextSize(words.c_str()).x;
  ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width);
  quiet(words);
}

bool layer_switch(const char* label, Colour colour, bool& on) {
  ImGui::PushStyleColor(ImGuiCol_CheckMark, to_vec4(colour));
  ImGui::PushStyleColor(ImGuiCol_Text, to_vec4(on ? kText : kQuietText));
  const bool changed = ImGui::Checkbox(label, &on);
  ImGui::PopStyleColor(2);
  return changed;
}

bool choice(const char* label, bool chosen, const char* tip) {
  if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, to_vec4(faded(kAccent, 0.45)));
  const bool pressed = ImGui::Button(label);
  if (chosen) ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip);
  return pressed;
}

}  // namespace cpslam::viewer
