// Frame rate, exposure and gain of a Video4Linux2 node. A camera that does not have one of them is used as it is. Source: Linux
// kernel, "Video for Linux API", VIDIOC_S_PARM, VIDIOC_S_EXT_CTRLS, Camera Control Reference.
#pragma once

#include "hal/linux/system_calls.h"
#include "hal/problem.h"

namespace lakshya {

struct V4l2Controls {
  double fps = 0;        // 0: as it is
  int exposure_us = -1;  // microseconds, set in steps of 100; negative: automatic
  int gain = -1;         // in the driver's own unit; negative: automatic
};

// Asks for all of them. The number of those that the node did not take as they were asked for; problem() then names the last
// (automatic exposure or gain that a node does not have was not refused). `fps`: what it will give, 0 where it does not say.
int set_controls(SystemCalls& calls, int fd, const char* place, const V4l2Controls& wanted, double& fps,
                 Problem& problem);

}  // namespace lakshya
