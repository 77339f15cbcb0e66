// Private to picture_map*.cc: the camera's view, the vehicle and the plan, drawn over the map's cells.
#pragma once

#include "app/tools/picture_panels.h"

namespace lakshya {

void draw_map_overlay(Canvas& area, const MapView& view, const PictureInput& input, MapDetail detail);

}  // namespace lakshya
