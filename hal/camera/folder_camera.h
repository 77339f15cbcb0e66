// Recorded stereo pairs, given as a camera would give them: a pair every so often, the newest one that is due, late callers
// miss some.
#pragma once

#include <optional>
#include <vector>

#include "hal/camera.h"
#include "hal/clock.h"

namespace lakshya {

// Where the pairs are and how they are decoded is not the driver's business.
class RecordedPairs {
 public:
  virtual ~RecordedPairs() = default;
  virtual int count() const = 0;
  // Of every image.
  virtual int width() const = 0;
  virtual int height() const = 0;
  // Of pair n in 0..count()-1, on the recording's clock; not decreasing. Empty where the recording does not say.
  virtual std::optional<Nanoseconds> time(int n) const = 0;
  // Fills both views, of the size above. bad_data: pair n cannot be read or has another size. May allocate: decoders do.
  virtual Status load(int n, ImageView<std::uint8_t> left, ImageView<std::uint8_t> right) = 0;
};

enum class Pace : std::uint8_t {
  recorded,  // at the recording's own times; at `rate_hz` where it has none
  rate,      // `rate_hz` pairs per second
  fastest,   // every pair, as soon as it is asked for
};

struct FolderCameraSettings {
  Pace pace = Pace::recorded;
  double rate_hz = 10;  // 0.01 .. 1000
  bool repeat = false;  // from the beginning again after the last pair, a period of 1 / rate_hz later
};

class FolderCamera final : public StereoCamera {
 public:
  // `pairs` and `clock` outlive the camera.
  FolderCamera(const FolderCameraSettings& settings, RecordedPairs& pairs, Clock& clock);

  // The first pair is due at the first capture(), so that nothing is missed before. bad_argument: a rate out of range;
  // end_of_data: no pairs.
  Status open() override;
  void close() override;
  // missed: pairs that were over before they were asked for; unreadable; decoded.
  std::span<const Counter> counters() const override { return counters_; }

  int width() const override { return pairs_->width(); }
  int height() const override { return pairs_->height(); }
  // A single pair.
  bool is_static() const override { return pairs_->count() == 1; }

  // The time it takes to decode a pair is not counted against the deadline. Capture times are when the pair was due, or with
  // Pace::fastest when it was asked for.
  Status capture(Nanoseconds deadline, StereoFrame& frame) override;

 private:
  Nanoseconds due(std::uint64_t number) const;
  bool over(std::uint64_t number) const;

  const FolderCameraSettings settings_;
  RecordedPairs* pairs_;
  Clock* clock_;
  bool recorded_times_ = false;
  Nanoseconds period_ = 0;  // of settings_.rate_hz
  Nanoseconds round_ = 0;   // from the first pair of one round to that of the next
  Nanoseconds start_ = 0;   // when the first pair was due
  bool started_ = false;
  std::uint64_t next_ = 0;  // pairs that are over; more than count() when they repeat
  std::vector<std::uint8_t> memory_;
  Counter counters_[3] = {{"missed"}, {"unreadable"}, {"decoded"}};
};

}  // namespace lakshya
