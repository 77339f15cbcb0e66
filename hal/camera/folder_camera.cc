#include "hal/camera/folder_camera.h"

#include <cmath>

namespace lakshya {
namespace {

enum CounterIndex : std::size_t { kMissed, kUnreadable, kDecoded };

std::size_t pixels(const RecordedPairs& pairs) {
  return static_cast<std::size_t>(pairs.width()) * static_cast<std::size_t>(pairs.height());
}

}  // namespace

FolderCamera::FolderCamera(const FolderCameraSettings& settings, RecordedPairs& pairs, Clock& clock)
    : settings_(settings), pairs_(&pairs), clock_(&clock) {}

Status FolderCamera::open() {
  close();
  if (!(settings_.rate_hz >= 0.01 && settings_.rate_hz <= 1000)) {
    problem_.set("%g pairs per second: out of range", settings_.rate_hz);
    return Status::bad_argument;
  }
  if (pairs_->count() < 1) {
    problem_.set("the recording has no pairs");
    return Status::end_of_data;
  }
  const int last = pairs_->count() - 1;
  period_ = std::llround(static_cast<double>(kSecond) / settings_.rate_hz);
  recorded_times_ = settings_.pace == Pace::recorded && pairs_->time(0) && pairs_->time(last);
  round_ = period_ + (recorded_times_ ? *pairs_->time(last) - *pairs_->time(0) : last * period_);
  memory_.resize(2 * pixels(*pairs_));
  return Status::ok;
}

void FolderCamera::close() {
  memory_.clear();
  started_ = false;
  next_ = 0;
}

bool FolderCamera::over(std::uint64_t number) const {
  return !settings_.repeat && number >= static_cast<std::uint64_t>(pairs_->count());
}

Nanoseconds FolderCamera::due(std::uint64_t number) const {
  const auto count = static_cast<std::uint64_t>(pairs_->count());
  const int n = static_cast<int>(number % count);
  // A pair without a time of its own, between others that have one, is due with the first.
  const Nanoseconds in_round =
      recorded_times_ ? pairs_->time(n).value_or(*pairs_->time(0)) - *pairs_->time(0) : n * period_;
  return start_ + static_cast<Nanoseconds>(number / count) * round_ + in_round;
}

Status FolderCamera::capture(Nanoseconds deadline, StereoFrame& frame) {
  if (memory_.empty()) return Status::disconnected;
  if (over(next_)) return Status::end_of_data;
  const bool paced = settings_.pace != Pace::fastest;
  if (!started_) {
    start_ = clock_->now();
    started_ = true;
  }
  if (paced) {
    if (due(next_) > deadline) {
      clock_->sleep_until(deadline);
      return Status::timeout;
    }
    clock_->sleep_until(due(next_));
    while (!over(next_ + 1) && due(next_ + 1) <= clock_->now()) {
      ++next_;
      ++counters_[kMissed].value;
    }
  }
  const std::uint64_t number = next_++;
  const int n = static_cast<int>(number % static_cast<std::uint64_t>(pairs_->count()));
  const ImageView<std::uint8_t> left(memory_.data(), width(), height());
  const ImageView<std::uint8_t> right(memory_.data() + pixels(*pairs_), width(), height());
  const Nanoseconds time = paced ? due(number) : clock_->now();
  ++counters_[kDecoded].value;
  if (pairs_->load(n, left, right) != Status::ok) {
    ++counters_[kUnreadable].value;
    problem_.set("pair %d of the recording cannot be read", n);
    return Status::bad_data;
  }
  frame = {.left = left, .right = right, .left_time = time, .right_time = time, .sequence = number};
  return Status::ok;
}

}  // namespace lakshya
