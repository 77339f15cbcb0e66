#include "app/core/way_point_file.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  (void)parse_way_points(text_of(bytes), "fuzz");
}

std::vector<std::string> seeds() {
  return {"east_m,north_m\n3,0\n# turn\n-1.5,4e1\n", "latitude_deg,longitude_deg\n45,7\n45.001,7.5\n"};
}

}  // namespace lakshya::fuzz
