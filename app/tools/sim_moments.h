// What a drive's summary sheet keeps of the drive while it goes on.
#pragma once

#include <string>
#include <vector>

#include "app/core/image.h"
#include "app/loop/messages.h"
#include "app/tools/sim/run_world.h"

namespace lakshya {

// One frame of perception.
struct DriveSample {
  double time_s = 0;
  double clear_m = 0;     // along the chosen direction; 0: no way
  double nearest_m = -1;  // of the map; -1: none
  bool blocked = false;
  State state = State::init;
};

struct DriveMoment {
  double time_s = 0;
  Image<Rgb8> picture;  // camera tinted by classes
  std::string text;     // why it was kept, what was decided
};

struct DriveRecord {
  std::vector<DriveSample> samples;
  std::vector<DriveMoment> moments;  // in order of time
};

class SimMoments final : public sim::Onlooker {
 public:
  // has_camera: false where the sensor does not look at the camera's pictures.
  explicit SimMoments(bool has_camera) : has_camera_(has_camera) {}

  void on_frame(const FrameResult& frame, const PlanNote& plan, const sim::Shot& shot) override;
  void on_turn(const StatusNote& status, const sim::VehicleState& /*vehicle*/) override { state_ = status.state; }

  // Moments: the first frame, the one with the nearest obstacle, the first without a way, the last one, and of the others some
  // that are spread over the drive; kMoments at most.
  DriveRecord record() const;

  static constexpr std::size_t kMoments = 5;

 private:
  struct Kept {
    std::size_t frame = 0;
    DriveMoment moment;
  };
  Kept keep(const FrameResult& frame, const PlanNote& plan, double time_s, const char* why) const;
  void spread(Kept kept);

  const bool has_camera_;
  State state_ = State::init;
  std::vector<DriveSample> samples_;
  std::vector<Kept> spread_;  // every `step_`th frame; thinned out when there are too many
  std::size_t step_ = 1;
  Kept nearest_;
  double nearest_m_ = -1;
  Kept blocked_;
  bool was_blocked_ = false;
  Kept last_;
};

}  // namespace lakshya
