// From a navigation map to a command, one frame at a time: docs/contract.md section 5.
// VFH+ chooses a direction, the clear distance along it limits the speed, steering turns both into wheel speeds.
//
// Directions are radians counter-clockwise from straight ahead. Distances are from the turning centre, so that the
// vehicle's radius is added to its stop_margin_m.
//
// Unknown cells (PlannerParams::unknown). Either way a sector is selectable only when it is seen, is not blocked
// and has a clear distance above 0 on its centre ray.
//  stop: the clear distance ends at the first unknown cell beyond the blind zone, as at an obstacle.
//  slow: so it does, but where an unknown cell ended it the speed is at least min(unknown_speed_mps,
//        max_speed_mps), unless an obstacle known further on in the corridor asks for less.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "app/nav/clear_distance.h"
#include "app/nav/params.h"
#include "app/nav/speed_governor.h"
#include "app/nav/steering.h"
#include "app/nav/vfh_plus.h"
#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"
#include "kernels/base/status.h"
#include "kernels/polar_histogram/polar_histogram.h"

namespace lakshya {

struct PlanInput {
  double target = 0;
  double heading = 0;  // direction of motion now: 0 unless the wheels point elsewhere
  std::optional<double> previous =
      std::nullopt;           // what the last plan chose, seen from the vehicle as it stands now
  double heading_change = 0;  // turned since the last plan, counter-clockwise positive
};

// What one frame leaves to the next. A new one starts free.
struct PlanState {
  BinaryHistogram binary;
};

struct Plan {
  PolarHistogram histogram{};
  SectorMask binary{};      // blocked after hysteresis
  SectorMask masked{};      // ... and after the turning circles
  SectorMask seen{};        // reached by the camera's view or the map's memory
  SectorMask selectable{};  // seen and not masked
  Openings openings;

  bool blocked = true;  // no candidate: everything below is zero, and `recovery` says where to turn on the spot
  Side recovery = Side::left;
  double direction = 0;
  double clear_distance_m = 0;
  ClearEnd clear_end = ClearEnd::unknown;
  double speed_mps = 0;  // already scaled by max(0, cos(direction))
  double turn_rate_rps = 0;
  WheelSpeeds wheels;  // before limit_acceleration
};

class Planner {
 public:
  // Keeps `table`, polar_table_entries(geometry) entries of the caller's, and fills it. bad_argument: a geometry or
  // radius outside the limits of polar_histogram.h, a name other than "vfh+", an `unknown` other than "stop" and
  // "slow". Call again for other parameters. The only function here that allocates (the names' copies).
  Status configure(const PlannerParams& params, const VehicleParams& vehicle, const GridGeometry& geometry,
                   std::span<PolarEntry> table);

  // `type` is rows x cols (else size_mismatch), the angles are finite (else bad_argument); on a refusal nothing is
  // written. Does not allocate.
  Status plan(ImageView<const std::uint8_t> type, const PlanInput& input, PlanState& state, Plan& plan) const;

 private:
  void choose_sectors(ImageView<const std::uint8_t> type, Plan& plan) const;
  double speed_along(ImageView<const std::uint8_t> type, const Plan& plan) const;

  PlannerParams params_;
  VehicleParams vehicle_;
  GridGeometry geometry_;
  PolarWindow window_;
  std::span<const PolarEntry> table_;
  TurningCircles circles_;
  GovernorParams governor_;
  bool creep_ = false;
};

}  // namespace lakshya
