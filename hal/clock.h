// Time for everything that waits or stamps. A test or a simulator brings its own clock.
#pragma once

#include <cstdint>

namespace lakshya {

// Nanoseconds since an arbitrary start; never steps back, not affected by setting the date.
using Nanoseconds = std::int64_t;

class Clock {
 public:
  virtual ~Clock() = default;
  virtual Nanoseconds now() const = 0;
  // Returns at `deadline`, at once when it has passed. The only way to wait in this project.
  virtual void sleep_until(Nanoseconds deadline) = 0;
};

}  // namespace lakshya
