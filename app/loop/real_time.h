// What the main loop asks of the operating system: memory that stays, threads that come first, threads with small stacks.
#pragma once

#include <pthread.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace lakshya {

// Whole megabytes of stack are locked memory that nobody uses.
inline constexpr std::size_t kThreadStackBytes = 256 * 1024;

// SCHED_FIFO's; 0: the ordinary kind. The image processing's threads stay ordinary: the kernel's own threads that carry USB and
// serial bytes are ordinary, too, and a team that takes every processor must not hold them up.
inline constexpr int kOrdinary = 0;
inline constexpr int kSupervisorPriority = 25;
inline constexpr int kCapturePriority = 30;
inline constexpr int kSensingPriority = 32;
inline constexpr int kDrivingPriority = 35;
inline constexpr int kControlPriority = 40;

// OpenMP reads its settings when the program is loaded: threads that wait asleep, not spinning (OMP_WAIT_POLICY), with stacks of
// kThreadStackBytes (OMP_STACKSIZE). Where they are not set, starts the program anew with them; returns where they are, or where
// that fails.
void require_openmp_settings(char** argv);

// All memory of the process stays in RAM; memory that it takes later, too, where no limit could make that fail. Empty: done; else why
// not.
std::string lock_memory();

// A thread with a small stack, which it touches to its end before it begins.
class Thread {
 public:
  // Throws InputError where the system has no thread to give. The body must not throw.
  Thread(const char* name, int priority, std::function<void()> body);
  ~Thread() { join(); }
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;

  void join();
  // Whether it got the priority; known when the body has begun.
  bool has_priority() const { return has_priority_; }

 private:
  static void* start(void* self);

  const char* name_;
  int priority_;
  std::function<void()> body_;
  pthread_t thread_{};
  bool running_ = false;
  std::atomic<bool> has_priority_ = true;
};

// Page faults of the calling thread so far.
std::uint64_t page_faults_of_thread();

// Resident memory of the process, bytes: now, and the most that it ever was.
std::uint64_t resident_bytes();
std::uint64_t most_resident_bytes();

}  // namespace lakshya
