#include "app/core/calibration_readers.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  parse_opencv_calibration(text_of(bytes), "fuzz", 0.001);
}

std::vector<std::string> seeds() {
  return {R"(%YAML:1.0
---
K1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 458.6, 0., 367.2, 0., 457.3, 248.4, 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -2.8e-01, 7.4e-02, 1.9e-04, 1.8e-05, 0. ]
M2: [[457.6, 0, 380], [0, 456.1, 255.2], [0, 0, 1]]
R: [1, 0, 0, 0, 1, 0, 0, 0, 1]
T: [-110, 0.4, -0.8]
image_size: [ 752, 480 ]
)",
          R"(image_width: 640
image_height: 480
K1: [500, 0, 320, 0, 500, 240, 0, 0, 1]
K2: [500, 0, 320, 0, 500, 240, 0, 0, 1]
R: [1, 0, 0, 0, 1, 0, 0, 0, 1]
T: [-110, 0, 0]
R1: [1, 0, 0, 0, 1, 0, 0, 0, 1]
R2: [1, 0, 0, 0, 1, 0, 0, 0, 1]
P1: [500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0]
P2: [500, 0, 320, -55000, 0, 500, 240, 0, 0, 0, 1, 0]
)"};
}

}  // namespace lakshya::fuzz
