// The kernel's own calls, with faults that a test switches on; ioctls are answered by the test.
#pragma once

#include <cerrno>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "hal/linux/system_calls.h"

namespace lakshya {

class FaultySystem final : public SystemCalls {
 public:
  int open(const char* path, int flags) override {
    if (unplugged) return -ENOENT;
    const int fd = linux_system_calls().open(path, flags);
    if (fd >= 0) paths_[fd] = path;
    return fd;
  }
  int close(int fd) override {
    paths_.erase(fd);
    return linux_system_calls().close(fd);
  }
  int ioctl(int /*fd*/, unsigned long request, void* argument) override {
    if (unplugged) return -ENODEV;
    return on_ioctl ? on_ioctl(request, argument) : -ENOTTY;
  }
  void* mmap(int fd, std::size_t bytes, std::int64_t offset) override {
    return linux_system_calls().mmap(fd, bytes, offset);
  }
  void munmap(void* memory, std::size_t bytes) override { linux_system_calls().munmap(memory, bytes); }
  long read_at_start(int fd, std::span<char> buffer) override {
    if (unplugged) return -ENODEV;
    return linux_system_calls().read_at_start(fd, buffer);
  }
  long write_at_start(int fd, std::span<const char> bytes) override {
    if (unplugged) return -ENODEV;
    if (write_error != 0 && paths_[fd].find(write_error_at) != std::string::npos && write_errors_left-- > 0)
      return -write_error;
    writes.push_back(paths_[fd].substr(paths_[fd].rfind('/') + 1) + "=" + std::string(bytes.begin(), bytes.end()));
    return linux_system_calls().write_at_start(fd, bytes);
  }

  // Files still open.
  std::size_t open_files() const { return paths_.size(); }

  bool unplugged = false;
  int write_error = 0;         // of the next `write_errors_left` writes to files whose paths contain
  std::string write_error_at;  // this
  int write_errors_left = 1'000'000;
  std::function<int(unsigned long request, void* argument)> on_ioctl;
  std::vector<std::string> writes;  // "file name=text", in order

 private:
  std::map<int, std::string> paths_;
};

}  // namespace lakshya
