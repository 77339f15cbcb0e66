// A vehicle in a world, as the firmware's devices see it: cameras, drives and compass for Machinery, on the virtual clock.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/core/image.h"
#include "app/core/pipeline.h"
#include "app/core/vehicle_config.h"
#include "app/loop/machinery.h"
#include "app/tools/sim/camera_pose.h"
#include "app/tools/sim/image_sensor.h"
#include "app/tools/sim/renderer.h"
#include "app/tools/sim/rig.h"
#include "app/tools/sim/stand_ins.h"
#include "app/tools/sim/vehicle.h"
#include "app/tools/sim/world.h"
#include "hal/camera/sim_camera.h"

namespace lakshya::sim {

struct SimulationSettings {
  SimRig rig;
  double fps = 10;                // pairs a second
  double mount_error_deg = 0.15;  // standard deviation of the mount's pitch and roll against the configuration's
  bool draws = true;              // false: noise instead of pictures, for a stand-in that does not look at them
  VehicleSettings vehicle;
  ImageSensorSettings sensor;
  std::uint64_t seed = 1;
};

class Simulation final : public FrameProducer {
 public:
  // `world` and `clock` outlive it.
  Simulation(const SimulationSettings& settings, const World& world, const VehicleConfig& config, Clock& clock);

  // For the firmware; they refer to this object. Way points: the world's goals, from where the vehicle starts.
  VehicleDevices devices();
  const StereoCalibration& calibration() const { return calibration_; }
  const RectifiedGeometry& camera() const { return camera_; }

  Status produce(Nanoseconds time, std::uint64_t number, ImageView<std::uint8_t> left,
                 ImageView<std::uint8_t> right) override;

  Vehicle& vehicle() { return vehicle_; }
  Renderer& renderer() { return renderer_; }
  const Shot& shot() const { return shot_; }
  // All who walk, on to `time` and where the vehicle is then; in order of time.
  WalkTimes walks(Nanoseconds time);
  double seconds(Nanoseconds time) const {
    return static_cast<double>(time - start_) / static_cast<double>(kSecond);
  }

 private:
  const SimulationSettings settings_;
  const World* world_;
  const VehicleConfig config_;
  Clock* clock_;
  const Nanoseconds start_;
  StereoCalibration calibration_;
  Rectification rectification_;
  RectifiedGeometry camera_;
  CameraConfig true_mount_;
  Vehicle vehicle_;
  Walkers walkers_;
  Renderer renderer_;
  RayTable left_rays_;
  RayTable right_rays_;
  ImageSensor sensor_;
  Shot shot_;
  Image<float> left_;
  Image<float> right_;
};

// The vehicle that is simulated where no configuration file is given, as --set takes it: a camera 1.05 m high, 15 degrees nose down.
std::vector<std::string> simulated_vehicle_settings(bool indoor);

// With what the simulator brings: its devices, no way-point file, nothing recorded.
VehicleConfig with_simulated_devices(VehicleConfig config);

}  // namespace lakshya::sim
