// The pose from two wheels' travel, its heading held by a compass where there is one.
//
// Between two readings both wheels are taken to turn evenly, so that the vehicle runs on an arc: with d the mean and D the
// difference right - left of the two ways, it turns by D / track and gets on by d sin(a) / a with a = D / (2 track), in the
// direction half way between the two headings. Wheels see the turn at once but their error grows; a compass has noise and
// iron about it, but its error does not grow: its difference is taken over with the time constant heading_time_s.
#pragma once

#include <optional>
#include <span>

#include "hal/compass.h"
#include "hal/device.h"
#include "hal/odometry.h"
#include "hal/servo.h"

namespace lakshya {

struct WheelOdometrySettings {
  double track_m = 0.5;          // between the wheels, > 0
  bool has_compass = false;      // the first heading decides where the vehicle points at the start; without: east
  double heading_time_s = 2;     // > 0
  double heading_jump_deg = 20;  // a heading farther than this from the wheels' is not believed,
  double jump_hold_s = 3;        // unless headings have said so for this long
  double max_speed_mps = 20;     // a wheel that went faster has lost count: that step is left out
};

class WheelOdometry final : public Odometry {
 public:
  explicit WheelOdometry(const WheelOdometrySettings& settings) : settings_(settings) {}

  // In order of time; earlier or equal ones are ignored, and with a compass those before the first heading. bad_data: the step is
  // impossible, the pose stays, with its time.
  Status add(const WheelTravel& travel);
  // bad_data: not finite, or a jump.
  Status add(const HeadingSample& heading);

  Status pose(PoseSample& sample) const override;

  // travel_jumps; heading_jumps
  std::span<const Counter> counters() const { return counters_; }

 private:
  WheelOdometrySettings settings_;
  std::optional<WheelTravel> last_travel_;
  std::optional<Nanoseconds> last_heading_;
  std::optional<Nanoseconds> jumped_since_;
  PoseSample pose_;
  Counter counters_[2] = {{"travel_jumps"}, {"heading_jumps"}};
};

}  // namespace lakshya
