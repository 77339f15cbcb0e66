// Everything that a run of the main loop is made of, built from the configuration and ready to begin.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/core/arena.h"
#include "app/core/devices.h"
#include "app/core/pipeline.h"
#include "app/core/vehicle_config.h"
#include "app/loop/capture.h"
#include "app/loop/control.h"
#include "app/loop/driving.h"
#include "app/loop/messages.h"
#include "app/loop/perception.h"
#include "app/loop/sensing.h"

namespace lakshya {

struct VehicleDevices {
  Made<StereoCamera> camera;
  Made<Servo> servo;
  Made<Compass> compass;
  Made<EmergencyStop> estop;
  std::optional<std::vector<WayPoint>> way_points;  // a simulator's own; else those of mission.way_points
};

// Those that the configuration names, not open yet. `clock` outlives them.
VehicleDevices make_devices(const VehicleConfig& config, Clock& clock);

// The calibration that camera.calibration names, seen from `config_path`'s folder where it is relative and there; else that of
// the recorded sequence. Throws InputError.
StereoCalibration loop_calibration(const VehicleConfig& config, const std::string& config_path);

class Machinery {
 public:
  // Opens the devices, the drives first, and takes all memory. `clock`: the devices' and the loop's; `stage_clock`: measures how
  // long the stages take. Both, and `kernels`, outlive it. Throws InputError: a device that does not open, a calibration that does
  // not fit the camera, more memory than memory.limit_mb.
  Machinery(const VehicleConfig& config, const StereoCalibration& calibration, VehicleDevices devices,
            const KernelTable& kernels, Clock& clock, const Clock& stage_clock);
  // The wheels are stopped.
  ~Machinery();
  Machinery(const Machinery&) = delete;
  Machinery& operator=(const Machinery&) = delete;

  const VehicleConfig& config() const { return config_; }
  Clock& clock() const { return *clock_; }
  Exchange& exchange() { return exchange_; }
  Capture& capture() { return *capture_; }
  Perception& perception() { return *perception_; }
  Sensing* sensing() { return sensing_.get(); }  // null: no compass
  Driving& driving() { return *driving_; }
  Control& control() { return *control_; }
  const Control& control() const { return *control_; }
  const Pipeline& pipeline() const { return *pipeline_; }
  Pipeline& pipeline() { return *pipeline_; }
  const VehicleDevices& devices() const { return devices_; }
  // Whether a captured pair has to be decoded, which allocates.
  bool capture_decodes() const;

  std::size_t arena_bytes() const { return arena_.used(); }

 private:
  void open_devices();
  std::size_t lay_out(Arena& arena, std::size_t pipeline_bytes);

  const VehicleConfig config_;
  Clock* clock_;
  VehicleDevices devices_;
  Exchange exchange_;
  Arena arena_;
  std::unique_ptr<Pipeline> pipeline_;
  std::unique_ptr<Capture> capture_;
  std::unique_ptr<Perception> perception_;
  std::unique_ptr<Sensing> sensing_;
  std::unique_ptr<Driving> driving_;
  std::unique_ptr<Control> control_;
};

}  // namespace lakshya
