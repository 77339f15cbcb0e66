// The navigation map as a small picture without words: seen from above, the vehicle at the bottom looking up. Obstacles red,
// unoccupied white, unknown grey; the vehicle a circle of its radius, blue the chosen direction as far as it is clear, black the
// direction of the way point.
#pragma once

#include "app/core/image.h"
#include "app/core/vehicle_config.h"
#include "app/loop/messages.h"

namespace lakshya {

Image<Rgb8> loop_map_picture(ImageView<const std::uint8_t> type, const PlanNote& plan, const VehicleConfig& config);

}  // namespace lakshya
