// The pose from two wheels' travel, its heading held by a compass where there is one.
//
// Between two readings both wheels are taken to turn evenly, so that the vehicle runs on an arc: with d the mean and D the
// difference right - left of the two ways, it turns by k D / track and gets on by d sin(a) / a with a = k D / (2 track), in the
// direction half way between the two headings. Wheels see the turn at once but their error grows; a compass has noise and
// iron about it, but its error does not grow. A Kalman filter (R. E. Kalman, 1960) of the heading and of k joins them: tyres that
// slip sideways turn the vehicle by some percent less than they roll, every time, and k is 1 less that share.
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
  double heading_time_s = 0.8;   // > 0; in which the compass corrects the heading at 0.5 m/s straight on
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
  // bad_data: not finite, or a jump. What is nearer, but farther than the wheels and a compass are likely to be wrong, is left out as
  // well and for as long, and is ok.
  Status add(const HeadingSample& heading);

  Status pose(PoseSample& sample) const override;

  // travel_jumps; heading_jumps
  std::span<const Counter> counters() const { return counters_; }

 private:
  void grow_errors(double turned, double way);
  void correct(double error, double variance);

  WheelOdometrySettings settings_;
  std::optional<WheelTravel> last_travel_;
  std::optional<Nanoseconds> last_heading_;
  std::optional<Nanoseconds> jumped_since_;
  PoseSample pose_;
  double turn_rate_rps_ = 0;  // of the last step
  double scale_ = 1;          // k
  // Of the heading and of k, with their covariance.
  double yaw_variance_ = 0;
  double scale_variance_ = 0;
  double covariance_ = 0;
  Counter counters_[2] = {{"travel_jumps"}, {"heading_jumps"}};
};

}  // namespace lakshya
