#include "app/core/image_codecs.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  if (is_pnm(bytes)) decode_pnm_gray("fuzz", bytes);
}

std::vector<std::string> seeds() {
  return {"P2\n# grey\n3 2\n15\n0 1 2\n3 4 15\n", "P3 2 1 255 1 2 3 255 255 255\n", "P5\n3 2\n255\nabcdef",
          "P6 1 2 7\n\1\2\3\4\5\6"};
}

}  // namespace lakshya::fuzz
