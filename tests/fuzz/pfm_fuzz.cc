#include "app/core/image_codecs.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {

void read(Bytes bytes) {
  decode_pfm("fuzz", bytes);
}

std::vector<std::string> seeds() {
  return {std::string("Pf\n2 1\n-1.0\n\0\0\200?\0\0\200\177", 20), std::string("Pf 1 1 0.25\n?\200\0\0", 16)};
}

}  // namespace lakshya::fuzz
