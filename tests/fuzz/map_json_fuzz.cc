#include "app/tools/map_file.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/test_grid.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  parse_map("fuzz", "{" + text_of(bytes), 0.1);  // other files are map_pgm's
}

std::vector<std::string> seeds() {
  test::TestGrid grid(2, 3);
  return {write_map_json(grid.view()).substr(1),
          R"("rows":1,"cols":2,"cell_m":0.1,"type":[[0,2]],"more":[{"a":null}]})"};
}

}  // namespace lakshya::fuzz
