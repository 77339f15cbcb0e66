#include "hal/linux/system_calls.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

namespace lakshya {
namespace {

constexpr mode_t kNewFileMode = 0644;

template <class Call>
auto retried(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR)
    result = call();
  return result < 0 ? -errno : result;
}

class LinuxSystemCalls final : public SystemCalls {
 public:
  int open(const char* path, int flags) override {
    return retried([&] { return ::open(path, flags | O_NONBLOCK | O_CLOEXEC, kNewFileMode); });
  }
  int close(int fd) override {
    return ::close(fd) < 0 ? -errno : 0;
  }  // not retried: the descriptor is gone either way
  int ioctl(int fd, unsigned long request, void* argument) override {
    return retried([&] { return ::ioctl(fd, request, argument); });
  }
  void* mmap(int fd, std::size_t bytes, std::int64_t offset) override {
    void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, offset);
    return memory == MAP_FAILED ? nullptr : memory;
  }
  void munmap(void* memory, std::size_t bytes) override { (void)::munmap(memory, bytes); }
  long read_at_start(int fd, std::span<char> buffer) override {
    return retried([&] { return ::pread(fd, buffer.data(), buffer.size(), 0); });
  }
  long write_at_start(int fd, std::span<const char> bytes) override {
    return retried([&] { return ::pwrite(fd, bytes.data(), bytes.size(), 0); });
  }
};

}  // namespace

SystemCalls& linux_system_calls() {
  static LinuxSystemCalls calls;
  return calls;
}

}  // namespace lakshya
