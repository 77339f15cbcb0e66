#include "app/core/vehicle_config_file.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  parse_vehicle_config(text_of(bytes), "fuzz", "", {});
}

std::vector<std::string> seeds() {
  return {
      "profile: hall\ncamera:\n  height_m: 0.45  # a comment\n  pitch_deg: -1e0\nmatcher: {name: sgm, paths: 5}\n"
      "profiles:\n  hall: &hall\n    prune: {max_depth_m: 12.0}\n  hall-2: *hall\n",
      "%YAML 1.2\n---\nplanner:\n  unknown: \"slow\"\n  name: 'vfh'\n..."};
}

}  // namespace lakshya::fuzz
