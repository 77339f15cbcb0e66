// A camera of a made-up world: a producer draws the pair that is due, at a fixed frame rate of the clock given.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/camera.h"

namespace lakshya {

class FrameProducer {
 public:
  virtual ~FrameProducer() = default;
  // Draws what both eyes see at `time` into every pixel of `left` and `right`. `number` counts the frame times from 0 when the
  // camera was opened; those that nobody fetched are not asked for. Anything but ok becomes capture()'s answer.
  virtual Status produce(Nanoseconds time, std::uint64_t number, ImageView<std::uint8_t> left,
                         ImageView<std::uint8_t> right) = 0;
};

struct SimCameraSettings {
  int width = 640;  // px of one eye, 1..16384
  int height = 480;
  double fps = 20;  // frames a second, 0.1..1000
};

class SimCamera final : public StereoCamera {
 public:
  // `producer` and `clock` outlive the camera.
  SimCamera(const SimCameraSettings& settings, FrameProducer& producer, Clock& clock);

  // bad_argument: settings outside their ranges. The first frame is due at once.
  Status open() override;
  void close() override;
  std::span<const Counter> counters() const override { return counters_; }

  int width() const override { return settings_.width; }
  int height() const override { return settings_.height; }

  // The newest pair that is due and was not given; those before it are counted as dropped. Drawing may take longer than the
  // deadline.
  Status capture(Nanoseconds deadline, StereoFrame& frame) override;

 private:
  const SimCameraSettings settings_;
  FrameProducer* producer_;
  Clock* clock_;
  Nanoseconds period_ = 0;
  Nanoseconds start_ = 0;
  std::uint64_t next_ = 0;  // number of the first frame that was not given
  bool open_ = false;
  std::vector<std::uint8_t> pixels_;  // of both eyes, one after the other
  Counter counters_[2] = {{"dropped_frames"}, {"failed_frames"}};
};

}  // namespace lakshya
