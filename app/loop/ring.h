// A queue of fixed length from one thread to one other: neither ever waits; what does not fit is lost and counted.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace lakshya {

template <class T, std::size_t kLength>
class Ring {
 public:
  // The writer.
  bool push(const T& value) {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == kLength) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    values_[end % kLength] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  // The reader: the next value, which stays; null: there is none.
  const T* front() const {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    return begin == end_.load(std::memory_order_acquire) ? nullptr : &values_[begin % kLength];
  }

  // The reader. False: there is none.
  bool pop(T& value) {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    value = values_[begin % kLength];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

 private:
  std::array<T, kLength> values_{};
  alignas(64) std::atomic<std::size_t> begin_ = 0;
  alignas(64) std::atomic<std::size_t> end_ = 0;
  std::atomic<std::uint64_t> lost_ = 0;
};

}  // namespace lakshya
