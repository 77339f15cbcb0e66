// Hand-over of the newest value from one thread to one other: neither ever waits, an older value is lost.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace lakshya {

// Three slots: the writer has one, the reader has one, the third lies between them and is exchanged for either's.
template <class T>
class TripleBuffer {
 public:
  // At the start only: each slot, to give it memory of its own.
  std::array<T, 3>& slots() { return slots_; }

  // The writer's slot, to be filled.
  T& writing() { return slots_[writer_]; }
  // Gives it to the reader. False: the value before was never read.
  bool publish() {
    const std::uint8_t before =
        between_.exchange(static_cast<std::uint8_t>(writer_ | kNew), std::memory_order_acq_rel);
    writer_ = before & kIndex;
    return (before & kNew) == 0;
  }

  // The writer's: what was published last has not been taken yet.
  bool is_unread() const { return has_new(); }

  // The reader's: there is a newer value than reading().
  bool has_new() const { return (between_.load(std::memory_order_acquire) & kNew) != 0; }
  // True: reading() is a newer value than before.
  bool take() {
    if ((between_.load(std::memory_order_relaxed) & kNew) == 0) return false;
    reader_ = between_.exchange(static_cast<std::uint8_t>(reader_), std::memory_order_acq_rel) & kIndex;
    return true;
  }
  const T& reading() const { return slots_[reader_]; }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kNew = 4;

  std::array<T, 3> slots_{};
  alignas(64) std::uint8_t writer_ = 0;  // each thread's own, on its own cache line
  alignas(64) std::uint8_t reader_ = 1;
  alignas(64) std::atomic<std::uint8_t> between_ = 2;
};

}  // namespace lakshya
