#include "viewer/timing_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "viewer/widgets.h"

namespace cpslam::viewer {
namespace {

constexpr std::array<Colour, kTimingParts.size()> kPartColours{
    {{72, 168, 255}, {200, 110, 230}, {120, 128, 140}, {70, 210, 150}}};
constexpr double kLeastRangeMs = 10.0;

double sum_of(const TimingParts& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

/// A round number of milliseconds that nearly all columns stay below.
double range_of(const std::deque<TimingParts>& frames) {
  std::vector<double> sums;
  sums.reserve(frames.size());
  for (const TimingParts& frame : frames) sums.push_back(sum_of(frame));
  if (sums.empty()) return kLeastRangeMs;
  const auto rank = static_cast<std::ptrdiff_t>(0.97 * static_cast<double>(sums.size() - 1));
  std::nth_element(sums.begin(), sums.begin() + rank, sums.end());
  double range_ms = kLeastRangeMs;
  while (range_ms < 1.1 * sums[static_cast<std::size_t>(rank)]) range_ms *= 2.0;
  return range_ms;
}

void draw_columns(const TimingHistory& history, ImVec2 corner, ImVec2 size, double range_ms) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float width = size.x / static_cast<float>(TimingHistory::kLength);
  const float px_per_ms = size.y / static_cast<float>(range_ms);
  float left = corner.x + size.x - width * static_cast<float>(history.frames().size());
  for (const TimingParts& frame : history.frames()) {
    float bottom = corner.y + size.y;
    for (std::size_t part = 0; part < frame.size(); ++part) {
      const float top = bottom - px_per_ms * static_cast<float>(frame[part]);
      list.AddRectFilled({left, top}, {left + width - 0.5F, bottom}, to_u32(faded(kPartColours[part], 0.85)));
      bottom = top;
    }
    left += width;
  }
}

void draw_graph(const Gui& gui, const TimingHistory& history, float height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, height);
  ImGui::Dummy(size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(corner.x + size.x, corner.y + size.y);
  list.AddRectFilled(corner, end, to_u32(kBackground), 5.0F);
  const double range_ms = range_of(history.frames());
  list.PushClipRect(corner, end, true);
  draw_columns(history, corner, size, range_ms);
  for (const double share : {0.25, 0.5, 0.75}) {
    const float y = end.y - static_cast<float>(share) * size.y;
    list.AddLine({corner.x, y}, {end.x, y}, to_u32(faded(kQuietText, 0.25)));
  }
  label(gui, {corner.x + 5.0F, corner.y + 4.0F}, text("%.0f ms", range_ms), kQuietText);
  list.PopClipRect();
}

TimingParts recent_mean(const TimingHistory& history) {
  constexpr std::size_t kRecent = 30;
  TimingParts mean{};
  const std::size_t n = std::min(kRecent, history.frames().size());
  for (std::size_t i = history.frames().size() - n; i < history.frames().size(); ++i) {
    for (std::size_t part = 0; part < mean.size(); ++part)
      mean[part] += history.frames()[i][part] / static_cast<double>(n);
  }
  return mean;
}

void draw_legend(const Gui& gui, const TimingHistory& history) {
  const TimingParts mean = recent_mean(history);
  ImGui::PushFont(gui.small());
  for (std::size_t part = 0; part < mean.size(); ++part) {
    if (part > 0) ImGui::SameLine(0.0F, 16.0F * gui.scale());
    dot(kPartColours[part]);
    quiet(text("%s %.1f ms", std::string(kTimingParts[part]).c_str(), mean[part]));
  }
  ImGui::PopFont();
}

void draw_table(const Gui& gui, const std::vector<StageTimes>& stages) {
  if (!ImGui::BeginTable("stages", 4, ImGuiTableFlags_ScrollY | ImGuiTableFlags_PadOuterX)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("stage", ImGuiTableColumnFlags_WidthStretch, 3.2F);
  for (const char* const column : {"median ms", "95 % ms", "calls"})
    ImGui::TableSetupColumn(column, ImGuiTableColumnFlags_WidthStretch, 1.0F);
  ImGui::PushFont(gui.small());
  ImGui::TableNextRow();
  for (const char* const column : {"stage", "median ms", "95 % ms", "calls"}) {
    ImGui::TableNextColumn();
    quiet(column);
  }
  for (const StageTimes& stage : stages) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(stage.stage.c_str());
    for (const std::string& cell :
         {text("%.2f", stage.p50_ms), text("%.2f", stage.p95_ms), grouped(stage.count)}) {
      ImGui::TableNextColumn();
      quiet(cell);
    }
  }
  ImGui::PopFont();
  ImGui::EndTable();
}

}  // namespace

void draw_timings(const Gui& gui, const TimingHistory& history) {
  const double mean_ms = sum_of(recent_mean(history));
  ImGui::TextUnformatted("Tracking time");
  right_aligned(text("%.1f ms per frame", mean_ms));
  const float left = ImGui::GetContentRegionAvail().y;
  draw_graph(gui, history, std::clamp(0.36F * left, 50.0F * gui.scale(), 130.0F * gui.scale()));
  draw_legend(gui, history);
  ImGui::Separator();
  draw_table(gui, history.stages());
}

}  // namespace cpslam::viewer
