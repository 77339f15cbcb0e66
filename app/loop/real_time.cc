#include "app/loop/real_time.h"

#include <alloca.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "app/core/input_error.h"

namespace lakshya {
namespace {

// Of the 256 kB some are the C library's.
constexpr std::size_t kTouchedBytes = kThreadStackBytes * 3 / 4;

[[gnu::noinline]] void touch_stack() {
  auto* bytes = static_cast<volatile char*>(alloca(kTouchedBytes));
  for (std::size_t i = 0; i < kTouchedBytes; i += 1024)
    bytes[i] = 0;
}

}  // namespace

void require_openmp_settings(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr && std::getenv("OMP_STACKSIZE") != nullptr) return;
  (void)setenv("OMP_WAIT_POLICY", "passive", 0);
  (void)setenv("OMP_STACKSIZE", "256", 0);  // kB
  (void)execv("/proc/self/exe", argv);
}

std::string lock_memory() {
  // With MCL_FUTURE an allocation beyond the limit fails, in the middle of the drive.
  rlimit limit{};
  const bool unlimited =
      geteuid() == 0 || (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
  if (mlockall(unlimited ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) == 0) return {};
  return std::strerror(errno);
}

Thread::Thread(const char* name, int priority, std::function<void()> body)
    : name_(name), priority_(priority), body_(std::move(body)) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kThreadStackBytes);
  const int error = pthread_create(&thread_, &attributes, start, this);
  pthread_attr_destroy(&attributes);
  if (error != 0) throw InputError(name, std::string("no thread: ") + std::strerror(error));
  running_ = true;
}

void* Thread::start(void* self) {
  auto* thread = static_cast<Thread*>(self);
  pthread_setname_np(pthread_self(), thread->name_);
  if (thread->priority_ > 0) {
    const sched_param wanted{.sched_priority = thread->priority_};
    thread->has_priority_ = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted) == 0;
  }
  touch_stack();
  thread->body_();
  return nullptr;
}

void Thread::join() {
  if (running_) pthread_join(thread_, nullptr);
  running_ = false;
}

std::uint64_t page_faults_of_thread() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return static_cast<std::uint64_t>(usage.ru_minflt) + static_cast<std::uint64_t>(usage.ru_majflt);
}

std::uint64_t resident_bytes() {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  unsigned long long pages = 0;
  const int read = std::fscanf(file, "%*u %llu", &pages);
  std::fclose(file);
  return read == 1 ? pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

std::uint64_t most_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace lakshya
