// What libFuzzer calls, the same for every target. LAKSHYA_FUZZ_SEEDS names the folder that gets the seeds.
#include <cstdio>
#include <cstdlib>

#include "app/core/file_bytes.h"
#include "app/core/input_error.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {
namespace {

void write_seeds(const std::string& folder) {
  int number = 0;
  for (const std::string& seed : seeds()) {
    read(bytes_of(seed));
    write_file_atomically(folder + "/seed-" + std::to_string(number++), seed);
  }
}

}  // namespace
}  // namespace lakshya::fuzz

// NOLINTBEGIN(readability-identifier-naming): the names are libFuzzer's.
extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  const char* folder = std::getenv("LAKSHYA_FUZZ_SEEDS");
  if (folder == nullptr) return 0;
  try {
    lakshya::fuzz::write_seeds(folder);
  } catch (const lakshya::InputError& e) {
    std::fprintf(stderr, "a seed is refused, or cannot be written: %s\n", e.what());
    std::exit(1);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    lakshya::fuzz::read({data, size});
  } catch (const lakshya::InputError&) {  // how a reader refuses
    return 0;
  }
  return 0;
}
// NOLINTEND(readability-identifier-naming)
