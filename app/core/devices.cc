#include "app/core/devices.h"

#include <algorithm>
#include <string>
#include <utility>

#include "app/core/device_config_keys.h"
#include "app/core/input_error.h"
#include "app/core/recorded_folder.h"
#include "hal/camera/folder_camera.h"
#include "hal/servo/pwm_servo.h"
#include "hal/servo/record_servo.h"

namespace lakshya {
namespace {

// ---- what a driver needs from the configuration

template <class Kind>
Made<Kind> none(const VehicleConfig& /*config*/, Clock& /*clock*/) {
  return {};
}

template <class Kind>
Made<Kind> sim(const VehicleConfig& /*config*/, Clock& /*clock*/) {
  throw InputError("drivers", "\"sim\" is the simulator's (choose a driver of a device, or run `lakshya sim`)");
}

bool yes(const std::string& answer) {
  return answer == kNoYes[1];
}

Pace pace_of(const std::string& name) {
  if (name == kPaces[0]) return Pace::recorded;
  return name == kPaces[1] ? Pace::rate : Pace::fastest;
}

Made<StereoCamera> folder(const VehicleConfig& config, Clock& clock) {
  const FolderConfig& c = config.folder;
  auto pairs = std::make_shared<RecordedFolder>(c);
  const FolderCameraSettings settings{.pace = pace_of(c.pace), .rate_hz = c.rate_hz, .repeat = yes(c.repeat)};
  auto camera = std::make_unique<FolderCamera>(settings, *pairs, clock);
  return {std::move(pairs), std::move(camera)};
}

Made<Servo> record(const VehicleConfig& config, Clock& clock) {
  return {nullptr, std::make_unique<RecordServo>(RecordServoSettings{.path = config.record.path,
                                                                     .max_speed_mps = config.vehicle.max_speed_mps},
                                                 clock)};
}

Made<Servo> pwm(const VehicleConfig& config, Clock& clock) {
  const PwmConfig& c = config.pwm;
  PwmServoSettings settings;
  settings.chip = c.chip;
  settings.channel = {c.left_channel, c.right_channel};
  settings.direction = {c.left_direction, c.right_direction};
  settings.center_us = {c.left_center_us, c.right_center_us};
  settings.span_us = c.span_us;
  settings.period_us = c.period_us;
  settings.full_speed_mps = c.full_speed_mps;
  settings.max_speed_mps = std::min(c.full_speed_mps, config.vehicle.max_speed_mps);
  settings.slew_mps2 = c.slew_mps2;
  settings.supervised = yes(c.supervised);
  settings.unsupervised_mps = config.drivers.unsupervised_speed_mps;
  return {nullptr, std::make_unique<PwmServo>(std::move(settings), clock)};
}

// ---- the lists

constexpr Driver<StereoCamera> kCameras[] = {{"none", none}, {"folder", folder}, {"sim", sim}};
constexpr Driver<Servo> kServos[] = {{"record", record}, {"pwm", pwm}, {"sim", sim}};
constexpr Driver<Compass> kCompasses[] = {{"none", none}, {"sim", sim}};

template <class Kind>
Made<Kind> make(std::span<const Driver<Kind>> drivers, const std::string& name, const VehicleConfig& config,
                Clock& clock) {
  const auto found = std::ranges::find(drivers, name, &Driver<Kind>::name);
  if (found == drivers.end()) throw InputError("drivers", "\"" + name + "\" is no driver in this program");
  return found->make(config, clock);
}

}  // namespace

std::span<const Driver<StereoCamera>> camera_drivers() {
  return kCameras;
}
std::span<const Driver<Servo>> servo_drivers() {
  return kServos;
}
std::span<const Driver<Compass>> compass_drivers() {
  return kCompasses;
}

Made<StereoCamera> make_camera(const VehicleConfig& config, Clock& clock) {
  return make(camera_drivers(), config.drivers.camera, config, clock);
}
Made<Servo> make_servo(const VehicleConfig& config, Clock& clock) {
  return make(servo_drivers(), config.drivers.servo, config, clock);
}
Made<Compass> make_compass(const VehicleConfig& config, Clock& clock) {
  return make(compass_drivers(), config.drivers.compass, config, clock);
}

WheelOdometrySettings odometry_settings(const VehicleConfig& config) {
  return {.track_m = config.vehicle.track_m,
          .has_compass = config.drivers.compass != "none",
          .heading_time_s = config.odometry.heading_time_s,
          .heading_jump_deg = config.odometry.heading_jump_deg,
          .jump_hold_s = config.odometry.jump_hold_s,
          .max_speed_mps = 1.5 * config.vehicle.max_speed_mps};  // downhill, or pushed
}

}  // namespace lakshya
