// Time for everything that waits or stamps. A test or a simulator brings its own clock.
#pragma once

#include <cstdint>

#include "kernels/base/status.h"

namespace lakshya {

// Nanoseconds since an arbitrary start; never steps back, not affected by setting the date.
using Nanoseconds = std::int64_t;

inline constexpr Nanoseconds kMillisecond = 1'000'000;
inline constexpr Nanoseconds kSecond = 1'000'000'000;

enum class Ready : std::uint8_t { to_read, to_write };

// Its two waits are the only ones in this project, and both end.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual Nanoseconds now() const = 0;
  // Returns at `deadline`, at once when it has passed.
  virtual void sleep_until(Nanoseconds deadline) = 0;
  // ok: a read (or write) of this file descriptor has something to tell at once, be it an error; timeout: `deadline` has come
  // and it has not; bad_argument: it is no open file descriptor.
  virtual Status wait_for(int fd, Ready what, Nanoseconds deadline) = 0;
};

}  // namespace lakshya
