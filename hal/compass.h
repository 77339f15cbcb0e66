// Where the vehicle points.
#pragma once

#include "hal/clock.h"
#include "hal/device.h"

namespace lakshya {

struct HeadingSample {
  double yaw =
      0;  // rad in (-pi, pi], world frame: zero east, counter-clockwise; from true north, mounting offset taken off
  // rad; gravity's, not the ground's (docs/contract.md, section 1). NaN where the device has no such sensor.
  double pitch = 0;  // nose up positive, as MAVLink's ATTITUDE
  double roll = 0;   // right side down positive
  Nanoseconds time = 0;
};

class Compass : public Device {
 public:
  // The newest sample that was not given yet; waits for one until `deadline`. timeout: none came; bad_data: only damaged ones
  // came; disconnected: the device has gone, the next call looks for it again.
  virtual Status read(Nanoseconds deadline, HeadingSample& sample) = 0;
};

}  // namespace lakshya
