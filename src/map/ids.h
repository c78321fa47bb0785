#pragma once

#include "map/slot_map.h"

namespace cpslam {

struct KeyFrameTag;
struct MapPointTag;
using KeyFrameId = SlotId<KeyFrameTag>;
using MapPointId = SlotId<MapPointTag>;

}  // namespace cpslam
