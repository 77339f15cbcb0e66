#include "hal/compass/sim_compass.h"

#include <cmath>

namespace lakshya {

SimCompass::SimCompass(double rate_hz, HeadingProducer& producer, Clock& clock)
    : rate_hz_(rate_hz), producer_(&producer), clock_(&clock) {}

Status SimCompass::open() {
  open_ = rate_hz_ >= 0.01 && rate_hz_ <= 1000;
  if (!open_) {
    problem_.set("%g readings per second: out of range", rate_hz_);
    return Status::bad_argument;
  }
  period_ = std::llround(static_cast<double>(kSecond) / rate_hz_);
  due_ = clock_->now();
  return Status::ok;
}

Status SimCompass::read(Nanoseconds deadline, HeadingSample& sample) {
  if (!open_) return Status::disconnected;
  if (due_ > deadline) {
    clock_->sleep_until(deadline);
    return Status::timeout;
  }
  clock_->sleep_until(due_);
  const Nanoseconds missed = (clock_->now() - due_) / period_;
  counters_[0].value += static_cast<std::uint64_t>(missed);
  due_ += missed * period_;
  const Nanoseconds time = due_;
  due_ += period_;
  const Status status = producer_->heading(time, sample);
  sample.time = time;
  return status;
}

}  // namespace lakshya
