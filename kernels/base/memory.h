// Where the elements of a buffer lie, and so which backend's kernels can be given it.
#pragma once

#include <cstdint>

namespace lakshya {

enum class Memory : std::uint8_t {
  host,    // the processor's own
  device,  // an accelerator's: its kernels reach it, a pointer into it means nothing to the processor
};

}  // namespace lakshya
