// The rows that a kernel keeps, laid out in its caller's scratch.
#pragma once

#include <cstddef>
#include <span>

namespace lakshya {

inline constexpr std::size_t kScratchAlignment = 64;  // a cache line, and any vector register

// Build a kernel's layout function twice: once without memory (null pointers are handed out and the bytes added
// up: the size that the header states), once on the caller's scratch, which must be aligned to kScratchAlignment
// and at least that large.
class ScratchLayout {
 public:
  explicit ScratchLayout(std::byte* base = nullptr) : base_(base) {}

  // `count` elements, aligned to kScratchAlignment, whatever was in them.
  template <class T>
  std::span<T> take(std::size_t count) {
    const std::size_t begin = used_;
    used_ += (count * sizeof(T) + kScratchAlignment - 1) / kScratchAlignment * kScratchAlignment;
    if (base_ == nullptr) return {};
    return {reinterpret_cast<T*>(base_ + begin), count};
  }

  std::size_t used() const { return used_; }

 private:
  std::byte* base_;
  std::size_t used_ = 0;
};

}  // namespace lakshya
