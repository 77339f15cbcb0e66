// Everything about one simulated drive on one sheet.
#pragma once

#include "app/core/image.h"
#include "app/tools/sim/run_result.h"
#include "app/tools/sim/world.h"
#include "app/tools/sim_moments.h"

namespace lakshya {

// 2000 px wide: the course, the figures, camera pictures with classes, and speed, clear way, nearest obstacle and states over
// time. What is missing in the record is left out.
Image<Rgb8> drive_sheet(const sim::World& world, const sim::RunResult& result, const DriveRecord& record,
                        double vehicle_radius_m);

}  // namespace lakshya
