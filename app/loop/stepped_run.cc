#include "app/loop/stepped_run.h"

#include <algorithm>
#include <cmath>

#include "app/loop/memory_watch.h"
#include "app/loop/ring.h"

namespace lakshya {
namespace {

class SteppedRun {
 public:
  SteppedRun(Machinery& machinery, SteppedClock& clock, const RunLimits& limits)
      : m_(&machinery),
        clock_(&clock),
        limits_(limits),
        latency_(std::llround(machinery.config().loop.virtual_latency_s * static_cast<double>(kSecond))),
        decodes_(machinery.capture_decodes() ? WatchedPlace::decoding : WatchedPlace::loop) {}

  void run(const std::function<void()>& after_turn) {
    Nanoseconds due = clock_->now();
    for (bool goes_on = true; goes_on; due = next_turn(due, clock_->now())) {
      capture_until(due);
      goes_on = control(due);
      if (!memory_watch_armed() && has_been_ready(m_->control().state())) arm_memory_watch();
      after_turn();
    }
  }

 private:
  // All pairs that come until the control turn, each with its plan. Before a turn that is late (drives that did not answer), the
  // pair that has come meanwhile.
  void capture_until(Nanoseconds due) {
    if (!over_ && clock_->now() > due) capture_and_process(clock_->now());
    while (!over_ && clock_->now() < due)
      capture_and_process(due);
    clock_->sleep_until(due);
  }

  void capture_and_process(Nanoseconds deadline) {
    const Status status = capture(deadline);
    damaged_ = status == Status::bad_data ? damaged_ + 1 : 0;
    const bool hopeless = limits_.damaged > 0 && damaged_ >= limits_.damaged;
    if (status == Status::ok) {
      process();
    } else if (status == Status::end_of_data || hopeless) {
      over_ = true;
    } else if (status != Status::timeout) {
      clock_->sleep_until(std::min(deadline, clock_->now() + kMillisecond));  // a camera that fails at once
    }
  }

  Status capture(Nanoseconds due) {
    const MemoryWatch counted(decodes_);
    return m_->capture().step(due);
  }

  void process() {
    const MemoryWatch counted(WatchedPlace::loop);
    PlanNote plan;
    if (!m_->perception().step(plan)) return;
    plan.done = plan.taken + latency_;
    (void)pending_.push(plan);
    if (limits_.frames > 0 && m_->perception().frames() >= limits_.frames) over_ = true;
  }

  bool control(Nanoseconds due) {
    const MemoryWatch counted(WatchedPlace::loop);
    for (PlanNote plan; pending_.front() != nullptr && pending_.front()->done <= due;) {
      (void)pending_.pop(plan);
      m_->perception().publish(plan);
    }
    if (m_->sensing() != nullptr) {
      // As many as the queue takes; a compass that always has one more is its own fault.
      for (int i = 0; i < 64 && m_->sensing()->step(due) == Status::ok; ++i) {
      }
    }
    const bool goes_on = m_->control().turn(due);
    m_->driving().step(due + kControlPeriod);
    // The turn that has taken up the last plan is the last but one.
    if (over_ && pending_.front() == nullptr) m_->exchange().terminate.store(true);
    return goes_on;
  }

  Machinery* m_;
  SteppedClock* clock_;
  const RunLimits limits_;
  const Nanoseconds latency_;
  const WatchedPlace decodes_;
  // Plans that are made and not due yet. The longest latency at the fastest camera is more; those who ask for that lose the newest.
  Ring<PlanNote, 256> pending_;
  std::uint64_t damaged_ = 0;  // captures in a row
  bool over_ = false;
};

}  // namespace

void run_stepped(Machinery& machinery, SteppedClock& clock, const RunLimits& limits,
                 const std::function<void()>& after_turn) {
  machinery.perception().warm_up();
  SteppedRun(machinery, clock, limits).run(after_turn);
}

}  // namespace lakshya
