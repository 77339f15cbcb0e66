// From a navigation map to a command, one frame at a time: docs/contract.md section 5.
// VFH+, VFH* or VFH (PlannerParams::name) chooses a direction, the clear distance along it limits the speed, steering turns
// both into wheel speeds. VFH differs in the histogram, the choice within the openings and one more limit of the
// speed (vfh.h); it has no hysteresis and looks at neither heading (but for the speed) nor previous choice. What is
// said here about unseen and unknown cells, the turning circles and the governor holds for both.
//
// Directions are radians counter-clockwise from straight ahead. Distances are from the turning centre, so that the
// vehicle's radius is added to its stop_margin_m.
//
// Where nothing has been open for two plans VFH+ and VFH* look once more without the safety distance, no farther than the next gap,
// and creep there (unknown_speed_mps): the map's cells make a gap up to a cell and a half narrower than it is, and a vehicle that
// has come into a narrow place must get out.
//
// Unknown cells (PlannerParams::unknown). Either way a sector is selectable only when it is seen, is not blocked
// and has a clear distance above 0 on its centre ray.
//  stop: the clear distance ends at the first unknown cell beyond the blind zone, as at an obstacle.
//  slow: so it does, but where an unknown cell ended it the speed is at least min(unknown_speed_mps,
//        max_speed_mps), unless an obstacle known further on in the corridor asks for less.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "app/nav/clear_distance.h"
#include "app/nav/params.h"
#include "app/nav/rolling_map.h"
#include "app/nav/speed_governor.h"
#include "app/nav/steering.h"
#include "app/nav/vfh.h"
#include "app/nav/vfh_plus.h"
#include "app/nav/vfh_star.h"
#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"
#include "kernels/base/status.h"
#include "kernels/polar_histogram/polar_histogram.h"

namespace lakshya {

// What a search for the way to the target (route.h) has found.
struct RouteAim {
  bool found = false;
  double direction = 0;                                         // rad, from straight ahead
  double straight_m = std::numeric_limits<double>::infinity();  // to the point that it leads to
  // How far the vehicle's side may go that way, to an obstacle or to the first cell that is not known to be free; and, of the
  // directions that it sweeps until it has turned there, the least that may be gone. From the turning centre, metres.
  double clear_m = 0;
  ClearEnd clear_end = ClearEnd::unknown;
  double swept_m = 0;
};

struct PlanInput {
  double target = 0;
  double target_distance_m = std::numeric_limits<double>::infinity();  // vfh*: it looks no farther ahead
  double heading = 0;  // direction of motion now: 0 unless the wheels point elsewhere
  std::optional<double> previous =
      std::nullopt;           // what the last plan chose, seen from the vehicle as it stands now
  double heading_change = 0;  // turned since the last plan, counter-clockwise positive
  // Where the map's frame was taken: for the pipeline's rolling map, which is left out without it. The planner looks at the map
  // only.
  std::optional<MapPose> pose = std::nullopt;
  // The planner "route": what the search on the rolling map has found; without it, it plans as "vfh+" does.
  std::optional<RouteAim> route = std::nullopt;
};

// A vehicle that is hemmed in turns to one side until a direction opens, and to the same side if that closes again soon: which
// side looks more open may change from frame to frame.
struct Recovery {
  static constexpr int kRemembered = 20;  // plans with a direction after which the side is chosen anew

  bool active = false;
  Side side = Side::left;
  double turned = 0;  // rad, without direction
  int open_for = 0;   // plans with one
};

// A choice farther than kOtherWay from the previous one is followed only when it has been made so many times in a row; until then the
// vehicle stands, or turns on where it was turning to. Else openings that come and go with the map's rounding, one to the left and
// one to the right, would have it turn to and fro for ever.
inline constexpr int kPatience = 8;
inline constexpr double kOtherWay = radians(60);

// What one frame leaves to the next. A new one starts free.
struct PlanState {
  BinaryHistogram binary;  // of VFH+ and VFH*
  Recovery recovery;
  int disagreements = 0;  // plans in a row that would go quite another way than the one before
};

struct Plan {
  PolarHistogram histogram{};  // VFH: smoothed
  SectorMask binary{};         // blocked; VFH+: after hysteresis
  SectorMask masked{};         // ... and after the turning circles
  SectorMask seen{};           // reached by the camera's view or the map's memory
  SectorMask selectable{};     // seen and not masked
  Openings openings;

