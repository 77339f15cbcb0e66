// Point Grey Bumblebee2 (640 x 480, 1024 x 768) and Bumblebee XB3 (1280 x 960, two of its eyes) as a stereo camera.
#pragma once

#include <array>
#include <vector>

#include "hal/camera.h"
#include "hal/camera/bumblebee.h"
#include "hal/camera/eye_check.h"
#include "hal/camera/iidc_camera.h"
#include "hal/retry.h"

namespace lakshya {

struct BumblebeeSettings {
  std::uint64_t guid = 0;  // of the camera (label on it); 0: the first one found
  int width = 640;         // px of one eye, even, 16..4096
  int height = 480;
  BayerPattern pattern = BayerPattern::none;  // of a colour head: what its data sheet says
  bool first_is_left = false;  // the first byte of a pixel is the left eye's: not to be believed, see check_eyes
  bool check_eyes = true;      // the first good pairs are looked at, and a wrong order is corrected (eye_check.h)
  int packet_bytes = 0;        // per bus cycle, which sets the frame rate; 0: the camera's recommendation
  int buffers = 4;             // 2..32
};

class BumblebeeCamera final : public StereoCamera {
 public:
  // `bus` and `clock` outlive the camera.
  BumblebeeCamera(const BumblebeeSettings& settings, IidcCamera& bus, Clock& clock);
  ~BumblebeeCamera() override;
  BumblebeeCamera(const BumblebeeCamera&) = delete;
  BumblebeeCamera& operator=(const BumblebeeCamera&) = delete;

  Status open() override;
  void close() override;
  std::span<const Counter> counters() const override;

  int width() const override { return settings_.width; }
  int height() const override { return settings_.height; }

  // As StereoCamera::capture(). A camera that has gone is looked for every 200 ms, by calls of this; they wait until it is time
  // to look. Setting it up again may take longer than the deadline, and so may the first pairs, by a look at the eyes each. After
  // a pause in which all buffers filled, the first pair is as old as its time says.
  Status capture(Nanoseconds deadline, StereoFrame& frame) override;

 private:
  Status look_again(Nanoseconds deadline);
  Status newest(Nanoseconds deadline);
  Status make_views(StereoFrame& frame);

  const BumblebeeSettings settings_;
  IidcCamera* bus_;
  Clock* clock_;
  EyeCheck eyes_;
  bool wanted_ = false;  // opened, and not closed
  bool running_ = false;
  Retry retry_;
  IidcFrame raw_;
  Nanoseconds fetched_ = 0;  // when raw_ was, which is when its age was taken
  std::uint64_t sequence_ = 0;
  std::vector<std::uint8_t> memory_;  // two mosaics, then two grey images
  Counter disconnections_{"disconnections"};
  Counter dropped_{"dropped_frames"};
  Counter torn_{"torn_frames"};
  Counter short_{"short_frames"};  // too few bytes, or of another size
  Counter unstamped_{"unstamped_frames"};
  mutable std::array<Counter, 7> shown_{};
};

}  // namespace lakshya
