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

// What makes one camera's picture brighter than another's, as the node says it is; -1: it does not say.
struct V4l2Light {
  bool automatic_exposure = false;
  int exposure = -1;  // 100 us
  bool automatic_gain = false;
  int gain = -1;
};
V4l2Light read_light(SystemCalls& calls, int fd);

// How many of the two, exposure and gain, are not the same: automatic in one of two nodes, or of different values. problem() then
// names the last.
int compare_lights(const V4l2Light& first, const char* first_place, const V4l2Light& second,
                   const char* second_place, Problem& problem);

}  // namespace lakshya
