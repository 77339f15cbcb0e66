// Whether this test runs on an emulated processor (./dev cross), which keeps no promise about time.
#pragma once

#include <cstdlib>

namespace lakshya {

inline bool is_emulated() {
  return std::getenv("LAKSHYA_EMULATED") != nullptr;
}

}  // namespace lakshya
