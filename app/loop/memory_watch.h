// Counts what the loop must not do once it is READY: allocate, free, and touch memory for the first time. The counting of malloc is
// a program's, not a library's: hook/allocation_hook.cc, which lakshyad and lakshya link.
#pragma once

#include <cstdint>

namespace lakshya {

enum class WatchedPlace : std::uint8_t {
  nowhere,   // not counted
  loop,      // perception, planning, control, raw capture
  decoding,  // of a recording's images, or of a camera's JPEG
};

// While it lives, what this thread does is counted for that place: malloc, calloc, realloc, free, new, delete, and page faults;
// what it does in the scope of a watch inside of it is that one's only.
class MemoryWatch {
 public:
  explicit MemoryWatch(WatchedPlace place);
  ~MemoryWatch();
  MemoryWatch(const MemoryWatch&) = delete;
  MemoryWatch& operator=(const MemoryWatch&) = delete;

 private:
  const WatchedPlace place_;
  const WatchedPlace before_;
  const std::uint64_t faults_of_inner_before_;
  const bool armed_;
  std::uint64_t page_faults_ = 0;
};

// Allocations of this thread, for good: for threads that others made (OpenMP's). Their page faults are not counted.
void watch_this_thread(WatchedPlace place);

// Counting begins, with zero: the loop is READY. It ends: the loop has, and its threads are about to go.
void arm_memory_watch();
void disarm_memory_watch();
bool memory_watch_armed();
bool memory_was_watched();  // it was armed at any time

// Since then. Allocations are always 0 where the hook is not linked (sanitizers have hooks of their own).
std::uint64_t allocations_at(WatchedPlace place);
bool allocations_are_counted();
std::uint64_t page_faults_at(WatchedPlace place);

// The hook's: one call.
void count_one_allocation();

}  // namespace lakshya
