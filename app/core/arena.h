// The one block of memory that the frame loop lives in: sized and taken at start, never grown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>

#include "kernels/base/image_view.h"
#include "kernels/base/memory.h"

namespace lakshya {

// A bump allocator. Build a user's layout function twice: once with a measuring arena (default constructed: hands
// out null pointers and adds up), once with a real one of the measured size.
class Arena {
 public:
  static constexpr std::size_t kAlignment = 64;  // a cache line, and any vector register

  Arena() = default;
  explicit Arena(std::size_t bytes)
      : block_(static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kAlignment}))),
        first_(block_.get()),
        capacity_(bytes) {}

  // A part of this arena for a user that wants one of its own: it ends with the user, the memory stays this arena's.
  // Of a measuring arena: the bytes are counted here, and the part measures.
  Arena part(std::size_t bytes) {
    Arena result;
    const std::span<std::byte> memory = take<std::byte>(bytes);
    result.first_ = memory.data();
    result.capacity_ = memory.size();
    return result;
  }

  // Zeroed elements, aligned to kAlignment. A real arena that is too small throws std::bad_alloc: a layout that
  // takes more than it measured is a programming error, found at start.
  template <class T>
  std::span<T> take(std::size_t count) {
    const std::size_t bytes = (count * sizeof(T) + kAlignment - 1) / kAlignment * kAlignment;
    const std::size_t begin = used_;
    used_ += bytes;
    if (first_ == nullptr) return {};
    if (used_ > capacity_) throw std::bad_alloc();
    T* first = reinterpret_cast<T*>(first_ + begin);
    std::uninitialized_value_construct_n(first, count);
    return {first, count};
  }

  template <class T>
  ImageView<T> take_image(int width, int height) {
    const auto pixels = take<T>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    return {pixels.data(), width, height};
  }

  std::size_t used() const { return used_; }
  bool measures() const { return first_ == nullptr; }

  // Where everything taken from this arena lies.
  static constexpr Memory memory() { return Memory::host; }

 private:
  struct Release {
    void operator()(std::byte* p) const { ::operator delete (p, std::align_val_t{kAlignment}); }
  };
  std::unique_ptr<std::byte, Release> block_;  // null in a part
  std::byte* first_ = nullptr;
  std::size_t capacity_ = 0;
  std::size_t used_ = 0;
};

}  // namespace lakshya
