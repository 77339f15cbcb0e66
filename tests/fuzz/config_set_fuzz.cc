#include "app/core/vehicle_config_file.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

// The first line is --profile, every other one a --set.
void read(Bytes bytes) {
  const std::string text = text_of(bytes);
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  load_vehicle_config("", lines[0], {lines.begin() + 1, lines.end()});
}

std::vector<std::string> seeds() {
  return {"indoor\ncamera.height_m=0.45\nmatcher.paths=5",
          "\nplanner.name=vfh\ngrid.cols=100\nvehicle.latency_s=+.5"};
}

}  // namespace lakshya::fuzz
