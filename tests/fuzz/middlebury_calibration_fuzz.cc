#include "app/core/calibration_readers.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  const std::string text = text_of(bytes);  // on the heap, so that reading past its end is seen
  parse_middlebury_calibration(text, "fuzz");
}

std::vector<std::string> seeds() {
  return {
      "cam0=[3962.004 0 1146.717; 0 3962.004 896.476; 0 0 1]\ncam1=[3962.004 0 1261.217; 0 3962.004 896.476; 0 0 "
      "1]\n"
      "doffs=114.5\nbaseline=237.604\nwidth=2872\nheight=1984\nndisp=260\nisint=0\n",
      "cam0=[500,0,320;0,500,240;0,0,1]\r\ndoffs=0\r\nbaseline=60\r\nwidth=640\r\nheight=480\r\n"};
}

}  // namespace lakshya::fuzz
