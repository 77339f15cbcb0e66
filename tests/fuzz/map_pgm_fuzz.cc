#include "app/tools/map_file.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  parse_map("fuzz", "P" + text_of(bytes), 0.1);
}

std::vector<std::string> seeds() {
  return {"2 3 2 255 0 254 205 0 0 0", "5\n2 1\n255\n\xfe\xcd"};
}

}  // namespace lakshya::fuzz
