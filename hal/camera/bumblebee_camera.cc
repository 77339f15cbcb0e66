#include "hal/camera/bumblebee_camera.h"

#include <algorithm>

namespace lakshya {
namespace {

constexpr Nanoseconds kOldest = 10 * kSecond;  // an age above that is a clock that was set
constexpr int kLeastSide = 16;
constexpr int kMostSide = 4096;
constexpr int kLeastBuffers = 2;
constexpr int kMostBuffers = 32;
constexpr int kMostFalseAlarms = 3;

}  // namespace

BumblebeeCamera::BumblebeeCamera(const BumblebeeSettings& settings, IidcCamera& bus, Clock& clock)
    : settings_(settings), bus_(&bus), clock_(&clock) {}

BumblebeeCamera::~BumblebeeCamera() {
  BumblebeeCamera::close();
}

std::span<const Counter> BumblebeeCamera::counters() const {
  const EyeCheck::Counters& e = eyes_.counters();
  shown_ = {disconnections_, dropped_, torn_, short_, unstamped_, e.corrected, e.unsure};
  return shown_;
}

Status BumblebeeCamera::open() {
  close();
  problem_.clear();
  const BumblebeeSettings& s = settings_;
  const auto in_range = [](int value, int least, int most) { return value >= least && value <= most; };
  if (!in_range(s.width, kLeastSide, kMostSide) || !in_range(s.height, kLeastSide, kMostSide) || s.width % 2 != 0 ||
      s.height % 2 != 0 || s.packet_bytes < 0 || !in_range(s.buffers, kLeastBuffers, kMostBuffers)) {
    problem_.set("bumblebee: %d x %d, packets of %d bytes, %d buffers: no such setting", s.width, s.height,
                 s.packet_bytes, s.buffers);
    return Status::bad_argument;
  }
  eyes_.open(s.check_eyes);
  memory_.assign(std::size_t{4} * static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height), 0);
  const Status status = bus_->start({s.guid, s.width, s.height, s.packet_bytes, s.buffers}, problem_);
  wanted_ = running_ = status == Status::ok;
  return status;
}

void BumblebeeCamera::close() {
  if (running_) bus_->stop();
  wanted_ = running_ = false;
}

Status BumblebeeCamera::look_again(Nanoseconds deadline) {
  if (running_) return Status::ok;
  if (!wanted_) {
    problem_.set("bumblebee: is not open");
    return Status::disconnected;
  }
  if (!retry_.wait(*clock_, deadline)) return Status::disconnected;
  const BumblebeeSettings& s = settings_;
  running_ = bus_->start({s.guid, s.width, s.height, s.packet_bytes, s.buffers}, problem_) == Status::ok;
  return running_ ? Status::ok : Status::disconnected;
}

// Fetches until nothing waits; raw_ is the last one. No more than twice the buffers: a camera cannot be faster for long.
Status BumblebeeCamera::newest(Nanoseconds deadline) {
  int found = 0;
  for (int alarms = 0; found == 0;) {
    Status status = Status::ok;
    while (status == Status::ok && found < 2 * settings_.buffers) {
      status = bus_->fetch(raw_);
      if (status != Status::ok) break;
      fetched_ = clock_->now();
      ++found;
    }
    if (status != Status::ok && status != Status::timeout) {
      ++disconnections_.value;
      problem_.set("bumblebee: gone");
      bus_->stop();
      running_ = false;
      return Status::disconnected;
    }
    if (found > 0) break;
    // A descriptor that is always ready must not keep the processor busy until the deadline.
    if (++alarms > kMostFalseAlarms) clock_->sleep_until(std::min(deadline, clock_->now() + kMillisecond));
    if (alarms > 1 && clock_->now() >= deadline) return Status::timeout;
    const Status waited = clock_->wait_for(bus_->fd(), Ready::to_read, deadline);
    if (waited != Status::ok) return waited;
  }
  sequence_ += static_cast<std::uint64_t>(found);
  dropped_.value += static_cast<std::uint64_t>(found - 1);
  return Status::ok;
}

Status BumblebeeCamera::make_views(StereoFrame& frame) {
  const int w = settings_.width;
  const int h = settings_.height;
  const auto image = [&](int index) {
    return ImageView<std::uint8_t>(memory_.data() + static_cast<std::ptrdiff_t>(index) * w * h, w, h);
  };
  if (raw_.torn) {
    ++torn_.value;
    problem_.set("bumblebee: a torn frame");
    return Status::bad_data;
  }
  if (raw_.width != w || raw_.height != h ||
      split_bytes(raw_.bytes, raw_.bytes_per_line, image(0), image(1)) != Status::ok) {
    ++short_.value;
    problem_.set("bumblebee: a frame of %d x %d with %zu bytes", raw_.width, raw_.height, raw_.bytes.size());
    return Status::bad_data;
  }
  const bool grey = settings_.pattern == BayerPattern::none;
  for (int i = 0; i < 2 && !grey; ++i) {
    const Status status = grey_of_bayer(image(i), settings_.pattern, image(2 + i));
    if (status != Status::ok) return status;
  }
  const ImageView<const std::uint8_t> eyes[2] = {image(grey ? 0 : 2), image(grey ? 1 : 3)};
  const int left = settings_.first_is_left ? 0 : 1;
  eyes_.look(eyes[left], eyes[1 - left], "bumblebee", problem_);
  const int first = eyes_.swapped() ? 1 - left : left;
  const bool known = raw_.age >= 0 && raw_.age <= kOldest;
  if (!known) ++unstamped_.value;
  const Nanoseconds time = fetched_ - (known ? raw_.age : 0);
  frame = {eyes[first], eyes[1 - first], time, time, sequence_};
  return Status::ok;
}

Status BumblebeeCamera::capture(Nanoseconds deadline, StereoFrame& frame) {
  Status status = look_again(deadline);
  if (status == Status::ok) status = newest(deadline);
  return status == Status::ok ? make_views(frame) : status;
}

}  // namespace lakshya
