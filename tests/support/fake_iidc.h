// A camera on IEEE 1394 that is not there: frames at times of a ManualClock.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/camera/iidc_camera.h"
#include "tests/support/manual_clock.h"

namespace lakshya::test {

class FakeIidc final : public IidcCamera {
 public:
  struct Due {
    Nanoseconds time = 0;
    IidcFrame frame;
  };

  explicit FakeIidc(ManualClock& clock) : clock_(&clock) {
    // The next frame, wherever it lies: a deadline before it is for the test to avoid.
    clock.ready = [this](int fd, Ready) {
      if (fd != kFd) return false;
      if (always_ready || gone()) return true;
      if (next_ >= frames.size()) return false;
      clock_->sleep_until(frames[next_].time);
      return true;
    };
  }

  Status start(const IidcRequest& asked, Problem& problem) override {
    request = asked;
    if (gone()) {
      problem.set("fake: no camera");
      return Status::disconnected;
    }
    if (answer != Status::ok) problem.set("fake: %s", to_string(answer));
    running = answer == Status::ok;
    if (running) ++started;
    return answer;
  }
  void stop() override {
    running = false;
    ++stopped;
  }
  int fd() const override { return running ? kFd : -1; }
  Status fetch(IidcFrame& frame) override {
    if (!running || gone()) return Status::disconnected;
    const bool waits = next_ < frames.size() && frames[next_].time <= clock_->now();
    clock_->advance(fetch_takes);
    if (!waits) return Status::timeout;
    frame = frames[next_++].frame;
    return Status::ok;
  }

  std::vector<Due> frames;  // in order of time
  Nanoseconds unplugged_at = INT64_MAX;
  Nanoseconds plugged_at = INT64_MAX;  // again
  Status answer = Status::ok;
  bool always_ready = false;
  Nanoseconds fetch_takes = 0;  // a frame's age is as of its end
  IidcRequest request;
  bool running = false;
  int started = 0;
  int stopped = 0;

 private:
  static constexpr int kFd = 7;
  bool gone() const { return clock_->now() >= unplugged_at && clock_->now() < plugged_at; }

  ManualClock* clock_;
  std::size_t next_ = 0;
};

}  // namespace lakshya::test
