// How much this core can do, for comparison with what the kernels do (docs/performance.md): not called in the frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lakshya {

// Both on the instruction set in use (isa.h). The digest is there so that the work cannot be left out.
struct PeakWork {
  std::uint64_t count = 0;  // operations on one byte, or bytes
  std::uint8_t digest = 0;
};

// Minima and saturated additions of bytes in registers, in turns: what matching consists of. `rounds` times the same.
PeakWork peak_operations_simd(std::int64_t rounds);

// Reads every byte once, in order.
PeakWork peak_read_simd(std::span<const std::uint8_t> bytes);

}  // namespace lakshya
