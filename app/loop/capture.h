// The first thread's work: a pair from the camera into the loop's memory, looked at on the way.
#pragma once

#include <array>

#include "app/core/loop_config.h"
#include "app/loop/messages.h"
#include "hal/camera.h"
#include "hal/clock.h"

namespace lakshya {

class Capture {
 public:
  // All of them outlive it; the camera is open, the slots of exchange.raw have memory of its size.
  Capture(const SafetyConfig& safety, StereoCamera& camera, const Clock& clock, Exchange& exchange)
      : safety_(safety), camera_(&camera), clock_(&clock), exchange_(&exchange) {}

  // Waits for a pair until `deadline` and hands it over, with a note of what came. ok: there is a new pair.
  Status step(Nanoseconds deadline);

 private:
  void look_at(const StereoFrame& frame);

  const SafetyConfig safety_;
  StereoCamera* camera_;
  const Clock* clock_;
  Exchange* exchange_;
  FrameNote note_;
  std::array<std::uint64_t, 2> hash_{};  // of the pair before, left and right
  std::array<int, 2> same_{};
};

}  // namespace lakshya
