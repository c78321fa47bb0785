#include "common/frame_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace cpslam::program {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kTintWeight = 0.4;

struct Colour {
  double blue, green, red;
  operator cv::Scalar() const { return {blue, green, red}; }  // NOLINT: stands for one in OpenCV's calls
};

constexpr Colour kKeptColour{0.0, 150.0, 0.0};
constexpr Colour kTrackedColour{60.0, 255.0, 60.0};
constexpr Colour kRemovedColour{0.0, 0.0, 255.0};
constexpr Colour kBoxColour{0.0, 220.0, 255.0};
constexpr Colour kTextColour{255.0, 255.0, 255.0};
constexpr Colour kLabelColour{0.0, 0.0, 0.0};

// Neither green nor red: those are the keypoints'.
constexpr std::array<std::array<int, 3>, 6> kPersonTints{
    {{255, 80, 0}, {255, 0, 200}, {255, 220, 0}, {0, 140, 255}, {255, 120, 120}, {180, 40, 120}}};

template <typename... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 120> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

/// Sizes grow with the picture.
double scale_of(const cv::Mat& picture) {
  return std::max(picture.cols / 640.0, 0.5);
}

void tint_people(cv::Mat& picture, const cv::Mat& mask) {
  if (mask.size() != picture.size() || mask.type() != CV_8UC1) return;
  for (int y = 0; y < mask.rows; ++y) {
    const auto* const person = mask.ptr<std::uint8_t>(y);
    auto* const pixel = picture.ptr<cv::Vec3b>(y);
    for (int x = 0; x < mask.cols; ++x) {
      if (person[x] == 0) continue;
      const auto& tint = kPersonTints[(person[x] - 1U) % kPersonTints.size()];
      for (int channel = 0; channel < 3; ++channel) {
        const double mixed =
            (1.0 - kTintWeight) * pixel[x][channel] + kTintWeight * tint[static_cast<std::size_t>(channel)];
        pixel[x][channel] = cv::saturate_cast<std::uint8_t>(mixed);
      }
    }
  }
}

void write_label(cv::Mat& picture, const std::string& label, cv::Point bottom_left) {
  const double size = 0.42 * scale_of(picture);
  int base = 0;
  const cv::Size extent = cv::getTextSize(label, kFont, size, 1, &base);
  const cv::Rect background(bottom_left.x, bottom_left.y - extent.height - 2, extent.width + 2,
                            extent.height + base + 2);
  cv::rectangle(picture, background, kLabelColour, cv::FILLED);
  cv::putText(picture, label, bottom_left, kFont, size, kTextColour, 1, cv::LINE_AA);
}

void draw_boxes(cv::Mat& picture, const std::vector<PersonBox>& boxes) {
  const int line = std::max(1, static_cast<int>(std::lround(scale_of(picture))));
  for (const PersonBox& box : boxes) {
    const cv::Rect2d outline(box.x, box.y, box.width, box.height);
    cv::rectangle(picture, outline, kBoxColour, line);
    // Inside the picture, even if the box's corner is not.
    const cv::Point corner(std::max(static_cast<int>(box.x), 0) + 2,
                           std::max(static_cast<int>(box.y + box.height), 0) - 5);
    write_label(picture, text("%.2f", box.confidence), {corner.x, std::min(corner.y, picture.rows - 5)});
  }
}

void draw_keypoints(cv::Mat& picture, const std::vector<FrameView::SeenKeypoint>& keypoints) {
  const int radius = std::max(1, static_cast<int>(std::lround(2.0 * scale_of(picture))));
  for (const FrameView::SeenKeypoint& keypoint : keypoints) {
    const Colour& colour = keypoint.kind == FrameView::Kind::kRemoved   ? kRemovedColour
                           : keypoint.kind == FrameView::Kind::kTracked ? kTrackedColour
                                                                        : kKeptColour;
    const cv::Point centre(static_cast<int>(std::lround(keypoint.x)),
                           static_cast<int>(std::lround(keypoint.y)));
    cv::circle(picture, centre, radius, colour, cv::FILLED);
  }
}

std::string caption(const FrameView& view) {
  const auto count = [&view](FrameView::Kind kind) {
    return std::count_if(view.keypoints.begin(), view.keypoints.end(),
                         [kind](const FrameView::SeenKeypoint& keypoint) { return keypoint.kind == kind; });
  };
  std::string line = text(
      "%ld tracked, %ld kept, %ld removed", static_cast<long>(count(FrameView::Kind::kTracked)),
      static_cast<long>(count(FrameView::Kind::kKept)), static_cast<long>(count(FrameView::Kind::kRemoved)));
  if (view.boxes_time_s) {
    line += text("; %zu boxes, %.0f ms old", view.boxes.size(), 1000.0 * (view.time_s - *view.boxes_time_s));
  }
  return line;
}

}  // namespace

cv::Mat paint(const cv::Mat& image, const FrameView& view) {
  cv::Mat picture;
  if (image.channels() == 1) {
    cv::cvtColor(image, picture, cv::COLOR_GRAY2BGR);
  } else {
    picture = image.clone();
  }
  tint_people(picture, view.person_mask);
  draw_boxes(picture, view.boxes);
  draw_keypoints(picture, view.keypoints);
  write_label(picture, caption(view), {3, static_cast<int>(14.0 * scale_of(picture))});
  return picture;
}

}  // namespace cpslam::program
