// OpenCV's matchers in the place of ours, under the same map and planner: lakshya sim --sensor opencv-bm, opencv-sgbm.
#pragma once

#include <memory>

#include "app/core/pipeline.h"
#include "app/tools/sim/run_world.h"

namespace lakshya {

// sensor: opencv_bm or opencv_sgbm. The search range is the configuration's.
std::unique_ptr<StandIn> make_opencv_stand_in(sim::Sensor sensor, const RectifiedGeometry& camera,
                                              const VehicleConfig& config);

}  // namespace lakshya
