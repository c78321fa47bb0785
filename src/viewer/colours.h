#pragma once

#include <array>
#include <cstdint>

#include "cpslam/rgbd_frame.h"
#include "cpslam/types.h"

namespace cpslam::viewer {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
  bool operator==(const Colour&) const = default;
};

[[nodiscard]] constexpr Colour faded(Colour colour, double share) {
  colour.alpha = static_cast<std::uint8_t>(share * colour.alpha);
  return colour;
}

inline constexpr Colour kBackground{13, 17, 23};
inline constexpr Colour kPanel{22, 27, 34};
inline constexpr Colour kRaised{33, 40, 50};
inline constexpr Colour kLine{48, 56, 68};
inline constexpr Colour kText{230, 235, 241};
inline constexpr Colour kQuietText{139, 150, 163};
inline constexpr Colour kAccent{72, 168, 255};

inline constexpr Colour kTracked{70, 220, 120};
inline constexpr Colour kKept{38, 130, 80};
inline constexpr Colour kRemoved{255, 82, 82};
inline constexpr Colour kBox{255, 200, 60};

inline constexpr Colour kKeyFrame{96, 156, 255};
inline constexpr Colour kCovisibility{70, 104, 160};
inline constexpr Colour kTree{60, 190, 170};
inline constexpr Colour kLoop{255, 120, 200};
inline constexpr Colour kTrajectory{255, 255, 255};
inline constexpr Colour kTruth{255, 170, 60};
inline constexpr Colour kCamera{70, 220, 120};

/// Neither green nor red: those are the keypoints'.
inline constexpr std::array<Colour, 6> kPeople{
    {{66, 135, 245}, {214, 90, 230}, {60, 210, 225}, {255, 150, 50}, {150, 120, 255}, {235, 120, 160}}};
/// number: of the person, from 1.
[[nodiscard]] constexpr Colour person_colour(unsigned number) {
  return kPeople[(number + kPeople.size() - 1) % kPeople.size()];
}

[[nodiscard]] constexpr Colour keypoint_colour(FrameView::Kind kind) {
  switch (kind) {
    case FrameView::Kind::kTracked:
      return kTracked;
    case FrameView::Kind::kKept:
      return kKept;
    case FrameView::Kind::kRemoved:
      return kRemoved;
  }
  return kText;
}

/// share in [0, 1] of the way from the floor to the ceiling.
[[nodiscard]] Colour height_colour(double share);

}  // namespace cpslam::viewer
