// The seam that a simulator fills: a compass at a fixed rate of the clock.
#pragma once

#include "hal/compass.h"

namespace lakshya {

class HeadingProducer {
 public:
  virtual ~HeadingProducer() = default;
  // What a compass on the simulated vehicle says at `time`; `sample.time` is set by who asks.
  virtual Status heading(Nanoseconds time, HeadingSample& sample) = 0;
};

class SimCompass final : public Compass {
 public:
  // Both outlive the compass. rate_hz: 0.01 .. 1000
  SimCompass(double rate_hz, HeadingProducer& producer, Clock& clock);

  // The first reading is due at once. bad_argument: a rate out of range.
  Status open() override;
  void close() override { open_ = false; }
  // missed: readings that were over before they were asked for
  std::span<const Counter> counters() const override { return counters_; }

  Status read(Nanoseconds deadline, HeadingSample& sample) override;

 private:
  const double rate_hz_;
  HeadingProducer* producer_;
  Clock* clock_;
  bool open_ = false;
  Nanoseconds period_ = 0;
  Nanoseconds due_ = 0;
  Counter counters_[1] = {{"missed"}};
};

}  // namespace lakshya
