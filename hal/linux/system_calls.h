// The calls that drivers of kernel devices make, as a seam: a test answers them from a recording. Each answers as the system
// call of its name, with -errno instead of -1 and errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lakshya {

class SystemCalls {
 public:
  virtual ~SystemCalls() = default;
  // A file descriptor that never blocks (O_NONBLOCK | O_CLOEXEC are added to `flags`).
  virtual int open(const char* path, int flags) = 0;
  virtual int close(int fd) = 0;
  virtual int ioctl(int fd, unsigned long request, void* argument) = 0;
  // Shared, to be read and written. nullptr when it fails.
  virtual void* mmap(int fd, std::size_t bytes, std::int64_t offset) = 0;
  virtual void munmap(void* memory, std::size_t bytes) = 0;
  // From the file's beginning, as the attributes of sysfs want it; the number of bytes.
  virtual long read_at_start(int fd, std::span<char> buffer) = 0;
  virtual long write_at_start(int fd, std::span<const char> bytes) = 0;
};

// The kernel's own.
SystemCalls& linux_system_calls();

}  // namespace lakshya
