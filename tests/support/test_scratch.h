// Scratch for kernels that ask for it: exactly the stated bytes, aligned, so that the sanitizers see an overrun.
#pragma once

#include <cstddef>
#include <new>
#include <span>

#include "kernels/base/scratch.h"

namespace lakshya::test {

class Scratch {
 public:
  explicit Scratch(std::size_t bytes)
      : size_(bytes), data_(static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kScratchAlignment}))) {}
  ~Scratch() { ::operator delete (data_, std::align_val_t{kScratchAlignment}); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::span<std::byte> span() const { return {data_, size_}; }

 private:
  std::size_t size_;
  std::byte* data_;
};

}  // namespace lakshya::test
