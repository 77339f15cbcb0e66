#include "app/core/calibration_readers.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/calibration_texts.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  const std::string text = text_of(bytes);  // on the heap, so that reading past its end is seen
  parse_kitti_calibration(text, "fuzz", {});
}

std::vector<std::string> seeds() {
  return {test::kitti_calib()};
}

}  // namespace lakshya::fuzz
