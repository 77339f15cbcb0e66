// Where the vehicle has got to since the start.
#pragma once

#include "hal/clock.h"
#include "kernels/base/status.h"

namespace lakshya {

// World frame: east-north, metres, origin at the start; yaw in (-pi, pi] from east, counter-clockwise.
struct PoseSample {
  double east_m = 0;
  double north_m = 0;
  double yaw = 0;
  Nanoseconds time = 0;  // of the newest travel in it
};

class Odometry {
 public:
  virtual ~Odometry() = default;
  // timeout: nothing to start from yet.
  virtual Status pose(PoseSample& sample) const = 0;
};

}  // namespace lakshya
