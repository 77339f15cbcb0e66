#include "app/tools/sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/core/rectification.h"
#include "app/tools/sim/random.h"

namespace lakshya::sim {
namespace {

constexpr double kSensorColumns = 640;  // for which ImageSensorSettings::noise_grey is given

CameraConfig with_error(CameraConfig mount, double deviation_deg, std::uint64_t seed) {
  Random random(seed ^ 0xCA'0000'0000ULL);
  mount.pitch_deg += deviation_deg * random.normal();
  mount.roll_deg += deviation_deg * random.normal();
  return mount;
}

VehicleSettings vehicle_settings(VehicleSettings settings, const VehicleConfig& config) {
  settings.track_m = config.vehicle.track_m;
  return settings;
}

ImageSensorSettings sensor_settings(const SimulationSettings& settings, const StereoCalibration& calibration) {
  ImageSensorSettings sensor = settings.sensor;
  sensor.focal_px = calibration.left.fx;
  sensor.seed = settings.seed;
  // A smaller picture of the same sensor is binned: the mean of n pixels has 1/sqrt(n) of their noise.
  sensor.noise_grey *= std::min(1.0, settings.rig.width / kSensorColumns);
  return sensor;
}

// Never the same twice, or the loop would take the camera for frozen.
void fill_with_noise(ImageView<std::uint8_t> image, std::uint64_t seed) {
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u)
      image.at(u, v) = static_cast<std::uint8_t>(64 + ((static_cast<std::uint64_t>(u) * 31 + seed) & 63));
  }
}

}  // namespace

Simulation::Simulation(const SimulationSettings& settings, const World& world, const VehicleConfig& config,
                       Clock& clock)
    : settings_(settings),
      world_(&world),
      config_(config),
      clock_(&clock),
      start_(clock.now()),
      calibration_(rig_calibration(settings.rig)),
      rectification_(needs_remap(calibration_)
                         ? rectify_stereo(calibration_, settings.rig.width, settings.rig.height)
                         : Rectification{}),
      camera_(rectified_geometry(calibration_, settings.rig.width, settings.rig.height)),
      true_mount_(with_error(config.camera, settings.mount_error_deg, settings.seed)),
      vehicle_(vehicle_settings(settings.vehicle, config), world, settings.seed, clock.now()),
      walkers_(world),
      renderer_(world),
      left_rays_(calibration_.left, settings.rig.width, settings.rig.height),
      right_rays_(calibration_.right, settings.rig.width, settings.rig.height),
      sensor_(sensor_settings(settings, calibration_), left_rays_, right_rays_),
      left_(settings.rig.width, settings.rig.height),
      right_(settings.rig.width, settings.rig.height) {}

VehicleDevices Simulation::devices() {
  VehicleDevices devices;
  const SimCameraSettings camera{
      .width = settings_.rig.width, .height = settings_.rig.height, .fps = settings_.fps};
  devices.camera.device = std::make_unique<SimCamera>(camera, *this, *clock_);
  devices.servo.device = std::make_unique<SimServo>(config_.vehicle.max_speed_mps * 1.5, vehicle_, *clock_);
  devices.compass.device = std::make_unique<SimCompass>(config_.compass.rate_hz, vehicle_, *clock_);
  devices.way_points.emplace();
  for (const Eigen::Vector2d& goal : world_->goals)
    devices.way_points->push_back({goal.x() - world_->start.x, goal.y() - world_->start.y});
  return devices;
}

WalkTimes Simulation::walks(Nanoseconds time) {
  const VehicleState& vehicle = vehicle_.at(time);
  walkers_.step(seconds(time), vehicle.x, vehicle.y, config_.vehicle.radius_m);
  return walkers_.times();
}

Status Simulation::produce(Nanoseconds time, std::uint64_t number, ImageView<std::uint8_t> left,
                           ImageView<std::uint8_t> right) {
  shot_.vehicle = vehicle_.at(time);
  shot_.time_s = seconds(time);
  shot_.walks = walks(time);
  shot_.rectified = rectified_camera(shot_.vehicle, true_mount_);
  if (!settings_.draws) {
    fill_with_noise(left, 2 * number);
    fill_with_noise(right, 2 * number + 1);
    return Status::ok;
  }
  const EyePoses poses = eyes(shot_.rectified, calibration_, rectification_.R1);
  renderer_.set_time(shot_.walks);
  renderer_.radiance(left_rays_, poses.left, left_.view());
  renderer_.radiance(right_rays_, poses.right, right_.view());
  const auto sun = [&](const CameraPose& pose) {
    return sun_in_picture(pose, world_->light.sun_direction, renderer_.sun_at(pose.position));
  };
  const SensorFrame frame{.number = number,
                          .yaw_rate = shot_.vehicle.turn_rate_rps,
                          .sun_left = sun(poses.left),
                          .sun_right = sun(poses.right)};
  sensor_.expose(left_.view(), right_.view(), frame, left, right);
  return Status::ok;
}

// The matcher's limits are stricter than for pictures with ground truth, where a wrong match costs no more than a missing one: here it
// stands in the way.
std::vector<std::string> simulated_vehicle_settings(bool indoor) {
  std::vector<std::string> sets{"camera.height_m=1.05",
                                "camera.pitch_deg=15",
                                "camera.forward_m=0.2",
                                "camera.left_m=0.06",
                                "planner.name=route",
                                "planner.blind_zone_m=0.5",
                                "matcher.uniqueness_percent=25",
                                "matcher.support_min_percent=45",
                                "matcher.support_radius_px=4",
                                "matcher.support_max_difference=32"};
  if (!indoor) sets.insert(sets.end(), {"vehicle.max_speed_mps=1.5", "planner.active_radius_m=4"});
  return sets;
}

VehicleConfig with_simulated_devices(VehicleConfig config) {
  config.drivers = {.camera = "sim",
                    .servo = "sim",
                    .compass = "sim",
                    .unsupervised_speed_mps = config.drivers.unsupervised_speed_mps};
  config.mission.way_points.clear();
  config.record.path.clear();
  return config;
}

}  // namespace lakshya::sim
