#include "app/loop/threaded_run.h"

#include <omp.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <exception>
#include <iterator>
#include <optional>

#include "app/core/input_error.h"
#include "app/loop/memory_watch.h"
#include "app/loop/real_time.h"

namespace lakshya {
namespace {

constexpr Nanoseconds kWait = 50 * kMillisecond;  // of threads that have nothing to do
constexpr Nanoseconds kLongestStart = 30 * kSecond;
constexpr Nanoseconds kPause = 5 * kMillisecond;  // before a device that fails at once is asked again

// A file descriptor that is closed again.
class Descriptor {
 public:
  Descriptor(int fd, const char* what) : fd_(fd) {
    if (fd < 0) throw InputError(what, "the system gives no descriptor");
  }
  ~Descriptor() { (void)::close(fd_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

// Wakes one thread that waits; how often it was rung meanwhile does not matter.
class Bell {
 public:
  void ring() const {
    const std::uint64_t one = 1;
    (void)!::write(fd_.get(), &one, sizeof one);
  }
  void wait(Clock& clock, Nanoseconds deadline) const {
    if (clock.wait_for(fd_.get(), Ready::to_read, deadline) != Status::ok) return;
    std::uint64_t rings = 0;
    (void)!::read(fd_.get(), &rings, sizeof rings);
  }

 private:
  Descriptor fd_{eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC), "eventfd"};
};

// The signals come to one descriptor, and to no thread.
class Signals {
 public:
  Signals() : fd_(make(), "signals") {}
  // Those that have come since are forgotten: they asked for the end that has come.
  ~Signals() {
    signalfd_siginfo info{};
    while (::read(fd_.get(), &info, sizeof info) == sizeof info) {
    }
    (void)pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  // Waits for one until `deadline`; 0: none came.
  int wait(Clock& clock, Nanoseconds deadline) const {
    if (clock.wait_for(fd_.get(), Ready::to_read, deadline) != Status::ok) return 0;
    signalfd_siginfo info{};
    return ::read(fd_.get(), &info, sizeof info) == sizeof info ? static_cast<int>(info.ssi_signo) : 0;
  }

 private:
  int make() {
    sigset_t wanted;
    sigemptyset(&wanted);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1})
      sigaddset(&wanted, signal);
    (void)pthread_sigmask(SIG_BLOCK, &wanted, &before_);
    return signalfd(-1, &wanted, SFD_NONBLOCK | SFD_CLOEXEC);
  }

  sigset_t before_{};
  Descriptor fd_;
};

class ThreadedRun {
 public:
  ThreadedRun(Machinery& machinery, Clock& clock, const RunLimits& limits, const ThreadedHooks& hooks)
      : m_(&machinery), x_(&machinery.exchange()), clock_(&clock), limits_(limits), hooks_(&hooks) {}

