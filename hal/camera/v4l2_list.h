// Which Video4Linux2 cameras there are and what they offer, for people who write settings. Host tools only: allocates.
#pragma once

#include <string>
#include <vector>

#include "hal/linux/system_calls.h"

namespace lakshya {

struct V4l2Offer {
  std::string format;  // "YUYV"
  int width = 0;       // px; of a range the largest
  int height = 0;
  bool up_to = false;       // a range of sizes that ends here
  std::vector<double> fps;  // frames a second; empty where the driver does not say
};

struct V4l2Listed {
  std::string path;
  std::string card;
  std::string driver;
  std::string bus;
  std::vector<V4l2Offer> offers;
  std::string problem;  // why nothing is known: "Permission denied"; else empty
};

// Nodes `root`0 .. `root`(count - 1) that capture and stream, or that could not be asked. Looks without disturbing a camera that
// another program uses.
std::vector<V4l2Listed> list_v4l2(SystemCalls& calls = linux_system_calls(), const std::string& root = "/dev/video",
                                  int count = 64);

}  // namespace lakshya
