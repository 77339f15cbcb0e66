// From configuration and rectified camera to the parameters of the kernels: degrees to radians, and which number
// goes where.
#pragma once

#include "app/core/calibration.h"
#include "app/core/vehicle_config.h"
#include "app/nav/rolling_map.h"
#include "kernels/base/nav_grid.h"
#include "kernels/ground/ground.h"
#include "kernels/prune/prune.h"
#include "kernels/score/score.h"
#include "kernels/slope/slope.h"

namespace lakshya {

struct RouteParams;

// Largest stored disparity that the matcher searches, px.
double max_disparity_px(const MatcherConfig& matcher);

GridGeometry grid_geometry(const GridConfig& grid);
RouteParams route_params(const VehicleConfig& config, const RectifiedGeometry& camera);
RollingMapParams rolling_map_params(const VehicleConfig& config, const RectifiedGeometry& camera);
PruneGeometry prune_geometry(const VehicleConfig& config, const RectifiedGeometry& camera);
ScoreGeometry score_geometry(const VehicleConfig& config, const RectifiedGeometry& camera);

SlopeParams slope_params(const VehicleConfig& config);

// What a change of pitch does to the floor's disparity, 1/16 px rounded up: (f B / H) * angle; at most
// kGroundReach.
std::int32_t disparity_of_pitch16(const VehicleConfig& config, const RectifiedGeometry& camera, double pitch_deg);

// The inverse: the change of pitch, degrees, that an offset of the floor's disparity stands for.
double pitch_deg_of_disparity16(const VehicleConfig& config, const RectifiedGeometry& camera,
                                std::int32_t offset16);

// Distance from the turning centre within which the camera cannot show the floor: where the image's bottom row meets
// it, towards the image's corners, and two cells more. Never less than planner.blind_zone_m, and just that for a camera
// that shows no floor within prune.max_depth_m.
double blind_zone_m(const VehicleConfig& config, const RectifiedGeometry& camera);

}  // namespace lakshya
