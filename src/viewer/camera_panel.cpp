#include "viewer/camera_panel.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "viewer/mask_overlay.h"
#include "viewer/state_look.h"
#include "viewer/widgets.h"

namespace cpslam::viewer {
namespace {

constexpr float kKeypointPx = 2.3F;
constexpr float kPlaceholderAspect = 0.75F;

/// A rectangle that holds the mask with its outlines.
cv::Rect area_of_people(const cv::Mat& mask) {
  if (mask.type() != CV_8UC1 || mask.empty()) return {};
  const cv::Rect people = cv::boundingRect(mask);
  if (people.empty()) return {};
  return cv::Rect(people.x - 1, people.y - 1, people.width + 2, people.height + 2) &
         cv::Rect({}, mask.size());
}

}  // namespace

void CameraPanel::set_frame(std::shared_ptr<const FrameSnapshot> frame) {
  frame_ = std::move(frame);
  image_.set(frame_->image);
  const cv::Mat& mask = frame_->view.person_mask;
  people_area_ = area_of_people(mask);
  people_.set(mask_overlay(mask(people_area_)));
}

void CameraPanel::draw(const Gui& gui) const {
  draw_state(gui);
  draw_picture(gui);
  draw_legend(gui);
}

void CameraPanel::draw_state(const Gui& gui) const {
  ImGui::PushFont(gui.heading());
  ImGui::TextUnformatted("CP-SLAM");
  ImGui::PopFont();
  const StateLook look = look_of(frame_ ? frame_->result.state : TrackingState::kNotInitialized);
  ImGui::SameLine(0.0F, 14.0F * gui.scale());
  pill(gui, look.text, look.colour);
  if (!frame_) return;
  const TrackResult& result = frame_->result;
  ImGui::AlignTextToFramePadding();
  right_aligned(text("frame %llu     %.2f s     %d inliers", static_cast<unsigned long long>(frame_->index),
                     result.time_s, result.n_inliers));
}

void CameraPanel::draw_picture(const Gui& gui) const {
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const cv::Size size = image_.size();
  const float scale = image_.empty() ? 1.0F : width / static_cast<float>(size.width);
  const float height = image_.empty() ? kPlaceholderAspect * width : scale * static_cast<float>(size.height);
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(corner.x + width, corner.y + height);
  if (image_.empty()) {
    list.AddRectFilled(corner, end, to_u32(kBackground));
    return;
  }
  list.PushClipRect(corner, end, true);
  list.AddImage(image_.handle(), corner, end);
  if (!people_.empty()) {
    const auto at = [&](cv::Point p) {
      return ImVec2(corner.x + scale * static_cast<float>(p.x), corner.y + scale * static_cast<float>(p.y));
    };
    list.AddImage(people_.handle(), at(people_area_.tl()), at(people_area_.br()));
  }
  draw_seen(gui, corner, scale);
  list.PopClipRect();
}

void CameraPanel::draw_seen(const Gui& gui, ImVec2 corner, float scale) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  // A thousand dots with soft rims would be most of the window's triangles.
  const ImDrawListFlags flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
  for (const FrameView::SeenKeypoint& keypoint : frame_->view.keypoints) {
    // A pixel's area reaches half a pixel around its coordinates.
    const ImVec2 at(corner.x + scale * (keypoint.x + 0.5F), corner.y + scale * (keypoint.y + 0.5F));
    list.AddCircleFilled(at, kKeypointPx, to_u32(keypoint_colour(keypoint.kind)), 4);
  }
  list.Flags = flags;
  for (const PersonBox& box : frame_->view.boxes) {
    const auto left = corner.x + scale * static_cast<float>(box.x);
    const auto top = corner.y + scale * static_cast<float>(box.y);
    const ImVec2 end(left + scale * static_cast<float>(box.width),
                     top + scale * static_cast<float>(box.height));
    list.AddRect({left, top}, end, to_u32(kBox), 4.0F, 0, 2.0F);
    label(gui, {std::max(left, corner.x) + 4.0F, std::max(top, corner.y) + 3.0F},
          text("%.0f %%", 100.0 * box.confidence), kBox);
  }
}

void CameraPanel::draw_legend(const Gui& gui) const {
  if (!frame_) return;
  const FrameView& view = frame_->view;
  const auto count = [&view](FrameView::Kind kind) {
    return static_cast<int>(std::count_if(view.keypoints.begin(), view.keypoints.end(),
                                          [kind](const auto& keypoint) { return keypoint.kind == kind; }));
  };
  ImGui::PushFont(gui.small());
  dot(kTracked);
  quiet(text("%d on the map", count(FrameView::Kind::kTracked)));
  ImGui::SameLine(0.0F, 16.0F * gui.scale());
  dot(kKept);
  quiet(text("%d kept", count(FrameView::Kind::kKept)));
  ImGui::SameLine(0.0F, 16.0F * gui.scale());
  dot(kRemoved);
  quiet(text("%d removed", count(FrameView::Kind::kRemoved)));
  ImGui::SameLine(0.0F, 16.0F * gui.scale());
  dot(kBox);
  if (view.boxes_time_s) {
    quiet(text("%zu %s, %.0f ms old", view.boxes.size(), view.boxes.size() == 1 ? "box" : "boxes",
               1000.0 * (view.time_s - *view.boxes_time_s)));
  } else {
    quiet("no boxes");
  }
  ImGui::PopFont();
}

}  // namespace cpslam::viewer