  void run() {
    const Signals signals;
    signals_ = &signals;
    start();
    while (!x_->ended.load(std::memory_order_acquire)) {
      clock_->sleep_until(clock_->now() + kWait);
      warn_of_priorities();
      if (wants_reset_.exchange(false)) {
        if (hooks_->before_reset) hooks_->before_reset();
        x_->reset.store(true);
      }
      keep_house();
    }
    for (std::optional<Thread>& thread : threads_)
      thread.reset();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  // All threads or none.
  void start() {
    struct Work {
      const char* name;
      int priority;
      void (ThreadedRun::*work)();
    };
    constexpr Work kWork[] = {{"perception", kOrdinary, &ThreadedRun::perceive},
                              {"capture", kCapturePriority, &ThreadedRun::capture_all},
                              {"sensing", kSensingPriority, &ThreadedRun::sense_all},
                              {"driving", kDrivingPriority, &ThreadedRun::drive_all},
                              {"control", kControlPriority, &ThreadedRun::control_all},
                              {"supervisor", kSupervisorPriority, &ThreadedRun::supervise}};
    static_assert(std::size(kWork) == kThreads);
    try {
      for (std::size_t i = 0; i < kThreads; ++i) {
        const Work& w = kWork[i];
        threads_[i].emplace(w.name, w.priority, [this, work = w.work] { (this->*work)(); });
      }
    } catch (...) {
      x_->ended.store(true, std::memory_order_release);
      throw;
    }
  }

  void warn_of_priorities() {
    const auto lacks = [](const std::optional<Thread>& thread) { return thread && !thread->has_priority(); };
    if (warned_ || std::ranges::none_of(threads_, lacks)) return;
    spdlog::warn(
        "no real-time priority (SCHED_FIFO): control turns may come late when the machine is busy (run as a "
        "service, or "
        "with CAP_SYS_NICE or LimitRTPRIO)");
    warned_ = true;
  }

  // What fails here must not leave the wheels turning: the run ends in order first.
  void keep_house() {
    if (failure_) return;
    try {
      hooks_->housekeeping();
    } catch (...) {
      failure_ = std::current_exception();
      x_->terminate.store(true);
    }
  }

  // Signals and watchdogs, in a thread that never waits for a disk or a terminal.
  void supervise() {
    begun_ = clock_->now();
    while (!x_->ended.load(std::memory_order_acquire)) {
      const int signal = signals_->wait(*clock_, clock_->now() + kWait);
      if (signal == SIGUSR1) {
        wants_reset_.store(true);
      } else if (signal != 0) {
        x_->terminate.store(true);
      }
      kick_watchdogs();
      end_with_the_recording();
    }
  }

  void wait_until_warm() {
    while (!warm_.load(std::memory_order_acquire) && !x_->ended.load(std::memory_order_acquire))
      clock_->sleep_until(clock_->now() + kMillisecond);
  }

  Status capture_one(WatchedPlace place) {
    const MemoryWatch watch(place);
    return m_->capture().step(clock_->now() + kWait);
  }

  void capture_all() {
    const WatchedPlace place = m_->capture_decodes() ? WatchedPlace::decoding : WatchedPlace::loop;
    wait_until_warm();  // which writes into the memory of the pairs
    std::uint64_t damaged = 0;
    while (!x_->ended.load(std::memory_order_acquire)) {
      const Status status = capture_one(place);
      if (status == Status::ok) new_pair_.ring();
      damaged = status == Status::bad_data ? damaged + 1 : 0;
      if (status == Status::end_of_data || (limits_.damaged > 0 && damaged >= limits_.damaged)) {
        over_.store(true, std::memory_order_release);
        return;
      }
      if (status != Status::ok && status != Status::timeout) clock_->sleep_until(clock_->now() + kPause);
    }
  }

  bool perceive_one() {
    const MemoryWatch watch(WatchedPlace::loop);
    PlanNote plan;
    if (!m_->perception().step(plan)) return false;
    m_->perception().publish(plan);
    return true;
  }

  void perceive() {
    if (m_->config().loop.threads > 0) omp_set_num_threads(m_->config().loop.threads);
    m_->perception().warm_up();
    warm_.store(true, std::memory_order_release);
    while (!x_->ended.load(std::memory_order_acquire)) {
      new_pair_.wait(*clock_, clock_->now() + kWait);
      while (!enough_.load(std::memory_order_relaxed) && perceive_one()) {
        if (limits_.frames > 0 && m_->perception().frames() >= limits_.frames)
          enough_.store(true, std::memory_order_release);
      }
    }
  }

  Status sense_one() {
    const MemoryWatch watch(WatchedPlace::loop);
    return m_->sensing()->step(clock_->now() + kWait);
  }

  void sense_all() {
    wait_until_warm();  // old headings would be the first
    while (m_->sensing() != nullptr && !x_->ended.load(std::memory_order_acquire)) {
      const Status status = sense_one();
      if (status != Status::ok && status != Status::timeout) clock_->sleep_until(clock_->now() + kPause);
    }
  }

  bool drive_one() {
    const MemoryWatch watch(WatchedPlace::loop);
    m_->driving().step();
    return !x_->ended.load(std::memory_order_acquire);
  }

  // As often as control commands, or as the drives' line can.
  void drive_all() {
    do {
      new_command_.wait(*clock_, clock_->now() + kWait);
    } while (drive_one());
  }

  bool turn(Nanoseconds due) {
    const MemoryWatch watch(WatchedPlace::loop);
    const bool goes_on = m_->control().turn(due);
    new_command_.ring();
    return goes_on;
  }

  void control_all() {
    wait_until_warm();
    Nanoseconds due = clock_->now();
    while (turn(due)) {
      turns_.fetch_add(1, std::memory_order_release);
      if (!memory_watch_armed() && has_been_ready(m_->control().state())) arm_memory_watch();
      due = next_turn(due, clock_->now());
      clock_->sleep_until(due);
    }
    disarm_memory_watch();
  }

  // As long as control turns; before its first turn for as long as a start may take.
  void kick_watchdogs() {
    const std::uint64_t turns = turns_.load(std::memory_order_acquire);
    const bool starts = turns == 0 && clock_->now() - begun_ < kLongestStart;
    if (turns == kicked_at_ && !starts) return;  // it hangs: let them act
    kicked_at_ = turns;
    bool well = true;
    for (Watchdog* watchdog : hooks_->watchdogs)
      well = watchdog->kick() == Status::ok && well;
    x_->watchdog_failed.store(!well, std::memory_order_release);
  }

  // The plan of the last pair must have reached control, and control had a turn with it.
  void end_with_the_recording() {
    const bool idle =
        over_.load(std::memory_order_acquire) && x_->working_since.load(std::memory_order_acquire) == 0;
    if (!idle && !enough_.load(std::memory_order_acquire)) {
      idle_turns_ = turns_.load();
      return;
    }
    if (turns_.load() > idle_turns_ + 5) x_->terminate.store(true);
  }

  Machinery* m_;
  Exchange* x_;
  Clock* clock_;
  const RunLimits limits_;
  const ThreadedHooks* hooks_;
  const Bell new_pair_;
  const Bell new_command_;
  std::atomic<bool> over_ = false;    // the recording
  std::atomic<bool> enough_ = false;  // frames
  std::atomic<bool> warm_ = false;
  std::atomic<std::uint64_t> turns_ = 0;
  static constexpr std::size_t kThreads = 6;
  std::array<std::optional<Thread>, kThreads> threads_;
  const Signals* signals_ = nullptr;
  Nanoseconds begun_ = 0;  // the supervisor's
  std::atomic<bool> wants_reset_ = false;
  bool warned_ = false;
  std::exception_ptr failure_;
  std::uint64_t kicked_at_ = 0;
  std::uint64_t idle_turns_ = 0;
};

}  // namespace

void run_threaded(Machinery& machinery, Clock& clock, const RunLimits& limits, const ThreadedHooks& hooks) {
  ThreadedRun(machinery, clock, limits, hooks).run();
}

}  // namespace lakshya
