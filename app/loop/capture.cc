#include "app/loop/capture.h"

#include <algorithm>
#include <cstdlib>

#include "app/loop/frame_check.h"

namespace lakshya {

void Capture::look_at(const StereoFrame& frame) {
  RawPair& raw = exchange_->raw.writing();
  // Two cameras freeze one by one.
  const std::array<std::uint64_t, 2> hash{copy_and_hash(frame.left, raw.left),
                                          copy_and_hash(frame.right, raw.right)};
  const bool may_freeze = note_.count > 0 && !camera_->is_static();
  for (std::size_t eye = 0; eye < hash.size(); ++eye)
    same_[eye] = may_freeze && hash[eye] == hash_[eye] ? same_[eye] + 1 : 0;
  note_.same = std::max(same_[0], same_[1]);
  hash_ = hash;

  const BrightnessLevels levels{safety_.dark_level, safety_.bright_level};
  const BrightnessShares l = brightness_shares(raw.left, levels);
  const BrightnessShares r = brightness_shares(raw.right, levels);
  note_.dark = std::max(l.dark, r.dark);
  note_.bright = std::max(l.bright, r.bright);
  note_.skew = std::abs(frame.left_time - frame.right_time);
  note_.taken = std::min(frame.left_time, frame.right_time);
  note_.arrived = clock_->now();
  ++note_.count;

  raw.number = note_.count;
  raw.taken = note_.taken;
  raw.arrived = note_.arrived;
  if (!exchange_->raw.publish()) exchange_->dropped.fetch_add(1, std::memory_order_relaxed);
}

Status Capture::step(Nanoseconds deadline) {
  StereoFrame frame;
  Status status = camera_->capture(deadline, frame);
  if (status == Status::ok &&
      !(same_size(frame.left, frame.right) && same_size(frame.left, exchange_->raw.writing().left)))
    status = Status::bad_data;
  if (status == Status::ok) look_at(frame);
  if (status == Status::bad_data) ++note_.damaged;
  note_.over = status == Status::end_of_data;
  note_.status = status;
  exchange_->frame.writing() = note_;
  (void)exchange_->frame.publish();
  return status;
}

}  // namespace lakshya
