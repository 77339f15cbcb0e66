#include "hal/camera/sim_camera.h"

#include <algorithm>
#include <cmath>

namespace lakshya {
namespace {

constexpr int kMostSide = 16384;
constexpr double kLeastFps = 0.1;
constexpr double kMostFps = 1000;

}  // namespace

SimCamera::SimCamera(const SimCameraSettings& settings, FrameProducer& producer, Clock& clock)
    : settings_(settings), producer_(&producer), clock_(&clock) {}

Status SimCamera::open() {
  close();
  const SimCameraSettings& s = settings_;
  const bool size = s.width >= 1 && s.width <= kMostSide && s.height >= 1 && s.height <= kMostSide;
  if (!size || !(s.fps >= kLeastFps && s.fps <= kMostFps)) {
    problem_.set("simulated camera: %d x %d at %g frames a second: no such setting", s.width, s.height, s.fps);
    return Status::bad_argument;
  }
  pixels_.assign(std::size_t{2} * static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height), 0);
  period_ = std::llround(static_cast<double>(kSecond) / s.fps);
  start_ = clock_->now();
  next_ = 0;
  open_ = true;
  return Status::ok;
}

void SimCamera::close() {
  open_ = false;
}

Status SimCamera::capture(Nanoseconds deadline, StereoFrame& frame) {
  if (!open_) {
    problem_.set("simulated camera: is not open");
    return Status::disconnected;
  }
  const Nanoseconds due = start_ + static_cast<Nanoseconds>(next_) * period_;
  clock_->sleep_until(std::min(due, std::max(deadline, clock_->now())));
  if (clock_->now() < due) return Status::timeout;
  const auto number = static_cast<std::uint64_t>((clock_->now() - start_) / period_);
  counters_[0].value += number - next_;
  next_ = number + 1;

  const Nanoseconds time = start_ + static_cast<Nanoseconds>(number) * period_;
  const int w = settings_.width;
  const int h = settings_.height;
  const ImageView<std::uint8_t> left(pixels_.data(), w, h);
  const ImageView<std::uint8_t> right(left.row(h), w, h);
  const Status status = producer_->produce(time, number, left, right);
  if (status != Status::ok) {
    ++counters_[1].value;
    problem_.set("simulated camera: frame %llu: %s", static_cast<unsigned long long>(number), to_string(status));
    return status;
  }
  frame = {left, right, time, time, number};
  return Status::ok;
}

}  // namespace lakshya