  bool blocked = true;  // no candidate: everything below is zero, and `recovery` says where to turn on the spot
  Side recovery = Side::left;
  bool waits = false;      // the direction is still the previous one, and the speed 0: see kPatience
  bool yields = false;     // stands, and does not turn either, because of somebody who moves: give_way.h
  bool squeezes = false;   // nothing is open but without the safety distance: creeping
  bool hemmed_in = false;  // blocked, and a full turn has found nothing: better stand still
  double direction = 0;
  double clear_distance_m = 0;
  ClearEnd clear_end = ClearEnd::unknown;
  double speed_mps = 0;  // already scaled by max(0, cos(direction))
  double turn_rate_rps = 0;
  WheelSpeeds wheels;  // before limit_acceleration
};

// Histogram values below `low` free a sector, values above `high` block it, what lies between leaves it as it was.
struct Thresholds {
  int low = 0;
  int high = 0;
};

// Those of the planner in use; VFH has one threshold, and leaves no sector as it was.
Thresholds histogram_thresholds(const PlannerParams& params);

class Planner {
 public:
  // Keeps `table`, polar_table_entries(geometry) entries of the caller's, and fills it. bad_argument: a geometry or
  // radius outside the limits of polar_histogram.h, a name other than "vfh+", "vfh*" and "vfh", an `unknown` other than "stop"
  // and "slow", a vfh_smoothing or vfh_stop_density outside the limits of vfh.h, a star_step_m or star_depth
  // outside those of vfh_star.h. Call again for other parameters. The
  // only function here that allocates (the names' copies). `sum` is the implementation of the histogram to use.
  Status configure(const PlannerParams& params, const VehicleParams& vehicle, const GridGeometry& geometry,
                   std::span<PolarEntry> table, decltype(&polar_histogram_ref) sum = polar_histogram_simd);

  // `type` is rows x cols (else size_mismatch), the angles are finite (else bad_argument); on a refusal nothing is
  // written. Does not allocate.
  Status plan(ImageView<const std::uint8_t> type, const PlanInput& input, PlanState& state, Plan& plan) const;

 private:
  void block_sectors(double heading_change, PlanState& state, Plan& plan) const;
  void choose_sectors(ImageView<const std::uint8_t> type, Plan& plan) const;
  std::optional<double> choose(ImageView<const std::uint8_t> type, const PlanInput& input, const Plan& plan) const;
  double speed_limit(const PlanInput& input, const Plan& plan) const;
  double speed_while_turning(ImageView<const std::uint8_t> type, double direction, double heading_change) const;
  std::optional<double> squeeze(ImageView<const std::uint8_t> type, const PlanInput& input, Plan& plan) const;
  void be_patient(const PlanInput& input, PlanState& state, Plan& plan) const;
  void follow_route(const RouteAim& route, Plan& plan) const;
  void recover(double heading_change, PlanState& state, Plan& plan) const;
  double speed_along(ImageView<const std::uint8_t> type, const Plan& plan) const;

  PlannerParams params_;
  VehicleParams vehicle_;
  GridGeometry geometry_;
  PolarWindow window_;
  std::span<const PolarEntry> table_;
  decltype(&polar_histogram_ref) sum_histogram_ = polar_histogram_simd;
  TurningCircles circles_;
  GovernorParams governor_;
  double corridor_m_ = 0;  // half width of the way that must be free
  bool creep_ = false;
  bool is_vfh_ = false;
  bool is_star_ = false;
  bool is_route_ = false;
};

}  // namespace lakshya
