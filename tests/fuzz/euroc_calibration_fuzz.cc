#include <algorithm>

#include "app/core/calibration_readers.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/calibration_texts.h"

namespace lakshya::fuzz {

// The two files with a zero byte between them.
void read(Bytes bytes) {
  const std::string text = text_of(bytes);
  const std::size_t middle = std::min(text.find('\0'), text.size());
  const std::string right = middle < text.size() ? text.substr(middle + 1) : text;
  parse_euroc_calibration({text.substr(0, middle), "left"}, {right, "right"});
}

std::vector<std::string> seeds() {
  const std::string between(1, '\0');
  return {test::euroc_sensor("0.06") + between + test::euroc_sensor("-0.05", "82")};
}

}  // namespace lakshya::fuzz
