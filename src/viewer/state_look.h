#pragma once

#include "cpslam/types.h"
#include "viewer/colours.h"

namespace cpslam::viewer {

/// How a state is shown.
struct StateLook {
  const char* text;
  Colour colour;
};

[[nodiscard]] constexpr StateLook look_of(TrackingState state) {
  switch (state) {
    case TrackingState::kTracked:
      return {"TRACKED", {46, 160, 90}};
    case TrackingState::kWeak:
      return {"WEAK", {120, 150, 50}};
    case TrackingState::kPredicted:
      return {"PREDICTED", {200, 140, 30}};
    case TrackingState::kLost:
      return {"LOST", {205, 60, 60}};
    case TrackingState::kNotInitialized:
      break;
  }
  return {"STARTING", {95, 105, 118}};
}

}  // namespace cpslam::viewer
